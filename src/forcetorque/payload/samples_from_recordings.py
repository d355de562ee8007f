# SPDX-License-Identifier: BSD-3-Clause
"""Means of measurements and motion under loads, of a wrist sensor and of loads on links of a robot.

The expected wrench of a sensor is linear in mass, first moment and inertia of a load on a link: the motion of the link
gives what each of the ten adds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.window_means import means_of_parts, means_over, window_for
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import reading_sign, wrench_matrix
from forcetorque.experiment.calibration.expected_sensor_errors import FLATTENED
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.long_recording import forget_recording, keep_quality, recorded_segments
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.identification.estimation_problem import INERTIAL, Load, LoadProblem, LoadRows
from forcetorque.payload.identification.measurement_model import inertial_columns
from forcetorque.payload.load_tables import Load as LoadTable
from forcetorque.recording.alignment import interpolate, seconds_since
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.robot.dynamics import body_poses, motion_of_link
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.measured_and_expected_wrench import LoggedRobot, Processing
from forcetorque.robot.mechanics.root_motion import support_motion_at
from forcetorque.robot.motion import JointMotion, RootMotion, blocks_of
from forcetorque.robot.tree import BodyTree, build_tree, joints_between, path_to_root

MOST_ROWS = 3600
"""Means of an interval, at most: an hour has means of 1 s, a day of half a minute."""


def weighing_readings(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval
) -> tuple[IntArray, FloatArray]:
    """Read a sensor in an interval, without samples that say nothing of its load or lie in an ignored interval.

    Args:
        experiment: The experiment, of which the recording is used.
        sensor: The sensor; raw counts are read by its prior.
        interval: The interval.

    Returns:
        Instants, shape (n,), ns; and wrenches, NaN in gaps, shape (n, 6), N, N m.

    Raises:
        ExperimentError: If there are raw counts and no prior.
    """
    sensor.require_six_components("the weighing of a load")
    stream = experiment.recording.stream(sensor.stream)
    inside = interval.holds(stream.stamp_ns) & ~sample_quality(experiment, sensor).unusable
    for other in experiment.recording.intervals:
        if other.use is Use.IGNORE:
            inside &= ~other.holds(stream.stamp_ns)
    reading = stream.signal(sensor.quantity).values[inside]
    if sensor.quantity == "raw":
        if sensor.prior is None:
            raise ExperimentError(
                f"sensor {sensor.name!r}: expected prior, a matrix that reads it roughly, without which nobody tells "
                "loads and matrix apart; or state mass_kg and centre_of_mass_m of every [[load]]"
            )
        reading = reading @ sensor.prior.T
    return stream.stamp_ns[inside], reading


def weighing_means(time_s: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Average the samples of an interval over windows in which noise is nearly white, and that are not too many.

    Args:
        time_s: Times; shape (n,); s.
        values: What is averaged; shape (n, k).

    Returns:
        Middles of the windows, shape (w,), s; means, shape (w, k); and the number of samples of each, shape (w,).
    """
    return means_over(time_s, values, _window_s(time_s))


def _window_s(time_s: FloatArray) -> float:
    length = float(time_s[-1] - time_s[0]) if len(time_s) else 0.0
    return max(window_for(time_s), length / MOST_ROWS)


_ENDS = np.cumsum([6, 3, 1, 3, 9, 9])
"""Last columns of wrench, proper acceleration and its size, angular acceleration, products of the angular velocity,
orientation."""
_MOTION_END = int(_ENDS[4])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _IntervalMeans:
    """Means over windows of one interval."""

    time_s: FloatArray
    """Middles of the windows; shape (w,); s."""
    means: FloatArray
    """Means of all columns that a problem needs, variables of the sensor last; shape (w, k)."""
    counts: IntArray
    """Samples of each window; shape (w,)."""
    names: tuple[str, ...]
    """Name of each window, for messages."""
    left_out: int
    """Samples of the interval that lack a value."""


