# SPDX-License-Identifier: BSD-3-Clause
"""Link groups without contact in an interval, what their joints and sensors logged, and their residuals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError, OutputError, RecordingError
from forcetorque.base.rows_on_disk import row_blocks
from forcetorque.calibration.joint.robust_fit import PartResidual, UntouchedStretch, residuals_by
from forcetorque.calibration.joint.window_nodes import Stretch, StretchRows
from forcetorque.calibration.joint.windows import part_windows, window_means
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.long_recording import forget_recording, segment_experiments
from forcetorque.experiment.sample_quality import unusable_in
from forcetorque.experiment.sensor_reading import readings_at
from forcetorque.recording.alignment import require_overlap, seconds_since
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Interval, MovingSupport, Support, Use
from forcetorque.robot.mechanics.measured_and_expected_wrench import (
    padded_samples,
    pick_samples,
    require_motion_overlap,
)
from forcetorque.robot.mechanics.root_motion import imu_frame, joints_to_support
from forcetorque.robot.mechanics.sub_model_equations import joints_of_cuts, joints_of_part, sensors_of, untouched_parts
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import BodyTree, build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedParts:
    """Parts that can be used, and why others cannot."""

    parts: tuple[SubModel, ...]
    """Parts whose joints were all logged."""
    weighed: tuple[SubModel, ...]
    """Parts that can be weighed at least: the joints between their sensors were logged."""
    left_out: tuple[str, ...]
    """What the others lack, in words."""

    @classmethod
    def of(cls, experiment: Experiment, parts: Sequence[SubModel], tree: BodyTree) -> Self:
        """Look for the joints of parts in a log.

        Args:
            experiment: The experiment.
            parts: The parts.
            tree: The robot that they are of.

        Returns:
            The same parts by what was logged.
        """
        available = set(experiment.recording.joint_signals("position"))
        logged, weighed, lacking = [], [], []
        for part in parts:
            missing = [joint for joint in joints_of_part(tree, part) if joint not in available]
            if not missing:
                logged.append(part)
            elif available.issuperset(joints_of_cuts(tree, part)):
                weighed.append(replace(part, name=f"weight on {', '.join(sensors_of(part))}"))
            else:
                lacking.append(f"part {part.name!r} needs the joint(s) {', '.join(missing)}, which the log lacks")
        return cls(parts=tuple(logged), weighed=tuple(weighed), left_out=tuple(lacking))

    @property
    def sensors(self) -> frozenset[str]:
        """Sensors that bound them."""
        return frozenset(name for part in (*self.parts, *self.weighed) for name in sensors_of(part))

    def joints(self, tree: BodyTree) -> tuple[str, ...]:
        """Name the joints whose motion they need.

        Args:
            tree: The robot that they are of.

        Returns:
            Joints, each once.
        """
        whole = (joint for part in self.parts for joint in joints_of_part(tree, part))
        cuts = (joint for part in self.weighed for joint in joints_of_cuts(tree, part))
        return tuple(dict.fromkeys((*whole, *cuts)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawWindows:
    """Raw readings of one sensor over the windows of an interval."""

    time_s: FloatArray
    """Mean instants; shape (w,); s."""
    means: FloatArray
    """Mean readings; shape (w, c); counts; NaN where a window has a gap."""
    minimum: FloatArray
    """Smallest reading per channel; shape (c,); counts."""
    maximum: FloatArray
    """Largest reading per channel; shape (c,); counts."""
    samples: int
    """Samples with a reading, and with the variables of the sensor."""
    missing: int
    """Samples without."""
    unusable: UnusableCounts
    """Samples of the sensor that say nothing of its load, among those of the interval."""

    @classmethod
    def of(cls, sensor: str, stretch: Stretch, raw: FloatArray, unusable: UnusableCounts) -> Self:
        """Average raw readings.

        Args:
            sensor: Name of the sensor.
            stretch: The stretch that they are of.
            raw: Readings at its instants; shape (n, c); counts; NaN in gaps.
            unusable: Samples of the sensor that say nothing of its load, among those of the interval.

        Returns:
            The same over its windows.
        """
        samples, minimum, maximum = 0, np.full(raw.shape[1], np.nan), np.full(raw.shape[1], np.nan)
        variables = [values for (owner, _), values in stretch.variables.items() if owner == sensor]
        for block, *beside in row_blocks(raw, *variables):
            whole = block[np.isfinite(np.hstack([block, *beside])).all(axis=1)]
            if len(whole):
                samples += len(whole)
                minimum, maximum = np.fmin(minimum, whole.min(axis=0)), np.fmax(maximum, whole.max(axis=0))
        times, means = window_means(stretch, raw)
        return cls(
            time_s=times,
            means=means,
            minimum=minimum,
            maximum=maximum,
            samples=samples,
            missing=len(raw) - samples,
            unusable=unusable,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointInterval:
    """One interval of one recording."""

    interval: Interval
    """The interval."""
    untouched: UntouchedStretch
    """Its equations, and what is needed for them."""
    raw: Mapping[str, RawWindows]
    """Raw readings by the names of the sensors."""
    variables: Mapping[tuple[str, str], FloatArray]
    """By sensor and name, means of linear variables less their reference values; shape (w,) each; in their units."""


def joint_interval(
    experiment: Experiment,
    interval: Interval,
    sensors: Sequence[str],
    *,
    label: str | None = None,
    recording: str | None = None,
    session: str | None = None,
    segments: Sequence[Experiment] = (),
    references: Mapping[tuple[str, str], float] | None = None,
) -> JointInterval:
    """Take what an interval says of several sensors at once.

    Args:
        experiment: The experiment.
        interval: One of its intervals.
        sensors: Names of its sensors.
        label: Name of the interval among those of other recordings; its label if None.
        recording: Name of the recording among others; that of the experiment if None.
        session: Session that the interval is of, among those of other recordings; by its file if None.
        segments: The experiment in the segments of a long recording, which are read one after the other; samples are
            then in temporary files.
        references: Linear variables to take by sensor and name, and the value at which each adds nothing; none if None.

    Returns:
        Readings by the prior matrices, at the instants of the first sensor, and the motion of the robot. Parts whose
        joints are not in the log are left out, and named.

    Raises:
        ExperimentError: If the interval has no support, or of no untouched part all joints are in the log.
        RecordingError: If no sample of the interval can be used.
    """
    setup = _Setup.of(experiment, interval, sensors, {} if references is None else references)
    parts = _parts(experiment, interval, setup, segments)
    stretch, raw, *unusable = next(parts)
    if segments:
        rows, stretch = StretchRows(stretch, raw), stretch.samples(np.arange(0))
        for part, raw, counts in parts:
            rows.append(part, raw)
            unusable.append(counts)
            del part, raw
        stretch, raw = rows.mapped()
    stretch = replace(
        stretch,
        label=interval.label if label is None else label,
        recording=experiment.session_names(None)[0] if recording is None else recording,
        session=experiment.session_names(interval.label)[0] if session is None else session,
    )
    logged = setup.logged
    return JointInterval(
        interval=interval,
        untouched=UntouchedStretch(
            stretch=stretch, parts=logged.parts, weighed=logged.weighed, left_out=logged.left_out
        ),
        raw={
            name: RawWindows.of(name, stretch, values, UnusableCounts.total(counts[name] for counts in unusable))
            for name, values in raw.items()
        },
        variables={pair: window_means(stretch, values)[1][:, 0] for pair, values in stretch.variables.items()},
    )


class _Setup(NamedTuple):
    """What of the robot and of the log is the same all over an interval."""

    support: Support | MovingSupport
    touched: tuple[str, ...]
    tree: BodyTree
    logged: LoggedParts
    used: list[ExperimentSensor]
    references: Mapping[tuple[str, str], float]

    @classmethod
    def of(
        cls,
        experiment: Experiment,
        interval: Interval,
        sensors: Sequence[str],
        references: Mapping[tuple[str, str], float],
    ) -> Self:
        support = interval.support
        if support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame or an IMU, got none")
        present = contacts_in(interval, experiment.contacts)
        touched = tuple(dict.fromkeys((support.frame, *(entry.contact.link for entry in present))))
        model = experiment.model_on(support)
        if isinstance(support, MovingSupport):
            # the motion is known where the IMU is: nothing needs to be carried to another link
            support = replace(support, frame=imu_frame(experiment.model, experiment.recording, support))
        tree = build_tree(model, support.frame)
        logged = LoggedParts.of(experiment, untouched_parts(tree, sensors, touched), tree)
        if not logged.parts and not logged.weighed:
            raise ExperimentError(
                f"interval {interval.label!r}: of no untouched part are all joints in the log: "
                f"{'; '.join(logged.left_out)}"
            )
        used = [experiment.sensor(name) for name in sensors if name in logged.sensors]
        source, *others = (experiment.recording.stream(sensor.stream) for sensor in used)
        for other in others:
            require_overlap(source, other)
        joints = (*logged.joints(tree), *joints_to_support(experiment.model, experiment.recording, support))
        require_motion_overlap(experiment.recording, support, joints, source, processing=experiment.processing)
        return cls(support, touched, tree, logged, used, references)


_LoggedPart = tuple[Stretch, dict[str, FloatArray], dict[str, UnusableCounts]]
"""A stretch, and by sensor raw readings at its instants, (n, c), counts, NaN in gaps, and how many are unusable."""


def _parts(
    experiment: Experiment, interval: Interval, setup: _Setup, segments: Sequence[Experiment]
) -> Iterator[_LoggedPart]:
    """An interval as a whole, or its parts in segments, which are not to be kept; at least one."""
    if not segments:
        yield _part(experiment, interval, setup, setup.used)
        return
    lost = {sensor.name: sensor for sensor in setup.used}
    for segment in segments:
        for part in segment.recording.intervals:
            if (part.label, part.use) != (interval.label, interval.use):
                continue
            read = [sensor for sensor in setup.used if _has_sample(segment, sensor, part)]
            if setup.used[0] in read:  # at whose instants the others are
                for sensor in read:
                    lost.pop(sensor.name, None)
                yield _part(segment, part, setup, read)
        forget_recording(experiment)
    for sensor in lost.values():
        raise RecordingError(f"interval {interval.label!r}: stream {sensor.stream!r} has no sample in it to use")


def _has_sample(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> bool:
    try:
        pick_samples(experiment.recording, experiment.recording.stream(sensor.stream), interval)
    except RecordingError:
        return False
    return True


def _part(experiment: Experiment, interval: Interval, setup: _Setup, read: Sequence[ExperimentSensor]) -> _LoggedPart:
    """A part, in which the sensors that are read have samples; the others are NaN."""
    support, touched, tree, logged, used, references = setup
    source = experiment.recording.stream(used[0].stream)
    samples = padded_samples(experiment.recording, source, interval, None)
    joints, root = experiment.motion_at(support, logged.joints(tree), source, samples.stamp_ns, overlap_checked=True)
    priors = {sensor.name: required_prior(sensor) for sensor in used}
    raw = {sensor.name: readings_at(experiment, sensor, (), samples.stamp_ns).raw for sensor in used}
    readings = {name: raw[name] @ prior.T for name, prior in priors.items()}
    variables = {}
    for sensor in used:
        for variable in sensor.variables:
            pair = sensor.name, variable.linear.name
            if pair in references:
                values = variable.source.at(experiment.recording, samples.stamp_ns)
                variables[pair] = values[:, None] - references[pair]
    stretch = Stretch(
        label=interval.label,
        recording=experiment.name,
        session=interval.label,
        time_s=seconds_since(samples.stamp_ns, experiment.recording.start_ns),
        tree=tree,
        joints=joints,
        root=root,
        readings=readings,
        touched=touched,
        keeps_disagreeing="disagreeing" in experiment.processing.keep,
        variables=variables,
    )
    unusable = {one.name: unusable_in(experiment, one, interval) if one in read else UnusableCounts() for one in used}
    return stretch, raw, unusable


def required_prior(sensor: ExperimentSensor) -> FloatArray:
    """Give the prior matrix of a sensor, which a joint calibration changes.

    Returns:
        The matrix; shape (6, c); N/count, N m/count.

    Raises:
        ExperimentError: If it has none.
    """
    sensor.require_six_components("a joint calibration")
    if sensor.prior is None:
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected a prior matrix, which a joint calibration changes; state the matrix of "
            'its data sheet as `prior`, or "identity" for a log of wrenches'
        )
    return sensor.prior


def part_residuals(experiment: Experiment, calibrations: Mapping[str, Calibration], use: Use) -> list[PartResidual]:
    """Add up what the sensors of every part read, and take off what moves its bodies.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by the names of their sensors.
        use: Use of the intervals that are asked.

    Returns:
        What is left by the prior matrices and by the calibrations, of every part all of whose sensors have one, and the
        variables for it, and whose joints were logged. Both with the offsets that suit the interval best, unless
        the calibrations know its session; then they keep theirs.
    """
    used = {
        sensor.name: calibrations[sensor.name]
        for sensor in experiment.sensors
        if sensor.name in calibrations
        and sensor.prior is not None
        and _has_variables(sensor, calibrations[sensor.name])
    }
    if not used:
        return []
    intervals = [interval for interval in experiment.recording.intervals if interval.use is use]
    segments = segment_experiments(experiment)
    return [residual for interval in intervals for residual in _residuals(experiment, interval, used, segments)]


def _has_variables(sensor: ExperimentSensor, calibration: Calibration) -> bool:
    units = {variable.linear.name: variable.linear.unit for variable in sensor.variables}
    return all(units.get(variable.name) == variable.unit for variable in calibration.variables)


def _residuals(
    experiment: Experiment,
    interval: Interval,
    calibrations: Mapping[str, Calibration],
    segments: Sequence[Experiment],
) -> Iterator[PartResidual]:
    variables = {(name, own.name): own for name, one in calibrations.items() for own in one.variables}
    references = {pair: own.reference_value for pair, own in variables.items()}
    try:
        one = joint_interval(
            experiment, interval, list(calibrations), segments=segments, references=references
        ).untouched
    except OutputError:
        raise
    except ForceTorqueError:  # no support, or something touches every part: then there is nothing to add up
        return
    sessions = experiment.session_names(interval.label)
    for windows in part_windows(one.stretch, one.parts, (), weighed=one.weighed):
        if not len(windows):
            continue
        own = {name: calibrations[name] for name in windows.sensors}
        offsets = {
            name: session.offset
            for name, calibration in own.items()
            for session in calibration.sessions
            if session.name in sessions
        }
        factors = {
            name: calibration.matrix @ np.linalg.pinv(required_prior(experiment.sensor(name)))
            for name, calibration in own.items()
        }
        slopes = {pair: variables[pair].coefficients for pair in windows.slopes}
        left = residuals_by(windows, factors, offsets if len(offsets) == len(own) else None, slopes)
        expected = {
            (name, variable.linear.name): variable.linear.prior
            for name in windows.sensors
            for variable in experiment.sensor(name).variables
            if variable.linear.prior is not None
        }
        yield PartResidual.of(windows, left, np.ones(len(windows), dtype=bool), expected)
