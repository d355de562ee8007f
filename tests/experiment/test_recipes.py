# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to a log: rows skipped, rates, several files, other frames and clocks, still joints."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import BoolArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, RecordingError, RobotError
from forcetorque.calibration.calibrate import data_doubts
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.inspection.inspect import inspect_log
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Stream
from tests.scenes.experiments import PARQUET, add, edit

HEAD = """\
schema = "forcetorque/experiment/1"
name = "tool"

[load]
frame = "tool"
motion = ["pose"]
measure_direction = "child_to_parent"

[recording]
format = "tabular"
path = "."
"""
POSE = """
[[recording.stream]]
name = "pose"
file = "pose.txt"
stamp = "row"
clock = "row"
column_names = ["qx", "qy", "qz", "qw"]

[[recording.stream.signal]]
quantity = "orientation"
columns = ["qx", "qy", "qz", "qw"]
units = ["1", "1", "1", "1"]
frame = "tool"
orientation = { form = "quat_xyzw", sense = "sensor_to_world" }
"""
WRENCH = """
[[recording.stream]]
name = "wrench"
file = "wrench.txt"
stamp = "row"
clock = "row"
column_names = ["a", "b", "c", "d", "e", "f"]

[[recording.stream.signal]]
quantity = "wrench"
columns = ["a", "b", "c", "d", "e", "f"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "base"
"""
TRANSFORM = '\n[[transform]]\nstream = "wrench"\nto = "tool"\norientation = "pose"\nmoment_about = "sensor"\n'
REST = """
[[sensor]]
name = "wrist"
stream = "wrench"
serial = "FT1"
prior = "identity"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

[[interval]]
label = "all"
start_s = 0
use = "calibration"
"""
TEXT = HEAD + POSE + WRENCH + TRANSFORM + REST
TURN = Rotation.random(30, random_state=np.random.default_rng(3))
SENSED = np.random.default_rng(4).normal(0.0, 5.0, size=(30, 6))
"""Wrench along the sensor's axes."""


def _table(path: Path, rows: np.ndarray, head: str = "") -> None:
    path.write_text(head + "".join(",".join(f"{value:.12g}" for value in row) + "\n" for row in rows), encoding="utf-8")


def _recording(folder: Path, text: str = TEXT) -> Recording:
    (folder / "tool.toml").write_text(text)
    return load_experiment(folder / "tool.toml").recording


@pytest.fixture
def poses(tmp_path: Path) -> Path:
    """Thirty poses, and wrenches turned into the world's axes."""
    _table(tmp_path / "pose.txt", TURN.as_quat())
    _table(tmp_path / "wrench.txt", np.hstack([TURN.apply(SENSED[:, :3]), TURN.apply(SENSED[:, 3:])]))
    return tmp_path


def test_a_wrench_of_the_base_frame_is_turned_into_the_sensor(poses: Path) -> None:
    """Force and moment are those of the sensor, the frame says so, and a finding how."""
    recording = _recording(poses)
    wrench = recording.stream("wrench").signal("wrench")
    np.testing.assert_allclose(wrench.values, SENSED, atol=1e-9)
    assert wrench.frame == "tool"
    (finding,) = (one for one in recording.findings if one.kind == "transformed")
    assert "moment about the origin of 'tool'" in finding.message


def test_a_wrench_of_another_frame_is_not_taken_for_the_sensors(poses: Path) -> None:
    """Without [[transform]] nothing would move it: a load weighed by it would be wrong without a word."""
    with pytest.raises(
        ExperimentError, match=r"in the frame of 'wrist', 'tool' .*got one in 'base'.*\[\[transform\]\]"
    ):
        _recording(poses, HEAD + POSE + WRENCH + REST)
    own = WRENCH.replace('frame = "base"', 'frame = "tool"')
    assert _recording(poses, HEAD + POSE + own + REST).stream("wrench").signal("wrench").frame == "tool"


def test_the_other_sense_of_the_pose_gives_another_wrench(poses: Path) -> None:
    """Negative control: what is turned the wrong way round is not what was sensed."""
    wrench = _recording(poses, TEXT.replace("sensor_to_world", "world_to_sensor")).stream("wrench").signal("wrench")
    assert np.abs(wrench.values - SENSED).max() > 5.0


