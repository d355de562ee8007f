# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a live run: the last corrected wrenches of every sensor with their 95 % bands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.results.figure_style import (
    GRID,
    SMALL_PANEL_POINTS,
    Look,
    draw_over_time,
    headline,
    in_figure_style,
    legend_below,
    new_figure,
    shown_name,
    thinned_line,
)
from forcetorque.results.number_text import counted
from forcetorque.results.visual_roles import AXES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.live.result import LiveRun

_SENSOR_INCHES, _FRAME_INCHES = 2.4, 0.6
"""Height of the panels of a sensor, and of the axis; inch."""
_MOST_SENSORS: Final = 4
"""Sensors that are drawn; the others are counted."""
_BAND_OPACITY: Final = 0.25
_AXES: Final = tuple(Look(colour=axis.colour, marker=axis.marker, dashes="-") for axis in AXES)


@in_figure_style
def live_figure(run: LiveRun) -> Figure:
    """Draw the last corrected wrenches of a run.

    Args:
        run: The run, with the samples that were kept.

    Returns:
        The figure over time: a row per sensor, force on the left, moment on the right, with 95 % bands where the
        calibration has a posterior. A line breaks where samples of its sensor lack; one of
        many samples keeps its peaks.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If no samples were kept.
    """
    kept = run.kept
    if kept is None or not len(kept.time_s):
        raise ShapeError("live run: expected samples to draw, got none")
    sensors = run.sensors[:_MOST_SENSORS]
    figure = new_figure(_FRAME_INCHES + _SENSOR_INCHES * len(sensors))
    panels = figure.subplots(len(sensors), 2, sharex=True, squeeze=False)
    for k, sensor in enumerate(sensors):
        own = kept.came[:, k] | ~kept.came[:, k].any()  # a line needs an instant
        wrench, half = kept.wrench[own, k], kept.half_width[own, k]
        time, lines = thinned_line(kept.time_s[own], np.concatenate([wrench, wrench - half, wrench + half], axis=1))
        panels[k, 0].set_title(shown_name(f"{sensor.sensor} ({sensor.serial})"), loc="left", fontweight="bold")
        for panel, part, unit in zip(panels[k], FORCE_AND_MOMENT, ("force, N", "moment, N m"), strict=True):
            columns = (lines[:, n : n + 6][:, part].T for n in (0, 6, 12))
            for turn, (style, values, low, high) in enumerate(zip(_AXES, *columns, strict=True)):
                panel.fill_between(time, low, high, color=style.colour, alpha=_BAND_OPACITY, linewidth=0.0)
                draw_over_time(panel, time, values, style, turn=turn, count=len(_AXES))
            panel.set_ylabel(unit)
            panel.tick_params(labelsize=SMALL_PANEL_POINTS)
            panel.grid(color=GRID, linewidth=0.6)
    for panel in panels[-1]:
        panel.set_xlabel("time since the first sample, s")
    keys = [(axis.word, style.key) for axis, style in zip(AXES, _AXES, strict=True)]
    legend_below(figure, keys, title="corrected; band: 95 % interval, where the calibration has a posterior")
    headline(figure, _message(run))
    return figure


def _message(run: LiveRun) -> str:
    samples, faulty = sum(one.samples for one in run.sensors), sum(one.faulty for one in run.sensors)
    lost = "losses not countable" if run.packets.lost is None else f"{run.packets.lost} lost"
    rest = len(run.sensors) - _MOST_SENSORS
    more = f"; {counted(rest, 'more sensor')} not drawn" if rest > 0 else ""
    return f"{counted(samples, 'sample')}, {lost}, {faulty} with faults{more}"
