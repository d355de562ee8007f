# SPDX-License-Identifier: BSD-3-Clause
"""The figure of temperature, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.sensor.figures import thermal_figure
from forcetorque.sensor.temperature.temperature_drift import SensorThermal, ThermalCurve, ThermalDriftRow


def draw_thermal(rng: np.random.Generator) -> Figure:
    """Drift over temperature of two sensors with a long name, heating and cooling apart."""
    degrees = np.concatenate([np.linspace(20.0, 40.0, 60), np.linspace(40.0, 20.0, 60)])
    heating = np.repeat([1.0, -1.0], 60)
    slopes = rng.normal(size=6)
    rows = tuple(
        ThermalDriftRow(
            signal=name,
            unit="N",
            drift_per_degC=float(slope),
            drift_standard_error_per_degC=0.1,
            drift_half_width_95_per_degC=0.2,
            hysteresis=1.0,
            hysteresis_half_width_95=0.1,
            drift_per_hour=None,
            drift_half_width_95_per_hour=None,
            residual_rms=0.1,
        )
        for name, slope in zip(WRENCH_COMPONENTS, slopes, strict=True)
    )
    reading = np.outer(degrees - 30.0, slopes) + 0.5 * heating[:, None] + 0.1 * rng.normal(size=(120, 6))
    curve = ThermalCurve(
        signals=tuple(f"{name}, N" for name in WRENCH_COMPONENTS),
        temperature_degC=degrees,
        heating=heating,
        measurement=reading,
        reference_degC=30.0,
    )
    sensor = SensorThermal(
        sensor="_left $wrist$ " + "x" * 70,
        serial="FT1",
        wrench_source="the logged wrench",
        variable="temperature",
        thermometer_lag_s=None,
        thermometer_lag_half_width_95_s=None,
        samples=120,
        sessions=1,
        lowest_degC=20.0,
        highest_degC=40.0,
        reference_degC=30.0,
        cycles=1.0,
        separable_from_time=True,
        components=rows,
        channels=(),
        corrected=False,
        curve=curve,
    )
    return thermal_figure([sensor, sensor])
