# SPDX-License-Identifier: BSD-3-Clause
"""Logs in MATLAB files: what is stated is read, what is not is refused, and a pressure without a clock finds one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.io import savemat

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError, SkinError, UnitError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.array_file.log_format import MatlabFormat
from forcetorque.formats.array_file.streams import MatlabLog
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import recognised_format

COUNTS: dict[str, Any] = {
    "name": "counts",
    "variable": "log.C",
    "time": {"column": 2, "unit": "s"},
    "sequence": 1,
    "signal": [{"quantity": "taxel_counts", "columns": [3, 5], "unit": "counts"}],
}
PRESSURE: dict[str, Any] = {
    "name": "chamber",
    "variable": "log.P",
    "rows_of": "counts",
    "shift_rows": 0,
    "signal": [{"quantity": "pressure", "columns": [1, 1], "unit": "kPa"}],
}
ROWS, PERIOD_S, PRESSURE_PERIOD_S, START_S = 3000, 0.02, 0.0199, 1.3


def _levels(seconds: np.ndarray) -> np.ndarray:
    """Ten steps of 10 kPa up and down again, every 3 s."""
    step = np.floor(seconds / 3.0)
    return 10.0 * np.clip(np.where(step < 10, step, 19 - step), 0, 10)


def _log(rng: np.random.Generator) -> dict[str, np.ndarray]:
    seconds = PERIOD_S * np.arange(ROWS)
    counts = np.rint(240.0 - 0.4 * _levels(seconds)[:, None] + rng.normal(0.0, 0.6, (ROWS, 3)))
    at = START_S + PRESSURE_PERIOD_S * np.arange(ROWS - 40)
    return {
        "C": np.column_stack([np.arange(ROWS), 1000.0 + seconds, counts]),
        "P": (_levels(at) + rng.normal(0.0, 0.2, len(at)))[:, None],
    }


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A file with a struct, a matrix beside it and a text."""
    savemat(tmp_path / "log.mat", {"log": _log(np.random.default_rng(5)), "note": "a text", "other": np.eye(2)})
    return tmp_path / "log.mat"


def _read(file: Path, *streams: dict[str, Any]) -> LogReading:
    stated = MatlabLog.model_validate({"format": "matlab", "path": file.name, "stream": streams})
    folder = file.parent
    context = ExperimentContext(experiment=folder / "x.toml", inputs=Inputs(folder), sensors={}, joint_units={})
    reading = MatlabFormat().read(stated, context)
    assert context.inputs.names() == {file.name}
    return reading


def test_numbers_are_those_of_the_file(file: Path) -> None:
    """Columns count from 1, units become SI, the counter and the times are those that are stated."""
    counts, chamber = _read(file, COUNTS, PRESSURE).streams
    content = _log(np.random.default_rng(5))
    assert counts.signal("taxel_counts").columns == ("0", "1", "2")
    np.testing.assert_array_equal(counts.signal("taxel_counts").values, content["C"][:, 2:])
    np.testing.assert_array_equal(chamber.signal("pressure").values, 1000.0 * content["P"])
    assert counts.stamp_ns[1] - counts.stamp_ns[0] == 20_000_000
    assert counts.sequence is not None
    assert counts.sequence[:3].tolist() == [0, 1, 2]
    np.testing.assert_array_equal(chamber.stamp_ns, counts.stamp_ns[: len(chamber)])


def test_rows_beside_the_other_stream_are_left_out(file: Path) -> None:
    """A stated shift moves rows; what then has no time is counted."""
    reading = _read(file, COUNTS, PRESSURE | {"shift_rows": 60})
    counts, chamber = reading.streams
    assert chamber.stamp_ns[0] == counts.stamp_ns[60]
    assert [(finding.kind, finding.count) for finding in reading.findings] == [("cropped", 20)]
    reading = _read(file, COUNTS, PRESSURE | {"shift_rows": -10})
    assert reading.streams[1].stamp_ns[0] == reading.streams[0].stamp_ns[0]
    assert [finding.count for finding in reading.findings] == [10]


def test_a_pressure_without_a_clock_finds_its_times(file: Path) -> None:
    """Start and rate are those that were made, to a tenth of a second over the whole log, and are told."""
    reading = _read(file, COUNTS, PRESSURE | {"shift_rows": "estimated"})
    counts, chamber = reading.streams
    seconds = (chamber.stamp_ns - counts.stamp_ns[0]) * 1e-9
    made = START_S + PRESSURE_PERIOD_S * np.arange(len(chamber))
    assert np.abs(seconds - made).max() < 0.1
    finding = reading.findings[0]
    assert finding.kind == "estimated_clock"
    assert finding.size is not None
    assert abs(finding.size - START_S) < 0.1
    assert "without a clock beside 3000 of 'counts'" in finding.message


def test_a_clock_that_is_not_there_is_not_found(file: Path) -> None:
    """Negative controls: the steps of another log, and no steps at all."""
    content = _log(np.random.default_rng(5))
    for pressure in (np.random.default_rng(6).normal(size=(ROWS, 1)), np.zeros((ROWS, 1))):
        savemat(file, {"log": content | {"P": pressure}})
        with pytest.raises(SkinError, match="pressure without a clock"):
            _read(file, COUNTS, PRESSURE | {"shift_rows": "estimated"})


