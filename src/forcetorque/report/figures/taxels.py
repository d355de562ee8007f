# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a calibration of taxels: pressure and counts over time, how taxels differ, and the curves of one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.analysis.skin.picture import TaxelPicture
from forcetorque.report.figures.canvas import (
    COLOURS,
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.thinning import thinned_cloud, thinned_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SAMPLES: dict[str, Any] = {"color": COLOURS[1], "marker": "o", "markersize": 2.5, "markerfacecolor": "none"}
"""Samples of the one taxel: red circles, as in the thesis."""
_POINTS = 800
"""Points of one taxel that are drawn."""
_FORMS = (0, 2, 3, 4)
"""Looks of the curves: the second is that of the samples."""


def taxel_figure(picture: TaxelPicture) -> Figure:
    """Draw what taxels were calibrated with, and their curves.

    From the left: pressure and mean fall of the counts over time [1], the pressure of some taxels over their own fall
    [2], and the samples of one taxel with every form of curve [3].

    Args:
        picture: Samples of one recording, and curves of the first of its taxels.

    Returns:
        The figure, one row.

    Raises:
        MissingExtraError: If matplotlib is not installed.

    References:
        F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019): [1] figure 7.5; [2] figure 7.2;
        [3] figure 7.6.
    """
    figure = new_figure(ROW_INCHES[1])
    over_time, taxels, one = figure.subplots(1, 3)
    _draw_time(over_time, picture)
    _draw_taxels(taxels, picture)
    _draw_curves(one, picture)
    for panel, title in (
        (over_time, picture.recording),
        (taxels, f"{len(picture.names)} taxels"),
        (one, picture.names[0]),
    ):
        panel.set_title(shown_name(title), fontsize=TITLE_POINTS, loc="left")
        panel.tick_params(labelsize=SMALL_POINTS)
    legend_below(
        figure,
        [
            ("pressure", {"color": REFERENCE_COLOUR, "linestyle": "-"}),
            ("mean counts below rest", {"color": COLOURS[0], "linestyle": "--"}),
            (f"samples of {picture.names[0]}", _SAMPLES | {"linestyle": "none"}),
            *((form, _line(k)) for k, form in enumerate(picture.curves)),
            ("highest that was fitted", {"color": REFERENCE_COLOUR, "linestyle": ":"}),
        ],
    )
    return figure


def _draw_time(panel: Axes, picture: TaxelPicture) -> None:
    time, drawn = thinned_line(picture.seconds, np.column_stack([1e-3 * picture.pressure, picture.mean_fall]))
    panel.plot(time, drawn[:, 0], color=REFERENCE_COLOUR, linewidth=1.0)
    counts = panel.twinx()
    counts.plot(time, drawn[:, 1], color=COLOURS[0], linestyle="--", linewidth=1.0)
    counts.set_ylabel("mean fall, counts", fontsize=TITLE_POINTS)
    counts.tick_params(labelsize=SMALL_POINTS)
    panel.set_xlabel("time, s", fontsize=TITLE_POINTS)
    panel.set_ylabel("pressure, kPa", fontsize=TITLE_POINTS)


def _draw_taxels(panel: Axes, picture: TaxelPicture) -> None:
    for k in range(len(picture.names)):
        cloud = thinned_cloud(np.column_stack([picture.fall[:, k], 1e-3 * picture.pressure]), _POINTS)
        style = look(k)
        panel.plot(cloud[:, 0], cloud[:, 1], linestyle="none", color=style.colour, marker=style.marker, markersize=1.5)
    panel.set_xlabel("counts below rest", fontsize=TITLE_POINTS)
    panel.set_ylabel("pressure, kPa", fontsize=TITLE_POINTS)


def _draw_curves(panel: Axes, picture: TaxelPicture) -> None:
    cloud = thinned_cloud(np.column_stack([picture.fall[:, 0], 1e-3 * picture.pressure]), _POINTS)
    panel.plot(cloud[:, 0], cloud[:, 1], linestyle="none", **_SAMPLES)
    for k, curve in enumerate(picture.curves.values()):
        panel.plot(picture.levels, 1e-3 * curve, linewidth=1.4, **_line(k))
    panel.axhline(1e-3 * picture.highest, color=REFERENCE_COLOUR, linestyle=":", linewidth=1.0)
    # a polynomial beyond its range would else leave nothing to see of the samples
    highest = 1e-3 * float(picture.pressure.max())
    panel.set_ylim(-0.1 * highest, 1.2 * highest)
    panel.set_xlabel("counts below rest", fontsize=TITLE_POINTS)
    panel.set_ylabel("pressure, kPa", fontsize=TITLE_POINTS)


def _line(k: int) -> dict[str, Any]:
    style = look(_FORMS[k % len(_FORMS)])
    return {"color": style.colour, "linestyle": style.dashes}
