# SPDX-License-Identifier: BSD-3-Clause
"""One recording that could be made at a workplace: postures, the way between them, and what it would teach."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.means import means_over
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.planning.information import Knowledge, Lesson
from forcetorque.planning.search import Choices, Criterion, picked_orders, search
from forcetorque.planning.workplace import Workplace
from forcetorque.robot.motion import JointMotion
from forcetorque.simulation.motions.waypoints import Waypoints, shortest_moves

TEMPERATURE = "temperature"
"""The variable whose values a plan may choose."""
_SAME = 1e-6
"""Part of the criterion below which one recording is as good as another; the simpler one is then made."""
_SEED = 31
_SAMPLED_HZ = 4.0
"""Rate at which loads on the way are averaged over a second: moves take seconds."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Effort:
    """How long to look for a plan."""

    postures: int = 400
    """Postures to pick from, at every workplace."""
    swaps: int = 60
    """Postures that are tried in place of others, by the exact worth of the whole."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Demand:
    """What is wanted of a recording."""

    criterion: Criterion
    """What to lower."""
    seconds: float
    """How long it may take; s."""
    hold_s: float
    """How long the robot rests at every posture; s."""
    effort: Effort
    """How long to look for it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Proposal:
    """A recording."""

    place: Workplace
    """Where it is made."""
    temperature: tuple[float, float] | None
    """Temperature at the start and at the end; None where none was stated; degC."""
    trajectory: Waypoints
    """The motion of all free joints, from rest to rest."""
    after: Knowledge
    """What is known after it."""
    value: float
    """The criterion after it."""

    @property
    def postures(self) -> FloatArray:
        """Postures in turn; shape (k, j); rad or m."""
        return self.trajectory.postures

    @property
    def duration_s(self) -> float:
        """How long it takes; s."""
        return self.trajectory.duration_s


def proposals(
    places: Sequence[Workplace],
    known: Knowledge,
    demand: Demand,
    *,
    recordings: int,
    temperatures: Sequence[tuple[float, float] | None] = (None,),
    progress: Callable[[str], None] = lambda _: None,
) -> Iterator[Proposal]:
    """Find recordings one after the other, each the best once those before it are made.

    Args:
        places: Where they can be made, the simplest first.
        known: What is known before.
        demand: What is wanted of each.
        recordings: How many.
        temperatures: Temperatures at the start and at the end that are tried, the simplest first.
        progress: Called with what is being done.

    Yields:
        The recordings.

    Raises:
        ExperimentError: If there is no place.
    """
    for number in range(1, recordings + 1):
        progress(f"planning recording {number}")
        best = _best(places, known, demand, temperatures)
        yield best
        known = best.after


def propose(place: Workplace, known: Knowledge, demand: Demand, temperature: tuple[float, float] | None) -> Proposal:
    """Find a recording that teaches much at a workplace.

    Args:
        place: The workplace.
        known: What is known.
        demand: What is wanted.
        temperature: Temperature at the start and at the end.

    Returns:
        The best of what was tried.
    """
    rng = np.random.default_rng(_SEED)
    drawn = place.postures(demand.effort.postures, rng)
    loads = place.loads(JointMotion.at_rest(place.stand.joints, drawn))
    columns = np.hstack([loads, _variables(known.posterior, temperature, np.zeros(len(loads)))])
    centred = _with_centre(known, loads, demand)
    choices = Choices(
        columns=columns,
        travel_s=lambda start: _travel(place, drawn[start], drawn) + demand.hold_s,
        hold_s=demand.hold_s,
        seconds=demand.seconds - demand.hold_s,
    )
    return search(
        lambda postures: _proposal(place, known, demand, temperature, postures),
        drawn,
        picked_orders(centred, demand.criterion, choices, drawn),
        seconds=demand.seconds,
        swaps=demand.effort.swaps,
        rng=rng,
    )


def lesson_of(
    place: Workplace, posterior: Posterior, trajectory: Waypoints, temperature: tuple[float, float] | None
) -> Lesson:
    """Find what the sensor will see of a motion.

    Args:
        place: Where it is made.
        posterior: What is known, whose variables are those of the lesson.
        trajectory: The motion.
        temperature: Temperature at the start and at the end.

    Returns:
        Means over a second.
    """
    sampled = np.arange(0.0, trajectory.duration_s, 1.0 / _SAMPLED_HZ)
    motion = trajectory(sampled)
    share = sampled / max(trajectory.duration_s, 1.0)
    columns = np.hstack([place.loads(motion), _variables(posterior, temperature, share)])
    time, means, _ = means_over(sampled, columns)
    return Lesson(time_s=time, wrench=means[:, :6], variables=means[:, 6:])


def _best(
    places: Sequence[Workplace],
    known: Knowledge,
    demand: Demand,
    temperatures: Sequence[tuple[float, float] | None],
) -> Proposal:
    best: Proposal | None = None
    for temperature in temperatures:
        for place in places:
            proposal = propose(place, known, demand, temperature)
            # what comes first is simpler: nothing attached, one temperature
            if best is None or proposal.value < best.value * (1.0 - _SAME):
                best = proposal
    if best is None:
        raise ExperimentError("plan: nothing can be recorded")
    return best


def _proposal(
    place: Workplace,
    known: Knowledge,
    demand: Demand,
    temperature: tuple[float, float] | None,
    postures: FloatArray,
) -> Proposal:
    moved = np.append(True, np.abs(np.diff(postures, axis=0)).max(axis=1) > 0.0)
    trajectory = place.stand.through(postures[moved], hold_s=demand.hold_s)
    lesson = lesson_of(place, known.posterior, trajectory, temperature)
    after = known.taught(lesson)
    return Proposal(
        place=place,
        temperature=temperature,
        trajectory=trajectory,
        after=after,
        value=demand.criterion.value(after.posterior),
    )


def _travel(place: Workplace, start: FloatArray, postures: FloatArray) -> FloatArray:
    """Time from a posture to others; shape (n,); s."""
    columns = place.stand.columns(place.moved)
    return shortest_moves(postures[:, columns] - start[columns], place.stand.speeds[columns])


def _variables(posterior: Posterior, temperature: tuple[float, float] | None, share: FloatArray) -> FloatArray:
    """Variables of the posterior, of which the temperature alone changes; shape (n, v)."""
    values = np.zeros((len(share), len(posterior.variables)))
    if temperature is not None and TEMPERATURE in posterior.variables:
        values[:, posterior.variables.index(TEMPERATURE)] = (temperature[1] - temperature[0]) * share
    return values


def _with_centre(known: Knowledge, loads: FloatArray, demand: Demand) -> Posterior:
    """What is known, with the mean load that it would have after a recording in postures like these."""
    before, seconds = known.seconds, demand.seconds
    centre = (before * known.posterior.load_centre + seconds * loads.mean(axis=0)) / (before + seconds)
    return known.posterior.model_copy(update={"load_centre": centre})
