# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stood over one interval, sample by sample."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.units import NORMAL_95
from forcetorque.formats.sample_table_writing import Column
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import (
    ComAcceleration,
    PlaneTolerance,
    PressureCentres,
    Sole,
)
from forcetorque.locomotion.standing.support_phases import (
    RELEASE_SHARE,
    TOUCH_SHARE,
    ContactThresholds,
    ForceLimit,
    SupportPhases,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class BalanceOptions:
    """What counts as a contact, as a point, and as a height that does not change."""

    touch: ForceLimit = ForceLimit(share=TOUCH_SHARE)
    """Force that a contact reaches."""
    release: ForceLimit = ForceLimit(share=RELEASE_SHARE)
    """Force above which it lasts."""
    dwell_s: float = 0.0
    """Shortest contact, and shortest pause, that counts; s."""
    least_load: ForceLimit | None = None
    """Load below which there is no centre of pressure; that of `touch` if None."""
    height_band_m: float | None = None
    """How far the centre of mass may be from its median height where (5.22) is requested; m; it is not if None."""
    plane: PlaneTolerance = PlaneTolerance()
    """How far soles may be out of one plane."""

    def thresholds(self, weight_N: float | None) -> ContactThresholds:
        """Settle the thresholds for a robot.

        Args:
            weight_N: Its weight; None where it is unknown; N.

        Returns:
            The thresholds.
        """
        contact_threshold_N, release_N = self.touch.newtons(weight_N), self.release.newtons(weight_N)
        return ContactThresholds(contact_threshold_N=contact_threshold_N, release_N=release_N, dwell_s=self.dwell_s)

    def least_load_N(self, weight_N: float | None) -> float:
        """Settle the load below which there is no point.

        Args:
            weight_N: Weight of the robot; None where it is unknown; N.

        Returns:
            The load; N.
        """
        return (self.touch if self.least_load is None else self.least_load).newtons(weight_N)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FootPressure:
    """What presses on one foot."""

    sole: Sole
    """The sole."""
    sensors: tuple[str, ...]
    """Sensors that measure it."""
    wrench: FloatArray
    """What the ground does to the foot, in and about the sole's frame; shape (n, 6); N, N m."""
    covariance: FloatArray | None
    """Covariance of its error; shape (n, 6, 6); None where that of the sensors is not specified."""
    pressure: PressureCentres
    """Centre of pressure on the sole."""
    reading_alone: FloatArray | None
    """The point that the sensor's reading gives as if it lay in the sole, without weight and inertia in between; shape
    (n, 2); m; None where several sensors bound the foot."""

    @property
    def beyond_m(self) -> FloatArray:
        """How far the point lies outside the outline, negative inside; shape (n,); m; NaN where none is known."""
        return self.sole.beyond(self.pressure.points)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobotBalance:
    """Centre of pressure and centre of mass of the robot, in the frame of one of its soles."""

    frame: str
    """That sole, whose plane is the ground."""
    pressure: PressureCentres
    """Centre of pressure of all feet that are down."""
    zero_moment_point: FloatArray | None = None
    """Where weight and inertia of the moving robot press, as its joints have it; shape (n, 2); m; NaN while no
    foot is down; None where joints that carry a mass were not logged."""
    com: FloatArray | None = None
    """Centre of mass; shape (n, 3); m."""
    com_acceleration: ComAcceleration | None = None
    """Its acceleration along the ground by (5.22); None where it was not asked for, or is refused."""
    com_acceleration_of_joints: FloatArray | None = None
    """The same as the joints' motion has it; shape (n, 2); m/s2."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalBalance:
    """How a robot stood over one interval; n samples."""

    recording: str
    """Name of the experiment."""
    label: str
    """Label of the interval."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    time_s: FloatArray
    """The same from the start of the recording; shape (n,); s."""
    weight_N: float | None
    """Weight of the robot; None where it is unknown."""
    forces: Mapping[str, FloatArray]
    """Force of the ground along the normal of each sole, by its frame; shape (n,) each; N."""
    net_N: FloatArray
    """Upward force of the ground on all feet together; shape (n,); N."""
    phases: SupportPhases
    """Which feet are down when."""
    feet: tuple[FootPressure, ...] = ()
    """What presses on each foot, where wrenches were measured."""
    robot: RobotBalance | None = None
    """Of the robot, where wrenches were measured."""
    refused: tuple[str, ...] = field(default=())
    """What cannot be determined, as text."""
    logged_net_N: FloatArray | None = None
    """Logged vertical forces of all feet together, beside a net force by the motion; shape (n,); N; None without."""

    @property
    def share(self) -> Mapping[str, FloatArray]:
        """Part of the load on all feet that each bears, by the frame of its sole; shape (n,) each; 1."""
        total = np.sum(list(self.forces.values()), axis=0)
        loaded = np.where(total > 0.0, total, np.nan)
        return {frame: force / loaded for frame, force in self.forces.items()}

    def column(self, name: str) -> FloatArray:
        """Give one number for every sample.

        Args:
            name: Such as `cop.robot.x` or `com.z`, as `columns` has them.

        Returns:
            Its values; shape (n,); NaN where there is none.

        Raises:
            KeyError: If there is none of that name.
        """
        return {key: values for key, _, values in self.columns()}[name]

    def columns(self) -> Iterator[Column]:
        """Give everything as numbers for every sample.

        Yields:
            `force.SOLE`, `share.SOLE`, `down.SOLE`, `net_force`; where wrenches were measured `cop.SOLE.x`,
            `beyond.SOLE`, `cop.robot.x` with `half_width.cop.robot.x`, `zmp.x`, `com.x`, `com_acceleration.x`.
        """
        down = self.phases.down.astype(np.float64)
        share = self.share
        for k, (frame, force) in enumerate(self.forces.items()):
            yield f"force.{frame}", "N", force
            yield f"share.{frame}", "1", share[frame]
            yield f"down.{frame}", "1", np.where(self.phases.known, down[:, k], np.nan)
        yield "net_force", "N", self.net_N
        if self.logged_net_N is not None:
            yield "logged_net_force", "N", self.logged_net_N
        for foot in self.feet:
            yield from _points(f"cop.{foot.sole.frame}", foot.pressure)
            if foot.sole.outline is not None:
                yield f"beyond.{foot.sole.frame}", "m", foot.beyond_m
        if self.robot is not None:
            yield from _of_robot(self.robot)


def _of_robot(robot: RobotBalance) -> Iterator[Column]:
    yield from _points("cop.robot", robot.pressure)
    if robot.zero_moment_point is not None:
        yield from _axes("zmp", "m", robot.zero_moment_point)
    if robot.com is not None:
        yield from _axes("com", "m", robot.com)
    pendulum = robot.com_acceleration
    if pendulum is not None:
        yield from _axes("com_acceleration", "m/s2", pendulum.acceleration)
        if pendulum.half_width_95 is not None:
            yield from _axes("half_width.com_acceleration", "m/s2", pendulum.half_width_95)
    if robot.com_acceleration_of_joints is not None:
        yield from _axes("com_acceleration_of_joints", "m/s2", robot.com_acceleration_of_joints)


def _points(name: str, pressure: PressureCentres) -> Iterator[Column]:
    yield from _axes(name, "m", pressure.points)
    if pressure.covariance is not None:
        yield from _axes(f"half_width.{name}", "m", half_widths(pressure.covariance))


def _axes(name: str, unit: str, values: FloatArray) -> Iterator[Column]:
    for axis, column in zip("xyz", values.T, strict=False):
        yield f"{name}.{axis}", unit, column


def half_widths(covariance: FloatArray) -> FloatArray:
    """Give half the 95 % intervals of points along either axis.

    Args:
        covariance: Covariances; shape (n, 2, 2); m2.

    Returns:
        Half-widths; shape (n, 2); m.
    """
    return NORMAL_95 * np.sqrt(np.maximum(np.einsum("nii->ni", covariance), 0.0))
