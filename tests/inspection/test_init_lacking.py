# SPDX-License-Identifier: BSD-3-Clause
"""What a log lacks is asked where it is needed, offered where it may be, and each answer is taken by the readers."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import unanswered_keys
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.draft.fault_corrections import DividedStream
from forcetorque.inspection.draft.proposals import Proposal, proposals
from forcetorque.inspection.draft.toml_lines import toml_value
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.inspection.inspect import inspect_log
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.simulation.robots import BIPED_URDF
from tests.cases import some_cases
from tests.scenes.tutorial_log import FOLDER

ANSWERS = {
    "serial": 'serial = "FT-28"',
    "full_scale": "full_scale = [200, 200, 200, 20, 20, 20]",
    "joint": 'joint = "arm_ft_joint"',
    "measure_direction": 'measure_direction = "child_to_parent"',
    "gravity_direction": "gravity_direction = [0.0, 0.0, -1.0]",
}
ROWS = [line.split(",") for line in (FOLDER / "log.csv").read_text(encoding="utf-8").splitlines()[:301]]


def _table(folder: Path, columns: list[int], *, name: str = "log", late_s: float = 0.0, above: str = "") -> Path:
    """Columns of the tutorial's log, stamped later, below other lines."""
    rows = [[row[k] for k in columns] for row in ROWS]
    if columns[0] == 0:
        rows[1:] = [[f"{float(row[0]) + late_s:.2f}", *row[1:]] for row in rows[1:]]
    file = folder / f"{name}.csv"
    file.write_text(above + "".join(f"{','.join(row)}\n" for row in rows), encoding="utf-8")
    return file


def _drafted(*logs: Path) -> str:
    return draft_experiment(logs, logs[0].parent / "experiment.toml", urdf=FOLDER / "robot.urdf").content


def _keys(text: str) -> list[str]:
    return [question.key for question in unanswered_keys(text)]


def _loaded(text: str, folder: Path, **more: str) -> Experiment:
    """The experiment with answers in place of the lines that ask; any other question would stop it."""
    (folder / "experiment.toml").write_text(_answered(text, **more), encoding="utf-8")
    return load_experiment(folder / "experiment.toml")


def _answered(text: str, **more: str) -> str:
    for key, answer in {**ANSWERS, **more}.items():
        text = re.sub(rf'^{key} = "\?".*$', answer, text, flags=re.MULTILINE)
    return text


def test_rows_without_a_time_may_have_a_rate(tmp_path: Path) -> None:
    """The question names both; the two lines below it, without their signs, are taken."""
    text = _drafted(_table(tmp_path, list(range(1, 12))))
    assert _keys(text) == ["stamp", *ANSWERS]
    uncommented = re.sub(r"^# (rate_hz|start_s) = ", r"\1 = ", text, flags=re.MULTILINE).replace("100.0", "25.0")
    recording = _loaded(uncommented, tmp_path, stamp="").recording
    np.testing.assert_array_equal(np.diff(recording.stream("log").stamp_ns), 40_000_000)
    assert [finding.kind for finding in recording.findings] == ["stated_rate"]


def test_arrays_without_a_time_are_offered_one(tmp_path: Path) -> None:
    """As tables are."""
    np.savez(tmp_path / "log.npz", wrench=np.random.default_rng(0).normal(size=(50, 6)))
    text = draft_experiment([tmp_path / "log.npz"]).content
    assert "time" in _keys(text)
    assert "# rate_hz" in text


def test_a_joint_that_the_sensor_needs_is_asked_for(tmp_path: Path) -> None:
    """Where it stood; a file of which all joints were logged asks for none."""
    text = _drafted(_table(tmp_path, [0, 1, 2, 3, 4, *range(6, 12)]))
    assert _keys(text) == ["wrist", *ANSWERS]
    recording = _loaded(text, tmp_path, wrist="wrist = 0.2").recording
    assert "wrist at 0.2" in recording.findings[0].message
    whole = tmp_path / "whole"
    whole.mkdir()
    assert "[robot.fixed]" not in _drafted(_table(whole, list(range(12))))


