# SPDX-License-Identifier: BSD-3-Clause
"""Verdicts "use", "do not use" and "not enough data" on simulated sensors, against the true error at the load case.

Sensors, families of errors and motions are those of `benchmarks.model_errors`. Each calibration is evaluated on a
recording that was not fitted: 60 s of random motion of the same robot, with the same errors, and (but for "contact")
with nothing in contact. The load cases are the default one (weight of the robot on its sole, or pushes as strong as the
weight of the distal links), pushes of 50 N within 0.3 m, tared and with the fitted offset, and a fifth of full scale in
all components, tared. Allowed is a twentieth of the loads in force and in moment, the default.

The true error is that of the verdict: root mean square over the loads of the load case of what the calibration reads
of the noise-free counts, less the load; loads are added to the mean load of the fitted data, and a tared sensor has no
error there. A sensor is good where force and moment error are both within the allowed ones.

    wrong use          of the verdicts "use" those of sensors that are not good
    wrong do not use   of the verdicts "do not use" those of sensors that are good
    power              of the good sensors those with the verdict "use"
    cover              true force and moment error are both at most the stated upper ends
    predicted          predicted over true error, geometric mean

Intervals are exact binomial ones of 95 %. All families of a seed and limb share sensor, motion and noise, and the load
cases share the calibration, so verdicts are not independent; a bootstrap over seeds and limbs is stated beside them.
"""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from benchmarks.harness import write_cases
from benchmarks.model_errors import (
    FAMILIES,
    MOTIONS,
    Robot,
    add_informed,
    case_arguments,
    expected_errors,
    powered_up,
    sensor_runs,
    specimen,
    traces,
    validation_trace,
)
from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.load_cases.load_case import LoadCase, operating_load_cases
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, use_verdicts
from forcetorque.evaluation.section import LoadCaseOffset, LoadCaseTable
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.simulation.simulated_sensor import SimulatedSensor

LOAD_CASES = (
    LoadCaseTable(name="push", force_N=50.0, radius_m=0.3, offset=LoadCaseOffset.TARED),
    LoadCaseTable(name="push, fitted offset", force_N=50.0, radius_m=0.3),
    LoadCaseTable(name="full scale", full_scale_share=0.2, offset=LoadCaseOffset.TARED),
)
"""Load cases beside the default one."""
DEFAULT = "default"
"""Name of the default load case of every limb."""
BOOTSTRAPS = 2000
PROBABILITIES = (0.02, 0.1, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.95)
"""Of an error within the allowed one, at which the trade-off of wrong uses and power is printed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One verdict, and what is true; force before moment in every pair; N, N m."""

    seed: int
    family: str
    limb: str
    motion: str
    load_case: str
    decision: str
    reason: str
    """The first reason."""
    within: float
    """Predicted probability of an error within the allowed one."""
    limited_by: str
    """Largest source of the predicted error where the prediction speaks against the use; "data" where only something
    else does; empty for a use."""
    else_usable: bool
    """Whether nothing but the prediction speaks against the use."""
    true: tuple[float, float]
    allowed: tuple[float, float]
    predicted: tuple[float, float]
    """Median."""
    at_most: tuple[float, float]
    """Upper end of the stated 95 % interval."""

    @property
    def good(self) -> bool:
        """Whether both true errors are within the allowed ones."""
        return all(true <= allowed for true, allowed in zip(self.true, self.allowed, strict=True))

    @property
    def covered(self) -> bool:
        """Whether both true errors are at most what is stated."""
        return all(true <= most for true, most in zip(self.true, self.at_most, strict=True))


def true_error(calibration: Calibration, sensor: SimulatedSensor, case: LoadCase) -> tuple[float, float]:
    """Read the loads of a load case without noise, and compare; N, N m."""
    if calibration.posterior is None:
        raise ForceTorqueError("expected a generative fit; [calibration] of the experiment file names another")
    centre = calibration.posterior.load_centre
    error = _counts(sensor, case.wrench + centre) @ calibration.matrix.T - case.wrench
    if case.offset is LoadCaseOffset.TARED:
        error = error - _counts(sensor, centre[None]) @ calibration.matrix.T
    else:
        error = error + calibration.offset - centre
    square = (error**2).mean(axis=0)
    return float(np.sqrt(square[:3].sum())), float(np.sqrt(square[3:].sum()))


