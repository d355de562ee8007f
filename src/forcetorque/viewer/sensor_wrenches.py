# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches of a sensor over time: expected, read through the prior, and through every calibration."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.evaluation.sphere.ellipsoid import EllipsoidFit
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.experiment.applicability import require_fit
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import require_overlap
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.results.table import short_names
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.root_motion import joints_to_support
from forcetorque.robot.model import RobotModel, SensorFrame
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.viewer.posture import Posture
from forcetorque.viewer.robot_shapes import flat
from forcetorque.viewer.scene import Ellipsoid, Sensor, Sphere, WrenchSeries
from forcetorque.viewer.scene_arrays import Block, Priors, SceneDraft, peak

_SPHERE_SAMPLES = 5_000
"""Samples of a log from which on ellipsoids are fitted to a part of them."""
_COVARIANCES = 20_000
"""Covariances that are held at once."""
EXPECTED = "expected"
"""Name of the series that the model expects."""
LOGGED = "logged"
"""Name of the series of a stream that holds wrenches."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Reading:
    """One way to read a sensor."""

    name: str
    candidate: str
    correction: Correction


def scene_sensor(
    experiment: Experiment,
    sensor: ExperimentSensor,
    calibrations: Mapping[str, Calibration],
    expected: FloatArray,
    posture: Posture,
    priors: Priors,
    draft: SceneDraft,
) -> Sensor:
    """Collect the wrenches of a sensor at common instants.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        sensor: One of its sensors.
        calibrations: Calibrations of that sensor by name.
        expected: What the model expects; shape (n, 6); N, N m.
        posture: The instants.
        priors: How sensors are read without a calibration.
        draft: Takes the arrays, what is missing and where the rest comes from.

    Returns:
        The sensor with its series; none is expected where the model gives nothing.
    """
    readings = _readings(experiment, sensor, calibrations, priors, draft)
    by_candidate = _spheres(experiment, sensor, calibrations, draft)
    series = []
    if np.isfinite(expected).any():
        series.append(_series(EXPECTED, draft.block, sensor.expected_reading(expected), sphere=_weight(by_candidate)))
    for reading in readings:
        values = _values(experiment, sensor, reading.correction, posture.stamp_ns, draft)
        offset = reading.correction.model.offset if reading.candidate == PRIOR else np.zeros(6)
        fits = _ellipsoids(by_candidate.get(reading.candidate), offset)
        deviation = _deviation(experiment, reading.correction, expected, posture)
        series.append(_series(reading.name, draft.block, values, reading, deviation, force=fits[0], moment=fits[1]))
    return replace(unread_sensor(experiment.model, sensor.name, sensor.serial), wrenches=tuple(series))


def unread_sensor(model: RobotModel, name: str, serial: str) -> Sensor:
    """Find where a sensor is.

    Args:
        model: The robot.
        name: One of its sensors.
        serial: Its serial number.

    Returns:
        The sensor with its frame, and who acts on whom, without wrenches.
    """
    tag = model.sensor(name)
    joint = model.joints[tag.joint]
    ends = (joint.child, joint.parent)
    acting, acted_on = ends if tag.direction is MeasureDirection.CHILD_TO_PARENT else ends[::-1]
    return Sensor(
        name=name,
        serial=serial,
        link=joint.parent if tag.frame is SensorFrame.PARENT else joint.child,
        link_H_sensor=flat(tag.child_H_sensor if tag.frame is SensorFrame.SENSOR else np.eye(4)),
        acting=acting,
        acted_on=acted_on,
        wrenches=(),
    )


def _readings(
    experiment: Experiment,
    sensor: ExperimentSensor,
    calibrations: Mapping[str, Calibration],
    priors: Priors,
    draft: SceneDraft,
) -> list[_Reading]:
    readings = []
    if sensor.quantity == "wrench" or sensor.prior is not None:
        correction = _prior_correction(sensor, priors, draft)
        name = LOGGED if correction.of_wrench else PRIOR
        draft.sources.append(f"{sensor.name}: {name} is {correction.source}")
        readings.append(_Reading(name=name, candidate=PRIOR, correction=correction))
    elif not calibrations:
        draft.notes.append(f"sensor {sensor.name!r}: raw counts become wrenches by --calibration or a prior matrix")
    shown = short_names((EXPECTED, LOGGED, PRIOR, *calibrations))  # none gets the name of another series
    for name, calibration in calibrations.items():
        require_fit(name, calibration, experiment, sensor)
        readings.append(_Reading(name=shown[name], candidate=name, correction=Correction.of(name, calibration)))
    return readings


def _prior_correction(sensor: ExperimentSensor, priors: Priors, draft: SceneDraft) -> Correction:
    """The prior with the offset that the calibration intervals give; with none where they do not."""
    try:
        return priors.of(sensor)
    except ForceTorqueError as error:
        draft.notes.append(f"sensor {sensor.name!r}: no offset is removed from the prior reading: {error}")
    return Correction.without_offset(sensor)


def _values(
    experiment: Experiment, sensor: ExperimentSensor, correction: Correction, at_ns: IntArray, draft: SceneDraft
) -> FloatArray:
    source = experiment.recording.stream(sensor.stream)
    first = experiment.recording.stream(experiment.sensors[0].stream)
    used = [source, *(experiment.recording.stream(sensor.variable(v).source.stream) for v in correction.variables)]
    try:
        for stream in used:
            require_overlap(first, stream)
        return wrench_at(experiment, sensor, correction, at_ns)
    except ForceTorqueError as error:
        draft.notes.append(f"sensor {sensor.name!r}: no reading by {correction.source}: {error}")
        return np.full((len(at_ns), 6), np.nan)


def _deviation(
    experiment: Experiment, correction: Correction, expected: FloatArray, posture: Posture
) -> FloatArray | None:
    """Standard deviation of the error under the expected wrench, with the offset of each interval's session."""
    posterior = None if correction.calibration is None else correction.calibration.posterior
    if posterior is None:
        return None
    deviation = np.full_like(expected, np.nan)
    for interval in experiment.recording.intervals:
        inside = np.flatnonzero(interval.holds(posture.stamp_ns) & np.isfinite(expected).all(axis=1))
        names = experiment.session_names(interval.label)
        session = next((name for name in names if name in posterior.sessions), posterior.sessions[-1])
        for start in range(0, len(inside), _COVARIANCES):
            rows = inside[start : start + _COVARIANCES]
            covariance = posterior.error_covariance(expected[rows], session=session)
            deviation[rows] = np.sqrt(np.maximum(np.einsum("nii->ni", covariance), 0.0))
    return deviation


