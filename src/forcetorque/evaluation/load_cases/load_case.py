# SPDX-License-Identifier: BSD-3-Clause
"""Load cases of a sensor: loads to come as wrenches, from the experiment file or by default, and the allowed error."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, mapping, require_shape
from forcetorque.base.errors import ExperimentError, ForceTorqueError, RobotError, SensorError
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.section import LOAD_CASES, LoadCaseOffset, LoadCaseTable
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.robot.dynamics import body_pose, link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree, build_tree, joint_range, joints_between, outboard_bodies

ALLOWED_SHARE: Final = 0.05
"""Error that is allowed by default, as a share of the loads: root mean square over root mean square."""
_LEAST_LEVER_M: Final = 1e-9
"""Lever below which a moment is rounding; m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadCase(ArrayRecord):
    """Loads to come, as what they add to the mean load of the fitted data."""

    name: str
    """Name."""
    words: str
    """What the loads are, in words."""
    wrench: FloatArray = field(metadata=array(None, 6))
    """The loads, each as likely as any other, in the sensor's frame and direction; shape (n, 6); N, N m."""
    offset: LoadCaseOffset = LoadCaseOffset.FITTED
    """Offset that the readings are taken with."""
    changes: Mapping[str, float] = field(default_factory=dict, metadata=mapping())
    """How far variables such as temperature are from where the offset holds, root mean square, by name."""
    allowed_force_N: float | None = None
    """Root mean square of the force error that the use allows; None for a share of the loads."""
    allowed_moment_Nm: float | None = None
    """The same of the moment error."""
    is_stated: bool = True
    """Whether a file specifies it; else it is the default."""
    readable: str = ""
    """A [[load_case]] of the kind of the default one that the sensor can read; empty where it can read this one."""
    tared: str = ""
    """The [[load_case]] with the offset that is taken anew before use; empty where no table states such loads."""

    def __post_init__(self) -> None:
        check_arrays(self)
        # a plain string would fail every `is` and count as the other offset
        object.__setattr__(self, "offset", LoadCaseOffset(self.offset))
        if not len(self.wrench) or not np.isfinite(self.wrench).all() or not self.wrench.any():
            raise SensorError(f"load case {self.name!r}: expected loads of finite size, and not all of them zero")
        for unit, allowed in (("N", self.allowed_force_N), ("N m", self.allowed_moment_Nm)):
            if allowed is not None and not 0.0 < allowed < np.inf:
                raise SensorError(f"load case {self.name!r}: expected an allowed error above 0 {unit}, got {allowed:g}")

    @property
    def force_N(self) -> float:
        """Root mean square of the forces."""
        return _root_mean_square(self.wrench[:, :3])

    @property
    def moment_Nm(self) -> float:
        """Root mean square of the moments."""
        size = _root_mean_square(self.wrench[:, 3:])
        # a force through the sensor has a moment of rounding, of which nothing can be a share
        return size if size > _LEAST_LEVER_M * self.force_N else 0.0

    @property
    def states_requirement(self) -> bool:
        """Whether a file specifies the allowed error."""
        return self.allowed_force_N is not None or self.allowed_moment_Nm is not None

    @property
    def requirement(self) -> tuple[float, float]:
        """Error that is allowed: of the force in N, of the moment in N m; infinite for what is not evaluated.

        By default both are `ALLOWED_SHARE` of the loads; where one is stated the other is free.
        """
        if not self.states_requirement:
            return ALLOWED_SHARE * self.force_N or np.inf, ALLOWED_SHARE * self.moment_Nm or np.inf
        force, moment = self.allowed_force_N, self.allowed_moment_Nm
        return np.inf if force is None else force, np.inf if moment is None else moment


def _root_mean_square(vectors: FloatArray) -> float:
    return float(np.sqrt((vectors**2).sum(axis=1).mean()))


LOADS: Final = 600
"""Number of loads that stand for a use."""
_SEED: Final = 2026


