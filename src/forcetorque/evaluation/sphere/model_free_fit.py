# SPDX-License-Identifier: BSD-3-Clause
"""Fits without the model: one radius, and an ellipsoid, as far as the cloud determines them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.sphere.algebraic_fit import (
    Quadrics,
    Spheres,
    direct_fit,
    gradient_weighted_fit,
    gradient_weighted_spheres,
    inverse_lengths,
    least_squares_spheres,
)
from forcetorque.evaluation.sphere.cloud import QuadricMoments, extent, reach
from forcetorque.evaluation.sphere.ellipsoid import (
    Ellipsoid,
    EllipsoidFit,
    RadiusFit,
    beyond_measured_extent,
    index_ends,
    indices_of,
    lengths_of,
    lowest_index,
    no_ellipsoid,
    no_radius,
    percent,
    relative_margin,
)
from forcetorque.evaluation.sphere.geometric_fit import refine_ellipsoid, refine_sphere
from forcetorque.evaluation.sphere.resampling import FEWEST_SAMPLES, Resampled, resampled, whole

_FLAT = 1e-5
"""Extent across a plane, relative to that along it, below which moments of the fourth degree see none."""

_SQUASHED = 5.0
"""Longest over shortest radius from which an ellipsoid is the noise around a plane.

The most deformed sensor of thesis Table 4.1 has 1.6; through a noisy circle, ellipsoids of 18 and more were found
that halves, blocks and methods agree on.
"""

_NEARLY_FLAT = 0.3
"""Size of a cloud, relative to a radius, below which the cloud is a small part of one side of the sphere."""


def is_flat(cloud: FloatArray) -> bool:
    """Find whether a cloud lies in a plane to rounding.

    Args:
        cloud: Points; shape (n, 3).

    Returns:
        Whether it does.
    """
    spans = np.linalg.eigvalsh(np.cov(cloud.T))
    return bool(spans[0] <= _FLAT**2 * spans[-1])


def fit_radius(cloud: FloatArray, *, unit: str, tolerance: float) -> RadiusFit:
    """Fit a sphere.

    Args:
        cloud: Points in the order of time, at least ten; shape (n, 3).
        unit: Unit of the points, for words.
        tolerance: Half width of the interval, relative to the radius, up to which it is identifiable.

    Returns:
        The fit.
    """
    if is_flat(cloud):
        return no_radius("the cloud lies in a plane")
    moments = QuadricMoments.of(cloud)
    fits = [bends(moments, fit) for fit in (least_squares_spheres, gradient_weighted_spheres)]
    start = gradient_weighted_spheres(whole(moments.sums), moments)
    algebraic = float(least_squares_spheres(whole(moments.sums), moments).radius[0])
    geometric = refine_sphere(cloud, start.centre[0], float(start.radius[0]))
    radius = float(geometric.parameters[3]) if geometric.converged else np.inf
    low, high = _hull([fit.halved for fit in fits], np.array([1.0 / radius]))
    why = []
    if len(cloud) < FEWEST_SAMPLES:
        why.append(f"{len(cloud)} samples are too few to leave any out; take at least {FEWEST_SAMPLES}")
    if not (np.isfinite(high[0]) and 0.5 * (high[0] - low[0]) <= tolerance * radius):
        why.append(f"halves of the recording give radii from {low[0]:.3g} to {high[0]:.3g} {unit}")
    if why:
        low, high = _hull([fit.ranged for fit in fits], np.array([1.0 / radius]))
    return RadiusFit(
        centre=geometric.parameters[:3] if geometric.converged else None,
        algebraic=algebraic,
        geometric=radius,
        low=float(low[0]),
        high=float(high[0]),
        rms=geometric.rms if geometric.converged else np.nan,
        identifiable=not why,
        why=tuple(why),
    )


def may_be_flat(cloud: FloatArray) -> bool:
    """Find whether a cloud can be told from a plane.

    Args:
        cloud: Points in the order of time; shape (n, 3).

    Returns:
        Whether the 95 % interval of its bend holds zero.
    """
    if is_flat(cloud):
        return True
    low, _ = bends(QuadricMoments.of(cloud), gradient_weighted_spheres).jackknifed
    return bool(low[0] <= 0.0)


def fit_ellipsoid(cloud: FloatArray, radius: RadiusFit, *, tolerance: float) -> EllipsoidFit:
    """Fit an ellipsoid: directly, then geometrically.

    Args:
        cloud: Points in the order of time, at least ten; shape (n, 3).
        radius: Fit of one radius to the same cloud.
        tolerance: Half width of an interval, relative to the mean intersection, up to which it is identifiable.

    Returns:
        The geometric ellipsoid where it is a minimum, else the direct one; none where nothing was measured near it;
        see `findings` for the rules.
    """
    if is_flat(cloud):
        return no_ellipsoid("the cloud lies in a plane")
    moments = QuadricMoments.of(cloud)
    both = resampled(moments.sums, lambda mean: _lengths_and_centres(direct_fit(mean, moments)), extent=extent)
    direct, centres = both.mapped(lambda numbers: numbers[:, :6]), both.mapped(lambda numbers: numbers[:, 6:])
    weighted = resampled(moments.sums, lambda mean: gradient_weighted_fit(mean, moments).inverse_lengths, extent=extent)
    first = direct_fit(whole(moments.sums), moments)
    if not first.closed[0]:  # nearly flat clouds leave the constraint to rounding
        return no_ellipsoid("the cloud lies in a plane")
    ellipsoid, refined = refine_ellipsoid(cloud, Ellipsoid(centre=first.centre[0], shape=first.shape[0]))
    geometric = np.zeros(6)
    if refined.converged:
        geometric = inverse_lengths(np.linalg.inv(ellipsoid.shape)[None])[0]
    else:
        ellipsoid = Ellipsoid(centre=first.centre[0], shape=first.shape[0])
    why = _against(len(cloud), direct, weighted, geometric, slice(0, 3), tolerance) + _squashed(ellipsoid)
    far = beyond_measured_extent(ellipsoid, reach(cloud)) if why else None
    if far is not None:
        return no_ellipsoid(*why, far)
    low, high, index_low, index_high = _intervals(direct, weighted, geometric, radius if why else None)
    return EllipsoidFit(
        ellipsoid=ellipsoid,
        low=low[:3],
        high=high[:3],
        half_width_low=low[3:],
        half_width_high=high[3:],
        index_low=index_low,
        index_high=index_high,
        centre_margin=np.where(np.isfinite(centres.margin), centres.margin, np.inf),
        rms=refined.rms if refined.converged else np.nan,
        identifiable=not why,
        tilt_identifiable=not (why or _against(len(cloud), direct, weighted, geometric, slice(3, 6), tolerance)),
        why=why,
    )


def bends(moments: QuadricMoments, fit: Callable[[FloatArray, QuadricMoments], Spheres]) -> Resampled:
    """Estimate one over the radius from the whole cloud and from parts of it.

    Args:
        moments: Moments of the cloud.
        fit: A method.

    Returns:
        One over the radius, negative where a part that is nearly flat bends the other way than the whole; k is 1.
    """
    towards = fit(whole(moments.sums), moments).bend[0]

    def signed(mean: FloatArray) -> FloatArray:
        bend = fit(mean, moments).bend
        size = np.linalg.norm(bend, axis=1)
        # parts of a wide cloud look at the centre from different sides, which is no other way of bending
        other_way = (size * moments.scale < _NEARLY_FLAT) & (bend @ towards < 0.0)
        return np.where(other_way, -size, size)[:, None]

    return resampled(moments.sums, signed, extent=extent)


def _lengths_and_centres(quadrics: Quadrics) -> FloatArray:
    """One over the axis intersections and half-widths, 0 for open surfaces, then centres; shape (m, 9)."""
    return np.concatenate([quadrics.inverse_lengths, quadrics.centre], axis=1)


def _against(
    count: int, direct: Resampled, weighted: Resampled, geometric: FloatArray, which: slice, tolerance: float
) -> tuple[str, ...]:
    """What speaks against some of the lengths: see the rule in `findings`."""
    if count < FEWEST_SAMPLES:
        return (f"{count} samples are too few to leave any out; take at least {FEWEST_SAMPLES}",)
    inverse = np.stack([fit[which] for fit in (direct.whole, weighted.whole, geometric)])
    if not (inverse > 0.0).all():
        return ("the cloud fits an open surface as well",)
    why = []
    lengths = 1.0 / inverse
    mean = float(lengths.mean())
    gap = float(np.ptp(lengths, axis=0).max()) / mean
    if gap > tolerance:
        why.append(f"methods that treat noise differently are {percent(gap)} of the mean radius apart")
    ends = (fit.jackknifed for fit in (direct, weighted))
    margin = max(relative_margin(low[which], high[which], mean) for low, high in ends)
    if not margin <= tolerance:
        why.append(f"without one tenth of the recording after the other, a radius is known to {percent(margin)} only")
    return tuple(why)


def _squashed(ellipsoid: Ellipsoid) -> tuple[str, ...]:
    radii = ellipsoid.principal_radii
    ratio = float(radii[0] / radii[-1])
    if ratio < _SQUASHED:
        return ()
    return (f"the longest radius is {ratio:.3g} times the shortest, as of a plane with its noise",)


def _lengths(inverse: tuple[FloatArray, FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Ends of intervals of lengths from those of one over them."""
    return lengths_of(inverse[1]), lengths_of(inverse[0])


def _hull(intervals: Sequence[tuple[FloatArray, FloatArray]], *points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Ends of the smallest intervals of lengths that hold some intervals, and points, of one over them."""
    return _lengths(
        (
            np.min([*(low for low, _ in intervals), *points], axis=0),
            np.max([*(high for _, high in intervals), *points], axis=0),
        )
    )


def _intervals(
    direct: Resampled, weighted: Resampled, geometric: FloatArray, radius: RadiusFit | None
) -> tuple[FloatArray, FloatArray, float, float]:
    """Intervals of lengths and index; `radius` if the ellipsoid is not identifiable: see the rule."""
    fits = (direct, weighted)
    index_low, index_high = index_ends(fits, jackknifed=radius is None)
    if radius is None:
        point = float(indices_of(geometric[None])[0])
        low, high = _hull([fit.jackknifed for fit in fits], geometric)
        return low, high, lowest_index(min(index_low, point), low[:3], high[:3]), max(index_high, point)
    one = (np.full(6, 1.0 / radius.high), np.full(6, 1.0 / radius.low))
    low, high = _hull([*(fit.ranged for fit in fits), one], geometric)
    return low, high, 0.0, index_high  # a sphere, whose index is 0, is not excluded
