# SPDX-License-Identifier: BSD-3-Clause
"""Tables 5.9 and 5.10 of the thesis, simulated: prior against in-situ matrix by three ways to take offsets."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.locomotion.commands import coherence
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import (
    Scenario,
    SimulatedRecording,
    build_scenario,
    simulate,
    trace_recordings,
)
from tests.scenes.switchings import short_switching

FEET = ("l_foot_ft", "r_foot_ft")
OFFSETS = ("one-link-imu:hanging", "one-link-imu:l_sole", "one-link-fixed-frame:l_sole")
SEEDS = range(300, 320)


def _recorded(experiment: Experiment, drawn: Scenario, simulated: SimulatedRecording) -> Experiment:
    """The same experiment with other sensors."""
    return replace(
        experiment,
        recording=replace(simulated.recording, intervals=experiment.recording.intervals),
        sensors=tuple(
            replace(sensor, prior=drawn.specimens[sensor.name].workbench, serial=drawn.specimens[sensor.name].serial)
            for sensor in experiment.sensors
        ),
    )


def _errors(folder: Path, seeds: range) -> dict[tuple[str, str], list[tuple[float, float]]]:
    """Norms of errors on the day not fitted, of phases that are evidence, and predicted, by offset and name."""
    content = short_switching(names=FEET)
    recordings = tuple(
        entry.model_copy(update={"motion": entry.motion.model_copy(update={"still_s": 2.0})})
        for entry in content.recording
    )
    scenario = build_scenario(content.model_copy(update={"recording": recordings}))
    write_scenario(scenario, folder)
    files = {plan.name: load_experiment(folder / f"{plan.name}.toml") for plan in scenario.plans}
    traces = trace_recordings(scenario)
    errors: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for seed in seeds:
        drawn = scenario.with_sensors(seed=seed)
        days = {one.name: _recorded(files[one.name], drawn, one) for one in simulate(drawn, traces)}
        fitted = {
            name: calibrate_sensor(
                SensorRun(days["switching_day1"], name), code_version="1", created="2020-01-01T00:00:00+00:00"
            )
            for name in FEET
        }
        for row in coherence(days["switching_day2"], {"in situ": fitted}, offsets=OFFSETS).rows:
            if row.evidence and row.phase != "hanging":
                key = f"{row.offset}:{row.offset_interval}", row.calibration
                assert row.force_predicted_N is not None
                errors.setdefault(key, []).append((float(np.linalg.norm(row.force_error_N)), row.force_predicted_N))
    return errors


@pytest.mark.long
def test_in_situ_matrices_are_more_coherent_than_priors(tmp_path: Path) -> None:
    """Twenty draws of 5 % error with noise and errors of the robot, by each way to take offsets."""
    errors = _errors(tmp_path / "out", SEEDS)
    assert set(errors) == {(offset, candidate) for offset in OFFSETS for candidate in ("prior", "in situ")}
    for offset in OFFSETS:
        prior, new = (np.array(errors[offset, one])[:, 0].reshape(len(SEEDS), -1) for one in ("prior", "in situ"))
        for candidate in ("prior", "in situ"):
            norm, predicted = np.transpose(errors[offset, candidate])
            # what is predicted allows for more errors than these robots have
            assert 0.4 < np.sqrt((norm**2).mean() / (predicted**2).mean()) < 1.0
            assert (norm > 2.0 * predicted).mean() < 0.05
        assert prior.shape == (20, 5 if offset.endswith("hanging") else 4)
        assert prior.mean() > 5.0
        assert new.mean() < 0.3 * prior.mean()
        # of every robot the mean over its phases is less
        assert (new.mean(axis=1) < prior.mean(axis=1)).all()


@pytest.mark.long
def test_one_draw_is_more_coherent(tmp_path: Path) -> None:
    """The same of one seed."""
    errors = _errors(tmp_path / "out", SEEDS[:1])
    assert len(errors) == 2 * len(OFFSETS)
    for offset in OFFSETS:
        assert np.mean(errors[offset, "in situ"], axis=0)[0] < 0.5 * np.mean(errors[offset, "prior"], axis=0)[0]
