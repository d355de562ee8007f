# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate`: its table of samples, its summary, and what it refuses."""

from __future__ import annotations

import csv
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.recording.storage import read_recording, write_recording
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO, YARP, add, edit, snapshot
from tests.scenes.warm_experiments import TEMPERATURE


def test_the_file_holds_every_sample_with_units(arm: Path, run: Run) -> None:
    """Rows are the samples of all intervals; columns are the library's numbers, with units in the metadata."""
    result = run("estimate", PARQUET, "-o", "out.parquet", "-c", "fitted.json", "--format", "json").result()
    table = pq.read_table("out.parquet")
    experiment = load_experiment(PARQUET)
    corrections = corrections_of(experiment, {"fitted.json": read_calibration(Path("fitted.json"))})
    spans = estimate_experiment(experiment, corrections)
    assert table.num_rows == result["samples"] == sum(len(span.estimates) for span in spans)
    assert set(table.column("interval").to_pylist()) == {"fit", "judge"}
    for column, values, unit in (
        ("contact.arm_ft.fz", [span.estimates.contact("arm_ft")[:, 2] for span in spans], b"N"),
        ("torque.elbow", [span.estimates.torque("elbow") for span in spans], b"N m"),
        ("expected.arm_ft.tx", [span.estimates.expected_of("arm_ft")[:, 3] for span in spans], b"N m"),
        ("residual.base.fx", [span.estimates.residual_of("base")[:, 0] for span in spans], b"N"),
    ):
        np.testing.assert_array_equal(table.column(column).to_numpy(), np.concatenate(values))
        assert table.schema.field(column).metadata[b"unit"] == unit
    assert table.column("rank.arm_ft").to_numpy().min() == 6
    assert result["wrench_sources"] == {"arm_ft": "fitted.json"}


@pytest.mark.long
def test_text_holds_the_same_as_parquet(arm: Path, run: Run) -> None:
    """Both forms have the same columns and, to the last digit, the same numbers."""
    for name in ("out.parquet", "out.csv"):
        assert run("estimate", YARP, "-o", name).code == 0
    table = pq.read_table("out.parquet")
    with Path("out.csv").open(encoding="utf-8", newline="") as stream:
        header, *rows = csv.reader(stream)
    assert header == table.column_names
    assert len(rows) == table.num_rows
    column = header.index("contact.arm_ft.fx")
    assert [float(row[column]) for row in rows] == table.column("contact.arm_ft.fx").to_pylist()


def test_the_summary_is_the_mean_norm(arm: Path, run: Run) -> None:
    """JSON, CSV and table say the same, and the JSON has the published form."""
    words = ("estimate", PARQUET, "-o", "out.parquet", "--format")
    result = run(*words, "json").result()
    assert faults(result, run("schema", "estimate").result()) == []
    rows = run(*words, "csv").rows()
    shown = run(*words, "table", "--details").out
    table = pq.read_table("out.parquet")
    force = np.column_stack([table.column(f"contact.arm_ft.f{axis}").to_numpy() for axis in "xyz"])
    judged = np.array(table.column("interval").to_pylist()) == "judge"
    mean = float(np.linalg.norm(force[judged], axis=1).mean())
    (found,) = [row for row in result["contacts"] if (row["contact"], row["interval"]) == ("arm_ft", "judge")]
    assert found["force_mean_N"] == pytest.approx(mean)
    assert found["samples"] == judged.sum()
    assert [float(row["force_mean_N"]) for row in rows if row["contact"] == "arm_ft"][1] == pytest.approx(mean)
    assert f"{mean:.2f}" in shown


def test_contacts_by_name(arm: Path, run: Run) -> None:
    """Named contacts take the place of those at the sensors; the support stays."""
    result = run(
        "estimate", TWO, "-o", "out.parquet", "--contacts", "tool", "--contacts", "hand:force", "--format", "json"
    ).result()
    assert {row["contact"] for row in result["contacts"]} == {"base", "tool", "hand"}
    ranks = {row["sub_model"]: row["rank"] for row in result["sub_models"]}
    assert ranks == {"base": 6, "arm_ft": 3, "tool_ft": 6}


