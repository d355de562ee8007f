# SPDX-License-Identifier: BSD-3-Clause
"""A page that several tests share: each finds it as it was when it was opened."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tests.browser import Visit

if TYPE_CHECKING:
    from playwright.sync_api import Page

FIRST = """() => {
    document.activeElement.blur();
    for (const part of document.querySelectorAll("details")) part.open = part.closest(".notes") !== null;
    window.ft.reset();
    window.ft.show(0);
}"""
"""Brings a page back to what it showed first, and to the first sample."""


def as_opened(visit: Visit, page: Page) -> Iterator[Page]:
    """Give the page as it was, and see that no error came and nobody else was asked for anything meanwhile.

    Args:
        visit: What notes both.
        page: Its page.

    Yields:
        The page, at its first sample.
    """
    page.evaluate(FIRST)
    yield page
    errors, visit.errors = visit.errors, []  # the next test starts without them
    strangers, visit.requests = visit.strangers(), []
    assert errors == []
    assert strangers == []
