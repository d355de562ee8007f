# SPDX-License-Identifier: BSD-3-Clause
"""A bag that describes its robot: the URDF of its `robot_description`, and the mount of its `tf_static`."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FormatError, OutputError
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log
from tests.formats.ros.bags import TF, Types, write_bag
from tests.inspection.draft.test_init import ANSWERS, answered
from tests.scenes.tutorial_log import log_text, robot_text

STRING, JOINTS = "std_msgs/msg/String", "sensor_msgs/msg/JointState"
WRENCH = "geometry_msgs/msg/WrenchStamped"
TURN = Rotation.from_euler("z", 30.0, degrees=True)
SHIFT_M = (0.0, 0.0, 0.02)
EMPTY = np.zeros(0)


def _topics(form: str, *, most: int | None = None, **changes: Any) -> dict[str, tuple[str, list[Any]]]:
    """The log of the tutorial, whose wrench is along the axes of a frame that is turned against the URDF's link."""
    types = Types(form)
    head, *lines = log_text().splitlines()
    lines = lines[:most]
    names = [name.removesuffix("_rad") for name in head.split(",")[1:6]]
    rows = np.array([line.split(",") for line in lines], dtype=np.float64)
    force, moment = rows[:, 6:9], rows[:, 9:12] - np.cross(SHIFT_M, rows[:, 6:9])
    wrench = np.hstack([TURN.inv().apply(force), TURN.inv().apply(moment)])
    static = types.make(
        TF,
        transforms=[
            types.transform(0, TURN.as_quat(), SHIFT_M, "flange", "ft_frame"),
            types.transform(0, np.array([0.0, 0.0, 0.0, 1.0]), (0.0, 0.0, 0.0), "upper_arm", "flange"),
        ],
    )
    topics = {
        "/robot_description": (STRING, [types.text(robot_text())]),
        "/tf_static": (TF, [static]),
        "/joint_states": (JOINTS, [types.joints(4 * k, names, row[1:6], EMPTY, EMPTY) for k, row in enumerate(rows)]),
        "/ft": (WRENCH, [types.wrench(4 * k, row, "ft_frame") for k, row in enumerate(wrench)]),
    }
    return topics | changes


