# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches that calibrations under test report where nothing touches."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, names, require_shape
from forcetorque.base.errors import EstimationError, ShapeError, known_names, require_known
from forcetorque.base.noise.window_means import joined_times
from forcetorque.base.rows_on_disk import RowsOnDisk, concatenated
from forcetorque.base.wrench import WRENCH_COMPONENTS, transform_wrench
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import CalibrationUnderTest
from forcetorque.experiment.free_sub_model import ContactForceValidation, FreeSubModel
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.validation_offset import LeftOut, Offset
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.motion import JointMotion, RootMotion


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EstimatedContactWrenches(ArrayRecord):
    """Contact wrenches of a sub-model that nothing touches, by each of k candidates over n samples."""

    validation: ContactForceValidation
    """What was validated."""
    candidates: tuple[str, ...] = field(metadata=names("k"))
    """Names of the candidates."""
    at_sensor: FloatArray = field(metadata=array("k", "n", 6))
    """Contact wrenches in the frame of the evaluated sensor and in its direction (4.1); shape (k, n, 6); N, N m; NaN in
    a sample with a gap."""
    free_reading: FloatArray = field(metadata=array("n", 6))
    """Reading of the evaluated sensor with which there would be no contact; shape (n, 6); N, N m."""
    sensor_H_contact: FloatArray = field(metadata=array(None, 4, 4))
    """Pose of the contact frame in the frame of the reading; shape (n, 4, 4) or (1, 4, 4); m."""

    def of(self, candidate: str) -> FloatArray:
        """Give the wrenches of one candidate.

        Args:
            candidate: Its name.

        Returns:
            Wrenches in the frame and direction of the evaluated sensor; shape (n, 6); N, N m.

        Raises:
            EstimationError: If there is no such candidate.
        """
        require_known(candidate, self.candidates, EstimationError, f"no candidate {candidate!r}")
        return self.at_sensor[self.candidates.index(candidate)]


def estimate_contact_wrenches(
    validation: ContactForceValidation,
    joints: JointMotion,
    root: RootMotion,
    readings: Mapping[str, Any] | FloatArray,
    *,
    measured: Wrenches | None = None,
) -> EstimatedContactWrenches:
    """Estimate the contact wrench of a sub-model that nothing touches, with candidates for one of its sensors.

    NaN in a sample is a gap: it makes NaN of that sample and of no other.

    Args:
        validation: What is validated.
        joints: Motion of at least its required joints; n samples.
        root: Motion of the root link's frame; one sample or n.
        readings: What the evaluated sensor reads with each candidate, in its frame and direction; shape (n, 6) by name,
            or (k, n, 6), and the candidates are then named by their index; N, N m.
        measured: Readings of at least the other sensors of the sub-model; looked at only in the mode `measured`.

    Returns:
        The wrenches of every candidate.

    Raises:
        EstimationError: If readings of other sensors are missing, or a number is infinite.
        RobotError: If a joint that is needed is not in `joints`.
        ShapeError: If numbers of samples differ, or there is no candidate.
    """
    candidates = _named(readings, len(joints))
    unread = _contact_if_it_read_zero(validation, joints, root, measured)
    pose = validation.sensor_H_contact(joints)
    free = -validation.sign * validation.direction * transform_wrench(pose, unread)
    wrenches = np.empty((len(candidates), len(joints), 6))
    for wrench, (name, reading) in zip(wrenches, candidates.items(), strict=True):
        np.subtract(reading, free, out=wrench)
        wrench *= validation.sign
        whole = np.isfinite(wrench).all(axis=1)
        if not whole.all():
            _refuse_infinite(name, reading)
            wrench[~whole] = np.nan  # a wrench at another point mixes all components
    wrenches.setflags(write=False)  # held as it is, not copied
    return EstimatedContactWrenches(
        validation=validation,
        candidates=tuple(candidates),
        at_sensor=wrenches,
        free_reading=free,
        sensor_H_contact=pose,
    )


