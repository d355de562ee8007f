# SPDX-License-Identifier: BSD-3-Clause
"""Load cases of a sensor: those of its experiment file, or the default one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError, RobotError
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.load_cases.load_case import (
    LoadCase,
    full_scale_loads,
    pushes_around_sensor,
    pushes_at,
    weights,
)
from forcetorque.evaluation.load_cases.section import LOAD_CASES, LoadCaseTable
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.robot.dynamics import body_pose, joints_between, link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree, build_tree, joint_range, outboard_bodies

DEFAULT_RADIUS_M: Final = 0.3
"""How far from a sensor a push acts by default."""
SOLE_RADIUS_M: Final = 0.05
"""How far from the origin of a sole the weight of the robot acts by default."""
_POSTURES, _SEED = 40, 5
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
                _require_readable(case, runs[0], matrix)
                cases.append(case)
        except ExperimentError as error:
            refused = True
            refuse(error)
    if cases or refused:
        return tuple(cases)
    default = location.default(max(_SensorLocation(run).outboard_weight for run in runs))
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
        )

    def default(self, weight: float) -> LoadCase | None:
        """The default load case; None without a mass beyond the sensor."""
        sole = self._sole()
        if sole is not None:
            wrench, words = self._stood_upon(sole, SOLE_RADIUS_M)
            return LoadCase(name="weight of the robot", words=words, wrench=wrench, is_stated=False)
        if weight <= 0.0:
            return None
        words = f"pushes of {weight:.3g} N, as much as hangs on the sensor, anywhere within {DEFAULT_RADIUS_M:g} m"
        wrench = pushes_around_sensor(weight, DEFAULT_RADIUS_M)
        return LoadCase(name="push", words=words, wrench=wrench, is_stated=False)

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
        drawn = np.random.default_rng(_SEED).uniform(ranges[:, 0], ranges[:, 1], (_POSTURES, len(names)))
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


def _require_readable(case: LoadCase, run: SensorRun, matrix: FloatArray | None) -> None:
    """Refuse loads that the sensor cannot read."""
    sensor = run.sensor
    if sensor.full_scale is not None:
        largest = np.abs(case.wrench).max(axis=0)
        worst = int(np.argmax(largest / sensor.full_scale))
        if largest[worst] > sensor.full_scale[worst]:
            raise ExperimentError(
                f"load case {case.name!r}: reaches {largest[worst]:.4g} {'N' if worst < 3 else 'N m'} in "
                f"{WRENCH_COMPONENTS[worst]}, the full scale of {sensor.name!r} is {sensor.full_scale[worst]:.4g}"
            )
        return
    read_by = sensor.prior if matrix is None else matrix
    if read_by is None or sensor.prior_source == "identity":
        return
    counts = float(np.abs(case.wrench @ np.linalg.pinv(read_by).T).max())
    if counts > sensor.limit_counts:
        raise ExperimentError(
            f"load case {case.name!r}: reaches {counts:.0f} counts in a channel of {sensor.name!r}, which reads up to "
            f"{sensor.limit_counts:.0f}; expected loads that it can read"
        )
