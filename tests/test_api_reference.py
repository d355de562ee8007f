# SPDX-License-Identifier: BSD-3-Clause
"""The API reference has every public name with its docstring, and `make docs` builds without a warning."""

from __future__ import annotations

import re
import subprocess
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

from docs.site.definitions import definition
from docs.site.layout import lay_out
from docs.site.reference import CLASSES, documented_modules, doors, pages

ROOT = Path(__file__).resolve().parents[1]
LIBRARY = ROOT / "src"


@cache
def _pages() -> dict[str, str]:
    """Written when first asked for: who only collects tests need not wait."""
    return dict(pages())


def _packages_with_a_door() -> set[str]:
    """As the files have it, without importing them."""
    found = [path for path in LIBRARY.rglob("__init__.py") if "__all__" in path.read_text(encoding="utf-8")]
    return {".".join(path.parent.relative_to(LIBRARY).parts) for path in found}


def test_every_package_that_offers_names_has_a_page() -> None:
    """Beside them, the errors, and modules that the pages for users import from."""
    assert _packages_with_a_door() > {"forcetorque", "forcetorque.evaluation"}
    of_doors = {name for name in _pages() if not name.startswith(f"{CLASSES}/")}
    assert of_doors == doors().keys()
    assert of_doors == _packages_with_a_door() | {"forcetorque.base.errors", *documented_modules()}
    assert len(documented_modules()) > 40


def test_every_class_has_a_page_that_its_door_lists() -> None:
    """So that no page is as long as the classes of a package together."""
    of_classes = {name for name in _pages() if name.startswith(f"{CLASSES}/")}
    assert len(of_classes) > 200
    for name in of_classes:
        assert _pages()[name].count(".. autoclass:: ") == 1
    listed = [re.findall(rf"^   ({CLASSES}/\S+)$", _pages()[door], re.MULTILINE) for door in doors()]
    assert sorted(name for names in listed for name in names) == sorted(of_classes)
    assert not any(".. autoclass:: " in _pages()[door] for door in doors())


def test_every_name_is_told_once() -> None:
    """On one page with its docstring; other pages that offer it point there."""
    told: list[str] = []
    for door, page in _pages().items():
        told += re.findall(r"^\.\. auto(?:class|function):: (\S+)$", page, re.MULTILINE)
        told += [f"{door}.{name}" for name in re.findall(r"^\.\. py:data:: (\w+)\n   :module: ", page, re.MULTILINE)]
    assert len(told) == len(set(told)) > 450
    pointed = {name for page in _pages().values() for name in re.findall(r"<(forcetorque\.\S+)>`: ", page, re.M)}
    assert pointed < set(told)
    for door, names in doors().items():
        for name in names:
            shown = re.search(rf":: (?:{re.escape(door)}\.)?{name}$|^- :py:obj:`{name} <", _pages()[door], re.MULTILINE)
            assert shown, f"{door}.{name}"


def test_every_public_name_has_a_docstring() -> None:
    """Also constants and aliases: the text that follows them."""
    bare = [
        f"{door}.{name}" for door, names in doors().items() for name in names if not definition(door, name).docstring
    ]
    assert bare == []


def test_imports_are_followed_to_the_definition() -> None:
    """Through packages, and through imports that only types see; what is nowhere is an error."""
    found = definition("forcetorque", "Calibration")
    assert (found.module, found.kind) == ("forcetorque.experiment.calibration.calibration_file", "class")
    constant = definition("forcetorque.evaluation.load_cases.load_case", "ALLOWED_SHARE")
    assert (constant.kind, float(constant.value)) == ("data", pytest.approx(0.05))
    with pytest.raises(LookupError, match=r"forcetorque\.robot\.RoboModel"):
        definition("forcetorque.robot", "RoboModel")


def test_pages_that_are_no_more_public_go(tmp_path: Path) -> None:
    """A second layout leaves what is unchanged, and nothing of a package that is gone."""
    lay_out(tmp_path)
    kept, gone = tmp_path / "api" / "forcetorque.rst", tmp_path / "api" / "forcetorque.gone.rst"
    gone.touch()
    before = kept.stat().st_mtime_ns
    lay_out(tmp_path)
    assert not gone.exists()
    assert kept.stat().st_mtime_ns == before
    assert (tmp_path / "docs" / "README.md").is_file()


@pytest.mark.long
@pytest.mark.skipif(find_spec("sphinx") is None, reason="Sphinx is not installed; `make docs` installs it")
def test_the_documentation_builds_without_a_warning(tmp_path: Path) -> None:
    """Links of pages lead to pages, and every door is in the sidebar."""
    lay_out(tmp_path / "pages")
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "--quiet", "--fail-on-warning", "--keep-going"]
        + ["-c", str(ROOT / "docs" / "site"), str(tmp_path / "pages"), str(tmp_path / "html")],
        capture_output=True,
        text=True,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    index = (tmp_path / "html" / "index.html").read_text(encoding="utf-8")
    assert all(f'href="api/{door}.html"' in index for door in _pages())
    use = (tmp_path / "html" / "docs" / "planning.html").read_text(encoding="utf-8")
    assert 'href="use.html#how-often-it-is-right"' in use
