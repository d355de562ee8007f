# SPDX-License-Identifier: BSD-3-Clause
"""Faults of an experiment file, URDF or log that may explain why a sensor does not measure what is expected.

Each is one change of the expected wrench: of what the log makes of it (sense, columns, unit, mount, gain), of the robot
model (gravity, joints) or of time. Parameters of a fault are fitted with the errors of the matrix integrated out.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import Final, Literal, TypeAlias

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.pose import skew
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.inspection.plausibility.evidence import Evidence, Fit
from forcetorque.robot.mounting import nearest_rotation, rotation_by, rotation_vector

FaultKind = Literal[
    "reversed",
    "component_reversed",
    "gravity",
    "mass",
    "joint_sign",
    "joint_offset",
    "joint_unit",
    "columns",
    "moment_unit",
    "delay",
    "mount",
]
"""What may be wrong."""

_MOMENT_UNITS: Final = {"N mm": 1e3, "kN m": 1e-3, "N cm": 1e2, "kgf cm": 10.197162, "lbf in": 8.8507458}
"""Units of moments, in what one N m is in each."""
Changes: TypeAlias = Mapping[str, tuple[float, float]]
"""Factor and shift of joint positions, by the name of the joint; shifts in rad."""
_AXES = np.vstack([np.eye(3), -np.eye(3)])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Explanation(ArrayRecord):
    """The expected wrench if something is wrong."""

    kind: FaultKind
    """What is wrong."""
    about: str
    """Joint, stream or components that it is about; empty for the whole sensor."""
    expected: FloatArray = field(metadata=array("n", 6))
    """Expected wrenches before `turn`; shape (n, 6); N, N m."""
    turn: FloatArray = field(metadata=array(6, 6))
    """What the log makes of the wrench that the sensor feels; shape (6, 6)."""
    fit: Fit
    """How well it explains the measurements."""
    value: float | None = None
    """Its parameter: gain, angle in rad, delay in s, or factor; None for a fault without one."""
    half_width: float | None = None
    """Half of the 95 % interval of the parameter; None for none."""
    vector: FloatArray | None = None
    """Direction of gravity, or axis of the turn; shape (3,); None for neither."""
    parameters: int = 0
    """Number of fitted parameters."""

    @property
    def changes_every_instant_alike(self) -> bool:
        """Whether `turn` is all that it changes, so that the rest of the log can be compared beside it."""
        return self.kind in ("reversed", "component_reversed", "columns", "moment_unit", "mass", "mount")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Robot:
    """What the robot model expects if something of it is changed, at the n compared instants."""

    joints: tuple[str, ...]
    """Joints that the expected wrench depends on, and that turn."""
    with_joints: Callable[[Sequence[Changes]], FloatArray]
    """Expected wrenches by each of k changes of joints; shape (k, n, 6); N, N m."""
    gravity_direction: FloatArray | None
    """Direction in which things fall, in the axes of the support; shape (3,); None where an IMU measures it."""
    with_gravity: Callable[[FloatArray], FloatArray]
    """Expected wrenches by each of k directions of gravity, shape (k, 3); shape (k, n, 6); N, N m."""
    joint_streams: tuple[str, ...]
    """Streams that hold these joints."""
    with_delay: Callable[[str | None, Sequence[float]], FloatArray]
    """Expected wrenches by stream of joints (None for all) and each of k delays in s; shape (k, n, 6); N, N m."""
    longest_delay_s: float
    """Largest delay that is looked for; s; 0 for none."""
    shortest_delay_s: float
    """Least delay that samples resolve; s."""


def explanations(
    evidence: Evidence,
    expected: FloatArray,
    robot: Robot | None,
    *,
    is_raw: bool,
    only: Collection[tuple[FaultKind, str]] | None = None,
) -> Iterator[Explanation]:
    """Explain measurements by each fault alone.

    Args:
        evidence: The measurements.
        expected: Expected wrenches by the model as it is; shape (n, 6); N, N m.
        robot: What the robot model expects if it is changed; None where known wrenches stand in for it.
        is_raw: Whether the sensor logs raw channels, which may be swapped in place of components.
        only: Kinds of faults and what they are about, to fit these again; None for all.

    Yields:
        Explanations; those of faults that have a parameter with the best one.
    """
    kinds = None if only is None else {kind for kind, _ in only}
    yield from _of_log(evidence, expected, is_raw=is_raw)
    yield from _gain(evidence, expected)
    yield _mount(evidence, expected)
    if robot is None:
        return
    if kinds is None or "gravity" in kinds:
        yield from _of_gravity(evidence, robot)
    yield from _of_joints(evidence, expected, robot, only)
    if kinds is None or "delay" in kinds:
        yield from _of_time(evidence, robot)


def senses(evidence: Evidence, expected: FloatArray) -> Iterator[Explanation]:
    """Explain measurements by a reversed sense of the sensor, of force or moment, or of a component.

    Args:
        evidence: The measurements.
        expected: Expected wrenches; shape (n, 6); N, N m.

    Yields:
        Explanations.
    """
    yield _linear(evidence, expected, "reversed", "", -np.eye(6))
    for about, places in (
        ("force", range(3)),
        ("moment", range(3, 6)),
        *((WRENCH_COMPONENTS[k], (k,)) for k in range(6)),
    ):
        sign = np.ones(6)
        sign[list(places)] = -1.0
        yield _linear(evidence, expected, "component_reversed", about, np.diag(sign))


def _linear(
    evidence: Evidence, expected: FloatArray, kind: FaultKind, about: str, turn: FloatArray, value: float | None = None
) -> Explanation:
    return Explanation(
        kind=kind, about=about, expected=expected, turn=turn, fit=evidence.fit(expected, turn), value=value
    )


def _of_log(evidence: Evidence, expected: FloatArray, *, is_raw: bool) -> Iterator[Explanation]:
    yield from senses(evidence, expected)
    for own in FORCE_AND_MOMENT:
        places = list(range(6))[own]
        for a, b in combinations(places, 2):
            yield _permuted(
                evidence, expected, f"{WRENCH_COMPONENTS[a]} and {WRENCH_COMPONENTS[b]} are swapped", {a: b, b: a}
            )
        for shift in (1, 2):
            order = dict(zip(places, places[shift:] + places[:shift], strict=True))
            listed = ", ".join(WRENCH_COMPONENTS[order[k]] for k in places)
            yield _permuted(
                evidence, expected, f"{listed} stand in the columns of {', '.join(WRENCH_COMPONENTS[own])}", order
            )
    yield _permuted(evidence, expected, "moment before force", {k: (k + 3) % 6 for k in range(6)})
    prior = evidence.prior
    if is_raw and prior.shape == (6, 6):
        inverse = np.linalg.inv(prior)
        for a, b in combinations(range(6), 2):
            swapped = np.eye(6)
            swapped[[a, b]] = swapped[[b, a]]
            yield _linear(evidence, expected, "columns", f"ch{a} and ch{b} are swapped", prior @ swapped @ inverse)
    for about, factor in _MOMENT_UNITS.items():
        turn = np.diag(np.repeat([1.0, factor], 3))
        yield _linear(evidence, expected, "moment_unit", about, turn, value=factor)


def _permuted(evidence: Evidence, expected: FloatArray, about: str, order: dict[int, int]) -> Explanation:
    turn = np.eye(6)[[order.get(k, k) for k in range(6)]]
    return _linear(evidence, expected, "columns", about, turn)


def _gain(evidence: Evidence, expected: FloatArray) -> Iterator[Explanation]:
    """Masses, or the prior matrix, are wrong by one factor; one below 0 is a reversed sense."""
    gain, fit = 1.0, evidence.fit(expected, None, expected[:, :, None])
    for _ in range(2):
        gain += float(fit.step[0])
        fit = evidence.fit(expected, gain * np.eye(6), expected[:, :, None])
    if gain > 0.0:
        yield Explanation(
            kind="mass",
            about="",
            expected=expected,
            turn=gain * np.eye(6),
            fit=fit,
            value=gain,
            half_width=_half_width(fit),
            parameters=1,
        )


def _linear_gain(fit: Fit) -> float:
    """Gain in evidence of the step of one parameter, by its linear effect."""
    variance = float(fit.covariance[0, 0])
    return float(fit.step[0]) ** 2 / (2.0 * variance) if variance > 0.0 else 0.0


def _half_width(fit: Fit) -> float:
    return 1.96 * float(np.sqrt(fit.covariance[0, 0]))


def _mount(evidence: Evidence, expected: FloatArray) -> Explanation:
    """The frame of the sensor is turned: the best rotation by Procrustes, then with errors of the matrix."""
    middle = np.median(expected, axis=0), np.median(evidence.measured, axis=0)
    correlation = np.zeros((3, 3))
    for own in FORCE_AND_MOMENT:
        scaled = (evidence.measured[:, own] - middle[1][own]) / evidence.size[own] ** 2
        correlation += (evidence.weights[:, None] * scaled).T @ (expected[:, own] - middle[0][own])
    rotation = nearest_rotation(correlation)
    for _ in range(3):
        turn: FloatArray = np.asarray(np.kron(np.eye(2), rotation), dtype=np.float64)
        turned = expected @ turn.T
        # exp(d) w = w + d x w
        columns = np.stack(
            [np.hstack([turned[:, own] @ skew(axis).T for own in FORCE_AND_MOMENT]) for axis in np.eye(3)], axis=2
        )
        fit = evidence.fit(expected, turn, columns)
        rotation = rotation_by(np.clip(fit.step, -0.3, 0.3)) @ rotation
    turn = np.asarray(np.kron(np.eye(2), rotation), dtype=np.float64)
    fit = evidence.fit(expected, turn, columns)
    vector = -rotation_vector(rotation)  # components of a wrench turn against the axes of the sensor
    angle = float(np.linalg.norm(vector))
    axis = vector / angle if angle > 0.0 else np.array([0.0, 0.0, 1.0])
    if axis[np.argmax(np.abs(axis))] < 0.0:  # 10 deg about -z are -10 deg about z
        angle, axis = -angle, -axis
    return Explanation(
        kind="mount",
        about="",
        expected=expected,
        turn=turn,
        fit=fit,
        value=angle,
        half_width=1.96 * float(np.sqrt(np.einsum("i,ij,j", axis, fit.covariance, axis))),
        vector=axis,
        parameters=3,
    )


def _of_gravity(evidence: Evidence, robot: Robot) -> Iterator[Explanation]:
    """Gravity along another axis of the support, or tilted."""
    if robot.gravity_direction is None:
        return
    specified = robot.gravity_direction
    # expected wrenches are affine in gravity, so four directions give those of all
    plus_minus = robot.with_gravity(np.vstack([np.eye(3), -np.eye(3)[:1]]))
    moved = (plus_minus[0] + plus_minus[3]) / 2.0
    along = np.moveaxis(plus_minus[:3] - moved, 0, 2)
    for axis in _AXES:
        if axis @ specified < 0.99:
            yield _down(evidence, robot, axis, moved + along @ axis, None, None)
    first = evidence.fit(moved, None, along).step
    down = first / max(float(np.linalg.norm(first)), 1e-9)
    for _ in range(2):
        tangent = np.linalg.svd(down[None])[2][1:].T
        fit = evidence.fit(moved + along @ down, None, along @ tangent)
        down = down + tangent @ np.clip(fit.step, -0.3, 0.3)
        down /= np.linalg.norm(down)
    expected = moved + along @ down
    fit = evidence.fit(expected, None, along @ tangent)
    deviation = float(np.sqrt(max(float(np.linalg.eigvalsh(fit.covariance)[-1]), 0.0)))
    yield _down(evidence, robot, down, expected, 1.96 * deviation, fit)


def _down(
    evidence: Evidence,
    robot: Robot,
    down: FloatArray,
    expected: FloatArray,
    half_width: float | None,
    fit: Fit | None,
) -> Explanation:
    specified = np.zeros(3) if robot.gravity_direction is None else robot.gravity_direction
    return Explanation(
        kind="gravity",
        about="",
        expected=expected,
        turn=np.eye(6),
        fit=evidence.fit(expected) if fit is None else fit,
        value=float(np.arccos(np.clip(down @ specified, -1.0, 1.0))),
        half_width=half_width,
        vector=down,
        parameters=0 if half_width is None else 2,
    )


_ZERO_STEP = 1e-4
"""Step of the derivative by the zero of a joint; rad."""
_WORTH_A_PARAMETER = 8.0
"""Gain in evidence, by the linear effect, below which the zero of a joint or a delay is not fitted further."""
_FARTHEST_ZERO = 1.6
"""Largest error of the zero of a joint; rad."""
_UNIT_FACTORS: Final = {"degrees, read as radians": np.pi / 180.0, "radians, read as degrees": 180.0 / np.pi}
"""Factors that put joint positions in the wrong unit right."""


def _of_joints(
    evidence: Evidence, expected: FloatArray, robot: Robot, only: Collection[tuple[FaultKind, str]] | None
) -> Iterator[Explanation]:
    """Unit of all joints, and sense or zero of one; all expected wrenches in one evaluation of the robot model."""

    def wanted(kind: FaultKind, about: str) -> bool:
        return only is None or (kind, about) in only

    changes: dict[tuple[FaultKind, str], Changes] = {}
    for about, factor in _UNIT_FACTORS.items() if robot.joints else ():
        changes["joint_unit", about] = dict.fromkeys(robot.joints, (factor, 0.0))
    for joint in robot.joints:
        changes["joint_sign", joint] = {joint: (-1.0, 0.0)}
        changes["joint_offset", joint] = {joint: (1.0, _ZERO_STEP)}
    changes = {key: change for key, change in changes.items() if wanted(*key)}
    if not changes:
        return
    for (kind, about), changed in zip(changes, robot.with_joints(list(changes.values())), strict=True):
        if kind == "joint_offset":
            yield from _zero(evidence, expected, robot, about, (changed - expected) / _ZERO_STEP)
        else:
            yield _linear(evidence, changed, kind, about, np.eye(6), value=_UNIT_FACTORS.get(about))


def _zero(
    evidence: Evidence, expected: FloatArray, robot: Robot, joint: str, slope: FloatArray
) -> Iterator[Explanation]:
    """Zero of a joint; nothing where the linear effect of one explains hardly anything."""
    fit = evidence.fit(expected, None, slope[:, :, None])
    if _linear_gain(fit) < _WORTH_A_PARAMETER:
        return
    zero = 0.0
    for _ in range(3):
        zero = float(np.clip(zero + np.clip(fit.step[0], -0.5, 0.5), -_FARTHEST_ZERO, _FARTHEST_ZERO))
        expected, beside = robot.with_joints([{joint: (1.0, zero)}, {joint: (1.0, zero + _ZERO_STEP)}])
        fit = evidence.fit(expected, None, ((beside - expected) / _ZERO_STEP)[:, :, None])
    yield Explanation(
        kind="joint_offset",
        about=joint,
        expected=expected,
        turn=np.eye(6),
        fit=fit,
        value=zero,
        half_width=_half_width(fit),
        parameters=1,
    )


_LAGS, _LAGS_OF_STREAM = 10, 5
"""Steps from zero to the largest delay: of the sensor, and of one of several streams of joints."""
_LAG_STEP_S = 1e-3
"""Step of the derivative by a delay; s."""


def _of_time(evidence: Evidence, robot: Robot) -> Iterator[Explanation]:
    """The sensor, or one of several streams of joints, comes late."""
    if robot.longest_delay_s <= 0.0:
        return
    yield _late(evidence, robot, None, _LAGS)
    if len(robot.joint_streams) > 1:
        for stream in robot.joint_streams:
            yield _late(evidence, robot, stream, _LAGS_OF_STREAM)


def _late(evidence: Evidence, robot: Robot, stream: str | None, lags: int) -> Explanation:
    delays: Sequence[float] = np.linspace(-robot.longest_delay_s, robot.longest_delay_s, 2 * lags + 1).tolist()
    at_zero = evidence.fit(robot.with_delay(stream, [0.0])[0]).evidence
    likelihoods = [evidence.fit(delayed).evidence for delayed in robot.with_delay(stream, delays)]
    delay = delays[int(np.argmax(likelihoods))]
    for number in range(3):
        expected, later, earlier = robot.with_delay(stream, [delay, delay + _LAG_STEP_S, delay - _LAG_STEP_S])
        fit = evidence.fit(expected, None, ((later - earlier) / (2.0 * _LAG_STEP_S))[:, :, None])
        if number == 0 and fit.evidence + _linear_gain(fit) < at_zero + _WORTH_A_PARAMETER:
            break
        if number < 2:
            delay += float(np.clip(fit.step[0], -0.05, 0.05))
    return Explanation(
        kind="delay",
        about=stream or "",
        expected=expected,
        turn=np.eye(6),
        fit=fit,
        value=delay,
        half_width=_half_width(fit),
        parameters=1,
    )
