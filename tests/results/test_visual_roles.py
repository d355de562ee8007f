# SPDX-License-Identifier: BSD-3-Clause
"""One file says what colours mean, and they can be told from their ground."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import product
from pathlib import Path

import pytest

from forcetorque.results.figure_style import look, looks
from forcetorque.results.visual_roles import (
    CALIBRATIONS,
    EXPECTED,
    PRIOR,
    SURFACES,
    css_variables,
    named_roles,
    rgb,
)

ROOT = Path(__file__).resolve().parents[2]
WRITTEN = ("visual_roles.py", "visual_roles.ts", "visual_roles.css")
"""The file itself, and what is made of it."""
FOLDERS = ("src/forcetorque", "web/src", "benchmarks", "examples")
NAMES = "white|black|red|green|blue|gr[ae]y|orange|yellow|purple|pink|brown|cyan|magenta"
PATTERNS = {
    ".py": rf"""["']\#[0-9a-fA-F]{{3,8}}["']|["']tab:|colou?r["']?\s*[:=]\s*["']({NAMES}|0?\.\d+|C\d|[rgbckmyw])["']""",
    ".ts": rf"""["'`]\#[0-9a-fA-F]{{3,8}}["'`]|rgba?\(|["']({NAMES})["']""",
    ".css": rf"\#[0-9a-fA-F]{{3,8}}\b|rgba?\(|hsla?\(|:\s*({NAMES})\b",
    ".j2": rf"\#[0-9a-fA-F]{{6}}\b|colou?r:\s*({NAMES})\b",
}
TEXT, GRAPHICS = 4.5, 3.0
"""Least contrast by success criteria 1.4.3 and 1.4.11 of WCAG 2.2."""


def _named(text: str, ending: str) -> Iterator[str]:
    yield from (match.group() for match in re.finditer(PATTERNS[ending], text))


def _contrast(one: str, other: str) -> float:
    """Contrast ratio of two colours, 1 to 21: Web Content Accessibility Guidelines 2.2, with relative luminance."""
    lighter, darker = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: str) -> float:
    parts = [part / 255.0 for part in rgb(colour)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_no_other_file_names_a_colour() -> None:
    """Neither code, nor style sheets, nor templates; bundles are made of these."""
    files = [
        path
        for folder in FOLDERS
        for path in (ROOT / folder).rglob("*")
        if path.suffix in PATTERNS and path.name not in WRITTEN and path.parent.name != "assets"
    ]
    assert len(files) > 300
    found = {
        str(path.relative_to(ROOT)): names
        for path in files
        if (names := list(_named(path.read_text(encoding="utf-8"), path.suffix)))
    }
    assert found == {}


@pytest.mark.parametrize(
    ("ending", "text"),
    [
        (".py", 'panel.plot(x, color="#0072B2")'),
        (".py", "panel.axvline(0.0, color='0.9')"),
        (".py", '{"color": "black"}'),
        (".py", 'panel.plot(x, markerfacecolor="white")'),
        (".ts", 'new Color("#ffffff")'),
        (".ts", 'pen.fillStyle = "rgba(0,0,0,1)"'),
        (".css", "a { color: #005a8c; }"),
        (".css", "a { background: white; }"),
        (".j2", '<b style="color: red">'),
    ],
)
def test_a_colour_elsewhere_is_noticed(ending: str, text: str) -> None:
    """Negative control: each way to write one."""
    assert len(list(_named(text, ending))) == 1


@pytest.mark.parametrize("dark", [False, True])
def test_roles_and_texts_stand_out_from_their_ground(dark: bool) -> None:
    """On paper and on a dark ground, over panels, pages and pointed-at parts."""
    grounds = [SURFACES[name][dark] for name in ("panel", "ground", "hover", "chosen")]
    panel = grounds[0]
    low = {
        name: ratio
        for name, role in named_roles().items()
        if (ratio := _contrast(role.dark if dark else role.colour, panel)) < GRAPHICS
    }
    assert low == {}
    for text, ground in product(("ink", "muted", "link"), grounds):
        assert _contrast(SURFACES[text][dark], ground) >= TEXT, (text, ground)
    assert _contrast(SURFACES["on-accent"][dark], SURFACES["accent"][dark]) >= TEXT
    assert _contrast(SURFACES["ink"][dark], SURFACES["note"][dark]) >= TEXT
    for name in ("border", "accent"):
        assert _contrast(SURFACES[name][dark], panel) >= GRAPHICS, name


def test_contrast_is_that_of_the_guidelines() -> None:
    """Black on white has the most, a colour on itself the least; #767676 is the lightest grey for text on white."""
    assert _contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert _contrast("#123456", "#123456") == 1.0
    assert _contrast("#767676", "#ffffff") == pytest.approx(4.54, abs=0.005)


def test_blue_never_means_before() -> None:
    """The prior is grey wherever it comes among others, the first calibration blue, the expected wrench black."""
    for names in (["prior", "a.json"], ["a.json", "prior"], ["logged", "a.json"]):
        by_name = looks(names)
        assert by_name["a.json"] == look(0)
        assert by_name["a.json"].colour == CALIBRATIONS[0].colour
        (before,) = (by_name[name] for name in names if name != "a.json")
        assert before.colour == PRIOR.colour != CALIBRATIONS[0].colour
    assert EXPECTED.colour == "#000000"


def test_roles_differ_in_more_than_their_colour() -> None:
    """Expected, prior and calibrations have markers of their own; lines beside each other have dashes of their own."""
    series = [EXPECTED, PRIOR, *CALIBRATIONS]
    assert len({role.marker for role in series}) == len(series)
    assert len({role.dash for role in (PRIOR, *CALIBRATIONS)}) == len(series) - 1


def test_every_role_is_a_variable_of_style_sheets() -> None:
    """With one colour for each ground."""
    for dark in (False, True):
        lines = css_variables(dark=dark).splitlines()
        assert [line.split(":")[0].strip() for line in lines] == [f"--{name}" for name in (*named_roles(), *SURFACES)]