def _named(readings: Mapping[str, Any] | FloatArray, n: int) -> dict[str, FloatArray]:
    if isinstance(readings, Mapping):
        named = {name: np.asarray(values, dtype=np.float64) for name, values in readings.items()}
    else:
        stacked = np.asarray(readings, dtype=np.float64)
        require_shape(stacked, name="readings", shape=(None, n, 6))
        named = {str(index): values for index, values in enumerate(stacked)}
    if not named:
        raise ShapeError("readings: expected at least one candidate, got none")
    for name, values in named.items():
        require_shape(values, name=f"readings of {name!r}", shape=(n, 6))
    return named


def _refuse_infinite(candidate: str, reading: FloatArray) -> None:
    places = np.argwhere(np.isinf(reading))
    if len(places):
        sample, component = places[0].tolist()
        raise EstimationError(
            f"readings of {candidate!r}: expected finite numbers, or NaN for a gap; {WRENCH_COMPONENTS[component]} is "
            f"{reading[sample, component]} in sample {sample}"
        )


def _contact_if_it_read_zero(
    validation: ContactForceValidation, joints: JointMotion, root: RootMotion, measured: Wrenches | None
) -> FloatArray:
    """What the estimator finds at the contact if the evaluated sensor reads zero; shape (n, 6)."""
    readings = {validation.sensor: np.zeros((len(joints), 6)), **_others(validation, joints, root, measured)}
    estimates = estimate(validation.contact_question, joints, root, measured=Wrenches.of(readings))
    return estimates.contact(validation.point.name)


def _others(
    validation: ContactForceValidation, joints: JointMotion, root: RootMotion, measured: Wrenches | None
) -> dict[str, FloatArray]:
    question = validation.expected_question
    if question is not None:
        estimates = estimate(question, joints, root)
        return {name: estimates.expected_of(name) for name in validation.others}
    wrenches = Wrenches(names=(), values=np.empty((len(joints), 0, 6))) if measured is None else measured
    for name in validation.others:
        if name not in wrenches.names:
            raise EstimationError(
                f"measured: reading of sensor {name!r}, which bounds sub-model {validation.part.name!r}, is missing; "
                f"{known_names(name, wrenches.names)}; if it has none, leave it out of cut_at, or take the mode model"
            )
    return {name: wrenches.of_name(name) for name in validation.others}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactWrenches:
    """Wrenches at the sensor over all validation intervals, in the order of time."""

    sub_model: str
    """Sub-model that nothing touches, by the sensor at its base or the root link."""
    candidates: tuple[CalibrationUnderTest, ...]
    """The candidates."""
    wrenches: Mapping[tuple[int, Offset], FloatArray]
    """Wrenches by the place of the candidate, because a calibration may be called `prior` too, and by the offset that
    is asked for; shape (n, 6) each; N, N m; NaN in gaps."""
    time_s: Mapping[tuple[int, Offset], FloatArray]
    """Instants of these, since the start of the recording; shape (n,) each; s."""
    expected: FloatArray
    """Readings with which there would be no contact, at the evaluated instants; shape (n, 6); N, N m; NaN in gaps."""
    left_out: tuple[str, ...]
    """What could not be evaluated of the intervals, in words."""


def contact_wrenches(free: FreeSubModel, calibrations: Mapping[str, Calibration]) -> ContactWrenches:
    """Read a sensor by every candidate, and carry the contact wrench of the free sub-model to the sensor.

    Args:
        free: The sub-model; the validation intervals are used.
        calibrations: Calibrations of the sensor by name.

    Returns:
        The wrenches with the candidate's own offset and with that of each interval's first second.

    Raises:
        ExperimentError: If there is no interval to evaluate, or one has no support.
    """
    rows = ContactRows(free.whole.candidates(calibrations))
    add_segments(free, rows)
    return rows.wrenches()


class OfSegments(Protocol):
    """What is collected of a recording whose segments come one after the other."""

    def add(self, free: FreeSubModel) -> None:
        """Evaluate the next segment."""
        ...


