# SPDX-License-Identifier: BSD-3-Clause
"""A wrist that turns on an arm: its orientation has no acceleration, which then passes for weight."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.answers import payload_answers
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.load_warnings import reason_to_withhold, reference_doubts

MASS, CENTRE, ARM = 0.9, np.array([0.0, 0.0, 0.04]), 0.6
GRAVITY, RATE_HZ = 9.80665, 100.0
NOISE = np.array([0.05, 0.05, 0.05, 0.003, 0.003, 0.003])

TEXT = """\
schema = "forcetorque/experiment/1"
name = "turning wrist"
load = { frame = "wrist", motion = ["log"], measure_direction = "child_to_parent" }
sensor = [{ name = "wrist", stream = "log", serial = "W", prior = "identity" }]
interval = [{ label = "all", start_s = 0.0, use = "calibration" }]

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "log.csv"
stamp = { column = "t", unit = "s" }

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "wrist"

[[recording.stream.signal]]
quantity = "gravity"
columns = ["gx", "gy", "gz"]
units = ["m/s2", "m/s2", "m/s2"]
frame = "wrist"
"""


def _run(angle: np.ndarray, folder: Path, *, held: bool = False, noise: float = 0.0) -> SensorRun:
    """Log of a sensor that turns about y, `ARM` away from the axis along its -z; of poses it is cut between them.

    The noise is that of the logged gravity, m/s2.
    """
    time = np.arange(len(angle)) / RATE_HZ
    speed = np.zeros_like(angle) if held else np.gradient(angle, time)
    turning = np.gradient(speed, time)
    none = np.zeros_like(angle)
    gravity = GRAVITY * np.column_stack([np.sin(angle), none, -np.cos(angle)])
    moved = np.column_stack([ARM * turning, none, -ARM * speed**2])  # of the sensor, along its axes
    force = MASS * (gravity - moved)
    wrench = np.hstack([force, np.cross(CENTRE, force)]) + [2.0, -1.0, 5.0, 0.1, 0.2, -0.1]
    wrench += np.random.default_rng(3).normal(size=wrench.shape) * NOISE
    logged = gravity + noise * np.random.default_rng(9).normal(size=gravity.shape)
    table = np.column_stack([time, wrench, logged])
    np.savetxt(folder / "log.csv", table, delimiter=",", comments="", header="t,fx,fy,fz,tx,ty,tz,gx,gy,gz", fmt="%.9g")
    path = folder / "wrist.toml"
    path.write_text(TEXT)
    experiment = load_experiment(path)
    return SensorRun(experiment, experiment.sensors[0])


def _turn(seconds: float) -> np.ndarray:
    """Angles of a half turn from one side to the other, which gathers speed in a fifth; a second of rest about it."""
    time = np.arange(0.0, seconds + 2.0, 1.0 / RATE_HZ) - 1.0
    speed = np.clip(np.minimum(time, seconds - time) / (0.2 * seconds), 0.0, 1.0)
    angle: np.ndarray = np.cumsum(speed)
    return np.pi * (angle / angle[-1] - 0.5)


def test_a_wrist_that_turns_while_it_weighs_is_named(tmp_path: Path) -> None:
    """Its mass is off by more than the interval says, and no file is written for a robot."""
    run = _run(_turn(4.0), tmp_path)
    weighed = weigh_load(run)
    (load,) = weighed.loads
    assert load.mass_kg is not None
    assert load.mass_half_width_95_kg is not None
    assert abs(load.mass_kg - MASS) > load.mass_half_width_95_kg
    assert [row.name for row in weighed.hypotheses] == ["motion of the arm"]
    (answer,) = payload_answers(weighed)
    assert answer.step.startswith("check for motion of the arm")
    withheld = reason_to_withhold(weighed)
    assert withheld is not None
    assert withheld.startswith("motion of the arm: the sensor turns in ")
    assert any(words.startswith("motion of the arm: ") for words in reference_doubts(run))


def test_a_slow_turn_is_not_named(tmp_path: Path) -> None:
    """A minute for the same turn leaves the mass within its interval."""
    run = _run(_turn(60.0), tmp_path)
    weighed = weigh_load(run)
    (load,) = weighed.loads
    assert load.mass_kg == pytest.approx(MASS, abs=load.mass_half_width_95_kg)
    assert not weighed.hypotheses
    assert not any(words.startswith("motion of the arm") for words in reference_doubts(run))


def test_held_poses_are_not_named(tmp_path: Path) -> None:
    """A log that is cut between poses of a third of a second holds no motion."""
    angle = np.repeat(np.random.default_rng(5).uniform(-3.0, 3.0, 24), 33)
    weighed = weigh_load(_run(angle, tmp_path, held=True))
    assert "motion of the arm" not in [row.name for row in weighed.hypotheses]


def test_noise_of_the_orientation_is_no_motion(tmp_path: Path) -> None:
    """Gravity by an accelerometer scatters by some mrad at rest, which is fast from sample to sample."""
    angle = np.repeat(np.random.default_rng(5).uniform(-3.0, 3.0, 24), 300)
    for noise in (0.02, 0.05):
        assert not weigh_load(_run(angle, tmp_path, held=True, noise=noise)).hypotheses
    turning = weigh_load(_run(_turn(4.0), tmp_path, noise=0.02))
    assert [row.name for row in turning.hypotheses] == ["motion of the arm"]
