# SPDX-License-Identifier: BSD-3-Clause
"""The mount of a sensor: estimated before the fit where it is unknown, checked where it is not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.errors import FitError
from forcetorque.base.noise.means import means_over, window_for
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.robot.mounting import MountEstimate, estimate_mount

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
