# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment: what every analysis needs of it, computed when it is first needed, and once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from typing import ParamSpec, TypeVar, cast

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.applicability import require_fit
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.provenance import SensorIdentity
from forcetorque.experiment.calibrations_under_test import PRIOR, CalibrationUnderTest, tested_calibrations
from forcetorque.experiment.contacts import contacts_in, touched_otherwise
from forcetorque.experiment.experiment import Experiment, ExperimentContact, ExperimentSensor
from forcetorque.experiment.interval_samples import IntervalSamples, readings_over, samples_over
from forcetorque.experiment.sensor_reading import Correction, Readings, wrench_at
from forcetorque.experiment.validation_offset import EvaluatedInstants, mean_offset
from forcetorque.recording.recording import Interval, MovingSupport, Support, Use
from forcetorque.recording.stream import Stream
from forcetorque.robot.mechanics.measured_and_expected_wrench import padded_samples
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree, path_to_root

_Answer = TypeVar("_Answer")
_Options = ParamSpec("_Options")

_ALL_AT_ONCE = "calibrate all at once, --jointly, from Python calibrate_jointly"
"""What needs no interval without contacts to fit a sensor to."""
_NET_FORCE = "evaluate the net force on all contacts, `forcetorque robot coherence`"
"""What needs no interval without contacts to evaluate sensors on."""


