# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate`: files, forms of the result, choice of sensors and of lambda."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from forcetorque.calibration.calibrate import calibrate_for_file, channel_names
from forcetorque.calibration.summary import calibration_answer
from forcetorque.experiment.calibration.artefact import read_calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.storage import read_recording
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.experiments import FT_LOG, MOUNTED, PARQUET, TWO, YARP, add, edit, edit_lines, snapshot
from tests.scenes.warm_experiments import EXACT, PER_DEGREE, TEMPERATURE, fixed_signal, put, with_variables

COMPONENTS = ("fx", "fy", "fz", "tx", "ty", "tz")


@pytest.mark.parametrize("form", [PARQUET, YARP])
def test_a_file_is_written_and_described(arm: Path, run: Run, form: str) -> None:
    """The file holds the calibration that the JSON on standard output shows, and nothing else is written."""
    before = snapshot(arm)
    result = run("calibrate", form, "--output", "made.json", "--format", "json").result()
    assert snapshot(arm).keys() - before.keys() == {"made.json"}
    assert (result["schema"], result["experiment"]) == ("forcetorque/calibrate/2", "small arm")
    (entry,) = result["calibrations"]
    assert entry["file"] == "made.json"
    assert entry["calibration"] == json.loads(Path("made.json").read_text(encoding="utf-8"))
    fitted = read_calibration("made.json")
    assert fitted.prior is not None
    new, prior = fitted.matrix, fitted.prior.matrix
    assert np.allclose(np.array(entry["secondary_matrix"]) @ prior, new, rtol=0.0, atol=1e-12 * np.abs(new).max())


def test_the_json_fits_the_printed_schemas(arm: Path, run: Run) -> None:
    """Result and file are what `forcetorque schema` promises; a damaged one is noticed."""
    result = run("calibrate", TWO, "-o", "made", "--format", "json", "--lambda", "held-out").result()
    schemas = {name: run("schema", name).result() for name in ("calibrate", "calibration")}
    assert faults(result, schemas["calibrate"]) == []
    files = sorted(Path("made").iterdir())
    assert len(files) == 2
    for file in files:
        content = json.loads(file.read_text(encoding="utf-8"))
        assert faults(content, schemas["calibration"]) == []
        assert faults({**content, "matrix": content["matrix"][:5]}, schemas["calibration"])
    assert faults({**result, "calibrations": "none"}, schemas["calibrate"])
    assert faults({key: value for key, value in result.items() if key != "experiment"}, schemas["calibrate"])


def test_the_answer_counts_many_intervals(arm: Path, run: Run) -> None:
    """A campaign of 200 recordings has an answer as short as that of one, which names its interval."""
    run("calibrate", PARQUET, "-o", "made.json", "--format", "json").result()
    fitted = read_calibration("made.json")
    interval = fitted.provenance.intervals[0]
    many = fitted.provenance.model_copy(update={"intervals": (interval,) * 200})
    campaign = fitted.model_copy(update={"provenance": many})
    one, several = (
        calibration_answer(calibration, None, "made.json", saved=True, doubtful=False).why[0]
        for calibration in (fitted, campaign)
    )
    assert f"{fitted.provenance.means} means of 1 s of '{interval.label}': residual" in one
    assert several == one.replace(f"of '{interval.label}':", "of 200 intervals:")
    commands = [
        calibration_answer(calibration, None, "made.json", saved=True, doubtful=False, has_validation=False).command
        for calibration in (fitted, campaign, fitted.model_copy(update={"prior": None}))
    ]
    assert "init --resume" in commands[0]
    assert commands[1:] == ["", ""], "nothing is divided of many intervals, or of raw counts without a prior"


def test_a_fit_to_fewer_means_than_unknowns_states_no_residual(arm: Path, run: Run) -> None:
    """Four means fit any sensor exactly; a residual of zero would be no measure of its noise."""
    run("calibrate", PARQUET, "-o", "made.json", "--format", "json").result()
    fitted = read_calibration("made.json")
    assert fitted.posterior is not None
    unknowns = fitted.posterior.mean.shape[1]
    words = [
        calibration_answer(
            fitted.model_copy(update={"provenance": fitted.provenance.model_copy(update={"means": count})}),
            None,
            "made.json",
            saved=True,
            doubtful=False,
        ).why[0]
        for count in (unknowns, unknowns + 1)
    ]
    assert "too few to leave a residual" in words[0]
    assert "residual 0.0" not in words[0]
    assert "(RMS of the norm)" in words[1]


