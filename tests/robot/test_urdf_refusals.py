# SPDX-License-Identifier: BSD-3-Clause
"""Bad URDF: every fault is one line that names file and element, whatever the bytes are."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError, RobotError
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.fuzzing import examples
from tests.scenes.robots import PENDULUM_URDF, joint_xml, link_xml, read_text, robot_xml

A_B = (link_xml("a"), link_xml("b"))

BOMB = (
    '<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {new} "{f"&{old};" * 10}">' for old, new in zip("abcdefgh", "bcdefghi", strict=True))
    + ']><robot name="&i;"><link name="x"/></robot>'
)

BAD: dict[str, tuple[str, type[ForceTorqueError], str]] = {
    "empty file": ("", FormatError, "robot.urdf:1: expected XML, got no element found"),
    "spaces": ("\n \n", FormatError, "robot.urdf:3: expected XML, got no element found"),
    "truncated": (
        PENDULUM_URDF.strip().partition('<link name="bob">')[0],
        FormatError,
        "robot.urdf:5: expected XML, got no element found",
    ),
    "not XML": ("mass: 2\nlinks: 3\n", FormatError, "robot.urdf:1: expected XML, got syntax error"),
    "unclosed": ("<robot>\n<link name='a'>\n</robot>", FormatError, "robot.urdf:3: expected XML, got mismatched tag"),
    "unknown encoding": ("<?xml version='1.0' encoding='x'?><robot/>", FormatError, "unknown encoding: x"),
    "not a robot": ("<sdf/>", FormatError, "expected the root element <robot>, got <sdf>; expand xacro files first"),
    "entity bomb": (BOMB, FormatError, "expected plain XML, got EntitiesForbidden(name='a'"),
    "external entity": (
        "<!DOCTYPE robot [<!ENTITY a SYSTEM 'file:///etc/hostname'>]><robot name='r'><link name='x'/>&a;</robot>",
        FormatError,
        "expected plain XML, got EntitiesForbidden(name='a', system_id='file:///etc/hostname'",
    ),
    "parameter entity": (
        "<!DOCTYPE robot [<!ENTITY % a SYSTEM 'file:///etc/hostname'> %a;]><robot name='r'><link name='x'/></robot>",
        FormatError,
        "expected plain XML, got EntitiesForbidden(name='a'",
    ),
    "no links": (robot_xml(), RobotError, "robot 'robot': expected links, got none"),
    "loop": (
        robot_xml(*A_B, joint_xml("j", "a", "b"), joint_xml("k", "b", "a")),
        RobotError,
        "robot 'robot': expected one root link that is no joint's child, found none: the joints form a loop",
    ),
    "loop beside a root": (
        robot_xml(*A_B, link_xml("c"), joint_xml("j", "a", "b"), joint_xml("k", "b", "a")),
        RobotError,
        "robot 'robot': the joints above link 'a' form a loop; expected a tree",
    ),
    "own child": (robot_xml(*A_B, joint_xml("j", "a", "a")), RobotError, "the joints above link 'a' form a loop"),
    "missing parent": (
        robot_xml(*A_B, joint_xml("j", "q", "b")),
        RobotError,
        "joint 'j': its parent link 'q' is not in the robot; known: a, b",
    ),
    "missing child": (
        robot_xml(link_xml("hand"), joint_xml("j", "hand", "hamd")),
        RobotError,
        "joint 'j': its child link 'hamd' is not in the robot; did you mean \"hand\"? known: hand",
    ),
    "two roots": (robot_xml(*A_B), RobotError, "expected one root link that is no joint's child, found 'a', 'b'"),
    "two parents": (
        robot_xml(*A_B, link_xml("c"), joint_xml("j", "a", "c"), joint_xml("k", "b", "c")),
        RobotError,
        "link 'c' is the child of the joints 'j' and 'k'; expected a tree without loops",
    ),
    "link twice": (
        robot_xml(*A_B, link_xml("a")),
        FormatError,
        "<link name='a'>: expected each name once, got it twice",
    ),
    "joint twice": (
        robot_xml(*A_B, joint_xml("j", "a", "b"), joint_xml("j", "b", "a")),
        FormatError,
        "<joint name='j'>: expected each name once, got it twice",
    ),
    "link without name": (robot_xml("<link/>"), FormatError, "<link>: expected the attribute name, got none"),
    "empty name": (robot_xml("<link name=''/>"), FormatError, "<link>: expected the attribute name, got an empty text"),
    "no mass": (
        robot_xml(link_xml("a").replace("<mass value='0.0'/>", "")),
        FormatError,
        "<link name='a'>: expected <mass> and <inertia> inside <inertial>, got only one of them or none",
    ),
    "no inertia": (
        robot_xml("<link name='a'><inertial><mass value='1'/></inertial></link>"),
        FormatError,
        "<link name='a'>: expected <mass> and <inertia> inside <inertial>",
    ),
    "negative mass": (
        robot_xml(link_xml("a", mass=-0.5)),
        FormatError,
        "<link name='a'>: <mass>: expected a mass of at least 0 kg, got -0.5",
    ),
    "mass that is a word": (
        robot_xml(link_xml("a").replace("value='0.0'", "value='heavy'")),
        FormatError,
        "<link name='a'>: <mass>: expected 1 number(s) in value, got 'heavy'",
    ),
    "mass without a value": (
        robot_xml(link_xml("a").replace("<mass value='0.0'/>", "<mass/>")),
        FormatError,
        "<link name='a'>: <mass>: expected the attribute value, got none",
    ),
    "mass that is not a number": (
        robot_xml(link_xml("a", mass=float("nan"))),
        FormatError,
        "<link name='a'>: <mass>: expected 1 finite number(s) in value, got 'nan'",
    ),
    "infinite moment": (
        robot_xml(link_xml("a", moments="0 0 0 inf 0 0")),
        FormatError,
        "<link name='a'>: <inertia>: expected 1 finite number(s) in iyy, got 'inf'",
    ),
    "missing moment": (
        robot_xml(link_xml("a").replace("ixz='0'", "")),
        FormatError,
        "<link name='a'>: <inertia>: expected the attribute ixz, got none",
    ),
    "two coordinates": (
        robot_xml(*A_B, joint_xml("j", "a", "b", xyz="0 1")),
        FormatError,
        "<joint name='j'>: <origin>: expected 3 finite number(s) in xyz, got '0 1'",
    ),
    "angles with a comma": (
        robot_xml(link_xml("a", rpy="0, 0, 1")),
        FormatError,
        "<link name='a'>: <origin>: expected 3 number(s) in rpy, got '0, 0, 1'",
    ),
    "zero axis": (
        robot_xml(*A_B, joint_xml("j", "a", "b", type="revolute", axis="0 0 0")),
        FormatError,
        "<joint name='j'>: <axis>: expected a direction, got the zero vector",
    ),
    "unknown type": (
        robot_xml(*A_B, joint_xml("j", "a", "b", type="floating")),
        FormatError,
        "<joint name='j'>: expected a joint type out of fixed, revolute, continuous, prismatic, got 'floating'",
    ),
    "no type": (
        robot_xml(*A_B, joint_xml("j", "a", "b").replace("type='fixed'", "")),
        FormatError,
        "<joint name='j'>: expected the attribute type, got none",
    ),
    "no child": (
        robot_xml(*A_B, joint_xml("j", "a", "b").replace("<child link='b'/>", "")),
        FormatError,
        "<joint name='j'>: expected <child link=...>, got none",
    ),
    "no parent link": (
        robot_xml(*A_B, joint_xml("j", "a", "b").replace("<parent link='a'/>", "<parent/>")),
        FormatError,
        "<joint name='j'>: <parent>: expected the attribute link, got none",
    ),
    "limit that is a word": (
        robot_xml(*A_B, joint_xml("j", "a", "b", type="revolute", inside="<limit lower='-1' upper='open'/>")),
        FormatError,
        "<joint name='j'>: <limit>: expected 1 number(s) in upper, got 'open'",
    ),
    "endless speed": (
        robot_xml(*A_B, joint_xml("j", "a", "b", type="continuous", inside="<limit velocity='inf'/>")),
        FormatError,
        "<joint name='j'>: <limit>: expected 1 finite number(s) in velocity, got 'inf'",
    ),
    "mimic without joint": (
        robot_xml(*A_B, joint_xml("j", "a", "b", type="revolute", inside="<mimic/>")),
        FormatError,
        "<joint name='j'>: <mimic>: expected the attribute joint, got none",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_urdf_is_refused_in_one_line(case: str, tmp_path: Path) -> None:
    """The message starts with the file, names the element, and says what was expected and what came."""
    text, kind, message = BAD[case]
    with pytest.raises(kind) as caught:
        read_text(text, tmp_path)
    assert str(caught.value).startswith(str(tmp_path / "robot.urdf"))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["absent.urdf", "."])
def test_a_missing_file_is_refused(name: str, tmp_path: Path) -> None:
    """Neither nothing nor a folder is a file."""
    with pytest.raises(MissingFileError, match="expected a URDF file, there is none") as caught:
        read_urdf(tmp_path / name)
    assert str(tmp_path) in str(caught.value)


@pytest.mark.parametrize("leaders", ["aa", "ba", "bb"])
def test_a_circle_of_mimics_is_refused(leaders: str, tmp_path: Path) -> None:
    """Joints that follow each other have no coordinate, so no tree can be built on them."""
    joints = [
        joint_xml(name, parent, child, type="revolute", inside=f"<mimic joint='{leader}' multiplier='2'/>")
        for name, parent, child, leader in zip("ab", "xy", "yz", leaders, strict=True)
    ]
    model = read_text(robot_xml(link_xml("x"), link_xml("y"), link_xml("z"), *joints), tmp_path)
    with pytest.raises(RobotError, match=r"expected it to mimic a free joint, got .*, a circle"):
        build_tree(model, "x")


_BYTES = PENDULUM_URDF.strip().encode()


def _read_bytes(content: bytes, folder: Path) -> RobotModel | str:
    file = folder / "fuzzed.urdf"
    file.write_bytes(content)
    try:
        model = read_urdf(file)
        build_tree(model, next(iter(model.links)))
    except ForceTorqueError as error:
        return str(error)
    return model


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One folder for all examples."""
    return tmp_path_factory.mktemp("fuzz")


