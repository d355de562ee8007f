# SPDX-License-Identifier: BSD-3-Clause
"""A plan as files that robots can play."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.files import new_folder, refuse_existing
from forcetorque.planning.planning import Plan
from forcetorque.planning.proposal import Proposal
from forcetorque.planning.trajectory import write_trajectory
from forcetorque.robot.motion import JointMotion


def refuse_full_folder(output: Path, *, where: str = "") -> None:
    """Refuse a folder that holds something, before any work is done.

    Args:
        output: Folder to make; an empty one is taken.
        where: What the message says in front of its name, such as the option that names it.

    Raises:
        ForceTorqueError: If it is there and not an empty folder.
    """
    if not output.is_symlink() and output.is_dir():
        if any(output.iterdir()):
            raise ForceTorqueError(f"{where}{output}: expected a new or empty folder, it holds something")
        return
    refuse_existing(output, where=where)


def write_plan(plan: Plan, output: Path) -> Plan:
    """Write the trajectories of a plan, all or nothing.

    Args:
        plan: The plan.
        output: Folder to make, or an empty one.

    Returns:
        The plan with the name of its folder.

    Raises:
        ForceTorqueError: If the folder holds something.
    """
    refuse_full_folder(output)
    written = plan.model_copy(update={"folder": str(output)})
    if output.is_dir():
        output.rmdir()
    with new_folder(output) as folder:
        for number, proposal in enumerate(plan.proposals, start=1):
            _write(folder, number, proposal)
        (folder / "plan.json").write_text(written.json_text() + "\n", encoding="utf-8")
    return written


def _write(folder: Path, number: int, proposal: Proposal) -> None:
    joints = proposal.place.stand.model.joints
    write_trajectory(
        folder,
        f"trajectory_{number}",
        lambda rate_hz: _sampled(proposal, rate_hz),
        tuple(joints[name].type.unit for name in proposal.place.joints),
    )


def _sampled(proposal: Proposal, rate_hz: float) -> tuple[FloatArray, JointMotion]:
    """Instants from start to end, and all joints that the load depends on."""
    way = proposal.trajectory
    time = np.append(np.arange(0.0, way.duration_s, 1.0 / rate_hz), way.duration_s)
    if time[-1] - time[-2] < 0.5 / rate_hz:
        time = np.delete(time, -2)
    motion, columns = way(time), proposal.place.stand.columns(proposal.place.joints)
    return time, JointMotion(
        names=proposal.place.joints,
        position=motion.position[:, columns],
        velocity=motion.velocity[:, columns],
        acceleration=motion.acceleration[:, columns],
    )
