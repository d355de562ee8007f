# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque sphere`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import SensorSphere
from forcetorque.arrays import FloatArray
from forcetorque.cli.output import finite_or_none
from forcetorque.evaluation.sphere import CloudForm, EllipsoidFit, MomentFit, RadiusFit, SphereAnalysis

_AXES = "xyz"


class RadiusRow(BaseModel):
    """A sphere of one radius through the forces: what a perfect sensor would read."""

    identifiable: bool
    """Whether the mass is known within the tolerance."""
    why: list[str]
    """What speaks against it; lengths in it are N."""
    algebraic_mass_kg: float | None
    """Mass by linear least squares, too small where noise meets a small part of a sphere; none for a plane."""
    geometric_mass_kg: float | None
    """Mass by orthogonal distances; none where the fit went on opening to a plane."""
    mass_low_kg: float
    """Lower end of the interval."""
    mass_high_kg: float | None
    """Upper end; none where it is unbounded."""
    rms_N: float | None
    """Root mean square distance from the geometric sphere."""


class EllipsoidRow(BaseModel):
    """An ellipsoid through the forces, three numbers each along x, y, z."""

    identifiable: bool
    """Whether masses, errors and index are worth comparing: see the rule of the result."""
    tilt_identifiable: bool
    """Whether half-widths and principal radii are too; a few poses along the axes tell nothing in between."""
    why: list[str]
    """What speaks against the masses."""
    centre_N: list[float] | None
    """What the sensor reads without force; all of these are none where the cloud is flat to rounding."""
    mass_kg: list[float] | None
    """Apparent mass of each axis: axis intersection over gravity."""
    mass_low_kg: list[float]
    """Lower ends of their intervals."""
    mass_high_kg: list[float | None]
    """Upper ends; none where unbounded."""
    index_kg: float | None
    """Performance index: sample standard deviation of the three apparent masses."""
    index_low_kg: float
    """Lower end of its interval."""
    index_high_kg: float | None
    """Upper end; none where it is unbounded."""
    error_N: list[float] | None
    """Axis intersections minus the weight by the model; none without a model."""
    axis_intersection_N: list[float] | None
    """Where the axes through the centre leave the ellipsoid, 1 / sqrt(Q_ii)."""
    half_width_N: list[float] | None
    """Half of its extent along each axis, sqrt((Q^-1)_ii)."""
    half_width_low_N: list[float]
    """Lower ends of the intervals of the half-widths."""
    half_width_high_N: list[float | None]
    """Upper ends; none where unbounded."""
    half_width_mass_kg: list[float] | None
    """Half-widths over gravity."""
    principal_radius_N: list[float] | None
    """Half of its own axes, 1 / sqrt(eigenvalue), the longest first; not along x, y, z."""
    principal_mass_kg: list[float] | None
    """Principal radii over gravity."""
    rms_N: float | None
    """Root mean square distance: from the ellipsoid, or with the model from where it has each sample."""


class MomentEllipsoidRow(BaseModel):
    """An ellipsoid through the moments without the model; a stiff limb makes a disc, which has none."""

    identifiable: bool
    """Whether the numbers are worth comparing."""
    why: list[str]
    """What speaks against it."""
    centre_Nm: list[float] | None
    """What the sensor reads without moment."""
    axis_intersection_Nm: list[float] | None
    """Where the axes through the centre leave the ellipsoid."""
    low_Nm: list[float]
    """Lower ends of the intervals of the axis intersections."""
    high_Nm: list[float | None]
    """Upper ends; none where unbounded."""
    half_width_Nm: list[float] | None
    """Half of its extent along each axis."""
    principal_radius_Nm: list[float] | None
    """Half of its own axes, the longest first."""


