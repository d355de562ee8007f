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
from forcetorque.workbench.bench import Bench
from forcetorque.workbench.fit import (
    LEAST_SENSORS,
    ResidualSpace,
    Scatter,
    moved_loads,
    own_scatter,
    reading_matrix,
    scatter_of_sensors,
    stated_scatter,
    turned_loads,
)
from forcetorque.workbench.loads import BenchLoads


class Fault(StrEnum):
    """A kind of fault."""

    SWAPPED = "swapped"
    """Two positions have each other's load."""
    WEIGHT = "wrong weight"
    """One weight is heavier or lighter than stated, as a share of it."""
    TILTED = "tilted"
    """Gravity points elsewhere at one position; rad."""
    DISPLACED = "displaced"
    """One weight hangs elsewhere; m."""
    COMPONENT = "wrong component"
    """One stated component of one wrench is wrong; N, N m."""
    PLATE_TILTED = "plate tilted"
    """Gravity points elsewhere at all positions, by one rotation in the sensor's axes; rad."""
    OTHER = "unlike the others"
    """One position disagrees in a way that has no name."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Signatures:
    """What faults of one kind do, one per set of positions."""

    fault: Fault
    """The kind."""
    components: tuple[int, ...] = ()
    """The component that each is about; none where they are about all."""
    positions: IntArray
    """Positions that each changes; shape (m, k)."""
    change: FloatArray
    """Change of their wrenches per unit of each of d amounts; shape (m, k, 6, d)."""
    whole: bool = False
    """Whether it happens or not, so that its one amount is 1."""


def signatures(loads: BenchLoads) -> Iterator[Signatures]:
    """List what can be wrong with loads.

    Args:
        loads: The loads.

    Yields:
        Faults by kind. Of weights: swapped, wrong, tilted, displaced, the plate; of stated wrenches: swapped as a
        whole or in one component, and single components.
    """
    n = len(loads)
    alone = np.arange(n)[:, None]
    yield from _swaps(loads)
    yield Signatures(fault=Fault.WEIGHT, positions=alone, change=loads.wrench[:, None, :, None])
    if loads.weights is None:
        for k in range(6):
            unit = np.broadcast_to(np.eye(6)[k][None, None, :, None], (n, 1, 6, 1))
            yield Signatures(fault=Fault.COMPONENT, components=(k,) * n, positions=alone, change=unit)
    else:
        turned, moved = turned_loads(loads), moved_loads(loads)
        yield Signatures(fault=Fault.TILTED, positions=alone, change=turned[:, None])
        yield Signatures(fault=Fault.DISPLACED, positions=alone, change=moved[:, None])
        yield Signatures(fault=Fault.PLATE_TILTED, positions=np.arange(n)[None], change=turned[None])
    yield Signatures(fault=Fault.OTHER, positions=alone, change=np.broadcast_to(np.eye(6)[None, None], (n, 1, 6, 6)))


def _swaps(loads: BenchLoads) -> Iterator[Signatures]:
    first, second = np.triu_indices(len(loads), k=1)
    apart = loads.wrench[second] - loads.wrench[first]
    yield _swap(first, second, apart, components=())
    if loads.weights is None:
        for k in range(len(WRENCH_COMPONENTS)):
            # only where the rest of the row differs too is a swap of one component another fault than one of all
            differs = (apart[:, k] != 0.0) & (np.delete(apart, k, axis=1) != 0.0).any(axis=1)
            if differs.any():
                kept = np.where(np.arange(6) == k, apart[differs], 0.0)
                yield _swap(first[differs], second[differs], kept, components=(k,) * int(differs.sum()))


def _swap(first: IntArray, second: IntArray, apart: FloatArray, components: tuple[int, ...]) -> Signatures:
    return Signatures(
        fault=Fault.SWAPPED,
        components=components,
        positions=np.column_stack([first, second]),
        change=np.stack([apart, -apart], axis=1)[..., None],
        whole=True,
    )


FALSE_ALARMS = 0.02
"""Share of undamaged sensors in which a fault is named."""
MOST_FAULTS = 5
"""Faults that are looked for in one sensor: where there are more, the bench is to be set up anew."""

_RANK = 1e-9
_TINY = 1e-300
_SAME = 4.0
"""Squared distance in standard deviations up to which an amount is that of a known cause."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Suspect:
    """A fault that the readings show."""

    fault: Fault
    """What kind."""
    positions: tuple[int, ...]
    """Which positions, by number; none for the plate."""
    component: int | None
    """Which component, where it is about one."""
    amount: FloatArray
    """Best amounts, in the units of the fault; shape (d,)."""
    standard_error: FloatArray
    """Their standard errors; shape (d,); 0 where the readings tell nothing of one."""
    log_probability: float
    """Logarithm of the share of undamaged sensors in which as much would be seen."""
    structure_forgotten: bool = False
    """Whether the amount is as if the mounting structure of the position were not there."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Evidence:
    """What m faults of one kind explain of s sensors."""

    signatures: Signatures
    log_probability: FloatArray  # (s, m)
    amount: FloatArray  # (s, m, d)
    covariance: FloatArray  # (m, d, d)

    def suspect(self, sensor: int, place: int) -> Suspect:
        """The fault at a place."""
        every = self.signatures
        is_plate = every.fault is Fault.PLATE_TILTED
        return Suspect(
            fault=every.fault,
            positions=() if is_plate else tuple(every.positions[place].tolist()),
            component=every.components[place] if every.components else None,
            amount=self.amount[sensor, place],
            standard_error=np.sqrt(np.maximum(np.diag(self.covariance[place]), 0.0)),
            log_probability=float(self.log_probability[sensor, place]),
        )


def suspects(
    loads: BenchLoads,
    residual: FloatArray,
    scatter: Scatter,
    *,
    false_alarms: float = FALSE_ALARMS,
    kinds: Sequence[Fault] = tuple(Fault),
) -> tuple[Suspect, ...]:
    """Name the faults of one sensor.

    Args:
        loads: Loads as stated.
        residual: Readings less loads; shape (n, 6); N, N m.
        scatter: How positions scatter.
        false_alarms: Share of undamaged sensors in which a fault may be named.
        kinds: Kinds to look for.

    Returns:
        Faults, the plainest first; each is looked for beside those before it.
    """
    named: list[Suspect] = []
    explained = np.zeros((6 * len(loads), 0))
    read, covariance = residual + loads.wrench, scatter.covariance
    while len(named) < MOST_FAULTS:
        space = ResidualSpace.of(loads.wrench, covariance, explained)
        (suspect,) = plainest(loads, (read - loads.wrench)[None], space, scatter.degrees_of_freedom, kinds=kinds)
        if suspect is None or suspect.log_probability > np.log(false_alarms):
            break
        named.append(suspect)
        if suspect.fault is Fault.SWAPPED:
            # where a load really hung it scatters as it does there
            loads, covariance = _exchanged(loads, covariance, suspect)
        else:
            explained = np.hstack([explained, _columns(loads, suspect)])
    return tuple(named)


def _exchanged(loads: BenchLoads, covariance: FloatArray, suspect: Suspect) -> tuple[BenchLoads, FloatArray]:
    """Loads and scatter with two positions exchanged, as a whole or in one component."""
    first, second = suspect.positions
    if suspect.component is None:
        order = np.arange(len(loads))
        order[[first, second]] = second, first
        return replace(loads.taken(order), names=loads.names), covariance[order]
    wrench = loads.wrench.copy()
    wrench[[first, second], suspect.component] = wrench[[second, first], suspect.component]
    return replace(loads, wrench=wrench), covariance


def plainest(
    loads: BenchLoads,
    residuals: FloatArray,
    space: ResidualSpace,
    degrees_of_freedom: float,
    *,
    kinds: Sequence[Fault] = tuple(Fault),
) -> list[Suspect | None]:
    """Find the plainest fault of every sensor, whether it is one or chance.

    Args:
        loads: Loads as stated, of all sensors.
        residuals: Readings less loads; shape (s, n, 6); N, N m.
        space: What a line leaves of such readings.
        degrees_of_freedom: As of `Scatter`.
        kinds: Kinds to look for.

    Returns:
        A fault for every sensor; None where there is nothing to compare.
    """
    weighed = space.weighed(residuals)
    every = [one for one in signatures(loads) if one.fault in kinds and len(one.positions)]
    evidence = [_evidence(one, weighed, space, degrees_of_freedom) for one in every]
    shares = {fault: sum(len(one.positions) for one in every if one.fault is fault) for fault in Fault}
    for one in evidence:
        one.log_probability[...] += np.log(shares[one.signatures.fault] * len({e.fault for e in every}))
    best: list[Suspect | None] = []
    for sensor in range(len(residuals)):
        tops = [(one, int(one.log_probability[sensor].argmin())) for one in evidence]
        if not tops:
            best.append(None)
            continue
        one, place = min(tops, key=lambda top: float(top[0].log_probability[sensor, top[1]]))
        best.append(_named(one.suspect(sensor, place), loads))
    return best


def _evidence(every: Signatures, weighed: FloatArray, space: ResidualSpace, degrees_of_freedom: float) -> _Evidence:
    shared = sum(
        np.einsum("spi,pid->spd", weighed[:, every.positions[:, k]], every.change[:, k])
        for k in range(every.positions.shape[1])
    )  # (s, m, d)
    information = _information(every, space)
    covariance = np.asarray(np.linalg.pinv(information, rcond=_RANK, hermitian=True), dtype=np.float64)
    amount = np.einsum("mde,sme->smd", covariance, shared)
    explained = (amount * shared).sum(axis=2)
    amounts = np.linalg.matrix_rank(information, tol=None, hermitian=True)
    if every.whole:  # it is 1 or nothing: what 1 explains, not what the best amount would
        explained = 2.0 * shared[..., 0] - information[:, 0, 0]
    return _Evidence(
        signatures=every,
        log_probability=log_upper_tail(np.maximum(explained, 0.0), np.maximum(amounts, 1), degrees_of_freedom),
        amount=amount,
        covariance=covariance,
    )


def _information(every: Signatures, space: ResidualSpace) -> FloatArray:
    """What readings tell of the amounts; shape (m, d, d)."""
    m, count, _, d = every.change.shape
    if m == 1:  # over all positions at once
        flat = every.change.reshape(6 * count, d)
        precision = space.precision.reshape(6 * count, 6 * count)
        return np.asarray((flat.T @ precision @ flat)[None], dtype=np.float64)
    information = np.zeros((m, d, d))
    for a in range(count):
        for b in range(count):
            blocks = space.precision[every.positions[:, a], :, every.positions[:, b], :]
            information += np.einsum("mid,mij,mje->mde", every.change[:, a], blocks, every.change[:, b])
    return information


def log_upper_tail(explained: FloatArray, amounts: FloatArray, degrees_of_freedom: float) -> FloatArray:
    """Give the logarithm of the probability that chance explains as much.

    Args:
        explained: What is explained, in units of the scatter; shape (s, m).
        amounts: How many amounts explain it; shape (m,).
        degrees_of_freedom: Of the scatter; infinite where it is known.

    Returns:
        Logarithms of the upper tail of a chi-squared, or of F where the scatter is estimated; shape (s, m).
    """
    from scipy.special import betaln, fdtrc, gammaincc, gammaln  # importing it takes longer than most commands

    half, count = 0.5 * explained, np.broadcast_to(0.5 * amounts, explained.shape)
    # beyond the smallest float the first term of the tail is exact enough to tell which is farther
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


def _named(suspect: Suspect, loads: BenchLoads) -> Suspect:
    """Say where a wrong weight is that of the structure."""
    if suspect.fault is not Fault.WEIGHT or loads.weights is None:
        return suspect
    (position,) = suspect.positions
    share = -loads.weights.structure_kg[position] / loads.weights.total_kg[position]
    distance = float((suspect.amount[0] - share) / suspect.standard_error[0]) ** 2
    return replace(suspect, structure_forgotten=bool(share < 0.0 and distance <= _SAME))


def _columns(loads: BenchLoads, suspect: Suspect) -> FloatArray:
    """What a fault does to all readings, per unit of its amounts; shape (6 n, d)."""
    for every in _like(loads, suspect):
        positions = tuple(range(len(loads))) if suspect.fault is Fault.PLATE_TILTED else suspect.positions
        place = int(np.flatnonzero((every.positions == positions).all(axis=1))[0])
        columns = np.zeros((len(loads), 6, every.change.shape[3]))
        columns[list(positions)] = every.change[place]
        return columns.reshape(6 * len(loads), -1)
    return np.zeros((6 * len(loads), 0))


def _like(loads: BenchLoads, suspect: Suspect) -> Iterator[Signatures]:
    for every in signatures(loads):
        component = every.components[0] if every.components else None
        if every.fault is suspect.fault and component == suspect.component:
            yield every


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
    """Share of undamaged sensors in which as much would be named."""
    sentence: str
    """The same as text."""


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
