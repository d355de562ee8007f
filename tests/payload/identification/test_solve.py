# SPDX-License-Identifier: BSD-3-Clause
"""Loads, biases and mounting from readings: exact on exact data, against the library's own dynamics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FitError
from forcetorque.base.inertia import Inertia
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import TableLayout, TableSignal
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem, LoadRows
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identification.parameter_vector import Kind
from forcetorque.payload.identification.robust_fit import plain_fit
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointType, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.payload.identification.payloads import CENTRE, MASS, SIZES, poses, problem_of, weight

BIAS = np.array([5.0, -3.0, 12.0, 0.5, -0.2, 0.1])
EXACT = 1e-8
"""kg, m, N, N m: rounding of a least-squares problem of condition below 1000, squared by its normal equations."""
INERTIA = np.array([[4e-3, 2e-4, 0.0], [2e-4, 3e-3, -1e-4], [0.0, -1e-4, 2e-3]])
DIRECTIONS = list(MeasureDirection)
SIX = ([0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2])
"""Places of xx, yy, zz, xy, xz, yz."""


def _dynamics(inertia: Inertia, direction: MeasureDirection, root: RootMotion) -> np.ndarray:
    """What the library's own dynamics expect of a sensor with this load."""
    joint = Joint(
        name="mount", type=JointType.FIXED, parent="flange", child="load", parent_H_child=np.eye(4), axis=[1.0, 0, 0]
    )
    sensor = ForceTorqueSensor(
        name="ft", joint="mount", frame=SensorFrame.CHILD, direction=direction, child_H_sensor=np.eye(4)
    )
    model = RobotModel(
        name="load", links={"flange": Inertia.zero(), "load": inertia}, joints={"mount": joint}, sensors={"ft": sensor}
    )
    joints = JointMotion.at_rest((), np.empty((len(root.proper_acceleration), 0)))
    return expected_wrenches(build_tree(model, "flange"), joints, root)["ft"]


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_exact_motion_gives_the_exact_load(direction: MeasureDirection) -> None:
    """Mass, centre, inertia and bias come back of a load that is turned, for both senses of the reading."""
    rng = np.random.default_rng(1)
    acceleration, velocity, turning = (size * rng.normal(size=(40, 3)) for size in (9.8, 2.0, 20.0))
    truth = Inertia.about_centre_of_mass(mass=MASS, centre_of_mass=CENTRE, second_moment=INERTIA)
    root = RootMotion(proper_acceleration=acceleration, angular_velocity=velocity, angular_acceleration=turning)
    rows = LoadRows.of_poses(
        _dynamics(truth, direction, root) + BIAS,
        acceleration,
        angular_velocity=velocity,
        angular_acceleration=turning,
    )
    loads = (Load(name="tool", inertia="unknown"),)
    solution = solve(
        LoadProblem(rows=rows, loads=loads, sessions=("a",), blocks=("a",), direction=direction, drift=False)
    )
    (load,) = solution.loads
    assert load.mass == pytest.approx(MASS, abs=EXACT)
    np.testing.assert_allclose(load.centre_of_mass, CENTRE, atol=EXACT)
    np.testing.assert_allclose(load.inertia, INERTIA, atol=EXACT)
    np.testing.assert_allclose(solution.sessions[0].bias, BIAS, atol=EXACT)
    np.testing.assert_allclose(load.as_inertia().second_moment, truth.second_moment, atol=EXACT)
    assert solution.open_directions == ()
    assert solution.hypotheses == ()


@pytest.mark.parametrize(
    "load",
    [
        Load(name="tool"),
        Load(name="tool", mass=MASS),
        Load(name="tool", centre_of_mass=CENTRE),
        Load(name="tool", mass=MASS, centre_of_mass=CENTRE),
        Load(name="tool", inertia=np.zeros((3, 3))),
    ],
    ids=["unknown", "mass", "centre", "both", "inertia"],
)
def test_what_is_stated_is_kept_and_the_rest_estimated(load: Load) -> None:
    """With any part of the load stated, the rest and the bias are exact."""
    gravity = poses(8, np.random.default_rng(2))
    solution = solve(problem_of(weight(gravity) + BIAS, gravity, loads=(load,)))
    (answer,) = solution.loads
    assert answer.mass == pytest.approx(MASS, abs=EXACT)
    np.testing.assert_allclose(answer.centre_of_mass, CENTRE, atol=EXACT)
    np.testing.assert_allclose(solution.sessions[0].bias, BIAS, atol=EXACT)
    assert answer.estimated is not load.is_known
    assert (answer.mass_half_width == 0.0) is (load.mass is not None)


