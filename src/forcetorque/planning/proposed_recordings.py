# SPDX-License-Identifier: BSD-3-Clause
"""Recordings that could be made: workplaces (support, tool, joints), postures, motion and information gained."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, RobotError
from forcetorque.base.noise.window_means import means_over
from forcetorque.calibration.model_error_derivatives import UncertainPart
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.information import Knowledge, PlannedLoads
from forcetorque.planning.posture_search import Choices, Criterion, picked_orders, search
from forcetorque.planning.section import PlanTable, PlanTool
from forcetorque.recording.recording import Support, Use
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.robot.modified_robot import with_load
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import joint_range, outboard_bodies
from forcetorque.simulation.motions.held_robot import Stand, limb_of
from forcetorque.simulation.motions.trajectories import Waypoints, shortest_moves

NOTHING = "none"
"""Name of what is attached where nothing is."""
_MATTERS = 1e-3
"""Share of all changes of load that a joint makes at least, of those that move."""
_WORKPLACE_SEED, _TRIALS = 8, 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Workplace:
    """A robot on its support with a tool."""

    stand: Stand
    """The robot."""
    sensor: str
    """The sensor."""
    tool: str
    """What is attached; `none` for nothing."""
    moved: tuple[str, ...]
    """Joints that move; the others rest."""
    uncertain: UncertainPart | None = None
    """What may be wrong with the robot model; None where it is exact."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints that the load depends on, moved or at rest: those between support and sensor, and beyond it."""
        limb = limb_of(self.stand, self.sensor)
        return tuple(dict.fromkeys((*limb.between, *limb.outboard, *self.moved)))

    def loads(self, motion: JointMotion) -> FloatArray:
        """Compute what a perfect sensor reads.

        Args:
            motion: Motion of all free joints.

        Returns:
            Wrenches in the sensor's frame; shape (n, 6); N, N m.
        """
        return expected_wrenches(self.stand.tree, motion, self._root, [self.sensor])[self.sensor]

    @property
    def _root(self) -> RootMotion:
        return RootMotion.fixed(self.stand.gravity_direction, gravity=self.stand.gravity)

    def by_model(
        self, motion: JointMotion, rates: FloatArray, recording: str
    ) -> tuple[tuple[ErrorTerm, ...], FloatArray]:
        """Differentiate the loads by the errors of the robot model.

        Args:
            motion: Motion of all free joints.
            rates: Rates of change of the loads; shape (n, 6); N/s, N m/s.
            recording: Name of the recording, which has an acceleration and a delay of its own.

        Returns:
            The errors, and derivatives by them; shape (n, 6, terms); N, N m per unit of the term.
        """
        if self.uncertain is None:
            return (), np.zeros((*rates.shape, 0))
        return self.uncertain.terms_in(recording), self.uncertain.derivatives(motion, self._root, rates)

    def postures(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Draw postures: the rest first, then as many with every joint anywhere as with every joint at an end.

        Args:
            count: How many to draw.
            rng: Source of them.

        Returns:
            Postures of all free joints, each once; shape (k, j), k at most count; rad or m.
        """
        low, high = np.array([self.stand.range_of(joint) for joint in self.moved]).T
        share = rng.uniform(size=(count, len(self.moved)))
        share[::2] = np.rint(share[::2])
        drawn = np.tile(self.stand.rest, (count, 1))
        drawn[:, self.stand.columns(self.moved)] = low + share * (high - low)
        drawn[0] = self.stand.rest
        _, first = np.unique(drawn, axis=0, return_index=True)
        return drawn[np.sort(first)]


def workplaces(run: SensorRun, table: PlanTable, clearance_deg: float, supports: Sequence[Support]) -> list[Workplace]:
    """Put the robot on every support with every tool.

    Args:
        run: The sensor.
        table: What can be recorded.
        clearance_deg: What joints keep away from their limits; deg.
        supports: What may hold the robot.

    Returns:
        Workplaces at which something that moves changes the load.

    Raises:
        ExperimentError: If there is none, a joint has no range left, or a tool does not hang on the sensor.
    """
    model, name = run.experiment.model, run.experiment.model.sensor(run.sensor.name).name
    tolerance = run.experiment.fit_options.tolerance
    places: list[Workplace] = []
    carried: set[str] = set()
    for support in supports:
        bare = _stand(run, model, table, clearance_deg, support, name)
        beyond = outboard_bodies(bare.tree, bare.tree.cuts[name].body)
        for tool in (None, *table.tool):
            if tool is not None and not beyond[bare.tree.frames[tool.frame][0]]:
                continue
            carried |= {tool.name} if tool is not None else set()
            stand = bare if tool is None else _carrying(bare, tool)
            moved = _moving(stand, name)
            if moved:
                label = NOTHING if tool is None else tool.name
                uncertain = UncertainPart.of(stand.tree, bare.tree, name, tolerance)
                places.append(Workplace(stand=stand, sensor=name, tool=label, moved=moved, uncertain=uncertain))
    for tool in table.tool:
        if tool.name not in carried:
            raise ExperimentError(
                f"plan: tool {tool.name!r}: a load on {tool.frame!r} does not load the sensor {name!r} from any "
                "support; expected a link beyond the sensor"
            )
    if not places:
        held = ", ".join(repr(support.frame) for support in supports)
        raise ExperimentError(
            f"plan: no joint that may move changes the load of {name!r} held at {held}; give ranges for other joints, "
            "or another support"
        )
    return places


def supports_of(runs: Sequence[SensorRun], table: PlanTable) -> list[Support]:
    """Find what may hold the robot.

    Args:
        runs: The sensor in its recordings.
        table: What can be recorded.

    Returns:
        The supports that the table names; else those of the calibration intervals; else the first of the file.

    Raises:
        ExperimentError: If there is none at rest.
    """
    known = {support.frame: support for run in runs for support in run.experiment.supports}
    if table.support:
        return [known[frame] for frame in table.support]
    used = [
        interval.support.frame
        for run in runs
        if run.has(Use.CALIBRATION)
        for interval in run.intervals(Use.CALIBRATION)
        if isinstance(interval.support, Support)
    ]
    frames = list(dict.fromkeys(used)) or list(known)[:1]
    if not frames:
        raise ExperimentError("plan: expected a [[support]] at rest, with gravity_direction, there is none")
    return [known[frame] for frame in frames]


def _stand(
    run: SensorRun, model: RobotModel, table: PlanTable, clearance_deg: float, support: Support, sensor: str
) -> Stand:
    free = Stand(
        model=model,
        support=support.frame,
        gravity_direction=support.gravity_direction,
        speed=table.speed,
        margin=0.0,
        gravity=run.experiment.processing.gravity,
    )
    limb = limb_of(free, sensor)
    movable = dict.fromkeys((*(limb.own or limb.between), *limb.outboard, *table.ranges))
    ranges = {joint: _range(free, table, clearance_deg, joint) for joint in movable}
    return replace(free, ranges=ranges)


def _range(stand: Stand, table: PlanTable, clearance_deg: float, joint: str) -> tuple[float, float]:
    """Limits less the clearance, and what the table says of the joint."""
    kind = stand.model.joints[joint].type
    turns = kind is not JointType.PRISMATIC
    clearance = np.deg2rad(clearance_deg) if turns and kind is not JointType.CONTINUOUS else 0.0
    stated = table.ranges.get(joint)
    if stated is not None and turns:
        stated = (float(np.deg2rad(stated[0])), float(np.deg2rad(stated[1])))
    try:
        low, high = joint_range(stand.model, stand.tree, joint, margin=0.0)
    except RobotError:
        if stated is None:
            raise ExperimentError(
                f"plan: joint {joint!r}: expected limits in the URDF, lower below upper; state ranges = "
                f"{{ {joint} = [lowest, highest] }} in [plan]"
            ) from None
        return stated
    least, most = low + clearance, high - clearance
    if stated is not None:
        least, most = max(least, stated[0]), min(most, stated[1])
    if least > most:
        unit, factor = ("deg", 180.0 / np.pi) if turns else ("m", 1.0)
        beside = "" if stated is None else f" and the range {stated[0] * factor:g} to {stated[1] * factor:g} {unit}"
        raise ExperimentError(
            f"plan: joint {joint!r}: limits {low * factor:.4g} to {high * factor:.4g} {unit}, a clearance of "
            f"{clearance_deg:g} deg{beside} leave no position; state less clearance, or another range"
        )
    return least, most


def _carrying(stand: Stand, tool: PlanTool) -> Stand:
    model = with_load(stand.model, tool.frame, mass_kg=tool.mass_kg, centre_of_mass_m=tool.centre_of_mass_m)
    return replace(stand, model=model)


def _moving(stand: Stand, sensor: str) -> tuple[str, ...]:
    """Joints whose ranges change the load of the sensor."""
    place = Workplace(stand=stand, sensor=sensor, tool=NOTHING, moved=tuple(stand.ranges))
    rng = np.random.default_rng(_WORKPLACE_SEED)
    drawn = place.postures(_TRIALS, rng)
    loads = place.loads(JointMotion.at_rest(stand.joints, drawn))
    largest = np.abs(loads - loads.mean(axis=0)).max(axis=0)
    return tuple(_those_that_matter(place, drawn, loads, largest, rng)) if largest.any() else ()


def _those_that_matter(
    place: Workplace, drawn: FloatArray, loads: FloatArray, largest: FloatArray, rng: np.random.Generator
) -> Iterator[str]:
    for joint in place.moved:
        column = place.stand.columns([joint])[0]
        turned = drawn.copy()
        turned[:, column] = rng.permutation(drawn[:, column])
        change = np.abs(place.loads(JointMotion.at_rest(place.stand.joints, turned)) - loads).max(axis=0)
        if (change > _MATTERS * largest).any():
            yield joint


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


@dataclass(frozen=True, kw_only=True, eq=False)
class Proposal:
    """A recording."""

    place: Workplace
    """Where it is made."""
    temperature: tuple[float, float] | None
    """Temperature at the start and at the end; None where none was stated; degC."""
    trajectory: Waypoints
    """The motion of all free joints, from rest to rest."""
    known: Knowledge
    """What is known before it."""
    criterion: Criterion
    """What it is to lower."""

    @cached_property
    def after(self) -> Knowledge:
        """What is known after it."""
        return self.known.updated(planned_loads(self.place, self.known, self.trajectory, self.temperature))

    @cached_property
    def value(self) -> float:
        """The criterion after it."""
        return self.criterion.value(self.after.posterior)

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
    at_rest = JointMotion.at_rest(place.stand.joints, drawn)
    loads = place.loads(at_rest)
    columns = np.hstack([loads, _variables(known.posterior, temperature, np.zeros(len(loads)))])
    terms, model = place.by_model(at_rest, np.zeros_like(loads), known.next_recording)
    centred = _with_centre(known, loads, demand)
    choices = Choices(
        columns=columns,
        travel_s=lambda start: _travel(place, drawn[start], drawn) + demand.hold_s,
        hold_s=demand.hold_s,
        seconds=demand.seconds - demand.hold_s,
        terms=terms,
        model=model,
    )
    return search(
        lambda postures: _proposal(place, known, demand, temperature, postures),
        drawn,
        picked_orders(centred, demand.criterion, choices, drawn),
        seconds=demand.seconds,
        swaps=demand.effort.swaps,
        rng=rng,
    )


def planned_loads(
    place: Workplace, known: Knowledge, trajectory: Waypoints, temperature: tuple[float, float] | None
) -> PlannedLoads:
    """Compute the loads on the sensor during a motion.

    Args:
        place: Workplace of the motion.
        known: What is known of the sensor, whose variables are those of the loads.
        trajectory: The motion.
        temperature: Temperature at the start and at the end.

    Returns:
        Means over a second.
    """
    sampled = np.arange(0.0, trajectory.duration_s, 1.0 / _SAMPLED_HZ)
    motion = trajectory(sampled)
    share = sampled / max(trajectory.duration_s, 1.0)
    loads = place.loads(motion)
    rates = np.gradient(loads, 1.0 / _SAMPLED_HZ, axis=0)
    terms, model = place.by_model(motion, rates, known.next_recording)
    variables = _variables(known.posterior, temperature, share)
    time, means, _ = means_over(sampled, np.hstack([loads, variables, model.reshape(len(loads), -1)]))
    wrench, variables, model = np.split(means, [6, 6 + variables.shape[1]], axis=1)
    return PlannedLoads(
        time_s=time, wrench=wrench, variables=variables, terms=terms, model=model.reshape(len(time), 6, len(terms))
    )


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
    return Proposal(
        place=place, temperature=temperature, trajectory=trajectory, known=known, criterion=demand.criterion
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
