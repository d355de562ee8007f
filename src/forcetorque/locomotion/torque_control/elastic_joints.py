# SPDX-License-Identifier: BSD-3-Clause
"""The linear robot with springs between motors and joints."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.locomotion.torque_control.balancing import Reference
from forcetorque.locomotion.torque_control.closed_loop import LoopSetting
from forcetorque.locomotion.torque_control.linear_robot import LinearRobot, linear_robot
from forcetorque.locomotion.torque_control.stability import LinearPlant
from forcetorque.locomotion.torque_control.world import Biped

DAMPING_S = 0.002
"""Damping of a spring over its stiffness; s."""


def massless_drives(biped: Biped, setting: LoopSetting, reference: Reference, k: int) -> LinearRobot:
    """Make the links linear about a posture, driven by joint torques: rotors and their friction are left out.

    Args:
        biped: The robot.
        setting: Drives, gains, balancing, rates.
        reference: The motion.
        k: Instant of the posture.

    Returns:
        What `with_springs` takes; `setting` is the one that was handed in.
    """
    bare = replace(setting, drive=replace(setting.drive, rotor_inertia=0.0, viscous=0.0))
    return replace(linear_robot(biped, bare, reference, k), setting=setting)


def with_springs(links: LinearRobot, stiffness: FloatArray) -> LinearRobot:
    """Put springs between motors and joints; rotors and viscous friction are on the motors' side.

        torque = K (motor - joint) + D (motor rate - joint rate),   J d2 motor/dt2 = drive - viscous rate - torque

    Encoders of the balancing controller are on the joints, the speed that back-EMF takes is that of the motor.

    Args:
        links: From `massless_drives`.
        stiffness: K of every joint; shape (12,); N m/rad.

    Returns:
        The robot; states are the ways z, their rates, positions and rates of motors, torques of drives.
    """
    drive, plant = links.setting.drive, links.plant
    joints = len(stiffness)
    n = (len(plant.a) - joints) // 2
    spring, damper = np.diag(stiffness), DAMPING_S * np.diag(stiffness)
    turned, one = plant.velocity[:, n : 2 * n], np.eye(joints)
    torque = np.hstack([-spring @ turned, -damper @ turned, spring, damper, np.zeros((joints, joints))])

    def rows(matrix: FloatArray) -> FloatArray:
        """What a matrix of ways, rates and joint torques does to the states."""
        return np.pad(matrix[:, : 2 * n], ((0, 0), (0, 3 * joints))) + matrix[:, 2 * n :] @ torque

    _, rate, drives = np.split(np.eye(torque.shape[1])[2 * n :], 3)
    a = np.vstack(
        [
            rows(plant.a[: 2 * n]),
            rate,
            (drives - drive.viscous * rate - torque) / drive.rotor_inertia,
            -drives / drive.lag_s,
        ]
    )
    elastic = LinearPlant(
        a=a,
        b=np.vstack([np.zeros((2 * n + 2 * joints, joints)), drive.torque_per_duty / drive.lag_s * one]),
        c=torque,
        d=np.zeros((joints, joints)),
        velocity=rate,
        demand=rows(plant.demand),
    )
    return replace(links, plant=elastic, wrenches=rows(links.wrenches))
