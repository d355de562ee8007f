# SPDX-License-Identifier: BSD-3-Clause
"""Soles and their centre of pressure; centre of mass and its acceleration as of an inverted pendulum (5.22)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    array,
    check_arrays,
    read_only,
    require_last_axis,
)
from forcetorque.base.errors import EstimationError, ShapeError
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import transform_wrench, wrench_matrix
from forcetorque.locomotion.standing.support_phases import stretches
from forcetorque.robot.contacts import Contact
from forcetorque.robot.dynamics import body_poses
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureCentres(ArrayRecord):
    """Centres of pressure of n samples on the plane z = 0 of a frame; NaN where too little presses."""

    points: FloatArray = field(metadata=array("n", 2))
    """Along x and y from the frame's origin; shape (n, 2); m."""
    covariance: FloatArray | None = field(default=None, metadata=array("n", 2, 2))
    """Covariance of their errors; shape (n, 2, 2); m2; None where that of the wrench is not known."""

    @property
    def known(self) -> BoolArray:
        """Whether there is a point; shape (n,)."""
        return np.all(np.isfinite(self.points), axis=1)


def centre_of_pressure(
    ground_wrench: Any, *, least_load_N: float, covariance: FloatArray | None = None
) -> PressureCentres:
    """Find the centre of pressure on the plane z = 0 of a frame.

    About the point the moment of the force along the plane vanishes: `x = -ty / fz`, `y = tx / fz` [1]. The plane may
    be tilted, and the robot accelerate: neither enters. An error of the wrench goes to the point by the first
    derivative, as `(-dty - x dfz) / fz` and `(dtx - y dfz) / fz`, which holds while `fz` is many times its own error.

    Args:
        ground_wrench: What the ground does to the robot, in and about the frame, z away from the ground; shape (n, 6);
            N, N m.
        least_load_N: Force along z below which there is no point; N.
        covariance: Covariance of the wrench; shape (n, 6, 6); None where it is not known.

    Returns:
        The points; NaN where less than `least_load_N` presses.

    Raises:
        EstimationError: If the least load is not positive: without pressure there is no centre of it.
        ShapeError: If shapes differ.

    References:
        [1] Thesis (5.21), which is printed as moment over force, component by component; in that form it is wrong.
    """
    wrench = np.asarray(ground_wrench, dtype=np.float64)
    require_last_axis(wrench, name="ground_wrench", length=6)
    if not 0.0 < least_load_N < np.inf:
        raise EstimationError(f"least_load_N: expected a positive force in N, got {least_load_N:g}")
    pressed = np.where(wrench[:, 2] >= least_load_N, wrench[:, 2], np.nan)
    points = np.stack([-wrench[:, 4], wrench[:, 3]], axis=1) / pressed[:, None]
    if covariance is None:
        return PressureCentres(points=points)
    if covariance.shape != (len(wrench), 6, 6):
        raise ShapeError(f"covariance: expected shape ({len(wrench)}, 6, 6), got {covariance.shape}")
    derivative = np.zeros((len(wrench), 2, 6))
    derivative[:, 0, 4], derivative[:, 1, 3] = -1.0, 1.0
    derivative[:, :, 2] = -points
    derivative /= pressed[:, None, None]
    return PressureCentres(points=points, covariance=derivative @ covariance @ derivative.swapaxes(1, 2))


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaneTolerance:
    """How far soles may be out of one plane and still count as coplanar."""

    height_m: float = 0.01
    """Height of one sole's origin over the plane of another; m."""
    tilt_rad: float = 0.05
    """Angle between their planes; rad."""


def coplanar(ground_H_soles: Sequence[FloatArray], down: BoolArray, tolerance: PlaneTolerance) -> BoolArray:
    """Find the samples in which all soles that are down lie in one plane, that of the ground's frame.

    Args:
        ground_H_soles: Poses of the soles in the frame of the ground, that of one of them; shape (n, 4, 4) each; m.
        down: Whether each is down; shape (n, soles).
        tolerance: How far they may be out of it.

    Returns:
        Whether they lie in it; shape (n,). A sole that is in the air may be anywhere.
    """
    level = np.ones(len(down), dtype=np.bool_)
    for pose, here in zip(ground_H_soles, down.T, strict=True):
        tilt = np.arctan2(np.linalg.norm(pose[:, :2, 2], axis=1), pose[:, 2, 2])
        level &= ~here | ((np.abs(pose[:, 2, 3]) <= tolerance.height_m) & (tilt <= tolerance.tilt_rad))
    return level


