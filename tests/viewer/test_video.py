# SPDX-License-Identifier: BSD-3-Clause
"""A page films itself in a browser without a window; what is needed for it and absent is named."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError, MissingExtraError, MissingFileError
from forcetorque.viewer.page import ViewerServer
from forcetorque.viewer.video import Film, film_page, find_browser, require_playwright

FILM = Film(start=3, end=9, fps=10.0, speed=2.0, width=320, height=200)


def _film(script: str) -> bytes:
    """What a page with this script makes of being asked for a film."""
    pytest.importorskip("playwright")
    try:
        browser = find_browser()
    except MissingFileError:
        pytest.skip("there is no browser; install chromium")
    page = f"<!DOCTYPE html><script>{script}</script>".encode()
    with ViewerServer(page, b"", None) as server:
        return film_page(server.url, FILM, browser=browser)


@pytest.mark.long
def test_the_page_is_asked_when_it_is_ready() -> None:
    """It gets the wishes as they are, after its promise is kept, and what it gives comes back as bytes."""
    script = """
      let ready = false;
      window.ft = { ready: new Promise(done => setTimeout(() => { ready = true; done(true); }, 50)),
                    video: async wanted => btoa(JSON.stringify([ready, wanted])) };
    """
    text = _film(script).decode()
    assert text == '[true,{"start":3,"end":9,"fps":10,"speed":2,"width":320,"height":200}]'


@pytest.mark.long
def test_a_page_that_fails_is_an_error() -> None:
    """What the page says is in the message."""
    with pytest.raises(ForceTorqueError, match="could not be filmed: .*the scene is empty"):
        _film("window.ft = { ready: Promise.reject(new Error('the scene is empty')) };")
    with pytest.raises(ForceTorqueError, match="expected a video, got 'no film'"):
        _film("window.ft = { ready: true, video: () => 'no film' };")


@pytest.mark.long
def test_the_page_reaches_nobody_else() -> None:
    """A request to another address fails, here one that would be answered: another server of this machine."""
    with ViewerServer(b"other", b"", None) as other:
        script = f"""
          window.ft = {{ ready: true, video: () => fetch('{other.url}').then(() => btoa('yes'), () => btoa('no')) }};
        """
        assert _film(script) == b"no"


@pytest.mark.parametrize(
    "change", [{"fps": 0.0}, {"fps": 1000.0}, {"speed": 0.0}, {"speed": float("inf")}, {"width": 321}, {"height": 10}]
)
def test_an_impossible_film_is_refused(change: dict[str, float]) -> None:
    """Before anything is drawn."""
    given = {"start": 0, "end": 1, "fps": 25.0, "speed": 1.0, "width": 320, "height": 200} | change
    with pytest.raises(ForceTorqueError, match="video: expected"):
        Film(**given)  # type: ignore[arg-type]


def test_without_a_browser_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Also where a program is named that is not there."""
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(MissingFileError, match=r"expected a browser \(chromium, .*install chromium or name one"):
        find_browser()
    with pytest.raises(MissingFileError, match="--browser .*nobrowser: expected a program, there is none"):
        find_browser(tmp_path / "nobrowser")
    (tmp_path / "chromium").write_text("#!/bin/sh\n", encoding="ascii")
    (tmp_path / "chromium").chmod(0o755)
    assert find_browser() == tmp_path / "chromium"


def test_without_playwright_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """The optional package is named."""
    monkeypatch.setitem(sys.modules, "playwright", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[video\]'"):
        require_playwright()
