# SPDX-License-Identifier: BSD-3-Clause
"""Bags that rosbags wrote are read back in all three forms; what is unclear is refused or a finding."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FormatError, MissingExtraError, MissingFileError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.ros import bag
from forcetorque.formats.ros.log_format import RosFormat, RosLog
from tests.formats.ros.bags import FORMS, PERIOD_NS, START_NS, TF, Types, write_bag

ROWS = 30
RNG = np.random.default_rng(4)
WRENCHES = RNG.normal(size=(ROWS, 6))
POSITIONS = RNG.normal(size=(ROWS, 3))
ROTATIONS = Rotation.random(ROWS, random_state=5).as_quat()
STAMPS = START_NS + PERIOD_NS * np.arange(ROWS)
EMPTY = np.zeros(0)
KINDS = {name: f"{package}/msg/{name}" for package, name in [("geometry_msgs", "WrenchStamped")]} | {
    name: f"sensor_msgs/msg/{name}" for name in ("JointState", "Imu", "Temperature")
}


def _topics(form: str) -> dict[str, tuple[str, list[Any]]]:
    types = Types(form)
    names = ["a", "b", "c"]
    joints = [
        # every other message has another order, as with two publishers on one topic
        types.joints(k, names[::-1], row[::-1].copy(), row[::-1].copy(), EMPTY)
        if k % 2
        else types.joints(k, names, row, row, EMPTY)
        for k, row in enumerate(POSITIONS)
    ]
    turns = [
        types.transforms(k, {("world", "base"): (0, 0, 0, 1), ("base", "sole"): row}) for k, row in enumerate(ROTATIONS)
    ]
    return {
        "/ft": (KINDS["WrenchStamped"], [types.wrench(k, row) for k, row in enumerate(WRENCHES)]),
        "/joint_states": (KINDS["JointState"], joints),
        "/imu": (KINDS["Imu"], [types.imu(k, row) for k, row in enumerate(WRENCHES)]),
        "/warm": (KINDS["Temperature"], [types.temperature(k, row[0]) for k, row in enumerate(WRENCHES)]),
        "/tf": (TF, turns),
    }


@pytest.fixture(scope="module", params=FORMS)
def written(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bag with every message that is read."""
    form: str = request.param
    return write_bag(tmp_path_factory.mktemp(form), form, _topics(form))


def _read(path: Path, *streams: dict[str, Any], joint_units: dict[str, str] | None = None) -> LogReading:
    stated = RosLog.model_validate({"format": "ros", "path": path.name, "stream": streams})
    context = ExperimentContext(
        experiment=path.parent / "x.toml",
        inputs=Inputs(path.parent),
        sensors={"wrist": "wrist_ft"},
        joint_units=joint_units or {},
    )
    reading = RosFormat().read(stated, context)
    assert context.inputs.names()
    return reading


def test_every_message_is_read_back(written: Path) -> None:
    """Numbers and stamps to the last bit, in SI units, in the frame of the sensor or else of the messages."""
    entries = {"wrist": "/ft", "joints": "/joint_states", "imu": "/imu", "warm": "/warm"}
    reading = _read(written, *({"name": name, "topic": topic} for name, topic in entries.items()))
    wrist, joints, imu, warm = reading.streams
    for stream in reading.streams:
        np.testing.assert_array_equal(stream.stamp_ns, STAMPS)
        assert stream.clock == "ros"
    np.testing.assert_array_equal(wrist.signal("wrench").values, WRENCHES)
    assert wrist.signal("wrench").frame == "wrist_ft"
    np.testing.assert_array_equal(imu.signal("angular_velocity").values, WRENCHES[:, :3])
    np.testing.assert_array_equal(imu.signal("proper_acceleration").values, WRENCHES[:, 3:])
    assert imu.signal("proper_acceleration").frame == "imu"
    np.testing.assert_array_equal(warm.signal("temperature").values, WRENCHES[:, :1])
    assert reading.findings == ()


