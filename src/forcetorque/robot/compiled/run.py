# SPDX-License-Identifier: BSD-3-Clause
"""Run the compiled evaluator over all samples: block by block in one compiled function, on several threads."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from numba import njit

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.compiled_functions import announced, frozen, source_digest
from forcetorque.robot.compiled import stages
from forcetorque.robot.compiled.plan import plan_of
from forcetorque.robot.compiled.recursion_and_vectors import DRIVER, LANES, STRIDE
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimate_inputs import Inputs, refuse_infinite
from forcetorque.robot.mechanics.estimated_quantities import Question


class Scratch(NamedTuple):
    """Rows of lanes; one body, contact or sensor per line."""

    q: FloatArray
    dq: FloatArray
    ddq: FloatArray
    cosine: FloatArray
    sine: FloatArray
    motion: FloatArray
    wrench: FloatArray  # of every body, summed up inside sub-models
    expected: FloatArray  # the same, summed up over the whole robot; if both are asked for
    readout: FloatArray  # expected readings
    known: FloatArray  # wrenches of known contacts
    reading: FloatArray  # of the measured sensors, on the outboard part, in the frame of the cut
    residue: FloatArray  # what sub-models outboard leave, on every body
    contact: FloatArray  # unknown wrenches
    torque: FloatArray
    columns: FloatArray  # of the equation of one sub-model
    solution: FloatArray
    right: FloatArray
    work: FloatArray
    carried: FloatArray  # one wrench on its way
    active: FloatArray
    rank: FloatArray
    condition: FloatArray
    gap: FloatArray  # zero where all results so far are finite


@njit(**DRIVER)
def make_scratch(coordinates, bodies, both, leaving, expected, known, sensors, contacts, unknowns, torques):
    """Scratch for so many of each."""
    return Scratch(
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates + 1, 9 * STRIDE)),
        np.zeros((bodies, 6 * STRIDE)),
        np.zeros((both, 6 * STRIDE)),
        np.zeros((expected, 6 * STRIDE)),
        np.zeros((known, 6 * STRIDE)),
        np.zeros((sensors, 6 * STRIDE)),
        np.zeros((leaving, 6 * STRIDE)),
        np.zeros((contacts, 6 * STRIDE)),
        np.zeros((torques, STRIDE)),
        np.zeros((unknowns, 6 * STRIDE)),
        np.zeros((unknowns, STRIDE)),
        np.zeros(6 * STRIDE),
        np.zeros((8, STRIDE)),
        np.zeros(6 * STRIDE),
        np.ones((contacts, STRIDE)),
        np.zeros(STRIDE),
        np.zeros(STRIDE),
        np.zeros(STRIDE),
    )


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
    source = source_digest(Path(__file__).parent)

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


def has_copy() -> bool:
    """Tell whether the compiled evaluator is on disk.

    Returns:
        Whether it is; also where the copy is of another version, which is compiled anew.
    """
    folder = driver().stats.cache_path  # type: ignore[attr-defined]  # of numba, without types
    return folder is not None and any(Path(folder).glob("run.driver.locals.drive-*.nbi"))


_CHUNK = 16384
"""Most samples of one task: long against the cost of starting it, and small in memory."""


def run_compiled(
    question: Question, inputs: Inputs, out: Estimates, *, threads: int | None, progress: Callable[[int], None] | None
) -> None:
    """Answer a question in compiled code.

    Args:
        question: The question.
        inputs: Its input.
        out: Where the answer goes.
        threads: Number of threads; as many as there are processors if None.
        progress: Called with the number of samples done so far.
    """
    plan, joints = plan_of(question, inputs.needs, inputs.switched)
    joint_columns = np.array([inputs.joints.names.index(joint) for joint in joints], dtype=np.int64)
    measured_columns, known_columns = _six_columns(inputs.measured_columns), _six_columns(inputs.known_columns)
    motion = (inputs.joints.position, inputs.joints.velocity, inputs.joints.acceleration)

    def task(block: slice) -> int:
        arrays = (
            tuple(frozen(values[block]) for values in motion),
            tuple(frozen(values if len(values) == 1 else values[block]) for values in inputs.root),
            measured_columns,
            frozen(_flat(inputs.measured.values[block])),
            known_columns,
            frozen(_flat(inputs.known.values[block])),
            frozen(inputs.active[block] if inputs.switched else np.empty((0, 0), dtype=bool)),
        )
        if driver()(plan, joint_columns, *arrays, _answer(out.samples(block))):
            refuse_infinite(inputs, block)
        return int(block.stop)

    workers = threads or os.cpu_count() or 1
    chunks = _chunks(len(out), workers)
    with (
        announced("compiling the dynamics for this machine, once; it takes about a minute"),
        # a control loop asks for few samples at a time, and starting a thread takes longer than answering
        ThreadPoolExecutor(workers) if len(chunks) > 1 else nullcontext() as pool,
    ):
        if pool is not None:
            task(slice(0, 0))  # two threads would compile the same
        for done in map(task, chunks) if pool is None else pool.map(task, chunks):
            if progress is not None:
                progress(done)


def _chunks(n: int, workers: int) -> list[slice]:
    """Divide samples into tasks of whole blocks, as many for each worker."""
    count = max(workers, -(-n // (_CHUNK * workers)) * workers)
    size = max(-(-n // (count * LANES)), 1) * LANES
    return [slice(start, min(start + size, n)) for start in range(0, n, size)]


def _six_columns(wrenches: IntArray) -> IntArray:
    return (6 * wrenches[:, None] + np.arange(6)).reshape(-1)


def _flat(wrenches: npt.NDArray[Any]) -> npt.NDArray[Any]:
    return wrenches.reshape(len(wrenches), 6 * wrenches.shape[1])


def _answer(out: Estimates) -> Answer:
    return Answer(**{name: _writable(getattr(out, name)) for name in Answer._fields})


def _writable(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    components = math.prod(values.shape[1:])
    return values.view(np.ndarray).reshape(len(values), components)
