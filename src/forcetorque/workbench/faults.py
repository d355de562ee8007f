# SPDX-License-Identifier: BSD-3-Clause
"""Faults of benches: hypotheses, which of them the measurements show, and their rows and messages."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.calibration.generative.agreement import unmoved_directions
from forcetorque.results.table import Row, Shown
from forcetorque.workbench.known_loads import BenchLoads
from forcetorque.workbench.matrix_fit import (
    LEAST_SENSORS,
    ResidualSpace,
    Scatter,
    residual_scatter,
    robust_matrix,
    rotation_derivatives,
    scatter_of_sensors,
    shift_derivatives,
    specified_scatter,
)
from forcetorque.workbench.position_means import Bench


class Fault(StrEnum):
    """A kind of fault."""

    SWAPPED = "swapped"
    """The loads of two positions are exchanged."""
    WEIGHT = "wrong weight"
    """One weight is heavier or lighter than specified, as a share of it."""
    TILTED = "tilted"
    """Gravity has another direction at one position; rad."""
    DISPLACED = "displaced"
    """One weight hangs at another position; m."""
    COMPONENT = "wrong component"
    """One specified component of one wrench is wrong; N, N m."""
    PLATE_TILTED = "plate tilted"
    """Gravity has another direction at all positions, by one rotation in the sensor's axes; rad."""
    OTHER = "unlike the others"
    """One position disagrees with the others by none of these faults."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Signatures:
    """Effect of m faults of one kind on the loads."""

    fault: Fault
    """The kind."""
    components: tuple[int, ...] = ()
    """Component that each fault changes; none where they change all."""
    positions: IntArray
    """Positions that each fault changes; shape (m, k)."""
    change: FloatArray
    """Change of their wrenches per unit of each of d amounts; shape (m, k, 6, d)."""
    is_binary: bool = False
    """Whether a fault is there or not, so that its one amount is 1."""


def signatures(loads: BenchLoads) -> Iterator[Signatures]:
    """List the possible faults of loads.

    Yields:
        Faults by kind. Of weights: swapped, wrong, tilted, displaced, the plate; of specified wrenches: swapped as a
        whole or in one component, and single components.
    """
    n = len(loads)
    single = np.arange(n)[:, None]
    yield from _swaps(loads)
    yield Signatures(fault=Fault.WEIGHT, positions=single, change=loads.wrench[:, None, :, None])
    if loads.weights is None:
        for k in range(6):
            unit = np.broadcast_to(np.eye(6)[k][None, None, :, None], (n, 1, 6, 1))
            yield Signatures(fault=Fault.COMPONENT, components=(k,) * n, positions=single, change=unit)
    else:
        rotation, shift = rotation_derivatives(loads), shift_derivatives(loads)
        yield Signatures(fault=Fault.TILTED, positions=single, change=rotation[:, None])
        yield Signatures(fault=Fault.DISPLACED, positions=single, change=shift[:, None])
        yield Signatures(fault=Fault.PLATE_TILTED, positions=np.arange(n)[None], change=rotation[None])
    yield Signatures(fault=Fault.OTHER, positions=single, change=np.broadcast_to(np.eye(6)[None, None], (n, 1, 6, 6)))


def _swaps(loads: BenchLoads) -> Iterator[Signatures]:
    first, second = np.triu_indices(len(loads), k=1)
    difference = loads.wrench[second] - loads.wrench[first]
    yield _swap(first, second, difference, components=())
    if loads.weights is None:
        for k in range(len(WRENCH_COMPONENTS)):
            # only where the rest of the row differs too is a swap of one component another fault than one of all
            differs = (difference[:, k] != 0.0) & (np.delete(difference, k, axis=1) != 0.0).any(axis=1)
            if differs.any():
                kept = np.where(np.arange(6) == k, difference[differs], 0.0)
                yield _swap(first[differs], second[differs], kept, components=(k,) * int(differs.sum()))


def _swap(first: IntArray, second: IntArray, difference: FloatArray, components: tuple[int, ...]) -> Signatures:
    return Signatures(
        fault=Fault.SWAPPED,
        components=components,
        positions=np.column_stack([first, second]),
        change=np.stack([difference, -difference], axis=1)[..., None],
        is_binary=True,
    )


FALSE_ALARMS = 0.02
"""Share of undamaged sensors for which a fault is reported."""
MOST_FAULTS = 5
"""Largest number of faults that are searched of one sensor: where there are more, the bench is to be set up again."""

_RANK = 1e-9
_TINY = 1e-300
_SAME = 4.0
"""Squared distance in standard deviations up to which an amount is attributed to a known cause."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DetectedFault:
    """A fault that the measurements show."""

    fault: Fault
    """The kind."""
    positions: tuple[int, ...]
    """Indices of the positions; none for the plate."""
    component: int | None
    """The component, where the fault changes one only."""
    amount: FloatArray
    """Estimated amounts, in the units of the fault; shape (d,)."""
    standard_error: FloatArray
    """Their standard errors; shape (d,); 0 where an amount is unobservable."""
    log_probability: float
    """Logarithm of the share of undamaged sensors that show as much."""
    structure_forgotten: bool = False
    """Whether the amount is as if the mounting structure of the position were not there."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Evidence:
    """Significance of m faults of one kind for s sensors."""

    signatures: Signatures
    log_probability: FloatArray  # (s, m)
    amount: FloatArray  # (s, m, d)
    covariance: FloatArray  # (m, d, d)

    def fault(self, sensor: int, index: int) -> DetectedFault:
        """The fault of a sensor at an index of the signatures."""
        signatures = self.signatures
        is_plate = signatures.fault is Fault.PLATE_TILTED
        return DetectedFault(
            fault=signatures.fault,
            positions=() if is_plate else tuple(signatures.positions[index].tolist()),
            component=signatures.components[index] if signatures.components else None,
            amount=self.amount[sensor, index],
            standard_error=np.sqrt(np.maximum(np.diag(self.covariance[index]), 0.0)),
            log_probability=float(self.log_probability[sensor, index]),
        )


def detect_faults(
    loads: BenchLoads,
    residual: FloatArray,
    scatter: Scatter,
    *,
    kinds: Sequence[Fault] = tuple(Fault),
) -> tuple[DetectedFault, ...]:
    """Detect the faults of one sensor.

    Args:
        loads: Loads as specified.
        residual: Measurements less loads; shape (n, 6); N, N m.
        scatter: Scatter of positions.
        kinds: Kinds of fault to search.

    Returns:
        Faults, the most significant first; each is estimated together with those before it.
    """
    detected: list[DetectedFault] = []
    explained = np.zeros((6 * len(loads), 0))
    measured, covariance = residual + loads.wrench, scatter.covariance
    while len(detected) < MOST_FAULTS:
        space = ResidualSpace.of(loads.wrench, covariance, explained)
        residuals = (measured - loads.wrench)[None]
        (fault,) = most_significant_faults(loads, residuals, space, scatter.degrees_of_freedom, kinds=kinds)
        if fault is None or fault.log_probability > np.log(FALSE_ALARMS):
            break
        detected.append(fault)
        if fault.fault is Fault.SWAPPED:
            # the scatter belongs to the position at which a load really hung
            loads, covariance = _exchanged(loads, covariance, fault)
        else:
            explained = np.hstack([explained, _columns(loads, fault)])
    return tuple(detected)


def _exchanged(loads: BenchLoads, covariance: FloatArray, fault: DetectedFault) -> tuple[BenchLoads, FloatArray]:
    """Loads and scatter with two positions exchanged, as a whole or in one component."""
    first, second = fault.positions
    if fault.component is None:
        order = np.arange(len(loads))
        order[[first, second]] = second, first
        return replace(loads.select(order), names=loads.names), covariance[order]
    wrench = loads.wrench.copy()
    wrench[[first, second], fault.component] = wrench[[second, first], fault.component]
    return replace(loads, wrench=wrench), covariance


def most_significant_faults(
    loads: BenchLoads,
    residuals: FloatArray,
    space: ResidualSpace,
    degrees_of_freedom: float,
    *,
    kinds: Sequence[Fault] = tuple(Fault),
) -> list[DetectedFault | None]:
    """Find the most significant fault of every sensor, significant or not.

    Args:
        loads: Loads as specified, of all sensors.
        residuals: Measurements less loads; shape (s, n, 6); N, N m.
        space: Residuals of a linear fit of these loads.
        degrees_of_freedom: As of `Scatter`.
        kinds: Kinds of fault to search.

    Returns:
        A fault for every sensor; None where no kind applies to the loads.
    """
    weighted = space.weighted(residuals)
    hypotheses = [kind for kind in signatures(loads) if kind.fault in kinds and len(kind.positions)]
    evidence = [_evidence(kind, weighted, space, degrees_of_freedom) for kind in hypotheses]
    counts = {fault: sum(len(kind.positions) for kind in hypotheses if kind.fault is fault) for fault in Fault}
    for kind in evidence:
        kind.log_probability[...] += np.log(counts[kind.signatures.fault] * len({h.fault for h in hypotheses}))
    best: list[DetectedFault | None] = []
    for sensor in range(len(residuals)):
        tops = [(kind, int(kind.log_probability[sensor].argmin())) for kind in evidence]
        if not tops:
            best.append(None)
            continue
        kind, index = min(tops, key=lambda top: float(top[0].log_probability[sensor, top[1]]))
        best.append(_attributed_to_structure(kind.fault(sensor, index), loads))
    return best


def _evidence(kind: Signatures, weighted: FloatArray, space: ResidualSpace, degrees_of_freedom: float) -> _Evidence:
    shared = sum(
        np.einsum("spi,pid->spd", weighted[:, kind.positions[:, k]], kind.change[:, k])
        for k in range(kind.positions.shape[1])
    )  # (s, m, d)
    information = _information(kind, space)
    covariance = np.asarray(np.linalg.pinv(information, rcond=_RANK, hermitian=True), dtype=np.float64)
    amount = np.einsum("mde,sme->smd", covariance, shared)
    explained = (amount * shared).sum(axis=2)
    amounts = np.linalg.matrix_rank(information, tol=None, hermitian=True)
    if kind.is_binary:  # the amount is 1 or 0: what 1 explains, not what the best amount would
        explained = 2.0 * shared[..., 0] - information[:, 0, 0]
    return _Evidence(
        signatures=kind,
        log_probability=log_upper_tail(np.maximum(explained, 0.0), np.maximum(amounts, 1), degrees_of_freedom),
        amount=amount,
        covariance=covariance,
    )


def _information(kind: Signatures, space: ResidualSpace) -> FloatArray:
    """Fisher information of the amounts; shape (m, d, d)."""
    m, count, _, d = kind.change.shape
    if m == 1:  # over all positions at once
        flat = kind.change.reshape(6 * count, d)
        precision = space.precision.reshape(6 * count, 6 * count)
        return np.asarray((flat.T @ precision @ flat)[None], dtype=np.float64)
    information = np.zeros((m, d, d))
    for a in range(count):
        for b in range(count):
            blocks = space.precision[kind.positions[:, a], :, kind.positions[:, b], :]
            information += np.einsum("mid,mij,mje->mde", kind.change[:, a], blocks, kind.change[:, b])
    return information


def log_upper_tail(explained: FloatArray, amounts: FloatArray, degrees_of_freedom: float) -> FloatArray:
    """Compute the logarithm of the probability that chance explains as much.

    Args:
        explained: Explained sum of squares, in units of the scatter; shape (s, m).
        amounts: Number of amounts that explain it; shape (m,).
        degrees_of_freedom: Of the scatter; infinite where it is specified.

    Returns:
        Logarithms of the upper tail of a chi-squared, or of F where the scatter is estimated; shape (s, m).
    """
    from scipy.special import betaln, fdtrc, gammaincc, gammaln  # importing it takes longer than most commands

    half, count = 0.5 * explained, np.broadcast_to(0.5 * amounts, explained.shape)
    # beyond the smallest float the first term of the tail is exact enough to compare tails
    if np.isfinite(degrees_of_freedom):
        tail, rest = fdtrc(2.0 * count, degrees_of_freedom, half / count), 0.5 * degrees_of_freedom
        left = rest / (rest + half)
        far = (
            rest * np.log(left)
            + (count - 1.0) * np.log(np.maximum(1.0 - left, _TINY))
            - np.log(rest)
            - betaln(rest, count)
        )
    else:
        tail = gammaincc(count, half)
        far = (count - 1.0) * np.log(np.maximum(half, 1.0)) - half - gammaln(count)
    return np.where(tail > _TINY, np.log(np.maximum(tail, _TINY)), far)


def _attributed_to_structure(fault: DetectedFault, loads: BenchLoads) -> DetectedFault:
    """The fault, with a wrong weight marked where its amount is that of the mounting structure."""
    if fault.fault is not Fault.WEIGHT or loads.weights is None:
        return fault
    (position,) = fault.positions
    share = -loads.weights.structure_kg[position] / loads.weights.total_kg[position]
    distance = float((fault.amount[0] - share) / fault.standard_error[0]) ** 2
    return replace(fault, structure_forgotten=bool(share < 0.0 and distance <= _SAME))


def _columns(loads: BenchLoads, fault: DetectedFault) -> FloatArray:
    """Change of the loads of all positions per unit of the amounts of a fault; shape (6 n, d)."""
    for kind in signatures(loads):
        component = kind.components[0] if kind.components else None
        if kind.fault is not fault.fault or component != fault.component:
            continue
        positions = tuple(range(len(loads))) if fault.fault is Fault.PLATE_TILTED else fault.positions
        index = int(np.flatnonzero((kind.positions == positions).all(axis=1))[0])
        columns = np.zeros((len(loads), 6, kind.change.shape[3]))
        columns[list(positions)] = kind.change[index]
        return columns.reshape(6 * len(loads), -1)
    return np.zeros((6 * len(loads), 0))


_LEAST_PROBABILITY = 1e-300


class FaultRow(Row):
    """A fault that the measurements show."""

    serial: Annotated[str, Shown("serial")]
    """Serial number."""
    fault: Annotated[str, Shown("fault")]
    """Kind of fault."""
    positions: Annotated[tuple[str, ...], Shown("positions")]
    """Positions; none for the plate."""
    component: Annotated[str | None, Shown("component")]
    """Component, where the fault changes one only."""
    amount: Annotated[float, Shown("amount", digits=3, error="standard_error")]
    """Amount, in `unit`; the actual load less the specified one."""
    standard_error: float
    """Standard error of the amount."""
    unit: Annotated[str, Shown("unit")]
    """Unit of the amount."""
    probability: float
    """Share of undamaged sensors for which as much would be reported."""
    message: str
    """The fault as text."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FaultSearch:
    """A sensor whose positions were compared with each other."""

    bench: Bench
    """Measurements of the positions."""
    measured: FloatArray
    """Wrenches by a robust matrix; shape (n, 6); N, N m."""
    detected: tuple[DetectedFault, ...]
    """Faults, the most significant first."""
    scatter: str
    """Source of the scatter of positions."""

    @property
    def error(self) -> FloatArray:
        """Measured less known wrench; shape (n, 6); N, N m."""
        return self.measured - self.bench.loads.wrench

    def rows(self) -> tuple[FaultRow, ...]:
        """Make the records of the faults.

        Returns:
            A record per fault, the most significant first.
        """
        return tuple(_fault_row(fault, self.bench.loads, self.bench.serial) for fault in self.detected)