def test_the_csv_holds_the_same_numbers(arm: Path, run: Run) -> None:
    """One row per component, equally long, with the matrix in full precision."""
    rows = run("calibrate", PARQUET, "-o", "made.json", "--format", "csv").rows()
    fitted = read_calibration("made.json")
    assert [row["component"] for row in rows] == list(COMPONENTS)
    assert [row["unit"] for row in rows] == ["N"] * 3 + ["N m"] * 3
    assert np.array_equal([[float(row[f"c{j}_per_count"]) for j in range(6)] for row in rows], fitted.matrix)
    assert np.array_equal([float(row["offset"]) for row in rows], fitted.offset)
    assert np.array_equal([float(row["residual_rms"]) for row in rows], fitted.residual_rms)
    assert {row["lambda_counts2"] for row in rows} == {""}
    given = run("calibrate", PARQUET, "-o", "other.json", "--lambda", "7", "--format", "csv").rows()
    assert {float(row["lambda_counts2"]) for row in given} == {7.0}
    assert {row["samples"] for row in rows} == {str(fitted.provenance.samples)}


def test_the_table_is_the_default(arm: Path, run: Run) -> None:
    """Without --format people get the answer, and below it the matrix per 1000 counts, what was learnt and the file."""
    made = run("calibrate", PARQUET, "-o", "made.json", "--details")
    assert made.code == 0
    assert made.out == run("calibrate", PARQUET, "-o", "made.json", "--details", "--format", "table").out
    answer, details = made.out.split("\n\n", maxsplit=1)
    assert run("calibrate", PARQUET, "-o", "made.json").out == f"{answer}\ndetails: --details\n"
    assert answer.endswith("\n  forcetorque evaluate parquet.toml -c made.json")
    first, *_, last = details.splitlines()
    fitted = read_calibration("made.json")
    assert first.startswith(
        f"arm_ft (SIM001): {fitted.provenance.samples} samples of fit, 0 left out; generative model, "
    )
    assert last == "written to made.json"
    found = re.search(r"^ fz, N +(.*)$", made.out, re.MULTILINE)
    assert found is not None
    shown = [float(word) for word in found[1].split()]
    np.testing.assert_allclose(shown[:6], 1000.0 * fitted.matrix[2], rtol=5.001e-4)  # half of the fourth digit
    assert "information gained: error that a unit load makes" in made.out
    assert run("calibrate", PARQUET, "-o", "other.json", "--type", "OnTdTO", "--details").out.count(" yes ") == 6


def test_channels_are_called_as_the_logs_call_them(arm: Path) -> None:
    """Counts that are recovered from a wrench have numbers, and so have those of logs that call them differently."""

    def logged(quantity: str, prior: str, *columns: str) -> SimpleNamespace:
        sensor = SimpleNamespace(quantity=quantity, prior_source=prior)
        return SimpleNamespace(
            sensor=sensor, stream=SimpleNamespace(signal=lambda of: SimpleNamespace(columns=columns))
        )

    gauges, others = logged("raw", "m.txt", "g1", "g2"), logged("raw", "m.txt", "a", "b")
    measured, recovered = logged("wrench", "identity", *COMPONENTS), logged("wrench", "m.txt", *COMPONENTS)
    for runs, names in (
        ([gauges, gauges], ("g1", "g2")),
        ([measured], COMPONENTS),
        ([recovered], ()),
        ([gauges, others], ()),
        ([gauges, recovered], ()),
    ):
        assert channel_names(cast(Any, SimpleNamespace(runs=runs))) == tuple(names)
    result = calibrate_for_file(SensorRun(load_experiment(arm / PARQUET), "arm_ft"), "a", code_version="1", created="")
    (entry,) = result.calibrations
    assert entry.channels == tuple(f"ch{k}" for k in range(6))
    named = result.model_copy(update={"calibrations": (entry.model_copy(update={"channels": tuple("ABCDEF")}),)})
    assert re.search(r"per 1000 counts +A +B +C +D +E +F ", named.text(200)) is not None


