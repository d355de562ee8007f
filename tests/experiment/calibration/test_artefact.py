# SPDX-License-Identifier: BSD-3-Clause
"""The calibration file: what was written reads back, and nothing else is accepted."""

from __future__ import annotations

import contextlib
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from forcetorque.base.errors import (
    ForceTorqueError,
    FormatError,
    MissingFileError,
    RecordingError,
    SerialNumberError,
    ShapeError,
)
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.calibration.calibration_file import (
    CalibratedVariable,
    Calibration,
    Prior,
    calibrations_in,
    read_calibration,
    write_calibration,
)
from forcetorque.experiment.calibration.provenance import Provenance, Selection, SensorIdentity, Validity
from tests.fuzzing import examples

ROUNDING = 1e-13
"""Relative: sums of seven products in double precision, in another order."""


def _calibration(*, lam: float = 3.5e4, prior: bool = True) -> Calibration:
    rng = np.random.default_rng(1)
    matrix = rng.normal(size=(6, 6))
    return Calibration(
        sensor=SensorIdentity(
            name="ft", serial="SN1", robot="arm", frame="child", measure_direction=MeasureDirection.CHILD_TO_PARENT
        ),
        matrix=matrix,
        offset=rng.normal(size=6),
        matrix_standard_error=np.abs(matrix) * 0.01,
        offset_standard_error=None,
        residual_rms=np.ones(6),
        lambda_counts2=lam,
        prior=Prior(matrix=rng.normal(size=(6, 6)), offset=np.zeros(6), source="matrix.txt") if prior else None,
        validity=Validity(
            raw_minimum_counts=np.zeros(6),
            raw_maximum_counts=np.ones(6),
            expected_wrench_sd=np.ones(6),
            rank=6,
            condition=12.0,
            directions=np.eye(6),
            variance_counts2=np.ones(6),
            explained=np.ones(6),
            excited=(True,) * 6,
        ),
        selection=Selection(rule="given", lambda_counts2=(1.0, math.inf), held_out_rmse=(1.0, 2.0)),
        provenance=Provenance(
            code_version="1", created="2026-01-01T00:00:00+00:00", experiment="e", intervals=(), samples=3, dropped=0,
            inputs_sha256={"a": "b"},
        ),
    )  # fmt: skip


@pytest.mark.parametrize("lam", [0.0, 3.5e4, math.inf])
def test_reads_back_exactly(tmp_path: Path, lam: float) -> None:
    """Every number and text comes back bit by bit, the infinite lambda too."""
    written = _calibration(lam=lam)
    write_calibration(tmp_path / "c.json", written)
    read = read_calibration(tmp_path / "c.json")
    assert read.matrix.tobytes() == written.matrix.tobytes()
    assert read.lambda_counts2 == lam
    assert read.model_dump_json(by_alias=True) == written.model_dump_json(by_alias=True)


def test_applies_matrix_then_offset() -> None:
    """Wrench = matrix raw + offset, for one sample and for many."""
    calibration = _calibration()
    raw = np.random.default_rng(2).normal(size=(4, 6))
    wrench = calibration.apply(raw, serial="SN1")
    for row, one in zip(wrench, raw, strict=True):
        by_hand = calibration.matrix @ one + calibration.offset
        np.testing.assert_allclose(row, by_hand, rtol=ROUNDING)
        np.testing.assert_allclose(calibration.apply(one, serial="SN1"), by_hand, rtol=ROUNDING)
    assert len(wrench) == 4


def _with_temperature() -> Calibration:
    temperature = CalibratedVariable(
        name="temperature",
        unit="degC",
        reference_value=29.5,
        coefficients=np.arange(6.0),
        standard_error=None,
        minimum=29.0,
        maximum=42.0,
    )
    return _calibration().model_copy(update={"variables": (temperature,), "estimation_type": "OwTrTO"})


