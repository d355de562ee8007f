# SPDX-License-Identifier: BSD-3-Clause
"""Loads on links of a robot: stated, weighed before, or estimated by the sensor that they are beyond."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.section import Loading
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem, together
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.load_from_result_file import WeighedLoad, read_weighed, spread_of, with_matrix_in_part
from forcetorque.payload.load_on_wrist_sensor import inertia_of_estimated, inertia_of_stated
from forcetorque.payload.samples_from_recordings import HungInterval, link_load_problem
from forcetorque.payload.toml_tables import LinkLoad
from forcetorque.recording.recording import Interval, MovingSupport, Support, Use
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree, path_to_root


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinkLoads:
    """What hangs on links of a robot, and in which intervals; what nobody stated is estimated when it is asked for."""

    loads: tuple[Load, ...]
    """Loads in the order of the file, each in the frame of its link."""
    links: tuple[str, ...]
    """Their links."""
    supports: tuple[tuple[Support | MovingSupport, int], ...]
    """Support of the intervals of each load, with its number."""
    sensor: ExperimentSensor | None
    """Sensor that weighs: the nearest one that all are beyond; None where there is none."""
    weighed: tuple[WeighedLoad, ...] = ()
    """Those among them that were weighed before."""
    beside: Mapping[str, Experiment] = field(default_factory=dict)
    """Recordings that weigh these loads together, this one among them, by name; none to ask this one alone."""
    _known: dict[str, LoadSolution] = field(default_factory=dict, repr=False)
    _problems: dict[Use, tuple[LoadProblem, int]] = field(default_factory=dict, repr=False)

    @property
    def in_place_of_robot(self) -> bool:
        """Never: they hang on its links."""
        return False

    @property
    def applied(self) -> str | None:
        """No wrench is stated of loads on links."""
        return None

    def nominal_model(self, stated: RobotModel) -> RobotModel:
        """Give the robot without the loads.

        Args:
            stated: The robot of the URDF.

        Returns:
            The same.
        """
        return stated

    def pooled(self, experiments: Mapping[str, Experiment]) -> Mapping[str, Experiment]:
        """Let recordings identify their loads together where one of them has a load that nobody stated.

        Args:
            experiments: Experiments with one sensor, by the names of their recordings.

        Returns:
            The same; those with loads on links share what is estimated.

        Raises:
            ExperimentError: If files say different things of a load.
        """
        return weighed_together(experiments)

    @property
    def are_stated(self) -> bool:
        """Whether nothing of any load is to be estimated."""
        return all(load.is_known for load in self.loads)

    def number_of(self, support: Support | MovingSupport | None) -> int | None:
        """Say which load hangs on the robot in an interval.

        Args:
            support: Support of the interval.

        Returns:
            Its number; None where the file does not say.
        """
        if len(self.loads) == 1:
            return 0
        return next((number for own, number in self.supports if own is support), None)

    def hung(self, intervals: Sequence[Interval]) -> list[HungInterval]:
        """Say what hangs in intervals.

        Args:
            intervals: Intervals of the experiment.

        Returns:
            The same with link and number of the load.
        """
        numbers = [self.number_of(interval.support) or 0 for interval in intervals]
        return [
            HungInterval(interval=interval, number=number, link=self.links[number])
            for interval, number in zip(intervals, numbers, strict=True)
        ]

    def problem(self, experiment: Experiment, *, use: Use = Use.CALIBRATION) -> LoadProblem:
        """Ask what intervals tell of the loads, if the matrix were exact.

        Args:
            experiment: The experiment, of which the recording and its intervals are used.
            use: Use of the intervals.

        Returns:
            The problem.

        Raises:
            ExperimentError: If no sensor weighs all the loads, or there is no such interval.
        """
        return self._problem_and_left_out(experiment, use)[0]

    def left_out(self, experiment: Experiment, *, use: Use = Use.CALIBRATION) -> int:
        """Count samples of intervals that lack a finite reading or motion.

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
            experiment, self.sensor, self.hung(intervals), self.loads, sessions=sessions
        )
        return self._problems[use]

    def solution(self, experiment: Experiment) -> LoadSolution:
        """Estimate the loads on the calibration intervals, with the matrix known in part, when it is first asked for.

        Recordings beside this one take part.

        Args:
            experiment: The experiment, of which the recording and its intervals are used.

        Returns:
            Loads and offsets.
        """
        if "solution" not in self._known:
            problem = joined_problem(self.beside or {experiment.name: experiment})
            self._known["solution"] = solve(with_matrix_in_part(problem, spread_of(experiment, self.weigher)))
        return self._known["solution"]

    @property
    def weigher(self) -> ExperimentSensor:
        """Sensor that weighs the loads.

        Raises:
            ExperimentError: If there is none.
        """
        if self.sensor is None:
            raise ExperimentError("load: expected one [[sensor]] beyond which all loads hang, got none")
        return self.sensor

    def model_on(self, support: Support | MovingSupport, experiment: Experiment) -> RobotModel:
        """Give the robot with the load of an interval.

        Args:
            support: Support of the interval.
            experiment: The experiment.

        Returns:
            The robot.

        Raises:
            ExperimentError: If the file does not say what hangs, or the recording does not determine it.
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
        estimated = next(one for one in solution.loads if one.name == load.name)
        return carrying(experiment.model, self.links[number], inertia_of_estimated(solution, estimated))


def link_loads(experiment: Experiment) -> LinkLoads | None:
    """Give what hangs on links of a robot beside what its URDF says.

    Args:
        experiment: The experiment.

    Returns:
        The loads; None for nothing.
    """
    loads = experiment.loads
    return loads if isinstance(loads, LinkLoads) else None


def weighed_together(experiments: Mapping[str, Experiment]) -> dict[str, Experiment]:
    """Let recordings weigh their loads together where one of them has a load that nobody stated.

    Two tools tell more of a matrix, and of each other, than one does.

    Args:
        experiments: Experiments with one sensor, by the names of their recordings.

    Returns:
        The same; those with loads on links share what is estimated.

    Raises:
        ExperimentError: If files say different things of a load.
    """
    loads = {name: link_loads(experiment) for name, experiment in experiments.items()}
    hanging = {name: experiments[name] for name, own in loads.items() if own is not None}
    known_loads = [own for own in loads.values() if own is not None]
    if len(hanging) < 2 or all(own.are_stated for own in known_loads) or all(own.beside for own in known_loads):
        return dict(experiments)
    _loads_of(hanging)
    known: dict[str, LoadSolution] = {}
    return {
        name: experiments[name]
        if own is None
        else experiments[name].with_loads(replace(own, beside=hanging, _known=known))
        for name, own in loads.items()
    }


def joined_problem(
    experiments: Mapping[str, Experiment],
    *,
    use: Use = Use.CALIBRATION,
    among: Mapping[str, Experiment] | None = None,
) -> LoadProblem:
    """Ask what recordings together tell of the loads on their robots.

    Args:
        experiments: Experiments with loads on links, by the names of their recordings.
        use: Use of the intervals; recordings without one are passed over.
        among: Recordings that number the loads, if those are more.

    Returns:
        The problem.

    Raises:
        ExperimentError: If no recording has such an interval, or files say different things of a load.
    """
    loads = _loads_of(among or experiments)
    problems: dict[str, LoadProblem] = {}
    for name, experiment in experiments.items():
        hanging = link_loads(experiment)
        if hanging is None or not any(one.use is use for one in experiment.recording.intervals):
            continue
        own = hanging.problem(experiment, use=use)
        numbers = np.array([list(loads).index(load.name) for load in own.loads])
        rows = replace(own.rows, load=numbers[own.rows.load])
        problems[name] = replace(own, loads=tuple(loads.values()), rows=rows)
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
        hanging = link_loads(experiment)
        if hanging is None:
            continue
        for load, link in zip(hanging.loads, hanging.links, strict=True):
            first, on = loads.setdefault(load.name, (load, link))
            if on != link or not _alike(first, load):
                raise ExperimentError(
                    f"{name}: load {load.name!r}: expected the link, mass_kg, centre_of_mass_m and inertia_kgm2 that "
                    "another recording states of it, got others; give another tool another name, and state one alike"
                )
    return {name: load for name, (load, _) in loads.items()}


def _alike(first: Load, other: Load) -> bool:
    fields = ("mass", "centre_of_mass", "inertia", "expected", "precision")
    return all(np.array_equal(getattr(first, field), getattr(other, field)) for field in fields)


def read_link_loads(tables: Sequence[LinkLoad], loading: Loading) -> LinkLoads | None:
    """Take the loads of an experiment file.

    Args:
        tables: Tables `[[load]]`.
        loading: Robot, sensors and recording, whose intervals have a support of their own for every load.

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
    weighed: list[WeighedLoad] = []
    for index, table in enumerate(tables):
        where = f"{file}: load[{index}] {table.name!r}"
        if table.link not in model.links:
            raise ExperimentError(
                f"{where}: robot {model.name!r} has no link {table.link!r}; {known_names(table.link, model.links)}"
            )
        with stated_in(where):
            if table.weighed is None:
                loads.append(_stated(table))
            else:
                weighed.append(read_weighed(loading.inputs.file(table.weighed), table.name, table.link))
                loads.append(weighed[-1].load)
    frames = {(support.frame, tables[number].link, number) for support, number in supports}
    felt: list[set[str]] = []
    for frame, link, number in sorted(frames):
        names = _inboard_sensors(model, frame, link)
        felt.append({sensor.name for sensor in sensors if sensor.name in names})
        if not felt[-1] and tables[number].mass_kg != 0.0:
            raise ExperimentError(
                f"{file}: load[{number}] {tables[number].name!r}: expected a link beyond a sensor of the file, as seen "
                f"from the support {frame!r}, got {link!r}, whose load no sensor feels; name the link that the tool is "
                "fastened to, or the support that the robot stands on"
            )
        # the nearest sensor first
        sensors = tuple(sorted(sensors, key=lambda one: names.index(one.name) if one.name in names else len(names)))
    shared = set.intersection(*felt) if felt else set()
    return LinkLoads(
        loads=tuple(loads),
        links=tuple(table.link for table in tables),
        supports=tuple(supports),
        sensor=next((sensor for sensor in sensors if sensor.name in shared), None),
        weighed=tuple(weighed),
    )


