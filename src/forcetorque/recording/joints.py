# SPDX-License-Identifier: BSD-3-Clause
"""Motion of named joints at given instants, from whatever streams hold them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import RecordingError, known_names
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording
from forcetorque.recording.smoothing import SavitzkyGolay, smooth
from forcetorque.robot import JointMotion


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
    quantities = ("position", "velocity", "acceleration")
    columns: dict[str, list[FloatArray]] = {quantity: [] for quantity in quantities}
    for derivative, quantity in enumerate(quantities):
        source = quantity if logged_derivatives else "position"
        signals = recording.joint_signals(source)
        for joint in joints:
            if joint not in signals:
                hint = "; take derivatives from the positions instead" if source != "position" else ""
                raise RecordingError(
                    f"no stream holds the {source} of joint {joint!r}{hint}; {known_names(joint, signals)}"
                )
            stream, signal = signals[joint]
            values = signal.column(joint)[:, None]
            if derivative and not logged_derivatives:
                values = smooth(stream.stamp_ns, values, window, derivative=derivative)
            columns[quantity].append(interpolate(stream, values, at_ns)[:, 0])
    stacked = {
        quantity: np.column_stack(found) if found else np.empty((len(at_ns), 0)) for quantity, found in columns.items()
    }
    return JointMotion(names=tuple(joints), **stacked)
