# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations as comma-separated text: every number and unit stands where its heading says."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.calibration.export.export import write_calibration_table
from tests.scenes.calibrations import MOUNTED, OFFSET, make_calibration, make_variable


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_every_number_reads_back_exactly(tmp_path: Path) -> None:
    """Coefficients and offset of each component stand in its row, to the last bit; the control is the transpose."""
    path = tmp_path / "table.csv"
    write_calibration_table(path, [make_calibration()])
    rows = _rows(path)
    assert [(row["component"], row["unit"]) for row in rows] == [
        ("fx", "N"), ("fy", "N"), ("fz", "N"), ("tx", "N m"), ("ty", "N m"), ("tz", "N m")
    ]  # fmt: skip
    matrix = np.array([[float(row[f"c{j}_per_count"]) for j in range(6)] for row in rows])
    assert matrix.tobytes() == MOUNTED.tobytes()
    assert matrix.T.tobytes() != MOUNTED.tobytes()
    assert [float(row["offset"]) for row in rows] == OFFSET.tolist()
    assert {(row["sensor"], row["serial"]) for row in rows} == {("leg_ft", "SN001")}


def test_several_sensors_with_different_channels_share_a_table(tmp_path: Path) -> None:
    """Six rows per sensor; a channel that a sensor does not have is an empty cell, and names are quoted."""
    path = tmp_path / "table.csv"
    eight = np.arange(48.0).reshape(6, 8)
    write_calibration_table(path, [make_calibration(), make_calibration(name='arm, "left"\n', matrix=eight)])
    rows = _rows(path)
    assert len(rows) == 12
    assert [row["c7_per_count"] for row in rows] == [""] * 6 + [str(8.0 * k + 7) for k in range(6)]
    assert [row["sensor"] for row in rows] == ["leg_ft"] * 6 + ['arm, "left"\n'] * 6
    assert all(row["offset"] for row in rows)


def test_variables_have_a_coefficient_and_a_reference(tmp_path: Path) -> None:
    """Both read back to the last bit under name and unit; sensors without the variable have empty cells."""
    path = tmp_path / "table.csv"
    temperature, supply = make_variable(), make_variable(name="supply", unit="V", reference_value=4.95)
    both = make_calibration(name="arm_ft", variables=(supply, temperature))
    chosen = [make_calibration(variables=(temperature,)), make_calibration(name="foot_ft"), both]
    write_calibration_table(path, chosen)
    rows = _rows(path)
    assert len(rows) == 18
    for k, calibration in enumerate(chosen):
        own, part = {v.name: v for v in calibration.variables}, rows[6 * k : 6 * k + 6]
        for name, unit in (("temperature", "degC"), ("supply", "V")):
            coefficients, references = ([row[f"{name}_{word}_{unit}"] for row in part] for word in ("per", "reference"))
            expected = own[name].coefficients.tolist() if name in own else None
            assert ([float(c) for c in coefficients] if any(coefficients) else None) == expected
            assert set(references) == ({repr(own[name].reference_value)} if name in own else {""})
    assert rows[0]["temperature_reference_degC"] == "29.3"


def test_the_rows_are_the_calibration(tmp_path: Path) -> None:
    """Component = coefficients raw + offset + coefficient (temperature - reference), as the docstring has it."""
    path = tmp_path / "table.csv"
    calibration = make_calibration(variables=(make_variable(),))
    write_calibration_table(path, [calibration])
    raw, degrees = np.random.default_rng(5).normal(size=6) * 1000, 41.5
    by_rows = [
        sum(float(row[f"c{j}_per_count"]) * raw[j] for j in range(6))
        + float(row["offset"])
        + float(row["temperature_per_degC"]) * (degrees - float(row["temperature_reference_degC"]))
        for row in _rows(path)
    ]
    expected = calibration.apply(raw, serial="SN001", variables={"temperature": degrees})
    np.testing.assert_allclose(by_rows, expected, rtol=1e-12)


def test_an_empty_table_is_refused(tmp_path: Path) -> None:
    """There is nothing to write, so nothing is written."""
    with pytest.raises(FormatError, match=r"table\.csv: expected at least one calibration to write, got none"):
        write_calibration_table(tmp_path / "table.csv", [])
    assert not list(tmp_path.iterdir())
