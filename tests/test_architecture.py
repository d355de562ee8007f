# SPDX-License-Identifier: BSD-3-Clause
"""The page for maintainers is true: its picture has the packages in their order, its recipes real files."""

from __future__ import annotations

import re
from pathlib import Path

from tests.test_import_order import KERNEL, NEEDS, ROOT as LIBRARY, TOP

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
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
        if not path.startswith(schemas) and not any((base / path).exists() for base in (LIBRARY, ROOT))
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
    modules = {path.stem for path in LIBRARY.rglob("*.py")} | {path.parent.name for path in LIBRARY.rglob("*.py")}
    texts = [path.read_text(encoding="utf-8") for path in LIBRARY.rglob("*.py")]
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


def test_every_recipe_names_the_test_that_follows_it() -> None:
    """The test is there, and says that it follows this page."""
    _, *recipes = re.split(r"^### To add ", PAGE, flags=re.MULTILINE)
    assert len(recipes) == 7
    for recipe in recipes:
        (test,) = set(re.findall(r"`(tests/[\w/]*test_add_\w+\.py)`", recipe))
        assert "recipe of docs/architecture.md" in (ROOT / test).read_text(encoding="utf-8")
