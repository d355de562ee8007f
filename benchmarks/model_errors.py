# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations of single sensors where robot, sensor or record are not as the file says, against the known truth.

The biped hangs by its pelvis and moves a limb; the experiment file names the nominal URDF, gravity along -z and a prior
matrix, and nothing of an error. A family is one kind of error; all families of a seed share sensor, motion and noise.
The prior is wrong in every family: each coefficient of the true matrix differs by 2 % of the root mean square of its
row (or as the name of the family has it), some 9 N and 0.13 N m of a push of 50 N. In "dense 2 %" it reads w as
`(1 + E) w` instead, the coefficients of E having a root mean square of 2 % with moments over 0.07 m: an error without
the structure of the sensor. In "turned alone" it is right but for the frame. "together" has small errors of many kinds.
Link masses and joint zeros are normal with the stated deviation, for all links and joints; the turn and shift of
a frame, the tilt of the base, and the delay of the sensor's stamps are exactly what is stated, in random directions. A
contact is 3 s long, of constant direction, and comes once in a recording of `grid` and of `tz`. A cable pulls on the
limb in proportion to every joint's position, with a force of constant direction in the sensor's frame per joint and a
moment over 0.05 m. A cover catches on the limb: it pushes one way or the other, by which side of its mean position the
joint that moves most is on, and changes over within 0.1 rad. Pushes and their truth
are in the sensor's frame as the URDF has it; offsets play no part in them.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from unittest.mock import patch

import numpy as np

from benchmarks.harness import write_cases
from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.base.pose import make_pose, rotation_about_z, rotation_with_z_along
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import wrench_matrix
from forcetorque.calibration.calibrate import calibrate_sensor, data_doubts, fit_doubts
from forcetorque.experiment.calibration import expected_sensor_errors
from forcetorque.experiment.calibration.expected_sensor_errors import Scale
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import grid_movement, random_movement, z_torque_movement
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.scenario.scenario import INTERVAL_MARGIN_S
from forcetorque.simulation.scenario.scenario_file import Sensors
from forcetorque.simulation.sensor_family import Specimen, draw_specimen
from forcetorque.simulation.simulated_sensor import (
    SimulatedSensor,
    distorted_by_mounting,
    mounted_matrix,
    random_matrix_error,
)
from forcetorque.simulation.trace import EPOCH_NS, Trace, trace_movement

