# SPDX-License-Identifier: BSD-3-Clause
"""Contact switching: the robot hangs, stands on both feet, and on each of them in turn."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, ShapeError, require_known
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import joints_between
from forcetorque.simulation.motions.foot_loads import FootLoads, Hook, internal_pushes
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import balancing_postures
from forcetorque.simulation.motions.movement import Foothold, Footing, Movement, MovementKind, Phase, PhaseKind
from forcetorque.simulation.motions.on_both_feet import INTERNAL_FORCE_N
from forcetorque.simulation.motions.stance import Stance
from forcetorque.simulation.motions.trajectories import Waypoints, minimum_jerk, shortest_moves

_SETTLED_S = 0.25
"""How long all stays as it is before and after weight is handed over; s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Share:
    """How far a link has taken its load: all of it at first, then more and less of it by minimum jerk."""

    changes: tuple[tuple[float, float], ...]
    """When each change starts, in s, and by how much it changes."""
    duration_s: float
    """How long each takes; s."""

    def __call__(self, seconds: FloatArray) -> FloatArray:
        """Give the share.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The share, 0 to 1; shape (n,).
        """
        share = np.ones(len(seconds))
        for start_s, change in self.changes:
            share += change * minimum_jerk((seconds - start_s) / self.duration_s)
        return share


@dataclass(slots=True, kw_only=True)
class Course:
    """What happens one after the other, written down in the order of calls."""

    stand: Stand
    """The robot at rest."""
    still_s: float
    """How long it rests before and after it moves; s."""
    shift_s: float
    """How long weight takes to be handed over; s."""
    clock_s: float = 0.0
    """When what comes next starts; s."""
    phases: list[Phase] = field(default_factory=list)
    """Phases that are over."""
    _postures: list[FloatArray] = field(default_factory=list)
    _departures_s: list[float] = field(default_factory=list)
    _durations_s: list[float] = field(default_factory=list)
    _changes: dict[str, list[tuple[float, float]]] = field(default_factory=dict)

    def rest(self) -> None:
        """Keep still."""
        self.clock_s += self.still_s

    def move_through(self, chosen: FloatArray) -> None:
        """Rest, go through postures and back, and rest again.

        Args:
            chosen: Postures of all free joints; shape (k, j); rad or m.
        """
        way = np.vstack([self.stand.rest, chosen, self.stand.rest])
        self.rest()
        for posture, duration in zip(way[1:], shortest_moves(np.diff(way, axis=0), self.stand.speeds), strict=True):
            self._postures.append(posture)
            self._departures_s.append(self.clock_s)
            self._durations_s.append(float(duration))
            self.clock_s += float(duration)
        self.rest()

    def hand_over(self, link: str, change: float) -> None:
        """Keep still while a link takes its load, or gives it away.

        Args:
            link: The link.
            change: 1 if it takes all, -1 if it gives all away.
        """
        start_s = self.clock_s + _SETTLED_S
        self._changes.setdefault(link, []).append((start_s, change))
        self.clock_s = start_s + self.shift_s + _SETTLED_S

    def end_phase(self, label: str, kind: PhaseKind, touched: Iterable[str]) -> None:
        """Take what happened since the phase before as one.

        Args:
            label: Its name.
            kind: How the robot was borne.
            touched: Links that touched the world.
        """
        start_s = self.phases[-1].end_s if self.phases else 0.0
        self.phases.append(Phase(label=label, kind=kind, start_s=start_s, end_s=self.clock_s, touched=tuple(touched)))

    def trajectory(self) -> Waypoints:
        """Give the motion of the joints.

        Returns:
            All moves, from rest to rest.
        """
        return Waypoints(
            names=self.stand.joints,
            postures=np.vstack([self.stand.rest, *self._postures]),
            departures_s=np.array(self._departures_s),
            durations_s=np.array(self._durations_s),
            duration_s=self.clock_s,
        )

    def share(self, link: str) -> Share:
        """Give how far a link has taken its load.

        Args:
            link: The link, which has all of it at first.

        Returns:
            Its share over time.
        """
        return Share(changes=tuple(self._changes.get(link, ())), duration_s=self.shift_s)


