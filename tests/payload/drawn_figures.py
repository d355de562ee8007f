# SPDX-License-Identifier: BSD-3-Clause
"""The figure of loads, of random data."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from forcetorque.payload.figure import load_figure
from forcetorque.payload.result import LoadRow, RecordingLoadRow


def draw_load(rng: np.random.Generator) -> Figure:
    """A tool by three recordings, one of which leaves a coordinate open, and a plate as stated."""
    recordings = []
    for k in range(3):
        x, y, z = rng.normal((0.01, 0.0, 0.08), 0.002).tolist()
        recordings.append(
            RecordingLoadRow(
                recording=f"_day $ {k}",
                **_values("tool", 1.5 + 0.02 * float(rng.normal()), 0.03, (x, y, None if k == 2 else z), 0.004),
            )
        )
    tool = LoadRow(**_values("tool", 1.5, 0.01, (0.01, 0.0, 0.08), 0.001))
    plate = LoadRow(**_values("plate", 0.4, 0.0, (0.0, 0.0, 0.02), 0.0) | {"estimated": False})
    return load_figure([tool, plate], recordings)


def _values(name: str, mass: float, half_kg: float, centre: tuple[float | None, ...], half_m: float) -> dict[str, Any]:
    return {
        "load": name,
        "estimated": True,
        "mass_kg": mass,
        "mass_half_width_95_kg": half_kg,
        "centre_of_mass_m": centre,
        "centre_of_mass_half_width_95_m": tuple(None if value is None else half_m for value in centre),
        "inertia_kgm2": None,
        "inertia_half_width_95_kgm2": None,
    }
