# SPDX-License-Identifier: BSD-3-Clause
"""Force-torque sensor tags of URDF files, in the plain and in the simulator's form."""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element

from forcetorque.arrays import FloatArray
from forcetorque.robot.model import ForceTorqueSensor, SensorFrame
from forcetorque.robot.urdf_attributes import UrdfPlace, origin, required
from forcetorque.spatial import MeasureDirection, make_pose, rotation_from_rpy


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
