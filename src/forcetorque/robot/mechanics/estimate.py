# SPDX-License-Identifier: BSD-3-Clause
"""Estimates for all samples: input checked and matched by name, then the readable or the compiled evaluator."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.contact_wrenches_and_torques import Block, BlockEvaluation, body_states
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimate_inputs import Inputs, checked_inputs, refuse_infinite
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.motion import JointMotion, RootMotion

_FEW = 20000
"""Fewer samples than this take the readable evaluator no longer than loading the compiled one."""
_FEW_TO_COMPILE, _FEW_EXPECTED_TO_COMPILE = 100_000, 400_000
"""Fewer samples than this take the readable evaluator up to 6 s, 50 us each for contacts and torques and 15 us for
expected wrenches alone: where nothing is compiled yet, that is sooner than the 33 s of compiling."""

_BLOCK = 4096
"""Samples per pass of the readable evaluator: its working arrays stay in the processor's cache."""


class Evaluator(StrEnum):
    """Who computes; both give the same numbers but for rounding."""

    READABLE = "readable"
    """NumPy, one equation after the other."""
    COMPILED = "compiled"
    """Blocks of samples in compiled code, on several threads."""


def evaluator_of_samples(samples: int, *, expected_only: bool = False) -> Evaluator:
    """Choose who computes so many samples.

    Args:
        samples: Number of samples, of all calls of `estimate` together.
        expected_only: Whether nothing but expected wrenches is wanted.

    Returns:
        The readable evaluator for few, and for more on a machine that has nothing compiled yet.
    """
    if samples < _FEW:
        return Evaluator.READABLE
    enough = samples >= (_FEW_EXPECTED_TO_COMPILE if expected_only else _FEW_TO_COMPILE)
    return Evaluator.COMPILED if enough or _is_compiled() else Evaluator.READABLE


def _is_compiled() -> bool:
    from forcetorque.robot.compiled.run import has_copy  # here: it loads the compiler

    return has_copy()


def estimate(
    question: Question,
    joints: JointMotion,
    root: RootMotion,
    *,
    measured: Wrenches | None = None,
    known: Wrenches | None = None,
    active: Mapping[str, Any] | None = None,
    out: Estimates | None = None,
    evaluator: Evaluator | None = None,
    threads: int | None = None,
    progress: Callable[[int], None] | None = None,
) -> Estimates:
    """Estimate what a question asks for.

    NaN in a sample is a gap: it makes NaN of what depends on it, in that sample and in no other.
    Arrays that are read-only, such as mapped files, are not copied, so that with `out` in mapped
    files any number of samples runs in little memory.

    Args:
        question: What is asked.
        joints: Motion of at least the joints that it depends on (`required_joints_of`); n samples.
        root: Motion of the root link's frame; one sample or n.
        measured: Readings of at least the sensors that the tree is cut at, in their frames and directions.
        known: Wrenches of at least the known contacts, in their contact frames.
        active: By the name of an unknown contact, whether it is there; shape (n,), bool; others always are.
        out: Where the answer goes; made if None.
        evaluator: Who computes; by the number of samples if None.
        threads: Threads of the compiled evaluator; as many as there are processors if None.
        progress: Called with the number of samples done so far.

    Returns:
        The answer; `out` if it was given.

    Raises:
        RobotError: If a joint that is needed is not in `joints`.
        EstimationError: If readings or known wrenches are missing, a sub-model has more than six unknowns at once
            and the question no `minimum_norm`, or an input is infinite.
        ShapeError: If numbers of samples differ.
    """
    n = len(joints)
    inputs = checked_inputs(question, joints, root, measured, known, active)
    answer = Estimates.empty(question.layout, n) if out is None else out
    if len(answer) != n or answer.layout != question.layout:
        raise ShapeError(f"out: expected {n} samples of {question.layout}, got {len(answer)} of {answer.layout}")
    if evaluator is None:
        evaluator = evaluator_of_samples(n)
    if Evaluator(evaluator) is Evaluator.READABLE:
        _run_readable(question, inputs, answer, progress)
    else:
        # imported here: it loads the compiler
        from forcetorque.robot.compiled.run import run_compiled

        run_compiled(question, inputs, answer, threads=threads, progress=progress)
    return answer


def _run_readable(question: Question, inputs: Inputs, out: Estimates, progress: Callable[[int], None] | None) -> None:
    for start in range(0, len(out), _BLOCK):
        block = slice(start, min(start + _BLOCK, len(out)))
        refuse_infinite(inputs, block)
        count = block.stop - start
        root = [np.broadcast_to(v if len(v) == 1 else v[block], (count, 3)) for v in inputs.root]
        given = Block(
            joints=inputs.joints.samples(block),
            root=np.stack(root),
            measured=inputs.measured.values[block][:, inputs.measured_columns],
            known=inputs.known.values[block][:, inputs.known_columns],
            active=inputs.active[block].astype(np.float64),
        )
        states = body_states(question, inputs.needs, given)  # outwards; the wrenches inwards
        BlockEvaluation(question, inputs.needs, given, states, out.samples(block)).run()
        if progress is not None:
            progress(block.stop)
