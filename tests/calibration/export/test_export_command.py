# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque export`: the written files hold the calibration, and the result says what they do not hold."""

from __future__ import annotations

import csv
import io
import itertools
import json
import logging
import pickle
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.app.command_line import main
from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.export.commands import export_calibrations
from forcetorque.calibration.export.export import Export
from forcetorque.calibration.export.wholebodydynamics import corrected, read_groups
from forcetorque.experiment.calibration.calibration_file import Calibration, SessionOffset, write_calibration
from forcetorque.formats.icub_matrix import read_matrix_file
from tests.results.showing import require_shown
from tests.scenes.calibrations import COEFFICIENTS, FACTORY, MOUNTED, OFFSET, make_calibration, make_variable

SOLVE_ROUNDING = 1e-10
"""Relative to the largest wrench: eps times the condition number of the prior, about 1e4 with rows in N and N m."""
SUM_ROUNDING = 1e-12
"""Relative: sums of six products in another order, of differences that keep 12 digits."""


@dataclass(frozen=True)
class Done:
    """What a command left."""

    code: int
    out: str
    err: str

    def result(self) -> dict[str, Any]:
        """Give the result in JSON."""
        content: dict[str, Any] = json.loads(self.out)
        return content


Run = Callable[..., Done]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run `forcetorque export` with these arguments."""

    def command(*arguments: str | Path) -> Done:
        monkeypatch.setattr(sys, "argv", ["forcetorque", "export", *map(str, arguments)])
        monkeypatch.setattr(logging.getLogger("forcetorque"), "handlers", [])  # or it keeps an earlier test's stream
        with pytest.raises(SystemExit) as leaving:
            main()
        captured = capsys.readouterr()
        return Done(code=int(leaving.value.code or 0), out=captured.out, err=captured.err)

    return command


@pytest.fixture
def leg(tmp_path: Path) -> Path:
    """File of a calibration."""
    return _written(tmp_path / "leg.json", make_calibration())


def _written(path: Path, calibration: Calibration) -> Path:
    write_calibration(path, calibration)
    return path


def _half_lsb_excess(full_scale: list[int], decoded: np.ndarray) -> float:
    half = np.array(full_scale)[:, np.newaxis] / 32767 / 2**16
    return float((np.abs(decoded - MOUNTED) - half * (1 + 1e-9)).max())


@pytest.mark.parametrize("form", ["csv", "numpy", "icub-matrix", "wholebodydynamics", "ros2"])
def test_an_export_of_another_process_writes_the_same_file(form: str, tmp_path: Path) -> None:
    """What was pickled writes what the export itself writes."""
    export = export_calibrations(make_calibration(), form, frame_ids=["sole"] if form == "ros2" else ())
    export.save(tmp_path / "here")
    pickle.loads(pickle.dumps(export)).save(tmp_path / "there")  # noqa: S301
    assert (tmp_path / "here").read_bytes() == (tmp_path / "there").read_bytes()


def test_the_matrix_file_decodes_to_the_calibration(run: Run, leg: Path, tmp_path: Path) -> None:
    """Every coefficient is within half a least significant bit of its row; one code further is not."""
    output = tmp_path / "matrix_SN001.txt"
    done = run(leg, "--to", "icub-matrix", "-o", output, "--format", "json")
    assert done.code == 0
    file = read_matrix_file(output)
    (entry,) = done.result()["calibrations"]
    assert entry["full_scale"] == list(file.full_scale)
    assert np.array(entry["matrix"]).tobytes() == file.matrix.tobytes()
    assert _half_lsb_excess(entry["full_scale"], file.matrix) <= 0.0
    one_code = np.array(file.full_scale)[:, np.newaxis] / 32767 / 2**15
    assert _half_lsb_excess(entry["full_scale"], file.matrix + one_code) > 0.0


def test_the_rounding_error_is_the_largest_over_the_fitted_range(run: Run, leg: Path, tmp_path: Path) -> None:
    """It is reached at a corner of the raw range: the 64 corners give the same, and no reading inside gives more."""
    output = tmp_path / "matrix.txt"
    (entry,) = run(leg, "--to", "icub-matrix", "-o", output, "--format", "json").result()["calibrations"]
    difference = read_matrix_file(output).matrix - MOUNTED
    low, high = -3000.0 * np.arange(1, 7), 2000.0 * np.arange(1, 7)
    corners = np.array(list(itertools.product(*zip(low, high, strict=True))))
    assert corners.shape == (64, 6)
    by_corners = np.abs(corners @ difference.T).max(axis=0)
    np.testing.assert_allclose(entry["largest_rounding_error"], by_corners, rtol=SUM_ROUNDING)
    inside = np.random.default_rng(3).uniform(low, high, size=(1000, 6))
    assert (np.abs(inside @ difference.T).max(axis=0) <= by_corners).all()


def test_the_offset_that_a_matrix_file_cannot_hold_is_announced(run: Run, leg: Path, tmp_path: Path) -> None:
    """Standard error warns with the offset, and the result says that it is not stored."""
    done = run(leg, "--to", "icub-matrix", "-o", tmp_path / "matrix.txt", "--format", "json")
    assert "WARNING" in done.err
    assert "offset (8, -5, 20) N, (0.3, -0.2, 0.1) N m: not stored" in done.err
    (entry,) = done.result()["calibrations"]
    assert entry["offset_stored"] is False
    assert entry["offset"] == OFFSET.tolist()
    stored = run(leg, "--to", "csv", "-o", tmp_path / "table.csv", "--format", "json")
    assert "WARNING" not in stored.err
    assert stored.result()["calibrations"][0]["offset_stored"] is True


def test_the_offset_of_a_load_cell_is_that_of_its_component(run: Run, tmp_path: Path) -> None:
    """Components that are not measured have no offset."""
    measured = np.arange(6)[:, None] == 2
    cell = make_calibration(matrix=np.where(measured, 1.0, 0.0), offset=np.where(measured[:, 0], 20.2, -0.0))
    done = run(_written(tmp_path / "cell.json", cell), "--to", "csv", "-o", tmp_path / "table.csv")
    assert "offset fz 20.2 N: stored" in done.err


def test_the_offset_of_several_sessions_is_said_to_be_the_last(run: Run, tmp_path: Path) -> None:
    """A robot has one offset: it is named, and warned of; with one session there is nothing to say."""
    old, new = (
        SessionOffset(name=name, offset=offset, standard_error=None, prior_offset=None)
        for name, offset in (("monday", 2.0 * OFFSET), ("friday", OFFSET))
    )
    for sessions, session in (((old, new), "friday"), ((new,), None)):
        calibration = make_calibration().model_copy(update={"sessions": sessions})
        file = _written(tmp_path / "days.json", calibration)
        done = run(file, "--to", "csv", "-o", tmp_path / "table.csv", "--format", "json")
        (entry,) = done.result()["calibrations"]
        assert (entry["session"], entry["offset"]) == (session, OFFSET.tolist())
        assert ("its offset is of the last session, 'friday'" in done.err) == (session is not None)


def test_warnings_of_the_fit_are_named(run: Run, leg: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fault of the bench goes with every file that is made of its calibration."""
    monkeypatch.setenv("COLUMNS", "500")  # paths of the tests are long
    fault = "SIM001: positions 4 and 9 are swapped"
    doubted = make_calibration().model_copy(update={"warnings": (fault,)})
    done = run(_written(tmp_path / "doubted.json", doubted), "--to", "icub-matrix", "-o", tmp_path / "matrix.txt")
    assert done.code == 0
    first, why, *_ = done.out.splitlines()
    assert first.endswith("WRITTEN AS icub-matrix, WITH WARNINGS")
    assert fault in why
    assert "doubted.json: fitted with the warning: " in done.err
    sound = run(leg, "--to", "icub-matrix", "-o", tmp_path / "sound.txt")
    assert "fitted with the warning" not in sound.err
    assert "WITH WARNINGS" not in sound.out


