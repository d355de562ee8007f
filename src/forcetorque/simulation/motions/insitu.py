# SPDX-License-Identifier: BSD-3-Clause
"""Motions of in situ calibration: grid, z-torque and balancing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.robot.contacts import Contact
from forcetorque.robot.kinematics import body_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.question import Question
from forcetorque.robot.model import JointType
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.newton_euler import expected_wrenches
from forcetorque.simulation.motions.limbs import Limb, legs_of, limb_of
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.stand import Stand

_ALONG = 0.9
"""Cosine above which two axes count as one: 26 degrees."""


def grid_movement(
    stand: Stand,
    sensor: str,
    *,
    joints: tuple[str, str] | None = None,
    steps: int = 7,
    hold_s: float = 0.0,
    name: str | None = None,
) -> Movement:
    """Carry the limb beyond a sensor over a grid of two joints between support and sensor.

    Everything beyond the sensor stays as it is, so the centre of mass stays where it is in the
    sensor's frame, and the force on the sensor goes over a part of a sphere. The second joint goes
    to and fro, the first one step by step.

    Args:
        stand: The robot on its support.
        sensor: Sensor of interest.
        joints: The two joints, slow one first; the first two of the limb that turn about axes of their own, neither
            along gravity at rest, if None.
        steps: Positions of each joint, spread over its range.
        hold_s: How long to rest at each; s.
        name: Name of the movement.

    Returns:
        The movement, from one corner of the grid to another.

    Raises:
        RobotError: If the limb has no two such joints, or those named do not carry the sensor.
        ShapeError: If there are fewer than two steps.
    """
    if steps < 2:
        raise ShapeError(f"steps: expected at least 2 positions of a joint, got {steps}")
    limb = limb_of(stand, sensor)
    slow, fast = _two_joints(stand, limb) if joints is None else _named(stand, limb, joints)
    rows, columns = (np.linspace(*stand.range_of(joint), steps) for joint in (slow, fast))
    postures = np.tile(stand.rest, (steps * steps, 1))
    postures[:, stand.joints.index(slow)] = np.repeat(rows, steps)
    there_and_back = [columns if row % 2 == 0 else columns[::-1] for row in range(steps)]
    postures[:, stand.joints.index(fast)] = np.concatenate(there_and_back)
    trajectory = stand.through(postures, hold_s=hold_s)
    title = f"grid {limb.sensor}" if name is None else name
    return stand.movement(title, MovementKind.GRID, trajectory, trajectory.duration_s)


def _two_joints(stand: Stand, limb: Limb) -> tuple[str, str]:
    pair: list[tuple[str, FloatArray]] = []
    for joint in limb.own:
        axis = _axis(stand, joint)
        others = [stand.gravity_direction, *(other for _, other in pair)]
        turns = stand.model.joints[joint].type is not JointType.PRISMATIC
        if turns and all(abs(axis @ other) < _ALONG for other in others):
            pair.append((joint, axis))
        if len(pair) == 2:
            return pair[0][0], pair[1][0]
    raise RobotError(
        f"grid of sensor {limb.sensor!r} from {stand.support!r}: expected two joints of its limb that turn about axes "
        f"of their own, away from gravity, got {_listed(joint for joint, _ in pair)} out of {_listed(limb.own)}; name "
        f"two of {_listed(limb.between)} as joints, or choose another support"
    )


def _named(stand: Stand, limb: Limb, joints: tuple[str, str]) -> tuple[str, str]:
    stand.columns(joints)
    for joint in joints:
        if joint not in limb.between:
            raise RobotError(
                f"grid of sensor {limb.sensor!r}: expected joints between {stand.support!r} and the sensor, got "
                f"{joint!r}; known: {_listed(limb.between)}"
            )
    slow, fast = joints
    if slow == fast:
        raise RobotError(f"grid of sensor {limb.sensor!r}: expected two joints, got {slow!r} twice")
    return slow, fast


def _axis(stand: Stand, joint: str) -> FloatArray:
    """Axis of a joint in the support, at rest; shape (3,)."""
    index = next(k for k, body in enumerate(stand.tree.bodies) if body.joint == joint)
    return body_pose(stand.tree, JointMotion.at_rest(stand.joints, stand.rest[None]), index)[0, :3, 2]


def _listed(names: Iterable[str]) -> str:
    return ", ".join(map(repr, names)) or "none"


_TZ = 5
"""Component of a wrench."""


def z_torque_movement(
    stand: Stand,
    sensor: str,
    *,
    rng: np.random.Generator,
    joints: Sequence[str] | None = None,
    postures: int = 12,
    candidates: int = 200,
    hold_s: float = 0.0,
    name: str | None = None,
) -> Movement:
    """Go between postures that twist a sensor about its z axis, one way and the other in turn.

    A heuristic: of as many random postures as there are candidates the one is taken whose weight
    twists most, for every posture anew, so that no two are alike.

    Args:
        stand: The robot on its support.
        sensor: Sensor of interest.
        rng: Source of the postures.
        joints: Joints that may move; those of the sensor's limb, on either side of it, if None.
        postures: How many postures, the rest at either end not counted.
        candidates: How many random postures each is chosen from.
        hold_s: How long to rest at each; s.
        name: Name of the movement.

    Returns:
        The movement, from rest to rest.

    Raises:
        RobotError: If the limb has no joints.
        ShapeError: If there are no postures or no candidates.
    """
    if postures < 1 or candidates < 1:
        raise ShapeError(f"expected at least one posture and candidate, got {postures} and {candidates}")
    limb = limb_of(stand, sensor)
    moving = (*limb.own, *limb.outboard) if joints is None else tuple(joints)
    if not moving:
        raise RobotError(
            f"z-torque of sensor {limb.sensor!r} from {stand.support!r}: its limb has no joints; name some"
        )
    low, high = np.array([stand.range_of(joint) for joint in moving]).T
    drawn = np.tile(stand.rest, (postures, candidates, 1))
    drawn[:, :, stand.columns(moving)] = rng.uniform(low, high, (postures, candidates, len(moving)))
    still = JointMotion.at_rest(stand.joints, drawn.reshape(-1, len(stand.joints)))
    root = RootMotion.fixed(stand.gravity_direction, gravity=stand.gravity)
    wrench = expected_wrenches(stand.tree, still, root, [limb.sensor])[limb.sensor]
    twist = wrench[:, _TZ].reshape(postures, candidates)
    twist[1::2] *= -1.0
    chosen = drawn[np.arange(postures), twist.argmax(axis=1)]
    trajectory = stand.through(np.vstack([stand.rest, chosen, stand.rest]), hold_s=hold_s)
    title = f"z-torque {limb.sensor}" if name is None else name
    return stand.movement(title, MovementKind.Z_TORQUE, trajectory, trajectory.duration_s)


def weight_at_support(stand: Stand, postures: FloatArray) -> FloatArray:
    """Compute what the ground does to the robot at the support, at rest.

    Args:
        stand: The robot on its support.
        postures: Postures of all free joints; shape (k, j); rad or m.

    Returns:
        The wrench that holds its weight, in the support's frame; shape (k, 6); N, N m.
    """
    question = Question(tree=stand.tree, contacts=(Contact(link=stand.support),))
    root = RootMotion.fixed(stand.gravity_direction, gravity=stand.gravity)
    return estimate(question, JointMotion.at_rest(stand.joints, postures), root).contact_wrenches[:, 0]


_SUPPORT_SHARE, _OTHER_SHARE = 0.2, 0.4
"""How much of their range the standing leg, and trunk and arms, use around their rest."""


def balancing_movement(
    stand: Stand,
    swing: str,
    *,
    rng: np.random.Generator,
    trunk: str | None = None,
    postures: int = 12,
    candidates: int = 50,
    hold_s: float = 0.0,
    name: str | None = None,
) -> Movement:
    """Stand on one foot and move the other leg widely.

    The standing leg's sensors then carry most of the weight, those of the other leg only what hangs
    on them: one movement is a data set for both kinds, support leg and non-support leg.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        rng: Source of the postures.
        trunk: Link that both legs hang on; the last link that both feet hang on in the URDF if None.
        postures: How many postures, the rest at either end not counted.
        candidates: How many random postures each is chosen from.
        hold_s: How long to rest at each; s.
        name: Name of the movement.

    Returns:
        The movement, from rest to rest.
    """
    chosen = balancing_postures(stand, swing, rng=rng, trunk=trunk, postures=postures, candidates=candidates)
    trajectory = stand.through(np.vstack([stand.rest, chosen, stand.rest]), hold_s=hold_s)
    title = f"balancing on {stand.support}" if name is None else name
    return stand.movement(title, MovementKind.BALANCING, trajectory, trajectory.duration_s)


def balancing_postures(
    stand: Stand, swing: str, *, rng: np.random.Generator, trunk: str | None, postures: int, candidates: int
) -> FloatArray:
    """Choose postures on one foot.

    A heuristic: the swing leg's posture is random over all of its range; of the random postures of
    the rest the one is taken whose weight is nearest to above the support. The foot may still have
    to pull on the ground, as if it were bolted to it.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        rng: Source of the postures.
        trunk: Link that both legs hang on, as in `balancing_movement`.
        postures: How many postures.
        candidates: How many random postures each is chosen from.

    Returns:
        Postures of all free joints; shape (postures, j); rad or m.

    Raises:
        ShapeError: If there are no postures or no candidates.
    """
    if postures < 1 or candidates < 1:
        raise ShapeError(f"expected at least one posture and candidate, got {postures} and {candidates}")
    legs = legs_of(stand, swing, trunk=trunk)
    drawn = np.tile(stand.rest, (postures, candidates, 1))
    # the sine puts more of the postures near the ends of the range
    wide = 0.5 - 0.5 * np.cos(np.pi * rng.uniform(size=(postures, 1, len(legs.swing))))
    low, high = stand.around_rest(legs.swing, 1.0)
    drawn[:, :, stand.columns(legs.swing)] = low + (high - low) * wide
    for joints, share in ((legs.support, _SUPPORT_SHARE), (legs.others, _OTHER_SHARE)):
        low, high = stand.around_rest(joints, share)
        drawn[:, :, stand.columns(joints)] = rng.uniform(low, high, (postures, candidates, len(joints)))
    wrench = weight_at_support(stand, drawn.reshape(-1, len(stand.joints))).reshape(postures, candidates, 6)
    # the moment about the support's origin is the weight times the level way to the centre of mass
    lever = np.linalg.norm(wrench[:, :, 3:], axis=2)
    return drawn[np.arange(postures), lever.argmin(axis=1)]
