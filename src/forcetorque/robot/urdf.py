# SPDX-License-Identifier: BSD-3-Clause
"""URDF files: from XML to a checked robot model with its force-torque sensors; errors name file and element."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TypeVar
from xml.etree.ElementTree import Element
from xml.sax.handler import ContentHandler
from xml.sax.xmlreader import AttributesImpl, Locator

import numpy as np
from defusedxml.sax import parse

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingFileError, RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.input_file import xml_of_text
from forcetorque.base.pose import make_pose, rotation_from_rpy, split_pose
from forcetorque.base.run_files import declare_input
from forcetorque.base.units import parsed_numbers
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointLimit, JointType, Mimic, RobotModel, SensorFrame


@dataclass(frozen=True, slots=True)
class UrdfPlace:
    """Where in a file we are, for messages."""

    text: str
    """File and elements, outermost first."""

    def inside(self, element: str) -> UrdfPlace:
        """Go one element deeper.

        Args:
            element: The element as a reader would recognise it.

        Returns:
            The place inside it.
        """
        return UrdfPlace(f"{self.text}: {element}")

    def error(self, expected: str, got: str) -> FormatError:
        """Build the error to raise here.

        Args:
            expected: What should stand here.
            got: What stands here.

        Returns:
            The error, not raised.
        """
        return FormatError(f"{self.text}: expected {expected}, got {got}")


def required(place: UrdfPlace, element: Element, attribute: str) -> str:
    """Give an attribute that must be there.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.

    Returns:
        Its text, not empty.

    Raises:
        FormatError: If it is missing or empty.
    """
    text = element.get(attribute)
    if not text:
        raise place.error(f"the attribute {attribute}", "none" if text is None else "an empty text")
    return text


def numbers(place: UrdfPlace, element: Element, attribute: str, *, count: int) -> FloatArray:
    """Give an attribute that holds numbers.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.
        count: How many numbers it must hold.

    Returns:
        The numbers; shape (count,).

    Raises:
        FormatError: If it does not hold that many finite numbers.
    """
    text = required(place, element, attribute)
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        raise place.error(f"{count} number(s) in {attribute}", f"{text!r}") from None
    if len(values) != count or not all(math.isfinite(value) for value in values):
        raise place.error(f"{count} finite number(s) in {attribute}", f"{text!r}")
    return np.array(values)


def number(place: UrdfPlace, element: Element, attribute: str, *, default: float | None = None) -> float:
    """Give an attribute that holds one number.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.
        default: Value of the specification where the attribute is absent; None if it must be there.

    Returns:
        The number.

    Raises:
        FormatError: If it is required and missing, or not one finite number.
    """
    if default is not None and element.get(attribute) is None:
        return default
    return float(numbers(place, element, attribute, count=1)[0])


def optional_number(place: UrdfPlace, element: Element, attribute: str) -> float | None:
    """Give an attribute that holds one number, if it is there.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.

    Returns:
        The number; None where the attribute is absent.

    Raises:
        FormatError: If it is there and not one finite number.
    """
    return None if element.get(attribute) is None else number(place, element, attribute)


def origin(place: UrdfPlace, element: Element | None) -> FloatArray:
    """Give the pose that an element's `<origin>` specifies; the identity where there is none.

    Args:
        place: Where the element is.
        element: Element that may hold an `<origin xyz=... rpy=...>`.

    Returns:
        Pose; shape (4, 4); translation in m.

    Raises:
        FormatError: If an attribute is not three finite numbers.
    """
    tag = None if element is None else element.find("origin")
    if tag is None:
        return np.eye(4)
    inner = place.inside("<origin>")
    vectors = {key: numbers(inner, tag, key, count=3) for key in ("xyz", "rpy") if tag.get(key) is not None}
    zero = np.zeros(3)
    return make_pose(rotation_from_rpy(vectors.get("rpy", zero)), vectors.get("xyz", zero))


def read_sensors(place: UrdfPlace, robot: Element) -> dict[str, ForceTorqueSensor]:
    """Read every force-torque sensor once.

    Models carry the same sensor as `<sensor>` and again under `<gazebo reference=joint>`. The plain
    form rules and the other becomes an alias; where only the simulator's form exists it counts.

    Args:
        place: The file.
        robot: The `<robot>` element.

    Returns:
        Sensors by name.

    Raises:
        FormatError: If a tag is incomplete, or the two forms of one sensor contradict each other.
    """
    plain = [_read_plain(place, tag) for tag in robot.findall("sensor") if tag.get("type") == "force_torque"]
    by_joint: dict[str, ForceTorqueSensor] = {}
    for sensor in plain:
        if sensor.joint in by_joint:
            raise place.error(
                "one force-torque sensor per joint",
                f"{by_joint[sensor.joint].name!r} and {sensor.name!r} at {sensor.joint!r}",
            )
        by_joint[sensor.joint] = sensor
    for gazebo in robot.findall("gazebo"):
        for tag in gazebo.findall("sensor"):
            if tag.get("type") == "force_torque":
                sensor = _read_simulated(place, gazebo, tag)
                by_joint[sensor.joint] = _merge(place, by_joint.get(sensor.joint), sensor)
    sensors: dict[str, ForceTorqueSensor] = {}
    taken: set[str] = set()
    for sensor in by_joint.values():
        for name in (sensor.name, *sensor.aliases):
            if name in taken:
                raise place.error("each sensor name once", f"{name!r} twice")
            taken.add(name)
        sensors[sensor.name] = sensor
    return sensors


def _merge(place: UrdfPlace, first: ForceTorqueSensor | None, second: ForceTorqueSensor) -> ForceTorqueSensor:
    if first is None:
        return second
    if first.direction is not second.direction:
        raise place.error(
            f"one measure_direction at joint {first.joint!r}",
            f"{first.direction} for {first.name!r} and {second.direction} for {second.name!r}",
        )
    aliases = dict.fromkeys((*first.aliases, second.name))
    aliases.pop(first.name, None)
    return ForceTorqueSensor(
        name=first.name,
        joint=first.joint,
        frame=first.frame,
        direction=first.direction,
        child_H_sensor=first.child_H_sensor,
        aliases=tuple(aliases),
    )


def _read_plain(place: UrdfPlace, tag: Element) -> ForceTorqueSensor:
    name = required(place.inside("<sensor>"), tag, "name")
    here = place.inside(f"<sensor name={name!r}>")
    parent = tag.find("parent")
    if parent is None:
        raise here.error("<parent joint=...>", "none")
    words = (tag.findtext("pose") or "").split()
    if words and parsed_numbers(words) != [0.0] * 6:
        raise here.error("its pose as <origin xyz=... rpy=...>", f"<pose>{tag.findtext('pose')}</pose>")
    return _read_common(
        here, tag, name=name, joint=required(here.inside("<parent>"), parent, "joint"), pose=origin(here, tag)
    )


def _read_simulated(place: UrdfPlace, gazebo: Element, tag: Element) -> ForceTorqueSensor:
    joint = required(place.inside("<gazebo> with a force-torque sensor"), gazebo, "reference")
    name = required(place.inside(f"<gazebo reference={joint!r}>: <sensor>"), tag, "name")
    here = place.inside(f"<gazebo reference={joint!r}>: <sensor name={name!r}>")
    return _read_common(here, tag, name=name, joint=joint, pose=_simulated_pose(here, tag))


def _simulated_pose(place: UrdfPlace, tag: Element) -> FloatArray:
    pose = tag.find("pose")
    if pose is not None and pose.attrib:
        # degrees, relative_to and rotation_format change what the numbers mean
        raise place.inside("<pose>").error("no attributes: x y z in m, roll pitch yaw in rad", str(dict(pose.attrib)))
    text = (tag.findtext("pose") or "0 0 0 0 0 0").strip()
    values = parsed_numbers(text.split())
    if len(values) != 6 or not all(math.isfinite(value) for value in values):
        raise place.inside("<pose>").error("six finite numbers, x y z roll pitch yaw", repr(text))
    return make_pose(rotation_from_rpy(values[3:]), values[:3])


def _read_common(place: UrdfPlace, tag: Element, *, name: str, joint: str, pose: FloatArray) -> ForceTorqueSensor:
    # child and child_to_parent are the defaults that the SDF specification defines
    frame = (tag.findtext("force_torque/frame") or SensorFrame.CHILD).strip()
    direction = (tag.findtext("force_torque/measure_direction") or MeasureDirection.CHILD_TO_PARENT).strip()
    if frame not in list(SensorFrame):
        raise place.inside("<frame>").error(f"one of {', '.join(SensorFrame)}", repr(frame))
    if direction not in list(MeasureDirection):
        raise place.inside("<measure_direction>").error(f"one of {', '.join(MeasureDirection)}", repr(direction))
    return ForceTorqueSensor(
        name=name,
        joint=joint,
        frame=SensorFrame(frame),
        direction=MeasureDirection(direction),
        child_H_sensor=pose,
    )


_Named = TypeVar("_Named")

_KEPT = 4
"""Robots that are kept after they were read."""


def read_urdf(path: Path | str) -> RobotModel:
    """Read a robot from a URDF file: its links, joints and force-torque sensors.

    Geometry, damping and friction are not read: they do not enter expected wrenches. Limits are read as they
    stand, for those who plan motions.

    Args:
        path: URDF file.

    Returns:
        The robot, checked to be one tree.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If the file is not URDF, or an element lacks or misstates what it must say.
        RobotError: If the links and joints are not one tree.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a URDF file, there is none")
    declare_input(file)
    return _read_once(file.read_bytes(), str(file), file.stem)


