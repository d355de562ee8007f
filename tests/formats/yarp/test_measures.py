# SPDX-License-Identifier: BSD-3-Clause
"""Logs of devices with several sensors: which numbers belong to whom, and what is refused."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import permutations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.measures import READ_LISTS, MeasuresList, MeasuresSensor, read_measures
from forcetorque.recording.stream import QUANTITIES
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, parse_nested, write_port
from tests.fuzzing import examples

ONE_SENSOR = (
    "1277 1648477185.597940 () () () () (((32.0) 3062439114.0)) "
    "(((30.0 30.0 60.0 -15.0 -14.0 -13.0) 3062439114.0))()()()()()  \n"
)
"""Published example of the port of a device with one sensor, eleven lists."""
TWO_SENSORS = (
    "4714 1648546986.847330 () () () () (((31.0) 8627844988.0) ((33.0) 8627845987.0)) "
    "(((30.0 0.0 -60.0 -1.0 -1.0 -1.0) 8627844988.0) "
    "((0.256134033203125 0.66009521484375 -3.583465576171875 0.0064697265625 0.067291259765625 -0.043487548828125) "
    "8627845987.0)) () () () ()\n"
)
"""Published example of two sensors, ten lists."""

_READ = {
    MeasuresList.GYROSCOPE: ("angular_velocity", 3, math.pi / 180),
    MeasuresList.ACCELEROMETER: ("proper_acceleration", 3, 1.0),
    MeasuresList.TEMPERATURE: ("temperature", 1, 1.0),
    MeasuresList.SIX_AXIS_FORCE_TORQUE: ("wrench", 6, 1.0),
}
"""Quantity, numbers and factor to SI of each list that is read number by number."""
_PLACES = {
    MeasuresList.GYROSCOPE: 0,
    MeasuresList.ACCELEROMETER: 1,
    MeasuresList.TEMPERATURE: 4,
    MeasuresList.SIX_AXIS_FORCE_TORQUE: 5,
}
"""Where YARP's definition of the messages has these lists."""


def _sensor(name: str, index: int = 0, stream: str | None = None) -> MeasuresSensor:
    has_frame = QUANTITIES[_READ[MeasuresList(name)][0]].has_frame
    stream = stream or f"{name}_{index}"
    return MeasuresSensor(list=MeasuresList(name), index=index, stream=stream, frame="board" if has_frame else None)


def _line(k: int, lists: Mapping[int, Sequence[tuple[Sequence[float], float]]], *, n_lists: int = 12) -> str:
    """Write message k with sensors in some of its lists."""
    texts = [
        "(" + " ".join(f"(({' '.join(map(repr, vector))}) {stamp!r})" for vector, stamp in lists.get(place, ())) + ")"
        for place in range(n_lists)
    ]
    return f"{k} {10 + k}.250000 {' '.join(texts)}\n"


def _read(
    folder: Path, text: str, sensors: Sequence[MeasuresSensor], info: str | None = INFO
) -> dict[str, StreamReading]:
    readings = read_measures(write_port(folder, text, info=info), sensors=sensors)
    assert [reading.stream.name for reading in readings] == [sensor.stream for sensor in sensors]
    return {reading.stream.name: reading for reading in readings}


def _values(reading: StreamReading, quantity: str) -> list[list[float]]:
    return reading.stream.signal(quantity).values.tolist()  # type: ignore[no-any-return]


def test_the_published_example_of_one_sensor(tmp_path: Path) -> None:
    """Eleven lists, no space between the last ones, two spaces at the end of the line."""
    readings = _read(tmp_path, ONE_SENSOR, [_sensor("six_axis_force_torque"), _sensor("temperature")])
    reading = readings["six_axis_force_torque_0"]
    assert list(reading.stream.signals) == ["wrench", "device_stamp"]
    assert _values(reading, "wrench") == [[30.0, 30.0, 60.0, -15.0, -14.0, -13.0]]
    wrench = reading.stream.signal("wrench")
    assert (wrench.frame, wrench.units) == ("board", ("N", "N", "N", "N m", "N m", "N m"))
    assert reading.stream.stamp_ns.tolist() == [1648477185_597940000]
    assert reading.stream.sequence is not None
    assert reading.stream.sequence.tolist() == [1277]
    assert reading.stream.clock == "yarp"
    assert reading.findings == ()
    temperature = readings["temperature_0"].stream
    assert temperature.signal("temperature").values.tolist() == [[32.0]]
    assert temperature.signal("temperature").frame is None
    for stream in (reading.stream, temperature):
        assert stream.signal("device_stamp").values.tolist() == [[3062439114.0]]
        assert stream.signal("device_stamp").units == ("tick",)


