# SPDX-License-Identifier: BSD-3-Clause
"""A fleet: records of one simulated sensor, changed as healthy and damaged sensors of other robots would have them."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.section import LoadCaseOffset
from forcetorque.experiment.calibration.calibration_file import Calibration, write_calibration
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.fleet.sensor_record import AddOptions, SensorRecord
from forcetorque.fleet.stored_validation_data import StoredEvaluation
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.simulation.scenario.scenario import trace_recordings
from tests.scenes.studies import SENSOR, SERIAL, scenario, write_days

DAY_NS: Final = 86_400 * 10**9
FIRST_NS: Final = 1_767_225_600 * 10**9
"""The first of January 2026, UTC."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Damage:
    """What a sensor does to its readings, beside what it did when it was calibrated."""

    gain: float = 1.0
    """Gain of all channels."""
    flipped: bool = False
    """Whether all channels are reversed."""
    dead: int | None = None
    """Channel that reads 0."""
    drift_counts_per_s: float = 0.0
    """Drift of all channels."""
    noise_counts: float = 0.0
    """Slow noise of all channels, white in means over a second; of records alone."""
    clipped: bool = False
    """Whether an amplifier clips readings at half of their deviations from the middle; of logs alone."""

    def matrix(self, channels: int) -> FloatArray:
        """What readings are multiplied with; shape (c, c)."""
        made = (-1.0 if self.flipped else 1.0) * self.gain * np.eye(channels)
        if self.dead is not None:
            made[self.dead] = 0.0
        return made

    def of_log(self, raw: FloatArray, seconds: FloatArray) -> FloatArray:
        """Readings of a log, whole counts; shape (n, c)."""
        made = raw @ self.matrix(raw.shape[1]).T + self.drift_counts_per_s * seconds[:, None]
        if self.clipped:
            low, high = made.min(axis=0), made.max(axis=0)
            made = np.clip(made, 0.75 * low + 0.25 * high, 0.25 * low + 0.75 * high)
        return np.rint(made)


DAMAGES: Final[Mapping[str, Damage]] = {
    "gain": Damage(gain=1.1),
    "reversed": Damage(flipped=True),
    "drifting": Damage(drift_counts_per_s=60.0),
    "dead": Damage(dead=2),
    "noisy": Damage(noise_counts=400.0),
    "clipped": Damage(clipped=True),
}
"""Damages that an evaluation can see."""


def fleet_of(
    robots: int, damaged: Mapping[int, str], record: SensorRecord, calibration: Calibration, folder: Path
) -> list[str]:
    """Write a dataset of robots with a validation recording on each of two days, and the calibrations of the sensors.

    Args:
        robots: Number of robots.
        damaged: Name of a damage by the number of its robot, from 0; it shows on the second day.
        record: Validation record of a sensor.
        calibration: Its calibration.
        folder: Where `fleet` and `calibrations` are made.

    Returns:
        Serial numbers by the number of the robot.
    """
    rng, serials = np.random.default_rng(7), [f"FT{k:03}" for k in range(robots)]
    (folder / "calibrations").mkdir(parents=True)
    for k, serial in enumerate(serials):
        sensor = calibration.sensor.model_copy(update={"serial": serial})
        own = calibration.model_copy(update={"sensor": sensor})
        write_calibration(folder / "calibrations" / f"{serial}.json", own)
        for day in range(2):
            damage = DAMAGES[damaged[k]] if day and k in damaged else Damage(gain=1.0 + 0.002 * rng.normal())
            made = _record(record, serial, day, damage, rng)
            Dataset(folder / "fleet").write(made, AddOptions(robot=f"robot {k}"))
    return serials


def _record(record: SensorRecord, serial: str, day: int, damage: Damage, rng: np.random.Generator) -> SensorRecord:
    assert record.evaluation is not None
    start_ns = FIRST_NS + day * DAY_NS
    text = f"{serial}, day {day}"
    return record.model_copy(
        update={
            "identity": record.identity.model_copy(update={"serial": serial}),
            "experiment": text,
            "file": f"/logs/{serial}/day_{day}.toml",
            "recording": hashlib.sha256(text.encode()).hexdigest(),
            "start_ns": start_ns,
            "end_ns": start_ns + record.end_ns - record.start_ns,
            "evaluation": _damaged(record.evaluation, serial, damage, rng),
        }
    )


