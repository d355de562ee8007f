# SPDX-License-Identifier: BSD-3-Clause
"""Fresh copies of small complete experiments for every test: fixtures that tests/conftest.py names."""

from __future__ import annotations

import shutil
from datetime import UTC, datetime
from pathlib import Path

import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import write_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.scenes.experiments import PARQUET, write_experiments
from tests.scenes.studies import write_days
from tests.scenes.warm_experiments import TEMPERATURE, warm_up, with_variables


@pytest.fixture(scope="session")
def intact(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the experiment, with the calibration `fitted.json` of its sensor; nobody changes it."""
    folder = tmp_path_factory.mktemp("intact")
    write_experiments(folder)
    experiment = load_experiment(folder / PARQUET)
    created = datetime(2020, 1, 1, tzinfo=UTC).isoformat()
    fitted = calibrate_sensor(SensorRun(experiment, "arm_ft"), code_version="1", created=created)
    write_calibration(folder / "fitted.json", fitted)
    return folder


@pytest.fixture
def arm(intact: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder with a copy of the experiment, to damage; it is the working folder."""
    folder = Path(shutil.copytree(intact, tmp_path / "arm"))
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture(scope="session")
def intact_warm(intact: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the experiment whose sensor drifts with temperature, which its file states; nobody changes it.

    The calibration `warm.json` is the exact one.
    """
    folder = warm_up(intact, tmp_path_factory.mktemp("warm") / "arm")
    experiment = load_experiment(with_variables(folder / PARQUET, TEMPERATURE))
    fitted = calibrate_sensor(
        SensorRun(experiment, "arm_ft"), code_version="1", created="2020-01-01T00:00:00+00:00", regularisation=0.0
    )
    write_calibration(folder / "warm.json", fitted)
    return folder


@pytest.fixture(scope="session")
def intact_warm_log(intact: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the experiment whose sensor drifts with temperature; its file has no variable; nobody changes it."""
    return warm_up(intact, tmp_path_factory.mktemp("warm_log") / "arm")


@pytest.fixture
def warm_log(intact_warm_log: Path, tmp_path: Path) -> Path:
    """Folder with a copy of it, to damage."""
    return Path(shutil.copytree(intact_warm_log, tmp_path / "warm"))


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the recordings of three days; nobody changes it."""
    folder = tmp_path_factory.mktemp("recorded")
    write_days(folder)
    return folder


@pytest.fixture
def warm(intact_warm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder with a copy of the drifting experiment, to damage; it is the working folder."""
    folder = Path(shutil.copytree(intact_warm, tmp_path / "warm"))
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def days(recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder with a copy of them, to damage; it is the working folder."""
    folder = Path(shutil.copytree(recorded, tmp_path / "days"))
    monkeypatch.chdir(folder)
    return folder
