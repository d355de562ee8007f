# SPDX-License-Identifier: BSD-3-Clause
"""The passive hinge: gravity leads every load to the other lock, and nowhere else does the hinge open."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from forcetorque.base.errors import RobotError, SensorError
from forcetorque.device.components import AttachedLoad, device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.motion import DeviceTrajectory, Sequence, twelve_steps
from forcetorque.device.motors_hinge_and_envelope import HingePath, hinge_ways, lag_rad, pendulum_Nm

DEVICE = read_device()


def _to_the_third_lock(yaw_deg: float) -> Sequence:
    """From straight down, unlocked, up to level."""
    return Sequence.of(
        DEVICE.with_locks(-90.0, 0.0, 90.0),
        "third lock",
        [[-90.0, yaw_deg, 0.0], [0.0, yaw_deg, -90.0]],
        unlocked=(True,),
    )


@pytest.mark.parametrize("load_kg", DEVICE.loads_kg)
def test_every_load_reaches_the_other_lock_in_step_11_only(load_kg: float) -> None:
    """Gravity drives it from 0 towards 90 deg all the way and never back; in all other steps the hinge is locked."""
    load = device_load(DEVICE, load_kg)
    ways = hinge_ways(DEVICE, load, twelve_steps(DEVICE))
    assert [way.step for way in ways if way.unlocked] == [11]
    (swing,) = (way for way in ways if way.unlocked)
    assert swing.end_rad == pytest.approx(0.5 * np.pi, abs=1e-9)
    assert swing.drives_to_end
    assert swing.moment[0] == pytest.approx(0.0, abs=1e-9)  # no jerk when the lock opens
    assert swing.moment[-1] == pytest.approx(pendulum_Nm(DEVICE, load))
    locked = [way for way in ways if not way.unlocked]
    assert all(way.end_rad == way.lock_rad for way in locked)
    assert max(way.holding_Nm for way in locked) == pytest.approx(pendulum_Nm(DEVICE, load))


def test_the_moments_are_those_by_hand() -> None:
    """35 kg at 115 mm are 39.45 N m; level at yaw 0 they open the hinge, at 180 deg they close it, at 90 nothing."""
    load = device_load(DEVICE, 35.0)
    assert pendulum_Nm(DEVICE, load) == pytest.approx(39.45, abs=0.01)
    ways = {way.step: way for way in hinge_ways(DEVICE, load, twelve_steps(DEVICE))}
    turn = ways[8].moment
    angles = np.linspace(0.0, 2.0 * np.pi, len(turn))
    np.testing.assert_allclose(turn, pendulum_Nm(DEVICE, load) * np.cos(angles), atol=1e-9)
    assert np.abs(ways[12].moment).max() < 1e-9  # it hangs along the arm's normal: the lock at 90 deg bears nothing


@pytest.mark.parametrize("load_kg", DEVICE.loads_kg)
def test_the_lock_at_minus_90_is_reached_with_yaw_turned_by_180(load_kg: float) -> None:
    """The same swing, the other way."""
    device, load = DEVICE.with_locks(-90.0, 0.0, 90.0), device_load(DEVICE, load_kg)
    (swing,) = hinge_ways(device, load, _to_the_third_lock(180.0))
    assert swing.end_rad == pytest.approx(-0.5 * np.pi, abs=1e-9)
    assert swing.drives_to_end
    assert swing.moment[-1] == pytest.approx(-pendulum_Nm(device, load))


@pytest.mark.parametrize(("lock_deg", "end_deg"), [(0.0, 90.0), (90.0, 0.0), (-90.0, -30.0), (90.0, 30.0)])
def test_gravity_drives_to_the_end_that_its_moment_points_to(lock_deg: float, end_deg: float) -> None:
    """From the lock towards the end all the way; against it at one place the load stays there."""
    towards = np.sign(end_deg - lock_deg) * np.array([3.0, 5.0, 0.0])

    def drives(moment: np.ndarray) -> bool:
        path = HingePath(
            step=11, unlocked=True, lock_rad=np.deg2rad(lock_deg), end_rad=np.deg2rad(end_deg), moment=moment
        )
        return path.drives_to_end

    assert drives(towards)
    assert not drives(-towards)
    assert not drives(towards * [1.0, -0.01, 1.0])


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e6])
def test_rounding_of_a_large_moment_does_not_drive_a_load_back(size: float) -> None:
    """Of a moment of some newton metres 1e-12 is rounding, whatever its size; 1e-6 is not."""

    def drives(back: float) -> bool:
        moment = size * np.array([3.0, -back, 5.0])
        return HingePath(step=11, unlocked=True, lock_rad=0.0, end_rad=1.0, moment=moment).drives_to_end

    assert drives(1e-12)
    assert not drives(1e-5)


def test_moments_are_looked_at_every_two_degrees() -> None:
    """Of the joint that turns most on a way, from its start to its end."""
    sequence = twelve_steps(DEVICE)
    ways = hinge_ways(DEVICE, device_load(DEVICE, 35.0), sequence)
    assert len(ways) == len(sequence.postures) - 1
    for way, change in zip(ways, np.rad2deg(np.diff(sequence.postures, axis=0)), strict=True):
        assert np.abs(change).max() / (len(way.moment) - 1) <= 2.0 + 1e-9


def test_a_lock_that_the_load_cannot_reach_is_refused() -> None:
    """Without the half turn it swings to +90; a quarter turn brings the axis of the hinge upright."""
    device, load = DEVICE.with_locks(-90.0, 0.0, 90.0), device_load(DEVICE, 35.0)
    with pytest.raises(RobotError, match=r"to hang at the lock at -90 deg .* it hangs at 90\.0 deg and does not reach"):
        hinge_ways(device, load, _to_the_third_lock(0.0))
    with pytest.raises(RobotError, match="expected its axis away from the vertical"):
        hinge_ways(device, load, _to_the_third_lock(90.0))
    short = Sequence.of(DEVICE, "too short", [[-90.0, 0.0, 0.0], [-10.0, 0.0, 90.0]], unlocked=(True,))
    with pytest.raises(RobotError, match=r"it hangs at 80\.0 deg and does not reach it"):
        hinge_ways(DEVICE, load, short)


def test_friction_keeps_light_loads_farther_from_the_lock() -> None:
    """The last of the way has no moment left, so that any friction leaves a gap: by hand, an arc sine."""
    loads = [device_load(DEVICE, load_kg) for load_kg in DEVICE.loads_kg]
    lags = [lag_rad(DEVICE, load, 0.1) for load in loads]
    assert lags == sorted(lags, reverse=True)
    assert np.rad2deg(lags[0]) == pytest.approx(np.rad2deg(np.arcsin(0.1 / (2.0 * DEVICE.gravity * 0.09))))
    assert lag_rad(DEVICE, loads[0], 0.0) == 0.0
    with pytest.raises(SensorError, match="expected a friction from 0 to below 1.77 N m"):
        lag_rad(DEVICE, loads[0], 2.0)


def _swung_deg(load: AttachedLoad, friction_Nm: float) -> tuple[np.ndarray, np.ndarray]:
    """Angle from hanging straight, and the position of the hinge, in step 11: a pendulum on a moving pivot, by hand."""
    trajectory = DeviceTrajectory(device=DEVICE, load=load, sequence=twelve_steps(DEVICE))
    way = trajectory.sequence.unlocked.index(True)
    start, duration = trajectory.ways.departures_s[way], trajectory.ways.durations_s[way]
    seconds = np.linspace(0.0, duration + 0.9, 2000)
    motion = trajectory.ways(start + seconds)
    positions, speeds, changes = motion.position[:, 0], motion.velocity[:, 0], motion.acceleration[:, 0]
    arm = DEVICE.pitch.part.height_m + DEVICE.yaw.part.height_m + 0.04 + DEVICE.hinge.bracket.height_m
    moment, inertia = load.inertia.first_moment[2], load.inertia.second_moment[1, 1]

    def rate(time: float, state: np.ndarray) -> list[float]:
        pitch, speed, change = (np.interp(time, seconds, values) for values in (positions, speeds, changes))
        forward = -arm * (np.cos(pitch) * speed**2 + np.sin(pitch) * change)
        upward = -arm * (np.sin(pitch) * speed**2 - np.cos(pitch) * change)
        rubbing = friction_Nm * np.tanh((state[1] - speed) / 0.01)
        pull = (DEVICE.gravity + upward) * np.sin(state[0]) + forward * np.cos(state[0])
        return [state[1], -(moment * pull + rubbing) / inertia]

    swing = solve_ivp(rate, (0.0, seconds[-1]), [0.0, 0.0], max_step=0.02, rtol=1e-6)
    return np.rad2deg(swing.y[0]), np.rad2deg(np.interp(swing.t, seconds, positions) - swing.y[0]) + 90.0


@pytest.mark.parametrize("load_kg", [0.0, 35.0])
def test_in_time_the_load_swings_by_half_a_degree_and_comes_to_its_lock(load_kg: float) -> None:
    """What statics say holds at the speed of the motors, where the hinge has no friction; with some it stops short."""
    load = device_load(DEVICE, load_kg)
    angle, hinge = _swung_deg(load, 0.0)
    assert np.abs(angle).max() < 0.6
    assert hinge.max() > 90.0
    angle, hinge = _swung_deg(load, 0.1)
    assert 0.0 < 90.0 - hinge.max() <= 90.0 - hinge[-1] < np.rad2deg(lag_rad(DEVICE, load, 0.1))