def test_a_fixed_pose_moves_the_moment_too(poses: Path) -> None:
    """By the closed form: the moment about the sensor is that about the other origin, plus lever times force."""
    pose = (
        'pose = { rpy_rad = [0.0, 0.0, 1.5707963267948966], position_m = [0.0, 0.0, 0.2] }\nmoment_about = "own_frame"'
    )
    text = TEXT.replace('orientation = "pose"\nmoment_about = "sensor"', pose)
    _table(poses / "wrench.txt", np.tile([1.0, 0.0, 0.0, 0.0, 0.0, 3.0], (30, 1)))
    wrench = _recording(poses, text).stream("wrench").signal("wrench").values
    np.testing.assert_allclose(wrench, np.tile([0.0, 1.0, 0.0, -0.2, 0.0, 3.0], (30, 1)), atol=1e-12)


PLACES = np.random.default_rng(6).uniform(-1.0, 1.0, size=(30, 3))
"""Where the sensor is in the world; m."""
TRANSLATION = (
    POSE.replace(', "qw"]', ', "qw", "x", "y", "z"]', 1)
    + """
[[recording.stream.signal]]
quantity = "translation"
columns = ["x", "y", "z"]
units = ["mm", "mm", "mm"]
frame = "tool"
"""
)
ABOUT_WORLD = TRANSFORM.replace('"sensor"', '"own_frame"')


@pytest.fixture
def robot_base(poses: Path) -> Path:
    """Wrenches along the axes of a base and about its origin, with the places of the sensor in mm."""
    force = TURN.apply(SENSED[:, :3])
    moment = TURN.apply(SENSED[:, 3:]) + np.cross(PLACES, force)
    _table(poses / "pose.txt", np.hstack([TURN.as_quat(), 1000.0 * PLACES]))
    _table(poses / "wrench.txt", np.hstack([force, moment]))
    return poses


def test_a_moment_about_the_base_is_brought_to_the_sensor(robot_base: Path) -> None:
    """By where the sensor is in every sample; to take it for one about the sensor is wrong by lever times force."""
    recording = _recording(robot_base, HEAD + TRANSLATION + WRENCH + ABOUT_WORLD + REST)
    np.testing.assert_allclose(recording.stream("wrench").signal("wrench").values, SENSED, atol=1e-9)
    (finding,) = (one for one in recording.findings if one.kind == "transformed")
    assert "moment about the origin of 'base'" in finding.message
    taken = _recording(robot_base, HEAD + TRANSLATION + WRENCH + TRANSFORM + REST).stream("wrench").signal("wrench")
    np.testing.assert_allclose(taken.values[:, :3], SENSED[:, :3], atol=1e-9)
    lever = TURN.inv().apply(np.cross(PLACES, TURN.apply(SENSED[:, :3])))
    np.testing.assert_allclose(taken.values[:, 3:] - SENSED[:, 3:], lever, atol=1e-9)


def test_a_moment_about_a_point_of_the_tool_is_brought_to_the_sensor(poses: Path) -> None:
    """Along the axes of the base and about the tool's point, as arms give it; with a pose that stays likewise."""
    point = np.array([0.02, -0.01, 0.15])
    about = SENSED[:, 3:] - np.cross(point, SENSED[:, :3])
    _table(poses / "wrench.txt", np.hstack([TURN.apply(SENSED[:, :3]), TURN.apply(about)]))
    stated = f'moment_about = "point"\npoint_m = {point.tolist()}'
    text = TEXT.replace('moment_about = "sensor"', stated)
    recording = _recording(poses, text)
    np.testing.assert_allclose(recording.stream("wrench").signal("wrench").values, SENSED, atol=1e-9)
    (finding,) = (one for one in recording.findings if one.kind == "transformed")
    assert "moment about a point that moves with 'tool'" in finding.message
    _table(poses / "wrench.txt", np.hstack([SENSED[:, :3], about]))
    still = text.replace('orientation = "pose"', "pose = { rpy_rad = [0.0, 0.0, 0.0] }")
    np.testing.assert_allclose(_recording(poses, still).stream("wrench").signal("wrench").values, SENSED, atol=1e-9)