def test_the_published_example_of_two_sensors(tmp_path: Path) -> None:
    """Each index gives its own numbers and the stamp of its own board."""
    names = ("six_axis_force_torque", "temperature")
    readings = _read(tmp_path, TWO_SENSORS, [_sensor(name, index) for name in names for index in range(2)])
    second = [
        0.256134033203125, 0.66009521484375, -3.583465576171875,
        0.0064697265625, 0.067291259765625, -0.043487548828125,
    ]  # fmt: skip
    assert _values(readings["six_axis_force_torque_0"], "wrench") == [[30.0, 0.0, -60.0, -1.0, -1.0, -1.0]]
    assert _values(readings["six_axis_force_torque_1"], "wrench") == [second]
    assert _values(readings["temperature_0"], "temperature") == [[31.0]]
    assert _values(readings["temperature_1"], "temperature") == [[33.0]]
    stamps = [_values(reading, "device_stamp") for reading in readings.values()]
    assert stamps == [[[8627844988.0]], [[8627845987.0]]] * 2


def test_the_lists_have_the_order_of_their_definition() -> None:
    """Checked by hand against SensorStreamingData.thrift of YARP; a list out of place would give wrong numbers."""
    assert [str(name) for name in MeasuresList] == [
        "gyroscope", "accelerometer", "magnetometer", "orientation", "temperature", "six_axis_force_torque",
        "contact_load_cell", "encoder", "skin", "position", "linear_velocity", "angular_acceleration",
    ]  # fmt: skip


@pytest.mark.parametrize("n_lists", [9, 10, 11, 12, 13])
def test_every_list_gives_its_quantity_whatever_their_number(tmp_path: Path, n_lists: int) -> None:
    """Sensors of every list at once; each list holds other numbers, so none can stand in for another."""
    width = {place: _READ[name][1] for name, place in _PLACES.items()}
    lists = {
        place: [([100.0 * place + 10 * i + j for j in range(width.get(place, 4))], 1e6 + place) for i in range(3)]
        for place in range(n_lists)
    }
    sensors = [_sensor(name, index) for name in _READ for index in range(3)]
    readings = _read(tmp_path, _line(0, lists, n_lists=n_lists), sensors)
    assert len(readings) == 12
    for sensor in sensors:
        quantity, n, factor = _READ[sensor.list]
        place = _PLACES[sensor.list]
        expected = [(100.0 * place + 10 * sensor.index + j) * factor for j in range(n)]
        assert _values(readings[sensor.stream], quantity) == [expected]
        assert _values(readings[sensor.stream], "device_stamp") == [[1e6 + place]]
    swapped = lists | {0: lists[1], 1: lists[0]}
    (wrong,) = read_measures(write_port(tmp_path, _line(0, swapped, n_lists=n_lists)), sensors=sensors[:1])
    assert _values(wrong, "angular_velocity") != _values(readings[sensors[0].stream], "angular_velocity")


def test_the_order_in_which_sensors_are_named_does_not_matter(tmp_path: Path) -> None:
    """All orders of three sensors, one of them not wanted: streams follow the names, not the places."""
    lists = {4: [([20.0 + i], 5.0 + i) for i in range(2)], 5: [([1.0 * i] * 6, 7.0 + i) for i in range(2)]}
    text = "".join(_line(k, lists) for k in range(3))
    sensors = [_sensor("temperature", 1), _sensor("six_axis_force_torque", 1), _sensor("six_axis_force_torque", 0)]
    seen = 0
    for order in permutations(sensors):
        readings = _read(tmp_path, text, order)
        assert _values(readings["temperature_1"], "temperature") == [[21.0]] * 3
        assert _values(readings["six_axis_force_torque_1"], "wrench") == [[1.0] * 6] * 3
        assert _values(readings["six_axis_force_torque_0"], "device_stamp") == [[7.0]] * 3
        seen += 1
    assert seen == 6


_FLOATS = st.floats(-1e9, 1e9, allow_nan=False)
_MESSAGES = st.lists(
    st.tuples(*(st.tuples(st.lists(_FLOATS, min_size=n, max_size=n), _FLOATS) for n in (3, 1, 6, 6))),
    min_size=1,
    max_size=5,
)


