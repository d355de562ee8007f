# SPDX-License-Identifier: BSD-3-Clause
"""A load case: the loads to come as wrenches at a sensor, and the error that is allowed there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, mapping, require_shape
from forcetorque.base.errors import SensorError

ALLOWED_SHARE: Final = 0.05
"""Error that is allowed by default, as a share of the loads: root mean square over root mean square."""
_LEAST_LEVER_M: Final = 1e-9
"""Lever below which a moment is rounding; m."""


class LoadCaseOffset(StrEnum):
    """What offset the readings of a use are taken with."""

    FITTED = "fitted"
    """That of the calibration: the sensor is used without being switched off."""
    TARED = "tared"
    """One that is taken anew just before use, under the load of the fitted data; readings are changes from there."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadCase(ArrayRecord):
    """Loads to come, as what they add to the mean load of the fitted data."""

    name: str
    """Name."""
    words: str
    """What the loads are, in words."""
    wrench: FloatArray = field(metadata=array(None, 6))
    """The loads, each as likely as any other, in the sensor's frame and direction; shape (n, 6); N, N m."""
    offset: LoadCaseOffset = LoadCaseOffset.FITTED
    """Offset that the readings are taken with."""
    changes: Mapping[str, float] = field(default_factory=dict, metadata=mapping())
    """How far variables such as temperature are from where the offset holds, root mean square, by name."""
    allowed_force_N: float | None = None
    """Root mean square of the force error that the use allows; None for a share of the loads."""
    allowed_moment_Nm: float | None = None
    """The same of the moment error."""
    is_stated: bool = True
    """Whether a file states it; else it is the default."""

    def __post_init__(self) -> None:
        check_arrays(self)
        # a plain string would fail every `is` and count as the other offset
        object.__setattr__(self, "offset", LoadCaseOffset(self.offset))
        if not len(self.wrench) or not np.isfinite(self.wrench).all() or not self.wrench.any():
            raise SensorError(f"load case {self.name!r}: expected loads of finite size, and not all of them zero")
        for unit, allowed in (("N", self.allowed_force_N), ("N m", self.allowed_moment_Nm)):
            if allowed is not None and not 0.0 < allowed < np.inf:
                raise SensorError(f"load case {self.name!r}: expected an allowed error above 0 {unit}, got {allowed:g}")

    @property
    def force_N(self) -> float:
        """Root mean square of the forces."""
        return _root_mean_square(self.wrench[:, :3])

    @property
    def moment_Nm(self) -> float:
        """Root mean square of the moments."""
        size = _root_mean_square(self.wrench[:, 3:])
        # a force through the sensor has a moment of rounding, of which nothing can be a share
        return size if size > _LEAST_LEVER_M * self.force_N else 0.0

    @property
    def states_requirement(self) -> bool:
        """Whether a file states the allowed error."""
        return self.allowed_force_N is not None or self.allowed_moment_Nm is not None

    @property
    def requirement(self) -> tuple[float, float]:
        """Error that is allowed: of the force in N, of the moment in N m; infinite for what is not judged.

        By default both are `ALLOWED_SHARE` of the loads; where one is stated the other is free.
        """
        if not self.states_requirement:
            return ALLOWED_SHARE * self.force_N or np.inf, ALLOWED_SHARE * self.moment_Nm or np.inf
        force, moment = self.allowed_force_N, self.allowed_moment_Nm
        return np.inf if force is None else force, np.inf if moment is None else moment


def _root_mean_square(vectors: FloatArray) -> float:
    return float(np.sqrt((vectors**2).sum(axis=1).mean()))


LOADS: Final = 600
"""Number of loads that stand for a use."""
_SEED: Final = 2026


def pushes_around_sensor(force_N: float, radius_m: float) -> FloatArray:
    """Push with a force in any direction, anywhere within a radius of the sensor.

    Args:
        force_N: Magnitude of the force; N.
        radius_m: Largest distance of its point; distances are as likely as each other; m.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    rng = np.random.default_rng(_SEED)
    return at_points(force_N * _directions(rng), radius_m * rng.uniform(size=(LOADS, 1)) * _directions(rng))


def pushes_at(point_m: Any, force_N: float, radius_m: float, *, direction: Any = None) -> FloatArray:
    """Push at places within a radius of given points.

    Args:
        point_m: Points in the sensor's frame, such as one for every posture; shape (k, 3); m.
        force_N: Magnitude of the force; N.
        radius_m: How far from a point it may act; m.
        direction: Directions of the force at every point in the sensor's axes, shape (k, 3); None for any.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    rng = np.random.default_rng(_SEED)
    points = np.asarray(point_m, dtype=np.float64)
    require_shape(points, name="point_m", shape=(None, 3))
    pick = np.arange(LOADS) % len(points)
    if direction is None:
        force = force_N * _directions(rng)
    else:
        along = np.asarray(direction, dtype=np.float64)
        require_shape(along, name="direction", shape=(len(points), 3))
        force = force_N * along[pick]
    # cube root: as likely in every part of the ball
    return at_points(force, points[pick] + radius_m * np.cbrt(rng.uniform(size=(LOADS, 1))) * _directions(rng))


def weights(mass_kg: float, centre_of_mass_m: Any, gravity: float) -> FloatArray:
    """Weigh a mass that is fixed to the sensor, in every orientation.

    Args:
        mass_kg: The mass; kg.
        centre_of_mass_m: Its centres of mass in the sensor's frame, one for every posture; shape (k, 3); m.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    return pushes_at(centre_of_mass_m, mass_kg * gravity, 0.0)


def full_scale_loads(full_scale: Any, share: float) -> FloatArray:
    """Load all six components at once, each up to a share of its full scale in either direction.

    Args:
        full_scale: Full scale; shape (6,); N, N m.
        share: The share, above 0 and at most 1.

    Returns:
        Wrenches; shape (n, 6); N, N m.

    Raises:
        SensorError: If the share is not such a one.
    """
    if not 0.0 < share <= 1.0:
        raise SensorError(f"share of full scale: expected one above 0 and at most 1, got {share:g}")
    scale = np.asarray(full_scale, dtype=np.float64)
    require_shape(scale, name="full_scale", shape=(6,))
    return share * scale * np.random.default_rng(_SEED).uniform(-1.0, 1.0, (LOADS, 6))


def at_points(force: FloatArray, point: FloatArray) -> FloatArray:
    """Turn forces at points into wrenches about the origin.

    Args:
        force: Forces; shape (n, 3); N.
        point: Where they act; shape (n, 3); m.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    return np.hstack([force, np.cross(point, force)])


def _directions(rng: np.random.Generator) -> FloatArray:
    vectors = rng.normal(size=(LOADS, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
