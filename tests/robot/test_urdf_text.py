# SPDX-License-Identifier: BSD-3-Clause
"""Robots written as URDF are read as they were."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import MissingFileError, RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import make_pose, rotation_from_rpy, rpy_from_rotation
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointLimit, JointType, Mimic, RobotModel, SensorFrame
from forcetorque.robot.urdf import read_urdf
from forcetorque.robot.urdf_and_mjcf_text import urdf_text, write_urdf
from forcetorque.simulation.robots import named_robot
from tests.scenes.robots import example_robot, icub

ROUNDING = 1e-14
"""Relative to the largest number that enters: some ten roundings at eps = 2e-16, with a margin of five."""

ROBOTS: dict[str, Callable[[], Path]] = {
    "arm": lambda: named_robot(("arm",)),
    "biped": lambda: named_robot(("biped",)),
    "icub": lambda: icub("iCubGenova02"),
    "massless links": lambda: icub("iCubGenova03"),
    "limits and a prismatic torso": lambda: example_robot("tiago_description/robots/tiago.urdf"),
    "panda": lambda: example_robot("panda_description/urdf/panda.urdf"),
}


def _assert_same_inertia(there: Inertia, back: Inertia) -> None:
    assert back.mass == there.mass
    np.testing.assert_allclose(back.first_moment, there.first_moment, rtol=ROUNDING, atol=ROUNDING * there.mass)
    size = np.abs(there.second_moment).max() + (there.first_moment**2).sum() / (there.mass or 1.0)
    np.testing.assert_allclose(back.second_moment, there.second_moment, rtol=0, atol=ROUNDING * size)


def _assert_same_joint(there: Joint, back: Joint) -> None:
    for field in ("name", "type", "parent", "child", "mimic", "limit"):
        assert getattr(back, field) == getattr(there, field)
    np.testing.assert_array_equal(back.parent_H_child[:3, 3], there.parent_H_child[:3, 3])
    np.testing.assert_allclose(back.parent_H_child, there.parent_H_child, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(back.axis, there.axis, rtol=0, atol=ROUNDING)


def _assert_same_sensor(there: ForceTorqueSensor, back: ForceTorqueSensor) -> None:
    for field in ("name", "joint", "frame", "direction", "aliases"):
        assert getattr(back, field) == getattr(there, field)
    np.testing.assert_allclose(back.child_H_sensor, there.child_H_sensor, rtol=0, atol=ROUNDING)


def _assert_same_robot(there: RobotModel, back: RobotModel) -> None:
    assert back.name == there.name
    for field, same in (
        ("links", _assert_same_inertia),
        ("joints", _assert_same_joint),
        ("sensors", _assert_same_sensor),
    ):
        ours, theirs = getattr(there, field), getattr(back, field)
        assert list(ours) == list(theirs)
        for name in ours:
            same(ours[name], theirs[name])  # type: ignore[operator]


def _written_and_read(model: RobotModel, folder: Path) -> RobotModel:
    write_urdf(folder / "written.urdf", model)
    return read_urdf(folder / "written.urdf")


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_comes_back(robot: str, tmp_path: Path) -> None:
    """Links, joints with limits and mimics, and sensors of real models are the same after writing and reading."""
    model = read_urdf(ROBOTS[robot]())
    _assert_same_robot(model, _written_and_read(model, tmp_path))


def test_a_second_time_changes_nothing(tmp_path: Path) -> None:
    """What was written once is a text that does not wander when it is read and written again."""
    model = _written_and_read(read_urdf(named_robot(("biped",))), tmp_path)
    once = _written_and_read(model, tmp_path)
    _assert_same_robot(model, once)


NUMBERS = st.floats(-10.0, 10.0, allow_nan=False)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
ANGLES = st.one_of(NUMBERS, st.sampled_from([0.0, np.pi / 2, -np.pi / 2, np.pi, np.pi / 2 - 1e-9]))
POSES = st.builds(
    lambda rpy, place: make_pose(rotation_from_rpy(rpy), place), st.tuples(ANGLES, ANGLES, ANGLES), VECTORS
)
NAMES = st.text(st.characters(codec="utf-8", exclude_categories=("C",)), min_size=1, max_size=8).map("a".__add__)
BOUNDS = st.none() | NUMBERS


@st.composite
def _inertias(draw: st.DrawFn) -> Inertia:
    root = np.array(draw(st.lists(VECTORS, min_size=3, max_size=3)))
    mass = draw(st.just(0.0) | st.floats(1e-3, 1e3))
    centre = draw(VECTORS)
    return Inertia.about_centre_of_mass(mass=mass, centre_of_mass=centre, second_moment=root @ root.T)


@st.composite
def _chains(draw: st.DrawFn) -> RobotModel:
    """Links in a row, joints of every type between them, and a sensor in the first."""
    names = draw(st.lists(NAMES, min_size=3, max_size=3, unique=True))
    joints = {}
    for k in range(2):
        kind = draw(st.sampled_from(JointType)) if k else JointType.FIXED
        moves = kind.moves
        bounds = (None, None) if kind is JointType.CONTINUOUS else (draw(BOUNDS), draw(BOUNDS))
        limit = JointLimit(lower=bounds[0], upper=bounds[1], velocity=draw(BOUNDS), effort=draw(BOUNDS))
        joints[f"joint {k}"] = Joint(
            name=f"joint {k}",
            type=kind,
            parent=names[k],
            child=names[k + 1],
            parent_H_child=draw(POSES),
            axis=rotation_from_rpy(draw(VECTORS))[2] if moves else np.array([1.0, 0.0, 0.0]),
            mimic=draw(st.none() | st.builds(Mimic, leader=NAMES, multiplier=NUMBERS, offset=NUMBERS))
            if moves
            else None,
            limit=draw(st.none() | st.just(limit)) if moves else None,
        )
    sensor = ForceTorqueSensor(
        name=draw(NAMES),
        joint="joint 0",
        frame=draw(st.sampled_from(SensorFrame)),
        direction=draw(st.sampled_from(MeasureDirection)),
        child_H_sensor=draw(POSES),
        aliases=tuple(f"alias {k}" for k in range(draw(st.integers(0, 1)))),
    )
    links = {name: draw(_inertias()) for name in names}
    return RobotModel(name=draw(NAMES), links=links, joints=joints, sensors={sensor.name: sensor})


@given(model=_chains())
def test_any_chain_comes_back(model: RobotModel, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Poses near the singularity of roll, pitch and yaw, absent limits and names with any sign are kept."""
    _assert_same_robot(model, _written_and_read(model, tmp_path_factory.mktemp("chain")))


