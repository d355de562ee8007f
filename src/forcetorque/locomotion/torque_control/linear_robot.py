# SPDX-License-Identifier: BSD-3-Clause
"""The balancing robot made linear about a posture, its joints stiff or elastic: duty cycles to torques and readings.

The feet that bear are bolted to the ground. States are the ways z that this leaves, their rates, and the torques of the
drives. Accelerations a and sensor wrenches w follow from positions, velocities, drive torques and contact wrenches by
the rigid-body dynamics alone (differences of both sides); contact wrenches follow from `J a = 0`. With errors E of the
sensors the estimate is `tau_est = tau + A(q) E w`, A being what the estimator makes of readings.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ControlError
from forcetorque.locomotion.torque_control.balancing_controller import Phase, Reference
from forcetorque.locomotion.torque_control.biped_in_mujoco import JOINTS, SENSORS, Biped, World
from forcetorque.locomotion.torque_control.closed_loop import LoopSetting, estimated_torques, moved, torque_question
from forcetorque.locomotion.torque_control.stability import GROWTH, LinearPlant, Onset, Stability, TorqueLoop, stability

_STEP: Final = 1e-5
"""Differences are taken over so much; rad, m, rad/s, N m, N. The error is its square, rounding 1e-11 of the torques."""
_ABOVE_M: Final = 1.0
"""The floor is out of reach: contacts are forces that are put on the soles."""
_DOFS, _READINGS = 18, 6 * len(SENSORS)
_FEET: Final = {Phase.DOUBLE: (0, 1), Phase.LEFT: (0,), Phase.RIGHT: (1,)}
_SCALES: Final = 40
"""Sizes of an error at which the loop is looked at before the first unstable one is found exactly."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearRobot:
    """The robot about one posture."""

    setting: LoopSetting
    """Drives, gains and rates."""
    plant: LinearPlant
    """What duty cycles do where sensors have no error."""
    wrenches: FloatArray
    """Sensor wrenches by states; shape (24, n)."""
    wrenches_at_rest: FloatArray
    """Sensor wrenches of the posture; shape (24,); N, N m."""
    estimator: FloatArray
    """A, joint torques by readings; shape (12, 24)."""
    estimator_slope: FloatArray
    """How A changes with the ways z; shape (ways, 12, 24)."""

    def loop(self, matrix: FloatArray) -> TorqueLoop:
        """Close the loop with errors of the sensors.

        Args:
            matrix: E of the four sensors; shape (4, 6, 6).

        Returns:
            The loop; the error is in its plant, so its own is to be 0.
        """
        whole = np.zeros((_READINGS, _READINGS))
        for k, block in enumerate(matrix):
            whole[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] = block
        c = self.plant.c + self.estimator @ whole @ self.wrenches
        ways = len(self.estimator_slope)
        c[:, :ways] += (self.estimator_slope @ (whole @ self.wrenches_at_rest)).T
        plant = replace(self.plant, c=c)
        # a reading is there after the step in which it was made
        delay = 1 + self.setting.delay_steps
        return TorqueLoop(
            plant=plant,
            gains=self.setting.gains,
            period_s=self.setting.period_s,
            delay_steps=delay,
            hold_steps=self.setting.hold_steps,
        )

    def stability(self, matrix: FloatArray) -> Stability:
        """Check whether the robot stands with errors of its sensors.

        Args:
            matrix: E of the four sensors; shape (4, 6, 6).

        Returns:
            The mode that grows fastest.
        """
        return stability(self.loop(matrix))

    def onset(self, matrix: FloatArray, *, largest: float) -> Onset | None:
        """Find from which size of an error on the robot oscillates or drifts away.

        Args:
            matrix: E of size 1 of the four sensors; shape (4, 6, 6).
            largest: Largest factor of it that is looked at.

        Returns:
            The smallest factor above which the loop is unstable; None if there is none up to the largest.

        Raises:
            ControlError: If the loop is unstable without any error.
        """
        from scipy.optimize import brentq  # here because importing it takes longer than most commands

        require_stable(self)
        scales = np.linspace(0.0, largest, _SCALES + 1)
        for low, high in zip(scales[:-1], scales[1:], strict=True):
            if not self.stability(high * matrix).stable:
                scale = brentq(lambda s: self.stability(s * matrix).growth - GROWTH, low, high, xtol=1e-3 * largest)
                return Onset(scale=float(scale), frequency_hz=self.stability(high * matrix).frequency_hz)
        return None


