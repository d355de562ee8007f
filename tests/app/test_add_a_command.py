# SPDX-License-Identifier: BSD-3-Clause
"""A command is a folder and a line: help, schema, report and their tests know it from then on.

So is a group of commands. This is the recipe of docs/architecture.md, followed with
`tests/toys/command` and `tests/toys/group`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from forcetorque.report.sorted_input_files import sort_sources
from tests.app import test_help_and_schema as every_command
from tests.app.added_command import GROUP, GROUP_COMMAND, NAME, added_command, added_group
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import TWO
from tests.scenes.patches import cylinder_patch, position_text


@pytest.fixture
def added(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The recipe, and the command among those that every test of commands looks at."""
    monkeypatch.setattr(every_command, "COMMANDS", sorted([*every_command.COMMANDS, NAME]))
    with added_command():
        yield


@pytest.mark.usefixtures("added")
def test_it_answers_in_every_form(run: Run, arm: Path) -> None:
    """Table, JSON and CSV of all sensors, which nobody wrote for it."""
    assert "sensor    duration, s" in run(NAME, TWO).out
    rows = run(NAME, TWO, "--format", "json").result()["sensors"]
    assert [row["sensor"] for row in rows] == ["arm_ft", "tool_ft"]
    assert [float(row["duration_s"]) for row in run(NAME, TWO, "--format", "csv").rows()] == [
        row["duration_s"] for row in rows
    ]


@pytest.mark.usefixtures("added")
def test_its_schema_is_known(run: Run, arm: Path) -> None:
    """It is printed, listed among the known ones, and the result fits it; a damaged one does not."""
    schema = run("schema", NAME).result()
    content = run(NAME, TWO, "--format", "json").result()
    assert faults(content, schema) == []
    assert faults({**content, "sensors": [{"sensor": 1}]}, schema) != []
    every_command.test_an_unknown_schema_leads_to_the_known_ones(run)


@pytest.mark.usefixtures("added")
def test_a_report_takes_its_result(run: Run, arm: Path) -> None:
    """By the schema that the file states."""
    (arm / "extent.json").write_text(run(NAME, TWO, "--format", "json").out, encoding="utf-8")
    file = arm / "extent.json"
    *_, results = sort_sources([arm / TWO, file])
    assert list(results) == [str(file)]


@pytest.mark.usefixtures("added")
def test_it_is_held_to_what_holds_for_every_command(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its help has one line and an example that can be typed; that the README does not name it is noticed."""
    every_command.test_the_help_lists_every_command(run)
    every_command.test_the_help_of_a_command_has_one_line_and_an_example(run, NAME)
    every_command.test_the_example_of_a_command_can_be_typed(run, NAME, tmp_path, monkeypatch)
    with pytest.raises(AssertionError):
        every_command.test_the_readme_names_every_command(NAME)


@pytest.fixture
def grouped(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """The recipe for a group, its command among those that every test of commands looks at, and a layout for it."""
    (tmp_path / "patch.txt").write_text(position_text(cylinder_patch()), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(every_command, "COMMANDS", sorted([*every_command.COMMANDS, GROUP_COMMAND]))
    monkeypatch.setattr(every_command, "GROUPS", sorted([*every_command.GROUPS, GROUP]))
    with added_group():
        yield


@pytest.mark.long
@pytest.mark.usefixtures("grouped")
def test_a_command_of_a_group_answers_and_has_a_schema(run: Run) -> None:
    """Typed behind the name of its group; its schema is called after both."""
    assert "patch      210" in run(GROUP, "count", "patch.txt").out
    content = run(GROUP, "count", "patch.txt", "--format", "json").result()
    schema = run("schema", "toy_count").result()
    assert faults(content, schema) == []
    assert faults({**content, "patches": [{"patch": 1}]}, schema) != []
    every_command.test_an_unknown_schema_leads_to_the_known_ones(run)


@pytest.mark.usefixtures("grouped")
def test_a_group_is_held_to_what_holds_for_every_command(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Help of the program, of the group and of the command; that the README does not name the group is noticed."""
    every_command.test_the_help_lists_every_command(run)
    every_command.test_the_help_of_a_group_lists_its_commands(run, GROUP)
    every_command.test_the_help_of_a_command_has_one_line_and_an_example(run, GROUP_COMMAND)
    every_command.test_the_example_of_a_command_can_be_typed(run, GROUP_COMMAND, tmp_path, monkeypatch)
    with pytest.raises(AssertionError):
        every_command.test_the_readme_names_every_command(GROUP_COMMAND)


def test_without_the_recipe_nobody_knows_it(run: Run, arm: Path) -> None:
    """Negative control: it is the files and lines that do it, and nothing of them stays."""
    with added_command():
        pass
    with added_group():
        pass
    assert f"No such command '{NAME}'" in run(NAME, TWO).err
    assert f"No such command '{GROUP}'" in run(GROUP, "count", TWO).err
    assert f"no schema is called '{NAME}'" in run("schema", NAME).error()
