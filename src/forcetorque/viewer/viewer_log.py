# SPDX-License-Identifier: BSD-3-Clause
"""A scene as frames, wrenches and events over time, as programs that play logs take it: Rerun, Foxglove, ROS 2."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.viewer.scene import Joint, Robot, Scene
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene
from forcetorque.viewer.sensor_wrenches import LOGGED

POSES_HZ = 50.0
"""Highest rate of poses and arrows; wrenches keep theirs."""

_LONGEST_ARROW_M = 0.3
"""Length of the largest force that the robot model expects, or where it expects none that is measured."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedFrame:
    """A frame, seen from its parent."""

    name: str
    """Name, unique in the log."""
    parent: str
    """Name of its parent; that of the world for the root link."""
    poses: FloatArray
    """x, y, z in m, then qw, qx, qy, qz, at `pose_ns`, or one where it stays; shape (m, 7) or (1, 7)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedWrench:
    """Wrenches in a frame, force then moment."""

    name: str
    """Name as topics have it, such as `arm_ft/expected`: letters, digits, _ and /."""
    frame: str
    """Frame along whose axes, and about whose origin they are."""
    values: FloatArray
    """Shape (n, 6); N, N m; NaN where there is none."""
    kind: Literal["expected", "measured", "error", "contact"]
    """Error: measured minus expected, in no interval of use `ignore`."""

    @property
    def known(self) -> IntArray:
        """Indices of the instants that have a wrench; shape (k,)."""
        return np.flatnonzero(np.isfinite(self.values).all(axis=1))


@dataclass(frozen=True, slots=True, kw_only=True)
class LoggedEvent:
    """Something that happens at an instant."""

    stamp_ns: int
    """When; ns."""
    is_warning: bool
    """Whether it is a finding, not information."""
    text: str
    """What."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ViewerLog:
    """Everything that a scene has for another viewer."""

    title: str
    """Name of the experiment."""
    world: str
    """Frame with z up in which the robot stands: `world`, or `world_frame` where a link has that name."""
    stamp_ns: IntArray
    """Instants of wrenches and joints; shape (n,); ns."""
    pose_samples: IntArray
    """Indices of the instants at which poses are given; shape (m,)."""
    frames: tuple[LoggedFrame, ...]
    """Frames, parents before children."""
    joints: tuple[str, ...]
    """Names of the joints that were logged and move."""
    positions: FloatArray
    """Their coordinates; shape (n, d); rad or m."""
    wrenches: tuple[LoggedWrench, ...]
    """Expected, measured and corrected wrenches, errors and contacts."""
    metres_per_newton: float
    """Length of arrows."""
    events: tuple[LoggedEvent, ...]
    """Intervals and findings, in the order of time."""
    robot: Robot
    """What the robot looks like."""
    block: bytes
    """Arrays of its meshes."""
    urdf: Path | None
    """File of the robot; None for a load without one."""

    @property
    def pose_ns(self) -> IntArray:
        """Stamps of poses and arrows; shape (m,); ns."""
        return self.stamp_ns[self.pose_samples]

    def sensors(self) -> tuple[str, ...]:
        """Names of sensors and contacts as the wrenches have them."""
        return tuple(dict.fromkeys(wrench.name.partition("/")[0] for wrench in self.wrenches))

    def wrenches_of(self, sensor: str) -> tuple[LoggedWrench, ...]:
        """Wrenches of a sensor or contact by its name in `sensors`."""
        return tuple(wrench for wrench in self.wrenches if wrench.name.startswith(f"{sensor}/"))

    def plots(self) -> Iterator[tuple[str, list[LoggedWrench]]]:
        """Give the wrenches to plot together; errors, which are far smaller, have plots of their own.

        Yields:
            Title of each plot, and its wrenches.
        """
        for name in self.sensors():
            known = [wrench for wrench in self.wrenches_of(name) if len(wrench.known)]
            for title, is_error in ((name, False), (f"{name}: error", True)):
                if shown := [wrench for wrench in known if (wrench.kind == "error") is is_error]:
                    yield title, shown

    def arrows(self) -> Iterator[tuple[LoggedWrench, FloatArray]]:
        """Give the tips of arrows of forces, in the frames of the wrenches.

        Yields:
            Each wrench that is none of errors, with its tips at the poses; shape (m, 3); m; NaN where there is none.
        """
        for wrench in self.wrenches:
            if wrench.kind != "error":
                yield wrench, self.metres_per_newton * wrench.values[self.pose_samples, :3]


