# SPDX-License-Identifier: BSD-3-Clause
"""Centre of mass of a robot, and its acceleration from the centre of pressure as of an inverted pendulum (5.22)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.base.errors import EstimationError
from forcetorque.base.units import NORMAL_95
from forcetorque.locomotion.standing.pressure import PressureCentres
from forcetorque.locomotion.standing.support_phases import stretches
from forcetorque.robot.kinematics import body_poses
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree


def mass_of(tree: BodyTree) -> float:
    """Add up the masses of a robot.

    Args:
        tree: The robot.

    Returns:
        Its mass; kg.
    """
    return float(sum(body.inertia.mass for body in tree.bodies))


def centre_of_mass(tree: BodyTree, joints: JointMotion) -> FloatArray:
    """Find the centre of mass.

    Args:
        tree: The robot, rooted at the link in which it is wanted.
        joints: Positions of at least the joints that carry a mass; n samples.

    Returns:
        Its position in the root link's frame; shape (n, 3); m; NaN where a joint is not known.

    Raises:
        EstimationError: If the robot has no mass.
    """
    mass = mass_of(tree)
    if not mass > 0.0:
        raise EstimationError("centre of mass: expected a robot with mass, got none; its links lack <inertial>")
    heavy = [index for index, body in enumerate(tree.bodies) if body.inertia.mass or body.inertia.first_moment.any()]
    poses = body_poses(tree, joints, heavy)
    moment = np.zeros((len(joints), 3))
    for index in heavy:
        inertia = tree.bodies[index].inertia
        moment += poses[index][:, :3, :3] @ inertia.first_moment + inertia.mass * poses[index][:, :3, 3]
    return moment / mass


STAY_S: Final = 1.0
"""How long the height has to stay in its band: who passes through it at speed is not at constant height; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ComAcceleration:
    """Acceleration of the centre of mass along the ground; NaN where the height does not stay in its band."""

    acceleration: FloatArray
    """Along x and y of the ground's frame; shape (n, 2); m/s2."""
    half_width_95: FloatArray | None
    """Half of its 95 % interval; shape (n, 2); m/s2; None where the covariance of the wrench is not known."""

    def __post_init__(self) -> None:
        shape = (len(self.acceleration), 2)
        object.__setattr__(self, "acceleration", read_only(self.acceleration, name="acceleration", shape=shape))
        if self.half_width_95 is not None:
            object.__setattr__(self, "half_width_95", read_only(self.half_width_95, name="half_width_95", shape=shape))


def stays_in_band(height_m: FloatArray, time_s: FloatArray, *, band_m: float) -> BoolArray:
    """Tell when the height of the centre of mass stays within a band around its median.

    Args:
        height_m: Height over the ground; NaN where it is not known; shape (n,); m.
        time_s: Instants; shape (n,); s.
        band_m: How far it may be from the median; m.

    Returns:
        Samples of stretches of `STAY_S` at least in which it never leaves the band; shape (n,).

    Raises:
        EstimationError: If the band has no width, or no height is known.
    """
    if not 0.0 < band_m < np.inf:
        raise EstimationError(f"height band: expected a positive height in m, got {band_m:g}")
    known = np.isfinite(height_m)
    if not known.any():
        raise EstimationError("height band: expected a height of the centre of mass, got none that is known")
    inside: BoolArray = np.abs(height_m - np.median(height_m[known])) <= band_m
    for stretch in stretches(inside):
        if time_s[stretch.stop - 1] - time_s[stretch.start] < STAY_S:
            inside[stretch] = False
    return inside


def pendulum_acceleration(com: FloatArray, point: FloatArray, gravity: FloatArray) -> FloatArray:
    """Give the acceleration of a centre of mass at constant height over a point on the ground, by (5.22).

    `(com - point) g / height` along a level ground, and on a tilted one with the part of gravity along it besides.

    Args:
        com: Centre of mass in the ground's frame, z away from the ground; shape (n, 3); m.
        point: Centre of pressure, or zero moment point, on the ground; shape (n, 2); m.
        gravity: Acceleration of free fall in the ground's frame; shape (3,); m/s2.

    Returns:
        Acceleration along x and y; shape (n, 2); m/s2.
    """
    rate = -gravity[2] / com[:, 2]
    return (com[:, :2] - point) * rate[:, None] + gravity[:2]


def com_acceleration(
    com: FloatArray, pressure: PressureCentres, gravity: FloatArray, *, inside: BoolArray, neglected: FloatArray
) -> ComAcceleration:
    """Give the acceleration of the centre of mass by (5.22), with what sensors and the pendulum leave open.

    The interval adds two sources that have nothing to do with each other: the error of the centre of pressure, and what
    a pendulum neglects, heights that accelerate and momenta that turn. Of the latter the root mean square counts, about
    zero. Errors of the masses, which shift the centre of mass, come on top.

    Args:
        com: Centre of mass in the ground's frame; shape (n, 3); m.
        pressure: Centre of pressure of the robot on the ground; n samples.
        gravity: Acceleration of free fall in the ground's frame; shape (3,); m/s2.
        inside: Samples whose height stays in its band (`stays_in_band`); shape (n,).
        neglected: What the motion of the robot says that (5.22) is off by; shape (n, 2); m/s2; NaN in gaps.

    Returns:
        The acceleration; NaN outside the band.

    Raises:
        EstimationError: If no height stays in the band.
    """
    if not inside.any():
        raise EstimationError(
            f"acceleration of the centre of mass: its height never stays in its band for {STAY_S:g} s, and "
            "(5.22) holds for a height that does not change; state a wider band, or use the acceleration of the joints"
        )
    acceleration = np.where(inside[:, None], pendulum_acceleration(com, pressure.points, gravity), np.nan)
    half = None
    if pressure.covariance is not None:
        of_point = np.einsum("nii->ni", pressure.covariance) * (gravity[2] / com[:, 2])[:, None] ** 2
        off = np.nanmean(np.where(inside[:, None], neglected, np.nan) ** 2, axis=0)
        half = np.where(inside[:, None], NORMAL_95 * np.sqrt(of_point + off), np.nan)
    return ComAcceleration(acceleration=acceleration, half_width_95=half)
