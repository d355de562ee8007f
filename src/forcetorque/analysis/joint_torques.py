# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques that a sensor's candidates lead to, against those of the rigid-body model (thesis 2.4.3, 5.6)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from forcetorque.analysis.candidate import JudgedCandidate
from forcetorque.analysis.corrections import corrections_of
from forcetorque.analysis.first_second import OffsetClock, gap_words, nothing_left
from forcetorque.analysis.reading import Correction, wrench_at
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.analysis.validate import free_part
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Estimates, Question, estimate, required_joints_of
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.evaluation import (
    KNOWN_BEFORE,
    ContactForceValidation,
    Offset,
    OtherSensors,
    TorqueErrors,
    TorqueMap,
    joints_of_sensor,
    torque_errors,
    torque_map,
)
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval, MovingSupport, Stream, Support, Use
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.robot import BodyTree, JointType


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointTorqueVerdict:
    """Errors of the torque that is estimated for one joint where one candidate reads the sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """Name of the calibration, or of its prior: `prior`, and `prior of NAME` among several calibrations."""
    offset: Offset
    """Offsets as fitted, or from the first second of every judged interval."""
    offset_source: str
    """Where the sensor's offset comes from, in words."""
    prior: str | None
    """Name of the prior that a calibration is to be compared with; None for a prior, and where it has none."""
    joint: str
    """Joint whose torque depends on the sensor."""
    unit: Literal["N m", "N"]
    """Unit of its torque: `N m`, or `N` for a prismatic joint."""
    errors: TorqueErrors
    """Estimated torque less that of the rigid-body model."""
    from_logged: TorqueErrors | None
    """Estimated torque less the logged one; None where none was logged or the model's torque cannot be computed."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointTorques:
    """Joint torques that depend on one sensor, by all its candidates."""

    verdicts: tuple[JointTorqueVerdict, ...]
    """One per candidate, offset and joint, joints from the support outwards."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, or to judge in an interval, in words."""


