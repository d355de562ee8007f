# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a fleet: errors and offsets of sensors over time, and errors of sensors beside each other."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.fleet.sensor_evaluation import RecordingError
from forcetorque.fleet.table import FAR, prior_medians
from forcetorque.results.figure_style import (
    GRID,
    LIMIT_LINE,
    SMALL_PANEL_POINTS,
    THIN_REFERENCE_LINE,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.results.number_text import counted
from forcetorque.results.visual_roles import CALIBRATIONS, PRIOR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.fleet.report import FleetReport, RankedSensor
    from forcetorque.fleet.run import FleetRun
    from forcetorque.fleet.table import FleetTable

ErrorsOverTime = tuple[str, Sequence[RecordingError], tuple[float | None, float | None]]
"""Name of a sensor, its errors in the order of time, and the allowed errors of force and moment; N, N m; None where
there is no limit."""

_Errors = tuple[float | None, float | None]
"""Errors of force and moment; N, N m; None where there is none."""

_COLUMNS: Final = 2
"""Sensors in a row."""
_ROW_INCHES: Final = 1.6
"""Height of a row; inch."""
_NO_DATE: Final = "1970-01-01"
"""Day of stamps that count from the start of a recording."""
_LINE: Final[dict[str, Any]] = {"linewidth": 1.2, "markersize": 4.0}
_LIMIT: Final[dict[str, Any]] = {**LIMIT_LINE, "linewidth": 1.2}
_KEYS: Final = (("error without its mean (RMS)", look(0)), ("offset: norm of the mean error", look(1)))

MOST_OVER_TIME: Final = 12
"""Sensors of one figure over time."""
_MOST_SENSORS: Final = 30
"""Sensors that are drawn beside each other; the others are counted."""
_SENSOR_INCHES, _FRAME_INCHES = 0.26, 1.0
"""Height of a sensor, and of axes and titles; inch."""
_PRIOR: Final[dict[str, Any]] = {"color": PRIOR.colour, "marker": PRIOR.marker, "linestyle": "none"}
_CALIBRATION: Final[dict[str, Any]] = {
    "color": CALIBRATIONS[0].colour,
    "marker": CALIBRATIONS[0].marker,
    "linestyle": "none",
}


@in_figure_style
def over_time_figure(sensors: Sequence[ErrorsOverTime], message: str | None = None) -> Figure:
    """Draw the error and the offset of sensors in every recording.

    Args:
        sensors: The sensors, each with at least one recording.
        message: What the figure shows; none where a caption says it.

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
    keys.append(("allowed", _LIMIT))
    along = "recordings in the order of their stamps" if first == _NO_DATE else f"days since {first}"
    legend_below(figure, keys, title=f"from left to right: {along}")
    if message is not None:
        headline(figure, message)
    return figure


def _days(day: str, first: str) -> int:
    return (date.fromisoformat(day) - date.fromisoformat(first)).days


def _draw(panel: Axes, instants: Sequence[int], lines: Sequence[Sequence[float]], limit: float | None) -> None:
    for values, (_, style) in zip(lines, _KEYS, strict=True):
        panel.plot(instants, values, **style.key, **_LINE)
    if limit is not None:
        panel.axhline(limit, **_LIMIT)
    panel.set_ylim(bottom=0.0)
    panel.tick_params(labelsize=SMALL_PANEL_POINTS)
    panel.locator_params(nbins=4)
    panel.locator_params(axis="x", integer=True)


def errors_over_time(report: FleetReport, sensors: Sequence[RankedSensor]) -> list[ErrorsOverTime]:
    """Give the errors of sensors as they are drawn.

    Args:
        report: The report.
        sensors: Some of its evaluated sensors.

    Returns:
        An entry per sensor.
    """
    return [
        (
            f"{row.rank}. {row.subject}",
            [one for one in report.over_time if one.serial == row.serial],
            (row.allowed_N, row.allowed_Nm),
        )
        for row in sensors
    ]


def fleet_report_figure(report: FleetReport) -> Figure:
    """Draw error and offset of the worst sensors over time.

    Args:
        report: The report.

    Returns:
        The figure of `over_time_figure`, of 12 sensors at most.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If no sensor was evaluated.
    """
    if not report.ranked:
        why = "".join(f"; {row.subject}: {row.reason}" for row in report.unranked[:1])
        raise ShapeError(f"{report.dataset}: expected an evaluated sensor to draw, got none{why}")
    times = [row.times_allowed for row in report.ranked if row.times_allowed is not None]
    beyond = sum(one > 1.0 for one in times)
    message = (
        f"{shown_name(report.dataset)}: in the last recording {beyond} of {counted(len(times), 'sensor')} "
        f"{'errs' if beyond == 1 else 'err'} by more than is allowed"
    )
    shown = errors_over_time(report, report.ranked[:MOST_OVER_TIME])
    return over_time_figure(shown, message + _not_drawn(len(report.ranked) - MOST_OVER_TIME))


@in_figure_style
def fleet_table_figure(table: FleetTable) -> Figure:
    """Draw the errors of the priors beside each other, and the median of all.

    Args:
        table: Sensors of a dataset.

    Returns:
        The figure: a row per sensor, force on the left, moment on the right; the first 30 are drawn.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If no sensor has a prior.
    """
    rows = [row for row in table.sensors if row.prior_force_error_N is not None]
    far = [row.subject for row in rows if row.times_median is not None and row.times_median >= FAR]
    worst = f"; most that of {shown_name(far[0])}" if far else ""
    return _beside_each_other(
        [(row.subject, (row.prior_force_error_N, row.prior_moment_error_Nm), (None, None)) for row in rows],
        f"{shown_name(table.dataset)}: {len(far)} of {counted(len(rows), 'prior')} "
        f"{'errs' if len(far) == 1 else 'err'} by at least {FAR:.0f} times the median{worst}",
        medians=prior_medians(rows),
    )


@in_figure_style
def fleet_run_figure(run: FleetRun) -> Figure:
    """Draw the errors of all calibrations and of their priors on validation data.

    Args:
        run: What became of a plan.

    Returns:
        The figure: a row per sensor, force on the left, moment on the right; the first 30 are drawn.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If no sensor was calibrated that has validation data.
    """
    rows = [row for row in run.sensors if row.force_error_rms_N is not None]
    pairs = [(row.prior_force_error_rms_N, row.force_error_rms_N) for row in rows]
    less = [after < before for before, after in pairs if before is not None and after is not None]
    rest = len(run.sensors) - len(less)
    return _beside_each_other(
        [
            (
                f"{row.sensor} ({row.serial})",
                (row.prior_force_error_rms_N, row.prior_moment_error_rms_Nm),
                (row.force_error_rms_N, row.moment_error_rms_Nm),
            )
            for row in rows
        ],
        f"{shown_name(run.plan)}: on data not fitted the force error is below that of the prior for {sum(less)} of "
        f"{counted(len(less), 'sensor')}" + (f"; {rest} without validation data or prior" if rest else ""),
    )


def _not_drawn(rest: int) -> str:
    return f"; {counted(rest, 'more sensor')} not drawn" if rest > 0 else ""


def _beside_each_other(
    sensors: Sequence[tuple[str, _Errors, _Errors]], message: str, medians: tuple[float, float] | None = None
) -> Figure:
    """Name, errors of the prior and of the calibration of each sensor."""
    if not sensors:
        raise ShapeError("sensors: expected at least one with an error to draw, got none")
    shown = sensors[:_MOST_SENSORS]
    figure = new_figure(_FRAME_INCHES + _SENSOR_INCHES * max(len(shown), 3))
    panels = figure.subplots(1, 2, sharey=True)
    calibrated = any(error is not None for _, _, errors in shown for error in errors)
    for k, (panel, quantity) in enumerate(zip(panels, ("force error, N", "moment error, N m"), strict=True)):
        values = np.array([(before[k], after[k]) for _, before, after in shown], dtype=np.float64)
        places = np.arange(len(shown))
        panel.hlines(places, *values.T, color=PRIOR.colour, linewidth=1.2)
        for column, style in zip(values.T, (_PRIOR, _CALIBRATION), strict=True):
            panel.plot(column, places, **style)
        if medians is not None:
            panel.axvline(medians[k], **THIN_REFERENCE_LINE)
        panel.set_xlim(left=0.0)
        panel.set_title(quantity, loc="left")
        panel.grid(axis="x", color=GRID, linewidth=0.6)
    panels[0].set_yticks(range(len(shown)), [shown_name(name) for name, _, _ in shown])
    panels[0].set_ylim(len(shown) - 0.5, -0.5)
    keys: list[tuple[str, Any]] = [("prior matrix", _PRIOR)]
    keys += [("calibration", _CALIBRATION)] if calibrated else []
    keys += [("median of the priors", THIN_REFERENCE_LINE)] if medians is not None else []
    legend_below(figure, keys)
    headline(figure, message + _not_drawn(len(sensors) - _MOST_SENSORS))
    return figure
