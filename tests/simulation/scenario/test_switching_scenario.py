# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios of contact switching: the bundled one, exact readings with an error of a stated size, refusals."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import read_toml
from forcetorque.recording.alignment import seconds_since
from forcetorque.simulation.scenario.scenario import Scenario, build_scenario, simulate, trace_recordings
from forcetorque.simulation.scenario.scenario_file import ScenarioFile, bundled_scenario
from tests.scenes.switchings import short_switching

READ_N = 1e-6
"""What the readings of perfect channels may differ from `(1 + E) w + bias`; biases are up to 1000 N."""


@cache
def exact() -> Scenario:
    """The same without anything that disturbs it."""
    return build_scenario(short_switching().exact())


def test_the_bundled_scenario_has_two_days() -> None:
    """Each with all phases in one recording, continuous readings and an IMU throughout."""
    content = read_toml(bundled_scenario("switching"), ScenarioFile, what="a scenario")
    assert [(entry.session, entry.use.value) for entry in content.recording] == [
        ("day 1", "calibration"),
        ("day 2", "validation"),
    ]
    scenario = build_scenario(short_switching())
    assert scenario.robot_errors is not None
    kinds = ["hanging", "landing", "double_support", "single_support"]
    traces, count = trace_recordings(scenario), 0
    for simulated in simulate(scenario, traces):
        movement = simulated.movement
        assert [phase.kind.value for phase in movement.phases][:4] == kinds
        for name in ("imu", "joints", *scenario.specimens):
            stamps = simulated.recording.stream(name).stamp_ns
            assert np.diff(stamps).max() < 0.06e9, name  # 0.04 s and jitter
            assert stamps[0] - simulated.start_ns < 0.06e9
            assert simulated.start_ns + movement.duration_s * 1e9 - stamps[-1] < 0.1e9
            count += 1
    assert count == 2 * 8


@pytest.mark.long
def test_perfect_channels_read_true_wrenches_with_error_and_bias() -> None:
    """Without noise the workbench matrix reads `(1 + E) w + bias`; with noise it does not."""
    scenario = exact()
    seen = 0
    for simulated in simulate(scenario):
        for name, sensor in simulated.sensors.items():
            workbench = scenario.specimens[name].workbench
            stream = simulated.recording.stream(name)
            true = simulated.movement.readings(seconds_since(stream.stamp_ns, simulated.start_ns), [name])
            error, bias = sensor.matrix_error(workbench), sensor.bias(workbench)
            read = stream.signal("raw").values @ workbench.T
            np.testing.assert_allclose(read, true.of_name(name) @ (np.eye(6) + error).T + bias, rtol=0, atol=READ_N)
            assert not stream.held.any()
            seen += 1
    assert seen == 2 * 6
    # negative control: of the same sensors with noise and steps
    noisy = next(simulate(scenario.with_sensors(noise_counts=3.0, step_counts=1.0)))
    raw = noisy.recording.stream("l_leg_ft").signal("raw").values
    assert (raw == np.rint(raw)).all()
    workbench = scenario.specimens["l_leg_ft"].workbench
    first = noisy.movement.readings([0.0], ["l_leg_ft"]).of_name("l_leg_ft")[0]
    sensor = noisy.sensors["l_leg_ft"]
    expected = (np.eye(6) + sensor.matrix_error(workbench)) @ first + sensor.bias(workbench)
    assert np.abs(raw[0] @ workbench.T - expected).max() > 0.01


def test_exact_recordings_hold_derivatives_and_the_imu_turns_with_its_link() -> None:
    """Joints as they are, at the stamps of the sensors; the IMU in the torso reads gravity alone while it hangs."""
    simulated = next(simulate(exact()))
    recording, movement = simulated.recording, simulated.movement
    joints, imu = recording.stream("joints"), recording.stream("imu")
    motion = movement.joints(seconds_since(joints.stamp_ns, simulated.start_ns))
    for quantity in ("position", "velocity", "acceleration"):
        np.testing.assert_array_equal(joints.signal(quantity).values, getattr(motion, quantity))
    for name in ("imu", "l_leg_ft"):
        np.testing.assert_array_equal(recording.stream(name).stamp_ns, joints.stamp_ns)
    hanging, single = movement.phases[0], movement.phases[3]
    seconds = seconds_since(imu.stamp_ns, simulated.start_ns)
    hung = (seconds > hanging.start_s) & (seconds < hanging.end_s)
    assert np.ptp(imu.signal("proper_acceleration").values[hung], axis=0).max() < 1e-12
    assert np.linalg.norm(imu.signal("proper_acceleration").values[0]) == pytest.approx(9.80665, abs=1e-12)
    alone = (seconds > single.start_s) & (seconds < single.end_s)
    assert np.abs(imu.signal("angular_acceleration").values[alone]).max() > 0.1


def test_the_error_of_the_matrix_has_its_stated_size() -> None:
    """For each sensor and seed the root mean square is the share; scaled shares scale one error; 0 is none."""
    scenario = exact()
    sizes = np.repeat([1.0, 0.07], 3)
    seen = 0
    for seed in (1, 2, 3):
        errors = {}
        for share in (0.0, 0.05, 0.1):
            changed = scenario.with_sensors(seed=seed, matrix_error={"share": share})
            for name, specimen in changed.specimens.items():
                error = specimen.sensor.matrix_error(specimen.workbench) / sizes[:, None] * sizes
                assert np.sqrt((error**2).mean()) == pytest.approx(share, abs=1e-12)
                errors[share, name] = error
        for name in scenario.specimens:
            np.testing.assert_allclose(errors[0.1, name], 2.0 * errors[0.05, name], rtol=0, atol=1e-12)
            seen += 1
    assert seen == 3 * 6


@pytest.mark.parametrize(
    ("sensors", "match"),
    [
        ({"matrix_error": {"share": 0.05}, "mounting_sd": 0.06}, "matrix_error stands for all that mounting does"),
        ({"matrix_error": {"share": -0.1}}, "greater than or equal to 0"),
        ({"matrix_error": {"share": 0.1, "lever_m": 0.0}}, "greater than 0"),
        ({"step_counts": -1.0}, "greater than or equal to 0"),
    ],
)
def test_sensors_that_make_no_sense_are_refused(sensors: dict[str, Any], match: str) -> None:
    """Two sources of one error, negative sizes, no lever."""
    content = short_switching().model_dump(by_alias=True)
    content["sensors"] = sensors
    with pytest.raises(ValueError, match=match):
        ScenarioFile.model_validate(content)


def test_what_the_motion_lacks_is_named() -> None:
    """An IMU, without which nobody could tell what double support is; an error that no mounting makes."""
    content = short_switching().model_dump(by_alias=True)
    with pytest.raises(ValueError, match="no foot stands all the time in a contact_switching motion; it needs"):
        ScenarioFile.model_validate({**content, "imu": None})
    with pytest.raises(FormatError, match=r"matrix_error: .* a share of 0.9, with which a load would be read with the"):
        exact().with_sensors(seed=1, matrix_error={"share": 0.9})
