# SPDX-License-Identifier: BSD-3-Clause
"""The balancing biped on its soles, and many copies of it in MuJoCo, advanced together."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final
from xml.etree.ElementTree import Element, SubElement

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import RobotError, needs_extra
from forcetorque.base.pose import cross, make_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import reading_sign
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import mass_of
from forcetorque.locomotion.torque_control.joint_torque_controller import JointDrive
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.robot.urdf_and_mjcf_text import mjcf_text, mjcf_tree
from forcetorque.simulation.robots import BIPED_URDF

SENSORS: Final = ("l_leg_ft", "l_foot_ft", "r_leg_ft", "r_foot_ft")
"""Sensors that joint torques are estimated from: above the yaw of each hip, and above each foot."""
SOLES: Final = ("l_sole", "r_sole")
"""Frames of the soles; z points up from the ground."""
LEGS: Final = tuple(
    tuple(f"{side}_{joint}" for joint in ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll"))
    for side in "lr"
)
"""Joints of either leg, from the hip down."""
JOINTS: Final = (*LEGS[0], *LEGS[1])
"""Joints with a torque controller."""
SOLE_CENTRE: Final = np.array([0.01, 0.0])
"""Middle of the sole in its frame, x and y; m."""
SOLE_HALF: Final = np.array([0.085, 0.04])
"""Half the length and half the width of a sole; m."""
MOST_TILT_DEG: Final = 20.0
"""Steeper soles take the ankles to their limits."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Biped:
    """The robot, in the one form that URDF, MuJoCo and our dynamics are made of."""

    tilt_deg: float
    """How far each sole is turned against its foot, about y: the foot then stands with its toes down; degree."""
    model: RobotModel
    """Links, joints and the four sensors of the legs."""
    tree: BodyTree
    """The robot seen from its pelvis."""

    @classmethod
    def on_soles(cls, tilt_deg: float = 0.0) -> Biped:
        """Build the robot; its waist and arms are held straight.

        Args:
            tilt_deg: How far each sole is turned against its foot, about y; degree.

        Returns:
            The robot.

        Raises:
            RobotError: If the ankles do not go so far.
        """
        if not abs(tilt_deg) <= MOST_TILT_DEG:
            raise RobotError(f"tilt_deg: expected at most {MOST_TILT_DEG:g} degrees either way, got {tilt_deg:g}")
        urdf = read_urdf(BIPED_URDF)
        joints = {
            name: joint if name in JOINTS else replace(joint, type=JointType.FIXED, limit=None)
            for name, joint in urdf.joints.items()
        }
        for sole in SOLES:
            mount = joints[f"{sole}_joint"]
            joints[mount.name] = replace(mount, parent_H_child=mount.parent_H_child @ _turn_about_y(tilt_deg))
        sensors = {name: urdf.sensors[name] for name in SENSORS}
        model = replace(urdf, joints=joints, sensors=sensors)
        return cls(tilt_deg=tilt_deg, model=model, tree=build_tree(model, model.root_link))

    @property
    def mass(self) -> float:
        """Mass of the robot; kg."""
        return mass_of(self.tree)


def _turn_about_y(angle_deg: float) -> FloatArray:
    sine, cosine = np.sin(np.deg2rad(angle_deg)), np.cos(np.deg2rad(angle_deg))
    return make_pose(np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]]), np.zeros(3))


_SOLE_HEIGHT: Final = 0.005
"""Half the height of the box that touches the ground; m."""
_CONTACT_TIME_S: Final = 0.008
"""Time in which the ground pushes a foot out; s. Longer than some steps of the simulation, shorter than any motion."""
_ROOT: Final = 6
"""Degrees of freedom of the pelvis, before those of joints."""


def import_mujoco() -> Any:
    """Import the simulator.

    Returns:
        The module `mujoco`.

    Raises:
        MissingExtraError: If it is not installed.
    """
    with needs_extra("the closed loop runs in MuJoCo", "closed-loop"):
        import mujoco
    return mujoco


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Posture:
    """Where all B copies are and how they move; pelvis (linear in world axes, angular in its own), then joints."""

    position: FloatArray
    """Pelvis position, quaternion wxyz, joints; shape (B, 19); m, rad."""
    velocity: FloatArray
    """Velocities; shape (B, 18)."""
    bias: FloatArray
    """Coriolis forces and gravity; shape (B, 18)."""
    centre_of_mass: FloatArray
    """In the world; shape (B, 3); m."""
    centre_jacobian: FloatArray
    """Velocity of the centre of mass per velocity; shape (B, 3, 18)."""
    sole_position: FloatArray
    """Origins of the soles in the world; shape (B, 2, 3); m."""
    sole_jacobian: FloatArray
    """Twist of each sole, linear then angular, in world axes, per velocity; shape (B, 2, 6, 18)."""