def test_a_joint_that_may_not_matter_is_offered(tmp_path: Path) -> None:
    """A robot that may stand on any limb needs some of its joints only: nobody is asked, a comment says how."""
    file = tmp_path / "log.csv"
    rows = "".join(f"{0.1 * k:.1f},0.1,0.2,1,2,3,4,5,6\n" for k in range(20))
    file.write_text(f"time_s,l_knee_rad,r_knee_rad,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm\n{rows}", encoding="utf-8")
    text = draft_experiment([file], urdf=BIPED_URDF).content
    assert "robot.fixed" not in text
    (offered,) = (line for line in text.splitlines() if line.startswith("# fixed = {"))
    assert list(tomllib.loads(offered.removeprefix("# "))["fixed"].values()) == [0.0]


@pytest.mark.parametrize(("late_s", "asked"), [(1000.0, True), (0.5, False)])
def test_clocks_of_two_tables(tmp_path: Path, late_s: float, asked: bool) -> None:
    """Without a time in common they are asked for; where stamps differ a table in comments is taken once it is none."""
    joints = _table(tmp_path, list(range(6)), name="joints")
    text = _drafted(joints, _table(tmp_path, [0, *range(6, 12)], name="wrist", late_s=late_s))
    assert ("delay_s" in _keys(text)) is asked
    if not asked:
        text = re.sub(r"^# (\[\[clock|stream =|to =|delay_s)", r"\1", text, flags=re.MULTILINE)
        text = text.replace('delay_s = "estimate"', f"delay_s = {late_s}")
    assert f"{late_s:.3f} s to " in text
    recording = _loaded(text, tmp_path, delay_s=f"delay_s = {late_s}").recording
    np.testing.assert_array_equal(recording.stream("wrist").stamp_ns, recording.stream("joints").stamp_ns)


def test_streams_of_clocks_with_names_are_asked_for(tmp_path: Path) -> None:
    """Nothing combines them before, though they have the same stamps; those of one clock have one question."""
    times = np.arange(200, dtype=np.int64) * 10_000_000
    rng = np.random.default_rng(1)

    def stream(name: str, clock: str, quantity: str, columns: tuple[str, ...], unit: str) -> Stream:
        values = rng.normal(size=(200, len(columns)))
        frame = None if quantity == "position" else "ft"
        signal = Signal(quantity=quantity, columns=columns, units=(unit,) * len(columns), values=values, frame=frame)
        return Stream(name=name, clock=clock, stamp_ns=times, signals={quantity: signal})

    axes = ("x", "y", "z")
    streams = (
        stream("joints", "robot", "position", ("wrist",), "rad"),
        stream("acc", "board", "proper_acceleration", axes, "m/s2"),
        stream("gyro", "board", "angular_velocity", axes, "rad/s"),
    )
    write_recording(tmp_path / "log", Recording(streams={one.name: one for one in streams}))
    text = draft_experiment([tmp_path / "log"], urdf=FOLDER / "robot.urdf").content
    (clock,) = (question for question in unanswered_keys(text) if question.key == "delay_s")
    assert "the clock 'board' stamped it, 'robot' stamped 'joints'" in clock.words
    assert 'stream = ["acc", "gyro"]\nto = "joints"' in text


def test_tables_with_open_units_have_clocks_too(tmp_path: Path) -> None:
    """A first look takes the likeliest answers, with a robot and without."""
    tables = {
        "wrench": "t,fx,fy,fz,tx,ty,tz\n" + "".join(f"{0.01 * k:.2f},1,2,3,4,5,6\n" for k in range(200)),
        "imu": "t,ax,ay,az\n" + "".join(f"{0.3 + 0.004 * k:.3f},0,0,9.8\n" for k in range(400)),
    }
    for name, text in tables.items():
        (tmp_path / f"{name}.csv").write_text(text, encoding="utf-8")
    text = draft_experiment([tmp_path / f"{name}.csv" for name in tables]).content
    assert '# stream = "imu"\n# to = "wrench"\n# delay_s = "estimate"' in text


