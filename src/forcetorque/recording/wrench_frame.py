# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches that a log gives along the axes of another frame than the sensor's, such as the base of the robot."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.pose import make_pose
from forcetorque.base.wrench import transform_wrench
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.recording.stream import Stream


def wrench_in_frame(stream: Stream, to: str, to_H_own: Any) -> Stream:
    """Move the wrench of a stream into a frame.

    Force and moment are turned; the moment is moved to the origin of the frame by what the pose says of the origins.

    Args:
        stream: Stream with a wrench.
        to: Name of the frame.
        to_H_own: Pose of the frame in which the wrench is given, in the other; shape (4, 4), or (n, 4, 4) for every
            sample; m. With a position of zero the moment is about the same point as before.

    Returns:
        The stream; NaN where the pose is.

    Raises:
        RecordingError: If the stream has no wrench, or has it in that frame.
    """
    signal = stream.signal("wrench")
    if signal.frame == to:
        raise RecordingError(
            f"stream {stream.name!r}: expected a wrench in another frame than {to!r}; state in its frame the one along "
            "whose axes the log has it, or leave [[transform]] out"
        )
    moved = replace(signal, values=transform_wrench(to_H_own, signal.values), frame=to)
    return replace(stream, signals={**stream.signals, "wrench": moved})


def orientation_at(stream: Stream, orientation: Stream, to: str) -> FloatArray:
    """Give the pose of the world in a frame at the samples of a stream, as far as it is turned.

    Args:
        stream: The stream.
        orientation: Stream with the orientation of the frame, on the same clock.
        to: Name of the frame.

    Returns:
        `to_H_world` without a position; shape (n, 4, 4); NaN where no orientation is known.

    Raises:
        RecordingError: If the orientation is of another frame, or the streams do not overlap.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    world_R_to = _interpolated(stream, orientation, "orientation", to).reshape(-1, 3, 3)
    known = np.isfinite(world_R_to).all(axis=(1, 2))
    if known.any():
        world_R_to[known] = Rotation.from_matrix(world_R_to[known]).as_matrix()  # between two rotations lies none
    return make_pose(world_R_to.transpose(0, 2, 1), np.zeros(3))


def pose_at(stream: Stream, pose: Stream, to: str) -> FloatArray:
    """Give the pose of the world in a frame at the samples of a stream.

    Args:
        stream: The stream.
        pose: Stream with the orientation and the translation of the frame, on the same clock.
        to: Name of the frame.

    Returns:
        `to_H_world`; shape (n, 4, 4); m; NaN where the pose is not known.

    Raises:
        RecordingError: If the pose is of another frame or lacks something, or the streams do not overlap.
    """
    if "translation" not in pose.signals:
        raise RecordingError(
            f"stream {pose.name!r}: expected a translation beside the orientation: the moment is about the origin of "
            f"its world; state where {to!r} is as x, y, z of the quantity translation, in m, or, where the moment is "
            'about a point that moves with the sensor, moment_about = "point" with point_m'
        )
    to_H_world = orientation_at(stream, pose, to)
    place = _interpolated(stream, pose, "translation", to)
    to_H_world[:, :3, 3] = -np.einsum("nij,nj->ni", to_H_world[:, :3, :3], place)
    return to_H_world


def _interpolated(stream: Stream, source: Stream, quantity: str, frame: str) -> FloatArray:
    signal = source.signal(quantity)
    if signal.frame != frame:
        raise RecordingError(
            f"stream {source.name!r}: expected the {quantity} of {frame!r}, got that of {signal.frame!r}"
        )
    require_overlap(stream, source)
    return interpolate(source, signal.values, stream.stamp_ns)
