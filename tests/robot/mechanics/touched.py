# SPDX-License-Identifier: BSD-3-Clause
"""A humanoid that the world touches at known places with known wrenches, and what its sensors then read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.robot.urdf import read_urdf
from tests.robot.mechanics.simulated import Simulation, from_root, random_root, to_root
from tests.scenes.robots import icub, random_motion


@dataclass(frozen=True)
class Touched:
    """A robot in motion, what touches it, and its sensors' readings."""

    model: RobotModel
    tree: BodyTree
    joints: JointMotion
    root: RootMotion
    simulation: Simulation
    truth: dict[str, FloatArray]
    measured: Wrenches

    def passing(self, sensor: str) -> FloatArray:
        """What the near side of a sensor does to the far side as the sensor has it, in the root link's frame."""
        tag = self.model.sensors[sensor]
        far = self.model.joints[tag.joint].child in self.simulation.far_side[tag.joint]
        sign = 1.0 if far == (tag.direction is MeasureDirection.PARENT_TO_CHILD) else -1.0
        return sign * to_root(self.simulation.sensor_pose(sensor), self.measured.of_name(sensor))

    def in_contact(self, contact: Contact, wrench: FloatArray) -> FloatArray:
        """Express wrenches in the root link's frame in a contact frame."""
        return from_root(self.simulation.links[contact.link].pose @ contact.link_H_contact, wrench)


@cache
def humanoid(root_link: str, samples: int) -> tuple[RobotModel, BodyTree, JointMotion, RootMotion]:
    """An iCub with six sensors, moving."""
    model = read_urdf(icub("iCubGazeboV2_7"))
    assert len(model.sensors) == 6
    return (
        model,
        build_tree(model, root_link),
        random_motion(model, samples=samples, seed=1),
        random_root(samples, 2),
    )


def touched(contacts: Sequence[Contact], *, root_link: str = "root_link", samples: int = 7, seed: int = 3) -> Touched:
    """Touch the humanoid at random strength, and hold it at its root link."""
    model, tree, joints, root = humanoid(root_link, samples)
    return touch(model, tree, joints, root, contacts, seed=seed)


def touch(
    model: RobotModel, tree: BodyTree, joints: JointMotion, root: RootMotion, contacts: Sequence[Contact], *, seed: int
) -> Touched:
    """Touch a robot at random strength; its sensors read what passes them."""
    rng, simulation, truth = np.random.default_rng(seed), Simulation(model, tree.root_link, joints, root), {}
    for contact in contacts:
        unknowns = contact.unknown_map() if contact.type.unknowns else np.eye(6)
        truth[contact.name] = 20.0 * rng.normal(size=(len(joints), unknowns.shape[1])) @ unknowns.T
        simulation.touch(contact, truth[contact.name])
    readings = {sensor: simulation.reading(sensor) for sensor in tree.cuts}
    values = np.array(list(readings.values())).reshape(len(readings), len(joints), 6)
    measured = Wrenches(names=tuple(readings), values=values.transpose(1, 0, 2))
    return Touched(model, tree, joints, root, simulation, truth, measured)