@given(rpy=st.tuples(ANGLES, ANGLES, ANGLES))
def test_roll_pitch_and_yaw_build_the_rotation_again(rpy: tuple[float, float, float]) -> None:
    """The angles may differ, the rotation does not."""
    rotation = rotation_from_rpy(rpy)
    np.testing.assert_allclose(rotation_from_rpy(rpy_from_rotation(rotation)), rotation, rtol=0, atol=ROUNDING)


def test_a_changed_robot_is_noticed(tmp_path: Path) -> None:
    """Negative control: another mass is another robot."""
    model = read_urdf(named_robot(("arm",)))
    link = next(name for name, inertia in model.links.items() if inertia.mass)
    other = replace(model.links[link], mass=1.001 * model.links[link].mass)
    with pytest.raises(AssertionError):
        _assert_same_robot(model, _written_and_read(replace(model, links={**model.links, link: other}), tmp_path))


def test_a_moment_without_a_mass_is_refused() -> None:
    """URDF states a centre of mass, of which there is none without a mass."""
    ghost = Inertia(mass=0.0, first_moment=np.ones(3), second_moment=np.eye(3))
    with pytest.raises(RobotError, match="link 'ghost': expected a mass where there is a first moment, got 0 kg"):
        urdf_text(RobotModel(name="robot", links={"ghost": ghost}, joints={}, sensors={}))


def test_no_folder_no_file(tmp_path: Path) -> None:
    """A folder that is not there is an error that names it."""
    with pytest.raises(MissingFileError, match="expected an existing folder"):
        write_urdf(tmp_path / "gone" / "robot.urdf", read_urdf(named_robot(("arm",))))
