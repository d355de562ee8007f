# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `thermal` in a few lines: the largest drift with temperature, and where to state it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.results.answer import EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import plus_minus

if TYPE_CHECKING:
    from forcetorque.sensor.temperature.temperature_drift import Thermal, ThermalDriftRow


def thermal_answers(thermal: Thermal) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        thermal: Drifts of sensors.

    Yields:
        One answer each.
    """
    for row in thermal.sensors:
        force, moment = (_largest(row.components[part]) for part in FORCE_AND_MOMENT)
        left = "left " if row.corrected else ""
        drift = f"{left}drift of {force.signal} {_drift(force)}"
        stated = row.variable_table() is not None
        yield Answer(
            subject=f"{row.sensor} ({row.serial})",
            verdict=drift if row.separable_from_time else "NOT SEPARABLE FROM DRIFT IN TIME",
            why=(
                f"{'largest' if row.separable_from_time else drift}; of the moments {left}drift of {moment.signal} "
                f"{_drift(moment)}",
                f"{row.samples} samples, {row.cycles:g} times heated and cooled, {row.lowest_degC:.1f} to "
                f"{row.highest_degC:.1f} degC",
            ),
            step="" if row.corrected else _STATE if stated else "record it heated and cooled several times",
            command=typed("bench", "thermal", EXPERIMENT, "--details") if stated else "",
            written=(thermal.figure_file,),
            concern=Concern.NONE if row.separable_from_time else Concern.UNCERTAIN,
        )


_STATE = "state prior_coefficients of the details as [[sensor.variable]], and calibrate"


def _largest(rows: Sequence[ThermalDriftRow]) -> ThermalDriftRow:
    return max(rows, key=lambda row: abs(row.drift_per_degC))


def _drift(row: ThermalDriftRow) -> str:
    return plus_minus(row.drift_per_degC, row.drift_half_width_95_per_degC, f"{row.unit}/degC")
