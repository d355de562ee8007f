# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the errors of the centre of pressure over a plate, before and after."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.results.figures import (
    COLOURS,
    REFERENCE_COLOUR,
    headline,
    in_figure_style,
    legend_below,
    new_figure,
    shown_name,
    two_digits,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.plates.calibration_result import PlatePicture

_LONGEST = 0.24
"""Length of the longest line, as a share of the longer half-edge."""
_LOAD = {"color": REFERENCE_COLOUR, "linestyle": "none", "marker": "o", "markersize": 3.0}


@in_figure_style
def centre_error_figure(picture: PlatePicture) -> Figure:
    """Draw the error of the centre of pressure at every load.

    Args:
        picture: Places of the loads, and errors.

    Returns:
        The figure: lines from where a load acts to the centre of pressure, enlarged as the title says, as measured and
        with the calibration by all other loads.
    """
    figure = new_figure(4.2)
    extent = np.abs(picture.place_mm).max(axis=0) if picture.half_edges_mm is None else picture.half_edges_mm
    kinds = {"as measured": picture.before_mm, "calibrated by the other loads": picture.after_mm}
    styles = [{"color": colour, "linewidth": 1.0} for colour in COLOURS[:2]]
    for panel, (name, errors), style in zip(figure.subplots(1, 2), kinds.items(), styles, strict=True):
        largest = max(float(np.linalg.norm(errors, axis=1).max()), 1e-9)
        scale = _LONGEST * float(extent.max()) / largest
        ends = picture.place_mm + scale * errors
        for axes in zip(picture.place_mm, ends, strict=True):
            panel.plot(*np.array(axes).T, **style)
        panel.plot(*picture.place_mm.T, **_LOAD)
        x, y = extent
        panel.plot([-x, x, x, -x, -x], [-y, -y, y, y, -y], color=REFERENCE_COLOUR, linewidth=0.8)
        panel.set_aspect("equal", adjustable="datalim")
        panel.set_title(f"{name}: up to {two_digits(largest)} mm, drawn {two_digits(scale)} times as long")
        panel.set_xlabel("x of the plate, mm")
        panel.set_ylabel("y of the plate, mm")
    before, after = (
        two_digits(float(np.linalg.norm(errors, axis=1).max())) for errors in (picture.before_mm, picture.after_mm)
    )
    headline(figure, f"Error of the centre of pressure: up to {before} mm as measured, {after} mm calibrated")
    words = [f"centre of pressure {name}" for name in kinds]
    keys = [("load", _LOAD), *zip(words, styles, strict=True)]
    legend_below(figure, [(shown_name(name), style) for name, style in keys])
    return figure
