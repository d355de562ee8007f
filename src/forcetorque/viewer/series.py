# SPDX-License-Identifier: BSD-3-Clause
"""The wrenches of a sensor: expected, read through the prior, and through every calibration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.evaluation.sphere.findings import EllipsoidFit
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.experiment.applicability import require_fit
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.candidates import PRIOR
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import require_overlap
from forcetorque.robot.model import SensorFrame
from forcetorque.viewer.arrays import Block, Priors, SceneDraft
from forcetorque.viewer.geometry import flat
from forcetorque.viewer.instants import Posture
from forcetorque.viewer.scene import Ellipsoid, Sensor, Sphere, WrenchSeries

_SPHERE_SAMPLES = 50_000
"""Samples of a log from which on ellipsoids are fitted to a part of them."""
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
        series.append(_series("expected", "expected", draft.block, expected, sphere=_weight(by_candidate)))
    for reading in readings:
        values = _values(experiment, sensor, reading.correction, posture.stamp_ns, draft)
        offset = reading.correction.model.offset if reading.candidate == PRIOR else np.zeros(6)
        fits = _ellipsoids(by_candidate.get(reading.candidate), offset)
        series.append(_series(reading.name, "measured", draft.block, values, force=fits[0], moment=fits[1]))
    tag = experiment.model.sensor(sensor.name)
    joint = experiment.model.joints[tag.joint]
    ends = (joint.child, joint.parent)
    acting, acted_on = ends if tag.direction is MeasureDirection.CHILD_TO_PARENT else ends[::-1]
    return Sensor(
        name=sensor.name,
        serial=sensor.serial,
        link=joint.parent if tag.frame is SensorFrame.PARENT else joint.child,
        link_H_sensor=flat(tag.child_H_sensor if tag.frame is SensorFrame.SENSOR else np.eye(4)),
        acting=acting,
        acted_on=acted_on,
        wrenches=tuple(series),
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
    for name, calibration in calibrations.items():
        require_fit(name, calibration, experiment, sensor)
        readings.append(_Reading(name=name, candidate=name, correction=Correction.of(name, calibration)))
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
            draft.notes.append(f"sensor {sensor.name!r}, {sphere.candidate}: no ellipsoid of forces: {reason}")
    labels = ", ".join(map(repr, analyses[0].intervals))
    draft.sources.append(
        f"{sensor.name}: sphere of the weight and ellipsoids as by `forcetorque sphere` over {labels}{every}"
    )
    return {sphere.candidate: sphere for sphere in analyses}


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
    role: str,
    block: Block,
    values: FloatArray,
    *,
    sphere: Sphere | None = None,
    force: Ellipsoid | None = None,
    moment: Ellipsoid | None = None,
) -> WrenchSeries:
    return WrenchSeries(
        name=name,
        role="expected" if role == "expected" else "measured",
        values=block.add(values, "float32"),
        reference_force=sphere,
        reference_moment=None,
        ellipsoid_force=force,
        ellipsoid_moment=moment,
    )
