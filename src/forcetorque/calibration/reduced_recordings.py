# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of a sensor reduced to what a calibration needs of each: a long one segment by segment."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.calibration.interval_and_mount_doubts import SegmentedDoubts, mount_doubts
from forcetorque.calibration.moments_of_samples import SegmentedMoments, agreeing_moments, load_error_of, moments_of
from forcetorque.experiment.calibration.moment_blocks import BLOCK_S, joined
from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.campaign_intervals import CampaignRecording
from forcetorque.experiment.long_recording import is_long, segment_runs, segments_of_run
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.load_warnings import reference_doubts
from forcetorque.payload.loads_on_robot_links import link_loads
from forcetorque.recording.recording import Use


def recording_moments(runs: Runs, *, block_s: float | None = None) -> list[RecordingMoments]:
    """Reduce the calibration intervals of a sensor.

    Args:
        runs: The sensor, in one experiment or several.
        block_s: Longest block that intervals are divided into, `moment_blocks.joined` puts them together; s; None for
            whole intervals.

    Returns:
        Moments and means of every recording.

    Raises:
        ExperimentError: If there is no calibration interval, or the full scale of the sensor is not known.
    """
    from forcetorque.inspection.plausibility.gate import examine

    campaign = Campaign.of(runs)
    sensor = campaign.sensor
    long = [run for run in campaign.runs if run.has(Use.CALIBRATION) and is_long(run)]
    short = [run for run in campaign.runs_with(Use.CALIBRATION) if run not in long]
    without_variables = campaign.runs[0].experiment.fit_options.with_variables is False
    variables = [] if without_variables else [v.linear for v in sensor.variables]
    names = [variable.name for variable in variables]
    intervals = campaign.samples(Use.CALIBRATION, variables=names, runs=short)
    doubts = examine([interval.data_set for interval in intervals], sensor.prior, sensor.full_scale) if short else ()
    turned = mount_doubts(campaign, intervals)
    results = []
    for run, recording in zip(campaign.runs, campaign.recordings, strict=True):
        if run in long:
            results.append(_of_segments(campaign, run, block_s))
        elif own := [interval for interval in intervals if interval.recording == recording]:
            kept, left_out = agreeing_moments(run, own, variables=variables, block_s=block_s)
            said = [*(doubt.message for doubt in doubts), *turned, *reference_doubts(run), *left_out]
            moments = moments_of(CampaignRecording.of(run), kept, variables=variables, doubts=said)
            results.append(moments.model_copy(update={"load_error": _load_error(run)}))
    return results


@dataclass(frozen=True, slots=True, kw_only=True)
class ReducedRecording:
    """What a calibration needs of a long recording."""

    moments: RecordingMoments | ForceTorqueError | None
    """Its moments, in blocks; the error where it cannot be fitted; None without a calibration interval."""
    warnings: tuple[str, ...]
    """What makes any fit on it doubtful."""


def reduced_in_segments(run: SensorRun, *, block_s: float = BLOCK_S) -> ReducedRecording:
    """Reduce a long recording, once.

    Args:
        run: The sensor.
        block_s: Longest block of moments; s.

    Returns:
        What a calibration needs of it.
    """
    return run.once(("reduced", block_s), _reduced, run, block_s)


def _reduced(run: SensorRun, block_s: float) -> ReducedRecording:
    moments, doubts = SegmentedMoments(run, block_s=block_s), SegmentedDoubts(run)
    refusal: ForceTorqueError | None = None
    for part in segment_runs(run):
        if refusal is None:
            try:
                moments.add(part)
            except ForceTorqueError as error:
                refusal = error
        doubts.add(part)
        del part
    reduced: RecordingMoments | ForceTorqueError | None
    try:
        reduced = moments.moments() if refusal is None else refusal
    except ForceTorqueError as error:
        reduced = error
    return ReducedRecording(moments=reduced, warnings=doubts.warnings(segments_of_run(run)))


def _of_segments(campaign: Campaign, run: SensorRun, block_s: float | None) -> RecordingMoments:
    """Moments of a long recording by the names of a campaign."""
    reduced = reduced_in_segments(run, block_s=BLOCK_S if block_s is None else block_s).moments
    if not isinstance(reduced, RecordingMoments):
        raise reduced or ExperimentError(f"sensor {run.sensor.name!r}: expected a calibration interval, got none")
    intervals = reduced.intervals if block_s is not None else joined(reduced.intervals)
    named = tuple(_named(campaign, run, interval) for interval in intervals)
    return reduced.model_copy(update={"intervals": named})


def _named(campaign: Campaign, run: SensorRun, moments: IntervalMoments) -> IntervalMoments:
    label = moments.interval.label
    names = {"label": campaign.label(run, label), "session": campaign.session(run, label)}
    interval = moments.interval.model_copy(update=names)
    return moments.model_copy(update={"interval": interval, "recording": campaign.recording(run)})


def _load_error(run: SensorRun) -> LoadError | None:
    """What is not known of loads on links that the sensor itself weighed, with the matrix of the same fit."""
    loads = link_loads(run.experiment)
    if loads is None or loads.are_stated or loads.weigher.name != run.sensor.name:
        return None
    return load_error_of(loads.solution(run.experiment))


def store_moments(runs: Runs, folder: Path | str, *, force: bool = False) -> list[Path]:
    """Keep what a calibration needs of every recording of a sensor.

    Args:
        runs: The sensor, in one experiment or several.
        folder: Where the files go; made where it is missing.
        force: As of `RecordingMoments.save`.

    Returns:
        The files, one per recording.
    """
    place = Path(folder)
    place.mkdir(parents=True, exist_ok=True)
    files = []
    for recording in recording_moments(runs):
        name = f"{recording.sensor.name}_{recording.sensor.serial}_{recording.intervals[0].recording}"
        files.append(place / f"{quote(name, safe=' ')}.json")
        recording.save(files[-1], force=force)
    return files
