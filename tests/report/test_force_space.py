# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of forces along the axes: every cloud is drawn, whatever their number."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.report import force_space_figure
from forcetorque.report.canvas import COLOURS
from tests.report.drawing import panels


def test_more_clouds_than_colours_are_all_drawn(drawn: list[Figure]) -> None:
    """The first after the palette has its first colour again; none is left out."""
    clouds = [(f"cloud {k}", np.full((3, 3), float(k))) for k in range(len(COLOURS) + 1)]
    force_space_figure({"leg": clouds})
    for panel in panels(drawn[0]):
        assert [line.get_label() for line in panel.lines] == [name for name, _ in clouds]
        assert panel.lines[-1].get_color() == COLOURS[0]
