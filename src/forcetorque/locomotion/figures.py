# SPDX-License-Identifier: BSD-3-Clause
"""Figures of feet and pressure, of net contact forces, of motions, and of torque control."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.locomotion.motion_quality import Motion, MotionCurve
from forcetorque.locomotion.net_force.result import Coherence, PhaseForce, policy_words
from forcetorque.locomotion.standing.interval_balance import IntervalBalance
from forcetorque.locomotion.torque_control.causes import OscillationCauses
from forcetorque.locomotion.torque_control.study import TorqueLoopRow, TorqueLoopStudy
from forcetorque.results.figures import (
    GRID,
    MUTED,
    PAPER,
    REFERENCE_COLOUR,
    ROW_INCHES,
    Look,
    draw_over_time,
    headline,
    in_figure_style,
    legend_below,
    look,
    looks,
    new_figure,
    shown_name,
    thinned_line,
    two_digits,
)
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_MM = 1e3
_MOST_POINTS = 1500
_WEIGHT: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (4, 1.5)), "linewidth": 1.2}
_OUTLINE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": "-", "linewidth": 1.0}


@in_figure_style
def balance_figure(interval: IntervalBalance) -> Figure:
    """Draw the load on each foot over time, shaded where it is down, and the points on soles and ground.

    Args:
        interval: How a robot stood over an interval; panels that it has nothing for are left out.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    planes = len(interval.feet) + (1 if interval.robot is not None else 0)
    figure = new_figure(ROW_INCHES[1] * (1.0 if not planes else 2.1))
    grid = figure.add_gridspec(2 if planes else 1, max(planes, 1))
    loads = figure.add_subplot(grid[0, :])
    _draw_loads(loads, interval)
    for k, foot in enumerate(interval.feet):
        panel = figure.add_subplot(grid[1, k])
        outline = foot.sole.outline
        if outline is not None:
            panel.plot(*(_MM * np.vstack([outline, outline[:1]])).T, **_OUTLINE)
        _draw_points(panel, foot.pressure.points, k)
        _plane(panel, foot.sole.frame)
    if interval.robot is not None:
        panel = figure.add_subplot(grid[1, planes - 1])
        if interval.robot.zero_moment_point is not None:
            _draw_points(panel, interval.robot.zero_moment_point, len(interval.feet) + 1)
        _draw_points(panel, interval.robot.pressure.points, len(interval.feet))
        _plane(panel, f"robot, in {interval.robot.frame}")
    headline(figure, _feet_bear(interval))
    legend_below(figure, _keys(interval))
    return figure


def _feet_bear(interval: IntervalBalance) -> str:
    """The mean load while a foot is down, and how many centres of pressure lie off their sole."""
    borne = interval.net_N[interval.phases.known & interval.phases.down.any(axis=1)]
    if not len(borne):
        return "No foot is down"
    load = f"The feet bear {borne.mean():.4g} N"
    if interval.weight_N is not None:
        load += f", {borne.mean() - interval.weight_N:+.1f} N from the weight"
    beyond = [foot.beyond_m for foot in interval.feet if foot.sole.outline is not None]
    points = np.concatenate([one[np.isfinite(one)] for one in beyond]) if beyond else np.empty(0)
    return f"{load}; {100.0 * (points > 0.0).mean():.2g} % of the points lie off their sole" if len(points) else load


def _draw_loads(panel: Axes, interval: IntervalBalance) -> None:
    count = len(interval.forces)
    for k, (force, down) in enumerate(zip(interval.forces.values(), interval.phases.down.T, strict=True)):
        at, lines = thinned_line(interval.time_s, force[:, None])
        draw_over_time(panel, at, lines[:, 0], look(k), turn=k, count=count)
        # a bar for each foot above the curves, where it is down
        panel.fill_between(
            interval.time_s,
            1.01 + 0.04 * (count - 1 - k),
            1.04 + 0.04 * (count - 1 - k),
            where=down.tolist(),
            transform=panel.get_xaxis_transform(),
            color=look(k).colour,
            linewidth=0.0,
            clip_on=False,
        )
    if interval.weight_N is not None:
        panel.axhline(interval.weight_N, **_WEIGHT)
    panel.set(xlabel="time, s", ylabel="load, N")