@pytest.mark.long
def test_brackets_in_names_are_shown(arm: Path, run: Run) -> None:
    """What the user called things is text, never markup."""
    edit(arm / PARQUET, 'label = "fit"', 'label = "run [bold] :smile: [/x]"')
    edit(arm / PARQUET, 'name = "small arm"', 'name = "[/red] arm"')
    assert "samples of run [bold] :smile: [/x], 0 left" in run("calibrate", PARQUET, "-o", "a.json", "--details").out
    assert "\n\n[/red] arm: arm_ft (SIM001)" in run("evaluate", PARQUET, "-c", "a.json", "--details").out


@pytest.mark.long
def test_a_folder_gets_one_file_per_sensor(arm: Path, run: Run) -> None:
    """The folder is made; names and serial numbers with a slash stay inside it."""
    result = run("calibrate", TWO, "-o", "deep/made", "--format", "json").result()
    assert sorted(path.name for path in Path("deep/made").iterdir()) == [
        "arm_ft_SIM001.json",
        "tool_ft_SIM%2F002.json",
    ]
    for entry in result["calibrations"]:
        assert read_calibration(entry["file"]).sensor.serial == entry["calibration"]["sensor"]["serial"]
    assert [entry["calibration"]["sensor"]["serial"] for entry in result["calibrations"]] == ["SIM001", "SIM/002"]


@pytest.mark.long
def test_sensors_are_chosen_by_name(arm: Path, run: Run) -> None:
    """--sensor picks, in the order given and each once; a file takes one sensor."""
    one = run("calibrate", TWO, "-o", "one.json", "--sensor", "tool_ft", "--format", "json").result()
    assert [entry["calibration"]["sensor"]["name"] for entry in one["calibrations"]] == ["tool_ft"]
    words = ("--sensor", "tool_ft", "--sensor", "arm_ft", "--sensor", "tool_ft")
    both = run("calibrate", TWO, "-o", "both", *words, "--format", "json").result()
    assert [entry["calibration"]["sensor"]["name"] for entry in both["calibrations"]] == ["tool_ft", "arm_ft"]
    before = snapshot(arm)
    error = run("calibrate", TWO, "-o", "two.json").error()
    assert error == "error: --output two.json: one file for 2 sensors; name a folder, or one sensor with --sensor"
    error = run("calibrate", TWO, "-o", "x.json", "--sensor", "tol_ft").error()
    assert error.startswith("error: experiment 'small arm' has no sensor 'tol_ft'; did you mean \"tool_ft\"?")
    assert snapshot(arm) == before


@pytest.mark.parametrize("words", [("--format", "json"), ("--format", "csv"), ("--details",)])
def test_a_sensor_that_cannot_be_fitted_leaves_the_others(arm: Path, run: Run, words: tuple[str, ...]) -> None:
    """The others are written and shown, the refused one is one line on standard error, and the exit code is 2."""
    alone = run("calibrate", TWO, "-o", "alone", "--sensor", "arm_ft", "--lambda", "0", *words)
    ended = run("calibrate", TWO, "-o", "whole", "--lambda", "0", *words)
    assert (alone.code, ended.code) == (0, 2)
    assert re.sub(r'("created": )".*"', r"\1", ended.out).replace("whole/", "alone/") == re.sub(
        r'("created": )".*"', r"\1", alone.out
    )
    assert [path.name for path in Path("whole").iterdir()] == ["arm_ft_SIM001.json"]
    *log, error = ended.err.splitlines()
    assert log == ended.log
    assert error.startswith(
        "error: two.toml: sensor 'tool_ft': lambda is 0 and the data do not excite 3 of 6 directions"
    )


def test_a_line_for_every_refused_sensor_and_no_file(arm: Path, run: Run) -> None:
    """Where no sensor can be fitted nothing is written and nothing is on standard output."""
    _stop(arm)
    before = snapshot(arm)
    ended = run("calibrate", TWO, "-o", "made", "--format", "json")
    assert (ended.code, ended.out) == (2, "")
    errors = [line for line in ended.err.splitlines() if line not in ended.log]
    assert [line.split(": the reference stays within ")[0] for line in errors] == [
        "error: two.toml: sensor 'arm_ft'",
        "error: two.toml: sensor 'tool_ft'",
    ]
    assert snapshot(arm) == before


