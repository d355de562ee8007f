# SPDX-License-Identifier: BSD-3-Clause
"""Gravity in the frame of a reading, by positions of joints as they come, and what the weight of a tool adds to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_shape
from forcetorque.base.errors import RecordingError, require_known
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree, joints_between


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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tool(ArrayRecord):
    """A rigid tool on the child link of a sensor, in the frame of the reading."""

    mass_kg: float
    """Mass; kg."""
    centre_m: FloatArray = field(metadata=array(3))
    """Centre of mass in the frame of the reading; shape (3,); m."""
    mass_sd_kg: float = 0.0
    """Standard deviation of the mass; kg."""
    centre_sd_m: float = 0.0
    """Standard deviation of each coordinate of the centre; m."""

    def __post_init__(self) -> None:
        ArrayRecord.__post_init__(self)
        for name, value in (
            ("mass_kg", self.mass_kg),
            ("mass_sd_kg", self.mass_sd_kg),
            ("centre_sd_m", self.centre_sd_m),
        ):
            if not (np.isfinite(value) and value >= 0.0):
                raise RecordingError(f"tool: {name}: expected a number of 0 or more, got {value}")
        if not np.isfinite(self.centre_m).all():
            raise RecordingError(f"tool: centre_m: expected three finite numbers, got {self.centre_m.tolist()}")

    def per_gravity(self, direction: MeasureDirection) -> FloatArray:
        """Give what the reading has of the tool per component of gravity.

        Args:
            direction: Who acts on whom in the reading.

        Returns:
            Matrix; shape (6, 3); `weight = matrix @ gravity`, with gravity as acceleration of free fall in the frame of
            the reading; kg, kg m.
        """
        x, y, z = self.centre_m
        hat = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        sign = 1.0 if direction is MeasureDirection.CHILD_TO_PARENT else -1.0
        return sign * self.mass_kg * np.vstack([np.eye(3), hat])

    def weight_variance(self, gravity: Any) -> FloatArray:
        """Give the variance of the weight, by the deviations of mass and centre.

        Args:
            gravity: Acceleration of free fall in the frame of the reading; shape (3,); m/s2.

        Returns:
            Variances; shape (6,); N2, (N m)2.

        Raises:
            ShapeError: If gravity is not of three components.
        """
        g = np.asarray(gravity, dtype=np.float64)
        require_shape(g, name="gravity", shape=(3,))
        moment = np.cross(self.centre_m, g) * self.mass_sd_kg
        lever = self.mass_kg * self.centre_sd_m * np.sqrt(np.maximum(g @ g - g**2, 0.0))
        return np.concatenate([(g * self.mass_sd_kg) ** 2, moment**2 + lever**2])
