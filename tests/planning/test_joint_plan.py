# SPDX-License-Identifier: BSD-3-Clause
"""Recordings are ordered by what they teach all sensors: as a calibration from them says, and as truth has it."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.calibration.joint.calibrate import calibrate_jointly
from forcetorque.evaluation.load_cases.load_case import operating_load_cases
from forcetorque.evaluation.load_cases.predicted_error import predict
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.joint_calibration_plan import plan_jointly

MOTIONS = ("grid_cold", "grid_warm", "move_cold")
STANCE = ("sway_day1", "stepping_day1", "left_foot_day1")


@pytest.fixture
def motions(days: Path) -> list[Experiment]:
    """Three recordings of the small arm, whose sensor has its offset at 30 degrees whichever of them is the first."""
    return [_with_offset_at(30.0, load_experiment(days / f"{name}.toml")) for name in MOTIONS]


def _with_offset_at(degrees: float, experiment: Experiment) -> Experiment:
    (sensor,) = experiment.sensors
    (variable,) = sensor.variables
    stated = replace(variable, linear=replace(variable.linear, reference_value=degrees))
    return replace(experiment, sensors=(replace(sensor, variables=(stated,)),))


def test_what_is_expected_is_what_a_calibration_from_them_says(motions: list[Experiment]) -> None:
    """The recordings of the last step, calibrated jointly, have the predicted error of the last row."""
    plan = plan_jointly(motions, recordings=2)
    assert [step.step for step in plan.steps] == [1, 2]
    taken = [next(one for one in motions if one.name == step.recording) for step in plan.steps]
    (entry,) = calibrate_jointly(taken, "out", code_version="1", created="2020-01-01").calibrations
    (case,) = operating_load_cases([SensorRun(one, "arm_ft") for one in motions])
    error = predict(entry.calibration, case)
    row = plan.sensors[-1]
    assert (row.step, row.sensor, row.load_case) == (2, "arm_ft", case.name)
    np.testing.assert_allclose(
        [row.force_after_N, row.moment_after_Nm], [error.force.typical, error.moment.typical], rtol=1e-6
    )


@pytest.mark.long
def test_the_first_is_the_best_by_itself(motions: list[Experiment]) -> None:
    """Each recording alone comes to no less than the one that is named first; the steps follow one another."""
    plan = plan_jointly(motions)
    alone = [plan_jointly([one]).steps[0].excess_after for one in motions]
    assert plan.steps[0].excess_after == pytest.approx(min(alone))
    assert max(alone) > 1.02 * min(alone)  # else any would do
    assert len(plan.steps) == len(motions) == 3
    for before, after in zip(plan.steps, plan.steps[1:], strict=False):
        assert after.excess_before == before.excess_after
    assert plan.steps[0].excess_after < 0.5 * plan.steps[0].excess_before


@pytest.mark.long
def test_what_adds_nothing_is_named(motions: list[Experiment]) -> None:
    """The advice names what helps, and what does not."""
    plan = plan_jointly(motions)
    assert plan.advice.startswith(f"record {plan.steps[0].recording}")
    for before, after in ((step.excess_before, step.excess_after) for step in plan.steps[1:]):
        if after > 0.95 * before:
            assert "would add less than 5 %" in plan.advice
            break
    else:
        assert "would add" not in plan.advice


@pytest.mark.long
def test_errors_of_a_humanoid_fall_as_planned(tmp_path: Path) -> None:
    """Stepping before swaying; standing still comes last and adds nothing; one of it teaches nothing."""
    folder = tmp_path / "simulated"
    words = [sys.executable, "-m", "forcetorque", "simulate", "stance", "-o", str(folder)]
    subprocess.run(words, check=True, capture_output=True)
    still = _still(folder)
    experiments = [load_experiment(folder / f"{name}.toml") for name in STANCE] + [load_experiment(still)]
    plan = plan_jointly(experiments, recordings=4)
    order = [step.recording.partition(", ")[2] for step in plan.steps]
    assert order[0] == "stepping_day1"
    assert order[-1] == "still"
    assert "still would add less than 5 %" in plan.advice
    alone = plan_jointly([experiments[-1]])
    assert (
        alone.steps[0].excess_after > 0.7 * alone.steps[0].excess_before
    )  # negative control: it teaches hardly anything


def _still(folder: Path) -> Path:
    """The recording of a robot that stands, offered as one to calibrate with."""
    text = (folder / "standing_day2.toml").read_text(encoding="utf-8")
    text = text.replace('use = "validation"', 'use = "calibration"').replace("stance, standing_day2", "stance, still")
    file = folder / "still.toml"
    file.write_text(text, encoding="utf-8")
    return file
