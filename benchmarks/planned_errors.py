# SPDX-License-Identifier: BSD-3-Clause
"""True errors after planned recordings of robots that are not quite their model, against those that the plan predicted.

Masses and centres of links and zeros of joints are normal with the default tolerances as deviations, the base is tilted
by 0.3 degrees; plan and calibration take the nominal URDF and these tolerances. Sensors are linear and repeat
themselves, which the file states; with `--guards` `accuracy` and `repeatability` have their defaults. Stages are
the first planned recording, the first two, and the first with one that was planned by the calibration on it.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, Literal

import numpy as np

from benchmarks.harness import write_cases
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.load_cases.load_case import LoadCase, operating_load_cases
from forcetorque.evaluation.load_cases.predicted_error import predict
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.planning.planning import plan
from forcetorque.planning.proposed_recordings import Effort, Proposal
from forcetorque.planning.result import PlannedRecording
from forcetorque.planning.section import PLAN
from forcetorque.recording.storage import write_recording
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors, with_load
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.movement import MovementKind
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.scenario.scenario import INTERVAL_MARGIN_S
from forcetorque.simulation.scenario.scenario_file import Sensors
from forcetorque.simulation.sensor_family import Specimen, draw_specimen
from forcetorque.simulation.trace import trace_movement

LINEAR: Final = "[calibration]\naccuracy = { force_N = 0.0, moment_Nm = 0.0 }\nrepeatability = 0.0\n"
"""Lines of the experiment file by which nothing but the robot model is wrong, and the sensor repeats itself."""
UNCERTAIN, EXACT = "", 'tolerance = "exact"\n'
"""Lines of the experiment file by which the robot model has the default tolerances, and none."""
MASS, CENTRE_M, ZERO_DEG, TILT_DEG = 0.03, 0.003, 0.5, 0.3
_ROBOT, _SENSOR, _POWER_UP, _NOISE = range(4)
"""What a stream of random numbers is for."""
_RATE_HZ: Final = 50.0
_TOOLS: Final = """
[[plan.tool]]
name = "bar"
frame = "hand"
mass_kg = 1.0
centre_of_mass_m = [0.2, 0.0, 0.0]
[[plan.tool]]
name = "block"
frame = "hand"
mass_kg = 1.5
centre_of_mass_m = [0.0, 0.1, 0.05]
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Limb:
    """A sensor, and how plans may move it."""

    robot: str
    sensor: str
    support: str
    force_N: float
    tools: str = ""


LIMBS = {
    "leg": Limb(robot="biped", sensor="l_leg_ft", support="pelvis", force_N=50.0),
    "arm with tools": Limb(robot="arm", sensor="arm_ft", support="base", force_N=30.0, tools=_TOOLS),
}
Stage = Literal["first", "two", "next"]
STAGES: tuple[Stage, ...] = ("first", "two", "next")
QUICK: Final = Effort(postures=150, swaps=20)


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """One sensor after planned recordings; force before moment in every pair; N, N m."""

    seed: int
    limb: str
    stage: Stage
    true: tuple[float, float]
    """Root mean square error at the load case."""
    planned: tuple[float, float]
    """Typical error that the plan predicted."""
    planned_at_most: tuple[float, float]
    """Its 95 % bound."""
    calibrated: tuple[float, float]
    """Typical error that the calibration predicts."""
    calibrated_at_most: tuple[float, float]
    """Its 95 % bound."""


