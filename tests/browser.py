# SPDX-License-Identifier: BSD-3-Clause
"""A real browser without a window, in which pages are opened as a user would: fixtures for a conftest to name."""

from __future__ import annotations

import importlib.util
import shutil
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene_builder import BuiltScene

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SIZE = {"width": 1000, "height": 650}
PATIENCE_MS = 20_000
# a processor draws in place of a graphics card, the same on every machine of one kind; nothing is asked of the network
FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)

AXE = Path(__file__).resolve().parents[1] / "web/node_modules/axe-core/axe.min.js"
needs_axe = pytest.mark.skipif(not AXE.is_file(), reason="axe-core is not installed: run `npm ci` in web")
RUN_AXE = """() => axe.run({runOnly: {type: "tag", values:
    ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]}})"""


def violations(page: Page, fewest_rules: int) -> list[tuple[str, list[str]]]:
    """Give the rules of WCAG 2.2 AA and good practice that axe finds broken, and by what.

    Args:
        page: The page, at rest: axe fails where what it looks at is replaced meanwhile.
        fewest_rules: Number of rules that must find something to check.
    """
    page.evaluate(AXE.read_text(encoding="utf-8"))
    result: dict[str, list[dict[str, Any]]] = page.evaluate(RUN_AXE)
    assert len(result["passes"]) + len(result["violations"]) >= fewest_rules
    return [(rule["id"], [node["html"] for node in rule["nodes"]]) for rule in result["violations"]]


class OneBrowser:
    """The browser of the system, started when it is first wanted.

    While it lives, nothing else in this process may drive a browser or run a loop.
    """

    def __init__(self) -> None:
        self._open: ExitStack | None = None
        self._browser: Browser | None = None

    def get(self) -> Browser:
        """Give the browser, or skip the test where there is none."""
        if self._browser is None:
            if importlib.util.find_spec("playwright") is None:
                pytest.skip("playwright is not installed")
            program = next(filter(None, map(shutil.which, BROWSERS)), None)
            if program is None:
                pytest.skip(f"no browser: none of {', '.join(BROWSERS)} is installed")
            from playwright.sync_api import sync_playwright

            self._open = ExitStack()
            driver = self._open.enter_context(sync_playwright())
            self._browser = driver.chromium.launch(executable_path=program, args=list(FLAGS))
            self._open.callback(self._browser.close)
        return self._browser

    def close(self) -> None:
        """Close it if it is open."""
        if self._open is not None:
            self._open.close()
        self._open = self._browser = None


ONE = OneBrowser()


@pytest.fixture(scope="session")
def _closed_at_the_end() -> Iterator[None]:
    yield
    ONE.close()


@pytest.fixture(scope="module")
def chromium(_closed_at_the_end: None) -> Browser:
    """The browser of the system; modules of one folder share it, as it takes seconds to start."""
    return ONE.get()


def close_after_folder(nextitem: pytest.Item | None, folder: Path) -> None:
    """Close the browser if the next test is not in a folder: for the hook of its conftest."""
    if nextitem is None or not nextitem.path.is_relative_to(folder):
        ONE.close()


class Visit:
    """Pages of one test, and what went wrong in them."""

    def __init__(self, browser: Browser, folder: Path) -> None:
        self.folder = folder
        self.errors: list[str] = []
        self.requests: list[str] = []
        self._browser = browser
        self._contexts: list[Any] = []

    def open(self, built: BuiltScene) -> Page:
        """Open a scene as one file, without a network."""
        file = self.folder / f"view{len(self._contexts)}.html"
        file.write_bytes(page_of(built))
        return self.go(file.as_uri(), offline=True)

    def go(self, url: str, *, offline: bool = False) -> Page:
        """Open an address and wait until everything is drawn."""
        page = self.blank(offline=offline)
        page.goto(url)
        page.evaluate("window.ft.ready")
        return page

    def blank(self, *, offline: bool = True) -> Page:
        """A page that shows nothing yet."""
        context = self._browser.new_context(viewport=SIZE, offline=offline, accept_downloads=True)  # type: ignore[arg-type]
        self._contexts.append(context)
        context.set_default_timeout(PATIENCE_MS)
        page = context.new_page()
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda line: self.errors.append(line.text) if line.type == "error" else None)
        page.on("request", lambda request: self.requests.append(request.url))
        return page

    def close(self) -> None:
        """Close everything."""
        for context in self._contexts:
            context.close()

    def strangers(self) -> list[str]:
        """Requests that left the machine."""
        near = ("file:", "data:", "blob:", "http://127.0.0.1:")
        return [url for url in self.requests if not url.startswith(near)]


@pytest.fixture
def visit(chromium: Browser, tmp_path: Path) -> Iterator[Visit]:
    """Pages of one test; none may report an error or ask another machine for anything."""
    visit = Visit(chromium, tmp_path)
    yield visit
    visit.close()
    assert visit.requests, "no page was opened"
    assert visit.errors == []
    assert visit.strangers() == []