def pushes_around_sensor(force_N: float, radius_m: float) -> FloatArray:
    """Push with a force in any direction, anywhere within a radius of the sensor.

    Args:
        force_N: Magnitude of the force; N.
        radius_m: Largest distance of its point; distances are as likely as each other; m.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    rng = np.random.default_rng(_SEED)
    return at_points(force_N * _directions(rng), radius_m * rng.uniform(size=(LOADS, 1)) * _directions(rng))


def pushes_at(point_m: Any, force_N: float, radius_m: float, *, direction: Any = None) -> FloatArray:
    """Push at places within a radius of given points.

    Args:
        point_m: Points in the sensor's frame, such as one for every posture; shape (k, 3); m.
        force_N: Magnitude of the force; N.
        radius_m: How far from a point it may act; m.
        direction: Directions of the force at every point in the sensor's axes, shape (k, 3); None for any.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    rng = np.random.default_rng(_SEED)
    points = np.asarray(point_m, dtype=np.float64)
    require_shape(points, name="point_m", shape=(None, 3))
    pick = np.arange(LOADS) % len(points)
    if direction is None:
        force = force_N * _directions(rng)
    else:
        along = np.asarray(direction, dtype=np.float64)
        require_shape(along, name="direction", shape=(len(points), 3))
        force = force_N * along[pick]
    # cube root: as likely in every part of the ball
    return at_points(force, points[pick] + radius_m * np.cbrt(rng.uniform(size=(LOADS, 1))) * _directions(rng))


def weights(mass_kg: float, centre_of_mass_m: Any, gravity: float) -> FloatArray:
    """Weigh a mass that is fixed to the sensor, in every orientation.

    Args:
        mass_kg: The mass; kg.
        centre_of_mass_m: Its centres of mass in the sensor's frame, one for every posture; shape (k, 3); m.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    return pushes_at(centre_of_mass_m, mass_kg * gravity, 0.0)


def full_scale_loads(full_scale: Any, share: float) -> FloatArray:
    """Load all six components at once, each up to a share of its full scale in either direction.

    Args:
        full_scale: Full scale; shape (6,); N, N m.
        share: The share, above 0 and at most 1.

    Returns:
        Wrenches; shape (n, 6); N, N m.

    Raises:
        SensorError: If the share is not such a one.
    """
    if not 0.0 < share <= 1.0:
        raise SensorError(f"share of full scale: expected one above 0 and at most 1, got {share:g}")
    scale = np.asarray(full_scale, dtype=np.float64)
    require_shape(scale, name="full_scale", shape=(6,))
    return share * scale * np.random.default_rng(_SEED).uniform(-1.0, 1.0, (LOADS, 6))


def at_points(force: FloatArray, point: FloatArray) -> FloatArray:
    """Turn forces at points into wrenches about the origin.

    Args:
        force: Forces; shape (n, 3); N.
        point: Where they act; shape (n, 3); m.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    return np.hstack([force, np.cross(point, force)])


