# SPDX-License-Identifier: BSD-3-Clause
"""Every command explains itself, is documented, and prints schemas that files and results fit."""

from __future__ import annotations

import json
import re
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

from forcetorque.app.command_line import whole_program
from forcetorque.recording.stream import QUANTITIES
from tests.app.commands import question_of, typed_commands
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.experiments import TEXTS

PROGRAM = whole_program()
COMMANDS = typed_commands(PROGRAM)
GROUPS = sorted(str(group.typer_instance.info.name) for group in PROGRAM.registered_groups if group.typer_instance)
ROOT = Path(__file__).parents[2]
FILES = (
    "experiment",
    "acceptance",
    "bench",
    "device_file",
    "contestants",
    "torque_loop_file",
    "load_cases",
    "sensor_catalogue",
    "scenario",
    "fleet_plan",
    "recording",
    "calibration",
    "joint",
    "moments",
    "taxels",
    "module_frames",
)
"""What people write, and what is written to be read again."""
OF_OPTIONS = ("plan_jointly", "evaluate_dataset", "payload_by_torques")
"""Results of commands that an option, a dataset in place of a log, or a log without a wrench, asks something else."""
JSON_SCHEMAS = (
    "experiment",
    "acceptance",
    "calibration",
    "joint",
    "moments",
    "accept",
    "calibrate",
    "compare",
    "estimate",
    "evaluate",
    "gains",
    "plan",
    "report",
    "run",
    "skin_calibrate",
    "skin_check",
    "skin_wrench",
    "study",
    "taxels",
    "bench",
    "workbench",
    "device",
    "device_file",
)


def _paragraphs(help_text: str) -> list[str]:
    return [" ".join(block.split()) for block in help_text.split("\n\n")]


def test_there_are_commands() -> None:
    """The tests below look at something."""
    assert {"calibrate", "evaluate", "schema", "skin check"} <= set(COMMANDS)


def _listed(help_text: str) -> list[str]:
    """Names in all panels, all with a line that says what they are for."""
    return sorted(re.findall(r"^  (\w[\w-]*)  +[A-Z]", help_text.partition("Options:")[2], re.MULTILINE))


def test_the_help_lists_every_command(run: Run) -> None:
    """Asked for help the program lists its commands and groups; without a word it does so too, and fails."""
    asked, bare = run("--help"), run()
    assert asked.code == 0
    assert (bare.code, bare.out + bare.err) == (2, asked.out)
    assert _listed(asked.out) == sorted([name for name in COMMANDS if " " not in name] + GROUPS)


@pytest.mark.parametrize("group", GROUPS)
def test_the_help_of_a_group_lists_its_commands(run: Run, group: str) -> None:
    """As that of the program does, below one sentence that says what they are about."""
    asked, bare = run(group, "--help"), run(group)
    assert (asked.code, asked.err) == (0, "")
    assert (bare.code, bare.out + bare.err) == (2, asked.out)
    usage, sentence, *_ = asked.out.split("\n\n")
    assert re.match(rf"Usage: .*\bforcetorque {group} ", usage)
    assert re.fullmatch(r"  [A-Z][^\n]+\.", sentence)
    assert [f"{group} {name}" for name in _listed(asked.out)] == [name for name in COMMANDS if name.split()[0] == group]


@pytest.mark.parametrize("command", COMMANDS)
def test_the_help_of_a_command_has_one_line_and_an_example(run: Run, command: str) -> None:
    """One sentence says what it does, one line can be copied; every option is explained."""
    asked = run(*command.split(), "--help")
    assert (asked.code, asked.err) == (0, "")
    usage, sentence, example, *_ = asked.out.split("\n\n")
    assert re.match(rf"Usage: .*\bforcetorque {command} ", usage)
    assert re.fullmatch(r"  [A-Z][^\n]+\.", sentence)
    assert re.fullmatch(rf"  Example: forcetorque {command} [^\n]+", example)
    options = re.split(r"\n(?=  -)", asked.out.partition("Options:")[2])[1:]
    assert options
    for option in options:
        assert re.search(r"  [A-Z]|\n {10,}[A-Z]", option), option