def test_a_limb_that_stands_still_is_refused(arm: Path, run: Run) -> None:
    """The line of the file to change is named; its offset with the prior matrix is still to be had."""
    _stop(arm)
    error = run("calibrate", PARQUET, "-o", "a.json").error()
    assert error.startswith("error: parquet.toml: sensor 'arm_ft': the reference stays within ")
    assert error.endswith(
        "as of a limb that stands still; in the experiment file set start_s and end_s of every [[interval]] with "
        'use = "calibration" to where the limb moves, among arrays calibrate'
    )
    kept = run("calibrate", PARQUET, "-o", "a.json", "--lambda", "inf", "--format", "json").result()
    assert max(kept["calibrations"][0]["calibration"]["validity"]["expected_wrench_sd"]) < 1e-9


@pytest.mark.long
def test_a_tool_without_mass_is_refused(arm: Path, run: Run) -> None:
    """The model is named as what to mend; the sensor of the arm is fitted all the same."""
    place = "xyz='0.03 0 -0.05' rpy='0 0 0'/><mass value="
    edit(arm / "arm.urdf", f"{place}'0.5'", f"{place}'0'")
    ended = run("calibrate", TWO, "-o", "made", "--format", "json")
    assert (ended.code, [path.name for path in Path("made").iterdir()]) == (2, ["arm_ft_SIM001.json"])
    assert ended.err.splitlines()[-1].startswith(
        "error: two.toml: sensor 'tool_ft': the reference is 0 N and 0 N m, so the model has no mass beyond the sensor"
    )


def _stop(folder: Path) -> None:
    """Let the joints of the recording stay where they were first."""
    joints = read_recording(folder / "recording").stream("joints")
    stopped = {
        quantity: replace(
            signal, values=0.0 * signal.values + (signal.values[0] if quantity == "joint_position" else 0)
        )
        for quantity, signal in joints.signals.items()
    }
    put(folder, replace(joints, signals=stopped))


@pytest.mark.parametrize(
    ("in_file", "words", "expected", "rule"),
    [
        ("", (), "", "regressed on loads"),
        ("lambda_counts2 = 12.5", (), 12.5, "given"),
        ("lambda_counts2 = 12.5", ("--lambda", "1e3"), 1000.0, "given"),
        ("lambda_counts2 = 12.5", ("--lambda", "held-out"), None, "held-out"),
        ('lambda_counts2 = "held-out"', (), None, "held-out"),
        ("", ("--lambda", "0"), 0.0, "given"),
        ("", ("--lambda", "inf"), "infinite", "given"),
    ],
)
def test_lambda_comes_from_the_command_or_the_file(
    arm: Path, run: Run, in_file: str, words: tuple[str, ...], expected: float | str | None, rule: str
) -> None:
    """--lambda rules over the file, the file over the default, which has no lambda."""
    add(arm / PARQUET, f"\n[calibration]\n{in_file}\n")
    result = run("calibrate", PARQUET, "-o", "a.json", *words, "--format", "json").result()
    made = result["calibrations"][0]["calibration"]
    assert rule in made["selection"]["rule"]
    if expected == "":
        assert made["lambda_counts2"] is None
    else:
        assert made["lambda_counts2"] == expected if expected is not None else made["lambda_counts2"] > 0.0
    if expected == "infinite":
        assert made["matrix"] == made["prior"]["matrix"]


@pytest.mark.parametrize("value", ["-1", "nan", "much", "held_out", "", "-inf"])
def test_a_bad_lambda_is_refused(arm: Path, run: Run, value: str) -> None:
    """The option, what it takes and what came are named, and nothing is written."""
    before = snapshot(arm)
    error = run("calibrate", PARQUET, "-o", "a.json", "--lambda", value).error()
    assert error == f"error: --lambda: expected a number of at least 0 counts2 or `held-out`, got '{value}'"
    assert snapshot(arm) == before


@pytest.mark.long
def test_findings_of_the_log_are_warnings(arm: Path, run: Run) -> None:
    """What the readers found is said with those of the fit, on standard error only."""
    made = run("calibrate", YARP, "-o", "a.json", "--format", "json")
    assert made.err.splitlines() == made.log
    assert [line.partition(":")[0] for line in made.log] == ["INFO", "INFO", "WARNING", "WARNING"]
    assert made.log[2].startswith("WARNING: joints: the board does not estimate the velocity: all 1200 messages hold")
    made.result()