LIMBS = ("l_leg_ft", "r_leg_ft", "l_foot_ft", "l_arm_ft")
UNCERTAIN, EXACT, INFORMED, STATED = "tolerance = {}\n", 'tolerance = "exact"\n', "informed", "stated"
"""Lines of the experiment file that state the default tolerances of the robot model, and none; a word for those of a
fit that knows which errors the family has, and their sizes; and one for the default beside the uncertainty of the
prior matrix, as a certificate states it."""
CERTIFIED = 0.02
"""Least size of errors of coefficients by `STATED`, also where the family has none."""
RANDOM, VALIDATION = "random", "validation"
"""Recordings beside those of the motions: one of another power-up, and one that is not fitted."""
RATE_HZ, HOUR_NS, LIMIT_COUNTS = 100.0, 3_600_000_000_000, 32767.0
MOTIONS = {"grid": ("grid",), "tz": ("tz",), "pooled": ("grid", "tz", RANDOM)}
"""Recordings of each kind of case; the random one is of another power-up."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """How far the robot is from its URDF, and its base from level."""

    mass: float = 0.0
    zero_deg: float = 0.0
    tilt_deg: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    """One kind of error."""

    group: str
    """Families whose totals are given together."""
    robot: Robot = Robot()
    dense: float = 0.0
    """Share of `random_matrix_error`."""
    coefficients: float = 0.02
    """Change of every coefficient of the matrix, relative to the root mean square of its row."""
    gains: float = 0.0
    turn_deg: float = 0.0
    shift_m: float = 0.0
    delay_s: float = 0.0
    contact_N: tuple[float, float] | None = None
    quadratic: float = 0.0
    """Spread of every product of two components at full scale, in full scales of the converter."""
    cable_N_rad: float = 0.0
    """Force of a cable per joint and rad."""
    cover_N: float = 0.0
    """Force of a cover that catches."""


MODEL, MATRIX = "model errors", "matrix and noise"
FAMILIES = {
    "clean": Family(group=MATRIX),
    "coefficients 3 %": Family(group=MATRIX, coefficients=0.03),
    "coefficients 6 %": Family(group=MATRIX, coefficients=0.06),
    "gains 5 %": Family(group=MATRIX, gains=0.05),
    "dense 2 %": Family(group="dense", coefficients=0.0, dense=0.02),
    "turned 2.5 deg": Family(group="turned", turn_deg=2.5, shift_m=0.005),
    "turned alone": Family(group="turned", coefficients=0.0, turn_deg=2.5, shift_m=0.005),
    **{f"masses {share} %": Family(group=MODEL, robot=Robot(mass=share / 100)) for share in (2, 5, 10)},
    **{f"zeros {deg:g} deg": Family(group=MODEL, robot=Robot(zero_deg=deg)) for deg in (0.5, 2.0)},
    "tilt 1 deg": Family(group=MODEL, robot=Robot(tilt_deg=1.0)),
    "contact": Family(group="contact", contact_N=(5.0, 20.0)),
    **{f"delay {ms} ms": Family(group="delay", delay_s=ms / 1000) for ms in (10, 50)},
    "quadratic 2 %": Family(group="quadratic", quadratic=0.02),
    "cable 1 N/rad": Family(group="cable", cable_N_rad=1.0),
    "cover 2 N": Family(group="cover", cover_N=2.0),
    "together": Family(
        group="together",
        robot=Robot(mass=0.02, zero_deg=0.5, tilt_deg=0.5),
        turn_deg=1.0,
        shift_m=0.002,
        delay_s=0.01,
    ),
}
_ROBOT, _MOTION, _SENSOR, _MATRIX, _NOISE, _CONTACT, _PUSHES, _CABLE = range(8)
"""What a stream of random numbers is for."""
CONTACT_S, RAMP_S, LEVER_M, PUSH_N, PUSHES = 3.0, 0.2, 0.3, 50.0, 300
CABLE_LEVER_M, COVER_RAD = 0.05, 0.1
ERROR_LEVER_M = 0.07
WORSE = 1.05
"""Ratio of force or moment errors above which a calibration is worse than the prior."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """What came out of one calibration; force before moment in every pair."""

    seed: int
    family: str
    limb: str
    motion: str
    refused: str | None = None
    """Words of the refusal; then there is nothing else."""
    before: tuple[float, float] = (0.0, 0.0)
    """Mean error of pushes by the prior matrix; N, N m."""
    after: tuple[float, float] = (0.0, 0.0)
    """By the calibration."""
    covered: tuple[float, float] = (0.0, 0.0)
    """Share of components of pushes within 1.96 predicted standard deviations."""
    predicted: tuple[float, float] = (0.0, 0.0)
    """Predicted over true root mean square error."""
    doubts: int = 0
    seconds: float = 0.0
    """Of the processor, in the fit alone."""

    @property
    def ratios(self) -> FloatArray:
        """After over before."""
        return np.array(self.after) / np.array(self.before)


def pushes(rng: np.random.Generator, count: int = PUSHES) -> FloatArray:
    """Draw pushes in random directions at random places within the lever; shape (count, 6); N, N m."""
    force, place = (_directions(rng, count) for _ in range(2))
    place *= LEVER_M * rng.uniform(size=(count, 1)) ** (1.0 / 3.0)
    return np.hstack([PUSH_N * force, np.cross(place, PUSH_N * force)])


def _directions(rng: np.random.Generator, count: int) -> FloatArray:
    drawn = rng.standard_normal((count, 3))
    return np.asarray(drawn / np.linalg.norm(drawn, axis=1, keepdims=True))


def true_stand(seed: int, robot: Robot) -> Stand:
    """Hang up the robot as it is."""
    nominal, rng = read_urdf(named_robot(["biped"])), np.random.default_rng([seed, _ROBOT])
    zero_rad = np.deg2rad(robot.zero_deg)
    errors = RobotErrors.draw(nominal, mass=robot.mass, centre_m=0.0, joint_zero_rad=zero_rad, rng=rng)
    down = _turn(rng, robot.tilt_deg, level=True) @ [0.0, 0.0, -1.0]
    return Stand(model=errors.applied_to(nominal), support=nominal.root_link, gravity_direction=down)


def traces(seed: int, robot: Robot, limb: str) -> dict[str, Trace]:
    """Move the true robot; traces by the names of the recordings."""
    stand, rng = true_stand(seed, robot), np.random.default_rng([seed, _MOTION, LIMBS.index(limb)])
    movements = (
        grid_movement(stand, limb, name="grid"),
        z_torque_movement(stand, limb, rng=rng, name="tz"),
        random_movement(stand, rng=rng, duration_s=60.0, name=RANDOM),
    )
    return {
        own.name: trace_movement(own, [limb], rate_hz=RATE_HZ, rng=rng, start_ns=EPOCH_NS + k * HOUR_NS)
        for k, own in enumerate(movements)
    }


def validation_trace(seed: int, robot: Robot, limb: str) -> Trace:
    """Move the true robot once more, at random, in the power-up of the grid."""
    rng = np.random.default_rng([seed, _MOTION, LIMBS.index(limb), 1])
    movement = random_movement(true_stand(seed, robot), rng=rng, duration_s=60.0, name=VALIDATION)
    return trace_movement(movement, [limb], rate_hz=RATE_HZ, rng=rng, start_ns=EPOCH_NS + 3 * HOUR_NS)


def _turn(rng: np.random.Generator, angle_deg: float, *, level: bool = False) -> FloatArray:
    """A rotation about a random axis, or a random level one; shape (3, 3)."""
    axis = rng.standard_normal(3) * [1.0, 1.0, float(not level)]
    along = rotation_with_z_along(axis / np.linalg.norm(axis))
    return np.asarray(along @ rotation_about_z(np.array(np.deg2rad(angle_deg))) @ along.T)


def specimen(seed: int, family: str, limb: str) -> Specimen:
    """Draw a sensor, whose workbench matrix is the prior and whose true matrix has the family's errors."""
    kind, number = FAMILIES[family], LIMBS.index(limb)
    described = Sensors(
        family="double range", noise_corner_hz=0.5, power_up_counts=60.0, crosstalk_counts=32767.0 * kind.quadratic
    )
    drawn = draw_specimen(described, number, np.random.default_rng([seed, _SENSOR, number]))
    rng = np.random.default_rng([seed, _MATRIX, number])
    error = random_matrix_error(kind.dense, ERROR_LEVER_M, rng)
    matrix = mounted_matrix(f"family {family!r}", drawn.workbench, error)
    matrix = distorted_by_mounting(matrix, relative=kind.coefficients, rng=rng)
    matrix = matrix / np.exp(kind.gains * rng.standard_normal(6))
    urdf_H_true = make_pose(_turn(rng, kind.turn_deg), kind.shift_m * _directions(rng, 1)[0])
    matrix = wrench_matrix(urdf_H_true) @ matrix
    offset = matrix @ np.linalg.solve(drawn.sensor.matrix, drawn.sensor.offset)
    return replace(drawn, sensor=replace(drawn.sensor, matrix=matrix, offset=offset))


