# SPDX-License-Identifier: BSD-3-Clause
"""Figure of errors and offsets of sensors over time: a small panel for force and one for moment of every sensor."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from typing import TYPE_CHECKING, Any, Final

from forcetorque.base.errors import ShapeError
from forcetorque.fleet.sensor_evaluation import RecordingError
from forcetorque.results.figures import (
    SMALL_PANEL_POINTS,
    THIN_REFERENCE_LINE,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ErrorsOverTime = tuple[str, Sequence[RecordingError], tuple[float | None, float | None]]
"""Name of a sensor, its errors in the order of time, and the allowed errors of force and moment; N, N m; None where
there is no limit."""

_COLUMNS: Final = 2
"""Sensors in a row."""
_ROW_INCHES: Final = 1.6
"""Height of a row; inch."""
_NO_DATE: Final = "1970-01-01"
"""Day of stamps that count from the start of a recording."""
_LINE: Final[dict[str, Any]] = {"linewidth": 1.2, "markersize": 4.0}
_KEYS: Final = (("error without its mean (RMS)", look(0)), ("offset: norm of the mean error", look(1)))


@in_figure_style
def over_time_figure(
    sensors: Sequence[ErrorsOverTime],
) -> Figure:
    """Draw the error and the offset of sensors in every recording.

    Args:
        sensors: The sensors, each with at least one recording.

    Returns:
        The figure: two sensors in a row; force on the left and moment on the right of each. Over days where all stamps
        have a date, else over recordings.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no sensor, or one without a recording.
    """
    if not sensors or not all(errors for _, errors, _ in sensors):
        raise ShapeError("sensors: expected at least one sensor, each with at least one recording")
    first = min(row.date for _, errors, _ in sensors for row in errors)
    rows = -(-len(sensors) // _COLUMNS)
    figure = new_figure(_ROW_INCHES * rows + 0.3)
    panels = figure.subplots(rows, 2 * _COLUMNS, squeeze=False)
    for place, (name, errors, limits) in enumerate(sensors):
        row, column = divmod(place, _COLUMNS)
        own = panels[row, 2 * column : 2 * column + 2]
        own[0].set_title(shown_name(name), loc="left", fontsize=SMALL_PANEL_POINTS, fontweight="bold")
        instants = [_days(one.date, first) for one in errors] if first != _NO_DATE else list(range(1, len(errors) + 1))
        for panel, (unit, size, offset), limit in zip(
            own,
            (("N", "force_error_rms_N", "offset_error_N"), ("N m", "moment_error_rms_Nm", "offset_error_Nm")),
            limits,
            strict=True,
        ):
            _draw(panel, instants, [[getattr(one, key) for one in errors] for key in (size, offset)], limit)
            panel.set_ylabel(unit, fontsize=SMALL_PANEL_POINTS)
    for panel in panels.ravel()[2 * len(sensors) :]:
        panel.set_axis_off()
    keys: list[tuple[str, Any]] = [(text, style.key) for text, style in _KEYS]
    keys.append(("allowed", THIN_REFERENCE_LINE))
    along = "recordings in the order of their stamps" if first == _NO_DATE else f"days since {first}"
    legend_below(figure, keys, title=f"from left to right: {along}")
    return figure


def _days(day: str, first: str) -> int:
    return (date.fromisoformat(day) - date.fromisoformat(first)).days


def _draw(panel: Axes, instants: Sequence[int], lines: Sequence[Sequence[float]], limit: float | None) -> None:
    for values, (_, style) in zip(lines, _KEYS, strict=True):
        panel.plot(instants, values, **style.key, **_LINE)
    if limit is not None:
        panel.axhline(limit, **THIN_REFERENCE_LINE)
    panel.set_ylim(bottom=0.0)
    panel.tick_params(labelsize=SMALL_PANEL_POINTS)
    panel.locator_params(nbins=4)
