# SPDX-License-Identifier: BSD-3-Clause
"""Loads that stand for a use: their sizes, levers and senses by closed forms."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.evaluation.load_cases.load_case import (
    LOADS,
    LoadCase,
    beyond_range,
    full_scale_loads,
    operating_load_cases,
    pushes_around_sensor,
    pushes_at,
    weights,
)
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.scenes.experiments import PARQUET, add

FORCE_N, RADIUS_M = 20.0, 0.3
STATISTICAL = 2.0 / np.sqrt(LOADS)
"""Relative: root mean squares of so many loads, whose squares differ by less than their mean, four standard errors."""
EXACT = 1e-12
"""Relative: rounding of a few products."""


def _root_mean_square(vectors: np.ndarray) -> float:
    return float(np.sqrt((vectors**2).sum(axis=1).mean()))


def _lever(wrench: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Moments about a point; shape (n, 3)."""
    return wrench[:, 3:] - np.cross(point, wrench[:, :3])


def test_pushes_around_a_sensor_act_anywhere_within_the_radius() -> None:
    """Distances are uniform, so that of the square of the radius a third is left, and two thirds of that turn."""
    wrench = pushes_around_sensor(FORCE_N, RADIUS_M)
    assert wrench.shape == (LOADS, 6)
    np.testing.assert_allclose(np.linalg.norm(wrench[:, :3], axis=1), FORCE_N, rtol=EXACT)
    np.testing.assert_allclose(np.sqrt((wrench[:, :3] ** 2).mean(axis=0)), FORCE_N / np.sqrt(3.0), rtol=STATISTICAL)
    np.testing.assert_allclose((wrench[:, :3] * wrench[:, 3:]).sum(axis=1), 0.0, atol=1e-9)
    moment = FORCE_N * RADIUS_M * np.sqrt(2.0 / 9.0)
    assert _root_mean_square(wrench[:, 3:]) == pytest.approx(moment, rel=STATISTICAL)
    assert np.linalg.norm(wrench[:, 3:], axis=1).max() <= FORCE_N * RADIUS_M