def test_a_moment_about_the_base_needs_the_place_of_the_sensor(robot_base: Path) -> None:
    """Without a translation, or with that of another frame, it cannot be moved, and the error says what to state."""
    without = POSE.replace(', "qw"]', ', "qw", "x", "y", "z"]', 1)
    with pytest.raises(RecordingError, match=r'transform\[0\]: .*quantity translation, in m, .*moment_about = "point"'):
        _recording(robot_base, HEAD + without + WRENCH + ABOUT_WORLD + REST)
    other = TRANSLATION.replace(
        'units = ["mm", "mm", "mm"]\nframe = "tool"', 'units = ["mm", "mm", "mm"]\nframe = "hand"'
    )
    with pytest.raises(RecordingError, match="expected the translation of 'tool', got that of 'hand'"):
        _recording(robot_base, HEAD + other + WRENCH + ABOUT_WORLD + REST)


def test_lines_are_skipped_and_a_rate_stands_for_a_time(poses: Path) -> None:
    """Titles in front of the table, and stamps that do not add up rounding."""
    _table(poses / "wrench.txt", SENSED, "made by a logger\n\nN and N m\n")
    text = (
        TEXT.replace(TRANSFORM, "")
        .replace('frame = "base"', 'frame = "tool"')
        .replace(
            'stamp = "row"\nclock = "row"\ncolumn_names = ["a"',
            'skip_rows = 3\nrate_hz = 698.0\nstart_s = 2.5\ncolumn_names = ["a"',
        )
    )
    stream = _recording(poses, text).stream("wrench")
    np.testing.assert_allclose(stream.signal("wrench").values, SENSED)
    np.testing.assert_array_equal(stream.stamp_ns, 2_500_000_000 + np.rint(np.arange(30) * (1e9 / 698.0)).astype(int))
    assert stream.clock == "log"


def test_columns_of_one_table_may_have_two_clocks(poses: Path) -> None:
    """The file is listed as two streams, and one of them is brought to the clock of the other."""
    time = 0.1 * np.arange(len(SENSED))
    _table(poses / "log.csv", np.column_stack([time, SENSED, TURN.as_quat()]), "t,a,b,c,d,e,f,qx,qy,qz,qw\n")
    stamped = 'stamp = { column = "t", unit = "s" }'
    pose, wrench = (
        "\n".join(line for line in text.splitlines() if not line.startswith(("clock", "column_names")))
        .replace(f"{name}.txt", "log.csv")
        .replace('stamp = "row"', stamped)
        for name, text in (("pose", POSE), ("wrench", WRENCH.replace('"base"', '"tool"')))
    )
    clock = '\n[[clock]]\nstream = "wrench"\nto = "pose"\ndelay_s = 0.3\n'
    streams = _recording(poses, f"{HEAD}{pose}\n{wrench}\n{clock}{REST}").streams
    np.testing.assert_array_equal(streams["pose"].stamp_ns - streams["wrench"].stamp_ns, 300_000_000)
    np.testing.assert_allclose(streams["wrench"].signal("wrench").values, SENSED, atol=1e-9)


def test_one_number_is_the_full_scale_of_all_axes(poses: Path) -> None:
    """As in the file of a bench."""
    text = TEXT.replace("[100.0, 100.0, 200.0, 10.0, 10.0, 10.0]", "50")
    (poses / "tool.toml").write_text(text)
    (sensor,) = load_experiment(poses / "tool.toml").sensors
    np.testing.assert_array_equal(sensor.full_scale, np.full(6, 50.0))


