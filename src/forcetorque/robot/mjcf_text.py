# SPDX-License-Identifier: BSD-3-Clause
"""MJCF text of a robot model: the same links, joints and sensors as its URDF, for the simulator MuJoCo."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import invert_pose, skew, split_pose
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointType, RobotModel, SensorFrame

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
        _add_sensor(readings, bodies[model.joints[sensor.joint].child], model, sensor)
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
            SubElement(body, "joint", name=joint.name, type=_JOINTS[joint.type], axis=_numbers(joint.axis))
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
    SubElement(body, "inertial", pos=_numbers(centre), mass=repr(inertia.mass), fullinertia=_numbers(six))


def _add_sensor(readings: Element, body: Element, model: RobotModel, sensor: ForceTorqueSensor) -> None:
    site = SubElement(body, "site", name=sensor.name)
    if sensor.frame is SensorFrame.SENSOR:
        _place(site, sensor.child_H_sensor)
    elif sensor.frame is SensorFrame.PARENT:
        _place(site, invert_pose(model.joints[sensor.joint].parent_H_child))
    for kind in ("force", "torque"):
        SubElement(readings, kind, name=f"{sensor.name}_{kind}", site=sensor.name)


def _place(element: Element, pose: FloatArray) -> None:
    rotation, position = split_pose(pose)
    element.set("pos", _numbers(position))
    element.set("xyaxes", _numbers((*rotation[:, 0], *rotation[:, 1])))


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
