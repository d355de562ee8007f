# SPDX-License-Identifier: BSD-3-Clause
"""Inputs and results in mapped files: the same numbers, and nothing is copied."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.motion import JointMotion, RootMotion
from tests.cases import some_cases
from tests.robot.mechanics.touched import touched

SAMPLES = 4096 + 150
"""More than one block of either evaluator."""

FIELDS = ("position", "velocity", "acceleration")

VECTORS = ("proper_acceleration", "angular_velocity", "angular_acceleration")


def _mapped(values: FloatArray, file: Path) -> npt.NDArray[Any]:
    """The same numbers in a file that is mapped for reading."""
    np.save(file, values)
    return np.load(file, mmap_mode="r")  # type: ignore[no-any-return]


@some_cases("evaluator", [Evaluator.COMPILED, Evaluator.READABLE])
def test_mapped_files_give_the_same(evaluator: Evaluator, tmp_path: Path) -> None:
    """All inputs and results in files give what arrays in memory give, to the last bit; the inputs are not copied."""
    contacts = (
        Contact(link="root_link"),
        Contact(link="l_hand"),
        Contact(link="l_forearm", type=ContactType.FORCE),
        Contact(link="r_sole", type=ContactType.FORCE),
        Contact(link="chest", type=ContactType.KNOWN),
    )
    robot = touched(contacts, samples=SAMPLES)
    question = Question(
        tree=robot.tree,
        measured=tuple(robot.tree.cuts),
        contacts=contacts[:2] + contacts[3:],
        torques=moving_joints(robot.tree),
        expected=tuple(robot.tree.cuts),
        net_wrenches=("chest",),
    )
    known = Wrenches.of({"chest": robot.truth["chest"]})
    inputs: dict[str, Any] = {"joints": robot.joints, "root": robot.root, "measured": robot.measured, "known": known}
    in_memory = estimate(question, **inputs, evaluator=evaluator)

    arrays = {f: _mapped(getattr(robot.joints, f), tmp_path / f"{f}.npy") for f in FIELDS}
    joints = JointMotion(names=robot.joints.names, **arrays)
    vectors = {f: _mapped(getattr(robot.root, f), tmp_path / f"{f}.npy") for f in VECTORS}
    readings = _mapped(robot.measured.values, tmp_path / "measured.npy")
    measured = Wrenches(names=robot.measured.names, values=readings)
    root = RootMotion(**vectors)
    assert np.shares_memory(measured.values, readings)
    assert all(np.shares_memory(getattr(joints, f), values) for f, values in arrays.items())
    assert all(np.shares_memory(getattr(root, f), values) for f, values in vectors.items())

    def make(name: str, shape: tuple[int, ...], dtype: npt.DTypeLike) -> npt.NDArray[Any]:
        if 0 in shape:
            return np.empty(shape, dtype=dtype)  # a file of no bytes cannot be mapped
        return np.lib.format.open_memmap(tmp_path / f"out_{name}.npy", mode="w+", dtype=dtype, shape=shape)

    out = Estimates.empty(question.layout, SAMPLES, make=make)
    inputs = {"joints": joints, "root": root, "measured": measured, "known": known}
    assert estimate(question, **inputs, out=out, evaluator=evaluator) is out
    for name, shape in question.layout.shapes(SAMPLES).items():
        getattr(out, name).flush()
        on_disk = np.load(tmp_path / f"out_{name}.npy")
        assert on_disk.shape == shape
        np.testing.assert_array_equal(on_disk, getattr(in_memory, name), err_msg=name)
    assert np.abs(in_memory.torques).max() > 1.0


def test_arrays_that_may_change_are_copied() -> None:
    """Negative control: a writable array, or a read-only view of one, is copied; a read-only array is not."""
    writable = np.zeros((5, 2))
    view = writable[:]
    view.flags.writeable = False
    frozen = np.zeros((5, 2))
    frozen.flags.writeable = False
    for values, shared in ((writable, False), (view, False), (frozen, True), (frozen[1:4], True)):
        joints = JointMotion(names=("a", "b"), position=values, velocity=values, acceleration=values)
        assert all(np.shares_memory(getattr(joints, field), values) == shared for field in FIELDS)
        assert not joints.position.flags.writeable


@pytest.mark.parametrize("evaluator", Evaluator)
def test_no_samples(evaluator: Evaluator) -> None:
    """A motion of no samples has an answer of no samples."""
    robot = touched([], samples=3)
    question = Question(
        tree=robot.tree, measured=("l_arm_ft",), contacts=(Contact(link="l_hand"),), torques=("l_elbow",)
    )
    none = {field: getattr(robot.joints, field)[:0] for field in FIELDS}
    joints = JointMotion(names=robot.joints.names, **none)
    measured = Wrenches(names=robot.measured.names, values=robot.measured.values[:0])
    found = estimate(question, joints, RootMotion.fixed([0.0, 0.0, -1.0]), measured=measured, evaluator=evaluator)
    assert len(found) == 0
    assert found.contact("l_hand").shape == (0, 6)
    assert found.torque("l_elbow").shape == (0,)


@pytest.mark.parametrize("evaluator", Evaluator)
def test_progress_counts_all_samples(evaluator: Evaluator) -> None:
    """Progress only grows, and ends at the number of samples."""
    robot = touched([], samples=SAMPLES)
    told: list[int] = []
    question = Question(tree=robot.tree, expected=("l_foot_ft",))
    estimate(question, robot.joints, robot.root, evaluator=evaluator, progress=told.append)
    assert len(told) > 1
    assert told == sorted(told)
    assert told[-1] == SAMPLES
