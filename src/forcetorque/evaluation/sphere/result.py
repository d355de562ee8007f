# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the answers about spheres: ellipsoids, one radius and moments of a sensor, and what failed."""

from __future__ import annotations

from typing import Self

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.sphere.affine_fit import MomentRow
from forcetorque.evaluation.sphere.cloud import StaticForceError
from forcetorque.evaluation.sphere.ellipsoid import CloudForm, EllipsoidFit, RadiusFit
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere, SphereAnalysis
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import AxisValues, Row, RowOfSensor


class RadiusRow(Row):
    """A sphere of one radius through the forces: what a perfect sensor would read."""

    identifiable: bool
    """Whether the mass is known within the tolerance."""
    why: tuple[str, ...]
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

    @classmethod
    def of(cls, fit: RadiusFit, gravity: float) -> Self:
        """Turn lengths into masses.

        Args:
            fit: The sphere; N.
            gravity: Magnitude of gravity; m/s2.

        Returns:
            Its row.
        """
        return cls(
            identifiable=fit.identifiable,
            why=fit.why,
            algebraic_mass_kg=finite_or_none(fit.algebraic / gravity),
            geometric_mass_kg=finite_or_none(fit.geometric / gravity),
            mass_low_kg=fit.low / gravity,
            mass_high_kg=finite_or_none(fit.high / gravity),
            rms_N=finite_or_none(fit.rms),
        )


class EllipsoidRow(Row):
    """An ellipsoid through the forces, three numbers each along x, y, z."""

    identifiable: bool
    """Whether masses, errors and index are worth comparing: see the rule of the result."""
    tilt_identifiable: bool
    """Whether half-widths and principal radii are too; a few poses along the axes tell nothing in between."""
    why: tuple[str, ...]
    """What speaks against the masses."""
    centre_N: AxisValues | None
    """What the sensor reads without force; all of these are none where the cloud is flat to rounding."""
    mass_kg: AxisValues | None
    """Apparent mass of each axis: axis intersection over gravity."""
    mass_low_kg: AxisValues
    """Lower ends of their intervals."""
    mass_high_kg: tuple[float | None, ...]
    """Upper ends; none where unbounded."""
    index_kg: float | None
    """Performance index: sample standard deviation of the three apparent masses."""
    index_low_kg: float
    """Lower end of its interval."""
    index_high_kg: float | None
    """Upper end; none where it is unbounded."""
    error_N: AxisValues | None
    """Axis intersections minus the weight by the model; none without a model."""
    axis_intersection_N: AxisValues | None
    """Where the axes through the centre leave the ellipsoid, 1 / sqrt(Q_ii)."""
    half_width_N: AxisValues | None
    """Half of its extent along each axis, sqrt((Q^-1)_ii)."""
    half_width_low_N: AxisValues
    """Lower ends of the intervals of the half-widths."""
    half_width_high_N: tuple[float | None, ...]
    """Upper ends; none where unbounded."""
    half_width_mass_kg: AxisValues | None
    """Half-widths over gravity."""
    principal_radius_N: AxisValues | None
    """Half of its own axes, 1 / sqrt(eigenvalue), the longest first; not along x, y, z."""
    principal_mass_kg: AxisValues | None
    """Principal radii over gravity."""
    rms_N: float | None
    """Root mean square distance: from the ellipsoid, or with the model from where it has each sample."""

    @classmethod
    def of(cls, fit: EllipsoidFit, analysis: SphereAnalysis) -> Self:
        """Turn an ellipsoid of forces into masses.

        Args:
            fit: The ellipsoid; N.
            analysis: What has its gravity and mass.

        Returns:
            Its row.
        """
        gravity, ellipsoid = analysis.gravity, fit.ellipsoid
        return cls(
            identifiable=fit.identifiable,
            tilt_identifiable=fit.tilt_identifiable,
            why=fit.why,
            centre_N=None if ellipsoid is None else ellipsoid.centre,
            mass_kg=analysis.masses(fit),
            mass_low_kg=fit.low / gravity,
            mass_high_kg=bounded(fit.high / gravity),
            index_kg=finite_or_none(fit.index / gravity),
            index_low_kg=fit.index_low / gravity,
            index_high_kg=finite_or_none(fit.index_high / gravity),
            error_N=analysis.errors(fit),
            axis_intersection_N=None if ellipsoid is None else ellipsoid.axis_intersections,
            half_width_N=None if ellipsoid is None else ellipsoid.half_widths,
            half_width_low_N=fit.half_width_low,
            half_width_high_N=bounded(fit.half_width_high),
            half_width_mass_kg=None if ellipsoid is None else ellipsoid.half_widths / gravity,
            principal_radius_N=None if ellipsoid is None else ellipsoid.principal_radii,
            principal_mass_kg=None if ellipsoid is None else ellipsoid.principal_radii / gravity,
            rms_N=finite_or_none(fit.rms),
        )


