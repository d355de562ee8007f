# SPDX-License-Identifier: BSD-3-Clause
"""Things that several tests do with the page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page


def download(page: Page, button: str) -> tuple[str, bytes]:
    """Press a button, and give name and content of the file that the page offers."""
    with page.expect_download() as offer:
        page.get_by_role("button", name=button).click()
    return offer.value.suggested_filename, Path(offer.value.path()).read_bytes()


def picture(page: Page, name: str) -> str:
    """What a view shows, as the address of a PNG."""
    address = page.get_by_role("img", name=name).first.evaluate("canvas => canvas.toDataURL()")
    assert address.startswith("data:image/png")
    return str(address)