def search_faults(benches: Sequence[Bench], matrices: Sequence[FloatArray | None] | None = None) -> list[FaultSearch]:
    """Search faults of sensors.

    Args:
        benches: Sensors; a sensor whose loads do not move all six directions needs a matrix.
        matrices: Matrix of each where one is fitted; shape (6, c); by least squares where there is none.

    Returns:
        The search of every sensor.
    """
    matrix_of_each = matrices or [None] * len(benches)
    measured = [_robust_wrenches(bench, matrix) for bench, matrix in zip(benches, matrix_of_each, strict=True)]
    common = _common_scatter(benches, measured)
    searches = []
    for bench, wrench in zip(benches, measured, strict=True):
        scatter = common or _single_scatter(bench, wrench)
        detected = detect_faults(bench.loads, wrench - bench.loads.wrench, scatter)
        searches.append(FaultSearch(bench=bench, measured=wrench, detected=detected, scatter=scatter.source))
    return searches


def _robust_wrenches(bench: Bench, matrix: FloatArray | None) -> FloatArray:
    """Wrenches by a matrix that a single fault hardly changes."""
    if matrix is not None and unmoved_directions(bench.loads.wrench, [len(bench)]):
        return bench.wrenches(matrix)
    scatter = _single_scatter(bench, bench.wrenches(_by_least_squares(bench) if matrix is None else matrix))
    return bench.wrenches(robust_matrix(bench, scatter))


