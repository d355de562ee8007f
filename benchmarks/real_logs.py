# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations on the real log of an iCub (yoga), judged where they were not fitted, by what the package offers users.

Two figures, both against the matrices that the sensors came with ("prior"):

- yoga: examples 02 to 05, four splits of the log of one leg in the air. `calibrate_sensor` on the calibration interval,
  `evaluate` on the other: mean norm of the force error with the offset as fitted and with that of the judged samples,
  mean norm of the moment error with the offset as fitted.
- switching: example 23, both feet, one foot, both feet. `coherence`: net contact force of all feet, read by the foot
  sensors, less (0, 0, weight) of the robot model; the offset of every sensor from the still seconds of "left" (25 to
  58 s), where one foot bears everything (`one-link-fixed-frame:left`), for the prior and each calibration by itself;
  the figure is the norm of the mean of the error over the samples of a phase. A phase that gave offset or matrix is
  "fitted" (*): no evidence.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Final, TypeVar

import numpy as np

from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.joint.calibrate import calibrate_jointly
from forcetorque.evaluation.evaluation import validation_errors
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.locomotion.commands import coherence
from forcetorque.locomotion.net_force.result import PhaseForce

EXAMPLES: Final = Path(__file__).resolve().parents[1] / "examples"
VERSION, CREATED = "benchmark", "2020-01-01T00:00:00+00:00"
PHASES: Final = ("double", "double again")
"""Phases on both feet."""
WHOLE, SHORT, DOUBLE = ("left", 36.0, 58.0), ("left", 41.5, 58.0), ("double", 0.0, 10.0)
"""Label, start and end of spans that are fitted; s."""
AIR, AIR_SENSORS = ("air", 25.0, 35.5), ("r_leg_ft_sensor", "r_foot_ft_sensor")
"""Where the right leg moves and nothing is fitted, and its sensors."""
FITS: Final[Mapping[str, Sequence[tuple[str, float, float]]]] = {
    "left 36-58 s": (WHOLE,),
    "left 41.5-58 s": (SHORT,),
    "left 36-58 s + double": (WHOLE, DOUBLE),
}
"""What is fitted, by name."""
T = TypeVar("T")
Intervals = Sequence[tuple[str, float, float]]


