# SPDX-License-Identifier: BSD-3-Clause
"""A kernel, one folder per capability, a thin top: imports are as docs/architecture.md says, and that page is true."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

import forcetorque
from forcetorque.base.lazy import named
from forcetorque.results.capability import all_named

KERNEL = ("base", "recording", "robot", "formats", "experiment", "results")
"""What every capability stands on."""
TOP = ("report", "viewer", "app")
"""What shows capabilities to people."""
NEEDS = {name: set(import_module(f"forcetorque.{name}").CAPABILITY.needs) for name in sorted(forcetorque.CAPABILITIES)}
"""Capabilities, and the capabilities that each needs."""
SHOWS_ASSESSMENTS = {"report_blocks.py"}
"""Files of capabilities that make blocks of a report of what it assessed."""
ROOT = Path(forcetorque.__file__).parent


@cache
def _nodes(path: Path) -> tuple[ast.AST, ...]:
    """Module, imports, calls and constants of a file; it is parsed once for all that is checked of it."""
    kinds = ast.Module | ast.Import | ast.ImportFrom | ast.Call | ast.Constant
    return tuple(node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, kinds))


_NAMED = re.compile(r"forcetorque\.(\w+)[.\w]*:\w+")
"""A function or another object that is named as `module:name`, and imported when it is first needed."""


def _imports(path: Path) -> set[str]:
    """Names of the library's packages that a file imports, also for types only, inside functions, or as text."""
    found = set()
    for node in _nodes(path):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "forcetorque":
            parts = node.module.split(".")[1:]
            found |= {parts[0]} if parts else {alias.name for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {a.name.split(".")[1] for a in node.names if a.name.startswith("forcetorque.")}
        elif isinstance(node, ast.Constant) and (named := _NAMED.fullmatch(str(node.value))):
            found.add(named[1])
    return found


def _allowed(package: str) -> set[str]:
    if package in KERNEL:
        return set(KERNEL)
    if package in TOP:
        return {*KERNEL, *NEEDS, *TOP}
    return {*KERNEL, package, *NEEDS[package]}


def _violations(file: str, imported: set[str]) -> set[str]:
    """Packages that a file, by its path in the library, must not import."""
    package, name = file.split("/")[0], file.rpartition("/")[2]
    exempt = {"report"} if name in SHOWS_ASSESSMENTS else set()
    return imported - _allowed(package) - exempt


FILES = sorted(path for path in ROOT.rglob("*.py") if path.parent != ROOT)
PACKAGES = sorted({path.relative_to(ROOT).parts[0] for path in FILES})


def _files(package: str) -> list[Path]:
    return [path for path in FILES if path.relative_to(ROOT).parts[0] == package]


def test_there_are_packages() -> None:
    """The test below looks at something, and every package is in the kernel, a capability, or at the top."""
    assert len(FILES) > 30
    assert set(PACKAGES) == {*KERNEL, *NEEDS, *TOP}


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_go_where_they_may(package: str) -> None:
    """The kernel imports no capability, a capability only those that it needs."""
    against = {path: _violations(path.relative_to(ROOT).as_posix(), _imports(path)) for path in _files(package)}
    assert {path: names for path, names in against.items() if names} == {}


def test_what_a_capability_names_is_there() -> None:
    """Commands and sections of the experiment file are imported by their names."""
    references = [reference for kind in ("commands", "sections") for _, reference in all_named(kind)]
    assert len(references) > 30
    assert all(named(reference) is not None for reference in references)


def test_capabilities_need_each_other_in_no_circle() -> None:
    """What a capability needs does not need it; every need is used."""
    assert list(TopologicalSorter(NEEDS).static_order())
    used = {name: set().union(*(_imports(path) for path in _files(name))) for name in NEEDS}
    assert {name: needs - used[name] for name, needs in NEEDS.items()} == dict.fromkeys(NEEDS, set())


def test_an_import_that_is_a_text_is_noticed(tmp_path: Path) -> None:
    """Negative control: the function that reads an option is named, not imported; other texts are none."""
    file = tmp_path / "command.py"
    file.write_text('reads = "forcetorque.skin.layout:read_patch"\nhelp = "forcetorque.payload"\n', encoding="utf-8")
    assert _imports(file) == {"skin"}


def test_a_circle_of_needs_is_noticed() -> None:
    """Negative control: calibration needs payload, so payload may not need calibration."""
    circle = {**NEEDS, "payload": NEEDS["payload"] | {"calibration"}}
    with pytest.raises(CycleError):
        TopologicalSorter(circle).prepare()


def _module_graph(root: Path) -> dict[str, set[str]]:
    """Modules, but packages themselves, that each module imports: also for types only, and inside functions."""
    name_of = {path: ".".join(path.relative_to(root.parent).with_suffix("").parts) for path in root.rglob("*.py")}
    modules = {name for path, name in name_of.items() if path.name != "__init__.py"}
    graph: dict[str, set[str]] = {name: set() for name in modules}
    for path, name in name_of.items():
        if name in modules:
            for node in _nodes(path):
                if isinstance(node, ast.ImportFrom) and node.module:
                    graph[name] |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)} & modules
            graph[name].discard(name)
    return graph