STILL_S = 3.0
"""How long a robot rests before and after it moves, as a rule; s."""
_LEGS_SHARE, _OTHERS_SHARE = 0.6, 0.4
"""How much of their range legs, and trunk and arms, use around their rest while the robot hangs."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Resting:
    """The robot at rest on both feet, which can be held at any of its links."""

    stand: Stand
    """The robot on its first foot, in its posture at rest."""
    world_H_first: FloatArray
    """Where that foot stands; shape (4, 4); m."""

    def pose(self, link: str) -> FloatArray:
        """Where a link is; shape (4, 4); m."""
        at_rest = JointMotion.at_rest(self.stand.joints, self.stand.rest[None])
        return self.world_H_first @ link_pose(self.stand.tree, at_rest, link)[0]

    def held_at(self, link: str) -> Stand:
        """The robot in the same posture and place, held at another link."""
        return replace(self.stand, support=link, gravity_direction=-self.pose(link)[2, :3])

    def footholds(self, course: Course) -> tuple[Foothold, ...]:
        """The link that stands still in each phase, the first that touches."""
        trees = {phase.touched[0]: self.held_at(phase.touched[0]).tree for phase in course.phases}
        return tuple(
            Foothold(tree=trees[link], world_H_link=self.pose(link), start_s=phase.start_s)
            for phase in course.phases
            for link in phase.touched[:1]
        )


def contact_switching_movement(
    stance: Stance,
    *,
    rng: np.random.Generator,
    hook: str | None = None,
    steps: int = 2,
    postures: int = 3,
    candidates: int = 50,
    still_s: float = STILL_S,
    shift_s: float = 1.5,
    internal_force_N: float = INTERNAL_FORCE_N,
    name: str = "contact_switching",
) -> Movement:
    """Hang from a hook, stand on both feet, on the first, on both, on the other, and so on, ending on both.

    While weight is handed over, and as long as both feet are down, all joints hold still, so that feet and hook do. On
    both feet the robot is borne by the wrenches of least cost beside slow pushes of the feet against each other, as in
    `standing_movement`. A simplification: the hook, and a foot that bears all, bear as if they were bolted to the
    robot and the ground; the pressure of a foot that bears all is below the weight, be that under its sole or not.

    Args:
        stance: The robot on both feet; the foot of its stand bears first.
        rng: Source of the postures and pushes.
        hook: Link that the robot hangs from before it stands; it does not hang if None.
        steps: How often the robot stands on one foot.
        postures: How many postures while it hangs, and on one foot each time.
        candidates: How many random postures each of those on one foot is chosen from.
        still_s: How long it rests before and after it moves, and in each double support; s.
        shift_s: How long weight takes to be handed over; s.
        internal_force_N: How much the feet push against each other along each axis at most; N.
        name: Name of the movement.

    Returns:
        The movement. Its `phases` are `hanging` and `landing`, if there is a hook, `double_1`, the first foot's link,
        `double_2`, the other's and so on. Feet and hook are its touches; the trunk, which is carried, bears nothing.

    Raises:
        RobotError: If there is no such hook, or it is part of a leg, or a joint is out of its range.
        ShapeError: If there is no step, a time is not positive, or the force is negative.
    """
    if steps < 1 or not (0.0 < shift_s < np.inf and 0.0 < still_s < np.inf):
        raise ShapeError(
            f"expected at least one step and positive shift_s and still_s, got {steps}, {shift_s:g} and {still_s:g}"
        )
    feet, trunk = stance.feet, stance.legs.trunk
    resting = _Resting(stand=stance.resting(), world_H_first=stance.world_H_feet[0])
    course = Course(stand=resting.stand, still_s=still_s, shift_s=shift_s)
    if hook is not None:
        _require_trunk_link(stance, hook)
        course.move_through(_hanging_postures(stance, resting.held_at(hook), rng=rng, postures=postures))
        course.end_phase("hanging", PhaseKind.HANGING, [hook])
        course.hand_over(hook, -1.0)
        course.end_phase("landing", PhaseKind.LANDING, [hook, *feet])
    singles = [feet[step % 2] for step in range(steps)]
    for number, (lands, bears) in enumerate(pairwise([None, *singles, None]), start=1):
        _stand_on_both(course, feet, lands=None if lands is None else _other(feet, lands), bears=bears)
        course.end_phase(f"double_{number}", PhaseKind.DOUBLE_SUPPORT, feet)
        if bears is None:
            break
        course.move_through(
            balancing_postures(
                resting.held_at(bears),
                _other(feet, bears),
                rng=rng,
                trunk=trunk,
                postures=postures,
                candidates=candidates,
            )
        )
        label = bears if steps <= len(feet) else f"{bears}_{(number + 1) // 2}"
        course.end_phase(label, PhaseKind.SINGLE_SUPPORT, [bears])
    trajectory = course.trajectory()
    unloaded = Movement(
        name=name,
        kind=MovementKind.CONTACT_SWITCHING,
        model=stance.stand.model,
        support=trunk,
        world_H_support=resting.pose(trunk),
        duration_s=course.clock_s,
        trajectory=trajectory,
        carriage=Footing(link=trunk, joints=trajectory, footholds=resting.footholds(course)),
        gravity=stance.stand.gravity,
        phases=tuple(course.phases),
    )
    first, second = (course.share(foot) for foot in feet)
    return FootLoads(
        unloaded=unloaded,
        feet=feet,
        shares=lambda seconds: np.stack([first(seconds), second(seconds)], axis=1),
        pushes=internal_pushes(feet, internal_force_N, duration_s=course.clock_s, rng=rng),
        hook=None if hook is None else Hook(link=hook, share=course.share(hook)),
    ).borne()


def _stand_on_both(course: Course, feet: tuple[str, str], *, lands: str | None, bears: str | None) -> None:
    """Let a foot that was free take its load, rest, and let the foot give its load away that will be free."""
    if lands is not None:
        course.hand_over(lands, 1.0)
    course.rest()
    if bears is not None:
        course.hand_over(_other(feet, bears), -1.0)


def _other(feet: tuple[str, str], foot: str) -> str:
    return feet[1] if foot == feet[0] else feet[0]


def _require_trunk_link(stance: Stance, hook: str) -> None:
    """Refuse a hook on a leg: legs are to be free."""
    model, legs = stance.stand.model, {*stance.legs.support, *stance.legs.swing}
    require_known(hook, model.links, RobotError, f"hook: robot {model.name!r} has no link {hook!r}")
    between = [joint for joint in joints_between(stance.tree, hook) if joint in legs]
    if between:
        raise RobotError(
            f"hook: expected a link that no leg moves, {hook!r} hangs on {', '.join(between)}; name one of the trunk"
        )


def _hanging_postures(stance: Stance, hanging: Stand, *, rng: np.random.Generator, postures: int) -> FloatArray:
    """Postures in the air; shape (postures, j); rad or m."""
    if postures < 1:
        raise ShapeError(f"expected at least one posture, got {postures}")
    drawn = np.tile(hanging.rest, (postures, 1))
    legs = (*stance.legs.support, *stance.legs.swing)
    for joints, share in ((legs, _LEGS_SHARE), (stance.legs.others, _OTHERS_SHARE)):
        low, high = hanging.around_rest(joints, share)
        drawn[:, hanging.columns(joints)] = rng.uniform(low, high, (postures, len(joints)))
    return drawn
