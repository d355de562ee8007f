# SPDX-License-Identifier: BSD-3-Clause
"""What one sensor measured of known loads: a mean per position, less its bias, and what is wrong with a block."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_shape
from forcetorque.base.errors import FormatError, SensorError, ShapeError
from forcetorque.base.noise.means import APART_S, mean_error
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.workbench.loads import BenchLoads


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """How far loads may be from where they are stated to be, one standard deviation each."""

    angle_rad: float
    """Direction of gravity about each axis across it; rad."""
    position_m: float
    """Place along each axis; m."""
    nonlinearity: float = 0.0
    """Departure of a channel from a line, as a share of its reading."""

    def __post_init__(self) -> None:
        for field in ("angle_rad", "position_m", "nonlinearity"):
            if not (math.isfinite(getattr(self, field)) and getattr(self, field) >= 0.0):
                raise SensorError(f"placement: {field}: expected a number of at least 0, got {getattr(self, field)}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Bench:
    """A sensor on a bench."""

    sensor: str
    """Name of the sensor."""
    serial: str
    """Its serial number."""
    loads: BenchLoads
    """Loads of the n positions that were recorded."""
    raw: FloatArray
    """Mean readings less bias; shape (n, c); counts."""
    full_scale: FloatArray
    """Largest magnitude of a reading of every channel; shape (c,); counts."""
    standard_error: Any = None
    """Standard errors of the mean readings; shape (n, c), zeros where None was given; counts."""
    bias: Any = None
    """Last reading without load; shape (c,), zeros where None was given; counts."""
    time_s: Any = None
    """Instants of the positions; shape (n,); s; None where they are not known, and slow noise is then between them."""
    prior: FloatArray | None = None
    """Nominal matrix; shape (6, c); N/count, N m/count; None for none."""
    placement: Placement | None = None
    """Uncertainty of the loads; None where none is given."""

    def __post_init__(self) -> None:
        n, raw = len(self.loads), read_only(self.raw, name="raw", shape=(len(self.loads), None))
        c = raw.shape[1]
        object.__setattr__(self, "raw", raw)
        for field, shape in (("standard_error", (n, c)), ("bias", (c,))):
            values = np.zeros(shape) if getattr(self, field) is None else getattr(self, field)
            object.__setattr__(self, field, read_only(values, name=field, shape=shape))
        object.__setattr__(self, "full_scale", read_only(self.full_scale, name="full_scale", shape=(c,)))
        if self.time_s is not None:
            object.__setattr__(self, "time_s", read_only(self.time_s, name="time_s", shape=(n,)))
        if self.prior is not None:
            object.__setattr__(self, "prior", read_only(self.prior, name="prior", shape=(6, c)))
        if c < 6:
            raise ShapeError(f"bench: expected at least six channels, which six load directions need, got {c}")

    def __len__(self) -> int:
        return len(self.loads)

    @property
    def instants_s(self) -> FloatArray:
        """Instants of the positions, far apart where they are not known: no slow noise joins them then; shape (n,)."""
        if self.time_s is None:
            return APART_S * np.arange(len(self), dtype=np.float64)
        return self.time_s

    def taken(self, positions: Any) -> Bench:
        """Give some of the positions.

        Args:
            positions: Which, by number; shape (k,).

        Returns:
            The bench with these alone.
        """
        places = np.asarray(positions, dtype=np.int64)
        return replace(
            self,
            loads=self.loads.taken(places),
            raw=self.raw[places],
            standard_error=self.standard_error[places],
            time_s=None if self.time_s is None else self.time_s[places],
        )

    def usable(self) -> Bench:
        """Give the positions whose load and reading are known.

        Returns:
            The bench without the others.

        Raises:
            SensorError: If there is none.
        """
        known = self.loads.known & np.isfinite(self.raw).all(axis=1)
        if not known.any():
            raise SensorError(f"{self.sensor!r}: expected positions with known load and reading, got none")
        return self.taken(np.flatnonzero(known))

    def read_by(self, matrix: FloatArray) -> FloatArray:
        """Turn the readings into wrenches.

        Args:
            matrix: Matrix; shape (6, c); N/count, N m/count.

        Returns:
            Changes of wrench from the bias; shape (n, 6); N, N m.
        """
        require_shape(matrix, name="matrix", shape=(6, self.raw.shape[1]))
        return self.raw @ matrix.T


BIAS = "bias"
"""What a block without load is called in place of a position."""

_PARTS = 10
"""Parts of a block whose means show whether something moved."""
_MOVED = 6.0
"""Standard errors of the mean of a part by which it may differ from that of the block."""
_LEAST_MOVED = 2e-3
"""Share of the full scale below which it does not matter."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Block:
    """Samples at one position, summed up."""

    position: str
    """Name of the position, or `bias`."""
    source: str
    """File and place in it."""
    samples: int
    """Number of samples."""
    time_s: float | None
    """Mean instant on the clock of the recording; s; None where it is not known."""
    mean: FloatArray
    """Mean reading; shape (c,); counts."""
    standard_error: FloatArray
    """Its standard error, slow noise within the block included; shape (c,); counts."""
    movement: FloatArray
    """Largest less smallest mean of a tenth of the block; shape (c,); counts."""
    moved: bool
    """Whether it was not at rest."""
    saturated: bool
    """Whether a channel was at its limit."""
    frozen: bool
    """Whether no channel changed at all."""

    @classmethod
    def of(
        cls,
        position: str,
        samples: FloatArray,
        full_scale: FloatArray,
        *,
        source: str,
        time_s: FloatArray | None = None,
    ) -> Block:
        """Sum up samples.

        Args:
            position: Name of the position, or `bias`.
            samples: Readings in the order of time; shape (n, c); counts.
            full_scale: Largest magnitude of a reading of every channel; shape (c,); counts.
            source: File and place in it, for messages.
            time_s: Instants; shape (n,); s; None where only their order is known.

        Returns:
            The block.

        Raises:
            FormatError: If there is no sample, or one is not finite.
        """
        readings = read_only(samples, name="samples", shape=(None, None))
        if not len(readings) or not np.isfinite(readings).all():
            bad = np.flatnonzero(~np.isfinite(readings).all(axis=1))
            where = f"a missing number in row {bad[0] + 1}" if len(bad) else "none"
            raise FormatError(f"{source}: expected samples of finite numbers, got {where}")
        instants = np.arange(len(readings), dtype=np.float64) if time_s is None else time_s
        error = mean_error(readings, instants).standard_error
        parts = np.array([part.mean(axis=0) for part in np.array_split(readings, min(_PARTS, len(readings)))])
        movement = np.ptp(parts, axis=0)
        part_error = readings.std(axis=0) * np.sqrt(_PARTS / len(readings))
        return cls(
            position=position,
            source=source,
            samples=len(readings),
            time_s=None if time_s is None else float(np.mean(time_s)),
            mean=readings.mean(axis=0),
            standard_error=np.where(np.isfinite(error), error, 0.0),
            movement=movement,
            moved=bool((movement > np.maximum(_MOVED * part_error, _LEAST_MOVED * full_scale)).any()),
            saturated=bool((np.abs(readings) >= full_scale).any()),
            frozen=bool(len(readings) > 1 and not np.ptp(readings, axis=0).any()),
        )


