# SPDX-License-Identifier: BSD-3-Clause
"""Workbench files that are drafted from tables of readings under known loads."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.draft.questions import answer_questions, logs_of, resume_experiment
from forcetorque.workbench.bench_recording import read_bench
from forcetorque.workbench.known_loads import THESIS_TABLE
from tests.app.outcome import Run
from tests.scenes.benches import thesis_loads

COUNTS_PER_SI = 100.0
ANSWERS = {
    "serial": "SIM7",
    "measure_direction": "child_to_parent",
    "full_scale": "32768.0",
    "known_units": '["N", "N", "N", "N m", "N m", "N m"]',
}


def _write(file: Path, headings: list[str], values: np.ndarray) -> Path:
    rows = [",".join(f"{value:.6g}" for value in row) for row in values]
    file.write_text("\n".join([",".join(headings), *rows, ""]), encoding="utf-8")
    return file


def _readings() -> np.ndarray:
    """Readings of a sensor that is exact, of the loads of the thesis."""
    noise = np.random.default_rng(3).normal(0.0, 0.5, (len(thesis_loads()), 6))
    return COUNTS_PER_SI * thesis_loads().wrench + noise


def _answer(question: str) -> str:
    return ANSWERS[question.splitlines()[-1].partition(", ")[2].partition(":")[0]]


@pytest.fixture
def beside_loads(tmp_path: Path) -> Path:
    """A table whose headings name the loads, as a spreadsheet of a bench has them."""
    headings = [*("Fx", "Fy", "Fz", "Mx", "My", "Mz"), *(f"known_{name}" for name in WRENCH_COMPONENTS)]
    return _write(tmp_path / "bench.csv", headings, np.hstack([_readings(), thesis_loads().wrench]))


def test_columns_of_loads_make_a_workbench_file(beside_loads: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """`run` begins the file, and goes the whole way once its questions are answered."""
    monkeypatch.chdir(beside_loads.parent)
    begun = run("run", "bench.csv", "-o", "results", "--no-input")
    file = Path("results/experiment.toml")
    assert begun.code == 4
    assert logs_of(file) == {beside_loads.resolve()}
    assert answer_questions(file, _answer)
    ended = run("run", "bench.csv", "-o", "results", "--no-input")
    assert ended.code == 0, ended.out
    assert "NO FAULT OF THE BENCH" in ended.out
    assert Path("results/experiment.json").is_file()
    assert resume_experiment(file).proposals == ()


def test_an_answer_that_the_key_does_not_take_is_asked_again(tmp_path: Path) -> None:
    """With what it takes; a list needs no brackets, and a number may be a serial number."""
    rows = np.hstack([_readings(), thesis_loads().wrench])
    names = [*(f"ch{k}" for k in range(6)), *(f"known_{name}" for name in WRENCH_COMPONENTS)]
    file = tmp_path / "bench.toml"
    draft_experiment([_write(tmp_path / "bench.csv", names, rows)], file)
    replies = iter(["170", "down", "child_to_parent", "up", "25", "25", "N, N, N, N m, N m, N m"])
    asked: list[str] = []

    def ask(question: str) -> str:
        asked.append(question)
        return next(replies)

    assert answer_questions(file, ask)
    content = tomllib.loads(file.read_text(encoding="utf-8"))
    assert (content["sensor"]["serial"], content["sensor"]["full_scale"]) == ("170", 25)
    assert content["measurements"]["known_units"] == ["N", "N", "N", "N m", "N m", "N m"]
    refused = [question.splitlines()[0] for question in asked if "\n" in question]
    assert "measure_direction: expected 'child_to_parent' or 'parent_to_child', got down" in refused[0]
    assert "full_scale: expected a list or a valid number, got up" in refused[1]
    assert "known_units: expected a list, got 25" in refused[2]
    assert next(iter(resume_experiment(file).answers())).verdict == "COMPLETE"
    file.write_text(file.read_text(encoding="utf-8").replace('["N", "N", ', '["N", '), encoding="utf-8")
    with pytest.raises(FormatError, match="known_units: expected one for each column of known"):
        resume_experiment(file)


def test_a_table_of_weights_is_named(tmp_path: Path) -> None:
    """Rows of readings are those of the table of weights, which is read as any other."""
    table = _write(tmp_path / "bench.csv", [f"ch{k}" for k in range(6)], _readings())
    file = tmp_path / "bench.toml"
    draft = draft_experiment([table], file, loads=THESIS_TABLE)
    (answer,) = draft.answers()
    assert answer.command == f"init --resume {file}"
    assert answer_questions(file, _answer)
    bench = read_bench(file).bench
    assert bench is not None
    np.testing.assert_allclose(bench.raw, _readings(), rtol=1e-5)
    assert next(iter(resume_experiment(file).answers())).command == f"run {file}"


def test_what_is_not_known_is_asked(tmp_path: Path) -> None:
    """Columns whose headings name no component are questions, as are those of fewer components."""
    forces = _write(tmp_path / "cell.csv", ["a", "b", "c", "load_fx", "load_fy", "load_fz"], _readings())
    content = draft_experiment([forces]).content
    assert 'components = ["fx", "fy", "fz"]' in content
    assert [one.key for one in draft_experiment([forces]).questions] == [
        "serial",
        "measure_direction",
        "full_scale",
        "load_full_scale",
        "channels",
        "known_units",
    ]
    named = draft_experiment(
        [_write(tmp_path / "own.csv", list("abcdefgh"), np.hstack([_readings(), _readings()[:, :2]]))],
        loads=tmp_path / "own.csv",
    )
    assert [one.key for one in named.questions][-3:] == ["channels", "known", "known_units"]


def test_loads_of_units_that_are_not_known_are_asked(tmp_path: Path) -> None:
    """They stay loads; what is named like a load twice is named as not taken."""
    channels = [f"ch{k}" for k in range(1, 7)]
    loads = ["known_fx [N]", "known_fy [N]", "known_fz [kN]", "known_tx [N m]", "known_ty [mN m]", "known_tz"]
    rows = np.hstack([_readings(), thesis_loads().wrench])
    draft = draft_experiment([_write(tmp_path / "fit.csv", [*channels, *loads], rows)])
    assert tomllib.loads(draft.content)["measurements"]["known"] == loads
    (question,) = [one.question for one in draft.questions if one.key == "known_units"]
    assert question == 'unit of each, as ["N", "N", "kN", "N m", "?", "N m"]; not known: known_ty [mN m]'
    behind = [f"{component} applied" for component in WRENCH_COMPONENTS]
    draft = draft_experiment([_write(tmp_path / "behind.csv", ["pos", *channels, *behind], rows[:, [0, *range(12)]])])
    assert tomllib.loads(draft.content)["measurements"]["known"] == behind
    twice = [f"{word}_f{axis}" for word in ("known", "applied") for axis in "xyz"]
    content = draft_experiment([_write(tmp_path / "twice.csv", [*channels, *twice], rows)]).content
    assert tomllib.loads(content)["measurements"]["known"] == twice[:3]
    assert "# named like a load, and not taken: applied_fx, applied_fy, applied_fz" in content


def test_loads_whose_heading_is_not_read_are_asked(tmp_path: Path) -> None:
    """A sensor of six components is not drafted as one of three; a unit behind the name is no other name."""
    channels = [f"ch{k}" for k in range(1, 7)]
    rows = np.hstack([_readings(), thesis_loads().wrench])
    loads = [*(f"load_F{axis}_kN" for axis in "xyz"), *(f"load_M{axis}_Ncm" for axis in "xyz")]
    draft = draft_experiment([_write(tmp_path / "units.csv", [*channels, *loads], rows)])
    content = tomllib.loads(draft.content)
    assert content["measurements"]["known"] == loads
    assert "components" not in content["sensor"]
    assert [one.question for one in draft.questions if one.key == "known_units"][0].endswith("load_My_Ncm, load_Mz_Ncm")
    for form in ("load_{}", "{}_ref"):
        loads = [form.format(name) for name in ("Fx", "Fy", "Fz", "about_x", "about_y", "about_z")]
        draft = draft_experiment([_write(tmp_path / "about.csv", [*channels, *loads], rows)])
        assert tomllib.loads(draft.content)["measurements"]["known"] == "?"
        assert "components" not in tomllib.loads(draft.content)["sensor"]


def test_lines_that_may_be_taken_up_are_toml(tmp_path: Path) -> None:
    """Once the first mark is taken away."""
    table = _write(tmp_path / "bench.csv", list("abcdefgh"), np.hstack([_readings(), _readings()[:, :2]]))
    lines = draft_experiment([table], loads=table).content.splitlines()
    optional = [line.removeprefix("# ") for line in lines if line.startswith("# ") and " = " in line]
    keys = [next(iter(tomllib.loads(line))) for line in optional]
    assert keys == ["components", "load_full_scale", "prior", "series_from_zero"]


@pytest.mark.parametrize(("name", "first"), [("position", 1), ("", 1), ("weight", 0), ("No.", 5)])
def test_numbers_of_rows_are_no_times(tmp_path: Path, beside_loads: Path, name: str, first: int) -> None:
    """By their name, or by their values."""
    table = np.hstack([_readings(), thesis_loads().wrench])
    headings = beside_loads.read_text(encoding="utf-8").splitlines()[0].split(",")
    numbers = np.arange(first, first + len(table))
    log = _write(tmp_path / "log.csv", [name, *headings], np.column_stack([numbers, table]))
    content = tomllib.loads(draft_experiment([log]).content)
    assert content["schema"] == "forcetorque/bench/1"
    assert content["measurements"]["channels"] == headings[:6]


def test_a_log_with_times_is_no_bench(tmp_path: Path, beside_loads: Path) -> None:
    """Negative control: a robot logs commanded forces beside measured ones."""
    table = np.hstack([_readings(), thesis_loads().wrench])
    headings = beside_loads.read_text(encoding="utf-8").splitlines()[0].split(",")
    log = _write(tmp_path / "log.csv", ["time_s", *headings], np.column_stack([np.arange(len(table)), table]))
    assert "forcetorque/bench" not in draft_experiment([log]).content
    assert "forcetorque/bench" in draft_experiment([beside_loads]).content


def test_what_no_workbench_file_can_state_is_refused(tmp_path: Path, beside_loads: Path) -> None:
    """Several tables, weights that are not there, lines above the headings; and the file by commands of experiments."""
    with pytest.raises(ExperimentError, match="expected one table of readings"):
        draft_experiment([beside_loads, _write(tmp_path / "b.csv", ["t", "fx"], np.eye(2))], loads=THESIS_TABLE)
    with pytest.raises(MissingFileError, match="expected a table of weights"):
        draft_experiment([beside_loads], loads=tmp_path / "none.csv")
    above = tmp_path / "above.csv"
    above.write_text(f"Bench of today\n{beside_loads.read_text(encoding='utf-8')}", encoding="utf-8")
    with pytest.raises(FormatError, match="one line of headings"):
        draft_experiment([above], loads=above)


def test_another_command_names_the_kind_of_the_file(beside_loads: Path, run: Run) -> None:
    """Not its first key that an experiment file does not have."""
    file = beside_loads.with_suffix(".toml")
    draft_experiment([beside_loads], file)
    answer_questions(file, _answer)
    assert 'expected "forcetorque/experiment/1", got "forcetorque/bench/1"' in run("inspect", file).error()
