# SPDX-License-Identifier: BSD-3-Clause
"""Orientations in the forms that logs have, gravity that follows from them, and wrenches in another frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, require_shape
from forcetorque.base.errors import FormatError, RecordingError, UnitError
from forcetorque.base.pose import make_pose
from forcetorque.base.units import STANDARD_GRAVITY, si_factor
from forcetorque.base.wrench import transform_wrench
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

LARGEST_DEFECT = 0.01
"""By how much the norm of a quaternion, or a product of rows of a rotation matrix, may be off, as rounding to two
decimals makes it; the nearest rotation is taken."""

ONE_TURN = 2.0 * np.pi
"""rad; larger angles are unwrapped, or degrees."""


class OrientationForm(StrEnum):
    """How a log writes an orientation."""

    QUAT_XYZW = "quat_xyzw"
    """Unit quaternion, its scalar last."""
    QUAT_WXYZ = "quat_wxyz"
    """Unit quaternion, its scalar first."""
    MATRIX_ROWS = "matrix_rows"
    """Rotation matrix, row after row."""
    MATRIX_COLUMNS = "matrix_columns"
    """Rotation matrix, column after column."""
    EULER = "euler"
    """Three angles, about axes that are specified."""
    ROTATION_VECTOR = "rotation_vector"
    """Axis of the rotation, as long as its angle, as Universal Robots write it."""


class OrientationSense(StrEnum):
    """What the rotation R of a log does."""

    SENSOR_TO_WORLD = "sensor_to_world"
    """`v_world = R v_sensor`: the columns of R are the sensor's axes in the world."""
    WORLD_TO_SENSOR = "world_to_sensor"
    """`v_sensor = R v_world`: the columns of R are the world's axes in the sensor."""


class EulerAxes(StrEnum):
    """About which axes three rotations follow each other."""

    MOVING = "moving"
    """Each about an axis that the ones before have rotated (intrinsic)."""
    FIXED = "fixed"
    """All about axes that do not move (extrinsic)."""


_COUNTS = {
    OrientationForm.QUAT_XYZW: 4,
    OrientationForm.QUAT_WXYZ: 4,
    OrientationForm.MATRIX_ROWS: 9,
    OrientationForm.MATRIX_COLUMNS: 9,
    OrientationForm.EULER: 3,
    OrientationForm.ROTATION_VECTOR: 3,
}


def _turns_about(axes: str) -> bool:
    return len(axes) == 3 and set(axes) <= set("xyz") and axes[0] != axes[1] != axes[2]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OrientationLayout(ArrayRecord):
    """What the numbers of a log mean for the orientation of a frame."""

    form: OrientationForm
    """How an orientation is written."""
    sense: OrientationSense
    """What the rotation does."""
    axes: str | None = None
    """Of Euler angles the axes in the order of the angles, such as `zyx`."""
    about: EulerAxes | None = None
    """Of Euler angles whether the axes move."""
    gravity_direction: FloatArray = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]), metadata=array(3))
    """Direction in which things fall, along the world's axes; shape (3,)."""
    gravity: float = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""

    def __post_init__(self) -> None:
        check_arrays(self)
        direction = self.gravity_direction
        length = float(np.linalg.norm(direction))
        if not (np.isfinite(length) and length > 0.0 and np.isfinite(self.gravity) and self.gravity > 0.0):
            raise FormatError(
                f"orientation: expected a gravity_direction that is not zero and a gravity above 0 m/s2, "
                f"got {direction.tolist()} and {self.gravity:g}"
            )
        euler = self.form is OrientationForm.EULER
        if euler != (self.axes is not None) or euler != (self.about is not None):
            wanted = "axes and about, moving or fixed" if euler else "neither axes nor about, which are for euler"
            raise FormatError(f"orientation: {self.form}: expected {wanted}; got {self.axes!r} and {self.about!r}")
        if self.axes is not None and not _turns_about(self.axes):
            raise FormatError(
                f'orientation: axes: expected three of x, y, z, no two alike in a row, such as "zyx", got {self.axes!r}'
            )

    @property
    def count(self) -> int:
        """Numbers per orientation."""
        return _COUNTS[self.form]

    @property
    def unit(self) -> str:
        """SI unit of the numbers."""
        return "rad" if self.count == 3 else "1"

    @property
    def world_gravity(self) -> FloatArray:
        """Gravity along the world's axes; shape (3,); m/s2."""
        return self.gravity * self.gravity_direction / np.linalg.norm(self.gravity_direction)


