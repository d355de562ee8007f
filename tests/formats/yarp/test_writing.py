# SPDX-License-Identifier: BSD-3-Clause
"""Recordings written as port folders read back through every reader, and nothing that was there is lost."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import MissingFileError, RecordingError
from forcetorque.formats.yarp import writing
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_inertial, read_state, read_state_ext
from forcetorque.formats.yarp.log_format import PortKind, discover_ports
from forcetorque.formats.yarp.measures import MeasuresList, MeasuresSensor, read_measures
from forcetorque.formats.yarp.writing import DevicePort, StreamPort, write_ports
from forcetorque.recording.orientation import ROLL_PITCH_YAW
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from tests.formats.yarp.port_logs import parse_nested, parse_slowly, read_text
from tests.recording.recordings import jittered_stamps, recording, refused, signal, stream
from tests.scenes.experiments import snapshot

N = 40
PRINTED = 1e-14
"""Relative error of 15 printed digits (5e-15 at most), and of a conversion to degrees and back (twice 1e-16)."""
JOINTS = ("hip", "knee", "slide")
FT = StreamPort(path="icub/leg/analog:o", kind=PortKind.ANALOG, stream="ft")
LEG = StreamPort(path="icub/leg/stateExt:o", kind=PortKind.STATE_EXT, stream="leg")


def _values(width: int, *, seed: int = 1) -> FloatArray:
    """Numbers of all sizes that a sensor may send, whole ones and zero among them."""
    rng = np.random.default_rng(seed)
    values = rng.normal(size=(N, width)) * 10.0 ** rng.integers(-9, 6, (N, width))
    values[3], values[4] = 0.0, 32.0
    return values


def _joint_signal(quantity: str, *, seed: int) -> Signal:
    units = {"position": ("rad", "rad", "m"), "velocity": ("rad/s", "rad/s", "m/s")}[quantity]
    return Signal(quantity=quantity, values=_values(3, seed=seed), columns=JOINTS, units=units)


def _ft(**changes: object) -> Stream:
    made = stream(
        jittered_stamps(N, seed=5),
        signal("wrench", _values(6)),
        name="ft",
        sequence=7 + np.delete(np.arange(N + 3), [3, 9, 10]),
    )
    return replace(made, **changes)  # type: ignore[arg-type]


def _leg(**changes: object) -> Stream:
    made = stream(
        jittered_stamps(N, seed=6), _joint_signal("position", seed=2), _joint_signal("velocity", seed=3), name="leg"
    )
    return replace(made, **changes)  # type: ignore[arg-type]


def _same(read: Stream, written: Stream, *quantities: str) -> None:
    """Stamps and sequence exactly, numbers to the printed digits."""
    assert read.stamp_ns.tolist() == written.stamp_ns.tolist()
    assert read.sequence is not None
    sequence = range(N) if written.sequence is None else written.sequence.tolist()
    assert read.sequence.tolist() == list(sequence)
    assert quantities
    for quantity in quantities:
        after, before = read.signal(quantity), written.signal(quantity)
        assert (after.columns, after.units) == (before.columns, before.units)
        # elements of a matrix are of the size of 1, whichever are near zero
        small = 10 * PRINTED if quantity == "orientation" else 0.0
        np.testing.assert_allclose(after.values, before.values, rtol=PRINTED, atol=small)


def test_a_force_torque_sensor_reads_back(tmp_path: Path) -> None:
    """Numbers, sequence with its jumps, and stamps to the nanosecond; a slow parser sees the same."""
    written = _ft()
    write_ports(tmp_path / "log", recording(written), [FT])
    reading = read_analog(tmp_path / "log" / FT.path, stream="ft", frame="frame")
    assert reading.findings == ()
    _same(reading.stream, written, "wrench")
    lines = parse_slowly(read_text(tmp_path / "log" / FT.path))
    assert [line.stamps_ns[0] for line in lines] == written.stamp_ns.tolist()
    slow = np.array([[float(number) for number in line.numbers] for line in lines])
    np.testing.assert_array_equal(reading.stream.signal("wrench").values, slow)
    assert lines[4].numbers == ("32.0",) * 6


def test_another_number_is_noticed(tmp_path: Path) -> None:
    """Negative control: one number off by a part in 10^12 is not the same."""
    written = _ft()
    write_ports(tmp_path / "log", recording(written), [FT])
    read = read_analog(tmp_path / "log" / FT.path, stream="ft", frame="frame").stream
    values = np.array(written.signal("wrench").values)
    values[20, 3] *= 1.0 + 1e-12
    with pytest.raises(AssertionError, match="Mismatched elements: 1 /"):
        _same(read, _ft(signals={"wrench": signal("wrench", values)}), "wrench")


def test_counts_of_a_board_that_does_not_calibrate_are_written_as_they_are(tmp_path: Path) -> None:
    """Six channels of raw stand where a wrench would; the reader cannot know."""
    counts = np.rint(_values(6))
    write_ports(tmp_path / "log", recording(_ft(signals={"raw": signal("raw", counts)})), [FT])
    read = read_analog(tmp_path / "log" / FT.path, stream="ft", frame="frame").stream
    np.testing.assert_array_equal(read.signal("wrench").values, counts)


def test_joints_read_back_in_radians_and_metres(tmp_path: Path) -> None:
    """Rotary joints go through degrees, prismatic ones do not; what the stream lacks is not estimated."""
    written = _leg()
    write_ports(tmp_path / "log", recording(written), [LEG])
    folder = tmp_path / "log" / LEG.path
    reading = read_state_ext(folder, stream="leg", joints=JOINTS, joint_units={"slide": "m"})
    _same(reading.stream, written, "position", "velocity")
    assert [(finding.kind, finding.channel) for finding in reading.findings] == [("not_estimated", "acceleration")]
    first = parse_slowly(read_text(folder))[0]
    assert (len(first.lists), first.flags) == (11, ("ok",) * 11)
    degrees = np.rad2deg(written.signal("position").values[0])
    np.testing.assert_allclose([float(text) for text in first.lists[0][:2]], degrees[:2], rtol=PRINTED)
    assert float(first.lists[0][2]) == pytest.approx(written.signal("position").values[0, 2], rel=PRINTED)


def test_failed_groups_are_flagged(tmp_path: Path) -> None:
    """A quantity that is missing as a whole is a flag; the reader counts them and gives NaN there alone."""
    values = _values(3, seed=2)
    values[[5, 6, 30]] = np.nan
    position = replace(_joint_signal("position", seed=2), values=values)
    written = _leg(signals={"position": position, "velocity": _joint_signal("velocity", seed=3)})
    write_ports(tmp_path / "log", recording(written), [LEG])
    reading = read_state_ext(tmp_path / "log" / LEG.path, stream="leg", joints=JOINTS, joint_units={"slide": "m"})
    _same(reading.stream, written, "position", "velocity")
    found = {finding.kind: finding.count for finding in reading.findings}
    assert found == {"failed_group": 3, "not_estimated": N}


def test_positions_alone_and_an_inertial_sensor_read_back(tmp_path: Path) -> None:
    """The two older ports of plain numbers; angular velocity goes through degrees."""
    imu = stream(
        jittered_stamps(N, seed=8),
        signal("proper_acceleration", _values(3)),
        signal("angular_velocity", _values(3, seed=4)),
        name="imu",
    )
    leg = _leg()
    ports = [
        StreamPort(path="inertial", kind=PortKind.INERTIAL, stream="imu"),
        StreamPort(path="leg/state:o", kind=PortKind.STATE, stream="leg"),
    ]
    write_ports(tmp_path / "log", recording(imu, leg), ports)
    read = read_inertial(tmp_path / "log" / "inertial", stream="imu", frame="frame").stream
    _same(read, imu, "proper_acceleration", "angular_velocity")
    turned = read_inertial(tmp_path / "log" / "inertial", stream="imu", frame="frame", orientation=ROLL_PITCH_YAW)
    assert set(turned.stream.signals) == {"orientation", "gravity"}
    np.testing.assert_array_equal(turned.stream.signal("orientation").values, [np.eye(3).ravel()] * N)
    state = read_state(tmp_path / "log" / "leg/state:o", stream="leg", joints=JOINTS, joint_units={"slide": "m"}).stream
    _same(state, leg, "position")
    assert list(state.signals) == ["position"]


def _device(path: str = "icub/leg/measures:o") -> tuple[Recording, DevicePort]:
    """Two force-torque sensors with their thermometers and an IMU, in an order of their own."""
    stamps = jittered_stamps(N, seed=9)
    ticks = signal("device_stamp", 3.0e9 + np.arange(N)[:, None] * 10_003.0)
    turned = Rotation.random(N, random_state=6)
    streams = [
        stream(stamps, signal("wrench", _values(6, seed=1)), ticks, name="second"),
        stream(stamps, signal("wrench", _values(6, seed=2)), name="first"),
        stream(stamps, signal("temperature", 30 + _values(1, seed=3)), name="warmth"),
        stream(stamps, signal("angular_velocity", _values(3, seed=4)), name="gyro"),
        stream(stamps, signal("proper_acceleration", _values(3, seed=5)), name="accelerometer"),
        stream(stamps, signal("orientation", turned.as_matrix().reshape(N, 9)), name="turn"),
    ]
    ft = MeasuresList.SIX_AXIS_FORCE_TORQUE
    sensors = (
        MeasuresSensor(list=ft, index=1, stream="second", frame="frame"),
        MeasuresSensor(list=ft, index=0, stream="first", frame="frame"),
        MeasuresSensor(list=MeasuresList.TEMPERATURE, index=0, stream="warmth"),
        MeasuresSensor(list=MeasuresList.GYROSCOPE, index=0, stream="gyro", frame="frame"),
        MeasuresSensor(list=MeasuresList.ACCELEROMETER, index=0, stream="accelerometer", frame="frame"),
        MeasuresSensor(list=MeasuresList.ORIENTATION, index=0, stream="turn", frame="frame"),
    )
    return recording(*streams), DevicePort(path=path, sensors=sensors)


def test_a_device_with_several_sensors_reads_back(tmp_path: Path) -> None:
    """The same declaration writes and reads; every sensor stands in its place of its list, with its own stamp."""
    made, port = _device()
    write_ports(tmp_path / "log", made, [port])
    for reading, sensor in zip(
        read_measures(tmp_path / "log" / port.path, sensors=port.sensors), port.sensors, strict=True
    ):
        assert reading.findings == ()
        _same(reading.stream, made.stream(sensor.stream), sensor.quantity)
    (second, *_) = read_measures(tmp_path / "log" / port.path, sensors=port.sensors)
    ticks = made.stream("second").signal("device_stamp").values
    np.testing.assert_array_equal(second.stream.signal("device_stamp").values, ticks)
    _, stamp, *lists = parse_nested(read_text(tmp_path / "log" / port.path).splitlines()[4])
    assert [len(sensors) for sensors in lists] == [1, 1, 0, 1, 1, 2, 0, 0, 0, 0, 0, 0]
    assert lists[5][1] == [["32.0"] * 6, "3000040012.0"]
    assert lists[5][0][1] == stamp


def test_the_ports_are_found_without_being_told(tmp_path: Path) -> None:
    """What was written is recognised from its first message."""
    device, port = _device()
    made = replace(device, streams={**device.streams, "ft": _ft(), "leg": _leg()})
    write_ports(tmp_path / "log", made, [FT, LEG, port])
    found = {each.path: each.kind for each in discover_ports(tmp_path / "log")}
    assert found == {FT.path: PortKind.ANALOG, LEG.path: PortKind.STATE_EXT, port.path: PortKind.MEASURES}


def test_a_folder_of_logs_keeps_what_it_holds(tmp_path: Path) -> None:
    """A port is added beside others; nothing that was there changes."""
    write_ports(tmp_path / "log", recording(_ft()), [FT])
    (tmp_path / "log" / "icub" / "notes.txt").write_text("mine")
    before = snapshot(tmp_path)
    write_ports(tmp_path / "log", recording(_leg()), [LEG])
    after = snapshot(tmp_path)
    assert before.items() <= after.items()
    added = {"", "/data.log", "/info.log"}
    assert after.keys() - before.keys() == {f"log/{LEG.path}{name}" for name in added}


def test_a_log_is_never_written_over(tmp_path: Path) -> None:
    """A port that is there is refused before anything is written, also together with one that is not."""
    write_ports(tmp_path / "log", recording(_ft()), [FT])
    before = snapshot(tmp_path)
    with refused(RecordingError, "analog:o: exists; a log is never written over"):
        write_ports(tmp_path / "log", recording(_ft(), _leg()), [LEG, FT])
    assert snapshot(tmp_path) == before


@pytest.mark.parametrize("is_new", [True, False])
def test_all_ports_are_written_or_none(tmp_path: Path, is_new: bool) -> None:
    """The second port cannot be written: the first is not there either, nor anything temporary."""
    if not is_new:
        write_ports(tmp_path / "log", recording(_ft()), [StreamPort(path="other", kind=PortKind.ANALOG, stream="ft")])
    before = snapshot(tmp_path)
    values = _values(3)
    values[7, 1] = np.nan
    half = _leg(signals={"position": replace(_joint_signal("position", seed=2), values=values)})
    with refused(RecordingError, "sample 7 and 0 more lack the position of some joints"):
        write_ports(tmp_path / "log", recording(_ft(), half), [FT, LEG])
    assert snapshot(tmp_path) == before


def test_a_move_that_fails_half_way_is_undone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The system refuses the second folder: the first and the folders made for it are gone again."""
    write_ports(tmp_path / "log", recording(_ft()), [StreamPort(path="other", kind=PortKind.ANALOG, stream="ft")])
    before = snapshot(tmp_path)
    rename = Path.rename
    moved: list[str] = []

    def fails_second(self: Path, target: Path) -> Path:
        if moved:
            raise OSError("disk full")
        moved.append(self.name)
        return rename(self, target)

    monkeypatch.setattr(writing.Path, "rename", fails_second)
    with pytest.raises(OSError, match="disk full"):
        write_ports(tmp_path / "log", recording(_ft(), _leg()), [FT, LEG])
    assert moved == ["analog:o"]
    assert snapshot(tmp_path) == before


