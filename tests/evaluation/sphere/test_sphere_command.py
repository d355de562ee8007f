# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study sphere`: its numbers against the library's, its forms, and what it refuses."""

from __future__ import annotations

import csv
import io
import json
import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.evaluation.sphere import sphere
from forcetorque.evaluation.sphere.cloud import StaticForceError
from forcetorque.evaluation.sphere.ellipsoid import RULE, TOLERANCE
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.table import Table
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO, edit, snapshot

EXAMPLES = Path(__file__).parents[3] / "examples"
GRAVITY = 9.80665


def _row(result: Any, candidate: str) -> Any:
    (row,) = [row for row in result["rows"] if row["calibration"] == candidate]
    return row


def test_the_result_is_what_the_library_finds(arm: Path, run: Run) -> None:
    """Masses, errors, index, intervals and verdicts, with the model and without; it fits its own schema."""
    ended = run("study", "sphere", PARQUET, "-c", "fitted.json", "--interval", "judge", "--format", "json")
    result = ended.result()
    assert faults(result, run("schema", "sphere").result()) == []
    assert (result["schema"], result["experiment"]) == ("forcetorque/sphere/2", "small arm")
    assert (result["rule"], result["tolerance"], result["gravity_m_s2"]) == (RULE, TOLERANCE, GRAVITY)
    experiment = load_experiment(PARQUET)
    prior = spheres(SensorRun(experiment, "arm_ft"), {}, ["judge"])
    (sphere,) = prior.analyses
    row, analysis = _row(result, "prior"), sphere.analysis
    assert (row["sensor"], row["serial"], row["samples"]) == ("arm_ft", "SIM001", analysis.samples)
    assert row["model_mass_kg"] == analysis.mass
    assert (row["form"], row["intervals"], row["no_model"]) == (analysis.form, ["judge"], None)
    captions = [block.caption for block in prior.blocks() if isinstance(block, Table)]
    assert captions[0] == f"small arm: arm_ft (SIM001), {analysis.samples} samples of judge"
    assert analysis.mapped is not None
    for name, fit in (("with_model", analysis.mapped.fit), ("without_model", analysis.free)):
        assert fit.ellipsoid is not None
        shown = row[name]
        assert (shown["identifiable"], shown["why"]) == (fit.identifiable, list(fit.why))
        np.testing.assert_allclose(shown["mass_kg"], fit.ellipsoid.axis_intersections / GRAVITY)
        np.testing.assert_allclose(shown["principal_mass_kg"], fit.ellipsoid.principal_radii / GRAVITY)
        np.testing.assert_allclose(shown["half_width_mass_kg"], fit.ellipsoid.half_widths / GRAVITY)
        np.testing.assert_allclose(shown["error_N"], fit.ellipsoid.axis_intersections - row["model_mass_kg"] * GRAVITY)
        assert shown["index_kg"] == pytest.approx(np.std(shown["mass_kg"], ddof=1), rel=1e-12)
        np.testing.assert_allclose(shown["centre_N"], fit.ellipsoid.centre)
    assert analysis.moment is not None
    np.testing.assert_allclose(row["moment_with_model"]["error_Nm"], analysis.moment.error_Nm)


def test_calibration_is_seen_to_mend(arm: Path, run: Run) -> None:
    """The three kinds of length have names of their own; what is unbounded is null."""
    result = run("study", "sphere", PARQUET, "-c", "fitted.json", "--interval", "judge", "--format", "json").result()
    prior, new = _row(result, "prior"), _row(result, "fitted.json")
    assert new["with_model"]["index_kg"] < 0.1 * prior["with_model"]["index_kg"]
    assert prior["without_model"]["identifiable"] is False
    assert prior["without_model"]["index_high_kg"] is None
    assert prior["without_model"]["mass_high_kg"] == [None] * 3
    assert any("the force has no one size" in reason for reason in prior["without_model"]["why"])


@pytest.mark.long
def test_what_was_fitted_is_warned_of(arm: Path, run: Run) -> None:
    """All intervals are taken if none is named, and those that flatter are named."""
    ended = run("study", "sphere", PARQUET, "-c", "fitted.json", "--format", "json")
    assert _row(ended.result(), "fitted.json")["fitted_on"] == ["fit"]
    assert "WARNING: fitted.json was fitted on 'fit', so the verdict on it flatters" in ended.log
    quiet = run("study", "sphere", PARQUET, "-c", "fitted.json", "--interval", "judge", "--format", "json")
    assert not any("flatters" in line for line in quiet.log)


