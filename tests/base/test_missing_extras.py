# SPDX-License-Identifier: BSD-3-Clause
"""What needs an optional package that is absent ends with the line to type, and the extra that it names exists."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

import pytest

from forcetorque.base.errors import install_line
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET

ROOT = Path(__file__).resolve().parents[2]
EXTRAS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]


_NAMES_EXTRA = r"(?:install_line\(|needs_extra\([^\n]*, )['\"]([\w-]+)['\"]\)"


def _named_extras() -> set[str]:
    """Extras that errors of the library name."""
    texts = (path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.py"))
    return {name for text in texts for name in re.findall(_NAMES_EXTRA, text)}


def test_errors_name_extras_that_exist() -> None:
    """Each extra that users may lack is named somewhere, and nothing else is."""
    runtime = EXTRAS.keys() - {"all", "docs", "test", "test-long"}
    assert _named_extras() == runtime


def test_the_line_to_type_is_written_in_one_place() -> None:
    """In quotes, as shells that expand brackets need it."""
    assert install_line("ros") == "pip install 'forcetorque[ros]'"
    bare = [path for path in (ROOT / "src").rglob("*.py") if "pip install forcetorque[" in path.read_text("utf-8")]
    assert bare == []


def _hide(package: str, patch: pytest.MonkeyPatch) -> None:
    """Make a package look as if it were not installed, also where it was imported before."""
    for name in [package, *(name for name in sys.modules if name.startswith(f"{package}."))]:
        patch.setitem(sys.modules, name, None)


@pytest.mark.parametrize(
    ("package", "extra", "words"),
    [
        ("rosbags", "ros", ("inspect", "log.mcap")),
        ("h5py", "hdf5", ("inspect", "log.h5")),
        ("matplotlib", "report", ("report", PARQUET, "-o", "report.html")),
        ("jinja2", "report", ("report", PARQUET, "-o", "report.html")),
        ("fpdf", "report", ("report", PARQUET, "-o", "report.pdf")),
    ],
)
def test_a_command_without_its_extra_is_refused_with_the_line(
    package: str, extra: str, words: tuple[str, ...], arm: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One line, exit code 2."""
    (arm / "log.mcap").write_bytes(b"\x89MCAP0\r\n" + bytes(64))
    (arm / "log.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(64))
    monkeypatch.chdir(arm)
    _hide(package, monkeypatch)
    error = run(*words).error()
    assert re.search(rf"pip install 'forcetorque\[{extra}\]'", error), error