def _damaged(stored: StoredEvaluation, serial: str, damage: Damage, rng: np.random.Generator) -> StoredEvaluation:
    channels = stored.blocks[0].channels
    first = np.eye(len(stored.blocks[0].mean))
    first[:channels, :channels] = damage.matrix(channels)
    seconds = np.linspace(stored.sessions[0].time_s[0], stored.sessions[0].time_s[-1], len(stored.blocks))
    blocks = []
    for block, second in zip(stored.blocks, seconds, strict=True):
        mean, square = first @ block.mean, first @ block.second_moment @ first.T
        mean[:channels] += damage.drift_counts_per_s * second + damage.noise_counts * rng.normal(size=channels)
        blocks.append(block.model_copy(update={"mean": mean, "second_moment": square}))
    sessions = []
    for session in stored.sessions:
        raw = session.raw @ damage.matrix(channels).T + damage.drift_counts_per_s * session.time_s[:, None]
        raw += damage.noise_counts * rng.normal(size=raw.shape)
        sessions.append(session.model_copy(update={"raw": raw}))
    sensor = stored.sensor.model_copy(update={"serial": serial})
    # no interval is known again in another recording: these are of other days
    intervals = tuple(
        one.model_copy(update={"start_ns": FIRST_NS, "end_ns": FIRST_NS + 1, "content": None})
        for one in stored.intervals
    )
    # every day has a power cycle, and thus an offset of its own
    limits = {"offset": LoadCaseOffset.TARED, "is_specified": True, "allowed_force_N": 2.0, "allowed_moment_Nm": 0.2}
    cases = tuple(one.model_copy(update=limits) for one in stored.load_cases[:1])
    return stored.model_copy(
        update={
            "load_cases": cases,
            "sensor": sensor,
            "log_sha256": (hashlib.sha256(serial.encode()).hexdigest(),),
            "intervals": intervals,
            "blocks": tuple(blocks),
            "sessions": tuple(sessions),
        }
    )


PLAN: Final = """
schema = "forcetorque/fleet_plan/1"
dataset = "fleet"
calibrations = "calibrations"
"""
LOAD_CASE: Final = """
[[load_case]]
name = "push"
force_N = 40.0
radius_m = 0.1
offset = "tared"
force_error_N = 2.0
moment_error_Nm = 0.2
"""


def write_logs(robots: int, damaged: Mapping[int, str], folder: Path) -> Path:
    """Write logs of robots, each with a sensor of its own: two to calibrate it, and two days to validate it.

    Args:
        robots: Number of robots.
        damaged: Name of a damage by the number of its robot; it shows on the second day.
        folder: Where they are written.

    Returns:
        Plan that adds and calibrates all of them.
    """
    traces, plan = trace_recordings(scenario()), [PLAN]
    for k in range(robots):
        robot = folder / f"robot_{k}"
        write_days(robot, scenario().with_sensors(seed=100 + k), traces)
        damage = DAMAGES[damaged[k]] if k in damaged else Damage()
        log = read_recording(robot / "day_2")
        stream = log.stream(SENSOR)
        seconds = 1e-9 * (stream.stamp_ns - stream.stamp_ns[0])
        raw = stream.signals["raw"]
        signals = dict(stream.signals) | {"raw": replace(raw, values=damage.of_log(raw.values, seconds))}
        streams = dict(log.streams) | {SENSOR: replace(stream, signals=signals)}
        shutil.rmtree(robot / "day_2")
        write_recording(robot / "day_2", replace(log, streams=streams))
        (robot / f"matrix_{SERIAL}.txt").rename(robot / f"matrix_FT{k:03}.txt")
        for file in robot.glob("*.toml"):
            text = file.read_text(encoding="utf-8").replace(SERIAL, f"FT{k:03}")
            file.write_text(text.replace('name = "arm ', f'name = "arm {k} ') + LOAD_CASE, encoding="utf-8")
        for name in ("move_cold.toml", "grid_cold.toml"):
            (robot / name).unlink()
        plan.append(f'[[recordings]]\nexperiments = "robot_{k}/*.toml"\nrobot = "robot {k}"\n')
    file = folder / "plan.toml"
    file.write_text("".join(plan), encoding="utf-8")
    return file
