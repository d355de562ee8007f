# SPDX-License-Identifier: BSD-3-Clause
"""A study as a folder, written from Python."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.study import study_folder
from forcetorque.study.study import SensorStudy, study_sensor
from forcetorque.study.study_data import read_study_data
from forcetorque.study.study_folder import write_study_folder
from tests.scenes.experiments import PARQUET, write_experiments


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> SensorStudy:
    """A study of one type and two lambdas."""
    folder = tmp_path_factory.mktemp("arm")
    write_experiments(folder)
    (data,) = read_study_data([folder / PARQUET], None)
    return study_sensor(
        data,
        data_sets=None,
        kinds=[ESTIMATION_TYPES["OnTdTO"]],
        lambdas=(0.0, 600.0),
        sphere=None,
        code_version="1",
        created="2020-01-01T00:00:00+00:00",
    )


@pytest.mark.usefixtures("blank_pictures")
def test_what_is_written_is_what_is_listed(study: SensorStudy, tmp_path: Path) -> None:
    """Tables, calibrations and figures; a folder per sensor."""
    lines: list[str] = []
    written = write_study_folder(tmp_path / "out", [study], experiments=["arm.toml"], progress=lines.append)
    (sensor,) = written.sensors
    assert sensor.folder is not None
    assert sorted(path.name for path in Path(sensor.folder).iterdir()) == sorted(sensor.files)
    assert {"candidates.csv", "best_offset_first_second.json"} <= set(sensor.files)
    assert f"tables, figures and calibrations are in {sensor.folder}" in " ".join(written.text(1000).split("\n"))
    assert lines == ["drawing figures"]


def test_a_study_that_fails_leaves_no_folder(
    study: SensorStudy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where a first sensor was written already; a folder that is there stays as it is."""
    monkeypatch.setattr(study_folder, "write_figures", lambda study, folder, progress: [])

    def studies() -> Iterator[SensorStudy]:
        yield study
        raise FitError("nothing can be fitted")

    with pytest.raises(FitError, match="nothing can be fitted"):
        write_study_folder(tmp_path / "new" / "out", studies(), experiments=[])
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "out").mkdir()
    with pytest.raises(ForceTorqueError, match="expected a new folder, it is there already"):
        write_study_folder(tmp_path / "out", [study], experiments=[])
