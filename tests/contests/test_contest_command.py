# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench contest` as it is typed, on files of the example, and the script of its page."""

from __future__ import annotations

import csv
import io
import runpy
from pathlib import Path

import pytest

from forcetorque.contests.contest_scores import Contest
from forcetorque.report.report_sections import result_figures
from forcetorque.results.document.content import Figure
from tests.app.outcome import Run
from tests.page_scripts import unmarked

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "19_contest.py"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example with one load to fit on and two to judge by."""
    place = tmp_path_factory.mktemp("contest")
    runpy.run_path(str(EXAMPLE))["write_contest"](place, fitted_kg=(5.0,), judged_kg=(10.0, 20.0), turns=1)
    return place


@pytest.mark.long
def test_it_ranks_draws_and_goes_into_a_report(run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Table, figure, JSON and CSV; what lacks something is named; a report that is given the JSON draws it."""
    monkeypatch.chdir(folder)
    asked = run("bench", "contest", "contest.toml", "--figure", "contest.png", "--format", "json")
    assert asked.code == 0
    result = asked.result()
    assert result["schema"] == "forcetorque/contest/2"
    ranks = {row["contestant"]: row["rank"] for row in result["contestants"]}
    assert ranks["ours 1, in situ"] < ranks["mini58 as bought"] < ranks["ours 1, factory matrix"]
    # one load on the device moves five directions of six, which without a prior is too few
    assert {row["contestant"] for row in result["left_out"]} == {"ours 2, workbench", "ours 1, in situ, no prior"}
    assert (folder / "contest.png").read_bytes().startswith(b"\x89PNG")
    (drawn,) = result_figures(result)
    assert isinstance(drawn, Figure)
    assert "Errors of every contestant over the loads" in drawn.caption
    assert list(result_figures({"schema": "forcetorque/thermal/2"})) == []
    text = Contest.model_validate_json(asked.out)
    lines = list(csv.DictReader(io.StringIO(_csv(text))))
    assert {line["row"] for line in lines} == {"contestant", "pair"}
    assert "could not take part" in str(text)


def _csv(result: Contest) -> str:
    out = io.StringIO()
    writer = csv.DictWriter(out, fieldnames=result.columns())
    writer.writeheader()
    writer.writerows(result.records())
    return out.getvalue()


def test_bad_input_is_one_line(run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A load on which somebody was fitted, by the file, the run and who; exit code 2."""
    monkeypatch.chdir(folder)
    text = (folder / "contest.toml").read_text(encoding="utf-8").replace("load_kg = 10.0", "load_kg = 5.0")
    (folder / "favours.toml").write_text(text, encoding="utf-8")
    asked = run("bench", "contest", "favours.toml")
    assert asked.code == 2
    assert "favours.toml: judge_10kg_0.toml: expected validation loads that no contestant was fitted on" in asked.err
    assert "'ours 1, in situ' was" in asked.err
    assert run("bench", "contest", "none.toml").code == 2


def test_the_script_of_the_page_runs(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """That of contest.md, as it stands."""
    monkeypatch.chdir(folder)
    (code,) = unmarked((ROOT / "docs" / "contests.md").read_text(encoding="utf-8"))
    names: dict[str, object] = {}
    exec(compile(code, "contest.md", "exec"), names)
    assert isinstance(names["answer"], Contest)
