# SPDX-License-Identifier: BSD-3-Clause
"""Robots on both feet, each with its own sensors and errors, calibrated in one motion and judged in others.

`python -m tests.calibration.joint.joint_trials` prints the figures of docs/calibration/joint.md.
"""

from __future__ import annotations

import argparse
import tempfile
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import count, product
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.joint.calibrate import calibrate_jointly
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.robot_model_error import ModelTolerance
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario, simulate, trace_recordings
from forcetorque.simulation.scenario.scenario_file import ScenarioFile, bundled_scenario

WAYS = {"sway": ["sway"], "steps": ["stepping"], "both": ["sway", "stepping"]}
"""Motions that are fitted together."""
JUDGED = ("sway", "stepping", "squat")
"""Motions in which a calibration is judged."""
FIRST_SEED = 101
ARMS = ("l_arm_ft", "r_arm_ft")
PUSH_N = 50.0
ALONE = "alone"
"""Way in which every sensor is calibrated by itself, on one foot and then on the other."""
FEET = {"left_foot": ("l_sole", "r_sole"), "right_foot": ("r_sole", "l_sole")}
"""Support and free foot of motions on one foot."""


@dataclass(frozen=True, kw_only=True)
class SensorTrial:
    """One sensor of one robot after one calibration."""

    sensor: str
    """Its name."""
    motions: Mapping[str, FloatArray]
    """Mean norm of its error in motions that were not fitted, with the fitted offset: force, moment; N, N m."""
    prior_motions: Mapping[str, FloatArray]
    """The same by the prior matrix with the offset that is best for each motion, which flatters it."""
    push: float
    """Root mean square error of pushes of 50 N along the axes; N."""
    prior_push: float
    """The same by the prior."""
    ratio: float
    """Error of these pushes over what is predicted, root mean square."""
    predicted_150: float
    """Predicted standard deviation of 150 N along z; N."""


def robots(number: int) -> Iterator[dict[str, list[SensorTrial]]]:
    """Try so many robots, of 1 to 10 counts of noise; one whose joints would leave their limits is another's turn."""
    tried = 0
    for seed in count(FIRST_SEED):
        if tried == number:
            return
        with suppress(RobotError):
            noise = float(np.random.default_rng(seed).uniform(1.0, 10.0))
            yield trials(seed, WAYS, JUDGED, noise_counts=noise)
            tried += 1


def trials(
    seed: int,
    fitted: Mapping[str, Sequence[str]],
    judged: Sequence[str],
    *,
    noise_counts: float = 3.0,
    mass: float = 0.02,
    centre_m: float = 0.002,
    joint_zero_deg: float = 0.5,
    sensors: Mapping[str, float] | None = None,
    tolerance: ModelTolerance | None = None,
    duration_s: float = 20.0,
) -> dict[str, list[SensorTrial]]:
    """Simulate a robot, calibrate it in several ways and judge every way.

    Args:
        seed: Seed of everything.
        fitted: Kinds of motion that are fitted together, by the name of the way.
        judged: Kinds of motion that are judged, with the feet elsewhere.
        noise_counts: White noise of the sensors; counts.
        mass: Standard deviation of masses, relative.
        centre_m: Of centres of mass; m.
        joint_zero_deg: Of joint zeros; degrees.
        sensors: Other values of the scenario's sensors.
        tolerance: How far the model is allowed to be off; the default if None.
        duration_s: Length of every motion; s.

    Returns:
        Every sensor by way.
    """
    scenario = build_scenario(
        _content(seed, fitted, judged, noise_counts, (mass, centre_m, joint_zero_deg), sensors or {}, duration_s)
    )
    traces = trace_recordings(scenario)
    simulated = {one.name: one for one in simulate(scenario, traces)}
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "out"
        write_scenario(scenario, place)
        results = {}
        for way, kinds in fitted.items():
            experiments = [load_experiment(place / f"{kind}_fitted.toml") for kind in kinds]
            results[way] = _alone(experiments) if way == ALONE else _together(experiments, tolerance)
    true = {name: sensor.matrix for name, sensor in next(iter(simulated.values())).sensors.items()}
    return {
        way: [
            _judged(
                calibration,
                true[name],
                {
                    kind: (
                        simulated[f"{kind}_judged"].recording.stream(name).signal("raw").values,
                        traces[f"{kind}_judged"].loads[name],
                    )
                    for kind in judged
                },
            )
            for name, calibration in calibrations.items()
        ]
        for way, calibrations in results.items()
    }


def _together(experiments: Sequence[Experiment], tolerance: ModelTolerance | None) -> dict[str, Calibration]:
    result = calibrate_jointly(experiments, "out", code_version="1", created="2020-01-01", tolerance=tolerance)
    return {one.calibration.sensor.name: one.calibration for one in result.calibrations}


def _alone(experiments: Sequence[Experiment]) -> dict[str, Calibration]:
    """Every sensor by itself, with the support known."""
    return {
        sensor.name: calibrate_sensor(
            [SensorRun(experiment, sensor.name) for experiment in experiments], code_version="1", created="2020-01-01"
        )
        for sensor in experiments[0].sensors
    }


