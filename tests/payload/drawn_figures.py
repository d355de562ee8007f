# SPDX-License-Identifier: BSD-3-Clause
"""Figures of loads and of a tare, of random data."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from forcetorque.payload.figures import load_figure, tare_figure
from forcetorque.payload.result import LoadRow, RecordingLoadRow
from forcetorque.payload.tare_offset import TaredSensor, TareErrors


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


def draw_tare(rng: np.random.Generator) -> Figure:
    """A sensor with an offset before, and one with a long name without."""
    rows = []
    for sensor, before in (("arm_ft", rng.normal(size=6)), ("_left $wrist$ " + "x" * 70, None)):
        offset = rng.normal((5.0, -3.0, 12.0, 0.2, -0.1, 0.0), 0.5)
        errors = rng.normal(0.0, (0.2, 0.2, 0.2, 0.01, 0.01, 0.01), (400, 6))
        rows.append(
            TaredSensor(
                sensor=sensor,
                serial="FT1",
                wrench_source="the logged wrench",
                interval="at $rest$",
                samples=400,
                offset=offset,
                half_width_95=np.repeat([0.4, 0.02], 3),
                offset_before=before,
                load=np.array([0.0, 0.0, -14.7, 0.0, 0.1, 0.0]),
                load_moves_N=0.01,
                errors=TareErrors(
                    time_s=0.05 * np.arange(400),
                    before=errors - offset + (0.0 if before is None else before),
                    after=errors,
                ),
            )
        )
    return tare_figure(rows)


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
