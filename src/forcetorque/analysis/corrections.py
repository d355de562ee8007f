# SPDX-License-Identifier: BSD-3-Clause
"""How every sensor of an experiment is read, where one is not judged but used."""

from __future__ import annotations

from collections.abc import Mapping

from forcetorque.analysis.applicability import one_per_sensor
from forcetorque.analysis.reading import Correction
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.calibration import Calibration
from forcetorque.experiment import Experiment


def corrections_of(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> dict[str, Correction]:
    """Decide how every sensor of an experiment is read.

    A calibration is used where one is given. Else the prior is, or the logged wrench, with the
    offset that makes its mean that of the model over the calibration intervals.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file.

    Returns:
        Corrections by sensor.

    Raises:
        ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior.
    """
    chosen = one_per_sensor(experiment, calibrations)
    corrections = {}
    for sensor in experiment.sensors:
        run = SensorRun(experiment, sensor)
        if sensor.name in chosen:
            name, calibration = chosen[sensor.name]
            run.require_fit(name, calibration)
            corrections[sensor.name] = Correction.of(name, calibration)
        else:
            corrections[sensor.name] = run.uncalibrated()
    return corrections
