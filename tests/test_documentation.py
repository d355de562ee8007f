# SPDX-License-Identifier: BSD-3-Clause
"""Pages lead where they say: every link has its file and its heading, every page is reached from the index."""

from __future__ import annotations

import ast
import inspect
import re
from collections import Counter
from importlib import import_module
from pathlib import Path

import pytest
import typer

import forcetorque
from forcetorque.app.command_line import whole_program
from forcetorque.app.python.experiment import Experiment
from forcetorque.app.python.run import Run
from tests.app.commands import typed_commands

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = sorted(path.parent.name for path in Path(forcetorque.__file__).parent.glob("*/__init__.py"))
HOLDERS = {
    **{name: import_module(f"forcetorque.{name}") for name in PACKAGES},
    "forcetorque": forcetorque,
    "experiment": Experiment,
    "run": Run,
}
"""What the lines of the page on Python call: an experiment, a sensor of it, the library and its packages."""
INDEX = ROOT / "docs" / "README.md"
PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").glob("*.md")])
every_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())


def _prose(text: str) -> str:
    """A page without code, in which brackets and hashes mean other things."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^    .*$", "", text, flags=re.MULTILINE))


def _links(page: Path) -> list[str]:
    """Targets of links and pictures that are no addresses of the web."""
    targets = re.findall(r"\]\(([^)\s]+)\)", _prose(page.read_text(encoding="utf-8")))
    return [target for target in targets if not re.match(r"[a-z]+:", target)]


def _anchors(page: Path) -> set[str]:
    """Names that GitHub gives to headings: lower case, no punctuation, hyphens for spaces, and numbers for repeats."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    count: Counter[str] = Counter()
    names = set()
    for heading in re.findall(r"^#+ +(.+)$", text, re.MULTILINE):
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        names.add(f"{name}-{count[name]}" if count[name] else name)
        count[name] += 1
    return names


def _broken(page: Path) -> list[str]:
    """Links of a page whose file or heading is not there."""
    broken = []
    for link in _links(page):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists() or (anchor and anchor not in _anchors(target)):
            broken.append(link)
    return broken


@every_page
def test_every_link_leads_somewhere(page: Path) -> None:
    """The file is there, and in it the heading."""
    assert _broken(page) == []


def test_pages_are_looked_at() -> None:
    """The tests here see pages, links and anchors."""
    assert {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"} <= {page.name for page in PAGES}
    links = [link for page in PAGES for link in _links(page)]
    assert len(links) > 60
    assert sum("#" in link for link in links) > 3


def test_a_broken_link_is_noticed(tmp_path: Path) -> None:
    """Negative control: a missing file, a missing heading here and there; code is no link."""
    (tmp_path / "other.md").write_text("# Its `one` heading, twice\n## Its one heading, twice\n", encoding="utf-8")
    page = tmp_path / "page.md"
    page.write_text(
        "# Here\n[a](other.md) [b](#here) [c](other.md#its-one-heading-twice) [d](other.md#its-one-heading-twice-1)\n"
        "[e](none.md) [f](#there) [g](other.md#its-one) [h](https://example.org/none)\n\n    x[i](none.md)\n",
        encoding="utf-8",
    )
    assert _broken(page) == ["none.md", "#there", "other.md#its-one"]


def test_every_page_is_in_the_index() -> None:
    """Nobody has to know the name of a page to find it, and the README leads to the index."""
    linked = {(INDEX.parent / link.partition("#")[0]).resolve() for link in _links(INDEX)}
    assert set(PAGES) - linked == {INDEX}
    assert "docs/README.md" in _links(ROOT / "README.md")


def test_every_page_is_in_the_sidebar() -> None:
    """What is not would be a warning of `make docs`, which is an error."""
    sidebar = (ROOT / "docs" / "site" / "index.rst").read_text(encoding="utf-8").split()
    pages = {page.relative_to(ROOT).with_suffix("").as_posix() for page in (ROOT / "docs").rglob("*.md")}
    pages -= {"docs/README"}
    assert pages <= set(sidebar)


def test_every_example_is_on_their_page() -> None:
    """Each with a line on what it shows."""
    page = ROOT / "examples" / "README.md"
    linked = {(page.parent / link).resolve() for link in _links(page)}
    assert {path for path in page.parent.iterdir() if path.is_file()} == linked | {page}


def test_the_index_says_when_to_take_every_command() -> None:
    """Each stands in its table."""
    _, _, table = INDEX.read_text(encoding="utf-8").partition("## Which command when")
    named = set(re.findall(r"`([a-z]+(?:[ -][a-z]+)*)`", table.partition("\n## ")[0]))
    assert named == set(typed_commands(whole_program()))


def _absent(code: str) -> list[str]:
    """Calls of a line of Python whose name is in none of the things that the page on Python has."""
    called = re.findall(rf"(?<![\w\"])({'|'.join(HOLDERS)})\.(\w+)", code)
    return [f"{holder}.{name}" for holder, name in called if not hasattr(HOLDERS[holder], name)]


def _python_lines(program: typer.Typer, group: str = "") -> dict[str, str]:
    """What stands behind `Python:` in the help of every command."""
    lines = {}
    for command in program.registered_commands:
        _, _, text = inspect.getdoc(command.callback).partition("\nPython: ")
        text = " ".join(text.partition("\n\n")[0].split())
        lines[f"{group}{command.name}"] = re.sub(r"(\w[\w ]*) \(docs/([\w./]+)\)", r"[\1](\2)", text)
    for added in program.registered_groups:
        assert added.typer_instance is not None
        lines |= _python_lines(added.typer_instance, f"{added.typer_instance.info.name} ")
    return dict(sorted(lines.items()))


def test_the_page_on_python_has_the_line_of_every_command(request: pytest.FixtureRequest) -> None:
    """Each names what is there. `pytest --write-snapshots` writes the table from the help of the commands."""
    page = ROOT / "docs" / "python.md"
    lines = _python_lines(whole_program())
    table = "| command | from Python |\n|---|---|\n" + "".join(
        f"| `{name}` | {line} |\n" for name, line in lines.items()
    )
    before, head, after = page.read_text(encoding="utf-8").partition("| command | from Python |\n")
    rest = re.sub(r"\A(?:\|.*\n)+", "", after)
    if request.config.getoption("--write-snapshots"):
        page.write_text(before + table + rest, encoding="utf-8")
    assert page.read_text(encoding="utf-8") == before + table + rest
    assert head
    assert {command: _absent(line) for command, line in lines.items()} == dict.fromkeys(lines, [])
    assert all(re.search(rf"`({'|'.join(HOLDERS)})\.\w+", line) for line in lines.values())


def test_an_absent_question_is_noticed() -> None:
    """Negative control."""
    assert _absent('`run.accept("a.toml")`, `run.judge()`, `payload.weighed`') == ["run.judge", "payload.weighed"]


def _unknown_names(code: str) -> list[str]:
    """What a script imports of the library that is not there."""
    unknown = []
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "forcetorque":
            module = import_module(node.module or "")
            unknown += [alias.name for alias in node.names if not hasattr(module, alias.name)]
    return unknown


@every_page
def test_scripts_of_pages_import_what_is_there(page: Path) -> None:
    """Every Python block is Python, and knows the library by its present names."""
    for code in re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE):
        assert _unknown_names(code) == []


def test_an_unknown_name_is_noticed() -> None:
    """Negative control."""
    assert _unknown_names("from forcetorque import evaluate, evaluated") == ["evaluated"]
