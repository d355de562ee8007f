# SPDX-License-Identifier: BSD-3-Clause
"""Contests without a robot: added masses with gravity measured, and a reference sensor, from files."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.contests.commands import contest
from forcetorque.contests.contest_file import read_entries
from tests.scenes.wrist_contest import write_contest, write_runs


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Runs to fit on by masses and by a reference sensor, and runs that judge by either."""
    place = tmp_path_factory.mktemp("wrist")
    write_runs(place)
    return place


@pytest.mark.parametrize("judge", ["judge", "judge_applied"])
def test_added_masses_and_a_reference_sensor_beat_what_was_bought(folder: Path, judge: str) -> None:
    """By runs whose reference is a known mass, and by those where another sensor says it."""
    path = write_contest(folder, {"masses": 1.0, "applied": 4.0, judge: 3.0})
    answer = contest(path)
    assert answer.left_out == ()
    by_name = {row.contestant: row for row in answer.contestants}
    assert by_name["as bought"].rank == len(by_name)
    for name, kg in (("masses", 1.0), ("reference", 4.0)):
        assert by_name[name].force_error_N < 0.5 * by_name["as bought"].force_error_N
        assert by_name[name].fitted_loads_kg == (kg,)
    assert by_name["as bought"].rmse_percent_of_full_scale is not None
    assert any("precision" in words for words in answer.warnings)


def test_a_method_takes_only_runs_of_its_own_kind(folder: Path) -> None:
    """Without the run of the reference sensor that method is named, and the other goes on."""
    (left,) = contest(write_contest(folder, {"masses": 1.0, "judge": 3.0})).left_out
    assert left.contestant == "reference"
    assert "applied" in left.why


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('method = "maker"', 'method = "makers"', r"contest.toml: contestant\[0\].method: .*maker"),
        ("load_kg", "load_lb", r"contest.toml: run\[0\]"),
        ('name = "masses"', 'name = "as bought"', "contestant: expected each once, got 'as bought' again"),
        ('method = "maker"', 'method = "maker"\nbench = "b.toml"', 'bench belongs to method = "workbench"'),
        ('method = "maker"', 'method = "maker"\ncatalogue = "mini58"', "expected catalogue or full_scale, got both"),
    ],
)
def test_bad_files_are_refused(folder: Path, old: str, new: str, message: str) -> None:
    """By the key that is wrong."""
    path = write_contest(folder, {"masses": 1.0, "judge": 3.0})
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(FormatError, match=message):
        read_entries(path)


def test_files_that_are_not_runs_and_ranges_that_are_not_there(folder: Path) -> None:
    """The message lists the runs, and how many ranges there are."""
    path = write_contest(folder, {"masses": 1.0, "judge": 3.0})
    text = path.read_text()
    path.write_text(text.replace('"known-masses"', '"known-masses"\nfitted_on = ["other.toml"]'))
    with pytest.raises(
        ExperimentError, match=r"'masses': fitted_on: .* got other.toml; known: judge.toml, masses.toml"
    ):
        read_entries(path)
    path.write_text(text.replace('"known-masses"', '"known-masses"\ncatalogue = "Axia80"'))
    with pytest.raises(
        ExperimentError, match=r"'masses': expected range, one of the 2 that the catalogue has of Axia80"
    ):
        read_entries(path)
