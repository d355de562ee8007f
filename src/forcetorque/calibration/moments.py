# SPDX-License-Identifier: BSD-3-Clause
"""Reduce recordings of a sensor to the moments that a calibration needs, with the error of estimated loads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.contact_windows import Disagreeing, agreeing_samples
from forcetorque.calibration.model_error_derivatives import model_columns
from forcetorque.experiment.calibration.assumptions import Assumptions
from forcetorque.experiment.calibration.moment_blocks import in_blocks
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments, VariableDescription
from forcetorque.experiment.campaign_intervals import CampaignInterval, CampaignRecording
from forcetorque.experiment.raw_counts import full_scale_of
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.parameter_vector import OF_LOAD, Kind, places

_ROUNDING = 1e-12
"""Share of the largest variance below which a combination of loads is known exactly."""


def load_error_of(solution: LoadSolution) -> LoadError | None:
    """Tell by how much errors of estimated loads move the response of a sensor and its offsets.

    Args:
        solution: Loads that were estimated with a matrix that is known in part.

    Returns:
        The errors; None where no load was estimated, or the matrix was taken as exact.
    """
    listed = solution.guess.parameters
    loads = [k for k, one in enumerate(listed) if one.kind in OF_LOAD]
    loads = [k for k in loads if np.isfinite(solution.covariance[k, k])]
    if not loads or not places(listed, Kind.MATRIX):
        return None
    own = solution.covariance[np.ix_(loads, loads)]
    size = np.sqrt(np.diag(own))
    size[size == 0.0] = 1.0
    variance, directions = np.linalg.eigh(own / np.outer(size, size))
    uncertain = variance > _ROUNDING * variance.max(initial=0.0)
    # S^-1/2, in the directions in which loads are uncertain
    root = directions[:, uncertain] / np.sqrt(variance[uncertain]) / size[:, None]
    sessions = [session.session for session in solution.sessions]
    factor = np.zeros((6, 6 + len(sessions), root.shape[1]))
    for row in range(6):
        factor[row, :6] = solution.covariance[np.ix_(places(listed, Kind.MATRIX, row), loads)] @ root
        for number in range(len(sessions)):
            biases = places(listed, Kind.BIAS, number)
            if biases and np.isfinite(solution.covariance[biases[row], biases[row]]):
                factor[row, 6 + number] = solution.covariance[biases[row], loads] @ root
    return LoadError(sessions=tuple(sessions), factor=factor)


def agreeing_moments(
    run: SensorRun,
    intervals: Sequence[CampaignInterval],
    *,
    variables: Sequence[LinearVariable],
    block_s: float | None = None,
    around: Sequence[DataSet] | None = None,
) -> tuple[list[IntervalMoments], list[str]]:
    """Reduce intervals of a recording, without the samples that disagree with all others.

    With a prior matrix they come with what errors of the robot model do to the expected wrenches.

    Args:
        run: The sensor in the recording.
        intervals: Samples of its calibration intervals.
        variables: Linear variables that are fitted.
        block_s: As of `recording_moments`.
        around: The same samples with those beside each interval, of parts that something may touch across their ends;
            None for the intervals alone.

    Returns:
        What is kept of the intervals, and a sentence per span that was left out.
    """
    recording, data_sets = CampaignRecording.of(run), [interval.data_set for interval in intervals]
    compared = data_sets if around is None else around
    of_compared, spans = agreeing_samples(
        compared, recording.sensor.prior, assumptions_of(recording), variables=variables, drift=recording.options.drift
    )
    if around is None:
        agree = of_compared
    else:
        pairs = zip(data_sets, around, of_compared, strict=True)
        agree = [np.isin(data.time_s, wider.time_s[marks]) for data, wider, marks in pairs]
        spans = tuple(_within(data_sets, spans))
    kept: list[IntervalMoments] = []
    for interval, data, marks in zip(intervals, data_sets, agree, strict=True):
        if marks.any():
            moments = interval.moments(marks)
            if recording.sensor.prior is not None:
                model = model_columns(run, interval.part.interval, data.kept(marks))
                moments = moments.with_model(model.terms, model.columns)
            kept += [moments] if block_s is None else in_blocks(moments, data.kept(marks), block_s)
    start_s = recording.start_ns * 1e-9
    return kept, [
        f"interval {span.label!r}: {span.start_s - start_s:.2f} to {span.end_s - start_s:.2f} s is left out: the "
        f"readings disagree there with all others, by up to {span.force_N:.2g} N and {span.moment_Nm:.2g} N m, as if "
        "something touched the distal links; `inspect` shows contacts"
        for span in spans
    ]


def _within(data_sets: Sequence[DataSet], spans: Sequence[Disagreeing]) -> Iterator[Disagreeing]:
    """Spans cut at the first and last sample of their intervals."""
    times = {data.label: data.time_s for data in data_sets}
    for span in spans:
        first_s, last_s = (float(times[span.label][place]) for place in (0, -1))
        if span.start_s <= last_s and span.end_s >= first_s:
            yield replace(span, start_s=max(span.start_s, first_s), end_s=min(span.end_s, last_s))


def assumptions_of(recording: CampaignRecording) -> Assumptions:
    """Give what the options of a recording, and the full scale of its sensor, let a fit assume.

    Args:
        recording: The recording of one sensor.

    Returns:
        The assumptions.
    """
    options = recording.options
    return Assumptions(
        full_scale=channel_full_scale(recording),
        load_full_scale=None if recording.sensor.measured.all() else recording.sensor.full_scale,
        accuracy=options.accuracy,
        repeatability=options.repeatability,
        mount=options.tolerance.mount_of(recording.sensor.name),
    )


def moments_of(
    recording: CampaignRecording,
    intervals: Sequence[IntervalMoments],
    *,
    variables: Sequence[LinearVariable],
    doubts: Sequence[str],
) -> RecordingMoments:
    """Put what is kept of intervals beside what the recording says about the sensor.

    Args:
        recording: The recording.
        intervals: What is kept of its intervals.
        variables: Linear variables that are fitted.
        doubts: What makes any fit of them doubtful.

    Returns:
        The moments of the recording.

    Raises:
        ExperimentError: If the full scale of the sensor is not known.
    """
    sensor, options = recording.sensor, recording.options
    mount = options.tolerance.mount_of(sensor.name)
    return RecordingMoments(
        sensor=recording.identity,
        experiment=recording.experiment,
        prior=sensor.prior,
        prior_source=sensor.prior_source,
        full_scale=channel_full_scale(recording),
        load_full_scale=None if sensor.measured.all() else sensor.full_scale,
        accuracy=options.accuracy,
        repeatability=options.repeatability,
        mount_rotation_rad=mount.rotation_rad,
        mount_shift_m=mount.shift_m,
        drift=options.drift,
        nonlinear=options.nonlinear,
        variables=tuple(map(VariableDescription.of, variables)),
        intervals=tuple(intervals),
        warnings=tuple(doubts),
        added=recording.added,
        inputs_sha256=dict(recording.inputs_sha256),
    )


def channel_full_scale(recording: CampaignRecording) -> FloatArray:
    """Give the full scale of every channel of a sensor's raw reading.

    Args:
        recording: What the recording says about the sensor.

    Returns:
        Full scales; shape (c,); counts, or N and N m where the logged wrench takes the place of counts.
    """
    return full_scale_of(recording.sensor, recording.options.accuracy, channels=recording.channels)
