# SPDX-License-Identifier: BSD-3-Clause
"""Measurements of one sensor under known loads: means per position less bias, and findings about blocks of samples."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, check_arrays, read_only, require_shape
from forcetorque.base.errors import FormatError, SensorError, ShapeError
from forcetorque.base.noise.window_means import APART_S, mean_error
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.generative.agreement import ALL_COMPONENTS
from forcetorque.workbench.known_loads import BenchLoads


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """Standard deviations of loads about their specified placement."""

    angle_rad: float
    """Direction of gravity about each axis across it; rad."""
    position_m: float
    """Position along each axis; m."""
    nonlinearity: float = 0.0
    """Departure of a channel from a line, as a share of its raw sample."""

    def __post_init__(self) -> None:
        for name in ("angle_rad", "position_m", "nonlinearity"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0.0):
                raise SensorError(f"placement: {name}: expected a number of at least 0, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Bench(ArrayRecord):
    """A sensor on a bench."""

    sensor: str
    """Name of the sensor."""
    serial: str
    """Its serial number."""
    loads: BenchLoads
    """Loads of the n positions that were recorded."""
    raw: FloatArray = field(metadata=array("n", "c"))
    """Mean raw samples less bias, of the positions of `loads`; shape (n, c); counts."""
    full_scale: FloatArray = field(metadata=array("c"))
    """Largest magnitude of a raw sample of every channel; shape (c,); counts."""
    standard_error: Any = field(default=None, metadata=array("n", "c"))
    """Standard errors of the mean raw samples; shape (n, c), zeros where None was given; counts."""
    bias: Any = field(default=None, metadata=array("c"))
    """Last raw sample without load; shape (c,), zeros where None was given; counts."""
    time_s: Any = field(default=None, metadata=array("n"))
    """Instants of the positions; shape (n,); s; None where unknown: slow noise is then not shared by positions."""
    prior: FloatArray | None = field(default=None, metadata=array(6, "c"))
    """Nominal matrix; shape (6, c); N/count, N m/count; None for none."""
    placement: Placement | None = None
    """Uncertainty of the loads; None where none is given."""
    measured: BoolArray = field(default_factory=ALL_COMPONENTS.copy, metadata=array(6, dtype="bool"))
    """Components that the sensor measures; shape (6,)."""
    load_full_scale: FloatArray | None = field(default=None, metadata=array(6))
    """Largest loads to come; shape (6,); N, N m; needed with fewer than six components."""

    def __post_init__(self) -> None:
        require_shape(np.asarray(self.raw), name="raw", shape=(len(self.loads), None))
        c = np.shape(self.raw)[1]
        for name, shape in (("standard_error", np.shape(self.raw)), ("bias", (c,))):
            if getattr(self, name) is None:
                object.__setattr__(self, name, np.zeros(shape))
        check_arrays(self)
        if c < (components := int(self.measured.sum())):
            raise ShapeError(f"bench: expected at least {components} channels, one for each component, got {c}")
        if not self.measured.all() and self.load_full_scale is None:
            raise SensorError("bench: expected load_full_scale with fewer than six components, got none")

    def __len__(self) -> int:
        return len(self.loads)

    @property
    def instants_s(self) -> FloatArray:
        """Instants of the positions, so far apart where they are unknown that slow noise does not correlate them."""
        if self.time_s is None:
            return APART_S * np.arange(len(self), dtype=np.float64)
        return self.time_s

    def select(self, positions: Any) -> Bench:
        """Select positions.

        Args:
            positions: Indices of the positions; shape (k,).

        Returns:
            The bench with these positions.
        """
        indices = np.asarray(positions, dtype=np.int64)
        return replace(
            self,
            loads=self.loads.select(indices),
            raw=self.raw[indices],
            standard_error=self.standard_error[indices],
            time_s=None if self.time_s is None else self.time_s[indices],
        )

    def usable(self) -> Bench:
        """Select the positions whose load and raw samples are known.

        Returns:
            The bench without the others.

        Raises:
            SensorError: If there is none.
        """
        known = self.loads.known & np.isfinite(self.raw).all(axis=1)
        if not known.any():
            raise SensorError(f"{self.sensor!r}: expected positions with known load and raw samples, got none")
        return self.select(np.flatnonzero(known))

    def wrenches(self, matrix: FloatArray) -> FloatArray:
        """Multiply the raw samples by a matrix.

        Args:
            matrix: Matrix; shape (6, c); N/count, N m/count.

        Returns:
            Wrenches less that of the bias; shape (n, 6); N, N m.
        """
        require_shape(matrix, name="matrix", shape=(6, self.raw.shape[1]))
        return self.raw @ matrix.T


_SEGMENTS = 10
"""Segments of a block whose means show whether the load moved."""
_MOVED = 6.0
"""Standard errors of the mean of a segment by which it may differ from that of the block."""
_LEAST_MOVED = 2e-3
"""Share of the full scale below which a movement does not matter."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Block:
    """Statistics of the samples at one position."""

    position: str
    """Name of the position, or `bias`."""
    source: str
    """File, and rows or times in it."""
    samples: int
    """Number of samples."""
    time_s: float | None
    """Mean instant on the clock of the recording; s; None where it is not known."""
    mean: FloatArray
    """Mean raw sample; shape (c,); counts."""
    standard_error: FloatArray
    """Standard error of the mean, slow noise within the block included; shape (c,); counts."""
    movement: FloatArray
    """Largest less smallest mean of a tenth of the block; shape (c,); counts."""
    moved: bool
    """Whether the load was not at rest."""
    saturated: bool
    """Whether a channel was at its limit."""
    frozen: bool
    """Whether no channel changed at all."""
    bias: Block | None = None
    """The block without load before this one; None of a block without load."""

    @classmethod
    def of(
        cls,
        position: str,
        samples: FloatArray,
        full_scale: FloatArray,
        *,
        source: str,
        time_s: FloatArray | None = None,
        bias: Block | None = None,
    ) -> Block:
        """Compute the statistics of samples.

        Args:
            position: Name of the position, or `bias`.
            samples: Raw samples in the order of time; shape (n, c); counts.
            full_scale: Largest magnitude of a raw sample of every channel; shape (c,); counts.
            source: File, and rows or times in it, for messages.
            time_s: Instants; shape (n,); s; None where only their order is known.
            bias: The block without load before this one; None of a block without load.

        Returns:
            The block.

        Raises:
            FormatError: If there is no sample, or one is not finite.
        """
        raw = read_only(samples, name="samples", shape=(None, None))
        if not len(raw) or not np.isfinite(raw).all():
            bad = np.flatnonzero(~np.isfinite(raw).all(axis=1))
            where = f"a missing number in row {bad[0] + 1}" if len(bad) else "none"
            raise FormatError(f"{source}: expected samples of finite numbers, got {where}")
        instants = np.arange(len(raw), dtype=np.float64) if time_s is None else time_s
        error = mean_error(raw, instants).standard_error
        segments = np.array([segment.mean(axis=0) for segment in np.array_split(raw, min(_SEGMENTS, len(raw)))])
        movement = np.ptp(segments, axis=0)
        segment_error = raw.std(axis=0) * np.sqrt(_SEGMENTS / len(raw))
        return cls(
            position=position,
            source=source,
            samples=len(raw),
            time_s=None if time_s is None else float(np.mean(time_s)),
            mean=raw.mean(axis=0),
            standard_error=np.where(np.isfinite(error), error, 0.0),
            movement=movement,
            moved=bool((movement > np.maximum(_MOVED * segment_error, _LEAST_MOVED * full_scale)).any()),
            saturated=bool((np.abs(raw) >= full_scale).any()),
            frozen=bool(len(raw) > 1 and not np.ptp(raw, axis=0).any()),
            bias=bias,
        )

    @property
    def change(self) -> FloatArray:
        """Mean raw sample less that of the bias; shape (c,); counts."""
        return self.mean if self.bias is None else self.mean - self.bias.mean