class MomentEllipsoidRow(Row):
    """An ellipsoid through the moments without the model; a stiff limb makes a disc, which has none."""

    identifiable: bool
    """Whether the numbers are worth comparing."""
    why: tuple[str, ...]
    """What speaks against it."""
    centre_Nm: AxisValues | None
    """What the sensor reads without moment."""
    axis_intersection_Nm: AxisValues | None
    """Where the axes through the centre leave the ellipsoid."""
    low_Nm: AxisValues
    """Lower ends of the intervals of the axis intersections."""
    high_Nm: tuple[float | None, ...]
    """Upper ends; none where unbounded."""
    half_width_Nm: AxisValues | None
    """Half of its extent along each axis."""
    principal_radius_Nm: AxisValues | None
    """Half of its own axes, the longest first."""

    @classmethod
    def of(cls, fit: EllipsoidFit) -> Self:
        """Take the lengths of an ellipsoid of moments.

        Args:
            fit: The ellipsoid; N m.

        Returns:
            Its row.
        """
        ellipsoid = fit.ellipsoid
        return cls(
            identifiable=fit.identifiable,
            why=fit.why,
            centre_Nm=None if ellipsoid is None else ellipsoid.centre,
            axis_intersection_Nm=None if ellipsoid is None else ellipsoid.axis_intersections,
            low_Nm=fit.low,
            high_Nm=bounded(fit.high),
            half_width_Nm=None if ellipsoid is None else ellipsoid.half_widths,
            principal_radius_Nm=None if ellipsoid is None else ellipsoid.principal_radii,
        )


class SphereRow(RowOfSensor):
    """One sensor, read in one way."""

    calibration: str
    """`prior`, or the calibration file."""
    intervals: tuple[str, ...]
    """Intervals whose samples were taken together."""
    fitted_on: tuple[str, ...]
    """Those of them that the calibration was fitted on, which flatters it."""
    samples: int
    """Number of samples."""
    model_mass_kg: float | None
    """Mass beyond the sensor by the model."""
    form: CloudForm
    """What part of a sphere the forces can be told to be."""
    force_scatter: float | None
    """Standard deviation of the size of the force by the model, relative to its mean; 0 for a sphere."""
    directions_covered: float | None
    """Share of all directions in which there was a force."""
    no_model: str | None
    """Why there are no fits with the model; none where there are."""
    one_radius: RadiusRow
    """A sphere."""
    without_model: EllipsoidRow
    """An ellipsoid without the model."""
    with_model: EllipsoidRow | None
    """An ellipsoid with the model."""
    moment_without_model: MomentEllipsoidRow | None
    """Moments without the model; none where they do not change."""
    moment_with_model: MomentRow | None
    """Moments with the model."""

    @classmethod
    def of(cls, sphere: SensorSphere) -> Self:
        """Take the numbers of an analysis.

        Args:
            sphere: The analysis of a sensor, read in one way.

        Returns:
            Its row.
        """
        analysis = sphere.analysis
        mapped, free_moment = analysis.mapped, analysis.free_moment
        return cls(
            sensor=sphere.sensor,
            serial=sphere.serial,
            calibration=sphere.calibration,
            intervals=sphere.intervals,
            fitted_on=sphere.fitted_on,
            samples=analysis.samples,
            model_mass_kg=analysis.mass,
            form=analysis.form,
            force_scatter=analysis.scatter,
            directions_covered=analysis.directions,
            no_model=sphere.no_fit_with_model,
            one_radius=RadiusRow.of(analysis.radius, analysis.gravity),
            without_model=EllipsoidRow.of(analysis.free, analysis),
            with_model=None if mapped is None else EllipsoidRow.of(mapped.fit, analysis),
            moment_without_model=None if free_moment is None else MomentEllipsoidRow.of(free_moment),
            moment_with_model=analysis.moment,
        )


class FailureRow(Row):
    """What could not be analysed."""

    file: str
    """Experiment file, or the option that named something."""
    sensor: str | None
    """Sensor; none for the whole file."""
    message: str
    """What was wrong, in one line that names the file."""
    skipped: bool = False
    """Whether nobody named the sensor, and nothing turned it: this is no failure."""

    @classmethod
    def of(cls, file: str, sensor: str | None, error: Exception, *, named: bool = True) -> Self:
        """Say what an error cost.

        Args:
            file: Experiment file, or the option that named something.
            sensor: Sensor; None for the whole file.
            error: What was wrong.
            named: Whether the caller named the sensor.

        Returns:
            Its row.
        """
        message = " ".join(str(error).split())
        # what is wrong with a file names it already, what is wrong with its data does not
        return cls(
            file=file,
            sensor=sensor,
            message=message if message.startswith(file) else f"{file}: {message}",
            skipped=not named and isinstance(error, StaticForceError),
        )

    @property
    def sentence(self) -> str:
        """The message behind a word that says what it means for the command."""
        return f"{'left out' if self.skipped else 'failed'}: {self.message}"


def bounded(values: FloatArray) -> tuple[float | None, ...]:
    """Give ends of intervals that JSON can hold.

    Args:
        values: The ends; shape (n,); infinite where there is none.

    Returns:
        The same, None for the infinite ones.
    """
    return tuple(finite_or_none(float(value)) for value in values)
