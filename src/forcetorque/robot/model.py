# SPDX-License-Identifier: BSD-3-Clause
"""Robot models: a tree of links joined by joints, with force-torque sensors at fixed joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, mapping, read_only
from forcetorque.base.errors import RobotError, known_names, require_known
from forcetorque.base.inertia import Inertia
from forcetorque.base.wrench import MeasureDirection


class JointType(StrEnum):
    """Joint types that the dynamics know."""

    FIXED = "fixed"
    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"

    @property
    def moves(self) -> bool:
        """Whether the joint has a coordinate."""
        return self is not JointType.FIXED

    @property
    def unit(self) -> str:
        """Unit of the joint's coordinate: m for a prismatic joint, else rad."""
        return "m" if self is JointType.PRISMATIC else "rad"


@dataclass(frozen=True, slots=True, kw_only=True)
class Mimic:
    """A coordinate that follows another: `multiplier * q_leader + offset`."""

    leader: str
    """Joint that is followed."""
    multiplier: float = 1.0
    """Ratio of the coordinates."""
    offset: float = 0.0
    """Coordinate where the leader's is zero; rad or m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JointLimit:
    """How far, how fast and with what effort a joint goes, as its file says: it need not be plausible, nor in order.

    Expected wrenches do not depend on it, so it is judged only where a motion is planned.
    """

    lower: float | None = None
    """Lowest coordinate; rad or m; None if the file has none or the joint turns without end."""
    upper: float | None = None
    """Highest coordinate; rad or m; None if the file has none or the joint turns without end."""
    velocity: float | None = None
    """Largest speed; rad/s or m/s; None if the file has none; often a 0 that stands for unknown."""
    effort: float | None = None
    """Largest torque or force of the motor; N m or N; None if the file has none."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Joint(ArrayRecord):
    """A joint; at coordinate zero the child link's frame is at `parent_H_child`."""

    name: str
    """Name, unique in the robot."""
    type: JointType
    """Type of the joint."""
    parent: str
    """Parent link."""
    child: str
    """Child link."""
    parent_H_child: FloatArray = field(metadata=array(4, 4))
    """Pose of the child link in the parent link at coordinate zero; shape (4, 4); m."""
    axis: FloatArray = field(metadata=array(3))
    """Unit axis in the child link's frame; shape (3,)."""
    mimic: Mimic | None = None
    """What the coordinate follows, if it is not free."""
    limit: JointLimit | None = None
    """How far and how fast it goes; None if the file says nothing."""


class SensorFrame(StrEnum):
    """Frame in whose axes, and about whose origin, a sensor reads."""

    CHILD = "child"
    """Frame of the child link. An `<origin>` of the sensor is then ignored."""
    PARENT = "parent"
    """Frame of the parent link. An `<origin>` of the sensor is then ignored."""
    SENSOR = "sensor"
    """Child link's frame moved by the sensor's `<origin>`."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ForceTorqueSensor(ArrayRecord):
    """A six-axis force-torque sensor at a fixed joint."""

    name: str
    """Name, unique in the robot."""
    joint: str
    """Fixed joint that it sits in."""
    frame: SensorFrame
    """Frame of its reading."""
    direction: MeasureDirection
    """Who acts on whom in its reading."""
    child_H_sensor: FloatArray = field(metadata=array(4, 4))
    """Pose of the `<origin>` in the child link, used where `frame` is `sensor`; shape (4, 4); m."""
    aliases: tuple[str, ...] = ()
    """Other names of the same sensor, such as that of its simulator's tag."""

    def __post_init__(self) -> None:
        check_arrays(self)
        # a bare word would fail every `is`, and so read as the other direction
        object.__setattr__(self, "frame", SensorFrame(self.frame))
        object.__setattr__(self, "direction", MeasureDirection(self.direction))


