# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches, joint torques and expected readings over the intervals of an experiment."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.estimation.clock_stream import clock_stream
from forcetorque.estimation.interval import IntervalQuestion
from forcetorque.estimation.section import LENGTH_SCALE
from forcetorque.estimation.skin.known_wrenches import SkinSource, frames_of_patches, uncertainty_of, with_skin
from forcetorque.estimation.uncertain.estimate import estimate_with_covariance
from forcetorque.estimation.uncertain.estimates import UncertainEstimates
from forcetorque.experiment.contacts import touched_otherwise
from forcetorque.experiment.experiment import Experiment, ExperimentContact
from forcetorque.experiment.sensor_reading import Correction, Readings, readings_at
from forcetorque.experiment.validity import AppliedReadings, applied_readings
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.ambiguity import indistinguishable
from forcetorque.robot.mechanics.estimates import Estimates
from forcetorque.robot.mechanics.samples import PaddedSamples, padded_samples
from forcetorque.robot.motion import JointMotion
from forcetorque.skin.wrench.wrench import PatchFrames


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
    asked = IntervalQuestion.of(experiment, interval, samples, named, length_scale=length_scale, patches=patches)
    question, joints, skin, inside = asked.question, asked.joints, asked.skin, samples.inside
    measured = asked.measured(corrections)
    estimates = asked.estimates(measured, progress=progress)
    answer = None
    if patches:
        uncertainty = uncertainty_of(experiment, corrections, skin, measured, label=interval.label)
        answer = estimate_with_covariance(
            question, joints, asked.root, measured=measured, known=asked.known, uncertainty=uncertainty
        )
        estimates = with_skin(estimates, answer)
    return IntervalEstimates(
        interval=interval,
        stamp_ns=samples.stamp_ns[inside],
        measured=Wrenches(names=measured.names, values=measured.values[inside]),
        estimates=_smoothed(estimates, samples),
        left_out=asked.left_out,
        ambiguous=indistinguishable(question, JointMotion.at_rest(joints.names, joints.position[inside])),
        applied=dict(_applied(experiment, corrections, interval, samples)),
        skin=tuple(source.of_samples(inside) for source in skin),
        uncertain=None if answer is None else answer.of_samples(inside),
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
