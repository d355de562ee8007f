# SPDX-License-Identifier: BSD-3-Clause
"""What an answered experiment file gets proposed: the planted error with its line, and nothing without one."""

from __future__ import annotations

import os
import shutil
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.wrench import MeasureDirection
from forcetorque.inspection.draft.proposals import Proposal, proposals, settle
from forcetorque.inspection.draft.questions import resume_experiment
from forcetorque.inspection.draft.toml_edits import Edit
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.results.terminal.options import has_piped_lines
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.simulated_sensor import SimulatedSensor
from forcetorque.simulation.trace import simulate_recording
from tests.app.outcome import Run
from tests.scenes.experiments import JOINTS, MOUNTED, OFFSET, PARQUET, TEXTS, TWO, write_experiments

DOWN = "gravity_direction = [0.0, 0.0, -1.0]"
ONE_INTERVAL = '[[interval]]\nlabel = "all"  # not cut yet\nstart_s = 0.0\nuse = "calibration"\nsupport = "base"\n'
PUSH_S = (6.0, 9.0)


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the experiment of the small arm."""
    folder = tmp_path_factory.mktemp("arm")
    write_experiments(folder)
    return folder


@pytest.fixture(scope="module")
def held(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the experiment of the small arm, so slow that weight is all that its sensors feel."""
    folder = tmp_path_factory.mktemp("held")
    write_experiments(folder)
    sensor = SimulatedSensor(matrix=MOUNTED, offset=OFFSET, noise_counts=4.0)
    recording = simulate_recording(
        read_urdf(folder / "arm.urdf").with_sensor(
            "tool_ft", joint="tool_joint", direction=MeasureDirection.PARENT_TO_CHILD
        ),
        {"arm_ft": sensor, "tool_ft": sensor},
        support="base",
        gravity_direction=[0.0, 0.0, -1.0],
        ranges=dict.fromkeys(JOINTS, (-2.2, 2.2)),
        duration_s=400.0,
        rate_hz=3.0,
        slowest_hz=0.007,
        seed=11,
    )
    write_recording(folder / "recording", recording)
    return folder


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An experiment of one interval, in which a push is steady in the axes of the sensor."""
    folder = tmp_path_factory.mktemp("pushed")
    write_experiments(folder)
    recording = read_recording(folder / "recording")
    stream = recording.stream("arm_ft")
    signal, seconds = stream.signal("raw"), (stream.stamp_ns - recording.start_ns) * 1e-9
    values = signal.values.copy()
    own = (seconds > PUSH_S[0]) & (seconds < PUSH_S[1])
    values[own] += np.linalg.inv(MOUNTED) @ np.array([0.0, 12.0, 0.0, 3.0, 0.0, 1.0])
    moved = replace(stream, signals={**stream.signals, "raw": replace(signal, values=values)})
    write_recording(folder / "recording", replace(recording, streams={**recording.streams, "arm_ft": moved}))
    text = TEXTS[PARQUET]
    (folder / "all.toml").write_text(text[: text.index("[[interval]]")] + ONE_INTERVAL, encoding="utf-8")
    return folder


def _proposed(folder: Path, text: str) -> tuple[Path, tuple[Proposal, ...]]:
    file = folder / "planted.toml"
    file.write_text(text, encoding="utf-8")
    return file, proposals(file)


def test_a_right_file_gets_no_proposal(arm: Path) -> None:
    """Negative control of all that follow."""
    assert _proposed(arm, TEXTS[PARQUET])[1] == ()


@pytest.mark.parametrize(
    ("planted", "kind", "key"),
    [
        (TEXTS[PARQUET].replace(DOWN, "gravity_direction = [1.0, 0.0, 0.0]  # ?"), "gravity", "gravity_direction"),
        pytest.param(
            TEXTS[PARQUET].replace(
                "\n\n[[support]]",
                "\nmount = { rotation_deg = [30, 10, 20], shift_mm = [0, 0, 0] }  # of the drawing\n\n[[support]]",
            ),
            "mount",
            "mount",
            marks=pytest.mark.long,
        ),
        pytest.param(
            TEXTS[PARQUET].replace(
                "\n\n[[support]]",
                "\nmount = { rotation_deg = [0, 0, 90], shift_mm = [1, 2, 3] }  # of the drawing\n\n[[support]]",
            ),
            "mount",
            "mount",
            marks=pytest.mark.long,
        ),
        pytest.param(
            TEXTS[PARQUET].replace(
                "[[sensor]]", '[[clock]]\nstream = "arm_ft"\nto = "joints"\ndelay_s = 0.15\n\n[[sensor]]'
            ),
            "delay",
            "delay_s",
            marks=pytest.mark.long,
        ),
        pytest.param(
            TEXTS[TWO].replace("parent_to_child", "child_to_parent"),
            "reversed",
            "measure_direction",
            marks=pytest.mark.long,
        ),
    ],
)
def test_a_wrong_statement_is_corrected_in_its_line(arm: Path, planted: str, kind: str, key: str) -> None:
    """The right value is proposed, with less of the force or moment left; all other lines stay."""
    _, (proposal,) = _proposed(arm, planted)
    assert proposal.kind == kind
    assert proposal.edit is not None
    assert proposal.residuals is not None
    assert (proposal.residuals.after < 0.8 * proposal.residuals.before).any()
    changed = proposal.edit.applied(planted)
    (old,), (new,) = proposal.edit.old, proposal.edit.new
    assert changed.replace(new, old) == planted
    assert f"line {proposal.edit.line}: {key} = " in proposal.sentence
    value = tomllib.loads(new)[key]
    if kind == "reversed":
        assert value == "parent_to_child"
    elif kind == "mount" and "30" in old:  # an angle that no screw pattern has
        assert value == "unknown"
        assert "turned by -37.6 deg about (0.81, 0.27, 0.53) against its stated mount" in proposal.sentence
    elif kind == "mount":
        assert value == {"rotation_deg": [0.0, 0.0, 0.0], "shift_mm": [1.0, 2.0, 3.0]}
    else:
        np.testing.assert_allclose(value, 0.0 if kind == "delay" else [0.0, 0.0, -1.0], atol=0.01)


@pytest.mark.long
def test_a_delay_of_the_log_gets_a_clock(arm: Path, tmp_path: Path) -> None:
    """Where the file has none; the table stands in front of the sensors."""
    text = TEXTS[PARQUET].replace('path = "recording"', f'path = "{tmp_path.as_posix()}/recording"')
    recording = read_recording(arm / "recording")
    stream = recording.stream("arm_ft")
    late = replace(stream, stamp_ns=stream.stamp_ns + 120_000_000)
    write_recording(tmp_path / "recording", replace(recording, streams={**recording.streams, "arm_ft": late}))
    _, (proposal,) = _proposed(arm, text)
    assert proposal.edit is not None
    (clock,) = tomllib.loads(proposal.edit.applied(text))["clock"]
    assert (clock["stream"], clock["to"]) == ("arm_ft", "joints")
    assert clock["delay_s"] == pytest.approx(0.12, abs=0.01)


@pytest.mark.long
def test_what_the_file_does_not_state_is_changed_elsewhere(arm: Path) -> None:
    """A joint that turns the other way: the URDF is named, and no line of the file."""
    urdf = (arm / "arm.urdf").read_text(encoding="utf-8")
    start = urdf.index('<joint name="elbow"')
    axis = urdf.index('<axis xyz="', start) + len('<axis xyz="')
    end = urdf.index('"', axis)
    turned = " ".join(str(-float(value)) for value in urdf[axis:end].split())
    (arm / "turned.urdf").write_text(urdf[:axis] + turned + urdf[end:], encoding="utf-8")
    _, (proposal,) = _proposed(arm, TEXTS[PARQUET].replace("arm.urdf", "turned.urdf"))
    assert (proposal.kind, proposal.about, proposal.edit) == ("joint_sign", "elbow", None)
    assert "<axis> of joint 'elbow' in the URDF" in proposal.sentence


LONG_SPANS = (
    ("start_s = 0.5\nend_s = 14.0", "start_s = 5.0\nend_s = 250.0"),
    ("start_s = 14.5\nend_s = 23.5", "start_s = 251.0\nend_s = 395.0"),
)
ARM_SENSOR = TEXTS[TWO][TEXTS[TWO].index("[[sensor]]") : TEXTS[TWO].index("[[support]]")]


def _reversed_in_poses() -> str:
    """Both sensors, with the wrong sense of that of the tool."""
    text = TEXTS[TWO].replace("parent_to_child", "child_to_parent")
    for old, new in LONG_SPANS:
        text = text.replace(old, new)
    return text


def test_faults_that_poses_do_not_separate_are_left_to_a_person(held: Path) -> None:
    """A wrong sense looks like gravity upwards: both are named, and neither can be accepted."""
    _, (proposal,) = _proposed(held, _reversed_in_poses().replace(ARM_SENSOR, ""))
    assert proposal.edit is None
    for words in (
        'measure_direction = "child_to_parent" -> measure_direction = "parent_to_child"',
        f"{DOWN} -> gravity_direction = [0.0, 0.0, 1.0]",
        "the log does not separate these",
    ):
        assert words in proposal.sentence


@pytest.mark.long
def test_a_change_that_makes_another_sensor_worse_is_not_offered(held: Path) -> None:
    """Gravity that the other sensor needs as it is: the sense is what is wrong."""
    _, (proposal,) = _proposed(held, _reversed_in_poses())
    assert (proposal.kind, proposal.about) == ("reversed", "tool_ft")
    assert proposal.edit is not None
    assert "measure_direction" in proposal.edit.text


def _require_cut(text: str, before: str) -> None:
    """Intervals without the push, of both uses; what stands before them stays."""
    assert text.startswith(before[: before.index("[[interval]]")])
    spans = [(one["start_s"], one["end_s"], one["use"]) for one in tomllib.loads(text)["interval"]]
    assert {use for *_, use in spans} == {"calibration", "validation"}
    assert sum(end - start for start, end, _ in spans) > 18.0
    assert all(end <= PUSH_S[0] or start >= PUSH_S[1] for start, end, _ in spans)


def test_a_push_is_cut_out_of_the_interval(pushed: Path) -> None:
    """The pieces are to fit and to validate, and leave less of force and moment than the interval."""
    file = pushed / "all.toml"
    (proposal,) = proposals(file)
    assert proposal.edit is not None
    assert proposal.residuals is not None
    assert (proposal.residuals.after < 0.1 * proposal.residuals.before).all()
    before = file.read_text(encoding="utf-8")
    _require_cut(proposal.edit.applied(before), before)


def test_piped_answers_are_refused_and_yes_accepts(
    pushed: Path, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Lines on standard input would be lost; an empty one has none, and --yes needs none."""
    shutil.copytree(pushed, tmp_path / "own")
    file = tmp_path / "own" / "all.toml"
    before = file.read_text(encoding="utf-8")
    for piped, is_refused in (("y\n", True), ("", False)):
        reading, writing = os.pipe()
        os.write(writing, piped.encode())
        os.close(writing)
        with os.fdopen(reading) as stdin, monkeypatch.context() as patch:
            patch.setattr("sys.stdin", stdin)
            assert has_piped_lines() is is_refused
            if is_refused:
                assert "got piped lines, which are not read" in run("init", "--resume", file).error()
    assert file.read_text(encoding="utf-8") == before
    assert "expected without --no-input" in run("init", "--resume", file, "--yes", "--no-input").error()
    accepted = run("init", "--resume", file, "--yes")
    assert accepted.code == 0
    assert any("accepted: intervals free of contact" in line for line in accepted.log)
    _require_cut(file.read_text(encoding="utf-8"), before)