def test_tables_with_the_same_stamps_have_one_clock(tmp_path: Path) -> None:
    """Nothing is asked or offered."""
    joints = _table(tmp_path, list(range(6)), name="joints")
    assert "clock" not in _drafted(joints, _table(tmp_path, [0, *range(6, 12)], name="wrist"))


@pytest.mark.parametrize(
    ("above", "skipped"),
    [("# of the logger\n# run 3\n\n", 3), ("Recorded today, by hand\nsensor: FT-28\n", 2), ("", None)],
)
def test_lines_in_front_of_a_table_are_skipped(tmp_path: Path, above: str, skipped: int | None) -> None:
    """They are counted, empty ones too, and the first is shown."""
    text = _drafted(_table(tmp_path, list(range(12)), above=above))
    assert _keys(text) == list(ANSWERS)
    assert tomllib.loads(text)["recording"]["stream"][0].get("skip_rows") == skipped
    assert len(_loaded(text, tmp_path).recording.stream("log")) == 300


def test_a_line_of_names_and_one_of_units_are_headings(tmp_path: Path) -> None:
    """Where headings state no unit themselves, the line below them does."""
    names = ",".join(name.rpartition("_")[0] for name in ROWS[0])
    units = ",".join(["s", *["rad"] * 5, *["N"] * 3, *["Nm"] * 3])
    file = _table(tmp_path, list(range(12)), above=f"log 7\n{names}\n{units}\n")
    file.write_text(file.read_text(encoding="utf-8").replace(f"{','.join(ROWS[0])}\n", ""), encoding="utf-8")
    text = _drafted(file)
    assert _keys(text) == list(ANSWERS)
    wrench = _loaded(text, tmp_path).recording.stream("log").signal("wrench").values
    np.testing.assert_allclose(wrench[0], [float(value) for value in ROWS[1][6:]])


@pytest.mark.parametrize(
    "text",
    [
        "title\n" + "1,2,3\n" * 7,
        "x,,z\n1,2,up\n2,3,down\n" + "1,2,3\n" * 20,
        "title\n" + "1,2,3\n" * 20 + "the end\n",
    ],
    ids=["too few rows", "rows of another kind", "prose behind"],
)
def test_no_row_is_taken_for_a_title(tmp_path: Path, text: str) -> None:
    """What is no table below its first lines is none."""
    (tmp_path / "log.csv").write_text(text, encoding="utf-8")
    with pytest.raises(FormatError):
        inspect_log(tmp_path / "log.csv")


def _thermometer(folder: Path) -> Path:
    rows = (f"{k:.1f},{25.0 + 0.01 * k:.2f}\n" for k in range(300))
    return _csv(folder / "thermometer.csv", "time_s,temperature_C\n", rows)


def _csv(file: Path, headings: str, rows: Iterable[str]) -> Path:
    file.write_text(headings + "".join(rows), encoding="utf-8")
    return file


def test_a_thermometer_alone_names_the_file_that_it_belongs_to(tmp_path: Path) -> None:
    """No answer makes it an experiment; together with the table of its sensor it is a variable of that."""
    table = _thermometer(tmp_path)
    draft = draft_experiment([table])
    (answer,) = draft.answers()
    assert (answer.verdict, _keys(draft.content)) == ("NO SENSOR AND NO ROBOT", ["units"])
    assert f"forcetorque init LOG {table}" in answer.why[1]
    assert '[[sensor.variable]] name = "temperature", stream = "thermometer"' in answer.why[1]
    sensor = _csv(
        tmp_path / "sensor.csv", "time_s,fx,fy,fz,tx,ty,tz\n", (f"{k:.1f},0,0,{k % 7},0,0,0\n" for k in range(300))
    )
    both = draft_experiment([table, sensor], tmp_path / "both.toml").content
    both = both.replace('units = "?"', 'units = ["degC"]', 1)
    both = both.replace('units = "?"', 'units = ["N", "N", "N", "N m", "N m", "N m"]', 1)
    (loaded,) = _loaded(both, tmp_path).sensors
    assert [one.source.stream for one in loaded.variables] == ["thermometer"]