_NAMED = 6
"""Sensors that the text of a robot names; more are counted."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class RobotModel(ArrayRecord):
    """A robot: links in a tree of joints, and its force-torque sensors."""

    name: str
    """Name of the robot."""
    links: Mapping[str, Inertia] = field(metadata=mapping())
    """Inertia of every link, in and about the link's frame."""
    joints: Mapping[str, Joint] = field(metadata=mapping())
    """Every joint by name."""
    sensors: Mapping[str, ForceTorqueSensor] = field(metadata=mapping())
    """Every force-torque sensor by name."""

    def __post_init__(self) -> None:
        check_arrays(self)
        _require_tree(self)

    def __repr__(self) -> str:
        moving = sum(joint.type.moves for joint in self.joints.values())
        named = ", ".join(list(self.sensors)[:_NAMED]) or "none"
        more = f" and {len(self.sensors) - _NAMED} more" if len(self.sensors) > _NAMED else ""
        what = f"{len(self.links)} links, {len(self.joints)} joints ({moving} moving), sensors {named}{more}"
        return f"<RobotModel {self.name!r}: {what}>"

    @property
    def root_link(self) -> str:
        """The one link that is no joint's child."""
        (root,) = _roots(self)
        return root

    def sensor(self, name: str) -> ForceTorqueSensor:
        """Find a force-torque sensor by its name or an alias.

        Returns:
            The sensor.

        Raises:
            RobotError: If the robot has no such sensor.
        """
        for sensor in self.sensors.values():
            if name == sensor.name or name in sensor.aliases:
                return sensor
        raise RobotError(
            f"robot {self.name!r} has no force-torque sensor {name!r}; {known_names(name, self.sensors)}; "
            "a sensor without a tag is declared by its fixed joint and measure_direction, from Python by with_sensor"
        )

    def with_sensor(
        self,
        name: str,
        *,
        joint: str,
        direction: MeasureDirection,
        frame: SensorFrame = SensorFrame.CHILD,
    ) -> RobotModel:
        """Declare a sensor at a fixed joint that carries no sensor tag.

        Args:
            name: Name of the new sensor.
            joint: Fixed joint that it sits in.
            direction: Who acts on whom in its reading; never guessed.
            frame: `child` or `parent`: the link in whose frame it reads.

        Returns:
            The robot with one more sensor.

        Raises:
            RobotError: If the joint is unknown, moves, or has a sensor already, or the frame needs an origin.
        """
        require_known(joint, self.joints, RobotError, f"robot {self.name!r} has no joint {joint!r}")
        if self.joints[joint].type.moves:
            raise RobotError(f"sensor {name!r}: expected a fixed joint, {joint!r} is {self.joints[joint].type}")
        holder = [s.name for s in self.sensors.values() if s.joint == joint]
        holder += [s.name for s in self.sensors.values() if name in (s.name, *s.aliases)]
        if holder:
            raise RobotError(f"sensor {name!r} at {joint!r}: the robot has the sensor {holder[0]!r} already")
        if frame == SensorFrame.SENSOR:
            raise RobotError(f"sensor {name!r}: without a tag there is no origin; the frame must be child or parent")
        sensor = ForceTorqueSensor(
            name=name, joint=joint, frame=frame, direction=direction, child_H_sensor=_identity_pose()
        )
        return replace(self, sensors={**self.sensors, name: sensor})


def _identity_pose() -> FloatArray:
    return read_only([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], name="pose", shape=(4, 4))


def _roots(model: RobotModel) -> list[str]:
    children = {joint.child for joint in model.joints.values()}
    return [link for link in model.links if link not in children]


def _require_tree(model: RobotModel) -> None:
    """Check that joints join known links to one tree, and that sensors sit at joints.

    A joint that mimics a missing one is refused only where its coordinate is needed: real models
    carry such fingers.

    Raises:
        RobotError: If it is not so.
    """
    if not model.links:
        raise RobotError(f"robot {model.name!r}: expected links, got none; expand xacro files first")
    parent_joint: dict[str, Joint] = {}
    for joint in model.joints.values():
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            require_known(
                link, model.links, RobotError, f"joint {joint.name!r}: its {role} link {link!r} is not in the robot"
            )
        if joint.child in parent_joint:
            raise RobotError(
                f"link {joint.child!r} is the child of the joints {parent_joint[joint.child].name!r} and "
                f"{joint.name!r}; expected a tree without loops"
            )
        parent_joint[joint.child] = joint
    roots = _roots(model)
    if len(roots) != 1:
        listed = "none: the joints form a loop" if not roots else ", ".join(repr(r) for r in roots)
        raise RobotError(f"robot {model.name!r}: expected one root link that is no joint's child, found {listed}")
    for link in model.links:
        seen = [link]
        while seen[-1] in parent_joint:
            seen.append(parent_joint[seen[-1]].parent)
            if len(seen) > len(model.links):
                raise RobotError(f"robot {model.name!r}: the joints above link {link!r} form a loop; expected a tree")
    for sensor in model.sensors.values():
        if sensor.joint not in model.joints:
            raise RobotError(
                f"force-torque sensor {sensor.name!r}: its joint {sensor.joint!r} is not in the robot; "
                f"{known_names(sensor.joint, model.joints)}"
            )
