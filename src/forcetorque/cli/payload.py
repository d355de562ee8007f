# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque payload`: what hangs on a wrist sensor, with the sensor's bias."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.errors import ExperimentError
from forcetorque.experiment import load_experiment
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


class PayloadResult(BaseModel):
    """What `forcetorque payload` found."""

    model_config = ConfigDict(populate_by_name=True)

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
    """Its standard error, as far as residuals are independent."""
    centre_of_mass_m: list[float]
    """Centre of mass in the sensor's frame."""
    centre_of_mass_standard_error_m: list[float]
    """Its standard error."""
    bias: list[float]
    """Reading without load; N, N m."""
    residual_rms: list[float]
    """Root mean square residual; N, N m."""


def run(path: Path, *, output_format: Format) -> None:
    """Estimate the load on the calibration intervals.

    Args:
        path: Experiment file with a `[load]` table that leaves the mass out.
        output_format: Form of the result.

    Raises:
        ExperimentError: If the experiment is of a robot, or states the mass.
    """
    log = start_logging()
    log.info("reading %s", path)
    experiment = load_experiment(path)
    payload = experiment.payload
    if payload is None:
        raise ExperimentError(
            f"{path}: expected [load] without mass_kg and centre_of_mass_m, which are to be estimated"
        )
    (sensor,) = experiment.sensors
    result = PayloadResult(
        experiment=experiment.name,
        sensor=sensor.name,
        serial=sensor.serial,
        samples=payload.count,
        mass_kg=payload.mass,
        mass_standard_error_kg=payload.mass_error,
        centre_of_mass_m=payload.centre_of_mass.tolist(),
        centre_of_mass_standard_error_m=payload.centre_of_mass_error.tolist(),
        bias=payload.bias.tolist(),
        residual_rms=payload.residual_rms.tolist(),
    )
    print_result(
        result.model_dump(mode="json", by_alias=True), [_flat(result)], output_format, show=lambda: _show(result)
    )


def _flat(result: PayloadResult) -> dict[str, object]:
    flat: dict[str, object] = {}
    for key, value in result.model_dump(exclude={"schema_name"}).items():
        if isinstance(value, list):
            names = WRENCH_COMPONENTS if len(value) == 6 else ("x", "y", "z")
            flat |= {f"{key}_{name}": number for name, number in zip(names, value, strict=True)}
        else:
            flat[key] = value
    return flat


def _show(result: PayloadResult) -> None:
    screen = console()
    centre = ", ".join(
        f"{1e3 * value:.2f} ±{1e3 * error:.2f}"
        for value, error in zip(result.centre_of_mass_m, result.centre_of_mass_standard_error_m, strict=True)
    )
    screen.print(
        f"{result.sensor} ({result.serial}), {result.samples} samples: {result.mass_kg:.4f} "
        f"±{result.mass_standard_error_kg:.4f} kg at ({centre}) mm"
    )
    made = table("", *(f"{c}, {u}" for c, u in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)))
    made.add_row("bias", *(f"{value:.4f}" for value in result.bias))
    made.add_row("residual RMS", *(f"{value:.4f}" for value in result.residual_rms))
    screen.print(made)