def compare_joint_torques(
    run: SensorRun,
    calibrations: Mapping[str, Calibration],
    *,
    others: Mapping[str, Calibration] | None = None,
    other_sensors: OtherSensors = OtherSensors.MODEL,
    sub_model: str | None = None,
    contact: str | None = None,
) -> JointTorques:
    """Judge candidates of a sensor by the joint torques that are estimated from it.

    The contacts are those of `estimate_experiment`: the support, and a full wrench at the sensor at the base of every
    other sub-model; `contact` moves that of the free one. The model's torques are those of the support as the only
    contact.

    Args:
        run: The sensor; the validation intervals are judged.
        calibrations: Calibrations of that sensor by name; their priors are judged too, or that of the experiment where
            there is none.
        others: Calibrations of the other sensors by name, for the mode `measured`; where there is none, their prior.
        other_sensors: Whether the other sensors read what the model expects or what they measured.
        sub_model: The free sub-model, by the sensor at its base or the root link; None for that outboard of the sensor.
        contact: Link of the free sub-model that takes up its contact wrench; None for that at its base.

    Returns:
        For every candidate, with its own offset and with one from each interval's first second, the errors per joint.

    Raises:
        ExperimentError: If an interval has no support.
    """
    experiment, sensor = run.experiment, run.sensor
    candidates = run.candidates(calibrations)
    needed = corrections_of(experiment, others or {}) if other_sensors is OtherSensors.MEASURED else {}
    found: dict[_Key, list[_Errors]] = {}
    left_out: dict[str, None] = {}
    for interval in run.intervals(Use.VALIDATION):
        with stated_in(f"interval {interval.label!r}"):
            part = free_part(experiment, sensor, interval, other_sensors, sub_model, contact)
            scheme = _scheme_of(experiment, interval, part, contact)
            left_out |= dict.fromkeys(scheme.left_out)
            clock = run.clock(interval)
            short = nothing_left(clock, interval)
            if short is not None:
                left_out[short] = None
            elif scheme.joints:
                over = dict(_over(experiment, sensor, clock, scheme, candidates, needed))
                left_out |= dict.fromkeys(_gaps(interval, candidates, over))
                for key, part_of in over.items():
                    found.setdefault(key, []).append(part_of)
    judged = {key: np.concatenate([part.from_model for part in parts]) for key, parts in found.items()}
    verdicts = [
        JointTorqueVerdict(
            sensor=sensor.name,
            serial=sensor.serial,
            candidate=candidates[key.candidate].name,
            offset=candidates[key.candidate].offset(key.offset),
            offset_source=candidates[key.candidate].offset_source(key.offset),
            prior=candidates[key.candidate].prior,
            joint=key.joint,
            unit="N" if experiment.model.joints[key.joint].type is JointType.PRISMATIC else "N m",
            errors=torque_errors(errors),
            from_logged=_pooled([part.from_logged for part in found[key] if part.from_logged is not None]),
        )
        for key, errors in judged.items()
        if not np.isnan(errors).all()
    ]
    return JointTorques(verdicts=tuple(verdicts), left_out=tuple(left_out))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Key:
    candidate: int
    """Its place: a calibration may be called `prior` too."""
    offset: Offset
    joint: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Errors:
    """Errors of one joint's torque over one interval; shape (n,) each."""

    from_model: FloatArray
    from_logged: FloatArray | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Scheme:
    """What is estimated over one interval, from which sensors."""

    tree: BodyTree
    support: Support | MovingSupport
    cut_at: tuple[str, ...]
    contact: str | None
    joints: tuple[str, ...]
    """Joints that depend on the judged sensor and can be judged."""
    sensors: tuple[str, ...]
    """Sensors whose error is in their torques; the judged one first."""
    logged: tuple[str, ...]
    """Those of the joints whose torque was logged and can be computed by the model."""
    question: Question
    """What the model is asked: the expected readings of these sensors, and the torques to compare with logged ones."""
    motion: tuple[str, ...]
    """Joints whose motion is needed."""
    left_out: tuple[str, ...]


def _scheme_of(
    experiment: Experiment, interval: Interval, part: ContactForceValidation, contact: str | None
) -> _Scheme:
    if interval.support is None:
        raise ExperimentError("expected a support frame, got none")
    tree, cut_at, sensor = part.tree, tuple(part.cut_at or ()), part.sensor
    available = set(experiment.recording.joint_signals("position"))
    names = cut_at if part.other_sensors is OtherSensors.MEASURED else (sensor,)
    loaded = {name: joints_of_sensor(tree, name, cut_at=cut_at, contact=contact) for name in names}
    joints, sensors, left_out = [], [sensor], []
    for joint in loaded[sensor]:
        readers = tuple(name for name in names if joint in loaded[name])
        missing = _missing(Question(tree=tree, expected=readers, equations=()), available)
        if missing:
            words = f"no stream holds the joint(s) {', '.join(missing)}"
            left_out.append(f"torque of {joint}, from what is expected of {', '.join(readers)}: {words}")
        else:
            joints.append(joint)
            sensors += [name for name in readers if name not in sensors]
    in_log = experiment.recording.joint_signals("torque")
    logged = tuple(
        joint
        for joint in joints
        if joint in in_log and not _missing(Question(tree=tree, torques=(joint,), equations=()), available)
    )
    question = Question(tree=tree, expected=tuple(sensors), torques=logged, equations=())
    return _Scheme(
        tree=tree,
        support=interval.support,
        cut_at=cut_at,
        contact=contact,
        joints=tuple(joints),
        sensors=tuple(sensors),
        logged=logged,
        question=question,
        motion=tuple(dict.fromkeys((*part.required_joints, *required_joints_of(question)))),
        left_out=tuple(left_out),
    )


def _missing(question: Question, available: set[str]) -> list[str]:
    return [joint for joint in required_joints_of(question) if joint not in available]


