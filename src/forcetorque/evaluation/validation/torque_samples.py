# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques that depend on a sensor, and their errors by its calibrations, sample by sample."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.means import one_after_another
from forcetorque.evaluation.validation.joint_torque_errors import TorqueMap, joints_of_sensor, torque_map
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.candidates import JudgedCandidate
from forcetorque.experiment.first_second import gap_words, nothing_left
from forcetorque.experiment.free_sub_model import FreeSubModel
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.offset_policy import KNOWN_BEFORE, Offset
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sub_model_choice import OtherSensors
from forcetorque.recording.alignment import interpolate, require_overlap, seconds_since
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimates import Estimates
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.tree import BodyTree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueScheme:
    """What is estimated over one interval, from which sensors."""

    tree: BodyTree
    """The robot, seen from the support."""
    cut_at: tuple[str, ...]
    """Sensors at which it is cut."""
    contact: str | None
    """Link of the free sub-model that takes up its contact wrench; None for that at its base."""
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
    """Torques that the log does not allow to estimate, in words."""


def torque_scheme(free: FreeSubModel, interval: Interval) -> TorqueScheme:
    """Decide which torques are judged in an interval.

    Args:
        free: The free sub-model of the judged sensor.
        interval: The interval.

    Returns:
        The joints, and what is needed for them.

    Raises:
        ExperimentError: If the interval has no support.
    """
    sub_model, recording = free.seen_from_support(interval), free.run.experiment.recording
    tree, cut_at, sensor = sub_model.tree, tuple(sub_model.cut_at or ()), sub_model.sensor
    available = set(recording.joint_signals("position"))
    names = cut_at if free.choice.other_sensors is OtherSensors.MEASURED else (sensor,)
    loaded = {name: joints_of_sensor(tree, name, cut_at=cut_at, contact=free.choice.contact) for name in names}
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
    in_log = recording.joint_signals("torque")
    logged = tuple(
        joint
        for joint in joints
        if joint in in_log and not _missing(Question(tree=tree, torques=(joint,), equations=()), available)
    )
    question = Question(tree=tree, expected=tuple(sensors), torques=logged, equations=())
    return TorqueScheme(
        tree=tree,
        cut_at=cut_at,
        contact=free.choice.contact,
        joints=tuple(joints),
        sensors=tuple(sensors),
        logged=logged,
        question=question,
        motion=tuple(dict.fromkeys((*sub_model.required_joints, *required_joints_of(question)))),
        left_out=tuple(left_out),
    )


def _missing(question: Question, available: set[str]) -> list[str]:
    return [joint for joint in required_joints_of(question) if joint not in available]


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueKey:
    """Whose torque is judged, and with which offset."""

    candidate: int
    """Place of the candidate: a calibration may be called `prior` too."""
    offset: Offset
    """Offset that is asked for."""
    joint: str
    """Joint."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueSamples:
    """Errors of one joint's torque; N m, N where prismatic; NaN in gaps."""

    from_model: FloatArray
    """Estimated torque less that of the rigid-body model; shape (n,)."""
    from_logged: FloatArray
    """Estimated torque less the logged one, over the intervals in which there is one; shape (m,)."""
    time_s: FloatArray
    """Instants of the former since the start of the recording; shape (n,); s."""
    logged_time_s: FloatArray
    """Instants of the latter; shape (m,); s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedTorques:
    """Errors of the torques that depend on one sensor, over all judged intervals, in the order of time."""

    candidates: tuple[JudgedCandidate, ...]
    """The candidates."""
    samples: Mapping[TorqueKey, TorqueSamples]
    """The errors."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, or to judge in an interval, in words."""


def judged_torques(free: FreeSubModel, calibrations: Mapping[str, Calibration]) -> JudgedTorques:
    """Estimate the torques of the joints that depend on a sensor by every candidate, and compare with the model.

    Args:
        free: The free sub-model of the sensor; the validation intervals are judged.
        calibrations: Calibrations of the sensor by name.

    Returns:
        Errors with the candidate's own offset and with that of each interval's first second.

    Raises:
        ExperimentError: If an interval has no support.
    """
    run = free.run
    candidates = run.candidates(calibrations)
    pieces: dict[TorqueKey, list[TorqueSamples]] = {}
    left_out: dict[str, None] = {}
    for interval in run.intervals(Use.VALIDATION):
        with stated_in(f"interval {interval.label!r}"):
            scheme = torque_scheme(free, interval)
            left_out |= dict.fromkeys(scheme.left_out)
            short = nothing_left(run.instants(interval), interval)
            if short is not None:
                left_out[short] = None
            elif scheme.joints:
                over = dict(_over(free, interval, scheme, candidates))
                left_out |= dict.fromkeys(_gaps(interval, candidates, over))
                for key, samples in over.items():
                    pieces.setdefault(key, []).append(samples)
    return JudgedTorques(
        candidates=candidates,
        samples={key: _joined(samples) for key, samples in pieces.items()},
        left_out=tuple(left_out),
    )


