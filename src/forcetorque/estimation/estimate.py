# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches, joint torques and expected wrenches over the intervals of an experiment."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.labelled_arrays import TIME, LabelledArray, wrench_array, xarray_dataset
from forcetorque.estimation.section import LENGTH_SCALE
from forcetorque.estimation.skin_contacts import (
    SkinSource,
    clock_stream,
    frames_of_patches,
    sources_at,
    uncertainty_of,
    with_skin,
)
from forcetorque.estimation.uncertain.estimate import UncertainEstimates, estimate_with_covariance
from forcetorque.experiment.contacts import contacts_at_sensors, contacts_in, touched_otherwise
from forcetorque.experiment.experiment import Experiment, ExperimentContact
from forcetorque.experiment.offsets import intervals_in_use
from forcetorque.experiment.seen_and_outside_samples import AppliedReadings, applied_readings
from forcetorque.experiment.sensor_reading import Correction, Readings, readings_at, wrench_at
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.contact_wrenches_and_torques import indistinguishable
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.measured_and_expected_wrench import PaddedSamples, padded_samples
from forcetorque.robot.mechanics.question import MinimumNorm, Question, TorqueSum, moving_joints, required_joints_of
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree, outboard_bodies
from forcetorque.skin.section import force_patches
from forcetorque.skin.wrench.skin_wrench import PatchFrames


def narrowed(
    question: Question, available: Collection[str], *, required: Collection[str]
) -> tuple[Question, list[str]]:
    """Leave out what needs joints that were not logged.

    A torque is left out too if a contact that it depends on is: it would be wrong without. Contacts whose wrench is
    known need no equation, and stay.

    Args:
        question: Everything that is wanted.
        available: Joints whose motion is known.
        required: Contacts requested by name.

    Returns:
        What can be estimated, and descriptions of what was left out.

    Raises:
        ExperimentError: If a required contact would be left out.
    """
    kept: list[Contact] = []
    solved, left_out = [], []
    for part in question.parts:
        inside = [contact for contact in question.contacts if question.body_of(contact) in part.bodies]
        missing = _missing(question, available, contacts=inside, equations=(part.name,))
        if not missing:
            kept += inside
            solved.append(part.name)
            continue
        refused = [contact.name for contact in inside if contact.name in required]
        if refused:
            raise ExperimentError(
                f"contact {refused[0]!r}: its sub-model {part.name!r} cannot be solved, {_missing_joints(missing)}"
            )
        known = [contact for contact in inside if contact.type is ContactType.KNOWN]
        kept += known
        names = ", ".join(contact.name for contact in inside if contact not in known) or "none"
        left_out.append(f"sub-model {part.name} with its contacts ({names}): {_missing_joints(missing)}")
    torques = [joint for joint in question.torques if not _missing_for_torque(question, available, kept, joint)]
    dropped = [joint for joint in question.torques if joint not in torques]
    if dropped:
        left_out.append(f"torques of {', '.join(dropped)}: joints, or contacts that act on them, are not known")
    expected = []
    for sensor in question.expected:
        missing = _missing(question, available, expected=(sensor,))
        if missing:
            left_out.append(f"expected readings of {sensor}: {_missing_joints(missing)}")
        else:
            expected.append(sensor)
    contacts = tuple(contact for contact in question.contacts if contact in kept)
    solvable = replace(
        question, contacts=contacts, equations=tuple(solved), torques=tuple(torques), expected=tuple(expected)
    )
    return solvable, left_out


def _missing_for_torque(question: Question, available: Collection[str], kept: list[Contact], joint: str) -> list[str]:
    body = next(index for index, body in enumerate(question.tree.bodies) if body.joint == joint)
    outboard = outboard_bodies(question.tree, body)
    acting = [c for c in question.contacts if c in kept or outboard[question.body_of(c)]]
    return _missing(question, available, contacts=acting, torques=(joint,))


def _missing(
    question: Question,
    available: Collection[str],
    *,
    contacts: Collection[Contact] = (),
    equations: tuple[str, ...] = (),
    torques: tuple[str, ...] = (),
    expected: tuple[str, ...] = (),
) -> list[str]:
    part = replace(question, contacts=tuple(contacts), equations=equations, torques=torques, expected=expected)
    return [joint for joint in required_joints_of(part) if joint not in available]


