# SPDX-License-Identifier: BSD-3-Clause
"""Bad input: exit code 2, one line that says where, and no file that is new or changed."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from tests.app.outcome import Run
from tests.scenes.experiments import ARM_LOG, FT_LOG, PARQUET, TWO, YARP, add, edit, edit_line, edit_lines, snapshot

KEPT = "kept.json"
"""An earlier result, of which an error must leave every byte."""


def _cut_last_line(file: Path) -> None:
    file.write_bytes(file.read_bytes()[:-9])


def _later(log: str, seconds: int) -> Callable[[], object]:
    """Move a port's stamps, which all begin with the same digits."""
    return lambda: edit_lines(
        Path(log), lambda lines: [line.replace(" 17000000", f" {17000000 + seconds // 100}", 1) for line in lines]
    )


def _in(file: str, old: str, new: str) -> Callable[[], object]:
    return lambda: edit(Path(file), old, new)


def _line(file: str, number: int, change: Callable[[str], str]) -> Callable[[], object]:
    return lambda: edit_line(Path(file), number, change)


def _nothing() -> None:
    """Leave the input as it is: the words alone are bad."""


BAD: dict[str, tuple[str, Callable[[], object], str]] = {
    "no experiment file": (
        PARQUET,
        lambda: Path(PARQUET).unlink(),
        "parquet.toml: expected an experiment file, there i",
    ),
    "no TOML": (PARQUET, _in(PARQUET, "[robot]", "[robot"), "parquet.toml: expected TOML, got Expected ']' at the end"),
    "unknown key": (
        PARQUET,
        _in(PARQUET, "serial", "serail"),
        "parquet.toml: sensor[0]: unknown key 'serail'; did you",
    ),
    "no URDF": (PARQUET, lambda: Path("arm.urdf").unlink(), "arm.urdf: expected a URDF file, there is none"),
    "URDF with a loop": (
        PARQUET,
        _in("arm.urdf", '<parent link="base"/>', '<parent link="hand"/>'),
        "arm.urdf: robot 'arm': the joints above link ",
    ),
    "URDF without a link": (
        PARQUET,
        _in("arm.urdf", '<link name="base"/>', ""),
        "arm.urdf: joint 'shoulder_yaw': its parent link 'base' is not in the robot; known: forearm, hand, ",
    ),
    "URDF that is cut": (
        PARQUET,
        lambda: edit_lines(Path("arm.urdf"), lambda lines: lines[:20]),
        "arm.urdf:21: expected XML, got no element found",
    ),
    "sensor not in the URDF": (
        PARQUET,
        _in(PARQUET, 'name = "arm_ft"', 'name = "leg_ft"'),
        "parquet.toml: sensor[0]: robot 'arm' has no force-torque sensor 'leg_ft'; ",
    ),
    "no log": (YARP, lambda: shutil.rmtree("log"), "log: expected the folder of a log, there is none"),
    "no port": (
        YARP,
        lambda: shutil.rmtree(Path(FT_LOG).parent),
        "yarp.toml: recording.stream[0]: log/arm_ft/analog:o: ",
    ),
    "no recording": (
        PARQUET,
        lambda: shutil.rmtree("recording"),
        "recording/recording.json: expected the index of a re",
    ),
    "no stream file": (
        PARQUET,
        lambda: Path("recording/joints.parquet").unlink(),
        "recording/joints.parquet: expected the Parquet file of a stream, there is no such file",
    ),
    "stream file that is cut": (
        PARQUET,
        lambda: _cut_last_line(Path("recording/arm_ft.parquet")),
        "recording/arm_ft.parquet: expected a stream of the form forcetorque/recording/1, got ",
    ),
    "stream without a column": (
        PARQUET,
        lambda: pq.write_table(
            pq.read_table("recording/joints.parquet").drop(["position"]), "recording/joints.parquet"
        ),
        "recording/joints.parquet: expected a stream of the form forcetorque/recording/1, got ",
    ),
    "empty log": (
        YARP,
        lambda: Path(FT_LOG).write_bytes(b""),
        "analog:o/data.log: expected at least one message, got an",
    ),
    "last line that is cut": (
        YARP,
        lambda: _cut_last_line(Path(ARM_LOG)),
        "yarp.toml: recording.stream[1]: log/arm/stateExt:o/data.log:1200: expected a line feed at the end of the last",
    ),
    "NaN in the log": (
        YARP,
        _line(FT_LOG, 77, lambda line: f"{line.rpartition(' ')[0]} nan\n"),
        "log/arm_ft/analog:o/data.log:77: expected numbers, lists, [ok] and [fail], got 'nan'; delete the line",
    ),
    "seven columns": (
        YARP,
        _line(FT_LOG, 78, lambda line: f"{line[:-1]} 0\n"),
        "log/arm_ft/analog:o/data.log:78: expected 6 numbers fx fy fz tx ty tz, got 7",
    ),
    "four joints": (
        YARP,
        _line(ARM_LOG, 79, lambda line: line.replace(" (", " (1 ", 1)),
        "log/arm/stateExt:o/data.log:79: expected 11 lists with flags of 5 5 5 5 5 5 5 5 5 5 5 numbers as in the lines",
    ),
    "wrenches without prior": (
        YARP,
        _in(YARP, "prior =", "# prior ="),
        "yarp.toml: sensor[0]: expected prior, the matrix ",
    ),
    "held-out without prior": (
        PARQUET,
        lambda: add(edit(Path(PARQUET), "prior =", "# prior ="), '\n[calibration]\nlambda_counts2 = "held-out"\n'),
        "parquet.toml: sensor 'arm_ft': lambda cannot be chosen without a prior matrix; give a prior, or lambda 0",
    ),
    "lambda without prior": (
        PARQUET,
        lambda: add(edit(Path(PARQUET), "prior =", "# prior ="), "\n[calibration]\nlambda_counts2 = 5\n"),
        "parquet.toml: sensor 'arm_ft': lambda: 5 counts2 needs a prior matrix to pull towards; give one or lambda 0",
    ),
    "joints after the sensor": (
        YARP,
        _later(ARM_LOG, 1000),
        "yarp.toml: sensor 'arm_ft': streams 'arm_ft' and 'joints' do not overlap in time: 97",
    ),
    "sensor after the joints": (
        YARP,
        _later(FT_LOG, 1000),
        "yarp.toml: sensor 'arm_ft': interval 'fit': stream 'arm_ft' has no sample in it to use",
    ),
    "interval after the log": (
        PARQUET,
        _in(PARQUET, "end_s = 14.0", "end_s = 140.0"),
        "parquet.toml: interval[0] 'fit': expected a span inside the log, 0 to 23.9",
    ),
    "prior that is damaged": (
        PARQUET,
        _line("matrix_SIM001.txt", 5, lambda _: "XYZ\r\n"),
        "matrix_SIM001.txt:5: expected 1 to 4 hex digits, all upper-case or all lower-case, got 'XYZ'",
    ),
    "prior that is cut": (
        YARP,
        lambda: edit_lines(Path("matrix_SIM001.txt"), lambda lines: lines[:40]),
        "matrix_SIM001.txt:40: expected 43 lines (36 coefficients, gain, 6 full scales), got 40",
    ),
    "singular prior": (
        YARP,
        lambda: edit_lines(Path("matrix_SIM001.txt"), lambda lines: ["0\r\n"] * 36 + lines[36:]),
        "yarp.toml: sensor 'arm_ft': the prior matrix is singular, so raw counts cannot be recovered from the",
    ),
    "singular prior of counts": (
        PARQUET,
        lambda: edit_lines(Path("matrix_SIM001.txt"), lambda lines: ["0\r\n"] * 36 + lines[36:]),
        "parquet.toml: sensor 'arm_ft': the prior matrix is singular, so no matrix corrects what it made",
    ),
    "joint that was not logged": (
        YARP,
        _in(YARP, '"elbow", "wrist"]', '"elbow", "finger"]'),
        "yarp.toml: sensor 'arm_ft': no stream holds the position of joint 'wrist'; known: elbow, finger, shoulder_",
    ),
    "derivatives that were not logged": (
        PARQUET,
        lambda: add(Path(PARQUET), '\n[processing]\nderivatives = "logged"\n'),
        "parquet.toml: sensor 'arm_ft': no stream holds the velocity of joint 'shoulder_yaw'; take derivatives from",
    ),
    "order below two": (
        PARQUET,
        lambda: add(Path(PARQUET), "\n[processing]\nderivatives = { window_s = 0.3, order = 1 }\n"),
        "parquet.toml: sensor 'arm_ft': Savitzky-Golay: derivative 2 needs a polynomial of at least that order, got 1",
    ),
    "second sensor that is bad": (
        TWO,
        _line("matrix_SIM002.txt", 43, lambda _: "0\r\n"),
        "matrix_SIM002.txt:43: expected a full scale, an integer from 1 to 65535 in decimal, got '0'",
    ),
}