def require_stable(robot: LinearRobot) -> None:
    """Refuse gains that are unstable without any error of the sensors.

    Args:
        robot: The robot about a posture.

    Raises:
        ControlError: If it is unstable.
    """
    alone = robot.stability(np.zeros((len(SENSORS), 6, 6)))
    if not alone.stable:
        raise ControlError(
            f"gains: the loop is unstable without any sensor error: it grows by {alone.growth:.3g} 1/s at "
            f"{alone.frequency_hz:.3g} Hz; lower the gains of the torque controllers, the delay or the lag"
        )


def linear_robot(biped: Biped, setting: LoopSetting, reference: Reference, k: int) -> LinearRobot:
    """Make the robot linear about a posture in which it stands still.

    Args:
        biped: The robot.
        setting: Drives, gains, balancing, rates; Coulomb friction is left out, it has no linear part.
        reference: The motion.
        k: Instant of the posture.

    Returns:
        The robot about it.
    """
    bearing = _FEET[reference.phases[k]]
    jacobian, soles = _standing(biped, setting, reference, k, bearing)
    ways = _null_space(jacobian)
    n = ways.shape[1]
    zero = np.zeros((_DOFS, n))
    joints, pushes = len(JOINTS), 6 * len(bearing)
    # columns: ways, their rates, drive torques, contact wrenches
    sides = _Sides.of(
        tangent=np.hstack([ways, zero, np.zeros((_DOFS, joints + pushes))]),
        velocity=np.hstack([zero, ways, np.zeros((_DOFS, joints + pushes))]),
        torque=np.hstack([np.zeros((joints, 2 * n)), np.eye(joints), np.zeros((joints, pushes))]),
        contact=np.hstack([np.zeros((pushes, 2 * n + joints)), np.eye(pushes)]),
    )
    acceleration, wrenches, demand, at_rest = _slopes(biped, setting, reference, k, bearing, soles, sides)
    states = 2 * n + joints
    contact = -np.linalg.solve(jacobian @ acceleration[:, states:], jacobian @ acceleration[:, :states])
    by_state = acceleration[:, :states] + acceleration[:, states:] @ contact
    drive, rates = setting.drive, np.hstack([np.zeros((joints, n)), ways[6:], np.zeros((joints, joints))])
    plant = LinearPlant(
        a=np.vstack(
            [
                np.hstack([np.zeros((n, n)), np.eye(n), np.zeros((n, joints))]),
                ways.T @ by_state,
                np.hstack([np.zeros((joints, 2 * n)), -np.eye(joints) / drive.lag_s]),
            ]
        ),
        b=np.vstack([np.zeros((2 * n, joints)), drive.torque_per_duty / drive.lag_s * np.eye(joints)]),
        # what moves the rotor and what friction takes is no torque of the joint
        c=np.eye(states)[2 * n :] - drive.rotor_inertia * by_state[6:] - drive.viscous * rates,
        d=np.zeros((joints, joints)),
        velocity=rates,
        demand=demand[:, :states],
    )
    estimator, slope = _estimator(biped, reference.position[k], ways)
    return LinearRobot(
        setting=setting,
        plant=plant,
        wrenches=wrenches[:, :states] + wrenches[:, states:] @ contact,
        wrenches_at_rest=at_rest,
        estimator=estimator,
        estimator_slope=slope,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Sides:
    """Both sides of every direction in which differences are taken; one row each."""

    tangent: FloatArray
    velocity: FloatArray
    torque: FloatArray
    contact: FloatArray

    @classmethod
    def of(cls, **columns: FloatArray) -> _Sides:
        return cls(**{name: _STEP * np.concatenate([rows.T, -rows.T]) for name, rows in columns.items()})


def _standing(
    biped: Biped, setting: LoopSetting, reference: Reference, k: int, bearing: tuple[int, ...]
) -> tuple[FloatArray, FloatArray]:
    """Jacobian of the bearing soles, and what the ground does to all soles (2, 6)."""
    world = World(biped, replace(setting.drive, coulomb=0.0), copies=1, step_s=setting.period_s)
    world.place(_raised(reference.position[k][None]))
    posture = world.look(np.ones(1, dtype=bool))
    wrench = setting.balance.sole_wrenches(posture, reference, k)[0]
    return posture.sole_jacobian[0, list(bearing)].reshape(-1, _DOFS), wrench


def _slopes(
    biped: Biped,
    setting: LoopSetting,
    reference: Reference,
    k: int,
    bearing: tuple[int, ...],
    soles: FloatArray,
    sides: _Sides,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """What accelerations, wrenches and desired torques are per column; and the wrenches at rest."""
    copies = len(sides.tangent)
    world = World(biped, replace(setting.drive, coulomb=0.0), copies=copies + 1, step_s=setting.period_s)
    awake = np.ones(copies + 1, dtype=bool)
    tangent, velocity, torque = (
        np.vstack([rows, np.zeros_like(rows[:1])]) for rows in (sides.tangent, sides.velocity, sides.torque)
    )
    position = _raised(moved(np.tile(reference.position[k], (copies + 1, 1)), tangent))
    world.place(position, velocity)
    posture = world.look(awake)
    desired = setting.balance.desired(posture, reference, k)
    pushed = np.tile(soles, (copies + 1, 1, 1))
    pushed[:-1, list(bearing)] += sides.contact.reshape(copies, len(bearing), 6)
    acceleration, wrenches = world.advance(desired[-1] + torque, awake, soles=pushed)
    rows = (acceleration, wrenches.reshape(copies + 1, _READINGS), desired)
    slope_a, slope_w, slope_d = ((v[: copies // 2] - v[copies // 2 : -1]).T / (2.0 * _STEP) for v in rows)
    return slope_a, slope_w, slope_d, wrenches[-1].ravel()


def _estimator(biped: Biped, position: FloatArray, ways: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A (12, 24), and how it changes with the ways (ways, 12, 24)."""
    n, question = ways.shape[1], torque_question(biped)
    tangents = np.concatenate([np.zeros((1, _DOFS)), _STEP * ways.T, -_STEP * ways.T])
    units = np.concatenate([np.eye(_READINGS), np.zeros((1, _READINGS))])
    positions = np.repeat(moved(np.tile(position, (len(tangents), 1)), tangents), len(units), axis=0)
    still = np.zeros((len(positions), _DOFS))
    readings = np.tile(units, (len(tangents), 1)).reshape(-1, len(SENSORS), 6)
    torques = estimated_torques(question, positions, still, still, readings=readings)
    by_unit = torques.reshape(len(tangents), len(units), len(JOINTS))
    maps = np.swapaxes(by_unit[:, :-1] - by_unit[:, -1:], 1, 2)
    return maps[0], (maps[1 : n + 1] - maps[n + 1 :]) / (2.0 * _STEP)


def _null_space(jacobian: FloatArray) -> FloatArray:
    """Ways that leave the feet where they are, orthonormal; shape (18, n)."""
    _, sizes, rows = np.linalg.svd(jacobian)
    return rows[int((sizes > 1e-9 * sizes[0]).sum()) :].T


def _raised(position: FloatArray) -> FloatArray:
    return position + np.concatenate([[0.0, 0.0, _ABOVE_M], np.zeros(position.shape[1] - 3)])


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
