# SPDX-License-Identifier: BSD-3-Clause
"""Fit of a force to gravity alone: the weight of the distal links and load of a sensor, plus a bias.

Without contact a sensor measures `f = R h + mu R a + b` along its axes: R turns vectors of the support to those of the
sensor, a is the acceleration of the centre of mass of the distal links, h their weight in the axes of the support (up
or down, by who acts on whom), mu their mass with that sign. Neither mass nor direction need be known. A contact shows
in the residual, once the errors of an uncalibrated matrix are estimated too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, true_runs
from forcetorque.base.inertia import Inertia
from forcetorque.base.units import MAD_TO_DEVIATION, STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.inspection.residual_findings import UNEXPLAINED, model_findings
from forcetorque.recording.alignment import interpolate, usable_samples
from forcetorque.recording.recording import Recording
from forcetorque.recording.smoothing import DERIVATIVE_WINDOW
from forcetorque.recording.stream import Stream
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion, joint_motion_at
from forcetorque.robot.tree import BodyTree, build_tree, required_joints

WINDOW_S = 0.2
"""Window of the means, against noise and vibration; s."""
MARGIN_S = 0.4
"""Margin to a contact, because a push starts and ends gently; s."""
SHORTEST_S = 2.0
"""Shortest interval; s."""
LARGE_SHARE = 0.02
"""Largest residual without contact, as a share of the weight, for a sensor that is not calibrated yet."""

CROSS_TALK = 0.05
"""Expected cross-talk of a prior matrix: share of a load that it measures in another component."""
LEVER_M = 0.05
"""Ratio of full scales of moment and force, which converts shares of moments to shares of forces; m."""
LIGHT_KG = 1e-3
"""Mass beyond a joint below which there is no load."""

_PROBE = "probe"
_FINE_WINDOW_S = 0.05
"""Window of the means in which contacts are looked for; s."""
_FEWEST = 20
_ROUNDS = 20
_MOST_WINDOWS = 20_000
_DEVIATIONS = 5.0
_MEDIAN_OF_NORM = 1.538
"""Median of the norm of three normal errors of deviation 1."""
_SURE = 5.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GravityFit:
    """Fit of the force of a sensor to its orientation."""

    stamp_ns: IntArray
    """Middles of the n windows; ns."""
    weight: FloatArray
    """Measured weight in the axes of the support; shape (3,); N."""
    inertia: float
    """Mass by the accelerations, with the sign of the measurement: minus for child_to_parent; kg."""
    inertia_deviation: float
    """Standard deviation of that mass; kg."""
    left: FloatArray
    """Magnitude of the residual force; shape (n,); N."""
    load: FloatArray
    """Force that the orientation explains; shape (n, 3); N."""
    tolerance: float
    """Largest residual force without contact; N."""

    @property
    def turned(self) -> float:
        """Standard deviation of the force that the orientation explains; N."""
        return float(np.sqrt(self.load.var(axis=0).sum()))

    @property
    def is_free(self) -> BoolArray:
        """Windows without an apparent contact; shape (n,)."""
        return self.left <= self.tolerance

    @property
    def median_residual(self) -> float:
        """Median of the residual force; N."""
        return float(np.median(self.left))

    @property
    def share_free(self) -> float:
        """Share of the windows without an apparent contact."""
        return float(self.is_free.mean())

    @property
    def is_significant(self) -> bool:
        """Whether the orientation explains far more of the force than the residual, most of the time."""
        return self.turned > 3.0 * self.median_residual and self.share_free > 0.5

    @property
    def direction(self) -> str | None:
        """Who acts on whom, where accelerations determine it and agree with the weight."""
        mass = float(np.linalg.norm(self.weight)) / 9.8
        sure = abs(self.inertia) > _SURE * self.inertia_deviation
        if not (sure and 0.5 * mass < abs(self.inertia) < 2.0 * mass):
            return None
        return "child_to_parent" if self.inertia < 0.0 else "parent_to_child"


def fit_gravity(
    model: RobotModel,
    joint: str,
    support: str,
    recording: Recording,
    stream: Stream,
    *,
    link_H_sensor: FloatArray | None = None,
) -> GravityFit | None:
    """Fit the forces of a stream to the orientation of a sensor in a joint.

    Args:
        model: The robot; without a mass beyond the joint, a point mass at the child link is used.
        joint: Fixed joint, with a sensor or without.
        support: Link that is assumed to be at rest.
        recording: Streams with the joints from the support to the distal links.
        stream: Stream with the wrench.
        link_H_sensor: Pose of a sensor without a tag in the child link; shape (4, 4); m; None where both are one frame.

    Returns:
        The fit; None where too few windows have all joints.
    """
    probed = _probed(model, joint, support, recording, stream, WINDOW_S, link_H_sensor)
    if probed is None:
        return None
    mass = mass_beyond(_probe(model, joint), joint)
    static = JointMotion.at_rest(probed.motion.names, probed.motion.position)
    link_R_support = np.stack([probed.expected(static, axis)[:, :3] / mass for axis in np.eye(3)], axis=-1)
    moved = -probed.expected(probed.motion, np.zeros(3))[:, :3] / mass
    return _fitted(probed.at_ns, probed.wrench, link_R_support, moved)


def contact_spans(
    model: RobotModel,
    joint: str,
    support: str,
    recording: Recording,
    stream: Stream,
    fit: GravityFit,
    *,
    link_H_sensor: FloatArray | None = None,
) -> list[tuple[int, int]]:
    """Find contacts and steps as `inspect` does, beside the wrench that the robot model expects.

    A steady push along an axis of the sensor is in them, which the fit of forces to moments takes for cross-talk.

    Args:
        model: The robot; without a mass beyond the joint only forces are compared.
        joint: Fixed joint, with a sensor or without.
        support: Link that is assumed to be at rest.
        recording: Streams with the joints from the support to the distal links.
        stream: Stream with the wrench.
        fit: Its fit to gravity, which gives direction and size of the weight.
        link_H_sensor: As of `fit_gravity`.

    Returns:
        First and last instant of each, in the order of time; ns.
    """
    probed = _probed(model, joint, support, recording, stream, _FINE_WINDOW_S, link_H_sensor)
    if probed is None:
        return []
    size = float(np.linalg.norm(fit.weight))
    static = JointMotion.at_rest(probed.motion.names, probed.motion.position)
    expected = probed.expected(static, fit.weight / size)
    if fit.direction is not None:
        moved = probed.expected(probed.motion, np.zeros(3)) / STANDARD_GRAVITY
        expected += moved if fit.direction == MeasureDirection.CHILD_TO_PARENT else -moved
    expected *= size / mass_beyond(_probe(model, joint), joint)
    measured = np.array(probed.wrench)
    if mass_beyond(model, joint) < LIGHT_KG:
        measured[:, 3:] = expected[:, 3:] = 0.0
    nearest = np.clip(np.searchsorted(fit.stamp_ns, probed.at_ns), 0, len(fit.stamp_ns) - 1)
    in_use = fit.is_free[nearest]
    findings = model_findings(stream.name, probed.at_ns, measured, expected, in_use=in_use) if in_use.any() else ()
    spans = [
        (one.start_ns, one.end_ns)
        for one in findings
        if one.kind in UNEXPLAINED and one.start_ns is not None and one.end_ns is not None
    ]
    return sorted(spans)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Probed:
    """Measured wrenches of windows, and the motion by which a probe in the place of the sensor is evaluated."""

    tree: BodyTree
    at_ns: IntArray
    wrench: FloatArray
    motion: JointMotion

    def expected(self, motion: JointMotion, pull: FloatArray) -> FloatArray:
        """Expected wrenches of the probe by the acceleration of free fall, as child_to_parent; shape (n, 6)."""
        root = RootMotion(proper_acceleration=-pull, angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3))
        return np.array(expected_wrenches(self.tree, motion, root, [_PROBE])[_PROBE])


def _probed(
    model: RobotModel,
    joint: str,
    support: str,
    recording: Recording,
    stream: Stream,
    window_s: float,
    link_H_sensor: FloatArray | None,
) -> _Probed | None:
    """Windows that have all joints; None for too few."""
    probe = _probe(model, joint)
    if link_H_sensor is not None:
        probe = replace(probe, sensors={_PROBE: replace(probe.sensors[_PROBE], child_H_sensor=link_H_sensor)})
    tree = build_tree(probe, support)
    at_ns, wrench = _windows(stream, window_s)
    joints = required_joints(tree, _PROBE)
    if len(at_ns) < _FEWEST or not set(joints) <= set(recording.joint_signals("position")):
        return None
    motion = joint_motion_at(recording, joints, at_ns, window=DERIVATIVE_WINDOW)
    whole = np.isfinite(motion.position).all(axis=1) & np.isfinite(motion.acceleration).all(axis=1)
    whole &= np.isfinite(wrench).all(axis=1)
    if int(whole.sum()) < _FEWEST:
        return None
    return _Probed(tree=tree, at_ns=at_ns[whole], wrench=wrench[whole], motion=motion.samples(np.flatnonzero(whole)))


def required_joints_of_sensor(model: RobotModel, joint: str, support: str) -> tuple[str, ...]:
    """Find the joints that the expected wrench of a sensor in a joint depends on.

    Args:
        model: The robot.
        joint: Fixed joint, with a sensor or without.
        support: Link that is assumed to be at rest.

    Returns:
        Joints between support and sensor, and those of the distal links.
    """
    return required_joints(build_tree(_probe(model, joint), support), _PROBE)


def _probe(model: RobotModel, joint: str) -> RobotModel:
    """The robot with one sensor, at the joint, child_to_parent, with a mass beyond it."""
    tags = [sensor for sensor in model.sensors.values() if sensor.joint == joint]
    bare = replace(model, sensors={})
    if tags:
        probe = replace(tags[0], name=_PROBE, direction=MeasureDirection.CHILD_TO_PARENT, aliases=())
        bare = replace(bare, sensors={_PROBE: probe})
    else:
        bare = bare.with_sensor(_PROBE, joint=joint, direction=MeasureDirection.CHILD_TO_PARENT)
    if mass_beyond(model, joint) >= LIGHT_KG:
        return bare
    child = model.joints[joint].child
    point = Inertia.about_centre_of_mass(mass=1.0, centre_of_mass=np.zeros(3), second_moment=np.zeros((3, 3)))
    return replace(bare, links={**bare.links, child: point})


def mass_beyond(model: RobotModel, joint: str) -> float:
    """Add up the masses beyond a joint.

    Returns:
        Mass of all distal links; kg.
    """
    outward: dict[str, list[str]] = {}
    for entry in model.joints.values():
        outward.setdefault(entry.parent, []).append(entry.child)
    total, waiting = 0.0, [model.joints[joint].child]
    while waiting:
        link = waiting.pop()
        total += model.links[link].mass
        waiting += outward.get(link, ())
    return total


def _windows(stream: Stream, window_s: float) -> tuple[IntArray, FloatArray]:
    """Middles of windows, and the mean wrench in each."""
    usable = usable_samples(stream.stamp_ns)
    stamps, wrench = stream.stamp_ns[usable], stream.signal("wrench").values[usable]
    if len(stamps) < 2:
        return np.empty(0, dtype=np.int64), np.empty((0, 6))
    length = max(int(window_s * 1e9), int(stamps[-1] - stamps[0]) // _MOST_WINDOWS + 1)
    number = (stamps - stamps[0]) // length
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    count = np.diff(np.append(starts, len(stamps)))
    mean = np.add.reduceat(wrench, starts, axis=0) / count[:, None]
    middle = stamps[starts] + (np.add.reduceat(stamps - stamps[0], starts) // count - (stamps[starts] - stamps[0]))
    return middle.astype(np.int64), mean


def _fitted(at_ns: IntArray, wrench: FloatArray, link_R_support: FloatArray, moved: FloatArray) -> GravityFit:
    n = len(at_ns)
    force, moment = wrench[:, :3], wrench[:, 3:]
    ideal = np.concatenate([link_R_support, moved[:, :, None], np.broadcast_to(np.eye(3), (n, 3, 3))], axis=2)
    ideal = ideal.reshape(3 * n, 7)
    exact = _robust_fit(ideal, force.reshape(-1))
    load = (ideal[:, :4] @ exact[:4]).reshape(n, 3)
    design = np.hstack([ideal, _share_columns(load), _share_columns(moment - np.median(moment, axis=0))])
    noise = MAD_TO_DEVIATION * float(np.median(np.abs(force.reshape(-1) - ideal @ exact)))
    # rows of the prior distribution of the matrix: without them its errors are attributed to mass and direction
    expected = np.repeat([np.inf, CROSS_TALK, CROSS_TALK / LEVER_M], [7, 9, 9])
    for _ in range(2):  # the noise is the residual that the expected errors of the matrix do not explain
        prior = np.diag(max(noise, 1e-9) / expected)
        coefficients = _robust_fit(design, force.reshape(-1), prior)
        left = np.linalg.norm((force.reshape(-1) - design @ coefficients).reshape(n, 3), axis=1)
        noise = float(np.median(left)) / _MEDIAN_OF_NORM
    # the gain of the matrix and the weight are not separable: the size is that for a matrix of gain one
    size = float(np.linalg.norm(exact[:3])) / max(float(np.linalg.norm(coefficients[:3])), 1e-9)
    weight = size * coefficients[:3]
    tolerance = max(_DEVIATIONS * noise, LARGE_SHARE * float(np.linalg.norm(weight)))
    rows = np.vstack([design[np.repeat(left <= tolerance, 3)], prior])
    covariance = np.linalg.pinv(rows.T @ rows) * noise**2
    return GravityFit(
        stamp_ns=at_ns,
        weight=weight,
        inertia=float(size * coefficients[3]),
        inertia_deviation=float(size * np.sqrt(covariance[3, 3])),
        left=left,
        load=link_R_support @ weight,
        tolerance=float(tolerance),
    )


def _share_columns(values: FloatArray) -> FloatArray:
    """Columns of the shares of each value in each of three components; shape (3 n, 9)."""
    return np.einsum("ij,nk->nijk", np.eye(3), values).reshape(3 * len(values), 9)


def _robust_fit(design: FloatArray, force: FloatArray, prior: FloatArray | None = None) -> FloatArray:
    """Coefficients by Cauchy's weights, which few large errors hardly change; rows of the prior keep their weight."""
    scale = np.maximum(np.abs(design).max(axis=0), 1e-9)
    scaled: FloatArray = design / scale
    prior_rows = np.empty((0, design.shape[1])) if prior is None else prior / scale
    target = np.append(force, np.zeros(len(prior_rows)))
    weights = np.ones(len(force))
    coefficients = np.zeros(design.shape[1])
    for _ in range(_ROUNDS):
        rows = np.vstack([weights[:, None] * scaled, prior_rows])
        coefficients = np.linalg.lstsq(rows, np.append(weights, np.ones(len(prior_rows))) * target, rcond=None)[0]
        residual = scaled @ coefficients - force
        noise = max(MAD_TO_DEVIATION * float(np.median(np.abs(residual))), 1e-9)
        weights = 1.0 / np.sqrt(1.0 + (residual / noise) ** 2)
    return coefficients / scale


def free_intervals(stamp_ns: IntArray, free: BoolArray) -> list[tuple[int, int]]:
    """Find intervals without an apparent contact.

    Args:
        stamp_ns: Instants, in order; shape (n,); ns.
        free: Whether there is no apparent contact; shape (n,).

    Returns:
        First and last instant of every interval that is long enough; ns.
    """
    if len(stamp_ns) < 2:
        return []
    step = float(np.median(np.diff(stamp_ns)))
    breaks = np.flatnonzero(np.diff(stamp_ns) > 5.0 * step) + 1
    runs: list[tuple[int, int]] = []
    for segment in np.split(np.arange(len(stamp_ns)), breaks):
        for a, b in true_runs(free[segment]):
            early, late = (0 if edge else int(MARGIN_S * 1e9) for edge in (a == 0, b == len(segment) - 1))
            runs.append((int(stamp_ns[segment[a]]) + early, int(stamp_ns[segment[b]]) - late))
    return [(first, last) for first, last in runs if last - first >= SHORTEST_S * 1e9]


def joint_speed(recording: Recording, at_ns: IntArray) -> FloatArray | None:
    """Compute the speed of the fastest joint at given instants.

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
