# SPDX-License-Identifier: BSD-3-Clause
"""Simulated sensors with known response on a bench with known faults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.workbench.known_loads import BenchLoads, Weights
from forcetorque.workbench.position_means import Bench, Placement

_LIMIT_COUNTS = 32767.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchFaults:
    """Faults of a bench beyond the scatter of placement; none by default. Positions are indices."""

    swapped: tuple[int, int] | None = None
    """Two positions whose loads are exchanged."""
    weight: Mapping[int, float] = field(default_factory=dict)
    """Relative error of the mass at a position."""
    no_structure: tuple[int, ...] = ()
    """Positions where the mounting structure is not there."""
    tilted_rad: Mapping[int, float] = field(default_factory=dict)
    """Angle between true and specified gravity at a position, about a random axis across it; rad."""
    plate_rad: float = 0.0
    """The same at all positions, about one random axis of the sensor; rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedBench:
    """Measurements of a simulated sensor on a bench, and its true response."""

    bench: Bench
    """The measurements."""
    response: FloatArray
    """True response; shape (6, 6); counts/N, counts/(N m)."""


def simulate_bench(
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
) -> SimulatedBench:
    """Simulate the measurements of a sensor under weights.

    Args:
        loads: Loads of weights, measured as `child_to_parent`.
        placement: Standard deviations of the placement; its nonlinearity is that of every channel at the largest raw
            sample of the bench, and falls with the square of the raw sample.
        rng: Source of sensor, placement and noise.
        faults: Faults of the bench; None for none.
        family: Family that the sensor is drawn from.
        serial: Serial number of the sensor.
        noise_counts: Standard deviation of the mean raw sample at a position; counts.
        with_prior: Whether the nominal matrix of the family is the prior matrix.
        response: Response of the sensor in place of one of the family; shape (c, 6); counts/N, counts/(N m).

    Returns:
        The measurements with the true response.

    Raises:
        SensorError: If no weights are known.
    """
    if loads.weights is None:
        raise SensorError("loads: expected weights with position and direction, got wrenches alone")
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
    return SimulatedBench(bench=bench, response=drawn)


def _placed(weights: Weights, placement: Placement, faults: BenchFaults, rng: np.random.Generator) -> FloatArray:
    """True wrenches; shape (n, 6)."""
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
