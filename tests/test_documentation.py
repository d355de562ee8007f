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
from forcetorque.app.run.result import ExitCode
from forcetorque.results.capability import capabilities
from tests.app.added_command import added_command
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
LLMS = ROOT / "docs" / "llms.txt"
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


def _listed(text: str) -> list[tuple[str, str, str]]:
    """Title, target and line of every link of a file of the form llms.txt."""
    return re.findall(r"^- \[(.+)\]\((\S+)\): (.+)$", text, re.MULTILINE)


def test_llms_txt_has_every_page_once() -> None:
    """Title as on the page, a line of its own; above the sections the name and a summary, as the convention has it."""
    text = LLMS.read_text(encoding="utf-8")
    head, *sections = re.split(r"^## .+\n", text, flags=re.MULTILINE)
    assert re.match(r"# forcetorque\n\n> \S", head)
    assert len(sections) >= 4
    assert all(_listed(section) and len(_listed(section)) == section.count("\n- ") for section in sections)
    targets = Counter((LLMS.parent / target).resolve() for _, target, _ in _listed(text))
    assert targets == Counter(PAGES)
    titles = {path: path.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ") for path in PAGES}
    listed = {(LLMS.parent / target).resolve(): title for title, target, _ in _listed(text)}
    assert listed == titles


def _named(page: str) -> set[str]:
    """What stands between backquotes and could be a command; options and files are none."""
    return set(re.findall(r"`(?:forcetorque )?([a-z]+(?:[ -][a-z]+)*)`", page))


def test_the_page_for_agents_names_every_command_and_exit_code() -> None:
    """So that a program finds what there is without a list of its own."""
    page = (ROOT / "docs" / "agents.md").read_text(encoding="utf-8")
    assert set(typed_commands(whole_program())) - _named(page) == set()
    codes = page.partition("## Exit codes")[2].partition("\n## ")[0]
    assert re.findall(r"^\| (\d) \|", codes, re.MULTILINE) == [str(code) for code in sorted([*map(int, ExitCode), 2])]
    with added_command():  # negative control
        assert set(typed_commands(whole_program())) - _named(page) == {"extent"}


def _with_pages(sidebar: str, pages: set[str]) -> str:
    """The sidebar with the pages that it lacks below those of commands."""
    missing = sorted(pages - set(sidebar.split()) - {"docs/README"})
    head, title, rest = sidebar.partition("   :caption: Which command when\n")
    assert title
    listed, end, after = rest.partition("\n\n.. toctree::")
    return f"{head}{title}{listed}" + "".join(f"\n   {page}" for page in missing) + end + after


def test_every_page_is_in_the_sidebar(request: pytest.FixtureRequest) -> None:
    """What is not would be an error of `make docs`. `pytest --write-snapshots` adds a page among those of commands."""
    sidebar = ROOT / "docs" / "site" / "index.rst"
    text = sidebar.read_text(encoding="utf-8")
    pages = {page.relative_to(ROOT).with_suffix("").as_posix() for page in (ROOT / "docs").rglob("*.md")}
    if request.config.getoption("--write-snapshots"):
        sidebar.write_text(_with_pages(text, pages), encoding="utf-8")
    assert sidebar.read_text(encoding="utf-8") == _with_pages(text, pages)


def test_a_page_that_the_sidebar_lacks_is_added() -> None:
    """Behind the last page of commands; the others stay where they are."""
    text = ".. toctree::\n   :caption: Which command when\n\n   docs/a\n\n.. toctree::\n\n   docs/b\n"
    assert _with_pages(text, {"docs/a", "docs/b", "docs/README"}) == text
    assert _with_pages(text, {"docs/a", "docs/toy"}) == text.replace("docs/a\n", "docs/a\n   docs/toy\n")


def test_every_example_is_on_their_page() -> None:
    """Each with a line on what it shows."""
    page = ROOT / "examples" / "README.md"
    linked = {(page.parent / link).resolve() for link in _links(page)}
    assert {path for path in page.parent.iterdir() if path.is_file()} == linked | {page}


def _help(program: typer.Typer, group: str = "") -> dict[str, str]:
    """Docstring of every command."""
    texts = {
        f"{group}{command.name}": inspect.getdoc(command.callback) or "" for command in program.registered_commands
    }
    for added in program.registered_groups:
        assert added.typer_instance is not None
        texts |= _help(added.typer_instance, f"{added.typer_instance.info.name} ")
    return dict(sorted(texts.items()))


def _commands_of(index: str) -> tuple[str, set[str]]:
    """The table of commands of the index, and the commands that it has."""
    _, _, table = index.partition("## Which command when")
    table = table.partition("\n\n## ")[0]
    return table, set(re.findall(r"`([a-z]+(?:[ -][a-z]+)*)`", table))


def _with_commands(index: str, program: typer.Typer) -> str:
    """The index with a row for every command that it lacks: sentence of its help, and page of its capability."""
    pages = {
        reference.partition(":")[2].replace("_", "-"): capability.page
        for capability in capabilities()
        for reference in capability.commands
    }
    table, named = _commands_of(index)
    rows = []
    for command, text in _help(program).items():
        if command not in named:
            page = pages[command.split()[0]]
            title = (INDEX.parent / page).read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")
            sentence = text.partition("\n")[0].rstrip(".")
            rows.append(f"\n| {sentence[:1].lower()}{sentence[1:]} | `{command}` | [{title}]({page}) |")
    return index.replace(table, table + "".join(rows))


def test_the_index_says_when_to_take_every_command(request: pytest.FixtureRequest) -> None:
    """Each stands in its table, which leads to the page of every capability. `pytest --write-snapshots` adds rows."""
    program, text = whole_program(), INDEX.read_text(encoding="utf-8")
    if request.config.getoption("--write-snapshots"):
        INDEX.write_text(_with_commands(text, program), encoding="utf-8")
    assert INDEX.read_text(encoding="utf-8") == _with_commands(text, program)
    table, named = _commands_of(text)
    assert named == set(typed_commands(program))
    assert [one.page for one in capabilities() if f"({one.page})" not in table] == []


def test_a_command_that_the_index_lacks_is_added() -> None:
    """As the last row of the table, from the line of its capability and its help; what stands there stays."""
    text = INDEX.read_text(encoding="utf-8")
    with added_command():
        written = _with_commands(text, whole_program())
    row = "| show how long sensors were logged | `extent` | [Recordings and experiment files](recording.md) |\n"
    assert row in written
    assert written.replace(row, "") == text
    assert _commands_of(written)[1] - _commands_of(text)[1] == {"extent"}


def _absent(code: str) -> list[str]:
    """Calls of a line of Python whose name is in none of the things that the page on Python has."""
    called = re.findall(rf"(?<![\w\"])({'|'.join(HOLDERS)})\.(\w+)", code)
    return [f"{holder}.{name}" for holder, name in called if not hasattr(HOLDERS[holder], name)]


def _python_lines(program: typer.Typer) -> dict[str, str]:
    """What stands behind `Python:` in the help of every command."""
    lines = {}
    for command, text in _help(program).items():
        line = " ".join(text.partition("\nPython: ")[2].partition("\n\n")[0].split())
        lines[command] = re.sub(r"(\w[\w ]*) \(docs/([\w./]+)\)", r"[\1](\2)", line)
    return lines


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