def test_rows_beside_none_of_the_others_are_refused(file: Path) -> None:
    """A stream without samples has no times that a third one could take."""
    for shift in (ROWS, -ROWS):
        with pytest.raises(
            FormatError, match=r"log\.mat: log\.P: expected rows beside some of the 3000 of 'counts', got"
        ):
            _read(file, COUNTS, PRESSURE | {"shift_rows": shift}, PRESSURE | {"name": "b", "rows_of": "chamber"})


WRONG: list[tuple[dict[str, Any], dict[str, Any], type[ForceTorqueError], str]] = [
    (
        COUNTS | {"variable": "log.c"},
        PRESSURE,
        FormatError,
        r"stream\[0\]: .*no variable 'log.c'; did you mean \"log.C\"\?",
    ),
    (COUNTS | {"variable": "note"}, PRESSURE, FormatError, "note: expected rows of real numbers, got 1 x 6 text"),
    (COUNTS | {"time": {"column": 9, "unit": "s"}}, PRESSURE, FormatError, "expected at least 9 columns, got 5"),
    (COUNTS | {"sequence": 2}, PRESSURE, FormatError, "row 2: expected a whole number to count by"),
    (COUNTS, PRESSURE | {"name": "counts"}, FormatError, "two streams are named 'counts'"),
    (COUNTS, PRESSURE | {"rows_of": "skin"}, FormatError, "no earlier stream 'skin'; known: counts"),
]


@pytest.mark.parametrize(("first", "second", "error", "message"), WRONG)
def test_what_the_file_does_not_hold_is_refused(
    file: Path, first: dict[str, Any], second: dict[str, Any], error: type[ForceTorqueError], message: str
) -> None:
    """By table, variable, column and row."""
    with pytest.raises(error, match=message):
        _read(file, first, second)


def test_units_are_those_of_the_quantity(file: Path) -> None:
    """A pressure in newtons, and one of two columns."""
    wrong = {"quantity": "pressure", "columns": [1, 1], "unit": "N"}
    with pytest.raises(UnitError, match="expected a unit of pressure that converts to Pa, got 'N'"):
        _read(file, COUNTS, PRESSURE | {"signal": [wrong]})
    with pytest.raises(FormatError, match="pressure: expected 1 columns \\(pressure\\), got 2"):
        _read(file, COUNTS | {"signal": [{"quantity": "pressure", "columns": [1, 2], "unit": "bar"}]})
    with pytest.raises(FormatError, match='estimated": expected a pressure'):
        _read(file, COUNTS, COUNTS | {"name": "b", "time": None, "rows_of": "counts", "shift_rows": "estimated"})


@pytest.mark.parametrize(
    ("stream", "message"),
    [
        ({**COUNTS, "rows_of": "x"}, "expected time"),
        ({k: v for k, v in COUNTS.items() if k != "time"}, "expected time"),
        ({k: v for k, v in PRESSURE.items() if k != "shift_rows"}, "rows_of needs shift_rows"),
        (PRESSURE | {"signal": [{"quantity": "pressure", "columns": [1, 1]}]}, "unit"),
        (PRESSURE | {"signal": [{"quantity": "pressure", "columns": [2, 1], "unit": "bar"}]}, "first column"),
    ],
)
def test_what_is_not_stated_is_refused(stream: dict[str, Any], message: str) -> None:
    """No time, no shift, no unit: nothing is guessed."""
    with pytest.raises(ValidationError, match=message):
        MatlabLog.model_validate({"format": "matlab", "path": "log.mat", "stream": [stream]})


def test_it_is_recognised_and_says_what_to_state(file: Path) -> None:
    """Its variables with their shapes stand in the message; nothing of it is guessed."""
    known = recognised_format(file)
    assert isinstance(known, MatlabFormat)
    with pytest.raises(FormatError, match=r"log\.C \(3000 x 5\), log\.P \(2960 x 1\), other \(2 x 2\); specify their"):
        known.describe(file)
    assert recognised_format(file.parent) is None


def test_other_and_damaged_files_are_refused(file: Path) -> None:
    """No file, a file of version 4, and one that was cut anywhere."""
    with pytest.raises(MissingFileError, match="expected a MATLAB file, there is none"):
        _read(file.with_name("none.mat"), COUNTS)
    savemat(file.with_name("old.mat"), {"a": np.eye(2)}, format="4")
    with pytest.raises(FormatError, match="of version 5 to 7, got another file"):
        _read(file.with_name("old.mat"), COUNTS)
    savemat(file, {"log": {"C": np.ones((4, 5)), "P": np.ones((4, 1))}})
    whole = file.read_bytes()
    for length in (*range(100, len(whole) - 8, 60), len(whole) - 8):
        file.write_bytes(whole[:length])
        with pytest.raises(FormatError, match=r"log\.mat"):
            _read(file, COUNTS, PRESSURE)