@pytest.mark.long
def test_a_line_per_sensor_and_candidate_as_csv(arm: Path, run: Run) -> None:
    """Triples become columns x, y and z, or 1 to 3 where they are no axes; reasons stay words."""
    words = ("study", "sphere", TWO, "-c", "fitted.json", "--interval", "judge", "--format")
    rows, result = run(*words, "csv").rows(), run(*words, "json").result()
    assert [(row["sensor"], row["calibration"]) for row in rows] == [
        ("arm_ft", "prior"),
        ("arm_ft", "fitted.json"),
        ("tool_ft", "prior"),
    ]
    shown = result["rows"][0]["with_model"]
    for end, mass, radius in zip("xyz", shown["mass_kg"], shown["principal_radius_N"], strict=True):
        assert float(rows[0][f"with_model_mass_{end}_kg"]) == mass
        assert float(rows[0][f"with_model_principal_radius_{'xyz'.index(end) + 1}_N"]) == radius
    assert rows[0]["without_model_mass_high_x_kg"] == ""
    assert rows[0]["without_model_why"] == "; ".join(result["rows"][0]["without_model"]["why"])
    assert rows[0]["intervals"] == "judge"


def test_the_table_has_both_columns_of_the_thesis(arm: Path, run: Run) -> None:
    """Errors of three axes and two indices per candidate, and a reason wherever something is not known."""
    out = run("study", "sphere", PARQUET, "-c", "fitted.json", "--interval", "judge", "--details").out
    lines = [line.split() for line in out.splitlines()]
    (prior,) = [line for line in lines if line[:3] == ["prior", "with", "model"] and line[-1] == "yes"]
    assert len(prior) == 3 + 3 + 3 + 1 + 1
    masses, errors, index = np.array(prior[3:6], float), np.array(prior[6:9], float), float(prior[9])
    np.testing.assert_allclose(errors, (masses - 4.0) * GRAVITY, atol=0.01)
    assert index == pytest.approx(np.std(masses, ddof=1), abs=0.001)
    assert "the model has 4.000 kg on the sensor; gravity 9.80665 m/s2" in out
    assert "prior, without: a cap" in out
    assert "what the recording allows" in out
    assert "to any" in out


def test_sensors_are_chosen(arm: Path, run: Run) -> None:
    """Who names one gets one, once; a calibration of another one is then read for nothing, which is refused."""
    named = run("study", "sphere", TWO, "--sensor", "tool_ft", "--sensor", "tool_ft", "--format", "json").result()
    assert [row["sensor"] for row in named["rows"]] == ["tool_ft"]
    refused = run("study", "sphere", TWO, "--sensor", "tool_ft", "-c", "fitted.json").error()
    assert "fitted.json: calibrates 'arm_ft', which --sensor leaves out" in refused