def powered_up(seed: int, limb: str, one: Specimen, recording: str) -> SimulatedSensor:
    """Give the sensor with the offset that it has in a recording."""
    return one.powered_up(np.random.default_rng([seed, _SENSOR, LIMBS.index(limb), int(recording == RANDOM)]))


def _recorded(seed: int, family: str, limb: str, one: Specimen, trace: Trace) -> Recording:
    """Read the sensor, with what the family does to the record."""
    kind, number, name = FAMILIES[family], LIMBS.index(limb), trace.movement.name
    sensor = powered_up(seed, limb, one, name)
    if kind.contact_N is not None and name in MOTIONS:
        rng = np.random.default_rng([seed, _CONTACT, number, *name.encode()])
        trace = _touched(trace, limb, rng.uniform(*kind.contact_N), rng)
    if kind.cable_N_rad or kind.cover_N:
        trace = _pulled(trace, limb, kind, np.random.default_rng([seed, _CABLE, number]))
    noise = np.random.default_rng([seed, _NOISE, number, *name.encode()])
    recording = trace.recorded({limb: sensor}, rng=noise)
    stream = recording.stream(limb)
    late = replace(stream, stamp_ns=stream.stamp_ns + round(1e9 * kind.delay_s))
    return replace(recording, streams={**recording.streams, limb: late})


