# SPDX-License-Identifier: BSD-3-Clause
"""The generative fit of every combination of data sets, to be judged beside the types of the thesis."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.analysis.calibration.generative import generative_calibration
from forcetorque.analysis.calibration.recording_moments import agreeing_moments, moments_of
from forcetorque.analysis.runs.campaign_interval import CampaignInterval
from forcetorque.analysis.study.data import StudyData
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration, IntervalMoments, RecordingMoments, gate
from forcetorque.errors import ExperimentError, FitError
from forcetorque.study import GenerativeCandidate


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GenerativeFits:
    """What the generative model makes of the combinations."""

    candidates: tuple[GenerativeCandidate, ...]
    """Fits to be judged."""
    calibrations: Mapping[str, Calibration]
    """The same as artefacts, by combination."""
    left_out: tuple[str, ...]
    """Combinations that it cannot be fitted to, with the reason."""


def generative_fits(
    data: StudyData, combinations: Mapping[str, Collection[str]], *, code_version: str, created: str
) -> GenerativeFits:
    """Fit every combination by the generative model, as `calibrate` does.

    Args:
        data: Samples of the sensor.
        combinations: Labels of the intervals of each combination, by its name.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.

    Returns:
        The fits. A combination without a load, with readings that do not follow it, or without a prior and with too few
        loads, is left out.
    """
    kept, doubts = _kept(data)
    calibrations: dict[str, Calibration] = {}
    candidates, left_out = [], []
    for name, labels in combinations.items():
        intervals = [one for one in data.calibration if one.label in labels and one.label in kept]
        try:
            recordings = _recordings(data, intervals, kept, doubts)
            calibration = generative_calibration(recordings, code_version=code_version, created=created)
        except (FitError, ExperimentError) as error:
            left_out.append(f"{name} generative: {error}")
            continue
        calibrations[name] = calibration
        candidates.append(_candidate(name, calibration, [kept[interval.label] for interval in intervals]))
    return GenerativeFits(candidates=tuple(candidates), calibrations=calibrations, left_out=tuple(left_out))


def _kept(data: StudyData) -> tuple[dict[str, IntervalMoments], dict[str, list[str]]]:
    """Intervals by their labels, without samples that disagree; and what was left out, by recording."""
    kept: dict[str, IntervalMoments] = {}
    doubts: dict[str, list[str]] = {}
    variables = [variable.linear for variable in data.sensor.variables]
    for name in dict.fromkeys(interval.recording for interval in data.calibration):
        own = [interval for interval in data.calibration if interval.recording == name]
        moments, doubts[name] = agreeing_moments(data.recordings[name], own, variables=variables)
        kept |= {one.interval.label: one for one in moments}
    return kept, doubts


def _recordings(
    data: StudyData,
    intervals: Sequence[CampaignInterval],
    kept: Mapping[str, IntervalMoments],
    left_out: Mapping[str, Sequence[str]],
) -> list[RecordingMoments]:
    sensor = data.sensor
    doubts = gate.examine([interval.data_set for interval in intervals], sensor.prior, sensor.full_scale)
    return [
        moments_of(
            data.recordings[name],
            [kept[interval.label] for interval in intervals if interval.recording == name],
            variables=[variable.linear for variable in sensor.variables],
            doubts=[*(doubt.message for doubt in doubts), *left_out[name]],
        )
        for name in dict.fromkeys(interval.recording for interval in intervals)
    ]


def _candidate(name: str, calibration: Calibration, intervals: Sequence[IntervalMoments]) -> GenerativeCandidate:
    if calibration.posterior is None:
        raise FitError(f"{name} generative: expected a posterior, got none")
    return GenerativeCandidate(
        data_set=name,
        model=calibration.model,
        offsets={session.name: session.offset for session in calibration.sessions},
        squared_error=_squared_error(calibration, intervals),
        posterior=calibration.posterior,
    )


def _squared_error(calibration: Calibration, intervals: Sequence[IntervalMoments]) -> FloatArray:
    """Mean squared error over all samples, each read with the offset of its session."""
    offsets = {session.name: session.offset for session in calibration.sessions}
    errors = [one.moments.squared_error(replace(calibration.model, offset=offsets[one.session])) for one in intervals]
    mean: FloatArray = np.average(errors, axis=0, weights=[one.samples for one in intervals])
    return mean