def test_intervals_in_one_line_are_changed_by_hand(pushed: Path) -> None:
    """The times are named, and no line of the file."""
    text = (pushed / "all.toml").read_text(encoding="utf-8")
    interval = '{ label = "all", start_s = 0.0, use = "calibration", support = "base" }'
    head, cut = text[: text.index("[[sensor]]")], text[text.index("[[sensor]]") : text.index("[[interval]]")]
    file = pushed / "inline.toml"
    file.write_text(f"interval = [{interval}]\n{head}{cut}", encoding="utf-8")
    draft = resume_experiment(file)
    (row,) = draft.proposals
    assert row.line is None
    assert "s validation; write label, start_s, end_s and use of each in interval by hand" in row.proposal
    assert not any("nothing is left to ask" in block for block in draft.blocks() if isinstance(block, str))


def test_intervals_of_files_are_cut_by_hand(pushed: Path) -> None:
    """Each file has its own parts free of contact, which one table for all files cannot state."""
    recording = read_recording(pushed / "recording")
    joints, readings = recording.stream("joints"), recording.stream("arm_ft")
    seconds = (readings.stamp_ns - recording.start_ns) * 1e-9
    angles = joints.signal("position").values
    moved = [np.interp(readings.stamp_ns, joints.stamp_ns, column) for column in angles.T]
    rows = np.column_stack([seconds, *moved, readings.signal("raw").values])
    channels = [f"ch{k}" for k in range(1, 7)]
    names = ["t", *JOINTS, *channels]
    (pushed / "raw").mkdir()
    for number, own in enumerate((seconds < 12.0, seconds >= 12.0), start=1):
        table = pushed / "raw" / f"{number}.csv"
        np.savetxt(table, rows[own], delimiter=",", header=",".join(names), comments="", fmt="%.9g")
    text = (pushed / "all.toml").read_text(encoding="utf-8")
    log = (
        'format = "tabular"\npath = "."\n\n[[recording.stream]]\nname = "arm_ft"\nfile = "raw/*.csv"\n'
        'stamp = { column = "t", unit = "s" }\nsignal = [\n'
        f'{{ quantity = "position", columns = {list(JOINTS)}, units = {["rad"] * 5}, names = {list(JOINTS)} }},\n'
        f'{{ quantity = "raw", columns = {channels}, units = {["counts"] * 6} }},\n]\n'
    )
    text = text.replace('format = "parquet"\npath = "recording"\n', log).replace(
        'label = "all"  # not cut yet\nstart_s = 0.0\n', 'label = "{file}"\nfiles = "arm_ft"\n'
    )
    file = pushed / "files.toml"
    file.write_text(text, encoding="utf-8")
    (row,) = resume_experiment(file, accepts=lambda _: True).proposals
    assert row.line is None
    assert "write label, start_s, end_s and use of each in interval by hand" in row.proposal
    assert row.residual_before_N is not None
    assert row.residual_after_N is not None
    assert row.residual_after_N < 0.5 * row.residual_before_N
    assert file.read_text(encoding="utf-8") == text


