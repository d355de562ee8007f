# SPDX-License-Identifier: BSD-3-Clause
"""Findings of `inspect` on simulated logs with one planted fault each, and on logs without: found, named, false alarms.

Four limbs: the arm of the small robot, and left leg, right foot and left arm of a biped that hangs by its pelvis. The
robot differs from its URDF in every log, by 3 % of masses, 2 mm of centres and 0.5 deg of joint zeros (standard
deviations); sensors have noise with a 1/f part, drift with temperature and a matrix that mounting changed. A fault is
planted into the log, or into what the experiment file says. It counts as found where any finding says that something is
wrong, and as named where one of the expected kind names the planted thing, and no finding of another fault is above it.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from benchmarks.harness import arguments, write_result
from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import rotation_about_z
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.inspection.inspect import FindingRow, inspected
from forcetorque.recording.recording import Support
from forcetorque.recording.stream import Stream
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario
from forcetorque.simulation.scenario.scenario_file import ScenarioFile
from forcetorque.simulation.simulated_sensor import calibrated_by_board

LIMBS = {"arm_ft": "arm", "l_leg_ft": "biped", "r_foot_ft": "biped", "l_arm_ft": "biped"}
"""Robot of every sensor."""
JOINTS = {"arm_ft": "shoulder_pitch", "l_leg_ft": "l_hip_roll", "r_foot_ft": "r_knee", "l_arm_ft": "l_shoulder_roll"}
"""Joint of every limb that is planted wrong."""
MOTIONS = ("random", "z_torque")
FAULT_S, CLEAN_S = 60.0, 600.0
"""Lengths of a log of the random motion, with a fault and without; s."""
FAULT_SEEDS, CLEAN_SEEDS = range(960, 963), range(965, 970)
"""Seeds of logs with a fault and without, which were not used for development."""
_WARNINGS = ("not_compared", "clock")
"""Kinds that say what was not looked at, or how the log was read."""


def scenario(seed: int, limb: str, motion: str, *, seconds: float) -> ScenarioFile:
    """Describe a log of one sensor of a robot that is not quite its model."""
    moved: dict[str, Any] = {"kind": motion}
    moved |= {"duration_s": seconds} if motion == "random" else {"sensor": limb, "postures": 5}
    return ScenarioFile.model_validate(
        {
            "schema": "forcetorque/scenario/1",
            "name": "diagnosis",
            "seed": seed,
            "robot": {"model": [LIMBS[limb]]},
            "robot_errors": {"mass": 0.03, "centre_m": 0.002, "joint_zero_deg": 0.5},
            "sensors": {
                "names": [limb],
                "family": "double range",
                "noise_corner_hz": 0.5,
                "offset_counts": 3000.0,
                "drift_counts_per_degC": 6.0,
                "creep_share": 0.003,
                "mounting_sd": 0.03,
            },
            "recording": [{"name": "log", "motion": moved, "temperature_degC": [30.0, 30.5]}],
        }
    )


@lru_cache(maxsize=2)
def clean_experiment(seed: int, limb: str, motion: str, seconds: float) -> Experiment:
    """Simulate a log without a fault, whose sensor logs wrenches."""
    with TemporaryDirectory() as name:
        folder = Path(name) / "scenario"
        write_scenario(build_scenario(scenario(seed, limb, motion, seconds=seconds)), folder)
        experiment = load_experiment(folder / "log.toml")
    (sensor,) = experiment.sensors
    if sensor.prior is None:
        raise ValueError("expected a prior matrix in the simulated experiment")
    recording = calibrated_by_board(experiment.recording, limb, matrix=sensor.prior, frame=limb)
    return replace(experiment, recording=recording, sensors=(replace(sensor, quantity="wrench"),))


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """A fault and what a finding of it says."""

    plant: Callable[[Experiment, str, np.random.Generator], Experiment]
    kinds: tuple[str, ...]
    """Kinds of findings that name it."""
    words: tuple[str, ...] = ()
    """Texts of which one is in the message that names it; `{joint}` is the joint."""
    is_local: bool = False
    """Whether it is in a part of the log."""


def _with_stream(experiment: Experiment, stream: Stream) -> Experiment:
    recording = experiment.recording
    return replace(experiment, recording=replace(recording, streams={**recording.streams, stream.name: stream}))


def _wrench(experiment: Experiment, limb: str, change: Callable[[FloatArray], FloatArray]) -> Experiment:
    stream = experiment.recording.stream(limb)
    signal = stream.signal("wrench")
    return _with_stream(
        experiment, replace(stream, signals={**stream.signals, "wrench": replace(signal, values=change(signal.values))})
    )


def _joints(experiment: Experiment, change: Callable[[FloatArray, tuple[str, ...]], FloatArray]) -> Experiment:
    stream = experiment.recording.stream("joints")
    signals = {
        quantity: replace(signal, values=change(signal.values, signal.columns)) if quantity == "position" else signal
        for quantity, signal in stream.signals.items()
    }
    return _with_stream(experiment, replace(stream, signals=signals))


def _reversed(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    return _wrench(experiment, limb, lambda values: -values)


def _component_reversed(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    return _wrench(experiment, limb, lambda values: values * [-1.0, 1.0, 1.0, 1.0, 1.0, 1.0])


def _gravity(direction: Sequence[float]) -> Callable[[Experiment, str, np.random.Generator], Experiment]:
    def plant(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
        intervals = [
            replace(one, support=Support(frame=one.support.frame, gravity_direction=np.array(direction)))
            for one in experiment.recording.intervals
            if one.support is not None
        ]
        return replace(experiment, recording=experiment.recording.with_intervals(intervals))

    return plant


def _masses(factor: float) -> Callable[[Experiment, str, np.random.Generator], Experiment]:
    return lambda experiment, limb, rng: _wrench(experiment, limb, lambda values: values / factor)


def _joint_sign(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    return _joints(experiment, lambda values, names: values * [-1.0 if one == JOINTS[limb] else 1.0 for one in names])


def _joint_offset(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    shift = np.deg2rad(rng.choice([-1.0, 1.0]) * rng.uniform(8.0, 15.0))
    return _joints(experiment, lambda values, names: values + [shift if one == JOINTS[limb] else 0.0 for one in names])


def _joint_unit(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    return _joints(experiment, lambda values, names: np.rad2deg(values))


def _joints_as_degrees(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    return _joints(experiment, lambda values, names: np.deg2rad(values))


def _columns(order: Sequence[int]) -> Callable[[Experiment, str, np.random.Generator], Experiment]:
    return lambda experiment, limb, rng: _wrench(experiment, limb, lambda values: values[:, list(order)])


def _moment_unit(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    return _wrench(experiment, limb, lambda values: values * [1.0, 1.0, 1.0, 1e3, 1e3, 1e3])


def _late(stream_of: Callable[[str], str]) -> Callable[[Experiment, str, np.random.Generator], Experiment]:
    def plant(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
        stream = experiment.recording.stream(stream_of(limb))
        delay = round(rng.uniform(0.08, 0.2) * 1e9)
        return _with_stream(experiment, replace(stream, stamp_ns=stream.stamp_ns + delay))

    return plant


def _turned(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
    turn = rotation_about_z(np.array(np.deg2rad(rng.choice([-1.0, 1.0]) * rng.uniform(15.0, 30.0))))
    return _wrench(experiment, limb, lambda values: np.hstack([values[:, :3] @ turn.T, values[:, 3:] @ turn.T]))


def _size(experiment: Experiment, limb: str) -> float:
    """Weight beyond the sensor; N."""
    from forcetorque.experiment.sensor_run import SensorRun

    run = SensorRun(experiment, limb)
    samples = run.interval_samples(experiment.recording.intervals[0]).samples
    return float(np.median(np.linalg.norm(samples.reference[:, :3], axis=1)))


def _added(
    shape: Callable[[FloatArray, np.random.Generator], FloatArray], share: float, lever_m: float, axes: int = 3
) -> Callable[[Experiment, str, np.random.Generator], Experiment]:
    """Add a wrench in a random direction with a course in time; its force is a share of the weight."""

    def plant(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
        stream = experiment.recording.stream(limb)
        seconds = (stream.stamp_ns - stream.stamp_ns[0]) * 1e-9
        force = rng.standard_normal(3) if axes == 3 else np.eye(3)[rng.integers(3)]
        force *= share * _size(experiment, limb) / np.linalg.norm(force)
        place = rng.standard_normal(3)
        place *= lever_m / np.linalg.norm(place)
        wrench = np.concatenate([force, np.cross(place, force)])
        course = shape(seconds, rng)
        return _wrench(experiment, limb, lambda values: values + course[:, None] * wrench)

    return plant


def _pulse(length_s: float) -> Callable[[FloatArray, np.random.Generator], FloatArray]:
    def course(seconds: FloatArray, rng: np.random.Generator) -> FloatArray:
        since = seconds - rng.uniform(5.0, seconds[-1] - 5.0 - length_s)
        return np.clip(np.minimum(since, length_s - since) / 0.05, 0.0, 1.0)

    return course


def _jump(seconds: FloatArray, rng: np.random.Generator) -> FloatArray:
    return (seconds > rng.uniform(8.0, seconds[-1] - 8.0)).astype(np.float64)


def _ramp(seconds: FloatArray, rng: np.random.Generator) -> FloatArray:
    return seconds / seconds[-1]


def _held(
    length_s: float, channels: Sequence[int] | None
) -> Callable[[Experiment, str, np.random.Generator], Experiment]:
    def plant(experiment: Experiment, limb: str, rng: np.random.Generator) -> Experiment:
        stream = experiment.recording.stream(limb)
        start = stream.stamp_ns[0] + round(rng.uniform(5.0, 20.0) * 1e9)
        first = int(np.searchsorted(stream.stamp_ns, start))
        last = int(np.searchsorted(stream.stamp_ns, start + round(length_s * 1e9)))
        columns = list(range(6) if channels is None else channels)

        def hold(values: FloatArray) -> FloatArray:
            held = np.array(values)
            held[first : last + 1, columns] = values[first, columns]
            return held

        return _wrench(experiment, limb, hold)

    return plant


FAULTS = {
    "reversed": Fault(plant=_reversed, kinds=("reversed", "gravity"), words=("measure_direction", "gravity_direction")),
    "fx reversed": Fault(plant=_component_reversed, kinds=("component_reversed",), words=("fx",)),
    "gravity upwards": Fault(
        plant=_gravity((0.0, 0.0, 1.0)), kinds=("gravity", "reversed"), words=("gravity_direction",)
    ),
    "gravity along x": Fault(plant=_gravity((1.0, 0.0, 0.0)), kinds=("gravity",), words=("gravity_direction",)),
    "masses x 1.5": Fault(plant=_masses(1.5), kinds=("mass", "implausible_scale"), words=("mass",)),
    "masses in grams": Fault(plant=_masses(1e3), kinds=("mass",), words=("mass",)),
    "joint sign": Fault(plant=_joint_sign, kinds=("joint_sign",), words=("{joint}",)),
    "joint offset": Fault(plant=_joint_offset, kinds=("joint_offset",), words=("{joint}",)),
    "degrees as radians": Fault(plant=_joint_unit, kinds=("joint_unit", "not_compared"), words=("degrees",)),
    "radians as degrees": Fault(plant=_joints_as_degrees, kinds=("joint_unit",), words=("degrees",)),
    "fx, fy swapped": Fault(plant=_columns((1, 0, 2, 3, 4, 5)), kinds=("columns",), words=("fx and fy",)),
    "mx, mz swapped": Fault(plant=_columns((0, 1, 2, 5, 4, 3)), kinds=("columns",), words=("mx and mz",)),
    "moment first": Fault(plant=_columns((3, 4, 5, 0, 1, 2)), kinds=("columns",), words=("moment before force",)),
    "moment in N mm": Fault(plant=_moment_unit, kinds=("moment_unit",), words=("N mm",)),
    "sensor late": Fault(plant=_late(lambda limb: limb), kinds=("delay",), words=("later",)),
    "joints late": Fault(plant=_late(lambda limb: "joints"), kinds=("delay",), words=("earlier",)),
    "mount turned": Fault(plant=_turned, kinds=("mount",), words=("about z",)),
    "contact 0.5 s": Fault(plant=_added(_pulse(0.5), 0.5, 0.2), kinds=("contact", "light_contact"), is_local=True),
    "contact 3 s": Fault(plant=_added(_pulse(3.0), 0.5, 0.2), kinds=("contact", "light_contact"), is_local=True),
    "step": Fault(plant=_added(_jump, 0.3, 0.0, axes=1), kinds=("step",), is_local=True),
    "drift": Fault(plant=_added(_ramp, 0.4, 0.0, axes=1), kinds=("drift",), is_local=True),
    "channel stuck 0.4 s": Fault(plant=_held(0.4, [1]), kinds=("stuck",), is_local=True),
    "frozen 2 s": Fault(plant=_held(2.0, None), kinds=("frozen",), is_local=True),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What `inspect` said of one log."""

    seed: int
    fault: str | None
    limb: str
    motion: str
    findings: tuple[FindingRow, ...]
    hours: float
    seconds: float

    @property
    def alarms(self) -> tuple[FindingRow, ...]:
        """Findings that say that something is wrong."""
        return tuple(row for row in self.findings if row.kind not in _WARNINGS)

    @property
    def is_found(self) -> bool:
        """Whether anything was said to be wrong."""
        return bool(self.alarms) or self.is_named

    @property
    def is_named(self) -> bool:
        """Whether the first finding, in its order, names the planted fault."""
        if self.fault is None:
            return False
        fault = FAULTS[self.fault]
        words = [word.format(joint=JOINTS[self.limb]) for word in fault.words]

        def names(row: FindingRow) -> bool:
            return row.kind in fault.kinds and (not words or any(word in row.message for word in words))

        if fault.is_local:
            return any(names(row) for row in self.alarms)
        first = next((row for row in self.findings if row.start_s is None or row.kind == "not_compared"), None)
        return first is not None and names(first)


