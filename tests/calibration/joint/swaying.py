# SPDX-License-Identifier: BSD-3-Clause
"""A humanoid that sways with both feet on the ground, its six sensors, and what is wrong with their matrices."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import invert_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import transform_wrench
from forcetorque.calibration.joint.result import ContactSpanRow
from forcetorque.calibration.joint.robust_fit import JointResult
from forcetorque.calibration.joint.unknowns import UNITS
from forcetorque.calibration.joint.window_nodes import Stretch
from forcetorque.robot.contacts import Contact
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.robot.mechanics.simulated import Simulation
from tests.scenes.robots import icub

SENSORS = ("l_leg_ft", "r_leg_ft", "l_foot_ft", "r_foot_ft", "l_arm_ft", "r_arm_ft")
FEET = ("l_sole", "r_sole")
ROOT = "root_link"
RATE_HZ = 100.0


@cache
def model() -> RobotModel:
    """The robot as its file describes it."""
    return read_urdf(icub("iCubGazeboV2_7"))


@dataclass(frozen=True, kw_only=True)
class Swaying:
    """One specimen in one motion."""

    stretch: Stretch
    """What is known of it."""
    true: dict[str, FloatArray]
    """True wrenches; N, N m."""
    change: dict[str, FloatArray]
    """What the wrenches by the prior matrices are truly to be multiplied by."""
    offset: dict[str, FloatArray]
    """Their true offsets; N, N m."""

    def error(self, sensor: str, change: FloatArray, offset: FloatArray) -> FloatArray:
        """Root mean square error of force and moment in this motion; shape (2,); N, N m."""
        error = self.stretch.readings[sensor] @ change.T + offset - self.true[sensor]
        return np.sqrt([(error[:, part] ** 2).sum(axis=1).mean() for part in (slice(3), slice(3, 6))])

    def prior_error(self, sensor: str) -> FloatArray:
        """The same by the prior matrix with its best offset."""
        readings = self.stretch.readings[sensor]
        return self.error(sensor, np.eye(6), (self.true[sensor] - readings).mean(axis=0))


def swaying(
    seed: int,
    *,
    sensor_seed: int | None = None,
    duration_s: float = 20.0,
    noise: float = 0.05,
    mass: float = 0.0,
    centre_m: float = 0.0,
    joint_zero_rad: float = 0.0,
    acceleration: float = 0.0,
    error: float = 0.04,
    touches: dict[str, FloatArray] | None = None,
) -> Swaying:
    """Sway.

    Args:
        seed: Seed of the motion.
        sensor_seed: Seed of sensors and model; that of the motion if None.
        duration_s: How long; s.
        noise: White noise of readings, in `UNITS`.
        mass: Standard deviation of every link's true mass, relative.
        centre_m: That of its centre of mass; m.
        joint_zero_rad: That of the zero of every joint; rad.
        acceleration: That of the bias of the accelerometer; m/s2.
        error: Standard deviation of the entries of the true changes, in `UNITS`.
        touches: Wrenches on links that nobody knows of; shape (n, 6); N, N m.

    Returns:
        The specimen: what is known of it is by the nominal model.
    """
    rng, drawn = np.random.default_rng(seed), np.random.default_rng(seed if sensor_seed is None else sensor_seed)
    time = np.arange(0.0, duration_s, 1.0 / RATE_HZ)
    joints, root = _motion(rng, time)
    zeros = joint_zero_rad * drawn.normal(size=len(joints.names))
    moved = JointMotion(
        names=joints.names,
        position=joints.position + zeros,
        velocity=joints.velocity,
        acceleration=joints.acceleration,
    )
    robot = Simulation(model=_disturbed(drawn, mass, centre_m), root_link=ROOT, joints=moved, root=root)
    for link, wrench in (touches or {}).items():
        robot.touch(Contact(link=link), wrench)
    _stand(rng, robot, time, touches or {})
    true = {name: robot.reading(name) for name in SENSORS}
    change = {name: np.eye(6) + error * drawn.normal(size=(6, 6)) * UNITS[:, None] / UNITS for name in SENSORS}
    offset = {name: 10.0 * drawn.normal(size=6) * UNITS for name in SENSORS}
    readings = {
        name: (true[name] - offset[name]) @ np.linalg.inv(change[name]).T
        + noise * UNITS * rng.normal(size=(len(time), 6))
        for name in SENSORS
    }
    bias = acceleration * drawn.normal(size=3)
    return Swaying(
        stretch=Stretch(
            label=f"sway {seed}",
            recording=f"sway {seed}",
            session="day",
            time_s=time,
            tree=build_tree(model(), ROOT),
            joints=joints,
            root=RootMotion(
                proper_acceleration=root.proper_acceleration + bias,
                angular_velocity=root.angular_velocity,
                angular_acceleration=root.angular_acceleration,
            ),
            readings=readings,
            touched=FEET,
        ),
        true=true,
        change=change,
        offset=offset,
    )


def _smooth(rng: np.random.Generator, time: FloatArray, count: int, size: float) -> tuple[FloatArray, ...]:
    """Sums of three slow sines each, with their first and second derivatives; shape (n, count)."""
    turn, phase = 2.0 * np.pi * rng.uniform(0.1, 0.5, (count, 3)), rng.uniform(0.0, 2.0 * np.pi, (count, 3))
    height = 0.5 * size * rng.normal(size=(count, 3))
    angle = turn * time[:, None, None] + phase
    return (
        (height * np.sin(angle)).sum(axis=2),
        (height * turn * np.cos(angle)).sum(axis=2),
        (-height * turn**2 * np.sin(angle)).sum(axis=2),
    )


def _motion(rng: np.random.Generator, time: FloatArray) -> tuple[JointMotion, RootMotion]:
    """All joints move, and the root tilts and is pushed about; the feet need not stay where they are for the maths."""
    names = tuple(joint.name for joint in model().joints.values() if joint.type.moves)
    joints = JointMotion(
        **dict(zip(("position", "velocity", "acceleration"), _smooth(rng, time, len(names), 0.3), strict=True)),
        names=names,
    )
    tilt, velocity, acceleration = _smooth(rng, time, 3, 0.15)
    upright = Rotation.from_rotvec(tilt).as_matrix().transpose(0, 2, 1)
    return joints, RootMotion(
        proper_acceleration=STANDARD_GRAVITY * upright[:, :, 2] + _smooth(rng, time, 3, 0.3)[0],
        angular_velocity=velocity,
        angular_acceleration=acceleration,
    )


def _stand(rng: np.random.Generator, robot: Simulation, time: FloatArray, touches: dict[str, FloatArray]) -> None:
    """Let one foot bear what it likes, and the other what is left."""
    left, right = (robot.links[foot].pose for foot in FEET)
    on_left = _smooth(rng, time, 6, 1.0)[0] * [20.0, 20.0, 80.0, 5.0, 5.0, 2.0] + [0.0, 0.0, 160.0, 0.0, 0.0, 0.0]
    robot.touch(Contact(link="l_sole"), on_left)
    rest = robot.total_needed() - transform_wrench(left, on_left)
    for link, wrench in touches.items():
        rest -= transform_wrench(robot.links[link].pose, wrench)
    robot.touch(Contact(link="r_sole"), transform_wrench(invert_pose(right), rest))


def _disturbed(rng: np.random.Generator, mass: float, centre_m: float) -> RobotModel:
    """The robot that is built, not that of the file."""
    links = {}
    for name, inertia in model().links.items():
        scale = 1.0 + mass * float(rng.normal())
        shift = centre_m * rng.normal(size=3)
        links[name] = Inertia(
            mass=inertia.mass * scale,
            first_moment=(inertia.first_moment + inertia.mass * shift) * scale,
            second_moment=inertia.second_moment * scale,
        )
    return RobotModel(name=model().name, links=links, joints=model().joints, sensors=model().sensors)


def touches(result: JointResult) -> list[ContactSpanRow]:
    """List the spans that a fit left out."""
    return [span for one in result.residuals for span in ContactSpanRow.all_of(one)]