def test_full_scales_can_be_kept(run: Run, leg: Path, tmp_path: Path) -> None:
    """Six given full scales stand in the file; one that cannot hold its row is refused with the smallest that can."""
    output = tmp_path / "matrix.txt"
    given = ["1587", "1823", "2113", "37", "38", "24"]
    done = run(leg, "--to", "icub-matrix", "-o", output, "--full-scale", *given, "--format", "json")
    assert done.result()["calibrations"][0]["full_scale"] == [int(scale) for scale in given]
    file = read_matrix_file(output)
    assert file.full_scale == (1587, 1823, 2113, 37, 38, 24)
    assert _half_lsb_excess(list(file.full_scale), file.matrix) <= 0.0
    before = output.read_bytes()
    refused = run(leg, "--to", "icub-matrix", "-o", output, "--full-scale", "1", *given[1:], "--force", "--details")
    assert refused.code == 2
    assert "leg.json: matrix[0, " in refused.err
    assert "smallest full scale that holds it is" in refused.err
    assert output.read_bytes() == before


def test_a_matrix_file_named_after_another_sensor_is_refused(run: Run, leg: Path, tmp_path: Path) -> None:
    """matrix_SN002.txt is the factory's name for the file of sensor SN002, not SN001."""
    output = tmp_path / "matrix_SN002.txt"
    done = run(leg, "--to", "icub-matrix", "-o", output, "--details")
    assert done.code == 2
    assert "'SN001'" in done.err
    assert "'SN002'" in done.err
    assert not output.exists()