def pooled_torques(recordings: Mapping[str, JudgedTorques]) -> JudgedTorques:
    """Put together what several recordings say.

    Args:
        recordings: Errors by name of the recording, candidates in the same order.

    Returns:
        All of them, one recording after the other; the same where there is one.
    """
    first = next(iter(recordings.values()))
    if len(recordings) == 1:
        return first
    pieces: dict[TorqueKey, list[TorqueSamples]] = {}
    for torques in recordings.values():
        for key, samples in torques.samples.items():
            pieces.setdefault(key, []).append(samples)
    return JudgedTorques(
        candidates=first.candidates,
        samples={key: _joined(samples, instants=one_after_another) for key, samples in pieces.items()},
        left_out=tuple(f"{name}: {words}" for name, torques in recordings.items() for words in torques.left_out),
    )


def _joined(
    pieces: Sequence[TorqueSamples], *, instants: Callable[[Sequence[FloatArray]], FloatArray] = np.concatenate
) -> TorqueSamples:
    return TorqueSamples(
        from_model=np.concatenate([samples.from_model for samples in pieces]),
        from_logged=np.concatenate([samples.from_logged for samples in pieces]),
        time_s=instants([samples.time_s for samples in pieces]),
        logged_time_s=instants([samples.logged_time_s for samples in pieces]),
    )


def _over(
    free: FreeSubModel, interval: Interval, scheme: TorqueScheme, candidates: Sequence[JudgedCandidate]
) -> Iterator[tuple[TorqueKey, TorqueSamples]]:
    """Errors of every candidate, offset and joint over one interval, after its first second."""
    run, instants, sensor = free.run, free.run.instants(interval), free.run.sensor.name
    model, maps = _model(run, interval, scheme)
    own = [run.measured(interval, candidate.correction) - model.expected_of(sensor) for candidate in candidates]
    measured = free.measured(scheme.sensors[1:], interval)
    others = {name: wrench - model.expected_of(name) for name, wrench in measured.items()}
    logged = _logged(run, interval, scheme.logged)
    time = seconds_since(instants.judged_ns, run.experiment.recording.start_ns)
    for offset in KNOWN_BEFORE:
        by_others = np.zeros((len(instants.at_ns), len(scheme.joints)))
        for name, error in others.items():
            by_others += _borne(scheme, maps[name], instants.with_offset(error, offset))
        for candidate, error in enumerate(own):
            borne = by_others + _borne(scheme, maps[sensor], instants.with_offset(error, offset))
            for joint, torque in zip(scheme.joints, borne.T, strict=True):
                off = torque + model.torque(joint) - logged[joint] if joint in logged else None
                yield (
                    TorqueKey(candidate=candidate, offset=offset, joint=joint),
                    TorqueSamples(
                        from_model=instants.judged(torque[:, None])[:, 0],
                        from_logged=np.empty(0) if off is None else instants.judged(off[:, None])[:, 0],
                        time_s=time,
                        logged_time_s=np.empty(0) if off is None else time,
                    ),
                )


def _gaps(
    interval: Interval, candidates: Sequence[JudgedCandidate], over: Mapping[TorqueKey, TorqueSamples]
) -> Iterator[str]:
    """Torques that gaps leave out in one interval, in words."""
    by_offset: dict[tuple[str, int], dict[Offset, FloatArray]] = {}
    for key, samples in over.items():
        by_offset.setdefault((key.joint, key.candidate), {})[key.offset] = samples.from_model
    for (joint, candidate), judged in by_offset.items():
        words = gap_words(f"torque of {joint} by {candidates[candidate].name}", interval, judged)
        if words is not None:
            yield words


def _model(run: SensorRun, interval: Interval, scheme: TorqueScheme) -> tuple[Estimates, dict[str, TorqueMap]]:
    """What the model expects, and how the torques depend on each sensor."""
    joints, root = run.motion(interval, scheme.motion)
    maps = {
        name: torque_map(scheme.tree, joints, name, cut_at=scheme.cut_at, contact=scheme.contact)
        for name in scheme.sensors
    }
    return estimate(scheme.question, joints, root), maps


def _logged(run: SensorRun, interval: Interval, joints: Sequence[str]) -> dict[str, FloatArray]:
    signals, at_ns = run.experiment.recording.joint_signals("torque"), run.instants(interval).at_ns
    torques = {}
    for joint in joints:
        stream, signal = signals[joint]
        require_overlap(run.stream, stream)
        torques[joint] = interpolate(stream, signal.column(joint)[:, None], at_ns)[:, 0]
    return torques


def _borne(scheme: TorqueScheme, map_of: TorqueMap, error: FloatArray) -> FloatArray:
    """Torques of the judged joints by the error of one sensor; shape (n, joints)."""
    torques = dict(zip(map_of.joints, map_of.torques(error).T, strict=True))
    none = np.zeros(len(error))
    return np.stack([torques.get(joint, none) for joint in scheme.joints], axis=1)
