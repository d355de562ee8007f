# SPDX-License-Identifier: BSD-3-Clause
"""Firefox without a window, driven by WebDriver BiDi, which it speaks itself: a second engine that reads the page."""

from __future__ import annotations

import importlib.util
import json
import re
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from websockets.sync.client import ClientConnection

PROGRAMS = ("firefox-esr", "firefox")
PATIENCE_S = 120.0
NO_NETWORK = {
    "app.normandy.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "remote.active-protocols": 1,
}
"""Preferences, with which it asks nobody for anything by itself; the last one is WebDriver BiDi."""


class FirefoxPage:
    """A tab, and what went wrong in it."""

    def __init__(self, connection: ClientConnection, size: tuple[int, int]) -> None:
        self.errors: list[str] = []
        self._connection, self._count = connection, 0
        self._call("session.new", capabilities={})
        self._call("session.subscribe", events=["log.entryAdded"])
        self._context = self._call("browsingContext.create", type="tab")["context"]
        viewport = {"width": size[0], "height": size[1]}
        self._call("browsingContext.setViewport", context=self._context, viewport=viewport)

    def go(self, url: str) -> None:
        """Open an address and wait until everything is drawn."""
        self._call("browsingContext.navigate", context=self._context, url=url, wait="complete")
        here = f"location.href === {json.dumps(url)} && document.readyState === 'complete' && window.ft !== undefined"
        end = time.monotonic() + PATIENCE_S
        while not self.evaluate(here):  # the last page may still answer
            assert time.monotonic() < end, f"{url} did not open"
            time.sleep(0.1)
        assert self.evaluate("window.ft.ready") is True

    def evaluate(self, expression: str) -> Any:
        """Value of an expression, or of what it promises."""
        text = f"Promise.resolve({expression}).then(value => JSON.stringify(value ?? null))"
        answer = self._call("script.evaluate", expression=text, target={"context": self._context}, awaitPromise=True)
        assert answer["type"] == "success", answer
        return json.loads(answer["result"]["value"])

    def press(self, key: str) -> None:
        """Press a key."""
        strokes = [{"type": kind, "value": key} for kind in ("keyDown", "keyUp")]
        actions = [{"type": "key", "id": "keys", "actions": strokes}]
        self._call("input.performActions", context=self._context, actions=actions)

    def _call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._count += 1
        self._connection.send(json.dumps({"id": self._count, "method": method, "params": parameters}))
        while True:
            message = json.loads(self._connection.recv(timeout=PATIENCE_S))
            if message.get("method") == "log.entryAdded" and message["params"]["level"] == "error":
                self.errors.append(str(message["params"]["text"]))
            if message.get("id") == self._count:
                assert message["type"] == "success", message
                return dict(message["result"])


@contextmanager
def firefox_page(profile: Path, size: tuple[int, int]) -> Iterator[FirefoxPage]:
    """Start Firefox with an empty profile, or skip the test where there is none."""
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        pytest.skip(f"no Firefox: none of {', '.join(PROGRAMS)} is installed; on Debian: apt-get install firefox-esr")
    if importlib.util.find_spec("websockets") is None:
        pytest.skip("websockets is not installed")
    from websockets.sync.client import connect

    profile.mkdir()
    lines = [f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in NO_NETWORK.items()]
    (profile / "user.js").write_text("".join(lines))
    options = ["--headless", "--no-remote", "--profile", str(profile), "--remote-debugging-port", "0"]
    log = profile / "stderr.txt"
    with log.open("w") as said, subprocess.Popen([program, *options], stderr=said) as process:
        try:
            with connect(f"{_address(log)}/session", max_size=None, open_timeout=PATIENCE_S) as connection:
                yield FirefoxPage(connection, size)
        finally:
            process.terminate()


def _address(log: Path) -> str:
    """Where it listens, which it says itself."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        if match := re.search(r"WebDriver BiDi listening on (ws://127\.0\.0\.1:\d+)", log.read_text(encoding="utf-8")):
            return match[1]
        time.sleep(0.1)
    raise AssertionError(f"Firefox did not say where it listens: {log.read_text(encoding='utf-8')}")