@pytest.mark.parametrize("robot", [False, True])
def test_a_thermometer_beside_a_pose_or_a_robot_is_a_variable_as_comments(tmp_path: Path, robot: bool) -> None:
    """As they stand no sensor uses it, which the answer says; without the comment signs the sensor does."""
    table = _thermometer(tmp_path)
    rows = (f"{k:.1f},0,0,{k % 7},0,0,0,0,0,0,1\n" for k in range(300))
    sensor = _csv(tmp_path / "sensor.csv", "time_s,fx,fy,fz,tx,ty,tz,qx,qy,qz,qw\n", rows)
    draft = draft_experiment([table, sensor], tmp_path / "both.toml", urdf=FOLDER / "robot.urdf" if robot else None)
    (answer,) = draft.answers()
    assert any("thermometer: no sensor uses the temperature" in text for text in answer.why)
    (without,) = tomllib.loads(draft.content)["sensor"]
    assert "variable" not in without
    taken = re.sub(r"^# (\[\[sensor.variable|name = .temperature|stream = .therm)", r"\1", draft.content, flags=re.M)
    (with_it,) = tomllib.loads(taken)["sensor"]
    assert with_it == {**without, "variable": [{"name": "temperature", "stream": "thermometer"}]}


def test_a_second_column_of_times_has_its_clock_as_comments(tmp_path: Path) -> None:
    """As they stand nothing is moved; without the comment signs the pose is brought from its clock to the first."""
    log = _csv(
        tmp_path / "log.csv",
        "time_s,fx [N],fy [N],fz [N],tx [N m],ty [N m],tz [N m],t_pose [ms],qx,qy,qz,qw\n",
        (
            f"{0.1 * k:.1f},0,0,{k % 7},0,0,0,{100 * k + 90_000},{np.sin(0.01 * k):.7f},0,0,{np.cos(0.01 * k):.7f}\n"
            for k in range(300)
        ),
    )
    draft = draft_experiment([log])
    (answer,) = draft.answers()
    assert "t_pose [ms] rises as a second time" in " ".join(answer.why)
    assert _drafted_streams(draft.content) == ["log"]
    taken = re.sub(r"^# (?=\[\[|\w+ = )", "", draft.content, flags=re.MULTILINE).replace("# full_scale", "full_scale")
    assert _drafted_streams(taken) == ["log", "log_t_pose"]
    content = tomllib.loads(taken)
    assert [one["signal"][0]["quantity"] for one in content["recording"]["stream"]] == ["wrench", "orientation"]
    (clock,) = content["clock"]
    assert (clock["delay_s"], clock["around_s"]) == ("estimate", 90.0)


@pytest.mark.parametrize(
    ("columns", "named"),
    [
        ("t,q,ft_time,w", "[wrench] stream of [[sensor]] then names log_ft_time"),
        ("t,w,t_pose,q", "[orientation] motion of [load] then names log_t_pose"),
        ("t,w,t_receive,t_pose,q", "[orientation] motion of [load] then names log_t_pose"),
        ("t,t_receive,w,t_pose,q", "[orientation] motion of [load] then names log_t_pose"),
        ("t,w,q,t_pose", "[orientation] motion of [load] then names log_t_pose"),
        ("t,c,ft_time,w,q", "[wrench, orientation] stream of [[sensor]] and motion of [load] then name log_ft_time"),
        ("t,t_receive,w,q", ""),
        ("t,w,t_robot,j", "[position] "),
        ("t,j,ft_time,w", "[wrench] stream of [[sensor]] then names log_ft_time"),
    ],
)
def test_a_second_column_of_times_names_who_reads_the_new_stream(tmp_path: Path, columns: str, named: str) -> None:
    """That of the groups behind the last such column, also where the sensor is behind it, and on a robot."""
    joints = [name for name in ROWS[0] if name.endswith("_rad")]
    groups = {"w": "fx,fy,fz,tx,ty,tz", "q": "qx,qy,qz,qw", "j": ",".join(joints), "c": "temp_degC"}
    headings = [name for one in columns.split(",") for name in groups.get(one, one).split(",")]
    assert joints
    rows = (
        ",".join(f"{k + (n if name.startswith('t_') else 0.1)}" for n, name in enumerate(headings)) for k in range(9)
    )
    log = _csv(tmp_path / "log.csv", ",".join(headings) + "\n", (f"{row}\n" for row in rows))
    text = draft_experiment([log], urdf=FOLDER / "robot.urdf" if "j" in columns.split(",") else None).content
    words = re.findall(r"take these lines(?:; (.*))?$", text, flags=re.MULTILINE)
    behind = text.partition("take these lines")[2]
    moved = ", ".join(re.findall(r'^quantity = "(\w+)"', behind, flags=re.MULTILINE))
    assert [f"[{moved}] {one}" for one in words] == ([named] if named else [])


