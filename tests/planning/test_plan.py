# SPDX-License-Identifier: BSD-3-Clause
"""Plans of what to record next: within limits, honest, with tools, and before any recording."""

from __future__ import annotations

import json
import time
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.formats.yarp.joint_and_sensor_ports import read_state
from forcetorque.planning.planning import Plan, plan, plan_sentence
from forcetorque.planning.trajectory_files import write_plan
from tests.scenes.experiments import JOINTS, PARQUET

CLEARANCE_DEG = 12.0
PLAN = f"""
[plan]
clearance_deg = {CLEARANCE_DEG}
speed = 0.8
ranges = {{ elbow = [-30.0, 45.0], wrist = [0.0, 0.0] }}
"""
BAR = """
[[plan.tool]]
name = "bar"
frame = "hand"
mass_kg = 1.0
centre_of_mass_m = [0.15, 0.0, 0.0]
"""


def _run(folder: Path, rest: str = PLAN) -> SensorRun:
    file = folder / "planned.toml"
    file.write_text((folder / PARQUET).read_text(encoding="utf-8") + rest, encoding="utf-8")
    return SensorRun(load_experiment(file, Purpose.PLANNING), "arm_ft")


def _fitted(run: SensorRun) -> Calibration:
    return calibrate_sensor(run, code_version="1", created="2020-01-01T00:00:00+00:00")


def _unrecorded(folder: Path, rest: str = PLAN) -> SensorRun:
    """The same sensor from a file without recording, intervals and streams."""
    text = f"""schema = "forcetorque/experiment/1"
name = "new arm"
[robot]
urdf = "arm.urdf"
tolerance = "exact"
[[sensor]]
name = "arm_ft"
serial = "SIM001"
prior = "matrix_SIM001.txt"
[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]
{rest}"""
    (folder / "new.toml").write_text(text, encoding="utf-8")
    return SensorRun(load_experiment(folder / "new.toml", Purpose.PLANNING), "arm_ft")


@pytest.fixture(scope="module")
def planned(intact: Path, tmp_path_factory: pytest.TempPathFactory) -> Plan:
    """A plan of two recordings from the prior, with a bar that may be attached."""
    import shutil

    folder = Path(shutil.copytree(intact, tmp_path_factory.mktemp("planned") / "arm"))
    return plan(_run(folder, PLAN + BAR), recordings=2, seconds=40.0)


def test_joints_stay_within_limits_less_the_clearance(planned: Plan) -> None:
    """All the way, not only at the postures; a joint whose range is one position stays there."""
    limits = np.deg2rad([CLEARANCE_DEG] * 2)
    for proposal in planned.proposals:
        way, stand = proposal.trajectory, proposal.place.stand
        positions = way(np.arange(0.0, way.duration_s, 0.1)).position
        assert np.abs(np.diff(positions, axis=0)).max() <= 0.8 * 0.1 + 1e-9
        for joint in proposal.place.moved:
            limit = stand.model.joints[joint].limit
            assert limit is not None
            assert limit.lower is not None
            assert limit.upper is not None
            column = positions[:, stand.columns([joint])[0]]
            assert column.min() >= limit.lower + limits[0] - 1e-9
            assert column.max() <= limit.upper - limits[1] + 1e-9
        elbow = positions[:, stand.columns(["elbow"])[0]]
        assert np.rad2deg([elbow.min(), elbow.max()]).round(6).tolist() >= [-30.0, 0.0]
        assert np.rad2deg(elbow.max()) <= 45.0 + 1e-9
        assert not positions[:, stand.columns(["wrist"])[0]].any()


def test_only_joints_that_change_the_load_move(planned: Plan) -> None:
    """The yaw of the shoulder turns about the vertical, and the wrist may not: both rest."""
    moved = {joint for row in planned.postures for joint in row.positions}
    assert moved == {"shoulder_pitch", "shoulder_roll", "elbow"}