def _by_least_squares(bench: Bench) -> FloatArray:
    design = np.hstack([bench.loads.wrench, np.ones((len(bench), 1))])
    response = np.linalg.lstsq(design, bench.raw, rcond=None)[0][:6].T
    return np.asarray(np.linalg.pinv(response), dtype=np.float64)


def _single_scatter(bench: Bench, measured: FloatArray) -> Scatter:
    if bench.placement is None or bench.loads.weights is None:
        return residual_scatter(bench.loads.wrench, measured - bench.loads.wrench)
    matrix = np.linalg.lstsq(bench.raw, measured, rcond=None)[0].T
    return specified_scatter(bench, np.asarray(matrix, dtype=np.float64), bench.placement)


def _common_scatter(benches: Sequence[Bench], measured: Sequence[FloatArray]) -> Scatter | None:
    if len(benches) < LEAST_SENSORS or any(bench.placement is not None for bench in benches):
        return None
    loads = benches[0].loads
    if any(bench.loads.names != loads.names for bench in benches):
        return None
    covariances = [_single_scatter(bench, wrench).covariance for bench, wrench in zip(benches, measured, strict=True)]
    return scatter_of_sensors(loads.wrench, np.array(measured) - loads.wrench, np.median(covariances, axis=0))


def _fault_row(fault: DetectedFault, loads: BenchLoads, serial: str) -> FaultRow:
    names = tuple(loads.names[k] for k in fault.positions)
    component = None if fault.component is None else WRENCH_COMPONENTS[fault.component]
    amount, error, unit = _amount(fault)
    return FaultRow(
        serial=serial,
        fault="structure forgotten" if fault.structure_forgotten else fault.fault.value,
        positions=names,
        component=component,
        amount=amount,
        standard_error=error,
        unit=unit,
        probability=max(math.exp(max(fault.log_probability, -690.0)), _LEAST_PROBABILITY),
        message=f"{serial}: {_message(fault, names, component, amount, unit, loads.named)}",
    )


