# SPDX-License-Identifier: BSD-3-Clause
"""How well all sensors come out of one motion on both feet: twenty robots, judged in motions that were not fitted.

Every robot has its own sensors (2 to 15 % off, with creep, cross-talk and slow noise), masses 2 %, centres 2 mm and
joint zeros 0.5 degrees off, an IMU with bias and noise, and white noise of 1 to 10 counts. It is judged with the fitted
offset, in sway, steps and squats with the feet elsewhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import pytest

from forcetorque.arrays import FloatArray
from tests.analysis.joint_trials import ARMS, SensorTrial, trials

SEEDS: Final = range(101, 121)
WAYS: Final = {"sway": ["sway"], "steps": ["stepping"], "both": ["sway", "stepping"]}
JUDGED: Final = ("sway", "stepping", "squat")


def _noise_counts(seed: int) -> float:
    return float(np.random.default_rng(seed).uniform(1.0, 10.0))


@pytest.fixture(scope="module")
def robots() -> list[dict[str, list[SensorTrial]]]:
    """Sensors of every robot, by what was fitted."""
    return [trials(seed, WAYS, JUDGED, noise_counts=_noise_counts(seed)) for seed in SEEDS]


def _legs(robots: Sequence[Mapping[str, list[SensorTrial]]], way: str) -> list[SensorTrial]:
    return [trial for robot in robots for trial in robot[way] if trial.sensor not in ARMS]


def _arms(robots: Sequence[Mapping[str, list[SensorTrial]]], way: str) -> list[SensorTrial]:
    return [trial for robot in robots for trial in robot[way] if trial.sensor in ARMS]


def _errors(sensors: Sequence[SensorTrial]) -> FloatArray:
    """Force and moment errors, by sensor and judged motion; shape (s, 3, 2)."""
    return np.array([[trial.motions[kind] for kind in JUDGED] for trial in sensors])
