# SPDX-License-Identifier: BSD-3-Clause
"""The compiled evaluator gives the numbers of the readable one, on random robots and questions."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question, moving_joints
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.fuzzing import examples
from tests.robot.mechanics.random_robots import Problem, problems, random_unit
from tests.robot.mechanics.simulated import random_pose, random_root
from tests.scenes.robots import icub, random_motion

EPS = float(np.finfo(np.float64).eps)

ROUNDINGS = 300.0
"""Roundings along a chain of nine links and in a least-squares solution, per unit of its condition: 30 in the worst
of 1500 examples, with a margin of ten."""

EXAMPLES = examples(320)

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large]
"""A robot takes many draws."""


def _both(problem: Problem) -> tuple[Estimates, Estimates]:
    readable = estimate(problem.question, evaluator=Evaluator.READABLE, **problem.inputs())
    return readable, estimate(problem.question, evaluator=Evaluator.COMPILED, **problem.inputs())


def _condition(problem: Problem) -> FloatArray:
    """Condition of the worst equation in every sample, (n,); 1 where nothing is unknown."""
    all_parts = Question(
        tree=problem.question.tree,
        measured=problem.question.measured,
        contacts=problem.question.contacts,
        minimum_norm=problem.question.minimum_norm,
    )
    found = estimate(all_parts, evaluator=Evaluator.READABLE, **problem.inputs())
    worst: FloatArray = np.nan_to_num(found.condition, nan=1.0).max(axis=1, initial=1.0)
    return worst


def _gaps(values: FloatArray) -> BoolArray:
    """Which wrenches, or torques, of which samples have a gap, in any component."""
    gaps: BoolArray = np.isnan(values).any(axis=tuple(range(2, values.ndim)))
    return gaps


def _forgiven(problem: Problem, field: str) -> BoolArray:
    """Samples in which the compiled evaluator may have gaps more.

    A torque of the whole tree does not depend on the reading at a sub-model without unknown contacts; the
    compiled evaluator adds that reading and takes it off again, and so gives NaN where it is missing.
    """
    samples = np.zeros((len(problem.joints), 1), dtype=bool)
    if field == "torques" and problem.measured is not None:
        samples |= np.isnan(problem.measured.values).any(axis=(1, 2))[:, None]
    return samples


def _worst(problem: Problem, readable: Estimates, compiled: Estimates) -> float:
    """Largest difference over the rounding that the worst equation of its sample allows."""
    fields = ("expected", "contact_wrenches", "torques", "net_wrenches", "residual")
    given = [wrenches.values for wrenches in (problem.measured, problem.known) if wrenches is not None]
    sizes = [
        np.nan_to_num(np.abs(values)).max(initial=1.0) for values in (*given, *(getattr(readable, f) for f in fields))
    ]
    allowed = ROUNDINGS * EPS * _condition(problem) * max(sizes)
    worst = 0.0
    for field in fields:
        differences = np.nan_to_num(np.abs(getattr(compiled, field) - getattr(readable, field)))
        per_sample = differences.max(axis=tuple(range(1, differences.ndim)), initial=0.0)
        worst = max(worst, float((per_sample / allowed).max()))
    return worst


@pytest.mark.fuzz
def test_both_evaluators_agree_on_anything() -> None:
    """Within rounding times condition, with the same gaps and ranks, whatever robot, question and input."""
    seen: Counter[str] = Counter()

    # the same examples in every run, as kinds of them are counted
    @settings(derandomize=True, max_examples=EXAMPLES, suppress_health_check=SLOW)
    @given(problems())
    def check(problem: Problem) -> None:
        readable, compiled = _both(problem)
        assert _worst(problem, readable, compiled) < 1.0
        np.testing.assert_array_equal(compiled.rank, readable.rank)
        np.testing.assert_array_equal(np.isnan(compiled.condition), np.isnan(readable.condition))
        rounding = ROUNDINGS * EPS * np.nan_to_num(readable.condition).max(initial=1.0)
        np.testing.assert_allclose(compiled.condition, readable.condition, rtol=rounding)
        for field in ("expected", "contact_wrenches", "torques", "net_wrenches", "residual"):
            ours, theirs = _gaps(getattr(compiled, field)), _gaps(getattr(readable, field))
            np.testing.assert_array_equal(ours & ~(~theirs & _forgiven(problem, field)), theirs)
            seen[field] += getattr(readable, field).size > 0
            seen["gaps"] += bool(theirs.any())
        seen["switched"] += bool(problem.active)
        seen["degenerate"] += bool((readable.rank < 6).any() and problem.question.unknown)
        seen.update(contact.type for contact in problem.question.contacts)
        seen["residual of an outboard part"] += bool(len(problem.question.parts) > 1 and problem.question.torques)

    check()
    assert len(seen) == 9 + len(ContactType)
    assert min(seen.values()) > EXAMPLES // 20, seen


def test_the_comparison_sees_a_millionth_of_a_radian() -> None:
    """Negative control: a joint moved by 1e-6 is far beyond what the comparison allows."""
    problem = _icub(samples=3)
    position = np.array(problem.joints.position)
    position[:, problem.joints.names.index("l_knee")] += 1e-6
    joints = problem.joints
    moved = JointMotion(
        names=joints.names, position=position, velocity=joints.velocity, acceleration=joints.acceleration
    )
    readable, _ = _both(problem)
    _, compiled = _both(replace(problem, joints=moved))
    assert _worst(problem, readable, compiled) > 1000.0


def _icub(*, samples: int) -> Problem:
    """A humanoid with all that may be asked of it at once."""
    model = read_urdf(icub("iCubGenova03"))
    tree, rng = build_tree(model, "head"), np.random.default_rng(1)
    contacts = [
        Contact(link="l_hand", link_H_contact=random_pose(rng)),
        Contact(link="l_forearm", type=ContactType.FORCE, link_H_contact=random_pose(rng)),
        Contact(link="l_sole"),
        Contact(link="l_lower_leg", type=ContactType.FORCE_ALONG, direction=random_unit(rng)),
        Contact(link="r_lower_leg", type=ContactType.FORCE, link_H_contact=random_pose(rng)),
        Contact(link="r_upper_leg", type=ContactType.FORCE, link_H_contact=random_pose(rng)),
        Contact(link="chest", type=ContactType.KNOWN, link_H_contact=random_pose(rng)),
        Contact(link="root_link"),
    ]
    question = Question(
        tree=tree,
        measured=tuple(tree.cuts),
        contacts=tuple(contacts),
        torques=moving_joints(tree),
        minimum_norm=MinimumNorm(length_scale=0.3),
        expected=tuple(tree.cuts),
        expected_contact="r_sole",
        net_wrenches=tuple(tree.frames),
    )
    return Problem(
        model=model,
        question=question,
        joints=random_motion(model, samples=samples, seed=2),
        root=random_root(samples, 3),
        measured=Wrenches.of({sensor: 30.0 * rng.normal(size=(samples, 6)) for sensor in tree.cuts}),
        known=Wrenches.of({"chest": 30.0 * rng.normal(size=(samples, 6))}),
        active={"l_sole": rng.random(samples) < 0.5, "l_forearm": rng.random(samples) < 0.5},
    )


@pytest.mark.long
def test_both_evaluators_agree_on_a_humanoid_over_many_chunks() -> None:
    """Samples of all chunks and threads, the last one not full, come out in their place."""
    problem = _icub(samples=16384 + 77)
    readable, compiled = _both(problem)
    assert _worst(problem, readable, compiled) < 1.0
    assert compiled.torques.shape == (16384 + 77, len(problem.question.torques))
    counted = []
    one = estimate(
        problem.question, evaluator=Evaluator.COMPILED, threads=1, progress=counted.append, **problem.inputs()
    )
    for field in problem.question.layout.shapes(0):
        np.testing.assert_array_equal(getattr(one, field), getattr(compiled, field))
    assert counted == sorted(counted)
    assert counted[-1] == len(compiled)
