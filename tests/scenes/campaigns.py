# SPDX-License-Identifier: BSD-3-Clause
"""A calibration of the simulated arm with a session per day, to judge on the recordings of several days."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration, SessionOffset
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.studies import SENSOR, VALIDATION

FITTED = "move_cold.toml"


def run_of(folder: Path, file: str) -> SensorRun:
    """Read the sensor of one file."""
    return SensorRun(load_experiment(folder / file), SENSOR)


def two_days(folder: Path) -> Campaign:
    """Read the sensor of the two days that are judged."""
    return Campaign([run_of(folder, file) for file in VALIDATION])


def by_day(folder: Path) -> Calibration:
    """Fit one recording, without temperature, and give every judged day the offset that makes its mean error zero."""
    run = run_of(folder, FITTED)
    plain = SensorRun(run.experiment, replace(run.sensor, variables=()))
    fitted = calibrate_sensor(plain, code_version="test", created="2020-01-01T00:00:00+00:00", regularisation=5.0)
    sessions = tuple(
        SessionOffset(
            name=interval.session,
            offset=_mean_error(fitted.matrix, interval.part.raw, interval.part.samples.reference),
            standard_error=None,
            prior_offset=None,
        )
        for interval in two_days(folder).samples(Use.VALIDATION)
    )
    intervals = tuple(
        interval.model_copy(update={"experiment": run.experiment.name, "session": "power-up 0"})
        for interval in fitted.provenance.intervals
    )
    provenance = fitted.provenance.model_copy(update={"intervals": intervals})
    return fitted.model_copy(update={"sessions": sessions, "provenance": provenance})


def _mean_error(matrix: FloatArray, raw: FloatArray, reference: FloatArray) -> FloatArray:
    mean: FloatArray = np.mean(reference - raw @ matrix.T, axis=0)
    return mean
