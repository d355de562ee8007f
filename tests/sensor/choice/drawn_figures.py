# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a choice, of random loads."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.sensor.catalogue import sensor_catalogue
from forcetorque.sensor.choice.choice import rank_sensors
from forcetorque.sensor.choice.load_case import LoadCase
from forcetorque.sensor.figures import choice_figure


def draw_choice(rng: np.random.Generator) -> Figure:
    """Sensors and principles under a load with a long name."""
    x, y, z = (float(value) for value in 100.0 * rng.normal(size=3))
    load = LoadCase(name="_$landing$ " + "x" * 70, force_N=(x, y, z))
    return choice_figure(rank_sensors([load], sensor_catalogue(), margin=0.2))
