# SPDX-License-Identifier: BSD-3-Clause
"""The figures of force plates, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.plates.figures import centre_error_figure, standing_figure
from forcetorque.plates.result import PlatePicture, PlateRow, PlateWeight


def draw_centre_error(rng: np.random.Generator) -> Figure:
    """Errors at 40 places, large before and small after."""
    return centre_error_figure(
        PlatePicture(
            half_edges_mm=np.array([250.0, 200.0]),
            place_mm=rng.uniform(-180.0, 180.0, (40, 2)),
            before_mm=rng.normal(3.0, 2.0, (40, 2)),
            after_mm=rng.normal(0.0, 0.1, (40, 2)),
        )
    )


def draw_standing(rng: np.random.Generator) -> Figure:
    """Four plates: a person on two, one free, and one whose edges are not known."""
    forces = rng.uniform(150.0, 300.0, 4) * np.array([1.0, 1.0, 0.01, 1.0])
    rows = [
        PlateRow(
            plate=k + 1,
            type=2,
            force_N=float(force),
            is_negative=True,
            x_mm=None if k == 2 else float(rng.normal(0.0, 80.0)),
            y_mm=None if k == 2 else float(rng.normal(0.0, 80.0)),
            sway_mm=None if k == 2 else 9.0,
            half_edges_mm=None if k == 3 else np.array([250.0, 200.0]),
            alone_kg=None,
            alone_half_width_95_kg=None,
        )
        for k, force in enumerate(forces)
    ]
    return standing_figure(
        PlateWeight(
            file="standing.c3d",
            start_s=1.0,
            end_s=4.0,
            gravity=9.81,
            mass_kg=float(forces.sum()) / 9.81,
            half_width_95_kg=0.12,
            plates=tuple(rows),
            contradictions=(),
        )
    )