@pytest.mark.long
def test_a_figure_is_written_where_it_is_asked(arm: Path, run: Run) -> None:
    """A PNG, named in the result; everything else stays as it is."""
    before = snapshot(arm)
    result = run("study", "sphere", PARQUET, "--figure", "spheres.png", "--format", "json").result()
    assert result["figure"] == "spheres.png"
    assert (arm / "spheres.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert snapshot(arm).keys() - before.keys() == {"spheres.png"}
    assert "drawn to spheres.png" in run("study", "sphere", PARQUET, "--figure", "spheres.png", "--details").out


def test_without_matplotlib_only_figures_are_refused(arm: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """The numbers need nothing more; the error says what to install, and nothing is written."""
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        monkeypatch.setitem(sys.modules, name, None)
    before = snapshot(arm)
    refused = run("study", "sphere", PARQUET, "--figure", "spheres.png")
    assert "pip install 'forcetorque[report]'" in refused.error()
    assert refused.log == []
    assert snapshot(arm) == before
    assert run("study", "sphere", PARQUET).code == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--interval", "jugde"), "has the label or kind 'jugde'; did you mean \"judge\"?"),
        (("--sensor", "arm_tf"), "has no sensor 'arm_tf'; did you mean \"arm_ft\"?"),
        (("--figure", "spheres.bmp"), "--figure spheres.bmp: expected a name that ends in .png"),
        (("--figure", "nowhere/spheres.png"), "expected an existing folder to write to"),
        (("-c", "nothing.json"), "nothing.json"),
    ],
)
def test_wrong_words_are_refused_in_one_line(arm: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """The option or the name is told, and nothing is written."""
    before = snapshot(arm)
    assert message in run("study", "sphere", PARQUET, *words).error()
    assert snapshot(arm) == before


@pytest.mark.parametrize("figure", ["spheres.bmp", "nowhere/spheres.png"])
def test_a_figure_is_refused_before_anything_is_read(arm: Path, run: Run, figure: str) -> None:
    """No minutes are lost to a folder that is not there."""
    refused = run("study", "sphere", PARQUET, "--figure", figure)
    assert f"--figure {figure}: expected" in refused.error()
    assert refused.log == []


def test_two_calibrations_of_one_sensor_are_compared(arm: Path, run: Run) -> None:
    """Unlike where one is to be used, here several are welcome."""
    shutil.copy("fitted.json", "copy.json")
    words = (
        "study",
        "sphere",
        PARQUET,
        "-c",
        "fitted.json",
        "-c",
        "copy.json",
        "--interval",
        "judge",
        "--format",
        "json",
    )
    result = run(*words).result()
    assert [row["calibration"] for row in result["rows"]] == ["prior", "fitted.json", "copy.json"]
    first, second = (_row(result, name)["with_model"] for name in ("fitted.json", "copy.json"))
    assert first == second


@pytest.mark.long
def test_files_of_one_name_are_told_apart(arm: Path, run: Run) -> None:
    """Calibrations of one name in two folders have the folders before them, in every table and line."""
    for folder in ("old", "new"):
        (arm / folder).mkdir()
        shutil.copy("fitted.json", arm / folder / "leg.json")
    words = ("-c", "old/leg.json", "-c", "new/leg.json", "--interval", "judge", "--details")
    _, out = run("study", "sphere", PARQUET, *words).out.split("\n\n", maxsplit=1)
    assert out.count("old/leg.json") == out.count("new/leg.json") > 4
    assert out.count("leg.json") == 2 * out.count("old/leg.json")


def test_counts_are_refused_with_their_sensor(arm: Path, run: Run) -> None:
    """The message names file, sensor and candidate, what was expected and what to do."""
    edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"', 'prior = "identity"')
    error = run("study", "sphere", PARQUET).error()
    assert "parquet.toml: sensor 'arm_ft', prior: force: expected N, got" in error
    assert "can only be counts; multiply them by the sensor's matrix" in error


@pytest.mark.long
def test_a_sensor_that_fails_is_named_and_does_not_take_the_others_with_it(arm: Path, run: Run) -> None:
    """One line in every form and on standard error; what is shown of the others is what they give alone."""
    alone = run("study", "sphere", TWO, "--sensor", "arm_ft", "--format", "json").result()
    assert alone["failures"] == []
    edit(arm / TWO, 'prior = "matrix_SIM002.txt"', 'prior = "identity"')
    ended = run("study", "sphere", TWO, "--figure", "spheres.png", "--format", "json")
    assert ended.code == 1
    result = json.loads(ended.out)
    assert faults(result, run("schema", "sphere").result()) == []
    assert result["rows"] == alone["rows"]
    (failure,) = result["failures"]
    assert (failure["file"], failure["sensor"]) == (TWO, "tool_ft")
    assert failure["message"].startswith(f"{TWO}: sensor 'tool_ft', prior: force: expected N, got whole numbers")
    assert f"WARNING: failed: {failure['message']}" in ended.log
    assert (arm / "spheres.png").is_file()
    shown, rows = run("study", "sphere", TWO, "--details"), run("study", "sphere", TWO, "--format", "csv")
    assert (shown.code, rows.code) == (1, 1)
    assert f"failed: {failure['message']}" in " ".join(shown.out.split())
    assert [row["sensor"] for row in csv.DictReader(io.StringIO(rows.out))] == ["arm_ft"]


def test_a_sensor_that_nothing_turned_is_no_failure_unless_it_was_named(
    arm: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of all sensors of a file some stand still; the one that is asked for must not."""
    analysed = sphere.spheres

    def still_tool(one: SensorRun, *arguments: Any) -> Any:
        if one.sensor.name == "tool_ft":
            raise StaticForceError("force: expected a cloud, got 99 times one point")
        return analysed(one, *arguments)

    monkeypatch.setattr(sphere, "spheres", still_tool)
    shown = run("study", "sphere", TWO)
    assert shown.code == 0
    assert "NOT MOVED" in shown.out
    assert not any("failed" in line for line in shown.log)
    named = run("study", "sphere", TWO, "--sensor", "arm_ft", "--sensor", "tool_ft")
    assert named.code == 1
    assert "FAILED" in named.out


def test_where_every_sensor_fails_there_is_no_result(arm: Path, run: Run) -> None:
    """Both are named in the one line of the error."""
    edit(arm / TWO, 'prior = "matrix_SIM001.txt"', 'prior = "identity"')
    edit(arm / TWO, 'prior = "matrix_SIM002.txt"', 'prior = "identity"')
    before = snapshot(arm)
    error = run("study", "sphere", TWO, "--figure", "spheres.png", "--format", "json").error()
    assert "two.toml: sensor 'arm_ft', prior: force: expected N" in error
    assert "two.toml: sensor 'tool_ft', prior: force: expected N" in error
    assert snapshot(arm) == before


@pytest.mark.long
@pytest.mark.real_data
def test_the_yoga_example(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """As the example says: neither one mass of the arms nor three are known, and the leg moves in a plane."""
    path = tmp_path / "yoga.toml"
    text = (EXAMPLES / "12_icub_yoga_sphere.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    result = run("study", "sphere", path, "--figure", tmp_path / "yoga.png", "--format", "json").result()
    assert [row["form"] for row in result["rows"]] == ["cap", "cap", "plane"]
    for row in result["rows"]:
        assert row["without_model"]["identifiable"] is False
        assert row["one_radius"]["identifiable"] is False
        assert row["one_radius"]["mass_low_kg"] < row["model_mass_kg"]
        assert row["directions_covered"] < 0.12
    assert [row["with_model"] is None for row in result["rows"]] == [True, True, False]
    assert "no stream holds the position of torso_pitch" in result["rows"][0]["no_model"]