def test_several_loads_share_a_bias() -> None:
    """Two unknown loads and a known one in one session: each has its own mass, the bias is one."""
    rng = np.random.default_rng(3)
    gravity, number = poses(18, rng), np.repeat([0, 1, 2], 6)
    masses, centres = (0.5, 1.0, 2.0), 0.1 * rng.normal(size=(3, 3))
    reading = np.vstack([weight(gravity[number == k], masses[k], centres[k]) for k in range(3)]) + BIAS
    loads = (Load(name="a"), Load(name="b", mass=1.0, centre_of_mass=centres[1]), Load(name="c"))
    solution = solve(problem_of(reading, gravity, loads=loads, load=number))
    for load, mass, centre in zip(solution.loads, masses, centres, strict=True):
        assert load.mass == pytest.approx(mass, abs=EXACT)
        np.testing.assert_allclose(load.centre_of_mass, centre, atol=EXACT)
    np.testing.assert_allclose(solution.sessions[0].bias, BIAS, atol=EXACT)


def test_a_temperature_is_told_from_bias_and_load() -> None:
    """What a degree adds comes back, within the noise; without it the bias would take it."""
    rng = np.random.default_rng(4)
    gravity, degrees = poses(60, rng), rng.uniform(20.0, 30.0, size=(60, 1))
    slope = np.array([0.1, -0.2, 0.5, 0.01, 0.0, 0.0])
    reading = weight(gravity) + BIAS + (degrees - degrees.mean()) * slope + SIZES * rng.normal(size=(60, 6))
    solution = solve(problem_of(reading, gravity, variables=degrees, variables_named=("temperature (degC)",)))
    (variable,) = solution.variables
    assert (np.abs(variable.coefficients - slope) < 1.5 * np.array(variable.half_width_95)).all()
    assert (np.array(variable.half_width_95) < 0.1 * np.abs(slope).max()).all()


@pytest.mark.long
def test_a_mount_that_nobody_states_is_found() -> None:
    """A sensor that is turned by a quarter and three degrees; stated as not turned, the quarter is named."""
    rng = np.random.default_rng(5)
    gravity = poses(30, rng)
    mount = Rotation.from_euler("zx", [90.0, 3.0], degrees=True).as_matrix()
    reading = weight(gravity @ mount.T) + BIAS + 0.01 * SIZES * rng.normal(size=(30, 6))
    solution = solve(problem_of(reading, gravity, mount=True))
    error = Rotation.from_matrix(solution.mount @ mount.T).as_rotvec()
    assert (np.abs(error) < 2.0 * solution.mount_half_width).all()
    assert np.rad2deg(solution.mount_half_width).max() < 0.1
    assert solution.loads[0].mass == pytest.approx(MASS, abs=1e-3)
    stated = solve(problem_of(reading, gravity))
    assert [one.name for one in stated.hypotheses] == ["turned axes"]
    assert "x of the sensor is -y of the motion, y is x, z is z" in stated.hypotheses[0].description


def test_the_tilt_of_a_floor_is_found() -> None:
    """A world that is tilted by two degrees, by the orientation of the rows."""
    rng = np.random.default_rng(6)
    world_R_sensor = Rotation.random(40, random_state=6).as_matrix()
    tilt = np.deg2rad([2.0, -1.0])
    up = np.array([0.0, 0.0, 9.80665])
    true_up = Rotation.from_rotvec([*tilt, 0.0]).apply(up)
    logged, true = (np.einsum("nji,j->ni", world_R_sensor, -one) for one in (up, true_up))
    reading = weight(true) + BIAS + 0.01 * SIZES * rng.normal(size=(40, 6))
    solution = solve(problem_of(reading, logged, orientation=world_R_sensor, tilt=True))
    assert (np.abs(solution.tilt - tilt) < 2.0 * solution.tilt_half_width).all()
    assert np.rad2deg(solution.tilt_half_width).max() < 0.1


def test_an_unknown_tilt_leaves_the_mass_of_a_sensor_that_turns() -> None:
    """Each row is a mean over a turn of 0.6 rad, whose mean orientation is no rotation; a level world has no tilt."""
    rng = np.random.default_rng(9)
    world_R_sensor = Rotation.random(40, random_state=6).as_matrix()[:, None] @ np.stack(
        [Rotation.from_rotvec([angle, 0.0, 0.0]).as_matrix() for angle in np.linspace(-0.3, 0.3, 11)]
    )
    gravity = np.einsum("nkji,j->nki", world_R_sensor, [0.0, 0.0, -9.80665]).mean(axis=1)
    reading = weight(gravity) + BIAS + 1e-3 * SIZES * rng.normal(size=(40, 6))
    solution = solve(problem_of(reading, gravity, orientation=world_R_sensor.mean(axis=1), tilt=True))
    assert solution.loads[0].mass == pytest.approx(MASS, rel=1e-4)
    assert np.abs(solution.tilt).max() < 1e-4


