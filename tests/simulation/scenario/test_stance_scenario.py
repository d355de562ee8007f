# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios on two feet: the bundled one, feet that are replaced, robots that differ from their URDF, and refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.base.toml_file import read_toml
from forcetorque.simulation.scenario.scenario import Scenario, build_scenario, simulate, trace_recordings
from forcetorque.simulation.scenario.scenario_file import ScenarioFile, bundled_scenario


def _content(*motions: dict[str, Any], **changes: Any) -> dict[str, Any]:
    recordings = [
        {"name": f"r{index}", "support": "l_sole", "motion": {"swing": "r_sole", "duration_s": 3.0, **motion}}
        for index, motion in enumerate(motions)
    ]
    return {
        "schema": "forcetorque/scenario/1",
        "name": "two feet",
        "seed": 7,
        "robot": {"model": ["biped"]},
        "imu": {"link": ["chest", "imu"], "accelerometer_bias": 0.05},
        "recording": recordings,
        **changes,
    }


def _built(*motions: dict[str, Any], **changes: Any) -> Scenario:
    return build_scenario(ScenarioFile.model_validate(_content(*motions, **changes)))


def test_the_bundled_scenario_has_two_days() -> None:
    """Feet are in one place on a day and in another on the next, and every kind of movement is there."""
    content = read_toml(bundled_scenario("stance"), ScenarioFile, what="a scenario")
    kinds = {entry.motion.kind.value for entry in content.recording}
    assert kinds == {"sway", "stepping", "squat", "standing", "balancing"}
    days = {entry.session: set[int]() for entry in content.recording}
    for entry in content.recording:
        if entry.motion.kind.value != "balancing":
            days[entry.session].add(entry.motion.placement)
    assert days == {"day 1": {1}, "day 2": {2}}
    by_kind = {entry.motion.kind.value: entry for entry in content.recording if entry.motion.placement > 0}
    short = tuple(
        entry.model_copy(update={"motion": entry.motion.model_copy(update={"duration_s": 2.0})})
        for entry in by_kind.values()
    )
    scenario = build_scenario(content.model_copy(update={"recording": short}))
    assert scenario.robot_errors is not None
    assert scenario.imu is not None
    assert scenario.imu.link in {"chest", "imu"}
    traces = trace_recordings(scenario)
    recordings = list(simulate(scenario, traces))
    assert len(recordings) == 4
    for simulated in recordings:
        assert simulated.movement.touched == ("l_sole", "r_sole")
        assert {"joints", "imu", *simulated.sensors} == set(simulated.recording.streams)


def test_feet_are_replaced_with_the_number_of_their_place() -> None:
    """Recordings of one number share it, of another do not; 0 has the feet below the hips."""
    first, again, other, below = (
        plan.movement.base_pose([0.0], "r_sole")[0]
        for plan in _built(
            {"kind": "sway", "placement": 1},
            {"kind": "standing", "placement": 1},
            {"kind": "sway", "placement": 2},
            {"kind": "standing"},
        ).plans
    )
    np.testing.assert_allclose(first, again, rtol=0, atol=1e-8)
    assert np.abs(first - other).max() > 1e-3
    np.testing.assert_allclose(below[:3, 3], [0.0, -0.15, 0.0], rtol=0, atol=1e-8)


def test_errors_of_the_robot_have_their_own_seed() -> None:
    """The robot differs from its model as the seed says, while the sensors and the placement stay."""
    sizes = {"mass": 0.02, "centre_m": 0.002, "joint_zero_deg": 0.5}
    plain = _built({"kind": "sway"})
    drawn, other = (_built({"kind": "sway"}, robot_errors={**sizes, "seed": seed}) for seed in (1, 2))
    assert plain.robot_errors is None
    assert drawn.robot_errors is not None
    assert other.robot_errors is not None
    assert drawn.robot_errors.mass != other.robot_errors.mass
    assert 0.1 < np.rad2deg(np.std(list(drawn.robot_errors.joint_zero_rad.values()))) < 1.0
    for name, specimen in plain.specimens.items():
        np.testing.assert_array_equal(specimen.sensor.matrix, drawn.specimens[name].sensor.matrix)


def test_the_bias_of_an_imu_holds_in_all_recordings() -> None:
    """Recordings of a robot that stands differ in noise only."""
    scenario = _built({"kind": "standing", "internal_force_N": 0.0}, {"kind": "standing"})
    assert scenario.imu is not None
    first, second = (
        simulated.recording.stream("imu").signal("proper_acceleration").values.mean(axis=0)
        for simulated in simulate(scenario)
    )
    np.testing.assert_allclose(first, second, rtol=0, atol=1e-6)
    # the frame of the biped's IMU is turned about the vertical
    np.testing.assert_allclose(first - [0, 0, 9.80665], scenario.imu.accelerometer_bias, rtol=0, atol=1e-6)
    assert np.abs(scenario.imu.accelerometer_bias).max() > 0.005


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"imu": None}, "recording 'r0': no foot stands all the time in a stepping motion; it needs"),
        ({"network": {}}, "no port of a .network. carries an .imu. yet"),
        ({"imu": {"link": ["head"], "noise": 1.0}}, "unknown key 'noise'"),
        ({"robot_errors": {"mass": -1.0}}, "greater than or equal to 0"),
    ],
)
def test_files_that_make_no_sense_are_refused(changes: dict[str, Any], match: str) -> None:
    """Steps without an IMU, an IMU on a network without ports for it, unknown keys and negative sizes."""
    with pytest.raises(ValueError, match=match):
        ScenarioFile.model_validate(_content({"kind": "stepping"}, **changes))


def test_motions_need_their_keys() -> None:
    """The other foot, and how long it takes; and a robot needs the IMU's link."""
    for kind, key in (("sway", "swing"), ("squat", "duration_s")):
        with pytest.raises(ValueError, match=f"a {kind} motion needs {key}"):
            ScenarioFile.model_validate(_content({"kind": kind, key: None}))
    with pytest.raises(RobotError, match="imu: robot 'biped' has none of the links chest, head"):
        _built({"kind": "sway"}, imu={"link": ["chest", "head"]})