@pytest.fixture(scope="module", params=("bag", "mcap"))
def bag(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bag of either encoding."""
    return write_bag(tmp_path_factory.mktemp(request.param), request.param, _topics(request.param))


def test_the_description_of_a_bag_is_written_beside_the_file(bag: Path, tmp_path: Path) -> None:
    """As it is in the bag, with a word on where it came from; the joints are then known by their names."""
    file = tmp_path / "arm.toml"
    draft = draft_experiment(bag, file)
    assert (tmp_path / "arm.urdf").read_text() == robot_text()
    assert draft.robot_file == str(tmp_path / "arm.urdf")
    assert draft.notes[0].startswith(f"{tmp_path / 'arm.urdf'}: written from /robot_description of {bag}")
    assert tomllib.loads(draft.content)["robot"] == {"urdf": "arm.urdf"}
    assert any("joints of the robot by name: 5 of 5" in note for note in draft.notes)


def test_a_fixed_frame_of_a_bag_is_the_mount(bag: Path, tmp_path: Path) -> None:
    """Through another frame that the URDF lacks, with its source; the force then turns as a weight does."""
    draft = draft_experiment(bag, tmp_path / "arm.toml")
    (sensor,) = tomllib.loads(draft.content)["sensor"]
    assert sensor["joint"] == "arm_ft_joint"
    np.testing.assert_allclose(sensor["mount"]["rotation_deg"], [0.0, 0.0, 30.0], atol=1e-4)
    np.testing.assert_allclose(sensor["mount"]["shift_mm"], [0.0, 0.0, 20.0], atol=1e-4)
    assert f"# 'ft_frame' of its messages in 'upper_arm', by /tf_static of {bag}" in draft.content
    assert {q.key for q in draft.questions} == set(ANSWERS) - {"joint"}
    assert len(tomllib.loads(draft.content)["interval"]) > 1


@pytest.mark.parametrize("force", [False, True])
def test_a_urdf_that_is_there_is_not_replaced(bag: Path, tmp_path: Path, *, force: bool) -> None:
    """It may be that of the user, which the experiment file then names; `--force` replaces that file alone."""
    mine = tmp_path / "arm.urdf"
    corrected = re.sub('<mass value="[^"]*"', '<mass value="7.5"', robot_text(), count=1)
    mine.write_text(corrected)
    (tmp_path / "arm.toml").write_text("" if force else "mine")
    if not force:
        with pytest.raises(OutputError, match="arm.toml: expected a new file"):
            draft_experiment(bag, tmp_path / "arm.toml")
        (tmp_path / "arm.toml").unlink()
    draft = draft_experiment(bag, tmp_path / "arm.toml", force=force)
    assert mine.read_text() == corrected
    assert draft.robot_file is None
    assert tomllib.loads(draft.content)["robot"] == {"urdf": "arm.urdf"}
    assert any(
        note.startswith(f"{mine}: kept, for it differs from /robot_description of {bag}") for note in draft.notes
    )
    assert f"it differs from /robot_description of {bag}" in draft.content
    assert any("which is taken: masses of " in note for note in draft.notes)


def test_the_same_urdf_may_be_there_already(bag: Path, tmp_path: Path) -> None:
    """A second draft beside it needs no other name."""
    (tmp_path / "arm.urdf").write_text(robot_text())
    draft = draft_experiment(bag, tmp_path / "arm.toml")
    assert (tmp_path / "arm.urdf").read_text() == robot_text()
    assert not any("kept" in note for note in draft.notes)


def test_without_a_file_to_write_the_robot_is_asked_for(bag: Path) -> None:
    """Its question says how to have the URDF of the bag."""
    first = draft_experiment(bag).questions[0]
    assert first.key == "urdf"
    assert "-o FILE writes that of /robot_description" in first.question


def test_another_robot_than_that_of_the_bag_is_named(bag: Path, tmp_path: Path) -> None:
    """The user's is taken; the same one is not mentioned."""
    mine = tmp_path / "mine.urdf"
    mine.write_text(robot_text())
    assert not any("differs" in note for note in draft_experiment(bag, urdf=mine).notes)
    mine.write_text(re.sub('<mass value="[^"]*"', '<mass value="7.5"', robot_text(), count=1))
    draft = draft_experiment(bag, tmp_path / "arm.toml", urdf=mine)
    assert draft.notes[0].startswith(f"/robot_description of {bag} differs from {mine}, which is taken: masses of ")
    assert draft.robot_file is None
    assert not (tmp_path / "arm.urdf").exists()


def test_fixed_frames_of_another_robot_are_not_taken(tmp_path: Path) -> None:
    """Of two robots with the same frames that in the namespace of the sensor counts; without one there is no mount."""
    types, turn = Types("mcap"), np.array([0.0, 0.0, 0.0, 1.0])
    topics = _topics("mcap", most=400)
    other = types.make(TF, transforms=[types.transform(0, turn, SHIFT_M, "upper_arm", "ft_frame")])
    both = {"/arm/tf_static": topics.pop("/tf_static"), "/brm/tf_static": (TF, [other])}
    named = topics | both | {"/arm/ft": topics["/ft"]}
    del named["/ft"]
    draft = draft_experiment(write_bag(tmp_path / "named", "mcap", named), tmp_path / "named.toml")
    (sensor,) = tomllib.loads(draft.content)["sensor"]
    np.testing.assert_allclose(sensor["mount"]["rotation_deg"], [0.0, 0.0, 30.0], atol=1e-4)
    unnamed = write_bag(tmp_path / "unnamed", "mcap", topics | both)
    draft = draft_experiment(unnamed, tmp_path / "unnamed.toml")
    assert "mount" not in tomllib.loads(draft.content)["sensor"][0]
    assert "joint" in {question.key for question in draft.questions}
    said = {(row.stream, row.kind): row.message for row in inspect_log(unnamed).findings}
    robot = said["/robot_description", "robot"]
    assert "of ft_frame topics outside the namespace of '/ft' have different poses" in robot


def test_inspect_tells_what_a_bag_has_of_its_robot(bag: Path) -> None:
    """In place of a topic that nothing reads."""
    said = {(row.stream, row.kind): row.message for row in inspect_log(bag).findings}
    assert "the URDF of the robot" in said["/robot_description", "not_read"]
    assert "fixed frames" in said["/tf_static", "not_read"]
    robot = said["/robot_description", "robot"]
    assert "5.3 kg; 5 of 5 moving joints are logged" in robot
    assert f"frame 'ft_frame' of '/ft' is fixed to its link 'upper_arm' by /tf_static of {bag}" in robot


def test_descriptions_that_cannot_be_taken_are_refused_with_the_remedy(tmp_path: Path) -> None:
    """Of two robots, and of one that is no URDF."""
    types = Types("mcap")
    left = types.text("<robot name='left'><link name='base'/></robot>")
    topics = _topics("mcap", most=100) | {"/left/robot_description": (STRING, [left])}
    bag = write_bag(tmp_path, "mcap", topics)
    with pytest.raises(FormatError, match="different ones in /left/robot_description and /robot_description;.*--urdf"):
        draft_experiment(bag)
    assert any("different ones" in row.message for row in inspect_log(bag).findings if row.kind == "robot")
    (tmp_path / "mine.urdf").write_text(robot_text())
    note = draft_experiment(bag, urdf=tmp_path / "mine.urdf").notes[0]
    assert note.startswith(f"{tmp_path / 'mine.urdf'} is not compared with the log: ")
    assert "--urdf" not in note
    other = _topics("sqlite3", most=100, **{"/robot_description": (STRING, [Types("sqlite3").text("<sdf/>")])})
    with pytest.raises(FormatError, match="expected the root element <robot>, got <sdf>.*; name the URDF .* by --urdf"):
        draft_experiment(write_bag(tmp_path, "sqlite3", other))


def test_frames_that_lead_to_no_fixed_joint_are_left_alone(tmp_path: Path) -> None:
    """Negative control: a ring, and a frame of another robot."""
    types = Types("mcap")
    turn = np.array([0.0, 0.0, 0.0, 1.0])
    ring = [types.transform(0, turn, SHIFT_M, *pair) for pair in (("a", "ft_frame"), ("ft_frame", "a"))]
    topics = _topics("mcap", most=400, **{"/tf_static": (TF, [types.make(TF, transforms=ring)])})
    draft = draft_experiment(write_bag(tmp_path, "mcap", topics), tmp_path / "arm.toml")
    assert "joint" in {q.key for q in draft.questions}
    assert "mount" not in tomllib.loads(draft.content)["sensor"][0]
    assert answered(draft.content, ANSWERS) != draft.content