def load_problem(
    experiment: Experiment,
    sensor: ExperimentSensor,
    table: LoadTable,
    loads: tuple[Load, ...],
    supports: Sequence[MovingSupport],
    *,
    use: Use = Use.CALIBRATION,
) -> LoadProblem:
    """Set up the estimation of the loads on a wrist sensor, and of its bias in every power cycle.

    Args:
        experiment: The experiment, of which the recording and its intervals are used.
        sensor: The sensor.
        table: What the file specifies of the sensor under its loads.
        loads: The loads.
        supports: Support of the intervals of each load.
        use: Use of the intervals.

    Returns:
        The problem, without samples that lack a value or lie in an ignored interval.

    Raises:
        ExperimentError: If there is no such interval, the sensor has raw readings and no prior, or nothing is left.
    """
    intervals = sorted(experiment.intervals(use), key=lambda interval: interval.start_ns)
    segments = _segments(experiment, sensor)
    blocks = [_wrist_means(experiment, segments, sensor, interval) for interval in intervals]
    if not sum(len(block.time_s) for block in blocks):
        raise ExperimentError(
            f'sensor {sensor.name!r}: expected samples in an interval with use = "{use}", with a reading and a '
            "motion; the streams have gaps or missing values all over it"
        )
    names = [experiment.session_names(interval.label)[-1] for interval in intervals]
    sessions = tuple(dict.fromkeys(names))
    lengths = [len(block.time_s) for block in blocks]
    means = np.concatenate([block.means for block in blocks])
    wrench, acceleration, size, turning, products, turned, values = np.split(means, _ENDS, axis=1)
    variables = tuple(f"{one.linear.name} ({one.linear.unit})" for one in sensor.variables)
    turns = bool(turning.any() or products.any())
    usual = np.median(np.concatenate([block.counts for block in blocks]))
    rows = LoadRows(
        wrench=wrench,
        proper_acceleration=acceleration,
        acceleration_size=size[:, 0],
        angular_velocity_products=products.reshape(-1, 3, 3) if turns else None,
        angular_acceleration=turning if turns else None,
        time_s=np.concatenate([block.time_s for block in blocks]),
        session=np.repeat([sessions.index(name) for name in names], lengths),
        block=np.repeat(np.arange(len(blocks)), lengths),
        load=np.repeat([load_number(interval.support, supports) for interval in intervals], lengths),
        share=np.concatenate([block.counts for block in blocks]) / usual,
        variables=values if variables else None,
        orientation=turned.reshape(-1, 3, 3) if np.isfinite(turned).all() else None,
        names=tuple(name for block in blocks for name in block.names),
    )
    return LoadProblem(
        rows=rows,
        loads=loads,
        sessions=sessions,
        blocks=tuple(interval.label for interval in intervals),
        direction=table.measure_direction,
        drift=table.drift,
        mount=table.mount is not None or sensor.mount_is_unknown,
        tilt=table.tilt is not None,
        variables=variables,
    )


def load_number(support: Support | MovingSupport | None, supports: Sequence[MovingSupport]) -> int:
    """Find the load of an interval by its support.

    Args:
        support: Support of the interval.
        supports: Support of the intervals of each load.

    Returns:
        Index of the load; 0 where there is one only.
    """
    return next((number for number, other in enumerate(supports) if other is support), 0)


def samples_left_out(experiment: Experiment, sensor: ExperimentSensor) -> int:
    """Count samples of the calibration intervals that lack a finite reading or motion.

    Returns:
        Their number.
    """
    segments = _segments(experiment, sensor)
    return sum(
        int((~np.isfinite(columns[:, :_MOTION_END]).all(axis=1)).sum())
        for interval in experiment.intervals(Use.CALIBRATION)
        for _, columns in _parts(experiment, segments, sensor, interval)
    )


def _segments(experiment: Experiment, sensor: ExperimentSensor) -> Sequence[Experiment]:
    """The experiment in segments of its recording; itself where that is not long."""
    segments = recorded_segments(experiment, weighing=True)
    if len(segments) == 1:
        return [experiment]
    experiments = [replace(experiment, recording=segment.recording) for segment in segments]
    if sensor.name not in experiment.qualities:
        qualities = [sample_quality(one, sensor) for one in experiments]
        keep_quality(SensorRun(experiment, sensor), segments, qualities)
    return experiments


def _parts(
    experiment: Experiment, segments: Sequence[Experiment], sensor: ExperimentSensor, interval: Interval
) -> Iterator[tuple[IntArray, FloatArray]]:
    """As of `_columns`, segment by segment."""
    for segment in segments:
        for part in segment.recording.intervals:
            if (part.label, part.use) == (interval.label, interval.use):
                yield _columns(segment, sensor, part)
                if segment is not experiment:
                    forget_recording(experiment)


