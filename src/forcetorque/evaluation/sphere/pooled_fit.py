# SPDX-License-Identifier: BSD-3-Clause
"""One analysis over several trials, between which the offset of the sensor changes: a centre for each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, read_only
from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.sphere.affine_fit import image_of_sphere, inverse_lengths_of
from forcetorque.evaluation.sphere.algebraic_fit import direct_shape_with_own_centres, inverse_lengths
from forcetorque.evaluation.sphere.cloud import monomials, reach, require_cloud
from forcetorque.evaluation.sphere.ellipsoid import (
    TOLERANCE,
    Ellipsoid,
    EllipsoidFit,
    indices_of,
    lengths_of,
    lowest_index,
    no_ellipsoid,
    percent,
    relative_margin,
)
from forcetorque.evaluation.sphere.geometric_fit import (
    NormalEquations,
    descend,
    ellipsoid_equations,
    ellipsoid_of_parameters,
    ellipsoid_parameters,
)
from forcetorque.evaluation.sphere.model_free_fit import fit_ellipsoid, fit_radius, is_flat
from forcetorque.evaluation.sphere.resampling import BLOCKS, jackknife_margin, resampled, whole


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OwnCentres(ArrayRecord):
    """An ellipsoid that is fitted to several clouds at once."""

    parameters: FloatArray = field(metadata=array(None))
    """Centre of each cloud, then the lower triangle of L as in `orthogonal`; shape (3 t + 6,)."""

    @property
    def centres(self) -> FloatArray:
        """Centre for each cloud; shape (t, 3)."""
        return self.parameters[:-6].reshape(-1, 3)

    @property
    def ellipsoid(self) -> Ellipsoid:
        """The shape, about the origin."""
        return ellipsoid_of_parameters(np.concatenate([np.zeros(3), self.parameters[-6:]]))


def fit_with_own_centres(clouds: Sequence[FloatArray], start: OwnCentres | None = None) -> OwnCentres | None:
    """Fit one shape and a centre for each cloud, by orthogonal distances.

    Args:
        clouds: Points; shapes (n, 3).
        start: Where to start; the direct fit if None.

    Returns:
        The fit; None where it is no minimum, because the clouds determine no ellipsoid.
    """
    begun = _direct(clouds) if start is None else start
    if begun is None:
        return None
    means = np.array([cloud.mean(axis=0) for cloud in clouds])
    moved = [cloud - mean for cloud, mean in zip(clouds, means, strict=True)]
    size = max(float(np.ptp(cloud, axis=0).max()) for cloud in clouds)
    offset = np.append(means.ravel(), np.zeros(6))
    descent = descend(
        lambda parameters: _equations(moved, parameters), begun.parameters - offset, size, sum(map(len, clouds))
    )
    return OwnCentres(parameters=descent.parameters + offset) if descent.converged else None


def _equations(clouds: Sequence[FloatArray], parameters: FloatArray) -> NormalEquations | None:
    """Normal equations of all clouds: those of each reach its own centre and the common shape."""
    count = len(parameters)
    cost, gradient, hessian = 0.0, np.zeros(count), np.zeros((count, count))
    for k, cloud in enumerate(clouds):
        mine = np.r_[3 * k : 3 * k + 3, count - 6 : count]
        part = ellipsoid_equations(cloud, parameters[mine])
        if part is None:
            return None
        cost += part.cost
        gradient[mine] += part.gradient
        hessian[np.ix_(mine, mine)] += part.hessian
    return NormalEquations(cost=cost, gradient=gradient, hessian=hessian)


def _direct(clouds: Sequence[FloatArray]) -> OwnCentres | None:
    shifts = [cloud.mean(axis=0) for cloud in clouds]
    scale = max(float(np.sqrt(((cloud - s) ** 2).sum(axis=1).mean())) for cloud, s in zip(clouds, shifts, strict=True))
    if scale == 0.0:
        return None
    monomial_rows = [monomials((cloud - shift) / scale) for cloud, shift in zip(clouds, shifts, strict=True)]
    solution = direct_shape_with_own_centres(np.array([rows.T @ rows for rows in monomial_rows]))
    if solution is None:
        return None
    shape, centres = solution
    common = Ellipsoid(centre=np.zeros(3), shape=shape / scale**2)
    return OwnCentres(
        parameters=np.append((np.array(shifts) + scale * centres).ravel(), ellipsoid_parameters(common)[3:])
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PooledSphere(ArrayRecord):
    """What several trials say together."""

    free: EllipsoidFit
    """Ellipsoid without the model; its centre is zero; N."""
    free_centres: FloatArray | None = field(metadata=array(None, 3))
    """Centre of each trial, in their order; shape (t, 3); N; None without an ellipsoid."""
    mapped: EllipsoidFit | None
    """Ellipsoid with the model; its centre is zero; N; None where a trial has no reference."""
    mapped_centres: FloatArray | None = field(metadata=array(None, 3))
    """What the sensor read without force in each trial; shape (t, 3); N; None without its
    ellipsoid."""


def pool_trials(
    forces: Sequence[FloatArray],
    references: Sequence[FloatArray] | None = None,
    *,
    weight: float | None = None,
    tolerance: float = TOLERANCE,
) -> PooledSphere:
    """Fit one ellipsoid to the forces of several trials, each with its own offset.

    Args:
        forces: Measured forces of each trial in the order of time, at least ten; shapes (n, 3); N.
        references: Forces by the model at the same instants; shapes (n, 3); N; None without a model.
        weight: Weight on the sensor; N; needed with references.
        tolerance: Half width of an interval, relative to the mean intersection, up to which it is identifiable.

    Returns:
        The fits, which do not depend on the order of the trials.

    Raises:
        ForceTorqueError: If there is no trial, or references without their weight.
        ShapeError: If there is not a reference for every force.
        FitError: If a trial has fewer than ten samples, or its forces or references are one point.
    """
    if not forces:
        raise ForceTorqueError("trials: expected at least one, got none")
    clouds = [require_cloud(force, name=f"force of trial {k + 1}", unit="N") for k, force in enumerate(forces)]
    # sums depend on their order in the last digit: a canonical one makes results the same to the bit
    order = sorted(range(len(clouds)), key=lambda k: (len(clouds[k]), *clouds[k].mean(axis=0)))
    sorted_clouds, place = [clouds[k] for k in order], np.argsort(order)
    free, free_centres = _free(sorted_clouds, tolerance)
    mapped, mapped_centres, why = None, None, None
    if references is not None:
        if weight is None or not 0.0 < weight < np.inf:
            raise ForceTorqueError(f"weight: expected a positive number with references, got {weight}")
        expected = [
            read_only(references[k], name=f"reference of trial {k + 1}", shape=(len(clouds[k]), 3)) for k in order
        ]
        for k, reference in zip(order, expected, strict=True):
            require_cloud(reference, name=f"reference of trial {k + 1}", unit="N")
        mapped, mapped_centres = _mapped(sorted_clouds, expected, weight, tolerance)
        why = _no_one_size(expected, tolerance)
    if why is not None:
        free = replace(free, identifiable=False, tilt_identifiable=False, why=(why, *free.why))
    return PooledSphere(
        free=free,
        free_centres=None if free_centres is None else free_centres[place],
        mapped=mapped,
        mapped_centres=None if mapped_centres is None else mapped_centres[place],
    )


def _tenths(trials: Sequence[FloatArray]) -> list[FloatArray]:
    """The same tenth of every trial, one after the other; shapes (m, k)."""
    cut = [np.array_split(trial, BLOCKS) for trial in trials]
    return [np.concatenate(parts) for parts in zip(*cut, strict=True)]


def _no_one_size(references: Sequence[FloatArray], tolerance: float) -> str | None:
    sizes = [np.linalg.norm(reference, axis=1) for reference in references]
    scatter = max(float(size.std() / size.mean()) for size in sizes)
    if scatter <= tolerance:
        return None
    return f"by the model the force has no one size in a trial, it scatters by {percent(scatter)}; move slowly"


def _free(clouds: Sequence[FloatArray], tolerance: float) -> tuple[EllipsoidFit, FloatArray | None]:
    if any(is_flat(cloud) for cloud in clouds):
        return no_ellipsoid("a trial lies in a plane"), None
    own = fit_with_own_centres(clouds)
    if own is None:
        return no_ellipsoid("the trials together determine no ellipsoid with a centre for each"), None
    moved = np.concatenate(_tenths([cloud - centre for cloud, centre in zip(clouds, own.centres, strict=True)]))
    fit = fit_ellipsoid(moved, fit_radius(moved, unit="N", tolerance=tolerance), tolerance=tolerance)
    return _with_unknown_centres(fit, clouds, own, tolerance), None if fit.ellipsoid is None else own.centres


def _with_unknown_centres(
    fit: EllipsoidFit, clouds: Sequence[FloatArray], own: OwnCentres, tolerance: float
) -> EllipsoidFit:
    """Widen intervals by what the centres are not known."""
    cut = [np.array_split(cloud, BLOCKS) for cloud in clouds]
    parts = []
    for left_out in range(BLOCKS):
        kept = [np.concatenate([*blocks[:left_out], *blocks[left_out + 1 :]]) for blocks in cut]
        part = fit_with_own_centres(kept, own)
        if part is None:
            reason = "without a tenth of the recordings the centres of the trials are not determined"
            return replace(no_ellipsoid(reason), ellipsoid=fit.ellipsoid)
        parts.append(_inverse(part))
    inverse, middle = np.array(parts), _inverse(own)
    margin = jackknife_margin(inverse)
    low, high = middle - margin, middle + margin
    indices, index = indices_of(inverse), float(indices_of(middle[None])[0])
    spread = float(jackknife_margin(indices[:, None])[0])
    mean = float((1.0 / middle[:3]).mean())
    why = fit.why
    share = relative_margin(low[:3], high[:3], mean)
    if not why and not share <= tolerance:
        why = (f"with the centres of the trials not known, a radius is known to {percent(share)} only",)
    shortest, longest = np.minimum(fit.low, lengths_of(high[:3])), np.maximum(fit.high, lengths_of(low[:3]))
    return replace(
        fit,
        low=shortest,
        high=longest,
        half_width_low=np.minimum(fit.half_width_low, lengths_of(high[3:])),
        half_width_high=np.maximum(fit.half_width_high, lengths_of(low[3:])),
        index_low=lowest_index(min(fit.index_low, index - spread), shortest, longest),
        index_high=max(fit.index_high, index + spread),
        identifiable=not why,
        tilt_identifiable=fit.tilt_identifiable and not why and relative_margin(low[3:], high[3:], mean) <= tolerance,
        why=why,
    )


def _inverse(own: OwnCentres) -> FloatArray:
    """One over axis intersections and half-widths; shape (6,)."""
    return inverse_lengths(np.linalg.inv(own.ellipsoid.shape)[None])[0]


def _mapped(
    clouds: Sequence[FloatArray], references: Sequence[FloatArray], weight: float, tolerance: float
) -> tuple[EllipsoidFit | None, FloatArray | None]:
    about = [reference - reference.mean(axis=0) for reference in references]
    if is_flat(np.concatenate(about)):
        return None, None
    count = len(clouds)
    shifts = [np.hstack([r.mean(axis=0), c.mean(axis=0)]) for r, c in zip(references, clouds, strict=True)]
    rows = []
    for k, (reference, cloud, shift) in enumerate(zip(references, clouds, shifts, strict=True)):
        belongs = np.zeros((len(cloud), count))
        belongs[:, k] = 1.0
        rows.append(np.hstack([np.hstack([reference, cloud]) - shift, belongs, np.ones((len(cloud), 1))]))
    sums = np.array([part.T @ part for part in _tenths(rows)])
    estimates = resampled(sums, lambda mean: inverse_lengths_of(_maps(mean)[0] * weight), extent=_extent)
    (matrix,), (rest,) = _maps(whole(sums))
    centres = np.array([shift[3:] - matrix @ shift[:3] for shift in shifts]) + rest
    margin = resampled(sums, lambda mean: _maps(mean)[1].reshape(len(mean), -1), extent=_extent).margin
    error = np.concatenate(
        [c - r @ matrix.T - centre for c, r, centre in zip(clouds, references, centres, strict=True)]
    )
    fit = image_of_sphere(
        matrix,
        np.zeros(3),
        estimates,
        radius=weight,
        extent=max(reach(cloud) for cloud in clouds),
        centre_margin=margin.reshape(count, 3).max(axis=0),
        error=error,
        tolerance=tolerance,
    )
    return fit, None if fit.ellipsoid is None else centres


def _centred(mean: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Second moments about the means of each trial, shape (m, 6, 6), and these means, shape (m, 6, t)."""
    share = np.diagonal(mean[:, 6:-1, 6:-1], axis1=1, axis2=2)
    middle = mean[:, :6, 6:-1] / np.maximum(share, np.finfo(float).tiny)[:, None, :]
    return mean[:, :6, :6] - (middle * share[:, None, :]) @ middle.transpose(0, 2, 1), middle


def _extent(mean: FloatArray) -> FloatArray:
    """Root mean square distances of references from the means of their trials; shape (m,)."""
    return np.sqrt(np.maximum(np.trace(_centred(mean)[0][:, :3, :3], axis1=1, axis2=2), 0.0))


def _maps(mean: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Linear maps (m, 3, 3) of reference to measured, and what is left of each trial's means (m, t, 3)."""
    centred, middle = _centred(mean)
    inverse = np.linalg.pinv(centred[:, :3, :3], rcond=1e-12, hermitian=True)
    matrices = centred[:, 3:, :3] @ inverse
    rest: FloatArray = middle[:, 3:] - matrices @ middle[:, :3]
    return matrices, rest.transpose(0, 2, 1)
