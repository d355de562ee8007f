# SPDX-License-Identifier: BSD-3-Clause
"""The page holds the scene and the bundle, and nothing in either can break out of its place."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.viewer.page import MOST_SAMPLES, page_of, write_page
from forcetorque.viewer.scene import scene_json
from forcetorque.viewer.scene_builder import BuiltScene

EVIL = "</script><script>alert(1)</script><!-- <b>& é \u2028"


class _Page(HTMLParser):
    """Attributes and content of every element, as a browser would split them."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str | None], list[str]]] = []
        self.open: list[list[str]] = [[]]
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs), []))
        self.open.append(self.elements[-1][2])

    def handle_endtag(self, tag: str) -> None:
        self.open.pop()

    def handle_data(self, data: str) -> None:
        self.open[-1].append(data)

    def one(self, tag: str, **attributes: str) -> tuple[dict[str, str | None], str]:
        """Attributes and text of the only element of a kind."""
        found = [
            (given, "".join(text))
            for name, given, text in self.elements
            if name == tag and attributes.items() <= {k: v or "" for k, v in given.items()}.items()
        ]
        assert len(found) == 1, (tag, attributes, len(found))
        return found[0]


def _titled(built: BuiltScene, title: str) -> BuiltScene:
    return replace(built, scene=replace(built.scene, title=title))


def _bundle(page: _Page) -> str:
    (script,) = ("".join(text) for tag, given, text in page.elements if tag == "script" and "type" not in given)
    return script


def test_a_file_holds_header_and_arrays(built: BuiltScene, assets: Path) -> None:
    """What a browser reads out of the page is the scene, whatever its texts are."""
    evil = _titled(built, EVIL)
    page = _Page(page_of(evil, assets=assets).decode())
    assert page.one("title")[1] == EVIL
    assert json.loads(page.one("script", id="scene")[1]) == json.loads(scene_json(evil.scene))
    attributes, data = page.one("script", id="data")
    assert base64.b64decode(data, validate=True) == built.block
    assert "data-url" not in attributes
    assert page.one("div", id="viewer")[1] == ""
    assert page.one("style")[1] == "#viewer { color: black }"


def test_the_policy_allows_the_bundle_and_no_connection(built: BuiltScene, assets: Path) -> None:
    """A script other than the bundle does not run, and a file connects to nothing; a served page to its server."""
    for url, connection in ((None, "'none'"), ("data.bin", "'self'")):
        page = _Page(page_of(_titled(built, EVIL), data_url=url, assets=assets).decode())
        policy, _ = page.one("meta", **{"http-equiv": "Content-Security-Policy"})
        rules = dict(rule.split(" ", 1) for rule in str(policy["content"]).split("; "))
        digest = base64.b64encode(hashlib.sha256(_bundle(page).encode()).digest()).decode()
        assert rules["default-src"] == "'none'"
        assert rules["script-src"] == f"'sha256-{digest}'"
        assert rules["connect-src"] == connection


def test_the_bundle_cannot_end_its_element(built: BuiltScene, assets: Path) -> None:
    """Texts in it that a browser would take for markup are written in another way of the same meaning."""
    assert _bundle(_Page(page_of(built, assets=assets).decode())) == "window.ft = '<\\/script>\\x3c!-- é';"


def test_a_served_page_names_its_data(built: BuiltScene, assets: Path) -> None:
    """It holds the header, where the arrays are and where saved samples go."""
    page = _Page(page_of(built, data_url="data.bin", annotations_url="annotations", assets=assets).decode())
    attributes, data = page.one("script", id="data")
    assert (attributes["data-url"], data) == ("data.bin", "")
    assert json.loads(page.one("script", id="scene")[1])["annotations_url"] == "annotations"


def test_nothing_in_the_template_is_fetched(built: BuiltScene, assets: Path) -> None:
    """No element refers to anything outside the page, and licences go with the bundle."""
    text = page_of(built, assets=assets).decode()
    assert re.findall(r"(?:src|href)=\"(?!data:)", text) == []
    assert "some - - licence" in text


def test_the_same_scene_gives_the_same_page(built: BuiltScene, assets: Path) -> None:
    """There is no date and no chance in it."""
    assert page_of(built, assets=assets) == page_of(built, assets=assets)


def test_too_many_samples_are_refused(built: BuiltScene, assets: Path, tmp_path: Path) -> None:
    """The message says how many there are, how many a file takes, and what to do instead."""
    most = replace(built, scene=replace(built.scene, samples=MOST_SAMPLES))
    assert write_page(tmp_path / "view.html", most, assets=assets) == (tmp_path / "view.html").stat().st_size
    more = replace(built, scene=replace(built.scene, samples=MOST_SAMPLES + 1))
    with pytest.raises(
        ForceTorqueError, match="at most 200000 samples in one page, got 200001; .* without --output serves them all"
    ):
        write_page(tmp_path / "more.html", more, assets=assets)
    assert [file.name for file in tmp_path.iterdir()] == ["view.html"]


def test_a_missing_bundle_is_named(built: BuiltScene, assets: Path, tmp_path: Path) -> None:
    """Whoever works on the page learns how to build it."""
    (tmp_path / "page.html").write_text("", encoding="utf-8")
    with pytest.raises(
        MissingFileError, match=r"viewer\.js: expected the viewer's bundle, there is none; run `make web`"
    ):
        page_of(built, assets=tmp_path)
