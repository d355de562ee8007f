# SPDX-License-Identifier: BSD-3-Clause
"""What `inspect` says first: events in time, faults of the file before them, and doubts that are no faults."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from forcetorque.inspection.answers import events, faults, inspection_answer
from forcetorque.inspection.inspect import FindingRow, Inspection
from forcetorque.inspection.plausibility.fault_hypotheses import FaultKind
from forcetorque.results.answer import MOST_LINES, Concern
from tests.app.outcome import Run

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def _row(kind: str, start_s: float | None = None, end_s: float | None = None, **more: object) -> FindingRow:
    given = {"stream": "leg", "channel": None, "count": 1, "size": None, "unit": None, "message": f"this is {kind}"}
    return FindingRow.model_validate({**given, "kind": kind, "start_s": start_s, "end_s": end_s, **more})


def _inspection(*rows: FindingRow, source: str = "walk.toml") -> Inspection:
    return Inspection(source=source, streams={}, duration_s=60.0, findings=rows)


def test_findings_of_one_contact_are_one_event() -> None:
    """What begins within it belongs to it, what is a second away or of another stream does not."""
    rows = (
        _row("step", 12.0, 12.0, channel="fx", size=-25.0, unit="N"),
        _row("step", 11.0, 11.0, channel="fy", size=6.0, unit="N"),
        _row("contact", 10.0, 20.0, size=164.0, unit="N"),
        _row("step", 30.0, 30.0, channel="fz", size=5.0, unit="N"),
        _row("off_level", 30.5, 33.0, channel="fz", size=9.0, unit="N"),
        _row("gap", 31.0, 31.5, stream="joints"),
    )
    assert [event.text for event in events(rows, 60.0)] == [
        "10.0-20.0 s, leg: contact up to 164 N; step in fx, fy up to 25 N",
        "30.0-33.0 s, leg: step in fz up to 5 N; off level in fz up to 9 N",
        "31.0-31.5 s, joints: gap",
    ]


def test_the_event_that_spoils_the_fit_most_is_first() -> None:
    """By its force and the time that it acts in intervals in use; a contact outside of them and a gap come after."""
    rows = (
        _row("contact", 0.0, 15.0, size=160.0, unit="N"),
        _row("gap", 20.0, 40.0, stream="joints", size=20.0, unit="s"),
        _row("off_level", 41.0, 44.0, channel="fy", size=12.0, unit="N"),
        _row("step", 50.0, 50.0, channel="tx", size=0.9, unit="N m"),
        _row("outlier", 58.0, 58.0, channel="fx", size=90.0, unit="N"),
    )
    inspection = _inspection(*rows)
    used = inspection.model_copy(update={"in_use_s": ((16.0, 60.0),)})
    kinds = [
        [line.split(": ")[1].split(" in ")[0].split(" up")[0] for line in inspection_answer(one).why[:4]]
        for one in (used, inspection)
    ]
    assert kinds == [["step", "off level", "outlier", "contact"], ["contact", "step", "off level", "outlier"]]
    assert "1 less harmful one(s)" in inspection_answer(used).why


def test_the_bar_shows_the_time_without_events() -> None:
    """A third of a minute in the middle is not usable; a finding of the whole log takes nothing from it."""
    answer = inspection_answer(_inspection(_row("contact", 20.0, 40.0), _row("not_estimated", 0.0, 59.9)))
    (bar,) = (line for line in answer.why if "|" in line)
    cells = bar.split("|")[1]
    assert answer.verdict == "1 EVENT"
    assert cells.strip("█") == "░" * cells.count("░")
    assert cells.count("░") == pytest.approx(len(cells) / 3, abs=2)
    assert any(line.startswith("1 remark(s) on the whole log: this is not_estimated") for line in answer.why)


@pytest.mark.parametrize("kind", ["joint_spike", "repeated_stamp", "backward_stamp"])
def test_single_samples_take_nothing_of_the_time(kind: str) -> None:
    """All of them are one finding from the first to the last, and cost no more than themselves."""
    turns = _row(kind, 5.0, 50.0, stream="joints").model_copy(update={"count": 12})
    answer = inspection_answer(_inspection(_row("contact", 20.0, 40.0), turns))
    assert answer.verdict == "1 EVENT"
    assert any(line.startswith(f"1 remark(s) on the whole log: this is {kind}") for line in answer.why)
    (bar,) = (line for line in answer.why if "|" in line)
    cells = bar.split("|")[1]
    assert cells.count("░") == pytest.approx(len(cells) / 3, abs=2)  # the contact alone
    alone = inspection_answer(_inspection(_row(kind, 5.0, 5.1, stream="joints")))
    assert alone.step.startswith("no interval uses a sample of these events")


@pytest.mark.parametrize("kind", [*get_args(FaultKind), "implausible"])
def test_a_fault_comes_first(kind: str) -> None:
    """Before contacts, with the command that tries its correction, or shows it again; quoted for a shell."""
    answer = inspection_answer(_inspection(_row("contact", 1.0, 2.0), _row(kind), source="my walk.toml"))
    assert (answer.verdict, answer.concern) == ("1 FAULT", Concern.BAD)
    assert answer.why == (f"leg: this is {kind}",)
    in_file = kind in ("gravity", "delay", "mount")
    assert answer.command == f"{'init --resume' if in_file else 'inspect'} 'my walk.toml'"
    assert answer.step == ("accept the change that corrects it" if in_file else "correct it, and inspect again")


@pytest.mark.parametrize("stated", [True, False])
def test_a_sense_is_changed_where_it_is_stated(stated: bool) -> None:
    """Of a sensor with a tag it is in the URDF, which no command changes."""
    inspection = _inspection(_row("reversed")).model_copy(update={"states_sense": stated})
    assert inspection_answer(inspection).command == f"{'init --resume' if stated else 'inspect'} walk.toml"


@pytest.mark.parametrize(
    ("stream", "end_s", "command"),
    [("leg", 40.0, "init --resume walk.toml"), ("leg", 12.0, "inspect walk.toml"), ("arm", 40.0, "inspect walk.toml")],
    ids=["long contact", "short contact", "contact of another stream"],
)
def test_a_contact_that_explains_a_fault_is_named(stream: str, end_s: float, command: str) -> None:
    """The next command then proposes intervals without it."""
    answer = inspection_answer(_inspection(_row("implausible"), _row("contact", 10.0, end_s, stream=stream)))
    assert answer.command == command
    assert answer.verdict == "1 FAULT"
    assert ("in an interval that is used: 10.0-40.0 s, leg: contact" in answer.why) == command.startswith("init")


@pytest.mark.parametrize(
    ("start_s", "kind", "first"),
    [
        (20.0, "implausible", "joint_jump"),
        (70.0, "implausible", "implausible"),
        (20.0, "gravity", "gravity"),
        (20.0, "joint_offset elbow", "joint_jump"),
        (70.0, "joint_offset elbow", "joint_offset"),
        (20.0, "joint_sign wrist", "joint_sign"),
    ],
)
def test_a_joint_that_jumps_explains_a_measurement(start_s: float, kind: str, first: str) -> None:
    """It comes first where an interval uses it, unless a fault of something else explains the measurements."""
    kind, _, channel = kind.partition(" ")
    found = _inspection(
        _row(kind, channel=channel or None), _row("joint_jump", start_s, start_s, stream="joints", channel="elbow")
    )
    answer = inspection_answer(found.model_copy(update={"in_use_s": ((16.0, 60.0),)}))
    assert (answer.verdict, answer.why[0].rpartition(" ")[2]) == ("1 FAULT", first)


@pytest.mark.parametrize(
    ("kind", "in_use_s", "command"),
    [
        ("contact", (16.0, 60.0), "run walk.toml -o results"),
        ("gap", (0.0, 60.0), "run walk.toml -o results"),
        ("contact", (14.0, 60.0), "init --resume walk.toml"),
    ],
    ids=["outside", "left out by every fit", "inside"],
)
def test_events_that_no_interval_uses_do_not_hold_up(kind: str, in_use_s: tuple[float, float], command: str) -> None:
    """Nothing is to be left out of the intervals then, and `init --resume` would propose nothing."""
    found = _inspection(_row(kind, 1.0, 15.0)).model_copy(update={"in_use_s": (in_use_s,)})
    assert inspection_answer(found).command == command


@pytest.mark.parametrize("kind", ["implausible_scale", "implausible_span", "implausible_delay"])
def test_what_calibrate_only_warns_of_is_no_fault(kind: str) -> None:
    """It is a remark."""
    inspection = _inspection(_row(kind))
    assert faults(inspection.findings) == ()
    assert inspection_answer(inspection).verdict == "REMARKS"


def test_columns_that_need_a_file_are_answered_in_few_lines(tmp_path: Path, run: Run) -> None:
    """However many columns there are: what they look like, and the command that begins the file."""
    log = tmp_path / "log.csv"
    names = ["time", *(f"joint_{k}_position" for k in range(40))]
    log.write_text(f"{','.join(names)}\n{','.join('1' for _ in names)}\n", encoding="utf-8")
    shown = run("inspect", log, columns=80)
    assert len(shown.out.splitlines()) <= MOST_LINES
    assert f"forcetorque init {log}" in " ".join(shown.out.split()).replace("\\ ", "")
    assert "joint_39_position" not in shown.out
    assert "joint_39_position" in run("inspect", log, "--details", columns=200).out


@pytest.mark.long
@pytest.mark.real_data
def test_a_foot_of_which_the_gain_is_doubted_is_not_called_faulty(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """Its matrix bears the robot's weight within a percent: that `calibrate` doubts its gain is a remark."""
    path = tmp_path / "contacts.toml"
    text = (EXAMPLES / "08_icub_yoga_contacts.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    result = run("inspect", path, "--format", "json").result()
    assert "implausible_scale" in {finding["kind"] for finding in result["findings"]}
    assert "FAULT" not in run("inspect", path).out.splitlines()[0]


def test_without_a_sensor_nothing_is_to_be_calibrated() -> None:
    """A file of joints alone has no next command; one of soles is for balance, one with a sensor for `run`."""
    inspection = _inspection()
    alone = inspection_answer(inspection.model_copy(update={"to_calibrate": None}))
    assert (alone.step.split(",")[0], alone.command) == ("state a [[sensor]] to calibrate", "")
    beside = inspection_answer(inspection.model_copy(update={"to_calibrate": "no_interval"}))
    assert (beside.step.split(",")[0], beside.command) == ('state an [[interval]] with use = "calibration"', "")
    standing = inspection_answer(inspection.model_copy(update={"to_calibrate": "standing"}))
    assert standing.command == "robot balance walk.toml"
    skin = inspection_answer(inspection.model_copy(update={"to_calibrate": "skin"}))
    assert (skin.command or "").startswith("skin calibrate walk.toml ")
    with_sensor = inspection_answer(inspection)
    assert "calibrate the sensors" in with_sensor.step
    assert (with_sensor.command or "").startswith("run ")
