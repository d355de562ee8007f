# SPDX-License-Identifier: BSD-3-Clause
"""A first experiment file: what a log says is in it, what nobody can tell is a question, and nothing runs before."""

from __future__ import annotations

import re
import tomllib
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, MissingFileError, OutputError
from forcetorque.base.toml_file import unanswered_keys
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.headings import read_heading
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.formats.log_format import SketchedColumns
from forcetorque.formats.specified_signals import OrientationTable
from forcetorque.inspection.draft.column_matches import array_groups, column_matches, is_estimated
from forcetorque.inspection.draft.draft import Draft, draft_experiment
from forcetorque.inspection.draft.joints import joint_rows
from forcetorque.inspection.draft.questions import answer_questions, resume_experiment
from forcetorque.inspection.inspect import inspect_log
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF, BIPED_URDF
from tests.formats.franka.states import states, write_table
from tests.formats.yarp.port_logs import write_port
from tests.scenes.tutorial_log import FOLDER, PUSH_S, log_text, reading, robot_text

ANSWERS = {
    "serial": '"FT-28"',
    "full_scale": "[200, 200, 200, 20, 20, 20]",
    "joint": '"arm_ft_joint"',
    "measure_direction": '"child_to_parent"',
    "gravity_direction": "[0.0, 0.0, -1.0]",
}


def answered(text: str, answers: dict[str, str]) -> str:
    """The file with answers in place of its questions."""
    for key, answer in answers.items():
        text = re.sub(rf'^{key} = "\?".*$', f"{key} = {answer}", text, flags=re.MULTILINE)
    return text


def _written(folder: Path, text: str, urdf: str = "") -> Path:
    (folder / "log.csv").write_text(text, encoding="utf-8")
    (folder / "robot.urdf").write_text(urdf or robot_text(), encoding="utf-8")
    return folder / "log.csv"


def _keys(text: str) -> list[str]:
    return [question.key for question in unanswered_keys(text)]


@pytest.fixture(scope="module")
def drafted() -> str:
    """The file of the tutorial's log."""
    return draft_experiment([FOLDER / "log.csv"], urdf=FOLDER / "robot.urdf").content


SENSORS_OWN = {
    "ATI": "Time (s),Fx (N),Fy (N),Fz (N),Tx (Nm),Ty (Nm),Tz (Nm)",
    "Robotiq": "time_s,Fx [N],Fy [N],Fz [N],Mx [Nm],My [Nm],Mz [Nm]",
    "OnRobot": "timestamp_s,force_x [N],force_y [N],force_z [N],torque_x [Nm],torque_y [Nm],torque_z [Nm]",
    "Bota": "stamp_s,force.x [N],force.y [N],force.z [N],torque.x [Nm],torque.y [Nm],torque.z [Nm]",
}


@pytest.mark.parametrize("maker", SENSORS_OWN)
def test_a_table_of_a_sensor_alone_asks_for_the_sensor_alone(tmp_path: Path, maker: str) -> None:
    """No column says how it is held, so nothing is asked of that; a thermometer is its variable; the file is read."""
    rows = np.column_stack(
        [0.01 * np.arange(300), np.random.default_rng(5).normal(size=(300, 6)), 30.0 + np.zeros(300)]
    )
    text = "\n".join([f"{SENSORS_OWN[maker]},temperature [degC]", *(",".join(map(str, row)) for row in rows)])
    (tmp_path / "log.csv").write_text(f"{text}\n")
    draft = draft_experiment(tmp_path / "log.csv", tmp_path / "x.toml")
    assert [question.key for question in draft.questions] == ["serial"]
    content = tomllib.loads(draft.content)
    assert content["load"] == {"frame": "ft_sensor", "motion": "none"}
    assert content["sensor"][0]["variable"] == [{"name": "temperature"}]
    (tmp_path / "x.toml").write_text(answered(draft.content, ANSWERS))
    (sensor,) = load_experiment(tmp_path / "x.toml").sensors
    assert sensor.variables[0].linear.unit == "degC"
    assert [row.kind for row in inspect_log(tmp_path / "x.toml").findings] == []


@pytest.mark.parametrize("components", [("fz",), ("fx", "fy", "fz"), ()])
def test_a_sensor_of_fewer_components_is_drafted(tmp_path: Path, components: tuple[str, ...]) -> None:
    """As a sensor of these components, and what no log has is asked; without such columns there is no sensor."""
    names = ("time", *components, "shoulder", "elbow")
    rows = np.column_stack([0.01 * np.arange(300), np.random.default_rng(5).normal(size=(300, len(names) - 1))])
    log = _written(tmp_path, "\n".join([",".join(names), *(",".join(map(str, row)) for row in rows)]))
    draft = draft_experiment(log, tmp_path / "x.toml", urdf=tmp_path / "robot.urdf")
    content = tomllib.loads(draft.content)
    assert ("sensor" in content) is bool(components)
    if components:
        signal = content["recording"]["stream"][0]["signal"][-1]
        assert signal == {"quantity": "raw", "columns": list(components), "units": ["counts"] * len(components)}
        (sensor,) = content["sensor"]
        assert sensor["components"] == list(components)
        assert [key for key, value in sensor.items() if value == "?"][:2] == ["serial", "full_scale"]
        assert "support" in content


def test_a_load_cell_in_a_file_of_its_own_is_drafted(tmp_path: Path) -> None:
    """Beside a table of joints; without a robot the file has its lines as comments, and the answer names them."""
    rows = np.random.default_rng(5).normal(size=(300, 3))
    for name, heading, first in (("cell", "time,fz", 0), ("log", "time,shoulder,elbow", 1)):
        lines = [
            f"{0.01 * k:.2f}," + ",".join(map(str, row[first : first + heading.count(",")]))
            for k, row in enumerate(rows)
        ]
        log = _written(tmp_path, "\n".join([heading, *lines]) + "\n")
        log.rename(tmp_path / f"{name}.csv")
    draft = draft_experiment([tmp_path / "cell.csv", log], tmp_path / "x.toml", urdf=tmp_path / "robot.urdf")
    (sensor,) = tomllib.loads(draft.content)["sensor"]
    assert (sensor["stream"], sensor["components"]) == ("cell", ["fz"])
    bare = draft_experiment([tmp_path / "cell.csv", log], tmp_path / "y.toml")
    assert bare.few_components == ("fz",)
    assert '# columns = ["fz"]' in bare.content
    assert "not read: of a load cell or a sensor of three axes" in next(iter(bare.answers())).why[-1]


NAMES = ("t", "fx", "fy", "fz", "tx", "ty", "tz")


