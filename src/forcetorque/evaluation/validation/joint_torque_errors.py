# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques that depend on a sensor, and their errors by its calibrations under test (thesis 2.4.3)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, names, require_shape
from forcetorque.base.errors import RobotError, ShapeError, known_names
from forcetorque.base.noise.window_means import joined_times, mean_error
from forcetorque.base.pose import invert_pose
from forcetorque.evaluation.validation.contact_wrenches import add_segments
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import CalibrationUnderTest
from forcetorque.experiment.free_sub_model import FreeSubModel, OtherSensors
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, EvaluatedInstants, LeftOut, Offset
from forcetorque.recording.alignment import interpolate, require_overlap, seconds_since
from forcetorque.recording.recording import Interval
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row, Shown
from forcetorque.robot.dynamics import body_poses
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.sub_models import sub_models
from forcetorque.robot.tree import BodyTree, Connection, outboard_bodies


def joints_of_sensor(
    tree: BodyTree, sensor: str, *, cut_at: Sequence[str], contact: str | None = None
) -> dict[str, float]:
    """Find the joints whose estimated torque depends on what a sensor reads.

    Args:
        tree: The robot.
        sensor: One of the sensors that it is cut at.
        cut_at: Sensors that it is cut at.
        contact: Link on which the contact of its sub-model is taken to be; that of every other sub-model is at its
            base, so on the root link or just outboard of the sensor at the base.

    Returns:
        Joints in the order of the tree, with the sign of what they bear: 1 where the contact beyond the sensor is
        outboard of the joint, -1 where that on the sensor's inner side is.

    Raises:
        RobotError: If the tree has no such link, or is not cut at that sensor.
    """
    if contact is not None and contact not in tree.frames:
        raise RobotError(f"contact: no link {contact!r}; {known_names(contact, tree.frames)}")
    if sensor not in cut_at:
        raise RobotError(f"cut_at: expected the sensor {sensor!r} among the cuts, got {tuple(cut_at)}")
    touched = None if contact is None else tree.frames[contact][0]
    near = far = 0  # both sides of a cut are found
    for part in sub_models(tree, cut_at):
        at = touched if touched is not None and touched in part.bodies else part.base
        if part.sensor == sensor:
            far = at
        elif sensor in part.outboard_sensors:
            near = at
    signs = {}
    for index, body in enumerate(tree.bodies):
        outboard = outboard_bodies(tree, index)
        if body.joint is not None and outboard[far] != outboard[near]:
            signs[body.joint] = 1.0 if outboard[far] else -1.0
    return signs


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueMap(ArrayRecord):
    """Joint torques per unit of a sensor's reading, over n samples: the transposed Jacobian of the sensor."""

    sensor: str
    """Sensor."""
    joints: tuple[str, ...] = field(metadata=names("k"))
    """Joints whose torque depends on it."""
    rows: FloatArray = field(metadata=array(None, "k", 6))
    """Torque per component of the reading, in its frame and direction; shape (n, joints, 6); m and 1, where prismatic
    1 and 1/m."""

    def torques(self, wrench: Any) -> FloatArray:
        """Give what a wrench in place of, or on top of, a reading adds to the torques.

        Args:
            wrench: Change of the reading, in its frame and direction; shape (n, 6); N, N m; NaN in gaps.

        Returns:
            Change of the torques along +q; shape (n, joints); N m, N where prismatic.
        """
        wrenches = np.asarray(wrench, dtype=np.float64)
        require_shape(wrenches, name="wrench", shape=(len(self.rows), 6))
        return np.einsum("nji,ni->nj", self.rows, wrenches)


def torque_map(
    tree: BodyTree, joints: JointMotion, sensor: str, *, cut_at: Sequence[str], contact: str | None = None
) -> TorqueMap:
    """Find how joint torques depend on the reading of a sensor.

    Args:
        tree: The robot.
        joints: Motion of at least the joints from the root to the sensor, and to the contact; n samples.
        sensor: One of the sensors that it is cut at.
        cut_at: Sensors that it is cut at.
        contact: Link on which the contact of its sub-model is taken to be, as in `joints_of_sensor`.

    Returns:
        The map of the joints that depend on it.
    """
    signs = joints_of_sensor(tree, sensor, cut_at=cut_at, contact=contact)
    cut = tree.cuts[sensor]
    rows = np.zeros((len(joints), len(signs), 6))
    moving = {index: body for index, body in enumerate(tree.bodies) if body.joint in signs}
    root_H_body = body_poses(tree, joints, (cut.body, *moving))
    root_H_sensor = root_H_body[cut.body] @ cut.body_H_sensor
    for column, (index, body) in enumerate(moving.items()):
        body_H_sensor = invert_pose(root_H_body[index]) @ root_H_sensor
        x, y, z = (body_H_sensor[:, axis, :3] for axis in range(3))  # rows of body_R_sensor
        if body.connection is Connection.PRISMATIC:
            rows[:, column, :3] = z
        else:  # moment about the body's z: z . R m + z . (p x R f)
            rows[:, column, :3] = body_H_sensor[:, 0, 3, None] * y - body_H_sensor[:, 1, 3, None] * x
            rows[:, column, 3:] = z
        rows[:, column] *= cut.sign * signs[str(body.joint)]
    return TorqueMap(sensor=sensor, joints=tuple(signs), rows=rows)


