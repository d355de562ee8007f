# SPDX-License-Identifier: BSD-3-Clause
"""The course of a movement in which links bear a robot in turn: moves of the joints, handing over, phases."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.simulation.motions.phase import Phase, PhaseKind
from forcetorque.simulation.motions.stand import Stand
from forcetorque.simulation.motions.waypoints import Waypoints, minimum_jerk, shortest_moves

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
    """What happens one after the other, written down as it is told."""

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
