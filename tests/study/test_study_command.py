# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study fits`: tables, figures and calibrations as files, and the choice on standard output."""

from __future__ import annotations

import csv
import json
import shutil
from contextlib import chdir
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import MissingExtraError, install_line
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.study import figures as study_figures
from forcetorque.study.study import SensorStudy
from tests.app.json_schema import faults
from tests.app.outcome import Outcome, Run
from tests.scenes.experiments import TWO, edit, snapshot
from tests.scenes.studies import CALIBRATION, FILES, SCENARIO, SERIAL, VALIDATION

FOLDER = Path("out") / f"arm_ft_{SERIAL}"
TABLES = (
    "table_5_2_squared_errors.csv",
    "table_5_3_matrix_differences.csv",
    "table_5_4_offsets.csv",
    "table_5_5_mean_forces_offset_first_second.csv",
    "table_5_6_mean_forces_offset_fitted.csv",
    "table_5_7_best_by_axis.csv",
    "candidates.csv",
)
CALIBRATIONS = (
    "best_offset_first_second.json",
    "best_by_axis_offset_first_second.json",
    "best_offset_fitted.json",
    "best_by_axis_offset_fitted.json",
)
FIGURES = (
    "figure_5_2_wrench_space.png",
    "figure_5_3_matrix_differences.png",
    "figure_5_4_differences_to_workbench.png",
    "figure_5_5_mean_forces_offset_first_second.png",
    "figure_5_5_mean_forces_offset_fitted.png",
    "figure_5_6_contact_forces.png",
    "figure_5_7_contact_moments.png",
    "figure_5_9_measured_and_reference.png",
)
PRINTED_LAMBDAS = (0, 1, 5, 10, 50, 100, 1000, 5000, 10000, 50000, 100000, 500000, 1000000)
LAMBDAS = tuple(f"lambda {6 * value} (table {value})" for value in PRINTED_LAMBDAS)
SPHERE = ("--sphere", "grid_cold", "--sphere", "grid_warm")
QUICK = ("--type", "OnTdTO", "--type", "OwTrTO", "--lambda", "0", "--lambda", "600")
PRINTED = 1e-12
"""Relative; numbers are written with all their digits."""


@pytest.fixture(autouse=True)
def no_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawing takes longer than all the rest; one test draws."""
    monkeypatch.setattr("forcetorque.study.study_folder.write_figures", _undrawn)


@pytest.fixture(scope="module")
def studied_days(recorded: Path, run: Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the recordings with a study of them in `out`, and what it printed; nobody changes it."""
    folder = Path(shutil.copytree(recorded, tmp_path_factory.mktemp("studied") / "days"))
    with pytest.MonkeyPatch.context() as patch, chdir(folder):
        patch.setattr("forcetorque.study.study_folder.write_figures", _undrawn)
        printed = run("study", "fits", *FILES, *SPHERE, "-o", "out", "--format", "json")
    (folder / "printed.json").write_text(printed.out, encoding="utf-8")
    return folder


@pytest.fixture
def studied(studied_days: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """What a study of the days printed of their sensor; its folder is the working folder."""
    monkeypatch.chdir(studied_days)
    (sensor,) = json.loads(Path("printed.json").read_text(encoding="utf-8"))["sensors"]
    return sensor


@pytest.fixture(scope="module")
def quick_days(recorded: Path, run: Run, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Outcome]:
    """Folder of the recordings with a study of few candidates in `new/er/out`, and what it said; nobody changes it."""
    folder = Path(shutil.copytree(recorded, tmp_path_factory.mktemp("quick") / "days"))
    with pytest.MonkeyPatch.context() as patch, chdir(folder):
        patch.setattr("forcetorque.study.study_folder.write_figures", _undrawn)
        return folder, run("study", "fits", *FILES, *QUICK, "-o", "new/er/out", "--format", "csv")


@pytest.fixture
def quick(quick_days: tuple[Path, Outcome], monkeypatch: pytest.MonkeyPatch) -> Outcome:
    """What a study of few candidates said; `new/er` is the working folder."""
    folder, outcome = quick_days
    monkeypatch.chdir(folder / "new/er")
    return outcome


def _undrawn(made: SensorStudy, folder: Path, progress: object) -> list[str]:
    return []


def _rows(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream, strict=True))