def _touched(trace: Trace, limb: str, force_N: float, rng: np.random.Generator) -> Trace:
    """Let something push beyond the sensor, at one place and in one direction of the sensor's frame."""
    push = pushes(rng, 1)[0] * (force_N / PUSH_N)
    start_s = rng.uniform(1.0, trace.movement.duration_s - 1.0 - CONTACT_S)
    since = (trace.stamp_ns[limb] - trace.start_ns) * 1e-9 - start_s
    strength = np.clip(np.minimum(since, CONTACT_S - since) / RAMP_S, 0.0, 1.0)
    return replace(trace, loads={limb: trace.loads[limb] + strength[:, None] * push})


def _pulled(trace: Trace, limb: str, kind: Family, rng: np.random.Generator) -> Trace:
    """Let a cable or a cover pull beyond the sensor as the joints move; the same one in every recording of a draw."""
    joints = trace.joints.signal("position")
    at = np.column_stack([np.interp(trace.stamp_ns[limb], trace.joints.stamp_ns, own) for own in joints.values.T])
    forces, moments = (_directions(rng, len(joints.columns)) for _ in range(2))
    load = np.hstack([forces, CABLE_LEVER_M * moments])
    most = int(np.argmax(at.std(axis=0)))
    caught = np.tanh((at[:, most] - at[:, most].mean()) / COVER_RAD)
    added = kind.cable_N_rad * at @ load + kind.cover_N * np.outer(caught, load[most])
    return replace(trace, loads={limb: trace.loads[limb] + added})


def _written(
    folder: Path, name: str, limb: str, recording: Recording, duration_s: float, robot: str, sensor: str
) -> Path:
    """Write a recording, and an experiment file with lines of the robot and of the sensor."""
    write_recording(folder / name, recording)
    file, use = folder / f"{name}.toml", "validation" if name == VALIDATION else "calibration"
    file.write_text(
        f'schema = "forcetorque/experiment/1"\nname = "{name}"\n'
        f'[robot]\nurdf = "robot.urdf"\n{robot}[recording]\nformat = "parquet"\npath = "{name}"\n'
        f'[[sensor]]\nname = "{limb}"\nstream = "{limb}"\nserial = "SIM"\nprior = "matrix.txt"\n'
        f"limit_counts = {LIMIT_COUNTS}\n{sensor}"
        '[[support]]\nframe = "pelvis"\ngravity_direction = [0.0, 0.0, -1.0]\n'
        f'[[interval]]\nlabel = "{name}"\nstart_s = {INTERVAL_MARGIN_S}\nend_s = {duration_s - INTERVAL_MARGIN_S:.3f}\n'
        f'use = "{use}"\nsupport = "pelvis"\nsession = "power-up {int(name == RANDOM)}"\n',
        encoding="utf-8",
    )
    return file


def _certificate(family: str, prior: FloatArray) -> str:
    """What a certificate states of a sensor whose coefficients are off by as much as those of the family."""
    full_scale, counts = LIMIT_COUNTS * np.linalg.norm(prior, axis=1), np.full(prior.shape[1], LIMIT_COUNTS)
    size_of_one_percent = expected_sensor_errors.stated_prior_size(
        prior, counts, full_scale, 0.01 * full_scale / NORMAL_95
    )
    percent = max(FAMILIES[family].coefficients, CERTIFIED) / size_of_one_percent
    return f"full_scale = {full_scale.tolist()}\nprior_uncertainty_percent = {percent.tolist()}\n"


@contextmanager
def expected_errors(family: str, robot: str) -> Iterator[str]:
    """Give the line of the experiment file; by `INFORMED` fits expect the errors of the family, and no other.

    Errors without the structure of the sensor have no unknowns of their own: coefficients of that size stand for them.
    """
    if robot != INFORMED:
        yield robot
        return
    kind, per_axis = FAMILIES[family], 1.0 / np.sqrt(3.0)
    rotation_rad, shift_m = per_axis * np.deg2rad(kind.turn_deg), per_axis * kind.shift_m
    expected = kind.coefficients or kind.dense, kind.gains, rotation_rad, shift_m
    coefficients, gain, *mount = (Scale(expected=max(size, 1e-6), weight=np.inf) for size in expected)
    changed = {
        "COEFFICIENTS": coefficients,
        "GAIN": gain,
        "MODEL": Scale(expected=1.0, weight=np.inf),
        "CABLE": Scale(expected=1.0, weight=np.inf),
        "mount_scales": lambda _: tuple(mount),
    }
    tilt = kind.robot.tilt_deg or 1e-3  # without any term the fit would be that of an exact model
    of_model = f"mass_relative = {kind.robot.mass}, joint_zero_deg = {kind.robot.zero_deg}, tilt_deg = {tilt}"
    with patch.multiple(expected_sensor_errors, **changed):
        rest = f"delay_s = {kind.delay_s}, centre_m = 0, cable_N_rad = {kind.cable_N_rad}"
        yield f"tolerance = {{ {of_model}, {rest} }}\n"


