# SPDX-License-Identifier: BSD-3-Clause
"""A calibration from a tool that the sensor itself weighed."""

from __future__ import annotations

import runpy
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from forcetorque.base.errors import FitError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.generative.generative_calibration import generative_calibration
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.experiment.calibration.stored_moments import RecordingMoments, read_moments
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.loads_on_robot_links import link_loads
from tests.scenes.robots import example_robot

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "27_arm_and_tools.py"
UR5 = "ur_description/urdf/ur5_robot.urdf"


@pytest.mark.long
def test_a_calibration_does_not_take_an_estimated_tool_for_known(arm: tuple[Path, np.ndarray], tmp_path: Path) -> None:
    """The predicted error of a push where the tool's centre of mass is has the share by which its mass is open.

    A stated tool adds nothing.
    """
    example = SimpleNamespace(**runpy.run_path(str(EXAMPLE)))
    tool = {"gripper": (1.3, [0.01, 0.02, 0.06])}
    example.simulate(tmp_path, example_robot(UR5), seed=6, tools=tool, duration_s=10.0)
    file = tmp_path / "gripper.toml"
    experiment = load_experiment(file)
    (estimated,) = recording_moments(SensorRun(experiment, "wrist_ft"))
    loads = link_loads(experiment)
    assert loads is not None
    (load,) = loads.solution(experiment).loads
    text = file.read_text(encoding="utf-8")
    said = 'link = "ee_link"\nmass_kg = 1.3\ncentre_of_mass_m = [0.01, 0.02, 0.06]\n'
    file.write_text(text.replace('link = "ee_link"\n', said), encoding="utf-8")
    (stated,) = recording_moments(SensorRun(load_experiment(file), "wrist_ft"))
    force = np.array([10.0, 0.0, 0.0])
    push = np.concatenate([force, np.cross(load.centre_of_mass, force)])

    def variance(moments: RecordingMoments) -> float:
        posterior = generative_calibration([moments], code_version="test", created="now").posterior
        assert posterior is not None
        return float(posterior.error_covariance(push)[0, 0])

    assert stated.load_error is None
    assert estimated.load_error is not None
    exact = estimated.model_copy(update={"load_error": None})
    share = np.sqrt(load.covariance[0, 0]) / load.mass
    added = np.sqrt(variance(estimated) - variance(exact))
    assert added == pytest.approx(10.0 * share, rel=0.2)
    estimated.save(tmp_path / "moments.json")
    kept = read_moments(tmp_path / "moments.json").load_error
    assert kept is not None
    np.testing.assert_array_equal(kept.factor, estimated.load_error.factor)


@pytest.mark.long
def test_a_tool_weighed_with_joints_in_a_wrong_unit_is_refused(tmp_path: Path) -> None:
    """Radians that are stated as degrees hardly move the arm: the tool becomes so heavy that it still fits."""
    example = SimpleNamespace(**runpy.run_path(str(EXAMPLE)))
    tool = {"gripper": (1.3, [0.01, 0.02, 0.06])}
    example.simulate(tmp_path, example_robot(UR5), seed=7, tools=tool, duration_s=10.0)
    file = tmp_path / "gripper.toml"
    calibrate_sensor(SensorRun(load_experiment(file), "wrist_ft"), code_version="1", created="now")
    file.write_text(file.read_text(encoding="utf-8").replace('"rad"', '"deg"'), encoding="utf-8")
    run = SensorRun(load_experiment(file), "wrist_ft")
    with pytest.raises(FitError, match=r"full scale is .* the load estimated with joints in another unit"):
        calibrate_sensor(run, code_version="1", created="now")


TOOLS = ("gripper", "weight")
SPECIMENS = 16


@pytest.mark.long
def test_predicted_errors_of_pushes_are_wide_enough(tmp_path: Path) -> None:
    """Intervals of 95 % hold 94 ± 2 % of the errors of 10 N pushes under two unknown tools, 80 % with these for exact.

    Under the same tools, weighed, they hold 93 %: sizes of deviations are taken as they are found. Of sixteen sensors,
    motions and noises; components of pushes in random directions, at random points within 0.3 m. By chance a sound
    one is below the limit once in a hundred, and one that takes the tools as exact is hardly ever above it.
    """
    example = SimpleNamespace(**runpy.run_path(str(EXAMPLE)))
    rng = np.random.default_rng(0)
    force, point = (values / np.linalg.norm(values, axis=1)[:, None] for values in rng.normal(size=(2, 200, 3)))
    pushes = np.hstack([10.0 * force, np.cross(0.3 * rng.random((200, 1)) * point, 10.0 * force)])
    held: dict[str, list[float]] = {"open": [], "exact": []}
    for seed in range(SPECIMENS):
        truth = example.simulate(tmp_path / str(seed), example_robot(UR5), seed=2000 + seed)
        runs = [SensorRun(load_experiment(tmp_path / str(seed) / f"{tool}.toml"), "wrist_ft") for tool in TOOLS]
        moments = recording_moments(runs)
        for name, own in (
            ("open", moments),
            ("exact", [one.model_copy(update={"load_error": None}) for one in moments]),
        ):
            calibration = generative_calibration(own, code_version="test", created="now")
            assert calibration.posterior is not None
            error = pushes @ (calibration.matrix @ np.linalg.inv(truth) - np.eye(6)).T
            deviation = np.sqrt(np.einsum("kii->ki", calibration.posterior.error_covariance(pushes)))
            held[name].append(float((np.abs(error) < 1.96 * deviation).mean()))
    assert np.mean(held["open"]) > 0.85
    assert np.mean(held["exact"]) < np.mean(held["open"]) - 0.1
