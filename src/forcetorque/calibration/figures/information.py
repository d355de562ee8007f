# SPDX-License-Identifier: BSD-3-Clause
"""Figures of calibrations before and after: predicted error along every direction, and what a joint one leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE, FORCE_AND_MOMENT, MOMENT, WRENCH_COMPONENTS
from forcetorque.calibration.joint.robust_fit import PartResidual
from forcetorque.calibration.summary import LITTLE_LEARNT, InformationGain
from forcetorque.results.figures import (
    COLOURS,
    GRID,
    MUTED,
    THIN_REFERENCE_LINE,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    two_digits,
)
from forcetorque.results.visual_roles import PRIOR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW_INCHES = 1.75
"""Height of three directions with the numbers and the label of their axis; inch."""
_LOADS = ("force along", "moment along")
"""What the directions of a row are."""
_ERRORS = (
    (("force error, % of the force", 100.0), ("moment error, N m per 1000 N", 1000.0)),
    (("force error, N per N m", 1.0), ("moment error, % of the moment", 100.0)),
)
"""For forces and for moments as loads: name of each error with its unit, and how many of them one unit is."""
_ROOM, _LEAST_ROOM = 0.3, 0.25
"""Part of the decades of an axis by which it goes on at either end for the numbers there, and the least of it."""
_MOST_DECADES = 1.5
"""Decades up to which an axis has room for numbers between the powers of ten."""
_SHARE_END = 140.0
"""End of the axis of shares, with room for the numbers behind 100; %."""
_BEFORE: dict[str, Any] = {"color": PRIOR.colour, "marker": "s", "markerfacecolor": "none", "markersize": 7.0}
_AFTER: dict[str, Any] = {"color": look(0).colour, "marker": look(0).marker, "markersize": 8.0}
_AFTER_LITTLE: dict[str, Any] = {"color": look(1).colour, "marker": "X", "markersize": 9.0}


@in_figure_style
def learnt_figure(learnt: Mapping[str, Sequence[InformationGain]]) -> Figure:
    """Draw what the recordings taught of every load direction.

    The first panels have by how much the uncertainty became narrower; the others the predicted error, before and after,
    of a load that is added along the direction: one standard deviation of its force and of its moment, as vectors.
    Axes of errors are logarithmic, and the same for all calibrations, so that these can be compared.

    Args:
        learnt: The six directions of `information_gains`, by name of the calibration.

    Returns:
        The figure, two rows for each calibration: forces as loads, moments as loads.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no calibration, or the directions of one are not fx to tz.
    """
    _require_directions(learnt)
    errors = np.array([[_errors(row) for row in rows] for rows in learnt.values()])
    figure = new_figure(_ROW_INCHES * 2 * len(learnt))
    grid = figure.subplots(2 * len(learnt), 3, squeeze=False, gridspec_kw={"width_ratios": (0.8, 1.0, 1.0)})
    for place, (name, rows) in enumerate(learnt.items()):
        little = [row.uncertainty_reduction < LITTLE_LEARNT for row in rows]
        for half, loads in enumerate(FORCE_AND_MOMENT):
            share, *panels = grid[2 * place + half]
            _draw_shares(share, [row.uncertainty_reduction for row in rows[loads]])
            for quantity, panel in enumerate(panels):
                label, factor = _ERRORS[half][quantity]
                _set_error_axis(panel, factor * errors[:, loads, quantity], label)
                _draw_errors(panel, factor * errors[place, loads, quantity], little[loads])
            for panel in (share, *panels):
                _name_directions(panel, WRENCH_COMPONENTS[loads])
            share.set_ylabel(_LOADS[half])
        grid[2 * place][0].set_title(shown_name(name), loc="left")
    counts = [sum(row.uncertainty_reduction >= LITTLE_LEARNT for row in rows) for rows in learnt.values()]
    names = [f"{count} of 6 by {shown_name(name)}" for count, name in zip(counts, learnt, strict=True)]
    headline(figure, f"Directions whose uncertainty fell by half or more: {', '.join(names)}")
    legend_below(
        figure,
        [
            ("before, by the prior", {**_BEFORE, "linestyle": "none"}),
            ("after", {**_AFTER, "linestyle": "-"}),
            ("after, where less than half is gained: the prior decides", {**_AFTER_LITTLE, "linestyle": ":"}),
            ("narrower by half", THIN_REFERENCE_LINE),
        ],
        title="predicted error where a load is added along a direction: one standard deviation of the error vector",
    )
    return figure


def _require_directions(learnt: Mapping[str, Sequence[InformationGain]]) -> None:
    if not learnt:
        raise ShapeError("learnt: expected at least one calibration to draw, got none")
    for name, rows in learnt.items():
        directions = tuple(row.direction for row in rows)
        if directions != WRENCH_COMPONENTS:
            expected = " ".join(WRENCH_COMPONENTS)
            raise ShapeError(f"learnt[{name!r}]: expected the directions {expected}, got {' '.join(directions)}")


def _errors(row: InformationGain) -> tuple[tuple[float, float], tuple[float, float]]:
    """Force error before and after, moment error before and after."""
    force = row.force_error_before_N, row.force_error_after_N
    return force, (row.moment_error_before_Nm, row.moment_error_after_Nm)


def _draw_shares(panel: Axes, shares: Sequence[float]) -> None:
    panel.axvline(100.0 * LITTLE_LEARNT, **THIN_REFERENCE_LINE)
    for row, share in enumerate(shares):
        little = share < LITTLE_LEARNT
        end = 100.0 * max(share, 0.0)
        style = _AFTER_LITTLE if little else _AFTER
        panel.plot([0.0, end], [row, row], ":" if little else "-", color=style["color"], linewidth=4.0)
        panel.plot(end, row, linestyle="none", clip_on=False, zorder=3, **style)
        # in a column of their own, off the dashed line
        _write(panel, f"{100.0 * share:.0f} %", (_SHARE_END, row), -1)
    panel.set(xlim=(0.0, _SHARE_END), xticks=range(0, 101, 25), xlabel="narrower by, %")


def _draw_errors(panel: Axes, errors: FloatArray, little: Sequence[bool]) -> None:
    """A line from the error before to that after, with both numbers outside of it; one that is 0 at the left edge."""
    least = panel.get_xlim()[0]
    for row, (values, few) in enumerate(zip(errors, little, strict=True)):
        before, after = np.maximum(values, least)
        style = _AFTER_LITTLE if few else _AFTER
        panel.plot([before, after], [row, row], ":" if few else "-", color=style["color"], linewidth=2.0)
        panel.plot(after, row, linestyle="none", zorder=3, **style)
        panel.plot(before, row, linestyle="none", zorder=4, **_BEFORE)
        side = 1 if after > before else -1
        _write(panel, two_digits(values[1]), (after, row), side)
        _write(panel, two_digits(values[0]), (before, row), -side)


def _write(panel: Axes, text: str, point: tuple[float, float], side: int) -> None:
    """Put a number beside a point: to the right for 1, to the left for -1."""
    alignment = "left" if side > 0 else "right"
    panel.annotate(
        text.replace("-", "−"),
        point,
        (8.0 * side, 0.0),
        textcoords="offset points",
        va="center",
        ha=alignment,
    )


def _set_error_axis(panel: Axes, errors: FloatArray, label: str) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    drawn = np.log10(errors[errors > 0.0])
    low, high = (float(drawn.min()), float(drawn.max())) if drawn.size else (0.0, 0.0)
    room = max(_LEAST_ROOM, _ROOM * (high - low))
    panel.set(xscale="log", xlim=(10.0 ** (low - room), 10.0 ** (high + room)))
    between = (1.0, 2.0, 5.0) if high - low < _MOST_DECADES else (1.0,)
    panel.xaxis.set_major_locator(LogLocator(subs=between))
    panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panel.xaxis.set_minor_formatter(NullFormatter())
    panel.set_xlabel(label)


def _name_directions(panel: Axes, names: Sequence[str]) -> None:
    panel.set_ylim(len(names) - 0.5, -0.5)
    panel.set_yticks(range(len(names)), names)
    panel.grid(visible=True, axis="x", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


_PART_INCHES = 1.7
_BY_PRIOR: dict[str, Any] = {"color": PRIOR.colour, "linestyle": (0, PRIOR.dash), "linewidth": 1.1}
_BY_CALIBRATIONS: dict[str, Any] = {"color": COLOURS[0], "linestyle": "-", "linewidth": 1.4}
_LEFT_OUT: dict[str, Any] = {"color": COLOURS[1], "linestyle": "none", "marker": "X", "markersize": 5.0}
_BORDER: dict[str, Any] = {"color": MUTED, "linestyle": ":", "linewidth": 1.0}
_QUANTITIES = (("force", "N", FORCE), ("moment", "N m", MOMENT))


@in_figure_style
def joint_figure(residuals: Sequence[PartResidual]) -> Figure:
    """Draw what is left of the equation of every part: magnitudes of force and moment, window by window.

    Intervals stand behind each other, with a dotted line between. The axes of magnitudes are logarithmic.

    Args:
        residuals: What is left, of every part in every interval, at least one.

    Returns:
        The figure, a row for each part: forces, moments.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are none.
    """
    if not residuals:
        raise ShapeError("residuals: expected those of at least one part, got none")
    parts = list(dict.fromkeys(one.part for one in residuals))
    starts = _starts(residuals)
    figure = new_figure(_PART_INCHES * len(parts))
    grid = figure.subplots(len(parts), 2, squeeze=False, sharex=True)
    for row, part in zip(grid, parts, strict=True):
        own = [one for one in residuals if one.part == part]
        for panel, (quantity, unit, loads) in zip(row, _QUANTITIES, strict=True):
            _draw(panel, own, starts, loads)
            panel.set_ylabel(f"{quantity}, {unit}")
            for start in list(starts.values())[1:]:
                panel.axvline(start, **_BORDER)
        sensors = ", ".join(dict.fromkeys(name for one in own for name in one.sensors))
        row[0].set_title(shown_name(f"{part}: {sensors}"), loc="left")
    for panel in grid[-1]:
        panel.set_xlabel("time of all intervals, s")
    legend_below(
        figure,
        [
            ("by the prior matrices, best offsets", _BY_PRIOR),
            ("by the calibrations", _BY_CALIBRATIONS),
            ("left out: disagrees with the others", _LEFT_OUT),
        ],
        title="sensors of a part less what moves its bodies: magnitudes over windows of a quarter of a second",
    )
    before, after = (
        _rms_force([getattr(one, values)[one.kept, FORCE] for one in residuals]) for values in ("before", "after")
    )
    headline(
        figure, f"What is left of forces, root mean square: {before} N by the priors, {after} N by the calibrations"
    )
    return figure


def _rms_force(forces: Sequence[FloatArray]) -> str:
    sizes = _sizes(np.concatenate(forces))
    known = sizes[np.isfinite(sizes)]
    return two_digits(float(np.sqrt(np.mean(known**2)))) if len(known) else "?"


def _starts(residuals: Sequence[PartResidual]) -> dict[str, float]:
    """Where the time of every interval begins on the common axis; s."""
    starts: dict[str, float] = {}
    end = 0.0
    for label in dict.fromkeys(one.label for one in residuals):
        times = np.concatenate([one.time_s for one in residuals if one.label == label])
        starts[label] = end
        end += float(np.ptp(times)) + 1.0 if len(times) else 0.0
    return starts


def _draw(panel: Axes, residuals: Sequence[PartResidual], starts: dict[str, float], loads: slice) -> None:
    for one in residuals:
        if not len(one.time_s):
            continue
        time = starts[one.label] + one.time_s - one.time_s[0]
        before, after = _sizes(one.before[:, loads]), _sizes(one.after[:, loads])
        panel.plot(time, before, **_BY_PRIOR)
        panel.plot(time, after, **_BY_CALIBRATIONS)
        panel.plot(time[~one.kept], after[~one.kept], **_LEFT_OUT)
    if any(np.nanmax(line.get_ydata(), initial=0.0) > 0.0 for line in panel.lines):  # Matplotlib warns of an empty one
        panel.set_yscale("log")
    panel.grid(visible=True, axis="y", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


def _sizes(values: FloatArray) -> FloatArray:
    return np.sqrt((values**2).sum(axis=1))
