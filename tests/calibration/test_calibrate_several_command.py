# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate` with several files: recordings, and moments that were kept of others."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.calibration.calibration_file import read_calibration
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import edit, snapshot, write_sharing
from tests.scenes.studies import CALIBRATION


@pytest.mark.long
def test_recordings_and_moments_come_to_one_calibration(days: Path, run: Run) -> None:
    """All files, and two of them with the moments of the others, give the same; the file says which went in."""
    whole = run("calibrate", *CALIBRATION, "-o", "whole.json", "--moments", "kept", "--format", "json").result()
    kept = sorted(str(path) for path in Path("kept").iterdir())
    assert kept == [f"kept/arm_ft_SIM001_arm {Path(file).stem}.json" for file in sorted(CALIBRATION)]
    schema = run("schema", "moments").result()
    for path in kept:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
        assert faults(content, schema) == []
        assert faults({**content, "intervals": []}, schema) != []
    mixed = [*CALIBRATION[2:], *(path for path in kept if "grid" in path)]
    ended = run("calibrate", *mixed, "-o", "mixed.json")
    assert ended.code == 0
    alone = run("calibrate", *kept, "-o", "alone.json")
    assert alone.code == 0
    one = read_calibration("whole.json")
    for file in ("mixed.json", "alone.json"):
        other = read_calibration(file)
        np.testing.assert_allclose(other.matrix, one.matrix, rtol=1e-8)
        assert len(other.provenance.intervals) == len(CALIBRATION)
    (entry,) = whole["calibrations"]
    assert [row["direction"] for row in entry["information_gain"]] == ["fx", "fy", "fz", "tx", "ty", "tz"]


def test_another_serial_number_is_refused(days: Path, run: Run) -> None:
    """The file is named, what came and what to do; nothing is written."""
    edit(days / CALIBRATION[1], 'serial = "SIM001"', 'serial = "SIM777"')
    before = snapshot(days)
    error = run("calibrate", *CALIBRATION, "-o", "a.json").error()
    assert (
        f"{CALIBRATION[1]}: sensor 'arm_ft': expected the serial number of {CALIBRATION[0]}, SIM001, got SIM777"
        in error
    )
    assert "leave one of the two out" in error
    assert snapshot(days) == before


def test_a_file_twice_is_refused(days: Path, run: Run) -> None:
    """Its samples would count twice."""
    error = run("calibrate", CALIBRATION[0], CALIBRATION[0], "-o", "a.json").error()
    assert "expected every experiment file once, it comes twice" in error


