# SPDX-License-Identifier: BSD-3-Clause
"""What stands still, and what hangs beyond a sensor, as far as the robot's model tells."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from forcetorque.inspection.draft.gravity import LIGHT_KG, Hanging, mass_beyond
from forcetorque.inspection.draft.sensors import DraftedSensor, sensor_joints, weight_words
from forcetorque.inspection.draft.toml_lines import line, listed, question
from forcetorque.robot.model import Joint, RobotModel

_STANDS = ("sole", "foot", "feet", "toe", "base", "ground")
"""Words in the names of links that robots stand on, the likeliest first."""
_SENSES = {"acc", "imu", "gyro", "skin", "taxel", "ft", "sensor"}
"""Words in the names of frames of sensors, which are ends of the robot too."""
_MOST_SUPPORTS = 12


def base_of_arm(model: RobotModel) -> str | None:
    """Give the link that an arm is bolted down by.

    Args:
        model: The robot.

    Returns:
        Its root, or the first link with a mass behind it, which fixed joints hold there; None for a robot with several
        limbs, which may stand on any of them.
    """
    moving = [joint for joint in model.joints.values() if joint.type.moves and joint.mimic is None]
    inward = {joint.child: joint for joint in model.joints.values()}
    first_of: set[str] = set()
    for joint in moving:
        here = joint
        while (above := _next_moving(here.parent, inward)) is not None:
            here = above
        first_of.add(here.name)
    if len(first_of) != 1:
        return None
    (first,) = first_of
    return model.joints[first].parent


def ends_of_robot(model: RobotModel) -> tuple[str, ...]:
    """Name the links without another beyond them that moving joints lead to.

    Args:
        model: The robot.

    Returns:
        The links that are called like soles first, then feet, bases, and the others in the order of the model, its root
        last of each.
    """
    parents = {joint.parent for joint in model.joints.values()}
    inward = {joint.child: joint for joint in model.joints.values()}
    ends = [
        link
        for link in model.links
        if link not in parents
        and link in inward
        and (inward[link].type.moves or _next_moving(inward[link].parent, inward))
    ]
    return tuple(sorted((*ends, model.root_link), key=_unlikely_to_stand))


def has_no_tool(sensor: DraftedSensor, model: RobotModel) -> bool:
    """Tell whether the robot's model has nothing that a sensor could feel.

    Args:
        sensor: The sensor.
        model: The robot.

    Returns:
        Whether all joints that it may sit in have no mass beyond them.
    """
    joints = sensor_joints(sensor, model)
    return bool(joints) and all(mass_beyond(model, joint) < LIGHT_KG for joint in joints)


def support_lines(
    base: str | None, model: RobotModel, imu_streams: Sequence[str], hanging: Hanging | None
) -> list[str]:
    """Write the `[[support]]` table.

    Args:
        base: The link that an arm is bolted down by; None where any may stand.
        model: The robot.
        imu_streams: Streams of inertial sensors.
        hanging: What a reading says of the direction of gravity there; None for nothing.

    Returns:
        Its lines.
    """
    lines = ["", "[[support]]"]
    if base is None:
        ends = ends_of_robot(model)
        likely = [link for link in ends if _unlikely_to_stand(link) < len(_STANDS)] or list(ends)
        others = f", or one of {len(ends) - len(likely)} other ends of it" if len(likely) < len(ends) else ""
        words = f"link that stands still and alone touches the world: {listed(likely, _MOST_SUPPORTS)}{others}"
        lines.append(question("frame", words))
    else:
        lines.append(line("frame", base, "it stands still: the link that the arm moves from"))
    words = (
        f"direction in which things fall, in the axes of {base or 'that link'}, as [0.0, 0.0, -1.0] where z points up"
    )
    if imu_streams:
        words += f"; a robot that moves has imu = [{', '.join(map(repr, imu_streams))}] in place of this line"
    if hanging is not None:
        words += f"; {weight_words(hanging)}"
    return [*lines, question("gravity_direction", words)]


def load_lines(sensor: DraftedSensor, model: RobotModel) -> list[str]:
    """Write the `[[load]]` of an arm whose model ends at the sensor.

    Args:
        sensor: The sensor.
        model: The robot.

    Returns:
        Its lines.
    """
    joint = model.sensors[sensor.name].joint if sensor.name in model.sensors else sensor.joint
    lines = ["", "# what hangs on the sensor: the URDF has no mass there", "[[load]]"]
    lines.append(question("name", "a name for the tool; in another recording the same name is the same tool"))
    if joint is not None:
        lines.append(line("link", model.joints[joint].child))
    else:
        lines.append(question("link", "link of the URDF that it hangs on: the child link of the sensor's joint"))
    return [
        *lines,
        "# mass_kg = 1.0                        # state both if the tool was weighed; without, it is estimated, and",
        "# centre_of_mass_m = [0.0, 0.0, 0.05]  # the scale of the matrix stays that of the prior; in the link's frame",
    ]


def interval_support(base: str | None) -> str:
    """Write the support of an interval.

    Args:
        base: The link that an arm is bolted down by; None where it is a question.

    Returns:
        The line.
    """
    return question("support", "frame of the [[support]]") if base is None else line("support", base)


def _unlikely_to_stand(link: str) -> int:
    """Place of the word in its name by which a link may stand on the ground; the number of words for none."""
    name = link.lower()
    if _SENSES & set(re.split("[^a-z]+", name)):
        return len(_STANDS)
    return next((k for k, word in enumerate(_STANDS) if word in name), len(_STANDS))


def _next_moving(link: str, inward: Mapping[str, Joint]) -> Joint | None:
    """The moving joint that carries a link; None for what is fixed to the root."""
    while link in inward:
        joint = inward[link]
        if joint.type.moves:
            return joint
        link = joint.parent
    return None
