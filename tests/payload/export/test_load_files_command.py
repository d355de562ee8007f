# SPDX-License-Identifier: BSD-3-Clause
"""`payload` and `tare` write what robots load, say what its program does with it, and refuse what it cannot hold."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from defusedxml import ElementTree
from scipy.spatial.transform import Rotation

from forcetorque.app.python.experiment import load_experiment
from forcetorque.base.errors import ExperimentError, OutputError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.export.export import export_load, robot_load, write_load_file
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.payload.load_warnings import overruled
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.payload.export.written_loads import read_ft_tools, read_mc_rtc
from tests.scenes.wrist_postures import BIAS, CENTRE, HELD_S, MASS, SLOW, write_postures

POSTURES = Rotation.random(8, random_state=4)
POSE = ("0.0", "0.0", "0.05", "0.0", "0.0", "0.0")
ENOUGH = 5.0
"""Standard deviations of a slow offset over 60 s or more."""


@pytest.fixture(scope="module")
def weighed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An experiment with an unknown load in eight postures."""
    return write_postures(tmp_path_factory.mktemp("weighed"), seed=5, postures=POSTURES, known=False)


def test_payload_writes_what_a_robot_loads(weighed: Path, run: Run) -> None:
    """The file has the load that the table shows; the program's way with it is a message."""
    file = weighed.parent / "parameters.yaml"
    outcome = run("payload", weighed, "--to", "ft-tools", "-o", file, "--format", "json")
    result = outcome.result()
    load = read_ft_tools(file, "tool")
    assert result["schema"].startswith("forcetorque/payload/")
    assert repr(load.mass) in json.dumps(result)
    assert load.mass == pytest.approx(MASS, rel=0.01)
    np.testing.assert_allclose(load.bias, BIAS, atol=ENOUGH * SLOW.max())
    assert "force_offset and torque_offset are the bias, and are taken off" in " ".join(outcome.err.split())


