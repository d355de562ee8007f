# SPDX-License-Identifier: BSD-3-Clause
"""Sphere analysis of the sensors of an experiment, with their prior and with other calibrations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.analysis.applicability import require_fit
from forcetorque.analysis.samples import readings_over, samples_over
from forcetorque.arrays import FloatArray, require_shape
from forcetorque.calibration import Calibration, WrenchModel, recover_raw
from forcetorque.errors import ExperimentError, known_names
from forcetorque.estimation import Question, estimate, required_joints_of
from forcetorque.estimation.root_motion import joints_to_support
from forcetorque.evaluation.sphere import SphereAnalysis, analyse_sphere
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval, Use
from forcetorque.robot import JointMotion, RootMotion, build_tree

_ROUNDING = 1e-9
"""Relative difference of masses that are sums of the same ones in another order."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorSphere:
    """Sphere analysis of one sensor read in one way."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """`prior`, or the name of a calibration."""
    intervals: tuple[str, ...]
    """Labels of the intervals whose samples were taken together."""
    fitted_on: tuple[str, ...]
    """Those of them that the calibration was fitted on: it is then judged too kindly."""
    no_reference: str | None
    """Why the model gives no reference; None where it does."""
    force: FloatArray
    """What the sensor read; shape (n, 3); N."""
    reference: FloatArray | None
    """What it should have read; shape (n, 3); N."""
    analysis: SphereAnalysis
    """The analysis."""

    @property
    def no_fit_with_model(self) -> str | None:
        """Why there is no fit with the model; None where there is one."""
        if self.analysis.mapped is not None:
            return None
        return self.no_reference or "the reference forces lie in a plane"


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
        labels = experiment.sphere_intervals or tuple(interval.label for interval in usable)
    else:
        labels = tuple(dict.fromkeys(label for name in names for label in _labelled(experiment, usable, name)))
    chosen = tuple(interval for interval in usable if interval.label in labels)
    if not chosen:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not to be ignored")
    return chosen


def analyse_sensor(
    experiment: Experiment,
    sensor: ExperimentSensor,
    intervals: Sequence[Interval],
    calibrations: Mapping[str, Calibration],
) -> list[SensorSphere]:
    """Analyse a sensor with its prior and with calibrations, on the same samples.

    Where the log lacks joints that the reference needs, there is none; the mass beyond the sensor is
    known from the model in any case.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        intervals: Intervals whose samples are taken together.
        calibrations: Calibrations of that sensor, by name.

    Returns:
        An analysis for each way to read the sensor.

    Raises:
        ExperimentError: If there is no way to read it, a calibration may not be applied, or the supports of the
            intervals are on both sides of the sensor, so that not the same mass hangs on it.
    """
    for name, calibration in calibrations.items():
        require_fit(name, calibration, experiment, sensor)
    if sensor.prior is None and not calibrations:
        raise ExperimentError(f"sensor {sensor.name!r}: raw counts become forces by --calibration or a prior matrix")
    needed = {variable.name for calibration in calibrations.values() for variable in calibration.variables}
    used = replace(sensor, variables=tuple(v for v in sensor.variables if v.linear.name in needed))
    reason = _no_reference(experiment, sensor, intervals)
    read, variables, reference = _collected(experiment, used, intervals, with_reference=reason is None)
    raw = read if sensor.quantity == "raw" or sensor.prior is None else recover_raw(read, sensor.prior)
    mass = _one_mass(experiment, sensor, intervals)
    column = {variable.linear.name: k for k, variable in enumerate(used.variables)}
    found = []
    for name, model, names in _candidates(sensor, calibrations):
        require_shape(model.matrix, name=f"{name}: matrix", shape=(6, raw.shape[1]))
        wrench = model.wrench(raw, variables[:, [column[each] for each in names]])
        with stated_in(f"sensor {sensor.name!r}, {name}"):
            analysis = analyse_sphere(wrench, reference, gravity=experiment.processing.gravity, mass=mass)
        found.append(
            SensorSphere(
                sensor=sensor.name,
                serial=sensor.serial,
                candidate=name,
                intervals=tuple(interval.label for interval in intervals),
                fitted_on=_fitted_on(calibrations.get(name), intervals),
                no_reference=reason,
                force=wrench[:, :3],
                reference=None if reference is None else reference[:, :3],
                analysis=analysis,
            )
        )
    return found


def _labelled(experiment: Experiment, usable: Sequence[Interval], name: str) -> list[str]:
    """Labels of the intervals that have this label, or are of this kind."""
    labels = [interval.label for interval in usable]
    if name in labels:
        return [name]
    found = [label for label in labels if experiment.roles[label].kind == name]
    if not found:
        known = {*labels, *(experiment.roles[label].kind for label in labels)}
        raise ExperimentError(
            f"experiment {experiment.name!r}: no interval to use has the label or kind {name!r}; "
            f"{known_names(name, known)}"
        )
    return found


def _candidates(
    sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> list[tuple[str, WrenchModel, tuple[str, ...]]]:
    """Ways to read a sensor: name, model of raw counts, and the variables that it needs."""
    found: list[tuple[str, WrenchModel, tuple[str, ...]]] = []
    if sensor.prior is not None:
        found.append(("prior", WrenchModel(matrix=sensor.prior, offset=np.zeros(6)), ()))
    return [*found, *((name, c.model, tuple(v.name for v in c.variables)) for name, c in calibrations.items())]


def _no_reference(experiment: Experiment, sensor: ExperimentSensor, intervals: Sequence[Interval]) -> str | None:
    """Say which joints the reference lacks; None if it lacks none."""
    logged = experiment.recording.joint_signals("position")
    missing: dict[str, None] = {}
    for interval in intervals:
        needed = required_joints_of(_question(experiment, sensor, interval))
        if interval.support is not None:
            needed += joints_to_support(experiment.model, experiment.recording, interval.support)
        missing.update(dict.fromkeys(joint for joint in needed if joint not in logged))
    return f"no stream holds the position of {', '.join(missing)}" if missing else None


def _question(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> Question:
    if interval.support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame, got none")
    tree = build_tree(experiment.model, interval.support.frame)
    return Question(tree=tree, expected=(sensor.name,), equations=())


def _collected(
    experiment: Experiment, sensor: ExperimentSensor, intervals: Sequence[Interval], *, with_reference: bool
) -> tuple[FloatArray, FloatArray, FloatArray | None]:
    """Readings, variables and references of all intervals, one after the other."""
    if not with_reference:
        pairs = [readings_over(experiment, sensor, interval) for interval in intervals]
        readings, variables = zip(*pairs, strict=True)
        return np.concatenate(readings), np.concatenate(variables), None
    parts = [
        samples_over(experiment, sensor, interval, variables=[v.linear.name for v in sensor.variables]).samples
        for interval in intervals
    ]
    return (
        np.concatenate([part.reading.values for part in parts]),
        np.concatenate([part.variables for part in parts]),
        np.concatenate([part.reference for part in parts]),
    )


def _one_mass(experiment: Experiment, sensor: ExperimentSensor, intervals: Sequence[Interval]) -> float | None:
    """Mass that hangs on the sensor in all intervals; kg."""
    masses = [_mass(experiment, sensor, interval) for interval in intervals]
    first = masses[0] or 0.0
    for interval, mass in zip(intervals, masses, strict=True):
        if abs((mass or 0.0) - first) > _ROUNDING * first:
            raise ExperimentError(
                f"sensor {sensor.name!r}: expected the same mass on it in all intervals, got {first:.4g} kg in "
                f"{intervals[0].label!r} and {mass or 0.0:.4g} kg in {interval.label!r}, whose supports are on the two "
                "sides of the sensor; choose intervals of one side (--interval)"
            )
    return masses[0]


def _mass(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> float | None:
    """Mass that hangs on the sensor, from the force that it reads at rest, in whatever posture; kg."""
    question = _question(experiment, sensor, interval)
    joints = required_joints_of(question)
    rest = JointMotion.at_rest(joints, np.zeros((1, len(joints))))
    root = RootMotion.fixed([0.0, 0.0, -1.0], gravity=1.0)
    force = estimate(question, rest, root).expected_of(sensor.name)[0, :3]
    mass = float(np.linalg.norm(force))
    return mass if mass > 0.0 else None


def _fitted_on(calibration: Calibration | None, intervals: Sequence[Interval]) -> tuple[str, ...]:
    fitted = () if calibration is None else calibration.provenance.intervals
    return tuple(
        interval.label
        for interval in intervals
        if any(interval.start_ns < other.end_ns and other.start_ns < interval.end_ns for other in fitted)
    )