def test_modules_import_each_other_in_no_circle() -> None:
    """Types included."""
    graph = _module_graph(ROOT)
    assert len(graph) > 300
    assert len(list(TopologicalSorter(graph).static_order())) == len(graph)


def test_a_circle_of_modules_is_noticed(tmp_path: Path) -> None:
    """Negative control: one for types only closes it."""
    (tmp_path / "library").mkdir()
    (tmp_path / "library" / "one.py").write_text("from library.two import Two\n", encoding="utf-8")
    text = "if TYPE_CHECKING:\n    from library.one import One\n"
    (tmp_path / "library" / "two.py").write_text(text, encoding="utf-8")
    with pytest.raises(CycleError):
        TopologicalSorter(_module_graph(tmp_path / "library")).prepare()


def test_a_forbidden_import_is_noticed() -> None:
    """Negative control: kernel upward, between capabilities, and to the top."""
    assert _violations("recording/stream.py", {"base", "calibration"}) == {"calibration"}
    assert _violations("skin/surface/rim.py", {"base", "calibration"}) == {"calibration"}
    assert _violations("sensor/gains/gains.py", {"report"}) == {"report"}


def test_the_top_imports_nothing_heavy() -> None:
    """`import forcetorque` loads no scientific library, and every public name is there when asked for."""
    code = (
        "import sys, forcetorque; heavy = {'numpy', 'scipy', 'pyarrow', 'pydantic'} & set(sys.modules); "
        "assert not heavy, heavy; assert all(hasattr(forcetorque, name) for name in forcetorque.__all__)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


COMPUTING = {"numpy", "scipy", "pyarrow", "pydantic"}
"""What the command line has no use for: numbers and forms are made below it."""


def _outside(path: Path) -> set[str]:
    """Names of what a file imports from elsewhere, wherever in it."""
    names = set()
    for node in _nodes(path):
        if isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module.split(".")[0])
        elif isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
    return names


COMMANDS = sorted(
    path
    for path in ROOT.rglob("*.py")
    if re.fullmatch(r"(?:\w+_)?commands?", path.stem) or path.parent.name == "commands"
)
"""Files of commands, by their names."""


