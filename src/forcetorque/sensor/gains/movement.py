# SPDX-License-Identifier: BSD-3-Clause
"""Whether a recording shows what the channels of a sensor are for: a load that moves, and one that comes by contact."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import BoolArray
from forcetorque.base.noise.means import means_over
from forcetorque.experiment.raw_counts import RawCounts
from forcetorque.experiment.sample_quality import expected_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, Use
from forcetorque.recording.sample_quality import smallest_steps, white_variance
from forcetorque.robot.model import RobotModel

_STILL = 0.01
"""Change of the expected wrench, relative to its size, below which the limb did not move: one that turns by half a
degree changes it by as much."""
_LEVER_M = 0.01
"""Least lever by which the size of the moment is judged."""
_WINDOW_S = 0.5
"""Length of the means of which the range is held against the noise; s."""
_BEYOND_NOISE = 5.0
"""Standard deviations of the noise of a sample that these means go over in a channel that moved."""
_INSTANTS = 400
"""Instants of an interval at which the expected wrench is evaluated."""


def moved_channels(run: SensorRun, counts: RawCounts) -> BoolArray:
    """Tell in which channels the recording shows a load that moves.

    Args:
        run: The sensor.
        counts: Its readings over all intervals that are not ignored.

    Returns:
        Which they are; shape (c,). None where the expected wrench stays, and no contact changes it.
    """
    values, stamps = counts.values, counts.stream.stamp_ns
    if not has_contact(run) and _is_still(run):
        return np.zeros(values.shape[1], dtype=bool)
    noise = np.sqrt(white_variance(stamps, values)) + smallest_steps(values)
    _, means, _ = means_over(seconds_since(stamps, int(stamps[0])), values, _WINDOW_S)
    return np.ptp(means, axis=0) > _BEYOND_NOISE * noise


def has_contact(run: SensorRun) -> bool:
    """Tell whether the file says of any interval that something touches the robot beyond the sensor.

    Args:
        run: The sensor.

    Returns:
        Whether the robot stands on what is beyond the sensor, a contact is stated there, or a known wrench is applied.
    """
    experiment = run.experiment
    if experiment.loads is not None and experiment.loads.in_place_of_robot:
        return experiment.loads.applied is not None
    used = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    return any(
        run.touched_beyond(interval) or run.possibly_touched(interval) or _stands_beyond(run, interval)
        for interval in used
    ) or any(entry.stream is not None for entry in experiment.contacts)


def _stands_beyond(run: SensorRun, interval: Interval) -> bool:
    """Whether the support is among the distal links of the sensor, which then bears the robot."""
    model: RobotModel = run.experiment.model
    if interval.support is None:
        return False
    parents = {joint.child: joint.parent for joint in model.joints.values()}
    child, link = model.joints[model.sensor(run.sensor.name).joint].child, interval.support.frame
    while link != child and link in parents:
        link = parents[link]
    return link == child


def _is_still(run: SensorRun) -> bool:
    """Whether the expected wrench is known in an interval, and the same in all."""
    parts = []
    for interval in run.experiment.recording.intervals:
        if interval.use is Use.IGNORE or interval.support is None:
            continue
        stamps = run.stream.stamp_ns[interval.holds(run.stream.stamp_ns)]
        expected = expected_at(run.experiment, run.sensor, interval, np.unique(stamps)[:: len(stamps) // _INSTANTS + 1])
        if expected is not None:
            parts.append(expected[np.isfinite(expected).all(axis=1)])
    known = np.concatenate(parts) if parts else np.empty((0, 6))
    if len(known) < 2:
        return False
    change, size = np.ptp(known, axis=0), np.sqrt((known**2).mean(axis=0))
    force = float(np.linalg.norm(size[:3]))
    lever = max(float(np.linalg.norm(size[3:])), _LEVER_M * force)
    return bool(np.linalg.norm(change[:3]) <= _STILL * force and np.linalg.norm(change[3:]) <= _STILL * lever)
