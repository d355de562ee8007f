# SPDX-License-Identifier: BSD-3-Clause
"""Lay out what Sphinx reads: copies of the repository's pages, side by side as on GitHub, and the API reference.

Usage: python -m docs.site.layout FOLDER
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from docs.site.reference import CLASSES, pages

ROOT = Path(__file__).resolve().parents[2]
FILES = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff", "LICENSE")
FOLDERS = ("docs", "examples")


def lay_out(folder: Path) -> None:
    """Fill a folder; what it holds of another time and is no longer there goes.

    Args:
        folder: The folder; made if it is not there.
    """
    reference = folder / "api"
    (reference / CLASSES).mkdir(parents=True, exist_ok=True)
    # copies and not links, which Sphinx would follow out of its folder; they keep their time
    for name in FILES:
        shutil.copy2(ROOT / name, folder)
    for name in FOLDERS:
        shutil.rmtree(folder / name, ignore_errors=True)
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("site", "__pycache__"))
    shutil.copy2(ROOT / "docs" / "site" / "index.rst", folder)
    written = {reference / f"{page}.rst": text for page, text in pages()}
    for stale in set(reference.rglob("*.rst")) - written.keys():
        stale.unlink()
    for path, text in written.items():
        # a page that stays the same keeps its time too, so that Sphinx need not read it again
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    lay_out(Path(sys.argv[1]))
