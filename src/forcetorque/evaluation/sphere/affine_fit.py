# SPDX-License-Identifier: BSD-3-Clause
"""Fits with the model: the affine map that makes what the sensor read of the forces that it should have read.

The reference goes over a part of a sphere of the radius m g, and the map takes the whole sphere along, so the
ellipsoid is known where the cloud itself, without the model, would not tell it from others. The same forces
make the moment of a stiff limb, `c x f` with its centre of mass c: a sphere of forces becomes a disc of moments,
on which axes have no intersection but a half-width.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.evaluation.sphere.algebraic_fit import inverse_lengths
from forcetorque.evaluation.sphere.cloud import reach
from forcetorque.evaluation.sphere.ellipsoid import (
    EllipsoidFit,
    beyond_measured_extent,
    ellipsoid_of_map,
    index_ends,
    lengths_of,
    lowest_index,
    no_ellipsoid,
    percent,
    relative_margin,
)
from forcetorque.evaluation.sphere.model_free_fit import is_flat
from forcetorque.evaluation.sphere.resampling import FEWEST_SAMPLES, Resampled, resampled, sums_of_products, whole
from forcetorque.results.table import AxisValues, Row

_ROUNDING = 1e-14
"""Square of a radius, relative to that of the largest, at which an ellipsoid is flat."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MappedFit(ArrayRecord):
    """An ellipsoid that is the image of the model's sphere."""

    matrix: FloatArray = field(metadata=array(3, 3))
    """Map of reference forces to measured ones; shape (3, 3)."""
    centre: FloatArray = field(metadata=array(3))
    """What the sensor reads without force; shape (3,); N."""
    radius: float
    """Radius of the model's sphere: weight on the sensor; N."""
    fit: EllipsoidFit
    """The ellipsoid."""


class MomentRow(Row):
    """How far moments reach while the force goes over its sphere, with the model."""

    identifiable: bool
    """Whether the half-widths are worth comparing."""
    why: tuple[str, ...]
    """What speaks against it."""
    centre_Nm: AxisValues
    """What the sensor reads without force."""
    half_width_Nm: AxisValues
    """Largest moment about each axis that the sensor would read."""
    low_Nm: AxisValues
    """Lower ends of their intervals."""
    high_Nm: AxisValues
    """Upper ends."""
    expected_half_width_Nm: AxisValues
    """Largest moment about each axis by the model."""
    error_Nm: AxisValues
    """Measured minus expected."""
    index_Nm: float
    """Sample standard deviation of the three errors."""
    stray_share: float
    """Root mean square of the model's moment that does not follow its force, relative to the largest half-width."""


def fit_mapped(force: FloatArray, reference: FloatArray, *, radius: float, tolerance: float) -> MappedFit | None:
    """Fit the map of reference forces to measured ones.

    Accelerations do no harm here: the map is of forces of any size, and it is the weight's sphere that it is laid on.

    Args:
        force: Measured forces; shape (n, 3); N.
        reference: Reference forces at the same instants; shape (n, 3); N.
        radius: Weight on the sensor; N.
        tolerance: Half width of an interval, relative to the mean intersection, up to which it is identifiable.

    Returns:
        The map with its ellipsoid; None where the reference stays in a plane to rounding.
    """
    if is_flat(reference):
        return None
    sums, shift = _sums(reference, force)
    (matrix,), (centre,) = _maps(whole(sums), shift)
    estimates = resampled(
        sums, lambda mean: inverse_lengths_of(_maps(mean, shift)[0] * radius), extent=_reference_extent
    )
    centres = resampled(sums, lambda mean: _maps(mean, shift)[1], extent=_reference_extent)
    error = force - reference @ matrix.T - centre
    fit = image_of_sphere(
        matrix,
        centre,
        estimates,
        radius=radius,
        extent=reach(force),
        centre_margin=centres.margin,
        error=error,
        tolerance=tolerance,
    )
    return MappedFit(matrix=matrix, centre=centre, radius=radius, fit=fit)


def image_of_sphere(
    matrix: FloatArray,
    centre: FloatArray,
    estimates: Resampled,
    *,
    radius: float,
    extent: float,
    centre_margin: FloatArray,
    error: FloatArray,
    tolerance: float,
) -> EllipsoidFit:
    """Lay a map on the sphere of the weight and evaluate the ellipsoid.

    Args:
        matrix: Map of reference forces to measured ones; shape (3, 3).
        centre: What the sensor reads without force; shape (3,); N.
        estimates: One over the lengths of the ellipsoid, by `inverse_lengths_of`; k is 6.
        radius: Weight on the sensor; N.
        extent: Size that the measured forces are within; N.
        centre_margin: Half of the 95 % interval of the centre; shape (3,); N.
        error: What the map leaves of the measured forces; shape (n, 3); N.
        tolerance: Half width of an interval, relative to the mean intersection, up to which it is identifiable.

    Returns:
        The ellipsoid with its intervals; none where the map makes of the weight what was nowhere measured.
    """
    if not (estimates.whole > 0.0).all():
        return no_ellipsoid("the measured forces lie in a plane")
    ellipsoid = ellipsoid_of_map(matrix, centre=centre, radius=radius)
    low, high = estimates.jackknifed
    mean = float(ellipsoid.axis_intersections.mean())
    why = _against(len(error), relative_margin(low[:3], high[:3], mean), tolerance)
    far = beyond_measured_extent(ellipsoid, max(extent, radius)) if why else None
    if far is not None:
        return no_ellipsoid(*why, far)
    tilt = not why and relative_margin(low[3:], high[3:], mean) <= tolerance
    if why:
        low, high = estimates.ranged
    index_low, index_high = index_ends([estimates], jackknifed=not why)
    shortest, longest = lengths_of(high[:3]), lengths_of(low[:3])
    return EllipsoidFit(
        ellipsoid=ellipsoid,
        low=shortest,
        high=longest,
        half_width_low=lengths_of(high[3:]),
        half_width_high=lengths_of(low[3:]),
        index_low=lowest_index(index_low, shortest, longest),
        index_high=index_high,
        centre_margin=centre_margin,
        rms=float(np.sqrt((error**2).sum(axis=1).mean())),
        identifiable=not why,
        tilt_identifiable=tilt,
        why=why,
    )