def add_segments(free: FreeSubModel, *rows: OfSegments) -> None:
    """Evaluate every segment of a recording, which is not kept, by one after the other.

    Args:
        free: The sub-model in the recording.
        rows: What is evaluated; what needs the motion of the most joints first, in which the others find theirs.
    """
    for part in free.segments():
        for one in rows:
            one.add(part)
        del part


class ContactRows:
    """Contact wrenches of a recording whose segments come one after the other, in temporary files if there are many."""

    def __init__(self, candidates: tuple[CalibrationUnderTest, ...]) -> None:
        """Begin.

        Args:
            candidates: By what the sensor is read.
        """
        self._candidates, self._sub_model = candidates, ""
        self._rows: dict[tuple[int, Offset], RowsOnDisk] = {}
        self._time, self._expected = RowsOnDisk(), RowsOnDisk((6,))
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
                sub_model = free.seen_from_support(interval)
                self._sub_model = sub_model.part.name
                if self._left_out.is_short(instants, interval):
                    continue
                over, without = _over(free, interval, sub_model, self._candidates)
            self._expected.append(instants.judged(without))
            self._time.append(seconds_since(instants.judged_ns, free.run.experiment.recording.start_ns))
            for index, wrench in enumerate(over):
                judged = instants.judged_with_both(wrench, ("contact", index))
                self._left_out.add_errors(f"contact force by {self._candidates[index].name}", interval, judged)
                for offset, errors in judged.items():
                    self._rows.setdefault((index, offset), RowsOnDisk((6,))).append(errors)

    def wrenches(self) -> ContactWrenches:
        """Put them together.

        Returns:
            The wrenches of all segments.
        """
        time_s = self._time.mapped()
        return ContactWrenches(
            sub_model=self._sub_model,
            candidates=self._candidates,
            wrenches={key: rows.mapped() for key, rows in self._rows.items()},
            time_s=dict.fromkeys(self._rows, time_s),
            expected=self._expected.mapped(),
            left_out=self._left_out.texts(),
        )


def pooled_contacts(recordings: Mapping[str, ContactWrenches]) -> ContactWrenches:
    """Put together what several recordings say.

    Args:
        recordings: Wrenches by name of the recording, candidates in the same order.

    Returns:
        All of them, one recording after the other; the same where there is one.
    """
    first = next(iter(recordings.values()))
    if len(recordings) == 1:
        return first
    pieces: dict[tuple[int, Offset], list[FloatArray]] = {}
    times: dict[tuple[int, Offset], list[FloatArray]] = {}
    for contacts in recordings.values():
        for key, wrenches in contacts.wrenches.items():
            pieces.setdefault(key, []).append(wrenches)
            times.setdefault(key, []).append(contacts.time_s[key])
    return ContactWrenches(
        sub_model=first.sub_model,
        candidates=first.candidates,
        wrenches={key: concatenated(several) for key, several in pieces.items()},
        time_s={key: joined_times(several) for key, several in times.items()},
        expected=concatenated([contacts.expected for contacts in recordings.values()]),
        left_out=tuple(f"{name}: {words}" for name, contacts in recordings.items() for words in contacts.left_out),
    )


def _over(
    free: FreeSubModel,
    interval: Interval,
    sub_model: ContactForceValidation,
    candidates: tuple[CalibrationUnderTest, ...],
) -> tuple[list[FloatArray], FloatArray]:
    """Contact wrench at the sensor by every candidate and its own offset, and the reading without any; not filtered."""
    joints, root = free.run.motion(interval, sub_model.required_joints)
    measured = free.measured(sub_model.others if free.corrections else (), interval)
    # by their places, because a calibration may be called `prior` too
    readings = {str(k): free.run.measured(interval, candidate.correction) for k, candidate in enumerate(candidates)}
    forces = estimate_contact_wrenches(
        sub_model, joints, root, readings, measured=Wrenches.of(measured) if measured else None
    )
    return [forces.of(place) for place in readings], forces.free_reading
