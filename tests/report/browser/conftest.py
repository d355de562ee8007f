# SPDX-License-Identifier: BSD-3-Clause
"""A report with the viewer in it, written by the command from a small complete experiment."""

from __future__ import annotations

from contextlib import chdir
from datetime import UTC, datetime
from pathlib import Path

import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import write_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.app.outcome import typed
from tests.scenes.experiments import PARQUET, write_experiments


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The document."""
    folder = tmp_path_factory.mktemp("report")
    write_experiments(folder)
    experiment = load_experiment(folder / PARQUET)
    created = datetime(2020, 1, 1, tzinfo=UTC).isoformat()
    fitted = calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created=created)
    write_calibration(folder / "fitted.json", fitted)
    with chdir(folder):
        assert typed("report", PARQUET, "fitted.json", "--viewer", "-o", "report.html").code == 0
    return folder / "report.html"