def _drafted_streams(text: str) -> list[str]:
    return [one["name"] for one in tomllib.loads(text)["recording"]["stream"]]


@some_cases("pose", ["joints", "orientation beside a variable", "orientation"], quick=2)
@pytest.mark.parametrize("late", [0, 3])
def test_a_delay_within_one_table_is_proposed_as_two_streams(tmp_path: Path, pose: str, late: int) -> None:
    """Of an arm and a wrist with the wrench three samples late; what is proposed leaves none, no delay gets it."""
    text = _late_arm(tmp_path, late) if pose == "joints" else _late_wrist(tmp_path, late)
    text = _with_supply(tmp_path / "log.csv", text) if "variable" in pose else text
    file = tmp_path / "experiment.toml"
    file.write_text(text, encoding="utf-8")
    delays = [one for one in proposals(file) if one.kind == "delay"]
    assert len(delays) == (late > 0)
    if not late:
        return
    (proposal,) = delays
    assert proposal.edit is not None
    changed = proposal.edit.applied(text)
    assert _drafted_streams(changed) == ["log", "log_motion"]
    content = tomllib.loads(changed)
    (clock,) = content["clock"]
    assert (clock["stream"], clock["to"]) == ("log", "log_motion")
    assert clock["delay_s"] == pytest.approx(0.04 * late, abs=0.005)
    if pose != "joints":
        assert content["load"]["motion"] == ["log_motion"]
    comments = [line for line in text.splitlines() if "#" in line]
    assert comments
    assert set(comments) <= set(changed.splitlines())
    file.write_text(changed, encoding="utf-8")
    assert not [one for one in proposals(file) if one.kind == "delay"]


@some_cases("form", ["lines", "comment in it", "one line"], quick=2)
def test_signals_in_a_list_are_divided(tmp_path: Path, form: str) -> None:
    """Also on several lines; where comments between them would be lost, it is left to a person, as `inspect` says."""
    text = _late_wrist(tmp_path, 3)
    content = tomllib.loads(text)
    (stream,) = content["recording"]["stream"]
    start = text.index("[[recording.stream.signal]]")
    signals = [toml_value(signal) for signal in stream["signal"]]
    between = {"one line": ", ", "lines": ",\n  ", "comment in it": ",  # N\n  # pose\n  "}[form]
    text = f"{text[:start]}signal = [{between.join(signals)}]  # all\n\n{text[text.index('[[sensor]]', start) :]}"
    content["recording"] = tomllib.loads(text)["recording"]
    division = DividedStream.of(content, "log", 0.12, ())
    assert division is not None
    edit = division.edit(text, content)
    if form == "comment in it":
        assert edit is None
        file = tmp_path / "experiment.toml"
        file.write_text(text, encoding="utf-8")
        (proposal,) = (one for one in proposals(file) if one.kind == "delay")
        assert proposal.edit is None
        assert "[[recording.stream]] of their own" in proposal.text
        (delay,) = (one for one in inspect_experiment(load_experiment(file)) if one.kind == "delay")
        assert "no comment stands within" in delay.message
        return
    assert edit is not None
    assert tomllib.loads(edit.applied(text)) == division.content(content, 0.12)
    kinds = [
        [one["quantity"] for one in stream["signal"]]
        for stream in division.content(content, 0.12)["recording"]["stream"]
    ]
    assert kinds == [["wrench"], ["orientation"]]