def viewer_log(built: BuiltScene) -> ViewerLog:
    """Take apart a scene for another viewer.

    Args:
        built: The scene, whose values have 24 bits.

    Returns:
        The log.
    """
    scene, block = built.scene, built.block
    seconds = read_array(block, scene.time_s)
    # differences of stamps below some 25 days come back to the nanosecond
    stamp_ns = int(scene.start_ns) + np.rint(seconds * 1e9).astype(np.int64)
    chosen = _at_most(POSES_HZ, stamp_ns)
    frames = _FrameNames.of(scene)
    wrenches = tuple(_wrenches(scene, block, frames))
    positions = read_array(block, scene.positions).astype(np.float64)
    return ViewerLog(
        title=scene.title,
        world=frames.world,
        stamp_ns=stamp_ns,
        pose_samples=chosen,
        frames=tuple(_frames(scene, block, chosen, frames)),
        joints=scene.coordinates,
        positions=positions,
        wrenches=wrenches,
        metres_per_newton=_scale(wrenches),
        events=_events(scene, stamp_ns),
        robot=scene.robot,
        block=block,
        urdf=built.urdf,
    )


def _at_most(rate_hz: float, stamp_ns: IntArray) -> IntArray:
    """Indices of instants at even distances in samples, in the mean not more often than at a rate."""
    duration_s = 1e-9 * float(stamp_ns[-1] - stamp_ns[0])
    step = max(int(np.ceil((len(stamp_ns) - 1) / (duration_s * rate_hz) - 1e-6)), 1) if duration_s > 0.0 else 1
    return np.arange(0, len(stamp_ns), step)


def _wrenches(scene: Scene, block: bytes, frames: _FrameNames) -> Iterator[LoggedWrench]:
    topics, ignored = set[str](), _ignored(scene, read_array(block, scene.time_s))
    for sensor in scene.sensors:
        if sensor.acting is None:  # what is left of the equation of a part, which no sensor reads
            continue
        topic, expected, taken = _unique(_topic(sensor.name), topics), None, set[str]()
        for series in sensor.wrenches:
            values = read_array(block, series.values).astype(np.float64)
            name = _unique(_topic(series.name), taken)
            place = f"{topic}/{name}"
            yield LoggedWrench(name=place, frame=frames.sensors[sensor.name], values=values, kind=series.role)
            if series.role == "expected":
                expected = values
            elif expected is not None:
                error = np.where(ignored[:, None], np.nan, values - expected)
                yield LoggedWrench(name=f"{place}/error", frame=frames.sensors[sensor.name], values=error, kind="error")
    for contact in scene.contacts:
        values = read_array(block, contact.values).astype(np.float64)
        name = _unique(f"{_topic(contact.name)}/contact", topics)
        yield LoggedWrench(name=name, frame=frames.contacts[contact.name], values=values, kind="contact")


def _ignored(scene: Scene, seconds: FloatArray) -> BoolArray:
    """Whether an instant lies in an interval that is ignored; shape (n,)."""
    ignored = np.zeros(len(seconds), dtype=bool)
    for interval in scene.intervals:
        if interval.use == "ignore":
            ignored |= (seconds >= interval.start_s) & (seconds < interval.end_s)
    return ignored


@dataclass(frozen=True, slots=True, kw_only=True)
class _FrameNames:
    """Frames of the world, by sensor and by contact; what has the name of a link gets `_frame` behind it."""

    world: str
    sensors: Mapping[str, str]
    contacts: Mapping[str, str]

    @classmethod
    def of(cls, scene: Scene) -> _FrameNames:
        taken = set(scene.robot.links)
        return cls(
            world=_unique("world", taken),
            sensors={sensor.name: _unique(sensor.name, taken) for sensor in scene.sensors},
            contacts={contact.name: _unique(f"{contact.name}_contact", taken) for contact in scene.contacts},
        )


