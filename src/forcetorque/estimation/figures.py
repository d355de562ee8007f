# SPDX-License-Identifier: BSD-3-Clause
"""Figures of contact forces where there should be none, and of joint torques over time."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError, UnitError, require_known
from forcetorque.base.units import NORMAL_95
from forcetorque.results.figure_style import (
    DRAWN_SAMPLES,
    GRID,
    MUTED,
    REFERENCE_COLOUR,
    ROW_INCHES,
    Look,
    draw_over_time,
    drawable,
    drawable_each,
    headline,
    in_figure_style,
    instants,
    legend_below,
    looks,
    new_figure,
    shown_name,
    text_inches,
    thinned_line,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_AXES = {"N": ("|f|", "fx", "fy", "fz"), "N m": ("|t|", "tx", "ty", "tz")}
"""By unit, what the rows show."""
_ROW_HEIGHT = 0.6 * ROW_INCHES[1]
_LINE_INCHES = 0.16
"""Height of a line of text; inch."""
_PANEL_INCHES = 0.9 * ROW_INCHES[0]
_LABEL_LINES = 3

Span = tuple[str, int, int]
"""Label, first sample and sample after the last."""


@in_figure_style
def contact_figure(
    time_s: FloatArray, candidates: Mapping[str, FloatArray], *, unit: str, spans: Sequence[Span] = ()
) -> Figure:
    """Draw contact forces, or torques, over time for several calibrations: magnitude and components [1].

    Sessions are drawn end to end, independently of the time between them, so that two days fit on one axis. A line of
    many samples keeps its peaks. The legend states the mean magnitude over the samples that are drawn.

    Args:
        time_s: Instants, not falling within a session; shape (n,); s.
        candidates: Contact forces or torques by calibration; shape (n, 3); in `unit`. What is not a finite number
            breaks the line.
        unit: `N` for forces, `N m` for torques.
        spans: Label, first sample and sample after the last of each session, in the order to draw; none for one session
            of all samples. Samples in no session are not drawn.

    Returns:
        The figure, a row for the magnitude and one for each component.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no candidates or no samples, the shapes differ, a session is not a range of samples, or
            time falls within one.
        UnitError: If the unit is another.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figures 5.6 and 5.7.
    """
    require_known(unit, _AXES, UnitError, f"unit: no contact force or torque is in {unit!r}")
    time = drawable(time_s, name="time_s", shape=(None,))
    by_name = drawable_each(candidates, name="candidates", shape=(len(time), 3))
    sessions = _end_to_end(time, spans or [("", 0, len(time))])
    figure = new_figure(4 * _ROW_HEIGHT)
    panels = figure.subplots(4, 1, sharex=True, height_ratios=(1.6, 1.0, 1.0, 1.0))
    keys, means = [], {}
    styles = looks(list(by_name))
    for k, (name, values) in enumerate(by_name.items()):
        columns = np.column_stack([np.linalg.norm(values, axis=1), values])
        at, lines = _thinned(sessions, columns)
        for row, panel in enumerate(panels):
            draw_over_time(panel, at, lines[:, row], styles[name], turn=k, count=len(by_name))
        magnitudes = np.concatenate([columns[session.samples, 0] for session in sessions])
        means[name] = _mean(magnitudes)
        keys.append((f"{shown_name(name)}: {_mean_text(means[name], unit)}", styles[name].key | {"linestyle": "-"}))
    for panel, label in zip(panels, _AXES[unit], strict=True):
        _dress(panel, f"{label}, {unit}", sessions)
    figure.align_ylabels()
    panels[-1].set_xlabel("time, s" if len(sessions) == 1 else "time, sessions end to end, s")
    _name_sessions(panels[0], sessions)
    legend_below(figure, keys)
    headline(figure, _mean_magnitudes(means, unit))
    return figure


def _mean_magnitudes(means: Mapping[str, float], unit: str) -> str:
    quantity = "force" if unit == "N" else "torque"
    known = {name: mean for name, mean in means.items() if np.isfinite(mean)}
    if not known:
        return f"No whole {quantity} of a contact"
    ends = (min(known, key=known.__getitem__), max(known, key=known.__getitem__))
    words = [f"{known[name]:.3g} {unit} ({shown_name(name)})" for name in dict.fromkeys(ends)]
    return f"Mean contact {quantity}: {' to '.join(words)}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Session:
    """A segment of samples and where it is drawn."""

    label: str
    samples: slice
    """Which samples it has."""
    time_s: FloatArray
    """Where they are along the axis; shape (n,); s."""


def _end_to_end(time_s: FloatArray, spans: Sequence[Span]) -> list[_Session]:
    """Sessions, each starting where the one before ended."""
    sessions: list[_Session] = []
    count = len(time_s)
    start_s = 0.0
    for label, start, stop in spans:
        if not 0 <= start < stop <= count:
            raise ShapeError(f"spans: session {label!r}: expected 0 <= start < stop <= {count}, got {start} and {stop}")
        time = instants(time_s[start:stop], name=f"time_s of session {label!r}")
        sessions.append(_Session(label=label, samples=slice(start, stop), time_s=time - time[0] + start_s))
        start_s = float(sessions[-1].time_s[-1])
    return sessions


def _thinned(sessions: list[_Session], columns: FloatArray) -> tuple[FloatArray, FloatArray]:
    total = sum(len(session.time_s) for session in sessions)
    parts = [
        thinned_line(session.time_s, columns[session.samples], max(2, DRAWN_SAMPLES * len(session.time_s) // total))
        for session in sessions
    ]
    return np.concatenate([time for time, _ in parts]), np.concatenate([lines for _, lines in parts])


def _mean(magnitudes: FloatArray) -> float:
    known = magnitudes[np.isfinite(magnitudes)]
    return float(known.mean()) if len(known) else np.nan


def _mean_text(mean: float, unit: str) -> str:
    return f"mean {_AXES[unit][0]} {mean:.3g} {unit}" if np.isfinite(mean) else "no samples"


def _dress(panel: Axes, label: str, sessions: list[_Session]) -> None:
    panel.set_ylabel(label)
    panel.margins(x=0.005)
    panel.grid(visible=True, axis="y", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)
    for session in sessions[1:]:
        panel.axvline(session.time_s[0], color=MUTED, linestyle=(0, (4, 3)), linewidth=min(1.0, 16.0 / len(sessions)))


def _name_sessions(panel: Axes, sessions: list[_Session]) -> None:
    """Write labels above the panel: level in a few lines if all fit in their sessions, else slanted, else upright."""
    whole = sessions[-1].time_s[-1] or 1.0
    rooms = [_PANEL_INCHES * float(np.ptp(each.time_s)) / whole for each in sessions]
    names = [shown_name(each.label) for each in sessions]
    wrapped = [_wrapped(name, room) for name, room in zip(names, rooms, strict=True)]
    level = None not in wrapped
    slant = 0.0 if level else 30.0 if min(rooms) > 2.5 * _LINE_INCHES else 90.0
    for name, lines, session in zip(names, wrapped, sessions, strict=True):
        panel.annotate(
            lines if level and lines is not None else name,
            (float(session.time_s[[0, -1]].mean()), 1.0),
            xycoords=panel.get_xaxis_transform(),
            xytext=(0.0, 4.0),
            textcoords="offset points",
            ha="center" if level else "left",
            va="bottom",
            rotation=slant,
            rotation_mode="anchor",
        )


def _wrapped(name: str, room: float) -> str | None:
    """A name in at most `_LABEL_LINES` lines that fit in a width in inch; None where it does not."""
    for count in range(1, _LABEL_LINES + 1):
        # a fifth more than their share: words do not fill lines evenly
        lines = textwrap.wrap(name, 1 + 6 * len(name) // (5 * count), break_long_words=False)
        if len(lines) <= count and max(text_inches(lines), default=0.0) < room:
            return "\n".join(lines)
    return None


_REFERENCE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (4, 1.5)), "linewidth": 1.4}


@in_figure_style
def torque_figure(
    time_s: FloatArray,
    joints: Sequence[str],
    estimates: Mapping[str, FloatArray],
    *,
    deviations: Mapping[str, FloatArray] | None = None,
    reference: tuple[str, FloatArray] | None = None,
) -> Figure:
    """Draw torques of joints over time by the sensors that they were estimated from [1].

    Bands are intervals of 95 %, where standard deviations are given. The legend states the root mean square of each
    estimate less the reference over all joints that are drawn.

    Args:
        time_s: Instants that do not fall; shape (n,); s.
        joints: Names of the k joints, rotary ones.
        estimates: Torques by what they were estimated from, such as the skin or a force-torque sensor; shape (n, k);
            N m. What is not a finite number breaks the line.
        deviations: Standard deviations of some of them; shape (n, k); N m.
        reference: Name and torques of what they are held against: the truth of a simulation, or another estimate;
            shape (n, k); N m.

    Returns:
        The figure, a panel for each joint.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is nothing to draw, the shapes differ, or a deviation is of no estimate.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 7.12.
    """
    time = instants(time_s)
    shape = (len(time), len(joints))
    if not joints:
        raise ShapeError("joints: expected at least one to draw, got none")
    torques = drawable_each(estimates, name="estimates", shape=shape)
    spread = drawable_each(deviations, name="deviations", shape=shape) if deviations else {}
    if unknown := sorted(set(spread) - set(torques)):
        raise ShapeError(f"deviations: expected those of {', '.join(torques)}, got one of {unknown[0]!r}")
    truth = None if reference is None else drawable(reference[1], name="reference", shape=shape)
    figure = new_figure(0.6 * ROW_INCHES[1] * len(joints))
    panels = figure.subplots(len(joints), 1, sharex=True, squeeze=False)[:, 0]
    styles = looks(list(torques))
    for column, (panel, joint) in enumerate(zip(panels, joints, strict=True)):
        for k, (name, torque) in enumerate(torques.items()):
            sd = spread[name][:, column] if name in spread else None
            _draw(panel, time, torque[:, column], sd, styles[name], turn=k, count=len(torques))
        if truth is not None:
            at, lines = thinned_line(time, truth[:, column, None])
            panel.plot(at, lines[:, 0], **_REFERENCE)
        panel.set_ylabel(f"{shown_name(joint)}, N m")
    figure.align_ylabels()
    panels[-1].set_xlabel("time, s")
    headline(figure, _message(joints, torques, truth))
    keys = [(_named(name, torque, truth), styles[name].key | {"linestyle": "-"}) for name, torque in torques.items()]
    legend_below(figure, [*keys, *([] if reference is None else [(shown_name(reference[0]), _REFERENCE)])])
    return figure


def _draw(
    panel: Axes, time: FloatArray, torque: FloatArray, sd: FloatArray | None, style: Look, *, turn: int, count: int
) -> None:
    if sd is None:
        at, lines = thinned_line(time, torque[:, None])
    else:
        half = NORMAL_95 * sd
        at, lines = thinned_line(time, np.column_stack([torque, torque - half, torque + half]))
        panel.fill_between(at, lines[:, 1], lines[:, 2], color=style.colour, alpha=0.2, linewidth=0.0)
    draw_over_time(panel, at, lines[:, 0], style, turn=turn, count=count)


def _message(joints: Sequence[str], torques: Mapping[str, FloatArray], truth: FloatArray | None) -> str:
    """Which estimate errs least; without a reference, the largest torque."""
    if truth is not None:
        known = np.isfinite(truth) & np.isfinite(np.stack(list(torques.values()))).all(axis=0)
        truth = np.where(known, truth, np.nan)  # one set of samples for all, else their order says nothing
        errors = {name: rmse for name, torque in torques.items() if (rmse := _rmse(torque, truth)) is not None}
        if not errors:
            return "No sample has all estimates and their reference"
        best = min(errors, key=errors.__getitem__)
        return f"{shown_name(best)} errs {'least, ' if len(errors) > 1 else ''}by {_Nm(errors[best])} RMSE"
    if not any(np.isfinite(torque).any() for torque in torques.values()):
        return "No sample has an estimate"
    peaks = {name: np.nanmax(np.abs(torque), axis=0, initial=0.0) for name, torque in torques.items()}
    name = max(peaks, key=lambda name: float(peaks[name].max()))
    joint = int(peaks[name].argmax())
    source = f", by {shown_name(name)}" if len(peaks) > 1 else ""
    return f"Largest torque: {_Nm(float(peaks[name][joint]))} at {shown_name(joints[joint])}{source}"


def _Nm(value: float) -> str:
    return f"{value:.3g} N m"


def _rmse(torque: FloatArray, truth: FloatArray) -> float | None:
    errors = (torque - truth)[np.isfinite(torque - truth)]
    return float(np.sqrt(np.mean(errors**2))) if len(errors) else None


def _named(name: str, torque: FloatArray, truth: FloatArray | None) -> str:
    if truth is None:
        return shown_name(name)
    rmse = _rmse(torque, truth)
    return f"{shown_name(name)}: {'no samples' if rmse is None else f'RMSE {_Nm(rmse)}'}"
