# SPDX-License-Identifier: BSD-3-Clause
"""Sub-models: the robot in parts, each between its sensors."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import RobotError
from forcetorque.robot.sub_models import SubModel, sub_models
from forcetorque.robot.tree import BodyTree, build_tree, cut_of, outboard_bodies, path_to_root
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import icub, joint_xml, link_xml, read_text, robot_xml, sensor_xml


def _chain(folder: Path, root_link: str) -> BodyTree:
    """Links a -(hinge)- b =ft1= c =ft2= d -(slide)- e, and beside them b =ft3= f."""
    model = read_text(
        robot_xml(
            *(link_xml(name, mass=1.0) for name in "abcdef"),
            joint_xml("hinge", "a", "b", type="revolute"),
            joint_xml("j1", "b", "c"),
            joint_xml("j2", "c", "d"),
            joint_xml("slide", "d", "e", type="prismatic"),
            joint_xml("j3", "b", "f"),
            *(sensor_xml(f"ft{k}", f"j{k}") for k in (1, 2, 3)),
        ),
        folder,
    )
    return build_tree(model, root_link)


def _links(tree: BodyTree, part: SubModel) -> str:
    return "".join(sorted(link for body in part.bodies for link in tree.bodies[body].links))


FROM_A = {"a": ("ab", {"ft1", "ft3"}), "ft1": ("c", {"ft2"}), "ft2": ("de", set()), "ft3": ("f", set())}
FROM_E = {"e": ("de", {"ft2"}), "ft2": ("c", {"ft1"}), "ft1": ("ab", {"ft3"}), "ft3": ("f", set())}
FROM_C = {"c": ("c", {"ft1", "ft2"}), "ft1": ("ab", {"ft3"}), "ft2": ("de", set()), "ft3": ("f", set())}


@pytest.mark.parametrize(("root_link", "wanted"), [("a", FROM_A), ("e", FROM_E), ("c", FROM_C)])
def test_parts_by_hand(root_link: str, wanted: dict[str, tuple[str, set[str]]], tmp_path: Path) -> None:
    """Each part has the links between its sensors; the sensor nearest the root is its base, the others outboard."""
    tree = _chain(tmp_path, root_link)
    parts = sub_models(tree, ("ft3", "ft1", "ft2"))
    assert {part.name: (_links(tree, part), set(part.outboard_sensors)) for part in parts} == wanted
    assert [part.sensor for part in parts if part.sensor is None] == [None]
    assert parts[0].name == root_link
    for part in parts[1:]:
        assert part.sensor == part.name
        assert part.base == tree.cuts[part.name].body == part.bodies[0]


def test_a_sensor_that_is_not_read_does_not_cut(tmp_path: Path) -> None:
    """Without the sensor between them two parts are one; without any the robot is."""
    tree = _chain(tmp_path, "a")
    parts = {part.name: part for part in sub_models(tree, ("ft2",))}
    assert {name: _links(tree, part) for name, part in parts.items()} == {"a": "abcf", "ft2": "de"}
    assert parts["a"].outboard_sensors == ("ft2",)
    (whole,) = sub_models(tree, ())
    assert _links(tree, whole) == "abcdef"
    assert (whole.base, whole.sensor, whole.outboard_sensors) == (0, None, ())


@pytest.mark.parametrize("root_link", ["root_link", "l_sole", "head", "r_hand"])
def test_parts_divide_the_bodies_of_a_humanoid(root_link: str) -> None:
    """Every body is in one part; parts come inboard first; each base's parent is in the part that has it outboard."""
    tree = build_tree(read_urdf(icub("iCubGenova02")), root_link)
    parts = sub_models(tree, tuple(tree.cuts))
    assert len(parts) == 7
    assert sorted(body for part in parts for body in part.bodies) == list(range(len(tree.bodies)))
    owner = {body: k for k, part in enumerate(parts) for body in part.bodies}
    for k, part in enumerate(parts[1:], start=1):
        inboard = owner[tree.bodies[part.base].parent]
        assert inboard < k
        assert part.name in parts[inboard].outboard_sensors
        assert sum(part.name in other.outboard_sensors for other in parts) == 1
        assert all(owner[tree.bodies[body].parent] == k for body in part.bodies[1:])


def test_ways_in_and_out(tmp_path: Path) -> None:
    """Outboard of a body is itself and all whose way to the root passes it."""
    tree = _chain(tmp_path, "a")
    for body in range(len(tree.bodies)):
        marks = outboard_bodies(tree, body)
        assert marks.tolist() == [body in path_to_root(tree, other) for other in range(len(tree.bodies))]
    assert path_to_root(tree, 0) == (0,)
    assert path_to_root(tree, tree.frames["e"][0])[-1] == 0
    assert len(path_to_root(tree, tree.frames["e"][0])) == 5


def test_what_cannot_be_cut_is_refused(tmp_path: Path) -> None:
    """Unknown sensors are named with the known ones; a sensor that is named twice cuts one joint twice."""
    tree = _chain(tmp_path, "a")
    with pytest.raises(RobotError, match="no force-torque sensor 'ft4'.*did you mean \"ft"):
        sub_models(tree, ("ft1", "ft4"))
    with pytest.raises(RobotError, match="known: ft1, ft2, ft3"):
        cut_of(tree, "wrist")
    with pytest.raises(RobotError, match="'ft1' and 'ft1' sit at one joint"):
        sub_models(tree, ("ft1", "ft2", "ft1"))