@pytest.mark.long
def test_a_file_is_complete_once_its_proposal_is_accepted(pushed: Path, run: Run) -> None:
    """Listed with exit code 4; then nothing is left."""
    file = pushed / "again.toml"
    before = (pushed / "all.toml").read_text(encoding="utf-8")
    file.write_text(before, encoding="utf-8")
    listed = run("init", "--resume", file, "--no-input")
    assert listed.code == 4
    assert "1 PROPOSAL" in listed.out.splitlines()[0]
    assert file.read_text(encoding="utf-8") == before
    assert resume_experiment(file, accepts=lambda _: True).proposals == ()
    _require_cut(file.read_text(encoding="utf-8"), before)
    assert run("init", "--resume", file, "--no-input").code == 0


def test_proposals_are_settled_one_by_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An accepted one is written before the next is made; a declined one, and one for a person, is left."""
    file = tmp_path / "x.toml"
    file.write_text("a = 1  # one\nb = 1\n", encoding="utf-8")

    def stub(path: Path, settled: set[tuple[str, str]]) -> tuple[Proposal, ...]:
        text = path.read_text(encoding="utf-8")
        edit = Edit(line=1, old=("a = 1  # one",), new=("a = 2  # one",))
        made = (
            Proposal(kind="mass", about="", text="weigh it", edit=None),
            *((Proposal(kind="a", about="", text="a is 2", edit=edit),) if "a = 1" in text else ()),
            Proposal(kind="b", about="", text="b is 2", edit=Edit(line=2, old=("b = 1",), new=("b = 2",))),
        )
        return tuple(one for one in made if one.key not in settled)

    monkeypatch.setattr("forcetorque.inspection.draft.proposals.proposals", stub)
    asked: list[str] = []

    def accepts(proposal: str) -> bool:
        asked.append(proposal)
        return proposal.startswith("a is 2")

    assert [one.kind for one in settle(file, accepts)] == ["mass", "b"]
    assert asked == ["a is 2: line 1: a = 1 -> a = 2", "b is 2: line 2: b = 1 -> b = 2"]
    assert file.read_text(encoding="utf-8") == "a = 2  # one\nb = 1\n"


def test_a_file_that_changed_beside_a_proposal_keeps_the_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing is written by lines that have moved; the proposal is made again."""
    file = tmp_path / "x.toml"
    file.write_text("a = 1\nb = 1\n", encoding="utf-8")

    def stub(path: Path, _: set[tuple[str, str]]) -> tuple[Proposal, ...]:
        lines = path.read_text(encoding="utf-8").splitlines()
        if "a = 1" not in lines:
            return ()
        edit = Edit(line=lines.index("a = 1") + 1, old=("a = 1",), new=("a = 2",))
        return (Proposal(kind="a", about="", text="a is 2", edit=edit),)

    monkeypatch.setattr("forcetorque.inspection.draft.proposals.proposals", stub)
    asked: list[str] = []

    def accepts(proposal: str) -> bool:
        if not asked:
            file.write_text("# note\na = 1\nb = 1\n", encoding="utf-8")
        asked.append(proposal)
        return True

    assert settle(file, accepts) == ()
    assert asked[0] == "a is 2: line 1: a = 1 -> a = 2"
    assert asked[1] == f"{file}: was changed meanwhile, nothing was written\na is 2: line 2: a = 1 -> a = 2"
    assert file.read_text(encoding="utf-8") == "# note\na = 2\nb = 1\n"


@pytest.mark.parametrize(
    "options", [("-o", "x.toml"), ("--column-names", "t,fx"), ("--force",), ("--log-format", "ros"), ("--sensor", "a")]
)
def test_options_of_a_log_are_refused_beside_a_file(options: tuple[str, ...], arm: Path, run: Run) -> None:
    """Each by its name; the file is not read."""
    error = run("init", "--resume", arm / PARQUET, "--no-input", *options).error()
    assert f"expected nothing of a log beside it, got {'--output' if options[0] == '-o' else options[0]}" in error


def test_a_file_with_open_questions_lists_these(arm: Path, run: Run) -> None:
    """And no proposal, since nothing can be read; a log beside the file is refused."""
    file = arm / "open.toml"
    file.write_text(TEXTS[PARQUET].replace('serial = "SIM001"', 'serial = "?"  # which'), encoding="utf-8")
    listed = run("init", "--resume", file, "--no-input")
    assert listed.code == 4
    assert "1 LINE TO FILL IN" in listed.out
    assert "expected nothing of a log beside it, got a log" in run("init", "log.csv", "--resume", file).error()
    assert "expected a log, or an experiment file by --resume" in run("init").error()