def sensor_runs(
    folder: Path, seed: int, family: str, limb: str, one: Specimen, known: Sequence[Trace], robot: str = UNCERTAIN
) -> list[SensorRun]:
    """Record the sensor in every trace; the files are in a folder, with the nominal robot and the prior matrix."""
    shutil.copyfile(named_robot(["biped"]), folder / "robot.urdf")
    write_matrix_file(folder / "matrix.txt", encode_matrix(one.workbench))
    line, sensor = (UNCERTAIN, _certificate(family, one.workbench)) if robot == STATED else (robot, "")
    runs = []
    for trace in known:
        recording, movement = _recorded(seed, family, limb, one, trace), trace.movement
        file = _written(folder, movement.name, limb, recording, movement.duration_s, line, sensor)
        runs.append(SensorRun(load_experiment(file), limb))
    return runs


def measured(seed: int, family: str, limb: str, motion: str, known: dict[str, Trace], robot: str = UNCERTAIN) -> Case:
    """Calibrate one sensor, and compare with the truth."""
    one = specimen(seed, family, limb)
    case = Case(seed=seed, family=family, limb=limb, motion=motion)
    with tempfile.TemporaryDirectory() as name, expected_errors(family, robot) as line:
        runs = sensor_runs(Path(name), seed, family, limb, one, [known[part] for part in MOTIONS[motion]], line)
        start = time.process_time()
        try:
            calibration = calibrate_sensor(runs if len(runs) > 1 else runs[0], code_version="benchmark", created="now")
        except ForceTorqueError as refusal:
            return replace(case, refused=str(refusal))
        seconds = time.process_time() - start
        doubts = [*fit_doubts(calibration), *(words for run in runs for words in data_doubts(run))]
        prior, posterior = runs[0].sensor.prior, calibration.posterior
    if prior is None or posterior is None:
        raise FitError("expected a generative fit with a prior; [calibration] of the experiment file names another")
    load = pushes(np.random.default_rng([seed, _PUSHES]))
    counts = np.linalg.solve(one.sensor.matrix, load.T).T
    before, error = counts @ prior.T - load, counts @ calibration.matrix.T - load
    deviation = np.sqrt(np.einsum("nii->ni", posterior.error_covariance(load)))
    return replace(
        case,
        before=_pair(lambda own: np.linalg.norm(before[:, own], axis=1).mean()),
        after=_pair(lambda own: np.linalg.norm(error[:, own], axis=1).mean()),
        covered=_pair(lambda own: (np.abs(error[:, own]) <= 1.96 * deviation[:, own]).mean()),
        predicted=_pair(lambda own: np.sqrt((deviation[:, own] ** 2).mean() / (error[:, own] ** 2).mean())),
        doubts=len(set(doubts)),
        seconds=seconds,
    )


def _pair(figure: Callable[[slice], float]) -> tuple[float, float]:
    """A figure of the force and of the moment."""
    return float(figure(slice(0, 3))), float(figure(slice(3, 6)))


def _of_limb(
    task: tuple[int, Robot, str], families: Sequence[str], motions: Sequence[str], *, table: str
) -> list[Case]:
    seed, robot, limb = task
    known = traces(seed, robot, limb)
    own = [family for family in families if FAMILIES[family].robot == robot]
    return [measured(seed, family, limb, motion, known, table) for family in own for motion in motions]