SLOW_TO_LOG = 'stream = "slow"\nto = "log"\ndelay_s = 5.0\n'
LOG_TO_SLOW = 'stream = "log"\nto = "slow"\ndelay_s = -5.0\ndrift = 1e-3\n'


def _late_wrist_beside(folder: Path, clock: str) -> str:
    _csv(folder / "slow.csv", "time_s,temp_degC\n", (f"{k + 5},25.0\n" for k in range(40)))
    slow = '[[recording.stream]]\nname = "slow"\nfile = "slow.csv"\nstamp = { column = "time_s", unit = "s" }\n'
    slow += '[[recording.stream.signal]]\nquantity = "temperature"\ncolumns = ["temp_degC"]\nunits = ["degC"]\n\n'
    return _late_wrist(folder, 3).replace("[[sensor]]", f"{slow}[[clock]]\n{clock}\n[[sensor]]", 1)


@pytest.mark.parametrize("clock", [SLOW_TO_LOG, LOG_TO_SLOW])
def test_a_table_of_another_clock_is_divided(tmp_path: Path, clock: str) -> None:
    """The delay between wrench and motion changes by what is found; what the file does to other stamps stays."""
    file, text = tmp_path / "experiment.toml", _late_wrist_beside(tmp_path, clock)
    file.write_text(text, encoding="utf-8")
    before = load_experiment(file).recording
    content = tomllib.loads(text)
    division = DividedStream.of(content, "log", 0.12, before.clocks)
    assert division is not None
    edit = division.edit(text, content)
    assert edit is not None
    file.write_text(edit.applied(text), encoding="utf-8")
    after = load_experiment(file).recording
    wrench, motion = after.stream("log"), after.stream("log_motion")
    assert list(wrench.signals) == ["wrench"]
    np.testing.assert_allclose(motion.stamp_ns - wrench.stamp_ns, 0.12e9, atol=1.0)
    assert wrench.clock == motion.clock == before.stream("log").clock
    kept = wrench if clock == LOG_TO_SLOW else motion
    np.testing.assert_array_equal(kept.stamp_ns, before.stream("log").stamp_ns)
    np.testing.assert_array_equal(after.stream("slow").stamp_ns, before.stream("slow").stamp_ns)


@pytest.mark.long
@pytest.mark.parametrize(
    ("clock", "written"),
    [
        (SLOW_TO_LOG, r'stream = "log", to = "log_motion", delay_s = 0\.1\d\d, in front of the others'),
        (LOG_TO_SLOW, r'stream = "log_motion", to = "log", delay_s = -5\.1\d\d, drift = 0\.001;'),
    ],
)
def test_two_streams_are_proposed_beside_other_clocks(tmp_path: Path, clock: str, written: str) -> None:
    """`inspect` names the same clock; with it no delay is left."""
    file, text = tmp_path / "experiment.toml", _late_wrist_beside(tmp_path, clock)
    file.write_text(text, encoding="utf-8")
    assert any(re.search(written, one.message) for one in inspect_experiment(load_experiment(file)))
    (proposal,) = (one for one in proposals(file) if one.kind == "delay")
    assert proposal.edit is not None
    file.write_text(proposal.edit.applied(text), encoding="utf-8")
    assert not [one for one in proposals(file) if one.kind == "delay"]