@pytest.mark.parametrize("path", COMMANDS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_commands_compute_nothing(path: Path) -> None:
    """Commands parse, call and show: they import no library that computes or describes results."""
    assert not _outside(path) & COMPUTING


def test_commands_are_looked_at() -> None:
    """The test above runs over something."""
    assert len(COMMANDS) > 18


def test_a_number_in_a_command_is_noticed(tmp_path: Path) -> None:
    """Negative control: an import inside a function counts."""
    file = tmp_path / "command.py"
    file.write_text("def run():\n    import numpy.linalg\n", encoding="utf-8")
    assert _outside(file) & COMPUTING == {"numpy"}


DISTRIBUTIONS = {
    "PIL": "pillow",
    "fpdf": "fpdf2",
    "icub_models": "icub-models",
    "pydantic_core": "pydantic",
    "rerun": "rerun-sdk",
    "sklearn": "scikit-learn",
    "zenoh": "eclipse-zenoh",
}
"""Distribution of an importable name, where they differ."""

IMPORTED_BY_OTHERS = {"pycollada"}
"""Distributions that a dependency imports for us: trimesh, to read DAE."""

PROJECT = tomllib.loads((ROOT.parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
DEVELOPMENT = {"test", "test-long", "docs"}
"""Extras that the library itself never imports."""


def _distributions(requirements: list[str]) -> set[str]:
    return {re.split(r"[<>=!~ ;\[]", entry)[0] for entry in requirements}


def _at_import(node: ast.AST) -> Iterator[ast.AST]:
    """Nodes that run when the module is imported: all but those inside functions, and those for type checkers."""
    for child in ast.iter_child_nodes(node):
        is_for_types = isinstance(child, ast.If) and ast.unparse(child.test) == "TYPE_CHECKING"
        if not is_for_types and not isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            yield child
            yield from _at_import(child)


def _foreign(nodes: Iterable[ast.AST]) -> set[str]:
    """Distributions that these nodes import, or find by name because they hold data and no module."""
    imported = set()
    for node in nodes:
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "distribution":
            imported |= {argument.value for argument in node.args if isinstance(argument, ast.Constant)}
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        names += [node.module] if isinstance(node, ast.ImportFrom) and node.module else []
        imported |= {name.split(".")[0] for name in names}
    return {DISTRIBUTIONS.get(name, name) for name in imported - sys.stdlib_module_names - {"forcetorque"}}


def _sources() -> list[Path]:
    return sorted(ROOT.rglob("*.py"))


RUN_TIME = {
    name: _distributions(entries) for name, entries in EXTRAS.items() if name not in DEVELOPMENT and name != "all"
}


def test_every_import_is_a_declared_dependency() -> None:
    """The library imports only what it declares, and declares only what it imports."""
    declared = _distributions(PROJECT["dependencies"]).union(*RUN_TIME.values())
    assert set().union(*(_foreign(_nodes(path)) for path in _sources())) == declared - IMPORTED_BY_OTHERS


def test_a_bare_install_imports_every_module() -> None:
    """What an extra brings is imported only inside functions: without it every module can still be imported."""
    assert set().union(*(_foreign(_at_import(_nodes(path)[0])) for path in _sources())) <= _distributions(
        PROJECT["dependencies"]
    )


def test_the_extra_named_all_holds_every_run_time_extra() -> None:
    """`pip install forcetorque[all]` brings everything that the library may import."""
    (entry,) = EXTRAS["all"]
    assert entry == f"forcetorque[{','.join(sorted(RUN_TIME))}]"


def test_an_extra_imported_with_its_module_is_noticed() -> None:
    """Negative control: only an import inside a function waits until it is called."""
    inside, outside = "def fit():\n    import sklearn", "class Fit:\n    import sklearn"
    assert _foreign(_at_import(ast.parse(inside))) == set()
    assert _foreign(ast.walk(ast.parse(inside))) == _foreign(_at_import(ast.parse(outside))) == {"scikit-learn"}


PRINTING = {"print", "input"}
CLOCK = "results/result.py"
"""The one place that says when a result is made, for those who call analyses."""


@pytest.mark.parametrize("package", [name for name in PACKAGES if name not in TOP])
def test_nothing_below_the_top_prints_or_reads_the_clock(package: str) -> None:
    """Results and time stamps are the command line's business."""
    called = {
        (path, ast.unparse(node.func))
        for path in _files(package)
        for node in _nodes(path)
        if isinstance(node, ast.Call)
    }
    assert called
    reading = ("datetime.now", "date.today", "time.time", "perf_counter")
    called = {(path, name) for path, name in called if path.relative_to(ROOT).as_posix() != CLOCK}
    assert {(path, name) for path, name in called if name in PRINTING or name.endswith(reading)} == set()


REPOSITORY = Path(__file__).resolve().parents[1]
PAGE = (REPOSITORY / "docs" / "architecture.md").read_text(encoding="utf-8")
SUFFIXES = (".py", ".md", ".toml", ".html", ".ts")


def _floors(page: str) -> list[list[str]]:
    """Packages of the picture, floor by floor, from the lowest up; a floor may have several lines."""
    _, picture, *_ = page.split("```text\n")
    floors = re.split(r"^\+-+\+$", picture.split("```")[0], flags=re.MULTILINE)
    lines = [
        re.findall(r"^\|([\w ]+?)(?:   +(?:top|capabilities|kernel))? *\|", floor, re.MULTILINE) for floor in floors
    ]
    return [" ".join(names).split() for names in reversed(lines) if names]


def test_the_picture_has_every_package_on_its_floor() -> None:
    """Kernel, capabilities, top; from the top down and from left to right a package may need only what follows."""
    kernel, capabilities, top = _floors(PAGE)
    assert (set(kernel), set(capabilities), set(top)) == (set(KERNEL), set(NEEDS), set(TOP))
    after = {name: set(capabilities[k + 1 :]) for k, name in enumerate(capabilities)}
    assert {name: needs - after[name] for name, needs in NEEDS.items()} == dict.fromkeys(NEEDS, set())


def test_a_package_on_the_wrong_floor_is_noticed() -> None:
    """Negative control: floors are read from below, whatever the number of their lines."""
    page = (
        "```text\n+---+\n| app report      |   top\n+---+\n| skin |\n| sensor   |  capabilities\n+---+\n| base |\n```"
    )
    assert _floors(page) == [["base"], ["skin", "sensor"], ["app", "report"]]


def _absent(page: str) -> list[str]:
    """Files and folders that a page names in code, and that are neither in the library nor in the repository."""
    names = [name for name in re.findall(r"`([\w./<>*-]+)`", page) if "/" in name or name.endswith(SUFFIXES)]
    # of a file that is still to be written only the folder can be there
    paths = [name.rpartition("/")[0] if "<" in name else name for name in names]
    schemas = ("forcetorque/",)
    return [
        path
        for path in paths
        if not path.startswith(schemas) and not any((base / path).exists() for base in (ROOT, REPOSITORY))
    ]


def test_files_of_the_page_are_there() -> None:
    """Those of the recipes, of their tests, and of what is told beside them; names of schemas are no files."""
    assert len(re.findall(r"`[\w./<>-]+\.py`", PAGE)) > 30
    assert [name for name in _absent(PAGE) if name != "experiment.toml"] == []


def test_a_file_that_moved_is_noticed() -> None:
    """Negative control: a wrong name, and the folder of a file to be written."""
    assert _absent("`app/command_line.py` `app/comand_line.py` `formats/<format>.py` `format/<format>.py`") == [
        "app/comand_line.py",
        "format",
    ]


def _unknown(section: str) -> list[str]:
    """Plain names in code that are no module, folder, function, class, constant or field of the library."""
    modules = {path.stem for path in ROOT.rglob("*.py")} | {path.parent.name for path in ROOT.rglob("*.py")}
    texts = [path.read_text(encoding="utf-8") for path in ROOT.rglob("*.py")]
    defined = {name for text in texts for name in re.findall(r"^\s*(?:def|class) (\w+)", text, re.MULTILINE)}
    defined |= {
        name for text in texts for name in re.findall(r"^\s*([A-Za-z_]\w+)(?:: [^=\n]+)? = ", text, re.MULTILINE)
    }
    names = [name.rpartition(".")[2] for name in re.findall(r"`([\w.]+)`", section)]
    return [name for name in names if name not in modules | defined]


def test_modules_of_the_page_are_called_so() -> None:
    """Layout and nouns are described by the names that files and functions have now."""
    described = PAGE.split("\n## To add something\n")[0]
    names = " ".join(re.findall(r"`[\w.]+`", re.sub(r"`[\w.]+/[\w./]+`", "", described)))
    assert len(names.split()) > 12
    assert _unknown(names) == []


def test_a_module_of_another_name_is_noticed() -> None:
    """Negative control: the name of a module that there is, and one that nothing has."""
    assert _unknown("`trials` and `contest_trials`") == ["contest_trials"]


ROLES = {"_figure": "figures", "_answer": "answers", "_answers": "answers"}
"""Names of files of the page, by how the names of their functions end."""


def _in_other_files(references: Iterable[tuple[str, str]]) -> list[str]:
    """References `module:name` to what is in a file, or in a folder, of another name than that of its role."""
    return [reference for reference, role in references if role not in reference.partition(":")[0].split(".")]


def test_what_has_a_role_is_in_the_file_of_its_name() -> None:
    """Commands, sections, answers and figures: each has one name for its file in every capability."""
    nodes = (node for name in NEEDS for path in _files(name) for node in _nodes(path))
    texts = {str(node.value) for node in nodes if isinstance(node, ast.Constant)}
    texts = {text for text in texts if _NAMED.fullmatch(text)}
    named_by_results = [(text, role) for text in sorted(texts) for end, role in ROLES.items() if text.endswith(end)]
    assert {role for _, role in named_by_results} == set(ROLES.values())
    commands = [(reference, "commands") for _, reference in all_named("commands")]
    sections = [(reference, "section") for _, reference in all_named("sections")]
    assert len(commands) > 30
    assert len(sections) > 5
    assert _in_other_files([*commands, *sections, *named_by_results]) == []


def test_a_role_in_another_file_is_noticed() -> None:
    """Negative control: the same name as part of another one does not do."""
    assert _in_other_files([("forcetorque.a.figure:b_figure", "figures")]) == ["forcetorque.a.figure:b_figure"]
    assert _in_other_files([("forcetorque.a.figures.b:b_figure", "figures")]) == []


def test_every_recipe_names_the_test_that_follows_it() -> None:
    """The test is there, and says that it follows this page."""
    _, *recipes = re.split(r"^### To add ", PAGE, flags=re.MULTILINE)
    assert len(recipes) == 7
    for recipe in recipes:
        (test,) = set(re.findall(r"`(tests/[\w/]*test_add_\w+\.py)`", recipe))
        assert "recipe of docs/architecture.md" in (REPOSITORY / test).read_text(encoding="utf-8")
