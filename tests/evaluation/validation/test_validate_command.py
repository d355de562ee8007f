# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study validate`: its forms, the best candidate, and what it refuses."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.storage import write_recording
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO, add, edit, holed, snapshot

AXES = [
    f"mean_absolute_{component}_{unit.replace(' ', '')}"
    for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)
]
"""Columns of the mean absolute values in CSV."""

INBOARD = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll")
"""Joints between the support and the arm's sensor."""


def test_the_best_candidate_is_named_in_every_form(arm: Path, run: Run) -> None:
    """The fit is best by magnitude and on every axis; the same numbers stand in JSON, CSV and table."""
    before = snapshot(arm)
    result = run("study", "validate", PARQUET, "-c", "fitted.json", "--format", "json").result()
    assert faults(result, run("schema", "validate").result()) == []
    rows = {(row["calibration"], row["offset"]): row for row in result["contact_forces"]}
    assert set(rows) == {(c, o) for c in ("prior", "fitted.json") for o in ("fitted", "first-second")}
    for best in result["best"]:
        assert best["by_magnitude"] == "fitted.json"
        forces = {c: rows[c, best["offset"]]["force_mean_N"] for c in ("prior", "fitted.json")}
        assert forces["fitted.json"] == min(forces.values())
        for axis, name in enumerate(best["by_axis"]):
            values = {c: rows[c, best["offset"]]["mean_absolute"][axis] for c in forces}
            assert values[name] == min(values.values())
    table = run("study", "validate", PARQUET, "-c", "fitted.json", "--format", "csv")
    flat = [line for line in csv.DictReader(io.StringIO(table.out)) if line["what"] == "contact_force"]
    assert len(flat) == 4
    for line in flat:
        row = rows[line["calibration"], line["offset"]]
        np.testing.assert_allclose([float(line[c]) for c in AXES], row["mean_absolute"], rtol=1e-12)
    shown = run("study", "validate", PARQUET, "-c", "fitted.json", "--details")
    assert shown.code == 0
    assert "free sub-model arm_ft" in shown.out
    assert "best is fitted.json" in shown.out
    assert "other sensors: as the model expects" in shown.out
    assert snapshot(arm) == before


@pytest.mark.long
def test_joint_torques_are_in_every_form(arm: Path, run: Run) -> None:
    """A row per candidate, offset and joint that depends on the sensor; the same numbers in JSON, CSV and table."""
    result = run("study", "validate", PARQUET, "-c", "fitted.json", "--format", "json").result()
    rows = {(row["calibration"], row["offset"], row["joint"]): row for row in result["joint_torques"]}
    assert len(rows) == len(result["joint_torques"]) == 2 * 2 * len(INBOARD)
    assert {joint for _, _, joint in rows} == set(INBOARD)
    assert result["left_out"] == []
    for (candidate, offset, joint), row in rows.items():
        assert (row["unit"], row["logged_rmse"]) == ("N m", None)
        assert abs(row["mean"]) <= row["rmse"] <= row["largest"]
        if candidate == "fitted.json":
            assert row["rmse"] < 0.2 * rows["prior", offset, joint]["rmse"]
    table = run("study", "validate", PARQUET, "-c", "fitted.json", "--format", "csv")
    flat = [line for line in csv.DictReader(io.StringIO(table.out)) if line["what"] == "joint_torque"]
    assert len(flat) == len(rows)
    for line in flat:
        row = rows[line["calibration"], line["offset"], line["joint"]]
        assert {line["force_mean_N"], line[AXES[0]], line["logged_rmse"]} == {""}
        for key in ("samples", "rmse", "rmse_error", "mean", "mean_error", "largest"):
            assert float(line[key]) == row[key]
    shown = run("study", "validate", PARQUET, "-c", "fitted.json", "--details").out
    assert "joint torques estimated from it, less those of the model" in shown
    for row in rows.values():
        assert f"{row['rmse']:.3f} ±{row['rmse_half_width_95']:.3f}" in shown


def test_it_is_said_where_no_torque_depends_on_the_sensor(arm: Path, run: Run) -> None:
    """The tool's sensor, judged by the part before it: with the contact in the hand, no joint lies in between."""
    beyond = run("study", "validate", TWO, "--sensor", "tool_ft", "--format", "json").result()
    assert {row["joint"] for row in beyond["joint_torques"]} == {"elbow", "wrist"}
    options = ("--sensor", "tool_ft", "--sub-model", "arm_ft", "--contact", "hand")
    assert run("study", "validate", TWO, *options, "--format", "json").result()["joint_torques"] == []
    assert "tool_ft: no joint torque is estimated from it" in run("study", "validate", TWO, *options, "--details").out


def test_without_calibrations_every_sensor_is_judged_by_its_prior(arm: Path, run: Run) -> None:
    """Both sensors of the file; with --sensor only the one."""
    result = run("study", "validate", TWO, "--format", "json", "--others", "measured").result()
    assert {row["sensor"] for row in result["contact_forces"]} == {"arm_ft", "tool_ft"}
    assert result["other_sensors"] == "measured"
    one = run("study", "validate", TWO, "--sensor", "tool_ft", "--sub-model", "arm_ft", "--format", "json").result()
    assert {(row["sensor"], row["sub_model"]) for row in one["contact_forces"]} == {("tool_ft", "arm_ft")}