def _wrist_means(
    experiment: Experiment, segments: Sequence[Experiment], sensor: ExperimentSensor, interval: Interval
) -> _IntervalMeans:
    start_ns, stamps = experiment.recording.start_ns, experiment.recording.stream(sensor.stream).stamp_ns
    is_whole, left_out, instants = True, 0, [np.zeros(0, dtype=np.int64)]

    def complete_parts() -> Iterator[tuple[FloatArray, FloatArray]]:
        nonlocal is_whole, left_out
        for at_ns, columns in _parts(experiment, segments, sensor, interval):
            needed = np.r_[0:_MOTION_END, _ENDS[-1] : columns.shape[1]]
            complete = np.isfinite(columns[:, needed]).all(axis=1)
            at_ns, columns = at_ns[complete], columns[complete]
            is_whole, left_out = is_whole and bool(np.isfinite(columns).all()), left_out + int((~complete).sum())
            instants.append(at_ns)
            yield seconds_since(at_ns, start_ns), np.nan_to_num(columns)

    parts = complete_parts()
    first = next(parts)
    if len(segments) > 1:  # a segment may have no sample
        first = next((part for part in chain([first], parts) if len(part[0])), first)
    if len(segments) == 1 or not len(first[0]):
        middle, means, counts = weighing_means(*first)
    else:
        window_s = _window_s(seconds_since(stamps[interval.holds(stamps)], start_ns))
        middle, means, counts = means_of_parts(chain([first], parts), window_s)
    if not is_whole:
        means[:, _MOTION_END : _ENDS[-1]] = np.nan
    single = counts.max(initial=1) == 1
    names = (
        tuple(f"{sensor.stream} {number + 1}" for number in np.searchsorted(stamps, np.concatenate(instants)))
        if single
        else tuple(f"{interval.label} at {instant:.2f} s" for instant in middle)
    )
    return _IntervalMeans(time_s=middle, means=means, counts=counts, names=names, left_out=left_out)


