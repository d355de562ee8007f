# SPDX-License-Identifier: BSD-3-Clause
"""URDF files: from XML to a checked robot model with its force-torque sensors, plain or in the simulator's form."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingFileError, RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import make_pose, rotation_from_rpy, split_pose
from forcetorque.base.wrench import MeasureDirection
from forcetorque.base.xml_file import read_xml
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointLimit, JointType, Mimic, RobotModel, SensorFrame
from forcetorque.robot.urdf_attributes import UrdfPlace, number, numbers, optional_number, origin, required


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
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        values = []
    if len(values) != 6 or not all(math.isfinite(value) for value in values):
        raise place.inside("<pose>").error("six finite numbers, x y z roll pitch yaw", repr(text))
    return make_pose(rotation_from_rpy(values[3:]), values[:3])


def _read_common(place: UrdfPlace, tag: Element, *, name: str, joint: str, pose: FloatArray) -> ForceTorqueSensor:
    # child and child_to_parent are the defaults that the SDF specification states
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
    robot = read_xml(file)
    if robot is None or robot.tag != "robot":
        got = "nothing" if robot is None else f"<{robot.tag}>"
        raise FormatError(f"{file}: expected the root element <robot>, got {got}; expand xacro files first")
    place = UrdfPlace(str(file))
    joints = _by_name(place, "joint", robot.findall("joint"), _read_joint)
    try:
        return RobotModel(
            name=robot.get("name", file.stem),
            links=_by_name(place, "link", robot.findall("link"), _read_link),
            joints=joints,
            sensors=read_sensors(place, robot),
        )
    except RobotError as error:
        raise RobotError(f"{file}: {error}") from error


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