def outcome(task: tuple[int, str | None, str, str]) -> Outcome:
    """Plant a fault, and inspect the log."""
    seed, fault, limb, motion = task
    seconds = CLEAN_S if fault is None else FAULT_S
    experiment = clean_experiment(seed, limb, motion, seconds)
    if fault is not None:
        rng = np.random.default_rng([seed, list(FAULTS).index(fault), list(LIMBS).index(limb)])
        experiment = FAULTS[fault].plant(replace(experiment), limb, rng)
    else:
        experiment = replace(experiment)
    start, end = experiment.recording.span_ns
    began = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rows = inspected(experiment).findings
    return Outcome(
        seed=seed,
        fault=fault,
        limb=limb,
        motion=motion,
        findings=rows,
        hours=(end - start) * 1e-9 / 3600.0,
        seconds=time.process_time() - began,
    )


def outcomes(seeds: Sequence[int], faults: Sequence[str | None]) -> list[Outcome]:
    """Inspect the logs of some seeds, of every limb and motion."""
    return [
        outcome((seed, fault, limb, motion))
        for seed in seeds
        for limb in LIMBS
        for motion in MOTIONS
        for fault in faults
    ]


def table(results: Sequence[Outcome]) -> Iterator[str]:
    """Give a line per fault, and one of logs without."""
    yield f"{'fault':24s}{'logs':>6s}{'found':>7s}{'named':>7s}"
    for fault in FAULTS:
        own = [one for one in results if one.fault == fault]
        found, named = sum(one.is_found for one in own), sum(one.is_named for one in own)
        yield f"{fault:24s}{len(own):6d}{found:7d}{named:7d}"
    clean = [one for one in results if one.fault is None]
    hours, alarms = sum(one.hours for one in clean), sum(len(one.alarms) for one in clean)
    alarmed = sum(bool(one.alarms) for one in clean)
    of_logs = f"{alarmed} of {len(clean)} logs, {hours:.2f} h"
    if clean:
        yield f"no fault: {alarms} false alarm(s) in {of_logs}: {alarms / hours:.1f} per hour"
    yield f"CPU per log: median {np.median([one.seconds for one in results]):.2f} s"


def main() -> None:
    """Inspect logs of seeds that were not used for development."""
    options = arguments(__doc__ or "")
    count = 1 if options.quick else None
    results = [*outcomes(FAULT_SEEDS[:count], tuple(FAULTS)), *outcomes(CLEAN_SEEDS[:count], (None,))]
    print("\n".join(table(results)))
    accuracy: dict[str, dict[str, float]] = {
        fault: {
            "logs": sum(one.fault == fault for one in results),
            "found": sum(one.fault == fault and one.is_found for one in results),
            "named": sum(one.fault == fault and one.is_named for one in results),
        }
        for fault in FAULTS
    }
    clean = [one for one in results if one.fault is None]
    hours = sum(one.hours for one in clean)
    accuracy["none"] = {"logs": len(clean), "hours": hours, "false_alarms": sum(len(one.alarms) for one in clean)}
    write_result(
        options.json,
        ratios={},
        seconds={"inspect": [one.seconds for one in results]},
        accuracy=accuracy,
        rounds=len(results),
        packages=("numpy", "scipy"),
    )


if __name__ == "__main__":
    main()
