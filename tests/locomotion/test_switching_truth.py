# SPDX-License-Identifier: BSD-3-Clause
"""Files of a simulated recording whose support changes say what truth says: perfect sensors find every contact."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario, simulate
from forcetorque.simulation.simulated_sensor import SimulatedSensor
from tests.scenes.switchings import short_switching

ROUNDING_N = 1e-6
"""Rounding of counts that stand for 500 N, and of wrenches over 40 bodies; truth is at the same instants."""
DAY = "switching_day1"


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[Experiment, Recording, Mapping[str, SimulatedSensor]]:
    """The first day without anything that disturbs it: its experiment, the true contact wrenches, and its sensors."""
    folder = tmp_path_factory.mktemp("exact") / "out"
    content = short_switching().exact()
    scenario = build_scenario(content.model_copy(update={"recording": content.recording[:1]}))
    write_scenario(scenario, folder)
    (simulated,) = simulate(scenario)
    return load_experiment(folder / f"{DAY}.toml"), read_recording(folder / f"{DAY}_contacts"), simulated.sensors


def _left(experiment: Experiment, truth: Recording, known: Mapping[str, Correction]) -> dict[tuple[str, str], float]:
    """By phase and contact, how far the estimate is from the truth at most."""
    left = {}
    for result in estimate_experiment(experiment, known):
        for index, contact in enumerate(result.estimates.layout.contacts):
            stream = truth.stream(contact)
            true = interpolate(stream, stream.signal("wrench").values, result.stamp_ns)
            error = result.estimates.contact_wrenches[:, index] - true
            left[result.interval.label, contact] = float(np.abs(error).max())
    return left


def _read_by(matrix: FloatArray, offset: FloatArray) -> Correction:
    return Correction(model=WrenchModel(matrix=matrix, offset=offset), source="a test", matrix_source="a test")


@pytest.mark.long
def test_perfect_sensors_find_all_contacts(
    written: tuple[Experiment, Recording, Mapping[str, SimulatedSensor]],
) -> None:
    """By the true matrices and offsets `estimate` gives hook and feet in every phase what truth has; by a prior not."""
    experiment, truth, sensors = written
    known = {name: _read_by(sensor.matrix, sensor.offset) for name, sensor in sensors.items()}
    left = _left(experiment, truth, known)
    both = [(f"double_{k}", foot) for k in (1, 2, 3) for foot in ("l_sole", "r_sole")]
    assert set(left) == {("hanging", "torso"), ("l_sole", "l_sole"), ("r_sole", "r_sole"), *both}
    assert max(left.values()) < ROUNDING_N
    prior = experiment.sensor("r_foot_ft").prior
    assert prior is not None
    wrong = _left(experiment, truth, {**known, "r_foot_ft": _read_by(prior, sensors["r_foot_ft"].offset)})
    assert wrong["double_2", "r_sole"] > 3.0
