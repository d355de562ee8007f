# SPDX-License-Identifier: BSD-3-Clause
"""The figure of force plates, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.plates.calibration_result import PlatePicture
from forcetorque.plates.figure import centre_error_figure


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
