# SPDX-License-Identifier: BSD-3-Clause
"""A robot model as text: URDF that `read_urdf` reads, and MJCF for the simulator MuJoCo."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.input_file import read_xml
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.pose import invert_pose, rpy_from_rotation, skew, split_pose
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointLimit, JointType, RobotModel, SensorFrame
from forcetorque.robot.urdf import read_urdf


def urdf_text(model: RobotModel) -> str:
    """Write a robot as URDF.

    `read_urdf` reads the same robot from it: the same names, and numbers that differ by rounding. Sensors are written
    in the plain form, which readers of models take, and again in that of the simulator.

    Returns:
        The text of the file.

    Raises:
        RobotError: If a link has a first moment without a mass, which URDF cannot say.
    """
    robot = Element("robot", name=model.name)
    for name, inertia in model.links.items():
        _add_link(robot, name, inertia)
    for joint in model.joints.values():
        _add_joint(robot, joint)
    for sensor in model.sensors.values():
        _add_sensor(robot, sensor)
    indent(robot)
    return f'<?xml version="1.0"?>\n{tostring(robot, encoding="unicode")}\n'


def write_urdf(path: Path | str, model: RobotModel) -> None:
    """Write a robot to a URDF file, which is there as a whole or not at all.

    Args:
        path: File to write or to replace.
        model: The robot.
    """
    write_bytes_atomically(Path(path), urdf_text(model).encode())


def corrected_urdf_text(path: Path | str, model: RobotModel) -> str:
    """Write a URDF file again, with other inertias and places of joints, and all else as it was.

    Args:
        path: URDF file.
        model: What is to be read from the new text, but for sensors: links and joints of the file.

    Returns:
        The text; comments before the root element are lost.

    Raises:
        FormatError: If the file is empty.
    """
    file = Path(path)
    before, robot = read_urdf(file), read_xml(file, comments=True)
    if robot is None:
        raise FormatError(f"{file}: expected the root element <robot>, got nothing")
    for tag in robot.findall("link"):
        name = tag.get("name", "")
        old, new = before.links[name], model.links[name]
        inertial = tag.find("inertial")
        if inertial is not None and old.mass > 0.0 and not _alike(old.matrix(), new.matrix()):
            _correct_inertial(inertial, old, new)
    for tag in robot.findall("joint"):
        name = tag.get("name", "")
        pose = model.joints[name].parent_H_child
        if not _alike(before.joints[name].parent_H_child, pose):
            rotation, position = split_pose(pose)
            values = {"xyz": _numbers(position), "rpy": _numbers(rpy_from_rotation(rotation))}
            _origin(tag).attrib.update(values)
    return f'<?xml version="1.0"?>\n{tostring(robot, encoding="unicode")}\n'


def _alike(old: FloatArray, new: FloatArray) -> bool:
    return bool(np.allclose(old, new, rtol=1e-12, atol=1e-15))


def _correct_inertial(inertial: Element, old: Inertia, new: Inertia) -> None:
    """Scale mass and tensor, and move the centre of mass; the axes of the tensor stay."""
    share = new.mass / old.mass
    for tag, keys in (("mass", ("value",)), ("inertia", ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))):
        for element in inertial.findall(tag):
            element.attrib.update({key: _number(share * float(element.get(key, "0"))) for key in keys})
    _origin(inertial).set("xyz", _numbers(new.first_moment / new.mass))


def _origin(parent: Element) -> Element:
    tag = parent.find("origin")
    if tag is None:
        tag = Element("origin")
        parent.insert(0, tag)
    return tag


def _add_link(robot: Element, name: str, inertia: Inertia) -> None:
    link = SubElement(robot, "link", name=name)
    if inertia.is_zero:
        return
    if inertia.mass == 0.0 and inertia.first_moment.any():
        raise RobotError(
            f"link {name!r}: expected a mass where there is a first moment, got 0 kg with "
            f"{inertia.first_moment.tolist()} kg m; URDF specifies a centre of mass"
        )
    centre = inertia.first_moment / (inertia.mass or 1.0)
    hat = skew(centre)
    tensor = inertia.second_moment + inertia.mass * hat @ hat
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "origin", xyz=_numbers(centre), rpy="0 0 0")
    SubElement(inertial, "mass", value=_number(inertia.mass))
    places = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    SubElement(inertial, "inertia", {key: _number(tensor[place]) for key, place in places.items()})


def _add_joint(robot: Element, joint: Joint) -> None:
    element = SubElement(robot, "joint", name=joint.name, type=joint.type.value)
    SubElement(element, "parent", link=joint.parent)
    SubElement(element, "child", link=joint.child)
    _add_origin(element, joint.parent_H_child)
    if not joint.type.moves:
        return
    SubElement(element, "axis", xyz=_numbers(joint.axis))
    if joint.limit is not None:
        _add_limit(element, joint.limit)
    if joint.mimic is not None:
        ratio, offset = _number(joint.mimic.multiplier), _number(joint.mimic.offset)
        SubElement(element, "mimic", joint=joint.mimic.leader, multiplier=ratio, offset=offset)


def _add_limit(joint: Element, limit: JointLimit) -> None:
    limits = {"lower": limit.lower, "upper": limit.upper, "effort": limit.effort, "velocity": limit.velocity}
    SubElement(joint, "limit", {key: _number(value) for key, value in limits.items() if value is not None})


def _add_sensor(robot: Element, sensor: ForceTorqueSensor) -> None:
    plain = SubElement(robot, "sensor", name=sensor.name, type="force_torque")
    SubElement(plain, "parent", joint=sensor.joint)
    _add_origin(plain, sensor.child_H_sensor)
    _add_measurement(plain, sensor)
    simulated = SubElement(robot, "gazebo", reference=sensor.joint)
    # without it simulators lump fixed joints, and the sensor with them
    SubElement(simulated, "preserveFixedJoint").text = "true"
    rotation, position = split_pose(sensor.child_H_sensor)
    for name in sensor.aliases or (sensor.name,):
        tag = SubElement(simulated, "sensor", name=name, type="force_torque")
        SubElement(tag, "pose").text = f"{_numbers(position)} {_numbers(rpy_from_rotation(rotation))}"
        _add_measurement(tag, sensor)


def _add_measurement(tag: Element, sensor: ForceTorqueSensor) -> None:
    measurement = SubElement(tag, "force_torque")
    SubElement(measurement, "frame").text = sensor.frame.value
    SubElement(measurement, "measure_direction").text = sensor.direction.value


def _add_origin(element: Element, pose: FloatArray) -> None:
    rotation, position = split_pose(pose)
    SubElement(element, "origin", xyz=_numbers(position), rpy=_numbers(rpy_from_rotation(rotation)))


def _numbers(values: Iterable[float]) -> str:
    return " ".join(_number(value) for value in values)


def _number(value: float) -> str:
    return repr(float(value))  # the shortest text that is read as the same number


_JOINTS = {JointType.REVOLUTE: "hinge", JointType.CONTINUOUS: "hinge", JointType.PRISMATIC: "slide"}


def mjcf_tree(model: RobotModel) -> Element:
    """Write a robot as MJCF, free to move: bodies and joints in a `worldbody`, sensors in a `sensor`.

    Numbers are those of the model, so what is written has its mass matrix. A sensor is a site with a `force` and a
    `torque`, called by its name with `_force` and `_torque` behind; their sign is that of the model. Limits, motors,
    shapes and the ground are left to who simulates, for a model says nothing certain of them.

    Args:
        model: The robot; no joint may mimic another.

    Returns:
        The element `mujoco`, to which more may be added.

    Raises:
        RobotError: If a joint mimics another, or a link has a first or second moment without a mass, which MJCF cannot
            say.
    """
    mimics = [joint.name for joint in model.joints.values() if joint.mimic is not None]
    if mimics:
        raise RobotError(
            f"joint {mimics[0]!r}: expected joints that are free, it mimics another; MJCF has no such joint"
        )
    mujoco = Element("mujoco", model=model.name)
    SubElement(mujoco, "compiler", angle="radian", autolimits="false")
    children: dict[str, list[Joint]] = {link: [] for link in model.links}
    for joint in model.joints.values():
        children[joint.parent].append(joint)
    root = _body(SubElement(mujoco, "worldbody"), model, model.root_link, None)
    SubElement(root, "freejoint", name=f"{model.root_link}_free")
    bodies, waiting = {model.root_link: root}, [model.root_link]
    while waiting:
        parent = waiting.pop(0)
        for joint in children[parent]:
            bodies[joint.child] = _body(bodies[parent], model, joint.child, joint)
            waiting.append(joint.child)
    readings = SubElement(mujoco, "sensor")
    for sensor in model.sensors.values():
        _add_mjcf_sensor(readings, bodies[model.joints[sensor.joint].child], model, sensor)
    return mujoco


def mjcf_text(tree: Element) -> str:
    """Write MJCF down.

    Args:
        tree: Element `mujoco`.

    Returns:
        The text of the file.
    """
    indent(tree)
    return f"{tostring(tree, encoding='unicode')}\n"


def _body(parent: Element, model: RobotModel, link: str, joint: Joint | None) -> Element:
    body = SubElement(parent, "body", name=link)
    if joint is not None:
        _place(body, joint.parent_H_child)
        if joint.type.moves:
            SubElement(body, "joint", name=joint.name, type=_JOINTS[joint.type], axis=_mjcf_numbers(joint.axis))
    _add_inertia(body, link, model.links[link])
    return body


def _add_inertia(body: Element, link: str, inertia: Inertia) -> None:
    if inertia.is_zero:
        return
    if inertia.mass <= 0.0:
        raise RobotError(f"link {link!r}: expected a mass beside its moments, got {inertia.mass:g} kg; MJCF needs one")
    centre = inertia.first_moment / inertia.mass
    hat = skew(centre)
    tensor = inertia.second_moment + inertia.mass * hat @ hat
    six = (tensor[0, 0], tensor[1, 1], tensor[2, 2], tensor[0, 1], tensor[0, 2], tensor[1, 2])
    SubElement(body, "inertial", pos=_mjcf_numbers(centre), mass=repr(inertia.mass), fullinertia=_mjcf_numbers(six))


def _add_mjcf_sensor(readings: Element, body: Element, model: RobotModel, sensor: ForceTorqueSensor) -> None:
    site = SubElement(body, "site", name=sensor.name)
    if sensor.frame is SensorFrame.SENSOR:
        _place(site, sensor.child_H_sensor)
    elif sensor.frame is SensorFrame.PARENT:
        _place(site, invert_pose(model.joints[sensor.joint].parent_H_child))
    for kind in ("force", "torque"):
        SubElement(readings, kind, name=f"{sensor.name}_{kind}", site=sensor.name)


def _place(element: Element, pose: FloatArray) -> None:
    rotation, position = split_pose(pose)
    element.set("pos", _mjcf_numbers(position))
    element.set("xyaxes", _mjcf_numbers((*rotation[:, 0], *rotation[:, 1])))


def _mjcf_numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