def _missing_joints(missing: list[str]) -> str:
    return f"no stream holds the joint(s) {', '.join(missing)}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalProblem:
    """The estimation of contacts over one interval, with the motion of the robot and the known wrenches."""

    experiment: Experiment
    """The experiment."""
    interval: Interval
    """The interval."""
    samples: PaddedSamples
    """Its instants, n with those around it."""
    question: Question
    """What is estimated, as far as the log allows."""
    left_out: tuple[str, ...]
    """What the log does not allow, for messages."""
    joints: JointMotion
    """Motion of the joints; n samples."""
    root: RootMotion
    """Motion of the support frame."""
    skin: tuple[SkinSource, ...]
    """Contacts on skin; n samples."""
    known: Wrenches | None
    """Wrenches of known contacts; n samples."""

    @classmethod
    def of(
        cls,
        experiment: Experiment,
        interval: Interval,
        samples: PaddedSamples,
        contacts: Sequence[ExperimentContact],
        *,
        only_named: bool | None = None,
        length_scale: float | None = None,
        patches: Sequence[PatchFrames] = (),
    ) -> IntervalProblem:
        """Set up the estimation of contacts over an interval.

        Args:
            experiment: The experiment.
            interval: The interval.
            samples: Its instants.
            contacts: Contacts beside the support, of all intervals.
            only_named: Whether only the named contacts are estimated; where not, a contact at every sensor stands for
                all contacts of the links outboard of it. By default only named ones where any is named.
            length_scale: Moment that weighs as much as one newton, where contacts leave something undetermined; m.
            patches: What patches of skin say.

        Returns:
            What is estimated, with its inputs.

        Raises:
            ExperimentError: If the interval has no support, or a named contact is not identifiable.
        """
        support = interval.support
        if support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        present, at_ns = contacts_in(interval, contacts), samples.stamp_ns
        skin = sources_at(experiment, patches, at_ns)
        named = bool(contacts) if only_named is None else only_named
        question = _question(experiment, support, present, skin, only_named=named, length_scale=length_scale)
        available = set(experiment.recording.joint_signals("position"))
        question, left_out = narrowed(question, available, required={entry.contact.name for entry in present})
        source = clock_stream(experiment)
        joints, root = experiment.motion_at(support, required_joints_of(question), source, at_ns)
        for stream in (entry.stream for entry in present if entry.stream):
            require_overlap(source, experiment.recording.stream(stream))
        return cls(
            experiment=experiment,
            interval=interval,
            samples=samples,
            question=question,
            left_out=tuple(left_out),
            joints=joints,
            root=root,
            skin=tuple(skin),
            known=_known(experiment, question, present, skin, at_ns),
        )

    def measured(self, corrections: Mapping[str, Correction]) -> Wrenches:
        """Read the sensors.

        Args:
            corrections: How each is read.

        Returns:
            What they measured; n samples.

        Raises:
            RecordingError: If a stream does not overlap the instants.
        """
        experiment, readings = self.experiment, {}
        for sensor in experiment.sensors:
            correction = corrections[sensor.name]
            streams = [sensor.stream, *(sensor.variable(name).source.stream for name in correction.variables)]
            for stream in streams:
                require_overlap(clock_stream(experiment), experiment.recording.stream(stream))
            readings[sensor.name] = wrench_at(
                experiment, sensor, correction, self.samples.stamp_ns, interval=self.interval
            )
        return Wrenches.of(readings) if readings else Wrenches(names=(), values=np.empty((len(self.joints), 0, 6)))

    def estimates(self, measured: Wrenches, *, progress: Callable[[int], None] | None = None) -> Estimates:
        """Estimate.

        Args:
            measured: What the sensors measured; n samples.
            progress: Called with the number of samples done.

        Returns:
            The estimates; n samples, not filtered.
        """
        return estimate(self.question, self.joints, self.root, measured=measured, known=self.known, progress=progress)