def fit_moment(
    moment: FloatArray, reference_moment: FloatArray, reference: FloatArray, *, radius: float, tolerance: float
) -> MomentRow | None:
    """Fit the maps of reference forces to measured and to reference moments.

    Args:
        moment: Measured moments; shape (n, 3); N m.
        reference_moment: Reference moments at the same instants; shape (n, 3); N m.
        reference: Reference forces; shape (n, 3); N.
        radius: Weight on the sensor; N.
        tolerance: Half width of an interval, relative to the largest half-width, up to which it is identifiable.

    Returns:
        How far moments reach; None where the reference stays in a plane to rounding.
    """
    if is_flat(reference):
        return None
    sums, shift = _sums(reference, moment)
    _, (centre,) = _maps(whole(sums), shift)
    estimates = resampled(
        sums, lambda mean: radius * np.linalg.norm(_maps(mean, shift)[0], axis=2), extent=_reference_extent
    )
    expected_sums, expected_shift = _sums(reference, reference_moment)
    (expected,), (rest,) = _maps(whole(expected_sums), expected_shift)
    reach = radius * np.linalg.norm(expected, axis=1)
    stray = reference_moment - reference @ expected.T - rest
    largest = max(float(reach.max()), float(estimates.whole.max()), np.finfo(float).tiny)
    share = float(np.sqrt((stray**2).sum(axis=1).mean())) / largest
    margin = float(estimates.margin.max()) / largest
    why = _against(len(moment), margin, tolerance)
    if share > tolerance:
        why += (f"the limb is not stiff: {percent(share)} of its largest moment does not follow the force",)
    low, high = estimates.ranged if why else estimates.jackknifed
    errors = estimates.whole - reach
    return MomentRow(
        identifiable=not why,
        why=why,
        centre_Nm=centre,
        half_width_Nm=estimates.whole,
        low_Nm=np.maximum(low, 0.0),
        high_Nm=high,
        expected_half_width_Nm=reach,
        error_Nm=errors,
        index_Nm=float(np.std(errors, ddof=1)),
        stray_share=share,
    )


def _against(count: int, margin: float, tolerance: float) -> tuple[str, ...]:
    if count < FEWEST_SAMPLES:
        return (f"{count} samples are too few to leave any out; take at least {FEWEST_SAMPLES}",)
    if not margin <= tolerance:
        return (f"without one tenth of the recording after the other, a radius is known to {percent(margin)} only",)
    return ()


def _sums(reference: FloatArray, measured: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sums of products of [reference, measured, 1] per block, about the means; and these means."""
    pairs = np.hstack([reference, measured])
    shift = pairs.mean(axis=0)
    return sums_of_products(pairs, lambda rows: np.column_stack([rows - shift, np.ones(len(rows))])), shift


def _reference_extent(mean: FloatArray) -> FloatArray:
    """Root mean square distances of references from their mean; shape (m,)."""
    squares = np.trace(mean[:, :3, :3], axis1=1, axis2=2) - (mean[:, :3, 6] ** 2).sum(axis=1)
    return np.sqrt(np.maximum(squares, 0.0))


def _maps(mean: FloatArray, shift: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Linear maps (m, 3, 3) of reference to measured, and what becomes of no force (m, 3), from mean products."""
    middle = mean[:, :6, 6]
    centred = mean[:, :6, :6] - middle[:, :, None] * middle[:, None, :]
    # the smallest of all maps where a part of the recording stays in a plane
    inverse = np.linalg.pinv(centred[:, :3, :3], rcond=1e-12, hermitian=True)
    matrices = centred[:, 3:, :3] @ inverse
    reference, measured = middle[:, :3] + shift[:3], middle[:, 3:] + shift[3:]
    return matrices, measured - np.einsum("mij,mj->mi", matrices, reference)


def inverse_lengths_of(spread: FloatArray) -> FloatArray:
    """Measure images of the unit sphere along the axes.

    Args:
        spread: The maps; shape (m, 3, 3).

    Returns:
        One over the axis intersections, then one over the half-widths, 0 for flat images; shape (m, 6).
    """
    squares = spread @ spread.transpose(0, 2, 1)
    values = np.linalg.eigvalsh(squares)
    solid = values[:, 0] > _ROUNDING * values[:, -1]
    lengths = np.zeros((len(spread), 6))
    lengths[solid] = inverse_lengths(squares[solid])
    return lengths