QUATERNION_XYZW = OrientationLayout(form=OrientationForm.QUAT_XYZW, sense=OrientationSense.SENSOR_TO_WORLD)
"""The scalar last, as ROS and Eigen write quaternions."""
ROLL_PITCH_YAW = OrientationLayout(
    form=OrientationForm.EULER, sense=OrientationSense.SENSOR_TO_WORLD, axes="xyz", about=EulerAxes.FIXED
)
"""`R = Rz(yaw) Ry(pitch) Rx(roll)`, as YARP and URDF define it."""


def orientation_signals(
    numbers: Any,
    layout: OrientationLayout,
    *,
    unit: str,
    frame: str,
    stream: str,
    place: Callable[[int], str] | None = None,
) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    """Turn logged orientations into the signals `orientation` and `gravity` of a stream.

    Args:
        numbers: Orientations; shape (n, `layout.count`); in `unit`; a row of NaN where one is missing.
        layout: What they mean.
        unit: Unit of the numbers: rad or deg for angles, else 1.
        frame: Name of the frame whose orientation it is.
        stream: Name of the stream, for findings.
        place: Gives where in the file a row is, for messages; `row 1` for the first one if left out.

    Returns:
        The two signals by their quantities, and findings.

    Raises:
        UnitError: If the unit is none of such numbers.
        FormatError: If there are not as many numbers as the form has, or a row is half missing, no unit quaternion, no
            rotation matrix, or one that mirrors.
    """
    si_unit, factor = si_factor(unit)
    if si_unit != layout.unit:
        raise UnitError(f"orientation: {layout.form}: expected a unit that converts to {layout.unit}, got {unit!r}")
    values = factor * np.asarray(numbers, dtype=np.float64)
    require_shape(values, name="orientation", shape=(None, None))
    if values.shape[1] != layout.count:
        raise FormatError(
            f"orientation: {layout.form}: expected {layout.count} numbers for each, got {values.shape[1]}"
        )
    where = place or (lambda row: f"row {row + 1}")
    missing = np.isnan(values).any(axis=1)
    for row in np.flatnonzero(missing & ~np.isnan(values).all(axis=1))[:1]:
        raise FormatError(
            f"{where(int(row))}: orientation: expected {layout.count} numbers, or none where it is missing, got "
            f"{np.count_nonzero(~np.isnan(values[row]))}"
        )
    known = np.flatnonzero(~missing)
    world_R_sensor = np.full((len(values), 3, 3), np.nan)
    if len(known):
        world_R_sensor[known] = _rotations(values[known], layout, lambda row: where(int(known[row])))
    return _signals(world_R_sensor, layout.world_gravity, frame), tuple(_angle_findings(values[known], unit, stream))


def _rotations(values: FloatArray, layout: OrientationLayout, where: Callable[[int], str]) -> FloatArray:
    """Rotations from the sensor's axes to the world's; shape (n, 3, 3)."""
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    if layout.form is OrientationForm.EULER:
        _require_angles(values, where)
        axes = layout.axes or ""
        rotation = Rotation.from_euler(axes.upper() if layout.about is EulerAxes.MOVING else axes, values)
    elif layout.form is OrientationForm.ROTATION_VECTOR:
        _require_angles(values, where)
        rotation = Rotation.from_rotvec(values)
    elif layout.count == 4:
        _require_unit(values, where)
        xyzw = np.roll(values, -1, axis=1) if layout.form is OrientationForm.QUAT_WXYZ else values
        rotation = Rotation.from_quat(xyzw)
    else:
        matrices = values.reshape(-1, 3, 3)
        if layout.form is OrientationForm.MATRIX_COLUMNS:
            matrices = matrices.transpose(0, 2, 1)
        _require_rotations(matrices, where)
        rotation = Rotation.from_matrix(matrices)  # the nearest rotation
    matrix: FloatArray = rotation.as_matrix()
    return matrix if layout.sense is OrientationSense.SENSOR_TO_WORLD else matrix.transpose(0, 2, 1)