def _stated(table: LinkLoad) -> Load:
    load = Load(name=table.name, mass=table.mass_kg, centre_of_mass=table.centre_of_mass_m, inertia=table.inertia_kgm2)
    if load.is_known or load.inertia is not None:
        return load
    # taken for a point, what its inertia does passes for another centre of mass, and that for rows of the matrix
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
    """Give the intervals of every load a support of their own, by which it is known what hangs then.

    Args:
        intervals: Intervals in the order of the file.
        named: Load that each names.
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
        own = supports.setdefault((id(interval.support), number), replace(interval.support))
        placed.append(replace(interval, support=own))
    return placed


def _number_of(name: str | None, loads: Sequence[LinkLoad]) -> int | None:
    names = [load.name for load in loads]
    return names.index(name) if name in names else 0 if len(names) == 1 else None


def _supports_of_loads(tables: Sequence[LinkLoad], loading: Loading) -> tuple[tuple[Support | MovingSupport, int], ...]:
    """Supports that `with_loads_named` made, each with the number of its load."""
    named = {span.label: span.load for span in loading.parsed.interval}
    supports: dict[int, tuple[Support | MovingSupport, int]] = {}
    for interval in loading.recording.intervals:
        number = _number_of(named[interval.label], tables)
        if interval.support is not None and number is not None:
            supports.setdefault(id(interval.support), (interval.support, number))
    return tuple(supports.values())


def carrying(model: RobotModel, link: str, load: Inertia) -> RobotModel:
    """Fasten a load to a link.

    Args:
        model: The robot.
        link: The link.
        load: Inertia of the load in the frame of the link.

    Returns:
        The robot with it.
    """
    return replace(model, links={**model.links, link: model.links[link] + load})