@pytest.mark.fuzz
@given(messages=_MESSAGES, data=st.data())
@settings(max_examples=examples(150), deadline=None)
def test_spaces_between_brackets_may_be_missing(
    tmp_path_factory: pytest.TempPathFactory, messages: list[Any], data: st.DataObject
) -> None:
    """Whichever of them are missing in whichever line, the numbers are those of a second parser and of the message."""
    lines = []
    for k, (gyroscope, temperature, *wrenches) in enumerate(messages):
        head, _, body = _line(k, {0: [gyroscope], 4: [temperature], 5: wrenches}, n_lists=10).partition(" (")
        parts = re.split(r"(?<=\)) | (?=\()", "(" + body)
        gaps = data.draw(st.lists(st.sampled_from(["", " ", "  "]), min_size=len(parts) - 1, max_size=len(parts) - 1))
        tight = "".join(part + gap for part, gap in zip(parts, [*gaps, ""], strict=True))
        lines.append(f"{head} {tight}")
    folder = tmp_path_factory.getbasetemp() / "spaces"
    sensors = [_sensor("gyroscope"), _sensor("temperature"), *(_sensor("six_axis_force_torque", i) for i in range(2))]
    readings = _read(folder, "".join(lines), sensors)
    for row, (line, message) in enumerate(zip(lines, messages, strict=True)):
        _, _, *parsed = parse_nested(line.strip())
        found = [parsed[0][0], parsed[4][0], *parsed[5]]
        for sensor, (vector, stamp), (texts, stamp_text) in zip(sensors, message, found, strict=True):
            quantity, _, factor = _READ[sensor.list]
            assert vector == [float(text) for text in texts]
            assert _values(readings[sensor.stream], quantity)[row] == [value * factor for value in vector]
            assert _values(readings[sensor.stream], "device_stamp")[row] == [stamp] == [float(stamp_text)]


def test_the_clock_of_the_board_is_kept_beside_the_other(tmp_path: Path) -> None:
    """It stands still, jumps and restarts as logged, and the stream's own stamps do not follow it."""
    clock = [5.0, 5.0, 4294967295.0, 0.0, 0.125]
    text = "".join(_line(k, {5: [([1.0] * 6, tick)]}) for k, tick in enumerate(clock))
    stream = _read(tmp_path, text, [_sensor("six_axis_force_torque")])["six_axis_force_torque_0"].stream
    assert stream.signal("device_stamp").column("device_stamp").tolist() == clock
    assert np.diff(stream.stamp_ns).tolist() == [10**9] * 4


def test_two_stamps_before_the_lists(tmp_path: Path) -> None:
    """As for every other port; the findings are those of each stream."""
    text = ONE_SENSOR.replace(" ", " 0.0 ", 1)
    sensors = [_sensor("six_axis_force_torque"), _sensor("temperature")]
    readings = _read(tmp_path, text, sensors, INFO_TWO_STAMPS)
    for sensor in sensors:
        assert readings[sensor.stream].stream.stamp_ns.tolist() == [1648477185_597940000]
        (finding,) = readings[sensor.stream].findings
        assert (finding.stream, finding.kind) == (sensor.stream, "dumper_stamp")


def test_the_indices_must_be_in_the_list(tmp_path: Path) -> None:
    """The error says how many sensors the list holds, also if it is empty."""
    with pytest.raises(FormatError, match=r"data\.log:1: expected the sensor 'ft' at .*\[2\], got a list of 2 sensors"):
        _read(tmp_path, TWO_SENSORS, [_sensor("six_axis_force_torque", 2, "ft")])
    with pytest.raises(FormatError, match=r"gyroscope\[0\], got a list of 0 sensors"):
        _read(tmp_path, TWO_SENSORS, [_sensor("gyroscope")])


@pytest.mark.parametrize("n", [0, 1, 5, 7])
@pytest.mark.parametrize("before", [0, 2])
def test_vectors_must_have_the_length_of_their_quantity(tmp_path: Path, n: int, before: int) -> None:
    """Five numbers are no wrench; the line is named."""
    good = "".join(_line(k, {5: [([1.0] * 6, 2.0)]}) for k in range(before))
    with pytest.raises(FormatError, match=rf"data\.log:{before + 1}: expected the 6 numbers fx .*, got {n}; is that"):
        _read(tmp_path, good + _line(9, {5: [([1.0] * n, 2.0)]}), [_sensor("six_axis_force_torque")])


def test_other_sensors_may_change_their_length(tmp_path: Path) -> None:
    """Arrays that nobody asked for are only counted."""
    text = "".join(_line(k, {5: [([1.0 * k] * 6, 2.0)], 8: [([5.0] * k, 2.0)]}) for k in range(4))
    reading = _read(tmp_path, text, [_sensor("six_axis_force_torque")])["six_axis_force_torque_0"]
    assert [row[0] for row in _values(reading, "wrench")] == [0.0, 1.0, 2.0, 3.0]


def test_sensors_must_not_come_or_go(tmp_path: Path) -> None:
    """With another configuration of the device the same index may be another sensor."""
    one, two = ({5: [([1.0] * 6, 2.0)] * n} for n in (1, 2))
    wanted = [_sensor("six_axis_force_torque")]
    with pytest.raises(FormatError, match=r"data\.log:2: expected lists of 0 0 0 0 0 1 0 .*got 0 0 0 0 0 2 0 .*split"):
        _read(tmp_path, _line(0, one) + _line(1, two), wanted)
    with pytest.raises(FormatError, match=r"data\.log:2: expected lists .* as in the lines before"):
        _read(tmp_path, _line(0, one, n_lists=11) + _line(1, one, n_lists=12), wanted)


