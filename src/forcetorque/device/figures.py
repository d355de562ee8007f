# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a calibration device: requirements, motion, motors, space, errors, and options for its excitation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.output_file import new_folder
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.figures.excitation import space_figure
from forcetorque.device.design import PICTURE_HZ, DeviceDesign
from forcetorque.device.error_budget import FORCE_LIMIT_N, MOMENT_LIMIT_NM
from forcetorque.device.excitation_and_predicted_errors import DirectionRow
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motors_hinge_and_envelope import VIEWS, EnvelopeRow
from forcetorque.device.requirements import GradeRow, RequirementRow, Verdict
from forcetorque.results.figure_style import (
    LIMIT_LINE,
    MUTED,
    REFERENCE_COLOUR,
    ROW_INCHES,
    draw_over_time,
    drawable_each,
    headline,
    in_figure_style,
    instants,
    legend_below,
    look,
    new_figure,
    number_log_axis,
    png_bytes,
    shown_name,
    thinned_line,
)
from forcetorque.results.number_text import amount
from forcetorque.results.visual_roles import TONES
from forcetorque.robot.motion import JointMotion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_REQUIREMENT_INCHES, _AROUND_INCHES = 0.24, 0.7
"""Height of a requirement, and of axes and title; inch."""
_VERDICTS: dict[Verdict, dict[str, Any]] = {
    Verdict.MET: {"color": TONES["good"].colour, "marker": "o", "linewidth": 2.0},
    Verdict.NOT_MET: {"color": TONES["bad"].colour, "marker": "X", "linewidth": 2.0},
}


