# SPDX-License-Identifier: BSD-3-Clause
"""Known loads on a bench: weights by mass, place and direction, and the wrench that each makes by geometry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, read_only
from forcetorque.errors import SensorError, ShapeError
from forcetorque.spatial import MeasureDirection, reading_sign

LONGEST_LEVER_M = 10.0
"""A weight farther from the sensor than this is on no bench: its place was typed in another unit."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Weights:
    """Weights at n positions, one at a time."""

    mass_kg: FloatArray
    """Mass of the weight alone; shape (n,); kg."""
    structure_kg: FloatArray
    """Mass of the mounting structure that hangs there besides; shape (n,); kg."""
    position_m: FloatArray
    """Where the load acts, in the sensor's frame; shape (n, 3); m."""
    direction: FloatArray
    """Where gravity points in the sensor's frame, of length 1 whatever was given; shape (n, 3)."""
    gravity: float
    """Magnitude of gravity; m/s2."""

    def __post_init__(self) -> None:
        n = len(np.asarray(self.mass_kg))
        shapes = {"mass_kg": (n,), "structure_kg": (n,), "position_m": (n, 3), "direction": (n, 3)}
        for field, shape in shapes.items():
            values = read_only(getattr(self, field), name=field, shape=shape)
            if not np.isfinite(values).all():
                row = int(np.argwhere(~np.isfinite(values))[0, 0])
                raise SensorError(f"weight {row + 1}: {field}: expected finite numbers, got {values[row]}")
            object.__setattr__(self, field, values)
        _require_weights(self)
        lengths = np.linalg.norm(self.direction, axis=1, keepdims=True)
        object.__setattr__(self, "direction", read_only(self.direction / lengths, name="direction", shape=(n, 3)))

    @property
    def total_kg(self) -> FloatArray:
        """Mass of weight and structure; shape (n,); kg."""
        return self.mass_kg + self.structure_kg

    def wrench(self, *, measure_direction: MeasureDirection) -> FloatArray:
        """Give what a sensor reads of each weight: force along gravity, moment `position x force`.

        Args:
            measure_direction: Who acts on whom in the reading; the load is the child.

        Returns:
            Wrenches in the sensor's frame, about its origin; shape (n, 6); N, N m.
        """
        force = self.gravity * self.total_kg[:, None] * self.direction
        acting = np.hstack([force, np.cross(self.position_m, force)])
        wrench: FloatArray = -reading_sign(measure_direction, child_is_outboard=True) * acting
        return wrench


def _require_weights(weights: Weights) -> None:
    if not 0.0 < weights.gravity < np.inf:
        raise SensorError(f"gravity: expected a number above 0 m/s2, got {weights.gravity:g}")
    levers = np.linalg.norm(weights.position_m, axis=1)
    lengths = np.linalg.norm(weights.direction, axis=1)
    for k, (mass, structure) in enumerate(zip(weights.mass_kg, weights.structure_kg, strict=True)):
        where = f"weight {k + 1}"
        if not mass > 0.0:
            raise SensorError(
                f"{where}: expected a mass above 0 kg, got {mass:g}; what is recorded without a weight is bias"
            )
        if structure < 0.0:
            raise SensorError(f"{where}: expected a structure of at least 0 kg, got {structure:g}")
        if levers[k] > LONGEST_LEVER_M:
            raise SensorError(
                f"{where}: expected a place within {LONGEST_LEVER_M:g} m of the sensor, got {levers[k]:g} m; "
                "is it in mm? State the unit in the heading"
            )
        if not lengths[k] > 0.0:
            raise SensorError(f"{where}: expected a direction of gravity, got {weights.direction[k].tolist()}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchLoads:
    """What a sensor is known to read at n positions."""

    names: tuple[str, ...]
    """Name of every position, unique."""
    wrench: FloatArray
    """Wrenches in the sensor's frame and direction; shape (n, 6); N, N m; NaN where a component is not known."""
    series: tuple[str, ...]
    """Series that each belongs to: positions that are set up together."""
    weights: Weights | None = None
    """Geometry that the wrenches come from; None where wrenches were stated."""

    def __post_init__(self) -> None:
        n = len(self.names)
        object.__setattr__(self, "wrench", read_only(self.wrench, name="wrench", shape=(n, 6)))
        if len(set(self.names)) < n:
            twice = next(name for name in self.names if self.names.count(name) > 1)
            raise SensorError(f"loads: expected every name once, got {twice!r} again")
        if len(self.series) != n or (self.weights is not None and len(self.weights.mass_kg) != n):
            raise ShapeError(f"loads: expected {n} series and weights, as many as names")

    def __len__(self) -> int:
        return len(self.names)

    @classmethod
    def of_weights(
        cls, names: Sequence[str], weights: Weights, *, measure_direction: MeasureDirection, series: Sequence[str] = ()
    ) -> BenchLoads:
        """Make loads of weights.

        Args:
            names: Name of every position.
            weights: The weights.
            measure_direction: Who acts on whom in the reading; the load is the child.
            series: Series of every position; one for all if left out.

        Returns:
            The loads.
        """
        return cls(
            names=tuple(names),
            wrench=weights.wrench(measure_direction=measure_direction),
            series=tuple(series) or ("all",) * len(names),
            weights=weights,
        )

    @property
    def known(self) -> BoolArray:
        """Whether all six components of a position are known; shape (n,)."""
        return np.asarray(np.isfinite(self.wrench).all(axis=1), dtype=np.bool_)

    def taken(self, positions: Any) -> BenchLoads:
        """Give some of the positions.

        Args:
            positions: Which, by number; shape (k,).

        Returns:
            Their loads.
        """
        places = np.asarray(positions, dtype=np.int64)
        weights = self.weights
        if weights is not None:
            weights = Weights(
                mass_kg=weights.mass_kg[places],
                structure_kg=weights.structure_kg[places],
                position_m=weights.position_m[places],
                direction=weights.direction[places],
                gravity=weights.gravity,
            )
        return BenchLoads(
            names=tuple(self.names[k] for k in places),
            wrench=self.wrench[places],
            series=tuple(self.series[k] for k in places),
            weights=weights,
        )