def _numbers(path: Path, head: str = "") -> Path:
    rows = np.column_stack([0.01 * np.arange(300), np.random.default_rng(5).normal(size=(300, 6))])
    path.write_text(head + "".join(",".join(f"{value:.6g}" for value in row) + "\n" for row in rows), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("head", "skipped"), [("", 0), ("time,force,moment\n", 1), ("a,b,c,d,e,f,g\n", 1)], ids=["none", "few", "others"]
)
def test_named_columns_of_a_table_without_headings_make_a_sensor(tmp_path: Path, head: str, skipped: int) -> None:
    """Also below a line of fewer headings, and in place of others; the file then holds the keys."""
    log = _numbers(tmp_path / "log.csv", head)
    text = draft_experiment(log, tmp_path / "x.toml", column_names=NAMES).content
    content = tomllib.loads(text)
    (entry,) = content["recording"]["stream"]
    assert entry["column_names"] == list(NAMES)
    assert entry.get("skip_rows", 0) == skipped
    assert entry["signal"][0]["columns"] == list(NAMES[1:])
    assert content["sensor"][0]["name"] == "ft_sensor"
    for wrong in (NAMES[:-1], (*NAMES[:-1], "t")):
        with pytest.raises(FormatError, match="expected a name for each of 7 columns, each once"):
            draft_experiment(log, column_names=wrong)


def test_a_table_without_headings_says_how_to_name_its_columns(tmp_path: Path) -> None:
    """At once, with an example that can be typed; the question has it as the value of the key."""
    log = _numbers(tmp_path / "log.csv")
    draft = draft_experiment(log)
    assert f"forcetorque init {log} --column-names t,fx,fy,fz,tx,ty,tz`" in draft.notes[0]
    assert draft.questions[0].key == "column_names"
    assert 'as ["t", "fx", "fy", "fz", "tx", "ty", "tz"]' in draft.questions[0].question


def test_elements_of_lists_are_matched_by_the_name_and_length_of_the_list() -> None:
    """As arrays are; elements without the first, and lists of another length, are nothing."""
    names = [f"observation.wrench[{k}]" for k in range(6)] + ["observation.temperature"]
    names += [f"acc[{k}]" for k in range(3)] + [f"ft[{k}]" for k in range(1, 7)] + [f"gyro[{k}]" for k in range(4)]
    seen = {one.quantity: one.columns for one in column_matches([read_heading(name) for name in names], [])}
    assert seen == {"wrench": (0, 1, 2, 3, 4, 5), "temperature": (6,), "proper_acceleration": (7, 8, 9)}


def test_what_is_left_is_asked_and_what_is_known_is_not(drafted: str) -> None:
    """Units stand in the headings and joints are called as in the URDF; sensor, sign and gravity are asked."""
    assert _keys(drafted) == list(ANSWERS)
    content = tomllib.loads(drafted)
    assert content["recording"]["stream"][0]["stamp"] == {"column": "time_s", "unit": "s"}
    position, wrench = content["recording"]["stream"][0]["signal"]
    assert position["names"] == ["shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist"]
    assert (position["units"], wrench["units"]) == (["rad"] * 5, ["N"] * 3 + ["N m"] * 3)
    assert content["support"][0]["frame"] == "base"


def test_dates_are_a_time_of_which_nothing_is_asked(tmp_path: Path, drafted: str) -> None:
    """A log with dates in place of seconds has the same questions and intervals, and is read."""
    first, *rows = log_text().splitlines()
    midnight = datetime(2026, 11, 23, tzinfo=UTC)
    cells = [row.split(",", 1) for row in rows]
    dated = [f"{(midnight + timedelta(seconds=float(time))).isoformat()},{rest}" for time, rest in cells]
    log = _written(tmp_path, "\n".join([first, *dated]) + "\n")
    text = draft_experiment([log], tmp_path / "x.toml", urdf=tmp_path / "robot.urdf").content
    assert _keys(text) == list(ANSWERS)
    content, plain = tomllib.loads(text), tomllib.loads(drafted)
    assert content["recording"]["stream"][0]["stamp"] == {"column": "time_s", "unit": "iso8601"}
    assert content["interval"] == plain["interval"]
    (tmp_path / "x.toml").write_text(answered(text, ANSWERS), encoding="utf-8")
    experiment = load_experiment(tmp_path / "x.toml")
    (stream,) = experiment.recording.streams.values()
    assert stream.stamp_ns[0] == int(midnight.timestamp()) * 10**9
    assert np.diff(stream.stamp_ns).tolist() == [40_000_000] * (len(rows) - 1)


@pytest.mark.parametrize(("kept", "is_asked"), [(3, False), (1, True)])
def test_times_that_come_twice_are_times(tmp_path: Path, kept: int, is_asked: bool) -> None:
    """Of rounded times some come again; where half of them do, the time is a question that names its column."""
    first, *rows = log_text().splitlines()
    cells = [row.split(",", 1) for row in rows]
    times = [cells[k - (k % (kept + 1) == kept)][0] for k in range(len(cells))]
    lines = [f"{time},{rest}" for time, (_, rest) in zip(times, cells, strict=True)]
    log = _written(tmp_path, "\n".join([first, *lines]) + "\n")
    draft = draft_experiment([log], urdf=tmp_path / "robot.urdf")
    asked = [one.question for one in draft.questions if one.key == "stamp"]
    assert [text[:46] for text in asked] == ["most times of time_s come twice or more, or on"] * is_asked
    assert all('{ column = "time_s", unit = "s" } uses only rows that rise' in text for text in asked)
    assert "a load cell or a sensor of three axes" not in draft.content  # of a wrench nothing else is offered


@pytest.mark.parametrize("lacking", ["nan", ""])
def test_a_missing_time_is_named_by_its_row(tmp_path: Path, lacking: str) -> None:
    """No stamp reads it: the row is to be deleted, and the question of the file without it is gone."""
    first, *rows = log_text().splitlines()
    texts = [[first, *rows[:5], lacking + rows[5][rows[5].index(",") :], *rows[6:]], [first, *rows[:5], *rows[6:]]]
    asked = []
    for lines in texts:
        log = _written(tmp_path, "\n".join(lines) + "\n")
        draft = draft_experiment([log], urdf=tmp_path / "robot.urdf")
        asked.append([one.question for one in draft.questions if one.key == "stamp"])
    assert [len(one) for one in asked] == [1, 0]
    assert asked[0][0].startswith("row 6 has no time_s: delete rows without a time, then { column =")


def test_an_open_question_stops_every_command_by_its_line(tmp_path: Path, drafted: str) -> None:
    """The file, the line, the key, the others and what is asked; each answer brings the next, the last one the file."""
    file = tmp_path / "experiment.toml"
    asked = list(ANSWERS)
    for answers in range(len(asked)):
        text = answered(drafted, {key: ANSWERS[key] for key in asked[:answers]})
        file.write_text(text, encoding="utf-8")
        line = next(k for k, words in enumerate(text.splitlines(), start=1) if words.startswith(f"{asked[answers]} ="))
        with pytest.raises(FormatError, match=rf"experiment.toml:{line}: {asked[answers]} is still to be filled in"):
            parse_experiment(file)
    file.write_text(answered(drafted, ANSWERS), encoding="utf-8")
    assert parse_experiment(file).sensor[0].serial == "FT-28"


def test_a_question_mark_in_a_name_or_a_comment_asks_nothing() -> None:
    """Only a value that is nothing else is a question; signs in texts before it are no comments."""
    text = 'a = "why?"\n# b = "?"\nc = { x = "a#b", d = "?" }, # d: which\ne = ["?"]\n'
    assert [(one.line, one.key, one.words) for one in unanswered_keys(text)] == [(3, "d", "d: which"), (4, "e", "")]


