# SPDX-License-Identifier: BSD-3-Clause
"""Figures of loads: mass and centre of mass with their intervals; offset and error of a tare, before and after."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.payload.result import LoadRow, RecordingLoadRow, load_words
from forcetorque.payload.tare_offset import TaredSensor
from forcetorque.results.figures import (
    THIN_REFERENCE_LINE,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    rms_sizes,
    shown_name,
    thinned_line,
    two_digits,
)
from forcetorque.results.number_text import amount
from forcetorque.results.visual_roles import PRIOR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW_INCHES, _FRAME_INCHES = 0.45, 1.6
"""Height of a load, and of axes and titles; inch."""
_ALL, _ALONE = look(0), look(1)
_STATED: dict[str, Any] = {"color": PRIOR.colour, "marker": PRIOR.marker, "linestyle": "none"}


@in_figure_style
def load_figure(loads: Sequence[LoadRow], recordings: Sequence[RecordingLoadRow] = ()) -> Figure:
    """Draw loads.

    Args:
        loads: Loads by all recordings together.
        recordings: The same by each recording alone.

    Returns:
        The figure: a row per load, below it one per recording; mass and the three coordinates of the centre of mass,
        with their 95 % intervals.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no load.
    """
    if not loads:
        raise ShapeError("loads: expected at least one to draw, got none")
    rows = [row for load in loads for row in (load, *(one for one in recordings if one.load == load.load))]
    figure = new_figure(_FRAME_INCHES + _ROW_INCHES * max(len(rows), 2))
    panels = figure.subplots(1, 4, sharey=True)
    for place, row in enumerate(rows):
        _draw(panels[0], place, row, row.mass_kg, row.mass_half_width_95_kg)
        for k, panel in enumerate(panels[1:]):
            centre, half_width = row.centre_of_mass_m[k], row.centre_of_mass_half_width_95_m[k]
            _draw(panel, place, row, _in_mm(centre), _in_mm(half_width))
    for panel, title in zip(panels, ("mass, kg", *(f"centre of mass {axis}, mm" for axis in "xyz")), strict=True):
        panel.set_title(title, loc="left")
        panel.margins(x=0.2)
        panel.locator_params(axis="x", nbins=5)
    panels[0].set_ylim(len(rows) - 0.5, -0.5)
    names = [row.recording if isinstance(row, RecordingLoadRow) else row.load for row in rows]
    panels[0].set_yticks(range(len(rows)), [shown_name(name) for name in names])
    headline(figure, f"{shown_name(loads[0].load)}: {load_words(loads[0].model_copy(update={'load': 'load'}))}")
    keys = [("estimated; line: 95 % interval", _ALL.key | {"linestyle": "-"})]
    if recordings:
        keys.append(("by one recording", _ALONE.key | {"linestyle": "-"}))
    if any(not row.estimated for row in rows):
        keys.append(("as stated", _STATED))
    legend_below(figure, keys)
    return figure


def _in_mm(value: float | None) -> float | None:
    return None if value is None else 1e3 * value


def _draw(panel: Axes, place: int, row: LoadRow, value: float | None, half_width: float | None) -> None:
    if value is None:
        panel.text(0.5, place, "open", transform=panel.get_yaxis_transform(), ha="center", va="center")
        return
    style = _ALONE if isinstance(row, RecordingLoadRow) else _ALL
    mark: dict[str, Any] = (
        {"color": style.colour, "marker": style.marker, "linestyle": "none"} if row.estimated else _STATED
    )
    if half_width is not None and row.estimated:
        panel.plot([value - half_width, value + half_width], [place, place], color=style.colour, linewidth=1.8)
    panel.plot(value, place, markersize=7.0, **mark)


_SENSOR_INCHES = 2.8
"""Height of the panels of a tared sensor; inch."""


@in_figure_style
def tare_figure(sensors: Sequence[TaredSensor]) -> Figure:
    """Draw offsets with their 95 % intervals, and how far the force is off, before and after.

    Args:
        sensors: Tared sensors, a row each.

    Returns:
        The figure: offset of forces, offset of moments, and the norm of the error of the force over the interval.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no sensor.
    """
    if not sensors:
        raise ShapeError("sensors: expected at least one to draw, got none")
    figure = new_figure(_SENSOR_INCHES * len(sensors))
    grid = figure.subplots(len(sensors), 3, squeeze=False, width_ratios=(1.0, 1.0, 2.0))
    for row, (*offsets, errors) in zip(sensors, grid, strict=True):
        for panel, part, title in zip(offsets, FORCE_AND_MOMENT, ("force, N", "moment, N m"), strict=True):
            _draw_offset(panel, row, part)
            panel.set_title(f"offset of the {title}", loc="left")
        for key, values in ((_STATED | {"linestyle": "--"}, row.errors.before), (_ALL.key, row.errors.after)):
            norm = np.linalg.norm(values[:, FORCE_AND_MOMENT[0]], axis=1)[:, None]
            time, drawn = thinned_line(row.errors.time_s, norm)
            errors.plot(time, drawn[:, 0], color=key["color"], linestyle=key["linestyle"], linewidth=1.2)
        errors.set_ylim(bottom=0.0)
        errors.set_title(shown_name(row.sensor), loc="left")
        errors.set(ylabel="error of the force, N", xlabel=f"time in {shown_name(row.interval)}, s")
    headline(figure, "; ".join(_tared(row) for row in sensors))
    keys = [("offset and error after the tare; line: 95 % interval", _ALL.key | {"linestyle": "-"})]
    before = "before" if any(row.offset_before is not None for row in sensors) else "error before"
    legend_below(figure, [*keys, (before, _STATED | {"linestyle": "--"})])
    return figure


def _draw_offset(panel: Axes, row: TaredSensor, part: slice) -> None:
    at = np.arange(3)
    panel.axhline(0.0, **THIN_REFERENCE_LINE | {"linewidth": 0.8})
    if row.offset_before is not None:
        panel.plot(at, row.offset_before[part], markersize=7.0, **_STATED)
    panel.errorbar(
        at,
        row.offset[part],
        yerr=row.half_width_95[part],
        color=_ALL.colour,
        marker=_ALL.marker,
        linestyle="none",
        elinewidth=1.8,
    )
    panel.set_xticks(at, WRENCH_COMPONENTS[part])
    panel.margins(x=0.25, y=0.15)


def _tared(row: TaredSensor) -> str:
    """RMS of the norm of the error of the force, before and after; where the load moves, by how much."""
    if row.load_moves:
        return f"{shown_name(row.sensor)}: the load moves by {amount(row.load_moves_N, 'N')}: no tare"
    before, after = (_rms_force(values) for values in (row.errors.before, row.errors.after))
    return f"{shown_name(row.sensor)}: error of the force from {before} to {after} N RMS"


def _rms_force(wrenches: FloatArray) -> str:
    sizes = rms_sizes(wrenches)
    return "unknown" if sizes is None else two_digits(sizes[0])