def test_temperature_counts_from_its_reference_value(tmp_path: Path) -> None:
    """A degree above the reference adds the coefficients once, for one temperature or one per reading."""
    write_calibration(tmp_path / "c.json", _with_temperature())
    calibration = read_calibration(tmp_path / "c.json")
    raw = np.random.default_rng(2).normal(size=(4, 6))
    without = raw @ calibration.matrix.T + calibration.offset
    one = calibration.apply(raw, serial="SN1", variables={"temperature": 30.5})
    np.testing.assert_allclose(one, without + np.arange(6.0), rtol=ROUNDING)
    rising = calibration.apply(raw, serial="SN1", variables={"temperature": 29.5 + np.arange(4.0)})
    np.testing.assert_allclose(rising, without + np.outer(np.arange(4.0), np.arange(6.0)), rtol=ROUNDING)
    with pytest.raises(RecordingError, match=r"expected values of the variables \['temperature'\], got \[\]"):
        calibration.apply(raw, serial="SN1")
    with pytest.raises(RecordingError, match=r"variables \[\], got \['temperature'\]"):
        _calibration().apply(raw, serial="SN1", variables={"temperature": 30.0})
    with pytest.raises(ShapeError, match="'temperature'"):
        calibration.apply(raw, serial="SN1", variables={"temperature": np.zeros(3)})


def test_a_file_of_an_earlier_form_is_refused(tmp_path: Path) -> None:
    """Its keys are others."""
    path = tmp_path / "c.json"
    write_calibration(path, _calibration())
    text = path.read_text()
    assert text.count('"forcetorque/calibration/4"') == 1
    path.write_text(text.replace("calibration/4", "calibration/3"))
    with pytest.raises(FormatError, match="expected the schema 'forcetorque/calibration/4', got .*fit again"):
        read_calibration(path)


def test_refuses_a_foreign_sensor_unless_told() -> None:
    """Another serial number is an error that names both; it can be allowed."""
    calibration = _calibration()
    with pytest.raises(SerialNumberError, match=r"'SN1'.*'SN2'"):
        calibration.apply(np.zeros(6), serial="SN2")
    np.testing.assert_array_equal(calibration.apply(np.zeros(6), serial="SN2", allow_foreign=True), calibration.offset)
    with pytest.raises(ShapeError, match="raw"):
        calibration.apply(np.zeros(5), serial="SN1")


def test_arrays_cannot_be_changed() -> None:
    """The matrix of a calibration is read-only."""
    with pytest.raises(ValueError, match="read-only"):
        _calibration().matrix[0, 0] = 1.0


def test_the_secondary_matrix_needs_a_prior() -> None:
    """Without a prior there is no stream to correct."""
    assert _calibration(prior=False).secondary_matrix() is None
    calibration = _calibration()
    secondary = calibration.secondary_matrix()
    assert secondary is not None
    assert calibration.prior is not None
    np.testing.assert_allclose(secondary @ calibration.prior.matrix, calibration.matrix, rtol=1e-9, atol=1e-12)


def _damage(content: dict[str, Any], key: str, value: Any) -> dict[str, Any]:
    content = dict(content)
    if value is None:
        del content[key]
    else:
        content[key] = value
    return content


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("matrix", [[1.0] * 6] * 5),
        ("matrix", "text"),
        ("matrix", [[1.0, float("nan")] * 3] * 6),
        ("offset", None),
        ("schema", "forcetorque/calibration/99"),
        ("lambda_counts2", -1.0),
        ("extra", 1),
        ("sensor", {"name": "x"}),
    ],
)
def test_a_changed_file_is_refused(tmp_path: Path, key: str, value: Any) -> None:
    """A missing, extra or misshapen entry is a one-line error that names the file and the key."""
    path = tmp_path / "c.json"
    write_calibration(path, _calibration())
    content = _damage(json.loads(path.read_text()), key, value)
    path.write_text(json.dumps(content))
    with pytest.raises(FormatError, match=rf"c\.json.*{key}") as caught:
        read_calibration(path)
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    """There is no file to read."""
    with pytest.raises(MissingFileError, match=r"none\.json"):
        read_calibration(tmp_path / "none.json")


