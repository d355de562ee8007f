# SPDX-License-Identifier: BSD-3-Clause
"""`payload` on a bag alone: the frame's pose by tf or by joints and robot description, assumptions, mistakes."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import make_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from tests.app.outcome import Run
from tests.cases import some_cases

bags = pytest.importorskip("tests.formats.ros.bags")
bag_module = pytest.importorskip("forcetorque.formats.ros.bag")

MASS, CENTRE = 1.3, np.array([0.01, -0.02, 0.06])
BIAS = np.array([4.0, -2.0, 7.0, 0.1, 0.3, -0.2])
NOISE = np.array([0.05, 0.05, 0.05, 0.002, 0.002, 0.002])
HELD, MOVED, POSTURES = 25, 5, 7
STRING, WRENCH, STATE = "std_msgs/msg/String", "geometry_msgs/msg/WrenchStamped", "sensor_msgs/msg/JointState"
HAND_H_FT = make_pose(Rotation.from_euler("xyz", [0.3, -0.5, 2.0]).as_matrix(), [0.02, 0.0, 0.05])
NAMES = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist")
Topics = dict[str, tuple[str, list[Any]]]


def _joints() -> FloatArray:
    """Postures that are held, with motions between; shape (n, 5); rad."""
    postures = np.random.default_rng(4).uniform(-1.2, 1.2, size=(POSTURES, 5))
    between = np.linspace(0.0, 1.0, MOVED + 2)[1:-1, None]
    rows = [np.repeat(postures[:1], HELD, axis=0)]
    for first, second in zip(postures[:-1], postures[1:], strict=True):
        rows += [first + between * (second - first), np.repeat(second[None], HELD, axis=0)]
    return np.concatenate(rows)


@cache
def _topics(form: str, *, sign: float = 1.0, frame: str = "ft", push: float = 0.0) -> Topics:
    """Wrench of a known tool, and the robot by tf and by joints; motions disturb the wrench."""
    types, joints = bags.Types(form), _joints()
    model = read_urdf(ARM_URDF)
    tree, motion = build_tree(model, "base"), JointMotion.at_rest(NAMES, joints)
    poses = {link: link_pose(tree, motion, link) for link in model.links}
    down = np.array([0.0, 0.0, -STANDARD_GRAVITY])
    force = MASS * np.einsum("nji,j->ni", (poses["hand"] @ HAND_H_FT)[:, :3, :3], down)
    wrench = sign * np.hstack([force, np.cross(CENTRE, force)]) + BIAS
    wrench += np.random.default_rng(3).normal(size=wrench.shape) * NOISE
    wrench[np.append(np.abs(np.diff(joints, axis=0)).max(axis=1) > 0.0, False)] += push
    moving = [joint for joint in model.joints.values() if joint.type.moves]
    sent = {(joint.parent, joint.child): np.linalg.inv(poses[joint.parent]) @ poses[joint.child] for joint in moving}
    tf = [
        types.make(bags.TF, transforms=[_transform(types, k, pose[k], *pair) for pair, pose in sent.items()])
        for k in range(len(joints))
    ]
    fixed = [_transform(types, 0, HAND_H_FT, "hand", "ft")]
    fixed += [
        _transform(types, 0, joint.parent_H_child, joint.parent, joint.child)
        for joint in model.joints.values()
        if not joint.type.moves
    ]
    empty = np.empty(0)
    return {
        "/ft": (WRENCH, [types.wrench(k, row, frame) for k, row in enumerate(wrench)]),
        "/tf": (bags.TF, tf),
        "/tf_static": (bags.TF, [types.make(bags.TF, transforms=fixed)]),
        "/joint_states": (STATE, [types.joints(k, list(NAMES), row, empty, empty) for k, row in enumerate(joints)]),
        "/robot_description": (STRING, [types.text(ARM_URDF.read_text(encoding="utf-8"))]),
    }


def _transform(types: Any, k: int, pose: FloatArray, parent: str, child: str) -> Any:
    return types.transform(k, Rotation.from_matrix(np.array(pose[:3, :3])).as_quat(), pose[:3, 3], parent, child)


def _written(folder: Path, form: str, topics: Topics, *left_out: str) -> Path:
    written: Path = bags.write_bag(folder, form, {key: value for key, value in topics.items() if key not in left_out})
    return written


@some_cases(
    ("form", "left_out", "sign"),
    [
        ("mcap", ("/joint_states", "/robot_description"), 1.0),
        ("sqlite3", ("/tf",), -1.0),
    ],
)
def test_a_bag_is_enough(tmp_path: Path, run: Run, form: str, left_out: tuple[str, ...], sign: float) -> None:
    """Mass, centre and bias within their intervals, of both directions of the wrench, and what was assumed."""
    log, file = _written(tmp_path, form, _topics(form, sign=sign, push=30.0), *left_out), tmp_path / "wrist.toml"
    result = run("payload", log, "--save-experiment", file, "--format", "json").result()
    (load,) = result["loads"]
    assert abs(load["mass_kg"] - MASS) < load["mass_half_width_95_kg"] < 0.05
    assert (np.abs(load["centre_of_mass_m"] - CENTRE) < load["centre_of_mass_half_width_95_m"]).all()
    assert (np.abs(result["sessions"][0]["bias"] - BIAS) < result["sessions"][0]["bias_half_width_95"]).all()
    direction = "child_to_parent" if sign > 0.0 else "parent_to_child"
    assumed = result["arms"][0]["assumed"]
    assert assumed[:2] == ["-z of base is down", f"{direction}, which makes the mass positive"]
    assert "s in motion are left out" in assumed[-1]
    shown = run("payload", file).out
    assert f'measure_direction = "{direction}"' in file.read_text(encoding="utf-8")
    assert len(shown.splitlines()) <= 12
    assert shown.splitlines()[:4] == run("payload", log).out.splitlines()[:4]


@pytest.mark.long
def test_a_bag_is_decoded_once(tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every topic, though frame, description and experiment file each need some of it."""
    decoded: list[str] = []
    read = bag_module.Bag.messages

    def counted(bag: Any, topic: str, **options: Any) -> Any:
        decoded.append(topic)
        return read(bag, topic, **options)

    log = _written(tmp_path, "mcap", _topics("mcap"), "/tf")
    monkeypatch.setattr(bag_module.Bag, "messages", counted)
    assert run("payload", log).code == 0
    assert sorted(decoded) == ["/ft", "/joint_states", "/robot_description", "/tf_static"]
    decoded.clear()
    draft_experiment(log, tmp_path / "drafted.toml")
    assert sorted(decoded) == ["/ft", "/joint_states", "/robot_description", "/tf_static"]