class World:
    """Copies of one robot on a level floor; a look gives their posture, then torques act for a step."""

    def __init__(self, biped: Biped, drive: JointDrive, *, copies: int, step_s: float) -> None:
        """Build the copies.

        Args:
            biped: The robot.
            drive: Friction and rotor of every joint.
            copies: How many, B.
            step_s: Step of the simulation; s.
        """
        self._mujoco = import_mujoco()
        self.model = self._mujoco.MjModel.from_xml_string(mjcf_text(world_tree(biped, drive, step_s=step_s)))
        self.copies = [self._mujoco.MjData(self.model) for _ in range(copies)]
        addresses = [self.model.jnt_dofadr[self.model.joint(name).id] for name in JOINTS]
        self.dofs = np.array(addresses)
        self._order = np.concatenate([np.arange(_ROOT), self.dofs])
        self._positions = np.concatenate([np.arange(_ROOT + 1), self.dofs + 1])
        self._soles = [self.model.body(sole).id for sole in SOLES]
        # MuJoCo reads what the parent does to the child
        signs = [reading_sign(biped.model.sensors[name].direction, child_is_outboard=True) for name in SENSORS]
        self._signs = np.array(signs)[:, None]
        self._root = self.model.body(biped.model.root_link).id
        nv = self.model.nv
        self._centre_jacobian = np.zeros((copies, 3, nv))
        self._sole_jacobian = np.zeros((copies, 2, 6, nv))

    def place(self, position: FloatArray, velocity: FloatArray | None = None) -> None:
        """Put every copy somewhere.

        Args:
            position: As in a posture; shape (B, 19) or (19,).
            velocity: As in a posture; shape (B, 18); at rest if None.
        """
        for k, data in enumerate(self.copies):
            self._mujoco.mj_resetData(self.model, data)
            data.qpos[self._positions] = position if position.ndim == 1 else position[k]
            if velocity is not None:
                data.qvel[self._order] = velocity[k]

    def look(self, awake: BoolArray) -> Posture:
        """Find where all copies are, before torques act.

        Args:
            awake: Copies that go on; others stay as they are; shape (B,).

        Returns:
            Their posture.
        """
        mujoco, model, copies = self._mujoco, self.model, self.copies
        for k in np.flatnonzero(awake):
            data = copies[k]
            mujoco.mj_step1(model, data)
            mujoco.mj_jacSubtreeCom(model, data, self._centre_jacobian[k], self._root)
            for sole, body in enumerate(self._soles):
                jacobian = self._sole_jacobian[k, sole]
                mujoco.mj_jacBody(model, data, jacobian[:3], jacobian[3:], body)
        return Posture(
            position=np.stack([data.qpos for data in copies])[:, self._positions],
            velocity=np.stack([data.qvel for data in copies])[:, self._order],
            bias=np.stack([data.qfrc_bias for data in copies])[:, self._order],
            centre_of_mass=np.stack([data.subtree_com[self._root] for data in copies]),
            centre_jacobian=self._centre_jacobian[:, :, self._order],
            sole_position=np.stack([data.xpos[self._soles] for data in copies]),
            sole_jacobian=self._sole_jacobian[..., self._order],
        )

    def advance(
        self, torque: FloatArray, awake: BoolArray, *, pelvis_N: float = 0.0, soles: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Let torques of the motors act for one step from the posture that was looked at.

        Args:
            torque: Torques, before friction; shape (B, 12); N m.
            awake: Copies that go on; shape (B,).
            pelvis_N: Force on the pelvis along y of the world; N.
            soles: Wrenches on the soles, beside what the floor does, along the axes of the world and about the origins
                of the soles; shape (B, 2, 6); N, N m; None for none.

        Returns:
            What they did at once: accelerations, shape (B, 18), and true wrenches at the sensors, in their frames and
            directions, shape (B, 4, 6); N, N m.
        """
        copies = self.copies
        for k in np.flatnonzero(awake):
            copies[k].ctrl[:] = torque[k]
            copies[k].xfrc_applied[self._root, 1] = pelvis_N
            if soles is not None:
                # MuJoCo applies them at the centres of mass of bodies
                lever = copies[k].xpos[self._soles] - copies[k].xipos[self._soles]
                about_centre = soles[k].copy()
                about_centre[:, 3:] += cross(lever, soles[k, :, :3])
                copies[k].xfrc_applied[self._soles] = about_centre
            self._mujoco.mj_step2(self.model, copies[k])
        wrenches = np.stack([data.sensordata for data in copies]).reshape(len(copies), -1, 6)
        return np.stack([data.qacc for data in copies])[:, self._order], wrenches * self._signs


def world_tree(biped: Biped, drive: JointDrive, *, step_s: float) -> Element:
    """Write the robot on its floor, with motors, as MJCF.

    Args:
        biped: The robot.
        drive: Friction and rotor of every joint.
        step_s: Step of the simulation; s.

    Returns:
        The element `mujoco`.
    """
    tree = mjcf_tree(biped.model)
    option = SubElement(tree, "option", timestep=repr(step_s), cone="elliptic", impratio="10")
    option.set("gravity", f"0 0 {-STANDARD_GRAVITY!r}")
    # what sensors and accelerations say must be what moves the robot
    SubElement(option, "flag", eulerdamp="disable")
    contact = {"friction": "0.9 0.02 0.001", "solref": f"{_CONTACT_TIME_S} 1", "solimp": "0.95 0.99 0.001 0.5 2"}
    ground = tree.find("worldbody")
    if ground is not None:
        SubElement(ground, "geom", contact, name="floor", type="plane", size="0 0 1", contype="1", conaffinity="2")
    for body in tree.iter("body"):
        if body.get("name") in SOLES:
            box = {"size": f"{SOLE_HALF[0]} {SOLE_HALF[1]} {_SOLE_HEIGHT}", "pos": f"{SOLE_CENTRE[0]} 0 {_SOLE_HEIGHT}"}
            SubElement(body, "geom", {**contact, **box}, type="box", contype="2", conaffinity="1", mass="0")
    for joint in tree.iter("joint"):
        joint.set("armature", repr(drive.rotor_inertia))
        joint.set("damping", repr(drive.viscous))
        joint.set("frictionloss", repr(drive.coulomb))
    motors = SubElement(tree, "actuator")
    for name in JOINTS:
        SubElement(motors, "motor", name=name, joint=name)
    return tree