def _require_angles(angles: FloatArray, where: Callable[[int], str]) -> None:
    for row in np.flatnonzero(~np.isfinite(angles).all(axis=1))[:1]:
        raise FormatError(f"{where(int(row))}: orientation: expected three angles, got {angles[row].tolist()}")


def _require_unit(quaternions: FloatArray, where: Callable[[int], str]) -> None:
    norm = np.linalg.norm(quaternions, axis=1)
    for row in np.flatnonzero(~(np.abs(norm - 1.0) <= LARGEST_DEFECT))[:1]:
        raise FormatError(
            f"{where(int(row))}: orientation: expected a quaternion of norm 1, got one of {norm[row]:.4g}; check its "
            "columns"
        )


def _require_rotations(matrices: FloatArray, where: Callable[[int], str]) -> None:
    defect = np.abs(matrices @ matrices.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    for row in np.flatnonzero(~(defect <= LARGEST_DEFECT))[:1]:
        raise FormatError(
            f"{where(int(row))}: orientation: expected a rotation matrix, of rows of length 1 at right angles, got one "
            f"that is off by {defect[row]:.3g}; check its columns"
        )
    for row in np.flatnonzero(np.linalg.det(matrices) < 0.0)[:1]:
        raise FormatError(
            f"{where(int(row))}: orientation: expected a rotation matrix, got one that mirrors, of determinant -1; "
            "check the sign of one axis"
        )


def _signals(world_R_sensor: FloatArray, world_gravity: FloatArray, frame: str) -> dict[str, Signal]:
    along_sensor = np.einsum("nji,j->ni", world_R_sensor, world_gravity)
    values = {"orientation": world_R_sensor.reshape(-1, 9), "gravity": along_sensor}
    return {quantity: Signal.of_fixed(quantity, samples, frame=frame) for quantity, samples in values.items()}


def _angle_findings(values: FloatArray, unit: str, stream: str) -> list[Finding]:
    """Angles in rad that turn more than once round: unwrapped, or degrees by another name."""
    turns = np.abs(values).max(axis=1, initial=0.0) > ONE_TURN
    if unit != "rad" or not turns.any():
        return []
    largest = float(np.abs(values).max())
    text = (
        f"angles of an orientation that are specified in rad reach {largest:.4g}, more than one turn; "
        'where they are degrees, specify units = ["deg", "deg", "deg"]'
    )
    count = int(np.count_nonzero(turns))
    return [Finding(stream=stream, kind="euler_units", message=text, count=count, size=largest, unit="rad")]


def wrench_in_frame(stream: Stream, to: str, to_H_own: Any) -> Stream:
    """Move the wrench of a stream into a frame.

    Force and moment are rotated; the moment is moved to the origin of the frame by the translation of the pose.

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
            f"stream {stream.name!r}: expected a wrench in another frame than {to!r}; specify in its frame the one "
            "along whose axes the log has it, or leave [[transform]] out"
        )
    moved = replace(signal, values=transform_wrench(to_H_own, signal.values), frame=to)
    return replace(stream, signals={**stream.signals, "wrench": moved})


def orientation_at(stream: Stream, orientation: Stream, to: str) -> FloatArray:
    """Give the pose of the world in a frame at the samples of a stream, its rotation only.

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
            f"its world; specify where {to!r} is as x, y, z of the quantity translation, in m, or, where the moment is "
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
