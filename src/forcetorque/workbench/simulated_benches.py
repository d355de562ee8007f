# SPDX-License-Identifier: BSD-3-Clause
"""Sensors with known truth on a bench with known faults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.workbench.bench import Bench, Placement
from forcetorque.workbench.loads import BenchLoads, Weights

_LIMIT_COUNTS = 32767.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchFaults:
    """What goes wrong beside placement; nothing by default. Positions by number."""

    swapped: tuple[int, int] | None = None
    """Two positions whose loads are exchanged."""
    weight: Mapping[int, float] = field(default_factory=dict)
    """Share by which the mass at a position differs from what is stated."""
    no_structure: tuple[int, ...] = ()
    """Positions where the mounting structure is not there."""
    tilted_rad: Mapping[int, float] = field(default_factory=dict)
    """Angle by which gravity points elsewhere at a position, about a random axis across it; rad."""
    plate_rad: float = 0.0
    """Angle by which it points elsewhere at all positions, about one random axis of the sensor; rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Specimen:
    """A sensor and what it read on the bench."""

    bench: Bench
    """What is known of it."""
    response: FloatArray
    """True response; shape (6, 6); counts/N, counts/(N m)."""


def simulate_specimen(
    loads: BenchLoads,
    placement: Placement,
    rng: np.random.Generator,
    *,
    faults: BenchFaults | None = None,
    family: str = "standard",
    serial: str = "SIM001",
    noise_counts: float = 0.3,
    with_prior: bool = False,
    response: FloatArray | None = None,
) -> Specimen:
    """Hang weights on a simulated sensor.

    Args:
        loads: Loads of weights, as a reading of `child_to_parent`.
        placement: How far weights are off where they are said to be; its nonlinearity is that of every channel at the
            largest reading of the bench, and falls with the square of the reading.
        rng: Source of sensor, placement and noise.
        faults: What goes wrong besides; None for nothing.
        family: Family that the sensor is drawn from.
        serial: Its serial number.
        noise_counts: Standard deviation of the mean reading at a position; counts.
        with_prior: Whether the nominal matrix of the family is known.
        response: Response of the sensor in place of one of the family; shape (c, 6); counts/N, counts/(N m).

    Returns:
        The sensor, and what is known of it.

    Raises:
        SensorError: If no weights are known.
    """
    if loads.weights is None:
        raise SensorError("loads: expected weights with place and direction, got wrenches alone")
    drawn = FAMILIES[family].draw(rng) if response is None else response
    wrench = _placed(loads.weights, placement, faults or BenchFaults(), rng)
    counts = wrench @ drawn.T
    largest = np.abs(counts).max()
    bend = placement.nonlinearity * largest * rng.choice([-1.0, 1.0], drawn.shape[0])
    counts = counts + bend * (counts / largest) ** 2 + noise_counts * rng.standard_normal(counts.shape)
    prior = np.asarray(np.linalg.inv(FAMILIES[family].nominal()), dtype=np.float64) if with_prior else None
    bench = Bench(
        sensor="ft",
        serial=serial,
        loads=loads,
        raw=counts,
        standard_error=np.full(counts.shape, noise_counts),
        full_scale=np.full(drawn.shape[0], _LIMIT_COUNTS),
        prior=prior,
        placement=placement,
    )
    return Specimen(bench=bench, response=drawn)


def _placed(weights: Weights, placement: Placement, faults: BenchFaults, rng: np.random.Generator) -> FloatArray:
    """Wrenches that act in truth; shape (n, 6)."""
    n = len(weights.mass_kg)
    mass, structure = weights.mass_kg.copy(), weights.structure_kg.copy()
    turn = placement.angle_rad * rng.standard_normal((n, 3))
    for position, share in faults.weight.items():
        mass[position] += share * weights.total_kg[position]
    structure[list(faults.no_structure)] = 0.0
    for position, angle in faults.tilted_rad.items():
        across = np.cross(weights.direction[position], rng.standard_normal(3))
        turn[position] += angle * across / np.linalg.norm(across)
    axis = rng.standard_normal(3)
    turn += faults.plate_rad * axis / np.linalg.norm(axis)
    true = replace(
        weights,
        mass_kg=mass,
        structure_kg=structure,
        position_m=weights.position_m + placement.position_m * rng.standard_normal((n, 3)),
        direction=weights.direction + np.cross(turn, weights.direction),
    )
    wrench = true.wrench(measure_direction=MeasureDirection.CHILD_TO_PARENT).copy()
    if faults.swapped is not None:
        wrench[list(faults.swapped)] = wrench[list(faults.swapped)[::-1]]
    return wrench