def _motion(kind: str, duration_s: float, placement: int) -> dict[str, Any]:
    if kind in FEET:
        support, swing = FEET[kind]
        return {"motion": {"kind": "balancing", "swing": swing, "postures": 3}, "support": support}
    motion = {"kind": kind, "swing": "r_sole", "duration_s": duration_s, "placement": placement}
    return {"motion": motion, "support": "l_sole"}


def _content(
    seed: int,
    fitted: Mapping[str, Sequence[str]],
    judged: Sequence[str],
    noise_counts: float,
    errors: tuple[float, float, float],
    sensors: Mapping[str, float],
    duration_s: float,
) -> ScenarioFile:
    table = tomllib.loads(bundled_scenario("stance").read_text(encoding="utf-8"))
    mass, centre_m, joint_zero_deg = errors
    table |= {"seed": seed}
    table["robot_errors"] |= {"mass": mass, "centre_m": centre_m, "joint_zero_deg": joint_zero_deg}
    if mass == centre_m == joint_zero_deg == 0.0:
        del table["robot_errors"]
        table["imu"] |= dict.fromkeys(("accelerometer_bias", "gyroscope_bias"), 0.0)
    table["sensors"] |= {"noise_counts": noise_counts, **sensors}
    kinds = dict.fromkeys(kind for together in fitted.values() for kind in together)
    table["recording"] = [
        {
            "name": f"{kind}_{role}",
            **_motion(kind, duration_s, placement),
            "power_up": 1,
            "session": "day",
            "use": use,
        }
        for role, use, placement, names in (("fitted", "calibration", 1, kinds), ("judged", "validation", 2, judged))
        for kind in names
    ]
    return ScenarioFile.model_validate(table)


def _judged(
    calibration: Calibration, true: FloatArray, motions: Mapping[str, tuple[FloatArray, FloatArray]]
) -> SensorTrial:
    assert calibration.prior is not None
    assert calibration.posterior is not None
    prior = calibration.prior.matrix
    errors, before = {}, {}
    for kind, (raw, load) in motions.items():
        errors[kind] = _mean_norms(raw @ calibration.matrix.T + calibration.offset - load)
        error = raw @ prior.T - load
        before[kind] = _mean_norms(error - error.mean(axis=0))
    pushes = PUSH_N * np.eye(6)[:3]
    left, prior_left = (
        pushes @ (matrix @ np.linalg.pinv(true) - np.eye(6)).T for matrix in (calibration.matrix, prior)
    )
    spread = np.sqrt(np.einsum("kii->ki", calibration.posterior.error_covariance(pushes)))
    return SensorTrial(
        sensor=calibration.sensor.name,
        motions=errors,
        prior_motions=before,
        push=_size(left),
        prior_push=_size(prior_left),
        ratio=float(np.sqrt(((left / spread) ** 2).mean())),
        predicted_150=float(np.sqrt(calibration.posterior.error_covariance([0, 0, 150.0, 0, 0, 0])[2, 2])),
    )


def _mean_norms(error: FloatArray) -> FloatArray:
    return np.array([np.linalg.norm(error[:, part], axis=1).mean() for part in (slice(3), slice(3, 6))])


def _size(error: FloatArray) -> float:
    return float(np.sqrt((error[:, :3] ** 2).sum(axis=1).mean()))


def main() -> None:
    """Print errors by way, kind of sensor and judged motion; the prior with the offset that is best for the motion."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--robots", type=int, default=20)
    tried = list(robots(parser.parse_args().robots))
    for way, arms in product(WAYS, (False, True)):
        by_robot = [[one for one in robot[way] if (one.sensor in ARMS) == arms] for robot in tried]
        sensors = [one for own in by_robot for one in own]
        who = f"{way}, {'arms' if arms else 'legs and feet'}"
        for kind in JUDGED:
            errors = np.array([one.motions[kind] for one in sensors])
            before = np.mean([one.prior_motions[kind][0] for one in sensors])
            worst = max(np.mean([one.motions[kind][0] for one in own]) for own in by_robot)
            print(  # noqa: T201
                f"{who}, judged in {kind}: {errors[:, 0].mean():.2f} N, worst robot {worst:.2f}, worst sensor "
                f"{errors[:, 0].max():.2f}; {errors[:, 1].mean():.3f} N m; by the prior {before:.2f} N"
            )
        pushes, ratios = np.array([one.push for one in sensors]), np.array([one.ratio for one in sensors])
        print(  # noqa: T201
            f"{who}, pushes of {PUSH_N:g} N: {pushes.mean():.2f} N, worst {pushes.max():.2f}, by the prior "
            f"{np.mean([one.prior_push for one in sensors]):.2f}, worst share of it "
            f"{max(one.push / one.prior_push for one in sensors):.2f}; error over predicted "
            f"{np.sqrt((ratios**2).mean()):.2f}, worst {ratios.max():.2f}"
        )


if __name__ == "__main__":
    main()
