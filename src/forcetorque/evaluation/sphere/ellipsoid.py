# SPDX-License-Identifier: BSD-3-Clause
"""Ellipsoids and results of fits to a cloud: radius, lengths, intervals, indices, and whether a fit is valid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, read_only
from forcetorque.base.errors import FitError
from forcetorque.evaluation.sphere.resampling import Resampled


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Ellipsoid(ArrayRecord):
    """Points x with `(x - centre)^T shape (x - centre) = 1`; lengths in the unit of x."""

    centre: FloatArray = field(metadata=array(3))
    """Centre; shape (3,)."""
    shape: FloatArray = field(metadata=array(3, 3))
    """Symmetric and positive definite; shape (3, 3); one over the square of a length."""

    def __post_init__(self) -> None:
        check_arrays(self)
        even = read_only(0.5 * (self.shape + self.shape.T), name="shape", shape=(3, 3))
        if not (np.isfinite(even).all() and np.linalg.eigvalsh(even)[0] > 0.0):
            raise FitError("ellipsoid: expected a positive definite shape, got that of an open surface")
        object.__setattr__(self, "shape", even)

    @property
    def axis_intersections(self) -> FloatArray:
        """Where the axes through the centre leave it, `1 / sqrt(shape_ii)`; shape (3,).

        What the sensor reads along an axis while it reads nothing along the two others.
        """
        return 1.0 / np.sqrt(np.diag(self.shape))

    @property
    def half_widths(self) -> FloatArray:
        """Half of its extent along each axis, `sqrt((shape^-1)_ii)`; shape (3,).

        The most that the sensor reads along an axis, for any reading along the others.
        """
        return np.sqrt(np.diag(np.linalg.inv(self.shape)))

    @property
    def principal_radii(self) -> FloatArray:
        """Half of its own axes, `1 / sqrt(eigenvalue)`, the longest first; shape (3,)."""
        return 1.0 / np.sqrt(np.linalg.eigvalsh(self.shape))

    @property
    def principal_axes(self) -> FloatArray:
        """Directions of the principal radii, a column each in their order; shape (3, 3)."""
        return np.linalg.eigh(self.shape).eigenvectors


def ellipsoid_of_map(matrix: Any, *, centre: Any, radius: float) -> Ellipsoid:
    """Give what a linear map makes of a sphere.

    Args:
        matrix: The map; shape (3, 3).
        centre: Where the centre of the sphere goes; shape (3,).
        radius: Radius of the sphere.

    Returns:
        The image of the sphere.

    Raises:
        FitError: If the map is singular, so that the image is flat.
    """
    spread = np.asarray(matrix, dtype=np.float64) * radius
    if np.linalg.matrix_rank(spread) < 3:
        raise FitError("ellipsoid: expected a map onto space, got one onto a plane or a line")
    inverse = np.linalg.inv(spread)
    return Ellipsoid(centre=centre, shape=inverse.T @ inverse)


TOLERANCE = 0.1
"""Half width of an interval, relative to the mean length, up to which a number is identifiable."""

_FAR = 5.0
"""Longest radius, relative to the extent of the cloud and to the weight, beyond which nothing was measured there.

