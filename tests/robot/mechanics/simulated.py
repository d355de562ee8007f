# SPDX-License-Identifier: BSD-3-Clause
"""A robot simulated link by link in the axes of its root link: neither lumped bodies nor a recursion of wrenches.

Every wrench is along the axes of the root link and about its origin, so that wrenches of different
links just add up. What passes a joint is the sum over the links on its far side of what they need to
move as they do, less what the world does to them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import cross
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.contacts import Contact
from forcetorque.robot.model import JointType, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion


@dataclass(frozen=True)
class Motion:
    """Where a link is in the root link and how it moves; vectors along the root link's axes, (n, 3)."""

    pose: FloatArray
    angular_velocity: FloatArray
    angular_acceleration: FloatArray
    proper_acceleration: FloatArray


@dataclass
class Simulation:
    """A robot in some samples."""

    model: RobotModel
    root_link: str
    joints: JointMotion
    root: RootMotion
    links: dict[str, Motion] = field(init=False)
    far_side: dict[str, set[str]] = field(init=False)
    on_links: dict[str, FloatArray] = field(init=False)
    needed: dict[str, FloatArray] = field(init=False)

    def __post_init__(self) -> None:
        n = len(self.joints)
        at_root = [
            np.array(np.broadcast_to(values, (n, 3)))
            for values in (self.root.angular_velocity, self.root.angular_acceleration, self.root.proper_acceleration)
        ]
        self.links = {self.root_link: Motion(np.broadcast_to(np.eye(4), (n, 4, 4)), *at_root)}
        self.far_side = {joint: set() for joint in self.model.joints}
        self.on_links = {link: np.zeros((n, 6)) for link in self.model.links}
        way: dict[str, tuple[str, ...]] = {self.root_link: ()}
        waiting = [self.root_link]
        while waiting:
            here = waiting.pop()
            for joint in way[here]:
                self.far_side[joint].add(here)
            for name, joint in self.model.joints.items():
                there = {joint.parent: joint.child, joint.child: joint.parent}.get(here)
                if there is not None and there not in self.links:
                    self.links[there] = self._across(name, here, downwards=there == joint.child)
                    way[there] = (*way[here], name)
                    waiting.append(there)
        self.needed = {link: self._needed(link) for link in self.links}

    def coordinate(self, joint: str) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Position, velocity and acceleration of a joint, or of what it mimics."""
        mimic = self.model.joints[joint].mimic
        if mimic is None:
            k = self.joints.names.index(joint)
            return self.joints.position[:, k], self.joints.velocity[:, k], self.joints.acceleration[:, k]
        q, dq, ddq = self.coordinate(mimic.leader)
        return mimic.multiplier * q + mimic.offset, mimic.multiplier * dq, mimic.multiplier * ddq

    def touch(self, contact: Contact, wrench: FloatArray) -> None:
        """Let the world do this to the robot, (n, 6), in and about the contact frame."""
        self.on_links[contact.link] += to_root(self.links[contact.link].pose @ contact.link_H_contact, wrench)

    def passing(self, joint: str) -> FloatArray:
        """What the near side of a joint does to the far side."""
        total = np.zeros((len(self.joints), 6))
        for link in self.far_side[joint]:
            total += self.needed[link] - self.on_links[link]
        return total

    def total_needed(self) -> FloatArray:
        """What the world must do to the whole robot."""
        return np.sum([self.needed[link] for link in self.model.links], axis=0)

    def parent_on_child(self, joint: str) -> FloatArray:
        """What the parent link's side of a joint does to the child link's."""
        child_is_far = self.model.joints[joint].child in self.far_side[joint]
        return self.passing(joint) if child_is_far else -self.passing(joint)

    def sensor_pose(self, sensor: str) -> FloatArray:
        """Pose of the frame in which a sensor reads."""
        tag = self.model.sensors[sensor]
        joint = self.model.joints[tag.joint]
        if tag.frame is SensorFrame.PARENT:
            return self.links[joint.parent].pose
        offset = tag.child_H_sensor if tag.frame is SensorFrame.SENSOR else np.eye(4)
        return self.links[joint.child].pose @ offset

    def reading(self, sensor: str) -> FloatArray:
        """What a sensor reads, in its frame and direction."""
        tag = self.model.sensors[sensor]
        sign = 1.0 if tag.direction is MeasureDirection.PARENT_TO_CHILD else -1.0
        return sign * from_root(self.sensor_pose(sensor), self.parent_on_child(tag.joint))

    def torque(self, joint: str) -> FloatArray:
        """What the motor of a joint does along its coordinate."""
        return self.along(joint, self.parent_on_child(joint))

    def along(self, joint: str, wrench: FloatArray) -> FloatArray:
        """Part of a wrench that works along the coordinate of a joint."""
        at_joint = from_root(self.links[self.model.joints[joint].child].pose, wrench)
        part = at_joint[:, :3] if self.model.joints[joint].type is JointType.PRISMATIC else at_joint[:, 3:]
        return part @ self.model.joints[joint].axis

    def net_wrench(self, link: str) -> FloatArray:
        """What moves a link as it moves, in and about its frame."""
        return from_root(self.links[link].pose, self.needed[link])

    def _needed(self, link: str) -> FloatArray:
        """What moves a link, by Newton's and Euler's laws about its centre of mass."""
        inertia, motion = self.model.links[link], self.links[link]
        if inertia.is_zero:
            return np.zeros((len(self.joints), 6))
        rotation, origin = motion.pose[:, :3, :3], motion.pose[:, :3, 3]
        centre = inertia.first_moment / inertia.mass if inertia.mass else np.zeros(3)
        about_centre = inertia.second_moment - inertia.mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        tensor = rotation @ about_centre @ rotation.transpose(0, 2, 1)
        omega, alpha = motion.angular_velocity, motion.angular_acceleration
        arm = rotation @ centre
        force = inertia.mass * (motion.proper_acceleration + cross(alpha, arm) + cross(omega, cross(omega, arm)))
        spin = np.einsum("nij,nj->ni", tensor, alpha) + cross(omega, np.einsum("nij,nj->ni", tensor, omega))
        return np.concatenate([force, spin + cross(origin + arm, force)], axis=1)

    def _across(self, name: str, here: str, *, downwards: bool) -> Motion:
        joint, near = self.model.joints[name], self.links[here]
        n = len(near.pose)
        moved, rates = np.broadcast_to(np.eye(4), (n, 4, 4)).copy(), (np.zeros(n), np.zeros(n))
        slides = joint.type is JointType.PRISMATIC
        if joint.type.moves:
            q, *rest = self.coordinate(name)
            rates = (rest[0], rest[1])
            if slides:
                moved[:, :3, 3] = q[:, None] * joint.axis
            else:
                moved[:, :3, :3] = Rotation.from_rotvec(q[:, None] * joint.axis).as_matrix()
        parent_H_child = joint.parent_H_child @ moved
        pose = near.pose @ (parent_H_child if downwards else np.linalg.inv(parent_H_child))
        axis = (pose if downwards else near.pose)[:, :3, :3] @ joint.axis
        sign = 1.0 if downwards else -1.0
        turning = 0.0 if slides or not joint.type.moves else sign
        omega = near.angular_velocity + turning * rates[0][:, None] * axis
        alpha = near.angular_acceleration + turning * (
            rates[1][:, None] * axis + rates[0][:, None] * cross(near.angular_velocity, axis)
        )
        # the points of both links on the joint's axis: relative motion is seen from the parent link
        of_parent = (near.angular_velocity, near.angular_acceleration) if downwards else (omega, alpha)
        arm = sign * (pose[:, :3, 3] - near.pose[:, :3, 3])  # from the parent link to the child link
        child_over_parent = cross(of_parent[1], arm) + cross(of_parent[0], cross(of_parent[0], arm))
        if slides:
            child_over_parent += rates[1][:, None] * axis + 2 * rates[0][:, None] * cross(of_parent[0], axis)
        return Motion(pose, omega, alpha, near.proper_acceleration + sign * child_over_parent)


def to_root(pose: FloatArray, wrench: FloatArray) -> FloatArray:
    """Express wrenches (n, 6) in frames at these poses (n, 4, 4) in the root link's."""
    force = np.einsum("nij,nj->ni", pose[:, :3, :3], wrench[:, :3])
    moment = np.einsum("nij,nj->ni", pose[:, :3, :3], wrench[:, 3:])
    return np.concatenate([force, moment + cross(pose[:, :3, 3], force)], axis=1)


def from_root(pose: FloatArray, wrench: FloatArray) -> FloatArray:
    """Express wrenches (n, 6) in the root link's frame in frames at these poses (n, 4, 4)."""
    about = wrench[:, 3:] - cross(pose[:, :3, 3], wrench[:, :3])
    force = np.einsum("nji,nj->ni", pose[:, :3, :3], wrench[:, :3])
    return np.concatenate([force, np.einsum("nji,nj->ni", pose[:, :3, :3], about)], axis=1)


def random_root(samples: int, seed: int) -> RootMotion:
    """Random motion of a root link, as quick as a shaken robot."""
    acceleration, velocity, turning = np.random.default_rng(seed).normal(size=(3, samples, 3))
    return RootMotion(
        proper_acceleration=10 * acceleration, angular_velocity=velocity, angular_acceleration=3 * turning
    )


def random_pose(rng: np.random.Generator, *, reach: float = 0.3) -> FloatArray:
    """Random pose within so many metres along each axis."""
    pose = np.eye(4)
    pose[:3, :3] = Rotation.random(random_state=rng).as_matrix()
    pose[:3, 3] = rng.uniform(-reach, reach, 3)
    return pose