def _over(
    experiment: Experiment,
    sensor: ExperimentSensor,
    clock: OffsetClock,
    scheme: _Scheme,
    candidates: Sequence[JudgedCandidate],
    needed: Mapping[str, Correction],
) -> Iterator[tuple[_Key, _Errors]]:
    """Errors of every candidate, offset and joint over one interval, after its first second."""
    source = experiment.recording.stream(sensor.stream)
    at_ns = clock.at_ns
    model, maps = _model(experiment, source, scheme, at_ns)
    expected = model.expected_of(sensor.name)
    own = [wrench_at(experiment, sensor, each.correction, at_ns) - expected for each in candidates]
    rest = {}
    for name in scheme.sensors[1:]:
        other = experiment.sensor(name)
        require_overlap(source, experiment.recording.stream(other.stream))
        rest[name] = wrench_at(experiment, other, needed[name], at_ns) - model.expected_of(name)
    logged = _logged(experiment, source, scheme.logged, at_ns)
    for offset in KNOWN_BEFORE:
        by_others = np.zeros((len(at_ns), len(scheme.joints)))
        for name, error in rest.items():
            by_others += _borne(scheme, maps[name], clock.with_offset(error, offset))
        for candidate, error in enumerate(own):
            borne = by_others + _borne(scheme, maps[sensor.name], clock.with_offset(error, offset))
            for joint, torque in zip(scheme.joints, borne.T, strict=True):
                off = torque + model.torque(joint) - logged[joint] if joint in logged else None
                yield (
                    _Key(candidate=candidate, offset=offset, joint=joint),
                    _Errors(
                        from_model=clock.judged(torque[:, None])[:, 0],
                        from_logged=None if off is None else clock.judged(off[:, None])[:, 0],
                    ),
                )


def _gaps(interval: Interval, candidates: Sequence[JudgedCandidate], over: Mapping[_Key, _Errors]) -> Iterator[str]:
    """Torques that gaps leave out in one interval, in words."""
    by_offset: dict[tuple[str, int], dict[Offset, FloatArray]] = {}
    for key, errors in over.items():
        by_offset.setdefault((key.joint, key.candidate), {})[key.offset] = errors.from_model
    for (joint, candidate), judged in by_offset.items():
        words = gap_words(f"torque of {joint} by {candidates[candidate].name}", interval, judged)
        if words is not None:
            yield words


def _model(
    experiment: Experiment, source: Stream, scheme: _Scheme, at_ns: IntArray
) -> tuple[Estimates, dict[str, TorqueMap]]:
    """What the model expects, and how the torques depend on each sensor."""
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        scheme.support,
        scheme.motion,
        source,
        at_ns,
        processing=experiment.processing,
    )
    maps = {
        name: torque_map(scheme.tree, joints, name, cut_at=scheme.cut_at, contact=scheme.contact)
        for name in scheme.sensors
    }
    return estimate(scheme.question, joints, root), maps


def _logged(experiment: Experiment, source: Stream, joints: Sequence[str], at_ns: IntArray) -> dict[str, FloatArray]:
    signals = experiment.recording.joint_signals("torque")
    torques = {}
    for joint in joints:
        stream, signal = signals[joint]
        require_overlap(source, stream)
        torques[joint] = interpolate(stream, signal.column(joint)[:, None], at_ns)[:, 0]
    return torques


def _borne(scheme: _Scheme, map_of: TorqueMap, error: FloatArray) -> FloatArray:
    """Torques of the judged joints by the error of one sensor; shape (n, joints)."""
    torques = dict(zip(map_of.joints, map_of.torques(error).T, strict=True))
    none = np.zeros(len(error))
    return np.stack([torques.get(joint, none) for joint in scheme.joints], axis=1)


def _pooled(parts: Sequence[FloatArray]) -> TorqueErrors | None:
    errors = np.concatenate([np.empty(0), *parts])
    return None if np.isnan(errors).all() else torque_errors(errors)