def _amount(fault: DetectedFault) -> tuple[float, float, str]:
    size = float(np.linalg.norm(fault.amount))
    error = float(np.linalg.norm(fault.standard_error))
    if fault.fault in (Fault.TILTED, Fault.PLATE_TILTED):
        return math.degrees(size), math.degrees(error), "deg"
    if fault.fault is Fault.DISPLACED:
        return 1e3 * size, 1e3 * error, "mm"
    if fault.fault is Fault.WEIGHT:
        return 100.0 * float(fault.amount[0]), 100.0 * error, "%"
    if fault.fault is Fault.SWAPPED:
        return float(fault.amount[0]), error, "1"
    if fault.fault is Fault.COMPONENT and fault.component is not None:
        return float(fault.amount[0]), error, WRENCH_UNITS[fault.component]
    force = float(np.linalg.norm(fault.amount[:3]))
    return force, float(np.linalg.norm(fault.standard_error[:3])), "N"


def _message(
    fault: DetectedFault, names: Sequence[str], component: str | None, amount: float, unit: str, named: str
) -> str:
    where = f" in {component}" if component else ""
    if fault.fault is Fault.SWAPPED:
        return f"{named}s {names[0]} and {names[1]} are swapped{where}"
    if fault.fault is Fault.PLATE_TILTED:
        return f"the plate is tilted by {amount:.2g} deg at all positions"
    position = f"{named} {names[0]}"
    if fault.structure_forgotten:
        return f"{position}: the mounting structure was not there ({amount:+.2g} %)"
    if fault.fault is Fault.WEIGHT:
        return f"{position}: the weight differs by {amount:+.2g} % from the table"
    if fault.fault is Fault.TILTED:
        return f"{position} is tilted by {amount:.2g} deg"
    if fault.fault is Fault.DISPLACED:
        return f"{position}: the weight hangs {amount:.2g} mm from its position"
    if fault.fault is Fault.COMPONENT:
        return f"{position}: {component} differs by {amount:+.2g} {unit} from the table"
    return f"{position} differs from all others by {amount:.2g} N, by no known fault"
