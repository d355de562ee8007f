# SPDX-License-Identifier: BSD-3-Clause
"""A robot that hangs, stands on both feet and on one is drawn in one world."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import invert_pose, make_pose
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.alignment import seconds_since
from forcetorque.simulation.motions.movement import Movement
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario, simulate
from forcetorque.viewer.posture import posture_at, root_poses, shown_stream
from tests.scenes.switchings import short_switching

LEVEL_M = 1e-7
"""Soles are level to what inverse kinematics leaves, 1e-8 rad."""


@pytest.fixture(scope="module")
def switched(tmp_path_factory: pytest.TempPathFactory) -> tuple[Experiment, Movement]:
    """A recording that nothing disturbs, with what the robot truly did."""
    folder = tmp_path_factory.mktemp("switched") / "out"
    content = short_switching(names=("l_leg_ft",)).exact()
    scenario = build_scenario(content.model_copy(update={"recording": content.recording[:1]}))
    write_scenario(scenario, folder)
    (simulated,) = simulate(scenario)
    return load_experiment(folder / "switching_day1.toml"), simulated.movement


def _poses(experiment: Experiment) -> tuple[FloatArray, FloatArray]:
    """Instants in s, and where the root link is drawn."""
    recording, model = experiment.recording, experiment.model
    posture = posture_at(recording, model, shown_stream(experiment, list(experiment.sensors)))
    values, _ = root_poses(recording, model, posture, recording.intervals, experiment.processing)
    rotation = Rotation.from_quat(values[:, [4, 5, 6, 3]]).as_matrix()
    return seconds_since(posture.stamp_ns, recording.start_ns), make_pose(rotation, values[:, :3])


def test_the_robot_goes_where_it_truly_went(switched: tuple[Experiment, Movement]) -> None:
    """Seen from its first place the root link is drawn where it was; with one support it would not be."""
    experiment, movement = switched
    seconds, drawn = _poses(experiment)
    true = movement.base_pose(seconds, experiment.model.root_link)
    way = invert_pose(drawn[0]) @ drawn
    expected = invert_pose(true[0]) @ true
    # landing has no support: the robot is at rest meanwhile
    np.testing.assert_allclose(way, expected, rtol=0, atol=LEVEL_M)
    hanging = experiment.recording.intervals[0].support
    intervals = tuple(replace(one, support=hanging) for one in experiment.recording.intervals)
    held = replace(experiment, recording=replace(experiment.recording, intervals=intervals))
    _, wrong = _poses(held)
    assert np.abs(invert_pose(wrong[0]) @ wrong - expected).max() > 0.05  # negative control
