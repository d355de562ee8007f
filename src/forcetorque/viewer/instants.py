# SPDX-License-Identifier: BSD-3-Clause
"""The instants that are shown, and where the joints are at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.recording.alignment import interpolate, require_overlap, usable_samples
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Stream
from forcetorque.robot.model import RobotModel
from forcetorque.skin.experiment import PATCHES

_NAMES = 4
"""So many joints are listed in a note."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Posture:
    """Joint coordinates at the instants of a stream."""

    stream: Stream
    """The stream."""
    stamp_ns: IntArray
    """Its stamps inside the time that the joints were logged; shape (n,); ns."""
    names: tuple[str, ...]
    """Joints."""
    position: FloatArray
    """Coordinates, held over gaps; shape (n, d); rad or m."""
    notes: tuple[str, ...]
    """What is missing."""


def shown_stream(experiment: Experiment, sensors: Sequence[ExperimentSensor]) -> Stream:
    """Choose the stream whose instants are shown.

    Args:
        experiment: The experiment.
        sensors: Sensors that are shown.

    Returns:
        The stream of the first of them; without any that of the first patch, else of contacts that a skinManager saw.

    Raises:
        ExperimentError: If there is neither sensor nor skin.
    """
    recording = experiment.recording
    if sensors:
        return recording.stream(sensors[0].stream)
    skin = experiment.section(PATCHES)
    patches = () if skin is None else skin.patches
    events = (name for name, stream in recording.streams.items() if "skin_event" in stream.signals)
    name = next(chain((patch.counts for patch in patches), events), None)
    if name is None:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected [[sensor]], [[patch]] or a stream of skin_events to be shown, "
            "got none"
        )
    return recording.stream(name)


def posture_at(recording: Recording, model: RobotModel, stream: Stream) -> Posture:
    """Take the instants of a stream and find the joints at them.

    All of the log is taken, also outside intervals, from the first to the last instant at which every joint
    is known that can be.

    Args:
        recording: The recording.
        model: The robot.
        stream: Stream whose stamps are the instants.

    Returns:
        The joints; none where no stream holds any.

    Raises:
        RecordingError: If the stream has no sample.
    """
    stamps = stream.stamp_ns[usable_samples(stream.stamp_ns)]
    if not len(stamps):
        raise RecordingError(f"stream {stream.name!r}: expected samples to show, got none")
    notes: list[str] = []
    holders = _alignable(recording, model, stream, notes)
    for holder in dict.fromkeys(holders.values()):
        known = recording.stream(holder).stamp_ns
        stamps = stamps[(stamps >= known.min()) & (stamps <= known.max())]
    if not len(stamps):
        raise RecordingError(f"stream {stream.name!r}: expected samples while all joints were logged, got none")
    names = tuple(holders)
    position = np.empty((len(stamps), len(names)))
    for holder in dict.fromkeys(holders.values()):
        columns = [k for k, name in enumerate(names) if holders[name] == holder]
        source = recording.stream(holder)
        signal = source.signal("position")
        values = signal.values[:, [signal.columns.index(names[k]) for k in columns]]
        held, gaps = _held(interpolate(source, values, stamps))
        position[:, columns] = held
        if gaps:
            notes.append(f"stream {holder!r}: {gaps} sample(s) in gaps show the last posture before")
    notes += _unlogged(model, names)
    return Posture(stream=stream, stamp_ns=stamps, names=names, position=position, notes=tuple(notes))


def _alignable(recording: Recording, model: RobotModel, stream: Stream, notes: list[str]) -> dict[str, str]:
    """Streams by moving joint of the robot; those that cannot be aligned are noted and left out."""
    holders: dict[str, str] = {}
    refused: dict[str, str] = {}
    for joint, (source, _) in recording.joint_signals("position").items():
        if joint not in model.joints or not model.joints[joint].type.moves:
            continue
        try:
            require_overlap(stream, source)
        except RecordingError as error:
            refused[source.name] = str(error)
        else:
            if len(usable_samples(source.stamp_ns)) < 2:
                refused[source.name] = f"stream {source.name!r}: a single sample of the joints is no motion"
            else:
                holders[joint] = source.name
    notes += [f"joints of {name!r} are not shown: {reason}" for name, reason in refused.items()]
    return holders


def _unlogged(model: RobotModel, names: tuple[str, ...]) -> list[str]:
    moving = [joint for joint in model.joints.values() if joint.type.moves and joint.mimic is None]
    lacking = [joint.name for joint in moving if joint.name not in names]
    if not lacking:
        return []
    listed = ", ".join(lacking[:_NAMES]) + (", ..." if len(lacking) > _NAMES else "")
    return [f"no stream holds the position of {len(lacking)} joint(s), which are drawn at zero: {listed}"]


def _held(values: FloatArray) -> tuple[FloatArray, int]:
    """Fill rows with a NaN by the last complete one, those before the first by it; and count them."""
    complete = np.isfinite(values).all(axis=1)
    if complete.all():
        return values, 0
    if not complete.any():
        return np.zeros_like(values), len(values)
    latest = np.maximum.accumulate(np.where(complete, np.arange(len(values)), -1))
    return values[np.where(latest < 0, int(np.argmax(complete)), latest)], int(np.count_nonzero(~complete))
