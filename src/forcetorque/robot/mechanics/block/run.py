# SPDX-License-Identifier: BSD-3-Clause
"""Run the compiled evaluator over all samples, on several threads."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import IntArray
from forcetorque.base.compiled import announced, frozen
from forcetorque.robot.block.lanes import LANES
from forcetorque.robot.mechanics.block.drive import Answer, driver
from forcetorque.robot.mechanics.block.plan import plan_of
from forcetorque.robot.mechanics.estimates import Estimates
from forcetorque.robot.mechanics.inputs import Inputs, refuse_infinite
from forcetorque.robot.mechanics.question import Question

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
