# SPDX-License-Identifier: BSD-3-Clause
"""URDF files: from XML to a checked robot model."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FormatError, MissingFileError, RobotError
from forcetorque.robot.model import Joint, JointLimit, JointType, Mimic, RobotModel
from forcetorque.robot.urdf_attributes import UrdfPlace, number, numbers, optional_number, origin, required
from forcetorque.robot.urdf_sensors import read_sensors
from forcetorque.spatial import Inertia, split_pose
from forcetorque.xml_file import read_xml

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
