# SPDX-License-Identifier: BSD-3-Clause
"""Figures as PNG, drawn by matplotlib, which is needed for nothing else and comes with the extra `report`."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import MissingExtraError
from forcetorque.experiment import SensorGains
from forcetorque.recording.alignment import GAP_PERIODS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DOTS_PER_INCH = 100
"""Resolution of every figure; dots per inch."""
ROW_INCHES = (12.0, 3.6)
"""Width and height of a row of a figure; inch."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442")
"""The palette of Okabe and Ito, which the colour-blind tell apart; the faint yellow comes last."""

_DRAWN_SAMPLES = 2000
"""Samples of a line beyond which its smallest and largest values stand for stretches of them."""


def gain_figure(sensors: Sequence[SensorGains]) -> bytes:
    """Draw the raw channels against their limits, with the present and with the recommended gains [1].

    Args:
        sensors: What was found for each sensor; one row each.

    Returns:
        The figure as PNG, `ROW_INCHES` times the number of rows at `DOTS_PER_INCH`.

    Raises:
        MissingExtraError: If matplotlib is not installed.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.8.
    """
    figure = _figure(ROW_INCHES[0], ROW_INCHES[1] * len(sensors))
    panels = figure.subplots(len(sensors), 2, squeeze=False, sharey="row")
    for (before, after), found in zip(panels, sensors, strict=True):
        known = all(each.recommended is not None for each in found.advice)
        _draw(before, found, found.counts, title=f"{found.sensor} ({found.serial}), as recorded")
        _draw(
            after, found, found.counts * found.factors, title=f"with the recommended {'gains' if known else 'factors'}"
        )
        before.set_ylabel("raw, counts")
        after.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return _png(figure)


def force_space_figure(clouds: Mapping[str, Sequence[tuple[str, FloatArray]]]) -> bytes:
    """Draw clouds of forces as seen along the three axes.

    Args:
        clouds: By the title of a row, names and forces of its clouds, drawn in this order; shape (n, 3); N.

    Returns:
        The figure as PNG, a row of three views per title.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = _figure(ROW_INCHES[0], ROW_INCHES[1] * len(clouds))
    rows = figure.subplots(len(clouds), 3, squeeze=False)
    for panels, (title, named) in zip(rows, clouds.items(), strict=True):
        for panel, (first, second) in zip(panels, ((0, 1), (1, 2), (0, 2)), strict=True):
            for (name, force), colour in zip(named, COLOURS, strict=False):
                panel.plot(force[:, first], force[:, second], ".", color=colour, markersize=1.5, label=name)
            panel.set_aspect("equal", adjustable="datalim")
            panel.set_xlabel(f"f{'xyz'[first]}, N")
            panel.set_ylabel(f"f{'xyz'[second]}, N")
        panels[0].set_title(title, fontsize=10, loc="left")
        panels[-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, markerscale=6.0)
    return _png(figure)


def _figure(width: float, height: float) -> Figure:
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise MissingExtraError("figures are drawn by matplotlib: pip install forcetorque[report]") from error
    # a Figure with its own canvas, not pyplot: no window, no state that others share
    figure = Figure(figsize=(width, height), dpi=DOTS_PER_INCH, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _png(figure: Figure) -> bytes:
    png = io.BytesIO()
    figure.savefig(png, format="png", dpi=DOTS_PER_INCH)
    return png.getvalue()


def _draw(panel: Axes, found: SensorGains, counts: FloatArray, *, title: str) -> None:
    limit = found.limit_counts
    for sign in (-1.0, 1.0):
        panel.axhline(sign * limit, color="black", linestyle="--", linewidth=1.0)
        panel.axhspan(sign * (1.0 - found.margin) * limit, sign * limit, color="black", alpha=0.08, linewidth=0.0)
    time, drawn = _line(found.time_s, counts)
    for k, each in enumerate(found.advice):
        # channels beyond the palette share a colour and differ in style
        style = ("-", ":", "-.")[k // len(COLOURS) % 3]
        colour = COLOURS[k % len(COLOURS)]
        panel.plot(time, drawn[:, k], style, color=colour, linewidth=0.9, label=each.channel)
    reach = max(1.1 * limit, float(np.abs(counts).max()))
    panel.set_ylim(-reach, reach)
    panel.set_title(title, fontsize=10)
    panel.set_xlabel("time, s")


def _line(time_s: FloatArray, counts: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A line of bearable length that keeps every peak and is broken where the samples pause."""
    steps = np.diff(time_s)
    pause = GAP_PERIODS * np.median(steps) if len(steps) else np.inf
    breaks = np.flatnonzero(steps > pause) + 1
    stride = -(-2 * len(time_s) // _DRAWN_SAMPLES)
    times: list[FloatArray] = []
    values: list[FloatArray] = []
    for time, part in zip(np.split(time_s, breaks), np.split(counts, breaks), strict=True):
        shown_time, shown = (time, part) if stride <= 2 else _envelope(time, part, stride)
        times += [shown_time, shown_time[-1:]]
        values += [shown, np.full((1, counts.shape[1]), np.nan)]
    return np.concatenate(times), np.concatenate(values)


def _envelope(time_s: FloatArray, counts: FloatArray, stride: int) -> tuple[FloatArray, FloatArray]:
    starts = np.arange(0, len(time_s), stride)
    smallest, largest = np.minimum.reduceat(counts, starts), np.maximum.reduceat(counts, starts)
    ends = np.stack([smallest, largest], axis=1).reshape(-1, counts.shape[1])
    return np.repeat(time_s[starts], 2), ends
