# SPDX-License-Identifier: BSD-3-Clause
"""All samples of a chunk, block by block: the one function that is compiled and kept on disk."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import NamedTuple

from numba import njit

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.compiled import source_digest
from forcetorque.robot.block import lanes
from forcetorque.robot.block.lanes import DRIVER, LANES
from forcetorque.robot.mechanics.block import stages
from forcetorque.robot.mechanics.block.scratch import make_scratch


class Answer(NamedTuple):
    """Where the results go; shape (n, components)."""

    expected: FloatArray
    contact_wrenches: FloatArray
    torques: FloatArray
    net_wrenches: FloatArray
    rank: IntArray
    condition: FloatArray
    residual: FloatArray


@cache
def driver() -> Callable[..., bool]:
    """Give the compiled evaluator; the first machine to call it compiles it.

    Returns:
        A function of a plan and the arrays of a chunk that fills an `Answer` and tells whether any of
        it is not finite.
    """
    source = source_digest(Path(__file__).parent, Path(lanes.__file__).parent)

    @njit(cache=True, **DRIVER)
    def drive(plan, joint_columns, motion, root, measured_columns, measured, known_columns, known, active, out):
        source  # noqa: B018 - closed over: a change in any of the files compiles it anew
        gap = False
        solving = len(plan.parts.base) > 0 or len(plan.torques.body) > 0
        bodies = len(plan.bodies.parent)
        work = make_scratch(
            len(joint_columns),
            bodies,
            bodies if solving and len(plan.expected_frames.body) else 0,
            bodies if len(plan.sums.residue) else 0,
            len(plan.expected_frames.body),
            len(plan.known_frames.body),
            len(plan.measured_frames.body),
            len(plan.contacts.unknowns),
            plan.contacts.unknowns.sum(),
            len(plan.torques.body),
        )
        for first in range(0, len(motion[0]), LANES):
            count = min(LANES, len(motion[0]) - first)
            stages.read_motion(plan.bodies, work, joint_columns, motion, root, first, count)
            for j in range(active.shape[1]):
                for k in range(count):
                    work.active[j, k] = 1.0 if active[first + k, j] else 0.0
            stages.demand(plan.bodies, work)
            stages.link_wrenches(plan.bodies, plan.links, plan.link_frames, work, out.net_wrenches, first, count)
            stages.take_known(plan.known_frames, work, known_columns, known, first, count)
            if len(plan.expected_frames.body):
                wrenches = work.wrench
                if solving:
                    work.expected[:] = work.wrench
                    wrenches = work.expected
                frames = plan.expected_frames
                stages.expect(plan.bodies, plan.sums, frames, work, wrenches, out.expected, first, count)
            if solving:
                frames = plan.measured_frames
                stages.read_sensors(plan.bodies, frames, work, measured_columns, measured, first, count)
                stages.solve_parts(plan, work, out, count, first)
                stages.carry_residue(plan, work)
                stages.torques(plan, work, out.torques, first, count)
            for k in range(count):
                gap |= work.gap[k] != 0.0
        return gap

    return drive
