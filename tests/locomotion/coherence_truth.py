# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the net contact force of a simulated robot, from planted matrix errors and true wrenches alone."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.robot.model import RobotModel
from forcetorque.simulation.motions.movement import Movement

GROUND = ("l_sole", "r_sole")


def net_force_errors(
    movement: Movement,
    model: RobotModel,
    seconds: FloatArray,
    errors: Mapping[str, FloatArray],
    offset_s: FloatArray,
    *,
    heading: str,
    feet: Mapping[str, str],
    weight: float,
) -> FloatArray:
    """What the feet that touch, as sensors read them, bear beyond the weight; (n, 3); z up, x that of a link, level.

    The forces of the world on all links, which are true, and what each sensor reads of its foot beyond the truth:
    `E (w - mean w)`, as biases went with the offset, which was taken at `offset_s`.
    """
    true = movement.external_wrenches(seconds)
    total = np.zeros((len(seconds), 3))
    for link in true.names:
        total += np.einsum("nij,nj->ni", movement.base_pose(seconds, link)[:, :3, :3], true.of_name(link)[:, :3])
    for sensor, foot in feet.items():
        if not np.any(true.of_name(foot)):
            continue
        wrench = movement.readings(seconds, [sensor]).of_name(sensor)
        mean = movement.readings(offset_s, [sensor]).of_name(sensor).mean(axis=0)
        error = ((wrench - mean) @ errors[sensor].T)[:, :3]
        link = model.joints[model.sensors[sensor].joint].child
        turned = np.einsum("nij,nj->ni", movement.base_pose(seconds, link)[:, :3, :3], error)
        read = np.einsum("nij,nj->ni", movement.base_pose(seconds, link)[:, :3, :3], wrench[:, :3])
        # what a foot bears pushes the robot up: by that the sign of the reading is known
        total += np.sign(read[:, 2].mean()) * turned
    x = movement.base_pose(seconds, heading)[:, :3, 0] * [1.0, 1.0, 0.0]
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    z = np.broadcast_to([0.0, 0.0, 1.0], x.shape)
    upright = np.stack([x, np.cross(z, x), z], axis=1)
    net: FloatArray = np.einsum("nij,nj->ni", upright, total) - [0.0, 0.0, weight]
    return net


def stamps_in(stamp_ns: IntArray, start_ns: int, end_ns: int) -> IntArray:
    """Stamps of a stretch."""
    return stamp_ns[(stamp_ns >= start_ns) & (stamp_ns < end_ns)]
