# SPDX-License-Identifier: BSD-3-Clause
"""The robot that balances: the legs of the bundled biped, on soles that may be tilted, for URDF and MuJoCo alike."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import RobotError
from forcetorque.estimation.balance import mass_of
from forcetorque.robot import BodyTree, JointType, RobotModel, build_tree, read_urdf
from forcetorque.simulation.robots import BIPED_URDF
from forcetorque.spatial import make_pose

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
