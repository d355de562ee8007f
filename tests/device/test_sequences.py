# SPDX-License-Identifier: BSD-3-Clause
"""The 12 steps, how the hinge hangs in them, and what the device refuses."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.device.components import AttachedLoad, Device, Turn, device_load
from forcetorque.device.device_file import DeviceMotion, read_device
from forcetorque.device.motion import DeviceTrajectory, Sequence, YawReturn, twelve_steps
from forcetorque.device.optimised_motion import Designer
from forcetorque.device.robot_model import hanging
from forcetorque.robot.motion import JointMotion

DIFFERENCE = 1e-4
"""Of a central difference over 1 ms where jerk sets in at the ends of a move: a quarter of that of some 0.2 rad/s3."""

DEVICE = read_device()
LOAD = device_load(DEVICE, 35.0)
ENDLESS = DEVICE.changed(yaw=DEVICE.yaw.model_copy(update={"range_deg": (-10.0, 1090.0)}))


def _device(yaw_return: YawReturn) -> Device:
    return ENDLESS if yaw_return is YawReturn.NEVER else DEVICE


@pytest.mark.parametrize("yaw_return", YawReturn)
def test_the_steps_go_where_the_thesis_says(yaw_return: YawReturn) -> None:
    """Pitch goes up and down four times, yaw once around in quarters, then level with the hinge at 0 and at 90."""
    sequence = twelve_steps(_device(yaw_return), yaw_return=yaw_return)
    assert set(sequence.steps) == {1, 2, 3, 4, 5, 7, 8, 9, 11, 12}
    ends = {step: np.rad2deg(sequence.postures[k]) for k, step in enumerate(sequence.steps)}
    assert [ends[step][0] for step in (1, 2, 4, 7, 8, 9, 11, 12)] == [-90, 90, -90, 0, 0, -90, 0, 0]
    assert [ends[step][2] for step in (9, 11, 12)] == [0, 90, 90]
    turned = {step: abs(ends[step][1] - ends[before][1]) for before, step in ((7, 8), (11, 12))}
    assert turned == {8: 360.0, 12: 360.0}
    sequence.require_possible(_device(yaw_return), LOAD)


@pytest.mark.parametrize("yaw_return", YawReturn)
def test_each_step_turns_what_the_thesis_turns(yaw_return: YawReturn) -> None:
    """Pitch through half a turn in steps 2 and 4, yaw by a quarter in 3 and 5, a whole turn in 8 and 12."""
    sequence = twelve_steps(_device(yaw_return), yaw_return=yaw_return)
    ways = np.rad2deg(np.abs(np.diff(sequence.postures, axis=0)))
    turned = {step: ways[np.array(sequence.steps[1:]) == step].sum(axis=0) for step in sequence.steps}
    back = 0.0 if yaw_return in (YawReturn.BACKWARDS, YawReturn.NEVER) else 360.0
    by_hand = {
        **dict.fromkeys((2, 4), [360.0, 0.0, 0.0]),
        **dict.fromkeys((3, 5), [0.0, 180.0, 0.0]),
        **dict.fromkeys((7, 9), [90.0, back, 0.0]),
        **dict.fromkeys((8, 12), [0.0, 360.0, 0.0]),
        11: [90.0, 0.0, 90.0],
    }
    for step, angles in by_hand.items():
        np.testing.assert_allclose(turned[step], angles, atol=1e-9)
    first, *_, last = np.rad2deg(sequence.postures)
    np.testing.assert_allclose(first, [-90.0, 0.0, 0.0])
    np.testing.assert_allclose(last, [0.0, 1080.0 if yaw_return is YawReturn.NEVER else 360.0, 90.0])
    # in one way, pitch before yaw, or yaw before pitch
    in_step_7 = ways[np.array(sequence.steps[1:]) == 7]
    first_way = {YawReturn.BEFORE: [0.0, 360.0, 0.0], YawReturn.AFTER: [90.0, 0.0, 0.0]}
    np.testing.assert_allclose(in_step_7[0], first_way.get(yaw_return, [90.0, back, 0.0]), atol=1e-9)


def test_a_motion_may_reach_its_stops() -> None:
    """Pitch, yaw and the hanging load at the ends of their ranges."""
    device = DEVICE.changed(
        pitch=DEVICE.pitch.model_copy(update={"range_deg": (-90.0, 90.0)}),
        yaw=DEVICE.yaw.model_copy(update={"range_deg": (0.0, 360.0)}),
        hinge=DEVICE.hinge.model_copy(update={"range_deg": (0.0, 90.0)}),
    )
    twelve_steps(device).require_possible(device, LOAD)


def test_postures_rest_as_long_wherever_they_are_from() -> None:
    """One second, of motions of files, in Python and of a search alike."""
    defaults = {field.name: field.default for field in dataclasses.fields(DeviceTrajectory)}
    searched = {field.name: field.default for field in dataclasses.fields(Designer)}
    assert defaults["hold_s"] == searched["hold_s"] == DeviceMotion().hold_s == DEVICE.motion.hold_s


def test_the_load_swings_with_pitch_and_locks_at_90() -> None:
    """In step 11 the load stays vertical: the hinge follows pitch, and is at 90 when the arm is level."""
    trajectory = DeviceTrajectory(device=DEVICE, load=LOAD, sequence=twelve_steps(DEVICE))
    time, motion = trajectory.sampled(20.0)
    swings = trajectory.way_at(time) == trajectory.sequence.unlocked.index(True)
    assert swings.sum() > 20
    np.testing.assert_allclose(motion.position[swings, 2], motion.position[swings, 0] + np.pi / 2, atol=1e-12)
    assert np.rad2deg(motion.position[-1]) == pytest.approx([0.0, 360.0, 90.0])


@pytest.mark.parametrize("rate_hz", [0.5, 20.0])
def test_samples_are_the_fewest_that_are_as_dense_as_the_rate(rate_hz: float) -> None:
    """From start to end, evenly; with an interval less they would be farther apart."""
    trajectory = DeviceTrajectory(device=DEVICE, load=LOAD, sequence=twelve_steps(DEVICE))
    time, motion = trajectory.sampled(rate_hz)
    assert (time[0], time[-1], len(motion)) == (0.0, trajectory.duration_s, len(time))
    np.testing.assert_allclose(np.diff(time), trajectory.duration_s / (len(time) - 1), rtol=1e-9)
    assert trajectory.duration_s / (len(time) - 1) <= 1.0 / rate_hz < trajectory.duration_s / (len(time) - 2)


def test_velocities_and_accelerations_are_derivatives() -> None:
    """Central differences of positions and velocities agree at every instant of the whole trajectory."""
    trajectory = DeviceTrajectory(device=DEVICE, load=LOAD, sequence=twelve_steps(DEVICE))
    time = np.linspace(0.01, trajectory.duration_s - 0.01, 4001)
    step = 1e-3
    before, at, after = trajectory(time - step), trajectory(time), trajectory(time + step)
    inside = trajectory.way_at(time - step) == trajectory.way_at(time + step)
    assert inside.mean() > 0.98
    for value, rate in (("position", "velocity"), ("velocity", "acceleration")):
        slope = (getattr(after, value) - getattr(before, value)) / (2 * step)
        np.testing.assert_allclose(slope[inside], getattr(at, rate)[inside], atol=DIFFERENCE)


def test_no_joint_is_faster_than_its_motor() -> None:
    """Speeds stay below those of the file, and reach them."""
    _, motion = DeviceTrajectory(device=DEVICE, load=LOAD, sequence=twelve_steps(DEVICE)).sampled(50.0)
    fastest = np.rad2deg(np.abs(motion.velocity).max(axis=0))
    assert fastest[0] == pytest.approx(DEVICE.pitch.speed_deg_s, rel=1e-3)
    assert fastest[1] == pytest.approx(DEVICE.yaw.speed_deg_s, rel=1e-3)


def test_a_hinge_hangs_with_its_derivatives() -> None:
    """Where pitch, yaw and turn move at once, differences of the angle are its velocity and acceleration."""
    device = DEVICE.changed(turn=Turn())
    phase = np.array([[0.3, 1.1, 2.0]])

    def angle(time: np.ndarray) -> JointMotion:
        swing = 0.7 * np.sin(time[:, None] + phase) - np.array([[0.9, 0.0, 0.0]])
        rate, change = 0.7 * np.cos(time[:, None] + phase), -0.7 * np.sin(time[:, None] + phase)
        others = JointMotion(names=("pitch", "yaw", "turn"), position=swing, velocity=rate, acceleration=change)
        return hanging(device, LOAD, others)

    time, step = np.linspace(0.0, 6.0, 61), 1e-4
    before, at, after = angle(time - step), angle(time), angle(time + step)
    assert np.ptp(at.position) > 0.5
    np.testing.assert_allclose((after.position - before.position) / (2 * step), at.velocity, atol=DIFFERENCE)
    np.testing.assert_allclose((after.velocity - before.velocity) / (2 * step), at.acceleration, atol=DIFFERENCE)


def test_a_hinge_whose_axis_is_upright_hangs_nowhere() -> None:
    """With a level arm yaw tilts the axis: a fiftieth of gravity across it is needed, 1.15 degrees."""
    names = ("pitch", "yaw")
    assert len(hanging(DEVICE, LOAD, JointMotion.at_rest(names, np.deg2rad([[0.0, 88.8]])))) == 1
    with pytest.raises(RobotError, match="expected its axis away from the vertical"):
        hanging(DEVICE, LOAD, JointMotion.at_rest(names, np.deg2rad([[0.0, 88.9]])))


def test_with_yaw_turned_the_load_goes_the_other_way() -> None:
    """After half a turn of yaw gravity carries the load to -90."""
    postures = [[-90.0, 180.0, 0.0], [0.0, 180.0, -90.0]]
    third = DEVICE.with_locks(-90.0, 0.0, 90.0)
    Sequence.of(third, "other way", postures, unlocked=(True,)).require_possible(third, LOAD)


def _refused(postures: list[list[float]], *, unlocked: bool = False, device: Device = DEVICE) -> None:
    Sequence.of(device, "test", postures, unlocked=(unlocked,) * (len(postures) - 1)).require_possible(device, LOAD)


def test_a_lock_that_the_load_does_not_reach_is_refused() -> None:
    """Short of level the load hangs short of 90, and the message says where."""
    with pytest.raises(RobotError, match=r"step 2: .* the load to hang at the lock at 90 deg .* hangs at 70.0 deg"):
        _refused([[-90.0, 0.0, 0.0], [-20.0, 0.0, 90.0]], unlocked=True)


def test_a_load_that_would_fall_is_refused() -> None:
    """Unlocked where it does not hang at its lock, it would drop."""
    with pytest.raises(RobotError, match=r"lock at 0 deg when it is unlocked, it hangs at 45.0 deg and would fall"):
        _refused([[-45.0, 0.0, 0.0], [0.0, 0.0, 90.0]], unlocked=True)


def test_a_way_past_a_stop_is_refused() -> None:
    """Both ends are well, but in between the load hangs beyond the stop."""
    hinge = DEVICE.hinge.model_copy(update={"range_deg": (-40.0, 90.0), "locks_deg": (45.0,)})
    with pytest.raises(RobotError, match=r"hang within hinge.range_deg = \[-40.0, 90.0\], got -"):
        _refused([[-45.0, 0.0, 45.0], [-45.0, 360.0, 45.0]], unlocked=True, device=DEVICE.changed(hinge=hinge))


def test_a_lock_that_is_not_there_is_refused() -> None:
    """The hinge rests at locks only."""
    with pytest.raises(RobotError, match=r"hinge at one of hinge.locks_deg = \[0.0, 90.0\], got -90 deg"):
        _refused([[0.0, 0.0, -90.0], [10.0, 0.0, -90.0]])


def test_a_locked_hinge_does_not_move() -> None:
    """No motor moves it."""
    with pytest.raises(RobotError, match="expected a locked hinge to stay, got a way from 0 to 90 deg"):
        _refused([[-90.0, 0.0, 0.0], [0.0, 0.0, 90.0]])


@pytest.mark.parametrize(("column", "joint", "angle"), [(0, "pitch", 100.0), (1, "yaw", 800.0)])
def test_a_motion_outside_of_the_ranges_is_refused(column: int, joint: str, angle: float) -> None:
    """The message names step, joint and range."""
    posture = [0.0, 0.0, 0.0]
    posture[column] = angle
    with pytest.raises(RobotError, match=rf"step 2: joint '{joint}': expected a position within .* got {angle:g}"):
        _refused([[0.0, 0.0, 0.0], posture])


def test_an_unlocked_hinge_with_a_vertical_axis_is_refused() -> None:
    """Nothing says where the load hangs."""
    motion = JointMotion.at_rest(("pitch", "yaw"), np.deg2rad([[0.0, 90.0]]))
    with pytest.raises(RobotError, match="axis away from the vertical .* got pitch 0.0 deg, yaw 90.0 deg"):
        hanging(DEVICE, LOAD, motion)


def test_a_load_beyond_the_stops_is_refused() -> None:
    """With the arm up the load hangs back over it."""
    with pytest.raises(RobotError, match="expected the load to hang within hinge.range_deg"):
        hanging(DEVICE, LOAD, JointMotion.at_rest(("pitch", "yaw"), np.deg2rad([[60.0, 0.0]])))


def test_a_load_aside_hangs_aside() -> None:
    """A centre of mass that is off the middle hangs below the hinge."""
    inertia = LOAD.inertia.expressed_in(np.array([[1, 0, 0, 0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
    aside = AttachedLoad(name="aside", inertia=inertia)
    at = hanging(DEVICE, aside, JointMotion.at_rest(("pitch", "yaw"), np.deg2rad([[-60.0, 0.0]])))
    expected = 30.0 - np.rad2deg(np.arctan2(0.1, LOAD.centre_of_mass_m[2]))
    assert np.rad2deg(at.position[0, 0]) == pytest.approx(expected)


def test_still_poses_are_close() -> None:
    """No joint goes farther than the spacing from pose to pose, and the ways end where the sequence does."""
    sequence = twelve_steps(DEVICE)
    poses = sequence.still_poses(DEVICE, LOAD, spacing_deg=20.0)
    assert np.rad2deg(np.abs(np.diff(poses.position, axis=0))).max() == pytest.approx(20.0)
    np.testing.assert_array_equal(poses.position[-1], sequence.postures[-1])
    assert not poses.velocity.any()
    with pytest.raises(ShapeError, match="spacing_deg"):
        sequence.still_poses(DEVICE, LOAD, spacing_deg=0.0)
