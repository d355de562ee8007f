# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches, joint torques and expected readings over the intervals of an experiment."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.answerable import narrowed
from forcetorque.analysis.reading import Correction, Readings, readings_at, wrench_at
from forcetorque.analysis.skin_sources import frames_of_patches, sources_at, uncertainty_of, with_skin
from forcetorque.analysis.skin_wrench import PatchFrames
from forcetorque.analysis.validity import AppliedReadings, applied_readings
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import ExperimentError
from forcetorque.estimation import (
    Contact,
    ContactType,
    Estimates,
    MinimumNorm,
    Question,
    TorqueSum,
    estimate,
    indistinguishable,
    moving_joints,
    required_joints_of,
)
from forcetorque.estimation.picked import PaddedSamples, padded_samples
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.estimation.uncertain import SkinSource, UncertainEstimates, estimate_with_covariance
from forcetorque.experiment.contacts import contacts_at_sensors, contacts_in, touched_otherwise
from forcetorque.experiment.content import Experiment, ExperimentContact
from forcetorque.recording import Interval, MovingSupport, Support, Use
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.robot import JointMotion, Wrenches, build_tree


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
    """What the log does not allow to estimate, in words."""
    ambiguous: Mapping[str, tuple[tuple[str, ...], ...]]
    """Unknowns that cannot be told apart, by sub-model."""
    applied: Mapping[str, AppliedReadings]
    """Of every sensor that a calibration reads, which readings lie outside what was fitted; n samples, smoothed."""
    skin: tuple[SkinSource, ...] = ()
    """Contacts on skin; n samples, as they were felt."""
    uncertain: UncertainEstimates | None = None
    """Contacts and torques with covariances, before any filter; None without skin."""


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

    The support touches the world with a full wrench. Without other contacts, whatever touches the
    part outboard of a sensor is given in the frame of that sensor.

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
    intervals = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if not intervals:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not to be ignored")
    named = experiment.contacts if contacts is None else tuple(contacts)
    scale = experiment.length_scale if length_scale is None else length_scale
    source = experiment.clock_stream
    skinned = frames_of_patches(experiment) if patches is None else patches
    recording, smoothing = experiment.recording, experiment.processing.smoothing
    taken = [
        padded_samples(recording, source, each, smoothing, apart=touched_otherwise(each, recording, named))
        for each in intervals
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
    support = interval.support
    if support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
    present, at_ns, inside = contacts_in(interval, named), samples.stamp_ns, samples.inside
    skin = sources_at(experiment, patches, at_ns)
    question = _question(experiment, support, present, skin, asked=bool(named), length_scale=length_scale)
    available = set(experiment.recording.joint_signals("position"))
    question, left_out = narrowed(question, available, required={entry.contact.name for entry in present})
    processing = experiment.processing
    source = experiment.clock_stream
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        required_joints_of(question),
        source,
        at_ns,
        processing=processing,
    )
    for stream in (*_reading_streams(experiment, corrections), *(e.stream for e in present if e.stream)):
        require_overlap(source, experiment.recording.stream(stream))
    measured = _measured(experiment, corrections, interval, at_ns)
    known = _known(experiment, question, present, skin, at_ns)
    estimates = estimate(question, joints, root, measured=measured, known=known, progress=progress)
    answer = None
    if patches:
        uncertainty = uncertainty_of(experiment, corrections, skin, measured, label=interval.label)
        answer = estimate_with_covariance(
            question, joints, root, measured=measured, known=known, uncertainty=uncertainty
        )
        estimates = with_skin(estimates, answer)
    return IntervalEstimates(
        interval=interval,
        stamp_ns=at_ns[inside],
        measured=Wrenches(names=measured.names, values=measured.values[inside]),
        estimates=_smoothed(estimates, samples),
        left_out=tuple(left_out),
        ambiguous=indistinguishable(question, JointMotion.at_rest(joints.names, joints.position[inside])),
        applied=dict(_applied(experiment, corrections, interval, samples)),
        skin=tuple(source.of_samples(inside) for source in skin),
        uncertain=None if answer is None else answer.of_samples(inside),
    )


def _measured(
    experiment: Experiment, corrections: Mapping[str, Correction], interval: Interval, at_ns: IntArray
) -> Wrenches:
    readings = {
        sensor.name: wrench_at(experiment, sensor, corrections[sensor.name], at_ns, interval=interval)
        for sensor in experiment.sensors
    }
    return Wrenches.of(readings) if readings else Wrenches(names=(), values=np.empty((len(at_ns), 0, 6)))


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


def _reading_streams(experiment: Experiment, corrections: Mapping[str, Correction]) -> list[str]:
    """Streams of the sensors, and of the variables that their corrections need."""
    streams = []
    for sensor in experiment.sensors:
        names = corrections[sensor.name].variables
        streams += [sensor.stream, *(sensor.variable(name).source.stream for name in names)]
    return streams


def _question(
    experiment: Experiment,
    support: Support | MovingSupport,
    present: Sequence[ExperimentContact],
    skin: Sequence[SkinSource],
    *,
    asked: bool,
    length_scale: float | None,
) -> Question:
    tree = build_tree(experiment.model_on(support), support.frame)
    sensors = tuple(sensor.name for sensor in experiment.sensors)
    contacts = [entry.contact for entry in present]
    if support.frame not in [contact.name for contact in contacts]:
        contacts.insert(0, Contact(link=support.frame))
    if not asked:
        contacts += contacts_at_sensors(tree, sensors)
    return Question(
        tree=tree,
        measured=sensors,
        contacts=(*contacts, *(source.contact for source in skin)),
        torques=moving_joints(tree),
        # errors leave nothing in a sub-model that its neighbours' torques would need
        torque_sum=TorqueSum.SUB_MODEL if experiment.force_patches else TorqueSum.WHOLE_TREE,
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
