# SPDX-License-Identifier: BSD-3-Clause
"""Contacts found by `robot collisions` on simulated limbs: pushes noticed by their size, and false alarms per hour.

Robots, sensors and families of errors are those of `benchmarks.model_errors`, without its delays, quadratic terms and
contacts. A limb of the hanging biped moves at random for three minutes; the first minute is stated as free of
contact, and in the other two something pushes a link of the limb every 6 s for 0.4 s: within 2 cm of its centre of
mass along each axis, in a random direction, with a force of the stated sizes in turn. The same recording without
pushes gives the false alarms. Several rates give the curve of pushes noticed against false alarms. A push is noticed
where a contact overlaps it by some of its time; the link is right where it is named, alone or among others. The
planted wrenches take the equation of the links that places the contacts too; tests of `tests/collisions` plant them
from the poses of links alone.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from scipy.stats import beta, chi2

from benchmarks.harness import write_cases
from benchmarks.model_errors import (
    FAMILIES,
    LIMBS,
    RATE_HZ,
    UNCERTAIN,
    case_arguments,
    powered_up,
    specimen,
    true_stand,
)
from forcetorque.base.arrays import FloatArray
from forcetorque.collisions.collisions import find_collisions
from forcetorque.collisions.location import equation_at
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.storage import write_recording
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.trace import EPOCH_NS, Trace, trace_movement

FORCES_N = (2.0, 4.0, 8.0, 16.0, 32.0)
DURATION_S, FREE_S, PERIOD_S, PUSH_S, RAMP_S, MARGIN_S = 180.0, 60.0, 6.0, 0.4, 0.05, 2.0
_MOTION, _NOISE, _PUSH = 11, 12, 13
"""What a stream of random numbers is for, beside those of `model_errors`."""
PELVIS = "pelvis"


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """What was found on one limb."""

    seed: int
    family: str
    limb: str
    alarms_per_hour: float
    """Rate of false alarms that the threshold is set for."""
    noticed: tuple[int, ...]
    """Pushes of every size that were noticed."""
    named: tuple[int, ...]
    """Of these those whose link was named."""
    pushes: tuple[int, ...]
    """Pushes of every size."""
    false_alarms: int
    """Contacts in the recording without pushes."""
    watched_s: float
    """Time that was looked at in it, without the free minute."""
    smallest_N: float
    """Force that is said to be noticed."""


def _wrenches(run: SensorRun, at_ns: Sequence[int], rng: np.random.Generator) -> tuple[list[FloatArray], list[str]]:
    """Wrenches of unit forces on links of a limb, as the sensor reads them, and the link of each."""
    tree, equation = equation_at(run, run.experiment.recording.intervals[0], np.array(at_ns))
    heavy = [index for index in equation.part.bodies if tree.bodies[index].inertia.mass > 0.0]
    wrenches, links = [], []
    for number in range(len(at_ns)):
        index = int(rng.choice(heavy))
        body = tree.bodies[index]
        force = rng.standard_normal(3)
        force /= np.linalg.norm(force)
        centre = body.inertia.first_moment / body.inertia.mass
        place = (equation.poses[index][number] @ np.r_[centre + rng.uniform(-0.02, 0.02, 3), 1.0])[:3]
        on_robot = np.concatenate([force, np.cross(place, force)])
        wrenches.append(-np.linalg.solve(equation.transmission[number, 0], on_robot))
        links.append(max(body.links, key=lambda link: tree.inertias[link].mass))
    return wrenches, links


def _pushed(trace: Trace, limb: str, starts_s: Sequence[float], wrenches: Sequence[FloatArray]) -> Trace:
    since = (trace.stamp_ns[limb] - trace.start_ns) * 1e-9
    loads = trace.loads[limb].copy()
    for start, wrench in zip(starts_s, wrenches, strict=True):
        strength = np.clip(np.minimum(since - start, start + PUSH_S - since) / RAMP_S, 0.0, 1.0)
        loads += strength[:, None] * wrench
    return replace(trace, loads={limb: loads})


def _run(folder: Path, name: str, seed: int, limb: str, family: str, trace: Trace) -> SensorRun:
    one = specimen(seed, family, limb)
    recording = trace.recorded({limb: powered_up(seed, limb, one, name)}, rng=np.random.default_rng([seed, _NOISE]))
    write_recording(folder / name, recording)
    shutil.copyfile(named_robot(["biped"]), folder / "robot.urdf")
    write_matrix_file(folder / "matrix.txt", encode_matrix(one.workbench))
    file = folder / f"{name}.toml"
    file.write_text(
        f'schema = "forcetorque/experiment/1"\nname = "{name}"\n'
        f'[robot]\nurdf = "robot.urdf"\n{UNCERTAIN}[recording]\nformat = "parquet"\npath = "{name}"\n'
        f'[[sensor]]\nname = "{limb}"\nstream = "{limb}"\nserial = "SIM"\nprior = "matrix.txt"\n'
        "limit_counts = 32767.0\n"
        f'[[support]]\nframe = "{PELVIS}"\ngravity_direction = [0.0, 0.0, -1.0]\n'
        f'[[interval]]\nlabel = "free"\nstart_s = {MARGIN_S}\nend_s = {FREE_S}\nuse = "calibration"\n'
        f'support = "{PELVIS}"\n'
        f'[[interval]]\nlabel = "watched"\nstart_s = {FREE_S}\nend_s = {DURATION_S - MARGIN_S}\nuse = "validation"\n'
        f'support = "{PELVIS}"\n',
        encoding="utf-8",
    )
    return SensorRun(load_experiment(file), limb)


def measured(task: tuple[int, str, str], rates_per_hour: Sequence[float]) -> list[Case]:
    """Push one limb, and leave it alone.

    Args:
        task: Seed, family and limb.
        rates_per_hour: Rates of false alarms, as of `find_collisions`.

    Returns:
        What was found, at each rate.
    """
    seed, family, limb = task
    rng = np.random.default_rng([seed, _MOTION, LIMBS.index(limb)])
    movement = random_movement(true_stand(seed, FAMILIES[family].robot), rng=rng, duration_s=DURATION_S, name="moving")
    trace = trace_movement(movement, [limb], rate_hz=RATE_HZ, rng=rng, start_ns=EPOCH_NS)
    starts = np.arange(FREE_S + 5.0, DURATION_S - 8.0, PERIOD_S)
    sizes = np.resize(FORCES_N, len(starts))
    with tempfile.TemporaryDirectory() as name:
        alone = _run(Path(name), "alone", seed, limb, family, trace)
        at_ns = [trace.start_ns + round(1e9 * (start + 0.5 * PUSH_S)) for start in starts]
        units, links = _wrenches(alone, at_ns, np.random.default_rng([seed, _PUSH, LIMBS.index(limb)]))
        pushed = _pushed(trace, limb, starts.tolist(), [size * unit for size, unit in zip(sizes, units, strict=True)])
        touched = _run(Path(name), "touched", seed, limb, family, pushed)
        return [_case(task, rate, alone, touched, starts, sizes, links) for rate in rates_per_hour]


def _case(
    task: tuple[int, str, str],
    rate: float,
    alone: SensorRun,
    touched: SensorRun,
    starts: FloatArray,
    sizes: FloatArray,
    links: Sequence[str],
) -> Case:
    quiet, found = (
        find_collisions(run, run.read_by(None, None).bare, ["watched"], ["free"], rate) for run in (alone, touched)
    )
    hits = [
        [row for row in found.collisions if row.start_s < start + PUSH_S + 0.1 and row.end_s > start]
        for start in starts
    ]
    right = [any(link in (row.link, *row.other_links) for row in rows) for link, rows in zip(links, hits, strict=True)]

    def counted(marks: Sequence[bool]) -> tuple[int, ...]:
        return tuple(int(np.count_nonzero(np.array(marks) & (sizes == size))) for size in FORCES_N)

    seed, family, limb = task
    return Case(
        seed=seed,
        family=family,
        limb=limb,
        alarms_per_hour=rate,
        noticed=counted([bool(rows) for rows in hits]),
        named=counted(right),
        pushes=counted([True] * len(starts)),
        false_alarms=len(quiet.collisions),
        watched_s=quiet.sensitivity[0].looked_at_s,
        smallest_N=quiet.sensitivity[0].smallest_force_N,
    )


def table(cases: Sequence[Case]) -> Iterator[str]:
    """Lines for people: by family, and all.

    Args:
        cases: The cases.

    Yields:
        Lines.
    """
    yield (
        "family               " + " ".join(f"{size:>10g} N" for size in FORCES_N) + "   link   alarms/h (95 %)  said, N"
    )
    for family in (*dict.fromkeys(case.family for case in cases), "all"):
        own = [case for case in cases if family in (case.family, "all")]
        noticed, named, pushes = (
            np.sum([getattr(case, name) for case in own], axis=0) for name in ("noticed", "named", "pushes")
        )
        hours, alarms = sum(case.watched_s for case in own) / 3600.0, sum(case.false_alarms for case in own)
        low, high = chi2.ppf(0.025, 2 * alarms) / 2 if alarms else 0.0, chi2.ppf(0.975, 2 * alarms + 2) / 2
        rates = " ".join(_rate(a, b) for a, b in zip(noticed, pushes, strict=True))
        share = f"{100 * named.sum() / max(noticed.sum(), 1):4.0f} %"
        said = float(np.median([case.smallest_N for case in own]))
        yield (
            f"{family:20} {rates} {share}  {alarms / hours:5.2f} ({low / hours:.2f} to {high / hours:.2f})  {said:.1f}"
        )


def _rate(hits: int, total: int) -> str:
    low = beta.ppf(0.025, hits, total - hits + 1) if hits else 0.0
    high = beta.ppf(0.975, hits + 1, total - hits) if hits < total else 1.0
    return f"{100 * hits / total:4.0f} ({100 * low:.0f}-{100 * high:.0f})".rjust(12)


def main() -> None:
    """Measure, print the table and write every case."""
    parser: argparse.ArgumentParser = case_arguments(__doc__ or "")
    parser.add_argument("--alarms-per-hour", type=float, nargs="+", default=[1.0])
    parser.add_argument("--json", type=Path, help="file for every case")
    options = parser.parse_args()
    seeds = range(options.first_seed, options.first_seed + options.seeds)
    tasks = [(seed, family, limb) for seed in seeds for family in options.families for limb in options.limbs]
    with ProcessPoolExecutor(options.processes, mp_context=get_context("spawn")) as pool:
        found = pool.map(partial(measured, rates_per_hour=options.alarms_per_hour), tasks)
        cases = [case for of_limb in found for case in of_limb]
    for rate in options.alarms_per_hour:
        print(f"set for {rate:g} false alarms an hour")
        print("\n".join(table([case for case in cases if case.alarms_per_hour == rate])))
    write_cases(options.json, cases)


if __name__ == "__main__":
    main()
