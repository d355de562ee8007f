# SPDX-License-Identifier: BSD-3-Clause
"""Options and fixtures that every test may use."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings

# the same examples in every run: a failure can be repeated, and a slow machine is no failure
settings.register_profile("reproducible", derandomize=True, deadline=None)
settings.load_profile("reproducible")

_DEFAULT_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let the caller say where the measured data are, and renew pictures of what commands show."""
    parser.addoption("--data", type=Path, default=_DEFAULT_DATA, help="folder of measured data")
    parser.addoption("--write-snapshots", action="store_true", help="take what commands show now as the pictures")


@pytest.fixture(scope="session")
def data_dir(request: pytest.FixtureRequest) -> Path:
    """Folder of measured data; tests that need it skip where it is absent."""
    folder = Path(request.config.getoption("--data")).resolve()
    if not folder.is_dir():
        pytest.skip(f"no measured data at {folder}; pass --data DIR")
    return folder
