# SPDX-License-Identifier: BSD-3-Clause
"""The sphere analysis of a sensor, with apparent masses and the error of each axis (thesis 4.1.2, Table 4.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import ForceTorqueError, ShapeError, UnitError
from forcetorque.evaluation.sphere.affine import MappedFit, MomentFit, fit_mapped, fit_moment
from forcetorque.evaluation.sphere.cloud import is_one_point, require_cloud, share_of_directions
from forcetorque.evaluation.sphere.findings import TOLERANCE, CloudForm, EllipsoidFit, RadiusFit, percent
from forcetorque.evaluation.sphere.free import fit_ellipsoid, fit_radius, may_be_flat


def apparent_masses(lengths: Any, *, gravity: float) -> FloatArray:
    """Give the mass whose weight each length is.

    Args:
        lengths: Radii of some kind; shape (3,); N.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        A mass for each; shape (3,); kg.
    """
    return read_only(lengths, name="lengths", shape=(3,)) / _positive(gravity, "gravity")


def axis_errors(masses: Any, *, reference_mass: float, gravity: float) -> FloatArray:
    """Compare the force that each axis reads with the weight that the model has.

    Args:
        masses: Apparent masses by the axis intersections; shape (3,); kg.
        reference_mass: What hangs on the sensor; kg.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Measured minus true size of the weight; shape (3,); N.
    """
    excess = read_only(masses, name="masses", shape=(3,)) - _positive(reference_mass, "reference_mass")
    return excess * _positive(gravity, "gravity")


def _positive(value: float, name: str) -> float:
    if not 0.0 < value < np.inf:
        raise ForceTorqueError(f"{name}: expected a positive number, got {value:g}")
    return value


_COUNTS = 100.0
"""Measured over reference extent beyond which a force is no force."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SphereAnalysis:
    """What the cloud of forces and moments says, with and without the model."""

    samples: int
    """Number of samples."""
    gravity: float
    """Magnitude of gravity; m/s2."""
    mass: float | None
    """Mass beyond the sensor by the model; kg; None without a model."""
    form: CloudForm
    """What part of a sphere the forces can be told to be."""
    scatter: float | None
    """Standard deviation of the size of the reference force, relative to its mean: 0 for a sphere; None without a
    reference."""
    directions: float | None
    """Share of all directions in which there was a force: of the reference; else seen from the centre of the ellipsoid,
    or of the sphere where that is not identifiable; None where there is none."""
    radius: RadiusFit
    """One radius through the forces; N."""
    free: EllipsoidFit
    """Ellipsoid through the forces without the model; N."""
    mapped: MappedFit | None
    """Ellipsoid through the forces with the model; N; None without reference."""
    free_moment: EllipsoidFit | None
    """Ellipsoid through the moments without the model; N m; None where the moment does not change."""
    moment: MomentFit | None
    """Moments with the model; None without reference."""

    def masses(self, fit: EllipsoidFit) -> FloatArray | None:
        """Give the apparent masses of an ellipsoid of forces.

        Args:
            fit: `free`, or that of `mapped`.

        Returns:
            By its axis intersections; shape (3,); kg; None without an ellipsoid.
        """
        if fit.ellipsoid is None:
            return None
        return apparent_masses(fit.ellipsoid.axis_intersections, gravity=self.gravity)

    def errors(self, fit: EllipsoidFit) -> FloatArray | None:
        """Compare an ellipsoid of forces with the weight by the model.

        Args:
            fit: `free`, or that of `mapped`.

        Returns:
            Axis intersections minus weight; shape (3,); N; None without an ellipsoid or a model.
        """
        masses = self.masses(fit)
        if masses is None or self.mass is None:
            return None
        return axis_errors(masses, reference_mass=self.mass, gravity=self.gravity)