class _Lines(ContentHandler):
    """Lines of the tags in one link or joint of a robot, by their path in it."""

    def __init__(self, outer: str, name: str) -> None:
        super().__init__()
        self.lines: dict[tuple[str, ...], int] = {}
        self._outer, self._name = outer, name
        self._path: list[str] = []
        self._is_inside = False
        self._locator: Locator | None = None

    def setDocumentLocator(self, locator: Locator) -> None:
        self._locator = locator

    def startElement(self, name: str, attrs: AttributesImpl) -> None:
        self._path.append(name)
        if len(self._path) == 2:
            self._is_inside = name == self._outer and attrs.get("name") == self._name
        if self._is_inside and self._locator is not None:
            self.lines.setdefault(tuple(self._path[2:]), self._locator.getLineNumber() or 0)

    def endElement(self, name: str) -> None:
        self._path.pop()
        self._is_inside = self._is_inside and len(self._path) > 1


def tag_lines(path: Path, outer: str, name: str) -> dict[tuple[str, ...], int]:
    """Give the lines of the tags of a link or a joint.

    Args:
        path: A URDF file that was read.
        outer: `link` or `joint`.
        name: Its name.

    Returns:
        The line of the first tag of every path in it; of itself by the empty path; nothing if it is not there.
    """
    handler = _Lines(outer, name)
    # a DTD that is named is not opened: the parser of SAX resolves nothing, and refuses that only by default
    parse(str(path), handler, forbid_external=False)
    return handler.lines


