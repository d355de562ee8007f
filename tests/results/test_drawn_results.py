# SPDX-License-Identifier: BSD-3-Clause
"""What a command draws is had from Python: its result has `figure()`."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar, Literal

import pytest
from matplotlib.figure import Figure
from pydantic import Field
from typer.core import TyperGroup as Group
from typer.main import get_command

import forcetorque
from forcetorque.app.command_line import whole_program
from forcetorque.base.errors import MissingExtraError, OutputError
from forcetorque.base.lazy import named
from forcetorque.results.figure_style import in_figure_style, new_figure
from forcetorque.results.result import DrawnResult, result_classes
from forcetorque.results.terminal.command_output import drawn_to, refuse_figure
from tests.app.commands import question_of

OTHER_RESULTS = {"evaluate_dataset": "evaluate", "payload_by_torques": "payload", "plan_jointly": "plan"}
"""Results that a command has for other input, and the command."""


@in_figure_style
def toy_lines(values: tuple[float, ...], name: str) -> Figure:
    """Values over their index, under a name."""
    figure = new_figure(2.0)
    figure.subplots().plot(values, label=name)
    return figure


class Toy(DrawnResult):
    """Numbers with a name."""

    drawn_by: ClassVar[str] = f"{__name__}:toy_lines"
    drawn_fields: ClassVar[tuple[str, ...]] = ("values", "title")

    schema_name: Literal["forcetorque/toy/1"] = Field(default="forcetorque/toy/1", alias="schema")
    """Form of the result."""
    values: tuple[float, ...]
    """Numbers."""

    @property
    def title(self) -> str:
        """Their name."""
        return f"{len(self.values)} values"


def test_a_result_draws_its_fields() -> None:
    """By the function that it names, of fields and properties; a notebook shows the figure."""
    figure = Toy(values=(1.0, 3.0)).figure()
    (line,) = figure.axes[0].lines
    assert (list(line.get_ydata()), line.get_label()) == ([1.0, 3.0], "2 values")
    assert figure._repr_png_().startswith(b"\x89PNG")  # type: ignore[attr-defined]


def test_the_file_of_the_figure_is_named() -> None:
    """In JSON, null without a file, behind the schema, which comes first; and once below the details."""
    toy = Toy(values=(1.0,))
    assert list(json.loads(toy.json_text())) == ["schema", "figure", "values"]
    assert json.loads(toy.json_text())["figure"] is None
    drawn = toy.model_copy(update={"figure_file": "toy.png"})
    assert json.loads(drawn.json_text())["figure"] == "toy.png"
    assert drawn.details() == "drawn to toy.png\n"


@pytest.mark.parametrize(("ending", "head"), [(".png", b"\x89PNG"), (".SVG", b"<?xml"), (".pdf", b"%PDF")])
def test_the_name_of_the_file_says_what_is_drawn(tmp_path: Path, ending: str, head: bytes) -> None:
    """The same bytes again, which a later run may replace; letters of lines stay letters."""
    toy, file = Toy(values=(1.0, 3.0)), tmp_path / f"toy{ending}"
    drawn = drawn_to(toy, file)
    first = file.read_bytes()
    assert (drawn.figure_file, first[: len(head)]) == (str(file), head)
    refuse_figure(file)
    assert drawn_to(toy, file) == drawn
    assert file.read_bytes() == first


class Kept(Toy):
    """A toy whose computation took long."""

    outlives_figure = True


def test_what_took_long_outlives_its_figure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A warning takes the place of what cannot be drawn; of other results it is an error."""

    def toy_lines(*_: object) -> Figure:
        raise OutputError("there is nothing to draw")

    monkeypatch.setattr(f"{__name__}.toy_lines", toy_lines)
    with pytest.raises(OutputError, match="nothing to draw"):
        drawn_to(Toy(values=(1.0,)), tmp_path / "toy.png")
    kept = drawn_to(Kept(values=(1.0,)), tmp_path / "toy.png")
    assert (kept.figure_file, kept.values) == (None, (1.0,))
    assert "toy.png: there is nothing to draw" in kept.warnings[0]
    assert not (tmp_path / "toy.png").exists()


def test_a_drawing_of_another_program_is_kept(tmp_path: Path) -> None:
    """An SVG that was drawn by hand is not replaced."""
    file = tmp_path / "sketch.svg"
    file.write_text('<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg"/>\n', encoding="utf-8")
    with pytest.raises(OutputError, match=r"sketch\.svg"):
        refuse_figure(file)


def test_without_matplotlib_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one line, with the command to install it."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[report\]'"):
        Toy(values=(1.0,)).figure()


def test_every_command_with_a_figure_gives_a_result_with_one() -> None:
    """Results name functions and fields that there are; those of other commands have no figure."""
    results = result_classes(forcetorque)
    drawn = {name for name, kind in results.items() if issubclass(kind, DrawnResult)}
    program = get_command(whole_program())
    assert isinstance(program, Group)
    offered = {question_of(words) for words in _drawing_commands(program)}
    assert offered == drawn - OTHER_RESULTS.keys()
    assert offered >= set(OTHER_RESULTS.values())
    assert len(drawn) == 42
    for name in drawn:
        kind = results[name]
        assert issubclass(kind, DrawnResult)
        if "figure" not in vars(kind):
            assert callable(named(kind.drawn_by))
            assert all(field in kind.model_fields or hasattr(kind, field) for field in kind.drawn_fields)


def _drawing_commands(group: Group, words: tuple[str, ...] = ()) -> Iterator[str]:
    """Words of every command with `--figure`."""
    for name, command in group.commands.items():
        if isinstance(command, Group):
            yield from _drawing_commands(command, (*words, name))
        elif any("--figure" in option.opts for option in command.params):
            yield " ".join((*words, name))
