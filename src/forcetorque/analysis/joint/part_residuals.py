# SPDX-License-Identifier: BSD-3-Clause
"""What calibrations leave of the equations of parts that nothing touches, whatever their contacts are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from forcetorque.analysis.joint.interval import joint_interval, required_prior
from forcetorque.calibration import Calibration
from forcetorque.calibration.joint import PartResidual, part_windows, residuals_by
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment
from forcetorque.recording import Interval, Use


def part_residuals(experiment: Experiment, calibrations: Mapping[str, Calibration], use: Use) -> list[PartResidual]:
    """Add up what the sensors of every part read, and take off what moves its bodies.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by the names of their sensors.
        use: Use of the intervals that are asked.

    Returns:
        What is left by the prior matrices and by the calibrations, of every part all of whose sensors have one and
        whose joints were logged. Both with the offsets that suit the interval best, unless the calibrations know its
        session; then they keep theirs.
    """
    used = {
        sensor.name: calibrations[sensor.name]
        for sensor in experiment.sensors
        if sensor.name in calibrations and sensor.prior is not None
    }
    intervals = [interval for interval in experiment.recording.intervals if interval.use is use]
    return [residual for interval in intervals if used for residual in _residuals(experiment, interval, used)]


def _residuals(
    experiment: Experiment, interval: Interval, calibrations: Mapping[str, Calibration]
) -> Iterator[PartResidual]:
    try:
        one = joint_interval(experiment, interval, list(calibrations)).untouched
    except ForceTorqueError:  # no support, or something touches every part: then there is nothing to add up
        return
    sessions = experiment.session_names(interval.label)
    for windows in part_windows(one.stretch, one.parts, (), weighed=one.weighed):
        if not len(windows):
            continue
        own = {name: calibrations[name] for name in windows.sensors}
        offsets = {
            name: session.offset
            for name, calibration in own.items()
            for session in calibration.sessions
            if session.name in sessions
        }
        factors = {
            name: calibration.matrix @ np.linalg.pinv(required_prior(experiment.sensor(name)))
            for name, calibration in own.items()
        }
        left = residuals_by(windows, factors, offsets if len(offsets) == len(own) else None)
        yield PartResidual.of(windows, left, np.ones(len(windows), dtype=bool))