@dataclass(frozen=True, kw_only=True)
class Laboratory:
    """A robot that is not quite its model, with a sensor whose matrix is off."""

    folder: Path
    seed: int
    limb: Limb
    robot: str
    """Line of the experiment file about the robot model."""
    sensors: str
    """Its lines about the accuracy of sensor and expected wrench."""

    @property
    def specimen(self) -> Specimen:
        """The sensor, whose workbench matrix is its prior."""
        sensors = Sensors(family="double range", noise_corner_hz=0.5, mounting_sd=0.05, power_up_counts=60.0)
        return draw_specimen(sensors, 0, np.random.default_rng([self.seed, _SENSOR]))

    def stand(self, model: RobotModel) -> Stand:
        """Give the true robot where it stands."""
        rng = np.random.default_rng([self.seed, _ROBOT])
        errors = RobotErrors.draw(model, mass=MASS, centre_m=CENTRE_M, joint_zero_rad=np.deg2rad(ZERO_DEG), rng=rng)
        about, tilt = rng.uniform(0.0, 2.0 * np.pi), np.deg2rad(TILT_DEG)
        down = np.array([np.sin(tilt) * np.cos(about), np.sin(tilt) * np.sin(about), -np.cos(tilt)])
        return Stand(model=errors.applied_to(model), support=self.limb.support, gravity_direction=down)

    def unrecorded(self) -> SensorRun:
        """Describe the sensor before any recording."""
        return SensorRun(load_experiment(self._written("new", ""), Purpose.PLANNING), self.limb.sensor)

    def record(self, proposal: Proposal, name: str) -> SensorRun:
        """Make a planned recording."""
        limb, number = self.limb, int.from_bytes(name.encode())
        place, way = proposal.place, proposal.trajectory
        stand, load = self.stand(read_urdf(named_robot([limb.robot]))), ""
        table = self.unrecorded().experiment.section(PLAN)
        for tool in () if table is None else table.tool:
            if tool.name == place.tool:
                carrying = with_load(
                    stand.model, tool.frame, mass_kg=tool.mass_kg, centre_of_mass_m=tool.centre_of_mass_m
                )
                stand = replace(stand, model=carrying)
                load = (
                    f'[[load]]\nlink = "{tool.frame}"\nmass_kg = {tool.mass_kg}\n'
                    f"centre_of_mass_m = {[float(x) for x in tool.centre_of_mass_m]}\n"
                )
        movement = stand.movement(name, MovementKind.GRID, way, way.duration_s)
        rng = np.random.default_rng([self.seed, _NOISE, number])
        trace = trace_movement(movement, [limb.sensor], rate_hz=_RATE_HZ, rng=rng)
        sensor = self.specimen.powered_up(np.random.default_rng([self.seed, _POWER_UP, number]))
        write_recording(self.folder / name, trace.recorded({limb.sensor: sensor}, rng=rng))
        rest = (
            f'[recording]\nformat = "parquet"\npath = "{name}"\n'
            f'[[interval]]\nlabel = "{name}"\nstart_s = {INTERVAL_MARGIN_S}\n'
            f'end_s = {way.duration_s - INTERVAL_MARGIN_S:.3f}\nuse = "calibration"\nsupport = "{limb.support}"\n'
            f'session = "{name}"\n{load}'
        )
        return SensorRun(load_experiment(self._written(name, rest)), limb.sensor)

    def _written(self, name: str, rest: str) -> Path:
        limb, file = self.limb, self.folder / f"{name}.toml"
        self.folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(named_robot([limb.robot]), self.folder / "robot.urdf")
        write_matrix_file(self.folder / "matrix.txt", encode_matrix(self.specimen.workbench))
        stream = f'stream = "{limb.sensor}"\n' if rest else ""
        file.write_text(
            f'schema = "forcetorque/experiment/1"\nname = "{name}"\n[robot]\nurdf = "robot.urdf"\n{self.robot}'
            f'[[sensor]]\nname = "{limb.sensor}"\n{stream}serial = "SIM"\nprior = "matrix.txt"\n'
            "limit_counts = 32767.0\n"
            f'[[support]]\nframe = "{limb.support}"\ngravity_direction = [0.0, 0.0, -1.0]\n'
            f'[[load_case]]\nname = "push"\nforce_N = {limb.force_N}\nradius_m = 0.3\noffset = "tared"\n'
            f'[plan]\nclearance_deg = 10\nsupport = "{limb.support}"\n{limb.tools}{self.sensors}{rest}',
            encoding="utf-8",
        )
        return file


