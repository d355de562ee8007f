# SPDX-License-Identifier: BSD-3-Clause
"""Figure of clouds of forces as seen along the three axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle

from forcetorque.arrays import FloatArray
from forcetorque.report.canvas import COLOURS, ROW_INCHES, new_figure, png_bytes


def force_space_figure(clouds: Mapping[str, Sequence[tuple[str, FloatArray]]]) -> bytes:
    """Draw clouds of forces as seen along the three axes.

    Args:
        clouds: By the title of a row, names and forces of its clouds, drawn in this order; shape (n, 3); N.

    Returns:
        The figure as PNG, a row of three views per title.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(ROW_INCHES[1] * len(clouds))
    rows = figure.subplots(len(clouds), 3, squeeze=False)
    for panels, (title, named) in zip(rows, clouds.items(), strict=True):
        for panel, (first, second) in zip(panels, ((0, 1), (1, 2), (0, 2)), strict=True):
            for (name, force), colour in zip(named, cycle(COLOURS), strict=False):
                panel.plot(force[:, first], force[:, second], ".", color=colour, markersize=1.5, label=name)
            panel.set_aspect("equal", adjustable="datalim")
            panel.set_xlabel(f"f{'xyz'[first]}, N")
            panel.set_ylabel(f"f{'xyz'[second]}, N")
        panels[0].set_title(title, fontsize=10, loc="left")
        panels[-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, markerscale=6.0)
    return png_bytes(figure)
