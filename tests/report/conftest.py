# SPDX-License-Identifier: BSD-3-Clause
"""A browser for documents, closed after the last test of this folder."""

from __future__ import annotations

from collections.abc import Generator
from pathlib import Path

import pytest

from tests.browser import _closed_at_the_end, chromium, close_after_folder, visit

__all__ = ["_closed_at_the_end", "chromium", "visit"]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(nextitem: pytest.Item | None) -> Generator[None]:
    """Leave no browser open to the tests of other folders."""
    try:
        yield
    finally:
        close_after_folder(nextitem, Path(__file__).parent)
