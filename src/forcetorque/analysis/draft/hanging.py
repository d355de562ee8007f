# SPDX-License-Identifier: BSD-3-Clause
"""What a reading says of gravity by itself: force as the weight of whatever hangs on the sensor, plus a bias.

A sensor that nothing touches reads `f = R h + mu R a + b` along its axes: R turns vectors of the support to those of
the sensor, a is the acceleration of the sensor, h the weight in the axes of the support (up or down, by who acts on
whom), mu the mass with that sign. Neither mass nor direction need be known, and a contact shows as what is left.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.recording import Recording, SavitzkyGolay, Stream
from forcetorque.recording.alignment import interpolate, usable_samples
from forcetorque.recording.joints import joint_motion_at
from forcetorque.recording.quality import spans
from forcetorque.robot import (
    RobotModel,
    RootMotion,
    SensorFrame,
    build_tree,
    joints_between,
    link_pose,
    motion_of_link,
)
from forcetorque.spatial import split_pose

WINDOW_S = 0.2
"""Readings are averaged over so long, against noise and vibration; s."""
SHORTEST_S = 2.0
"""Shortest span that is offered; s."""
LARGE_SHARE = 0.02
"""What is left may be this share of the weight, for a sensor that is not calibrated yet."""

_FEWEST = 20
_MOST_WINDOWS = 20_000
_DEVIATIONS = 5.0
_MAD = 1.4826
"""Standard deviation of normal errors over their median magnitude."""
_SURE = 5.0
_FILTER = SavitzkyGolay(window_s=0.3, order=3)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hanging:
    """How a reading goes with the orientation of its sensor."""

    stamp_ns: IntArray
    """Middles of the n windows; ns."""
    weight: FloatArray
    """Weight in the axes of the support, as it is read; shape (3,); N."""
    inertia: float
    """Mass with the sign of the reading, by its acceleration: minus for child_to_parent; kg."""
    inertia_deviation: float
    """Standard deviation of that; kg."""
    left: FloatArray
    """Magnitude of the force that is left; shape (n,); N."""
    turned: float
    """Standard deviation of the force that the orientation explains; N."""
    tolerance: float
    """Force that is taken for none; N."""

    @property
    def is_free(self) -> BoolArray:
        """Windows in which nothing seems to touch; shape (n,)."""
        free: BoolArray = self.left <= self.tolerance
        return free

    @property
    def share_free(self) -> float:
        """Share of the windows in which nothing seems to touch."""
        return float(self.is_free.mean())

    @property
    def says_something(self) -> bool:
        """Whether orientation moves the reading by far more than what is left, in most of the time."""
        return self.turned > 3.0 * float(np.median(self.left)) and self.share_free > 0.5

    @property
    def direction(self) -> str | None:
        """Who acts on whom, where accelerations tell it surely and agree with the weight."""
        mass = float(np.linalg.norm(self.weight)) / 9.8
        sure = abs(self.inertia) > _SURE * self.inertia_deviation
        if not (sure and 0.5 * mass < abs(self.inertia) < 2.0 * mass):
            return None
        return "child_to_parent" if self.inertia < 0.0 else "parent_to_child"


def hanging(model: RobotModel, link: str, support: str, recording: Recording, stream: Stream) -> Hanging | None:
    """Hold the forces of a stream against the orientation of a link.

    Args:
        model: The robot.
        link: Link in whose axes the sensor may read.
        support: Link that is taken to stand still.
        recording: Streams with the joints between them.
        stream: Stream with the wrench.

    Returns:
        What the readings say; None where too few windows have all joints.
    """
    tree = build_tree(model, support)
    at_ns, force = _windows(stream)
    joints = joints_between(tree, link)
    if len(at_ns) < _FEWEST or not set(joints) <= set(recording.joint_signals("position")):
        return None
    motion = joint_motion_at(recording, joints, at_ns, window=_FILTER)
    whole = np.isfinite(motion.position).all(axis=1) & np.isfinite(motion.acceleration).all(axis=1)
    whole &= np.isfinite(force).all(axis=1)
    if int(whole.sum()) < _FEWEST:
        return None
    at_ns, force = at_ns[whole], force[whole]
    motion = joint_motion_at(recording, joints, at_ns, window=_FILTER)
    rotation, _ = split_pose(link_pose(tree, motion, link))  # (n, 3, 3), or one
    link_R_support = np.broadcast_to(np.swapaxes(rotation, -1, -2), (len(at_ns), 3, 3))
    still = RootMotion(proper_acceleration=np.zeros(3), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3))
    moved = np.broadcast_to(motion_of_link(tree, motion, still, link).proper_acceleration, (len(at_ns), 3))
    return _fitted(at_ns, force, link_R_support, moved)


def reading_link(model: RobotModel, joint: str, frame: SensorFrame | None = None) -> str:
    """Give the link in whose axes a sensor at a fixed joint reads.

    Args:
        model: The robot.
        joint: The joint.
        frame: Frame of the sensor; child if None.

    Returns:
        The link.
    """
    placed = model.joints[joint]
    return placed.parent if frame is SensorFrame.PARENT else placed.child


def _windows(stream: Stream) -> tuple[IntArray, FloatArray]:
    """Middles of windows, and the mean force in each."""
    usable = usable_samples(stream.stamp_ns)
    stamps, force = stream.stamp_ns[usable], stream.signal("wrench").values[usable, :3]
    if len(stamps) < 2:
        return np.empty(0, dtype=np.int64), np.empty((0, 3))
    length = max(int(WINDOW_S * 1e9), int(stamps[-1] - stamps[0]) // _MOST_WINDOWS + 1)
    number = (stamps - stamps[0]) // length
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    count = np.diff(np.append(starts, len(stamps)))
    mean = np.add.reduceat(force, starts, axis=0) / count[:, None]
    middle = stamps[starts] + (np.add.reduceat(stamps - stamps[0], starts) // count - (stamps[starts] - stamps[0]))
    return middle.astype(np.int64), mean


def _fitted(at_ns: IntArray, force: FloatArray, link_R_support: FloatArray, moved: FloatArray) -> Hanging:
    n = len(at_ns)
    design = np.concatenate([link_R_support, moved[:, :, None], np.broadcast_to(np.eye(3), (n, 3, 3))], axis=2).reshape(
        3 * n, 7
    )
    reading = force.reshape(-1)
    scale = np.maximum(np.abs(design).max(axis=0), 1e-9)
    start = np.linalg.lstsq(design / scale, reading, rcond=None)[0]
    scaled: FloatArray = design / scale
    noise = max(_MAD * float(np.median(np.abs(scaled @ start - reading))), 1e-6)

    def residual(x: FloatArray) -> FloatArray:
        rest: FloatArray = scaled @ x - reading
        return rest

    fit = least_squares(residual, start, loss="cauchy", f_scale=noise)  # linear: finite differences are exact
    coefficients = fit.x / scale
    rest = (reading - design @ coefficients).reshape(n, 3)
    left = np.linalg.norm(rest, axis=1)
    weight = coefficients[:3]
    spread = _MAD * float(np.median(left))
    tolerance = max(_DEVIATIONS * spread / np.sqrt(2.0), LARGE_SHARE * float(np.linalg.norm(weight)))
    information = scaled[np.repeat(left <= tolerance, 3)]
    covariance = np.linalg.pinv(information.T @ information) * spread**2
    turned = link_R_support @ weight
    return Hanging(
        stamp_ns=at_ns,
        weight=weight,
        inertia=float(coefficients[3]),
        inertia_deviation=float(np.sqrt(covariance[3, 3]) / scale[3]),
        left=left,
        turned=float(np.sqrt(turned.var(axis=0).sum())),
        tolerance=float(tolerance),
    )


def free_spans(stamp_ns: IntArray, free: BoolArray) -> list[tuple[int, int]]:
    """Find spans of time in which nothing seems to touch.

    Args:
        stamp_ns: Instants, in order; shape (n,); ns.
        free: Whether nothing seems to touch then; shape (n,).

    Returns:
        First and last instant of every span that is long enough; ns.
    """
    if len(stamp_ns) < 2:
        return []
    step = float(np.median(np.diff(stamp_ns)))
    breaks = np.flatnonzero(np.diff(stamp_ns) > 5.0 * step) + 1
    runs: list[tuple[int, int]] = []
    for part in np.split(np.arange(len(stamp_ns)), breaks):
        runs += [(int(stamp_ns[part[a]]), int(stamp_ns[part[b]])) for a, b in spans(free[part])]
    return [(first, last) for first, last in runs if last - first >= SHORTEST_S * 1e9]


def joint_speed(recording: Recording, at_ns: IntArray) -> FloatArray | None:
    """Give the fastest joint at given instants, to tell rest from motion.

    Args:
        recording: Streams, of which those with positions are used.
        at_ns: Instants; shape (n,); ns.

    Returns:
        Speed; shape (n,); rad/s or m/s; None without joints.
    """
    fastest = None
    for stream in recording.streams.values():
        usable = usable_samples(stream.stamp_ns)
        if "position" in stream.signals and len(usable) > 2:
            positions = stream.signals["position"].values
            rate = np.zeros_like(positions)
            rate[usable] = np.gradient(positions[usable], stream.stamp_ns[usable] * 1e-9, axis=0)
            speed = np.abs(interpolate(stream, rate, at_ns)).max(axis=1)
            fastest = speed if fastest is None else np.fmax(fastest, speed)
    return fastest
