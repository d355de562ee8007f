# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the errors of the centre of pressure over a plate, before and after."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.results.figures import COLOURS, REFERENCE_COLOUR, in_figure_style, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.plates.calibration_result import PlatePicture

_LONGEST = 0.12
"""Length of the longest arrow, as a share of the longer edge."""


@in_figure_style
def centre_error_figure(picture: PlatePicture) -> Figure:
    """Draw the error of the centre of pressure at every load.

    Args:
        picture: Places of the loads, and errors.

    Returns:
        The figure: arrows from where a load acts to the centre of pressure, enlarged as the title says, as measured and
        with the calibration by all other loads.
    """
    figure = new_figure(4.2)
    extent = np.abs(picture.place_mm).max(axis=0) if picture.half_edges_mm is None else picture.half_edges_mm
    for panel, errors, title, colour in zip(
        figure.subplots(1, 2),
        (picture.before_mm, picture.after_mm),
        ("as measured", "calibrated by the other loads"),
        COLOURS,
        strict=False,
    ):
        largest = max(float(np.linalg.norm(errors, axis=1).max()), 1e-9)
        scale = _LONGEST * 2.0 * float(extent.max()) / largest
        tips = picture.place_mm + scale * errors
        panel.plot(
            np.stack([picture.place_mm[:, 0], tips[:, 0]]),
            np.stack([picture.place_mm[:, 1], tips[:, 1]]),
            color=colour,
            linewidth=1.0,
        )
        panel.plot(*picture.place_mm.T, linestyle="none", marker="o", markersize=3.0, color=REFERENCE_COLOUR)
        x, y = extent
        panel.plot([-x, x, x, -x, -x], [-y, -y, y, y, -y], color=REFERENCE_COLOUR, linewidth=0.8)
        panel.set_aspect("equal", adjustable="datalim")
        panel.set_title(f"{title}: largest {largest:.2g} mm, drawn x {scale:.2g}")
        panel.set_xlabel("x of the plate, mm")
        panel.set_ylabel("y of the plate, mm")
    return figure