def test_what_is_given_is_not_assumed(tmp_path: Path, run: Run) -> None:
    """A base on the ceiling turns gravity, and with it who acts on whom; a direction may be given too."""
    log = _written(tmp_path, "mcap", _topics("mcap"), "/robot_description", "/joint_states")
    keys = ("--recording", "gravity_direction=[0, 0, 1]", "--recording", "gravity=9.82", "--recording", "world=base")
    shown = run("payload", log, *keys, "--format", "json").result()
    assert shown["arms"][0]["assumed"][:2] == [
        "[0, 0, 1] of base is down",
        "parent_to_child, which makes the mass positive",
    ]
    assert shown["loads"][0]["mass_kg"] == pytest.approx(MASS * STANDARD_GRAVITY / 9.82, abs=0.01)
    refused = run("payload", log, "--recording", "measure_direction=parent_to_child").error()
    assert "reversed" in refused or "below 0" in refused
    assert "unknown key 'mass'" in run("payload", log, "--recording", "mass=1").error()
    assert (
        "above 'ft' in the tree of frames, got 'hand', 'forearm'"
        in run("payload", log, "--recording", "world=ft").error()
    )


def test_frames_that_are_wrong_are_named(tmp_path: Path, run: Run) -> None:
    """A frame_id that tf lacks, no robot at all, one that does not move, and a joint without positions."""
    topics = _topics("mcap", frame="ft_sensor")
    unknown = _written(tmp_path / "unknown", "mcap", topics)
    refused = run("payload", unknown).error()
    assert "expected a frame of tf or robot_description, got 'ft_sensor', the frame_id of /ft" in refused
    assert "known: base" in refused
    assert "give the frame along whose axes the wrench is by --recording frame=..." in refused
    assert run("payload", unknown, "--recording", "frame=ft").code == 0
    alone = _written(tmp_path / "alone", "mcap", topics, *(set(topics) - {"/ft"}))
    assert "no pose of that frame: record /tf and /tf_static, or /joint_states and" in run("payload", alone).error()
    topics = _topics("mcap")
    fixed = _written(tmp_path / "fixed", "mcap", topics, "/tf", "/robot_description")
    assert "expected 'ft' to move in 'hand', got fixed frames alone between them" in run("payload", fixed).error()
    no_joints = _written(tmp_path / "joints", "mcap", topics, "/tf", "/joint_states")
    assert "expected positions of joint 'wrist', which moves 'hand', got none" in run("payload", no_joints).error()


def test_a_weight_that_does_not_show_is_asked_for(tmp_path: Path, run: Run) -> None:
    """Without a weight in the forces no direction is taken from its sign; of several topics one must be named."""
    types, topics = bags.Types("mcap"), dict(_topics("mcap"))
    noise = np.random.default_rng(3).normal(size=(len(topics["/tf"][1]), 6))
    topics["/other"] = (WRENCH, [types.wrench(k, row, "ft") for k, row in enumerate(noise)])
    log = _written(tmp_path, "mcap", topics)
    assert (
        "topic, which of /ft, /other is the sensor's; give each by --recording topic=..." in run("payload", log).error()
    )
    refused = run("payload", log, "--recording", "topic=/other").error()
    assert "measure_direction, who acts on whom in the wrench" in refused
    assert run("payload", log, "--recording", "topic=/ft").code == 0


def test_readings_before_the_first_pose_do_not_hide_gravity(tmp_path: Path, run: Run) -> None:
    """A tf that begins after the wrench: the load is that of the rest, and gravity is a number."""
    topics = dict(_topics("mcap"))
    topics["/tf"] = (bags.TF, topics["/tf"][1][10:])
    log = _written(tmp_path, "mcap", topics, "/robot_description", "/joint_states")
    result = run("payload", log, "--format", "json").result()
    assert result["arms"][0]["assumed"][2].startswith("gravity 9.80665 m/s2 and the gain of the sensor, whose ")
    assert result["loads"][0]["mass_kg"] == pytest.approx(MASS, abs=0.01)
