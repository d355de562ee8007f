# SPDX-License-Identifier: BSD-3-Clause
"""Sphere analysis of one sensor: its intervals and calibrations, apparent masses and axis errors (Table 4.2)."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import (
    ExperimentError,
    FitError,
    ForceTorqueError,
    RecordingError,
    ShapeError,
    UnitError,
    known_names,
)
from forcetorque.evaluation.sphere.affine_fit import MappedFit, MomentRow, fit_mapped, fit_moment
from forcetorque.evaluation.sphere.cloud import is_one_point, require_cloud, share_of_directions
from forcetorque.evaluation.sphere.ellipsoid import TOLERANCE, CloudForm, EllipsoidFit, RadiusFit, percent
from forcetorque.evaluation.sphere.model_free_fit import fit_ellipsoid, fit_radius, may_be_flat
from forcetorque.experiment.applicability import overlapping
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.long_recording import is_long, segment_runs
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.sensor_reading import Correction, Readings
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.root_motion import joints_to_support
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree


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
        reference_mass: Mass beyond the sensor; kg.
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
    moment: MomentRow | None
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


_ROUNDING = 1e-9
"""Relative difference of masses that are sums of the same ones in another order."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorSphere:
    """Sphere analysis of one sensor read in one way."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    calibration: str
    """`prior`, or the name of a calibration."""
    intervals: tuple[str, ...]
    """Labels of the intervals whose samples were taken together."""
    fitted_on: tuple[str, ...]
    """Those of them that the calibration was fitted on: it is then evaluated too kindly."""
    every: int = 1
    """Of how many samples one was taken; 1 unless the recording is long."""
    no_model: str | None
    """Why the model gives no reference; None where it does."""
    force: FloatArray
    """What the sensor read; shape (n, 3); N."""
    reference: FloatArray | None
    """What it should have read; shape (n, 3); N."""
    analysis: SphereAnalysis
    """The analysis."""

    def doubts(self) -> Iterator[str]:
        """Say what the verdict is to be read with.

        Yields:
            Sentences.
        """
        if self.fitted_on:
            labels = ", ".join(map(repr, self.fitted_on))
            yield f"{self.calibration} was fitted on {labels}, so the verdict on it flatters"
        if self.every > 1:
            yield f"{self.sensor}: one of {self.every} samples draws the sphere, as the recording is long"

    @property
    def no_fit_with_model(self) -> str | None:
        """Why there is no fit with the model; None where there is one."""
        if self.analysis.mapped is not None:
            return None
        return self.no_model or "the reference forces lie in a plane"


def sphere_intervals(experiment: Experiment, names: Sequence[str] | None) -> tuple[Interval, ...]:
    """Choose the intervals whose motion draws a sphere.

    Args:
        experiment: The experiment.
        names: Labels or kinds of intervals; None for those that the file names as sphere intervals, else for all
            that are not to be ignored.

    Returns:
        Intervals in the order of the file.

    Raises:
        ExperimentError: If nothing is called so, or there is no interval.
    """
    usable = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if names is None:
        labels = experiment.fit_options.sphere_intervals or tuple(interval.label for interval in usable)
    else:
        labels = tuple(dict.fromkeys(label for name in names for label in _labelled(experiment, usable, name)))
    chosen = tuple(interval for interval in usable if interval.label in labels)
    if not chosen:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not to be ignored")
    return chosen


def sensor_spheres(
    run: SensorRun, calibrations: Mapping[str, Calibration], intervals: Sequence[Interval]
) -> tuple[SensorSphere, ...]:
    """Analyse a sensor with its prior and with calibrations, on the same samples.

    Where the log lacks joints that the reference needs, there is none; the mass beyond the sensor is
    known from the model in any case.

    Args:
        run: The sensor.
        calibrations: Its calibrations by name.
        intervals: Intervals whose samples are taken together, but for those in which something touches the robot beyond
            the sensor.

    Returns:
        An analysis for each way to read the sensor, the prior first.

    Raises:
        ForceTorqueError: If a fit fails.
        ExperimentError: If there is no way to read the sensor, a calibration may not be applied, something touches
            beyond the sensor in every interval, or the supports of the intervals are on both sides of the sensor, so
            that the mass beyond it differs.
        SerialNumberError: If a calibration is of another sensor.
    """
    where = f"sensor {run.sensor.name!r}"
    with stated_in(where):
        for name in calibrations:
            run.require_fit(name, calibrations[name])
        intervals = run.known(intervals)
        corrections = _corrections(run, calibrations)
        reason = _no_reference(run, intervals)
        needed = {variable for _, correction, _ in corrections for variable in correction.variables}
        spans, reference, every = _collected(run, intervals, needed, with_model=reason is None)
        mass = _one_mass(run, intervals)
    spheres = []
    for name, correction, calibration in corrections:
        with stated_in(f"{where}, {name}"):
            wrench = run.read(spans, correction)
            analysis = _analysed(wrench, reference, gravity=run.experiment.processing.gravity, mass=mass)
        spheres.append(
            SensorSphere(
                sensor=run.sensor.name,
                serial=run.sensor.serial,
                calibration=name,
                intervals=tuple(interval.label for interval in intervals),
                every=every,
                fitted_on=_fitted_on(run, calibration, intervals),
                no_model=reason,
                force=wrench[:, :3],
                reference=None if reference is None else reference[:, :3],
                analysis=analysis,
            )
        )
    return tuple(spheres)


def _labelled(experiment: Experiment, usable: Sequence[Interval], name: str) -> list[str]:
    """Labels of the intervals that have this label, or are of this kind."""
    labels = [interval.label for interval in usable]
    if name in labels:
        return [name]
    of_kind = [label for label in labels if experiment.roles[label].kind == name]
    if not of_kind:
        known = {*labels, *(experiment.roles[label].kind for label in labels)}
        raise ExperimentError(
            f"experiment {experiment.name!r}: no interval to use has the label or kind {name!r}; "
            f"{known_names(name, known)}"
        )
    return of_kind


def _corrections(
    run: SensorRun, calibrations: Mapping[str, Calibration]
) -> list[tuple[str, Correction, Calibration | None]]:
    """Ways to read a sensor by name, the prior first and with no offset removed: the centre is what is looked for."""
    run.sensor.require_six_components("the sphere of the weight")
    if run.sensor.prior is None and not calibrations:
        raise ExperimentError("raw counts become forces by a calibration or a prior matrix")
    prior = [] if run.sensor.prior is None else [(PRIOR, Correction.without_offset(run.sensor), None)]
    return [
        *prior,
        *((name, Correction.of(name, calibration), calibration) for name, calibration in calibrations.items()),
    ]


def _no_reference(run: SensorRun, intervals: Sequence[Interval]) -> str | None:
    """Say which joints the reference lacks; None if it lacks none."""
    recording, model = run.experiment.recording, run.experiment.model
    logged = recording.joint_signals("position")
    missing: dict[str, None] = {}
    for interval in intervals:
        needed = required_joints_of(_question(run, interval))
        if interval.support is not None:
            needed += joints_to_support(model, recording, interval.support)
        missing.update(dict.fromkeys(joint for joint in needed if joint not in logged))
    return f"no stream holds the position of {', '.join(missing)}" if missing else None


def _question(run: SensorRun, interval: Interval) -> Question:
    support = interval.required_support(ExperimentError)
    tree = build_tree(run.experiment.model_on(support), support.frame)
    return Question(tree=tree, expected=(run.sensor.name,), equations=())


_MOST: Final = 360_000
"""Samples of a long recording that draw a sphere, evenly taken: an hour at 100 Hz."""


def _collected(
    run: SensorRun, intervals: Sequence[Interval], variables: Collection[str], *, with_model: bool
) -> tuple[list[tuple[Interval, Readings]], FloatArray | None, int]:
    """Readings of every interval, references one after the other, and of how many samples one is taken."""
    if not is_long(run):
        spans, references = _over(run, intervals, variables, with_model=with_model)
        return spans, np.concatenate(references) if references else None, 1
    stamps, labels = run.stream.stamp_ns, {interval.label for interval in intervals}
    every = -(-sum(int(np.count_nonzero(interval.holds(stamps))) for interval in intervals) // _MOST)
    taken: list[tuple[Interval, Readings]] = []
    expected: list[FloatArray] = []
    lost: dict[str, RecordingError] = {}  # the first of every interval
    for part in segment_runs(run):
        own = [one for one in part.experiment.recording.intervals if one.label in labels and one.use is not Use.IGNORE]
        for interval in own:
            try:
                spans, references = _over(part, [interval], variables, with_model=with_model)
            except RecordingError as error:  # the log has a gap there
                lost.setdefault(interval.label, error)
                continue
            taken += [(one, readings.at(slice(None, None, every))) for one, readings in spans]
            expected += [reference[::every].copy() for reference in references]
        del part
    for label in (one.label for one in intervals if one.label not in {interval.label for interval, _ in taken}):
        raise lost.get(label) or RecordingError(f"interval {label!r}: expected samples, got none")
    return taken, np.concatenate(expected) if expected else None, every


def _over(
    run: SensorRun, intervals: Sequence[Interval], variables: Collection[str], *, with_model: bool
) -> tuple[list[tuple[Interval, Readings]], list[FloatArray]]:
    if not with_model:
        return [(interval, run.interval_readings(interval, variables=variables)) for interval in intervals], []
    samples = [run.interval_samples(interval, variables=variables) for interval in intervals]
    return [(one.interval, one.readings) for one in samples], [one.samples.reference for one in samples]


def _analysed(
    wrench: FloatArray, reference: FloatArray | None, *, gravity: float, mass: float | None
) -> SphereAnalysis:
    try:
        return analyse_sphere(wrench, reference, gravity=gravity, mass=mass)
    except np.linalg.LinAlgError as error:
        raise FitError(str(error)) from error


def _one_mass(run: SensorRun, intervals: Sequence[Interval]) -> float | None:
    """Mass beyond the sensor in all intervals; kg."""
    masses = [_mass(run, interval) for interval in intervals]
    first = masses[0] or 0.0
    for interval, mass in zip(intervals, masses, strict=True):
        if abs((mass or 0.0) - first) > _ROUNDING * first:
            raise ExperimentError(
                f"expected the same mass on it in all intervals, got {first:.4g} kg in "
                f"{intervals[0].label!r} and {mass or 0.0:.4g} kg in {interval.label!r}, whose supports are on the two "
                "sides of the sensor; choose intervals of one side by --interval, from Python intervals"
            )
    return masses[0]


def _mass(run: SensorRun, interval: Interval) -> float | None:
    """Mass beyond the sensor, from the force that it reads at rest in any posture; kg."""
    question = _question(run, interval)
    joints = required_joints_of(question)
    rest = JointMotion.at_rest(joints, np.zeros((1, len(joints))))
    root = RootMotion.fixed([0.0, 0.0, -1.0], gravity=1.0)
    force = estimate(question, rest, root).expected_of(run.sensor.name)[0, :3]
    mass = float(np.linalg.norm(force))
    return mass if mass > 0.0 else None


def _fitted_on(run: SensorRun, calibration: Calibration | None, intervals: Sequence[Interval]) -> tuple[str, ...]:
    if calibration is None:
        return ()
    pairs = overlapping(run.experiment, intervals, calibration, calibration.provenance.intervals)
    return tuple(dict.fromkeys(label for label, _ in pairs))
