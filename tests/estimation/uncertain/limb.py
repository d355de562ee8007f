# SPDX-License-Identifier: BSD-3-Clause
"""A leg with one force-torque sensor above a shank under skin: what touches it, what sensor and skin read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import make_pose
from forcetorque.base.wrench import MeasureDirection
from forcetorque.estimation.skin_contacts import SkinSource, skin_sources
from forcetorque.estimation.uncertain.input_errors import Uncertainty
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointType, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.skin.contact.contact_clusters import SkinContacts, find_contacts
from forcetorque.skin.contact.pressure_frame import PatchReader
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ContactTruth, SkinBody, contacts
from forcetorque.skin.simulation.recordings import TaxelResponses
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from tests.robot.mechanics.simulated import Simulation
from tests.scenes.patches import cylinder_patch
from tests.skin.contact_trials import OFF_EDGE, chamber_table

FRAMES: Final = 10
REST_FRAMES: Final = 100
FRICTION: Final = 0.3
SENSOR_SD: Final = np.array([0.1, 0.1, 0.2, 0.005, 0.005, 0.003])
"""Standard deviation of the sensor's errors; N, N m."""
LEAST_TURN_RAD: Final = 0.6
"""By how much the skin turns between two contacts."""
FOOT: Final = Contact(link="foot")


def leg() -> RobotModel:
    """A thigh on a hip, a sensor at its lower end, a shank, and a foot on an ankle."""
    return RobotModel(
        name="leg",
        links={
            "base": Inertia.zero(),
            "thigh": _inertia(2.0, 0.15),
            "shank": _inertia(1.5, 0.12),
            "foot": _inertia(0.5, 0.03),
        },
        joints={
            "hip": _joint("hip", "base", "thigh", 0.0),
            "knee_ft": _joint("knee_ft", "thigh", "shank", -0.3, JointType.FIXED),
            "ankle": _joint("ankle", "shank", "foot", -0.25),
        },
        sensors={
            "knee_ft": ForceTorqueSensor(
                name="knee_ft",
                joint="knee_ft",
                frame=SensorFrame.SENSOR,
                direction=MeasureDirection.CHILD_TO_PARENT,
                child_H_sensor=np.eye(4),
            )
        },
    )


def _inertia(mass: float, depth_m: float) -> Inertia:
    return Inertia.about_centre_of_mass(
        mass=mass, centre_of_mass=np.array([0.0, 0.0, -depth_m]), second_moment=0.004 * mass * np.eye(3)
    )


def _joint(name: str, parent: str, child: str, z: float, type: JointType = JointType.REVOLUTE) -> Joint:
    pose = make_pose(np.eye(3), np.array([0.0, 0.0, z]))
    return Joint(name=name, type=type, parent=parent, child=child, parent_H_child=pose, axis=np.array([0.0, 1.0, 0.0]))


class Shin:
    """Skin on the shank: its true surface, what is made of its pressures, and its taxels of 8 bits."""

    def __init__(self, layout: SkinLayout, *, objects: int, seed: int = 2) -> None:
        rng = np.random.default_rng(seed)
        self.body, self.patch = SkinBody.of(layout), SkinPatch.of(layout)
        self.taxels = TaxelResponses.drawn(len(layout), rng)
        table = chamber_table(self.taxels, rng, both_ways=False)
        rest = self.taxels.counts(np.zeros(len(table)), rng, frames=REST_FRAMES).astype(np.float64)
        self.reader = PatchReader.at_rest(table, rest)
        self.truths = [one for one in contacts(self.body, rng, objects) if self._in_scope(one, rng)]

    def felt(self, truths: Sequence[ContactTruth], rng: np.random.Generator) -> SkinContacts:
        """What the skin tells of objects that rest on it together."""
        pressures = np.sum([truth.pressures for truth in truths], axis=0)
        return find_contacts(self.patch, self.reader.frame(self.taxels.counts(pressures, rng, frames=FRAMES)))

    def _in_scope(self, truth: ContactTruth, rng: np.random.Generator) -> bool:
        """One contact in range and off the edge, as predicted standard deviations suppose."""
        told = self.felt([truth], rng)
        return len(told) == 1 and not told.beyond_range[0] and bool(told.edge_share[0] < OFF_EDGE)

    def touched(self, rng: np.random.Generator, number: int) -> tuple[list[ContactTruth], SkinContacts]:
        """Objects on different faces, and the contacts that are felt; anew until those are as many."""
        while True:
            truths = [self.truths[k] for k in rng.permutation(len(self.truths))[:number]]
            if _on_different_faces(truths):
                told = self.felt(truths, rng)
                if len(told) == number:
                    centres = np.stack([truth.centre for truth in truths])
                    near = [int(np.linalg.norm(centres - c, axis=1).argmin()) for c in told.centre_of_pressure]
                    return [truths[k] for k in near], told