@pytest.mark.long
def test_memory_of_all_samples_is_stated(days: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a fit holds them all and that is much; a fit of segments says nothing."""
    thesis = ("calibrate", CALIBRATION[0], "--lambda", "5", "-o", "a.json", "--force")
    assert "GB of memory" not in run(*thesis).err
    monkeypatch.setattr("forcetorque.calibration.commands._LARGE_BYTES", 1)
    assert "samples at once, about 0.5 GB of memory; without it" in run(*thesis).err
    assert "GB of memory" not in run("calibrate", CALIBRATION[0], "-o", "b.json").err


@pytest.mark.parametrize("options", [[], ["--lambda", "5"], ["--jointly"]], ids=["default", "thesis", "jointly"])
def test_a_copy_of_a_log_is_refused(days: Path, run: Run, options: list[str]) -> None:
    """Under another name its samples would count twice; another log is fitted."""
    text = (days / CALIBRATION[0]).read_text()
    (days / "copy.toml").write_text(re.sub(r'(?m)^name = ".*"', 'name = "copy"', text, count=1))
    error = run("calibrate", CALIBRATION[0], "copy.toml", *options, "-o", "fit" if options else "fit.json").error()
    assert re.search(r"'copy' has readings of '.*' again, and readings count once; leave one of the two out", error)
    assert not (days / "fit").exists()
    assert not (days / "fit.json").exists()


@pytest.mark.parametrize("options", [[], ["--lambda", "5"], ["--jointly"]], ids=["default", "thesis", "jointly"])
def test_the_share_of_readings_in_two_recordings_is_that_of_their_samples(
    arm: Path, run: Run, options: list[str]
) -> None:
    """Two of eight seconds are in the longer recording too: 25 %, not one interval of two."""
    error = run("calibrate", *write_sharing(arm, "calibration"), *options, "-o", "fit").error()
    assert "'second' has about 25 % of its readings in common with 'first'" in error


@pytest.mark.long
def test_moments_are_not_for_a_type_of_the_thesis(days: Path, run: Run) -> None:
    """It needs samples; the error says what to leave out."""
    assert run("calibrate", CALIBRATION[0], "-o", "a.json", "--moments", "kept").code == 0
    (kept,) = Path("kept").iterdir()
    error = run("calibrate", CALIBRATION[1], str(kept), "-o", "b.json", "--type", "OwTrTO").error()
    assert "stored moments are fitted by the generative model; leave out the estimation type and lambda" in error
    assert not Path("b.json").exists()


@pytest.mark.long
def test_a_file_of_moments_is_no_place_to_write_to(days: Path, run: Run) -> None:
    """What was kept of a recording is not replaced by the calibration that is made of it."""
    assert run("calibrate", CALIBRATION[0], "-o", "a.json", "--moments", "kept").code == 0
    (kept,) = Path("kept").iterdir()
    before = kept.read_bytes()
    error = run("calibrate", CALIBRATION[1], str(kept), "-o", str(kept)).error()
    assert "expected a file to write that is not read, got an input" in error
    assert kept.read_bytes() == before


@pytest.mark.long
def test_moments_of_a_sensor_that_is_not_fitted_are_refused(days: Path, run: Run) -> None:
    """They would be left out in silence; with moments alone, --sensor chooses among theirs."""
    assert run("calibrate", CALIBRATION[0], "-o", "a.json", "--moments", "kept").code == 0
    (kept,) = Path("kept").iterdir()
    other = json.loads(kept.read_text(encoding="utf-8"))
    other["sensor"]["name"] = "leg_ft"
    Path("leg.json").write_text(json.dumps(other), encoding="utf-8")
    error = run("calibrate", CALIBRATION[1], "leg.json", "-o", "b.json").error()
    assert "leg.json: moments of 'leg_ft', which is not fitted here; leave the file out, or name" in error
    error = run("calibrate", str(kept), "-o", "b.json", "--sensor", "foot_ft").error()
    assert "--sensor: no file of moments is of 'foot_ft'" in error
    assert not Path("b.json").exists()
    assert run("calibrate", str(kept), "-o", "b.json", "--sensor", "arm_ft").code == 0


@pytest.mark.long
def test_files_that_ask_for_different_estimators_are_refused(days: Path, run: Run) -> None:
    """The first file does not overrule the second; a type for all does."""
    second = days / CALIBRATION[1]
    edit(second, "[recording]", '[calibration]\ntype = "OwTrTO"\n\n[recording]')
    error = run("calibrate", *CALIBRATION[:2], "-o", "a.json").error()
    assert f"{CALIBRATION[1]}: expected the estimator that [calibration] of {CALIBRATION[0]} asks for" in error
    assert not Path("a.json").exists()
    assert run("calibrate", *CALIBRATION[:2], "-o", "a.json", "--type", "generative").code == 0


def test_recordings_that_cannot_be_used_are_left_out_and_named(days: Path, run: Run) -> None:
    """A damaged log and a robot with another joint: the others are fitted; where all are bad it is an error."""
    damaged, renamed, *others = CALIBRATION
    log = sorted((days / damaged.removesuffix(".toml")).glob("*.parquet"))[0]
    log.write_bytes(log.read_bytes()[:1000])
    robot = (days / "robot.urdf").read_text(encoding="utf-8")
    (days / "other.urdf").write_text(robot.replace('"shoulder_yaw"', '"other_joint"'), encoding="utf-8")
    edit(days / renamed, 'urdf = "robot.urdf"', 'urdf = "other.urdf"')
    ended = run("calibrate", *CALIBRATION, "-o", "whole.json", "--moments", "kept", "--format", "json")
    assert ended.code == 0
    said = " ".join(ended.log)
    assert f"{damaged}: left out: " in said
    assert f"{renamed}: left out: no stream holds the position of joint 'other_joint'" in said
    assert len(read_calibration("whole.json").provenance.intervals) == len(others)
    assert len(list(Path("kept").iterdir())) == len(others)
    assert "other_joint" in run("calibrate", damaged, renamed, "-o", "none.json").error()
    assert "other_joint" in run("calibrate", renamed, "-o", "none.json").error()
    assert not Path("none.json").exists()