def _spheres(
    experiment: Experiment,
    sensor: ExperimentSensor,
    calibrations: Mapping[str, Calibration],
    draft: SceneDraft,
) -> dict[str, SensorSphere]:
    try:
        thinned, every = _thinned(experiment, sensor)
        analyses = spheres(SensorRun(thinned, sensor), calibrations).analyses
    except ForceTorqueError as error:
        draft.notes.append(f"sensor {sensor.name!r}: no sphere and no ellipsoid: {error}")
        return {}
    for sphere in analyses:
        if _force_fit(sphere) is None:
            fit = sphere.analysis.free if sphere.analysis.mapped is None else sphere.analysis.mapped.fit
            reason = "; ".join(fit.why)
            draft.notes.append(f"sensor {sensor.name!r}, {sphere.calibration}: no ellipsoid of forces: {reason}")
    labels = ", ".join(map(repr, analyses[0].intervals))
    draft.sources.append(
        f"{sensor.name}: sphere of the weight and ellipsoids as by `forcetorque study sphere` over {labels}{every}"
    )
    return {sphere.calibration: sphere for sphere in analyses}


def _thinned(experiment: Experiment, sensor: ExperimentSensor) -> tuple[Experiment, str]:
    """Leave samples out of a long log, of which ellipsoids need not see all; and say so."""
    stream = experiment.recording.stream(sensor.stream)
    step = -(-len(stream) // _SPHERE_SAMPLES)
    if step == 1 or experiment.processing.smoothing is not None:  # a filter needs them all
        return experiment, ""
    signals = {name: replace(signal, values=signal.values[::step]) for name, signal in stream.signals.items()}
    fewer = replace(stream, stamp_ns=stream.stamp_ns[::step], sequence=None, signals=signals)
    streams = {**experiment.recording.streams, stream.name: fewer}
    return replace(experiment, recording=replace(experiment.recording, streams=streams)), f", from one sample in {step}"


def _weight(by_candidate: Mapping[str, SensorSphere]) -> Sphere | None:
    """Sphere that the weight beyond the sensor draws."""
    for sphere in by_candidate.values():
        if sphere.analysis.mass is not None:
            return Sphere(centre=(0.0, 0.0, 0.0), radius=sphere.analysis.mass * sphere.analysis.gravity)
    return None


def _ellipsoids(sphere: SensorSphere | None, offset: FloatArray) -> tuple[Ellipsoid | None, Ellipsoid | None]:
    """Ellipsoids of forces and moments, moved by an offset that the analysis did not apply."""
    if sphere is None:
        return None, None
    moment = sphere.analysis.free_moment
    return (
        _ellipsoid(_force_fit(sphere), offset[:3]),
        _ellipsoid(moment if moment is not None and moment.identifiable else None, offset[3:]),
    )


def _force_fit(sphere: SensorSphere) -> EllipsoidFit | None:
    """The ellipsoid with the model where that is identifiable, else the one without."""
    mapped = sphere.analysis.mapped
    for fit in ([] if mapped is None else [mapped.fit]) + [sphere.analysis.free]:
        if fit.identifiable and fit.ellipsoid is not None:
            return fit
    return None


def _ellipsoid(fit: EllipsoidFit | None, offset: FloatArray) -> Ellipsoid | None:
    if fit is None or fit.ellipsoid is None:
        return None
    axes = fit.ellipsoid.principal_axes * fit.ellipsoid.principal_radii
    return Ellipsoid(centre=flat(fit.ellipsoid.centre + offset), axes=flat(axes))


def _series(
    name: str,
    block: Block,
    values: FloatArray,
    reading: _Reading | None = None,
    deviation: FloatArray | None = None,
    *,
    sphere: Sphere | None = None,
    force: Ellipsoid | None = None,
    moment: Ellipsoid | None = None,
) -> WrenchSeries:
    return WrenchSeries(
        name=name,
        role="expected" if reading is None else "measured",
        calibrated=reading is not None and reading.correction.calibration is not None,
        peak=peak(values),
        values=block.add(values, "float32"),
        deviation=None if deviation is None else block.add(deviation, "float32"),
        reference_force=sphere,
        reference_moment=None,
        ellipsoid_force=force,
        ellipsoid_moment=moment,
    )


def expected_readings(
    experiment: Experiment, sensors: Sequence[str], posture: Posture
) -> tuple[dict[str, FloatArray], list[str]]:
    """Evaluate the model at every instant that lies in an interval with a support.

    Where several intervals hold an instant, the first with a support rules. Nothing is expected of a
    sensor in an interval in which something touches a robot on the move beyond it.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        sensors: Names of the sensors.
        posture: The instants.

    Returns:
        Expected readings by sensor, NaN where there is none, of shape (n, 6) in N, N m; and what is missing.
    """
    n = len(posture.stamp_ns)
    expected = {sensor: np.full((n, 6), np.nan) for sensor in sensors}
    notes: dict[str, None] = {}
    left = np.ones(n, dtype=bool)
    spans: dict[int, tuple[Support | MovingSupport, np.ndarray]] = {}
    shown: list[tuple[Interval, BoolArray]] = []
    for interval in experiment.recording.intervals:
        if interval.support is not None:
            inside = left & interval.holds(posture.stamp_ns)
            left &= ~inside
            shown.append((interval, inside))
            _, before = spans.get(id(interval.support), (None, np.zeros(n, dtype=bool)))
            spans[id(interval.support)] = (interval.support, before | inside)
    for support, inside in spans.values():
        chosen = np.flatnonzero(inside)
        if not len(chosen):
            continue
        answerable = []
        try:
            tree = build_tree(experiment.model_on(support), support.frame)
        except ForceTorqueError as error:
            notes[f"no expected wrenches on {support.frame!r}: {error}"] = None
            continue
        for sensor in sensors:
            try:
                lacking = _lacking(experiment, tree, sensor, support)
            except ForceTorqueError as error:
                notes[f"sensor {sensor!r}: no expected wrench on {support.frame!r}: {error}"] = None
                continue
            if lacking:
                joints = ", ".join(lacking)
                notes[f"sensor {sensor!r}: no expected wrench on {support.frame!r}: no stream holds {joints}"] = None
            else:
                answerable.append(sensor)
        if not answerable:
            continue
        try:
            readings = _evaluate(experiment, tree, answerable, support, posture, chosen)
        except ForceTorqueError as error:
            notes[f"no expected wrenches on {support.frame!r}: {error}"] = None
            continue
        for sensor, values in readings.items():
            expected[sensor][chosen] = values
    for sensor, values in expected.items():
        notes.update(dict.fromkeys(_without_touched(SensorRun(experiment, sensor), values, shown)))
    if not spans:
        notes["no expected wrenches: no interval states a support"] = None
    return expected, list(notes)


def _without_touched(run: SensorRun, values: FloatArray, shown: Sequence[tuple[Interval, BoolArray]]) -> Iterator[str]:
    """Take away what is expected where something touches beyond the sensor; in words, where that is."""
    touched: dict[tuple[str, ...], list[str]] = {}
    for interval, inside in shown:
        if (names := run.touched_beyond(interval)) and np.isfinite(values[inside]).any():
            values[inside] = np.nan
            touched.setdefault(names, []).append(interval.label)
    for names, labels in touched.items():
        yield (
            f"sensor {run.sensor.name!r}: no expected wrench in {', '.join(labels)}, where {', '.join(names)} touches "
            "the robot beyond it"
        )


def _lacking(experiment: Experiment, tree: BodyTree, sensor: str, support: Support | MovingSupport) -> list[str]:
    """Joints that the expected reading of a sensor needs and no stream holds."""
    needed = required_joints_of(Question(tree=tree, expected=(sensor,), equations=()))
    needed += joints_to_support(experiment.model, experiment.recording, support)
    logged = experiment.recording.joint_signals("position")
    return [joint for joint in dict.fromkeys(needed) if joint not in logged]


def _evaluate(
    experiment: Experiment,
    tree: BodyTree,
    sensors: Sequence[str],
    support: Support | MovingSupport,
    posture: Posture,
    chosen: np.ndarray,
) -> dict[str, FloatArray]:
    question = Question(tree=tree, expected=tuple(sensors), equations=())
    joints, root = experiment.motion_at(support, required_joints_of(question), posture.stream, posture.stamp_ns[chosen])
    estimates = estimate(question, joints, root)
    return {sensor: estimates.expected_of(sensor) for sensor in sensors}