def test_wrong_words_are_refused_in_one_line(arm: Path, run: Run) -> None:
    """Unknown sensor, part and link are errors that say what is known."""
    assert "has no sensor 'leg'" in run("study", "validate", PARQUET, "--sensor", "leg").error()
    assert "sub_model: expected one of the two" in run("study", "validate", PARQUET, "--sub-model", "leg").error()
    assert "no link 'leg'" in run("study", "validate", PARQUET, "--contact", "leg").error()
    assert run("study", "validate", PARQUET, "--others", "both").code == 2


@pytest.mark.long
def test_what_is_left_out_is_warned_of_and_every_row_counts_its_own_samples(arm: Path, run: Run) -> None:
    """A short interval, and one whose first second is a gap: the title gives no count where rows differ."""
    assert "arm_ft; per axis" not in run("study", "validate", PARQUET, "--details").out
    edit(arm / PARQUET, "end_s = 23.5", "end_s = 17.0")
    for label, start_s, end_s in (("rest", 17.0, 22.0), ("blink", 22.5, 23.0)):
        interval = f'label = "{label}"\nstart_s = {start_s}\nend_s = {end_s}\nuse = "validation"\nsupport = "base"'
        add(arm / PARQUET, f"\n[[interval]]\n{interval}\n")
    write_recording(arm / "holed", holed(load_experiment(PARQUET).recording, "arm_ft", 17.0, 18.1))
    edit(arm / PARQUET, 'path = "recording"', 'path = "holed"')
    done = run("study", "validate", PARQUET, "-c", "fitted.json", "--format", "json")
    left_out = done.result()["left_out"]
    assert "arm_ft: interval 'blink': it ends within its first 1 s, after which it would be evaluated" in left_out
    for name in ("prior", "fitted.json"):
        words = f"arm_ft: contact force by {name} over 'rest', offset first-second: every sample of its first second"
        assert [line for line in left_out if line.startswith(words)]
    for line in left_out:
        assert f"WARNING: left out: {line}" in done.log
    counts = {(row["calibration"], row["offset"]): row["samples"] for row in done.result()["contact_forces"]}
    assert len(set(counts.values())) == 2
    shown = run("study", "validate", PARQUET, "-c", "fitted.json", "--details").out
    assert "free sub-model arm_ft; force: mean norm ± half its 95 % interval; per axis" in shown
    table = shown[: shown.index("joint torques")].partition("mean contact wrench")[0].splitlines()
    rows = [line.split() for line in table if line.startswith((" prior", " fitted.json"))]
    (headings,) = (line.split() for line in table if line.startswith(" calibration"))
    assert [int(row[headings.index("samples")]) for row in rows] == list(counts.values())


@pytest.mark.long
def test_it_is_said_where_no_offset_was_removed(arm: Path, run: Run) -> None:
    """By the prior alone, in a file without an interval to fit; a calibration carries the offset of its prior."""
    assert "no offset removed" not in run("study", "validate", PARQUET, "--details").out
    edit(arm / PARQUET, 'use = "calibration"', 'use = "ignore"')
    alone = run("study", "validate", PARQUET, "--details")
    assert "arm_ft, prior, offset none: read by the prior matrix_SIM001.txt, no offset removed" in alone.out
    rows = run("study", "validate", PARQUET, "--format", "json").result()
    for row in (*rows["contact_forces"], *rows["joint_torques"]):
        assert row["offset_source"].endswith("no offset removed") == (row["offset"] == "none")
    assert "no offset removed" not in run("study", "validate", PARQUET, "-c", "fitted.json", "--details").out


def test_accept_judges_the_prior_that_no_data_gave_an_offset(arm: Path, run: Run) -> None:
    """With the limit on `fitted`: the numbers are those of the rows whose offset is `none`."""
    edit(arm / PARQUET, 'use = "calibration"', 'use = "ignore"')
    limits = '[validate]\nforce_mean_N = 1.0\nmoment_mean_Nm = 1.0\noffset = "fitted"\n'
    (arm / "limits.toml").write_text(f'schema = "forcetorque/acceptance/1"\nname = "t"\n{limits}', encoding="utf-8")
    rows = run("study", "validate", PARQUET, "--format", "json").result()["contact_forces"]
    (row,) = (row for row in rows if row["offset"] == "none")
    accepted = run("accept", PARQUET, "--spec", "limits.toml", "--format", "csv")
    assert accepted.code == 1, accepted.err
    measured = {line["criterion"]: float(line["measured"]) for line in csv.DictReader(io.StringIO(accepted.out))}
    assert measured["validate.force_mean_N"] == row["force_mean_N"]
    assert measured["validate.moment_mean_Nm"] == row["moment_mean_Nm"]


def test_the_prior_is_the_one_of_evaluate(arm: Path, run: Run) -> None:
    """In a file without an interval to fit, both give it the offset that the calibration carries; the numbers agree."""
    edit(arm / PARQUET, 'use = "calibration"', 'use = "ignore"')
    words = (PARQUET, "-c", "fitted.json", "--format", "json")
    judged = {(r["calibration"], r["offset"]): r for r in run("evaluate", *words).result()["verdicts"]}
    rows = {(r["calibration"], r["offset"]): r for r in run("study", "validate", *words).result()["contact_forces"]}
    for name, prior in (("prior", None), ("fitted.json", "prior")):
        one, other = judged[name, "fitted"], rows[name, "fitted"]
        # evaluate judges the first second too, one in nine
        assert abs(one["force_error_mean_N"] / other["force_mean_N"] - 1.0) < 0.15
        assert (one["prior"], one["offset_source"]) == (other["prior"], other["offset_source"])
        assert one["prior"] == prior