def test_every_recording_lowers_the_error_and_takes_no_longer_than_allowed(planned: Plan) -> None:
    """What is known before one is what was known after the one before; it starts and ends at rest."""
    first, second = planned.recordings
    assert first.force_after_N < 0.5 * first.force_before_N
    assert first.moment_after_Nm < 0.5 * first.moment_before_Nm
    assert (second.force_before_N, second.moment_before_Nm) == (first.force_after_N, first.moment_after_Nm)
    assert second.force_after_N <= second.force_before_N
    assert all(20.0 < row.seconds <= 40.0 for row in planned.recordings)
    for proposal in planned.proposals:
        np.testing.assert_array_equal(proposal.trajectory.postures[[0, -1]], [proposal.place.stand.rest] * 2)


def test_the_sentence_says_what_to_record_first_and_what_it_brings(planned: Plan) -> None:
    """Postures, seconds, support, tool, errors before and after; what is not checked stands below."""
    first = planned.recordings[0]
    assert planned.advice.startswith(
        f"record first {first.postures} postures in {first.seconds:.0f} s, held at base, bar attached: "
        f"the expected error falls from {first.force_before_N:.3g} N and {first.moment_before_Nm:.3g} N m to "
        f"{first.force_after_N:.3g} N (95 %: {first.force_after_at_most_N:.3g})"
    )
    assert planned.start == "prior"
    words = " ".join(planned.limits)
    assert "whether the robot touches itself, the floor" in words
    assert "off by some 6 % of each row" in words
    assert "recording 2: positions" in planned.text()


@pytest.mark.long
def test_before_any_recording_the_plan_is_that_from_the_prior(arm: Path) -> None:
    """A file without recording, intervals and streams gives the same; other commands say what is missing."""
    new, old = plan(_unrecorded(arm), recordings=1, seconds=30.0), plan(_run(arm), recordings=1, seconds=30.0)
    assert new.recordings == old.recordings
    assert new.postures == old.postures
    with pytest.raises(ForceTorqueError, match=r"new\.toml: recording: expected a table \[recording\]"):
        load_experiment(arm / "new.toml")


@pytest.mark.long
def test_a_clock_belongs_to_what_was_recorded(arm: Path) -> None:
    """It changes no plan and is said; where nothing was recorded it is refused by its name."""
    clock = '\n[[clock]]\nstream = "arm_ft"\nto = "joints"\ndelay_s = 0.0\n'
    first, plain = (plan(_run(arm, PLAN + words), recordings=1, seconds=30.0) for words in (clock, ""))
    assert first.recordings == plain.recordings
    assert set(first.warnings) - set(plain.warnings) == {
        "arm_ft: stamped 0 ms later than 'joints', as specified: its stamps are brought to that clock"
    }
    with pytest.raises(ExperimentError, match=r"expected \[recording\], to whose streams \[\[clock\]\] is done"):
        _unrecorded(arm, PLAN + clock)


def test_a_full_scale_alone_is_enough_to_begin_with(arm: Path) -> None:
    """Without a matrix the sensor is taken to read N and N m; without full scale there is nothing to go by."""
    run = _unrecorded(arm)
    file = run.experiment.file
    text = file.read_text(encoding="utf-8").replace('prior = "matrix_SIM001.txt"', "")
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ExperimentError, match="expected a prior matrix or full_scale"):
        plan(SensorRun(load_experiment(file, Purpose.PLANNING), "arm_ft"))
    scale = "full_scale = [500.0, 500.0, 500.0, 20.0, 20.0, 20.0]\n[[support]]"
    file.write_text(text.replace("[[support]]", scale, 1), encoding="utf-8")
    first = plan(SensorRun(load_experiment(file, Purpose.PLANNING), "arm_ft"), recordings=1, seconds=30.0).recordings[0]
    assert first.force_after_N < first.force_before_N


@pytest.mark.long
def test_a_calibration_is_where_the_plan_begins(arm: Path) -> None:
    """Its predicted error stands before the first recording; nothing is assumed of the noise."""
    from forcetorque.evaluation.load_cases.load_case import operating_load_cases
    from forcetorque.evaluation.load_cases.predicted_error import predict

    run = _run(arm)
    fitted = _fitted(run)
    planned = plan(run, fitted, recordings=1, seconds=30.0)
    (case,) = operating_load_cases([run])
    assert planned.start == "calibration"
    assert planned.recordings[0].force_before_N == predict(fitted, case).force.typical
    assert not any("nothing was recorded" in sentence for sentence in planned.limits)