def _draw_points(panel: Axes, points: FloatArray, k: int) -> None:
    known = points[np.all(np.isfinite(points), axis=1)]
    rows = _MM * known[:: max(1, -(-len(known) // _MOST_POINTS))]
    panel.plot(rows[:, 0], rows[:, 1], linestyle="", marker=look(k).marker, markersize=2.5, color=look(k).colour)


def _plane(panel: Axes, title: str) -> None:
    panel.set(title=shown_name(title), xlabel="x, mm", ylabel="y, mm")
    panel.set_aspect("equal", adjustable="datalim")


def _keys(interval: IntervalBalance) -> list[tuple[str, dict[str, Any]]]:
    keys: list[tuple[str, dict[str, Any]]] = [
        (f"{shown_name(frame)}, bar: down", look(k).key | {"linestyle": "-"}) for k, frame in enumerate(interval.forces)
    ]
    if interval.weight_N is not None:
        keys.append(("weight of the robot", _WEIGHT))
    dots = {"linestyle": ""}
    if interval.robot is not None:
        keys.append(("centre of pressure, robot", look(len(interval.feet)).key | dots))
        if interval.robot.zero_moment_point is not None:
            keys.append(("zero moment point of the motion", look(len(interval.feet) + 1).key | dots))
    if any(foot.sole.outline is not None for foot in interval.feet):
        keys.append(("outline of the sole", _OUTLINE))
    return keys


_SPREAD = 0.5
"""Width that the candidates of one phase take, of that of the phase."""
_LONGEST_LABEL = 14
"""Characters of the name of a phase that stands level below its place; longer ones are turned."""


@in_figure_style
def coherence_figure(result: Coherence) -> Figure:
    """Draw what the net contact force of every phase is off the weight, with 95 % intervals.

    A row for each offset, a panel for each axis. Hollow is what is near zero by construction.

    Args:
        result: The answer.

    Returns:
        The figure, a row for each offset.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    offsets = list(dict.fromkeys((row.offset, row.offset_interval) for row in result.rows))
    names = short_names([row.calibration for row in result.rows])
    styles = looks(list(dict.fromkeys(names)))
    figure = new_figure(ROW_INCHES[1] * len(offsets))
    for line, panels in zip(offsets, figure.subplots(len(offsets), 3, squeeze=False, sharey="row"), strict=True):
        rows = [row for row in result.rows if (row.offset, row.offset_interval) == line]
        for axis, panel in enumerate(panels):
            _draw_coherence(panel, rows, styles, axis)
            panel.set_title(f"E{'xyz'[axis]}", loc="left")
        panels[0].set_ylabel(shown_name(f"{policy_words(*line)}; N"))
    keys: list[tuple[str, dict[str, Any]]] = [
        (shown_name(names[candidate]), {"color": one.colour, "marker": one.marker, "linestyle": "none"})
        for candidate, one in styles.items()
    ]
    if not all(row.evidence for row in result.rows):
        hollow = {"color": MUTED, "marker": "o", "markerfacecolor": PAPER, "linestyle": "none"}
        keys.append(("not evidence: the phase gave offset or matrix", hollow))
    worst = max(result.rows, key=lambda row: (row.evidence, float(np.linalg.norm(row.force_error_N))))
    size = two_digits(float(np.linalg.norm(worst.force_error_N)))
    headline(
        figure,
        f"Net force off the weight: mean of up to {size} N, {shown_name(worst.phase)} by "
        f"{shown_name(names[worst.calibration])}",
    )
    legend_below(figure, keys)
    return figure


def _draw_coherence(panel: Axes, rows: Sequence[PhaseForce], styles: dict[str, Look], axis: int) -> None:
    phases = list(dict.fromkeys(row.phase for row in rows))
    shift = dict(zip(styles, _SPREAD * (np.linspace(0.0, 1.0, len(styles) + 2)[1:-1] - 0.5), strict=True))
    for row in rows:
        one, x = styles[row.calibration], phases.index(row.phase) + shift[row.calibration]
        half = row.force_half_width_95_N[axis]
        panel.errorbar(
            [x],
            [row.force_error_N[axis]],
            yerr=None if half is None else [half],
            color=one.colour,
            marker=one.marker,
            markersize=5.0,
            markerfacecolor=one.colour if row.evidence else PAPER,
            linewidth=1.0,
            capsize=2.0,
        )
    panel.axhline(0.0, color=MUTED, linewidth=0.8, zorder=0)
    turned = max(map(len, phases)) * len(phases) > 3 * _LONGEST_LABEL
    panel.set_xticks(
        range(len(phases)),
        [shown_name(phase) for phase in phases],
        rotation=30.0 if turned else 0.0,
        ha="right" if turned else "center",
    )
    panel.set_xlim(-0.6, len(phases) - 0.4)
    panel.grid(visible=True, axis="y", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


MOST_CURVES = 6
"""Columns that are drawn, the first ones."""
_MEASURED, _SWING = look(0), look(1)


@in_figure_style
def motion_figure(motion: Motion) -> Figure:
    """Draw columns over time.

    Returns:
        The figure, a row for each column.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    curves = motion.curves[:MOST_CURVES]
    figure = new_figure(0.7 * ROW_INCHES[1] * max(len(curves), 1))
    panels = figure.subplots(max(len(curves), 1), 1, squeeze=False)[:, 0]
    for panel, curve in zip(panels, curves, strict=False):
        _draw_motion(panel, curve, motion)
    keys: list[tuple[str, Any]] = [("measured", {"color": _MEASURED.colour, "linestyle": _MEASURED.dashes})]
    if any(curve.swing is not None for curve in curves):
        keys.append(("mean, trend and swings", {"color": _SWING.colour, "linestyle": _SWING.dashes}))
    if motion.settling:
        keys.append(("step", {"color": REFERENCE_COLOUR, "linestyle": ":"}))
        keys.append(("settled", {"color": REFERENCE_COLOUR, "linestyle": "-"}))
    legend_below(figure, keys)
    swings = [row for row in motion.oscillations if row.oscillates]
    columns = dict.fromkeys((row.interval, row.column) for row in motion.oscillations)
    moving = dict.fromkeys((row.interval, row.column) for row in swings)
    fastest = max((row.frequency_hz or 0.0 for row in swings), default=0.0)
    count = f"Columns that oscillate: {len(moving)} of {len(columns)}"
    headline(figure, count + (f", at up to {fastest:.3g} Hz" if swings else ""))
    return figure


def _draw_motion(panel: Axes, curve: MotionCurve, motion: Motion) -> None:
    panel.plot(curve.time_s, curve.values, color=_MEASURED.colour, linestyle=_MEASURED.dashes, linewidth=1.0)
    if curve.swing is not None:
        panel.plot(curve.time_s, curve.swing, color=_SWING.colour, linestyle=_SWING.dashes, linewidth=1.2)
    for row in motion.settling:
        if curve.title == f"{row.interval}: {row.column}":
            panel.axvline(row.step_at_s, color=REFERENCE_COLOUR, linestyle=":", linewidth=1.0)
            if row.settling_s is not None:
                panel.axvline(row.step_at_s + row.settling_s, color=REFERENCE_COLOUR, linestyle="-", linewidth=1.0)
    swings = [row for row in motion.oscillations if row.oscillates and curve.title == f"{row.interval}: {row.column}"]
    words = ", ".join(f"{row.frequency_hz:.3g} Hz" for row in swings) or "no oscillation"
    panel.set_title(shown_name(f"{curve.title}: {words}"), loc="left")
    panel.set(ylabel=shown_name(curve.unit), xlabel="time, s")
    panel.set_xlim(*np.array([curve.time_s[0], curve.time_s[-1]]))


@in_figure_style
def torque_loop_figure(loop: TorqueLoopStudy) -> Figure:
    """Draw what the error of the sensors does, a curve per soles, gains and kind of error.

    Args:
        loop: The result.

    Returns:
        The figure: tracking error, share that swings on after a push, share that falls; bars are 95 % intervals.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(1.25 * ROW_INCHES[1])
    panels = figure.subplots(1, 3)
    curves = _curves(loop.rows)
    for k, (_, rows) in enumerate(curves):
        _draw_torque_loop(panels, rows, k)
    names = ("tracking error, N m", "swings on after a push, %", "falls, %")
    messages = (
        f"Tracking error: up to {max(row.tracking_rms_Nm for row in loop.rows):.2g} N m",
        _from_error_on([(row.force_error_N, row.oscillating) for row in loop.rows], "Swings on"),
        _from_error_on([(row.force_error_N, row.falls) for row in loop.rows], "Falls"),
    )
    for panel, name, message in zip(panels, names, messages, strict=True):
        panel.set(xlabel="force error of the sensors under the weight, N", ylabel=name)
        panel.set_title(message, loc="left", fontweight="bold")
    for panel in panels[1:]:
        panel.set_ylim(-3.0, 103.0)
    legend_below(figure, [(shown_name(name), look(k).key) for k, (name, _) in enumerate(curves)])
    return figure


def _from_error_on(counts: Sequence[tuple[float, int]], what: str) -> str:
    """The least error of the sensors at which a run had it."""
    errors = [error for error, count in counts if count > 0]
    return f"{what} in no run" if not errors else f"{what} first at {min(errors):.2g} N"


def _curves(rows: Sequence[TorqueLoopRow]) -> list[tuple[str, list[TorqueLoopRow]]]:
    """A curve per robot, gains and kind of error; each begins with the robot whose sensors have none."""
    curves = []
    for (tilt_deg, factor), group in groupby(rows, key=lambda row: (row.tilt_deg, row.gain_factor)):
        first, *others = group
        for errors, sized in groupby(others, key=lambda row: row.errors):
            name = f"{errors}, soles at {tilt_deg:g} deg" + (f", gains times {factor:g}" if factor != 1.0 else "")
            curves.append((name, [first, *sized]))
    return curves


def _draw_torque_loop(panels: Sequence[Axes], rows: Sequence[TorqueLoopRow], k: int) -> None:
    style = look(k)
    size = [row.force_error_N for row in rows]
    shares = [
        [(row.oscillating, row.oscillating_least_percent, row.oscillating_most_percent) for row in rows],
        [(row.falls, row.falls_least_percent, row.falls_most_percent) for row in rows],
    ]
    panels[0].plot(size, [row.tracking_rms_Nm for row in rows], linewidth=1.0, markersize=5.0, **style.key)
    for x, row in zip(size, rows, strict=True):
        half = row.tracking_half_width_95_Nm or 0.0
        panels[0].plot([x, x], [row.tracking_rms_Nm - half, row.tracking_rms_Nm + half], color=style.colour)
    for panel, counts in zip(panels[1:], shares, strict=True):
        values = [100.0 * count / row.runs for (count, _, _), row in zip(counts, rows, strict=True)]
        panel.plot(size, values, linewidth=1.0, markersize=5.0, **style.key)
        for x, (_, least, most) in zip(size, counts, strict=True):
            panel.plot([x, x], [least, most], color=style.colour, linewidth=1.0)


@in_figure_style
def oscillation_causes_figure(causes: OscillationCauses) -> Figure:
    """Draw the share of either errors that oscillates, a bar per cause, a panel per loop and sole.

    Args:
        causes: The result.

    Returns:
        The figure; lines are 95 % intervals of the larger errors.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    groups = {key: list(rows) for key, rows in groupby(causes.rows, key=lambda row: (row.loop, row.tilt_deg))}
    figure = new_figure(0.75 * ROW_INCHES[1] * len(groups))
    panels = np.ravel(figure.subplots(len(groups), 1, sharex=True, squeeze=False))
    for panel, ((loop, tilt_deg), rows) in zip(panels, groups.items(), strict=True):
        most = max(rows, key=lambda row: row.share)
        for k, row in enumerate(rows):
            panel.plot([row.larger_least_percent, row.larger_most_percent], [k, k], color=look(0).colour)
            for style, share in enumerate((row.share, row.smaller / row.draws)):
                panel.plot([100.0 * share], [k], markersize=5.0, **{**look(style).key, "linestyle": "none"})
        panel.set_yticks(
            range(len(rows)), [row.cause + ("" if row.at is None else f": {row.at:.3g}") for row in rows], fontsize=7
        )
        panel.invert_yaxis()
        panel.set_xlim(-3.0, 103.0)
        panel.set_title(
            f"{loop}, sole {tilt_deg:g} deg: at most {100.0 * most.share:.0f} % of '{causes.larger}' oscillate",
            loc="left",
            fontweight="bold",
        )
    panels[-1].set_xlabel("unstable draws, %")
    legend_below(figure, [(shown_name(name), look(k).key) for k, name in enumerate((causes.larger, causes.smaller))])
    return figure
