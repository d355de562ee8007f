# SPDX-License-Identifier: BSD-3-Clause
"""Figure of joint torques over time, estimated from different sensors, against a reference."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.constants import NORMAL_95
from forcetorque.errors import ShapeError
from forcetorque.report.figures.canvas import (
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    Look,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.inputs import drawable, drawable_each, instants
from forcetorque.report.figures.thinning import thinned_line
from forcetorque.report.figures.time_lines import draw_over_time

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_REFERENCE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (4, 1.5)), "linewidth": 1.4}


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
    for column, (panel, joint) in enumerate(zip(panels, joints, strict=True)):
        for k, (name, torque) in enumerate(torques.items()):
            sd = spread[name][:, column] if name in spread else None
            _draw(panel, time, torque[:, column], sd, look(k), turn=k, count=len(torques))
        if truth is not None:
            at, lines = thinned_line(time, truth[:, column, None])
            panel.plot(at, lines[:, 0], **_REFERENCE)
        panel.set_ylabel(f"{shown_name(joint)}, N m", fontsize=TITLE_POINTS)
        panel.tick_params(labelsize=SMALL_POINTS)
    figure.align_ylabels()
    panels[-1].set_xlabel("time, s", fontsize=TITLE_POINTS)
    keys = [
        (_named(name, torque, truth), look(k).key | {"linestyle": "-"})
        for k, (name, torque) in enumerate(torques.items())
    ]
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


def _named(name: str, torque: FloatArray, truth: FloatArray | None) -> str:
    if truth is None:
        return shown_name(name)
    errors = (torque - truth)[np.isfinite(torque - truth)]
    known = f"RMSE {np.sqrt(np.mean(errors**2)):.3g} N m" if len(errors) else "no samples"
    return f"{shown_name(name)}: {known}"
