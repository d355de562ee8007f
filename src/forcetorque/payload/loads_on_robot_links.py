# SPDX-License-Identifier: BSD-3-Clause
"""Loads on links of a robot: specified, from an earlier result, or estimated by a sensor between support and load."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.errors import ExperimentError
from forcetorque.base.inertia import Inertia
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.section import Loading, require_link
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem, together
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.load_from_result_file import LoadFromFile, read_load_from_file, spread_of, with_matrix_in_part
from forcetorque.payload.load_on_wrist_sensor import inertia_of_estimated, inertia_of_stated
from forcetorque.payload.load_tables import LinkLoad
from forcetorque.payload.samples_from_recordings import LoadedInterval, link_load_problem
from forcetorque.recording.recording import Interval, MovingSupport, Support, Use
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree, path_to_root


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinkLoads:
    """Loads on links of a robot, and their intervals; unspecified ones are estimated when they are first needed."""

    loads: tuple[Load, ...]
    """Loads in the order of the file, each in the frame of its link."""
    links: tuple[str, ...]
    """Their links."""
    supports: tuple[tuple[Support | MovingSupport, int], ...]
    """Support of the intervals of each load, with its number."""
    sensor: ExperimentSensor | None
    """Sensor that identifies the loads: the nearest one inboard of all of them; None where there is none."""
    weighed: tuple[LoadFromFile, ...] = ()
    """Those of them that come from an earlier result."""
    pool: Mapping[str, Experiment] = field(default_factory=dict)
    """Recordings that estimate these loads together, this one included, by name; none to use this one only."""
    _known: dict[str, LoadSolution] = field(default_factory=dict, repr=False)
    _problems: dict[Use, tuple[LoadProblem, int]] = field(default_factory=dict, repr=False)

    @property
    def in_place_of_robot(self) -> bool:
        """Never: the loads are on its links."""
        return False

    @property
    def applied(self) -> str | None:
        """No wrench is specified of loads on links."""
        return None

    def circular(self, serial: str) -> Iterator[str]:
        """Name loads of an earlier result that the same sensor identified by itself."""
        return (sentence for load in self.weighed for sentence in load.circular(serial))

    def nominal_model(self, stated: RobotModel) -> RobotModel:
        """Return the robot without the loads.

        Args:
            stated: The robot of the URDF.

        Returns:
            The same.
        """
        return stated

    def pooled(self, experiments: Mapping[str, Experiment]) -> Mapping[str, Experiment]:
        """Pool recordings, so that they estimate their loads together.

        Args:
            experiments: Experiments with one sensor, by the names of their recordings.

        Returns:
            The same experiments; those with loads on links share the estimate.

        Raises:
            ExperimentError: If files specify a load differently.
        """
        return identified_together(experiments)

    @property
    def are_stated(self) -> bool:
        """Whether all loads are specified."""
        return all(load.is_known for load in self.loads)

    def number_of(self, support: Support | MovingSupport | None) -> int | None:
        """Find the load of an interval.

        Args:
            support: Support of the interval.

        Returns:
            Index of the load; None where the file does not specify it.
        """
        if len(self.loads) == 1:
            return 0
        return next((number for other, number in self.supports if other is support), None)

    def loaded(self, intervals: Sequence[Interval]) -> list[LoadedInterval]:
        """Find the loads of intervals.

        Args:
            intervals: Intervals of the experiment.

        Returns:
            The intervals with link and index of the load.
        """
        numbers = [self.number_of(interval.support) or 0 for interval in intervals]
        return [
            LoadedInterval(interval=interval, number=number, link=self.links[number])
            for interval, number in zip(intervals, numbers, strict=True)
        ]

    def problem(self, experiment: Experiment, *, use: Use = Use.CALIBRATION) -> LoadProblem:
        """Set up the estimation of the loads with an exact matrix.

        Args:
            experiment: The experiment, of which the recording and its intervals are used.
            use: Use of the intervals.

        Returns:
            The problem.

        Raises:
            ExperimentError: If no sensor measures all loads, or there is no such interval.
        """
        return self._problem_and_left_out(experiment, use)[0]

    def left_out(self, experiment: Experiment, *, use: Use = Use.CALIBRATION) -> int:
        """Count samples of intervals without a finite measurement or motion.

        Args:
            experiment: The experiment.
            use: Use of the intervals.

        Returns:
            Their number.
        """
        return self._problem_and_left_out(experiment, use)[1]

    def _problem_and_left_out(self, experiment: Experiment, use: Use) -> tuple[LoadProblem, int]:
        if use in self._problems:
            return self._problems[use]
        if self.sensor is None:
            names = ", ".join(repr(load.name) for load in self.loads)
            raise ExperimentError(
                f"load: expected one [[sensor]] beyond which all of {names} hang, which weighs them, got none; state "
                "mass_kg and centre_of_mass_m, or weigh each in an experiment of its own"
            )
        intervals = sorted(experiment.intervals(use), key=lambda interval: interval.start_ns)
        sessions = [experiment.session_names(interval.label)[-1] for interval in intervals]
        self._problems[use] = link_load_problem(
            experiment, self.sensor, self.loaded(intervals), self.loads, sessions=sessions
        )
        return self._problems[use]

    def solution(self, experiment: Experiment) -> LoadSolution:
        """Estimate the loads on the calibration intervals, with an uncertain matrix, when first needed.

        Pooled recordings are used together.

        Args:
            experiment: The experiment, of which the recording and its intervals are used.

        Returns:
            Loads and offsets.
        """
        if "solution" not in self._known:
            problem = joined_problem(self.pool or {experiment.name: experiment})
            self._known["solution"] = solve(with_matrix_in_part(problem, spread_of(experiment, self.weigher)))
        return self._known["solution"]

    @property
    def weigher(self) -> ExperimentSensor:
        """Sensor that identifies the loads.

        Raises:
            ExperimentError: If there is none.
        """
        if self.sensor is None:
            raise ExperimentError("load: expected one [[sensor]] beyond which all loads hang, got none")
        return self.sensor

    def model_on(self, support: Support | MovingSupport, experiment: Experiment) -> RobotModel:
        """Make the robot with the load of an interval.

        Args:
            support: Support of the interval.
            experiment: The experiment.

        Returns:
            The robot.

        Raises:
            ExperimentError: If the file does not specify the load, or the recording does not determine it.
        """
        number = self.number_of(support)
        if number is None:
            raise ExperimentError(
                f"support {support.frame!r}: expected an interval that says which load hangs on the robot: "
                f"{', '.join(load.name for load in self.loads)}"
            )
        load = self.loads[number]
        if load.is_known:
            return carrying(experiment.model, self.links[number], inertia_of_stated(load))
        solution = self.solution(experiment)
        estimated = next(estimate for estimate in solution.loads if estimate.name == load.name)
        return carrying(experiment.model, self.links[number], inertia_of_estimated(solution, estimated))


def link_loads(experiment: Experiment) -> LinkLoads | None:
    """Return the loads on links of a robot beyond those of its URDF.

    Returns:
        The loads; None where there are none.
    """
    loads = experiment.loads
    return loads if isinstance(loads, LinkLoads) else None


def identified_together(experiments: Mapping[str, Experiment]) -> dict[str, Experiment]:
    """Pool recordings where a load of one of them is not specified.

    Two tools determine a matrix, and each other, more accurately than one does.

    Args:
        experiments: Experiments with one sensor, by the names of their recordings.

    Returns:
        The same experiments; those with loads on links share the estimate.

    Raises:
        ExperimentError: If files specify a load differently.
    """
    loads = {name: link_loads(experiment) for name, experiment in experiments.items()}
    pool = {name: experiments[name] for name, on_links in loads.items() if on_links is not None}
    present = [on_links for on_links in loads.values() if on_links is not None]
    if len(pool) < 2 or all(on_links.are_stated for on_links in present) or all(on_links.pool for on_links in present):
        return dict(experiments)
    _loads_of(pool)
    known: dict[str, LoadSolution] = {}
    return {
        name: experiments[name]
        if on_links is None
        else experiments[name].with_loads(replace(on_links, pool=pool, _known=known))
        for name, on_links in loads.items()
    }


def joined_problem(
    experiments: Mapping[str, Experiment],
    *,
    use: Use = Use.CALIBRATION,
    among: Mapping[str, Experiment] | None = None,
) -> LoadProblem:
    """Set up the joint estimation of the loads of recordings.

    Args:
        experiments: Experiments with loads on links, by the names of their recordings.
        use: Use of the intervals; recordings without such an interval are left out.
        among: Recordings that define the indices of the loads, if these are more.

    Returns:
        The problem.

    Raises:
        ExperimentError: If no recording has such an interval, or files specify a load differently.
    """
    loads = _loads_of(among or experiments)
    problems: dict[str, LoadProblem] = {}
    for name, experiment in experiments.items():
        on_links = link_loads(experiment)
        if on_links is None or not any(interval.use is use for interval in experiment.recording.intervals):
            continue
        problem = on_links.problem(experiment, use=use)
        numbers = np.array([list(loads).index(load.name) for load in problem.loads])
        rows = replace(problem.rows, load=numbers[problem.rows.load])
        problems[name] = replace(problem, loads=tuple(loads.values()), rows=rows)
    if not problems:
        raise ExperimentError(
            f'{", ".join(experiments)}: expected an interval with use = "{use}", which weighs the loads, got none; '
            "state mass_kg and centre_of_mass_m"
        )
    return together(problems)


def _loads_of(experiments: Mapping[str, Experiment]) -> dict[str, Load]:
    """Loads by name, those of the first recording first."""
    loads: dict[str, tuple[Load, str]] = {}
    for name, experiment in experiments.items():
        on_links = link_loads(experiment)
        if on_links is None:
            continue
        for load, link in zip(on_links.loads, on_links.links, strict=True):
            first, first_link = loads.setdefault(load.name, (load, link))
            if first_link != link or not _same_load(first, load):
                raise ExperimentError(
                    f"{name}: load {load.name!r}: expected the link, mass_kg, centre_of_mass_m and inertia_kgm2 that "
                    "another recording states of it, got others; give another tool another name, and state one alike"
                )
    return {name: load for name, (load, _) in loads.items()}


def _same_load(first: Load, other: Load) -> bool:
    fields = ("mass", "centre_of_mass", "inertia", "expected", "precision")
    return all(np.array_equal(getattr(first, field), getattr(other, field)) for field in fields)


def read_link_loads(tables: Sequence[LinkLoad], loading: Loading) -> LinkLoads | None:
    """Check the loads of an experiment file.

    Args:
        tables: Tables `[[load]]`.
        loading: Robot, sensors and recording, whose intervals have a different support for every load.

    Returns:
        The loads; None where there are none.

    Raises:
        ExperimentError: If a link is not in the robot, or not beyond a sensor.
    """
    file, model, sensors = loading.file, loading.model, loading.sensors
    supports = _supports_of_loads(tables, loading)
    if not tables:
        return None
    loads: list[Load] = []
    weighed: list[LoadFromFile] = []
    for index, table in enumerate(tables):
        where = f"{file}: load[{index}] {table.name!r}"
        require_link(model, table.link, where)
        with stated_in(where):
            if table.weighed is None:
                loads.append(_specified(table))
            else:
                weighed.append(read_load_from_file(loading.inputs.file(table.weighed), table.name, table.link))
                loads.append(weighed[-1].load)
    frames = {(support.frame, tables[number].link, number) for support, number in supports}
    inboard: list[set[str]] = []
    for frame, link, number in sorted(frames):
        names = _inboard_sensors(model, frame, link)
        inboard.append({sensor.name for sensor in sensors if sensor.name in names})
        if not inboard[-1] and tables[number].mass_kg != 0.0:
            raise ExperimentError(
                f"{file}: load[{number}] {tables[number].name!r}: expected a link beyond a sensor of the file, as seen "
                f"from the support {frame!r}, got {link!r}, whose load no sensor feels; name the link that the tool is "
                "fastened to, or the support that the robot stands on"
            )
        # the nearest sensor first
        sensors = tuple(sorted(sensors, key=lambda s: names.index(s.name) if s.name in names else len(names)))
    shared = set.intersection(*inboard) if inboard else set()
    return LinkLoads(
        loads=tuple(loads),
        links=tuple(table.link for table in tables),
        supports=tuple(supports),
        sensor=next((sensor for sensor in sensors if sensor.name in shared), None),
        weighed=tuple(weighed),
    )


def _specified(table: LinkLoad) -> Load:
    load = Load(name=table.name, mass=table.mass_kg, centre_of_mass=table.centre_of_mass_m, inertia=table.inertia_kgm2)
    if load.is_known or load.inertia is not None:
        return load
    # for a point mass, the effect of its inertia would be attributed to its centre of mass, or to the matrix
    return replace(load, inertia="unknown")


def _inboard_sensors(model: RobotModel, support: str, link: str) -> list[str]:
    """Sensors between a support and a link, the nearest to the link first."""
    tree = build_tree(model, support)
    path = path_to_root(tree, tree.frames[link][0])
    at = {cut.body: name for name, cut in tree.cuts.items()}
    return [at[body] for body in path if body in at]


def with_loads_named(
    intervals: Sequence[Interval], named: Sequence[str | None], loads: Sequence[LinkLoad]
) -> list[Interval]:
    """Copy the supports, one for every load, so that the support of an interval determines its load.

    Args:
        intervals: Intervals in the order of the file.
        named: Name of the load of each interval.
        loads: Loads of the file.

    Returns:
        The intervals.
    """
    supports: dict[tuple[int, int], Support | MovingSupport] = {}
    placed: list[Interval] = []
    for interval, name in zip(intervals, named, strict=True):
        number = _number_of(name, loads)
        if interval.support is None or number is None:
            placed.append(interval)
            continue
        support = supports.setdefault((id(interval.support), number), replace(interval.support))
        placed.append(replace(interval, support=support))
    return placed


def _number_of(name: str | None, loads: Sequence[LinkLoad]) -> int | None:
    names = [load.name for load in loads]
    return names.index(name) if name in names else 0 if len(names) == 1 else None


def _supports_of_loads(tables: Sequence[LinkLoad], loading: Loading) -> tuple[tuple[Support | MovingSupport, int], ...]:
    """Supports of `with_loads_named`, each with the index of its load."""
    named = {table.label: table.load for table in loading.parsed.interval}
    supports: dict[int, tuple[Support | MovingSupport, int]] = {}
    for interval in loading.recording.intervals:
        number = _number_of(named[interval.label], tables)
        if interval.support is not None and number is not None:
            supports.setdefault(id(interval.support), (interval.support, number))
    return tuple(supports.values())


def carrying(model: RobotModel, link: str, load: Inertia) -> RobotModel:
    """Add a load to a link.

    Args:
        model: The robot.
        link: The link.
        load: Inertia of the load in the frame of the link.

    Returns:
        The robot with the load.
    """
    return replace(model, links={**model.links, link: model.links[link] + load})