_ONE = ONE_SENSOR.rstrip()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (_ONE.replace("()()()", "("), r'expected "\)" for every'),
        (_ONE.replace(" () () () ()", "").replace("()()", ""), "expected at least 9 lists .*, got 3 elements"),
        (_ONE + " 5", "got 12 elements of which 11 are lists"),
        (_ONE + " [ok]", "got 12 elements of which 11 are lists"),
        (_ONE + " (5)", r"expected \(\(v1 ... vn\) stamp\) for each sensor in the list angular_acceleration"),
        (_ONE + " () (5)", r"for each sensor in the list number 13"),
        (_ONE.replace("(32.0)", "32.0"), "in the list temperature"),
        (_ONE.replace("(32.0)", "((32.0))"), "in the list temperature"),
        (_ONE.replace("(32.0) 3062439114.0", "(32.0)"), "in the list temperature"),
        (_ONE.replace("(32.0) 3062439114.0", "(32.0) (1)"), "in the list temperature"),
        (_ONE.replace("(32.0) 3062439114.0", "(32.0) 1 2"), "in the list temperature"),
        (_ONE.replace("(32.0)", "([ok])"), "in the list temperature"),
        (_ONE.replace("32.0", "nan"), "got 'nan'"),
        (_ONE.replace("60.0", "6.0.0"), r"got '6\.0\.0'"),
        (_ONE.replace("-13.0", "1e999"), "beyond the range of float64"),
        (_ONE.replace(" 3062439114.0", ""), "in the list temperature"),
        ("1 1.5 1 2 3 4 5 6", "got 6 elements of which 0 are lists"),
        ("1 1.5", "got 0 elements"),
    ],
)
@pytest.mark.parametrize("before", [0, 2])
def test_a_message_of_another_kind_is_refused(tmp_path: Path, line: str, message: str, before: int) -> None:
    """With its line, however many good ones stand before it."""
    with pytest.raises(FormatError, match=rf"data\.log:{before + 1}: .*{message}") as caught:
        _read(tmp_path, ONE_SENSOR * before + line + "\n", [_sensor("six_axis_force_torque")])
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", [name for name in MeasuresList if name not in READ_LISTS])
def test_lists_that_are_not_read_are_refused(name: MeasuresList) -> None:
    """The error says which ones are."""
    with pytest.raises(
        RecordingError, match=rf"s: sensors in the list {name} are not read; .* gyroscope, accel.*, temp"
    ):
        MeasuresSensor(list=name, index=0, stream="s", frame="f")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"list": "gyroskope", "frame": "f"}, 'did you mean "gyroscope"'),
        ({"list": None}, "no list is called None"),
        ({"list": "gyroscope"}, "expected the frame of its axes for angular_velocity, got None"),
        ({"list": "accelerometer"}, "expected the frame of its axes for proper_acceleration"),
        ({"list": "six_axis_force_torque"}, "expected the frame of its axes for wrench"),
        ({"list": "temperature", "frame": "f"}, "expected no frame for temperature, got 'f'"),
        ({"list": "temperature", "index": -1}, "expected an index of 0 or more, got -1"),
        ({"list": "temperature", "index": True}, "expected an index of 0 or more, got True"),
        ({"list": "temperature", "index": 0.0}, r"expected an index of 0 or more, got 0\.0"),
    ],
)
def test_a_sensor_is_checked_when_it_is_named(arguments: dict[str, Any], message: str) -> None:
    """Before any log is opened."""
    with pytest.raises(RecordingError, match=message):
        MeasuresSensor(**({"index": 0, "stream": "s"} | arguments))


def test_a_list_may_be_given_by_its_name() -> None:
    """A text from a file becomes the member of the enumeration."""
    assert MeasuresSensor(list="temperature", index=0, stream="s").list is MeasuresList.TEMPERATURE  # type: ignore[arg-type]


def test_names_and_places_are_unique(tmp_path: Path) -> None:
    """Two sensors of one name, or one sensor under two names, are mistakes; so is none."""
    write_port(tmp_path, TWO_SENSORS)
    with pytest.raises(RecordingError, match="two of them are called 'a'"):
        read_measures(tmp_path, sensors=[_sensor("temperature", 0, "a"), _sensor("temperature", 1, "a")])
    with pytest.raises(RecordingError, match=r"'a' and 'b' are both temperature\[0\]"):
        read_measures(tmp_path, sensors=[_sensor("temperature", 0, "a"), _sensor("temperature", 0, "b")])
    with pytest.raises(RecordingError, match="expected at least one, got none"):
        read_measures(tmp_path, sensors=[])
