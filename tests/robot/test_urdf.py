# SPDX-License-Identifier: BSD-3-Clause
"""Reading links and joints of URDF, by small robots written by hand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.robot.model import JointType, Mimic
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import PENDULUM_URDF, icub, joint_xml, link_xml, read_text, robot_xml

ROUNDING = 1e-15
"""A few roundings of numbers up to 1."""


def _two_links(joint: str) -> str:
    return robot_xml(link_xml("a"), link_xml("b"), joint)


def test_the_pendulum_is_read(tmp_path: Path) -> None:
    """Names, tree and masses of the hand-written pendulum are those of its text."""
    model = read_text(PENDULUM_URDF, tmp_path)
    assert model.name == "pendulum"
    assert list(model.links) == ["base", "arm", "bob"]
    assert [(j.name, j.parent, j.child) for j in model.joints.values()] == [
        ("swing", "base", "arm"),
        ("mount", "arm", "bob"),
    ]
    assert model.links["base"].is_zero
    assert model.links["bob"].mass == 2.0
    np.testing.assert_allclose(model.links["bob"].first_moment, [0.0, 0.0, -0.6], rtol=0, atol=ROUNDING)


def test_the_path_may_be_text(tmp_path: Path) -> None:
    """A path given as text reads the same file."""
    read_text(PENDULUM_URDF, tmp_path)
    assert read_urdf(str(tmp_path / "robot.urdf")).name == "pendulum"


def test_a_robot_without_a_name_is_called_after_its_file(tmp_path: Path) -> None:
    """The file's stem stands in for a name that is not there."""
    assert read_text("<robot><link name='a'/></robot>", tmp_path).name == "robot"


@pytest.mark.parametrize(
    ("kind", "unit"), [("revolute", "rad"), ("continuous", "rad"), ("prismatic", "m"), ("fixed", "rad")]
)
def test_joint_types(kind: str, unit: str, tmp_path: Path) -> None:
    """Every type that the dynamics know is read, and only the fixed one does not move."""
    joint = read_text(_two_links(joint_xml("j", "a", "b", type=kind)), tmp_path).joints["j"]
    assert joint.type is JointType(kind)
    assert joint.type.moves == (kind != "fixed")
    assert joint.type.unit == unit