def test_a_push_is_in_no_interval(drafted: str) -> None:
    """What is offered is free of it, covers most of the rest, and is for calibration and validation."""
    intervals = tomllib.loads(drafted)["interval"]
    spans = [(one["start_s"], one["end_s"]) for one in intervals]
    assert {one["use"] for one in intervals} == {"calibration", "validation"}
    assert all(end <= PUSH_S[0] or start >= PUSH_S[1] for start, end in spans)
    assert sum(end - start for start, end in spans) > 50.0


@pytest.mark.parametrize(("force", "lever"), [((0, 12, 0), (0.3, 0.1, 0.3)), ((7, 7, 7), (0, 0, 0.6))])
def test_a_push_that_is_steady_in_the_axes_of_the_sensor_is_in_no_interval(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, force: tuple[float, ...], lever: tuple[float, ...]
) -> None:
    """12 N for 5 s, which the moments seem to explain; without the comparison of `inspect` it is in an interval."""
    start, end = 5.0, 10.0
    push = [*force, *np.cross(lever, force)]
    heading, *rows = log_text().splitlines()
    cells = [row.split(",") for row in rows]
    for row in cells:
        if start <= float(row[0]) < end:
            row[6:] = [f"{float(value) + more:.4f}" for value, more in zip(row[6:], push, strict=True)]
    log = _written(tmp_path, "\n".join([heading, *map(",".join, cells)]) + "\n")

    def shared_s() -> tuple[float, float]:
        """Time of all intervals, and of what they have of the push."""
        text = draft_experiment([log], urdf=tmp_path / "robot.urdf").content
        spans = [(one["start_s"], one["end_s"]) for one in tomllib.loads(text)["interval"]]
        return sum(b - a for a, b in spans), sum(max(0.0, min(b, end) - max(a, start)) for a, b in spans)

    total, of_push = shared_s()
    assert total > 40.0
    assert of_push == 0.0
    monkeypatch.setattr("forcetorque.inspection.draft.draft.contact_spans", lambda *_, **__: [])
    assert shared_s()[1] > 4.0


@pytest.mark.parametrize("direction", list(MeasureDirection))
def test_accelerations_tell_who_acts_on_whom(tmp_path: Path, direction: MeasureDirection) -> None:
    """The other sign of the same log gives the other direction, and gravity the other way."""
    sign = 1.0 if direction is MeasureDirection.CHILD_TO_PARENT else -1.0
    table = pacsv.read_csv(FOLDER / "log.csv")
    values = {name: table[name] for name in table.column_names[:6]}
    values |= {name: sign * column for name, column in zip(table.column_names[6:], reading().T, strict=True)}
    (tmp_path / "robot.urdf").write_text(robot_text(), encoding="utf-8")
    pacsv.write_csv(pa.table(values), tmp_path / "log.csv", pacsv.WriteOptions(quoting_style="none"))
    draft = draft_experiment([tmp_path / "log.csv"], urdf=tmp_path / "robot.urdf")
    asked = {question.key: question.question for question in draft.questions}
    assert f"the accelerations in the log say {direction}" in asked["measure_direction"]
    along = re.search(r"along \[([^\]]*)\]", asked["gravity_direction"])
    assert along is not None
    np.testing.assert_allclose([float(x) for x in along[1].split(", ")], [0, 0, -sign], atol=0.02)


def test_a_reading_that_does_not_turn_tells_nothing(tmp_path: Path) -> None:
    """Negative control: noise in place of the wrench gives no evidence, no interval and no direction."""
    rng = np.random.default_rng(4)
    lines = log_text().splitlines()
    rows = [",".join([*row.split(",")[:6], *(f"{x:.3f}" for x in rng.normal(0, 5, 6))]) for row in lines[1:]]
    _written(tmp_path, "\n".join([lines[0], *rows]) + "\n")
    draft = draft_experiment([tmp_path / "log.csv"], urdf=tmp_path / "robot.urdf")
    assert "the accelerations" not in draft.content
    assert [one["label"] for one in tomllib.loads(draft.content)["interval"]] == ["all"]
    assert any("does not turn with it as a weight does" in words for words in draft.notes)


def test_bare_headings_leave_units_open(tmp_path: Path) -> None:
    """Nothing is decided by names or numbers: what is likely is said and asked, and serves for a first look alone."""
    lines = log_text().splitlines()
    heading = re.sub(r"_(?:s|rad|Nm|N)\b", "", lines[0])
    _written(tmp_path, "\n".join([heading, *lines[1:]]) + "\n")
    draft = draft_experiment([tmp_path / "log.csv"], urdf=tmp_path / "robot.urdf")
    assert _keys(draft.content)[:3] == ["unit", "units", "units"]
    assert "s makes 25 Hz and 63.96 s" in draft.content
    assert any("looked at with the likeliest units" in words for words in draft.notes)
    assert (draft.streams, len(tomllib.loads(draft.content)["interval"])) == ({}, 3)


@pytest.mark.parametrize(
    ("heading", "name", "unit"),
    [
        ("fx [N]", "fx", "N"),
        ("tx (N-m)", "tx", "N m"),
        ("Fx_N", "Fx", "N"),
        ("Fx_kgf", "Fx", "kgf"),
        ("Mx (kgf-cm)", "Mx", "kgf cm"),
        ("Mx_lbfin", "Mx", "lbf in"),
        ("joint_n", "joint_n", None),
        ("time_s", "time", "s"),
        ("x_s", "x_s", None),
        ("q_rad", "q", "rad"),
        ("T [°C]", "T", "degC"),
        ("load [stone]", "load [stone]", None),
        ("force_a", "force_a", None),
    ],
)
def test_headings_state_units_or_none(heading: str, name: str, unit: str | None) -> None:
    """A letter that may be part of a name is no unit."""
    assert (read_heading(heading).name, read_heading(heading).unit) == (name, unit)


def test_columns_look_like_what_they_are_called() -> None:
    """Six of a wrench in any spelling, joints by name, rotations by rows; three g may be two things."""
    names = ["t", "wrench.force.x", "wrench.force.y", "wrench.force.z", "wrench.torque.x", "wrench.torque.y"]
    names += ["wrench.torque.z", "gx", "gy", "gz", "actual_q_elbow", "elbow_vel", "qx", "qy", "qz", "qw"]
    names += [f"ch{k}" for k in range(6)]
    seen = {one.quantity: one for one in column_matches([read_heading(name) for name in names], ["elbow"])}
    assert seen["wrench"].columns == (1, 2, 3, 4, 5, 6)
    assert (seen["position"].columns, seen["velocity"].columns) == ((10,), (11,))
    assert seen["?"].words == "gravity or angular_velocity"
    assert seen["orientation"].form == "quat_xyzw"
    assert seen["raw"].columns == tuple(range(16, 22))
    assert column_matches([read_heading(name) for name in ("fx", "fy", "fz", "note")], []) == ()