@pytest.mark.long
def test_the_file_may_go_to_standard_output(weighed: Path, run: Run) -> None:
    """The file in place of the table; not beside a result for programs."""
    told = run("payload", weighed, "--to", "mc-rtc", "-o", "-", "--sensor-pose", *POSE)
    assert len(told.out.split()) == 13
    (weighed.parent / "calib").write_text(told.out)
    pose = np.eye(4)
    pose[2, 3] = 0.05
    load = read_mc_rtc(weighed.parent / "calib", "tool", pose)
    np.testing.assert_allclose(load.centre_of_mass, CENTRE, atol=0.002)
    both = run("payload", weighed, "--to", "hrpsys", "-o", "-", "--format", "json")
    assert (both.code, "standard output for both" in both.err) == (2, True)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--to", "hrpsys"), "expected both --to"),
        (("-o", "x"), "expected both --to"),
        (("--to", "gravity-filter", "-o", "x"), "expected --world-frame"),
        (("--to", "mc-rtc", "-o", "x"), "expected --sensor-pose"),
        (("--to", "force-torque-tools", "-o", "x"), "turn the sign of the readings"),
        (("--to", "hrpsys", "-o", "nowhere/x"), "expected an existing folder"),
    ],
)
def test_what_a_file_needs_is_asked_for(
    weighed: Path, run: Run, words: tuple[str, ...], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One line that says what is missing; nothing is written."""
    monkeypatch.chdir(tmp_path)
    outcome = run("payload", weighed, *words)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err
    assert not (tmp_path / "x").exists()


def test_a_robot_is_told_one_load_with_a_whole_bias(weighed: Path, run: Run, tmp_path: Path) -> None:
    """Neither one of several loads, nor a bias that the data leave open."""
    content = load_experiment(weighed)
    sensor = SensorRun(content, content.sensors[0])
    with pytest.raises(ExperimentError, match="the data leave fz, tx open"):
        robot_load(sensor, (1.0, 2.0, None, None, 0.0, 0.0))
    text = weighed.read_text(encoding="utf-8")
    second = '[[load]]\nname = "other"\n\n[recording]'
    several = tmp_path / "wrist.toml"
    several.write_text(
        text.replace("[load]", '[[load]]\nname = "tool"')
        .replace("[recording]", second, 1)
        .replace('use = "calibration"', 'use = "calibration"\nload = "tool"')
    )
    (tmp_path / "log.csv").write_bytes((weighed.parent / "log.csv").read_bytes())
    outcome = run("payload", several, "--to", "hrpsys", "-o", tmp_path / "load")
    assert (outcome.code, "expected one [[load]]" in outcome.err) == (2, True)
    assert not (tmp_path / "load").exists()


@pytest.mark.long
def test_a_robot_is_told_what_several_recordings_say_together(weighed: Path, run: Run, tmp_path: Path) -> None:
    """Not what the last of them says alone; the bias is that of the last, which is said."""
    other = write_postures(tmp_path, seed=7, postures=POSTURES, known=False)
    file = tmp_path / "load.yaml"
    outcome = run("payload", weighed, other, "--to", "ft-tools", "-o", file, "--format", "json")
    result = outcome.result()
    load = read_ft_tools(file, "tool")
    assert load.mass == result["loads"][0]["mass_kg"]
    assert load.mass != run("payload", other, "--format", "json").result()["loads"][0]["mass_kg"]
    assert load.bias.tolist() == result["sessions"][-1]["bias"]
    assert f"the bias is that of {result['sessions'][-1]['session']!r}" in outcome.err


_COLUMNS = 'columns = ["fx", "fy", "fz", "tx", "ty", "tz"]'
_UNITS = 'units = ["N", "N", "N", "N m", "N m", "N m"]'


@some_cases(
    ("old", "new", "match"),
    [
        ("child_to_parent", "parent_to_child", "reversed direction: "),
        (_COLUMNS, 'columns = ["tx", "ty", "tz", "fx", "fy", "fz"]', "swapped columns: "),
        ("sensor_to_world", "world_to_sensor", "transposed rotation: "),
        (_UNITS, _UNITS.replace("N m", "N mm"), "mixed units: "),
        (_UNITS, 'units = ["kgf", "kgf", "kgf", "N m", "N m", "N m"]', "check units of the wrench"),
    ],
)
@some_cases("count", [1, 2])
def test_no_file_is_written_of_a_load_that_the_readings_contradict(
    weighed: Path, run: Run, tmp_path: Path, count: int, old: str, new: str, match: str
) -> None:
    """A file with a wrong frame, sense or unit gives another load than what hangs there, alone and with others."""
    text = weighed.read_text(encoding="utf-8")
    assert text.count(old) == 1
    files = []
    for number in range(count):
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "log.csv").write_bytes((weighed.parent / "log.csv").read_bytes())
        (folder / "wrist.toml").write_text(text.replace(old, new).replace("100.0, 100.0, 200.0", "60.0, 60.0, 60.0"))
        files.append(folder / "wrist.toml")
    error = run("payload", *files, "--to", "gravity-filter", "--world-frame", "map", "-o", tmp_path / "load").error()
    assert match in error
    assert "mend that, and weigh again" in error
    assert not (tmp_path / "load").exists()


@pytest.mark.long
def test_a_tare_under_a_load_that_the_readings_contradict_writes_no_file(run: Run, tmp_path: Path) -> None:
    """The new offset would hold twice the weight; the answer itself is still shown."""
    path = write_postures(tmp_path, seed=8, postures=POSTURES)
    text = (
        path.read_text()
        .replace(f"end_s = {HELD_S}", f"end_s = {7 * HELD_S}")
        .replace(f"start_s = {HELD_S}", f"start_s = {7 * HELD_S}")
    )
    path.write_text(text.replace("child_to_parent", "parent_to_child"))
    words = ("tare", path, "--interval", "second")
    error = run(*words, "--to", "gravity-filter", "--world-frame", "map", "-o", tmp_path / "load").error()
    assert "they say: reversed direction" in error
    assert not (tmp_path / "load").exists()
    assert run(*words).code == 0


@pytest.mark.long
def test_a_jump_takes_a_reason_and_that_nothing_hangs_there_takes_none(run: Run, tmp_path: Path) -> None:
    """A jump makes the bias wrong; a stated mass of 0 is what the user wants. The reason stands beside the file."""
    jumped = write_postures(tmp_path, seed=9, postures=POSTURES)
    rows = np.loadtxt(tmp_path / "log.csv", delimiter=",", skiprows=1)
    rows[len(rows) // 2 :, 3] += 0.8
    header = (tmp_path / "log.csv").read_text().split("\n", 1)[0]
    np.savetxt(tmp_path / "log.csv", rows, delimiter=",", header=header, comments="", fmt="%.9g")
    text = jumped.read_text()
    jumped.write_text(
        text.split("[[interval]]")[0] + '[[interval]]\nlabel = "all"\nstart_s = 0.0\nuse = "calibration"\n'
    )
    words = ("payload", jumped, "--to", "hrpsys", "-o", tmp_path / "load")
    assert "jump: the bias jumps in fz" in run(*words).error()
    assert not (tmp_path / "load").exists()
    assert run(*words, "--override", "taken before the jump").code == 0
    assert "override (taken before the jump), although: jump" in (tmp_path / "load.override.txt").read_text()
    jumped.write_text(text.replace(f"mass_kg = {MASS}", "mass_kg = 0.0"))
    outcome = run("payload", jumped, "--to", "hrpsys", "-o", tmp_path / "load", "--force")
    assert (outcome.code, "all masses are stated as 0" in outcome.err) == (0, True)


def test_the_reason_to_write_a_doubtful_load_is_a_comment(tmp_path: Path) -> None:
    """A form without comments has it in a file beside it, which standard output has not; no reason is refused."""
    note = overruled("a jump", "taken\nbefore it", where="load")
    assert note == "written by override (taken before it), although: a jump"
    assert overruled(None, "in any case", where="load") is None
    for reason, match in ((None, "expected what the measurements agree on, got: a jump"), (" ", "got an empty one")):
        with pytest.raises(ExperimentError, match=match):
            overruled("a jump", reason, where="load")
    load = RobotLoad(
        sensor="wrist",
        frame="tool",
        direction=MeasureDirection.CHILD_TO_PARENT,
        mass=MASS,
        centre_of_mass=CENTRE,
        bias=BIAS,
        override=note,
    )
    write_load_file(tmp_path / "load.yaml", load, LoadFormat.FT_TOOLS)
    assert (tmp_path / "load.yaml").read_text().splitlines()[1] == f"# {note}"
    assert read_ft_tools(tmp_path / "load.yaml", "tool").mass == MASS
    with pytest.raises(ExperimentError, match="expected a file, beside which the reason is written"):
        write_load_file("-", load, LoadFormat.HRPSYS)


def test_any_reason_stays_a_remark(tmp_path: Path) -> None:
    """Also one with hyphens, line breaks and control characters, which a file may not hold as they are."""
    load = RobotLoad(
        sensor="wrist",
        frame="tool",
        direction=MeasureDirection.CHILD_TO_PARENT,
        mass=MASS,
        centre_of_mass=CENTRE,
        bias=BIAS,
        override="see ---> a\nmass: 99 \x1b \udcff",
    )
    write_load_file(tmp_path / "load.urdf", load, LoadFormat.URDF, body_H_sensor=np.eye(4))
    assert ElementTree.parse(tmp_path / "load.urdf").getroot().tag == "robot"
    write_load_file(tmp_path / "load.yaml", load, LoadFormat.FT_TOOLS)
    assert read_ft_tools(tmp_path / "load.yaml", "tool").mass == MASS
    assert "see ---> a mass: 99" in (tmp_path / "load.yaml").read_text(encoding="utf-8")


def test_the_reason_beside_a_file_replaces_none_of_the_user_and_goes_with_the_doubt(tmp_path: Path) -> None:
    """A foreign file of its name is refused; a load without doubt takes away the reason of an earlier one."""
    load = RobotLoad(
        sensor="wrist",
        frame="tool",
        direction=MeasureDirection.CHILD_TO_PARENT,
        mass=MASS,
        centre_of_mass=CENTRE,
        bias=BIAS,
        override="why",
    )
    beside = tmp_path / "load.conf.override.txt"
    beside.write_text("mine", encoding="utf-8")
    with pytest.raises(OutputError, match=r"load\.conf\.override\.txt"):
        export_load(load, tmp_path / "load.conf", LoadFormat.HRPSYS)
    assert beside.read_text(encoding="utf-8") == "mine"
    export_load(replace(load, override=None), tmp_path / "load.conf", LoadFormat.HRPSYS)
    assert beside.read_text(encoding="utf-8") == "mine"
    beside.unlink()
    for doubtful in (load, load, replace(load, override=None)):
        export_load(doubtful, tmp_path / "load.conf", LoadFormat.HRPSYS, force=True)
        assert beside.exists() == (doubtful.override is not None)


@pytest.mark.long
def test_a_tare_under_a_load_that_moves_takes_a_reason(tmp_path: Path, run: Run) -> None:
    """Its offset has errors of the load in it."""
    path = write_postures(tmp_path, seed=6, postures=POSTURES)
    text = path.read_text().replace(f"end_s = {HELD_S}", f"end_s = {2 * HELD_S}")
    path.write_text(text.replace(f"start_s = {HELD_S}", f"start_s = {2 * HELD_S}"))
    words = ("tare", path, "--interval", "first", "--to", "ft-tools", "-o", tmp_path / "load.yaml")
    assert "the load moves by" in run(*words).error()
    assert run(*words, "--override", "a test").code == 0
    assert "although: wrist: the load moves by" in (tmp_path / "load.yaml").read_text()


def test_tare_shows_and_writes_the_offset(tmp_path: Path, run: Run) -> None:
    """JSON and table have the same numbers; the file has the stated load with the new bias."""
    path = write_postures(tmp_path, seed=6)
    file = tmp_path / "parameters.yaml"
    result = run("tare", path, "--interval", "first", "--to", "ft-tools", "-o", file, "--format", "json").result()
    assert result["schema"] == "forcetorque/tare/2"
    (row,) = result["sensors"]
    assert (np.abs(np.array(row["offset"]) + BIAS) < ENOUGH * SLOW).all()
    load = read_ft_tools(file, "tool")
    assert load.mass == MASS
    np.testing.assert_allclose(load.bias, -np.array(row["offset"]))
    table = run("tare", path, "--interval", "first", "--details").out
    assert f"{row['offset'][0]:.4f}" in table
    assert f"{row['half_width_95'][5]:.4f}" in table
    lines = run("tare", path, "--interval", "first", "--format", "csv").out.splitlines()
    assert (len(lines), "offset" in lines[0]) == (2, True)


def test_a_calibration_of_another_sensor_is_refused(tmp_path: Path, run: Run) -> None:
    """Nothing is tared with it."""
    path = write_postures(tmp_path, seed=7)
    outcome = run("tare", path, "--interval", "first", "-c", tmp_path / "none.json")
    assert (outcome.code, "none.json" in outcome.err) == (2, True)


def test_the_words_for_every_form_are_in_the_help(run: Run) -> None:
    """Every form can be chosen."""
    text = "".join(run("payload", "--help").out.split())
    assert all(form.value in text for form in LoadFormat)
