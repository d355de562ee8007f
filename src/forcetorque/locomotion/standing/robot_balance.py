# SPDX-License-Identifier: BSD-3-Clause
"""Centre of pressure, zero moment point and centre of mass of a robot, on the plane of one of its soles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import EstimationError
from forcetorque.locomotion.standing.centre_of_mass import (
    ComAcceleration,
    com_acceleration,
    mass_of,
    pendulum_acceleration,
    stays_in_band,
)
from forcetorque.locomotion.standing.interval import BalanceOptions, FootPressure, RobotBalance
from forcetorque.locomotion.standing.pressure import PressureCentres, centre_of_pressure, coplanar, wrench_on_ground
from forcetorque.locomotion.standing.robot_on_soles import BalanceScene
from forcetorque.locomotion.standing.support_phases import SupportPhases


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Motion:
    """What the joints say of the whole robot, in the ground's frame."""

    zero_moment_point: FloatArray
    """Shape (n, 2); m."""
    com: FloatArray
    """Centre of mass; shape (n, 3); m."""
    acceleration: FloatArray | None
    """Of the centre of mass along the ground; shape (n, 2); m/s2; None where the ground is not known to rest."""


def robot_balance(
    scene: BalanceScene, feet: Sequence[FootPressure], phases: SupportPhases, options: BalanceOptions
) -> tuple[RobotBalance, list[str]]:
    """Put together what presses on all feet, and what the motion of the robot demands.

    Args:
        scene: The robot over the interval.
        feet: What presses on each foot, in the order of the scene's soles.
        phases: Which feet are down.
        options: Tolerance of the plane, least load, and height band.

    Returns:
        The balance of the robot, and what cannot be told of it, in words.
    """
    refused = []
    poses = [scene.ground_H_sole(foot.sole) for foot in feet]
    flat = coplanar(poses, phases.down, options.plane)
    if not flat.all():
        refused.append(_not_coplanar(scene, float(np.mean(~flat)), options))
    total, spread = wrench_on_ground(
        poses, [foot.wrench for foot in feet], [foot.covariance for foot in feet], phases.down
    )
    total = np.where((flat & phases.known)[:, None], total, np.nan)
    least_N = options.least_load_N(scene.weight_N)
    pressure = centre_of_pressure(total, least_load_N=least_N, covariance=spread)
    motion = _motion(scene, least_N) if not scene.missing else None
    if scene.missing:
        refused.append(
            f"centre of mass and zero moment point: the log has no position of {', '.join(scene.missing)}, which carry "
            "a mass; log them, or take them as fixed joints of the model"
        )
    borne: BoolArray = np.any(phases.down, axis=1)  # what hangs presses nowhere
    pendulum = None
    if options.height_band_m is not None and motion is not None:
        try:
            pendulum = _pendulum(scene, motion, pressure, options.height_band_m)
        except EstimationError as error:
            refused.append(str(error))
    robot = RobotBalance(
        frame=scene.ground.frame,
        pressure=pressure,
        zero_moment_point=None if motion is None else np.where(borne[:, None], motion.zero_moment_point, np.nan),
        com=None if motion is None else motion.com,
        com_acceleration=pendulum,
        com_acceleration_of_joints=None if motion is None else motion.acceleration,
    )
    return robot, refused


def _motion(scene: BalanceScene, least_N: float) -> _Motion:
    demanded, com = scene.demanded_wrench(), scene.centre_of_mass()
    gravity = scene.gravity
    return _Motion(
        zero_moment_point=centre_of_pressure(demanded, least_load_N=least_N).points,
        com=com,
        acceleration=None if gravity is None else demanded[:, :2] / mass_of(scene.tree) + gravity[:2],
    )


def _pendulum(scene: BalanceScene, motion: _Motion, pressure: PressureCentres, height_band_m: float) -> ComAcceleration:
    gravity = scene.gravity
    if gravity is None or motion.acceleration is None:
        raise EstimationError(
            f"acceleration of the centre of mass: (5.22) takes a ground that is known to rest, and no support with "
            f"gravity_direction is the sole {scene.ground.frame!r} in the interval {scene.interval.label!r}"
        )
    inside = stays_in_band(motion.com[:, 2], scene.time_s, band_m=height_band_m)
    neglected = motion.acceleration - pendulum_acceleration(motion.com, motion.zero_moment_point, gravity)
    return com_acceleration(motion.com, pressure, gravity, inside=inside, neglected=neglected)


def _not_coplanar(scene: BalanceScene, share: float, options: BalanceOptions) -> str:
    return (
        f"centre of pressure of the robot: in {share:.1%} of the samples of {scene.interval.label!r} soles that are "
        f"down are out of the plane of {scene.ground.frame!r} by more than {1e3 * options.plane.height_m:g} mm or "
        f"{np.degrees(options.plane.tilt_rad):.2g} deg; points on two planes have no common one"
    )
