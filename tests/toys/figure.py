# SPDX-License-Identifier: BSD-3-Clause
"""A figure that nobody needs: all that adding one takes, for the test that adds it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from forcetorque.base.arrays import FloatArray
from forcetorque.results.figure_style import ROW_INCHES, legend_below, look, new_figure, shown_name

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def toy_figure(time_s: FloatArray, forces: Mapping[str, FloatArray]) -> Figure:
    """Draw the norms of forces over time.

    Args:
        time_s: Instants; shape (n,); s.
        forces: Forces by name; shape (n, 3) each; N.

    Returns:
        The figure.
    """
    figure = new_figure(ROW_INCHES[1])
    panel = figure.subplots()
    for k, force in enumerate(forces.values()):
        panel.plot(time_s, (force**2).sum(axis=1) ** 0.5, color=look(k).colour, linestyle=look(k).dashes)
    panel.set_xlabel("time, s")
    panel.set_ylabel("force, N")
    legend_below(figure, [(shown_name(name), look(k).key) for k, name in enumerate(forces)])
    return figure