def test_the_fuzzed_file_is_a_robot_when_whole(folder: Path) -> None:
    """Control: untouched the text is a model, and cut in two it is an error."""
    assert isinstance(_read_bytes(_BYTES, folder), RobotModel)
    assert isinstance(_read_bytes(_BYTES[: len(_BYTES) // 2], folder), str)


@settings(derandomize=True, deadline=None, max_examples=examples(300))
@given(changes=st.lists(st.tuples(st.integers(0, len(_BYTES) - 1), st.integers(0, 255)), min_size=1, max_size=4))
def test_changed_bytes_give_a_model_or_one_line(folder: Path, changes: list[tuple[int, int]]) -> None:
    """Whatever bytes stand where, the reader gives a model or one of its own errors, in one line."""
    content = bytearray(_BYTES)
    for place, value in changes:
        content[place] = value
    found = _read_bytes(bytes(content), folder)
    assert isinstance(found, RobotModel) or len(found.splitlines()) == 1


@settings(derandomize=True, deadline=None, max_examples=examples(150))
@given(start=st.integers(0, len(_BYTES)), length=st.integers(1, len(_BYTES)))
def test_cuts_give_a_model_or_one_line(folder: Path, start: int, length: int) -> None:
    """A file with a piece cut out, or cut short, gives a model or one of our errors."""
    found = _read_bytes(_BYTES[:start] + _BYTES[start + length :], folder)
    assert isinstance(found, RobotModel) or len(found.splitlines()) == 1