@pytest.mark.long
def test_a_matrix_that_is_known_in_part_widens_the_mass() -> None:
    """A gain of 2 % that nobody knows is 2 % of the mass; a stated mass then tells the gain."""
    rng = np.random.default_rng(7)
    gravity = poses(40, rng)
    reading = weight(gravity) + BIAS + 0.1 * SIZES * rng.normal(size=(40, 6))
    deviations = np.full((6, 6), 1e-5)
    deviations[:3, :3] += 0.02 * np.eye(3)
    prior = np.array([np.diag(row**2) for row in deviations])
    exact, vague = (solve(problem_of(reading, gravity, matrix_prior=one)).loads[0] for one in (None, prior))
    assert exact.mass_half_width < 0.002 * MASS
    assert 0.015 * MASS < vague.mass_half_width < 0.05 * MASS
    louder = reading * np.repeat([1.02, 1.0], 3)
    known = (Load(name="tool", mass=MASS, centre_of_mass=CENTRE),)
    response = solve(problem_of(louder, gravity, loads=known, matrix_prior=prior)).response
    np.testing.assert_allclose(np.diag(response)[:3], 1.02, atol=0.002)


def test_a_slope_moves_a_mass_by_its_variance() -> None:
    """By the closed form: a slope of the density moves the least squares by it times the variance under the noise.

    Set against the whole reading, which is what is left before the first step, it would move the mass by 100 kg.
    """
    rng, force_noise, slope = np.random.default_rng(3), 0.02, 1e4
    acceleration = rng.normal(size=(40, 3))
    acceleration *= 9.8 / np.linalg.norm(acceleration, axis=1, keepdims=True)
    reading = np.hstack([1.3 * acceleration, np.zeros((40, 3))])
    reading += rng.normal(size=(40, 6)) * np.repeat([force_noise, 1e-3], 3)
    problem = LoadProblem(
        rows=LoadRows.of_poses(reading, acceleration),
        loads=(Load(name="tool", centre_of_mass=np.zeros(3)),),
        sessions=("all",),
        blocks=("poses",),
        direction=MeasureDirection.PARENT_TO_CHILD,
        drift=False,
    )
    steep = replace(problem, slope=(np.append(slope, np.zeros(9)),))
    flat_mass, steep_mass = (plain_fit(one, drift=False)[0].of(Kind.MASS)[0] for one in (problem, steep))
    variance = force_noise**2 / ((acceleration - acceleration.mean(axis=0)) ** 2).sum()
    assert flat_mass - steep_mass == pytest.approx(slope * variance, rel=0.2)


def _about_centre(inertial: np.ndarray) -> np.ndarray:
    """Centre of mass, and inertia about it as xx, yy, zz, xy, xz, yz, of ten inertial parameters; shape (9,)."""
    mass, first = inertial[0], inertial[1:4]
    xx, yy, zz, xy, xz, yz = inertial[4:]
    (x, y, z) = centre = first / mass
    # the parallel axis theorem, component by component
    about = [xx - mass * (y * y + z * z), yy - mass * (x * x + z * z), zz - mass * (x * x + y * y)]
    return np.concatenate([centre, about, [xy + mass * x * y, xz + mass * x * z, yz + mass * y * z]])


