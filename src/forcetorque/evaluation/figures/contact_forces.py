# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a validation: contact force and joint torques that calibrations report where nothing touches."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.validation.answers import answered_choices, best_text
from forcetorque.evaluation.validation.contact_force_errors import ContactForceErrors
from forcetorque.evaluation.validation.validation import JointTorqueErrors
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.figures import (
    ROW_INCHES,
    Look,
    headline,
    in_figure_style,
    legend_below,
    looks,
    new_figure,
    shown_name,
)
from forcetorque.results.number_text import plus_minus

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.evaluation.validation.validation import Validation

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
