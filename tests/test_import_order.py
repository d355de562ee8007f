# SPDX-License-Identifier: BSD-3-Clause
"""The packages import only from those before them, as the architecture has it."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import forcetorque

ORDER = (
    "spatial",
    "result",
    "noise",
    "robot",
    "recording",
    "sensor",
    "skin",
    "estimation",
    "calibration",
    "loads",
    "evaluation",
    "study",
    "simulation",
    "exsitu",
    "exchange",
    "experiment",
    "analysis",
    "viewer",
    "report",
    "interactive",
    "live",
    "fleet",
    "cli",
)
ROOT = Path(forcetorque.__file__).parent
LEAVES = {path.stem for path in ROOT.glob("*.py")} - {"__init__", "__main__"}
"""Single modules beside the packages, such as errors: anyone may import them, they import no package."""


@cache
def _nodes(path: Path) -> tuple[ast.AST, ...]:
    """All of a file; it is parsed once for all that is asked of it."""
    return tuple(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))


def _imports(path: Path) -> set[str]:
    """Names of the library's packages and modules that a file imports."""
    found = set()
    for node in _nodes(path):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "forcetorque":
            parts = node.module.split(".")[1:]
            found |= {parts[0]} if parts else {alias.name for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {a.name.split(".")[1] for a in node.names if a.name.startswith("forcetorque.")}
    return found


def _violations(package: str, imported: set[str]) -> set[str]:
    allowed = set(ORDER[: ORDER.index(package) + 1]) | LEAVES
    return imported - allowed


FILES = sorted(path for path in ROOT.rglob("*.py") if path.parent != ROOT)
PACKAGES = sorted({path.relative_to(ROOT).parts[0] for path in FILES})


def _files(package: str) -> list[Path]:
    return [path for path in FILES if path.relative_to(ROOT).parts[0] == package]


def test_there_are_packages() -> None:
    """The test below looks at something, and every package has its place in the order."""
    assert len(FILES) > 30
    assert set(PACKAGES) <= set(ORDER)


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_go_to_earlier_packages(package: str) -> None:
    """A file imports its own package, earlier ones, and single modules."""
    against = {path: _violations(package, _imports(path)) for path in _files(package)}
    assert {path: names for path, names in against.items() if names} == {}


@pytest.mark.parametrize("name", sorted(LEAVES))
def test_single_modules_import_no_package(name: str) -> None:
    """Single modules are below every package."""
    assert _imports(ROOT / f"{name}.py") <= LEAVES


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


@pytest.mark.parametrize("path", sorted((ROOT / "cli").rglob("*.py")), ids=lambda path: path.name)
def test_the_command_line_computes_nothing(path: Path) -> None:
    """Commands parse, call and show: they import no library that computes or describes results."""
    assert not _outside(path) & COMPUTING


def test_a_number_in_the_command_line_is_noticed(tmp_path: Path) -> None:
    """Negative control: an import inside a function counts."""
    file = tmp_path / "command.py"
    file.write_text("def run():\n    import numpy.linalg\n", encoding="utf-8")
    assert _outside(file) & COMPUTING == {"numpy"}


def test_a_later_package_is_noticed() -> None:
    """Negative control: an import against the order is a violation."""
    assert _violations("recording", {"spatial", "errors", "calibration"}) == {"calibration"}


def _questions() -> dict[str, set[str]]:
    """Of every question in `analysis`, a file or a folder, the others that it imports."""
    graph: dict[str, set[str]] = {}
    for path in _files("analysis"):
        question = path.relative_to(ROOT / "analysis").with_suffix("").parts[0]
        modules = [node.module for node in _nodes(path) if isinstance(node, ast.ImportFrom) and node.module]
        others = {name.split(".")[2] for name in modules if name.startswith("forcetorque.analysis.")}
        if question != "__init__":
            graph.setdefault(question, set()).update(others - {question})
    return graph


def test_questions_do_not_import_each_other_in_circles() -> None:
    """A question may ask another, but not be asked by it; all stand on `runs`, which asks none."""
    questions = _questions()
    assert list(TopologicalSorter(questions).static_order())
    assert questions["runs"] == set()
    assert sum("runs" in others for others in questions.values()) > 15


def test_a_circle_of_questions_is_noticed() -> None:
    """Negative control: calibrating asks what was weighed, so weighing may not calibrate."""
    questions = _questions()
    questions["payload"].add("calibration")
    with pytest.raises(CycleError):
        TopologicalSorter(questions).prepare()


DISTRIBUTIONS = {
    "PIL": "pillow",
    "fpdf": "fpdf2",
    "icub_models": "icub-models",
    "pydantic_core": "pydantic",
    "sklearn": "scikit-learn",
}
"""Distribution of an importable name, where they differ."""

PROJECT = tomllib.loads((ROOT.parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
DEVELOPMENT = {"test", "docs"}
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
    """Distributions that these nodes import."""
    imported = set()
    for node in nodes:
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
    assert set().union(*(_foreign(_nodes(path)) for path in _sources())) == declared


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


@pytest.mark.parametrize("package", [name for name in PACKAGES if ORDER.index(name) < ORDER.index("report")])
def test_nothing_below_report_prints_or_reads_the_clock(package: str) -> None:
    """Results and time stamps are the command line's business."""
    called = {
        (path, ast.unparse(node.func))
        for path in _files(package)
        for node in _nodes(path)
        if isinstance(node, ast.Call)
    }
    assert called
    reading = ("datetime.now", "date.today", "time.time", "perf_counter")
    assert {(path, name) for path, name in called if name in PRINTING or name.endswith(reading)} == set()