def test_half_widths_of_centre_and_inertia_follow_from_the_covariance() -> None:
    """By finite differences of the ratio and of the parallel axis theorem; the interval has one quantile for all."""
    rng = np.random.default_rng(10)
    acceleration, velocity, turning = (size * rng.normal(size=(30, 3)) for size in (9.8, 2.0, 20.0))
    centre = np.array([0.1, -0.2, 0.5])
    truth = Inertia.about_centre_of_mass(mass=MASS, centre_of_mass=centre, second_moment=INERTIA)
    root = RootMotion(proper_acceleration=acceleration, angular_velocity=velocity, angular_acceleration=turning)
    reading = _dynamics(truth, DIRECTIONS[0], root) + 4.0 * SIZES * rng.normal(size=(30, 6))
    motion = {"angular_velocity": velocity, "angular_acceleration": turning}
    rows = LoadRows.of_poses(reading, acceleration, **motion)
    tool = (Load(name="tool", inertia="unknown"),)
    fields = {"sessions": ("a",), "blocks": ("a",), "direction": DIRECTIONS[0], "drift": False}
    (load,) = solve(LoadProblem(rows=rows, loads=tool, **fields)).loads  # type: ignore[arg-type]
    inertial = np.concatenate([[load.mass], load.first_moment, truth.second_moment[SIX]])
    inertial[4:] = load.as_inertia().second_moment[SIX]
    np.testing.assert_allclose(_about_centre(inertial), [*load.centre_of_mass, *load.inertia[SIX]], atol=1e-12)
    steps = 1e-4 * np.diag(np.sqrt(np.diag(load.covariance)))
    change = np.array([_about_centre(inertial + step) - _about_centre(inertial - step) for step in steps]).T
    change /= 2.0 * np.diag(steps)
    error = np.sqrt(np.einsum("ia,ab,ib->i", change, load.covariance, change))
    quantiles = np.concatenate([load.centre_of_mass_half_width, load.inertia_half_width[SIX]]) / error
    # an error of the differences is one of steps squared
    np.testing.assert_allclose(quantiles, quantiles[0], rtol=1e-6)
    own = load.mass_half_width / np.sqrt(load.covariance[0, 0])
    assert 1.9 < own <= quantiles[0] * (1.0 + 1e-9) < 1.5 * own
    # negative control: without the error of the mass the centre would be some other
    first = np.sqrt(np.diag(load.covariance)[1:4]) / load.mass
    assert not np.allclose(error[:3], first, rtol=0.05)


def test_rows_must_be_finite_and_named() -> None:
    """A row that is no number is named; no row at all is refused."""
    gravity = poses(6, np.random.default_rng(8))
    reading = weight(gravity)
    reading[3, 1] = np.nan
    with pytest.raises(FitError, match=r"wrench: row 'row 4' has a value that is no finite number"):
        problem_of(reading, gravity)
    empty = LoadRows.of_poses(np.empty((0, 6)), np.empty((0, 3)))
    nothing = LoadProblem(rows=empty, loads=(Load(name="a"),), sessions=("a",), blocks=("a",), direction=DIRECTIONS[0])
    with pytest.raises(FitError, match="at least one reading"):
        solve(nothing)


@pytest.mark.real_data
def test_a_real_wrist_sensors_load(data_dir: Path) -> None:
    """24 still poses of an ATI Gamma: 0.932 kg, 44 mm along z, residuals of .13 .05 .06 N."""
    layout = TableLayout(
        stamp=None,
        signals=(
            TableSignal(
                quantity="wrench",
                columns=("fx", "fy", "fz", "tx", "ty", "tz"),
                units=("N", "N", "N", "N m", "N m", "N m"),
                frame="ft",
            ),
            TableSignal(quantity="gravity", columns=("gx", "gy", "gz"), units=("m/s2",) * 3, frame="ft"),
        ),
    )
    path = data_dir / "ati_gamma_kuka_med14_skrede" / "0-calibration_fts-accel.csv"
    (table,) = read_table(path, layout, stream="wrist", clock="none").streams
    solution = solve(problem_of(table.signal("wrench").values, table.signal("gravity").values))
    (load,) = solution.loads
    assert load.mass == pytest.approx(0.932, abs=0.001)
    assert solution.drift.plain_mass_without_kg[0] == pytest.approx(0.9323, abs=0.0001)
    np.testing.assert_allclose(load.centre_of_mass, [0.0003, 0.0, 0.0439], atol=1e-4)
    assert abs(load.mass - 0.9323) < load.mass_half_width < 0.004
    np.testing.assert_allclose(solution.residual_rms[:3], [0.13, 0.05, 0.06], atol=0.005)
    assert solution.disagreeing == ()
    assert solution.hypotheses == ()


def test_what_is_known_before_the_rows_fills_what_they_leave_open() -> None:
    """Still poses say nothing of the inertia, which is as expected; of the mass they say all, whatever was expected."""
    gravity = poses(12, np.random.default_rng(5))
    expected, precision = np.array([2.0 * MASS, 0.0, 0.0, 0.0, 0.02, 0.03, 0.01, 1e-3, 2e-3, -1e-3]), np.zeros((10, 10))
    precision[4:, 4:] = 1e8 * np.eye(6)
    precision[0, 0] = 1e-3
    load = Load(name="tool", inertia="unknown", expected=expected, precision=precision)
    (found,) = solve(problem_of(weight(gravity) + BIAS, gravity, loads=(load,))).loads
    assert found.mass == pytest.approx(MASS, abs=1e-3)
    np.testing.assert_allclose(found.as_inertia().second_moment[SIX], expected[4:], atol=1e-5)
