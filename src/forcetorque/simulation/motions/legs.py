# SPDX-License-Identifier: BSD-3-Clause
"""Two legs of a robot: which joints carry the weight, and which lift the other foot."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.errors import RobotError, known_names
from forcetorque.robot import build_tree, joints_between
from forcetorque.simulation.motions.stand import Stand


@dataclass(frozen=True, slots=True, kw_only=True)
class Legs:
    """Free joints of a robot that stands on one foot."""

    trunk: str
    """Link that both legs hang on."""
    support: tuple[str, ...]
    """Joints between the trunk and the foot that stands."""
    swing: tuple[str, ...]
    """Joints between the trunk and the other foot."""
    others: tuple[str, ...]
    """All other free joints: of the trunk, arms and head."""


def legs_of(stand: Stand, swing: str, *, trunk: str | None = None) -> Legs:
    """Tell the legs apart.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        trunk: Link that both legs hang on; the last link that both feet hang on in the URDF if None.

    Returns:
        The joints of both legs, and the others.

    Raises:
        RobotError: If there is no such link, or a leg has no joints of its own.
    """
    for link in (swing, *(() if trunk is None else (trunk,))):
        if link not in stand.model.links:
            raise RobotError(f"robot {stand.model.name!r} has no link {link!r}; {known_names(link, stand.model.links)}")
    middle = _common_ancestor(stand, swing) if trunk is None else trunk
    tree = build_tree(stand.model, middle)
    standing, swinging = (joints_between(tree, foot) for foot in (stand.support, swing))
    shared = set(standing) & set(swinging)
    for foot, joints in ((stand.support, standing), (swing, swinging)):
        if not joints or shared:
            raise RobotError(
                f"legs from {middle!r} to {stand.support!r} and {swing!r}: expected joints of their own, {foot!r} has "
                f"{', '.join(joints) or 'none'}; name the trunk between the legs"
            )
    legs = {*standing, *swinging}
    return Legs(trunk=middle, support=standing, swing=swinging, others=tuple(j for j in stand.joints if j not in legs))


def _common_ancestor(stand: Stand, swing: str) -> str:
    parents = {joint.child: joint.parent for joint in stand.model.joints.values()}
    above = [stand.support]
    while above[-1] in parents:
        above.append(parents[above[-1]])
    link = swing
    while link not in above:
        link = parents[link]
    return link
