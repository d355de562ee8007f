# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study compare`: one table of many files, and that no file takes the others with it."""

from __future__ import annotations

import csv
import io
import json
import shutil
import sys
from contextlib import chdir
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.evaluation.sphere.ellipsoid import RULE, TOLERANCE
from tests.app.json_schema import faults
from tests.app.outcome import Outcome, Run
from tests.scenes.axia import write_axia
from tests.scenes.experiments import PARQUET, TWO, add, edit, snapshot

EXAMPLES = Path(__file__).parents[3] / "examples"
FIRST, SECOND, LOOSE = "first.toml", "second.toml", "loose.toml"


@pytest.fixture
def trials(arm: Path) -> Path:
    """Folder with the trials, to damage; it is the working folder."""
    _write_trials(arm)
    return arm


def _write_trials(arm: Path) -> None:
    """Two trials of the arm's sensor with tight screws, from two spans of a recording, and one with loose ones."""
    text = (arm / PARQUET).read_text(encoding="utf-8")
    head, _, judge = text.split("[[interval]]\n")
    for name, condition, interval in (
        (FIRST, "2 N m", judge.replace("14.5", "0.5")),
        (SECOND, "2 N m", judge),
        (LOOSE, "0.5 N m", judge.replace("23.5", "23.2")),
    ):
        (arm / name).write_text(f'{head}[[interval]]\n{interval}\n[trial]\ncondition = "{condition}"\n')