@pytest.mark.long
def test_a_stiff_limb_leaves_directions_to_the_prior_and_says_so(arm: Path) -> None:
    """One centre of mass spans three directions; after one recording a second brings nothing, and the reason is named.

    Negative control: with two tools that may be attached nothing is said of directions that no load reaches.
    """
    stiff = PLAN.replace("[-30.0, 45.0]", "[0.0, 0.0]")
    use = '[[load_case]]\nname = "push"\nforce_N = 30.0\nradius_m = 0.3\noffset = "tared"\n'
    alone = plan(_run(arm, use + stiff), recordings=3, seconds=30.0)
    assert "stays with the prior: the loads within these limits span 3 of 6 directions" in alone.advice
    assert "a tool with its centre of mass elsewhere" in alone.advice
    bars = BAR + BAR.replace('"bar"', '"block"').replace("[0.15, 0.0, 0.0]", "[0.0, 0.12, 0.05]")
    helped = plan(_run(arm, use + stiff + bars), recordings=3, seconds=30.0)
    assert "6 directions" not in helped.advice
    assert {row.tool for row in helped.recordings} == {"bar", "block"}
    assert helped.recordings[-1].force_after_N < 0.3 * alone.recordings[-1].force_after_N


def test_where_nothing_helps_the_plan_says_so(arm: Path) -> None:
    """A sensor that may hardly move learns nothing in a few seconds."""
    still = "[plan]\nclearance_deg = 5\nranges = { shoulder_pitch = [0.0, 0.5], shoulder_roll = [0.0, 0.0], "
    run = _run(arm, still + "elbow = [0.0, 0.0], wrist = [0.0, 0.0] }\n")
    planned = plan(run, _fitted(run), recordings=1, seconds=12.0)
    assert planned.advice.startswith("nothing within these limits helps: the best recording of ")


@pytest.mark.long
def test_temperatures_are_gone_through_where_the_use_changes_them(arm: Path) -> None:
    """A use at other temperatures asks for a recording that warms up; one at the same does not."""
    variable = 'prior = "matrix_SIM001.txt"\nvariable = [{ name = "temperature" }]'
    temperatures = PLAN + "temperatures = [20.0, 40.0]\n"

    def asked(changes: str) -> tuple[float | None, float | None]:
        use = f'[[load_case]]\nname = "push"\nforce_N = 30.0\nradius_m = 0.3\noffset = "tared"\n{changes}\n'
        file = _unrecorded(arm, use + temperatures).experiment.file
        text = file.read_text(encoding="utf-8").replace('prior = "matrix_SIM001.txt"', variable)
        file.write_text(text, encoding="utf-8")
        first = plan(
            SensorRun(load_experiment(file, Purpose.PLANNING), "arm_ft"), recordings=1, seconds=30.0
        ).recordings[0]
        return first.temperature_start_degC, first.temperature_end_degC

    assert asked("") == (20.0, 20.0)
    assert asked("changes = { temperature = 15.0 }") == (20.0, 40.0)


def test_the_sentence_of_an_assessment_takes_less_than_five_seconds(arm: Path) -> None:
    """It plans one recording without looking long; without a clearance it says what to state."""
    run = _run(arm)
    fitted = _fitted(run)
    start = time.perf_counter()
    sentence = plan_sentence(run, fitted)
    assert time.perf_counter() - start < 5.0
    assert sentence.startswith(("record first ", "nothing within these limits helps"))
    assert plan_sentence(_run(arm, ""), fitted).startswith("state clearance_deg in [plan]")


