# SPDX-License-Identifier: BSD-3-Clause
"""Answers to open questions: a file stays TOML, keeps its form, and nothing that another program wrote is lost."""

from __future__ import annotations

import codecs
from collections.abc import Callable
from pathlib import Path

import pytest

from forcetorque.inspection.draft.questions import answer_questions, with_serials
from forcetorque.inspection.draft.toml_lines import text_of, write_text_of


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """An experiment file with an open question in a table of one line."""
    path = tmp_path / "x.toml"
    path.write_text('stamp = { unit = "?" }  # of the column\n', encoding="utf-8")
    return path


def _answers(*answers: str) -> tuple[Callable[[str], str], list[str]]:
    given, asked = iter(answers), list[str]()

    def ask(question: str) -> str:
        asked.append(question)
        return next(given)

    return ask, asked


def test_an_answer_that_leaves_no_toml_is_asked_again(file: Path) -> None:
    """A comment behind a value in a table of one line; the reason stands in front of the question."""
    ask, asked = _answers('"s" # seconds', '"s"')
    assert answer_questions(file, ask)
    assert asked[0] == "line 1, unit: of the column"
    refusal, question = asked[1].splitlines()
    assert f"{file}:1: unit: expected a value without a comment" in refusal
    assert 'got "s" # seconds' in refusal
    assert question == asked[0]
    assert file.read_text(encoding="utf-8") == 'stamp = { unit = "s" }  # of the column\n'


def test_answers_that_cannot_be_written_leave_the_question_open(file: Path) -> None:
    """After three of them, with the file as it was."""
    before = file.read_bytes()
    ask, asked = _answers(*3 * ['"s" # seconds'])
    assert not answer_questions(file, ask)
    assert len(asked) == 3
    assert file.read_bytes() == before


def test_a_file_that_is_changed_beside_a_question_keeps_the_change(file: Path) -> None:
    """The answer goes to the line where the key is then."""
    asked: list[str] = []

    def ask(question: str) -> str:
        if not asked:
            file.write_text(f"# of the rig\n{file.read_text(encoding='utf-8')}", encoding="utf-8")
        asked.append(question)
        return "s"

    assert answer_questions(file, ask)
    assert "was changed meanwhile" in asked[1]
    assert "\nline 2, unit:" in asked[1]
    assert file.read_text(encoding="utf-8") == '# of the rig\nstamp = { unit = "s" }  # of the column\n'


@pytest.mark.parametrize("text", ['sensor = "x"\nserial = "?"\n', 'serial = "?"\n[sensor]\nserial = "S"\n'])
def test_sensors_that_are_no_list_get_no_serial_number(text: str, tmp_path: Path) -> None:
    """The command that reads the file says what is wrong with it."""
    assert with_serials(text, tmp_path) == text


@pytest.mark.parametrize("mark", [b"", codecs.BOM_UTF8])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_line_ends_and_byte_order_mark_stay(mark: bytes, end: str, tmp_path: Path) -> None:
    """Of every line, also of one that is put in."""
    file = tmp_path / "x.toml"
    file.write_bytes(mark + f"a = 1{end}b = 2{end}".encode())
    assert text_of(file) == "a = 1\nb = 2\n"
    write_text_of(file, "a = 1\nnew = 3\nb = 2\n")
    assert file.read_bytes() == mark + f"a = 1{end}new = 3{end}b = 2{end}".encode()