def table(cases: Sequence[Case]) -> Iterator[str]:
    """Give a line per family, one per group, and one per limb for errors of the robot."""
    columns = ("n", "refused", "worse", "worst", "F", "M", "cov F", "cov M", "pred F", "pred M", "doubted", "CPU s")
    yield f"{'family':24s}" + "".join(f"{column:>8s}" for column in columns)
    labels = [_labels(FAMILIES[case.family].group, case) for case in cases]
    groups = dict.fromkeys(kind.group for kind in FAMILIES.values())
    for label in (*FAMILIES, *(f"= {group}" for group in groups), *(f"{MODEL}, {limb}" for limb in LIMBS)):
        yield from _line(label, [case for case, own in zip(cases, labels, strict=True) if label in own])


def _labels(group: str, case: Case) -> tuple[str, ...]:
    return case.family, f"= {group}", f"{group}, {case.limb}"


def _line(label: str, cases: Sequence[Case]) -> Iterator[str]:
    fitted = [case for case in cases if case.refused is None]
    if not fitted:
        if cases:
            yield f"{label:24s}{0:8d}{len(cases):8d}"
        return
    ratios = np.array([case.ratios for case in fitted])
    shares = (
        ratios.max(),
        *np.exp(np.log(ratios).mean(axis=0)),
        *np.mean([case.covered for case in fitted], axis=0),
        *np.exp(np.log([case.predicted for case in fitted]).mean(axis=0)),
    )
    counts = (len(fitted), len(cases) - len(fitted), (ratios.max(axis=1) > WORSE).sum())
    doubted, seconds = sum(case.doubts > 0 for case in fitted), np.mean([case.seconds for case in fitted])
    yield (
        f"{label:24s}" + "".join(f"{n:8d}" for n in counts) + "".join(f"{share:8.2f}" for share in shares)
        + f"{doubted:8d}{seconds:8.2f}"
    )  # fmt: skip


def case_arguments(description: str) -> argparse.ArgumentParser:
    """Begin the arguments of a benchmark over simulated cases.

    Args:
        description: What the benchmark measures, in its first line.

    Returns:
        A parser of seeds, families, limbs, motions and number of processes.
    """
    parser = argparse.ArgumentParser(description=description.partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=1, help="how many")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=list(FAMILIES), metavar="FAMILY")
    parser.add_argument("--limbs", nargs="+", choices=LIMBS, default=LIMBS)
    parser.add_argument("--motions", nargs="+", choices=MOTIONS, default=list(MOTIONS))
    parser.add_argument("--processes", type=int, default=2, help="set OMP_NUM_THREADS=1 beside it")
    return parser


def add_informed(parser: argparse.ArgumentParser) -> None:
    """Add the choice of a fit that knows the errors; `robot` of the options is `UNCERTAIN` without it."""
    parser.add_argument(
        "--informed",
        dest="robot",
        action="store_const",
        const=INFORMED,
        default=UNCERTAIN,
        help="let the fit know which errors there are and their sizes, as no fit of a real sensor does: a bound",
    )


def main() -> None:
    """Measure all cases, print the table and write every case."""
    parser = case_arguments(__doc__ or "")
    add_informed(parser)
    parser.add_argument(
        "--exact",
        dest="robot",
        action="store_const",
        const=EXACT,
        help="state no tolerance: the robot model is taken as exact",
    )
    parser.add_argument(
        "--stated",
        dest="robot",
        action="store_const",
        const=STATED,
        help="state the uncertainty of the prior matrix, 2 %% of coefficients or what the family has",
    )
    parser.add_argument("--quick", action="store_true", help="one seed, one limb, the motion grid")
    parser.add_argument("--json", type=Path, help="file for every case")
    options = parser.parse_args()
    if options.quick:
        options.seeds, options.limbs, options.motions = 1, LIMBS[:1], ["grid"]
    robots = dict.fromkeys(FAMILIES[family].robot for family in options.families)
    seeds = range(options.first_seed, options.first_seed + options.seeds)
    tasks = [(seed, robot, limb) for seed in seeds for robot in robots for limb in options.limbs]
    with ProcessPoolExecutor(options.processes, mp_context=get_context("spawn")) as pool:
        work = partial(_of_limb, families=options.families, motions=options.motions, table=options.robot)
        cases = [case for some in pool.map(work, tasks) for case in some]
    print("\n".join(table(cases)))
    write_cases(options.json, cases)


if __name__ == "__main__":
    main()
