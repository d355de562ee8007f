# SPDX-License-Identifier: BSD-3-Clause
"""Positions of joints as they come, and gravity in the frame of a reading by them and a robot model."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError, require_known
from forcetorque.robot.dynamics import joints_between, link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree


class JointPositions:
    """Keeps the positions that came last; joints may come in several messages."""

    def __init__(self, names: Sequence[str]) -> None:
        """Begin.

        Args:
            names: Joints, in the order of the vector.
        """
        self.names = tuple(names)
        """Joints."""
        self.vector = np.full(len(self.names), np.nan)
        """Their positions; shape (d,); rad or m; NaN until they come; another array after each message."""
        self._places = {name: place for place, name in enumerate(self.names)}

    def add(self, names: Sequence[str], positions: Sequence[float]) -> None:
        """Take positions in, as of `JointGravity`.

        Args:
            names: Joints, in any order; others are left out.
            positions: Their positions; rad, or m where prismatic; none where the message has none.
        """
        vector = self.vector.copy()
        for name, value in zip(names, positions, strict=False):
            if name in self._places and math.isfinite(value):
                vector[self._places[name]] = value
        self.vector = vector


class JointGravity:
    """Keeps the positions that came last; joints may come in several messages."""

    def __init__(self, model: RobotModel, frame: str, base_gravity: FloatArray) -> None:
        """Prepare.

        Args:
            model: The robot, whose root link does not move.
            frame: Link whose frame the reading is in.
            base_gravity: Acceleration of free fall along the axes of the root link; shape (3,); m/s2.

        Raises:
            RecordingError: If the robot has no such link.
        """
        require_known(frame, model.links, RecordingError, f"--frame {frame}: expected a link of {model.name!r}")
        self.vector = np.full(3, np.nan)
        """Acceleration of free fall in the frame; shape (3,); m/s2; NaN until all joints on the way have come."""
        self._tree, self._frame, self._base_gravity = build_tree(model, model.root_link), frame, base_gravity
        self._positions = dict.fromkeys(joints_between(self._tree, frame), np.nan)
        self._came_s = dict.fromkeys(self._positions, -math.inf)
        self._turn()

    @property
    def oldest_s(self) -> float:
        """When the joint on the way that is silent for longest came; s, by the clock of `add`; infinite without any."""
        return min(self._came_s.values(), default=math.inf)

    def add(self, names: Sequence[str], positions: Sequence[float], now_s: float) -> None:
        """Take positions in.

        Args:
            names: Joints, in any order; others than those on the way to the frame are left out.
            positions: Their positions; rad, or m where prismatic; none where the message has none.
            now_s: Time of their arrival; s of any clock.
        """
        came = {
            name: value if math.isfinite(value) else math.nan
            for name, value in zip(names, positions, strict=False)
            if name in self._positions
        }
        if came:
            self._positions |= came
            self._came_s |= dict.fromkeys(came, now_s)
            self._turn()

    def _turn(self) -> None:
        joints = JointMotion.at_rest(tuple(self._positions), np.array([list(self._positions.values())]))
        self.vector = link_pose(self._tree, joints, self._frame)[0, :3, :3].T @ self._base_gravity
