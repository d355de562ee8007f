# SPDX-License-Identifier: BSD-3-Clause
"""From a simulated robot to an experiment on disk: an IMU in the chest as the source of gravity and acceleration."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Use
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.recording.stream import Signal
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import Scenario, build_scenario
from forcetorque.simulation.scenario.scenario_file import ScenarioFile
from tests.scenes.experiments import edit

LIMITS_N = {"l_foot_ft": (1e-3, 0.1, 0.02), "l_leg_ft": (4e-3, 0.4, 0.1)}
"""RMS errors of forces. With exact derivatives in the log, lines between samples 10 ms apart err by 0.0003 and 0.002 N.
With positions alone, a window of 0.3 s cannot follow a foot that is in the air for 1 s only: 0.05 and 0.25 N. One of
0.1 s leaves 0.01 and 0.05 N."""
BALANCED_N = 0.1
"""A window of 0.3 s on a robot that moves slowly on one foot."""
AT_REST = "gravity_direction = [-0.0, -0.0, -1.0]"
AIR_S = ((4.52, 5.48), (8.52, 9.48))
"""When the left foot is in the air."""

CONTENT = {
    "schema": "forcetorque/scenario/1",
    "name": "two feet",
    "seed": 5,
    "robot": {"model": ["biped"]},
    "imu": {"link": ["chest", "imu"]},
    "sensors": {"noise_counts": 0.0, "names": ["l_leg_ft", "l_foot_ft"]},
    "recording": [
        {
            "name": "stepping",
            "motion": {"kind": "stepping", "swing": "r_sole", "duration_s": 12.0},
            "support": "l_sole",
        },
        {
            "name": "right_foot",
            "motion": {"kind": "balancing", "swing": "l_sole", "postures": 2},
            "support": "r_sole",
        },
    ],
}


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    """A robot without faults and its IMU, stepping, and on its right foot."""
    return build_scenario(ScenarioFile.model_validate(CONTENT))


@pytest.fixture(scope="module")
def folder(scenario: Scenario, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Its recordings."""
    path = tmp_path_factory.mktemp("simulated") / "out"
    write_scenario(scenario, path)
    return path


def _errors(
    scenario: Scenario,
    experiment: Experiment,
    recording: Recording,
    sensor: str,
    *,
    processing: Processing,
    spans_s: tuple[tuple[float, float], ...] = AIR_S,
) -> tuple[FloatArray, FloatArray]:
    """Expected less true wrenches in spans of time in which the right foot alone touches, and the true ones."""
    plan = next(plan for plan in scenario.plans if plan.name in experiment.name)
    expected, true = [], []
    for start_s, end_s in spans_s:
        samples = sensor_samples(
            recording,
            experiment.model,
            sensor=sensor,
            stream=sensor,
            quantity="raw",
            interval=Interval(
                label="air",
                start_ns=plan.start_ns + round(start_s * 1e9),
                end_ns=plan.start_ns + round(end_s * 1e9),
                use=Use.CALIBRATION,
                support=MovingSupport(frame="r_sole", motion_streams=("imu",)),
            ),
            processing=processing,
        )
        assert len(samples.reference) > 80
        expected.append(samples.reference)
        true.append(plan.movement.readings(seconds_since(samples.stamp_ns, plan.start_ns), [sensor]).of_name(sensor))
    loads = np.concatenate(true)
    return np.concatenate(expected) - loads, loads


def _rms(values: FloatArray) -> float:
    """Of the forces."""
    return float(np.sqrt((values[:, :3] ** 2).mean()))