def _with_supply(log: Path, text: str) -> str:
    """A supply in V as a variable of the sensor, in the same table."""
    first, *rows = log.read_text(encoding="utf-8").splitlines()
    _csv(log, f"{first},supply\n", (f"{row},{5.0 + 0.1 * np.sin(0.02 * k):.4f}\n" for k, row in enumerate(rows)))
    signal = '[[recording.stream.signal]]\nquantity = "scalar"\ncolumns = ["supply"]\nunits = ["V"]\n\n'
    variable = '[[sensor.variable]]\nname = "supply"\nquantity = "scalar"\n\n'
    return text.replace("[[sensor]]", f"{signal}[[sensor]]").replace("[load]", f"{variable}[load]")


def _late_arm(folder: Path, late: int) -> str:
    rows = [line.split(",") for line in (FOLDER / "log.csv").read_text(encoding="utf-8").splitlines()]
    body = [[*row[:6], *rows[max(k - late, 1)][6:]] for k, row in enumerate(rows[1:], start=1)]
    _csv(folder / "log.csv", ",".join(rows[0]) + "\n", (",".join(row) + "\n" for row in body))
    return _answered(_drafted(folder / "log.csv"))


@pytest.mark.long
def test_delays_of_wrists_are_found_and_none_where_there_is_none(tmp_path: Path) -> None:
    """In all of 40 draws of motion and noise with 120 ms, within 10 ms; in none of the same 40 without it."""
    sizes = {
        late: [
            [_clock_delay(one) for one in _wrist_proposals(tmp_path, late, seed) if one.kind == "delay"]
            for seed in range(100, 140)
        ]
        for late in (3, 0)
    }
    assert sizes[0] == [[]] * 40
    np.testing.assert_allclose(sizes[3], 0.12, atol=0.01)


def _clock_delay(proposal: Proposal) -> float:
    assert proposal.edit is not None
    return next(float(line.split("=")[1]) for line in proposal.edit.new if line.startswith("delay_s"))


def _wrist_proposals(folder: Path, late: int, seed: int) -> tuple[Proposal, ...]:
    file = folder / "experiment.toml"
    file.write_text(_late_wrist(folder, late, seed), encoding="utf-8")
    return proposals(file)


def _late_wrist(folder: Path, late: int, seed: int = 40) -> str:
    rng = np.random.default_rng(seed)
    at_s = 0.04 * np.arange(1000)
    speeds, phases = rng.uniform(0.4, 1.4, 3), rng.uniform(0.0, 6.0, 3)
    angles = np.array([0.9, 1.2, 0.4]) * np.sin(at_s[:, None] * speeds + phases)
    angles = np.stack([angles[:, 0], angles[:, 1] + angles[:, 2]], axis=-1)
    world_R_sensor = np.stack([_turn(*pair) for pair in angles])
    force = -9.80665 * 1.2 * world_R_sensor[:, 2]
    wrench = np.hstack([force, np.cross([0.01, 0.0, 0.06], force)])
    wrench = wrench[np.maximum(np.arange(len(at_s)) - late, 0)]
    wrench += rng.normal(size=wrench.shape) * np.repeat([0.05, 0.002], 3)
    values = np.column_stack([at_s, wrench, world_R_sensor.reshape(-1, 9)])
    entries = ",".join(f"r{row}{column}" for row in "123" for column in "123")
    headings = f"time_s,fx [N],fy [N],fz [N],tx [N m],ty [N m],tz [N m],{entries}\n"
    _csv(folder / "log.csv", headings, (",".join(f"{value:.6f}" for value in row) + "\n" for row in values))
    text = draft_experiment(folder / "log.csv", folder / "experiment.toml", force=True).content
    answers = {"sense": "sensor_to_world", "frame": "ft_sensor", "measure_direction": "child_to_parent", "serial": "A"}
    for key, answer in answers.items():
        text = text.replace(f'{key} = "?"', f'{key} = "{answer}"')
    return text


def _turn(pitch: float, roll: float) -> FloatArray:
    (c, s), (k, n) = (np.cos(pitch), np.sin(pitch)), (np.cos(roll), np.sin(roll))
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]) @ np.array([[1.0, 0, 0], [0, k, -n], [0, n, k]])