def test_files_of_one_stream_follow_each_other(poses: Path) -> None:
    """Rows without a time are numbered on; rows with one must go on in time."""
    for name in ("pose", "wrench"):
        lines = (poses / f"{name}.txt").read_text().splitlines(keepends=True)
        (poses / f"{name}_1.txt").write_text("".join(lines[:11]))
        (poses / f"{name}_2.txt").write_text("".join(lines[11:]))
    text = TEXT
    for name in ("pose", "wrench"):
        text = text.replace(f'"{name}.txt"', f'["{name}_1.txt", "{name}_2.txt"]')
    whole, joined = _recording(poses), _recording(poses, text)
    np.testing.assert_array_equal(joined.stream("wrench").stamp_ns, whole.stream("wrench").stamp_ns)
    np.testing.assert_array_equal(
        joined.stream("wrench").signal("wrench").values, whole.stream("wrench").signal("wrench").values
    )
    pattern = TEXT.replace('"pose.txt"', '"pose_[12].txt"').replace('"wrench.txt"', '"wrench_?.txt"')
    matched = _recording(poses, pattern).stream("wrench").signal("wrench")
    np.testing.assert_array_equal(matched.values, whole.stream("wrench").signal("wrench").values)
    rated = text.replace('stamp = "row"\nclock = "row"', "rate_hz = 10.0\nstart_s = [0.0, {start}]")
    assert len(_recording(poses, rated.replace("{start}", "1.1")).stream("wrench")) == 30
    with pytest.raises(ForceTorqueError, match=r"pose_2\.txt.*expected samples after the last of .*pose_1\.txt"):
        _recording(poses, rated.replace("{start}", "0.5"))
    with pytest.raises(ForceTorqueError, match=r"expected samples after the last of"):
        _recording(poses, rated.replace("{start}", "-1.1"))


def test_a_name_that_is_there_is_no_pattern_and_numbers_are_ordered_by_value(poses: Path) -> None:
    """A file called `wrench[1].txt` is read; `w2.txt` stands before `w10.txt`."""
    lines = (poses / "wrench.txt").read_text().splitlines(keepends=True)
    for name, part in (("wrench[1]", lines), ("w2", lines[:11]), ("w10", lines[11:])):
        (poses / f"{name}.txt").write_text("".join(part))
    whole = _recording(poses).stream("wrench").signal("wrench").values
    for name in ("wrench[1].txt", "w[0-9]*.txt"):
        read = _recording(poses, TEXT.replace('"wrench.txt"', f'"{name}"')).stream("wrench").signal("wrench").values
        np.testing.assert_array_equal(read, whole)


def _replaced(old: str, new: str) -> Callable[[str], str]:
    return lambda text: text.replace(old, new)