def _unique(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_frame"
    taken.add(name)
    return name


def _topic(name: str) -> str:
    """A name with letters, digits and _ alone, as topics of ROS 2 have it."""
    plain = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_")
    return plain if plain[:1].isalpha() else f"_{plain}"


def _scale(wrenches: tuple[LoggedWrench, ...]) -> float:
    for kinds in (("expected",), ("measured", "contact")):
        sizes = [np.linalg.norm(wrench.values[wrench.known, :3], axis=1) for wrench in wrenches if wrench.kind in kinds]
        largest = max((float(size.max()) for size in sizes if len(size)), default=0.0)
        if largest > 0.0:
            return _LONGEST_ARROW_M / largest
    return 1.0


def _events(scene: Scene, stamp_ns: IntArray) -> tuple[LoggedEvent, ...]:
    start_ns = int(scene.start_ns)

    def at(seconds: float | None) -> int:
        return int(stamp_ns[0]) if seconds is None else start_ns + round(seconds * 1e9)

    events = []
    for interval in scene.intervals:
        on = "" if interval.support is None else f" on {interval.support}"
        text = f"interval {interval.label!r} ({interval.use}{on})"
        events.append(LoggedEvent(stamp_ns=at(interval.start_s), is_warning=False, text=f"{text} begins"))
        events.append(LoggedEvent(stamp_ns=at(interval.end_s), is_warning=False, text=f"{text} ends"))
    for finding in scene.findings:
        text = f"{finding.stream}: {finding.kind}: {finding.message}"
        events.append(LoggedEvent(stamp_ns=at(finding.start_s), is_warning=True, text=text))
    moved = [
        f"{sensor.name}, {series.name}: the offset over the calibration intervals is added; do not calibrate from it"
        for sensor in scene.sensors
        for series in sensor.wrenches
        if series.name in (LOGGED, PRIOR)
    ]
    notes = (LoggedEvent(stamp_ns=int(stamp_ns[0]), is_warning=False, text=note) for note in (*moved, *scene.notes))
    return tuple(sorted((*events, *notes), key=lambda event: event.stamp_ns))


def _frames(scene: Scene, block: bytes, chosen: IntArray, frames: _FrameNames) -> Iterator[LoggedFrame]:
    root = read_array(block, scene.root)[chosen].astype(np.float64)
    positions = read_array(block, scene.positions)[chosen].astype(np.float64)
    yield LoggedFrame(name=scene.robot.root_link, parent=frames.world, poses=_once(root))
    for joint in scene.robot.joints:
        yield LoggedFrame(name=joint.child, parent=joint.parent, poses=_once(_moved(joint, positions)))
    for sensor in scene.sensors:
        if sensor.acting is not None:
            pose = _pose(sensor.link_H_sensor)
            yield LoggedFrame(name=frames.sensors[sensor.name], parent=sensor.link, poses=pose[None])
    for contact in scene.contacts:
        pose = _pose(contact.link_H_contact)
        yield LoggedFrame(name=frames.contacts[contact.name], parent=contact.link, poses=pose[None])


def _once(poses: FloatArray) -> FloatArray:
    return poses[:1] if (poses == poses[0]).all() else poses


def _moved(joint: Joint, positions: FloatArray) -> FloatArray:
    """Poses of the child of a joint in the parent; shape (m, 7), or (1, 7) where it stays."""
    if joint.column is None:
        coordinate = np.array([joint.offset])
    else:
        coordinate = joint.multiplier * positions[:, joint.column] + joint.offset
    fixed, axis = _pose(joint.parent_H_child), np.array(joint.axis)
    own = np.zeros((len(coordinate), 7))
    own[:, 3] = 1.0
    if joint.type == "prismatic":
        own[:, :3] = coordinate[:, None] * axis
    elif joint.type == "rotary":
        own[:, 3] = np.cos(0.5 * coordinate)
        own[:, 4:] = np.sin(0.5 * coordinate)[:, None] * axis
    return composed(fixed[None], own)


def _pose(row_by_row: tuple[float, ...]) -> FloatArray:
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    pose = np.reshape(row_by_row, (4, 4))
    x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat(canonical=True)
    return np.array([*pose[:3, 3], w, x, y, z])


def composed(a_H_b: FloatArray, b_H_c: FloatArray) -> FloatArray:
    """Compose poses.

    Args:
        a_H_b: x, y, z, qw, qx, qy, qz; shape (m, 7) or (1, 7).
        b_H_c: Likewise.

    Returns:
        `a_H_c`; shape (m, 7).
    """
    quaternion, position = a_H_b[:, 3:], b_H_c[:, :3]
    scalar, vector = quaternion[:, :1], quaternion[:, 1:]
    half = 2.0 * np.cross(vector, position)
    moved = a_H_b[:, :3] + position + scalar * half + np.cross(vector, half)
    other_scalar, other_vector = b_H_c[:, 3:4], b_H_c[:, 4:]
    w = scalar * other_scalar - np.sum(vector * other_vector, axis=1, keepdims=True)
    xyz = scalar * other_vector + other_scalar * vector + np.cross(vector, other_vector)
    return np.hstack([moved, w, xyz])