def test_joints_go_by_name(written: Path) -> None:
    """Whatever order a message has; a quantity that no message has is not there; units are those of the robot."""
    (joints,) = _read(written, {"name": "q", "topic": "/joint_states"}, joint_units={"b": "m"}).streams
    assert joints.signal("position").columns == ("a", "b", "c")
    assert joints.signal("position").units == ("rad", "m", "rad")
    assert joints.signal("velocity").units == ("rad/s", "m/s", "rad/s")
    np.testing.assert_array_equal(joints.signal("position").values, POSITIONS)
    np.testing.assert_array_equal(joints.signal("velocity").values, POSITIONS)
    assert set(joints.signals) == {"position", "velocity"}


def test_tf_gives_gravity_in_the_support_frame(written: Path) -> None:
    """The rotation of the child, and gravity along its axes: down in the world, which is z."""
    entry = {"name": "sole", "topic": "/tf", "frame": "sole", "world": "base"}
    (stream,) = _read(written, entry).streams
    rotations = Rotation.from_quat(ROTATIONS)
    expected = rotations.as_matrix()
    np.testing.assert_allclose(stream.signal("orientation").values, expected.reshape(-1, 9), atol=1e-14)
    gravity = rotations.inv().apply([0.0, 0.0, -STANDARD_GRAVITY])
    np.testing.assert_allclose(stream.signal("gravity").values, gravity, atol=1e-13)
    np.testing.assert_array_equal(stream.signal("translation").values, [[1.0, 2.0, 3.0]] * ROWS)
    (chained,) = _read(written, entry | {"world": "world"}).streams
    np.testing.assert_allclose(chained.signal("gravity").values, gravity, atol=1e-12)
    np.testing.assert_allclose(chained.signal("translation").values, [[2.0, 4.0, 6.0]] * ROWS, atol=1e-14)
    with pytest.raises(FormatError, match="expected poses of sole in map, got base -> sole, world -> base"):
        _read(written, entry | {"world": "map"})
    with pytest.raises(FormatError, match="expected frame and world for poses"):
        _read(written, {"name": "sole", "topic": "/tf", "frame": "sole"})


def test_it_is_described(written: Path) -> None:
    """Everything but tf and the orientations of an IMU is a stream; the table is what a file may state."""
    known = recognised_format(written)
    assert isinstance(known, RosFormat)
    description = known.describe(written)
    assert [stream.name for stream in description.reading.streams] == ["/ft", "/imu", "/joint_states", "/warm"]
    findings = description.reading.findings
    assert [(finding.kind, finding.stream) for finding in findings] == [("not_read", "/imu"), ("not_read", "/tf")]
    again = _read(written, *(entry.model_dump() for entry in description.table.stream))
    for stream, other in zip(description.reading.streams, again.streams, strict=True):
        np.testing.assert_array_equal(stream.stamp_ns, other.stamp_ns)
        for quantity, signal in stream.signals.items():
            np.testing.assert_array_equal(signal.values, other.signal(quantity).values)


@pytest.mark.parametrize("form", ["sqlite3", "mcap"])
def test_a_file_of_a_bag_is_a_bag(tmp_path: Path, form: str) -> None:
    """Without its folder's index too; under another name it says how it must be called."""
    folder = write_bag(tmp_path, form, {"/ft": _topics(form)["/ft"]})
    (file,) = (path for path in folder.iterdir() if path.suffix in (".db3", ".mcap"))
    (stream,) = _read(file, {"name": "wrist", "topic": "/ft"}).streams
    np.testing.assert_array_equal(stream.signal("wrench").values, WRENCHES)
    other = file.rename(tmp_path / "log.bin")
    with pytest.raises(FormatError, match=rf"expected a name that ends in {file.suffix}"):
        RosFormat().describe(other)