def _sensor(run: Run, *words: object) -> Any:
    (sensor,) = run("study", "fits", *FILES, *words, "-o", "out", "--format", "json").result()["sensors"]
    return sensor


@pytest.mark.long
def test_from_a_scenario_to_a_calibration_that_is_better(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Simulated, studied and evaluated: the best matrix beats the workbench's on the days that were not fitted."""
    monkeypatch.chdir(tmp_path)
    Path("scenario.toml").write_text(SCENARIO, encoding="utf-8")
    assert run("simulate", "scenario.toml", "-o", "simulated").code == 0
    files = [f"simulated/{file}" for file in FILES]
    result = run("study", "fits", *files, *SPHERE, "-o", "out", "--format", "json").result()
    assert faults(result, run("schema", "study").result()) == []
    assert result["schema"] == "forcetorque/study/2"
    assert result["lambda_convention"].startswith("thesis (5.4): mean squared residual norm + lambda |C - C_prior|^2")
    assert result["experiments"] == files
    (sensor,) = result["sensors"]
    assert (sensor["sensor"], sensor["serial"], sensor["folder"]) == ("arm_ft", SERIAL, str(FOLDER))
    assert [mode["offset"] for mode in sensor["modes"]] == ["first-second", "fitted"]
    assert sensor["modes"][0]["best"]["force_mean_N"] < 0.05 * sensor["workbench"]["force_mean_N"]
    best = FOLDER / "best_offset_first_second.json"
    verdicts = run("evaluate", files[-1], "-c", best, "--format", "json").result()["verdicts"]
    errors = {(row["calibration"], row["offset"]): row["force_error_mean_N"] for row in verdicts}
    assert errors[str(best), "judged-mean"] < 0.05 * errors["prior", "judged-mean"]


def test_the_files_are_those_that_are_listed(recorded: Path, studied_days: Path, studied: Any) -> None:
    """Seven tables and four calibrations, nothing else, all in one folder; the data are as they were."""
    assert studied["files"] == [*TABLES, *CALIBRATIONS]
    assert sorted(path.name for path in FOLDER.iterdir()) == sorted(studied["files"])
    assert [path.name for path in Path("out").iterdir()] == [FOLDER.name]
    after = {path: digest for path, digest in snapshot(studied_days).items() if not path.startswith("out")}
    del after["printed.json"]
    assert after == snapshot(recorded)


@pytest.mark.long
def test_figures_are_drawn(days: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures 5.2 to 5.7 and 5.9, as PNG, listed with the other files."""
    monkeypatch.setattr("forcetorque.study.study_folder.write_figures", study_figures.write_figures)
    sensor = _sensor(run, *SPHERE, *QUICK)
    assert sensor["files"] == [*TABLES, *CALIBRATIONS, *FIGURES]
    for name in FIGURES:
        assert (FOLDER / name).read_bytes().startswith(b"\x89PNG\r\n\x1a\n")


@pytest.mark.usefixtures("blank_pictures")
@pytest.mark.long
def test_figures_over_lambda_need_lambdas_and_a_prior(days: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """With lambda 0 alone, or without a matrix to differ from, the others are made; pixels are looked at above."""
    monkeypatch.setattr("forcetorque.study.study_folder.write_figures", study_figures.write_figures)
    for file in FILES:
        edit(days / file, f'prior = "matrix_{SERIAL}.txt"\n', "")
    sensor = _sensor(run, "--type", "OwTrTO")
    drawn = [name for name in FIGURES if "5_4" not in name and "5_5" not in name]
    assert sensor["files"] == [*TABLES, *CALIBRATIONS, *drawn]
    assert sensor["workbench"] is None
    assert {row["workbench"] for mode in sensor["modes"] for row in mode["by_axis"]} == {None}


@pytest.mark.long
def test_without_the_drawing_library_the_rest_is_made(days: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """A warning says what is missing."""

    def missing(made: SensorStudy, folder: Path, progress: object) -> list[str]:
        raise MissingExtraError(f"figures are drawn by matplotlib: {install_line('report')}")

    monkeypatch.setattr("forcetorque.study.study_folder.write_figures", missing)
    done = run("study", "fits", *FILES, *QUICK, "-o", "out", "--format", "json")
    (sensor,) = done.result()["sensors"]
    assert sensor["files"] == [*TABLES, *CALIBRATIONS]
    assert "WARNING: no figures: figures are drawn by matplotlib: pip install 'forcetorque[report]'" in done.log


@pytest.mark.parametrize("mode", ["first_second", "fitted"])
def test_tables_5_5_and_5_6_are_in_the_form_of_the_thesis(studied: Any, mode: str) -> None:
    """Rows of data set and type, a column for each of the thirteen lambdas as printed, and the workbench below."""
    number = {"first_second": "5_5", "fitted": "5_6"}[mode]
    *types, grid, move, both, workbench = _rows(FOLDER / f"table_{number}_mean_forces_offset_{mode}.csv")
    rows, generative = types, [grid, move, both]
    assert list(rows[0]) == ["data_set", "type", *LAMBDAS, "mean"]
    without = [name for name in ESTIMATION_TYPES if not name.startswith("S")]
    assert [(row["data_set"], row["type"]) for row in rows] == [
        *(("grid", name) for name in ESTIMATION_TYPES),
        *(("random", name) for name in without),
        *(("grid + random", name) for name in ESTIMATION_TYPES),
    ]
    assert [(row["data_set"], row["type"], row[LAMBDAS[0]]) for row in generative] == [
        (name, "generative", "") for name in ("grid", "random", "grid + random")
    ]
    assert (workbench["data_set"], workbench["type"], workbench[LAMBDAS[0]]) == ("workbench", "", "")
    assert float(workbench["mean"]) == pytest.approx(studied["workbench"]["force_mean_N"], rel=PRINTED)
    (found,) = [each["best"] for each in studied["modes"] if each["offset"].replace("-", "_") == mode]
    data_set, _, name = found["name"].partition(" lambda ")[0].rpartition(" ")
    (row,) = [row for row in (*rows, *generative) if (row["data_set"], row["type"]) == (data_set, name)]
    heading = "mean"
    if name != "generative":
        heading = f"lambda {found['lambda_counts2']:.0f} (table {found['table_lambda_counts2']:.0f})"
    assert float(row[heading]) == pytest.approx(found["force_mean_N"], rel=PRINTED)
    assert studied["candidates"] == len(rows) * 13 == 312


def test_the_other_tables_can_be_read(studied: Any) -> None:
    """5.2 and 5.4 by axis, 5.3 with the workbench first, 5.7 a row per axis, and every candidate."""
    keys = [(row["data_set"], row["type"]) for row in _rows(FOLDER / TABLES[0])]
    assert len(keys) == 9 + 6 + 9 + 3
    assert [key for key in keys if key[1] == "generative"] == keys[-3:]
    for name in (TABLES[0], TABLES[2]):
        rows = _rows(FOLDER / name)
        assert list(rows[0]) == ["data_set", "type", *WRENCH_COMPONENTS]
        assert [(row["data_set"], row["type"]) for row in rows] == keys
        assert all(float(row[component]) != 0.0 for row in rows for component in WRENCH_COMPONENTS)
    differences = _rows(FOLDER / TABLES[1])
    names = ["workbench", *ESTIMATION_TYPES, "generative"]
    assert list(differences[0]) == ["data_set", "type", *names]
    assert [row["type"] for row in differences if row["data_set"] == "grid"] == names
    assert all(float(row[row["type"]]) == 0.0 for row in differences)
    assert {row["SnTdTO"] for row in differences if row["data_set"] == "random"} == {""}
    by_axis = _rows(FOLDER / TABLES[5])
    assert [row["axis"] for row in by_axis] == list(WRENCH_COMPONENTS)
    for mode in studied["modes"]:
        for found, row in zip(mode["by_axis"], by_axis, strict=True):
            assert row[f"best, offset {mode['offset']}"] == found["name"]
            assert float(row[f"value, offset {mode['offset']}"]) == found["mean_absolute"]
            assert float(row["workbench"]) == found["workbench"]
    *candidates, workbench = _rows(FOLDER / TABLES[6])
    assert len(candidates) == studied["candidates"] + studied["generative"]
    generative, candidates = candidates[studied["candidates"] :], candidates[: studied["candidates"]]
    assert {(row["type"], row["lambda_counts2"], row["relative_lambda"]) for row in generative} == {
        ("generative", "", "")
    }
    assert all(abs(float(row["push_deviation_sd"])) < 1e-6 for row in generative)
    assert max(float(row["push_deviation_sd"]) for row in candidates) > 0.1
    assert (workbench["data_set"], workbench["table_lambda_counts2"]) == ("workbench", "")
    for row in candidates:
        assert float(row["lambda_counts2"]) == 6.0 * float(row["table_lambda_counts2"])


def test_the_result_agrees_with_the_candidates(studied: Any) -> None:
    """What is chosen has the smallest error of the table, and what other sessions promise is there for each."""
    *candidates, _ = _rows(FOLDER / "candidates.csv")
    for mode in studied["modes"]:
        suffix, best = mode["offset"].replace("-", "_"), mode["best"]
        smallest = min(float(row[f"force_mean_{suffix}"]) for row in candidates)
        assert best["force_mean_N"] == pytest.approx(smallest, rel=1e-6)
        assert 0.0 < best["force_mean_error_N"] < best["force_mean_N"]
        if best["lambda_counts2"] is not None:
            assert best["lambda_counts2"] == 6.0 * best["table_lambda_counts2"]
        for row in mode["by_axis"]:
            least = min(float(candidate[f"{row['axis']}_{suffix}"]) for candidate in candidates)
            assert row["mean_absolute"] == pytest.approx(least, rel=1e-6)
        assert [row["session"] for row in mode["across_sessions"]] == ["power-up 1", "power-up 2"]
        assert sum(row["samples"] for row in mode["across_sessions"]) == studied["validation_samples"]
        assert all(len(row["by_axis"]) == len(row["mean_absolute"]) == 6 for row in mode["across_sessions"])
    assert [(c["name"], c["intervals"]) for c in studied["combinations"]] == [
        ("grid", ["grid_cold", "grid_warm"]),
        ("random", ["move_cold", "move_warm"]),
        ("grid + random", ["grid_cold", "grid_warm", "move_cold", "move_warm"]),
    ]
    assert {c["channels"] for c in studied["combinations"]} == {6}


def test_the_calibrations_can_be_evaluated(days: Path, studied_days: Path, run: Run) -> None:
    """All four at once, on a judged day, with a warning; not on a day that they were fitted to."""
    shutil.copytree(studied_days / "out", days / "out")
    options = [word for name in CALIBRATIONS for word in ("-c", FOLDER / name)]
    done = run("evaluate", VALIDATION[0], *options, "--format", "json")
    judged = {row["calibration"] for row in done.result()["verdicts"]}
    assert judged >= {str(FOLDER / name) for name in CALIBRATIONS}
    assert sum("was chosen among others on 'day_1' too" in line for line in done.log) == 4
    for name in CALIBRATIONS:
        calibration = read_calibration(FOLDER / name)
        assert [interval.label for interval in calibration.selection.chosen_on] == ["day_1", "day_2"]
    edit(days / CALIBRATION[0], '"calibration"', '"validation"')
    assert "was fitted on the interval 'grid_cold'" in run("evaluate", CALIBRATION[0], *options[-2:]).error()
    assert run("export", FOLDER / CALIBRATIONS[1], "--to", "csv", "-o", "matrix.csv").code == 0


@pytest.mark.long
def test_types_and_lambdas_can_be_chosen(days: Path, run: Run) -> None:
    """In any order and each once: types as they are typed, lambdas sorted."""
    sensor = _sensor(run, "--type", "OwTrTO", "--type", "CnTdTO", "--lambda", "60", "--lambda", "1.5", "--lambda", "60")
    rows = [row for row in _rows(FOLDER / "candidates.csv")[:-1] if row["type"] != "generative"]
    assert [(row["type"], row["lambda_counts2"]) for row in rows[:4]] == [
        ("OwTrTO", "1.5"), ("OwTrTO", "60.0"), ("CnTdTO", "1.5"), ("CnTdTO", "60.0"),
    ]  # fmt: skip
    assert sensor["candidates"] == len(rows) == 12
    assert list(_rows(FOLDER / TABLES[3])[0]) == [
        "data_set", "type", "lambda 1.5 (table 0.25)", "lambda 60 (table 10)", "mean",
    ]  # fmt: skip


@pytest.mark.long
def test_data_sets_are_named_by_label_or_kind(days: Path, run: Run) -> None:
    """With blanks around the words, which may stand in names too."""
    sensor = _sensor(run, *QUICK, "--data-set", "all = grid, random", "--data-set", "warm ones=grid_warm,move_warm")
    assert [(c["name"], c["intervals"]) for c in sensor["combinations"]] == [
        ("all", ["grid_cold", "grid_warm", "move_cold", "move_warm"]),
        ("warm ones", ["grid_warm", "move_warm"]),
    ]
    assert sensor["candidates"] == 2 * 2 * 2


@pytest.mark.long
def test_sphere_types_need_a_sphere(days: Path, run: Run) -> None:
    """Without one they are left out with a warning for each; named for the run they are fitted where it is."""
    done = run("study", "fits", *FILES, "--lambda", "0", "-o", "out", "--format", "json")
    (sensor,) = done.result()["sensors"]
    assert len(sensor["left_out"]) == 9
    assert sensor["left_out"][0] == (
        "grid SnTdTO: sphere offset: name the data sets that draw the sphere, out of grid_cold, grid_warm; "
        "in an experiment file they are sphere_intervals of [calibration]"
    )
    assert [line for line in done.log if "left out" in line] == [
        f"WARNING: left out: {line}" for line in sensor["left_out"]
    ]
    (named,) = run(
        "study", "fits", *FILES, "--lambda", "0", "--sphere", "grid_warm", "-o", "named", "--format", "json"
    ).result()["sensors"]
    assert [line.partition(":")[0] for line in named["left_out"]] == [
        f"random {name}" for name in ("SnTdTO", "SwTdTO", "SwTrTO")
    ]
    assert named["candidates"] == sensor["candidates"] + 6


@pytest.mark.long
def test_every_sensor_has_a_folder_of_its_own(arm: Path, run: Run) -> None:
    """Its serial number cannot lead anywhere else; one alone can be asked for."""
    words = ("--lambda", "100", "--format", "json")
    result = run("study", "fits", TWO, *words, "-o", "out").result()
    assert [Path(sensor["folder"]).name for sensor in result["sensors"]] == ["arm_ft_SIM001", "tool_ft_SIM%2F002"]
    assert sorted(path.name for path in Path("out").iterdir()) == ["arm_ft_SIM001", "tool_ft_SIM%2F002"]
    (alone,) = run("study", "fits", TWO, *words, "--sensor", "tool_ft", "-o", "tool").result()["sensors"]
    assert alone["sensor"] == "tool_ft"
    assert alone["modes"] == result["sensors"][1]["modes"]
    assert alone["modes"][0]["across_sessions"] == []
    rows = run("study", "fits", TWO, "--lambda", "100", "--format", "csv", "-o", "rows").rows()
    assert [row["sensor"] for row in rows] == [name for name in ("arm_ft", "tool_ft") for _ in range(5)]


@pytest.mark.long
def test_csv_has_every_candidate(quick: Outcome) -> None:
    """The same rows as the file, with the name of the sensor, and the workbench last."""
    rows = quick.rows()
    assert rows == [{"sensor": "arm_ft", **row} for row in _rows(FOLDER / "candidates.csv")]
    assert [row["data_set"] for row in rows] == [
        *(n for n in ("grid", "random", "grid + random") for _ in range(4)),
        *("grid", "random", "grid + random"),
        "workbench",
    ]


@pytest.mark.long
def test_the_table_shows_the_choice_and_what_to_expect(days: Path, run: Run) -> None:
    """The best in both modes beside the workbench, axis by axis, and what is left on another session."""
    done = run("study", "fits", *FILES, *QUICK, "-o", "out", "--details")
    assert done.code == 0
    shown = " ".join(done.out.split())
    assert (
        "arm_ft (SIM001): 12 matrices of 3 data sets and 3 generative fits, "
        "evaluated on 599 samples that were not fitted"
    ) in shown
    for text in (
        "mean contact force where nothing touches",
        "best candidate of every axis",
        "loads that were not fitted: pushes of 50 N with levers up to 0.3 m",
        "what to expect on another session, offset first-second",
        "what to expect on another session, offset fitted",
        f"tables, figures and calibrations are in {FOLDER}",
    ):
        assert text in shown
    assert "workbench" in shown
    assert "grid + random" in shown
    assert done.out.count("power-up 1") == done.out.count("power-up 2") == 2


@pytest.mark.long
def test_the_table_says_which_data_leave_directions_still(days: Path, run: Run) -> None:
    """A short piece of the grid, about one joint, moves a part of the six; the reader learns how many."""
    edit(days / "grid_cold.toml", "end_s = 19.75", "end_s = 3.0")
    words = ("--type", "OnTdTO", "--lambda", "100", "--data-set", "piece=grid_cold", "--data-set", "all=grid,random")
    piece, every = _sensor(run, *words)["combinations"]
    assert piece["excited"] < every["excited"] == piece["channels"] == 6
    shown = run("study", "fits", *FILES, *words, "-o", "again", "--details").out
    assert f"piece: loads move only {piece['excited']} of 6 raw directions\n" in shown
    assert "all: loads move" not in shown


@pytest.mark.long
def test_the_log_tells_every_step(quick: Outcome) -> None:
    """Files, fits and judging, on standard error."""
    log = quick.log
    assert log[: len(FILES)] == [f"INFO: reading {file}" for file in FILES]
    assert log[len(FILES) : len(FILES) + 3] == [
        "INFO: studying arm_ft (SIM001)",
        "INFO: fitting 3 combinations of data sets by the generative model",
        "INFO: fitting 3 combinations of data sets, 2 types, 2 lambdas",
    ]
    assert "INFO: evaluating 16 matrices on 2 intervals, offset fitted" in log
    assert [line for line in log if line.startswith("INFO")][-1] == "INFO: drawing figures"


@pytest.mark.long
def test_folders_above_the_new_one_are_made(quick: Outcome) -> None:
    """And stay when all went well."""
    assert quick.code == 0
    assert (FOLDER / TABLES[0]).is_file()
    assert [path.name for path in Path().iterdir()] == ["out"]


@pytest.mark.long
def test_the_same_files_give_the_same_tables(days: Path, quick_days: tuple[Path, Outcome], run: Run) -> None:
    """Nothing is random: two runs write the same bytes, but for the time of the calibrations."""
    assert run("study", "fits", *FILES, *QUICK, "-o", "out").code == 0
    outputs = (quick_days[0] / "new/er/out", days / "out")
    one, two = map(snapshot, outputs)
    assert {path for path in one if path.endswith(".csv")} == {f"{FOLDER.name}/{name}" for name in TABLES}
    assert {path: digest for path, digest in one.items() if path.endswith(".csv")} == {
        path: digest for path, digest in two.items() if path.endswith(".csv")
    }
    for name in CALIBRATIONS:
        texts = [json.loads((output / FOLDER.name / name).read_text(encoding="utf-8")) for output in outputs]
        for text in texts:
            del text["provenance"]["created"]
        assert texts[0] == texts[1]


@pytest.mark.long
def test_a_lambda_is_what_calibrate_calls_so(days: Path, run: Run) -> None:
    """Typed for a study of one file or for a calibration of it, a lambda gives the same fit; a sixth does not."""
    assert (
        run("study", "fits", "move_cold.toml", *VALIDATION, "--type", "OnTdTO", "--lambda", "6e5", "-o", "out").code
        == 0
    )
    (row,) = [row for row in _rows(FOLDER / TABLES[2]) if row["type"] == "OnTdTO"]
    studied = np.array([float(row[component]) for component in WRENCH_COMPONENTS])
    offsets = {}
    for regularisation in ("6e5", "1e5"):
        words = ("--type", "OnTdTO", "--lambda", regularisation, "-o", f"{regularisation}.json")
        assert run("calibrate", "move_cold.toml", *words).code == 0
        offsets[regularisation] = read_calibration(Path(f"{regularisation}.json")).offset
    np.testing.assert_allclose(studied, offsets["6e5"], rtol=0.0, atol=1e-9 * np.abs(studied).max())
    assert np.abs(studied - offsets["1e5"]).max() > 1e-6 * np.abs(studied).max()