@lru_cache(maxsize=_KEPT)
def _read_once(content: bytes, where: str, name: str) -> RobotModel:
    """Recordings of one robot share its model, and with it the trees that are built of it."""
    return _robot(xml_of_text(content, where=where), where, name)


def read_urdf_text(text: str, *, where: str) -> RobotModel:
    """Read a robot from URDF that is no file, such as a message.

    Args:
        text: The URDF.
        where: What has it, for messages.

    Returns:
        The robot, as of `read_urdf`.
    """
    return _robot(xml_of_text(text, where=where), where, "robot")


def _robot(robot: Element | None, where: str, name: str) -> RobotModel:
    if robot is None or robot.tag != "robot":
        got = "nothing" if robot is None else f"<{robot.tag}>"
        raise FormatError(f"{where}: expected the root element <robot>, got {got}; expand xacro files first")
    place = UrdfPlace(where)
    joints = _by_name(place, "joint", robot.findall("joint"), _read_joint)
    try:
        return RobotModel(
            name=robot.get("name", name),
            links=_by_name(place, "link", robot.findall("link"), _read_link),
            joints=joints,
            sensors=read_sensors(place, robot),
        )
    except RobotError as error:
        raise RobotError(f"{where}: {error}") from error


def _by_name(
    place: UrdfPlace, tag: str, elements: Iterable[Element], read: Callable[[UrdfPlace, Element], _Named]
) -> dict[str, _Named]:
    by_name: dict[str, _Named] = {}
    for element in elements:
        name = required(place.inside(f"<{tag}>"), element, "name")
        if name in by_name:
            raise place.inside(f"<{tag} name={name!r}>").error("each name once", "it twice")
        by_name[name] = read(place.inside(f"<{tag} name={name!r}>"), element)
    return by_name