def test_batches_do_not_matter(written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """However many messages are held at a time, samples keep their order."""
    monkeypatch.setattr(bag, "BATCH_MESSAGES", 7)
    test_every_message_is_read_back(written)
    test_joints_go_by_name(written)


@pytest.mark.parametrize("form", FORMS)
def test_counters_of_ros_1_are_kept(tmp_path: Path, form: str) -> None:
    """ROS 2 has none."""
    path = write_bag(tmp_path, form, {"/ft": _topics(form)["/ft"]})
    (stream,) = _read(path, {"name": "wrist", "topic": "/ft"}).streams
    if form == "bag":
        assert stream.sequence is not None
        np.testing.assert_array_equal(stream.sequence, np.arange(1, ROWS + 1))
    else:
        assert stream.sequence is None


@pytest.mark.parametrize("form", FORMS)
def test_messages_without_stamps_take_those_of_the_recorder(tmp_path: Path, form: str) -> None:
    """With a finding, for the transport is in them."""
    types = Types(form)
    messages = [types.wrench(k, row, stamped=False) for k, row in enumerate(WRENCHES)]
    path = write_bag(tmp_path, form, {"/ft": (KINDS["WrenchStamped"], messages)})
    reading = _read(path, {"name": "wrist", "topic": "/ft"})
    np.testing.assert_array_equal(reading.streams[0].stamp_ns, STAMPS + 5)
    assert [finding.kind for finding in reading.findings] == ["recorder_stamp"]


@pytest.mark.parametrize("form", FORMS)
def test_two_frames_on_one_topic_are_refused(tmp_path: Path, form: str) -> None:
    """Unless it is stated which it is; lengths of frames may differ too."""
    types = Types(form)
    messages = [types.wrench(k, row, "left" if k % 2 else "right_tool") for k, row in enumerate(WRENCHES)]
    path = write_bag(tmp_path, form, {"/ft": (KINDS["WrenchStamped"], messages)})
    with pytest.raises(FormatError, match="expected messages of one frame, got 'left', 'right_tool'; specify it"):
        _read(path, {"name": "other", "topic": "/ft"})
    (stream,) = _read(path, {"name": "wrist", "topic": "/ft"}).streams
    np.testing.assert_array_equal(stream.signal("wrench").values, WRENCHES)


@pytest.mark.parametrize("form", FORMS)
def test_what_an_imu_does_not_measure_is_left_out(tmp_path: Path, form: str) -> None:
    """A covariance that begins with -1 is how drivers say so."""
    types = Types(form)
    messages = [types.imu(k, row, covariance=-1.0) for k, row in enumerate(WRENCHES)]
    path = write_bag(tmp_path, form, {"/imu": (KINDS["Imu"], messages)})
    (stream,) = _read(path, {"name": "imu", "topic": "/imu"}).streams
    assert set(stream.signals) == {"proper_acceleration"}


def test_unknown_topics_and_types_are_named(written: Path, tmp_path: Path) -> None:
    """By what there is."""
    with pytest.raises(FormatError, match=r"no topic '/FT'; did you mean \"/ft\"\?"):
        _read(written, {"name": "wrist", "topic": "/FT"})
    types = Types("mcap")
    path = write_bag(tmp_path, "mcap", {"/h": ("std_msgs/msg/Header", [types.header(0, "a")])})
    with pytest.raises(FormatError, match="nothing reads messages of std_msgs/msg/Header"):
        RosFormat().describe(path)
    with pytest.raises(MissingFileError):
        _read(tmp_path / "log.mcap", {"name": "wrist", "topic": "/ft"})


def _truncate(data: bytes) -> bytes:
    return data[: len(data) // 2]


def _nothing(data: bytes) -> bytes:
    return data[:16]


@pytest.mark.parametrize("damage", [_truncate, _nothing])
@pytest.mark.parametrize("form", FORMS)
def test_damaged_bags_are_refused(tmp_path: Path, form: str, damage: Callable[[bytes], bytes]) -> None:
    """With our error, in one line."""
    path = write_bag(tmp_path, form, _topics(form))
    file = path if path.is_file() else next(p for p in path.iterdir() if p.suffix in (".db3", ".mcap"))
    file.write_bytes(damage(file.read_bytes()))
    with pytest.raises(FormatError) as error:
        RosFormat().describe(path)
    assert "\n" not in str(error.value)


def test_without_rosbags_the_error_says_what_to_install(written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The bag is recognised all the same."""
    monkeypatch.setitem(sys.modules, "rosbags.rosbag1", None)
    assert isinstance(recognised_format(written), RosFormat)
    with pytest.raises(MissingExtraError, match=r"bags are read by rosbags: pip install 'forcetorque\[ros\]'"):
        RosFormat().describe(written)
