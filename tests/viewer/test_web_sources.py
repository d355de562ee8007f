# SPDX-License-Identifier: BSD-3-Clause
"""The sources of the page: no finding of the linter, and their own tests pass."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

WEB = Path(__file__).resolve().parents[2] / "web"


@pytest.mark.long
@pytest.mark.parametrize("script", ["lint", "types", "test"])
def test_sources_of_the_page(script: str) -> None:
    """As `make web-test` has it, where node is there and `npm ci` was run."""
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("npm is not installed")
    if not (WEB / "node_modules" / "oxlint").is_dir():
        pytest.skip("web/node_modules is absent or old: cd web && npm ci")
    done = subprocess.run([npm, "run", script], cwd=WEB, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    if script == "test":
        assert re.search(r"^# pass [1-9]", done.stdout, re.MULTILINE)
