# SPDX-License-Identifier: BSD-3-Clause
"""The load of a wrist sensor as a robot of two links, with the inertia that a model takes for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.base.errors import ExperimentError
from forcetorque.base.inertia import Inertia
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.named_files import Inputs, stated_in
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem
from forcetorque.payload.identification.load_estimates import LoadEstimate, LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.load_from_result_file import LoadFromFile, read_wrist_load_from_file
from forcetorque.payload.load_tables import Load as LoadTable
from forcetorque.payload.samples_from_recordings import load_number, load_problem, samples_left_out
from forcetorque.recording.recording import MovingSupport, Support, Use
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointType, RobotModel, SensorFrame


def inertia_of_stated(load: Load) -> Inertia:
    """Give the inertia of a load of which nothing is to be estimated.

    Returns:
        Its inertia in its own frame; zero where nothing hangs, or something of it is to be estimated.
    """
    if not load.mass or isinstance(load.inertia, str):
        return Inertia.zero()
    return Inertia.about_centre_of_mass(
        mass=load.mass,
        centre_of_mass=np.zeros(3) if load.centre_of_mass is None else load.centre_of_mass,
        second_moment=np.zeros((3, 3)) if load.inertia is None else load.inertia,
    )


def inertia_of_estimated(solution: LoadSolution, estimate: LoadEstimate) -> Inertia:
    """Give the inertia of a load that readings told.

    Args:
        solution: What they told, with what they leave open.
        estimate: The load.

    Returns:
        Its inertia in its own frame.

    Raises:
        ExperimentError: If they leave it open, or fit a negative mass.
    """
    if not estimate.is_determined:
        words = "; ".join(solution.open_directions) or "no calibration interval has it"
        raise ExperimentError(
            f"load {estimate.name!r}: the calibration intervals do not determine it: {words}; `forcetorque payload` "
            "says what they do determine, and mass_kg with centre_of_mass_m state the load"
        )
    if not estimate.mass >= 0.0:
        words = "; ".join(entry.description for entry in solution.hypotheses) or "see `forcetorque payload`"
        raise ExperimentError(
            f"load {estimate.name!r}: the readings fit a mass of {estimate.mass:.3g} kg, beside the links of the URDF "
            f"where there is one; expected a positive one: {words}"
        )
    return estimate.as_inertia()


LOAD_LINK = "load"
"""Link of what hangs on the sensor."""
_JOINT = "mount"
_ANY_LOAD = Inertia.about_centre_of_mass(mass=1.0, centre_of_mass=(0.05, 0.05, 0.05), second_moment=np.zeros((3, 3)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WristLoads:
    """What hangs on a wrist sensor, and in which intervals; what nobody stated is estimated when it is asked for."""

    loads: tuple[Load, ...]
    """Loads in the order of the file."""
    supports: Mapping[str, MovingSupport]
    """Support of the intervals of each load, by its name."""
    table: LoadTable
    """What the file says of the sensor under them."""
    sensor: ExperimentSensor
    """The sensor."""
    weighed: tuple[LoadFromFile, ...] = ()
    """Loads of an earlier result."""
    _known: dict[str, LoadSolution] = field(default_factory=dict, repr=False)

    @property
    def are_stated(self) -> bool:
        """Whether nothing of any load is to be estimated."""
        return self.table.applied is not None or all(load.is_known for load in self.loads)

    @property
    def direction(self) -> MeasureDirection:
        """Who acts on whom in the reading; the load is the child."""
        return self.table.measure_direction

    @property
    def in_place_of_robot(self) -> bool:
        """Always: the file names no robot."""
        return True

    @property
    def applied(self) -> str | None:
        """Stream of the wrench that the sensor must read; None where that follows from motion and mass."""
        return self.table.applied

    def circular(self, serial: str) -> Iterator[str]:
        """Name loads of an earlier result that the same sensor identified by itself."""
        return (sentence for load in self.weighed for sentence in load.circular(serial))

    def nominal_model(self, stated: RobotModel) -> RobotModel:
        """Give the robot with a load that moves the reading as the stated one does, or as any load would.

        Args:
            stated: The robot with what the file says of the load.

        Returns:
            The same; with 1 kg beside all axes of the sensor where something of the load is to be estimated, or there
            are several.
        """
        if self.are_stated and len(self.loads) == 1:
            return stated
        return load_model(self.table, self.sensor.name, _ANY_LOAD)

    def problem(self, experiment: Experiment, *, use: Use = Use.CALIBRATION) -> LoadProblem:
        """Ask what intervals tell of the loads.

        Args:
            experiment: The experiment.
            use: Use of the intervals.

        Returns:
            The problem.
        """
        supports = tuple(self.supports.values())
        return load_problem(experiment, self.sensor, self.table, self.loads, supports, use=use)

    def left_out(self, experiment: Experiment) -> int:
        """Count samples of the calibration intervals that lack a finite reading or motion.

        Returns:
            Their number.
        """
        return samples_left_out(experiment, self.sensor)

    def solution(self, experiment: Experiment) -> LoadSolution:
        """Estimate the loads on the calibration intervals, when it is first asked for.

        Args:
            experiment: The experiment, of which the recording and its intervals are used.

        Returns:
            Loads and biases.

        Raises:
            ExperimentError: If the wrench of the load is stated, so that there is nothing to estimate.
        """
        if self.table.applied is not None:
            raise ExperimentError(
                f"load: the wrench of {self.table.applied!r} says what the sensor must read, so there is nothing to "
                "weigh; state motion in place of applied"
            )
        if "solution" not in self._known:
            self._known["solution"] = solve(self.problem(experiment))
        return self._known["solution"]

    def model_on(self, support: Support | MovingSupport, experiment: Experiment) -> RobotModel:
        """Give the robot with the load of an interval.

        Args:
            support: Support of the interval.
            experiment: The experiment.

        Returns:
            The robot.

        Raises:
            ExperimentError: If the recording does not determine the load.
        """
        number = load_number(support, tuple(self.supports.values()))
        if self.are_stated and len(self.loads) == 1:
            return experiment.model
        if self.table.mount is not None or self.table.tilt is not None or self.sensor.mount_is_unknown:
            raise ExperimentError(
                "load: an unknown mount or tilt is for `forcetorque payload`; turn the motion streams by what it says, "
                "then leave mount and tilt out"
            )
        solution = self.solution(experiment)
        inertia = inertia_of_estimated(solution, solution.loads[number])
        return load_model(self.table, self.sensor.name, inertia)

    def pooled(self, experiments: Mapping[str, Experiment]) -> Mapping[str, Experiment]:
        """Leave recordings to estimate their loads each by itself.

        Args:
            experiments: Experiments by the names of their recordings.

        Returns:
            The same.
        """
        return experiments


def stated_loads(tables: Sequence[LoadTable], inputs: Inputs) -> tuple[tuple[Load, ...], tuple[LoadFromFile, ...]]:
    """Give loads as a file states them, or the result that it names.

    Args:
        tables: Tables `[load]` or `[[load]]`.
        inputs: Opens the results that they name.

    Returns:
        The loads, and those of an earlier result.
    """
    weighed = {
        table.name: read_wrist_load_from_file(inputs.file(table.weighed), table.name, table.frame)
        for table in tables
        if table.weighed is not None
    }
    loads = tuple(
        weighed[table.name].load
        if table.name in weighed
        else Load(
            name=table.name, mass=table.mass_kg, centre_of_mass=table.centre_of_mass_m, inertia=table.inertia_kgm2
        )
        for table in tables
    )
    return loads, tuple(weighed.values())


def stated_inertia(loads: Sequence[Load]) -> Inertia:
    """Give what a file says of the load.

    Returns:
        Inertia in the frame of the sensor; zero where there are several, or something is to be estimated.
    """
    (load, *others) = loads
    return Inertia.zero() if others or not load.is_known else inertia_of_stated(load)


def read_wrist_loads(
    tables: Sequence[LoadTable],
    file: Path,
    supports: Mapping[str, MovingSupport],
    sensor: ExperimentSensor,
    inputs: Inputs,
) -> WristLoads:
    """Take the loads of an experiment file.

    Args:
        tables: Tables `[load]` or `[[load]]`.
        file: The experiment file, for messages.
        supports: Support of the intervals of each load, by its name.
        sensor: The sensor.
        inputs: Opens the results that the tables name.

    Returns:
        The loads.
    """
    with stated_in(f"{file}: load"):
        loads, weighed = stated_loads(tables, inputs)
    return WristLoads(loads=loads, supports=supports, table=tables[0], sensor=sensor, weighed=weighed)


def load_model(load: LoadTable, sensor: str, inertia: Inertia) -> RobotModel:
    """Build the robot of a wrist sensor.

    Args:
        load: The `[load]` table.
        sensor: Name of the sensor.
        inertia: Inertia of the load in the sensor's frame.

    Returns:
        Two links, joined by a fixed joint with the sensor.
    """
    identity = np.eye(4)
    return RobotModel(
        name=f"load of {sensor}",
        links={load.frame: Inertia.zero(), LOAD_LINK: inertia},
        joints={
            _JOINT: Joint(
                name=_JOINT,
                type=JointType.FIXED,
                parent=load.frame,
                child=LOAD_LINK,
                parent_H_child=identity,
                axis=np.array([1.0, 0.0, 0.0]),  # a fixed joint has none
            )
        },
        sensors={
            sensor: ForceTorqueSensor(
                name=sensor,
                joint=_JOINT,
                frame=SensorFrame.CHILD,
                direction=load.measure_direction,
                child_H_sensor=identity,
            )
        },
    )


def is_wrist_load(model: RobotModel) -> bool:
    """Tell the robot of a wrist sensor from that of a URDF file.

    Returns:
        Whether `load_model` made it.
    """
    return tuple(model.joints) == (_JOINT,) and tuple(model.links)[1:] == (LOAD_LINK,)


def wrist_loads(experiment: Experiment) -> WristLoads | None:
    """Give what hangs on a wrist sensor.

    Returns:
        The loads; None for a robot.
    """
    loads = experiment.loads
    return loads if isinstance(loads, WristLoads) else None