def wrench_on_ground(
    ground_H_soles: Sequence[FloatArray],
    wrenches: Sequence[FloatArray],
    covariances: Sequence[FloatArray | None],
    down: BoolArray,
) -> tuple[FloatArray, FloatArray | None]:
    """Add up what the ground does to all feet that are down.

    Args:
        ground_H_soles: Poses of the soles in the frame of the ground; shape (n, 4, 4) each; m.
        wrenches: What the ground does to each, in and about the frame of the sole; shape (n, 6) each; N, N m.
        covariances: Covariances of these, independent from sole to sole; shape (n, 6, 6) each; None where one is not
            known.
        down: Whether each is down; shape (n, soles).

    Returns:
        The sum in and about the frame of the ground, shape (n, 6), N, N m; and its covariance, shape (n, 6, 6), None
        where one is not known.
    """
    total = np.zeros((len(down), 6))
    spread: FloatArray | None = np.zeros((len(down), 6, 6))
    for pose, wrench, covariance, here in zip(ground_H_soles, wrenches, covariances, down.T, strict=True):
        total += np.where(here[:, None], transform_wrench(pose, wrench), 0.0)
        if covariance is None or spread is None:
            spread = None
            continue
        carried = wrench_matrix(pose)
        spread = spread + np.where(here[:, None, None], carried @ covariance @ carried.swapaxes(1, 2), 0.0)
    return total, spread


_FEWEST_CORNERS = 3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sole(ArrayRecord):
    """A flat sole: the plane z = 0 of its frame, z away from the ground."""

    frame: str
    """Link of the robot whose axes it has."""
    position: FloatArray = field(default_factory=lambda: np.zeros(3), metadata=array(3))
    """Origin of the sole in that frame, a point of its plane; shape (3,); m."""
    outline: FloatArray | None = field(default=None, metadata=array(None, 2))
    """Corners of the sole along x and y from its origin; shape (k, 2); m; None where its extent is unknown.
    The ground presses, so the centre of pressure lies in the smallest convex shape around them."""
    friction: float | None = None
    """Force along the ground over the normal force up to which the sole holds; None where it is not stated."""
    torsional_friction_m: float | None = None
    """Torsion about the normal over the normal force up to which it holds; m; None where it is not stated."""
    edges: FloatArray = field(init=False)
    """Outward unit normals of that shape and their offsets, `normal . point + offset` being positive outside; shape
    (e, 3); 1, 1, m."""

    def __post_init__(self) -> None:
        check_arrays(self)
        edges = np.empty((0, 3)) if self.outline is None else _convex_edges(self.frame, self.outline)
        object.__setattr__(self, "edges", read_only(edges, name="edges", shape=(None, 3)))
        for name in ("friction", "torsional_friction_m"):
            value = getattr(self, name)
            if value is not None and not 0.0 < value < np.inf:
                raise EstimationError(f"sole {self.frame!r}: {name}: expected a number above 0, got {value:g}")

    @property
    def has_friction(self) -> bool:
        """Whether a friction is stated."""
        return self.friction is not None or self.torsional_friction_m is not None

    @property
    def contact(self) -> Contact:
        """The whole wrench of the ground, in and about the frame of the sole."""
        return Contact.at_point(self.frame, self.position)

    def beyond(self, points: FloatArray) -> FloatArray:
        """Compute how far points lie outside the sole.

        Args:
            points: Points of its plane; shape (n, 2); m.

        Returns:
            Largest distance to an edge, from the inside outwards: positive outside; shape (n,); m. NaN for points that
            are, and where the outline is not known.
        """
        require_last_axis(points, name="points", length=2)
        if not len(self.edges):
            return np.full(len(points), np.nan)
        return (points @ self.edges[:, :2].T + self.edges[:, 2]).max(axis=1)


def _convex_edges(frame: str, outline: FloatArray) -> FloatArray:
    from scipy.spatial import ConvexHull, QhullError  # here because importing it takes longer than most commands

    if len(outline) >= _FEWEST_CORNERS and np.isfinite(outline).all():
        try:
            return np.asarray(ConvexHull(outline).equations, dtype=np.float64)
        except QhullError:
            pass
    raise EstimationError(
        f"sole {frame!r}: outline: expected at least {_FEWEST_CORNERS} corners x, y in m that span an area, got "
        f"{len(outline)}: {np.round(outline, 6).tolist()}"
    )


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
class ComAcceleration(ArrayRecord):
    """Acceleration of the centre of mass along the ground; NaN where the height does not stay in its band."""

    acceleration: FloatArray = field(metadata=array("n", 2))
    """Along x and y of the ground's frame; shape (n, 2); m/s2."""
    half_width_95: FloatArray | None = field(metadata=array("n", 2))
    """Half of its 95 % interval; shape (n, 2); m/s2; None where the covariance of the wrench is not known."""


def stays_in_band(height_m: FloatArray, time_s: FloatArray, *, band_m: float) -> BoolArray:
    """Find the samples in which the height of the centre of mass stays within a band around its median.

    Args:
        height_m: Height over the ground; NaN where it is not known; shape (n,); m.
        time_s: Instants; shape (n,); s.
        band_m: How far it may be from the median; m.

    Returns:
        Samples of segments of `STAY_S` at least in which it never leaves the band; shape (n,).

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