def test_a_refused_sensor_keeps_its_warnings(arm: Path, run: Run) -> None:
    """What is wrong with the fitted data is said where the fit is refused too: it may be the reason."""
    edit_lines(arm / FT_LOG, lambda lines: [*lines[:200], *lines[230:]])
    refused = run("calibrate", YARP, "-o", "a.json", "--type", "OwTrTO")
    assert "expected a linear variable" in refused.error()
    assert [line for line in refused.log if line.startswith("WARNING: interval 'fit': arm_ft gap at ")]


def test_an_earlier_file_is_replaced(arm: Path, run: Run) -> None:
    """Nothing of what the file held stays."""
    file = Path("fitted.json")
    file.write_text(file.read_text(encoding="utf-8") * 3, encoding="utf-8")
    assert run("calibrate", PARQUET, "-o", file, "--lambda", "17").code == 0
    assert read_calibration(file).lambda_counts2 == 17.0


@pytest.mark.long
def test_the_temperature_is_fitted_and_shown(warm: Path, run: Run) -> None:
    """File, JSON, CSV and table hold the exact coefficients with their unit and reference value."""
    words = ("calibrate", PARQUET, "-o", "made.json", "--lambda", "0", "--format")
    result = run(*words, "json").result()
    assert faults(result, run("schema", "calibrate").result()) == []
    fitted = read_calibration("made.json")
    (variable,) = fitted.variables
    assert np.abs(fitted.matrix - MOUNTED).max() < EXACT * np.abs(MOUNTED).max()
    assert np.abs(variable.coefficients - PER_DEGREE).max() < EXACT * np.abs(PER_DEGREE).max()
    assert result["calibrations"][0]["calibration"]["estimation_type"] == fitted.estimation_type == "OwTrTO"
    rows = run(*words, "csv").rows()
    assert [float(row["temperature_per_degC"]) for row in rows] == variable.coefficients.tolist()
    assert {float(row["temperature_reference_degC"]) for row in rows} == {variable.reference_value}
    shown = run(*words, "table", "--details").out
    assert "OwTrTO, lambda 0 counts2 (given)" in shown
    # the table is too wide for a pipe and lies on its side
    table = re.search(
        r"variable +temperature, degC\n.*\n from +([\d.]+)\n fitted range .*\n fx, N +(-0\.4000) ±", shown
    )
    assert table is not None
    assert abs(float(table[1]) - variable.reference_value) < 0.005001


def test_sensors_with_and_without_temperature_share_a_result(warm: Path, run: Run) -> None:
    """Columns that a sensor does not have are empty in the CSV, and each file names its own type."""
    with_variables(warm / TWO, TEMPERATURE)
    rows = run("calibrate", TWO, "-o", "made", "--lambda", "5", "--format", "csv").rows()
    assert [bool(row["temperature_per_degC"]) for row in rows] == [True] * 6 + [False] * 6
    kinds = {path.name: read_calibration(path).estimation_type for path in Path("made").iterdir()}
    assert kinds == {"arm_ft_SIM001.json": "OwTrTO", "tool_ft_SIM%2F002.json": "OnTdTO"}


@some_cases("name", ESTIMATION_TYPES, quick=3)
def test_the_type_comes_from_the_command_or_the_file(warm: Path, run: Run, name: str) -> None:
    """--type is the same fit as the file's type, and rules over it."""
    words = ("calibrate", PARQUET, "-o", "a.json", "--lambda", "6e4", "--format", "json")
    asked = run(*words, "--type", name).result()["calibrations"][0]["calibration"]
    add(warm / PARQUET, f'\n[calibration]\ntype = "{name}"\n')
    stated = run(*words).result()["calibrations"][0]["calibration"]
    assert asked["estimation_type"] == stated["estimation_type"] == name
    for key in ("matrix", "offset", "variables", "raw_offset_counts", "matrix_standard_error", "residual_rms"):
        assert asked[key] == stated[key], key
    other = "CnTdTO" if name != "CnTdTO" else "SwTdTO"
    ruled = run(*words, "--type", other).result()["calibrations"][0]["calibration"]
    assert ruled["estimation_type"] == other
    assert ruled["matrix"] != asked["matrix"] or {name, other} == {"OnTdTO", "CnTdTO"}


