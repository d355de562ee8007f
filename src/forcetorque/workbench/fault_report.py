# SPDX-License-Identifier: BSD-3-Clause
"""Faults of benches in rows and words: of one sensor, and of many at the same loads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.calibration.generative.agreement import unmoved_directions
from forcetorque.results.row import Row, Shown
from forcetorque.workbench.bench import Bench
from forcetorque.workbench.faults import Fault, Suspect, suspects
from forcetorque.workbench.fit import reading_matrix
from forcetorque.workbench.loads import BenchLoads
from forcetorque.workbench.scatter import LEAST_SENSORS, Scatter, own_scatter, scatter_of_sensors, stated_scatter

_LEAST_PROBABILITY = 1e-300


class FaultRow(Row):
    """A fault that the readings show."""

    serial: Annotated[str, Shown("serial")]
    """Serial number."""
    fault: Annotated[str, Shown("fault")]
    """Kind of fault."""
    positions: Annotated[tuple[str, ...], Shown("positions")]
    """Positions; none for the plate."""
    component: Annotated[str | None, Shown("component")]
    """Component, where it is about one."""
    amount: Annotated[float, Shown("amount", digits=3, error="standard_error")]
    """How much, in `unit`; the actual load less the stated one."""
    standard_error: float
    """Standard error of the amount."""
    unit: Annotated[str, Shown("unit")]
    """Unit of the amount."""
    probability: float
    """Share of sound sensors in which as much would be named."""
    sentence: str
    """The same in words."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Examined:
    """A sensor whose positions were held against each other."""

    bench: Bench
    """Its positions."""
    read: FloatArray
    """Wrenches by the positions that agree; shape (n, 6); N, N m."""
    suspects: tuple[Suspect, ...]
    """What is wrong."""
    scatter: str
    """Where the scatter of positions is from."""

    @property
    def error(self) -> FloatArray:
        """Read less known wrench; shape (n, 6); N, N m."""
        return self.read - self.bench.loads.wrench

    def rows(self) -> tuple[FaultRow, ...]:
        """Give its faults as rows.

        Returns:
            A row per fault, the plainest first.
        """
        return tuple(fault_row(suspect, self.bench.loads, self.bench.serial) for suspect in self.suspects)


def examine(benches: Sequence[Bench], matrices: Sequence[FloatArray | None] | None = None) -> list[Examined]:
    """Look for faults of sensors.

    Args:
        benches: Sensors; where the loads of one do not move all six directions it needs a matrix.
        matrices: Matrix of each where one is fitted; shape (6, c); by least squares where there is none.

    Returns:
        Every sensor with its faults.
    """
    matrix_of_each = matrices or [None] * len(benches)
    read = [_read(bench, matrix) for bench, matrix in zip(benches, matrix_of_each, strict=True)]
    common = _common_scatter(benches, read)
    examined = []
    for bench, wrench in zip(benches, read, strict=True):
        scatter = common or _single_scatter(bench, wrench)
        named = suspects(bench.loads, wrench - bench.loads.wrench, scatter)
        examined.append(Examined(bench=bench, read=wrench, suspects=named, scatter=scatter.source))
    return examined


def _read(bench: Bench, matrix: FloatArray | None) -> FloatArray:
    """Wrenches by a matrix that no single fault bends."""
    if matrix is not None and unmoved_directions(bench.loads.wrench, [len(bench)]):
        return bench.read_by(matrix)
    scatter = _single_scatter(bench, bench.read_by(_by_least_squares(bench) if matrix is None else matrix))
    return bench.read_by(reading_matrix(bench, scatter))


def _by_least_squares(bench: Bench) -> FloatArray:
    design = np.hstack([bench.loads.wrench, np.ones((len(bench), 1))])
    response = np.linalg.lstsq(design, bench.raw, rcond=None)[0][:6].T
    return np.asarray(np.linalg.pinv(response), dtype=np.float64)


