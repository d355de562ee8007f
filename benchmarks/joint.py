# SPDX-License-Identifier: BSD-3-Clause
"""An hour of six sensors calibrated jointly, against setting up the equations of its samples once, one by one."""

from __future__ import annotations

import resource
import tempfile
import time
import tomllib
from pathlib import Path

import numpy as np

from benchmarks.harness import arguments, write_result
from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.joint.robust_fit import UntouchedStretch, fit_stretches
from forcetorque.calibration.joint.untouched_interval import joint_interval
from forcetorque.calibration.joint.window_nodes import Stretch
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Use
from forcetorque.robot.mechanics.sub_model_equations import part_equations
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario
from forcetorque.simulation.scenario.scenario_file import ScenarioFile, bundled_scenario

BLOCK = 6000
"""Samples whose equations fit into memory at a time."""


def main() -> None:
    """Time both, and write ratio, memory and seconds of the processor."""
    options = arguments(__doc__ or "")
    minutes, rounds = (2, 2) if options.quick else (60, 3)
    one = _repeated(_sway(), minutes * 60.0)
    seconds: dict[str, list[float]] = {"joint calibration": [], "equations of every sample": []}
    for _ in range(rounds):
        for name, task in (
            ("joint calibration", lambda: fit_stretches([one])),
            ("equations of every sample", lambda: _equations(one)),
        ):
            start = time.process_time()
            task()
            seconds[name].append(time.process_time() - start)
    ratios = [a / b for a, b in zip(*seconds.values(), strict=True)]
    write_result(
        options.json,
        ratios={"joint calibration to equations of every sample, once": float(np.median(ratios))},
        seconds=seconds,
        accuracy={"sensors": len(one.stretch.readings), "samples": len(one.stretch)},
        rounds=rounds,
        packages=("numpy",),
        figures={
            "minutes": minutes,
            "processor_s": float(np.median(seconds["joint calibration"])),
            "peak_memory_MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3,
        },
    )


def _sway() -> UntouchedStretch:
    """Twenty seconds of sway of the bundled robot."""
    content = tomllib.loads(bundled_scenario("stance").read_text(encoding="utf-8"))
    content["recording"] = content["recording"][:1]
    with tempfile.TemporaryDirectory() as folder:
        write_scenario(build_scenario(ScenarioFile.model_validate(content)), Path(folder) / "out")
        experiment = load_experiment(Path(folder) / "out" / "sway_day1.toml")
        (interval,) = experiment.intervals(Use.CALIBRATION)
        return joint_interval(experiment, interval, [sensor.name for sensor in experiment.sensors]).untouched


def _repeated(one: UntouchedStretch, duration_s: float) -> UntouchedStretch:
    """The same motion again and again, with other noise."""
    short = one.stretch
    step = float(np.median(np.diff(short.time_s)))
    times = round(duration_s / (step * len(short)))
    rng = np.random.default_rng(1)

    def again(values: FloatArray) -> FloatArray:
        return np.tile(values, (times, 1))

    joints, root = short.joints, short.root
    stretch = Stretch(
        label=short.label,
        recording=short.recording,
        session=short.session,
        time_s=short.time_s[0] + step * np.arange(times * len(short)),
        tree=short.tree,
        joints=JointMotion(
            names=joints.names,
            position=again(joints.position),
            velocity=again(joints.velocity),
            acceleration=again(joints.acceleration),
        ),
        root=RootMotion(
            proper_acceleration=again(root.proper_acceleration),
            angular_velocity=again(root.angular_velocity),
            angular_acceleration=again(root.angular_acceleration),
        ),
        readings={
            name: again(values) + 0.01 * rng.normal(size=(times * len(short), 6))
            for name, values in short.readings.items()
        },
        touched=short.touched,
    )
    return UntouchedStretch(stretch=stretch, parts=one.parts)


def _equations(one: UntouchedStretch) -> None:
    stretch = one.stretch
    for start in range(0, len(stretch), BLOCK):
        rows = slice(start, start + BLOCK)
        for equation in part_equations(
            stretch.tree, one.parts, stretch.joints.samples(rows), stretch.root.samples(rows)
        ):
            readings = np.stack([stretch.readings[name][rows] for name in equation.sensors], axis=1)
            np.einsum("nkia,nkb->nikab", equation.transmission, readings)


if __name__ == "__main__":
    main()