def _counts(sensor: SimulatedSensor, wrench: FloatArray) -> FloatArray:
    counts: FloatArray = np.asarray(np.linalg.solve(sensor.matrix, (wrench - sensor.offset).T).T, dtype=np.float64)
    return counts if sensor.crosstalk is None else counts + sensor.crosstalk.counts(wrench)


def outcomes(
    run: SensorRun, calibration: Calibration, sensor: SimulatedSensor
) -> Iterator[tuple[LoadCase, LoadCaseVerdict, tuple[float, float]]]:
    """Decide on every load case of one calibration, and compare with the truth."""
    for tables in ((), LOAD_CASES):
        cases = operating_load_cases([run], tables, matrix=calibration.matrix)
        verdicts = use_verdicts(run, {"new": calibration}, tables)
        for case, verdict in zip(cases, verdicts, strict=True):
            if verdict.beyond_range is None:  # else the verdict is about the loads of the recording
                yield case, verdict, true_error(calibration, sensor, case)


def _outcome(
    key: tuple[int, str, str, str], case: LoadCase, verdict: LoadCaseVerdict, true: tuple[float, float]
) -> Outcome:
    force, moment = verdict.errors
    return Outcome(
        seed=key[0],
        family=key[1],
        limb=key[2],
        motion=key[3],
        load_case=case.name if case.is_stated else DEFAULT,
        decision=verdict.decision,
        reason=verdict.reasons[0].text,
        within=-1.0 if verdict.within is None else verdict.within,
        limited_by="" if verdict.decision == "use" else verdict.limited_by or "data",
        else_usable=not any(
            reason.against is not None and reason.remedy is not None and "error comes from" not in reason.remedy
            for reason in verdict.reasons
        ),
        true=true,
        allowed=case.requirement,
        predicted=(force.after, moment.after),
        at_most=(force.after_at_most, moment.after_at_most),
    )


def _of_limb(
    task: tuple[int, Robot, str], families: Sequence[str], motions: Sequence[str], *, table: str
) -> list[Outcome]:
    seed, robot, limb = task
    known = [*traces(seed, robot, limb).values(), validation_trace(seed, robot, limb)]
    found: list[Outcome] = []
    for family in families:
        if FAMILIES[family].robot != robot:
            continue
        one = specimen(seed, family, limb)
        with tempfile.TemporaryDirectory() as folder, expected_errors(family, table) as line:
            runs = sensor_runs(Path(folder), seed, family, limb, one, known, line)
            named = {trace.movement.name: run for trace, run in zip(known, runs, strict=True)}
            for motion in motions:
                fitted = [named[part] for part in MOTIONS[motion]]
                try:
                    calibration = calibrate_sensor(fitted, code_version="benchmark", created="now")
                except ForceTorqueError as refusal:
                    print(f"refused: {seed}, {family}, {limb}, {motion}: {refusal}")
                    continue
                # the offset of the calibration is that of its last power-up
                sensor = powered_up(seed, limb, one, MOTIONS[motion][-1])
                key = (seed, family, limb, motion)
                found += [_outcome(key, *result) for result in outcomes(runs[-1], calibration, sensor)]
    return found


Group = tuple[str, Callable[[Outcome], bool]]