def _exact(scenario: Scenario, recording: Recording) -> Recording:
    """The recording of stepping with all derivatives, as some robots log them."""
    plan = scenario.plans[0]
    joints, imu = recording.stream("joints"), recording.stream("imu")
    motion = plan.movement.joints(seconds_since(joints.stamp_ns, plan.start_ns))
    logged = {
        quantity: Signal(quantity=quantity, values=values, columns=motion.names, units=(unit,) * len(motion.names))
        for quantity, values, unit in (
            ("position", motion.position, "rad"),
            ("velocity", motion.velocity, "rad/s"),
            ("acceleration", motion.acceleration, "rad/s2"),
        )
    }
    turning = plan.movement.link_motion(seconds_since(imu.stamp_ns, plan.start_ns), "imu").angular_acceleration
    rate = replace(
        imu.signal("angular_velocity"), quantity="angular_acceleration", values=turning, units=("rad/s2",) * 3
    )
    streams = {
        **recording.streams,
        "joints": replace(joints, signals=logged),
        "imu": replace(imu, signals={**imu.signals, "angular_acceleration": rate}),
    }
    return replace(recording, streams=streams)


@pytest.mark.parametrize("sensor", ["l_foot_ft", "l_leg_ft"])
def test_the_imu_tells_the_loads_of_a_foot_in_the_air(scenario: Scenario, folder: Path, sensor: str) -> None:
    """With exact derivatives only interpolation is left; windows that differentiate positions leave what they blur."""
    experiment = load_experiment(folder / "stepping.toml")
    exact, loads = _errors(
        scenario,
        experiment,
        _exact(scenario, experiment.recording),
        sensor,
        processing=Processing(logged_derivatives=True),
    )
    changing = _rms(loads - loads.mean(axis=0))
    interpolated, derived, short = LIMITS_N[sensor]
    assert _rms(exact) < interpolated < 0.01 * changing
    shorter = Processing(derivative_window=SavitzkyGolay(window_s=0.1, order=3))
    for processing, limit in ((experiment.processing, derived), (shorter, short)):
        errors, _ = _errors(scenario, experiment, experiment.recording, sensor, processing=processing)
        assert _rms(errors) < limit < 0.6 * changing


def test_an_imu_on_a_wrong_link_does_not(scenario: Scenario, folder: Path) -> None:
    """Negative control: said to be in an arm, it has gravity from another side."""
    experiment = load_experiment(folder / "stepping.toml")
    imu = experiment.recording.stream("imu")
    wrong = replace(imu, signals={name: replace(signal, frame="l_forearm") for name, signal in imu.signals.items()})
    recording = replace(experiment.recording, streams={**experiment.recording.streams, "imu": wrong})
    off, _ = _errors(scenario, experiment, recording, "l_foot_ft", processing=experiment.processing)
    right, _ = _errors(scenario, experiment, experiment.recording, "l_foot_ft", processing=experiment.processing)
    assert _rms(off) > 1.0 > 10.0 * _rms(right)


def test_a_file_with_the_imu_says_what_one_with_gravity_says(scenario: Scenario, folder: Path) -> None:
    """On one foot the IMU and the resting sole demand the same of the other leg."""
    text = (folder / "right_foot.toml").read_text(encoding="utf-8")
    (folder / "with_imu.toml").write_text(text, encoding="utf-8")
    moving = load_experiment(edit(folder / "with_imu.toml", AT_REST, 'imu = ["imu"]'))
    (interval,) = moving.recording.intervals
    assert isinstance(interval.support, MovingSupport)
    errors, loads = _errors(
        scenario, moving, moving.recording, "l_leg_ft", processing=moving.processing, spans_s=((1.0, 8.0),)
    )
    assert _rms(errors) < BALANCED_N
    assert np.ptp(loads[:, :3], axis=0).max() > 5.0


def test_files_say_what_touches(folder: Path, scenario: Scenario) -> None:
    """Stepping has its first foot as the support that the IMU carries, the other as a contact; the truth has both."""
    experiment = load_experiment(folder / "stepping.toml")
    (interval,) = experiment.recording.intervals
    assert isinstance(interval.support, MovingSupport)
    assert interval.support.frame == "l_sole"
    assert interval.support.motion_streams == ("imu",)
    assert [entry.contact.link for entry in experiment.contacts] == ["r_sole"]
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    assert truth["recordings"]["stepping"]["touches"] == ["l_sole", "r_sole"]
    assert truth["recordings"]["stepping"]["support"] is None
    assert truth["recordings"]["right_foot"]["support"] == "r_sole"
    assert truth["imu"]["link"] == "imu"
    assert "robot_errors" not in truth
    assert scenario.imu is not None
