# SPDX-License-Identifier: BSD-3-Clause
"""What the ground does to each foot of a robot that stands on two, and what a hook does that it hangs from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import ShapeError
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import WRENCH_COMPONENTS, transform_wrench, wrench_matrix
from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.dynamics import link_pose
from forcetorque.simulation.motions.movement import Movement, Touch
from forcetorque.simulation.motions.trajectories import Spline

_COST = np.array([1.0, 1.0, 0.05, 150.0, 150.0, 150.0])
"""Cost of a squared component of a foot's wrench: the vertical force is cheap, and 1 N m costs as much as 12 N along
the ground, so that weight is borne near the middle of the sole."""
_PUSH_LEVER_M, _PUSH_PERIOD_S = 0.1, 2.0
"""Internal moments over internal forces, and time from target to target of both."""


class Hook(NamedTuple):
    """A link beside the feet that a robot may hang from."""

    link: str
    """The link, in whose frame the wrench is."""
    share: Callable[[FloatArray], FloatArray]
    """From instants (n,) in s to how much of the load it bears, 0 to 1; the feet bear the rest; shape (n,)."""


def internal_pushes(
    feet: tuple[str, str], force_N: float, *, duration_s: float, rng: np.random.Generator
) -> Callable[[FloatArray], FloatArray]:
    """Draw how feet push against each other.

    Args:
        feet: Links of the feet.
        force_N: Force along each axis at most; moments go with it by a lever of 0.1 m; N.
        duration_s: How long it goes on; s.
        rng: Source of the pushes.

    Returns:
        From instants (n,) in s to what each foot would rather do, foot after foot; shape (n, 12); N, N m.

    Raises:
        ShapeError: If the force is negative.
    """
    if not 0.0 <= force_N < np.inf:
        raise ShapeError(f"internal_force_N: expected a force of at least 0 N, got {force_N:g}")
    reach = np.tile(np.repeat([1.0, _PUSH_LEVER_M], 3), 2) * force_N
    names = tuple(f"{foot} {component}" for foot in feet for component in WRENCH_COMPONENTS)
    return Spline.towards_targets(names, reach, duration_s=duration_s, period_s=_PUSH_PERIOD_S, rng=rng)


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
    hook: Hook | None = None
    """What bears beside the feet, if anything does."""
    _latest: dict[bytes, FloatArray] = field(init=False, repr=False, default_factory=dict)
    """Loads at the instants of the last call: the touches ask for them in turn."""

    @property
    def links(self) -> tuple[str, ...]:
        """Links that bear: the feet, then the hook."""
        return self.feet if self.hook is None else (*self.feet, self.hook.link)

    def __call__(self, seconds: FloatArray) -> FloatArray:
        """Give the wrenches that the world applies to the links that bear.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            Wrenches in the frames of `links`; shape (n, links, 6); N, N m.
        """
        instants = seconds.tobytes()
        if instants not in self._latest:
            self._latest.clear()
            loads = self._borne_by_all(seconds)
            self._latest[instants] = read_only(loads, name="loads", shape=(len(seconds), len(self.links), 6))
        return self._latest[instants]

    def _borne_by_all(self, seconds: FloatArray) -> FloatArray:
        """Wrenches in the frames of all links that bear; shape (n, links, 6); N, N m."""
        joints, tree = self.unloaded.joints(seconds), self.unloaded.tree
        demanded = self.unloaded.support_wrench(seconds)
        on_feet = self._shared(seconds, [link_pose(tree, joints, foot) for foot in self.feet], demanded)
        if self.hook is None:
            return on_feet
        share = self.hook.share(seconds)[:, None]
        hung = transform_wrench(invert_pose(link_pose(tree, joints, self.hook.link)), share * demanded)
        return np.concatenate([(1.0 - share)[..., None] * on_feet, hung[:, None]], axis=1)

    def _shared(self, seconds: FloatArray, trunk_H_feet: Sequence[FloatArray], demanded: FloatArray) -> FloatArray:
        """Wrenches in the frames of both feet, as their shares are; shape (n, 2, 6); N, N m."""
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

    def on(self, index: int, seconds: FloatArray) -> FloatArray:
        """Give the wrench that the world applies to one link.

        Args:
            index: Its place in `links`.
            seconds: Instants; shape (n,); s.

        Returns:
            Wrench in the frame of the link; shape (n, 6); N, N m.
        """
        return self(seconds)[:, index]

    def borne(self) -> Movement:
        """Let the feet, and the hook, bear what the support bore.

        Returns:
            The movement, with these links as touches and a support that bears nothing.
        """
        touches = (
            Touch(Contact(link=link, type=ContactType.KNOWN), partial(self.on, index))
            for index, link in enumerate(self.links)
        )
        return replace(self.unloaded, external=tuple(touches))