def test_several_sensors_go_into_one_configuration(run: Run, leg: Path, tmp_path: Path) -> None:
    """Each correction turns the prior's stream into the wrenches of its calibration."""
    other = make_calibration(name="arm_ft", serial="SN002", matrix=2.0 * MOUNTED, offset=-OFFSET)
    arm, output = _written(tmp_path / "arm.json", other), tmp_path / "ft.xml"
    done = run(leg, arm, "--to", "wholebodydynamics", "-o", output, "--format", "json")
    assert done.code == 0
    found = read_groups(output)
    assert [correction.sensor for correction in found] == ["leg_ft", "arm_ft"]
    raw = np.random.default_rng(4).normal(size=(20, 6)) * 1000
    checked = 0
    for correction, calibration, entry in zip(
        found, (make_calibration(), other), done.result()["calibrations"], strict=True
    ):
        expected = calibration.apply(raw, serial=calibration.sensor.serial)
        tolerance = SOLVE_ROUNDING * np.abs(expected).max()
        np.testing.assert_allclose(corrected(correction, raw @ FACTORY.T), expected, rtol=0, atol=tolerance)
        assert entry["matrix"] == correction.secondary_matrix.tolist()
        assert entry["sensor"] == correction.sensor
        checked += 1
    assert checked == 2
    assert "which the device ADDS" in done.err


def test_the_robots_name_of_a_sensor_can_be_given(run: Run, leg: Path, tmp_path: Path) -> None:
    """The name stands in the file and in the result."""
    output = tmp_path / "ft.xml"
    arguments = (leg, "--to", "wholebodydynamics", "-o", output, "--format", "json")
    assert run(*arguments, "--sensor-name", "l_leg_ft").result()["calibrations"][0]["sensor"] == "l_leg_ft"
    assert [correction.sensor for correction in read_groups(output)] == ["l_leg_ft"]
    refused = run(*arguments, "--sensor-name", "l leg", "--details")
    assert refused.code == 2
    assert "leg.json: sensor: expected a name that YARP reads as one word" in refused.err


def test_an_offset_of_six_zeros_is_warned_of(run: Run, tmp_path: Path) -> None:
    """The device would not set its offset to zero but keep its own."""
    zero = _written(tmp_path / "zero.json", make_calibration(offset=np.zeros(6)))
    done = run(zero, "--to", "wholebodydynamics", "-o", tmp_path / "ft.xml", "--details")
    assert "WARNING" in done.err
    assert "ignores an FT_OFFSET of six zeros" in done.err


def test_a_table_holds_matrix_and_offset(run: Run, leg: Path, tmp_path: Path) -> None:
    """The file reads back to the calibration, to the last bit."""
    output = tmp_path / "table.csv"
    assert run(leg, "--to", "csv", "-o", output).code == 0
    rows = list(csv.DictReader(io.StringIO(output.read_text(encoding="utf-8"))))
    assert np.array([[float(row[f"c{j}_per_count"]) for j in range(6)] for row in rows]).tobytes() == MOUNTED.tobytes()
    assert [float(row["offset"]) for row in rows] == OFFSET.tolist()


STREAM = make_calibration(
    matrix=1.1 * FACTORY + 0.001,
    offset=np.array([-30.0, 12.0, 5.0, -1.0, 0.5, 0.7]),
    variables=(make_variable(reference_value=35.0, coefficients=np.array([0.5, -0.2, 0.9, -0.03, 0.02, 0.01])),),
)
"""An earlier calibration of the same sensor, with an offset, coefficients and reference of its own."""


@pytest.fixture
def warm(tmp_path: Path) -> Path:
    """File of a calibration with temperature."""
    return _written(tmp_path / "warm.json", make_calibration(variables=(make_variable(),)))