@pytest.fixture(scope="module")
def compared(intact: Path, run: Run, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """`compare` of the three trials as they are, with further words; the same words are run but once."""
    folder = Path(shutil.copytree(intact, tmp_path_factory.mktemp("compared") / "arm"))
    _write_trials(folder)

    @cache
    def compare(*words: str) -> Outcome:
        with chdir(folder):
            return run("study", "compare", FIRST, SECOND, LOOSE, *words)

    return compare


def _ended_with_failures(ended: Outcome) -> Any:
    assert ended.code == 1, ended.err
    return json.loads(ended.out)


def _group(result: Any, condition: str | None, candidate: str = "prior") -> Any:
    (group,) = [
        group for group in result["groups"] if (group["condition"], group["calibration"]) == (condition, candidate)
    ]
    return group


@pytest.mark.long
def test_every_trial_is_what_sphere_finds(trials: Path, compared: Run, run: Run) -> None:
    """Row by row the numbers of `sphere`, means of them, and the result fits its own schema."""
    result = compared("-c", "fitted.json", "--format", "json").result()
    assert faults(result, run("schema", "compare").result()) == []
    assert (result["schema"], result["rule"], result["tolerance"]) == ("forcetorque/compare/2", RULE, TOLERANCE)
    assert result["failures"] == []
    seen = 0
    for name in (FIRST, SECOND, LOOSE):
        for row in run("study", "sphere", name, "-c", "fitted.json", "--format", "json").result()["rows"]:
            (mine,) = [
                trial
                for trial in result["trials"]
                if (trial["file"], trial["calibration"]) == (name, row["calibration"])
            ]
            for key in ("with_model", "without_model", "samples", "form", "model_mass_kg", "fitted_on"):
                assert mine[key] == row[key]
            seen += 1
    assert seen == 6
    tight, loose = _group(result, "2 N m"), _group(result, "0.5 N m")
    indices = [
        trial["with_model"]["index_kg"]
        for trial in result["trials"]
        if (trial["condition"], trial["calibration"]) == ("2 N m", "prior")
    ]
    assert len(indices) == 2
    by = tight["with_model"]
    assert by["mean_index_kg"] == pytest.approx(np.mean(indices), rel=1e-14)
    assert min(indices) < by["pooled"]["index_kg"] < max(indices)
    assert by["pooled"]["centre_N"] is None
    assert len(by["pooled_centre_N"]) == 2
    assert by["drift"]["index_kg"] == pytest.approx(indices[1] - indices[0], rel=1e-9)
    assert (loose["trials"], loose["with_model"]["pooled"], loose["with_model"]["drift"]) == (1, None, None)


@pytest.mark.long
def test_ranks_are_of_intervals(compared: Run) -> None:
    """The calibrated sensor comes before its prior; what overlaps is in no order, and what is not known has no rank."""
    result = compared("-c", "fitted.json", "--format", "json").result()
    ends = []
    for group in result["groups"]:
        by = group["with_model"]
        (only, *_) = [row for row in result["trials"] if all(row[k] == group[k] for k in ("condition", "calibration"))]
        fit = by["pooled"] or only["with_model"]
        ends.append((fit["index_low_kg"], fit["index_high_kg"], by["rank"], group["calibration"]))
    assert len(ends) == 4
    for low, high, rank, candidate in ends:
        below = [other for other in ends if other[1] < low]
        assert rank == 1 + len(below)
        overlapping = [other for other in ends if other[0] <= high and low <= other[1]]
        assert {other[3] for other in overlapping} == {candidate}
    assert sorted(rank for _, _, rank, _ in ends) == [1, 1, 3, 3]
    out = compared("-c", "fitted.json", "--details").out
    assert "what overlaps is in no order" in out
    for group in result["groups"]:
        free = group["without_model"]
        if free["rank"] is not None:
            assert free["pooled"] is None or free["pooled"]["identifiable"]
    unknown = _group(result, "2 N m")["without_model"]
    assert (unknown["known"], unknown["mean_index_kg"], unknown["rank"]) == (0, None, None)
    assert unknown["drift"] is None or unknown["drift"]["exceeds"] is None


@pytest.mark.long
def test_the_table_has_the_forms_of_the_thesis(compared: Run) -> None:
    """Errors and two indices for each trial; trials down, conditions across, and the mean apart from the pooled fit."""
    ended = compared("--details")
    assert ended.code == 0
    lines = [line.split() for line in ended.out.splitlines()]
    result = compared("--format", "json").result()
    first = result["trials"][0]
    errors = [f"{error:.4f}" for error in first["with_model"]["error_N"]]
    index, free = first["with_model"]["index_kg"], first["without_model"]["index_kg"]
    assert ["arm_ft", "SIM001", "2", "N", "m", "1", *errors, f"{index:.4f}", f"({free:.4f})"] in lines
    tight, loose = (_group(result, condition)["with_model"] for condition in ("2 N m", "0.5 N m"))
    assert ["mean", "of", "trials", f"{tight['mean_index_kg']:.4f}", f"{loose['mean_index_kg']:.4f}"] in lines
    assert ["pooled", "fit", f"{tight['pooled']['index_kg']:.4f}", "-"] in lines
    assert "drift: last trial minus first" in ended.out
    assert "not identifiable" in ended.out
    assert "in brackets: not identifiable, neither averaged nor ranked" in ended.out


def test_a_condition_is_shown_as_it_was_written(trials: Path, run: Run) -> None:
    """A stroke in it makes no path of it: halves and three halves of a turn stay apart."""
    for name, condition in ((FIRST, "1/2 turn"), (LOOSE, "3/2 turn")):
        path = trials / name
        path.write_text(path.read_text(encoding="utf-8").split("[trial]")[0] + f'[trial]\ncondition = "{condition}"\n')
    out = run("study", "compare", FIRST, LOOSE, "--details").out
    every = out.split("every trial")[1].split("index with the model")[0]
    assert "1/2 turn" in every
    assert "3/2 turn" in every


@pytest.mark.long
def test_files_of_one_name_are_told_apart(trials: Path, run: Run) -> None:
    """Calibrations of one name in two folders have the folders before them, in every table."""
    for folder in ("old", "new"):
        (trials / folder).mkdir()
        shutil.copy(trials / "fitted.json", trials / folder / "leg.json")
    out = run("study", "compare", FIRST, SECOND, "-c", "old/leg.json", "-c", "new/leg.json", "--details").out
    assert out.count("old/leg.json") == out.count("new/leg.json") > 4
    assert out.count("leg.json") == 2 * out.count("old/leg.json")


@pytest.mark.long
def test_the_order_of_files_is_that_of_the_trials(trials: Path, run: Run) -> None:
    """Turned round, only the drift changes, by its sign; numbers in the files rule over their order."""
    there, back = (
        run("study", "compare", *names, "--format", "json").result() for names in ((FIRST, SECOND), (SECOND, FIRST))
    )
    one, other = (_group(result, "2 N m")["with_model"] for result in (there, back))
    assert one["pooled"] == other["pooled"]
    assert one["mean_index_kg"] == pytest.approx(other["mean_index_kg"], rel=1e-14)
    assert one["drift"]["index_kg"] == -other["drift"]["index_kg"] != 0.0
    assert one["pooled_centre_N"] == other["pooled_centre_N"][::-1]
    for name, number in ((FIRST, 2), (SECOND, 1)):
        add(trials / name, f"number = {number}\n")
    numbered = run("study", "compare", FIRST, SECOND, "--format", "json").result()
    assert [trial["file"] for trial in numbered["trials"]] == [SECOND, FIRST]
    edit(trials / SECOND, "number = 1\n", "")
    half = run("study", "compare", FIRST, SECOND, "--format", "json")
    assert [trial["file"] for trial in half.result()["trials"]] == [FIRST, SECOND]
    assert any("[trial] number is missing or double" in line for line in half.log)


@pytest.mark.long
def test_intervals_may_be_trials(arm: Path, run: Run) -> None:
    """A file with two intervals then has two trials, which have no condition."""
    result = run("study", "compare", PARQUET, "--trials", "intervals", "--format", "json").result()
    assert [(trial["trial"], trial["intervals"]) for trial in result["trials"]] == [(1, ["fit"]), (2, ["judge"])]
    assert _group(result, None)["trials"] == 2
    out = run("study", "compare", PARQUET, "--trials", "intervals", "--details").out
    assert "no condition" in out


@pytest.mark.long
def test_a_bad_file_does_not_cost_the_table(trials: Path, run: Run) -> None:
    """It is told on standard error and in the result, the others are there, and the exit code is 1."""
    edit(trials / SECOND, 'path = "recording"', 'path = "nowhere"')
    words = ("study", "compare", FIRST, SECOND, LOOSE)
    ended = run(*words, "--format", "json")
    result = _ended_with_failures(ended)
    assert faults(result, run("schema", "compare").result()) == []
    assert [trial["file"] for trial in result["trials"]] == [FIRST, LOOSE]
    (failure,) = result["failures"]
    assert (failure["file"], failure["sensor"]) == (SECOND, None)
    assert "nowhere" in failure["message"]
    assert any(line.startswith("WARNING: failed: second.toml: ") for line in ended.log)
    assert any(line == "INFO: reading loose.toml (3 of 3)" for line in ended.log)
    shown = run(*words, "--details")
    assert shown.code == 1
    assert f"failed: {failure['message']}" in " ".join(shown.out.split())
    rows = list(csv.DictReader(io.StringIO(run(*words, "--format", "csv").out)))
    assert [row["file"] for row in rows if row["row"] == "failure"] == [SECOND]
    assert sum(row["row"] == "trial" for row in rows) == 4


def test_all_bad_files_still_give_a_result(arm: Path, run: Run) -> None:
    """Nothing but failures, in every form."""
    edit(arm / PARQUET, 'path = "recording"', 'path = "nowhere"')
    result = _ended_with_failures(run("study", "compare", PARQUET, "--figure", "none.png", "--format", "json"))
    assert (result["trials"], result["groups"], len(result["failures"])) == ([], [], 1)
    assert result["figure"] is None
    assert not (arm / "none.png").exists()
    assert run("study", "compare", PARQUET).code == 1
    assert run("study", "compare", PARQUET, "--format", "csv").code == 1


def test_lines_of_numbers(compared: Run) -> None:
    """Trials, then mean, pooled fit and drift of each group, by both fits; the same numbers as JSON."""
    rows = compared("--format", "csv").rows()
    result = compared("--format", "json").result()
    mapped = [row for row in rows if row["fit"] == "with_model"]
    assert [row["row"] for row in mapped] == ["trial", "trial", "trial", "mean", "pooled", "drift", "mean"]
    assert float(mapped[0]["error_x_N"]) == result["trials"][0]["with_model"]["error_N"][0]
    group = _group(result, "2 N m")["with_model"]
    assert float(mapped[3]["index_kg"]) == group["mean_index_kg"]
    assert float(mapped[4]["index_kg"]) == group["pooled"]["index_kg"]
    assert float(mapped[5]["mass_x_kg"]) == group["drift"]["mass_kg"][0]
    assert mapped[5]["exceeds"] == "; ".join(group["drift"]["exceeds"])


@pytest.mark.long
def test_a_figure_is_written_where_it_is_asked(trials: Path, run: Run) -> None:
    """A PNG, named in the result; everything else stays as it is."""
    before = snapshot(trials)
    ended = run("study", "compare", FIRST, SECOND, "--figure", "compare.png", "--format", "json")
    assert ended.result()["figure"] == "compare.png"
    assert (trials / "compare.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert snapshot(trials).keys() - before.keys() == {"compare.png"}


@pytest.mark.long
def test_a_figure_that_could_not_be_drawn_is_not_named(trials: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor is one that is there from before; what went wrong is a failure, and the numbers are there."""

    def refuse(groups: object) -> bytes:
        raise OSError("no room")

    (trials / "compare.png").write_bytes(b"\x89PNG\r\n\x1a\n of another day")
    monkeypatch.setattr("forcetorque.evaluation.figures.sphere.index_figure", refuse)
    words = ("study", "compare", FIRST, SECOND, "--figure", "compare.png")
    result = _ended_with_failures(run(*words, "--format", "json"))
    assert (result["figure"], len(result["trials"])) == (None, 2)
    assert [(failure["file"], failure["message"]) for failure in result["failures"]] == [("compare.png", "no room")]
    assert "drawn to" not in run(*words, "--details").out


def test_without_matplotlib_only_figures_are_refused(arm: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before any file is read, not after all of them."""
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        monkeypatch.setitem(sys.modules, name, None)
    refused = run("study", "compare", PARQUET, "--figure", "compare.png")
    assert "pip install 'forcetorque[report]'" in refused.error()
    assert refused.log == []
    assert run("study", "compare", PARQUET).code == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("none.toml",), "none.toml: expected an experiment file, there is none"),
        ((PARQUET,), "parquet.toml: is named twice"),
        (("--figure", "compare.bmp"), "--figure compare.bmp: expected a name that ends in .png"),
        (("--figure", "nowhere/compare.png"), "expected an existing folder to write to"),
        (("-c", "nothing.json"), "nothing.json"),
    ],
)
def test_wrong_words_are_refused_before_anything_is_read(
    arm: Path, run: Run, words: tuple[str, ...], message: str
) -> None:
    """One line and exit code 2: no hours are lost."""
    refused = run("study", "compare", PARQUET, *words)
    assert message in refused.error()
    assert refused.log == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--sensor", "arm_tf"), "--sensor: no file has a sensor 'arm_tf'; did you mean \"arm_ft\"?"),
        (("--interval", "jugde"), "has the label or kind 'jugde'; did you mean \"judge\"?"),
    ],
)
def test_names_that_no_file_has_are_failures(arm: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """What a file may or may not have is found when it is read."""
    result = _ended_with_failures(run("study", "compare", PARQUET, TWO, *words, "--format", "json"))
    assert message in result["failures"][0]["message"]


@pytest.mark.long
@pytest.mark.real_data
def test_the_arms_and_the_leg_of_the_yoga(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """Two intervals as trials: nothing is identifiable, so nothing is averaged, ranked, or said to have drifted."""
    path = tmp_path / "yoga.toml"
    text = (EXAMPLES / "12_icub_yoga_sphere.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    result = run("study", "compare", path, "--trials", "intervals", "--format", "json").result()
    assert len(result["trials"]) == 6
    assert len(result["groups"]) == 3
    fits = 0
    for group in result["groups"]:
        for by in (group["with_model"], group["without_model"]):
            if by is not None:
                fits += 1
                assert (by["known"], by["mean_index_kg"], by["rank"]) == (0, None, None)
                assert not by["pooled"]["identifiable"]
                assert by["pooled"]["why"]
                assert by["drift"] is None or by["drift"]["exceeds"] is None
    assert fits == 4


@pytest.mark.long
@pytest.mark.real_data
def test_a_wrist_of_100_poses_and_of_7(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """Seven poses are too few and fail; the hundred stay, known with the model only."""
    paths = []
    for suffix in ("_100", ""):
        folder = tmp_path / f"axia{suffix}"
        folder.mkdir()
        paths.append(write_axia(data_dir, folder, suffix))
    result = _ended_with_failures(run("study", "compare", *paths, "--format", "json"))
    (trial,), (failure,) = result["trials"], result["failures"]
    assert trial["samples"] == 100
    assert trial["with_model"]["identifiable"]
    assert not trial["without_model"]["identifiable"]
    assert "expected at least 10 points, got 7" in failure["message"]
    (group,) = result["groups"]
    assert (group["with_model"]["rank"], group["without_model"]["rank"]) == (1, None)


@pytest.mark.long
@pytest.mark.real_data
def test_halves_of_a_hundred_poses(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """As two trials: one half is not known, so it is not averaged, and with an offset for each the pooled fit is not.

    Its interval holds the index of all poses with one offset.
    """
    path = write_axia(data_dir, tmp_path, "_100")
    whole = run("study", "compare", path, "--format", "json").result()["groups"][0]["with_model"]
    text = path.read_text(encoding="utf-8")
    assert text.count('label = "all"\nstart_s = 0.0\n') == 1
    halves = text.replace('label = "all"\nstart_s = 0.0\n', 'label = "a"\nstart_s = 0.0\nend_s = 50.0\n')
    path.write_text(f'{halves}[[interval]]\nlabel = "b"\nstart_s = 50.0\nuse = "calibration"\n')
    result = run("study", "compare", path, "--trials", "intervals", "--format", "json").result()
    assert len(result["trials"]) == 2
    by = result["groups"][0]["with_model"]
    assert (whole["known"], by["known"], by["rank"]) == (1, 1, None)
    assert not by["pooled"]["identifiable"]
    assert by["drift"]["exceeds"] is None
    assert by["pooled"]["index_low_kg"] <= whole["mean_index_kg"] <= by["pooled"]["index_high_kg"]
    assert not result["groups"][0]["without_model"]["pooled"]["identifiable"]
