# SPDX-License-Identifier: BSD-3-Clause
"""Tables of pressure, and the file that they come from: of one patch, and of no other."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingFileError, ShapeError, SkinError
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import (
    CalibratedTaxel,
    PatchCalibration,
    PatchProvenance,
    PressureTable,
    read_patch_calibration,
    write_pressure_table,
)
from forcetorque.skin.taxels.taxel_curve import CurveKind

REST = np.array([240.0, 0.0, 241.5, 239.0])
"""The second column is no taxel, the last one is broken."""


def _calibration(**changed: Any) -> PatchCalibration:
    errors = {"rmse_pa": 900.0, "error_pa": 500.0, "hysteresis_pa": 700.0, "hysteresis_share": 0.04}
    values: dict[str, Any] = {
        "patch": "palm",
        "serial": "P7",
        "columns": 4,
        "curve": CurveKind.LINE,
        "highest_pa": 5e4,
        "taxels": (
            CalibratedTaxel(taxel=0, coefficients=np.array([0.0, 5e4]), range_counts=50.0, **errors),
            CalibratedTaxel(taxel=2, coefficients=np.array([0.0, 4e4]), range_counts=40.0, **errors),
            CalibratedTaxel(taxel=3, left_out=("jumps",)),
        ),
        "provenance": PatchProvenance(
            code_version="1",
            created="2020-01-01T00:00:00+00:00",
            experiments=("chamber",),
            intervals=("chamber: cycle",),
            samples=100,
            inputs_sha256={"chamber.toml": "0" * 64},
        ),
    }
    return PatchCalibration(**values | changed)


@pytest.fixture
def table() -> PressureTable:
    """Tables of three taxels, one of which is broken."""
    return _calibration().table()


def test_counts_become_pressures(table: PressureTable) -> None:
    """Whole counts are a line of the table, means lie between two, above rest is no pressure, broken is none."""
    counts = np.array([[230.0, 7.0, 231.5, 100.0], [229.75, 7.0, 241.5, 100.0], [245.0, 7.0, 200.0, 100.0]])
    expected = [[1e4, 1e4, 0.0], [1.025e4, 0.0, 0.0], [0.0, 4.15e4, 0.0]]
    np.testing.assert_allclose(table.pressures(counts, REST), expected, rtol=1e-12)
    np.testing.assert_array_equal(table.beyond_range(counts, REST), [[False] * 3, [False] * 3, [False, True, False]])
    assert table.live.tolist() == [True, True, False]
    assert not table.falls().any()


def test_the_ends_of_the_table_hold(table: PressureTable) -> None:
    """A fall of 255 counts is the last line."""
    frame = np.array([0.0, 1.0, 0.0, 0.0])
    np.testing.assert_allclose(table.pressures(frame + [0, 0, 0, 1], np.full(4, 255.0)), [2.55e5, 2.55e5, 0.0])


def test_another_number_of_taxels_is_refused(table: PressureTable) -> None:
    """By the name of the patch; a message of zeros is none."""
    with pytest.raises(ShapeError, match=r"patch 'palm': counts: expected shape \(\.\.\., 4\), got \(3,\)"):
        table.pressures(np.zeros(3), REST)
    with pytest.raises(ShapeError, match="patch 'palm': rest: expected shape"):
        table.pressures(np.ones(4), np.ones(5))
    with pytest.raises(SkinError, match="patch 'palm': expected counts, got a message of zeros"):
        table.pressures(np.zeros((2, 4)), REST)


def test_a_table_of_another_patch_is_refused(table: PressureTable) -> None:
    """By name, by serial number, or by the number of columns; that of the patch itself is not."""
    table.require_patch("palm", columns=4, serial="P7")
    with pytest.raises(
        SkinError, match=r"table of patch 'palm': expected counts of that patch, got name 'sole' for 'palm'"
    ):
        table.require_patch("sole", columns=4, serial="P7")
    with pytest.raises(SkinError, match="serial 'P8' for 'P7'"):
        table.require_patch("palm", columns=4, serial="P8")
    with pytest.raises(SkinError, match="columns 192 for 4"):
        table.require_patch("palm", columns=192, serial="P7")


def test_the_file_reads_back(tmp_path: Path) -> None:
    """Every number, and the tables bit by bit."""
    made = _calibration()
    made.save(tmp_path / "palm.json")
    read = read_patch_calibration(tmp_path / "palm.json")
    assert read.model_dump(mode="json") == made.model_dump(mode="json")
    np.testing.assert_array_equal(read.table().values, made.table().values)
    assert repr(read) == "<PatchCalibration of palm: line, 2 of 3 taxels>"
    assert not [path for path in tmp_path.iterdir() if path.suffix == ".tmp"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"schema": "forcetorque/taxels/9"}, "expected the schema 'forcetorque/taxels/1', got 'forcetorque/taxels/9'"),
        ({"curve": "spline"}, "curve: expected"),
        ({"columns": 0}, "columns: expected "),
        ({"taxels": [{"taxel": 0}]}, "expected a curve with its errors, or why there is none"),
        ({"taxels": [{"taxel": 0, "coefficients": [1.0, float("inf")]}]}, "expected finite numbers"),
        ({"extra": 1}, "extra: expected no such key"),
    ],
)
def test_other_files_are_refused(tmp_path: Path, change: dict[str, Any], message: str) -> None:
    """Changed by hand, or of another form."""
    content = _calibration().model_dump(mode="json", by_alias=True) | change
    (tmp_path / "palm.json").write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(FormatError, match=message):
        read_patch_calibration(tmp_path / "palm.json")
    with pytest.raises(MissingFileError, match="`forcetorque skin calibrate` makes one"):
        read_patch_calibration(tmp_path / "none.json")


def test_the_text_has_every_live_taxel(tmp_path: Path, table: PressureTable) -> None:
    """256 lines each, flagged beyond the range."""
    write_pressure_table(tmp_path / "palm.csv", table)
    head, *lines = (tmp_path / "palm.csv").read_text(encoding="utf-8").splitlines()
    assert head == "taxel,counts_below_rest,pressure_Pa,beyond_range"
    assert len(lines) == 2 * 256
    assert lines[10] == "0,10,10000,0"
    assert lines[256 + 41] == "2,41,41000,1"
