# SPDX-License-Identifier: BSD-3-Clause
"""Inertia of a rigid body about the origin of a frame: mass, first and second moment."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, read_only
from forcetorque.base.pose import skew, split_pose


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inertia(ArrayRecord):
    """Inertia of a rigid body in a frame; adding two in the same frame joins the bodies.

    The second moment is kept even where the mass is zero: real robot models contain such links,
    and dropping them changes joint torques.
    """

    mass: float
    """Mass; kg."""
    first_moment: FloatArray = field(metadata=array(3))
    """Mass times centre of mass; shape (3,); kg m."""
    second_moment: FloatArray = field(metadata=array(3, 3))
    """Rotational inertia about the origin of the frame; shape (3, 3); kg m2."""

    @classmethod
    def zero(cls) -> Inertia:
        """Give the inertia of nothing.

        Returns:
            An inertia of zero mass and moments.
        """
        return cls(mass=0.0, first_moment=np.zeros(3), second_moment=np.zeros((3, 3)))

    @classmethod
    def about_centre_of_mass(cls, *, mass: float, centre_of_mass: Any, second_moment: Any) -> Inertia:
        """Build from the second moment about the centre of mass, as robot descriptions give it.

        Args:
            mass: Mass; kg.
            centre_of_mass: Position in the frame; shape (3,); m.
            second_moment: Rotational inertia about the centre of mass, in the frame's axes; shape (3, 3); kg m2.

        Returns:
            The inertia about the frame's origin.
        """
        hat = skew(centre_of_mass)
        return cls(
            mass=mass,
            first_moment=mass * np.asarray(centre_of_mass, dtype=np.float64),
            second_moment=read_only(second_moment, name="second_moment", shape=(3, 3)) - mass * hat @ hat,
        )

    @property
    def is_zero(self) -> bool:
        """Whether the body takes no wrench to move: neither mass nor moments."""
        return self.mass == 0.0 and not self.first_moment.any() and not self.second_moment.any()

    def expressed_in(self, a_H_b: Any) -> Inertia:
        """Express the inertia given in frame b in frame a and about its origin.

        Args:
            a_H_b: Pose of b in a; shape (4, 4); translation in m.

        Returns:
            The same body's inertia in a.
        """
        rotation, offset = split_pose(a_H_b)
        rotated = rotation @ self.first_moment
        hat_rotated, hat_offset = skew(rotated), skew(offset)
        return Inertia(
            mass=self.mass,
            first_moment=rotated + self.mass * offset,
            second_moment=rotation @ self.second_moment @ rotation.T
            - hat_offset @ hat_rotated
            - hat_rotated @ hat_offset
            - self.mass * hat_offset @ hat_offset,
        )

    def __add__(self, other: Inertia) -> Inertia:
        return Inertia(
            mass=self.mass + other.mass,
            first_moment=self.first_moment + other.first_moment,
            second_moment=self.second_moment + other.second_moment,
        )

    def matrix(self) -> FloatArray:
        """Give the 6 x 6 inertia matrix, linear part first.

        Returns:
            `[[m 1, -hat(mc)], [hat(mc), I]]`; shape (6, 6).
        """
        hat = skew(self.first_moment)
        return np.block([[self.mass * np.eye(3), -hat], [hat, self.second_moment]])
