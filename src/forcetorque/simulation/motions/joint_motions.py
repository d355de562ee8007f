# SPDX-License-Identifier: BSD-3-Clause
"""Motions of joints of a held robot: grid, z-torque and balancing (in situ calibration), random smooth ones."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, names
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.robot.contacts import Contact
from forcetorque.robot.dynamics import body_pose, expected_wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.model import JointType
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.simulation.motions.held_robot import Limb, Stand, legs_of, limb_of
from forcetorque.simulation.motions.movement import Movement, MovementKind

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


_HARMONICS = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SumOfSines(ArrayRecord):
    """A trajectory of joints that are sums of sines, each of its own."""

    names: tuple[str, ...] = field(metadata=names("j"))
    """Joints."""
    centre: FloatArray = field(metadata=array("j"))
    """Middle of every joint's range; shape (j,); rad or m."""
    amplitude: FloatArray = field(metadata=array("j", _HARMONICS))
    """Amplitudes; shape (j, h); rad or m."""
    omega: FloatArray = field(metadata=array("j", _HARMONICS))
    """Angular frequencies; shape (j, h); rad/s."""
    phase: FloatArray = field(metadata=array("j", _HARMONICS))
    """Phases at 0 s; shape (j, h); rad."""

    @classmethod
    def draw(
        cls, ranges: Mapping[str, tuple[float, float]], *, slowest_hz: float, rng: np.random.Generator
    ) -> SumOfSines:
        """Draw frequencies and phases; the amplitudes add up to half of the range.

        Args:
            ranges: Lowest and highest position of every joint; rad or m.
            slowest_hz: About the frequency of the slowest sine; Hz.
            rng: Source of amplitudes, frequencies and phases.

        Returns:
            The trajectory.
        """
        centre, amplitude, omega, phase = [], [], [], []
        for low, high in ranges.values():
            weights = rng.uniform(0.5, 1.0, _HARMONICS)
            amplitude.append(weights * (0.5 * (high - low) / weights.sum()))
            omega.append(2.0 * np.pi * slowest_hz * (np.arange(_HARMONICS) + rng.uniform(0.7, 1.3, _HARMONICS)))
            phase.append(rng.uniform(0.0, 2.0 * np.pi, _HARMONICS))
            centre.append(0.5 * (low + high))
        shape = (len(ranges), _HARMONICS)  # also of no joints
        return cls(
            names=tuple(ranges),
            centre=np.array(centre),
            amplitude=np.reshape(amplitude, shape),
            omega=np.reshape(omega, shape),
            phase=np.reshape(phase, shape),
        )

    def no_faster_than(self, speeds: FloatArray) -> SumOfSines:
        """Slow down the joints that could exceed a speed.

        Args:
            speeds: Largest speed of every joint; shape (j,); rad/s or m/s.

        Returns:
            The trajectory, with lower frequencies where needed.
        """
        fastest = np.abs(self.amplitude * self.omega).sum(axis=1)
        slower = np.minimum(1.0, speeds / np.where(fastest > 0.0, fastest, speeds))
        return replace(self, omega=self.omega * slower[:, None])

    def __call__(self, seconds: FloatArray) -> JointMotion:
        """Give the motion of the joints.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The motion with its exact derivatives; n samples.
        """
        position, velocity, acceleration = (np.empty((len(seconds), len(self.names))) for _ in range(3))
        for k, (amplitude, omega) in enumerate(zip(self.amplitude, self.omega, strict=True)):
            angle = seconds[:, None] * omega + self.phase[k]
            sine = np.sin(angle)
            position[:, k] = self.centre[k] + sine @ amplitude
            velocity[:, k] = np.cos(angle) @ (amplitude * omega)
            acceleration[:, k] = -sine @ (amplitude * omega**2)
        return JointMotion(names=self.names, position=position, velocity=velocity, acceleration=acceleration)


def random_smooth_motion(
    ranges: Mapping[str, tuple[float, float]], seconds: FloatArray, *, slowest_hz: float, rng: np.random.Generator
) -> JointMotion:
    """Move joints by sums of sines with random phases, inside given ranges.

    Args:
        ranges: Lowest and highest position of every joint; rad or m.
        seconds: Instants; shape (n,); s.
        slowest_hz: About the frequency of the slowest sine; Hz.
        rng: Source of phases and frequencies.

    Returns:
        The motion with its exact derivatives; n samples.
    """
    return SumOfSines.draw(ranges, slowest_hz=slowest_hz, rng=rng)(seconds)


def random_movement(
    stand: Stand,
    *,
    rng: np.random.Generator,
    duration_s: float,
    slowest_hz: float = 0.1,
    joints: Sequence[str] | None = None,
    name: str = "random",
) -> Movement:
    """Move joints smoothly and at random over their ranges, no faster than the stand allows.

    Args:
        stand: The robot on its support.
        rng: Source of amplitudes, frequencies and phases.
        duration_s: How long it takes; s.
        slowest_hz: About the frequency of the slowest sine of joints that are not slowed down; Hz.
        joints: Joints that move, the others rest; all free ones if None.
        name: Name of the movement.

    Returns:
        The movement; it neither starts nor ends at rest.

    Raises:
        ShapeError: If the frequency is not positive.
    """
    if not 0.0 < slowest_hz < np.inf:
        raise ShapeError(f"slowest_hz: expected a positive frequency in Hz, got {slowest_hz:g}")
    moving = stand.joints if joints is None else tuple(joints)
    stand.columns(moving)
    ranges = {
        joint: stand.range_of(joint) if joint in moving else (rest, rest)
        for joint, rest in zip(stand.joints, map(float, stand.rest), strict=True)
    }
    trajectory = SumOfSines.draw(ranges, slowest_hz=slowest_hz, rng=rng).no_faster_than(stand.speeds)
    return stand.movement(name, MovementKind.RANDOM, trajectory, duration_s)
