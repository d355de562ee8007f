# SPDX-License-Identifier: BSD-3-Clause
"""Weigh what hangs on a wrist sensor, with the sensor's own reading."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.errors import ExperimentError
from forcetorque.result import COMPONENTS, AxisValues, Result, Table, WrenchValues, with_error


class WeighedLoad(Result):
    """What hangs on a wrist sensor, and the sensor's bias."""

    schema_name: Literal["forcetorque/payload/1"] = Field(default="forcetorque/payload/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    samples: int
    """Number of samples."""
    mass_kg: float
    """Mass."""
    mass_standard_error_kg: float
    """Its standard error."""
    mass_half_width_95_kg: float
    """Half-width of its 95 % interval."""
    centre_of_mass_m: AxisValues
    """Centre of mass in the sensor's frame."""
    centre_of_mass_standard_error_m: AxisValues
    """Its standard error."""
    centre_of_mass_half_width_95_m: AxisValues
    """Half-widths of its 95 % intervals."""
    bias: WrenchValues
    """Reading without load; N, N m."""
    residual_rms: WrenchValues
    """Root mean square residual; N, N m."""

    def blocks(self) -> Iterator[Table | str]:
        """Give mass and centre of mass, then bias and residual.

        Yields:
            A sentence and a table.
        """
        mass = with_error(self.mass_kg, self.mass_half_width_95_kg, digits=4)
        centre = ", ".join(
            with_error(1e3 * position, 1e3 * error, digits=2)
            for position, error in zip(self.centre_of_mass_m, self.centre_of_mass_half_width_95_m, strict=True)
        )
        source = f"{self.sensor} ({self.serial}), {self.samples} samples"
        yield f"{source}: {mass} kg at ({centre}) mm, ± half a 95 % interval"
        lines = (("bias", self.bias), ("residual RMS", self.residual_rms))
        yield Table(
            caption="",
            headings=("", *COMPONENTS),
            rows=tuple((name, *(f"{value:.4f}" for value in values)) for name, values in lines),
        )

    def records(self) -> list[dict[str, object]]:
        """Give the answer as one flat line.

        Returns:
            The line.
        """
        return [{key: value for key, value in self.flat().items() if key != "schema"}]


def weigh_load(run: SensorRun) -> WeighedLoad:
    """Give the load that the calibration intervals of an experiment tell.

    Args:
        run: The wrist sensor.

    Returns:
        Mass, centre of mass and bias, with their standard errors.

    Raises:
        ExperimentError: If the experiment is of a robot, or states the mass.
    """
    experiment, sensor = run.experiment, run.sensor
    payload = experiment.payload
    if payload is None:
        raise ExperimentError("expected [load] without mass_kg and centre_of_mass_m, which are to be estimated")
    return WeighedLoad(
        experiment=experiment.name,
        sensor=sensor.name,
        serial=sensor.serial,
        samples=payload.count,
        mass_kg=payload.mass,
        mass_standard_error_kg=payload.mass_error,
        mass_half_width_95_kg=payload.mass_half_width,
        centre_of_mass_m=payload.centre_of_mass,
        centre_of_mass_standard_error_m=payload.centre_of_mass_error,
        centre_of_mass_half_width_95_m=payload.centre_of_mass_half_width,
        bias=payload.bias,
        residual_rms=payload.residual_rms,
    )
