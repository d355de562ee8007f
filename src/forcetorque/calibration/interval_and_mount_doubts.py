# SPDX-License-Identifier: BSD-3-Clause
"""What makes a fit on intervals of a recording doubtful, and the mount of a sensor before the fit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.errors import FitError
from forcetorque.base.noise.window_means import means_over, window_for
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.free_sub_model import possible_touch
from forcetorque.experiment.long_recording import joined_findings
from forcetorque.experiment.recording_notes import added_to
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment, unreliable_among
from forcetorque.payload.load_on_wrist_sensor import wrist_loads
from forcetorque.payload.load_warnings import contradicted_statements, load_doubts
from forcetorque.recording.recording import Finding, Interval, Use
from forcetorque.recording.segments import Segment
from forcetorque.robot.mount_estimate import MountEstimate, estimate_mount

_MOST_ALIKE = 5
"""Findings of one kind in an interval that are doubts by themselves; the rest is counted."""


def doubts_of_samples(run: SensorRun) -> Iterator[str]:
    """Say what makes any fit doubtful by the loads, and what the samples say about them.

    Args:
        run: The sensor, in a recording or a segment of one.

    Yields:
        The first sentences of `data_doubts`.
    """
    if (loads := wrist_loads(run.experiment)) is not None and not loads.are_stated:
        yield (
            "the load was estimated with this sensor's own reading, so a wrong gain cannot be seen; "
            "give mass_kg and centre_of_mass_m to judge it"
        )
    yield from contradicted_statements(run)
    yield from load_doubts(run)


def doubts_of_intervals(
    run: SensorRun, found: Sequence[tuple[Interval, Finding]], *, by_model: bool = True
) -> Iterator[str]:
    """Say which intervals are doubtful, without a look at samples.

    Args:
        run: The sensor in the whole recording.
        found: Findings in its calibration intervals, as of `unreliable_intervals`.
        by_model: As of `data_doubts`.

    Yields:
        The other sentences of `data_doubts`.
    """
    if by_model:
        yield from _touched(run)
        if (sentence := possible_touch(run)) is not None:
            yield sentence
    yield from added_to(run.experiment.recording)
    yield from _found(run.experiment.recording.start_ns, found)


def _found(start_ns: int, found: Sequence[tuple[Interval, Finding]]) -> Iterator[str]:
    """Findings in fitted intervals; a channel that saturates in every swing does not hide the others."""
    alike: dict[str, list[str]] = {}
    for interval, finding in found:
        start, end = (((stamp_ns or 0) - start_ns) * 1e-9 for stamp_ns in (finding.start_ns, finding.end_ns))
        kind = f"interval {interval.label!r}: {finding.stream} {finding.kind}"
        alike.setdefault(kind, []).append(f"{kind} at {start:.2f}-{end:.2f} s: {finding.message}")
    for kind, sentences in alike.items():
        yield from sentences[:_MOST_ALIKE]
        if len(sentences) > _MOST_ALIKE:
            yield f"{kind}: {len(sentences) - _MOST_ALIKE} more, which `inspect` lists"


def _touched(run: SensorRun) -> Iterator[str]:
    for interval in run.experiment.intervals(Use.CALIBRATION):
        if names := run.touched_beyond(interval):
            yield (
                f"interval {interval.label!r} is left out: {', '.join(names)} touches the robot beyond the sensor, by "
                "[[contact]] or contact_links, so that nobody knows what it must read; calibrate all sensors at once, "
                "--jointly, from Python calibrate_jointly"
            )


class SegmentedDoubts:
    """What makes a fit on a recording doubtful of which segments are looked at one after the other."""

    def __init__(self, run: SensorRun, *, by_model: bool = True) -> None:
        """Begin.

        Args:
            run: The sensor in the whole recording, of which no samples are looked at.
            by_model: As of `data_doubts`.
        """
        self._run, self._by_model = run, by_model
        self._said: dict[str, None] = {}
        self._found: list[Sequence[Finding]] = []

    def add(self, run: SensorRun) -> None:
        """Look at the next segment.

        Args:
            run: The sensor in the segment.
        """
        # a fit checks the causes by itself
        found = inspect_experiment(
            run.experiment, by_model=self._by_model, with_causes=False, sensors=[run.sensor.name], computed=run
        )
        self._found.append(found)
        if run.has(Use.CALIBRATION):
            self._said |= dict.fromkeys(doubts_of_samples(run))

    def warnings(self, segments: Sequence[Segment]) -> tuple[str, ...]:
        """Put together what was found.

        Returns:
            The sentences of `data_doubts`.
        """
        among = unreliable_among(joined_findings(segments, self._found), self._run.experiment, Use.CALIBRATION)
        return tuple(dict.fromkeys([*self._said, *doubts_of_intervals(self._run, among, by_model=self._by_model)]))


_DOUBTFUL = 3.0
"""Standard deviations by which a mount is off the stated one before there is a warning."""


def with_estimated_mount(campaign: Campaign) -> tuple[Campaign, SensorMount | None]:
    """Estimate the mount of a sensor by all calibration intervals, where it is unknown.

    Args:
        campaign: The recordings.

    Returns:
        The recordings with the sensor where it is mounted, and its mount; None where the robot model states it.

    Raises:
        FitError: If the recordings do not determine the mount; the message says what motion is missing.
    """
    sensor = campaign.sensor
    if not sensor.mount_is_unknown:
        return campaign, campaign.runs[0].experiment.mounts.get(sensor.name)
    stated = Campaign([SensorRun(run.experiment, replace(run.sensor, mount_is_unknown=False)) for run in campaign.runs])
    estimate = _estimate(stated, stated.samples(Use.CALIBRATION))
    if estimate is None:
        raise FitError(
            f"sensor {sensor.name!r}: its mount is unknown: expected prior, a matrix that reads it roughly, without "
            "which nobody tells mount and matrix apart"
        )
    if estimate.undetermined:
        raise FitError(f"sensor {sensor.name!r}: its mount is not determined: {estimate.undetermined}; or state mount")
    mount = SensorMount.of(estimate)
    runs = []
    for run in stated.runs:
        experiment = replace(run.experiment, mounts={**run.experiment.mounts, sensor.name: mount})
        runs.append(SensorRun(experiment, run.sensor))
    return Campaign(runs), mount


def mount_doubts(campaign: Campaign, intervals: Sequence[CampaignInterval]) -> tuple[str, ...]:
    """Warn of a sensor that is turned against the mount that the file or the robot model states.

    Args:
        campaign: The recordings.
        intervals: Their calibration intervals.

    Returns:
        A sentence with a proposal; none where the mount is as stated, or the recordings do not determine it.
    """
    try:
        estimate = _estimate(campaign, intervals)
    except (FitError, np.linalg.LinAlgError):
        return ()
    if estimate is None or estimate.undetermined or estimate.standard_deviations_off < _DOUBTFUL:
        return ()
    mount, name = SensorMount.of(estimate), campaign.sensor.name
    return (
        f"turned by {mount.turn} against the robot model ({estimate.standard_deviations_off:.1f} standard deviations): "
        f"residual {mount.residual_before_N:.2g} -> {mount.residual_after_N:.2g} N by the prior; set "
        f'mount = "unknown" for sensor {name!r}, or check its frame',
    )


def _estimate(campaign: Campaign, intervals: Sequence[CampaignInterval]) -> MountEstimate | None:
    """The mount by means of the samples; None without a prior of six components."""
    prior = campaign.sensor.prior
    if prior is None or not campaign.sensor.measured.all():
        return None
    measured, expected, group = [], [], []
    for number, interval in enumerate(intervals):
        data = interval.data_set
        if not len(data.raw):
            continue
        columns = np.hstack([data.raw @ prior.T, data.reference])
        _, means, _ = means_over(data.time_s, columns, window_for(data.time_s))
        measured.append(means[:, :6])
        expected.append(means[:, 6:])
        group.append(np.full(len(means), number))
    if not measured:
        return None
    full_scale = campaign.sensor.full_scale
    return estimate_mount(
        np.concatenate(measured), np.concatenate(expected), np.concatenate(group), full_scale=full_scale
    )