class TorqueErrors(Row):
    """Statistics of n errors of one joint's torque, pooled before anything is averaged; N m, N where prismatic."""

    samples: Annotated[int, Shown("samples")]
    """Number of samples without a gap."""
    rmse: Annotated[float, Shown("RMSE", digits=3, error="rmse_half_width_95")]
    """Root mean square error."""
    rmse_error: float | None
    """Standard error of that root; None for one sample."""
    rmse_half_width_95: float | None
    """Half-width of its 95 % interval; None where the samples do not determine it."""
    mean: Annotated[float, Shown("mean", digits=3, error="mean_half_width_95")]
    """Mean error."""
    mean_error: float | None
    """Standard error of that mean; None for one sample."""
    mean_half_width_95: float | None
    """Half-width of its 95 % interval; None where the samples do not determine it."""
    largest: Annotated[float, Shown("largest", digits=3)]
    """Largest absolute error."""


def torque_errors(errors: Any, time_s: Any) -> TorqueErrors:
    """Sum up the errors of one joint's torque.

    Args:
        errors: Errors in the order of time; shape (n,); samples with a gap (NaN) are left out.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Their statistics.

    Raises:
        ShapeError: If the shape is another, or every sample has a gap.
    """
    samples = np.asarray(errors, dtype=np.float64)
    require_shape(samples, name="errors", shape=(None,))
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name="time_s", shape=(len(samples),))
    complete = ~np.isnan(samples)
    whole = samples[complete]
    if not len(whole):
        raise ShapeError(f"errors: expected at least one sample without a gap, got none among {len(samples)}")
    square = float(np.mean(whole**2))
    rmse = float(np.sqrt(square))
    known = mean_error(np.column_stack([whole, whole**2]), time[complete])
    (error, square_error), (half, square_half) = known.standard_error, known.half_width
    slope = 0.5 / rmse if rmse > 0.0 else 0.0  # d sqrt(m) = dm / (2 sqrt(m))
    return TorqueErrors(
        samples=len(whole),
        rmse=rmse,
        rmse_error=finite_or_none(slope * float(square_error)) if rmse > 0.0 else 0.0,
        rmse_half_width_95=finite_or_none(slope * float(square_half)) if rmse > 0.0 else 0.0,
        mean=float(whole.mean()),
        mean_error=finite_or_none(float(error)),
        mean_half_width_95=finite_or_none(float(half)),
        largest=float(np.abs(whole).max()),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueScheme:
    """What is estimated over one interval, from which sensors."""

    tree: BodyTree
    """The robot, seen from the support."""
    cut_at: tuple[str, ...]
    """Sensors at which it is cut."""
    contact: str | None
    """Link of the free sub-model that takes up its contact wrench; None for that at its base."""
    joints: tuple[str, ...]
    """Joints that depend on the evaluated sensor and can be evaluated."""
    sensors: tuple[str, ...]
    """Sensors whose error is in their torques; the judged one first."""
    logged: tuple[str, ...]
    """Those of the joints whose torque was logged and can be computed by the model."""
    question: Question
    """What the model is asked: the expected readings of these sensors, and the torques to compare with logged ones."""
    motion: tuple[str, ...]
    """Joints whose motion is needed."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, in words."""


def torque_scheme(free: FreeSubModel, interval: Interval) -> TorqueScheme:
    """Decide which torques are evaluated in an interval.

    Args:
        free: The free sub-model of the evaluated sensor.
        interval: The interval.

    Returns:
        The joints, and what is needed for them.

    Raises:
        ExperimentError: If the interval has no support.
    """
    sub_model, recording = free.seen_from_support(interval), free.run.experiment.recording
    tree, cut_at, sensor = sub_model.tree, tuple(sub_model.cut_at or ()), sub_model.sensor
    available = set(recording.joint_signals("position"))
    names = cut_at if free.choice.other_sensors is OtherSensors.MEASURED else (sensor,)
    loaded = {name: joints_of_sensor(tree, name, cut_at=cut_at, contact=free.choice.contact) for name in names}
    joints, sensors, left_out = [], [sensor], []
    for joint in loaded[sensor]:
        readers = tuple(name for name in names if joint in loaded[name])
        missing = _missing(Question(tree=tree, expected=readers, equations=()), available)
        if missing:
            words = f"no stream holds the joint(s) {', '.join(missing)}"
            left_out.append(f"torque of {joint}, from what is expected of {', '.join(readers)}: {words}")
        else:
            joints.append(joint)
            sensors += [name for name in readers if name not in sensors]
    in_log = recording.joint_signals("torque")
    logged = tuple(
        joint
        for joint in joints
        if joint in in_log and not _missing(Question(tree=tree, torques=(joint,), equations=()), available)
    )
    question = Question(tree=tree, expected=tuple(sensors), torques=logged, equations=())
    return TorqueScheme(
        tree=tree,
        cut_at=cut_at,
        contact=free.choice.contact,
        joints=tuple(joints),
        sensors=tuple(sensors),
        logged=logged,
        question=question,
        motion=tuple(dict.fromkeys((*sub_model.required_joints, *required_joints_of(question)))),
        left_out=tuple(left_out),
    )


def _missing(question: Question, available: set[str]) -> list[str]:
    return [joint for joint in required_joints_of(question) if joint not in available]


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueKey:
    """Whose torque is evaluated, and with which offset."""

    candidate: int
    """Place of the candidate: a calibration may be called `prior` too."""
    offset: Offset
    """Offset that is asked for."""
    joint: str
    """Joint."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueSamples:
    """Errors of one joint's torque; N m, N where prismatic; NaN in gaps."""

    from_model: FloatArray
    """Estimated torque less that of the rigid-body model; shape (n,)."""
    from_logged: FloatArray
    """Estimated torque less the logged one, over the intervals in which there is one; shape (m,)."""
    time_s: FloatArray
    """Instants of the former since the start of the recording; shape (n,); s."""
    logged_time_s: FloatArray
    """Instants of the latter; shape (m,); s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueErrorSamples:
    """Errors of the torques that depend on one sensor, over all validation intervals, in the order of time."""

    candidates: tuple[CalibrationUnderTest, ...]
    """The candidates."""
    samples: Mapping[TorqueKey, TorqueSamples]
    """The errors."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, or to evaluate in an interval, in words."""


def torque_error_samples(free: FreeSubModel, calibrations: Mapping[str, Calibration]) -> TorqueErrorSamples:
    """Estimate the torques of the joints that depend on a sensor by every candidate, and compare with the model.

    Args:
        free: The free sub-model of the sensor; the validation intervals are used.
        calibrations: Calibrations of the sensor by name.

    Returns:
        Errors with the candidate's own offset and with that of each interval's first second.

    Raises:
        ExperimentError: If an interval has no support.
    """
    rows = TorqueRows(free.whole.candidates(calibrations))
    add_segments(free, rows)
    return rows.samples()


class TorqueRows:
    """Errors of joint torques of a recording whose segments come one after the other."""

    def __init__(self, candidates: tuple[CalibrationUnderTest, ...]) -> None:
        """Begin.

        Args:
            candidates: By what the sensor is read.
        """
        self._candidates = candidates
        self._pieces: dict[TorqueKey, list[TorqueSamples]] = {}
        self._left_out = LeftOut()

    def add(self, free: FreeSubModel) -> None:
        """Evaluate the next segment.

        Args:
            free: The sub-model in the segment.

        Raises:
            ExperimentError: If an interval has no support.
        """
        for interval, instants in free.instants():
            with stated_in(f"interval {interval.label!r}"):
                scheme = torque_scheme(free, interval)
                self._left_out.add(scheme.left_out)
                if not self._left_out.is_short(instants, interval) and scheme.joints:
                    over = dict(_over(free, interval, instants, scheme, self._candidates))
                    for key, samples in over.items():
                        self._pieces.setdefault(key, []).append(samples)
                    for what, judged in _judged(self._candidates, over):
                        self._left_out.add_errors(what, interval, judged)

    def samples(self) -> TorqueErrorSamples:
        """Put them together.

        Returns:
            The errors of all segments.
        """
        return TorqueErrorSamples(
            candidates=self._candidates,
            samples=_joined(self._pieces, np.concatenate),
            left_out=self._left_out.texts(),
        )


def pooled_torque_errors(recordings: Mapping[str, TorqueErrorSamples]) -> TorqueErrorSamples:
    """Put together what several recordings say.

    Args:
        recordings: Errors by name of the recording, candidates in the same order.

    Returns:
        All of them, one recording after the other; the same where there is one.
    """
    first = next(iter(recordings.values()))
    if len(recordings) == 1:
        return first
    pieces: dict[TorqueKey, list[TorqueSamples]] = {}
    for torques in recordings.values():
        for key, samples in torques.samples.items():
            pieces.setdefault(key, []).append(samples)
    return TorqueErrorSamples(
        candidates=first.candidates,
        samples=_joined(pieces, joined_times),
        left_out=tuple(f"{name}: {words}" for name, torques in recordings.items() for words in torques.left_out),
    )


def _joined(
    pieces: Mapping[TorqueKey, Sequence[TorqueSamples]], instants: Callable[[Sequence[FloatArray]], FloatArray]
) -> dict[TorqueKey, TorqueSamples]:
    """Put errors that follow each other together; torques of the same instants share them."""
    known: dict[tuple[int, ...], FloatArray] = {}

    def joined(times: Sequence[FloatArray]) -> FloatArray:
        key = tuple(map(id, times))
        return known[key] if key in known else known.setdefault(key, instants(times))

    return {
        key: TorqueSamples(
            from_model=np.concatenate([one.from_model for one in own]),
            from_logged=np.concatenate([one.from_logged for one in own]),
            time_s=joined([one.time_s for one in own]),
            logged_time_s=joined([one.logged_time_s for one in own]),
        )
        for key, own in pieces.items()
    }


def _over(
    free: FreeSubModel,
    interval: Interval,
    instants: EvaluatedInstants,
    scheme: TorqueScheme,
    candidates: Sequence[CalibrationUnderTest],
) -> Iterator[tuple[TorqueKey, TorqueSamples]]:
    """Errors of every calibration, offset and joint over one interval, after its first second."""
    run, sensor = free.run, free.run.sensor.name
    model, maps = _model(run, interval, scheme)
    own = [run.measured(interval, candidate.correction) - model.expected_of(sensor) for candidate in candidates]
    measured = free.measured(scheme.sensors[1:], interval)
    others = {name: wrench - model.expected_of(name) for name, wrench in measured.items()}
    logged = _logged(run, interval, scheme.logged)
    time = seconds_since(instants.judged_ns, run.experiment.recording.start_ns)
    for offset in KNOWN_BEFORE:
        by_others = np.zeros((len(instants.at_ns), len(scheme.joints)))
        for name, error in others.items():
            by_others += _borne(scheme, maps[name], instants.with_offset(error, offset, ("torque", name)))
        for candidate, error in enumerate(own):
            known = instants.with_offset(error, offset, ("torque", candidate))
            borne = by_others + _borne(scheme, maps[sensor], known)
            for joint, torque in zip(scheme.joints, borne.T, strict=True):
                off = torque + model.torque(joint) - logged[joint] if joint in logged else None
                yield (
                    TorqueKey(candidate=candidate, offset=offset, joint=joint),
                    TorqueSamples(
                        from_model=instants.judged(torque[:, None])[:, 0],
                        from_logged=np.empty(0) if off is None else instants.judged(off[:, None])[:, 0],
                        time_s=time,
                        logged_time_s=np.empty(0) if off is None else time,
                    ),
                )


def _judged(
    candidates: Sequence[CalibrationUnderTest], over: Mapping[TorqueKey, TorqueSamples]
) -> Iterator[tuple[str, dict[Offset, FloatArray]]]:
    """Every torque by every candidate, in words, and its errors with either offset."""
    by_offset: dict[tuple[str, int], dict[Offset, FloatArray]] = {}
    for key, samples in over.items():
        by_offset.setdefault((key.joint, key.candidate), {})[key.offset] = samples.from_model
    for (joint, candidate), judged in by_offset.items():
        yield f"torque of {joint} by {candidates[candidate].name}", judged


def _model(run: SensorRun, interval: Interval, scheme: TorqueScheme) -> tuple[Estimates, dict[str, TorqueMap]]:
    """What the model expects, and how the torques depend on each sensor."""
    joints, root = run.motion(interval, scheme.motion)
    maps = {
        name: torque_map(scheme.tree, joints, name, cut_at=scheme.cut_at, contact=scheme.contact)
        for name in scheme.sensors
    }
    return estimate(scheme.question, joints, root), maps


def _logged(run: SensorRun, interval: Interval, joints: Sequence[str]) -> dict[str, FloatArray]:
    signals, at_ns = run.experiment.recording.joint_signals("torque"), run.instants(interval).at_ns
    torques = {}
    for joint in joints:
        stream, signal = signals[joint]
        require_overlap(run.stream, stream)
        torques[joint] = interpolate(stream, signal.column(joint)[:, None], at_ns)[:, 0]
    return torques


def _borne(scheme: TorqueScheme, map_of: TorqueMap, error: FloatArray) -> FloatArray:
    """Torques of the evaluated joints by the error of one sensor; shape (n, joints)."""
    torques = dict(zip(map_of.joints, map_of.torques(error).T, strict=True))
    none = np.zeros(len(error))
    return np.stack([torques.get(joint, none) for joint in scheme.joints], axis=1)
