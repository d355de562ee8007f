# SPDX-License-Identifier: BSD-3-Clause
"""The `[[sensor]]` tables of a log, the loads beyond sensors, and the links that stand still."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.pose import make_pose
from forcetorque.inspection.draft.drafted_streams import DraftedStream
from forcetorque.inspection.draft.gravity_fit import LIGHT_KG, GravityFit, mass_beyond
from forcetorque.inspection.draft.toml_lines import line, listed, question
from forcetorque.robot.model import Joint, RobotModel
from forcetorque.robot.mount_estimate import rotation_by

_OF_SENSORS = {
    "ft",
    "fts",
    "sensor",
    "force",
    "torque",
    "wrench",
    "analog",
    "measures",
    "o",
    "i",
    "filtered",
    "raw",
    "data",
}
"""Words that tell no sensor from another."""
_MOST_CANDIDATES = 12
_DIGITS = 4
"""Decimals of a mount; deg, mm."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DraftedMount:
    """Pose of a sensor in the child link of its joint."""

    rotation_deg: FloatArray
    """Rotation vector that turns the axes of the link into those of the sensor; shape (3,); deg."""
    shift_mm: FloatArray
    """Origin of the sensor in the link; shape (3,); mm."""
    source: str
    """What says so."""

    @property
    def pose(self) -> FloatArray:
        """`link_H_sensor`; shape (4, 4); m."""
        return make_pose(rotation_by(np.deg2rad(self.rotation_deg)), 1e-3 * self.shift_mm)

    def line(self) -> str:
        """Write the key.

        Returns:
            The line, with its source.
        """
        rotation, shift = (values.round(_DIGITS) + 0.0 for values in (self.rotation_deg, self.shift_mm))
        return line("mount", {"rotation_deg": rotation.tolist(), "shift_mm": shift.tolist()}, self.source)


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedSensor:
    """A sensor of the experiment."""

    name: str
    """Its name; `?` where the robot has several and none is called like the stream."""
    stream: str
    """Stream of its reading."""
    is_raw: bool
    """Whether that is of raw channels."""
    is_estimated: bool = False
    """Whether that is called an estimated wrench."""
    tags: tuple[str, ...] = ()
    """Sensors of the robot's file that it may be, where its name is open."""
    joints: tuple[str, ...] = ()
    """Fixed joints that it may sit in, the likeliest first; none where the robot's file has a tag."""
    joint: str | None = None
    """The joint, where a name tells it."""
    mount: DraftedMount | None = None
    """Its pose in the child link of that joint, where the log has it."""
    components: tuple[str, ...] = ()
    """What it measures, where that is fewer than six components."""
    evidence: Mapping[str, GravityFit] = field(default_factory=dict)
    """What the reading says of each joint."""


def draft_sensors(streams: Sequence[DraftedStream], model: RobotModel | None) -> tuple[DraftedSensor, ...]:
    """Match streams that read loads to the robot.

    Args:
        streams: Streams of the log.
        model: The robot; None for a wrist sensor without one.

    Returns:
        A sensor for each.
    """
    reading = [stream for stream in streams if stream.reads_load]
    if model is None:
        return tuple(
            DraftedSensor(
                name=_name_of(stream, reading),
                stream=stream.name,
                is_raw=_is_raw(stream),
                is_estimated=stream.is_estimated,
            )
            for stream in reading
        )
    return tuple(
        replace(_matched(stream, reading, model), components=stream.components, is_estimated=stream.is_estimated)
        for stream in reading
    )


def chosen_sensors(sensors: Sequence[DraftedSensor], wanted: Sequence[str]) -> tuple[DraftedSensor, ...]:
    """Select sensors by name or stream.

    Args:
        sensors: All sensors of the log.
        wanted: Names of sensors, or of their streams; all sensors if empty, without wrenches that are called estimated
            where there are others.

    Returns:
        The sensors, in the order of the log.

    Raises:
        ExperimentError: If one is not in the log.
    """
    known = [name for one in sensors for name in dict.fromkeys((one.name, one.stream))]
    for name in wanted:
        require_known(name, known, ExperimentError, f"--sensor: the log has no sensor {name!r}")
    if not wanted:
        return tuple(one for one in sensors if not one.is_estimated) or tuple(sensors)
    return tuple(one for one in sensors if {one.name, one.stream} & set(wanted))


