# SPDX-License-Identifier: BSD-3-Clause
"""What an error of one sensor's reading does to joint torques (thesis 2.4.3).

The robot is cut at its sensors, and on every sub-model one full wrench takes up whatever the equation
demands. So an error dw of a reading changes the contact wrenches of the two sub-models that the sensor
parts, by opposite amounts, and nothing else: it flows from one contact through the sensor to the
other. A joint on that way bears it, and its torque errs by

    d tau = +-<s, J_X_s dw>                                                                        (2.7)

with s the joint's motion subspace; all other torques stay as they are. The masses and the motion do
not enter, only the posture: a row of six numbers per joint and sample, the same for every candidate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_shape
from forcetorque.base.errors import RobotError, ShapeError, known_names
from forcetorque.base.noise.means import mean_error
from forcetorque.base.pose import invert_pose
from forcetorque.robot.kinematics import body_poses
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.sub_model import outboard_bodies, sub_models
from forcetorque.robot.tree import BodyTree, Connection


def joints_of_sensor(
    tree: BodyTree, sensor: str, *, cut_at: Sequence[str], contact: str | None = None
) -> dict[str, float]:
    """Find the joints whose estimated torque depends on what a sensor reads.

    Args:
        tree: The robot.
        sensor: One of the sensors that it is cut at.
        cut_at: Sensors that it is cut at.
        contact: Link on which the contact of its sub-model is taken to be; that of every other sub-model is at its
            base, so on the root link or just outboard of the sensor at the base.

    Returns:
        Joints in the order of the tree, with the sign of what they bear: 1 where the contact beyond the sensor is
        outboard of the joint, -1 where that on the sensor's inner side is.

    Raises:
        RobotError: If the tree has no such link, or is not cut at that sensor.
    """
    if contact is not None and contact not in tree.frames:
        raise RobotError(f"contact: no link {contact!r}; {known_names(contact, tree.frames)}")
    if sensor not in cut_at:
        raise RobotError(f"cut_at: expected the sensor {sensor!r} among the cuts, got {tuple(cut_at)}")
    touched = None if contact is None else tree.frames[contact][0]
    near = far = 0  # both sides of a cut are found
    for part in sub_models(tree, cut_at):
        at = touched if touched is not None and touched in part.bodies else part.base
        if part.sensor == sensor:
            far = at
        elif sensor in part.outboard_sensors:
            near = at
    signs = {}
    for index, body in enumerate(tree.bodies):
        outboard = outboard_bodies(tree, index)
        if body.joint is not None and outboard[far] != outboard[near]:
            signs[body.joint] = 1.0 if outboard[far] else -1.0
    return signs


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueMap:
    """Joint torques per unit of a sensor's reading, over n samples: the transposed Jacobian of the sensor."""

    sensor: str
    """Sensor."""
    joints: tuple[str, ...]
    """Joints whose torque depends on it."""
    rows: FloatArray
    """Torque per component of the reading, in its frame and direction; shape (n, joints, 6); m and 1, where prismatic
    1 and 1/m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "rows", read_only(self.rows, name="rows", shape=(None, len(self.joints), 6)))

    def torques(self, wrench: Any) -> FloatArray:
        """Give what a wrench in place of, or on top of, a reading adds to the torques.

        Args:
            wrench: Change of the reading, in its frame and direction; shape (n, 6); N, N m; NaN in gaps.

        Returns:
            Change of the torques along +q; shape (n, joints); N m, N where prismatic.
        """
        wrenches = np.asarray(wrench, dtype=np.float64)
        require_shape(wrenches, name="wrench", shape=(len(self.rows), 6))
        return np.einsum("nji,ni->nj", self.rows, wrenches)


def torque_map(
    tree: BodyTree, joints: JointMotion, sensor: str, *, cut_at: Sequence[str], contact: str | None = None
) -> TorqueMap:
    """Find how joint torques depend on the reading of a sensor.

    Args:
        tree: The robot.
        joints: Motion of at least the joints from the root to the sensor, and to the contact; n samples.
        sensor: One of the sensors that it is cut at.
        cut_at: Sensors that it is cut at.
        contact: Link on which the contact of its sub-model is taken to be, as in `joints_of_sensor`.

    Returns:
        The map of the joints that depend on it.
    """
    signs = joints_of_sensor(tree, sensor, cut_at=cut_at, contact=contact)
    cut = tree.cuts[sensor]
    rows = np.zeros((len(joints), len(signs), 6))
    moving = {index: body for index, body in enumerate(tree.bodies) if body.joint in signs}
    root_H_body = body_poses(tree, joints, (cut.body, *moving))
    root_H_sensor = root_H_body[cut.body] @ cut.body_H_sensor
    for column, (index, body) in enumerate(moving.items()):
        body_H_sensor = invert_pose(root_H_body[index]) @ root_H_sensor
        x, y, z = (body_H_sensor[:, axis, :3] for axis in range(3))  # rows of body_R_sensor
        if body.connection is Connection.PRISMATIC:
            rows[:, column, :3] = z
        else:  # moment about the body's z: z . R m + z . (p x R f)
            rows[:, column, :3] = body_H_sensor[:, 0, 3, None] * y - body_H_sensor[:, 1, 3, None] * x
            rows[:, column, 3:] = z
        rows[:, column] *= cut.sign * signs[str(body.joint)]
    return TorqueMap(sensor=sensor, joints=tuple(signs), rows=rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueErrors:
    """Statistics of n errors of one joint's torque, pooled before anything is averaged; N m, N where prismatic."""

    count: int
    """Number of samples."""
    rmse: float
    """Root mean square error."""
    rmse_error: float
    """Standard error of that root; NaN for one sample."""
    rmse_half_width: float
    """Half-width of its 95 % interval; infinite where it cannot be told."""
    mean: float
    """Mean error."""
    mean_error: float
    """Standard error of that mean; NaN for one sample."""
    mean_half_width: float
    """Half-width of its 95 % interval; infinite where it cannot be told."""
    largest: float
    """Largest absolute error."""


def torque_errors(errors: Any, time_s: Any) -> TorqueErrors:
    """Sum up the errors of one joint's torque.

    Args:
        errors: Errors in the order of time; shape (n,); samples with a gap (NaN) are left out.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Their statistics.

    Raises:
        ShapeError: If the shape is another, or every sample has a gap.
    """
    samples = np.asarray(errors, dtype=np.float64)
    require_shape(samples, name="errors", shape=(None,))
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name="time_s", shape=(len(samples),))
    complete = ~np.isnan(samples)
    whole = samples[complete]
    if not len(whole):
        raise ShapeError(f"errors: expected at least one sample without a gap, got none among {len(samples)}")
    square = float(np.mean(whole**2))
    rmse = float(np.sqrt(square))
    known = mean_error(np.column_stack([whole, whole**2]), time[complete])
    (error, square_error), (half, square_half) = known.standard_error, known.half_width
    slope = 0.5 / rmse if rmse > 0.0 else 0.0  # d sqrt(m) = dm / (2 sqrt(m))
    return TorqueErrors(
        count=len(whole),
        rmse=rmse,
        rmse_error=slope * float(square_error) if rmse > 0.0 else 0.0,
        rmse_half_width=slope * float(square_half) if rmse > 0.0 else 0.0,
        mean=float(whole.mean()),
        mean_error=float(error),
        mean_half_width=float(half),
        largest=float(np.abs(whole).max()),
    )