class MomentRow(BaseModel):
    """How far moments reach while the force goes over its sphere, with the model."""

    identifiable: bool
    """Whether the half-widths are worth comparing."""
    why: list[str]
    """What speaks against it."""
    centre_Nm: list[float]
    """What the sensor reads without force."""
    half_width_Nm: list[float]
    """Largest moment about each axis that the sensor would read."""
    low_Nm: list[float]
    """Lower ends of their intervals."""
    high_Nm: list[float]
    """Upper ends."""
    expected_half_width_Nm: list[float]
    """Largest moment about each axis by the model."""
    error_Nm: list[float]
    """Measured minus expected."""
    index_Nm: float
    """Sample standard deviation of the three errors."""
    stray_share: float
    """Root mean square of the model's moment that does not follow its force, relative to the largest half-width."""


class SphereRow(BaseModel):
    """One sensor, read in one way."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """`prior`, or the calibration file."""
    intervals: list[str]
    """Intervals whose samples were taken together."""
    fitted_on: list[str]
    """Those of them that the calibration was fitted on, which flatters it."""
    samples: int
    """Number of samples."""
    model_mass_kg: float | None
    """Mass that hangs on the sensor by the model."""
    form: CloudForm
    """What part of a sphere the forces can be told to be."""
    force_scatter: float | None
    """Standard deviation of the size of the force by the model, relative to its mean; 0 for a sphere."""
    directions_covered: float | None
    """Share of all directions in which there was a force."""
    no_reference: str | None
    """Why there are no fits with the model; none where there are."""
    one_radius: RadiusRow
    """A sphere."""
    without_reference: EllipsoidRow
    """An ellipsoid without the model."""
    with_reference: EllipsoidRow | None
    """An ellipsoid with the model."""
    moment_without_reference: MomentEllipsoidRow | None
    """Moments without the model; none where they do not change."""
    moment_with_reference: MomentRow | None
    """Moments with the model."""


class FailureRow(BaseModel):
    """What could not be analysed."""

    file: str
    """Experiment file, or the option that named something."""
    sensor: str | None
    """Sensor; none for the whole file."""
    message: str
    """What was wrong."""


class SphereResult(BaseModel):
    """What `forcetorque sphere` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/sphere/1"] = Field(default="forcetorque/sphere/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    gravity_m_s2: float
    """Magnitude of gravity."""
    tolerance: float
    """Half width of an interval, relative to the mean radius, up to which a number is identifiable."""
    rule: str
    """How it is decided what is identifiable."""
    figure: str | None
    """File of the figure."""
    rows: list[SphereRow]
    """One per sensor and way to read it."""
    failures: list[FailureRow]
    """Sensors that could not be analysed; the exit code is 1 if there is any, and 2 if there are no others."""


def sphere_row(found: SensorSphere) -> SphereRow:
    """Put an analysis into the form of the result.

    Args:
        found: The analysis of a sensor, read in one way.

    Returns:
        Its row.
    """
    analysis = found.analysis
    mapped = analysis.mapped
    return SphereRow(
        sensor=found.sensor,
        serial=found.serial,
        candidate=found.candidate,
        intervals=list(found.intervals),
        fitted_on=list(found.fitted_on),
        samples=analysis.samples,
        model_mass_kg=analysis.mass,
        form=analysis.form,
        force_scatter=analysis.scatter,
        directions_covered=analysis.directions,
        no_reference=found.no_fit_with_model,
        one_radius=_radius(analysis.radius, analysis.gravity),
        without_reference=ellipsoid_row(analysis.free, analysis),
        with_reference=None if mapped is None else ellipsoid_row(mapped.fit, analysis),
        moment_without_reference=None if analysis.free_moment is None else _moment_ellipsoid(analysis.free_moment),
        moment_with_reference=None if analysis.moment is None else _moment(analysis.moment),
    )


def flat_row(row: SphereRow) -> dict[str, object]:
    """Put a row into one line of a table of numbers.

    Args:
        row: The row.

    Returns:
        Its values by names that are joined with underscores; principal radii count 1 to 3, other triples x, y, z.
    """
    flat: dict[str, object] = {}
    for key, value in row.model_dump(mode="json").items():
        flat.update(_flattened(key, value))
    return flat


