# SPDX-License-Identifier: BSD-3-Clause
"""What the ground does to each foot of a robot that stands on two."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.estimation import Contact, ContactType
from forcetorque.robot import link_pose
from forcetorque.simulation.motions.movement import Movement, Touch
from forcetorque.spatial import invert_pose, transform_wrench, wrench_matrix

_COST = np.array([1.0, 1.0, 0.05, 150.0, 150.0, 150.0])
"""Cost of a squared component of a foot's wrench: the vertical force is cheap, and 1 N m costs as much as 12 N along
the ground, so that weight is borne near the middle of the sole."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FootLoads:
    """Wrenches of the ground that together make a robot move as it does.

    While both feet bear, of all such wrenches those of least cost beside the pushes; what the pushes do in
    sum is taken back, so that the feet push against each other only. While a foot takes or hands over its
    load, a mean of that and of the other foot bearing all.
    """

    unloaded: Movement
    """The movement without the ground: its support bears all."""
    feet: tuple[str, str]
    """Links of the feet, in whose frames the wrenches are."""
    shares: Callable[[FloatArray], FloatArray]
    """From instants (n,) in s to how far each foot has taken its load, 0 to 1, one of both at 1; shape (n, 2)."""
    pushes: Callable[[FloatArray], FloatArray]
    """From instants (n,) in s to what the feet would rather do, foot after foot; shape (n, 12); N, N m."""
    _latest: dict[bytes, FloatArray] = field(init=False, repr=False, default_factory=dict)
    """Loads at the instants of the last call: the touches of both feet ask for them in turn."""

    def __call__(self, seconds: FloatArray) -> FloatArray:
        """Give the wrenches that the ground applies to the feet.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            Wrenches in the frames of the feet; shape (n, 2, 6); N, N m.
        """
        instants = seconds.tobytes()
        if instants not in self._latest:
            self._latest.clear()
            self._latest[instants] = read_only(self._shared(seconds), name="loads", shape=(len(seconds), 2, 6))
        return self._latest[instants]

    def _shared(self, seconds: FloatArray) -> FloatArray:
        """Wrenches in the frames of both feet, as their shares are; shape (n, 2, 6); N, N m."""
        joints, tree = self.unloaded.joints(seconds), self.unloaded.tree
        demanded = self.unloaded.support_wrench(seconds)
        trunk_H_feet = [link_pose(tree, joints, foot) for foot in self.feet]
        first, second = self.shares(seconds).T[..., None]
        loads: FloatArray = (first + second - 1.0)[..., None] * self._on_both(seconds, trunk_H_feet, demanded)
        for foot, other_share in enumerate((second, first)):
            alone = transform_wrench(invert_pose(trunk_H_feet[foot]), demanded)
            loads[:, foot] += (1.0 - other_share) * alone
        return loads

    def _on_both(self, seconds: FloatArray, trunk_H_feet: Sequence[FloatArray], demanded: FloatArray) -> FloatArray:
        """Wrenches in the frames of two feet that both bear; shape (n, 2, 6); N, N m."""
        total = np.concatenate([wrench_matrix(pose) for pose in trunk_H_feet], axis=2)  # of both feet; (n, 6, 12)
        cheap = total.transpose(0, 2, 1) / np.tile(_COST, 2)[:, None]
        pushes = self.pushes(seconds)[..., None]
        loads: FloatArray = pushes + cheap @ np.linalg.solve(total @ cheap, demanded[..., None] - total @ pushes)
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
