# SPDX-License-Identifier: BSD-3-Clause
"""Where a sensor can be taught: the robot held at a support, with a tool or none, and the joints that may move."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, RobotError
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.section import PlanTable, PlanTool
from forcetorque.recording.recording import Support, Use
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.newton_euler import expected_wrenches
from forcetorque.robot.sub_model import outboard_bodies
from forcetorque.simulation.load import with_load
from forcetorque.simulation.motions.limbs import limb_of
from forcetorque.simulation.motions.stand import Stand, joint_range

NOTHING = "none"
"""Name of what is attached where nothing is."""
_MATTERS = 1e-3
"""Share of all changes of load that a joint makes at least, of those that move."""
_SEED, _TRIALS = 8, 12


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
        root = RootMotion.fixed(self.stand.gravity_direction, gravity=self.stand.gravity)
        return expected_wrenches(self.stand.tree, motion, root, [self.sensor])[self.sensor]

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
                places.append(Workplace(stand=stand, sensor=name, tool=label, moved=moved))
    for tool in table.tool:
        if tool.name not in carried:
            raise ExperimentError(
                f"plan: tool {tool.name!r}: what hangs on {tool.frame!r} does not load the sensor {name!r} from any "
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
    rng = np.random.default_rng(_SEED)
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
