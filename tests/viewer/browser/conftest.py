# SPDX-License-Identifier: BSD-3-Clause
"""The viewer's page in a real browser."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.browser import Visit, _closed_at_the_end, chromium, close_after_folder, visit
from tests.viewer.browser.arm_scene import Arm, arm_scene
from tests.viewer.browser.opened import as_opened

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

__all__ = ["_closed_at_the_end", "chromium", "visit"]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(nextitem: pytest.Item | None) -> Generator[None]:
    """Leave no browser open to the tests of other folders."""
    try:
        yield
    finally:
        close_after_folder(nextitem, Path(__file__).parent)


@pytest.fixture(scope="session")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Arm:
    """The scene of most tests."""
    return arm_scene(tmp_path_factory.mktemp("arm"))


@pytest.fixture(scope="module")
def shared(chromium: Browser, arm: Arm, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Visit, Page]]:
    """That scene, opened once for several tests: a browser that draws by processor takes seconds."""
    visit = Visit(chromium, tmp_path_factory.mktemp("shared"))
    yield visit, visit.open(arm.built)
    visit.close()


@pytest.fixture
def page(shared: tuple[Visit, Page]) -> Iterator[Page]:
    """That scene as it was when it was opened, at its first sample."""
    yield from as_opened(*shared)


@pytest.fixture
def sample(page: Page) -> Callable[[], int]:
    """The sample that the page shows."""
    return lambda: int(page.evaluate("window.ft.sample()"))
