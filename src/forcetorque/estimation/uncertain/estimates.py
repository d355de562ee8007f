# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches and joint torques with their covariances."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.estimation.uncertain.undetermined import Undetermined
from forcetorque.robot.mechanics.estimates import column_of

BY_SAMPLE: Final = (
    "contact_wrenches",
    "contact_covariance",
    "torques",
    "torque_covariance",
    "torque_lasting",
    "residual",
    "rank",
    "condition",
)
"""Fields with a row for each sample."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UncertainEstimates:
    """Estimates of n samples; NaN in a gap, and where a number depends on what is not determined."""

    contacts: tuple[str, ...]
    """Contacts: unknown ones, then known ones, in the order of the question."""
    contact_wrenches: FloatArray
    """What the environment does to the robot, in and about the contact frame; of a known contact as readings and its
    tangents have corrected it; shape (n, contacts, 6); N, N m."""
    contact_covariance: FloatArray
    """Covariance of its error; shape (n, contacts, 6, 6)."""
    joints: tuple[str, ...]
    """Joints whose torque was asked for."""
    torques: FloatArray
    """What the motor does along +q; shape (n, joints); N m, N where prismatic."""
    torque_covariance: FloatArray
    """Covariance of their errors; shape (n, joints, joints)."""
    torque_lasting: FloatArray
    """What one standard deviation of each of p errors that last leaves them wrong by; part of that covariance; shape
    (n, joints, p)."""
    parts: tuple[str, ...]
    """Sub-models whose equations were solved, by the sensor at their base or the root link."""
    residual: FloatArray
    """What neither unknowns nor errors explain of each, along the root link's axes; shape (n, parts, 6); N, N m."""
    rank: IntArray
    """Directions of all unknowns together that the equations see; shape (n,)."""
    condition: FloatArray
    """Largest over smallest singular value of those; shape (n,); NaN for rank 0."""
    undetermined: tuple[Undetermined, ...]
    """What the equations do not see, and where."""

    def __len__(self) -> int:
        return len(self.torques)

    def of_samples(self, kept: BoolArray) -> UncertainEstimates:
        """Keep some samples.

        Args:
            kept: Which; shape (n,).

        Returns:
            Their estimates.
        """
        arrays: dict[str, Any] = {name: getattr(self, name)[kept] for name in BY_SAMPLE}
        hidden = [replace(one, samples=one.samples[kept]) for one in self.undetermined if one.samples[kept].any()]
        return replace(self, **arrays, undetermined=tuple(hidden))

    @property
    def determined(self) -> BoolArray:
        """Whether everything is determined in a sample; shape (n,)."""
        hidden = np.zeros(len(self), dtype=np.bool_)
        for one in self.undetermined:
            hidden |= one.samples
        return ~hidden

    @property
    def torque_sd(self) -> FloatArray:
        """Standard deviation of each torque; shape (n, joints)."""
        return _deviations(self.torque_covariance)

    def contact(self, name: str) -> FloatArray:
        """Give the wrenches of a contact.

        Args:
            name: Its name.

        Returns:
            Wrenches in the contact frame; shape (n, 6); N, N m.
        """
        return self.contact_wrenches[:, column_of(name, self.contacts, "contact")]

    def contact_sd(self, name: str) -> FloatArray:
        """Give the standard deviations of the wrench of a contact.

        Args:
            name: Its name.

        Returns:
            One for each component; shape (n, 6); N, N m.
        """
        return _deviations(self.covariance_of(name))

    def covariance_of(self, name: str) -> FloatArray:
        """Give the covariance of the wrench of a contact.

        Args:
            name: Its name.

        Returns:
            Covariances; shape (n, 6, 6).
        """
        return self.contact_covariance[:, column_of(name, self.contacts, "contact")]

    def torque(self, joint: str) -> FloatArray:
        """Give the torques of a joint.

        Args:
            joint: Its name.

        Returns:
            Torques; shape (n,); N m, N where prismatic.
        """
        return self.torques[:, column_of(joint, self.joints, "torque")]


def _deviations(covariance: FloatArray) -> FloatArray:
    variance = np.einsum("...ii->...i", covariance)
    return np.sqrt(np.maximum(variance, 0.0))
