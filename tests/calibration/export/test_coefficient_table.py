# SPDX-License-Identifier: BSD-3-Clause
"""Coefficients of variables by themselves: rows read back exactly, sensors without any have none."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.export.export import write_coefficient_table
from tests.scenes.calibrations import COEFFICIENTS, make_calibration, make_variable


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_every_number_reads_back_exactly(tmp_path: Path) -> None:
    """One row per variable and sensor, to the last bit; the negative control is the order of the components."""
    path = tmp_path / "coefficients.csv"
    supply = make_variable(name="supply, 5 V", unit="V", reference_value=0.1 + 0.2, coefficients=COEFFICIENTS[::-1])
    leg, arm = make_calibration(variables=(make_variable(), supply)), make_calibration(name="arm_ft", serial="SN002")
    foot = make_calibration(name="foot_ft", serial="SN003", variables=(make_variable(reference_value=-3.0),))
    write_coefficient_table(path, [leg, arm, foot])
    rows = _rows(path)
    assert [(row["sensor"], row["serial"], row["variable"], row["unit"]) for row in rows] == [
        ("leg_ft", "SN001", "temperature", "degC"),
        ("leg_ft", "SN001", "supply, 5 V", "V"),
        ("foot_ft", "SN003", "temperature", "degC"),
    ]
    assert [float(row["reference_value"]) for row in rows] == [29.3, 0.1 + 0.2, -3.0]
    found = np.array([[float(row[component]) for component in WRENCH_COMPONENTS] for row in rows])
    assert found.tobytes() == np.array([COEFFICIENTS, COEFFICIENTS[::-1], COEFFICIENTS]).tobytes()
    assert list(rows[0])[-6:] == list(WRENCH_COMPONENTS)
    assert found[0].tobytes() != found[0, ::-1].tobytes()


def test_calibrations_without_variables_write_nothing(tmp_path: Path) -> None:
    """A table without rows would look like coefficients of zero."""
    with pytest.raises(FormatError, match=r"coefficients\.csv: expected a calibration with a linear variable such as"):
        write_coefficient_table(tmp_path / "coefficients.csv", [make_calibration()])
    assert not list(tmp_path.iterdir())
