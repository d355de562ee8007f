# SPDX-License-Identifier: BSD-3-Clause
"""Matrices of other sensors: which files are read, whose they are, and what 32 real ones say of each other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.evaluation.matrix_checks import most_unusual, position_in_population
from forcetorque.experiment.applicability import read_population
from forcetorque.experiment.calibration.calibration_file import write_calibration
from forcetorque.formats.icub_matrix import encode_matrix, read_matrix_file, write_matrix_file
from tests.scenes.calibrations import FACTORY, MOUNTED, make_calibration

REAL_LARGEST, SWAPPED_SMALLEST = 20.0, 500.0
"""Robust z-scores of the most unusual feature: 17.7 among 32 real sensors of three families, 933 with channels
swapped."""


def test_folders_and_files_give_matrices_by_serial_number(tmp_path: Path) -> None:
    """Matrix files by their names, calibrations by what is in them; other files of a folder are left alone."""
    for name in ("matrix_SN002.txt", "matrix_SIM003.txt"):
        write_matrix_file(tmp_path / name, encode_matrix(FACTORY))
    write_calibration(tmp_path / "any.json", make_calibration(serial="SN001"))
    (tmp_path / "truth.json").write_text('{"schema": "forcetorque/truth/1"}', encoding="utf-8")
    (tmp_path / "notes.txt").write_text("not a matrix", encoding="utf-8")
    (tmp_path / "matrix_identity.txt").write_text("not of a sensor", encoding="utf-8")
    found = read_population([tmp_path])
    assert sorted(found) == ["SIM003", "SN001", "SN002"]
    np.testing.assert_array_equal(found["SN001"], MOUNTED)
    np.testing.assert_array_equal(found["SN002"], read_matrix_file(tmp_path / "matrix_SN002.txt").matrix)
    named = tmp_path / "matrix_left 3.txt"
    write_matrix_file(named, encode_matrix(FACTORY))
    assert sorted(read_population([named, tmp_path / "any.json"])) == ["SN001", "left 3"]


def test_a_matrix_must_tell_whose_it_is(tmp_path: Path) -> None:
    """Else the judged sensor could be compared with itself."""
    for name in ("spare.txt", "matrix_.txt", "matrix_SN001.csv"):
        write_matrix_file(tmp_path / name, encode_matrix(FACTORY))
        with pytest.raises(FormatError, match=f"{name}: expected a calibration .*, or a name with the serial number"):
            read_population([tmp_path / name])


def test_a_sensor_counts_once(tmp_path: Path) -> None:
    """A matrix file and a calibration of one serial number are refused, not counted as two sensors."""
    write_matrix_file(tmp_path / "matrix_SN001.txt", encode_matrix(FACTORY))
    write_calibration(tmp_path / "any.json", make_calibration(serial="SN001"))
    with pytest.raises(FormatError, match=r"SN001.txt: expected one matrix per sensor, .*any.json is of 'SN001'"):
        read_population([tmp_path])


def test_what_is_not_there_is_named(tmp_path: Path) -> None:
    """A missing file, an empty folder, a file of another kind."""
    with pytest.raises(MissingFileError, match="none.txt: expected a matrix file, a calibration or a folder"):
        read_population([tmp_path / "none.txt"])
    with pytest.raises(MissingFileError, match=r"matrix_SN026.txt; got an empty folder$"):
        read_population([tmp_path])
    (tmp_path / "matrix_identity.txt").touch()
    with pytest.raises(MissingFileError, match=r"SN or SIM and a number in their names.* got matrix_identity.txt$"):
        read_population([tmp_path])
    (tmp_path / "other.json").write_text("{}", encoding="utf-8")
    with pytest.raises(FormatError, match=r"other.json: expected the schema"):
        read_population([tmp_path])


@pytest.mark.long
@pytest.mark.real_data
def test_real_sensors_are_told_from_wrongly_wired_ones(data_dir: Path) -> None:
    """Each of 32 factory matrices is far nearer to the others than it would be with two channels swapped."""
    population = read_population([data_dir / "icub_workbench_matrices"])
    assert len(population) == 32
    for serial, matrix in population.items():
        others = {name: other for name, other in population.items() if name != serial}
        assert abs(most_unusual(position_in_population(matrix, others)).robust_z) < REAL_LARGEST
        swapped = matrix[:, [1, 0, 2, 3, 4, 5]]
        assert abs(most_unusual(position_in_population(swapped, others)).robust_z) > SWAPPED_SMALLEST