SIZE = (0.7, 1.4)
"""Least and largest share of the known load that a sensor measures by its nominal matrix: sensors of one type differ by
11 %, weights that are mistaken for each other by more than three times that."""

_SAME = 0.02
"""Share of a change of the raw samples below which two blocks are of the same position."""
_OTHER = 0.5
"""Distance to the load of another position, over that to the specified load, below which a block is of the other."""
_NEAR = 0.35
"""Distance to the load of another position, over its size, by which sensors differ at most."""


def block_findings(blocks: Sequence[Block], loads: BenchLoads, nominal: FloatArray | None) -> list[tuple[str, ...]]:
    """Check blocks against their loads and against the block before.

    Args:
        blocks: Blocks of positions with their bias, in the order in which they were recorded.
        loads: All loads.
        nominal: Approximate matrix of the sensor; shape (6, c); signs and sizes are not checked if it is None.

    Returns:
        Messages about every block; none where the block is valid.
    """
    findings = []
    for k, block in enumerate(blocks):
        before = blocks[k - 1] if k else None
        messages = list(_at_rest(block))
        if block.bias is not None:
            messages += (f"bias: {message}" for message in _at_rest(block.bias))
        if before is not None and _is_same(block.change, before.change):
            messages.append(f"the measurement equals that of position {before.position} before it: was the load moved?")
        elif nominal is not None and not block.saturated:
            messages += _of_load(nominal @ block.change, block.position, loads)
        findings.append(tuple(messages))
    return findings


def _is_same(change: FloatArray, before: FloatArray) -> bool:
    return bool(np.linalg.norm(change - before) < _SAME * np.linalg.norm(before))


def _at_rest(block: Block) -> Iterator[str]:
    if block.saturated:
        yield "a channel is at its limit: it does not determine the load"
    if block.frozen:
        yield "no channel changes at all: is the log frozen?"
    if block.moved:
        yield f"not static: the mean of a tenth of the block varies by {block.movement.max():.0f} counts"


def _of_load(wrench: FloatArray, position: str, loads: BenchLoads) -> Iterator[str]:
    """Compare a wrench by the nominal matrix with the load of its position, and with those of all others."""
    sizes = np.repeat([np.linalg.norm(loads.wrench[:, half], axis=1).max() for half in FORCE_AND_MOMENT], 3)
    known = loads.wrench / sizes
    index = loads.names.index(position)
    expected, measured = known[index], wrench / sizes
    share = float(measured @ expected / (expected @ expected))
    distance = np.linalg.norm(known - measured, axis=1)
    nearest = int(np.argmin(distance))
    distance_permuted = float(np.linalg.norm(np.roll(wrench, 3) / sizes - expected))
    is_near = distance[nearest] < _NEAR * np.linalg.norm(known[nearest])
    if is_near and distance[nearest] < _OTHER * distance[index]:
        yield f"the measurement matches position {loads.names[nearest]}: was that position recorded in its place?"
    elif distance_permuted < _OTHER * distance[index]:
        yield "forces and moments are permuted: check the order of the channels"
    elif share < 0.0:
        yield "the sign is reversed: check where the weight hangs, and measure_direction"
    elif not SIZE[0] <= share <= SIZE[1]:
        yield f"the measurement is {share:.2f} of the load: check the weight"