@pytest.mark.parametrize("output", [KEPT, "fresh/fresh.json"])
@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line_and_no_file(arm: Path, run: Run, name: str, output: str) -> None:
    """The line says file and line or key; an earlier result keeps its bytes, a new one does not begin to exist."""
    form, damage, message = BAD[name]
    Path(KEPT).write_text('{"schema": "forcetorque/calibration/1", "of": "an earlier result"}', encoding="utf-8")
    damage()
    before = snapshot(arm)
    assert message in run("calibrate", form, "-o", output).error()
    assert snapshot(arm) == before


@pytest.mark.parametrize("name", ["no URDF", "last line that is cut", "joint that was not logged", "no port"])
def test_evaluate_refuses_the_same(arm: Path, run: Run, name: str) -> None:
    """Input that cannot be fitted cannot be evaluated either, and is named alike."""
    form, damage, message = BAD[name]
    assert run("evaluate", form, "-c", "fitted.json").code == 0
    damage()
    assert message in run("evaluate", form, "-c", "fitted.json").error()


@pytest.mark.parametrize("form", [PARQUET, YARP, TWO])
def test_the_same_commands_succeed_on_what_is_not_damaged(arm: Path, run: Run, form: str) -> None:
    """Negative control: without damage there is no error, and the files appear."""
    before = snapshot(arm)
    assert run("calibrate", form, "-o", "fresh").code == 0
    assert len(snapshot(arm).keys() - before.keys()) == (3 if form == TWO else 2)


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("arm.urdf", "error: --output arm.urdf: expected a folder or a .json file, got another file"),
        ("arm.urdf/made", "arm.urdf"),
        ("arm.urdf/made.json", "arm.urdf"),
        ("recording.json", "recording.json"),
    ],
)
def test_an_output_that_cannot_be_written_is_named(arm: Path, run: Run, output: str, message: str) -> None:
    """A file is no folder, a folder is no file, and both stay as they were."""
    Path("recording.json").mkdir()
    before = snapshot(arm)
    assert message in run("calibrate", PARQUET, "-o", output).error()
    assert snapshot(arm) == before


def test_a_folder_without_permission_is_named(arm: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the operating system refuses is one line too, and leaves no temporary file."""

    def refuse(path: Path, target: Path) -> None:
        raise PermissionError(13, "Permission denied", str(target))

    monkeypatch.setattr(Path, "replace", refuse)
    before = snapshot(arm)
    error = run("calibrate", PARQUET, "-o", "made.json").error()
    assert error == f"error: [Errno 13] Permission denied: '{arm / 'made.json'}'"
    assert snapshot(arm) == before


def test_a_log_of_nan_is_refused_with_the_interval(arm: Path, run: Run) -> None:
    """In the project's own form NaN marks a gap; an interval that is nothing else cannot be fitted."""
    table = pq.read_table("recording/arm_ft.parquet")
    field = table.schema.field("raw")
    raw = np.full((len(table), 6), np.nan)
    column = type(table.column("raw").chunk(0)).from_arrays(raw.ravel(), type=field.type)
    pq.write_table(table.set_column(table.schema.get_field_index("raw"), field, column), "recording/arm_ft.parquet")
    error = run("calibrate", PARQUET, "-o", "made.json").error()
    assert "parquet.toml: sensor 'arm_ft': interval 'fit': none of " in error