def _directions(rng: np.random.Generator) -> FloatArray:
    vectors = rng.normal(size=(LOADS, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


DEFAULT_RADIUS_M: Final = 0.3
"""How far from a sensor a push acts by default."""
SOLE_RADIUS_M: Final = 0.05
"""How far from the origin of a sole the weight of the robot acts by default."""
_SMALLER_RADII_M: Final = (0.04, 0.03, 0.02, 0.01, 0.0)
"""Where a sensor may read it if it cannot read that."""
_POSTURES, _POSTURE_SEED = 40, 5
_SOLES = ("sole", "foot")


Refuse = Callable[[ForceTorqueError], None]
"""Called with why a load case cannot be had at a sensor."""


def raise_rejection(error: ForceTorqueError) -> None:
    """Refuse all load cases because of one.

    Args:
        error: What is wrong with it.

    Raises:
        ForceTorqueError: Always.
    """
    raise error


def operating_load_cases(
    runs: Sequence[SensorRun],
    more: Sequence[LoadCaseTable] = (),
    *,
    matrix: FloatArray | None = None,
    refuse: Refuse = raise_rejection,
) -> tuple[LoadCase, ...]:
    """Give the load cases of a sensor.

    Args:
        runs: The sensor in its recordings, at least one.
        more: Load cases beside those of the experiments, such as those of an acceptance file.
        matrix: Matrix by which loads are turned into counts, to see whether the sensor can read them, shape (6, c); the
            prior of the experiment if left out.
        refuse: Called with what is wrong with a load case, which is then left out; raises it if left out.

    Returns:
        The load cases that are stated for the sensor; without any the weight of the robot on its sole for a sensor in
        a leg, else pushes as strong as the weight beyond the sensor, anywhere within 0.3 m; none where nothing has
        a mass beyond it.

    Raises:
        ExperimentError: If a stated load is beyond what the sensor can read, or its frame is not outboard of it.
    """
    location = _SensorLocation(runs[0])
    tables: dict[str, LoadCaseTable] = {}
    for table in (*(table for run in runs for table in run.experiment.section(LOAD_CASES)), *more):
        earlier = tables.setdefault(table.name, table)
        if earlier.model_dump_json() != table.model_dump_json():
            raise ExperimentError(
                f"two different load cases are called {table.name!r} in these files; expected one of each name"
            )
    cases, refused = [], False
    for table in tables.values():
        try:
            case = location.case(table)
            if case is not None:
                if (beyond := beyond_range(case, runs[0].sensor, matrix)) is not None:
                    raise ExperimentError(f"load case {case.name!r}: {beyond}; expected loads that it can read")
                cases.append(case)
        except ExperimentError as error:
            refused = True
            refuse(error)
    if cases or refused:
        return tuple(cases)
    default = location.default(max(_SensorLocation(run).outboard_weight for run in runs), matrix)
    return () if default is None else (default,)


class _SensorLocation:
    """Where a sensor sits in its robot, and what its outboard links do to it."""

    def __init__(self, run: SensorRun) -> None:
        self.run, self.model = run, run.experiment.model
        self.gravity = run.experiment.processing.gravity
        joint = self.model.joints[self.model.sensor(run.sensor.name).joint]
        # rooted just inboard of the sensor: what acts on the other side passes it
        self.tree: BodyTree = build_tree(self.model, joint.parent)
        self.cut = self.tree.cuts[self.model.sensor(run.sensor.name).name]
        self.outboard = outboard_bodies(self.tree, self.cut.body)

    @property
    def outboard_weight(self) -> float:
        """Weight of all outboard links, with the heaviest payload of all intervals; N."""
        used = [one for one in self.run.experiment.recording.intervals if one.use is not Use.IGNORE]
        models = [self.run.experiment.model_on(one.support) for one in used if one.support is not None]
        return self.gravity * max(
            sum(inertia.mass for link, inertia in model.links.items() if self.passes(link))
            for model in (self.model, *models)
        )

    def passes(self, link: str) -> bool:
        """Whether what acts on a link passes the sensor."""
        return bool(self.outboard[self.tree.frames[link][0]])

    def _passes_another(self, link: str) -> bool:
        """Whether what acts on a link passes another sensor of the experiment, whose load case it then is."""
        others = [sensor for sensor in self.run.experiment.sensors if sensor.name != self.run.sensor.name]
        return any(_SensorLocation(SensorRun(self.run.experiment, sensor)).passes(link) for sensor in others)

    def case(self, table: LoadCaseTable) -> LoadCase | None:
        """The loads of a table at this sensor; None where they do not pass it and the table does not name it."""
        sensor = self.model.sensor(self.run.sensor.name)
        if table.sensor is not None and table.sensor not in (sensor.name, *sensor.aliases):
            return None
        link = table.frame or table.weight_on
        if link is not None and not self.passes(link):
            if table.sensor is None and self._passes_another(link):
                return None
            raise ExperimentError(
                f"load case {table.name!r}: what acts on {link!r} does not pass the sensor {sensor.name!r}; expected a "
                "link on the side of its child link"
            )
        wrench, words = self._loads(table)
        return LoadCase(
            name=table.name,
            words=words,
            wrench=wrench,
            offset=table.offset,
            changes=table.changes,
            allowed_force_N=table.force_error_N,
            allowed_moment_Nm=table.moment_error_Nm,
            tared=_tared_text(table),
        )

    def default(self, weight: float, matrix: FloatArray | None) -> LoadCase | None:
        """The default load case; None without a mass beyond the sensor."""
        sole = self._sole()
        if sole is not None:
            wrench, words = self._stood_upon(sole, SOLE_RADIUS_M)
            stated = LoadCaseTable(name="standing", weight_on=sole, radius_m=SOLE_RADIUS_M)
            case = LoadCase(name="weight of the robot", words=words, wrench=wrench, is_stated=False)
            smaller = [LoadCaseTable(name="standing", weight_on=sole, radius_m=radius) for radius in _SMALLER_RADII_M]
        elif weight <= 0.0:
            return None
        else:
            words = f"pushes of {weight:.3g} N, the weight of the distal links, anywhere within {DEFAULT_RADIUS_M:g} m"
            wrench = pushes_around_sensor(weight, DEFAULT_RADIUS_M)
            stated = LoadCaseTable(name="push", force_N=float(f"{weight:.3g}"), radius_m=DEFAULT_RADIUS_M)
            case = LoadCase(name="push", words=words, wrench=wrench, is_stated=False)
            smaller = [self._pushed_less(wrench, weight, matrix)]
        if self._reads(case.wrench, matrix):
            return replace(case, tared=_tared_text(stated))
        fitting = (_table_text(table) for table in smaller if self._reads(self._loads(table)[0], matrix))
        return replace(case, readable=next(fitting, ""))

    def _reads(self, wrench: FloatArray, matrix: FloatArray | None) -> bool:
        """Whether the sensor can read loads, as far as its limit is known."""
        reached = _reached(wrench, self.run.sensor, matrix)
        return reached is None or reached[0] <= 1.0

    def _pushed_less(self, wrench: FloatArray, force: float, matrix: FloatArray | None) -> LoadCaseTable:
        """Pushes like those of a force, as strong as the sensor can read."""
        reached = _reached(wrench, self.run.sensor, matrix)
        least = force if reached is None else min(force, force / reached[0])
        digit = 10.0 ** (np.floor(np.log10(least)) - 1)  # two digits, rounded down
        return LoadCaseTable(
            name="push", force_N=float(f"{np.floor(least / digit) * digit:.6g}"), radius_m=DEFAULT_RADIUS_M
        )

    def _loads(self, table: LoadCaseTable) -> tuple[FloatArray, str]:
        if table.weight_on is not None:
            return self._stood_upon(table.weight_on, table.radius_m or 0.0)
        if table.full_scale_share is not None:
            words = f"up to {100.0 * table.full_scale_share:g} % of full scale in all components at once"
            return full_scale_loads(_full_scale(self.run), table.full_scale_share), words
        if table.mass_kg is not None and table.centre_of_mass_m is not None:
            wrench = weights(table.mass_kg, self._points(table.frame, table.centre_of_mass_m), self.gravity)
            return wrench, f"a tool of {table.mass_kg:g} kg in any orientation"
        return self._pushes(table, table.force_N or 0.0)

    def _pushes(self, table: LoadCaseTable, force_N: float) -> tuple[FloatArray, str]:
        radius = table.radius_m or 0.0
        if table.frame is None:
            text = f"pushes of {force_N:g} N anywhere within {radius:g} m of the sensor"
            return pushes_around_sensor(force_N, radius), text
        near = f" and {radius:g} m around" if radius else ""
        words = f"pushes of {force_N:g} N at {table.frame}{near}"
        if table.direction is None:
            return pushes_at(self._points(table.frame, np.zeros(3)), force_N, radius), words
        pose = self._poses(table.frame, still=False)
        along = pose[:, :3, :3] @ (table.direction / np.linalg.norm(table.direction))
        wrench = self._read(pushes_at(pose[:, :3, 3], force_N, radius, direction=along))
        return wrench, f"{words} along {table.direction.tolist()} of it"

    def _stood_upon(self, sole: str, radius: float) -> tuple[FloatArray, str]:
        weight = self.gravity * sum(inertia.mass for inertia in self.model.links.values())
        pose = self._poses(sole, still=True)
        wrench = pushes_at(pose[:, :3, 3], weight, radius, direction=pose[:, :3, 2])
        near = f", within {radius:g} m of its origin" if radius else ""
        return self._read(wrench), f"the weight of the robot, {weight:.3g} N, on {sole}{near}"

    def _read(self, wrench: FloatArray) -> FloatArray:
        """What the sensor reads of a wrench on what is outboard, which it holds against."""
        return -self.cut.sign * wrench

    def _points(self, frame: str | None, point: FloatArray) -> FloatArray:
        if frame is None:
            return np.asarray(point, dtype=np.float64)[None]
        pose = self._poses(frame, still=False)
        return pose[:, :3, :3] @ point + pose[:, :3, 3]

    def _poses(self, link: str, *, still: bool) -> FloatArray:
        """Poses of a link in the sensor's frame: at rest, or in postures within the limits; shape (k, 4, 4)."""
        names = joints_between(self.tree, link)
        ranges = np.array([_range(self.model, self.tree, name) for name in names]).reshape(-1, 2)
        rest = np.clip(0.0, ranges[:, 0], ranges[:, 1])[None]
        drawn = np.random.default_rng(_POSTURE_SEED).uniform(ranges[:, 0], ranges[:, 1], (_POSTURES, len(names)))
        postures = JointMotion.at_rest(names, rest if still else np.concatenate([rest, drawn]))
        sensor = body_pose(self.tree, postures, self.cut.body) @ self.cut.body_H_sensor
        return invert_pose(sensor) @ link_pose(self.tree, postures, link)

    def _sole(self) -> str | None:
        """The sole outboard of the sensor of a robot that has two; the last link of its chain that is called so."""
        for word in _SOLES:
            soles = [link for link in self.model.links if word in link.lower()]
            own = [link for link in soles if self.passes(link)]
            if own and len(soles) > len(own):
                return min(own, key=len)
        return None


def _table_text(table: LoadCaseTable) -> str:
    """Write a load case as an experiment file has it."""
    values = table.model_dump(mode="json", exclude_unset=True)
    return "\n".join(["[[load_case]]", *(f"{key} = {_toml(value)}" for key, value in values.items())])


def _toml(value: Any) -> str:
    """Write a text, a number, a list, or a mapping of numbers."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_toml(key)} = {_toml(entry)}' for key, entry in value.items())} }}"
    return json.dumps(value, ensure_ascii=False)


def _tared_text(table: LoadCaseTable) -> str:
    return _table_text(table.model_copy(update={"offset": LoadCaseOffset.TARED}))


def _range(model: RobotModel, tree: BodyTree, joint: str) -> tuple[float, float]:
    try:
        return joint_range(model, tree, joint, margin=0.0)
    except RobotError:  # no limits that make sense: it is left where it is
        return 0.0, 0.0


def _full_scale(run: SensorRun) -> FloatArray:
    sensor = run.sensor
    if sensor.full_scale is not None:
        return sensor.full_scale
    if sensor.prior is None or sensor.prior_source == "identity":
        raise ExperimentError(
            f"sensor {sensor.name!r}: a share of full scale needs full_scale of [[sensor]], or a prior matrix"
        )
    return sensor.limit_counts * np.linalg.norm(sensor.prior, axis=1)


def _reached(wrench: FloatArray, sensor: ExperimentSensor, matrix: FloatArray | None) -> tuple[float, str] | None:
    """Share of what the sensor can read that loads, shape (n, 6), reach, with a message; None without a known limit."""
    if sensor.full_scale is not None:
        largest = np.abs(wrench).max(axis=0)
        worst = int(np.argmax(largest / sensor.full_scale))
        text = (
            f"reaches {largest[worst]:.4g} {'N' if worst < 3 else 'N m'} in {WRENCH_COMPONENTS[worst]}, the full scale "
            f"of {sensor.name!r} is {sensor.full_scale[worst]:.4g}"
        )
        return float(largest[worst] / sensor.full_scale[worst]), text
    read_by = sensor.prior if matrix is None else matrix
    if read_by is None or sensor.prior_source == "identity":
        return None
    counts, limit = float(np.abs(wrench @ np.linalg.pinv(read_by).T).max()), sensor.limit_counts
    text = f"reaches {counts:.0f} counts in a channel of {sensor.name!r}, which reads up to {limit:.0f}"
    return counts / limit, text


def beyond_range(case: LoadCase, sensor: ExperimentSensor, matrix: FloatArray | None) -> str | None:
    """Compare the loads with what the sensor can read.

    Args:
        case: The load case.
        sensor: The sensor.
        matrix: Matrix by which loads are turned into counts; shape (6, c); the prior if None.

    Returns:
        What the loads reach, and the limit; None where the sensor can read them, or nobody knows its limit.
    """
    reached = _reached(case.wrench, sensor, matrix)
    return None if reached is None or reached[0] <= 1.0 else reached[1]
