# SPDX-License-Identifier: BSD-3-Clause
"""Sketches of the geometry that pages explain: the sign of a sensor, a limb with its sensors, a tool on a wrist."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from matplotlib.patches import Rectangle

from forcetorque.results.figure_style import MUTED, headline, in_figure_style, new_figure, png_bytes
from forcetorque.results.visual_roles import AXES, CALIBRATIONS, CONTACT, EXPECTED, SKIN, SURFACES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LINK = SURFACES["line"][0]
_SENSOR = CALIBRATIONS[0].colour

Arrow = tuple[tuple[float, float], tuple[float, float], str, str]
"""Where it begins and ends, colour, and the words at its outer end."""


def _arrow(panel: Axes, start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 2.5, "mutation_scale": 18.0}
    panel.annotate("", end, start, arrowprops=style)


@in_figure_style
def signs() -> bytes:
    """Draw the sign of a sensor between two links, of which the outer one hangs.

    Returns:
        A PNG.
    """
    figure = new_figure(3.2)
    for panel, direction, other, sign, tail in zip(
        figure.subplots(1, 2),
        ("child_to_parent", "parent_to_child"),
        ("the child on the parent", "the parent on the child"),
        ("-", "+"),
        (1.0, -0.2),
        strict=True,
    ):
        links = {"parent, towards the known frame": (1.1, 0.5), "child, mass m beyond the sensor": (-0.9, 0.5)}
        for name, (bottom, height) in links.items():
            panel.add_patch(Rectangle((-1.5, bottom), 3.0, height, facecolor=_LINK))
            panel.text(0.0, bottom + 0.5 * height, name, ha="center", va="center")
        panel.add_patch(Rectangle((-0.5, 0.2), 1.0, 0.3, facecolor=MUTED))
        panel.text(0.6, 0.35, "sensor", va="center")
        for x in (-0.3, 0.3):
            panel.plot([x, x], [-0.4, 1.1], color=MUTED, linewidth=2.0, zorder=0)
        _arrow(panel, (-1.8, tail), (-1.8, tail + (-0.8 if sign == "-" else 0.8)), _SENSOR)
        _arrow(panel, (1.8, -0.3), (1.8, -1.1), EXPECTED.colour)
        panel.text(-1.95, 0.5 * tail + 0.05, f"reading\n(0, 0, {sign}m g)", ha="right", color=_SENSOR)
        panel.text(1.95, -0.8, "weight\n(0, 0, -m g)", va="center")
        panel.set_title(f"{direction}: {other}", fontweight="bold")
        panel.set_xlim(-3.2, 3.2)
        panel.set_ylim(-1.2, 1.8)
        panel.set_axis_off()
    return png_bytes(figure)


@in_figure_style
def limb(
    message: str,
    sensors: Sequence[float],
    arrows: Sequence[Arrow],
    *,
    line: tuple[tuple[float, float], tuple[float, float]] | None = None,
    skin: bool = False,
) -> bytes:
    """Draw a leg that lies, with sensors in it and what acts on it.

    Args:
        message: What it shows.
        sensors: Where sensors are, along the leg.
        arrows: What acts, and what is measured.
        line: A line of action.
        skin: Whether the shank has skin.

    Returns:
        A PNG.
    """
    figure = new_figure(2.4)
    panel = figure.subplots()
    for name, start, end, half in (
        ("torso", -0.6, 0.9, 0.45),
        ("thigh", 1.1, 2.5, 0.18),
        ("shank", 2.7, 4.7, 0.18),
        ("foot", 4.9, 6.0, 0.12),
    ):
        panel.add_patch(Rectangle((start, -half), end - start, 2.0 * half, facecolor=_LINK))
        panel.text(0.5 * (start + end), 0.0, name, ha="center", va="center")
    for x in (1.0, 2.6, 4.8):
        if x in sensors:
            panel.add_patch(Rectangle((x - 0.09, -0.24), 0.18, 0.48, facecolor=_SENSOR))
        else:
            panel.plot(x, 0.0, marker="o", markersize=9.0, color=MUTED)
    if skin:
        panel.add_patch(Rectangle((2.75, 0.18), 1.9, 0.07, facecolor=SKIN.colour))
        panel.text(2.7, 0.34, "skin", color=SKIN.colour)
    if line is not None:
        panel.plot(*zip(*line, strict=True), color=MUTED, linestyle=(0, (4, 3)), linewidth=1.2, zorder=0)
        panel.text(line[1][0] + 0.08, line[1][1], "line of action", va="center", color=MUTED)
    for start, end, colour, words in arrows:
        _arrow(panel, start, end, colour)
        outer = max(start, end, key=lambda place: abs(place[1]))
        panel.text(outer[0] + 0.1, outer[1], words, va="center", color=colour)
    panel.set_xlim(-0.8, 7.0)
    panel.set_ylim(-1.15, 1.25)
    panel.set_axis_off()
    headline(figure, message)
    return png_bytes(figure)


@in_figure_style
def tool() -> bytes:
    """Draw a tool on a wrist: flange, sensor, and the centre of mass in either frame.

    Returns:
        A PNG.
    """
    figure = new_figure(2.6)
    panel = figure.subplots()
    for name, start, end, half in (("arm", -1.0, 0.9, 0.3), ("tool", 2.4, 4.6, 0.45)):
        panel.add_patch(Rectangle((start, -half), end - start, 2.0 * half, facecolor=_LINK))
        panel.text(start + 0.15, half - 0.14, name, va="center")
    panel.add_patch(Rectangle((1.0, -0.3), 1.3, 0.6, facecolor=MUTED, alpha=0.4))
    panel.text(1.65, -0.42, "sensor", ha="center", va="top")
    for name, x in (("flange", 0.95), ("sensor frame", 1.9)):
        for axis, (dx, dy) in ((AXES[2], (0.42, 0.0)), (AXES[0], (0.0, 0.42))):
            _arrow(panel, (x, 0.0), (x + dx, dy), axis.colour)
            panel.text(x + 1.1 * dx + 0.03, 1.1 * dy + 0.06, axis.word, color=axis.colour)
        panel.text(x, 0.75, name, ha="center")
    panel.annotate("", (1.9, -0.85), (0.95, -0.85), arrowprops={"arrowstyle": "-|>", "color": _SENSOR})
    panel.text(0.9, -0.85, "--sensor-pose", ha="right", va="center", color=_SENSOR)
    panel.annotate("", (3.6, -0.1), (1.9, 0.0), arrowprops={"arrowstyle": "-|>", "color": EXPECTED.colour})
    panel.text(3.75, 0.0, "centre of mass", va="center")
    panel.plot(3.6, -0.1, marker="o", markersize=9.0, color=EXPECTED.colour)
    _arrow(panel, (3.6, -0.15), (3.6, -0.95), EXPECTED.colour)
    panel.text(3.7, -0.8, "weight m g: in the reading in every posture", va="center")
    panel.set_xlim(-1.2, 6.6)
    panel.set_ylim(-1.1, 1.0)
    panel.set_axis_off()
    headline(figure, "What hangs beyond the sensor counts in the sensor's frame; for a controller, in the flange")
    return png_bytes(figure)


_FOOT = ((5.45, -0.95), (5.45, -0.16), CONTACT.colour)
SKETCHES: dict[str, Callable[[], bytes]] = {
    "signs": signs,
    "tool": tool,
    "limb_push": partial(
        limb,
        "One sensor measures a push anywhere beyond it, and the line along which it acts, not the point on it",
        (1.0,),
        (
            ((2.9, 1.05), (3.3, 0.22), CONTACT.colour, "push"),
            ((1.0, -0.95), (1.0, -0.28), _SENSOR, "reading"),
        ),
        line=((2.8, 1.2575), (3.9, -1.025)),
    ),
    "limb_part": partial(
        limb,
        "Nothing touches the part between two sensors: both readings together balance its weight and inertia",
        (1.0, 4.8),
        (
            ((1.0, -0.95), (1.0, -0.28), _SENSOR, "reading"),
            ((4.8, 0.95), (4.8, 0.28), _SENSOR, "reading"),
            ((2.9, -0.22), (2.9, -0.95), EXPECTED.colour, "weight and inertia of the part"),
            (*_FOOT, "unknown"),
        ),
    ),
    "limb_skin": partial(
        limb,
        "Skin measures the push on it; with that known, the sensor determines what touches the foot",
        (1.0,),
        (
            ((3.7, 1.05), (3.7, 0.28), SKIN.colour, "push: measured by skin"),
            ((1.0, -0.95), (1.0, -0.28), _SENSOR, "reading: both together"),
            (*_FOOT, "unknown: what is left"),
        ),
        skin=True,
    ),
}
"""By name of the picture."""