@in_figure_style
def requirement_figure(design: DeviceDesign) -> Figure:
    """Draw the value of every requirement as a share of its limit.

    Args:
        design: The device.

    Returns:
        The figure, a line per requirement with value, limit and verdict; temperatures have no share.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    rows = design.demands.requirements
    figure = new_figure(_AROUND_INCHES + _REQUIREMENT_INCHES * len(rows))
    panel = figure.subplots()
    panel.axvline(1.0, **LIMIT_LINE)
    panel.set_xscale("log")
    for place, row in enumerate(rows):
        style = _VERDICTS.get(row.verdict)
        if style is not None and row.value and row.limit and row.unit != "degC":
            panel.plot([1.0, row.value / row.limit], [place, place], markevery=[1], **style)
        panel.text(
            1.01,
            place,
            _compared_words(row),
            transform=panel.get_yaxis_transform(),
            va="center",
            color=MUTED if style is None else style["color"],
        )
    panel.set_yticks(range(len(rows)), [f"{row.number}. {row.requirement}" for row in rows])
    panel.set_ylim(len(rows) - 0.5, -0.5)
    panel.margins(x=0.1)
    number_log_axis(panel.xaxis)
    panel.set_xlabel("value over its limit")
    counts = {verdict: sum(row.verdict is verdict for row in rows) for verdict in Verdict}
    headline(
        figure,
        f"{shown_name(design.device)} with {len(design.sensors)} sensor{'s' * (len(design.sensors) > 1)} meets "
        f"{counts[Verdict.MET]} of {counts[Verdict.MET] + counts[Verdict.NOT_MET]} requirements; "
        f"{counts[Verdict.NOT_COMPUTED]} more are not computed",
    )
    keys = [(str(verdict), style) for verdict, style in _VERDICTS.items()]
    legend_below(figure, [*keys, ("limit", LIMIT_LINE)])
    return figure


def _compared_words(row: RequirementRow) -> str:
    if row.value is None or row.limit is None:
        return f"{row.verdict}"
    return f"{amount(row.value, '')} of {row.limit:g} {row.unit}".rstrip() + f": {row.verdict}"


@in_figure_style
def device_figure(time_s: FloatArray, motion: JointMotion, torques: Mapping[str, FloatArray]) -> Figure:
    """Draw positions of joints, and torques on their axes, over time [1].

    Args:
        time_s: Instants that do not fall; shape (n,); s.
        motion: Motion of the joints at them; rad.
        torques: Torques by joint; shape (n,) each; N m.

    Returns:
        The figure, a panel for positions and one for torques.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is nothing to draw, or the shapes differ.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figures 6.5 and 6.9.
    """
    time = instants(time_s)
    positions = dict(zip(motion.names, np.rad2deg(motion.position).T, strict=True))
    rows = {"position, deg": positions, "torque, N m": torques}
    figure = new_figure(1.4 * ROW_INCHES[1])
    panels = figure.subplots(len(rows), 1, sharex=True)
    for panel, (label, lines) in zip(panels, rows.items(), strict=True):
        drawable_lines = drawable_each(lines, name=label, shape=(len(time),))
        for number, values in enumerate(drawable_lines.values()):
            at, drawn = thinned_line(time, values[:, None])
            draw_over_time(panel, at, drawn[:, 0], look(number), turn=number, count=len(drawable_lines))
        panel.set_ylabel(label)
    panels[-1].set_xlabel("time, s")
    figure.align_ylabels()
    peaks = {name: np.nanmax(np.abs(values), initial=0.0) for name, values in torques.items()}
    largest = max(peaks, key=lambda name: float(peaks[name]))
    headline(figure, f"Largest torque: {peaks[largest]:.3g} N m at {shown_name(largest)}")
    keys = [(shown_name(name), look(number).key | {"linestyle": "-"}) for number, name in enumerate(positions)]
    legend_below(figure, keys)
    return figure


_AXES = "xyz"


@in_figure_style
def envelope_figure(rows: Sequence[EnvelopeRow]) -> Figure:
    """Draw the swept space in each view, and the rectangle around it [1].

    Args:
        rows: The swept space, by view.

    Returns:
        The figure, a panel per view.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 6.13.
    """
    figure = new_figure(1.2 * ROW_INCHES[1])
    for panel, row in zip(figure.subplots(1, len(rows), squeeze=False)[0], rows, strict=True):
        _draw_envelope(panel, row)
    legend_below(
        figure,
        [
            ("convex hull of the swept space", {"color": look(0).colour, "linestyle": "-"}),
            ("rectangle around it", {"color": REFERENCE_COLOUR, "linestyle": "--"}),
        ],
    )
    largest = max(rows, key=lambda row: row.rectangle_m2)
    headline(
        figure, f"The rectangle around the swept space has up to {largest.rectangle_m2:.2f} m2, from {largest.view}"
    )
    return figure


def _draw_envelope(panel: Axes, row: EnvelopeRow) -> None:
    closed = np.concatenate([row.outline, row.outline[:1]])
    panel.fill(*closed.T, color=look(0).colour, alpha=0.2)
    panel.plot(*closed.T, color=look(0).colour, linewidth=1.4)
    low, high = row.outline.min(axis=0), row.outline.max(axis=0)
    corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]], low])
    panel.plot(*corners.T, color=REFERENCE_COLOUR, linestyle="--", linewidth=1.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.set_title(f"from {row.view}, {row.rectangle_m2:.2f} m2")
    first, second = VIEWS[row.view]
    panel.set(xlabel=f"{_AXES[first]}, m", ylabel=f"{_AXES[second]}, m")


_SIZES = (
    "root mean square",
    "largest, error of one",
    "largest component, errors of all",
    "largest norm, errors of all",
)


@in_figure_style
def reference_error_figure(grades: Sequence[GradeRow]) -> Figure:
    """Draw root mean squares and largest errors of forces and moments against the limits of requirement 6.

    Args:
        grades: Errors by grade.

    Returns:
        The figure: forces, and below moments.
    """
    ordered = sorted(grades, key=lambda row: (row.gravity_by, row.full_width))
    figure = new_figure(1.5 * ROW_INCHES[1])
    above, below = figure.subplots(2, 1, sharex=True)
    forces = [[row.rms[:3].max(), row.single_force_N, row.largest_force_N, row.force_norm_N] for row in ordered]
    moments = [[row.rms[3:].max(), row.single_moment_Nm, row.largest_moment_Nm, row.moment_norm_Nm] for row in ordered]
    _draw_errors(above, np.array(forces), FORCE_LIMIT_N, "error of the force, N")
    _draw_errors(below, np.array(moments), MOMENT_LIMIT_NM, "error of the moment, N m")
    below.set_xticks(
        range(len(ordered)),
        [f"{row.gravity_by}\n±{row.plus_minus:g} {row.unit}" for row in ordered],
    )
    headline(figure, _requirement_6(ordered))
    legend_below(
        figure,
        [
            *(
                (name, {"color": look(k).colour, "marker": look(k).marker, "linestyle": "none"})
                for k, name in enumerate(_SIZES)
            ),
            ("requirement 6", {"color": REFERENCE_COLOUR, "linestyle": "--"}),
        ],
    )
    return figure


def _requirement_6(rows: Sequence[GradeRow]) -> str:
    """How many grades meet the limits, and the least error."""
    met = sum(row.largest_force_N <= FORCE_LIMIT_N and row.largest_moment_Nm <= MOMENT_LIMIT_NM for row in rows)
    best = min(rows, key=lambda row: row.largest_moment_Nm)
    return (
        f"{met} of {len(rows)} grades meet requirement 6, {FORCE_LIMIT_N:g} N and {MOMENT_LIMIT_NM:g} N m; least error "
        f"of the moment: {best.largest_moment_Nm:.2g} N m by {best.gravity_by} of ±{best.plus_minus:.3g} {best.unit}"
    )


def _draw_errors(panel: Axes, errors: FloatArray, limit: float, label: str) -> None:
    for k in range(errors.shape[1]):
        places = np.arange(len(errors)) + 0.12 * (k - 1.5)
        panel.plot(places, errors[:, k], linestyle="none", marker=look(k).marker, color=look(k).colour, markersize=6.0)
    panel.axhline(limit, color=REFERENCE_COLOUR, linestyle="--", linewidth=1.0)
    panel.set_yscale("log")
    number_log_axis(panel.yaxis)
    panel.set_ylabel(label)


@in_figure_style
def predicted_error_figure(rows: Sequence[DirectionRow]) -> Figure:
    """Draw predicted errors by the axis that is loaded; undetermined ones are left out.

    Args:
        rows: Errors of force and moment, by motion of the calibration.

    Returns:
        The figure, a panel for each error.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is nothing to draw.
    """
    if not rows:
        raise ShapeError("excitation options: expected at least one row, got none")
    figure = new_figure(1.4 * ROW_INCHES[1])
    errors = tuple(dict.fromkeys(row.error for row in rows))
    names = tuple(dict.fromkeys(row.motion for row in rows))
    panels = figure.subplots(len(errors), 1, sharex=True, squeeze=False)[:, 0]
    for panel, error in zip(panels, errors, strict=True):
        for row in (row for row in rows if row.error == error):
            number = names.index(row.motion)
            values = np.array([getattr(row, component) for component in WRENCH_COMPONENTS])
            at = np.arange(6) + 0.7 * ((number + 0.5) / len(names) - 0.5)
            known = np.isfinite(values)
            style = look(number)
            panel.plot(at[known], values[known], linestyle="none", marker=style.marker, color=style.colour)
        panel.set(yscale="log", ylabel=f"error of {error}")
        panel.set_title(_least_worst([row for row in rows if row.error == error]), loc="left", fontweight="bold")
    panels[-1].set_xticks(range(6), WRENCH_COMPONENTS)
    panels[-1].set_xlabel("axis that is loaded, by 100 N or 5 N m")
    figure.align_ylabels()
    legend_below(figure, [(shown_name(name), look(k).key | {"linestyle": "none"}) for k, name in enumerate(names)])
    return figure


def _least_worst(rows: Sequence[DirectionRow]) -> str:
    """The motion whose worst axis errs least, of those that determine all axes."""
    error, _, unit = rows[0].error.partition(", ")
    worst = {row.motion: max(getattr(row, component) for component in WRENCH_COMPONENTS) for row in rows}
    best = min(worst, key=worst.__getitem__)
    if not np.isfinite(worst[best]):
        return f"No motion determines the {error} of every axis"
    return f"{shown_name(best)}: least {error} error of the worst axis, {worst[best]:.2g} {unit}"


def innermost_wrenches(design: DeviceDesign) -> dict[str, FloatArray]:
    """Compute the wrenches of the innermost sensor in the motions.

    Args:
        design: The device.

    Returns:
        By the names of the motions; shapes (n, 6); N, N m.
    """
    wrenches = {}
    for row in design.motions:
        trajectory = design.trajectories[row.motion]
        _, motion = trajectory.sampled(PICTURE_HZ)
        response = device_response(trajectory.device, trajectory.load, motion)
        wrenches[row.motion] = response.wrenches.of_name(design.sensors[0])
    return wrenches


def write_device_figures(design: DeviceDesign, output: Path) -> DeviceDesign:
    """Draw a device, all or nothing.

    Args:
        design: The device.
        output: Folder to make, for `motion.png` (figures 6.5 and 6.9 of the thesis), `space.png` (6.6 and 6.7),
            `options.png` (predicted errors by direction), `envelope.png` (6.13) and `errors.png` (Table 6.3).

    Returns:
        The result with the names of the files.
    """
    demands, trajectory = design.demands, design.trajectories[design.motions[0].motion]
    time_s, motion = trajectory.sampled(PICTURE_HZ)
    response = device_response(trajectory.device, trajectory.load, motion)
    torques = {joint: response.torque(joint) for joint in response.joints}
    figures = {
        "motion.png": device_figure(time_s, motion, torques),
        "space.png": space_figure(innermost_wrenches(design)),
        "options.png": predicted_error_figure(design.span.directions),
        "envelope.png": envelope_figure(demands.envelope),
        "errors.png": reference_error_figure(demands.grades),
    }
    with new_folder(output) as folder:
        for name, figure in figures.items():
            (folder / name).write_bytes(png_bytes(figure))
    return design.model_copy(update={"figures": tuple(str(output / name) for name in figures)})
