# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations as comma-separated text: every number and unit stands where its heading says."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from forcetorque.errors import FormatError
from forcetorque.exchange.calibration_table import write_calibration_table
from tests.calibrations import MOUNTED, OFFSET, make_calibration


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


def test_an_empty_table_is_refused(tmp_path: Path) -> None:
    """There is nothing to write, so nothing is written."""
    with pytest.raises(FormatError, match=r"table\.csv: expected at least one calibration to write, got none"):
        write_calibration_table(tmp_path / "table.csv", [])
    assert not list(tmp_path.iterdir())