def _flattened(key: str, value: Any) -> dict[str, object]:
    if isinstance(value, dict):
        found: dict[str, object] = {}
        for name, inner in value.items():
            found.update(_flattened(f"{key}_{name}", inner))
        return found
    if isinstance(value, list):
        if value and not isinstance(value[0], str):
            name, _, unit = key.rpartition("_")
            ends: Iterable[str] = "123" if "principal" in key else _AXES
            return {f"{name}_{end}_{unit}": number for end, number in zip(ends, value, strict=True)}
        return {key: "; ".join(value)}
    return {key: value}


def _radius(fit: RadiusFit, gravity: float) -> RadiusRow:
    return RadiusRow(
        identifiable=fit.identifiable,
        why=list(fit.why),
        algebraic_mass_kg=finite_or_none(fit.algebraic / gravity),
        geometric_mass_kg=finite_or_none(fit.geometric / gravity),
        mass_low_kg=fit.low / gravity,
        mass_high_kg=finite_or_none(fit.high / gravity),
        rms_N=finite_or_none(fit.rms),
    )


def ellipsoid_row(fit: EllipsoidFit, analysis: SphereAnalysis) -> EllipsoidRow:
    """Put an ellipsoid of forces into the form of the result.

    Args:
        fit: The ellipsoid.
        analysis: What has its gravity and mass.

    Returns:
        Its row.
    """
    gravity, ellipsoid = analysis.gravity, fit.ellipsoid
    return EllipsoidRow(
        identifiable=fit.identifiable,
        tilt_identifiable=fit.tilt_identifiable,
        why=list(fit.why),
        centre_N=None if ellipsoid is None else ellipsoid.centre.tolist(),
        mass_kg=_listed(analysis.masses(fit)),
        mass_low_kg=(fit.low / gravity).tolist(),
        mass_high_kg=_bounded(fit.high / gravity),
        index_kg=finite_or_none(fit.index / gravity),
        index_low_kg=fit.index_low / gravity,
        index_high_kg=finite_or_none(fit.index_high / gravity),
        error_N=_listed(analysis.errors(fit)),
        axis_intersection_N=None if ellipsoid is None else ellipsoid.axis_intersections.tolist(),
        half_width_N=None if ellipsoid is None else ellipsoid.half_widths.tolist(),
        half_width_low_N=fit.half_width_low.tolist(),
        half_width_high_N=_bounded(fit.half_width_high),
        half_width_mass_kg=None if ellipsoid is None else (ellipsoid.half_widths / gravity).tolist(),
        principal_radius_N=None if ellipsoid is None else ellipsoid.principal_radii.tolist(),
        principal_mass_kg=None if ellipsoid is None else (ellipsoid.principal_radii / gravity).tolist(),
        rms_N=finite_or_none(fit.rms),
    )


def _moment_ellipsoid(fit: EllipsoidFit) -> MomentEllipsoidRow:
    ellipsoid = fit.ellipsoid
    return MomentEllipsoidRow(
        identifiable=fit.identifiable,
        why=list(fit.why),
        centre_Nm=None if ellipsoid is None else ellipsoid.centre.tolist(),
        axis_intersection_Nm=None if ellipsoid is None else ellipsoid.axis_intersections.tolist(),
        low_Nm=fit.low.tolist(),
        high_Nm=_bounded(fit.high),
        half_width_Nm=None if ellipsoid is None else ellipsoid.half_widths.tolist(),
        principal_radius_Nm=None if ellipsoid is None else ellipsoid.principal_radii.tolist(),
    )


def _moment(fit: MomentFit) -> MomentRow:
    return MomentRow(
        identifiable=fit.identifiable,
        why=list(fit.why),
        centre_Nm=fit.centre.tolist(),
        half_width_Nm=fit.half_widths.tolist(),
        low_Nm=fit.low.tolist(),
        high_Nm=fit.high.tolist(),
        expected_half_width_Nm=fit.expected_half_widths.tolist(),
        error_Nm=fit.errors.tolist(),
        index_Nm=float(np.std(fit.errors, ddof=1)),
        stray_share=fit.stray,
    )


def _listed(values: FloatArray | None) -> list[float] | None:
    return None if values is None else values.tolist()


def _bounded(values: FloatArray) -> list[float | None]:
    return [finite_or_none(float(value)) for value in values]