def _warm_readings() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Raw readings, temperatures, and the wrenches that the calibration with temperature makes of them."""
    rng = np.random.default_rng(8)
    raw, degrees = rng.normal(size=(40, 6)) * 1000, rng.uniform(20.0, 45.0, size=40)
    calibration = make_calibration(variables=(make_variable(),))
    return raw, degrees, calibration.apply(raw, serial="SN001", variables={"temperature": degrees})


def test_the_device_gets_the_temperature(run: Run, warm: Path, tmp_path: Path) -> None:
    """The written groups turn the prior's readings at each temperature into the wrenches of the calibration."""
    output = tmp_path / "ft.xml"
    done = run(warm, "--to", "wholebodydynamics", "-o", output, "--format", "json")
    (correction,), (entry,) = read_groups(output), done.result()["calibrations"]
    raw, degrees, expected = _warm_readings()
    close = SOLVE_ROUNDING * np.abs(expected).max()
    np.testing.assert_allclose(corrected(correction, raw @ FACTORY.T, degrees), expected, rtol=0, atol=close)
    assert entry["variables"] == {"temperature": COEFFICIENTS.tolist()}
    assert entry["variables_stored"] is True
    assert "coefficients" not in done.err


def test_the_device_corrects_a_stream_that_is_calibrated_already(run: Run, warm: Path, tmp_path: Path) -> None:
    """--stream takes offset and temperature of the earlier calibration out; without it newtons are wrong."""
    earlier, output = _written(tmp_path / "earlier.json", STREAM), tmp_path / "ft.xml"
    raw, degrees, expected = _warm_readings()
    sent = STREAM.apply(raw, serial="SN001", variables={"temperature": degrees})
    words = (warm, "--to", "wholebodydynamics", "-o", output, "--format", "json")
    (entry,) = run(*words, "--stream", earlier).result()["calibrations"]
    (correction,) = read_groups(output)
    close = SOLVE_ROUNDING * np.abs(expected).max()
    np.testing.assert_allclose(corrected(correction, sent, degrees), expected, rtol=0, atol=close)
    assert correction.temperature_coefficients is not None
    assert entry["matrix"] == correction.secondary_matrix.tolist()
    assert entry["offset"] == correction.offset.tolist() != OFFSET.tolist()
    assert entry["variables"]["temperature"] == correction.temperature_coefficients.tolist() != COEFFICIENTS.tolist()
    run(*words).result()
    (without,) = read_groups(output)
    assert np.abs(corrected(without, sent, degrees) - expected).max() > 1.0


def test_coefficients_have_a_file_of_their_own(run: Run, leg: Path, warm: Path, tmp_path: Path) -> None:
    """They read back to the last bit; offset and matrix are announced to be elsewhere, sensors without have no row."""
    output = tmp_path / "coefficients.csv"
    done = run(leg, warm, "--to", "coefficients", "-o", output, "--format", "json")
    rows = list(csv.DictReader(io.StringIO(output.read_text(encoding="utf-8"))))
    assert [(row["sensor"], row["serial"], row["variable"], row["unit"]) for row in rows] == [
        ("leg_ft", "SN001", "temperature", "degC")
    ]
    assert np.array([float(rows[0][name]) for name in ("fx", "fy", "fz", "tx", "ty", "tz")]).tobytes() == (
        COEFFICIENTS.tobytes()
    )
    assert float(rows[0]["reference_value"]) == 29.3
    plain, entry = done.result()["calibrations"]
    assert (plain["variables"], entry["variables"]) == ({}, {"temperature": COEFFICIENTS.tolist()})
    assert (entry["offset_stored"], entry["variables_stored"]) == (False, True)
    assert "not stored, the file is for the variables: store it with the matrix" in done.err


def test_coefficients_that_a_matrix_file_cannot_hold_are_announced(
    run: Run, leg: Path, warm: Path, tmp_path: Path
) -> None:
    """The warning names the variable and the format that holds it; a calibration without any has no such warning."""
    output, warning = tmp_path / "matrix_SN001.txt", "the coefficients of temperature are not in this file: --to coef"
    done = run(warm, "--to", "icub-matrix", "-o", output, "--format", "json")
    assert f"warm.json: {warning}" in done.err
    (entry,) = done.result()["calibrations"]
    assert (entry["variables"], entry["variables_stored"]) == ({"temperature": COEFFICIENTS.tolist()}, False)
    assert warning not in run(leg, "--to", "icub-matrix", "-o", output, "--details").err
    assert warning not in run(warm, "--to", "csv", "-o", tmp_path / "table.csv", "--details").err