def sensor_joints(sensor: DraftedSensor, model: RobotModel) -> tuple[str, ...]:
    """Name the fixed joints that a sensor may sit in.

    Returns:
        One where its name or a tag of the robot's file tells it; else the likeliest first.
    """
    if sensor.name in model.sensors:
        return (model.sensors[sensor.name].joint,)
    return (sensor.joint,) if sensor.joint else sensor.joints


def sensor_lines(sensor: DraftedSensor, priors: Sequence[str], *, on_robot: bool) -> list[str]:
    """Write a `[[sensor]]` table.

    Args:
        sensor: The sensor.
        priors: Lines with its serial number and prior.
        on_robot: Whether there is a robot, in one of whose joints it sits.

    Returns:
        Its lines.
    """
    lines = ["", "[[sensor]]"]
    if sensor.tags:
        lines.append(question("name", f"sensor of the URDF that the stream is of: {listed(sensor.tags)}"))
    else:
        lines.append(line("name", sensor.name))
    lines.append(line("stream", sensor.stream))
    lines += priors
    if sensor.components:
        lines.append(line("components", sensor.components))
    if on_robot and not sensor.tags and (sensor.joint or sensor.joints):
        lines += _place_lines(sensor)
    return lines


def weight_text(fit: GravityFit) -> str:
    """Say what a reading tells of gravity.

    Args:
        fit: How it goes with the orientation.

    Returns:
        Words for the question of the direction of gravity.
    """
    size = float((fit.weight**2).sum() ** 0.5)
    along = ", ".join(f"{value:+.2f}" for value in fit.weight / size)
    return (
        f"the force turns with the sensor as a weight of {size:.3g} N along [{along}] would: gravity points there if "
        "child_to_parent, else the other way"
    )


def _place_lines(sensor: DraftedSensor) -> list[str]:
    if sensor.joint is not None:
        joint = line("joint", sensor.joint, "by its name" if sensor.mount is None else "by its frame")
    else:
        candidates = sorted(sensor.evidence, key=lambda name: sensor.evidence[name].median_residual)
        left = [f"{name} ({_left(sensor.evidence[name])})" for name in candidates]
        others = [name for name in sensor.joints if name not in sensor.evidence]
        words = "fixed joint of the URDF that it sits in, whose child link has the axes of the sensor"
        evidence = "; what the orientation of that link leaves of the force: " if left else ": "
        joint = question("joint", f"{words}{evidence}{listed([*left, *others], _MOST_CANDIDATES)}")
    words = "child_to_parent if it reads what the outer part does to the inner one, so that a hanging load reads down; "
    words += "parent_to_child if the opposite"
    directions = {fit.direction for fit in sensor.evidence.values()} - {None}
    if len(directions) == 1:
        words += f"; the accelerations in the log say {directions.pop()}"
    mount = '# mount = "unknown"  # if it may be turned against that link: calibrate then estimates the mount first'
    if sensor.mount is not None:
        mount = sensor.mount.line()
    return [joint, question("measure_direction", words), mount]


def _left(fit: GravityFit) -> str:
    free = fit.left[fit.is_free]
    rms = float((free**2).mean() ** 0.5) if len(free) else float((fit.left**2).mean() ** 0.5)
    return f"{rms:.2g} N of {fit.turned:.2g} N in {100 * fit.share_free:.0f} % of the time"