def followed(
    folder: Path,
    seed: int,
    name: str,
    *,
    robot: str = UNCERTAIN,
    sensors: str = LINEAR,
    stages: Sequence[Stage] = STAGES,
    seconds: float = 40.0,
    effort: Effort = QUICK,
) -> Iterator[Trial]:
    """Plan, record what is planned, calibrate, and compare with the truth.

    Args:
        folder: Where experiments are written.
        seed: Of robot, sensor and noise.
        name: Name of the limb.
        robot: Line of the experiment file about the robot model.
        sensors: Its lines about the accuracy of sensor and expected wrench.
        stages: Which stages.
        seconds: How long a recording may be; s.
        effort: How long to look for a plan.

    Yields:
        A trial per stage.
    """
    laboratory = Laboratory(folder=folder, seed=seed, limb=LIMBS[name], robot=robot, sensors=sensors)
    new = laboratory.unrecorded()
    (case,) = operating_load_cases([new])
    ahead = plan(new, recordings=2 if "two" in stages else 1, seconds=seconds, effort=effort)
    first = laboratory.record(ahead.proposals[0], "first")
    known = _calibrated([first])

    def trial(stage: Stage, planned: PlannedRecording, calibration: Calibration) -> Trial:
        stated = predict(calibration, case)
        return Trial(
            seed=seed,
            limb=name,
            stage=stage,
            true=_true_error(calibration, laboratory.specimen, case),
            planned=(planned.force_after_N, planned.moment_after_Nm),
            planned_at_most=(planned.force_after_at_most_N, planned.moment_after_at_most_Nm),
            calibrated=(stated.force.typical, stated.moment.typical),
            calibrated_at_most=(stated.force.at_most, stated.moment.at_most),
        )

    if "first" in stages:
        yield trial("first", ahead.recordings[0], known)
    if "two" in stages:
        second = laboratory.record(ahead.proposals[1], "second")
        yield trial("two", ahead.recordings[1], _calibrated([first, second]))
    if "next" in stages:
        again = plan(first, known, recordings=1, seconds=seconds, effort=effort)
        third = laboratory.record(again.proposals[0], "next")
        yield trial("next", again.recordings[0], _calibrated([first, third]))


def _calibrated(runs: Sequence[SensorRun]) -> Calibration:
    return calibrate_sensor(runs, code_version="benchmark", created="now")


def _true_error(calibration: Calibration, specimen: Specimen, case: LoadCase) -> tuple[float, float]:
    wrong = case.wrench @ (calibration.matrix @ np.linalg.inv(specimen.sensor.matrix) - np.eye(6)).T
    force, moment = (float(np.sqrt((wrong[:, part] ** 2).sum(axis=1).mean())) for part in (slice(3), slice(3, 6)))
    return force, moment


def table(trials: Sequence[Trial]) -> Iterator[str]:
    """Give two lines, of force and of moment, per limb and stage."""
    columns = ("n", "true", "plan", "ratio", "within", "fit", "ratio", "within")
    yield f"{'limb, stage':30s}" + "".join(f"{column:>9s}" for column in columns)
    for limb in dict.fromkeys(one.limb for one in trials):
        for stage in STAGES:
            own = [one for one in trials if (one.limb, one.stage) == (limb, stage)]
            for k, unit in enumerate(("N", "N m") if own else ()):
                true = np.array([one.true[k] for one in own])
                line = f"{f'{limb}, {stage}, {unit}':30s}{len(own):9d}{np.median(true):9.4f}"
                for kind in ("planned", "calibrated"):
                    typical = np.array([getattr(one, kind)[k] for one in own])
                    most = np.array([getattr(one, f"{kind}_at_most")[k] for one in own])
                    ratio = np.median(typical) / np.median(true)
                    line += f"{np.median(typical):9.4f}{ratio:9.2f}{(true <= most).mean():9.2f}"
                yield line


def main() -> None:
    """Measure all trials, print the table and write every trial."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=20, help="how many")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--limbs", nargs="+", choices=LIMBS, default=list(LIMBS))
    parser.add_argument("--exact", action="store_true", help="state that the robot model is exact, which it is not")
    parser.add_argument("--guards", action="store_true", help="leave accuracy and repeatability to their defaults")
    parser.add_argument("--quick", action="store_true", help="one seed, one limb")
    parser.add_argument("--json", type=Path, help="file for every trial")
    options = parser.parse_args()
    if options.quick:
        options.seeds, options.limbs = 1, list(LIMBS)[:1]
    trials: list[Trial] = []
    for seed in range(options.first_seed, options.first_seed + options.seeds):
        for limb in options.limbs:
            with tempfile.TemporaryDirectory() as folder:
                trials += followed(
                    Path(folder),
                    seed,
                    limb,
                    robot=EXACT if options.exact else UNCERTAIN,
                    sensors="" if options.guards else LINEAR,
                )
    print("\n".join(table(trials)))
    write_cases(options.json, trials)


if __name__ == "__main__":
    main()