@pytest.mark.parametrize(
    ("name", "to"),
    [(name, to) for name in ("leg", "warm") for to in ("icub-matrix", "wholebodydynamics", "csv")]
    + [("warm", "coefficients"), ("leg", "numpy"), ("warm", "numpy")],
)
def test_the_result_has_three_forms(
    run: Run, request: pytest.FixtureRequest, tmp_path: Path, name: str, to: str
) -> None:
    """JSON is what its schema says, CSV has a row per component with the same numbers, the table names the file."""
    leg: Path = request.getfixturevalue(name)
    output = tmp_path / "out.file"
    result = run(leg, "--to", to, "-o", output, "--format", "json").result()
    assert json.loads(Export.model_validate(result).json_text()) == result
    assert result["schema"] == "forcetorque/export/1"
    assert (result["format"], result["file"]) == (to, str(output))
    again = ("--force",) if to in ("icub-matrix", "numpy") else ()  # which carry no mark of who wrote them
    rows = list(csv.DictReader(io.StringIO(run(leg, "--to", to, "-o", output, *again, "--format", "csv").out)))
    (entry,) = result["calibrations"]
    assert [row["component"] for row in rows] == ["fx", "fy", "fz", "tx", "ty", "tz"]
    assert [[float(row[f"m{j}"]) for j in range(6)] for row in rows] == entry["matrix"]
    assert ("full_scale" in rows[0]) is (to == "icub-matrix")
    coefficients = [float(row["temperature_coefficient"]) for row in rows] if name == "warm" else None
    assert coefficients == entry["variables"].get("temperature")
    table = " ".join(
        run(leg, "--to", to, "-o", output, *again, "--details").out.split()
    )  # sentences are broken at spaces
    assert f"written to {output}" in table
    assert f"offset: {result['offset_handling']}" in table
    assert "leg_ft (SN001)" in table


def test_exports_show_themselves(tmp_path: Path) -> None:
    """From Python too: what is not stored is a warning of the result, and both kinds of matrix keep their numbers."""
    leg = make_calibration(variables=(make_variable(),))
    matrix = export_calibrations({"leg": leg}, "icub-matrix")
    matrix.save(str(tmp_path / "matrix.txt"))  # text is a path too
    require_shown(matrix)
    offset, coefficients = matrix.warnings
    assert offset.startswith("leg: offset (8, -5, 20) N, (0.3, -0.2, 0.1) N m: not stored")
    assert coefficients == (
        "leg: the coefficients of temperature are not in this file: --to coefficients, from Python "
        "export_calibrations, has them"
    )
    groups = export_calibrations({"leg": leg}, "wholebodydynamics")
    require_shown(groups)
    assert groups.warnings == ()


