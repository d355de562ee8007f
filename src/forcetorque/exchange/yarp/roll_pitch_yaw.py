# SPDX-License-Identifier: BSD-3-Clause
"""Orientations as YARP has them: roll, pitch and yaw in deg, `v_world = Rz(yaw) Ry(pitch) Rx(roll) v_sensor` [1].

References:
    [1] YARP, src/libYARP_dev/src/yarp/dev/MultipleAnalogSensorsInterfaces.h, IOrientationSensors.
"""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.recording import Signal

ANGLES = ("roll", "pitch", "yaw")
"""Names of the numbers, of which `recording.ROLL_PITCH_YAW` says what they mean."""


def angles_of(orientation: Signal) -> FloatArray:
    """Give the angles of rotation matrices, as sensors send them.

    Args:
        orientation: The orientation of a stream.

    Returns:
        Roll, pitch and yaw; shape (n, 3); deg; NaN where there is none.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    matrices = orientation.values.reshape(-1, 3, 3)
    known = np.isfinite(matrices).all(axis=(1, 2))
    angles = np.full((len(matrices), 3), np.nan)
    if known.any():
        angles[known] = Rotation.from_matrix(matrices[known]).as_euler("xyz", degrees=True)
    return angles