def _single_scatter(bench: Bench, read: FloatArray) -> Scatter:
    if bench.placement is None or bench.loads.weights is None:
        return own_scatter(bench.loads.wrench, read - bench.loads.wrench)
    matrix = np.linalg.lstsq(bench.raw, read, rcond=None)[0].T
    return stated_scatter(bench, np.asarray(matrix, dtype=np.float64), bench.placement)


def _common_scatter(benches: Sequence[Bench], read: Sequence[FloatArray]) -> Scatter | None:
    if len(benches) < LEAST_SENSORS or any(bench.placement is not None for bench in benches):
        return None
    loads = benches[0].loads
    if any(bench.loads.names != loads.names for bench in benches):
        return None
    covariances = [_single_scatter(bench, wrench).covariance for bench, wrench in zip(benches, read, strict=True)]
    return scatter_of_sensors(loads.wrench, np.array(read) - loads.wrench, np.median(covariances, axis=0))


def fault_row(suspect: Suspect, loads: BenchLoads, serial: str) -> FaultRow:
    """Put a fault into words.

    Args:
        suspect: The fault.
        loads: Loads, for the names of positions.
        serial: Serial number of the sensor.

    Returns:
        The row.
    """
    names = tuple(loads.names[k] for k in suspect.positions)
    component = None if suspect.component is None else WRENCH_COMPONENTS[suspect.component]
    amount, error, unit = _amount(suspect)
    return FaultRow(
        serial=serial,
        fault="structure forgotten" if suspect.structure_forgotten else suspect.fault.value,
        positions=names,
        component=component,
        amount=amount,
        standard_error=error,
        unit=unit,
        probability=max(math.exp(max(suspect.log_probability, -690.0)), _LEAST_PROBABILITY),
        sentence=f"{serial}: {_words(suspect, names, component, amount, unit)}",
    )


def _amount(suspect: Suspect) -> tuple[float, float, str]:
    size = float(np.linalg.norm(suspect.amount))
    error = float(np.linalg.norm(suspect.standard_error))
    if suspect.fault in (Fault.TILTED, Fault.PLATE_TILTED):
        return math.degrees(size), math.degrees(error), "deg"
    if suspect.fault is Fault.DISPLACED:
        return 1e3 * size, 1e3 * error, "mm"
    if suspect.fault is Fault.WEIGHT:
        return 100.0 * float(suspect.amount[0]), 100.0 * error, "%"
    if suspect.fault is Fault.SWAPPED:
        return float(suspect.amount[0]), error, "1"
    if suspect.fault is Fault.COMPONENT and suspect.component is not None:
        return float(suspect.amount[0]), error, WRENCH_UNITS[suspect.component]
    force = float(np.linalg.norm(suspect.amount[:3]))
    return force, float(np.linalg.norm(suspect.standard_error[:3])), "N"


def _words(suspect: Suspect, names: Sequence[str], component: str | None, amount: float, unit: str) -> str:
    where = f" in {component}" if component else ""
    if suspect.fault is Fault.SWAPPED:
        return f"positions {names[0]} and {names[1]} are swapped{where}"
    if suspect.fault is Fault.PLATE_TILTED:
        return f"the plate is tilted by {amount:.2g} deg all through"
    position = f"position {names[0]}"
    if suspect.structure_forgotten:
        return f"{position} reads as if the mounting structure did not hang there ({amount:+.2g} %)"
    if suspect.fault is Fault.WEIGHT:
        return f"{position}: the weight is {amount:+.2g} % off what is stated"
    if suspect.fault is Fault.TILTED:
        return f"{position} is tilted by {amount:.2g} deg"
    if suspect.fault is Fault.DISPLACED:
        return f"{position}: the weight hangs {amount:.2g} mm beside its place"
    if suspect.fault is Fault.COMPONENT:
        return f"{position}: {component} is {amount:+.2g} {unit} off what is stated"
    return f"{position} is unlike all others by {amount:.2g} N, in a way that has no name"