def test_the_files_of_a_plan_are_what_the_plan_says(planned: Plan, tmp_path: Path) -> None:
    """Trajectories end where the postures do, in every form; a folder that holds something is left alone."""
    output = tmp_path / "next"
    output.mkdir()
    written = write_plan(planned, output)
    assert written.folder == str(output)
    assert json.loads((output / "plan.json").read_text(encoding="utf-8")) == json.loads(written.json_text())
    layout = TableLayout(
        stamp=StampColumn(column="time_s", unit="s"),
        signals=(TableSignal(quantity="position", columns=JOINTS, units=("rad",) * len(JOINTS)),),
    )
    for number, (row, proposal) in enumerate(zip(planned.recordings, planned.proposals, strict=True), start=1):
        (stream,) = read_table(output / f"trajectory_{number}.csv", layout, stream="joints", clock="plan").streams
        values, seconds = stream.signal("position").values, stream.stamp_ns * 1e-9
        assert seconds[-1] == pytest.approx(row.seconds, abs=1e-3)
        np.testing.assert_allclose(values, proposal.trajectory(seconds).position, atol=1e-3)
        port = output / f"trajectory_{number}_yarp" / "plan" / "state:o"
        played = read_state(port, stream="joints", joints=JOINTS, joint_units={}).stream
        np.testing.assert_allclose(played.signal("position").values, values, atol=1e-6)
        assert "joint_names: [" in (output / f"trajectory_{number}_ros.yaml").read_text(encoding="utf-8")
    with pytest.raises(ForceTorqueError, match="expected a new or empty folder"):
        write_plan(planned, output)


@pytest.mark.parametrize(
    ("rest", "message"),
    [
        ("", "expected a clearance from the joint limits, in deg; state clearance_deg"),
        (
            "[plan]\nclearance_deg = 160.0\n",
            "joint 'elbow': limits .* a clearance of 160 deg .*leave no position",
        ),
        ("[plan]\nclearance_deg = 5\nranges = { elbow = [170.0, 175.0] }\n", "and the range 170 to 175 deg leave no"),
        (
            "[plan]\nclearance_deg = 5\nranges = { elbow = [3.0, 2.0] }\n",
            "joint elbow: expected .lowest, highest., got",
        ),
        ("[plan]\nclearance_deg = 5\nranges = { elbo = [0.0, 2.0] }\n", "no free joint 'elbo'; did you mean \"elbow\""),
        (PLAN + BAR.replace('"hand"', '"hnd"'), "tool 'bar': robot 'arm' has no link 'hnd'; did you mean \"hand\""),
        (PLAN + BAR.replace('"hand"', '"base"'), "tool 'bar': a load on 'base' does not load the sensor 'arm_ft'"),
        (PLAN + BAR + BAR, "two tools are called bar; name them apart"),
        (PLAN + BAR.replace('"bar"', '"none"'), "two tools are called none; name them apart"),
        ('[plan]\nclearance_deg = 5\nsupport = "hand"\n', "no .*support.* at rest has the frame 'hand'; .*known: base"),
        (PLAN + "temperatures = [20.0]\n", "was fitted without the variable 'temperature'; add a"),
        (
            "[plan]\nclearance_deg = 5\nranges = { shoulder_pitch = [0, 0], shoulder_roll = [0, 0], elbow = [0, 0], "
            "wrist = [0, 0] }\n",
            "no joint that may move changes the load of 'arm_ft' held at 'base'",
        ),
    ],
)
def test_limits_that_contradict_are_refused(arm: Path, rest: str, message: str) -> None:
    """In one line that names the joint, tool or support, and what to do."""
    with pytest.raises(ForceTorqueError, match=message) as refused:
        plan(_run(arm, rest))
    assert "\n" not in str(refused.value)


def test_what_is_asked_of_a_plan_is_checked(arm: Path) -> None:
    """A use that nobody states, no time for postures, a clearance below zero, a calibration without covariance."""
    run = _run(arm)
    thesis = calibrate_sensor(run, code_version="1", created="2020-01-01T00:00:00+00:00", regularisation=0.0)
    with pytest.raises(ExperimentError, match="no load case of the sensor is called 'pull'; known: push"):
        plan(run, load_case="pull")
    with pytest.raises(ExperimentError, match="expected recordings of at least 8 s"):
        plan(run, seconds=3.0)
    with pytest.raises(ExperimentError, match="expected a clearance of at least 0 deg, got -1"):
        plan(run, clearance_deg=-1.0)
    with pytest.raises(ForceTorqueError, match="a plan needs a calibration with a covariance"):
        plan(run, thesis)
