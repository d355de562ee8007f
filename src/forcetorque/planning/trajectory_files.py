# SPDX-License-Identifier: BSD-3-Clause
"""Plans and joint trajectories as files that robots play: ROS, a table, a folder of yarpdatadumper."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import new_folder, refuse_existing
from forcetorque.formats.yarp.log_format import PortKind
from forcetorque.formats.yarp.writing import StreamPort, write_ports
from forcetorque.planning.planning import Plan
from forcetorque.planning.proposed_recordings import Proposal
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.motion import JointMotion


def ros_trajectory(time_s: FloatArray, motion: JointMotion) -> str:
    """Write a trajectory with positions and velocities.

    Args:
        time_s: Instants from the start; shape (n,); s.
        motion: The motion at them; rad or m.

    Returns:
        YAML.
    """
    names = ", ".join(json.dumps(name) for name in motion.names)
    lines = [
        "header:",
        "  stamp: {sec: 0, nanosec: 0}",
        '  frame_id: ""',
        f"joint_names: [{names}]",
        "points:",
    ]
    for time, position, velocity in zip(time_s.tolist(), motion.position, motion.velocity, strict=True):
        total = round(time * 1e9)
        lines += [
            f"- positions: {_list(position)}",
            f"  velocities: {_list(velocity)}",
            f"  time_from_start: {{sec: {total // 10**9}, nanosec: {total % 10**9}}}",
        ]
    return "\n".join(lines) + "\n"


def _list(values: FloatArray) -> str:
    # plain decimals: YAML 1.1 takes 1e-05 for a text
    return "[" + ", ".join(f"{value:.9f}" for value in values) + "]"


TIME_COLUMN = "time_s"
"""Heading of the time."""


def trajectory_table(time_s: FloatArray, motion: JointMotion) -> str:
    """Write a trajectory as CSV.

    Args:
        time_s: Instants from the start; shape (n,); s.
        motion: Positions at them; rad or m.

    Returns:
        A line of headings, and a line per instant.
    """
    lines = [",".join((TIME_COLUMN, *motion.names))]
    lines += [
        ",".join((f"{time:.3f}", *(f"{value:.9g}" for value in row)))
        for time, row in zip(time_s.tolist(), motion.position.tolist(), strict=True)
    ]
    return "\n".join(lines) + "\n"


PORT = "plan/state:o"
"""Folder of the port below the folder of logs."""
_START_NS = 1_000_000_000
"""First stamp: yarp takes one of 0 for none."""


def write_yarp_positions(folder: Path, time_s: FloatArray, motion: JointMotion, units: tuple[str, ...]) -> None:
    """Write positions of joints, in deg for those that turn.

    Args:
        folder: Folder of logs to make.
        time_s: Instants from the start; shape (n,); s.
        motion: Positions at them; rad or m.
        units: Unit of every joint.
    """
    signal = Signal(quantity="position", values=motion.position, columns=motion.names, units=units)
    stamps = _START_NS + np.rint(time_s * 1e9).astype(np.int64)
    stream = Stream(name="positions", clock="plan", stamp_ns=stamps, signals={"position": signal})
    port = StreamPort(path=PORT, kind=PortKind.STATE, stream="positions")
    write_ports(folder, Recording(streams={"positions": stream}), [port])


_DENSE_HZ, _SPARSE_HZ = 50.0, 10.0
"""Rates of what is played sample by sample, and of what controllers interpolate."""


def write_trajectory(
    folder: Path, stem: str, sampled: Callable[[float], tuple[FloatArray, JointMotion]], units: tuple[str, ...]
) -> None:
    """Write a trajectory as a table, for ROS, and for YARP.

    Args:
        folder: Folder that is there.
        stem: How the names of the files begin.
        sampled: From a rate in Hz to instants, shape (n,), in s, and the motion at them.
        units: Unit of every joint.
    """
    dense, motion = sampled(_DENSE_HZ)
    (folder / f"{stem}.csv").write_text(trajectory_table(dense, motion), encoding="utf-8")
    sparse, coarse = sampled(_SPARSE_HZ)
    (folder / f"{stem}_ros.yaml").write_text(ros_trajectory(sparse, coarse), encoding="utf-8")
    write_yarp_positions(folder / f"{stem}_yarp", dense, motion, units)


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