def analyse_sphere(
    wrench: Any,
    reference: Any = None,
    *,
    gravity: float,
    mass: float | None = None,
    tolerance: float = TOLERANCE,
) -> SphereAnalysis:
    """Analyse the readings of a sensor while the limb beyond it is carried around slowly.

    Args:
        wrench: Measured wrenches in the order of time, at least ten; shape (n, 6); N, N m.
        reference: Wrenches by the model at the same instants; shape (n, 6); N, N m; None without a model.
        gravity: Magnitude of gravity; m/s2.
        mass: Mass beyond the sensor; kg; that of the mean reference force if None.
        tolerance: Half width of an interval, relative to the mean radius, up to which it is identifiable.

    Returns:
        Fits with and without the model.

    Raises:
        ShapeError: If the shapes are not these, or a value is missing.
        ForceTorqueError: If gravity, mass or tolerance is not positive.
    """
    for name, value in (("gravity", gravity), ("tolerance", tolerance), ("mass", mass)):
        if value is not None and not 0.0 < value < np.inf:
            raise ForceTorqueError(f"{name}: expected a positive number, got {value:g}")
    measured = _wrenches(wrench, "wrench")
    force = require_cloud(measured[:, :3], name="force", unit="N")
    expected = None
    if reference is not None:
        expected = _wrenches(reference, "reference")
        if expected.shape != measured.shape:
            raise ShapeError(f"reference: expected one for each of {len(measured)} wrenches, got {len(expected)}")
        _refuse_counts(force, require_cloud(expected[:, :3], name="reference force", unit="N"))
        if mass is None:
            mass = float(np.linalg.norm(expected[:, :3], axis=1).mean()) / gravity
    return _analyse(measured, expected, gravity=gravity, mass=mass, tolerance=tolerance)


def _analyse(
    measured: FloatArray, expected: FloatArray | None, *, gravity: float, mass: float | None, tolerance: float
) -> SphereAnalysis:
    force, moment = np.ascontiguousarray(measured[:, :3]), np.ascontiguousarray(measured[:, 3:])
    radius = fit_radius(force, unit="N", tolerance=tolerance)
    free = fit_ellipsoid(force, radius, tolerance=tolerance)
    form = CloudForm.SURFACE if free.identifiable else CloudForm.PLANE if may_be_flat(force) else CloudForm.CAP
    mapped = moment_fit = scatter = None
    if expected is not None:
        reference = np.ascontiguousarray(expected[:, :3])
        size = np.linalg.norm(reference, axis=1)
        scatter = float(size.std() / size.mean())
        if scatter > tolerance:
            reason = f"by the model the force has no one size, it scatters by {percent(scatter)}; move slowly"
            radius = replace(radius, identifiable=False, why=(reason, *radius.why))
            free = replace(free, identifiable=False, tilt_identifiable=False, why=(reason, *free.why))
        weight = gravity * mass if mass is not None else float(size.mean())
        mapped = fit_mapped(force, reference, radius=weight, tolerance=tolerance)
        moment_fit = fit_moment(moment, expected[:, 3:], reference, radius=weight, tolerance=tolerance)
    return SphereAnalysis(
        samples=len(force),
        gravity=gravity,
        mass=mass,
        form=form,
        scatter=scatter,
        directions=_directions(force, expected, radius, free),
        radius=radius,
        free=free,
        mapped=mapped,
        free_moment=_free_moment(moment, tolerance),
        moment=moment_fit,
    )


def _free_moment(moment: FloatArray, tolerance: float) -> EllipsoidFit | None:
    if is_one_point(moment):
        return None
    cloud = require_cloud(moment, name="moment", unit="N m")
    return fit_ellipsoid(cloud, fit_radius(cloud, unit="N m", tolerance=tolerance), tolerance=tolerance)


def _directions(force: FloatArray, expected: FloatArray | None, radius: RadiusFit, free: EllipsoidFit) -> float | None:
    if expected is not None:
        return share_of_directions(expected[:, :3], np.zeros(3))
    if free.identifiable and free.ellipsoid is not None:
        return share_of_directions(force, free.ellipsoid.centre)
    return None if radius.centre is None else share_of_directions(force, radius.centre)


def _wrenches(values: Any, name: str) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 6:
        raise ShapeError(f"{name}: expected shape (n, 6), got {array.shape}")
    finite = np.isfinite(array).all(axis=1)
    if not finite.all():
        raise ShapeError(
            f"{name}: expected finite values, got NaN or infinite ones in {np.count_nonzero(~finite)} of {len(array)} "
            "samples; leave out gaps"
        )
    return array


def _refuse_counts(force: FloatArray, reference: FloatArray) -> None:
    """Refuse readings whose size no matrix that is worth its name can have made of these forces."""
    ratio = np.ptp(force, axis=0).max() / np.linalg.norm(reference, axis=1).mean()
    if ratio > _COUNTS:
        raise UnitError(
            f"force: expected N, got values that move by {ratio:.3g} times the weight on the sensor, which can only be "
            "counts; multiply them by the sensor's matrix"
        )