def _columns(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> tuple[IntArray, FloatArray]:
    """Instants of the samples of an interval, shape (n,), and all columns at these, shape (n, 31 + variables)."""
    recording = experiment.recording
    at_ns, reading = weighing_readings(experiment, sensor, interval)
    if interval.support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a load")
    window = experiment.processing.derivative_window
    motion, longer = (
        support_motion_at(
            experiment.model,
            recording,
            interval.support,
            JointMotion.at_rest((), np.empty((len(at_ns), 0))),
            at_ns,
            window=chosen,
            gravity=0.0,
        )
        for chosen in (window, window.doubled())
    )
    velocity = np.broadcast_to(motion.angular_velocity, (len(at_ns), 3))
    turning = np.broadcast_to(motion.angular_acceleration, (len(at_ns), 3))
    # a window flattens a first derivative by this power of its length; near the ends of a log the longer has no room
    power = 2 * ((window.order + 1) // 2)
    turning = turning + np.nan_to_num(turning - longer.angular_acceleration) / (2.0**power - 1.0)
    products = (velocity[:, :, None] * velocity[:, None, :]).reshape(-1, 9)
    variables = [one.source.at(recording, at_ns)[:, None] for one in sensor.variables]
    orientation = _orientation(recording, interval, at_ns)
    acceleration = motion.proper_acceleration
    size = np.linalg.norm(acceleration, axis=1, keepdims=True)
    return at_ns, np.hstack([reading, acceleration, size, turning, products, orientation, *variables])


def _orientation(recording: Recording, interval: Interval, at_ns: IntArray) -> FloatArray:
    """`world_R_sensor` row by row, where a motion stream has it; shape (n, 9); NaN otherwise."""
    names: Sequence[str] = getattr(interval.support, "motion_streams", ())
    for stream in (recording.stream(name) for name in names):
        if "orientation" in stream.signals:
            return interpolate(stream, stream.signals["orientation"].values, at_ns)
    return np.full((len(at_ns), 9), np.nan)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadedInterval:
    """An interval with the load that the robot carries."""

    interval: Interval
    """The interval, with a support."""
    number: int
    """Index of the load among those of the problem."""
    link: str | None
    """Link of the load; None where the robot carries none."""


def link_load_problem(
    experiment: Experiment,
    sensor: ExperimentSensor,
    intervals: Sequence[LoadedInterval],
    loads: Sequence[Load],
    *,
    sessions: Sequence[str],
) -> tuple[LoadProblem, int]:
    """Set up the estimation of the loads on a robot, and of the offset of a sensor in every power cycle.

    Args:
        experiment: The experiment, of which the recording and the processing are used.
        sensor: Sensor between the support and the loads.
        intervals: Intervals, in the order of time.
        loads: The loads, in the frames of their links.
        sessions: Power cycle of each interval.

    Returns:
        The problem, with constant offsets unless the file lets them drift, and the number of samples that are left out
        because they lack a value; samples in an ignored interval are not counted.

    Raises:
        ExperimentError: If the sensor has raw readings and no prior, or nothing is left.
    """
    blocks = [_link_means(experiment, sensor, loaded) for loaded in intervals]
    if not sum(len(block.time_s) for block in blocks):
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected samples with a reading and the position of all joints that it needs, "
            "got none in the calibration intervals; the streams have gaps or missing values all over them, or all "
            "samples are frozen, saturated or repeated: see `forcetorque inspect`"
        )
    names = tuple(dict.fromkeys(sessions))
    lengths = [len(block.time_s) for block in blocks]
    means = np.concatenate([block.means for block in blocks])
    counts = np.concatenate([block.counts for block in blocks])
    ends = np.cumsum([6, 6 * INERTIAL, 6])
    wrench, columns, known, variables = np.split(means, ends, axis=1)
    columns = columns.reshape(-1, 6, INERTIAL)
    rows = LoadRows(
        wrench=wrench,
        proper_acceleration=columns[:, :3, 0],
        columns=columns,
        known=known,
        time_s=np.concatenate([block.time_s for block in blocks]),
        session=np.repeat([names.index(session) for session in sessions], lengths),
        block=np.repeat(np.arange(len(blocks)), lengths),
        load=np.repeat([loaded.number for loaded in intervals], lengths),
        share=counts / np.median(counts),
        variables=variables if variables.shape[1] else None,
        names=tuple(name for block in blocks for name in block.names),
    )
    problem = LoadProblem(
        rows=rows,
        loads=tuple(loads),
        sessions=names,
        blocks=tuple(loaded.interval.label for loaded in intervals),
        direction=experiment.model.sensor(sensor.name).direction,
        drift=experiment.fit_options.drift,
        mount=sensor.mount_is_unknown,
        variables=tuple(f"{one.linear.name} ({one.linear.unit})" for one in sensor.variables),
    )
    return problem, sum(block.left_out for block in blocks)


def _link_means(experiment: Experiment, sensor: ExperimentSensor, loaded: LoadedInterval) -> _IntervalMeans:
    recording = experiment.recording
    at_ns, reading = weighing_readings(experiment, sensor, loaded.interval)
    columns, known = _expected(experiment, sensor, loaded, at_ns)
    variables = [one.source.at(recording, at_ns)[:, None] for one in sensor.variables]
    values = np.hstack([reading, columns.reshape(len(at_ns), 6 * INERTIAL), known, *variables])
    complete = np.isfinite(values).all(axis=1)
    time = seconds_since(at_ns[complete], recording.start_ns)
    middle, means, counts = weighing_means(time, values[complete])
    names = tuple(f"{loaded.interval.label} at {instant:.2f} s" for instant in middle)
    return _IntervalMeans(time_s=middle, means=means, counts=counts, names=names, left_out=int((~complete).sum()))


def _expected(
    experiment: Experiment, sensor: ExperimentSensor, loaded: LoadedInterval, at_ns: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Derivative of the load's wrench by each parameter, (n, 6, 10), and the expected wrench by the URDF, (n, 6)."""
    support = loaded.interval.required_support(ExperimentError)
    bare = experiment.mounted(experiment.model)
    tree, name, link = build_tree(bare, support.frame), bare.sensor(sensor.name).name, loaded.link
    question = Question(tree=tree, expected=(name,), equations=())
    needed = (*required_joints_of(question), *(() if link is None else joints_between(tree, link)))
    stream = experiment.recording.stream(sensor.stream)
    sign = reading_sign(bare.sensor(sensor.name).direction, child_is_outboard=True)

    def expected(how: Processing) -> FloatArray:
        robot = LoggedRobot(experiment.recording, experiment.model, support, needed, stream, processing=how)
        wrenches = np.zeros((len(at_ns), 6, INERTIAL + 1))
        for block in blocks_of(len(at_ns)):
            joints, root = robot.at(at_ns[block])
            wrenches[block, :, -1] = estimate(question, joints, root).expected_of(name)
            if link is not None:
                wrenches[block, :, :-1] = sign * _by_load(tree, name, link, joints, root)
        robot.require_radians()
        return wrenches

    processing = experiment.processing
    wrenches = expected(processing)
    if not processing.logged_derivatives:
        longer = expected(replace(processing, derivative_window=processing.derivative_window.doubled()))
        wrenches += FLATTENED * np.nan_to_num(wrenches - longer)
    return wrenches[:, :, :-1], wrenches[:, :, -1]


def _by_load(tree: BodyTree, sensor: str, link: str, joints: JointMotion, root: RootMotion) -> FloatArray:
    """Derivatives of the measurement of a sensor by the inertial parameters of a load on a link; shape (n, 6, 10)."""
    cut, (body, body_H_link) = tree.cuts[sensor], tree.frames[link]
    if cut.body not in path_to_root(tree, body):
        return np.zeros((len(joints), 6, INERTIAL))
    motion = motion_of_link(tree, joints, root, link)
    omega = motion.angular_velocity
    columns = inertial_columns(
        motion.proper_acceleration, motion.angular_acceleration, omega[:, :, None] * omega[:, None, :]
    )
    poses = body_poses(tree, joints, (cut.body, body))
    sensor_H_link = invert_pose(poses[cut.body] @ cut.body_H_sensor) @ poses[body] @ body_H_link
    return cut.sign * (wrench_matrix(sensor_H_link) @ columns)