def main() -> None:
    """Measure, print tables, and write one JSON object."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--data", type=Path, default=Path("../shared/data"), help="folder of measured data")
    parser.add_argument("--json", type=Path, required=True, help="file for the result")
    parser.add_argument("--exact", action="store_true", help="state no tolerance: the robot model is taken as exact")
    parser.add_argument("--only", choices=("yoga", "switching"), help="one of the two figures")
    options = parser.parse_args()
    data = options.data.resolve()
    result: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, measure in (("yoga", yoga), ("switching", switching)):
            if options.only in (None, name):
                result[name] = measure(data, Path(folder), exact=options.exact)
    commit = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True, check=False)
    result["commit"] = commit.stdout.strip()
    options.json.parent.mkdir(parents=True, exist_ok=True)
    options.json.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


def yoga(data: Path, folder: Path, *, exact: bool) -> dict[str, Any]:
    """Measure the four splits of one leg in the air.

    Args:
        data: Folder of measured data.
        folder: Folder for experiment files.
        exact: Whether the robot model is taken as exact.

    Returns:
        Errors by split of prior and calibration, means over the splits, and ratios.
    """
    splits = []
    for path in sorted(EXAMPLES.glob("0[2-5]_icub_yoga_*.toml")):
        experiment = _load(path.read_text(encoding="utf-8"), data, folder / path.name, exact=exact)
        run = SensorRun(experiment, experiment.sensors[0].name)
        calibration, seconds = _timed(partial(calibrate_sensor, run, code_version=VERSION, created=CREATED))
        rows = validation_errors(run, {"new": calibration}).verdicts
        split: dict[str, Any] = {"example": path.stem, "seconds": seconds, "samples": rows[0].samples}
        for candidate in ("prior", "new"):
            of = {row.offset: row for row in rows if row.calibration == candidate}
            fitted, own = of[Offset.FITTED], of[Offset.JUDGED_MEAN]
            split[candidate] = {
                "force fitted offset, N": fitted.force_error_mean_N,
                "force own offset, N": own.force_error_mean_N,
                "moment fitted offset, N m": fitted.moment_error_mean_Nm,
                "moment own offset, N m": own.moment_error_mean_Nm,
            }
        split["ratio"] = {name: split["new"][name] / value for name, value in split["prior"].items()}
        splits.append(split)
    means = {
        candidate: {name: float(np.mean([one[candidate][name] for one in splits])) for name in splits[0]["prior"]}
        for candidate in ("prior", "new")
    }
    worst = {name: max(one["ratio"][name] for one in splits) for name in splits[0]["ratio"]}
    print(f"yoga, {len(splits)} splits: error of prior -> new (ratio); means over samples, then over splits")
    for name in worst:
        cells = [
            f"{one['prior'][name]:.3f} -> {one['new'][name]:.3f} ({one['ratio'][name]:.2f})"
            for one in (*splits, {**means, "ratio": {name: means["new"][name] / means["prior"][name]}})
        ]
        print(f"  {name:26s} {'; '.join(cells[:-1])}; mean {cells[-1]}; worst ratio {worst[name]:.2f}")
    samples, seconds = sum(one["samples"] for one in splits), sum(one["seconds"] for one in splits)
    print(f"  {samples} judged samples, {seconds:.1f} CPU s of calibration")
    return {"splits": splits, "mean": means, "worst ratio": worst}


def switching(data: Path, folder: Path, *, exact: bool) -> dict[str, Any]:
    """Measure the net force of both feet by prior, single fits and joint fits.

    Args:
        data: Folder of measured data.
        folder: Folder for experiment files.
        exact: Whether the robot model is taken as exact.

    Returns:
        Errors per fit and phase.
    """
    text = (EXAMPLES / "23_icub_yoga_switching.toml").read_text(encoding="utf-8")
    judged = _load(text, data, folder / "judged.toml", exact=exact)
    air = _load(_with_intervals(text, [AIR], use="validation"), data, folder / "air.toml", exact=exact)
    fits: dict[str, dict[str, Calibration]] = {}
    about: dict[str, dict[str, Any]] = {"prior": {"fitted": [], "seconds": 0.0, "not fitted": {}}}
    for name, intervals in FITS.items():
        fitted = _load(_with_intervals(text, intervals), data, folder / "fitted.toml", exact=exact)
        for kind, fit in (("single", _singly), ("joint", _jointly)):
            if kind == "single" and DOUBLE in intervals:
                continue  # a single sensor is fitted while nothing touches the foot beyond it
            (calibrations, refused), seconds = _timed(partial(fit, fitted))
            about[f"{kind}, {name}"] = {
                "fitted": [label for label, _, _ in intervals],
                "seconds": seconds,
                "sensors": sorted(calibrations),
                "not fitted": refused,
            }
            fits[f"{kind}, {name}"] = calibrations
    rows = coherence(judged, fits, offsets=["one-link-fixed-frame:left"]).rows
    print(
        "switching: |mean error of the net force|, N (x, y, z); offset of every sensor from 'left'; * phase was fitted"
    )
    for name, facts in about.items():
        own = {row.phase: row for row in rows if row.calibration == name}
        facts["air"] = _in_air(air, fits.get(name, {}))
        facts["phases"] = {phase: _phase(own[phase], phase in facts["fitted"]) for phase in PHASES}
        cells = "; ".join(_cell(phase, facts["phases"][phase]) for phase in PHASES)
        print(f"  {name:32s} {cells}; {facts['seconds']:.1f} s")
        for sensor, errors in facts["air"].items():
            before, after = errors["prior"], errors["new"]
            print(
                f"    {sensor} in the air, 25 to 35.5 s, offset as fitted: {before[0]:.2f} -> {after[0]:.2f} N, "
                f"{before[1]:.3f} -> {after[1]:.3f} N m"
            )
        for sensor, words in facts["not fitted"].items():
            print(f"    {sensor} not fitted: {words.split(';')[0]}")
    prior = about["prior"]["phases"]
    print("  samples: " + ", ".join(f"{phase} {prior[phase]['samples']}" for phase in PHASES))
    return about


def _phase(row: PhaseForce, fitted: bool) -> dict[str, Any]:
    return {
        "error, N": float(np.linalg.norm(row.force_error_N)),
        "axes, N": [float(value) for value in row.force_error_N],
        "samples": row.samples,
        "fitted": fitted,
    }


def _cell(phase: str, facts: Mapping[str, Any]) -> str:
    x, y, z = facts["axes, N"]
    return f"{phase} {facts['error, N']:.2f}{'*' if facts['fitted'] else ''} ({x:.1f}, {y:.1f}, {z:.1f})"


def _singly(experiment: Experiment) -> tuple[dict[str, Calibration], dict[str, str]]:
    """Every sensor alone, as far as something hangs from it that nothing touches."""
    fits, refused = {}, {}
    for sensor in experiment.sensors:
        try:
            fits[sensor.name] = calibrate_sensor(
                SensorRun(experiment, sensor.name), code_version=VERSION, created=CREATED
            )
        except ForceTorqueError as error:
            refused[sensor.name] = str(error)
    return fits, refused


def _jointly(experiment: Experiment) -> tuple[dict[str, Calibration], dict[str, str]]:
    result = calibrate_jointly([experiment], "joint", code_version=VERSION, created=CREATED)
    return {one.calibration.sensor.name: one.calibration for one in result.calibrations}, {}


def _in_air(air: Experiment, calibrations: Mapping[str, Calibration]) -> dict[str, Any]:
    """Mean norms of force and moment error where the leg moves in the air, with the offset as fitted; N, N m."""
    errors: dict[str, Any] = {}
    for sensor in AIR_SENSORS:
        if sensor in calibrations:
            rows = validation_errors(SensorRun(air, sensor), {"new": calibrations[sensor]}).verdicts
            errors[sensor] = {
                row.calibration: (row.force_error_mean_N, row.moment_error_mean_Nm)
                for row in rows
                if row.offset is Offset.FITTED
            }
    return errors


def _with_intervals(text: str, intervals: Intervals, use: str = "calibration") -> str:
    """The same experiment, with other intervals, all of one use, on both feet where they are called so."""
    table = '[[interval]]\nlabel = "{}"\nstart_s = {}\nend_s = {}\nuse = "{use}"\nsupport = "l_sole"\n'
    both = [label for label, _, _ in intervals if label in PHASES]
    contact = [f'[[contact]]\nframe = "r_sole"\nintervals = {json.dumps(both)}\n'] if both else []
    head = text[: text.index("[[contact]]")]
    return "\n".join([head, *contact, *(table.format(*interval, use=use) for interval in intervals)])


def _load(text: str, data: Path, path: Path, *, exact: bool) -> Experiment:
    text = text.replace("[robot]\n", '[robot]\ntolerance = "exact"\n') if exact else text
    path.write_text(text.replace("../../shared/data", data.as_posix()), encoding="utf-8")
    return load_experiment(path)


def _timed(task: Callable[[], T]) -> tuple[T, float]:
    start = time.process_time()
    return task(), time.process_time() - start


if __name__ == "__main__":
    main()
