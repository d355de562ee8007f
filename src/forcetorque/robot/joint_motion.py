# SPDX-License-Identifier: BSD-3-Clause
"""Motion of named joints at given instants, from whatever streams hold them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError, known_names
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording
from forcetorque.recording.smoothing import SavitzkyGolay, smooth_columns
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.motion import JointMotion


def joint_motion_at(
    recording: Recording,
    joints: Sequence[str],
    at_ns: IntArray,
    *,
    window: SavitzkyGolay,
    logged_derivatives: bool = False,
) -> JointMotion:
    """Give positions, velocities and accelerations of joints at given instants.

    Args:
        recording: Streams that hold the joints, on the clock of `at_ns`.
        joints: Names of the joints.
        at_ns: Instants; shape (n,); ns.
        window: Filter that differentiates the logged positions on their own clock.
        logged_derivatives: Whether velocities and accelerations are taken from the log instead.

    Returns:
        The motion; shape (n, j) each; NaN where a stream has a gap.

    Raises:
        RecordingError: If a joint is in no stream, or the log lacks derivatives that are to be taken from it.
    """
    motion: dict[str, FloatArray] = {}
    for derivative, quantity in enumerate(("position", "velocity", "acceleration")):
        source = quantity if logged_derivatives else "position"
        motion[quantity] = np.empty((len(at_ns), len(joints)))
        for stream, signal, columns in _holders(recording, joints, source):
            values = signal.values[:, [signal.columns.index(joints[k]) for k in columns]]
            if derivative and not logged_derivatives:
                values = smooth_columns(stream.stamp_ns, values, window, derivative=derivative)
            motion[quantity][:, columns] = interpolate(stream, values, at_ns)
    return JointMotion(names=tuple(joints), **motion)


def _holders(recording: Recording, joints: Sequence[str], source: str) -> list[tuple[Stream, Signal, list[int]]]:
    """Streams that hold joints, with the places of these joints among all."""
    signals = recording.joint_signals(source)
    for joint in joints:
        if joint not in signals:
            hint, still = "; take derivatives from the positions instead", ""
            if source == "position":
                hint = ""
                still = (
                    "; if it stood still all along, state where in fixed of [robot], among arrays repeat its position"
                )
            raise RecordingError(
                f"no stream holds the {source} of joint {joint!r}{hint}; {known_names(joint, signals)}{still}"
            )
    places: dict[str, list[int]] = {}
    for k, joint in enumerate(joints):
        places.setdefault(signals[joint][0].name, []).append(k)
    return [(*signals[joints[columns[0]]], columns) for columns in places.values()]