def test_the_axis_is_normalised(tmp_path: Path) -> None:
    """An axis of any length becomes a unit vector."""
    joint = read_text(_two_links(joint_xml("j", "a", "b", type="revolute", axis="0 3 -4")), tmp_path).joints["j"]
    np.testing.assert_allclose(joint.axis, [0.0, 0.6, -0.8], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("length", ["1e200", "1e-200"])
def test_an_axis_of_extreme_length_is_normalised(length: str, tmp_path: Path) -> None:
    """The squares of the components may overflow or vanish, the direction does not."""
    text = _two_links(joint_xml("j", "a", "b", type="revolute", axis=f"0 -{length} 0"))
    np.testing.assert_array_equal(read_text(text, tmp_path).joints["j"].axis, [0.0, -1.0, 0.0])


def test_the_default_axis_is_x(tmp_path: Path) -> None:
    """A moving joint without an axis turns about x, as the specification says."""
    text = _two_links(joint_xml("j", "a", "b", type="revolute")).replace("<axis xyz='0 0 1'/>", "")
    assert "axis" not in text
    np.testing.assert_array_equal(read_text(text, tmp_path).joints["j"].axis, [1.0, 0.0, 0.0])


def test_the_origin_of_a_joint(tmp_path: Path) -> None:
    """The origin holds the position, xyz, and rpy, the fixed-axis rotation of the child in the parent."""
    joint = read_text(
        _two_links(joint_xml("j", "a", "b", xyz="0.1 0.2 0.3", rpy="0 0 1.5707963267948966")), tmp_path
    ).joints["j"]
    expected = [[0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]]
    np.testing.assert_allclose(joint.parent_H_child, expected, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("origin", ["", "<origin/>", "<origin xyz='0 0 0'/>", "<origin rpy='0 0 0'/>"])
def test_a_missing_origin_is_the_identity(origin: str, tmp_path: Path) -> None:
    """The origin and each of its attributes default to zero."""
    text = _two_links(joint_xml("j", "a", "b")).replace("<origin xyz='0 0 0' rpy='0 0 0'/><axis", f"{origin}<axis")
    assert text.count("<origin xyz='0 0 0' rpy='0 0 0'/>") == 2  # those of the links
    np.testing.assert_array_equal(read_text(text, tmp_path).joints["j"].parent_H_child, np.eye(4))


def test_mimic(tmp_path: Path) -> None:
    """Leader, multiplier and offset are read; they default to 1 and 0; a fixed joint has none."""
    full, short = "<mimic joint='lead' multiplier='-0.5' offset='0.2'/>", "<mimic joint='lead'/>"
    model = read_text(
        robot_xml(
            *(link_xml(name) for name in "abcde"),
            joint_xml("lead", "a", "b", type="revolute"),
            joint_xml("full", "b", "c", type="revolute", inside=full),
            joint_xml("short", "c", "d", type="prismatic", inside=short),
            joint_xml("still", "d", "e", inside=full),
        ),
        tmp_path,
    )
    assert model.joints["lead"].mimic is None
    assert model.joints["full"].mimic == Mimic(leader="lead", multiplier=-0.5, offset=0.2)
    assert model.joints["short"].mimic == Mimic(leader="lead", multiplier=1.0, offset=0.0)
    assert model.joints["still"].mimic is None


def test_a_mimic_of_a_missing_joint_is_read(tmp_path: Path) -> None:
    """Real models carry such fingers, so only asking for their coordinate is an error."""
    text = _two_links(joint_xml("j", "a", "b", type="revolute", inside="<mimic joint='gone'/>"))
    mimic = read_text(text, tmp_path).joints["j"].mimic
    assert mimic == Mimic(leader="gone")


def test_the_inertial_origin_moves_and_turns_the_inertia(tmp_path: Path) -> None:
    """Quarters about x, then z, take x to y to z to x; the offset adds m (|p|^2 1 - p p^T)."""
    link = link_xml("a", mass=2.0, xyz="0 0.5 0", rpy="1.5707963267948966 0 1.5707963267948966", moments="1 0 0 3 0 4")
    inertia = read_text(robot_xml(link), tmp_path).links["a"]
    np.testing.assert_allclose(inertia.first_moment, [0.0, 1.0, 0.0], rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(inertia.second_moment, np.diag([4.5, 1.0, 3.5]), rtol=0, atol=4 * ROUNDING)


def test_products_of_inertia_keep_their_places_and_signs(tmp_path: Path) -> None:
    """Each of the six numbers stands where its name says, on both sides of the diagonal."""
    inertia = read_text(robot_xml(link_xml("a", mass=1.0, moments="10 1 -2 20 3 30")), tmp_path).links["a"]
    np.testing.assert_array_equal(inertia.second_moment, [[10, 1, -2], [1, 20, 3], [-2, 3, 30]])


def test_a_massless_link_keeps_its_inertia(tmp_path: Path) -> None:
    """Mass 0 with a second moment is not the same as no inertial element."""
    links = read_text(
        robot_xml(link_xml("a", moments="0.1 0 0 0.2 0 0.3"), "<link name='b'/>", joint_xml("j", "a", "b")), tmp_path
    ).links
    assert links["a"].mass == 0.0
    np.testing.assert_array_equal(links["a"].second_moment, np.diag([0.1, 0.2, 0.3]))
    assert not links["a"].is_zero
    assert links["b"].is_zero


def test_what_does_not_matter_is_passed_over(tmp_path: Path) -> None:
    """Geometry, damping, friction, transmissions and comments change nothing."""
    noise = (
        "<!-- a comment --><transmission><joint name='j'/></transmission>"
        "<gazebo reference='a'><material>x</material></gazebo>"
    )
    joint = joint_xml("j", "a", "b", type="revolute", inside="<dynamics damping='nan' friction='x'/>")
    model = read_text(robot_xml(link_xml("a"), link_xml("b"), joint, noise), tmp_path)
    assert list(model.links) == ["a", "b"]
    assert list(model.joints) == ["j"]
    assert not model.sensors


def test_the_order_of_elements_does_not_matter(tmp_path: Path) -> None:
    """Joints before links read as the same robot."""
    forwards = [link_xml("a"), link_xml("b", mass=1.0), joint_xml("j", "a", "b")]
    there, back = (read_text(robot_xml(*parts), tmp_path) for parts in (forwards, forwards[::-1]))
    assert set(there.links) == set(back.links)
    assert back.joints["j"].parent == "a"
    assert back.links["b"].mass == 1.0


def test_utf16_is_read(tmp_path: Path) -> None:
    """XML says its own encoding, and names need not be ASCII."""
    file = tmp_path / "robot.urdf"
    file.write_text("<robot name='Ärmchen'><link name='a'/></robot>", encoding="utf-16")
    assert read_urdf(file).name == "Ärmchen"


def test_a_model_cannot_be_changed(tmp_path: Path) -> None:
    """Links, joints and sensors are read-only, and so are their arrays."""
    model = read_text(PENDULUM_URDF, tmp_path)
    with pytest.raises(TypeError, match="does not support item assignment"):
        model.links["new"] = model.links["bob"]  # type: ignore[index]
    with pytest.raises(ValueError, match="read-only"):
        model.joints["mount"].parent_H_child[0, 3] = 1.0


def test_real_robots_have_the_masses_of_their_text() -> None:
    """Masses of an iCub, added up from its text, are those of the model; the sensors are the six known ones."""
    urdf = icub("iCubGenova02")
    model = read_urdf(urdf)
    from_text = [float(part.split("=")[1].split('"')[1]) for part in urdf.read_text().split("<mass ")[1:]]
    assert len(from_text) > 30
    assert sum(inertia.mass for inertia in model.links.values()) == pytest.approx(sum(from_text), rel=1e-12)
    assert {f"{side}_{limb}_ft" for side in "lr" for limb in ("arm", "leg", "foot")} == set(model.sensors)
