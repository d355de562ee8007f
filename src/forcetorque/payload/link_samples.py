# SPDX-License-Identifier: BSD-3-Clause
"""From the intervals of a robot to what they tell of loads on its links, by its own dynamics.

What a sensor must read is linear in mass, first moment and inertia of a load: robots that weigh nothing but one of the
ten say what each adds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.inertia import Inertia
from forcetorque.base.wrench import reading_sign
from forcetorque.experiment.calibration.assumptions import FLATTENED
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.payload.identification.parameters import inertia_of
from forcetorque.payload.identification.problem import Load, LoadProblem, LoadRows
from forcetorque.payload.wrist_samples import weighing_means, weighing_readings
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.mechanics.samples import Processing, robot_motion_at
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree

_PARAMETERS = 10


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HungInterval:
    """An interval, and what hangs on the robot then."""

    interval: Interval
    """The interval, with a support."""
    number: int
    """Number of the load among those of the problem."""
    link: str | None
    """Link that it is fastened to; None where the URDF is all there is."""


def link_load_problem(
    experiment: Experiment,
    sensor: ExperimentSensor,
    intervals: Sequence[HungInterval],
    loads: Sequence[Load],
    *,
    sessions: Sequence[str],
) -> tuple[LoadProblem, int]:
    """Ask what intervals tell of the loads on a robot, and of the offset of a sensor in every session.

    Args:
        experiment: The experiment, of which the recording and the processing are used.
        sensor: Sensor that the loads are beyond.
        intervals: Intervals, in the order of time.
        loads: The loads, in the frames of their links.
        sessions: Session of each interval.

    Returns:
        The problem, with constant offsets unless the file lets them drift, and the number of samples that are left out
        because they lack something; those in an ignored interval are not asked for.

    Raises:
        ExperimentError: If the sensor has raw readings and no prior, or nothing is left.
    """
    spans = [_span(experiment, sensor, one) for one in intervals]
    if not sum(len(span.time_s) for span in spans):
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected samples with a reading and the position of all joints that it needs, "
            "got none in the calibration intervals; the streams have gaps or missing values all over them"
        )
    names = tuple(dict.fromkeys(sessions))
    lengths = [len(span.time_s) for span in spans]
    means, counts = (np.concatenate(parts) for parts in zip(*((s.means, s.counts) for s in spans), strict=True))
    ends = np.cumsum([6, 6 * _PARAMETERS, 6])
    wrench, columns, known, variables = np.split(means, ends, axis=1)
    columns = columns.reshape(-1, 6, _PARAMETERS)
    labels = [one.interval.label for one in intervals]
    rows = LoadRows(
        wrench=wrench,
        proper_acceleration=columns[:, :3, 0],
        columns=columns,
        known=known,
        time_s=np.concatenate([span.time_s for span in spans]),
        session=np.repeat([names.index(session) for session in sessions], lengths),
        block=np.repeat(np.arange(len(spans)), lengths),
        load=np.repeat([one.number for one in intervals], lengths),
        share=counts / np.median(counts),
        variables=variables if variables.shape[1] else None,
        names=tuple(f"{label} at {at:.2f} s" for label, span in zip(labels, spans, strict=True) for at in span.time_s),
    )
    problem = LoadProblem(
        rows=rows,
        loads=tuple(loads),
        sessions=names,
        blocks=tuple(labels),
        direction=experiment.model.sensor(sensor.name).direction,
        drift=experiment.fit_options.drift,
        variables=tuple(f"{one.linear.name} ({one.linear.unit})" for one in sensor.variables),
    )
    return problem, sum(span.left_out for span in spans)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Span:
    """Means of one interval: wrench, columns, known wrench, variables."""

    time_s: FloatArray
    means: FloatArray
    counts: IntArray
    left_out: int


def _span(experiment: Experiment, sensor: ExperimentSensor, hung: HungInterval) -> _Span:
    recording = experiment.recording
    at_ns, reading = weighing_readings(experiment, sensor, hung.interval)
    columns, known = _expected(experiment, sensor, hung, at_ns)
    variables = [one.source.at(recording, at_ns)[:, None] for one in sensor.variables]
    values = np.hstack([reading, columns.reshape(len(at_ns), -1), known, *variables])
    complete = np.isfinite(values).all(axis=1)
    time = seconds_since(at_ns[complete], recording.start_ns)
    middle, means, counts = weighing_means(time, values[complete])
    return _Span(time_s=middle, means=means, counts=counts, left_out=int((~complete).sum()))


def _expected(
    experiment: Experiment, sensor: ExperimentSensor, hung: HungInterval, at_ns: IntArray
) -> tuple[FloatArray, FloatArray]:
    """What each parameter adds to the wrench that moves the load, (n, 6, 10), and what the URDF makes read, (n, 6)."""
    bare = experiment.model
    weightless = replace(bare, links=dict.fromkeys(bare.links, Inertia.zero()))
    parameters = [] if hung.link is None else [_with(weightless, hung.link, k) for k in range(_PARAMETERS)]
    sign = reading_sign(bare.sensor(sensor.name).direction, child_is_outboard=True)
    columns = np.zeros((len(at_ns), 6, _PARAMETERS))
    readings = _readings(experiment, sensor, hung.interval, [bare, *parameters], at_ns)
    if parameters:
        columns[:] = sign * np.stack(readings[1:], axis=2)
    return columns, readings[0]


def _with(weightless: RobotModel, link: str, parameter: int) -> RobotModel:
    """A robot that has one inertial parameter, of one link."""
    unit = np.eye(_PARAMETERS)[parameter]
    inertia = Inertia(mass=float(unit[0]), first_moment=unit[1:4], second_moment=inertia_of(unit[4:]))
    return replace(weightless, links={**weightless.links, link: inertia})


def _readings(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval, models: Sequence[RobotModel], at_ns: IntArray
) -> list[FloatArray]:
    """Expected readings of a sensor on several robots that move alike, unflattened as the calibration does it."""
    support = interval.support
    if support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame, got none")
    name = experiment.model.sensor(sensor.name).name
    questions = [Question(tree=build_tree(model, support.frame), expected=(name,), equations=()) for model in models]
    needed = tuple(dict.fromkeys(joint for question in questions for joint in required_joints_of(question)))
    stream = experiment.recording.stream(sensor.stream)

    def expected(how: Processing) -> list[FloatArray]:
        joints, root = robot_motion_at(
            experiment.recording, experiment.model, support, needed, stream, at_ns, processing=how
        )
        return [estimate(question, joints, root).expected_of(name) for question in questions]

    processing = experiment.processing
    readings = expected(processing)
    if processing.logged_derivatives:
        return readings
    window = processing.derivative_window
    longer = expected(replace(processing, derivative_window=replace(window, window_s=2.0 * window.window_s)))
    return [one + FLATTENED * np.nan_to_num(one - other) for one, other in zip(readings, longer, strict=True)]