def _still(folder: Path) -> None:
    """Let the temperature of the recording stay at one value."""
    stream = read_recording(folder / "recording").stream("arm_ft")
    still = fixed_signal("temperature", np.full((len(stream), 1), 31.5))
    put(folder, replace(stream, signals={**stream.signals, "temperature": still}))


def test_what_a_type_cannot_do_is_one_line(warm: Path, run: Run) -> None:
    """File and sensor are named with what to do, and no file is written."""
    error = run("calibrate", PARQUET, "-o", "a.json", "--type", "OwTrT0").error()
    assert error.startswith("error: no estimation type is called 'OwTrT0'; did you mean \"OwTrTO\"? known: CnTdTO, ")
    with_variables(warm / TWO, TEMPERATURE)
    before = snapshot(warm)
    error = run("calibrate", TWO, "-o", "made", "--sensor", "tool_ft", "--lambda", "5", "--type", "OwTrTO").error()
    assert error == (
        "error: two.toml: sensor 'tool_ft': type OwTrTO: expected a linear variable such as temperature, "
        "the data have none"
    )
    assert snapshot(warm) == before
    _still(warm)
    before = snapshot(warm)
    error = run("calibrate", PARQUET, "-o", "a.json", "--type", "OwTrTO").error()
    assert error == (
        "error: parquet.toml: sensor 'arm_ft': variable 'temperature': its value is 31.5 degC throughout the fitted "
        "data, so its coefficients cannot be told from the offset; fit data at several values, or a type without "
        "variables"
    )
    assert snapshot(warm) == before
    assert run("calibrate", PARQUET, "-o", "a.json", "--type", "OnTdTO").code == 0  # the way out that it names


def test_a_type_by_name_and_by_options_is_refused(warm: Path, run: Run) -> None:
    """The file contradicts itself, whatever the command asks for."""
    add(warm / PARQUET, '\n[calibration]\ntype = "OwTrTO"\noffset = "one-shot"\n')
    for words in ((), ("--type", "OnTdTO")):
        error = run("calibrate", PARQUET, "-o", "a.json", *words).error()
        assert error.startswith(
            "error: parquet.toml: calibration: type stands for offset, with_variables and from_refer"
        )


def test_a_prior_of_another_sensor_is_refused(arm: Path, run: Run) -> None:
    """The factory's name of the file tells whose matrix it is."""
    Path("matrix_SIM001.txt").rename("matrix_SN026.txt")
    edit(arm / PARQUET, "matrix_SIM001.txt", "matrix_SN026.txt")
    error = run("calibrate", PARQUET, "-o", "a.json").error()
    assert error.startswith(
        "error: parquet.toml: sensor[0]: expected the prior matrix of the sensor 'SIM001', got that "
    )


@pytest.mark.long
def test_what_was_learnt_is_drawn_where_it_is_asked(arm: Path, run: Run) -> None:
    """A PNG beside the calibration, named in the result; without the option there is none."""
    before = snapshot(arm)
    ended = run("calibrate", PARQUET, "-o", "a.json", "--figure", "learnt.png", "--format", "json")
    assert ended.result()["figure"] == "learnt.png"
    assert Path("learnt.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert snapshot(arm).keys() - before.keys() == {"a.json", "learnt.png"}
    assert run("calibrate", PARQUET, "-o", "a.json", "--format", "json").result()["figure"] is None


def test_a_type_of_the_thesis_has_nothing_to_draw(arm: Path, run: Run) -> None:
    """The calibration is written all the same; the reason is one line, and the exit code says that one was given."""
    ended = run("calibrate", PARQUET, "-o", "a.json", "--type", "OnTdTO", "--figure", "learnt.png", "--details")
    assert ended.code == 2
    assert "error: --figure learnt.png: expected a generative fit towards a prior" in ended.err
    assert Path("a.json").exists()
    assert not Path("learnt.png").exists()


def test_a_figure_that_cannot_be_written_is_refused_before_the_fit(arm: Path, run: Run) -> None:
    """Another ending: nothing is read, fitted or written."""
    before = snapshot(arm)
    error = run("calibrate", PARQUET, "-o", "a.json", "--figure", "learnt.bmp").error()
    assert "--figure learnt.bmp: expected a name that ends in .png" in error
    assert snapshot(arm) == before