def _none(quantity: str, width: int) -> Signal:
    values = _values(width)
    values[4, 0] = np.inf
    return signal(quantity, values)


_TWO = signal("position", _values(2))
REFUSED = {
    "no ports": (recording(_ft()), [], "ports: expected at least one"),
    "another stream": (recording(_ft()), [LEG], "no stream 'leg'; known: ft"),
    "two in one folder": (recording(_ft()), [FT, FT], "lie in each other"),
    "one in the other": (recording(_ft()), [FT, replace(FT, path=f"{FT.path}/x")], "lie in each other"),
    "no wrench": (recording(_leg(name="ft")), [FT], "expected a wrench or six channels of raw, got neither"),
    "five channels": (recording(_ft(signals={"raw": signal("raw", _values(5))})), [FT], "got 5 columns of raw"),
    "wrench and counts": (
        recording(_ft(signals={"raw": signal("raw", _values(6)), "wrench": signal("wrench", _values(6))})),
        [FT],
        "got 6 columns of wrench and 6 columns of raw",
    ),
    "a missing wrench": (
        recording(_ft(signals={"wrench": _none("wrench", 6)})),
        [FT],
        "sample 4 and 0 more lack a value",
    ),
    "no joints": (recording(_ft(name="leg")), [LEG], "has no position"),
    "other joints": (
        recording(_leg(signals={"position": _TWO, "velocity": _joint_signal("velocity", seed=3)})),
        [LEG],
        "expected the velocity of a, b as of the position, got hip, knee, slide",
    ),
    "no sample": (recording(stream([], signal("wrench", np.zeros((0, 6))), name="ft")), [FT], "holds no sample"),
    "before the epoch": (recording(_ft(stamp_ns=np.arange(N) - 5)), [FT], "expected stamps after the epoch, got -5 ns"),
    "no envelope": (recording(_ft(sequence=np.arange(N) - 1)), [FT], "expected sequence numbers from 0 .* -1 to 38"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_log_cannot_say_is_refused(tmp_path: Path, name: str) -> None:
    """One line says what does not fit, and nothing is written."""
    made, ports, message = REFUSED[name]
    with refused(RecordingError, message):
        write_ports(tmp_path / "log", made, ports)
    assert snapshot(tmp_path) == {}


def test_sensors_of_one_device_share_their_messages(tmp_path: Path) -> None:
    """Streams with other stamps or sequence numbers cannot be in the same messages."""
    made, port = _device()
    gyro = made.stream("gyro")
    for changed in (replace(gyro, stamp_ns=gyro.stamp_ns + 1), replace(gyro, sequence=np.arange(N))):
        with refused(RecordingError, "expected the streams 'second' and 'gyro' to share their stamps"):
            write_ports(tmp_path / "log", replace(made, streams={**made.streams, "gyro": changed}), [port])


def test_a_folder_needs_a_place(tmp_path: Path) -> None:
    """The parent must be there, and no file may be in the way."""
    with refused(MissingFileError, "expected an existing folder to write to"):
        write_ports(tmp_path / "a" / "log", recording(_ft()), [FT])
    (tmp_path / "log").mkdir()
    (tmp_path / "log" / "icub").write_text("a file")
    with refused(RecordingError, "icub: expected a folder or nothing, got a file"):
        write_ports(tmp_path / "log", recording(_ft()), [FT])


@pytest.mark.parametrize("path", ["", "/etc/port", "../port", "a/../../b", "a\\b"])
def test_a_port_lies_below_the_folder_of_logs(path: str) -> None:
    """No path leads out of it."""
    with refused(RecordingError, "expected a path below the folder of logs"):
        StreamPort(path=path, kind=PortKind.ANALOG, stream="ft")


def test_ports_are_declared_in_full() -> None:
    """A device is no stream, and its lists have no holes."""
    with refused(RecordingError, "expected one of analog, state_ext, state, inertial, got 'measures'"):
        StreamPort(path="p", kind=PortKind.MEASURES, stream="ft")
    with refused(RecordingError, "expected at least one sensor"):
        DevicePort(path="p", sensors=())
    warm = MeasuresList.TEMPERATURE
    with refused(RecordingError, "expected the indices 0 to 1 in the list temperature, each once, got 0, 2"):
        DevicePort(path="p", sensors=tuple(MeasuresSensor(list=warm, index=k, stream=f"t{k}") for k in (0, 2)))


@pytest.mark.real_data
def test_logs_of_a_real_robot_read_back_the_same(tmp_path: Path, data_dir: Path) -> None:
    """What a robot logged, written and read again, is the same to the bit for the sensor, to rounding for joints."""
    folder = data_dir / "icub_genova02_yoga" / "dumperLeftLegNoIMU" / "icub"
    joints = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")
    ft = read_analog(folder / "right_leg" / "analog:o", stream="ft", frame="frame").stream
    leg = read_state_ext(folder / "right_leg" / "stateExt:o", stream="leg", joints=joints).stream
    write_ports(tmp_path / "log", recording(ft, leg), [FT, LEG])
    again = read_analog(tmp_path / "log" / FT.path, stream="ft", frame="frame").stream
    assert len(again) > 7000
    np.testing.assert_array_equal(again.stamp_ns, ft.stamp_ns)
    np.testing.assert_array_equal(again.sequence, ft.sequence)
    np.testing.assert_array_equal(again.signal("wrench").values, ft.signal("wrench").values)
    moved = read_state_ext(tmp_path / "log" / LEG.path, stream="leg", joints=joints).stream
    assert list(moved.signals) == list(leg.signals)
    for name, kept in leg.signals.items():
        np.testing.assert_allclose(moved.signal(name).values, kept.values, rtol=PRINTED, atol=0.0)