def test_four_elements_of_a_list_with_norm_1_are_an_orientation(tmp_path: Path) -> None:
    """In a pose too; the order of the four is asked unless the name states it. Negative control: another norm."""
    rng = np.random.default_rng(7)
    fours = rng.normal(size=(50, 4))
    fours /= np.linalg.norm(fours, axis=1, keepdims=True)
    columns = {"time": 0.01 * np.arange(50), "ft": rng.normal(size=(50, 6))}
    for name, values, form in (
        ("tcp_pose", np.hstack([rng.normal(size=(50, 3)), fours]), None),
        ("quat_wxyz", fours, "quat_wxyz"),
        ("quat_xyzw", 2.0 * fours, ""),
    ):
        path = tmp_path / f"{name}.parquet"
        lists = {key: list(array) for key, array in (columns | {name: values}).items()}
        pq.write_table(pa.table(lists), path)
        draft = draft_experiment(path)
        text = draft.content
        assert ('quantity = "orientation"' in text) is (form != "")
        if form is None:
            assert f'columns = ["{name}[3]", "{name}[4]", "{name}[5]", "{name}[6]"]' in text
            assert {"form", "sense"} <= {question.key for question in draft.questions}
        elif form:
            assert f'orientation = {{ form = "{form}", sense = "?" }}' in text


def test_messages_of_joints_as_a_table_are_of_joints() -> None:
    """As PlotJuggler names them by topic, as rostopic counts them; what is wanted of joints is not where they are."""
    robot = ["shoulder", "elbow", "wrist"]
    names = ["/arm/joint_states/elbow/position", "/arm/joint_states/wrist/position", "/arm/joint_states/elbow/effort"]
    names += ["/target/elbow/position", "field.name0", "field.velocity0", "field.velocity1", "field.wanted0"]
    seen = {one.quantity: one for one in column_matches([read_heading(name) for name in names], robot)}
    assert (seen["position"].columns, seen["position"].names) == ((0, 1), ("elbow", "wrist"))
    assert (seen["torque"].columns, seen["torque"].names) == ((2,), ("elbow",))
    assert (seen["velocity"].columns, seen["velocity"].names) == ((5, 6), None)
    assert len(seen) == 3


def test_joints_by_number_are_joints_however_many() -> None:
    """As many as the robot has by any letter, fewer where the heading says joint; the word behind is the quantity."""
    robot = ["shoulder", "elbow", "wrist"]

    def seen(*names: str) -> dict[str, tuple[int, ...]]:
        return {one.quantity: one.columns for one in column_matches([read_heading(name) for name in names], robot)}

    assert seen("j1_rad", "j2_rad", "j3_rad") == {"position": (0, 1, 2)}
    assert seen("joint1", "joint2") == {"position": (0, 1)}
    assert seen("joint1_vel", "joint2_vel", "joint1_pos", "joint2_pos") == {"velocity": (0, 1), "position": (2, 3)}
    assert seen("q1", "q2") == {}
    assert seen("j1", "j2", "j3", "j4") == {}


