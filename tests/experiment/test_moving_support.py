# SPDX-License-Identifier: BSD-3-Clause
"""Experiments without a fixed foot: an IMU at any link tells how the robot moves."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.dynamics import motion_of_link
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.robot.motion import RootMotion, joint_motion_at
from forcetorque.robot.tree import build_tree, joints_between
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from tests.scenes.experiments import JOINTS, PARQUET, edit

IMU_LINK = "forearm"
AGREEMENT = 0.05
"""N, N m: positions are interpolated and differentiated at 50 Hz once for the IMU and once for the way back."""


def _with_imu(recording: Recording, *, frame: str = IMU_LINK, rate: bool = False) -> Recording:
    """Add the streams of an IMU on the forearm of the arm, whose base stands still."""
    model = read_urdf(ARM_URDF)
    tree = build_tree(model, "base")
    stamps = recording.stream("joints").stamp_ns
    joints = joint_motion_at(recording, joints_between(tree, IMU_LINK), stamps, window=Processing().derivative_window)
    motion = motion_of_link(tree, joints, RootMotion.fixed([0, 0, -1]), IMU_LINK)
    columns = ("x", "y", "z")

    def signal(quantity: str, values: np.ndarray, unit: str) -> Signal:
        return Signal(quantity=quantity, values=values, columns=columns, units=(unit,) * 3, frame=frame)

    gyro = {"angular_velocity": signal("angular_velocity", motion.angular_velocity, "rad/s")}
    if rate:
        gyro["angular_acceleration"] = signal("angular_acceleration", motion.angular_acceleration, "rad/s2")
    accelerometer = {"proper_acceleration": signal("proper_acceleration", motion.proper_acceleration, "m/s2")}
    streams = {
        name: Stream(name=name, clock="simulation", stamp_ns=stamps, signals=signals)
        for name, signals in (("gyro", gyro), ("accelerometer", accelerometer))
    }
    return replace(recording, streams={**recording.streams, **streams})


def _reference(recording: Recording, support: Support | MovingSupport) -> tuple[np.ndarray, np.ndarray]:
    start = recording.start_ns
    interval = Interval(
        label="all", start_ns=start + 10**9, end_ns=start + 20 * 10**9, use=Use.CALIBRATION, support=support
    )
    samples = sensor_samples(
        recording,
        read_urdf(ARM_URDF),
        sensor="arm_ft",
        stream="arm_ft",
        quantity="raw",
        interval=interval,
        processing=Processing(),
    )
    return samples.stamp_ns, samples.reference


@pytest.mark.parametrize("rate", [False, True], ids=["derivative of the gyro", "angular acceleration"])
def test_the_imu_gives_what_the_fixed_base_gives(arm: Path, rate: bool) -> None:
    """The motion of a forearm, carried back to the resting base, demands the same of the sensor as gravity there."""
    recording = _with_imu(read_recording(arm / "recording"), rate=rate)
    at, fixed = _reference(recording, Support(frame="base", gravity_direction=[0, 0, -1]))
    moving_at, moving = _reference(recording, MovingSupport(frame="base", motion_streams=("gyro", "accelerometer")))
    common = np.isin(at, moving_at)
    assert np.count_nonzero(common) > 900
    difference = np.abs(moving[np.isin(moving_at, at)] - fixed[common])
    assert np.sqrt((difference**2).mean()) < AGREEMENT
    assert np.ptp(fixed[:, :3], axis=0).max() > 30.0  # the wrench itself is far larger


def test_an_experiment_names_the_imus_streams(arm: Path) -> None:
    """The experiment file with `imu` loads, and its sensor can be compared with the model."""
    recording = _with_imu(read_recording(arm / "recording"))
    write_recording(arm / "recording", recording)
    path = edit(arm / PARQUET, "gravity_direction = [0.0, 0.0, -1.0]", 'imu = ["gyro", "accelerometer"]')
    support = load_experiment(path).recording.intervals[0].support
    assert isinstance(support, MovingSupport)
    assert support.motion_streams == ("gyro", "accelerometer")


@pytest.mark.parametrize(
    ("streams", "frame", "match"),
    [
        (("gyro",), IMU_LINK, "expected proper_acceleration and angular_velocity"),
        (("joints",), IMU_LINK, "got neither"),
        (("gyro", "gyro"), IMU_LINK, "keep one"),
        (("gyro", "accelerometer"), "elbow_board", "no link of robot 'arm'"),
        (("gyro", "nothing"), IMU_LINK, "no stream 'nothing'"),
    ],
)
def test_incomplete_imus_are_refused(arm: Path, streams: tuple[str, ...], frame: str, match: str) -> None:
    """Missing, doubled or unknown signals and frames are an error that names them."""
    recording = _with_imu(read_recording(arm / "recording"), frame=frame)
    with pytest.raises(ForceTorqueError, match=match):
        _reference(recording, MovingSupport(frame="base", motion_streams=streams))


SUPPORT = '[[support]]\nframe = "base"\ngravity_direction = [0.0, 0.0, -1.0]\n'


def _touched(arm: Path, links: str, recording: Recording | None = None) -> Path:
    """The experiment whose first interval names links that touch, and no support anywhere."""
    if recording is not None:
        write_recording(arm / "recording", recording)
    path = arm / PARQUET
    text = path.read_text(encoding="utf-8").replace(SUPPORT, "").replace('support = "base"', f"contact_links = {links}")
    assert "[[support]]" not in text
    path.write_text(text, encoding="utf-8")
    return path


def test_links_that_touch_need_no_support(arm: Path) -> None:
    """The first stands for the support, the IMU of the recording tells its motion, the others are contacts there."""
    path = _touched(arm, '["base", "hand"]', _with_imu(read_recording(arm / "recording")))
    experiment = load_experiment(path)
    for interval in experiment.recording.intervals:
        assert isinstance(interval.support, MovingSupport)
        assert (interval.support.frame, set(interval.support.motion_streams)) == ("base", {"gyro", "accelerometer"})
        assert [entry.contact.link for entry in contacts_in(interval, experiment.contacts)] == ["hand"]
    assert len(experiment.recording.intervals) > 1


def test_a_contact_that_is_stated_is_not_added_again(arm: Path) -> None:
    """Its type is what the file says."""
    path = _touched(arm, '["base", "hand"]', _with_imu(read_recording(arm / "recording")))
    path.write_text(path.read_text(encoding="utf-8") + '\n[[contact]]\nframe = "hand"\ntype = "force"\n')
    (entry,) = load_experiment(path).contacts
    assert (entry.contact.link, str(entry.contact.type)) == ("hand", "force")


@pytest.mark.parametrize(
    ("links", "match"),
    [
        ('["base", "nose"]', r"contact_links: robot 'arm' has no link 'nose'"),
        ("[]", "at least 1 value"),
        ('["base"]\nsupport = "base"', "expected support or contact_links, got both"),
    ],
)
def test_what_touches_is_a_link_and_no_support(arm: Path, links: str, match: str) -> None:
    """Each wrong word is named."""
    path = _touched(arm, links, _with_imu(read_recording(arm / "recording")))
    with pytest.raises(ForceTorqueError, match=match):
        load_experiment(path)


def test_without_an_imu_nobody_knows_how_a_touched_robot_moves(arm: Path) -> None:
    """Nothing is taken for level or still."""
    with pytest.raises(ForceTorqueError, match="expected an IMU in the recording"):
        load_experiment(_touched(arm, '["base"]'))


def test_of_two_imus_the_file_must_name_one(arm: Path) -> None:
    """As a support, which names its streams."""
    recording = _with_imu(read_recording(arm / "recording"))
    gyro = recording.stream("gyro")
    double = {**recording.streams, "gyro_2": replace(gyro, name="gyro_2")}
    with pytest.raises(ForceTorqueError, match="'gyro' and 'gyro_2'; keep one"):
        load_experiment(_touched(arm, '["base"]', replace(recording, streams=double)))


def test_a_joint_between_imu_and_support_is_needed(arm: Path) -> None:
    """The way from the forearm to the base passes the elbow, whose absence is an error that names it."""
    recording = _with_imu(read_recording(arm / "recording"))
    joints = recording.stream("joints")
    position = joints.signal("position")
    keep = [k for k, name in enumerate(JOINTS) if name != "elbow"]
    less = replace(
        position,
        values=position.values[:, keep],
        columns=tuple(JOINTS[k] for k in keep),
        units=tuple(position.units[k] for k in keep),
    )
    streams = {**recording.streams, "joints": replace(joints, signals={"position": less})}
    with pytest.raises(ForceTorqueError, match="'elbow'"):
        _reference(
            replace(recording, streams=streams),
            MovingSupport(frame="base", motion_streams=("gyro", "accelerometer")),
        )


def test_a_moving_support_is_stored(arm: Path, tmp_path: Path) -> None:
    """Intervals with an IMU read back from the project's own form."""
    recording = _with_imu(read_recording(arm / "recording"))
    support = MovingSupport(frame="base", motion_streams=("gyro", "accelerometer"))
    interval = Interval(label="a", start_ns=0, end_ns=1, use=Use.VALIDATION, support=support)
    write_recording(tmp_path / "again", recording.with_intervals([interval]))
    (read,) = read_recording(tmp_path / "again").intervals
    assert isinstance(read.support, MovingSupport)
    assert (read.support.frame, read.support.motion_streams) == ("base", ("gyro", "accelerometer"))