Sensors had 1.6 times the weight at most; on grids of 10 to 60 degrees to each side, at any noise, ellipsoids that
are identifiable without the model had less than 2.5 times the extent of their cloud.
"""

RULE = (
    "a number is identifiable if its 95 % interval, from leaving out one of ten blocks of time after the other, is "
    "within the tolerance of the mean radius; with the model that is all, and the interval takes the model and the "
    "joint angles as exact; without the model, methods that treat noise differently must also agree within the "
    "tolerance, and each must find a closed surface, and the ellipsoid must be less than five times as long as thick; "
    "what is not identifiable has the range over methods, halves and windows as its interval, and is no ellipsoid at "
    "all if its longest radius is more than five times the extent of the cloud, and the weight where the model gives it"
)
"""Both rules in one sentence, for results."""


class CloudForm(StrEnum):
    """What part of a sphere a cloud can be told to be."""

    SURFACE = "surface"
    """Enough of it for an ellipsoid."""
    CAP = "cap"
    """Bent, but too little of it, or too noisy, for an ellipsoid."""
    PLANE = "plane"
    """It cannot be told from a plane, or lies in one, as a single circle does."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RadiusFit(ArrayRecord):
    """A sphere of one radius through a cloud: what a perfect sensor would read."""

    centre: FloatArray | None = field(metadata=array(3))
    """Centre by the geometric fit; shape (3,); None where it went on opening."""
    algebraic: float
    """Radius by linear least squares; infinite for a plane."""
    geometric: float
    """Radius by orthogonal distances; infinite where it went on opening."""
    low: float
    """Lower end of the interval over halves and windows of the recording and both methods."""
    high: float
    """Upper end; infinite where a part of the recording is flat."""
    rms: float
    """Root mean square distance from the geometric sphere; NaN without one."""
    identifiable: bool
    """Whether the interval is within the tolerance."""
    why: tuple[str, ...]
    """What speaks against it; empty if it is identifiable."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EllipsoidFit(ArrayRecord):
    """An ellipsoid with the uncertainty of its axis intersections."""

    ellipsoid: Ellipsoid | None
    """The ellipsoid; None where the cloud or the reference is flat to rounding."""
    low: FloatArray = field(metadata=array(3))
    """Lower ends of the axis intersections; shape (3,)."""
    high: FloatArray = field(metadata=array(3))
    """Upper ends; infinite where the surface may be open; shape (3,)."""
    half_width_low: FloatArray = field(metadata=array(3))
    """Lower ends of the half-widths; shape (3,)."""
    half_width_high: FloatArray = field(metadata=array(3))
    """Upper ends; infinite where the surface may be open; shape (3,)."""
    index_low: float
    """Lower end of the sample standard deviation of the three axis intersections; 0 where their intervals share a
    value."""
    index_high: float
    """Its upper end; infinite where the surface may be open."""
    centre_margin: FloatArray = field(metadata=array(3))
    """Half of the 95 % interval of the centre; infinite without an ellipsoid; shape (3,)."""
    rms: float
    """Root mean square distance from the ellipsoid; with the model from where the map has each sample on it, which is
    no less; NaN without an ellipsoid."""
    identifiable: bool
    """Whether the intersections are worth comparing."""
    tilt_identifiable: bool
    """Whether the half-widths, and with them the principal radii, are too: a few poses along the axes tell the
    intersections and nothing in between."""
    why: tuple[str, ...]
    """What speaks against the intersections; empty if they are identifiable."""

    @property
    def index(self) -> float:
        """Sample standard deviation of the three axis intersections; NaN without an ellipsoid."""
        return np.nan if self.ellipsoid is None else spread_index(self.ellipsoid.axis_intersections)


def no_radius(reason: str) -> RadiusFit:
    """Say that there is no sphere.

    Args:
        reason: Why not.

    Returns:
        A radius that may be anything.
    """
    return RadiusFit(
        centre=None,
        algebraic=np.inf,
        geometric=np.inf,
        low=0.0,
        high=np.inf,
        rms=np.nan,
        identifiable=False,
        why=(reason,),
    )


def no_ellipsoid(*reasons: str) -> EllipsoidFit:
    """Say that there is no ellipsoid.

    Args:
        reasons: Why not.

    Returns:
        A fit that may be anything.
    """
    return EllipsoidFit(
        ellipsoid=None,
        low=np.zeros(3),
        high=np.full(3, np.inf),
        half_width_low=np.zeros(3),
        half_width_high=np.full(3, np.inf),
        index_low=0.0,
        index_high=np.inf,
        centre_margin=np.full(3, np.inf),
        rms=np.nan,
        identifiable=False,
        tilt_identifiable=False,
        why=reasons,
    )


def beyond_measured_extent(ellipsoid: Ellipsoid, extent: float) -> str | None:
    """Find whether an ellipsoid lies where nothing was measured.

    Args:
        ellipsoid: The ellipsoid.
        extent: Size that the data vouch for: that of the cloud, or of the weight if it is larger.

    Returns:
        Why it is none; None if it may be one.
    """
    ratio = float(ellipsoid.principal_radii[0]) / extent
    if ratio <= _FAR:
        return None
    return f"its longest radius would be {ratio:.3g} times the extent of what was measured, so there is no ellipsoid"


def spread_index(lengths: FloatArray) -> float:
    """Sum up in one number how far a sensor is from reading the same force alike along all axes.

    The thesis prints it as a "standard deviation of the radii". The numbers of its Table 4.1 are the sample standard
    deviation of the three axis intersections over gravity, that is of three apparent masses.

    Args:
        lengths: Axis intersections, or apparent masses; shape (3,).

    Returns:
        Their sample standard deviation, with n - 1; 0 for a perfect sensor.
    """
    return float(np.std(lengths, ddof=1))


def lengths_of(inverse: FloatArray) -> FloatArray:
    """Give the lengths that belong to one over them.

    Args:
        inverse: One over lengths; zero or less for an open surface.

    Returns:
        Lengths, infinite for an open surface; the same shape.
    """
    positive = inverse > 0.0
    return np.where(positive, 1.0 / np.where(positive, inverse, 1.0), np.inf)


def indices_of(inverse: FloatArray) -> FloatArray:
    """Give the index of every estimate.

    Args:
        inverse: One over axis intersections; shape (m, 3 or more).

    Returns:
        Sample standard deviations of the first three lengths; shape (m,); infinite for open surfaces.
    """
    lengths = lengths_of(inverse[:, :3])
    closed = np.asarray(np.isfinite(lengths).all(axis=1))
    return np.where(closed, np.where(closed[:, None], lengths, 0.0).std(axis=1, ddof=1), np.inf)


def index_ends(estimates: Sequence[Resampled], *, jackknifed: bool) -> tuple[float, float]:
    """Give the interval of the index.

    Args:
        estimates: One over the axis intersections, and maybe more, by some methods.
        jackknifed: Whether they move so little that the jackknife holds; else the range over all parts is taken.

    Returns:
        Its ends over the methods, not below 0; infinite where a part is open.
    """
    if jackknifed:
        ends = [estimate.mapped(lambda inverse: indices_of(inverse)[:, None]).jackknifed for estimate in estimates]
        return max(0.0, min(float(low[0]) for low, _ in ends)), max(float(high[0]) for _, high in ends)
    parts = [
        np.vstack([estimate.whole, estimate.without_one, estimate.halves, estimate.windows]) for estimate in estimates
    ]
    indices = indices_of(np.concatenate(parts))
    return float(indices.min()), float(indices.max())


def lowest_index(index_low: float, low: FloatArray, high: FloatArray) -> float:
    """Let the interval of the index hold 0 where the lengths may be equal.

    An index is no less than 0, and noise only adds to it, so that near 0 an interval about the estimate lies too high.

    Args:
        index_low: Lower end of the interval about the estimate.
        low: Lower ends of the axis intersections; shape (3,).
        high: Their upper ends; shape (3,).

    Returns:
        0 where the three intervals share a value, else the end as it was, not below 0.
    """
    return 0.0 if low.max() <= high.min() else max(0.0, index_low)


def relative_margin(low: FloatArray, high: FloatArray, mean: float) -> float:
    """Give half of the widest of some intervals.

    Args:
        low: Lower ends of one over lengths; shape (k,).
        high: Upper ends of one over lengths; shape (k,).
        mean: What it is relative to.

    Returns:
        Half of the interval of the length, relative to the mean; infinite for an open surface.
    """
    return float((0.5 * (lengths_of(low) - lengths_of(high))).max()) / mean


def percent(share: float) -> str:
    """Write a share for a message.

    Args:
        share: The share, or infinity.

    Returns:
        It in per cent.
    """
    return f"{100.0 * share:.3g} %" if np.isfinite(share) else "any amount"
