# SPDX-License-Identifier: BSD-3-Clause
"""A block of samples at one position: its mean, what that is worth, and whether the sensor was at rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FormatError
from forcetorque.noise.mean_errors import mean_error

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
