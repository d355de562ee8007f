# SPDX-License-Identifier: BSD-3-Clause
"""What the ground does to each foot of a robot that stands on two."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.estimation import Contact, ContactType
from forcetorque.robot import link_pose
from forcetorque.simulation.motions.movement import Movement, Touch
from forcetorque.spatial import wrench_matrix

_COST = np.array([1.0, 1.0, 0.05, 150.0, 150.0, 150.0])
"""Cost of a squared component of a foot's wrench: the vertical force is cheap, and 1 N m costs as much as 12 N along
the ground, so that weight is borne near the middle of the sole."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FootLoads:
    """Wrenches of the ground that together make a robot move as it does.

    Of all of them those of least cost beside the pushes; what the pushes do in sum is taken back, so that
    the feet push against each other only. A foot without a share bears nothing.
    """

    unloaded: Movement
    """The movement without the ground: its support bears all."""
    feet: tuple[str, str]
    """Links of the feet, in whose frames the wrenches are."""
    shares: Callable[[FloatArray], FloatArray]
    """From instants (n,) in s to how far each foot bears, 0 to 1; shape (n, 2)."""
    pushes: Callable[[FloatArray], FloatArray]
    """From instants (n,) in s to what the feet would rather do, foot after foot; shape (n, 12); N, N m."""

    def __call__(self, seconds: FloatArray) -> FloatArray:
        """Give the wrenches that the ground applies to the feet.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            Wrenches in the frames of the feet; shape (n, 2, 6); N, N m.
        """
        joints, tree = self.unloaded.joints(seconds), self.unloaded.tree
        demanded = self.unloaded.support_wrench(seconds)
        sum_of = np.concatenate([wrench_matrix(link_pose(tree, joints, foot)) for foot in self.feet], axis=2)
        shares = np.repeat(self.shares(seconds), 6, axis=1)
        pushes = shares * self.pushes(seconds)
        cheap = (shares / np.tile(_COST, 2))[..., None] * sum_of.transpose(0, 2, 1)  # (n, 12, 6)
        missing = demanded[..., None] - sum_of @ pushes[..., None]
        loads: FloatArray = pushes + (cheap @ np.linalg.solve(sum_of @ cheap, missing))[..., 0]
        return loads.reshape(-1, 2, 6)

    def on(self, foot: int, seconds: FloatArray) -> FloatArray:
        """Give the wrench that the ground applies to one foot.

        Args:
            foot: Which foot, 0 or 1.
            seconds: Instants; shape (n,); s.

        Returns:
            Wrench in the frame of the foot; shape (n, 6); N, N m.
        """
        return self(seconds)[:, foot]

    def borne(self) -> Movement:
        """Let the feet bear what the support bore.

        Returns:
            The movement, with the feet as touches and a support that bears nothing.
        """
        touches = (
            Touch(Contact(link=link, type=ContactType.KNOWN), partial(self.on, index))
            for index, link in enumerate(self.feet)
        )
        return replace(self.unloaded, external=tuple(touches))
