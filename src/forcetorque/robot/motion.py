# SPDX-License-Identifier: BSD-3-Clause
"""Motion of a robot over n samples: its joints, and the frame that the tree is rooted at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.errors import ShapeError

_UNIT = 1e-6
"""A direction may be this far from unit length: it is a part of the weight far below what sensors resolve."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointMotion:
    """Positions, velocities and accelerations of joints, matched by name."""

    names: tuple[str, ...]
    """Joints, in any order."""
    position: FloatArray
    """Positions; shape (n, j); rad, or m where prismatic."""
    velocity: FloatArray
    """Velocities; shape (n, j); rad/s or m/s."""
    acceleration: FloatArray
    """Accelerations; shape (n, j); rad/s2 or m/s2."""

    def __post_init__(self) -> None:
        names = tuple(self.names)
        object.__setattr__(self, "names", names)
        position = read_only(self.position, name="position", shape=(None, len(names)))
        object.__setattr__(self, "position", position)
        for field in ("velocity", "acceleration"):
            values = read_only(getattr(self, field), name=field, shape=position.shape)
            object.__setattr__(self, field, values)
        if len(set(names)) != len(names):
            raise ShapeError(f"joint names: expected each once, got {names}")

    @classmethod
    def at_rest(cls, names: Sequence[str], position: Any) -> JointMotion:
        """Hold joints still.

        Args:
            names: Joints.
            position: Positions; shape (n, j); rad, or m where prismatic.

        Returns:
            A motion without velocity and acceleration.
        """
        zero = np.zeros_like(np.asarray(position, dtype=np.float64))
        return cls(names=tuple(names), position=position, velocity=zero, acceleration=zero)

    def samples(self, rows: slice | IntArray) -> JointMotion:
        """Look at some of the samples.

        Args:
            rows: Range of samples, without a step, or their numbers.

        Returns:
            The same memory for a range.
        """
        parts = (values[rows] for values in (self.position, self.velocity, self.acceleration))
        position, velocity, acceleration = parts
        return JointMotion(names=self.names, position=position, velocity=velocity, acceleration=acceleration)

    def shifted(self, zeros: Mapping[str, float]) -> JointMotion:
        """Give the motion of joints whose zeros are elsewhere.

        Args:
            zeros: By the name of a joint, what is to be added to its position; rad or m. Others stay.

        Returns:
            The same velocities and accelerations at other positions.
        """
        shift = np.array([zeros.get(name, 0.0) for name in self.names])
        return replace(self, position=self.position + shift)

    def __len__(self) -> int:
        return len(self.position)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RootMotion:
    """Motion of the root link's frame, in its own axes; one sample or n."""

    proper_acceleration: FloatArray
    """What an accelerometer at its origin reads (+9.8 m/s2 upwards at rest); shape (3,) or (n, 3); m/s2."""
    angular_velocity: FloatArray
    """Angular velocity; shape (3,) or (n, 3); rad/s."""
    angular_acceleration: FloatArray
    """Angular acceleration; shape (3,) or (n, 3); rad/s2."""

    def __post_init__(self) -> None:
        for field in ("proper_acceleration", "angular_velocity", "angular_acceleration"):
            values = np.asarray(getattr(self, field), dtype=np.float64)
            shape = (3,) if values.ndim == 1 else (None, 3)
            object.__setattr__(self, field, read_only(values, name=field, shape=shape))

    @classmethod
    def fixed(cls, gravity_direction: Any, *, gravity: float = STANDARD_GRAVITY) -> RootMotion:
        """Hold the root link still in the world.

        Args:
            gravity_direction: Unit vector along which things fall, in the root link's axes; shape (3,).
            gravity: Magnitude of gravity; m/s2.

        Returns:
            The motion of a frame at rest.

        Raises:
            ShapeError: If the direction is not a unit vector.
        """
        down = read_only(gravity_direction, name="gravity_direction", shape=(3,))
        if not abs(float(np.linalg.norm(down)) - 1.0) < _UNIT:
            raise ShapeError(
                f"gravity_direction: expected a unit vector, got {down.tolist()}; gravity is m/s2 beside it"
            )
        return cls(proper_acceleration=-gravity * down, angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3))

    def samples(self, rows: slice | IntArray) -> RootMotion:
        """Look at some of the samples.

        Args:
            rows: Range of samples, or their numbers.

        Returns:
            The motion there; what is one for all samples stays so.
        """
        vectors = (self.proper_acceleration, self.angular_velocity, self.angular_acceleration)
        proper, velocity, rate = (values if values.size == 3 else values[rows] for values in vectors)
        return RootMotion(proper_acceleration=proper, angular_velocity=velocity, angular_acceleration=rate)