def _question(
    experiment: Experiment,
    support: Support | MovingSupport,
    present: Sequence[ExperimentContact],
    skin: Sequence[SkinSource],
    *,
    only_named: bool,
    length_scale: float | None,
) -> Question:
    tree = build_tree(experiment.model_on(support), support.frame)
    sensors = tuple(sensor.name for sensor in experiment.sensors)
    contacts = [entry.contact for entry in present]
    if support.frame not in [contact.name for contact in contacts]:
        contacts.insert(0, Contact(link=support.frame))
    if not only_named:
        contacts += contacts_at_sensors(tree, sensors)
    return Question(
        tree=tree,
        measured=sensors,
        contacts=(*contacts, *(source.contact for source in skin)),
        torques=moving_joints(tree),
        # errors leave nothing in a sub-model that its neighbours' torques would need
        torque_sum=TorqueSum.SUB_MODEL if force_patches(experiment) else TorqueSum.WHOLE_TREE,
        expected=sensors,
        minimum_norm=None if length_scale is None else MinimumNorm(length_scale=length_scale),
    )


def _known(
    experiment: Experiment,
    question: Question,
    present: Sequence[ExperimentContact],
    skin: Sequence[SkinSource],
    at_ns: IntArray,
) -> Wrenches | None:
    streams = {e.contact.name: e.stream for e in present if e.stream is not None}
    wrenches = {source.contact.name: source.wrench for source in skin}
    for contact in question.contacts:
        if contact.type is ContactType.KNOWN and contact.name in streams:
            stream = experiment.recording.stream(streams[contact.name])
            wrenches[contact.name] = interpolate(stream, stream.signal("wrench").values, at_ns)
    return Wrenches.of(wrenches) if wrenches else None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalEstimates:
    """Estimates over one interval."""

    interval: Interval
    """The interval."""
    stamp_ns: IntArray
    """Instants: those of the first sensor's stream; shape (n,); ns."""
    measured: Wrenches
    """What the sensors measured, corrected."""
    estimates: Estimates
    """What was estimated."""
    left_out: tuple[str, ...]
    """What the log does not allow to estimate, for messages."""
    ambiguous: Mapping[str, tuple[tuple[str, ...], ...]]
    """Unknowns that are not separable, by sub-model."""
    applied: Mapping[str, AppliedReadings]
    """Of every sensor that a calibration reads, which readings lie outside what was fitted; n samples, smoothed."""
    skin: tuple[SkinSource, ...] = ()
    """Contacts on skin; n samples, as they were felt."""
    uncertain: UncertainEstimates | None = None
    """Contacts and torques with covariances, before any filter; None without skin."""

    def to_xarray(self) -> Any:
        """Give measured and expected wrenches, contact wrenches and joint torques as a data set of xarray.

        Returns:
            `xarray.Dataset` over `time`, `sensor`, `contact`, `joint` and `axis`; what was not estimated is left out.

        Raises:
            MissingExtraError: If xarray is not installed.
        """
        estimates, layout = self.estimates, self.estimates.layout
        measured = "sensor" if self.measured.names == layout.sensors else "measured_sensor"
        arrays = {
            "measured": wrench_array(
                self.measured.values, measured, long_name="measured by the sensors, in their frames"
            ),
            "expected": wrench_array(
                estimates.expected, "sensor", long_name="expected measurement, in the frame of the sensor"
            ),
            "contact_wrench": wrench_array(
                estimates.contact_wrenches, "contact", long_name="environment on robot, in and about the contact frame"
            ),
            "torque": LabelledArray(
                values=estimates.torques,
                dims=(TIME, "joint"),
                units="N m, N of prismatic joints",
                attributes={"long_name": "joint torque along +q"},
            ),
        }
        names = {
            measured: self.measured.names,
            "sensor": layout.sensors,
            "contact": layout.contacts,
            "joint": layout.joints,
        }
        present = {name: array for name, array in arrays.items() if np.asarray(array.values).shape[1]}
        return xarray_dataset(
            self.stamp_ns,
            present,
            {dim: labels for dim, labels in names.items() if labels},
            interval=self.interval.label,
        )


