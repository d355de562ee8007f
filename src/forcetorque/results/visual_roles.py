# SPDX-License-Identifier: BSD-3-Clause
"""What colours, dashes and markers mean, in figures, in the viewer's page, in reports and in other viewers.

No other file names a colour. A role is told from its neighbours by its dash and marker too, and by its word. Series
take the palette of M. Okabe and K. Ito, "Color universal design", 2008, with the two that are faint on paper replaced.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Role:
    """How something with a meaning is drawn."""

    word: str
    """What a legend calls it."""
    colour: str
    """Colour on a light ground, as `#rrggbb`."""
    dark: str
    """Colour on a dark ground."""
    dash: tuple[float, ...] = ()
    """Lengths of strokes and of the gaps between them, in widths of the line; empty for an unbroken line."""
    marker: str = "o"
    """Shape of its points, as matplotlib names it."""


EXPECTED = Role(word="expected", colour="#000000", dark="#ffffff", marker="D")
"""What robot model and known loads demand."""
PRIOR = Role(word="prior", colour="#747b85", dark="#9aa3af", dash=(4.0, 2.0), marker="s")
"""Before a calibration: the prior matrix, or what was logged."""
CALIBRATIONS = (
    Role(word="calibration", colour="#0072B2", dark="#56b4e9", marker="o"),
    Role(word="second calibration", colour="#D55E00", dark="#f08a3c", dash=(6.0, 2.0), marker="^"),
    Role(word="third calibration", colour="#009E73", dark="#2fc79b", dash=(6.0, 2.0, 1.0, 2.0), marker="v"),
    Role(word="fourth calibration", colour="#CC79A7", dark="#e3a0c6", dash=(2.0, 1.5), marker="P"),
    Role(word="fifth calibration", colour="#665200", dark="#ffc04d", dash=(6.0, 2.0, 1.0, 2.0, 1.0, 2.0), marker="X"),
    Role(word="sixth calibration", colour="#5b2a86", dark="#b7a3e3", dash=(1.0, 1.0), marker="d"),
)
"""After a calibration: the first is blue wherever it is drawn."""
CONTACT = Role(word="contact", colour="#7a4a00", dark="#d9a25f", marker="h")
"""Wrenches of the world on the robot."""
LIMIT = Role(word="limit", colour="#c1121f", dark="#ff6b6b", dash=(4.0, 3.0), marker="_")
"""What must not be exceeded, and the error on the robot."""
FINDING = Role(word="finding", colour="#b04a00", dark="#ff9d5c", marker="|")
"""What is wrong with a recording."""
SKIN = Role(word="contact on skin", colour="#882255", dark="#e08bb4", marker="p")
"""Contacts on skin, and their uncertainty."""
HEURISTIC = Role(word="heuristic contact", colour="#5b6472", dark="#a9b2c0", dash=(1.0, 2.0), marker="p")
"""Contacts whose force is a heuristic."""
AXES = (
    Role(word="x", colour="#d0312d", dark="#ff7b72", marker=">"),
    Role(word="y", colour="#2a8a3c", dark="#5fd075", marker="^"),
    Role(word="z", colour="#2b5fd0", dark="#82aaff", marker="o"),
)
"""Axes of frames: red, green and blue."""
USES = {
    "calibration": Role(word="calibration", colour="#3a8fc4", dark="#3d8fc0"),
    "validation": Role(word="validation", colour="#009e73", dark="#1f9c78"),
    "ignore": Role(word="ignored", colour="#8a8f98", dark="#7d838d"),
}
"""Intervals by what their samples are for."""
TONES = {
    "good": Role(word="use", colour="#00654a", dark="#4ed1a5"),
    "caution": Role(word="caution", colour="#8a5a00", dark="#f0b64a"),
    "bad": Role(word="refuse", colour="#a33c00", dark="#ff8f5c"),
    "unknown": Role(word="unknown", colour="#4b5560", dark="#aab3be"),
}
"""Verdicts."""
TERMINAL = {"good": 32, "caution": 33, "bad": 31}
"""Colours of verdicts on a terminal: the green, yellow and red of its own palette, by their number (ECMA-48)."""

SURFACES = {
    "ink": ("#1f2430", "#e8ebf0"),
    "muted": ("#59606c", "#a4acb9"),
    "line": ("#d8dce3", "#3a4150"),
    "border": ("#7b8390", "#7d8694"),
    "guide": ("#c9ced6", "#4a5263"),
    "grid": ("#e9ecf1", "#2a303c"),
    "ground": ("#f4f6f8", "#12151b"),
    "panel": ("#ffffff", "#1b1f27"),
    "hover": ("#eef3f7", "#2a313d"),
    "chosen": ("#dcecf6", "#1d3a52"),
    "accent": ("#0069a6", "#5cb8f0"),
    "on-accent": ("#ffffff", "#0c1218"),
    "link": ("#005c91", "#7cc7f5"),
    "note": ("#fff7e0", "#3a3115"),
    "note-border": ("#b87f00", "#a8842a"),
    "shadow": ("#00000033", "#000000aa"),
    "sky": ("#ffffff", "#ffffff"),
    "earth": ("#b9bec8", "#9aa1ad"),
}
"""Everything that has no meaning of its own, on a light and on a dark ground."""

PRESSURES = ("#f3efe6", "#f2c14e", "#d1495b", "#3b0f70")
"""Pressure from none to the largest: lightness alone tells it."""

HIGHLIGHT, SHADE = "#f0e442", "#ebedf0"
"""Colour of a choice among many curves, and of a part of a panel that is out of bounds."""


def named_roles() -> dict[str, Role]:
    """Give all roles by a name of their own.

    Returns:
        Roles, in the order of this file.
    """
    return {
        "expected": EXPECTED,
        "prior": PRIOR,
        **{f"calibration-{k + 1}": role for k, role in enumerate(CALIBRATIONS)},
        "contact": CONTACT,
        "limit": LIMIT,
        "finding": FINDING,
        "skin": SKIN,
        "heuristic": HEURISTIC,
        **{f"axis-{role.word}": role for role in AXES},
        **{f"use-{name}": role for name, role in USES.items()},
        **{f"tone-{name}": role for name, role in TONES.items()},
    }


def css_variables(*, dark: bool) -> str:
    """Write roles and surfaces as variables of a style sheet.

    Args:
        dark: Whether they are for a dark ground.

    Returns:
        Declarations such as `--prior: #747b85;`, a line each.
    """
    return "\n".join(f"  --{name}: {colour};" for name, colour in _colours(dark=dark))


def _colours(*, dark: bool) -> Iterator[tuple[str, str]]:
    for name, role in named_roles().items():
        yield name, role.dark if dark else role.colour
    for name, colours in SURFACES.items():
        yield name, colours[dark]


def rgb(colour: str) -> tuple[int, int, int]:
    """Read a colour.

    Args:
        colour: Such as `#0072B2`.

    Returns:
        Red, green and blue from 0 to 255.
    """
    red, green, blue = bytes.fromhex(colour[1:7])
    return red, green, blue
