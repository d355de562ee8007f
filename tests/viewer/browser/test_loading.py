# SPDX-License-Identifier: BSD-3-Clause
"""The page opens from disk and needs nothing else."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from forcetorque.viewer.page import page_of
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser


def test_opens_without_a_network(visit: Visit, arm: Arm) -> None:
    """The file is all that is asked for; name, views and first sample are there when it says that it is ready."""
    page = visit.open(arm.built)
    assert page.evaluate("window.ft.ready") is True
    assert page.title() == "arm at the wall"
    assert page.get_by_role("heading", level=1).text_content() == "arm at the wall"
    assert page.get_by_role("img").count() == 6, "robot, space, three planes and the strip of intervals"
    assert page.get_by_label("Sample number").input_value() == "485", "the worst sample of the validation"
    assert [re.sub("#.*", "", url).startswith(("file:", "data:")) for url in visit.requests] == [True] * len(
        visit.requests
    )
    assert page.evaluate("document.documentElement.scrollHeight") <= 650, "everything fits without scrolling"


@pytest.mark.long
def test_nothing_else_may_be_asked_for(page: Page, shared: tuple[Visit, Page]) -> None:
    """The policy of the page refuses what is not itself, so the absence of requests is no accident."""
    refused = page.evaluate("fetch('http://192.0.2.1/').then(() => 'answered', error => String(error))")
    assert "Failed to fetch" in refused
    visit = shared[0]
    assert any("Content Security Policy" in error for error in visit.errors)
    visit.errors.clear()
    visit.requests.clear()


def test_page_names_no_other_machine(arm: Arm) -> None:
    """No address is loaded by the markup."""
    markup = re.sub(rb"<script.*?</script>", b"", page_of(arm.built), flags=re.DOTALL)
    markup = re.sub(rb"<!--.*?-->", b"", markup, flags=re.DOTALL)
    assert b"<script" not in markup
    assert not re.search(rb"""(src|href)=["']?http|url\(["']?http|@import""", markup)