@some_cases("command", sorted(COMMANDS, key="demo".__eq__), quick=len(COMMANDS) - 1)  # the demo runs
def test_the_example_of_a_command_can_be_typed(
    run: Run, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where its files are missing, that is the only complaint; the words themselves are right."""
    monkeypatch.chdir(tmp_path)
    example = next(text for text in _paragraphs(run(*command.split(), "--help").out) if text.startswith("Example: "))
    _, name, *words = example.split()
    assert name == "forcetorque"
    ended = run(*words)
    if ended.code != 0:
        assert re.search(r": expected an? [\w ]+, there is none", ended.error())
    with_a_typo = run(*words, "--no-such-option")
    assert with_a_typo.code == 2
    assert re.search(r"No such option:? '?--no-such-option\b", with_a_typo.err)  # quoted or not, by version of typer


@pytest.mark.parametrize("command", COMMANDS)
def test_the_readme_names_every_command(command: str) -> None:
    """Who reads the README learns that the command, or its group, exists."""
    assert re.search(rf"(\bforcetorque |`){command.split()[0]}\b", (ROOT / "README.md").read_text(encoding="utf-8"))


def test_the_version_is_that_of_the_package(run: Run) -> None:
    """It is one line on standard output."""
    asked = run("--version")
    assert (asked.code, asked.out, asked.err) == (0, f"{version('forcetorque')}\n", "")


def _names(run: Run) -> list[str]:
    known = run("schema", "experimint").error()
    assert known.startswith("error: no schema is called 'experimint'; did you mean \"experiment\"? known: ")
    return known.partition("known: ")[2].split(", ")


def test_an_unknown_schema_leads_to_the_known_ones(run: Run) -> None:
    """The error lists files and every command that has a result; the help those files; each is printed as JSON."""
    names = _names(run)
    assert set(names) == {*FILES, *OF_OPTIONS, *map(question_of, COMMANDS)} - {"schema", "demo"}
    (argument,) = re.findall(r"Arguments:\n((?:.+\n)+)", run("schema", "--help").out)
    assert all(re.search(rf"\b{name}\b", argument) for name in FILES)
    for name in names:
        described = run("schema", name).result()
        assert isinstance(described, dict)
        assert described


def _release(package: str) -> tuple[int, ...]:
    return tuple(map(int, version(package).split(".")[:2]))


@pytest.mark.parametrize("name", JSON_SCHEMAS)
def test_schemas_say_what_every_key_means_where_it_has_a_table(run: Run, name: str) -> None:
    """Each is a JSON schema of an object, every table in it is described, and unknown tables are not referred to."""
    schema = run("schema", name).result()
    assert schema["type"] == "object"
    assert "schema" in schema["properties"]
    tables = [schema, *schema.get("$defs", {}).values()]
    # before 2.13 pydantic takes no description from a plain dataclass
    unsaid = {"UnusableCounts"} if _release("pydantic") < (2, 13) else set()
    for table in tables:
        assert table.get("description") or "enum" in table or table["title"] in unsaid, table["title"]
    references = set(re.findall(r'"#/\$defs/(\w+)"', json.dumps(schema)))
    assert references == set(schema.get("$defs", {}))
    assert len(tables) > 1


@pytest.mark.parametrize("form", TEXTS)
def test_experiment_files_fit_the_printed_schema(run: Run, form: str) -> None:
    """Complete files fit, with every form that an optional key may have; damaged ones do not."""
    schema = run("schema", "experiment").result()
    content = tomllib.loads(TEXTS[form])
    assert faults(content, schema) == []
    for processing in ({"derivatives": "logged"}, {"derivatives": {"window_s": 0.1, "order": 2}, "smoothing": None}):
        assert faults({**content, "processing": processing}, schema) == []
    for value in (5, 2.5, "held-out"):
        assert faults({**content, "calibration": {"lambda_counts2": value}}, schema) == []
    for calibration in ({"type": "OwTrTO"}, {"offset": "sphere", "with_variables": True, "sphere_intervals": ["fit"]}):
        assert faults({**content, "calibration": calibration}, schema) == []
    assert faults({**content, "trial": {"condition": "2 N m", "number": 1}}, schema) == []
    variables = [
        {"name": "temperature"},
        {"name": "supply", "stream": "board", "quantity": "scalar", "column": "supply"},
    ]
    sensors = [{**content["sensor"][0], "variable": variables}]
    assert faults({**content, "sensor": sensors}, schema) == []
    bad: list[dict[str, object]] = [
        {"calibration": {"type": "OwTr"}},
        {"calibration": {"offset": "centralized"}},
        {"sensor": [{**content["sensor"][0], "variable": [{"quantity": "temperature"}]}]},
        {"colour": "red"},
        {"trial": {"number": 0}},
        {"name": 3},
        {"calibration": {"lambda_counts2": -1}},
        {"sensor": []},
        {"patch": []},
        {"patch": [{"name": "palm"}]},
    ]
    for damage in bad:
        assert faults({**content, **damage}, schema) != []
    # contacts that a skinManager saw are about neither sensors nor patches
    assert faults({other: value for other, value in content.items() if other != "sensor"}, schema) == []
    for key in ("recording", "interval", "schema", "name"):
        assert faults({other: value for other, value in content.items() if other != key}, schema) != []


def test_the_schema_of_recordings_lists_every_quantity(run: Run) -> None:
    """Name, columns, units and meaning are those that readers and writers use."""
    described = run("schema", "recording").result()
    assert described["schema"] == "forcetorque/recording/1"
    assert list(described["quantities"]) == list(QUANTITIES)
    for name, quantity in QUANTITIES.items():
        assert described["quantities"][name]["description"] == quantity.description
        if quantity.columns:
            assert described["quantities"][name]["columns"] == list(quantity.columns)