def test_roll_pitch_and_yaw_are_an_orientation_where_no_joint_tells_it(tmp_path: Path) -> None:
    """Their axes are questions, whose answers are taken; angles of a neck are none."""
    head = "t_s,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,tcp_yaw_deg,tcp_roll_deg,tcp_pitch_deg"
    rows = "\n".join(f"{k},1,2,3,4,5,6,{k},10,20" for k in range(9))
    (tmp_path / "log.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
    text = draft_experiment([tmp_path / "log.csv"]).content
    assert _keys(text)[:4] == ["frame", "axes", "about", "sense"]
    answers = {"frame": '"ft_sensor"', "axes": '"xyz"', "about": '"fixed"', "sense": '"sensor_to_world"'}
    signal = tomllib.loads(answered(text, answers))["recording"]["stream"][0]["signal"][1]
    assert signal["columns"] == ["tcp_roll_deg", "tcp_pitch_deg", "tcp_yaw_deg"]
    assert signal["units"] == ["deg"] * 3
    table = {**signal["orientation"], "gravity": 9.8}
    assert OrientationTable.model_validate(table).layout().axes == "xyz"
    assert column_matches([read_heading(f"neck_{name}") for name in ("roll", "pitch", "yaw")], []) == ()


def test_headings_of_another_language_are_a_wrench_by_their_units(tmp_path: Path) -> None:
    """With decimal commas, and rotation vectors whose form is asked; of two sensors none is chosen."""
    names = [f"{word} {axis} [{unit}]" for word, unit in (("Kraft", "N"), ("Drehmoment", "Nm")) for axis in "XYZ"]
    head = ";".join(["Zeit [s]", "RX [rad]", "RY [rad]", "RZ [rad]", *names])
    rows = "\n".join(f"{k},5;0,1;0,2;0,3;1,5;2,5;3,5;4,5;5,5;{k},25" for k in range(9))
    (tmp_path / "log.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
    text = draft_experiment([tmp_path / "log.csv"]).content
    assert _keys(text) == ["frame", "form", "sense", "serial", "measure_direction"]
    (stream,) = tomllib.loads(text)["recording"]["stream"]
    assert [signal["quantity"] for signal in stream["signal"]] == ["orientation", "wrench"]
    assert stream["signal"][1]["columns"] == names
    answers = {"form": "rotation_vector", "sense": "sensor_to_world", "gravity": 9.8}
    assert OrientationTable.model_validate(answers).layout().count == 3
    two = [read_heading(f"{name[:-4]} {side} {name[-4:]}") for side in "AB" for name in names]
    assert column_matches(two, []) == ()
    by_side = [read_heading(f"{side} {name}") for side in ("links", "rechts") for name in names]
    assert column_matches(by_side, []) == ()


_WRENCH = "Fx [N],Fy [N],Fz [N],Tx [Nm],Ty [Nm],Tz [Nm]"
_TAXELS = ",".join(f"left_taxel_{k}" for k in range(12))


def _axes(text: str) -> str:
    return ",".join(text.replace("?", axis) for axis in "xyz")


@pytest.mark.parametrize(
    ("others", "expected"),
    [
        (_axes("transform.rotation.?") + ",transform.rotation.w", {"orientation": "transform.rotation.x"}),
        (_axes("rv_?") + ",rv_w", {}),
        (f"{_axes('Soll ? [N]')},{_axes('Sollmoment ? [Nm]')},{_WRENCH}", {"wrench": "Fx [N]"}),
        (f"{_axes('Soll ? [N]')},{_axes('Sollmoment ? [Nm]')},fx,fy,fz,tx,ty,tz", {"wrench": "fx"}),
        (f"{_axes('TCP force ? [N]')},{_axes('TCP force r? [Nm]')}", {"wrench": "TCP force x [N]"}),
        (_axes("r_? [rad/s]"), {}),
        ("roll [rad/s],pitch [rad/s],yaw [rad/s]", {}),
        (f"{_axes('target_TCP_pose_r?')},{_axes('actual_TCP_pose_r?')}", {"orientation": "actual_TCP_pose_rx"}),
        (_axes("target_TCP_pose_r?"), {"orientation": "target_TCP_pose_rx"}),
        *(
            (f"{_axes(f'{word}_f?')},{_axes(f'{word}_t?')},{_axes('f?')},{_axes('t?')}", {"wrench": "fx"})
            for word in ("cmd", "commanded", "Reference", "Soll", "setpoint", "other")
        ),
        (f"{_axes('goal_f?')},{_axes('goal_t?')},{_axes('ft_f?')},{_axes('ft_t?')}", {"wrench": "ft_fx"}),
        (f"{_axes('goalie_f?')},{_axes('goalie_t?')},{_axes('ft_f?')},{_axes('ft_t?')}", {"wrench": "goalie_fx"}),
        (f"tempo [s],{_WRENCH}", {"wrench": "Fx [N]"}),
        ("temps [s],temp [degC]", {"temperature": "temp [degC]"}),
        (f"{_WRENCH},pressure [kPa]", {"wrench": "Fx [N]"}),
        (f"{_TAXELS},pressure [kPa]", {"taxel_counts": "left_taxel_0", "pressure": "pressure [kPa]"}),
        (",".join(f"taxel_{k} [N]" for k in range(12)), {}),
        (",".join(f"cell_{k}" for k in range(12)), {}),
        (",".join(f"taxel_{k} [counts]" for k in range(12)), {"taxel_counts": "taxel_0 [counts]"}),
        (f"{_TAXELS},{_TAXELS.replace('left', 'right')}", {"taxel_counts": "left_taxel_0"}),
    ],
)
def test_columns_are_read_as_no_other_quantity(tmp_path: Path, others: str, expected: dict[str, str]) -> None:
    """Units and a fourth component exclude a quantity; a desired value is not taken where a measured one is."""
    names = others.split(",")
    rows = [
        ",".join([str(row / 100), *(f"{0.1 * (k % 5) - 0.01 * row:.3f}" for k in range(len(names)))]) for row in (0, 1)
    ]
    _written(tmp_path, "\n".join([f"time_s,{others}", *rows]) + "\n")
    draft = draft_experiment([tmp_path / "log.csv"])
    (stream,) = tomllib.loads(draft.content)["recording"]["stream"]
    signals = {one["quantity"]: one["columns"][0] for one in stream["signal"] if one["quantity"] != "?"}
    assert signals == expected
    (answer,) = draft.answers()
    left_out = "right_" in others or others.count("TCP_pose") > 3 or others.count("fx") > 1
    assert any("left out; other columns are its" in text for text in answer.why) == left_out


@pytest.mark.parametrize("heading", ["{}joint_states/position/{}", "{}_joint_state_position_{}"])
def test_commanded_joints_are_not_taken_where_measured_ones_are(tmp_path: Path, heading: str) -> None:
    """Where they come first too; alone they are taken, which is said."""
    model = read_urdf(ARM_URDF)
    joints = [name for name, joint in model.joints.items() if joint.type != "fixed"]
    ends = joints if "/" in heading else [str(k) for k in range(len(joints))]
    desired, measured = ([heading.format(of, end) for end in ends] for of in ("/desired/", "/actual/"))
    both = [*desired, *measured]
    for names, said in ((both, "left out; other columns are its"), (desired, "commanded by their names")):
        columns = ["time_s", *names, *_WRENCH.split(",")]
        rows = [",".join(f"{0.1 * row + 0.01 * k:.3f}" for k in range(len(columns))) for row in range(3)]
        (tmp_path / "log.csv").write_text("\n".join([",".join(columns), *rows]) + "\n", encoding="utf-8")
        draft = draft_experiment([tmp_path / "log.csv"], urdf=ARM_URDF)
        (stream,) = tomllib.loads(draft.content)["recording"]["stream"]
        read = [one["columns"] for one in stream["signal"] if one["quantity"] == "position"]
        assert read == [names[-len(joints) :]]
        (note,) = draft.left_out
        assert desired[0] in note
        assert said in note


def test_a_commanded_array_is_not_taken_where_a_measured_one_is() -> None:
    """Whatever their order in the file; alone it is taken."""
    arrays = [SketchedColumns(name=name, rows=9, columns=6) for name in ("cmd_wrench", "wrench")]
    for names, place in ((arrays, 1), (arrays[::-1], 0), (arrays[:1], 0)):
        assert [(one.quantity, one.columns) for one in array_groups(names, ())] == [("wrench", (place,))]


def test_a_time_is_no_temperature() -> None:
    """It is passed over for the next column that is called so."""
    names = [read_heading(name) for name in ("tempo", "temp")]
    (match,) = column_matches(names, [], time=0)
    assert match.columns == (1,)


def test_counts_of_taxels_are_a_patch(tmp_path: Path) -> None:
    """With a pressure they are to be fitted, without one a layout is asked; of a few cells none is made."""

    def draft_of(names: list[str], word: str = "taxel", count: int = 12) -> Draft:
        head = ",".join(["time_s", *(f"{word}_{k}" for k in range(count)), *names])
        rows = "\n".join(",".join(map(str, [k / 10, *[240 - k] * (count + len(names))])) for k in range(30))
        (tmp_path / "skin.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
        return draft_experiment([tmp_path / "skin.csv"], tmp_path / "skin.toml", force=True)

    fitted = draft_of(["pressure_kPa"])
    assert [one.key for one in fitted.questions] == ["name", "pressure_of"]
    content = tomllib.loads(fitted.content)
    (patch,), (interval,) = content["patch"], content["interval"]
    assert (patch["counts"], patch["pressure"], interval["use"]) == ("skin", "skin", "calibration")
    text = answered(fitted.content, {"name": '"pad"', "pressure_of": '"chamber"'})
    (tmp_path / "skin.toml").write_text(text, encoding="utf-8")
    assert resume_experiment(tmp_path / "skin.toml").proposals == ()
    (answer,) = resume_experiment(tmp_path / "skin.toml").answers()
    assert (answer.verdict, answer.command) == ("COMPLETE", f"inspect {tmp_path / 'skin.toml'}")
    assert [one.key for one in draft_of([]).questions] == ["name", "layout"]
    assert "[[patch]]" not in draft_of([], "taxel", 6).content


def test_taxels_beside_a_sensor_ask_nothing(tmp_path: Path) -> None:
    """Their patch is there to be taken up: with its lines uncommented it asks for name and layout."""
    others = ",".join(f"taxel_{k}" for k in range(12))
    rows = "\n".join(",".join([f"{k / 10}", *["240"] * 12, *map(str, range(k, k + 6))]) for k in range(30))
    (tmp_path / "log.csv").write_text(f"time_s,{others},{_WRENCH}\n{rows}\n", encoding="utf-8")
    draft = draft_experiment([tmp_path / "log.csv"])
    assert "layout" not in [one.key for one in draft.questions]
    content = tomllib.loads(draft.content)
    assert [one["name"] for one in content["sensor"]] == ["ft_sensor"]
    assert "patch" not in content
    taken_up = re.sub(r"(?m)^# (?=\[\[patch|name = |counts = |layout = )", "", draft.content)
    patch = tomllib.loads(taken_up)["patch"]
    assert patch == [{"name": "?", "counts": "log", "layout": "?"}]


def test_forces_and_moments_without_units_have_ranges_of_their_own(tmp_path: Path) -> None:
    """One range of both would hide that moments are in N mm."""
    rows = "\n".join(f"{k},{k},{k},{k},{1000 * k},0,0" for k in range(9))
    (tmp_path / "log.csv").write_text(f"t_s,fx,fy,fz,tx,ty,tz\n{rows}\n", encoding="utf-8")
    asked = {one.key: one.question for one in draft_experiment([tmp_path / "log.csv"]).questions}
    assert asked["units"].endswith("forces run from 0 to 8, moments from 0 to 8000")


def test_counts_are_not_taken_for_newtons(tmp_path: Path) -> None:
    """Millions of newtons are counts: the question says how their size is stated, and no answer is likely."""
    rows = "\n".join(f"{k / 10},{1e6 * k},2000000,-9000000,1000,2000,{k}" for k in range(20))
    (tmp_path / "log.csv").write_text(f"t_s,fx,fy,fz,tx,ty,tz\n{rows}\n", encoding="utf-8")
    draft = draft_experiment([tmp_path / "log.csv"])
    (units,) = (one.question for one in draft.questions if one.key == "units")
    assert '"1e-6 N" where 1000000 are a newton; forces run from -9e+06 to 1.9e+07' in units
    assert '"N", "N"' not in units


def test_what_goes_with_a_log_is_no_log(tmp_path: Path) -> None:
    """A robot and a calibration are called what they are, with where they belong."""
    with pytest.raises(FormatError, match=r"got the URDF of a robot: `forcetorque init LOG --urdf"):
        draft_experiment([BIPED_URDF])
    (tmp_path / "matrix.csv").write_text("\n".join(["1,2,3,4,5,6"] * 6), encoding="utf-8")
    with pytest.raises(FormatError, match=r"got the calibration that a sensor came with: .* prior"):
        draft_experiment([tmp_path / "matrix.csv"])
    (tmp_path / "other.xml").write_text("<mujoco/>", encoding="utf-8")
    with pytest.raises(FormatError, match="found none of them"):
        draft_experiment([tmp_path / "other.xml"])


def test_a_wrist_sensor_without_a_robot_has_a_load(tmp_path: Path) -> None:
    """Several tables are one recording; the pose is the motion of the load, and who acts on whom is asked."""
    (tmp_path / "wrench.csv").write_text("t_s,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm\n0,1,2,3,4,5,6\n1,1,2,3,4,5,7\n")
    (tmp_path / "pose.csv").write_text("t_s,qx,qy,qz,qw\n0,0,0,0,1\n1,0,0,0,1\n")
    draft = draft_experiment([tmp_path / "wrench.csv", tmp_path / "pose.csv"], tmp_path / "x.toml")
    content = tomllib.loads((tmp_path / "x.toml").read_text(encoding="utf-8"))
    assert content["load"]["motion"] == ["pose"]
    assert content["recording"]["stream"][1]["signal"][0]["orientation"] == {"form": "quat_xyzw", "sense": "?"}
    assert _keys(draft.content) == ["frame", "sense", "serial", "measure_direction"]
    with pytest.raises(OutputError, match="x.toml: expected a new file"):
        draft_experiment([tmp_path / "wrench.csv"], tmp_path / "x.toml")


def test_logged_gravity_stands_beside_an_orientation(tmp_path: Path) -> None:
    """As a comment that may take its place, which a turn rate does not; full scale may be left out."""
    head = "t_s,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,qx,qy,qz,qw,gx,gy,gz\n"
    row = ",1,2,3,4,5,6,0,0,0,1"
    for down, is_gravity in ((9.81, True), (1.0, True), (0.4, False)):
        (tmp_path / "log.csv").write_text(f"{head}0{row},0,0,-{down}\n1{row},0,{down},0\n")
        draft = draft_experiment([tmp_path / "log.csv"])
        assert ('# quantity = "gravity"\n# columns = ["gx", "gy", "gz"]' in draft.content) is is_gravity
        assert ("# not read: gx, gy, gz" in draft.content) is not is_gravity
    (scale,) = (line for line in draft.content.splitlines() if "full_scale" in line)
    assert scale.startswith("# full_scale = [300, 300, ")
    assert scale.endswith("`payload` needs none, `calibrate` does")


@pytest.mark.parametrize("kept", ["orientation", "proper_acceleration"])
def test_an_acceleration_beside_an_orientation_is_no_second_motion(tmp_path: Path, kept: str) -> None:
    """The answered file loads as drafted, and with the alternative that stands in its comments."""
    head = "t_s,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,ax [m/s2],ay [m/s2],az [m/s2],qx,qy,qz,qw"
    rows = "\n".join(f"{k},1,2,3,4,5,{k},0,0,9.80665,0,0,0,1" for k in range(9))
    (tmp_path / "log.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
    text = draft_experiment([tmp_path / "log.csv"], tmp_path / "x.toml").content
    if kept != "orientation":
        first, other = text.index('quantity = "orientation"'), text.index("# the motion is that of orientation")
        commented, sensor = text.index("# [[recording", other), text.index("[[sensor]]")
        text = (
            text[:first].removesuffix("[[recording.stream.signal]]\n")
            + text[commented:sensor].replace("\n# ", "\n").removeprefix("# ")
            + text[sensor:]
        )
    text = answered(text, {**ANSWERS, "frame": '"ft_sensor"'}).replace('sense = "?"', 'sense = "sensor_to_world"')
    (tmp_path / "x.toml").write_text(text, encoding="utf-8")
    experiment = load_experiment(tmp_path / "x.toml")
    (stream,) = experiment.recording.streams.values()
    assert kept in text
    assert ("proper_acceleration" in stream.signals) is (kept != "orientation")
    _, root = SensorRun(experiment, "ft_sensor").motion(experiment.recording.intervals[0], ())
    np.testing.assert_allclose(root.proper_acceleration[0], [0.0, 0.0, 9.80665], atol=1e-9)


def test_boards_that_count_their_joints_are_asked_for_names(tmp_path: Path) -> None:
    """Rows of joints of the robot that have that number are proposed, those of the side first."""
    write_port(tmp_path / "log" / "left_leg" / "stateExt:o", "1 10.5 " + "(1 2 3 4 5 6) [ok] " * 10 + "(3) [ok]\n")
    write_port(tmp_path / "log" / "left_leg" / "analog:o", "1 10.5 1 2 3 4 5 6\n2 10.6 1 2 3 4 5 7\n")
    model = read_urdf(BIPED_URDF)
    rows = joint_rows(model, 6, "left_leg")
    assert rows
    assert all(joint.startswith("l_") for row in rows for joint in row)
    assert joint_rows(model, 6, "head") == []
    assert joint_rows(model, 6, "log")
    draft = draft_experiment([tmp_path / "log"], urdf=BIPED_URDF)
    asked = {question.key: question.question for question in draft.questions}
    assert str(rows[0]).replace("'", '"') in asked["joints"]
    sensor = tomllib.loads(draft.content)["sensor"][0]
    assert sensor["name"] == "l_leg_ft"
    assert asked["frame"].startswith("link that stands still")
    assert re.search(r": l_sole, r_sole.* or one of \d+ other ends of it$", asked["frame"])


@pytest.fixture
def two_legs(tmp_path: Path) -> Path:
    """A log with the sensors of two legs."""
    for side in ("left", "right"):
        rows = "".join(f"{k} {k}.5 1 2 3 4 5 {k}\n" for k in range(1, 5))
        write_port(tmp_path / "log" / f"{side}_leg" / "analog:o", rows)
    return tmp_path / "log"


def test_a_sensor_is_drafted_alone(two_legs: Path) -> None:
    """Neither the stream nor the questions of the others are in the file; an unknown one is refused with the known."""
    draft = draft_experiment([two_legs], urdf=BIPED_URDF, sensors=["r_leg_ft"])
    content = tomllib.loads(draft.content)
    assert [one["name"] for one in content["sensor"]] == ["r_leg_ft"]
    assert [one["name"] for one in content["recording"]["stream"]] == ["right_leg/analog:o"]
    with pytest.raises(ExperimentError, match=r"--sensor: the log has no sensor 'leg'; .*known: l_leg_ft"):
        draft_experiment([two_legs], urdf=BIPED_URDF, sensors=["leg"])


def test_an_estimated_wrench_is_a_sensor_where_it_is_alone_or_named(tmp_path: Path) -> None:
    """Controllers of arms publish one beside the sensor, about which nothing needs to be asked; the notes name it."""
    names = ("netft_wrench", "external_wrench_in_base")
    for name in names:
        (tmp_path / f"{name}.csv").write_text("t_s,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm\n0,1,2,3,4,5,6\n1,1,2,3,4,5,7\n")
    (tmp_path / "pose.csv").write_text("t_s,qx,qy,qz,qw\n0,0,0,0,1\n1,0,0,0,1\n")
    logs = [tmp_path / f"{name}.csv" for name in (*names, "pose")]
    for paths, wanted, expected in (
        (logs, (), ["netft_wrench"]),
        (logs[1:], (), ["external_wrench_in_base"]),
        (logs, (names[1],), ["external_wrench_in_base"]),
    ):
        draft = draft_experiment(paths, sensors=wanted)
        assert [one["stream"] for one in tomllib.loads(draft.content)["sensor"]] == expected
        left_out = [note for note in draft.notes if "left out, an estimated wrench" in note]
        assert len(left_out) == (paths == logs and not wanted)
        (answer,) = draft.answers()
        assert set(left_out) <= set(answer.why)
        streams = [one["name"] for one in tomllib.loads(draft.content)["recording"]["stream"]]
        assert set(names) & set(streams) == {*expected}
    assert not [one.key for one in draft_experiment(logs[:2]).questions if one.key == "frame"]


def test_an_estimated_wrench_is_known_by_whole_words_and_by_headings(tmp_path: Path) -> None:
    """A sensor with such letters in its name stays; columns of an estimate are passed over."""
    for name in ("half_extended", "shelf_ext", "external_wrench_sensor"):
        assert not is_estimated(name)
    for name in ("/arm/external_wrench", "O_F_ext_hat_K[0]", "wrench_estimated"):
        assert is_estimated(name)
    head = ["fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"]
    estimated = [f"external_wrench.{name}" for name in head]
    rows = ["0" + ",1" * 12, "1" + ",2" * 12]
    (tmp_path / "log.csv").write_text("\n".join([",".join(["t_s", *estimated, *head]), *rows]))
    (tmp_path / "b.csv").write_text("\n".join([",".join(["t_s", *estimated]), *(row[:13] for row in rows)]))
    draft = draft_experiment([tmp_path / "log.csv", tmp_path / "b.csv"])
    (stream,) = tomllib.loads(draft.content)["recording"]["stream"]
    assert stream["signal"][0]["columns"] == head
    assert draft.notes[0].startswith("b: left out, an estimated wrench")
    assert draft.notes[1].startswith("log: external_wrench.fx_N, ")


def test_an_estimated_wrench_beside_raw_channels_leaves_these(tmp_path: Path) -> None:
    """Only its columns are left out, of a table that has raw samples of a sensor."""
    head = ["fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"]
    channels = [f"ch{k}" for k in range(1, 7)]
    rows = ["0" + ",1" * 12, "1" + ",2" * 12]
    names = ["t_s", *channels, *(f"external_wrench_{name}" for name in head)]
    (tmp_path / "hand.csv").write_text("\n".join([",".join(names), *rows]))
    (tmp_path / "foot.csv").write_text("\n".join([",".join(["t_s", *head]), *(row[:13] for row in rows)]))
    draft = draft_experiment([tmp_path / "hand.csv", tmp_path / "foot.csv"])
    hand, foot = tomllib.loads(draft.content)["recording"]["stream"]
    assert [one["columns"] for one in (*hand["signal"], *foot["signal"])] == [channels, head]
    assert [one["stream"] for one in tomllib.loads(draft.content)["sensor"]] == ["hand"]
    assert draft.left_out == (
        "hand: external_wrench_fx_N, external_wrench_fy_N, external_wrench_fz_N and 3 more left out; an estimated "
        "wrench by its name",
    )


def test_the_size_of_several_sensors_is_asked_once(two_legs: Path) -> None:
    """As the accuracy of what they are fitted to; the file that is answered so is calibrated without full scales."""
    draft = draft_experiment([two_legs], two_legs.parent / "x.toml", urdf=BIPED_URDF)
    keys = _keys(draft.content)
    assert (keys.count("serial"), keys.count("full_scale"), keys.count("accuracy")) == (2, 0, 1)
    answers = {**ANSWERS, "accuracy": "{ force_N = 0.3, moment_Nm = 0.03 }", "frame": '"l_sole"', "support": '"l_sole"'}
    (two_legs.parent / "x.toml").write_text(answered(draft.content, answers), encoding="utf-8")
    accuracy = load_experiment(two_legs.parent / "x.toml").fit_options.accuracy
    assert accuracy is not None
    np.testing.assert_allclose(accuracy, [0.3, 0.3, 0.3, 0.03, 0.03, 0.03])


def test_matrix_files_give_priors_and_serial_numbers(two_legs: Path) -> None:
    """By the name of the sensor in that of the file, or the only one; else the file is asked, and has the number."""
    folder = two_legs.parent / "matrices"
    folder.mkdir()
    with pytest.raises(FormatError, match=r"--matrices .*expected a folder with matrix files, got one without any"):
        draft_experiment([two_legs], urdf=BIPED_URDF, matrices=folder)
    for serial in ("SN001", "SN002"):
        write_matrix_file(folder / f"matrix_{serial}.txt", encode_matrix(0.01 * np.eye(6)))
    file = two_legs.parent / "x.toml"
    asked = draft_experiment([two_legs], file, urdf=BIPED_URDF, matrices=folder).content
    assert _keys(asked)[:4] == ["prior", "serial", "prior", "serial"]
    assert "full_scale" not in asked
    replies = iter(["matrices/matrix_SN002.txt", "matrices/matrix_SN001.txt"])
    assert not answer_questions(file, lambda _: next(replies, ""))
    sensors = tomllib.loads(file.read_text(encoding="utf-8"))["sensor"]
    assert [one["serial"] for one in sensors] == ["SN002", "SN001"]
    (folder / "matrix_SN002.txt").unlink()
    (only,) = tomllib.loads(
        draft_experiment([two_legs], urdf=BIPED_URDF, sensors=["l_leg_ft"], matrices=folder).content
    )["sensor"]
    assert (only["serial"], only["prior"].split("/")[-1]) == ("SN001", "matrix_SN001.txt")


def test_what_is_left_out_is_said(tmp_path: Path) -> None:
    """Angles of an inertial port, of which the log does not say what they turn into what."""
    write_port(tmp_path / "log" / "inertial", "".join(f"{k} {k}.5 1 2 3 0 0 9.8 0 0 0 0 0 0\n" for k in range(1, 30)))
    (words,) = (note for note in draft_experiment([tmp_path / "log"]).notes if note.startswith("not read"))
    assert "not all of it: inertial; `forcetorque inspect" in words


def test_a_recording_of_our_own_leaves_nothing_of_itself_open(tmp_path: Path) -> None:
    """It says all; a tag of the URDF says place and sign. The answered file is read."""
    table = pacsv.read_csv(FOLDER / "log.csv")
    columns = [table[name].to_numpy() for name in table.column_names]
    joints = tuple(name.removesuffix("_rad") for name in table.column_names[1:6])
    position = Signal(
        quantity="position", values=np.stack(columns[1:6], axis=1), columns=joints, units=("rad",) * len(joints)
    )
    wrench = Signal.of_fixed("wrench", np.stack(columns[6:], axis=1), frame="arm_ft")
    stamps = np.rint(columns[0] * 1e9).astype(np.int64)
    stream = Stream(name="all", clock="log", stamp_ns=stamps, signals={"position": position, "wrench": wrench})
    write_recording(tmp_path / "recording", Recording(streams={"all": stream}))
    draft = draft_experiment([tmp_path / "recording"], tmp_path / "x.toml", urdf=ARM_URDF)
    assert _keys(draft.content) == ["serial", "full_scale", "gravity_direction"]
    (tmp_path / "x.toml").write_text(answered(draft.content, ANSWERS), encoding="utf-8")
    experiment = load_experiment(tmp_path / "x.toml")
    assert experiment.sensors[0].name == "arm_ft"
    assert len(experiment.recording.intervals) == 3


def test_what_is_no_log_is_said(tmp_path: Path) -> None:
    """Nothing there, a folder of several, several that are no tables, loose messages of a port."""
    with pytest.raises(MissingFileError, match="expected a log, there is none"):
        draft_experiment([tmp_path / "none.csv"])
    with pytest.raises(ExperimentError, match="expected a log to begin"):
        draft_experiment([])
    for name in ("a.csv", "b.csv"):
        (tmp_path / name).write_text("t,x\n0,1\n1,2\n", encoding="utf-8")
    with pytest.raises(FormatError, match=r"a folder of several: a.csv, b.csv; name one"):
        draft_experiment([tmp_path])
    (tmp_path / "port").mkdir()
    write_port(tmp_path / "port" / "ft", "1 10.5 1 2 3 4 5 6\n")
    with pytest.raises(FormatError, match="expected tables .* got yarp"):
        draft_experiment([tmp_path / "a.csv", tmp_path / "port"])
    (tmp_path / "loose").mkdir()
    (tmp_path / "loose" / "left_data.log").write_text("1 10.5 (1 2)\n", encoding="utf-8")
    with pytest.raises(FormatError, match="left_data.log looks like a port's: put it into a folder of its own"):
        inspect_log(tmp_path / "loose")


def test_whatever_a_table_holds_becomes_a_file_of_toml(tmp_path: Path) -> None:
    """Headings with quotes, marks and letters of any kind; the file is TOML, or the log is refused."""
    rng = np.random.default_rng(9)
    words = ['a"b', "c\\d", "x#y", "ü", "f [N]", "=", "{", "'", "?", "é\t", "1e9", "t", "fx", "\x7f"]
    drafted = 0
    for _ in range(60):
        names = rng.choice(words, size=4)
        rows = "\n".join(",".join(f"{x:.2f}" for x in rng.normal(size=4)) for _ in range(3))
        (tmp_path / "log.csv").write_text(f"{','.join(names)}\n{rows}\n", encoding="utf-8")
        try:
            draft = draft_experiment([tmp_path / "log.csv"])
        except ForceTorqueError:
            continue
        tomllib.loads(draft.content)
        drafted += 1
    assert drafted > 10


def test_a_robot_that_ends_at_its_sensor_has_a_tool(tmp_path: Path) -> None:
    """What hangs there is asked by name, on the link of the sensor's joint; a robot with a mass there has none."""
    bare = re.sub(
        r'(<link name="(?:upper_arm|forearm|hand)">\s*)<inertial>.*?</inertial>', r"\1", robot_text(), flags=re.S
    )
    _written(tmp_path, log_text(), bare)
    draft = draft_experiment([tmp_path / "log.csv"], urdf=tmp_path / "robot.urdf")
    assert _keys(draft.content)[-2:] == ["name", "link"]
    assert "the URDF has no mass there" in draft.content
    assert [one["support"] for one in tomllib.loads(draft.content)["interval"]] == ["base"] * 3


def test_a_log_with_neither_sensor_nor_robot_is_not_called_complete(tmp_path: Path) -> None:
    """No command could go on with its file; with the robot it is inspected."""
    log = write_table(tmp_path / "joints.csv", states(poses=2, samples=3))
    (alone,) = draft_experiment([log]).answers()
    assert (alone.verdict, alone.command) == ("NO SENSOR AND NO ROBOT", "")
    (beside,) = draft_experiment([log], urdf=ARM_URDF).answers()
    assert "NO SENSOR" not in beside.verdict
    assert any("no stream looks like the reading of a force-torque sensor" in words for words in beside.why)
    assert beside.command.startswith("init --resume ")


def test_tables_without_headings_have_a_list_of_names_each(tmp_path: Path) -> None:
    """A wrench and a pose in two texts make a sensor and its motion; as many lists as tables, or one for all."""
    rng = np.random.default_rng(5)
    turns = rng.normal(size=(40, 4))
    wrench, pose = tmp_path / "wrench.txt", tmp_path / "pose.txt"
    np.savetxt(wrench, rng.normal(size=(40, 6)), delimiter=", ", fmt="%.6f")
    np.savetxt(pose, turns / np.linalg.norm(turns, axis=1, keepdims=True), delimiter=", ", fmt="%.6f")
    names = [["fx", "fy", "fz", "tx", "ty", "tz"], ["qx", "qy", "qz", "qw"]]
    content = draft_experiment([wrench, pose], column_names=names).content
    assert content.count("[[sensor]]") == 1
    assert 'motion = ["pose"]' in content
    with pytest.raises(FormatError, match="once for each of 2 in their order, got them 3 times"):
        draft_experiment([wrench, pose], column_names=[*names, names[0]])
    assert "[[sensor]]" not in draft_experiment([wrench, pose]).content