def test_pushes_at_points_act_anywhere_in_a_ball() -> None:
    """All points take turns; in a ball three fifths of the square of its radius are left, and two thirds turn."""
    points = np.array([[0.1, 0.0, -0.2], [0.0, 0.5, 0.0]])
    along = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    for direction in (None, along):
        wrench = pushes_at(points, FORCE_N, RADIUS_M, direction=direction)
        np.testing.assert_allclose(np.linalg.norm(wrench[:, :3], axis=1), FORCE_N, rtol=EXACT)
        about = np.concatenate([_lever(wrench[k::2], point) for k, point in enumerate(points)])
        assert _root_mean_square(about) == pytest.approx(FORCE_N * RADIUS_M * np.sqrt(0.4), rel=STATISTICAL)
        assert np.linalg.norm(about, axis=1).max() <= FORCE_N * RADIUS_M
    for k in range(2):
        np.testing.assert_allclose(wrench[k::2, :3], np.tile(FORCE_N * along[k], (LOADS // 2, 1)), rtol=EXACT)


def test_a_tool_weighs_at_its_centre_of_mass_in_every_orientation() -> None:
    """Mass times gravity, in any direction of the sensor, with the moment of the centre of mass."""
    centre = np.array([0.02, -0.05, 0.1])
    wrench = weights(1.5, centre[None], 9.81)
    np.testing.assert_allclose(np.linalg.norm(wrench[:, :3], axis=1), 1.5 * 9.81, rtol=EXACT)
    np.testing.assert_allclose(_lever(wrench, centre), 0.0, atol=1e-12)
    assert np.abs(wrench[:, :3].mean(axis=0)).max() < 4.0 / np.sqrt(3.0 * LOADS) * 1.5 * 9.81


def test_loads_of_full_scale_are_uniform_up_to_the_share() -> None:
    """Root mean square is the limit over the root of three in every component, in both senses."""
    scale = np.array([300.0, 200.0, 500.0, 10.0, 20.0, 5.0])
    loads = full_scale_loads(scale, 0.2)
    np.testing.assert_allclose(np.sqrt((loads**2).mean(axis=0)), 0.2 * scale / np.sqrt(3.0), rtol=STATISTICAL)
    for limit in (loads.max(axis=0), -loads.min(axis=0)):
        assert ((0.97 * 0.2 * scale < limit) & (limit <= 0.2 * scale)).all()
    np.testing.assert_allclose(full_scale_loads(scale, 1.0), 5.0 * loads, rtol=EXACT)
    for share in (0.0, -0.1, 1.01):
        with pytest.raises(SensorError, match="expected one above 0 and at most 1"):
            full_scale_loads(scale, share)


def test_by_default_a_twentieth_of_the_loads_is_allowed() -> None:
    """Of the root mean squares of 5 and 13 N, and of 3 and 5 N m; what no load has is not judged; one stated is all."""
    wrench = [[3.0, 4.0, 0.0, 0.0, 0.0, 3.0], [12.0, 0.0, 5.0, 4.0, 3.0, 0.0]]
    case = LoadCase(name="a", words="", wrench=wrench)
    assert (case.force_N, case.moment_Nm) == pytest.approx((np.sqrt(97.0), np.sqrt(17.0)))
    assert case.requirement == pytest.approx((0.05 * np.sqrt(97.0), 0.05 * np.sqrt(17.0)))
    # 1e-10 m of lever is rounding, a millionth of a metre is not
    for lever, allowed in ((1e-10, np.inf), (1e-6, 0.05e-6 * 5.0)):
        pushed = LoadCase(name="a", words="", wrench=[[3.0, 4.0, 0.0, 0.0, 0.0, 5.0 * lever]])
        assert pushed.requirement == pytest.approx((0.25, allowed))
    twist = LoadCase(name="a", words="", wrench=[[0.0, 0.0, 0.0, 0.0, 0.0, 2.0]])
    assert twist.requirement == pytest.approx((np.inf, 0.1))
    assert LoadCase(name="a", words="", wrench=wrench, allowed_force_N=0.7).requirement == (0.7, np.inf)
    assert LoadCase(name="a", words="", wrench=wrench, allowed_moment_Nm=0.7).requirement == (np.inf, 0.7)


def test_a_full_scale_of_the_sensor_limits_its_loads(intact: Path) -> None:
    """By hand: the component that goes farthest beyond its own full scale is named, with its unit."""
    sensor = replace(
        load_experiment(intact / PARQUET).sensors[0], full_scale=np.array([100.0, 100.0, 200.0, 10.0, 10.0, 5.0])
    )
    loads = np.zeros((3, 6))
    loads[1], loads[2] = [-100.0, 50.0, 0.0, 0.0, 10.0, 0.0], [0.0, 0.0, 200.0, 0.0, 0.0, -5.0]
    assert beyond_range(LoadCase(name="a", words="", wrench=loads), sensor, None) is None
    for place, load, text in (
        (2, 210.0, "reaches 210 N in fz, the full scale of 'arm_ft' is 200"),
        (3, -12.0, "reaches 12 N m in tx, the full scale of 'arm_ft' is 10"),
    ):
        loads[0, place] = load
        assert beyond_range(LoadCase(name="a", words="", wrench=loads), sensor, None) == text


def test_channels_limit_loads_where_no_full_scale_is_stated(intact: Path) -> None:
    """Counts by the prior, or by the matrix that is given, of which one channel reaches its limit."""
    sensor = load_experiment(intact / PARQUET).sensors[0]
    assert sensor.prior is not None
    limit = sensor.limit_counts
    counts = np.array([[0.2, -0.999, 0.0, 0.5, 0.0, 0.0], [0.1, 0.3, 0.4, 0.0, 0.0, 0.999]]) * limit
    case = LoadCase(name="a", words="", wrench=counts @ sensor.prior.T)
    assert beyond_range(case, sensor, None) is None
    assert beyond_range(case, sensor, 2.0 * sensor.prior) is None
    expected = f"reaches {1.1 * 0.999 * limit:.0f} counts in a channel of 'arm_ft', which reads up to {limit:.0f}"
    assert beyond_range(case, sensor, sensor.prior / 1.1) == expected
    # of a sensor without a matrix nothing is known
    assert beyond_range(replace(case, wrench=1e9 * case.wrench), replace(sensor, prior=None), None) is None


def test_a_share_of_full_scale_is_of_what_channels_read_where_none_is_stated(arm: Path) -> None:
    """Uniform up to a twentieth of counts times the norm of each row of the prior, or of the stated full scale."""
    file = add(arm / PARQUET, '\n[[load_case]]\nname = "a"\nfull_scale_share = 0.05\n')
    run = SensorRun(load_experiment(file), "arm_ft")
    assert run.sensor.prior is not None
    stated = np.array([10.0, 20.0, 30.0, 1.0, 2.0, 3.0])
    by_rows = run.sensor.limit_counts * np.linalg.norm(run.sensor.prior, axis=1)
    for sensor, scale in ((run.sensor, by_rows), (replace(run.sensor, full_scale=stated), stated)):
        experiment = replace(run.experiment, sensors=(sensor,))
        (case,) = operating_load_cases([SensorRun(experiment, "arm_ft")])
        np.testing.assert_allclose(
            np.sqrt((case.wrench**2).mean(axis=0)), 0.05 * scale / np.sqrt(3.0), rtol=STATISTICAL
        )
        assert case.words == "up to 5 % of full scale in all components at once"


@pytest.mark.parametrize("share", [1.37, 4.9, 23.0])
def test_pushes_that_the_sensor_can_read_are_the_strongest_of_two_digits(intact: Path, share: float) -> None:
    """Where the default ones are beyond its full scale: two digits that are at most a tenth below what it can read."""
    run = SensorRun(load_experiment(intact / PARQUET), "arm_ft")
    (usual,) = operating_load_cases([run])
    sensor = replace(run.sensor, full_scale=np.abs(usual.wrench).max(axis=0) / share)
    (case,) = operating_load_cases([SensorRun(replace(run.experiment, sensors=(sensor,)), "arm_ft")])
    (table,) = tomllib.loads(case.readable)["load_case"]
    assert (table["name"], table["radius_m"]) == ("push", 0.3)
    force, largest = table["force_N"], usual.force_N / share
    assert force == float(f"{force:.1e}")
    assert force <= largest < 1.1 * force
