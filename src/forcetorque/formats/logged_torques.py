# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of an arm, in whose log there is no wrench: those that hold what is beyond the flange."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, names

UNKNOWNS = ("mass", "centre of mass along x", "centre of mass along y", "centre of mass along z")
"""What the columns of `unit_torque` belong to."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedTorques(ArrayRecord):
    """What the format of a log fixes of torques without a wrench.

    At rest `torque + unit_torque (declared load) = unit_torque [m; m c] + bias`, with a bias of each joint.
    """

    controller: str
    """Kind of the controller, `franka`."""
    joints: tuple[str, ...] = field(metadata=names("d"))
    """Names of the joints."""
    stamp_ns: IntArray = field(metadata=array("n", dtype="int"))
    """Time since the controller started; shape (n,); ns."""
    position: FloatArray = field(metadata=array("n", "d"))
    """Angles; shape (n, d); rad."""
    is_still: BoolArray = field(metadata=array("n", dtype="bool"))
    """Where no joint moves; shape (n,)."""
    torque: FloatArray = field(metadata=array("n", "d"))
    """By which the arm holds what its controller does not know; shape (n, d); N m."""
    unit_torque: FloatArray = field(metadata=array("n", "d", 4))
    """By which it holds 1 kg at the origin of the flange, and a first moment of 1 kg m along each of its axes; shape
    (n, d, 4); N m."""
    declared_mass: FloatArray = field(metadata=array("n"))
    """Mass that the controller knows; shape (n,); kg."""
    declared_centre: FloatArray = field(metadata=array("n", 3))
    """Its centre along the axes of the flange from its origin; shape (n, 3); m."""
    undetermined: Mapping[str, str]
    """Keys of the table that neither log nor format determines, each with the question for it."""
    assumed: tuple[str, ...]
    """What is taken from the format and not from the log, in a few words each."""


def holding_torques(
    axes: FloatArray, joint_points: FloatArray, base_H_flange: FloatArray, gravity: FloatArray
) -> FloatArray:
    """Give the torques by which rotary joints hold a load at rest, per kg and per kg m.

    The torque about the axis z through p that holds a mass m at p_m against gravity g is `-z . ((p_m - p) x m g)`.

    Args:
        axes: Axes of the joints in the base; shape (n, d, 3).
        joint_points: A point on each axis; shape (n, d, 3); m.
        base_H_flange: Poses of the flange; shape (n, 4, 4); m.
        gravity: In the base, pointing down; shape (3,); m/s2.

    Returns:
        Of 1 kg at the origin of the flange, and of a first moment of 1 kg m along each of its axes; shape (n, d, 4);
        N m per kg, N m per kg m.
    """
    lever = base_H_flange[:, None, :3, 3] - joint_points
    of_mass = -np.einsum("ndk,ndk->nd", axes, np.cross(lever, gravity))
    turned = np.cross(base_H_flange[:, :3, :3].transpose(0, 2, 1), gravity)  # of each axis of the flange; (n, 3, 3)
    of_moment = -np.einsum("ndk,nak->nda", axes, turned)
    return np.concatenate([of_mass[:, :, None], of_moment], axis=2)
