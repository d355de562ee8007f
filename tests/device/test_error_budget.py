# SPDX-License-Identifier: BSD-3-Clause
"""Errors of references: by hand, by first order, by drawing, and as Table 6.3 of the thesis has them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.device.components import AttachedLoad, device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.error_budget import (
    DATA_SHEETS,
    THESIS_GRADES,
    ErrorBudget,
    Grade,
    LoadErrors,
    drawn_errors,
    graded_errors,
)
from forcetorque.device.expected_wrench import (
    BRACKET_LENGTH,
    COMPLIANCE,
    ENCODERS,
    IMU,
    LOAD_LENGTH,
    MASS,
    QUANTITIES,
    ExpectedWrench,
    device_response,
)
from forcetorque.device.motion import twelve_steps
from forcetorque.device.tolerances import Tolerance

THREE = read_device().with_sensors(3)
ONE = THREE.with_sensors(1)
LOAD = device_load(THREE, 35.0)
WEIGHT = 35.0 * THREE.gravity
BEYOND = 0.02
"""Share by which the innermost sensor holds more than the load: three interfaces, two sensors, the bracket; 0.68 kg."""

DRAWS = 50
DRAWN = 5.0
"""Monte Carlo errors by which a root mean square of draws may differ from first order, the worst of six components."""


def _expected(sensor: str = "ft_1", spacing_deg: float = 30.0) -> ExpectedWrench:
    poses = twelve_steps(THREE).still_poses(THREE, LOAD, spacing_deg=spacing_deg)
    return ExpectedWrench(device=THREE, load=LOAD, poses=poses, sensor=sensor)


@cache
def _graded(sensors: int) -> dict[Grade, LoadErrors]:
    device = THREE.with_sensors(sensors)
    grades = (*THESIS_GRADES, *DATA_SHEETS)
    return graded_errors(device, "ft_1", twelve_steps(device), grades)


def _encoders(full_width: float, sensors: int = 1) -> LoadErrors:
    return _graded(sensors)[Grade(by_imu=False, full_width=full_width)]


def _imu(full_width: float, sensors: int = 1) -> LoadErrors:
    return _graded(sensors)[Grade(by_imu=True, full_width=full_width)]


def test_errors_of_data_sheets_are_those_of_their_steps() -> None:
    """8 of the 2^14 steps of both ranges of the BNO055, to three digits, and 0.5 deg each way of the AS5045."""
    steps = [8.0 * 2.0 * reach * STANDARD_GRAVITY / 2**14 for reach in (2.0, 4.0)]
    assert [grade.full_width for grade in DATA_SHEETS if grade.by_imu] == pytest.approx(steps, rel=3e-3)
    assert max(grade.full_width for grade in DATA_SHEETS if not grade.by_imu) == 2.0 * 0.5


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_the_first_order_of_each_quantity_is_that_of_the_whole_wrench(quantity: str) -> None:
    """A small error of one quantity changes the expected wrench by its derivative."""
    expected = _expected()
    small = {COMPLIANCE: 1e-8, MASS: 1e-4}.get(quantity, 1e-5)
    change = expected.wrench({quantity: small}) - expected.wrench()
    assert np.abs(change).max() > 1e-6
    np.testing.assert_allclose(change, small * expected.derivative(quantity), atol=2e-5 * np.abs(change).max())


def test_slopes_are_those_by_hand() -> None:
    """Straight and level: pitch turns the weight into z, an IMU adds mass times its error, lengths are levers."""
    expected = _expected()
    row = int(np.argmin(np.abs(expected.poses.position).sum(axis=1)))
    assert np.allclose(expected.poses.position[row], 0.0)
    wrench = expected.wrench()[row]
    force = np.linalg.norm(wrench[:3])
    assert force == pytest.approx(WEIGHT, rel=BEYOND)
    assert abs(expected.derivative("pitch")[row, 2]) == pytest.approx(force)
    assert abs(expected.derivative("yaw")[row, :3]) == pytest.approx(np.abs(np.cross(wrench[:3], [0.0, 0.0, 1.0])))
    assert expected.derivative("imu_z")[row, 2] == pytest.approx(-force / THREE.gravity)
    assert np.linalg.norm(expected.derivative(MASS)[row, :3]) == pytest.approx(WEIGHT)
    for length in (BRACKET_LENGTH, LOAD_LENGTH):
        assert np.abs(expected.derivative(length)[row, :3]).max() == pytest.approx(0.0, abs=1e-9)
        moment = wrench[3:] / np.linalg.norm(wrench[3:])
        np.testing.assert_allclose(expected.derivative(length)[row, 3:], WEIGHT * moment, atol=1e-6)


def test_slopes_by_angles_and_an_inertial_sensor_are_those_of_a_point_mass() -> None:
    """At either lock an error of gravity acts at the centre of mass; bending turns as the torques that bend do."""
    expected = _expected()
    true, poses = expected.wrench(), expected.poses
    torques = device_response(THREE, LOAD, poses)
    bent = sum(torques.torque(joint)[:, None] * expected.derivative(joint) for joint in ENCODERS)
    np.testing.assert_allclose(expected.derivative(COMPLIANCE), bent, atol=1e-6 * np.abs(bent).max())
    looked = 0
    for lock_deg in THREE.hinge.locks_deg:
        at = np.abs(np.rad2deg(poses.position[:, -1]) - lock_deg) < 1e-6
        assert at.sum() > 3
        mass = np.linalg.norm(true[at, :3], axis=1) / THREE.gravity
        arms = np.concatenate([np.cross(np.eye(3), force).T for force in true[at, :3]])
        centre = np.linalg.lstsq(arms, true[at, 3:].ravel(), rcond=None)[0]
        for axis, name in zip(np.eye(3), IMU, strict=True):
            change = np.concatenate([axis, np.cross(centre, axis)])
            np.testing.assert_allclose(expected.derivative(name)[at], -mass[:, None] * change, atol=1e-6)
            looked += 1
    assert looked == 6


TOLERANCES: Mapping[str, Tolerance] = {
    "pitch": Tolerance(step=2e-3),
    "yaw": Tolerance(zero=2e-3),
    MASS: Tolerance(zero=1e-3),
    BRACKET_LENGTH: Tolerance(zero=2e-4),
    LOAD_LENGTH: Tolerance(zero=2e-4),
    COMPLIANCE: Tolerance(fixed=1e-5),
}


@pytest.mark.parametrize("sensor", ["ft_1", "ft_1_3"])
@pytest.mark.parametrize("by_imu", [False, True])
def test_drawing_agrees_with_first_order(sensor: str, by_imu: bool) -> None:
    """Root mean square within the error of so many draws; no draw beyond what the largest errors allow."""
    imu = dict.fromkeys(IMU, Tolerance(step=0.02, zero=0.01))
    tolerances = imu | {MASS: Tolerance(zero=1e-3)} if by_imu else dict(TOLERANCES)
    expected = _expected(sensor)
    error = ErrorBudget.of(expected, tolerances)
    drawn = drawn_errors(expected, tolerances, np.random.default_rng(7), DRAWS)
    square = (drawn**2).mean(axis=1)  # (draws, 6)
    spread = square.std(axis=0) / np.sqrt(DRAWS)
    assert (np.abs(square.mean(axis=0) - error.rms**2) < DRAWN * spread).all()
    # of second order: the square of a mrad of the weight
    assert (np.abs(drawn).max(axis=(0, 1)) < 1.01 * error.largest).all()
    assert np.linalg.norm(drawn[..., :3], axis=-1).max() < 1.01 * error.largest_norms[0]
    assert np.linalg.norm(drawn[..., 3:], axis=-1).max() < 1.01 * error.largest_norms[1]


def test_drawing_notices_a_wrong_width() -> None:
    """Negative control: a width that is a fifth larger is seen by as many draws."""
    expected = _expected()
    tolerances = dict.fromkeys(ENCODERS, Tolerance(step=2e-3))
    drawn = drawn_errors(expected, dict.fromkeys(ENCODERS, Tolerance(step=2.4e-3)), np.random.default_rng(9), DRAWS)
    square = (drawn**2).mean(axis=1)
    spread = square.std(axis=0) / np.sqrt(DRAWS)
    assert (np.abs(square.mean(axis=0) - ErrorBudget.of(expected, tolerances).rms ** 2) > DRAWN * spread).all()


def test_table_6_3_of_a_bare_load_of_35_kg_is_that_by_hand() -> None:
    """Amplitudes are full widths: a mass of 35 kg times width over root 12; .340 is printed where it is .303."""
    bare = AttachedLoad.point(35.0, 0.11495)
    part = ONE.sensor[0].male
    sensor = ONE.sensor[0].model_copy(update={"male": part.model_copy(update={"mass_kg": 0.0})})
    bracket = ONE.hinge.bracket.model_copy(update={"mass_kg": 0.0})
    device = ONE.changed(sensor=(sensor,), hinge=ONE.hinge.model_copy(update={"bracket": bracket}))
    poses = twelve_steps(device).still_poses(device, bare, spacing_deg=5.0)
    expected = ExpectedWrench(device=device, load=bare, poses=poses, sensor="ft_1")
    for width, printed in ((0.015, 0.152), (0.03, 0.303)):
        rms = ErrorBudget.of(expected, dict.fromkeys(IMU, Tolerance(step=width))).rms
        np.testing.assert_allclose(rms[:3], 35.0 * width / np.sqrt(12.0), rtol=1e-9)
        assert rms[0] == pytest.approx(printed, abs=5e-4)


@pytest.mark.parametrize(("full_width", "force"), [(0.5, 0.61), (0.25, 0.31), (0.1, 0.12)])
def test_table_6_3_of_encoders_within_five_percent(full_width: float, force: float) -> None:
    """Root mean square of Fx and Fy; the device has 0.2 kg of interface and bracket beside the 35 kg."""
    rms = _encoders(full_width).at_largest_load.rms
    np.testing.assert_allclose(rms[:2], force, rtol=0.05)


@pytest.mark.parametrize(("full_width", "force"), [(0.015, 0.152), (0.03, 0.303)])
def test_table_6_3_of_an_imu_within_a_percent(full_width: float, force: float) -> None:
    """With interface and bracket."""
    np.testing.assert_allclose(_imu(full_width).at_largest_load.rms[:3], force, rtol=0.01)


def test_the_largest_errors_of_forces() -> None:
    """0.5 deg full width is 1.5 N per joint; 0.15 deg meets 0.5 N in each component, not as a norm of both joints."""
    assert _encoders(0.5).at_largest_load.largest_single_norms[0] == pytest.approx(1.5, rel=0.01)
    narrow = _encoders(0.15)
    assert narrow.at_largest_load.largest[:3].max() < 0.5 < narrow.at_largest_load.largest_norms[0]
    assert narrow.met_to_kg[0] == 35.0
    assert _encoders(0.25).at_largest_load.largest[:3].max() > 0.5
    assert _imu(0.015).at_largest_load.largest_norms[0] < 0.5 < _imu(0.03).at_largest_load.largest[:3].max()


def test_no_grade_meets_the_moment_at_a_lever_of_245_mm() -> None:
    """At 35 kg 0.02 N m is 0.06 mm; the finest grades are at three times as much, and meet it up to 10 kg."""
    assert pytest.approx(0.06e-3, rel=0.03) == 0.02 / WEIGHT
    for grade, one in _graded(3).items():
        assert one.at_largest_load.largest[3:].max() > 0.02, grade
    assert _encoders(0.1, 3).at_largest_load.largest_single_norms[1] == pytest.approx(0.07, abs=0.005)
    assert _imu(0.015, 3).at_largest_load.largest_single_norms[1] == pytest.approx(0.06, abs=0.005)
    for finest in (_encoders(0.1, 3), _imu(0.015, 3)):
        moment_kg = finest.met_to_kg[1]
        assert moment_kg is not None
        assert 10.0 < moment_kg < 11.0
    assert _encoders(0.5, 3).met_to_kg[1] is None


def test_errors_of_steps_zero_and_noise_count_as_they_are() -> None:
    """Full widths over root 12, noise as its deviation; the largest is half of widths, three deviations of noise."""
    tolerance = Tolerance(step=0.6, zero=1.2, noise=0.1)
    assert tolerance.variance == pytest.approx((0.36 + 1.44) / 12.0 + 0.01)
    assert tolerance.largest == pytest.approx(0.9 + 3.0 * 0.1)
    drawn = np.concatenate([tolerance.drawn(np.random.default_rng(seed), 50) for seed in range(400)])
    assert drawn.var() == pytest.approx(tolerance.variance, rel=0.1)
    stays = Tolerance(zero=1.0).drawn(np.random.default_rng(1), 50)
    assert np.ptp(stays) == 0.0


@pytest.mark.parametrize("field", ["step", "zero"])
def test_uniform_errors_reach_half_of_their_width_either_way(field: str) -> None:
    """About the fixed error; of 2000 draws an end is missed by 1 % of the width with a probability of 2e-9."""
    tolerance = Tolerance(**{field: 0.8}, fixed=3.0)
    drawn = [tolerance.drawn(np.random.default_rng(seed), 1) for seed in range(2000)]
    low, high = np.min(drawn) - 3.0, np.max(drawn) - 3.0
    assert -0.4 <= low < -0.392
    assert 0.392 < high <= 0.4


def test_a_budget_is_that_of_its_slopes_by_hand() -> None:
    """Random errors by their variance and their reach, a fixed one with its sign, pose by pose."""
    slopes = np.random.default_rng(4).normal(size=(3, 5, 6))
    tolerances = (Tolerance(step=0.6), Tolerance(zero=0.2, noise=0.1), Tolerance(fixed=-0.7, step=0.1))
    budget = ErrorBudget(quantities=("pitch", "yaw", MASS), tolerances=tolerances, slopes=slopes)
    variances, reach = [0.03, 0.04 / 12.0 + 0.01, 0.01 / 12.0], [0.3, 0.1 + 3.0 * 0.1, 0.05]
    square = sum(variance * slope**2 for variance, slope in zip(variances, slopes, strict=True))
    np.testing.assert_allclose(budget.rms**2, (square + (0.7 * slopes[2]) ** 2).mean(axis=0))
    worst = sum(size * np.abs(slope) for size, slope in zip(reach, slopes, strict=True)) + 0.7 * np.abs(slopes[2])
    np.testing.assert_allclose(budget.largest, worst.max(axis=0))
    # a norm is largest at one of the eight corners, and no error inside of them is larger
    corners = np.array(np.meshgrid(*([-size, size] for size in reach))).reshape(3, -1).T + [0.0, 0.0, -0.7]
    inside = np.random.default_rng(5).uniform(-1.0, 1.0, (500, 3)) * reach + [0.0, 0.0, -0.7]
    for half, largest in zip((slice(3), slice(3, 6)), budget.largest_norms, strict=True):
        at_corners, drawn = (
            np.linalg.norm(np.einsum("ck,knj->cnj", errors, slopes[:, :, half]), axis=2).max()
            for errors in (corners, inside)
        )
        assert drawn < largest == pytest.approx(at_corners)
    alone = [np.linalg.norm(slope[:, :3], axis=1).max() for slope in slopes]
    assert budget.largest_single_norms[0] == pytest.approx(max(np.array(alone) * [reach[0], reach[1], 0.75]))


def test_loads_up_to_which_a_limit_is_met_are_interpolated() -> None:
    """Of errors that are stated: 0.5 N between two loads, 0.02 N m at none, and both at all."""

    def errors(force: list[float], moment: list[float]) -> LoadErrors:
        slopes = np.zeros((3, 1, 1, 6))
        slopes[:, 0, 0, 1], slopes[:, 0, 0, 5] = force, moment
        budgets = (ErrorBudget(quantities=("pitch",), tolerances=(Tolerance(fixed=1.0),), slopes=one) for one in slopes)
        return LoadErrors(loads_kg=np.array([2.0, 5.0, 10.0]), budgets=tuple(budgets))

    assert errors([0.1, 0.3, 0.9], [0.03, 0.01, 0.01]).met_to_kg == (pytest.approx(5.0 + 5.0 / 3.0), None)
    assert errors([0.1, 0.3, 0.4], [0.01, 0.03, 0.04]).met_to_kg == (10.0, pytest.approx(3.5))


def test_what_cannot_be_propagated_is_refused() -> None:
    """Two sources of gravity, no errors, unknown names and invalid widths."""
    expected = _expected()
    both = {"pitch": Tolerance(step=1e-3), "imu_x": Tolerance(step=0.015)}
    with pytest.raises(SensorError, match="gravity by encoders or by an inertial sensor, got both"):
        ErrorBudget.of(expected, both)
    with pytest.raises(SensorError, match="at least one quantity with an error"):
        ErrorBudget.of(expected, {"pitch": Tolerance()})
    with pytest.raises(SensorError, match="unknown quantity 'pich'; did you mean \"pitch\""):
        expected.wrench({"pich": 1e-3})
    with pytest.raises(SensorError, match="no sensor 'ft_9'"):
        _expected("ft_9")
    with pytest.raises(SensorError, match="step: expected a width of at least 0"):
        Tolerance(step=-1.0)