SIZE = (0.7, 1.4)
"""Share of the expected load that a sensor reads by its nominal matrix at least and at most: specimens differ by some
11 %, weights that are mistaken for each other by more than three times that."""

_SAME = 0.02
"""Share of a change of reading below which two blocks are of the same position."""
_OWN = 0.5
"""Distance to another load, over that to its own, below which a block is of the other."""
_NEAR = 0.35
"""Distance to the other, over its size, that specimens differ by at most."""


def block_findings(
    blocks: Sequence[Block], biases: Sequence[Block], loads: BenchLoads, nominal: FloatArray | None
) -> list[tuple[str, ...]]:
    """Check blocks, each with those that were recorded before it.

    Args:
        blocks: Blocks of positions, as they came.
        biases: The block without load that each is taken from.
        loads: All loads.
        nominal: Matrix of the sensor, roughly; shape (6, c); None for none, and signs and sizes are not checked then.

    Returns:
        What is wrong with every block, in sentences; none where it is sound.
    """
    findings = []
    for k, (block, bias) in enumerate(zip(blocks, biases, strict=True)):
        before = (blocks[k - 1].mean - biases[k - 1].mean) if k else None
        change = block.mean - bias.mean
        sentences = [*_at_rest(block), *(f"bias: {words}" for words in _at_rest(bias))]
        if before is not None and np.linalg.norm(change - before) < _SAME * np.linalg.norm(before):
            sentences.append(f"it reads as position {blocks[k - 1].position} before it: was the load moved?")
        elif nominal is not None and not block.saturated:
            sentences += _of_load(nominal @ change, block.position, loads)
        findings.append(tuple(sentences))
    return findings


def _at_rest(block: Block) -> Iterator[str]:
    if block.saturated:
        yield "a channel is at its limit: no load can be told from it"
    if block.frozen:
        yield "no channel changes at all: is the log frozen?"
    if block.moved:
        yield f"not still: the mean of a tenth of it wanders by {block.movement.max():.0f} counts"


def _of_load(wrench: FloatArray, position: str, loads: BenchLoads) -> Iterator[str]:
    """Compare a wrench by the nominal matrix with the load of its position, and with all others."""
    sizes = np.repeat([np.linalg.norm(loads.wrench[:, part], axis=1).max() for part in FORCE_AND_MOMENT], 3)
    known = loads.wrench / sizes
    own, read = known[loads.names.index(position)], wrench / sizes
    share = float(read @ own / (own @ own))
    distance = np.linalg.norm(known - read, axis=1)
    nearest = int(np.argmin(distance))
    swapped_halves = float(np.linalg.norm(np.roll(wrench, 3) / sizes - own))
    own_distance = float(distance[loads.names.index(position)])
    is_near = distance[nearest] < _NEAR * np.linalg.norm(known[nearest])
    if is_near and distance[nearest] < _OWN * own_distance:
        yield f"it reads like position {loads.names[nearest]}: was that one recorded in place of it?"
    elif swapped_halves < _OWN * own_distance:
        yield "it reads as if forces and moments were swapped: check the order of the channels"
    elif share < 0.0:
        yield "its sign is the other way round: check where it hangs, and measure_direction"
    elif not SIZE[0] <= share <= SIZE[1]:
        yield f"it reads {share:.2f} of its load: check the weight"