class SensorRun:
    """One sensor of one experiment. Questions take it, and share what they have in common."""

    def __init__(
        self, experiment: Experiment, sensor: ExperimentSensor | str, *, shared: SharedWrenches | None = None
    ) -> None:
        """Choose a sensor.

        Args:
            experiment: The experiment.
            sensor: One of its sensors, or its name.
            shared: Expected wrenches of sensors of the experiment that are analysed after it, or before; None where it
                is analysed alone.
        """
        self.shared = shared
        """What it has in common with other sensors of the experiment; None where it is analysed alone."""
        self.experiment = experiment
        self.sensor = experiment.sensor(sensor) if isinstance(sensor, str) else sensor
        self._known: dict[Hashable, object] = {}
        self._samples: dict[tuple[Hashable, tuple[str, ...], bool], IntervalSamples] = {}
        self._motions: dict[Hashable, list[tuple[JointMotion, RootMotion]]] = {}

    def __repr__(self) -> str:
        return f"SensorRun({self.experiment.name!r}, {self.sensor.name!r}, serial={self.sensor.serial!r})"

    @property
    def stream(self) -> Stream:
        """The stream that holds its reading."""
        return self.experiment.recording.stream(self.sensor.stream)

    @property
    def identity(self) -> SensorIdentity:
        """Which sensor it is, where it is mounted and how it reads."""
        tag = self.experiment.model.sensor(self.sensor.name)
        return SensorIdentity(
            name=self.sensor.name,
            serial=self.sensor.serial,
            robot=self.experiment.model.name,
            frame=tag.frame.value,
            measure_direction=tag.direction,
        )

    @property
    def channels(self) -> int:
        """Number of channels of a raw reading, logged or recovered through the prior."""
        prior, logged = self.sensor.prior, self.stream.signal(self.sensor.quantity).values
        return int(logged.shape[1] if self.sensor.quantity == "raw" or prior is None else prior.shape[1])

    def has(self, use: Use) -> bool:
        """Tell whether the recording has an interval of a use in which it is known what the sensor must read.

        Returns:
            Whether it has.
        """
        return any(
            interval.use is use and not self.touched_beyond(interval)
            for interval in self.experiment.recording.intervals
        )

    def intervals(self, use: Use) -> tuple[Interval, ...]:
        """Give the intervals of one use in which it is known what the sensor must read.

        Returns:
            Intervals in the order of time.
        """
        return tuple(sorted(self._known_intervals(use), key=lambda interval: interval.start_ns))

    def circular_loads(self) -> tuple[str, ...]:
        """Name loads that the sensor itself weighed before, as if its matrix were right.

        Returns:
            A sentence for every load beside which nothing was stated then that would have told the scale of the matrix.
        """
        loads = self.experiment.loads
        return () if loads is None else tuple(loads.circular(self.sensor.serial))

    def touched_beyond(self, interval: Interval) -> tuple[str, ...]:
        """Name what touches a robot on the move beyond the sensor, seen from the support, and nobody knows how.

        Where the support stands still a contact is one that may come, such as a hand; where it moves, with an IMU, the
        robot stands on what the file names.

        Returns:
            Names of contacts; none where mechanics says what the sensor must read.
        """
        present = contacts_in(interval, self.experiment.contacts)
        support = interval.support
        if not present or not isinstance(support, MovingSupport):
            return ()
        return self.once(("touched", _key(interval)), self._beyond, support, present)

    def possibly_touched(self, interval: Interval) -> tuple[str, ...]:
        """Name the contacts beyond the sensor that may come while the support stands still.

        Returns:
            Names of contacts; none where the support moves, since there they are `touched_beyond`.
        """
        present = contacts_in(interval, self.experiment.contacts)
        support = interval.support
        return self._beyond(support, present) if present and isinstance(support, Support) else ()

    def known(
        self, intervals: Sequence[Interval], which: str = "an interval", remedy: str = _ALL_AT_ONCE
    ) -> tuple[Interval, ...]:
        """Leave out intervals in which nobody knows what the sensor must read.

        Args:
            intervals: At least one interval.
            which: What they are, for messages.
            remedy: What does without such intervals, for messages.

        Returns:
            Those in which nothing touches the robot beyond the sensor.

        Raises:
            ExperimentError: If something does in every one.
        """
        known = tuple(interval for interval in intervals if not self.touched_beyond(interval))
        if not known:
            names = dict.fromkeys(name for interval in intervals for name in self.touched_beyond(interval))
            raise ExperimentError(
                f"expected {which} in which nothing touches the robot beyond {self.sensor.name!r}, but by [[contact]] "
                f"or contact_links {', '.join(names)} does in every one, so that nobody knows what the sensor must "
                f"read; record it with that in the air, or {remedy}"
            )
        return known

    def interval_samples(
        self,
        interval: Interval,
        *,
        variables: Collection[str] = (),
        smoothed: bool = True,
        with_flattening: bool = True,
    ) -> IntervalSamples:
        """Pair reading and reference over an interval.

        Args:
            interval: The interval.
            variables: Names of the linear variables that are wanted; samples that lack one are left out.
            smoothed: Whether the filter of the experiment is applied.
            with_flattening: Whether a fit needs them, and with it the flattening by the derivative window.

        Returns:
            The samples; with the flattening also where it is not needed, but was before.
        """
        names = self._in_order(variables)
        key = (_key(interval), names, smoothed)
        kept = self._samples.get(key)
        if kept is None or (with_flattening and kept.samples.flattening is None):
            kept = self._samples[key] = samples_over(
                self.experiment,
                self.sensor,
                interval,
                variables=names,
                smoothed=smoothed,
                with_flattening=with_flattening,
                known=self._without_filter(),
                shared=self.shared,
            )
        return kept

    def _without_filter(self) -> list[IntervalSamples]:
        unfiltered = self.experiment.processing.smoothing is None
        return [samples for (*_, smoothed), samples in self._samples.items() if unfiltered or not smoothed]

    def copy(self) -> SensorRun:
        """Share what is computed so far, for an analysis whose samples are not to be kept in memory.

        Returns:
            The sensor; what it computes further is not known to this one.
        """
        other = SensorRun(self.experiment, self.sensor, shared=self.shared)
        other._known, other._samples = dict(self._known), dict(self._samples)
        return other

    def interval_readings(self, interval: Interval, *, variables: Collection[str] = ()) -> Readings:
        """Take the readings over an interval, for which no reference is wanted.

        Args:
            interval: The interval.
            variables: Names of the linear variables that are wanted; samples that lack one are left out.

        Returns:
            The readings, through the filter of the experiment.
        """
        names = self._in_order(variables)
        return self.once(
            ("readings", _key(interval), names),
            readings_over,
            self.experiment,
            self.sensor,
            interval,
            variables=names,
        )

    def samples(self, use: Use, *, variables: Collection[str] = ()) -> list[IntervalSamples]:
        """Pair reading and reference over the intervals of one use.

        Args:
            use: The use.
            variables: Names of the linear variables that are wanted.

        Returns:
            Samples per interval, in the order of the file.
        """
        return [self.interval_samples(interval, variables=variables) for interval in self._known_intervals(use)]

    def instants(self, interval: Interval) -> EvaluatedInstants:
        """Give the instants at which the sensor is evaluated in an interval.

        Returns:
            Instants of all its samples, and those around it that the filter of the experiment takes.
        """

        def padded_instants() -> EvaluatedInstants:
            recording, smoothing = self.experiment.recording, self.experiment.processing.smoothing
            apart = touched_otherwise(interval, recording, self.experiment.contacts)
            return EvaluatedInstants(samples=padded_samples(recording, self.stream, interval, smoothing, apart=apart))

        return self.once(("instants", _key(interval)), padded_instants)

    def motion(self, interval: Interval, joints: Sequence[str]) -> tuple[JointMotion, RootMotion]:
        """Give the motion of joints and support at the instants of an interval.

        Args:
            interval: The interval.
            joints: Joints whose motion is wanted.

        Returns:
            Motion of these joints, among others where a question before this one wanted more, and of the support frame.

        Raises:
            ExperimentError: If the interval has no support.
        """
        support = interval.required_support(ExperimentError)
        motions = self._motions.setdefault(_key(interval), [])
        for motion in motions:
            if set(joints) <= set(motion[0].names):
                return motion
        motions.append(self.motion_at(support, joints, self.instants(interval).at_ns))
        return motions[-1]

    def motion_at(
        self, support: Support | MovingSupport, joints: Sequence[str], at_ns: IntArray
    ) -> tuple[JointMotion, RootMotion]:
        """Give the motion of joints and support at instants of the stream of the sensor, as of the experiment."""
        filters = None if self.shared is None else self.shared.filters
        return self.experiment.motion_at(support, joints, self.stream, at_ns, filters=filters)

    def measured(self, interval: Interval, correction: Correction) -> FloatArray:
        """Give what the sensor measured at the instants of an interval.

        Args:
            interval: The interval.
            correction: How it is read.

        Returns:
            Wrenches; shape (n, 6); N, N m; NaN in gaps.
        """
        at_ns = self.instants(interval).at_ns
        return wrench_at(self.experiment, self.sensor, correction, at_ns, interval=interval)

    def read(self, spans: Sequence[tuple[Interval, Readings]], correction: Correction) -> FloatArray:
        """Read the sensor over intervals, each with the offset of its session.

        Args:
            spans: Intervals with the readings in them, at least one.
            correction: How it is read.

        Returns:
            Wrenches, one interval after the other; shape (n, 6); N, N m.
        """
        return np.concatenate(
            [readings.wrench(correction.over(self.experiment, interval.label)) for interval, readings in spans]
        )

    def uncalibrated(self) -> Correction:
        """Read the sensor by the prior of the experiment, or take the logged wrench.

        Returns:
            The correction, with the offset that the calibration intervals give; without any no offset is removed.

        Raises:
            ExperimentError: If raw counts have no prior.
        """
        return self.once("uncalibrated", self._uncalibrated)

    def _uncalibrated(self) -> Correction:
        bare = Correction.without_offset(self.sensor)
        if not any(interval.use is Use.CALIBRATION for interval in self.experiment.recording.intervals):
            return bare
        parts = self.samples(Use.CALIBRATION)
        # the mean over all samples at once: its last bits depend on how it is summed
        wrench = np.concatenate([part.samples.reading.values for part in parts])
        wrench = wrench if bare.of_wrench else wrench @ bare.model.matrix.T
        reference = np.concatenate([part.samples.reference for part in parts])
        offset = mean_offset(self.sensor.expected_reading(reference) - wrench)
        labels = ", ".join(repr(part.interval.label) for part in parts)
        return bare.with_offset(offset, f"over {labels} ({len(wrench)} samples)")

    def read_by(self, name: str | None, calibration: Calibration | None) -> Correction:
        """Read the sensor by one calibration, or, with whatever offset it has, by its prior or as logged.

        Args:
            name: Name of the calibration, for messages; None for none.
            calibration: The calibration; None for none.

        Returns:
            The correction.
        """
        if calibration is None:
            return Correction.without_offset(self.sensor)
        self.require_fit(name or "calibration", calibration)
        return Correction.of(name or "calibration", calibration)

    def candidates(self, calibrations: Mapping[str, Calibration]) -> tuple[CalibrationUnderTest, ...]:
        """Decide by what the sensor is read in turn.

        Args:
            calibrations: Calibrations of the sensor by name; without any it is read by the prior of the experiment.

        Returns:
            The candidates, priors first; a prior that several calibrations share comes once.

        Raises:
            SerialNumberError: If a calibration is of another sensor.
            ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior.
        """
        return self.once(("candidates", calibrations_key(calibrations)), self._candidates, calibrations)

    def _candidates(self, calibrations: Mapping[str, Calibration]) -> tuple[CalibrationUnderTest, ...]:
        if not calibrations:
            return (CalibrationUnderTest(name=PRIOR, correction=self.uncalibrated(), prior=None),)
        for name, calibration in calibrations.items():
            self.require_fit(name, calibration)
        return tested_calibrations(calibrations)

    def require_fit(self, name: str, calibration: Calibration) -> None:
        """Refuse a calibration of another sensor, or of one that is read in another way.

        Args:
            name: Name of the calibration, for messages.
            calibration: The calibration.
        """
        require_fit(name, calibration, self.experiment, self.sensor)

    def _known_intervals(self, use: Use) -> tuple[Interval, ...]:
        remedy = _NET_FORCE if use is Use.VALIDATION else _ALL_AT_ONCE
        return self.known(self.experiment.intervals(use), f'an interval with use = "{use}"', remedy)

    def _beyond(self, support: Support | MovingSupport, contacts: Sequence[ExperimentContact]) -> tuple[str, ...]:
        tree = build_tree(self.experiment.model, support.frame)
        cut = tree.cuts[self.sensor.name].body
        return tuple(
            entry.contact.name
            for entry in contacts
            if entry.stream is None and cut in path_to_root(tree, tree.frames[entry.contact.link][0])
        )

    def _in_order(self, variables: Collection[str]) -> tuple[str, ...]:
        return tuple(v.linear.name for v in self.sensor.variables if v.linear.name in variables)

    def once(
        self,
        key: Hashable,
        compute: Callable[_Options, _Answer],
        *arguments: _Options.args,
        **options: _Options.kwargs,
    ) -> _Answer:
        """Compute what several analyses need of the sensor, when it is first needed.

        Args:
            key: What it is, other than all else that is kept.
            compute: Computes it.
            *arguments: What `compute` takes.
            **options: What it takes by name.

        Returns:
            What was computed.
        """
        if key not in self._known:
            self._known[key] = compute(*arguments, **options)
        return cast("_Answer", self._known[key])


def _key(interval: Interval) -> Hashable:
    # intervals of one label differ where somebody asks for the whole log
    return interval.label, interval.start_ns, interval.end_ns


def calibrations_key(calibrations: Mapping[str, Calibration]) -> Hashable:
    """Give a key by which the same calibrations under the same names are known again.

    Args:
        calibrations: Calibrations by name.

    Returns:
        The key.
    """
    return tuple((name, _Same(calibration)) for name, calibration in calibrations.items())


class _Same:
    """A calibration as a key, by identity: another one may come under the same name."""

    def __init__(self, calibration: Calibration) -> None:
        self.calibration = calibration

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and self.calibration is other.calibration

    def __hash__(self) -> int:
        return id(self.calibration)