@pytest.mark.long
def test_what_trades_off_is_said(arm: Path, run: Run) -> None:
    """With more unknowns than equations the groups are in the result and on the screen."""
    words = ("estimate", PARQUET, "-o", "o.csv", "--contacts", "hand", "--contacts", "forearm:force")
    said = run(*words, "--length-scale", "0.2", "--format", "json").result()
    (group,) = [
        row["ambiguous"] for row in said["sub_models"] if row["sub_model"] == "arm_ft" and row["interval"] == "judge"
    ]
    assert {"hand.fx", "forearm.fx"} <= {name for names in group for name in names}
    assert "not separable: " in run(*words, "--length-scale", "0.2").out
    assert "length_scale" in run(*words).error()


def test_a_gap_is_an_empty_cell(arm: Path, run: Run) -> None:
    """A reading that is missing leaves its sample's contact empty and no other."""
    recording = read_recording("recording")
    raw = np.array(recording.stream("arm_ft").signal("raw").values)
    raw[800, 2] = np.nan
    stream = recording.stream("arm_ft")
    damaged = replace(stream, signals={"raw": replace(stream.signal("raw"), values=raw)})
    write_recording("recording", replace(recording, streams={**recording.streams, "arm_ft": damaged}))
    assert run("estimate", PARQUET, "-o", "out.parquet").code == 0
    table = pq.read_table("out.parquet")
    empty = [k for k, value in enumerate(table.column("contact.arm_ft.fx").to_pylist()) if value is None]
    assert len(empty) == 1
    assert table.column("stamp_ns").to_pylist()[empty[0]] == int(stream.stamp_ns[800])
    assert table.column("expected.arm_ft.fx").null_count == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("-o", "out.txt"), r"--output out.txt: expected a name that ends in .parquet or .csv"),
        (("-o", "absent/out.csv"), r"absent/out.csv: expected an existing folder"),
        (("-o", "out.csv", "--contacts", "hnad"), r"parquet.toml: contact 'hnad': .* no link 'hnad'; did you mean"),
        (("-o", "out.csv", "--length-scale", "0"), r"length_scale: expected a positive length in m, got 0"),
        (("-o", "out.csv", "-c", "fitted.json", "-c", "copy.json"), r"copy.json: fitted.json calibrates 'arm_ft' too"),
    ],
)
def test_what_is_refused(arm: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """One line says what is wrong, and nothing is written."""
    Path("copy.json").write_bytes(Path("fitted.json").read_bytes())
    before = snapshot(arm)
    error = run("estimate", PARQUET, *words).error()
    assert re.search(message, error), error
    assert snapshot(arm) == before


def test_a_calibration_of_another_sensor_is_refused(arm: Path, run: Run) -> None:
    """The serial number decides."""
    edit(arm / PARQUET, 'serial = "SIM001"', 'serial = "SIM009"')
    assert "SIM009" in run("estimate", PARQUET, "-o", "out.csv", "-c", "fitted.json").error()


@pytest.mark.long
def test_the_temperature_of_each_instant_is_used(warm: Path, run: Run) -> None:
    """The exact calibration finds that nothing touches; where the file states no temperature it is refused."""
    words = ("estimate", PARQUET, "-o", "out.csv", "--format", "json")
    result = run(*words, "-c", "warm.json").result()
    free = [row["force_largest_N"] for row in result["contacts"] if row["contact"] == "arm_ft"]
    assert len(free) == 2
    assert max(free) < 1e-5
    assert max(row["force_largest_N"] for row in run(*words).result()["contacts"] if row["contact"] == "arm_ft") > 1.0
    edit(warm / PARQUET, TEMPERATURE, "")
    error = run(*words, "-c", "warm.json").error()
    assert error == (
        "error: parquet.toml: sensor 'arm_ft': expected the variable 'temperature', the experiment specifies none; "
        "add it as [[sensor.variable]]"
    )


def test_known_contacts_come_from_a_stream(arm: Path, run: Run) -> None:
    """A known contact whose stream holds no wrench is refused with the table's name."""
    add(arm / PARQUET, '\n[[contact]]\nframe = "hand"\ntype = "known"\nstream = "joints"\n')
    assert "contact[0]: stream 'joints' has no wrench" in run("estimate", PARQUET, "-o", "out.csv").error()
