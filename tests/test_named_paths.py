# SPDX-License-Identifier: BSD-3-Clause
"""Files, modules and make targets that pages name exist, or a command on the page writes them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(
    [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), ROOT / "docs" / "llms.txt", *(ROOT / "examples").glob("*.*")]
)
NAMED = re.compile(
    r"(?<![\w./~-])(?:\./)?((?:docs|examples|tests|benchmarks|src|web)/(?:[\w.*?/-]|\[\w+\])*(?:[\w*/]|\[\w+\]))"
)
BUILT = re.compile(r"(?<![\w./~-])(build/[\w./*-]*\w)")
MODULE = re.compile(r"python -m ((?:tests|benchmarks|docs)(?:\.\w+)+)")
TARGET = re.compile(r"`make ([a-z][\w-]*)|^(?: {4}|\$ )make ([a-z][\w-]*)", re.MULTILINE)
WRITES = r"(?:-o|--output|--figure|--json|demo|examples/\S+\.py|\S+\.png|save\(|Path\()"
MADE_BY_MAKE = {"demo": "build/demo", "docs": "build/docs", "bench": "build/benchmarks"}
"""Folder that each target fills."""


def _absent(text: str) -> list[str]:
    """What a page names that neither exists nor is written."""
    absent = [path for path in NAMED.findall(text) if not _exists(path)]
    absent += [name for name in MODULE.findall(text) if not _is_module(name)]
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = [first or second for first, second in TARGET.findall(text)]
    absent += [f"make {target}" for target in targets if not re.search(rf"^{target}:", makefile, re.MULTILINE)]
    return absent + [path for path in BUILT.findall(text) if not _is_built(path, text)]


def _exists(path: str) -> bool:
    """Whether a path, or a pattern of paths, is there."""
    if re.search(r"[*?\[]", path):
        return any(ROOT.glob(path.rstrip("/")))
    return (ROOT / path).exists()


def _is_module(name: str) -> bool:
    path = ROOT / name.replace(".", "/")
    return path.with_suffix(".py").exists() or (path / "__main__.py").exists()


def _is_built(path: str, text: str) -> bool:
    """Whether a target of make fills a folder above it, or a command on the page writes there."""
    folders = [str(folder) for folder in (Path(path), *Path(path).parents)]
    return bool(set(folders) & set(MADE_BY_MAKE.values())) or any(
        re.search(rf"{WRITES} ?\"?{re.escape(folder)}", text) for folder in folders if folder not in ("build", ".")
    )


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_what_a_page_names_is_there(page: Path) -> None:
    """From the root of the repository."""
    assert _absent(page.read_text(encoding="utf-8")) == []


def test_an_absent_path_is_noticed() -> None:
    """Negative control: a file, a pattern, a module, a target, and a result that no command writes."""
    text = "`examples/99_none.py` `docs/none*.md` `python -m tests.none` `make none` `build/none.json`"
    assert _absent(text) == ["examples/99_none.py", "docs/none*.md", "tests.none", "make none", "build/none.json"]
    assert _absent("`docs/README.md` `make demo` `build/demo/arm.urdf` forcetorque evaluate -o build/a.json") == []