def _on_different_faces(truths: Sequence[ContactTruth]) -> bool:
    normals = np.stack([_normal(truth) for truth in truths])
    cosines = (normals @ normals.T)[np.triu_indices(len(truths), 1)]
    return bool((cosines < np.cos(LEAST_TURN_RAD)).all())


def _normal(truth: ContactTruth) -> FloatArray:
    normal: FloatArray = -truth.wrench[:3] / np.linalg.norm(truth.wrench[:3])
    return normal


@cache
def cylinder() -> Shin:
    """Skin around most of the shank."""
    return Shin(cylinder_patch(across=20, along=5).layout(), objects=80)


def _slip(rng: np.random.Generator, truth: ContactTruth, friction: float) -> FloatArray:
    """Friction at the centre of pressure, along the skin there."""
    direction = np.cross(_normal(truth), rng.normal(size=3))
    force = friction * truth.normal_force_N * direction / np.linalg.norm(direction)
    return np.concatenate([force, np.cross(truth.centre, force)])


@dataclass(frozen=True, kw_only=True)
class Draws:
    """The leg in as many poses as draws, touched in each."""

    simulation: Simulation
    """The truth."""
    measured: Wrenches
    """What the sensor reads, with errors."""
    sources: tuple[SkinSource, ...]
    """What the skin tells."""
    skin_truth: FloatArray
    """What happens on the skin, friction included; shape (n, k, 6)."""
    centres: FloatArray
    """Where; shape (n, k, 3); m."""
    pushes: FloatArray
    """What happens on the skin without friction; shape (n, k, 6)."""
    normals: FloatArray
    """Which way is out there; shape (n, k, 3)."""
    foot: FloatArray
    """What happens at the foot; shape (n, 6)."""
    fewest: IntArray
    """Active taxels of the contact that has the fewest; shape (n,)."""

    def question(self, *, foot: bool, sensor: bool = True) -> Question:
        """Torques of hip and ankle, the wrench at the foot or nothing there, and what holds the base."""
        contacts = [Contact(link="base"), *([FOOT] if foot else []), *(source.contact for source in self.sources)]
        return Question(
            tree=build_tree(self.simulation.model, "base"),
            measured=("knee_ft",) if sensor else (),
            contacts=tuple(contacts),
            torques=("hip", "ankle"),
            torque_sum=TorqueSum.SUB_MODEL,
        )

    def known(self) -> Wrenches:
        """Wrenches of the skin."""
        return Wrenches.of({source.contact.name: source.wrench for source in self.sources})

    def uncertainty(self) -> Uncertainty:
        """What sensor and skin say of their errors."""
        return Uncertainty(
            measured={"knee_ft": np.diag(SENSOR_SD**2)},
            known={source.contact.name: source.covariance for source in self.sources},
            tangents={s.contact.name: s.tangents for s in self.sources if s.tangents is not None},
        )


def draw(
    shin: Shin, seed: int, draws: int, number: int, *, friction: float, believed: float | None, foot: bool
) -> Draws:
    """Touch the leg in random poses.

    Args:
        shin: Its skin.
        seed: Seed.
        draws: Number of poses.
        number: Contacts on skin.
        friction: True coefficient.
        believed: Coefficient that the estimator is told; None for free tangents.
        foot: Whether something touches the foot too.

    Returns:
        Truth and readings.
    """
    rng = np.random.default_rng(seed)
    drawn = [shin.touched(rng, number) for _ in range(draws)]
    frames = [told for _, told in drawn]
    sources = skin_sources("shin", "shank", frames, np.arange(draws), friction=believed)
    angles = rng.uniform(-0.8, 0.8, (draws, 2))
    joints = JointMotion.at_rest(("hip", "ankle"), angles)
    still = RootMotion(
        proper_acceleration=np.array([0.0, 0.0, 9.81]), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3)
    )
    simulation = Simulation(leg(), "base", joints, still)
    truth = np.array([[one.wrench + _slip(rng, one, friction) for one in truths] for truths, _ in drawn])
    for k, source in enumerate(sources):
        simulation.touch(source.contact, truth[:, k])
    at_foot = rng.normal(size=(draws, 6)) * [10.0, 10.0, 10.0, 1.0, 1.0, 1.0] * foot
    simulation.touch(FOOT, at_foot)
    reading = simulation.reading("knee_ft") + rng.normal(size=(draws, 6)) * SENSOR_SD
    return Draws(
        simulation=simulation,
        measured=Wrenches.of({"knee_ft": reading}),
        sources=sources,
        skin_truth=truth,
        centres=np.array([[one.centre for one in truths] for truths, _ in drawn]),
        pushes=np.array([[one.wrench for one in truths] for truths, _ in drawn]),
        normals=np.array([[_normal(one) for one in truths] for truths, _ in drawn]),
        foot=at_foot,
        fewest=np.array([min(len(told.taxels(k)) for k in range(number)) for told in frames]),
    )