@pytest.mark.fuzz
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=examples(150), deadline=None)
@given(st.data())
def test_damaged_bytes_give_our_errors_only(tmp_path: Path, data: st.DataObject) -> None:
    """Truncation and flipped bytes give a calibration or our error, nothing else."""
    path = tmp_path / "c.json"
    write_calibration(path, _calibration())
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(0, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(bytes(content[: data.draw(st.integers(0, len(content)))]))
    with contextlib.suppress(ForceTorqueError):
        read_calibration(path)


def test_a_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """When writing fails, the old content stays and no temporary file is left."""
    path = tmp_path / "c.json"
    write_calibration(path, _calibration())
    before = path.read_bytes()
    monkeypatch.setattr(Path, "replace", lambda *_: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(OSError, match="disk full"):
        write_calibration(path, _calibration(lam=1.0))
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["c.json"]


NEGATIVE = np.where(np.arange(36).reshape(6, 6) == 8, -0.25, 0.25)
"""A matrix of which one number is negative."""


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        ("matrix", np.zeros((6, 6)), "expected a matrix, got one of zeros, which reads no load"),
        ("matrix_standard_error", NEGATIVE, "expected numbers of at least 0, got -0.25"),
        ("offset_standard_error", NEGATIVE[1], "expected numbers of at least 0, got -0.25"),
        ("variables.0.standard_error", NEGATIVE[1], "expected numbers of at least 0, got -0.25"),
        ("residual_rms", NEGATIVE[1], "expected numbers of at least 0, got -0.25"),
        ("lambda_counts2", -1.0, "at least 0"),
        ("selection.lambda_counts2.0", -1.0, "at least 0"),
        ("validity.variance_counts2", NEGATIVE[1], "expected numbers of at least 0, got -0.25"),
        ("validity.expected_wrench_sd", NEGATIVE[1], "expected numbers of at least 0, got -0.25"),
        ("provenance.samples", -1, "at least 0"),
        ("provenance.dropped", -3, "at least 0"),
    ],
)
def test_numbers_that_no_fit_leaves_are_refused(tmp_path: Path, place: str, value: Any, message: str) -> None:
    """A matrix of zeros, a negative error, variance or count: one line that names file and key; zero is accepted."""
    path = tmp_path / "c.json"
    write_calibration(path, _with_temperature())
    for number, refused in ((np.abs(value) * 0.0 if place != "matrix" else NEGATIVE, False), (value, True)):
        content = json.loads(path.read_text())
        *tables, key = [int(word) if word.isdigit() else word for word in place.split(".")]
        table = content
        for step in tables:
            table = table[step]
        table[key] = np.asarray(number, dtype=np.asarray(value).dtype).tolist()
        changed = tmp_path / "changed.json"
        changed.write_text(json.dumps(content))
        if not refused:
            read_calibration(changed)
            continue
        with pytest.raises(FormatError, match=rf"changed\.json: {place}: .*{message}") as caught:
            read_calibration(changed)
        assert "\n" not in str(caught.value)


def test_other_json_files_of_a_folder_are_named(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """They are left out with a warning; other results of the library, as of a joint calibration, without."""
    write_calibration(tmp_path / "arm.json", _calibration())
    (tmp_path / "joint.json").write_text('{"schema": "forcetorque/joint/1"}', encoding="utf-8")
    assert list(calibrations_in(tmp_path)) == [str(tmp_path / "arm.json")]
    assert caplog.messages == []
    (tmp_path / "notes.json").write_text("[1, 2]", encoding="utf-8")
    (tmp_path / "settings.json").write_text('{"schema": "other/1"}', encoding="utf-8")
    assert list(calibrations_in(tmp_path)) == [str(tmp_path / "arm.json")]
    assert caplog.messages == [
        f"{tmp_path}: left out notes.json, settings.json: expected calibrations, got other JSON files"
    ]