def _matched(stream: DraftedStream, reading: Sequence[DraftedStream], model: RobotModel) -> DraftedSensor:
    tags = _tags_of(stream, model)
    rivals = [other for other in reading if other is not stream and set(tags) & set(_tags_of(other, model))]
    raw = _is_raw(stream)
    if len(tags) == 1 and not rivals:
        return DraftedSensor(name=tags[0], stream=stream.name, is_raw=raw)
    if model.sensors:
        if len(model.sensors) == len(reading) == 1:
            return DraftedSensor(name=next(iter(model.sensors)), stream=stream.name, is_raw=raw)
        return DraftedSensor(name=_name_of(stream, reading), stream=stream.name, is_raw=raw, tags=tuple(model.sensors))
    fixed = _fixed_joints(model)
    named = [
        name
        for name in fixed
        if stream.frame == model.joints[name].child
        or _plain(stream.name) in (_plain(name), _plain(model.joints[name].child))
    ]
    return DraftedSensor(
        name=_name_of(stream, reading),
        stream=stream.name,
        is_raw=raw,
        joints=tuple(fixed),
        joint=named[0] if len(named) == 1 else None,
    )


def _tags_of(stream: DraftedStream, model: RobotModel) -> list[str]:
    """Tags that the stream is called like."""
    return [
        name
        for name, sensor in model.sensors.items()
        if any(is_called(stream.name, alias) for alias in (name, *sensor.aliases))
    ]


def is_called(text: str, name: str) -> bool:
    """Tell whether the words of a name stand in a text, a first letter for a whole word: `r_leg` is `right_leg`.

    Args:
        text: Name of a stream or a file.
        name: Name of a sensor.

    Returns:
        Whether they do, in their order.
    """
    return _words_match(_words(name), _words(text))


def _words(name: str) -> list[str]:
    return [word for word in re.split(r"[^a-z0-9]+", name.lower()) if word and word not in _OF_SENSORS]


def _words_match(wanted: Sequence[str], words: Sequence[str]) -> bool:
    size = len(wanted)
    return size > 0 and any(
        all(
            short == long or (len(short) == 1 and long.startswith(short))
            for short, long in zip(wanted, run, strict=True)
        )
        for run in (words[k : k + size] for k in range(len(words) - size + 1))
    )


def _fixed_joints(model: RobotModel) -> list[str]:
    """Fixed joints with a moving one inward of them, the outermost first: nothing is felt at the base's own."""
    inward = {joint.child: joint for joint in model.joints.values()}
    depth: dict[str, int] = {}
    for name, joint in model.joints.items():
        if joint.type.moves:
            continue
        above, here = 0, joint
        while (here_above := inward.get(here.parent)) is not None:
            above += here_above.type.moves
            here = here_above
        if above:
            depth[name] = above
    return sorted(depth, key=lambda name: -depth[name])


def _is_raw(stream: DraftedStream) -> bool:
    return "raw" in stream.quantities


def _name_of(stream: DraftedStream, reading: Sequence[DraftedStream]) -> str:
    """The only one in tables has a name that other recordings of it get too: tables are called after the day."""
    return "ft_sensor" if stream.table is not None and len(reading) == 1 else _plain(stream.name)


def _plain(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_") or "sensor"


_STANDS = ("sole", "foot", "feet", "toe", "base", "ground")
"""Words in the names of links that robots stand on, the likeliest first."""
_SENSES = {"acc", "imu", "gyro", "skin", "taxel", "ft", "sensor"}
"""Words in the names of frames of sensors, which are ends of the robot too."""
_MOST_SUPPORTS = 12


def base_of_arm(model: RobotModel) -> str | None:
    """Give the link that an arm is bolted down by.

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

    Returns:
        Whether all joints that it may sit in have no mass beyond them.
    """
    joints = sensor_joints(sensor, model)
    return bool(joints) and all(mass_beyond(model, joint) < LIGHT_KG for joint in joints)


def support_lines(base: str | None, model: RobotModel, imu_streams: Sequence[str], fit: GravityFit | None) -> list[str]:
    """Write the `[[support]]` table.

    Args:
        base: The link that an arm is bolted down by; None where any may stand.
        model: The robot.
        imu_streams: Streams of inertial sensors.
        fit: What a reading says of the direction of gravity there; None for nothing.

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
    if fit is not None:
        words += f"; {weight_text(fit)}"
    return [*lines, question("gravity_direction", words)]


def load_lines(sensor: DraftedSensor, model: RobotModel) -> list[str]:
    """Write the `[[load]]` of an arm whose model ends at the sensor."""
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