def table(found: Sequence[Outcome]) -> Iterator[str]:
    """Give a line per family, load case and motion, and the totals with their intervals."""
    columns = ("n", "good", "use", "not", "data", "wrong use", "wrong not", "power", "cover", "pred F", "pred M")
    yield f"{'':24s}" + "".join(f"{column:>10s}" for column in columns)
    groups: list[Group] = [
        *((name, lambda one, name=name: one.family == name) for name in FAMILIES),
        *((name, lambda one, name=name: one.load_case == name) for name in dict.fromkeys(o.load_case for o in found)),
        *((name, lambda one, name=name: one.motion == name) for name in MOTIONS),
        ("all", lambda one: True),
    ]
    for name, member in groups:
        if own := [one for one in found if member(one)]:
            yield _line(name, own)
    for name, figure in RATES.items():
        part, whole = figure(found)
        low, high = binomial_interval(part, whole)
        least, most = bootstrap_interval(found, figure)
        yield (
            f"{name}: {part} of {whole}, {_percent(part / max(whole, 1))} % ({_percent(low)} to {_percent(high)} %; "
            f"sensors drawn anew {_percent(least)} to {_percent(most)} %)"
        )
    limits = Counter(one.limited_by for one in found if one.good and one.limited_by)
    yield f"good sensors that are not used, limited by: {', '.join(f'{key} {n}' for key, n in limits.most_common())}"
    yield "least probability of an error within the allowed one that a use needs: wrong uses of all, power"
    for least in PROBABILITIES:
        use = [one for one in found if one.within >= least and one.else_usable]
        right, good = sum(one.good for one in use), sum(one.good for one in found)
        yield f"  {least:.2f}: {len(use) - right} of {len(use)}, {_percent(right / max(good, 1))} %"


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f}"


def _line(name: str, own: Sequence[Outcome]) -> str:
    decided = [sum(one.decision == decision for one in own) for decision in ("use", "do not use", "not enough data")]
    rates = ["{}/{}".format(*figure(own)) for figure in RATES.values()]
    ratio = np.log([one.predicted for one in own]) - np.log([one.true for one in own])
    force, moment = np.exp(ratio.mean(axis=0))
    cells = (len(own), sum(one.good for one in own), *decided, *rates)
    cover = np.mean([one.covered for one in own])
    return f"{name:24s}" + "".join(f"{cell:>10}" for cell in cells) + f"{cover:10.3f}{force:10.2f}{moment:10.2f}"


Figure = Callable[[Sequence[Outcome]], tuple[int, int]]


def _share(of: Callable[[Outcome], bool], part: Callable[[Outcome], bool]) -> Figure:
    def figure(found: Sequence[Outcome]) -> tuple[int, int]:
        whole = [one for one in found if of(one)]
        return sum(part(one) for one in whole), len(whole)

    return figure


RATES: dict[str, Figure] = {
    "wrong use": _share(lambda one: one.decision == "use", lambda one: not one.good),
    "wrong do not use": _share(lambda one: one.decision == "do not use", lambda one: one.good),
    "power": _share(lambda one: one.good, lambda one: one.decision == "use"),
}


def binomial_interval(part: int, whole: int) -> tuple[float, float]:
    """Give the exact 95 % interval of a share (Clopper and Pearson, Biometrika 1934)."""
    from scipy.special import betaincinv

    low = float(betaincinv(part, whole - part + 1, 0.025)) if part else 0.0
    high = float(betaincinv(part + 1, whole - part, 0.975)) if part < whole else 1.0
    return low, high


def bootstrap_interval(found: Sequence[Outcome], figure: Figure) -> FloatArray:
    """Draw seeds and limbs anew, with all their verdicts; the middle 95 % of the share; shape (2,)."""
    sensors = sorted({(one.seed, one.limb) for one in found})
    counts = np.array([figure([one for one in found if (one.seed, one.limb) == sensor]) for sensor in sensors])
    rng = np.random.default_rng(0)
    drawn = counts[rng.integers(len(sensors), size=(BOOTSTRAPS, len(sensors)))].sum(axis=1)
    share = drawn[:, 0] / np.maximum(drawn[:, 1], 1)
    return np.asarray(np.quantile(share, [0.025, 0.975]))


def main() -> None:
    """Measure all verdicts, print the table and write every verdict."""
    parser = case_arguments(__doc__ or "")
    add_informed(parser)
    parser.add_argument("--json", type=Path, help="file for every verdict")
    options = parser.parse_args()
    robots = dict.fromkeys(FAMILIES[family].robot for family in options.families)
    seeds = range(options.first_seed, options.first_seed + options.seeds)
    tasks = [(seed, robot, limb) for seed in seeds for robot in robots for limb in options.limbs]
    with ProcessPoolExecutor(options.processes, mp_context=get_context("spawn")) as pool:
        work = partial(_of_limb, families=options.families, motions=options.motions, table=options.robot)
        found = [one for some in pool.map(work, tasks) for one in some]
    print("\n".join(table(found)))
    write_cases(options.json, found)


if __name__ == "__main__":
    main()
