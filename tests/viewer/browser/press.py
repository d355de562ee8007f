# SPDX-License-Identifier: BSD-3-Clause
"""Things that several tests do with the page."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page


def download(page: Page, button: str) -> tuple[str, bytes]:
    """Press a button, and give name and content of the file that the page offers."""
    with page.expect_download() as offer:
        page.get_by_role("button", name=button).click()
    return offer.value.suggested_filename, Path(offer.value.path()).read_bytes()


def wait_until(page: Page, happened: Callable[[], bool]) -> None:
    """Look again until something has happened; the page's policy lets no text be run, so it cannot look by itself."""
    for _ in range(600):
        if happened():
            return
        page.wait_for_timeout(50)
    raise AssertionError("it did not happen within 30 s")


def wait_for_drawing(page: Page) -> None:
    """Let the page draw what has changed; it does so in the next frame of the browser."""
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def picture(page: Page, name: str) -> str:
    """What a view shows, as the address of a PNG."""
    address = page.get_by_role("img", name=name).first.evaluate("canvas => canvas.toDataURL()")
    assert address.startswith("data:image/png")
    return str(address)