WRENCH_STAMP = 'stamp = "row"\nclock = "row"\ncolumn_names = ["a"'
REFUSED = {
    "stamp and rate": (_replaced(WRENCH_STAMP, f"rate_hz = 5.0\nstart_s = 0.0\n{WRENCH_STAMP}"), "got both; keep one"),
    "neither": (_replaced(WRENCH_STAMP, 'column_names = ["a"'), "got neither"),
    "rate without a start": (_replaced(WRENCH_STAMP, 'rate_hz = 5.0\ncolumn_names = ["a"'), "rate_hz needs start_s"),
    "rate of zero": (_replaced(WRENCH_STAMP, 'rate_hz = 0.0\nstart_s = 0.0\ncolumn_names = ["a"'), "rate_hz"),
    "rate too high": (
        _replaced(WRENCH_STAMP, 'rate_hz = 1e12\nstart_s = 0.0\ncolumn_names = ["a"'),
        "at most 1e9 times a second",
    ),
    "starts of other files": (
        _replaced(WRENCH_STAMP, 'rate_hz = 5.0\nstart_s = [0.0, 9.0]\ncolumn_names = ["a"'),
        r"start_s of 1 file\(s\), one for each",
    ),
    "rows before the first": (_replaced(WRENCH_STAMP, f"skip_rows = -1\n{WRENCH_STAMP}"), "skip_rows"),
    "all rows skipped": (_replaced(WRENCH_STAMP, f"skip_rows = 99\n{WRENCH_STAMP}"), r"wrench\.txt"),
    "a pattern of nothing": (_replaced('"wrench.txt"', '"raw/*.csv"'), r"expected files of the pattern 'raw/\*\.csv'"),
    "no pattern": (_replaced('"wrench.txt"', '"**x/*.txt"'), r"expected (a|files of the) pattern"),
    "a pattern with a rate": (
        _replaced('"wrench.txt"\n' + WRENCH_STAMP, '"w*.txt"\nrate_hz = 5.0\nstart_s = 0.0\ncolumn_names = ["a"'),
        "list the files of a rate",
    ),
    "no file": (_replaced('"wrench.txt"', "[]"), "file"),
    "frame of the sensor already": (_replaced('frame = "base"', 'frame = "tool"'), "in another frame than 'tool'"),
    "orientation of another frame": (_replaced('to = "tool"', 'to = "hand"'), "orientation of 'hand'"),
    "unknown stream": (_replaced('[[transform]]\nstream = "wrench"', '[[transform]]\nstream = "wernch"'), "wernch"),
    "no pose": (_replaced('orientation = "pose"\nmoment', "moment"), "expected orientation, a stream, or pose"),
    "no point": (_replaced('moment_about = "sensor"', ""), "moment_about"),
    "own frame without a place": (
        _replaced(
            'orientation = "pose"\nmoment_about = "sensor"',
            'pose = { rpy_rad = [0, 0, 0] }\nmoment_about = "own_frame"',
        ),
        "position_m of pose is needed",
    ),
    "a point that is nowhere": (_replaced('about = "sensor"', 'about = "point"'), "point_m is needed"),
    "a point for nothing": (_replaced('about = "sensor"', 'about = "sensor"\npoint_m = [0, 0, 0]'), "moves nothing"),
    "place that moves nothing": (
        _replaced('orientation = "pose"', "pose = { rpy_rad = [0.0, 0.0, 0.0], position_m = [0.0, 0.0, 0.1] }"),
        "moves nothing",
    ),
    "clock of itself": (
        _replaced("[[sensor]]", '[[clock]]\nstream = "pose"\nto = "pose"\ndelay_s = 0.0\n[[sensor]]'),
        "another stream",
    ),
    "clock of nothing": (
        _replaced("[[sensor]]", '[[clock]]\nstream = "psoe"\nto = "pose"\ndelay_s = 0.0\n[[sensor]]'),
        "psoe",
    ),
    "drift alone estimated": (
        _replaced(
            "[[sensor]]", '[[clock]]\nstream = "pose"\nto = "wrench"\ndelay_s = 0.0\ndrift = "estimate"\n[[sensor]]'
        ),
        'needs delay_s = "estimate"',
    ),
    "search for what is stated": (
        _replaced("[[sensor]]", '[[clock]]\nstream = "pose"\nto = "wrench"\ndelay_s = 0.0\nwithin_s = 1.0\n[[sensor]]'),
        "within_s are for",
    ),
    "clock stated twice": (
        _replaced("[[sensor]]", '[[clock]]\nstream = "pose"\nto = "wrench"\ndelay_s = 0.0\n' * 2 + "[[sensor]]"),
        "specify every stream once",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_contradicts_itself_is_refused(poses: Path, case: str) -> None:
    """In one line that names the key."""
    change, message = REFUSED[case]
    assert change(TEXT) != TEXT
    with pytest.raises(ForceTorqueError, match=message) as caught:
        _recording(poses, change(TEXT))
    assert "\n" not in str(caught.value)
    assert isinstance(caught.value, ExperimentError | FormatError | RecordingError)


CLOCK = '\n[[clock]]\nstream = "arm_ft"\nto = "joints"\ndelay_s = "estimate"\n'


def _late(arm: Path, delay_ns: int) -> None:
    recording = read_recording(arm / "recording")
    stream = recording.stream("arm_ft")
    late = replace(stream, stamp_ns=stream.stamp_ns + delay_ns, clock="board")
    write_recording(arm / "recording_late", replace(recording, streams={**recording.streams, "arm_ft": late}))
    edit(arm / PARQUET, 'path = "recording"', 'path = "recording_late"')


def _samples(arm: Path) -> int:
    experiment = load_experiment(arm / PARQUET)
    return sum(len(one.raw) for one in SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION))


@pytest.mark.long
def test_a_planted_delay_of_a_sensor_is_taken_back(arm: Path) -> None:
    """Against what joints and model demand, with its interval, for inspect, calibrate and Python."""
    _late(arm, 40_000_000)
    with pytest.raises(ForceTorqueError, match="clock"):
        _samples(arm)
    add(arm / PARQUET, CLOCK)
    experiment = load_experiment(arm / PARQUET)
    (shift,) = experiment.recording.clocks
    assert shift.delay_half_width_s is not None
    assert abs(shift.delay_s - 0.04) < 2.0 * shift.delay_half_width_s < 0.01
    stamps = (
        experiment.recording.stream("arm_ft").stamp_ns - read_recording(arm / "recording").stream("arm_ft").stamp_ns
    )
    assert np.abs(stamps).max() < 1e9 * 2.0 * shift.delay_half_width_s
    assert any(
        one.kind == "clock" and "estimated by raw of 'arm_ft'" in one.message for one in inspect_experiment(experiment)
    )
    assert any("ms later than 'joints'" in doubt for doubt in data_doubts(SensorRun(experiment, experiment.sensors[0])))
    inspection = inspect_log(arm / PARQUET)
    (row,) = inspection.clocks
    assert (row.stream, row.to, row.estimated, row.undetermined) == ("arm_ft", "joints", True, None)
    assert (row.delay_s, row.delay_half_width_95_s) == (shift.delay_s, shift.delay_half_width_s)
    assert json.loads(inspection.json_text())["clocks"][0]["explained"] == shift.explained


def test_a_stated_delay_and_drift_are_taken_back(arm: Path) -> None:
    """The delay is that of the middle of the stream."""
    _late(arm, 0)
    add(arm / PARQUET, CLOCK.replace('"estimate"', "0.25\ndrift = 0.01"))
    before = read_recording(arm / "recording").stream("arm_ft").stamp_ns
    moved = before - load_experiment(arm / PARQUET).recording.stream("arm_ft").stamp_ns
    half = 0.5e-9 * float(before[-1] - before[0])
    np.testing.assert_allclose(moved[[0, -1]] * 1e-9, [0.25 - 0.01 * half, 0.25 + 0.01 * half], atol=1e-8)


def test_streams_that_show_nothing_in_common_are_refused(poses: Path) -> None:
    """Two streams with the same quantity follow each other by no law of mechanics that a file states."""
    other = WRENCH.replace('name = "wrench"', 'name = "again"')
    clock = '\n[[clock]]\nstream = "again"\nto = "wrench"\ndelay_s = "estimate"\n'
    with pytest.raises(RecordingError, match=r"clock\[0\]: .*show nothing in common"):
        _recording(poses, HEAD + POSE + WRENCH + other + clock + REST)
    inspection = inspect_log(poses / "tool.toml")
    (row,) = inspection.clocks
    assert (row.stream, row.to, row.estimated, row.delay_s, row.drift) == ("again", "wrench", True, None, None)
    assert "show nothing in common" in (row.undetermined or "")
    assert "untold_clock" in [finding.kind for finding in inspection.findings]
    assert set(inspection.streams) == {"pose", "wrench", "again"}


def test_a_file_without_clocks_has_no_rows_of_them(arm: Path) -> None:
    """Its JSON is what it was before there were any."""
    assert "clocks" not in json.loads(inspect_log(arm / PARQUET).json_text())


def _without_wrist(arm: Path) -> None:
    recording = read_recording(arm / "recording")
    joints = recording.stream("joints")
    signals = {
        quantity: replace(signal, columns=signal.columns[:-1], units=signal.units[:-1], values=signal.values[:, :-1])
        for quantity, signal in joints.signals.items()
    }
    write_recording(
        arm / "recording_late",
        replace(recording, streams={**recording.streams, "joints": replace(joints, signals=signals)}),
    )
    edit(arm / PARQUET, 'path = "recording"', 'path = "recording_late"')


def test_a_joint_that_nobody_logged_stands_where_the_file_says(arm: Path) -> None:
    """Without it the sensor has no reference; with it every result says what was assumed."""
    _without_wrist(arm)
    with pytest.raises(ForceTorqueError, match="wrist"):
        _samples(arm)
    edit(arm / PARQUET, 'urdf = "arm.urdf"', 'urdf = "arm.urdf"\nfixed = { wrist = 0.4 }')
    experiment = load_experiment(arm / PARQUET)
    run = SensorRun(experiment, experiment.sensors[0])
    assert _samples(arm)
    assert any("wrist at 0.4" in doubt for doubt in data_doubts(run))


@pytest.mark.parametrize(
    ("fixed", "error", "message"),
    [
        ("{ wirst = 0.0 }", RobotError, r"robot: fixed: .*no joint 'wirst'; did you mean \"wrist\""),
        ("{ wrist = 30.0 }", RobotError, "within one turn, got 30; is that in degrees"),
        ("{ elbow = 0.0 }", ExperimentError, "joint 'elbow' is logged, in the stream 'joints'"),
        ("{ tool_joint = 0.0 }", RobotError, "it is fixed in the robot"),
        ("{ wrist = nan }", FormatError, "fixed"),
    ],
)
def test_joints_that_cannot_be_fixed_are_refused(
    arm: Path, fixed: str, error: type[ForceTorqueError], message: str
) -> None:
    """Unknown, in degrees, logged, fixed already, no number."""
    _without_wrist(arm)
    edit(arm / PARQUET, 'urdf = "arm.urdf"', f'urdf = "arm.urdf"\nfixed = {fixed}')
    with pytest.raises(error, match=message):
        load_experiment(arm / PARQUET)


def _rows(stream: Stream, rows: BoolArray) -> Stream:
    signals = {quantity: replace(one, values=one.values[rows]) for quantity, one in stream.signals.items()}
    sequence = None if stream.sequence is None else stream.sequence[rows]
    return replace(stream, stamp_ns=stream.stamp_ns[rows], signals=signals, sequence=sequence)


def test_a_log_of_any_format_goes_on_in_other_files(arm: Path) -> None:
    """Two recordings, one after the other, are one; in the wrong order, or twice the same, they are refused."""
    recording = read_recording(arm / "recording")
    middle = recording.start_ns + 12_000_000_000
    for name, later in (("first", False), ("second", True)):
        streams = {
            stream.name: _rows(stream, (stream.stamp_ns >= middle) == later) for stream in recording.streams.values()
        }
        write_recording(arm / name, replace(recording, streams=streams))
    text = (arm / PARQUET).read_text(encoding="utf-8")
    edit(arm / PARQUET, 'path = "recording"', 'path = "first"\ncontinued_in = ["second"]')
    joined = load_experiment(arm / PARQUET).recording
    for name, stream in recording.streams.items():
        np.testing.assert_array_equal(joined.stream(name).stamp_ns, stream.stamp_ns)
        for quantity, signal in stream.signals.items():
            np.testing.assert_array_equal(joined.stream(name).signal(quantity).values, signal.values)
    for path, others in (("second", '["first"]'), ("first", '["first"]')):
        stated = f'path = "{path}"\ncontinued_in = {others}'
        (arm / PARQUET).write_text(text.replace('path = "recording"', stated), encoding="utf-8")
        with pytest.raises(ForceTorqueError, match="continued_in: .*expected samples after the last of"):
            load_experiment(arm / PARQUET)


def test_rows_of_a_numpy_file_may_have_a_rate(tmp_path: Path) -> None:
    """The keys are those of tables; a start for each of several files is not for one file."""
    np.savez(tmp_path / "log.npz", wrench=SENSED, pose=TURN.as_quat())
    stream = """
[[recording.stream]]
name = "{name}"
variable = "{name}"
{time}
signal = [ {{ quantity = "{quantity}", columns = [1, {count}], unit = {unit}, frame = "tool"{more} }} ]
"""
    rate = "rate_hz = 100.0\nstart_s = 0.0"
    pose = ', orientation = { form = "quat_xyzw", sense = "sensor_to_world" }'
    head = HEAD.replace('format = "tabular"\npath = "."', 'format = "npz"\npath = "log.npz"')

    def text(time: str) -> str:
        wrench = stream.format(
            name="wrench", time=time, quantity="wrench", count=6, unit=["N", "N", "N", "N m", "N m", "N m"], more=""
        )
        turned = stream.format(name="pose", time=rate, quantity="orientation", count=4, unit='"1"', more=pose)
        return head + turned + wrench + REST

    stream_of_rows = _recording(tmp_path, text(rate)).stream("wrench")
    np.testing.assert_array_equal(stream_of_rows.stamp_ns, 10_000_000 * np.arange(30))
    for time, message in (
        ("rate_hz = 100.0\nstart_s = [0.0, 1.0]", "start_s of one file"),
        (f'{rate}\nrows_of = "pose"\nshift_rows = 0', "one of them"),
        ("", "one of them"),
    ):
        with pytest.raises(FormatError, match=message):
            _recording(tmp_path, text(time))
