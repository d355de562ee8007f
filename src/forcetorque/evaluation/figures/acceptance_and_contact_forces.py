# SPDX-License-Identifier: BSD-3-Clause
"""Figures of an acceptance, every criterion as a share of its limit, and of contact forces where nothing touches."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.acceptance.criteria import Criterion
from forcetorque.evaluation.validation.answers import answered_choices, best_text
from forcetorque.evaluation.validation.contact_force_errors import ContactForceErrors
from forcetorque.evaluation.validation.validation import JointTorqueErrors
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.figure_style import (
    GRID,
    LIMIT_LINE,
    ROW_INCHES,
    Look,
    headline,
    in_figure_style,
    legend_below,
    look,
    looks,
    new_figure,
    shown_name,
    two_digits,
)
from forcetorque.results.number_text import plus_minus
from forcetorque.results.visual_roles import LIMIT

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.evaluation.acceptance.acceptance import Acceptance
    from forcetorque.evaluation.validation.validation import Validation


_ROW_INCHES, _FRAME_INCHES = 0.24, 1.0
"""Height of a criterion, and of axis and margins; inch."""
_MOST = 35
"""Criteria that are drawn: those that fail or are nearest to their limits."""
_FARTHEST = 100.0
"""Times the limit, or below it, up to which shares are told apart."""
_HOLDS: dict[str, Any] = {"color": look(0).colour, "marker": look(0).marker, "linestyle": "none"}
_FAILS: dict[str, Any] = {"color": LIMIT.colour, "marker": "X", "linestyle": "none"}


@in_figure_style
def acceptance_figure(acceptance: Acceptance) -> Figure:
    """Draw how far criteria are from their limits.

    Returns:
        The figure: what was measured over its limit, and for a lower bound the limit over it, so that 1 is the limit
        and less holds; the worst on top, beside each its numbers.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no criterion.
    """
    if not acceptance.criteria:
        raise ShapeError("criteria: expected at least one to draw, got none")
    rows = sorted(acceptance.criteria, key=lambda row: row.share, reverse=True)[:_MOST]
    figure = new_figure(_FRAME_INCHES + _ROW_INCHES * max(len(rows), 6))
    panel = figure.subplots()
    low, high = (0.7 * min(0.5, *map(_drawn, rows)), 1.4 * max(2.0, *map(_drawn, rows)))
    for place, row in enumerate(rows):
        style = _HOLDS if row.passed else _FAILS
        panel.plot([low, _drawn(row)], [place, place], color=GRID, linewidth=1.2, zorder=1)
        panel.plot(_drawn(row), place, markersize=7.0, zorder=3, **style)
    panel.axvline(1.0, zorder=2, **LIMIT_LINE)
    panel.set(xscale="log", xlim=(low, high), ylim=(len(rows) - 0.5, -0.5))
    several = len({row.sensor for row in rows}) > 1
    panel.set_yticks(
        range(len(rows)), [shown_name(f"{row.sensor}: {row.criterion}" if several else row.criterion) for row in rows]
    )
    numbers = panel.secondary_yaxis("right")
    numbers.set_yticks(range(len(rows)), [_numbers(row) for row in rows])
    for axis in (panel, numbers):
        axis.tick_params(axis="y", length=0.0)
    panel.set_xlabel(f"share of the limit; what is below {1.0 / _FARTHEST:g} or above {_FARTHEST:g} is drawn there")
    failed = [row for row in rows if not row.passed]
    count = len(acceptance.criteria)
    headline(
        figure,
        f"{shown_name(acceptance.specification)}: {'accepted' if acceptance.accepted else 'NOT accepted'}, "
        f"{sum(row.passed for row in acceptance.criteria)} of {count} criteria hold"
        + (f"; farthest off: {shown_name(failed[0].criterion)}" if failed else "")
        + (f"; the {len(rows)} worst are drawn" if count > len(rows) else ""),
    )
    legend_below(figure, [("holds", _HOLDS), *([("fails", _FAILS)] if failed else []), ("limit", LIMIT_LINE)])
    return figure


def _drawn(row: Criterion) -> float:
    """Share of the limit within what the axis shows."""
    return float(np.clip(row.share, 1.0 / _FARTHEST, _FARTHEST))


def _numbers(row: Criterion) -> str:
    measured = two_digits(row.measured) if np.isfinite(row.measured) else "infinite"
    return f"{' '.join(filter(None, (measured, row.unit)))} ({row.bound} {row.limit:g})"


_Row = TypeVar("_Row", ContactForceErrors, JointTorqueErrors)
_SPREAD = 0.6
"""Part of the distance between two places over which calibrations stand beside each other."""


@in_figure_style
def validation_figure(validation: Validation) -> Figure:
    """Draw what calibrations report where nothing touches, which should be zero.

    Returns:
        The figure: for every sensor the mean contact force by offset, and the root mean square error of each joint
        torque, with the offset of the first second where there is one; lines are 95 % intervals.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no contact force.
    """
    if not validation.best:
        raise ShapeError("contact forces: expected at least one to draw, got none")
    sensors = list(dict.fromkeys(row.sensor for row in validation.contact_forces))
    styles = looks(list(dict.fromkeys(row.calibration for row in validation.contact_forces)))
    figure = new_figure(ROW_INCHES[1] * len(sensors))
    rows = figure.subplots(len(sensors), 2, squeeze=False, width_ratios=[1, 2])
    for sensor, (forces, torques) in zip(sensors, rows, strict=True):
        _draw_forces(forces, [row for row in validation.contact_forces if row.sensor == sensor], styles)
        _draw_torques(torques, [row for row in validation.joint_torques if row.sensor == sensor], styles)
        forces.set_title(f"{shown_name(sensor)}: contact force", loc="left")
    headline(figure, _headline(validation))
    legend_below(figure, [(shown_name(name), style.key | {"linestyle": "-"}) for name, style in styles.items()])
    return figure


def _headline(validation: Validation) -> str:
    """Who is best of the sensor whose least contact force is largest, as it is answered."""
    least = {}
    for choice in answered_choices(validation.best):
        key = (choice.sensor, choice.offset, choice.by_magnitude)
        row = next(row for row in validation.contact_forces if (row.sensor, row.offset, row.calibration) == key)
        least[choice.sensor] = (row, choice)
    row, choice = max(least.values(), key=lambda entry: entry[0].force_mean_N)
    name, verdict = shown_name(row.calibration), best_text(choice, shown_name(row.calibration))
    return (
        f"{shown_name(row.sensor)}{f', worst of {len(least)} sensors' if len(least) > 1 else ''}: "
        f"{f'{verdict}; ' if verdict else ''}contact force where nothing touches, {row.offset} offset: {name} "
        f"{plus_minus(row.force_mean_N, row.force_mean_half_width_95_N, 'N')}"
    )


def _draw_forces(panel: Axes, rows: Sequence[ContactForceErrors], styles: Mapping[str, Look]) -> None:
    offsets = list(dict.fromkeys(row.offset for row in rows))
    for row in rows:
        _draw(
            panel, offsets.index(row.offset), row.force_mean_N, row.force_mean_half_width_95_N, row.calibration, styles
        )
    panel.set_xticks(range(len(offsets)), [f"offset:\n{offset}" for offset in offsets])
    panel.set(ylabel="mean contact force, N", ylim=(0.0, None))
    panel.margins(x=0.3)


def _draw_torques(panel: Axes, rows: Sequence[JointTorqueErrors], styles: Mapping[str, Look]) -> None:
    shown = _shown_offset(rows)
    panel.set_title(f"joint torques, offset: {', '.join(dict.fromkeys(row.offset for row in shown))}", loc="left")
    joints = list(dict.fromkeys(row.joint for row in shown))
    for row in shown:
        _draw(panel, joints.index(row.joint), row.rmse, row.rmse_half_width_95, row.calibration, styles)
    if not shown:
        panel.text(0.5, 0.5, "no joint torque depends on it", ha="center", transform=panel.transAxes)
    panel.set_xticks(range(len(joints)), [shown_name(joint) for joint in joints], rotation=20.0, ha="right")
    panel.set(ylabel=f"RMSE, {' or '.join(dict.fromkeys(row.unit for row in shown))}", ylim=(0.0, None))


def _shown_offset(rows: Sequence[_Row]) -> Sequence[_Row]:
    """Those with the offset of the first second, which every candidate has; all where there is none."""
    return [row for row in rows if row.offset is Offset.FIRST_SECOND] or rows


def _draw(
    panel: Axes, place: int, value: float, half_width: float | None, name: str, styles: Mapping[str, Look]
) -> None:
    k, count = list(styles).index(name), len(styles)
    at = place + _SPREAD * ((k + 0.5) / count - 0.5)
    style = styles[name]
    if half_width is not None:
        panel.plot([at, at], [max(value - half_width, 0.0), value + half_width], color=style.colour, linewidth=1.6)
    panel.plot(at, value, linestyle="none", color=style.colour, marker=style.marker, markersize=7.0)