def estimate_experiment(
    experiment: Experiment,
    corrections: Mapping[str, Correction],
    *,
    contacts: Sequence[ExperimentContact] | None = None,
    length_scale: float | None = None,
    progress: Callable[[int, int], None] | None = None,
    patches: Sequence[PatchFrames] | None = None,
) -> list[IntervalEstimates]:
    """Estimate over every interval that is not to be ignored.

    The support touches the world with a full wrench. Without other contacts, all contacts of
    the links outboard of a sensor are given as one wrench in the frame of that sensor.

    Args:
        experiment: The experiment.
        corrections: How its sensors are read (`corrections_of`).
        contacts: Contacts in place of the experiment's.
        length_scale: Length scale in place of the experiment's; m.
        progress: Called with the number of samples done and of all.
        patches: What its patches say (`frames_of_patches`); they are read if None.

    Returns:
        Estimates in the order of the intervals.

    Raises:
        ExperimentError: If no interval has a support.
    """
    intervals = intervals_in_use(experiment)
    named = experiment.contacts if contacts is None else tuple(contacts)
    scale = experiment.section(LENGTH_SCALE) if length_scale is None else length_scale
    source = clock_stream(experiment)
    skinned = frames_of_patches(experiment) if patches is None else patches
    recording, smoothing = experiment.recording, experiment.processing.smoothing
    taken = [
        padded_samples(recording, source, span, smoothing, apart=touched_otherwise(span, recording, named))
        for span in intervals
    ]
    total, done = sum(len(samples.rows) for samples in taken), 0
    results = []
    for interval, samples in zip(intervals, taken, strict=True):
        before = done
        report = None if progress is None else lambda count, start=before: progress(start + count, total)
        results.append(_over(experiment, corrections, interval, samples, named, scale, report, skinned))
        done += len(samples.rows)
    return results


def _over(
    experiment: Experiment,
    corrections: Mapping[str, Correction],
    interval: Interval,
    samples: PaddedSamples,
    named: Sequence[ExperimentContact],
    length_scale: float | None,
    progress: Callable[[int], None] | None,
    patches: Sequence[PatchFrames],
) -> IntervalEstimates:
    problem = IntervalProblem.of(experiment, interval, samples, named, length_scale=length_scale, patches=patches)
    question, joints, skin, inside = problem.question, problem.joints, problem.skin, samples.inside
    measured = problem.measured(corrections)
    estimates = problem.estimates(measured, progress=progress)
    with_covariance = None
    if patches:
        uncertainty = uncertainty_of(experiment, corrections, skin, measured, label=interval.label)
        with_covariance = estimate_with_covariance(
            question, joints, problem.root, measured=measured, known=problem.known, uncertainty=uncertainty
        )
        estimates = with_skin(estimates, with_covariance)
    return IntervalEstimates(
        interval=interval,
        stamp_ns=samples.stamp_ns[inside],
        measured=Wrenches(names=measured.names, values=measured.values[inside]),
        estimates=_smoothed(estimates, samples),
        left_out=problem.left_out,
        ambiguous=indistinguishable(question, JointMotion.at_rest(joints.names, joints.position[inside])),
        applied=dict(_applied(experiment, corrections, interval, samples)),
        skin=tuple(source.of_samples(inside) for source in skin),
        uncertain=None if with_covariance is None else with_covariance.of_samples(inside),
    )


def _applied(
    experiment: Experiment, corrections: Mapping[str, Correction], interval: Interval, samples: PaddedSamples
) -> Iterator[tuple[str, AppliedReadings]]:
    """Which readings lie outside what was fitted: smoothed, as those were that were fitted."""
    sessions = experiment.session_names(interval.label)
    for sensor in experiment.sensors:
        calibration = corrections[sensor.name].calibration
        if calibration is None:
            continue
        names = corrections[sensor.name].variables
        readings = readings_at(experiment, sensor, names, samples.stamp_ns)
        columns = [readings.logged, *(readings.variables[name][:, None] for name in names)]
        values, channels = samples.smoothed(np.hstack(columns)), readings.logged.shape[1]
        variables = dict(zip(names, values[:, channels:].T, strict=True))
        smoothed = Readings.of(sensor, values[:, :channels], variables)
        yield sensor.name, applied_readings(calibration, smoothed, sessions)


def _smoothed(estimates: Estimates, samples: PaddedSamples) -> Estimates:
    """Filter results as readings and references are filtered elsewhere; rank and condition stay as they are."""
    n, count = len(estimates), int(np.count_nonzero(samples.inside))
    arrays: dict[str, FloatArray] = {}
    for name in ("expected", "contact_wrenches", "torques", "net_wrenches", "residual"):
        values = getattr(estimates, name)
        filtered = samples.smoothed(values.reshape(n, -1)) if values.size else values[samples.inside]
        arrays[name] = np.ascontiguousarray(filtered.reshape(count, *values.shape[1:]))
    rank, condition = estimates.rank[samples.inside], estimates.condition[samples.inside]
    return Estimates(layout=estimates.layout, rank=rank, condition=condition, **arrays)
