# SPDX-License-Identifier: BSD-3-Clause
"""The packages import only from those before them, as the architecture has it."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import forcetorque

ORDER = (
    "spatial",
    "robot",
    "recording",
    "sensor",
    "estimation",
    "skin",
    "calibration",
    "evaluation",
    "study",
    "simulation",
    "exsitu",
    "exchange",
    "experiment",
    "viewer",
    "report",
    "live",
    "fleet",
    "cli",
)
ROOT = Path(forcetorque.__file__).parent
LEAVES = {path.stem for path in ROOT.glob("*.py")} - {"__init__", "__main__"}
"""Single modules beside the packages, such as errors: anyone may import them, they import no package."""


def _imports(path: Path) -> set[str]:
    """Names of the library's packages and modules that a file imports."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
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


def test_there_are_packages() -> None:
    """The test below looks at something, and every package has its place in the order."""
    assert len(FILES) > 30
    assert {path.relative_to(ROOT).parts[0] for path in FILES} <= set(ORDER)


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_go_to_earlier_packages(path: Path) -> None:
    """A file imports its own package, earlier ones, and single modules."""
    assert not _violations(path.relative_to(ROOT).parts[0], _imports(path))


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


def test_a_later_package_is_noticed() -> None:
    """Negative control: an import against the order is a violation."""
    assert _violations("recording", {"spatial", "errors", "calibration"}) == {"calibration"}


DISTRIBUTIONS = {"pydantic_core": "pydantic", "sklearn": "scikit-learn"}
"""Distribution of an importable name, where they differ."""
DEVELOPMENT = {"test", "docs"}
"""Extras of those who work on the library; nothing in it may need them."""


def _distributions(entries: list[str]) -> set[str]:
    """Names of requirements, without versions and markers; an extra that names others of ours names none itself."""
    return {re.split(r"[<>=!~ ;\[]", entry)[0] for entry in entries} - {"forcetorque"}


def _foreign(code: str) -> tuple[set[str], set[str]]:
    """Distributions that a file needs when it is imported, and those that it imports only in functions or for types."""
    at_import: set[str] = set()
    everywhere: set[str] = set()

    def look(node: ast.AST, *, deferred: bool) -> None:
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        names += [node.module] if isinstance(node, ast.ImportFrom) and node.module and not node.level else []
        found = {name.split(".")[0] for name in names} - sys.stdlib_module_names - {"forcetorque"}
        everywhere.update(found)
        if not deferred:
            at_import.update(found)
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            for child in node.body:
                look(child, deferred=True)
            for child in node.orelse:
                look(child, deferred=deferred)
            return
        inside = deferred or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        for child in ast.iter_child_nodes(node):
            look(child, deferred=inside)

    look(ast.parse(code), deferred=False)
    named = [{DISTRIBUTIONS.get(name, name) for name in names} for names in (at_import, everywhere - at_import)]
    return named[0], named[1]


def test_every_import_is_a_declared_dependency() -> None:
    """A bare install runs: what is not a dependency is in an extra, and then imported in functions alone."""
    project = tomllib.loads((ROOT.parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    dependencies = _distributions(project["dependencies"])
    optional = _distributions([e for name, entries in extras.items() if name not in DEVELOPMENT for e in entries])
    imported = [_foreign(path.read_text(encoding="utf-8")) for path in ROOT.rglob("*.py")]
    at_import = set().union(*(first for first, _ in imported))
    later = set().union(*(second for _, second in imported))
    assert at_import <= dependencies
    assert later <= dependencies | optional
    assert dependencies | optional == at_import | later
    assert not dependencies & optional


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("import numpy.linalg", ({"numpy"}, set())),
        ("def f():\n    from sklearn.svm import SVC", (set(), {"scikit-learn"})),
        ("if TYPE_CHECKING:\n    from matplotlib.axes import Axes", (set(), {"matplotlib"})),
        ("if TYPE_CHECKING:\n    pass\nelse:\n    import matplotlib", ({"matplotlib"}, set())),
        ("try:\n    import matplotlib\nexcept ImportError:\n    pass", ({"matplotlib"}, set())),
        ("class A:\n    import matplotlib", ({"matplotlib"}, set())),
        ("import os, forcetorque.spatial", (set(), set())),
    ],
)
def test_imports_in_functions_are_told_apart(code: str, expected: tuple[set[str], set[str]]) -> None:
    """Control of the test above: only functions and blocks for types put an import off."""
    assert _foreign(code) == expected


PRINTING = {"print", "input"}


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_nothing_below_report_prints_or_reads_the_clock(path: Path) -> None:
    """Results and time stamps are the command line's business."""
    package = path.relative_to(ROOT).parts[0]
    if ORDER.index(package) >= ORDER.index("report"):
        return
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call):
            name = ast.unparse(node.func)
            assert name not in PRINTING
            assert not name.endswith(("datetime.now", "date.today", "time.time", "perf_counter"))