def test_the_result_has_a_schema(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """`forcetorque schema export` describes the keys of the result."""
    monkeypatch.setattr(sys, "argv", ["forcetorque", "schema", "export"])
    with pytest.raises(SystemExit) as leaving:
        main()
    assert not leaving.value.code
    schema = json.loads(capsys.readouterr().out)
    assert set(schema["properties"]) == {"schema", "format", "file", "offset_handling", "calibrations"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("LEG ARM --to icub-matrix -o OUT", "--to icub-matrix: a file holds one matrix, got 2 calibrations"),
        ("BOTH --to icub-matrix -o OUT", "--to icub-matrix: a file holds one matrix, got 2 calibrations"),
        ("BOTH --to numpy -o OUT", "--to numpy: a file holds one matrix, got 2 calibrations"),
        ("LEG --to csv -o OUT --full-scale 1 1 1 1 1 1", "--full-scale: only files of --to icub-matrix"),
        ("LEG --to csv -o OUT --sensor-name x", "--sensor-name: expected --to wholebodydynamics and one calibration"),
        ("LEG ARM --to wholebodydynamics -o OUT --sensor-name x", "--sensor-name: expected --to wholebodydynamics"),
        ("LEG LEG2 --to wholebodydynamics -o OUT", "expected every sensor once, got 'leg_ft' 2 times"),
        ("BARE --to wholebodydynamics -o OUT", "bare.json: sensor 'bare' ('SN001'): expected a matrix and a prior"),
        ("WIDE --to icub-matrix -o OUT", "wide.json: matrix: expected an array of shape (6, 6), got (6, 7)"),
        ("UNRANGED --to icub-matrix -o OUT", "unranged.json: raw_minimum_counts: expected an array of shape (6)"),
        (
            "LEG --to csv -o OUT --stream ARM",
            "--stream: expected --to wholebodydynamics and one calibration, got --to csv",
        ),
        ("LEG ARM --to wholebodydynamics -o OUT --stream LEG", "--stream: expected --to wholebodydynamics and one"),
        (
            "LEG --to wholebodydynamics -o OUT --stream ARM2",
            "leg.json: calibration of sensor 'SN002': expected readings",
        ),
        (
            "LEG --to wholebodydynamics -o OUT --stream WARM",
            "leg.json: sensor 'leg_ft' ('SN001'): the stream depends on",
        ),
        ("LEG --to wholebodydynamics -o OUT --stream NONE", "none.json: expected a calibration file, there is none"),
        ("VOLTS --to wholebodydynamics -o OUT", "volts.json: sensor 'leg_ft' ('SN001'): expected no variable but"),
        ("LEG --to coefficients -o OUT", "expected a calibration with a linear variable such as temperature, got none"),
        ("WARM --to coefficients -o OUT --full-scale 1 1 1 1 1 1", "--full-scale: only files of --to icub-matrix hold"),
        ("LEG --to csv -o FOLDER", "expected a file to write, got a folder"),
        ("LEG --to csv -o LEG", "leg.json: expected a file to write that is not read, got an input"),
        ("LEG --to csv -o NOWHERE", "expected an existing folder to write to, got none"),
        ("NONE --to csv -o OUT", "none.json: expected a calibration file, there is none"),
        ("LEG NONE --to wholebodydynamics -o OUT", "none.json: expected a calibration file, there is none"),
    ],
)
def test_wrong_requests_are_one_line_and_write_nothing(
    run: Run, leg: Path, tmp_path: Path, arguments: str, message: str
) -> None:
    """The line says what to change; the exit code is 2, and no file changes."""
    seven = np.hstack([MOUNTED, np.ones((6, 1))])
    (tmp_path / "folder").mkdir()
    (tmp_path / "both").mkdir()
    for name in ("arm_ft", "leg_ft"):
        _written(tmp_path / "both" / f"{name}.json", make_calibration(name=name))
    _written(tmp_path / "arm.json", make_calibration(name="arm_ft"))
    _written(tmp_path / "arm2.json", make_calibration(name="arm_ft", serial="SN002"))
    _written(tmp_path / "warm.json", make_calibration(variables=(make_variable(),)))
    _written(tmp_path / "volts.json", make_calibration(variables=(make_variable(name="supply", unit="V"),)))
    _written(tmp_path / "leg2.json", make_calibration())
    _written(tmp_path / "bare.json", make_calibration(name="bare", prior=None))
    _written(tmp_path / "wide.json", make_calibration(matrix=seven, prior=None))
    unranged = make_calibration().model_copy(update={"validity": make_calibration(matrix=seven).validity})
    _written(tmp_path / "unranged.json", unranged)
    files = {
        "OUT": tmp_path / "out.file",
        "LEG": leg,
        "FOLDER": tmp_path / "folder",
        "BOTH": tmp_path / "both",
        "NOWHERE": tmp_path / "nowhere" / "x",
    }
    others = ("arm", "arm2", "leg2", "bare", "wide", "unranged", "warm", "volts", "none")
    files |= {name.upper(): tmp_path / f"{name}.json" for name in others}
    before = {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    done = run(*(files.get(word, word) for word in arguments.split()))
    assert done.code == 2
    assert done.out == ""
    errors = [line for line in done.err.splitlines() if line.startswith("error: ")]
    assert len(errors) == 1
    assert message in errors[0]
    assert {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()} == before


def test_parameters_of_ros2_need_a_frame(run: Run, leg: Path, tmp_path: Path) -> None:
    """--frame-id is asked for, and belongs to no other form."""
    output = tmp_path / "leg.yaml"
    assert "--frame-id names it" in run(leg, "--to", "ros2", "-o", output).err
    assert "--frame-id: only files of --to ros2" in run(leg, "--to", "csv", "-o", output, "--frame-id", "ft").err
    assert not output.exists()
    done = run(leg, "--to", "ros2", "-o", output, "--frame-id", "ft", "--sensor-name", "wrist", "--format", "json")
    assert done.result()["calibrations"][0]["sensor"] == "wrist"
    assert 'frame_id: "ft"' in output.read_text(encoding="utf-8")