def _read_link(place: UrdfPlace, link: Element) -> Inertia:
    inertial = link.find("inertial")
    if inertial is None:
        return Inertia.zero()
    mass_element, inertia_element = inertial.find("mass"), inertial.find("inertia")
    if mass_element is None or inertia_element is None:
        raise place.error("<mass> and <inertia> inside <inertial>", "only one of them or none")
    mass = number(place.inside("<mass>"), mass_element, "value")
    if mass < 0.0:
        raise place.inside("<mass>").error("a mass of at least 0 kg", f"{mass:g}")
    moment = {
        key: number(place.inside("<inertia>"), inertia_element, key)
        for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    }
    tensor = np.array(
        [
            [moment["ixx"], moment["ixy"], moment["ixz"]],
            [moment["ixy"], moment["iyy"], moment["iyz"]],
            [moment["ixz"], moment["iyz"], moment["izz"]],
        ]
    )
    rotation, centre = split_pose(origin(place, inertial))
    return Inertia.about_centre_of_mass(mass=mass, centre_of_mass=centre, second_moment=rotation @ tensor @ rotation.T)


def _read_joint(place: UrdfPlace, joint: Element) -> Joint:
    text = required(place, joint, "type")
    try:
        kind = JointType(text)
    except ValueError:
        known = ", ".join(JointType)
        raise place.error(f"a joint type out of {known}", f"{text!r}") from None
    links = []
    for tag in ("parent", "child"):
        element = joint.find(tag)
        if element is None:
            raise place.error(f"<{tag} link=...>", "none")
        links.append(required(place.inside(f"<{tag}>"), element, "link"))
    mimic, limit = joint.find("mimic"), joint.find("limit")
    return Joint(
        name=required(place, joint, "name"),
        type=kind,
        parent=links[0],
        child=links[1],
        parent_H_child=origin(place, joint),
        axis=_read_axis(place, joint) if kind.moves else np.array([1.0, 0.0, 0.0]),
        mimic=None if mimic is None or not kind.moves else _read_mimic(place.inside("<mimic>"), mimic),
        limit=None if limit is None or not kind.moves else _read_limit(place.inside("<limit>"), limit, kind),
    )


def _read_axis(place: UrdfPlace, joint: Element) -> FloatArray:
    element = joint.find("axis")
    if element is None:
        return np.array([1.0, 0.0, 0.0])  # the default of the URDF specification
    axis = numbers(place.inside("<axis>"), element, "xyz", count=3)
    length = math.hypot(*axis)  # does not overflow
    if length == 0.0:
        raise place.inside("<axis>").error("a direction", "the zero vector")
    return axis / length


def _read_mimic(place: UrdfPlace, mimic: Element) -> Mimic:
    return Mimic(
        leader=required(place, mimic, "joint"),
        multiplier=number(place, mimic, "multiplier", default=1.0),
        offset=number(place, mimic, "offset", default=0.0),
    )


def _read_limit(place: UrdfPlace, limit: Element, kind: JointType) -> JointLimit:
    # the specification reads an absent bound as 0; real files leave both out where they mean no bound
    lower, upper, velocity, effort = (
        optional_number(place, limit, name) for name in ("lower", "upper", "velocity", "effort")
    )
    if kind is JointType.CONTINUOUS:
        return JointLimit(velocity=velocity, effort=effort)
    return JointLimit(lower=lower, upper=upper, velocity=velocity, effort=effort)
