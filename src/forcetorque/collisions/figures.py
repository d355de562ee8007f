# SPDX-License-Identifier: BSD-3-Clause
"""Figure of contacts over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.results.figures import (
    LIMIT_LINE,
    PAPER,
    ROW_INCHES,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.results.visual_roles import CONTACT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.collisions.result import Collisions, JointCollisions


_FORCE: dict[str, Any] = {"color": look(0).colour, "linewidth": 0.8}
_CONTACT: dict[str, Any] = {"color": CONTACT.colour, "linewidth": 6.0, "alpha": 0.25}
_NAMED = 3
"""Contacts of a sensor that are named, the strongest first, each a line lower."""


@in_figure_style
def collisions_figure(result: Collisions) -> Figure:
    """Draw the force that every sensor reads too much over time, with contacts shaded and named.

    Args:
        result: Contacts, with the curves of the sensors.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(ROW_INCHES[1] * max(len(result.curves), 1))
    panels = figure.subplots(max(len(result.curves), 1), 1, sharex=True, squeeze=False)[:, 0]
    for panel, curve, sensor in zip(panels, result.curves, result.sensitivity, strict=False):
        time_s, force = np.asarray(curve.time_s), np.asarray(curve.force_N)
        gaps = np.flatnonzero(np.diff(time_s) > 1.0) + 1
        panel.plot(np.insert(time_s, gaps, np.nan), np.insert(force, gaps, np.nan), **_FORCE)
        panel.axhline(sensor.smallest_force_N, **LIMIT_LINE)
        own = [row for row in result.collisions if row.sensor == curve.sensor]
        for row in own:
            panel.axvspan(row.start_s, row.end_s, color=_CONTACT["color"], alpha=0.25, linewidth=0.0)
        for place, row in enumerate(sorted(own, key=lambda row: -row.force_N)[:_NAMED]):
            panel.annotate(
                f"{row.force_N:.3g} N, {shown_name(row.link)}",
                (row.end_s, 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(3, -12 * (place + 1)),
                textcoords="offset points",
                clip_on=True,
                color=CONTACT.colour,
                bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.5},
            )
        if own:  # room for the names
            panel.set_ylim(top=1.4 * float(force.max(initial=0.0)))
        panel.set_ylabel("force beyond the model, N")
        panel.set_title(
            f"{shown_name(curve.sensor)}: {_contacts(len(own))}, noticed from {sensor.smallest_force_N:.2g} N",
            loc="left",
            fontweight="bold",
        )
    panels[-1].set_xlabel("time, s")
    legend_below(figure, [("force beyond the model", _FORCE), ("noticed from", LIMIT_LINE), ("contact", _CONTACT)])
    strongest = max(result.collisions, key=lambda row: row.force_N, default=None)
    size = "" if strongest is None else f", up to {strongest.force_N:.3g} N on {shown_name(strongest.link)}"
    headline(figure, f"{shown_name(result.experiment)}: {_contacts(len(result.collisions))}{size}")
    return figure


@in_figure_style
def joint_collisions_figure(result: JointCollisions) -> Figure:
    """Draw the external torque of every joint over its threshold, with contacts shaded.

    Args:
        result: Contacts, with the curves of the joints.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(1.5 * ROW_INCHES[1])
    panel = figure.subplots()
    for k, curve in enumerate(result.curves):
        style = look(k)
        panel.plot(
            curve.time_s, curve.over_threshold, **style.key, markevery=0.1, linewidth=0.8, label=shown_name(curve.joint)
        )
    for sign in (-1.0, 1.0):
        panel.axhline(sign, **LIMIT_LINE)
    for row in result.contacts:
        panel.axvspan(row.start_s, row.end_s, color=_CONTACT["color"], alpha=0.25, linewidth=0.0)
    panel.set(xlabel="time, s", ylabel="external torque over threshold")
    headline(figure, f"{shown_name(result.experiment)}: {_contacts(len(result.contacts))}")
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure


def _contacts(count: int) -> str:
    return "1 contact" if count == 1 else f"{count or 'no'} contacts"
