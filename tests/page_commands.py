# SPDX-License-Identifier: BSD-3-Clause
"""Run a page as a reader does: write its files, type its commands, and put what they print into the page.

A block `toml` whose first line is `# NAME.toml` writes that file; where the file exists, its keys take the place of the
values `"?"` in it. A block `console` holds commands behind `$ ` and the first lines that each prints; `...` stands for
the rest. `# exit code 1` behind a command is what it ends with. Scripts of the examples are commands too. A block
`python` runs, and a block `text` that follows it has the first lines that it prints.
"""

from __future__ import annotations

import io
import re
import runpy
import shlex
import sys
from contextlib import redirect_stdout
from pathlib import Path

import pytest

from tests.app.outcome import typed
from tests.page_scripts import printed

WIDTH = 80
"""Characters of the terminal of the pages."""
_BLOCK = re.compile(r"^```(console|toml|python|text)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
_REST = "..."


def run_page(page: str) -> str:
    """Run a page in the present folder.

    Args:
        page: Its text.

    Returns:
        The text with the first lines that commands and programs print now, as many as it has.
    """
    shown: str | None = None

    def renewed(block: re.Match[str]) -> str:
        nonlocal shown
        kind, text = block[1], block[2]
        if kind == "text":
            if shown is None:
                return block[0]
            text, shown = "\n".join(_first_lines(shown, text.splitlines())) + "\n", None
            return f"```text\n{text}```"
        shown = None
        if kind == "console":
            return f"```console\n{_typed(text)}```"
        if kind == "python":
            shown = printed(text, "page")
        elif name := re.match(r"# (\S+\.toml)\n", text):
            _write(Path(name[1]), text)
        return block[0]

    return _BLOCK.sub(renewed, page)


def _typed(block: str) -> str:
    lines = []
    for step in re.findall(r"^\$ .*\n(?:(?!\$ ).*\n)*", block, re.MULTILINE):
        command, *shown = step.splitlines()
        lines += [command, *_first_lines(_output(command), shown)]
    return "".join(f"{line}\n" for line in lines)


def _output(command: str) -> str:
    """Standard output of the library's command, or of a script of the examples, which ends as the page says."""
    program, *words = shlex.split(command.removeprefix("$ "), comments=True)
    if program == "python":
        return _script_output(words)
    assert program == "forcetorque", command
    done = typed(*words, columns=WIDTH)
    code = re.search(r"# exit code (\d+)$", command)
    assert done.code == (int(code[1]) if code else 0), f"{command}\n{done.out}{done.err}"
    return done.out


def _script_output(words: list[str]) -> str:
    output = io.StringIO()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(output):
        patch.setattr(sys, "argv", words)
        runpy.run_path(words[0], run_name="__main__")
    return output.getvalue()


def _first_lines(output: str, shown: list[str]) -> list[str]:
    """As many lines of an output as a page shows; all of them where it shows no `...`, or only that."""
    lines = [line.rstrip() for line in output.splitlines()]
    if not shown or (shown[-1] == _REST and len(shown) - 1 >= len(lines)) or shown == [_REST]:
        return lines if shown else []
    return [*lines[: len(shown) - 1], _REST] if shown[-1] == _REST else lines


def _write(file: Path, text: str) -> None:
    """Write a file of the page, or answer the questions of one that a command made."""
    if not file.exists():
        file.write_text(text, encoding="utf-8")
        return
    content = file.read_text(encoding="utf-8")
    for line in text.splitlines()[1:]:
        key, equals, _ = line.partition(" = ")
        if equals:
            content, count = re.subn(rf'\b{key} = "\?"', lambda _, line=line: line.split("  #")[0], content, count=1)
            assert count == 1, f"{file}: nothing asks for {key}"
    file.write_text(content, encoding="utf-8")
