# SPDX-License-Identifier: BSD-3-Clause
"""Where a robot presses is where the ground presses it, whatever lies between sensors and soles, in motion too."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import Experiment
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.locomotion.answers import balance_answer
from forcetorque.locomotion.section import SOLES
from forcetorque.locomotion.standing.balance import balance
from forcetorque.locomotion.standing.foot_wrenches import load_foot_forces
from forcetorque.locomotion.standing.interval_balance import BalanceOptions
from forcetorque.locomotion.standing.support_phases import NO_FOOT, ContactThresholds, ForceLimit, support_phases
from forcetorque.results.answer import Concern
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import balancing_movement
from forcetorque.simulation.robots import BIPED_URDF
from tests.locomotion.standing_robot import Standing, moving, switching
from tests.page_scripts import unmarked

EXACT_M = 1e-9
ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples"
TILT_DEG = 8.0
NOISE = np.repeat([1.0, 0.05], 3)
"""Deviation of a reading in tests of intervals; N, N m."""


@pytest.fixture(scope="module")
def standing(tmp_path_factory: pytest.TempPathFactory) -> Standing:
    """The biped through all phases of contact switching."""
    return switching(tmp_path_factory.mktemp("standing") / "out")


@pytest.fixture(scope="module")
def tilted(standing: Standing) -> Standing:
    """The biped that moves fast on its left foot, on ground that is 8 degrees out of level."""
    tilt = np.radians(TILT_DEG)
    down = np.array([np.sin(tilt), 0.0, -np.cos(tilt)])
    stand = Stand(model=read_urdf(BIPED_URDF), support="l_sole", gravity_direction=down, speed=2.0)
    return moving(standing, balancing_movement(stand, "r_sole", rng=np.random.default_rng(4), postures=2))


@pytest.mark.long
def test_a_script_writes_forces_as_the_command_does(standing: Standing) -> None:
    """Touch, release and least load in newtons or shares; the other options are those of `BalanceOptions`."""
    asked = BalanceOptions(
        touch=ForceLimit.of("50N"), release=ForceLimit.of("5%"), least_load=ForceLimit.of("20N"), dwell_s=0.1
    )
    expected = balance([standing.experiment], [corrections_of(standing.experiment, {})], asked)
    said = Experiment.of(standing.experiment).balance(touch="50N", release="5%", least_load="20N", dwell_s=0.1)
    assert said.json_text() == expected.json_text()


@pytest.mark.long
def test_points_are_those_of_the_ground_in_every_phase(standing: Standing) -> None:
    """Of each foot that is down, within 1e-9 m; a foot in the air has none, and phases are those that were planned."""
    result = balance([standing.experiment], [standing.corrections])
    names = {interval.label: interval.phases.names for interval in result.intervals}
    both = "l_sole + r_sole"
    assert (names["hanging"], names["l_sole"], names["r_sole"]) == ((NO_FOOT,), ("l_sole",), ("r_sole",))
    # the weight goes to one foot, or comes from one
    assert (names["double_1"], names["double_2"], names["double_3"]) == (
        (both, "l_sole"),
        ("l_sole", both, "r_sole"),
        ("r_sole", both),
    )
    compared = 0
    for interval in result.intervals:
        for foot in interval.feet:
            known = foot.pressure.known
            if not known.any():
                continue
            true = standing.true_points(foot.sole.frame, interval.stamp_ns)
            np.testing.assert_allclose(foot.pressure.points[known], true[known], rtol=0, atol=EXACT_M)
            assert foot.reading_alone is not None
            # negative control: what neglect of weight, inertia and height below the sensor comes to
            assert 1e3 * np.nanmax(np.abs(foot.reading_alone[known] - true[known])) > 1.0, interval.label
            compared += 1
    assert compared == 8
    free = next(row for row in result.feet if (row.interval, row.sole) == ("l_sole", "r_sole"))
    assert (free.samples, free.load_N, free.x_mm) == (0, None, None)
    assert any("never bears the least load" in warning for warning in result.warnings)
    hanging = next(interval.robot for interval in result.intervals if interval.label == "hanging")
    assert hanging is not None
    assert hanging.zero_moment_point is not None
    assert np.isnan(hanging.zero_moment_point).all()


@pytest.mark.long
def test_the_net_force_is_the_weight_where_nothing_moves(standing: Standing) -> None:
    """In double support all joints are still: the two feet bear what the robot weighs."""
    result = balance([standing.experiment], [standing.corrections])
    (row,) = [row for row in result.phases if row.phase == "l_sole + r_sole"]
    assert row.from_weight_N == pytest.approx(0.0, abs=1e-6)


def test_neither_a_slope_nor_acceleration_enters(tilted: Standing) -> None:
    """On a slope and in fast motion: the point of the foot, of the robot and of its motion are one, within 1e-9 m."""
    (interval,) = balance([tilted.experiment], [tilted.corrections]).intervals
    true = tilted.true_points("l_sole", interval.stamp_ns)
    left = interval.feet[0]
    assert interval.robot is not None
    assert interval.robot.zero_moment_point is not None
    assert interval.robot.com_acceleration_of_joints is not None
    assert np.abs(interval.robot.com_acceleration_of_joints).max() > 0.3
    for points in (left.pressure.points, interval.robot.pressure.points, interval.robot.zero_moment_point):
        assert np.isfinite(points).all()
        np.testing.assert_allclose(points, true, rtol=0, atol=EXACT_M)
    # negative control: the weight alone, without inertia, would press elsewhere
    assert interval.robot.com is not None
    slope = interval.robot.com[:, 0] + np.tan(np.radians(TILT_DEG)) * interval.robot.com[:, 2]
    assert np.abs(slope - true[:, 0]).max() > 0.002


def test_a_sensor_in_the_leg_tells_the_same_point(standing: Standing) -> None:
    """Without the sensors of the feet those of the legs do, two joints and a shank above the sole, within 1e-9 m."""
    legs = {name: reading for name, reading in standing.corrections.items() if "leg" in name}
    sensors = tuple(sensor for sensor in standing.experiment.sensors if sensor.name in legs)
    result = balance([replace(standing.experiment, sensors=sensors)], [legs])
    compared = 0
    for interval in result.intervals:
        for foot in interval.feet:
            known = foot.pressure.known
            assert foot.sensors == (f"{foot.sole.frame[0]}_leg_ft",)
            true = standing.true_points(foot.sole.frame, interval.stamp_ns)
            np.testing.assert_allclose(foot.pressure.points[known], true[known], rtol=0, atol=EXACT_M)
            compared += int(known.any())
    assert compared == 8


def _noisy(like: Standing, seed: int) -> Standing:
    """The same with white noise in all readings, whose size the file states."""
    rng = np.random.default_rng(seed)
    experiment, streams = like.experiment, dict(like.experiment.recording.streams)
    for sensor in experiment.sensors:
        stream = streams[sensor.stream]
        signal = stream.signal("raw")
        noise = rng.normal(size=(len(stream), 6)) * NOISE @ np.linalg.inv(like.corrections[sensor.name].model.matrix).T
        streams[sensor.stream] = replace(stream, signals={"raw": replace(signal, values=signal.values + noise)})
    sensors = tuple(
        replace(sensor, measurement_noise=NOISE, measurement_offset_sd=np.zeros(6)) for sensor in experiment.sensors
    )
    recording = replace(experiment.recording, streams=streams)
    return replace(like, experiment=replace(experiment, recording=recording, sensors=sensors))


def test_intervals_of_points_hold_the_truth(tilted: Standing) -> None:
    """With noise of a stated size 92 to 98 % of the points are within their 95 % intervals."""
    noisy = _noisy(tilted, seed=5)
    (interval,) = balance([noisy.experiment], [noisy.corrections]).intervals
    true = tilted.true_points("l_sole", interval.stamp_ns)
    assert interval.robot is not None
    for pressure in (interval.feet[0].pressure, interval.robot.pressure):
        assert pressure.covariance is not None
        half = 1.96 * np.sqrt(np.einsum("nii->ni", pressure.covariance))
        inside = np.abs(pressure.points - true) <= half
        assert len(inside) > 150
        assert np.all((inside.mean(axis=0) > 0.92) & (inside.mean(axis=0) < 0.98)), inside.mean(axis=0)


def test_the_pendulum_holds_within_its_interval_inside_the_band_and_is_refused_outside(tilted: Standing) -> None:
    """(5.22) on the samples whose height stays within 20 mm: 90 % of the true accelerations are inside; others NaN."""
    noisy = _noisy(tilted, seed=6)
    options = BalanceOptions(height_band_m=0.02)
    (interval,) = balance([noisy.experiment], [noisy.corrections], options).intervals
    assert interval.robot is not None
    pendulum, true = interval.robot.com_acceleration, interval.robot.com_acceleration_of_joints
    assert pendulum is not None
    assert pendulum.half_width_95 is not None
    assert true is not None
    known = np.isfinite(pendulum.acceleration[:, 0])
    assert 50 < known.sum() < len(known)
    assert np.mean(np.abs(pendulum.acceleration - true)[known] <= pendulum.half_width_95[known]) > 0.9
    narrow = balance([noisy.experiment], [noisy.corrections], BalanceOptions(height_band_m=1e-7))
    assert not narrow.pendulum
    assert any("never stays in its band" in words for words in narrow.refused)


def test_a_wrong_offset_is_flagged_and_not_clipped(tilted: Standing) -> None:
    """A moment of 40 N m too much puts the point outside the sole: it is given where it is, with a warning."""
    sensor = "l_foot_ft"
    model = tilted.corrections[sensor].model
    wrong = Correction(
        model=WrenchModel(matrix=model.matrix, offset=model.offset + [0, 0, 0, 0, 40.0, 0]),
        source="a test",
        matrix_source="a test",
    )
    result = balance([tilted.experiment], [{**tilted.corrections, sensor: wrong}])
    left = result.feet[0]
    assert left.outside_percent == 100.0
    assert left.beyond_mm is not None
    assert left.beyond_mm > 20.0
    assert any("lie outside the outline, by up to" in warning for warning in result.warnings)


@pytest.mark.long
def test_feet_that_bear_another_weight_are_doubted(standing: Standing) -> None:
    """An offset of 100 N upwards that nobody removed: the robot seems a third heavier, and a warning says so."""
    sensor = "l_foot_ft"
    model = standing.corrections[sensor].model
    wrong = Correction(
        model=WrenchModel(matrix=model.matrix, offset=model.offset + [0, 0, -100.0, 0, 0, 0]),
        source="a test",
        matrix_source="a test",
    )
    exact = balance([standing.experiment], [standing.corrections])
    assert not any("weighs" in warning for warning in exact.warnings)
    result = balance([standing.experiment], [{**standing.corrections, sensor: wrong}])
    assert any("the robot weighs" in warning and "offset" in warning for warning in result.warnings)


def test_what_is_missing_is_named(standing: Standing, tilted: Standing) -> None:
    """No sole, no interval, no experiment; a joint that was not logged takes the centre of mass, not the feet."""
    with pytest.raises(ExperimentError, match=r"expected \[\[sole\]\]"):
        balance([replace(standing.experiment, sections={SOLES.key: ()})], [standing.corrections])
    with pytest.raises(ExperimentError, match="expected an experiment at least"):
        balance([])
    streams = dict(tilted.experiment.recording.streams)
    joints = streams["joints"]
    kept = [k for k, name in enumerate(joints.signal("position").columns) if not name.startswith("l_shoulder")]
    streams["joints"] = replace(
        joints,
        signals={
            name: replace(
                signal,
                values=signal.values[:, kept],
                columns=tuple(signal.columns[k] for k in kept),
                units=tuple(signal.units[k] for k in kept),
            )
            for name, signal in joints.signals.items()
        },
    )
    recording = replace(tilted.experiment.recording, streams=streams)
    result = balance([replace(tilted.experiment, recording=recording)], [tilted.corrections])
    assert any(
        "centre of mass and zero moment point: the log has no position of l_shoulder" in w for w in result.refused
    )
    assert all(row.com_x_mm is None for row in result.robot)
    assert sum(row.samples for row in result.feet) > 0


@pytest.mark.long
def test_the_script_of_the_page_runs(
    standing: Standing, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """As it stands, on the recording of contact switching whose file states its soles."""
    source = standing.experiment.file
    text = source.read_text(encoding="utf-8")
    source.with_name("standing.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(source.parent)
    (code,) = unmarked((ROOT / "docs" / "locomotion" / "balance.md").read_text(encoding="utf-8"))
    exec(compile(code, "balance.md", "exec"), {})
    shown = capsys.readouterr().out
    assert "support phases of switching" in shown
    assert "centre of pressure of each foot" in shown
    assert Path("samples.parquet").exists()


def test_thresholds_are_shares_of_the_weight() -> None:
    """The defaults are 15 and 6 percent."""
    assert BalanceOptions().thresholds(300.0) == ContactThresholds(contact_threshold_N=45.0, release_N=18.0)


WALKING = BalanceOptions(touch=ForceLimit(force_N=50.0), release=ForceLimit(force_N=20.0))


@pytest.mark.real_data
def test_a_walking_robot_bears_its_weight_on_either_foot(data_dir: Path, tmp_path: Path) -> None:
    """318 N on the left foot, 325 N on the right, 333 N on both, of 324 N; the same forces are counted once."""
    text = (EXAMPLES / "21_icub_walking_forces.toml").read_text(encoding="utf-8")
    text = text.replace("../../shared/data", data_dir.as_posix())
    files = []
    for number, log in enumerate(("walking.mat", "walking_2021.mat")):
        files.append(tmp_path / f"{number}.toml")
        files[-1].write_text(
            text.replace("walking.mat", log).replace("icub walking", f"icub walking {number}"), "utf-8"
        )
    result = balance([load_foot_forces(file) for file in files], options=WALKING)
    rows = {row.phase: row for row in result.phases}
    for phase, mean_N, deviation_N in (
        ("l_sole", 318.0, 9.0),
        ("r_sole", 325.0, 11.0),
        ("l_sole + r_sole", 333.0, 9.0),
    ):
        row = rows[phase]
        assert row.net_N == pytest.approx(mean_N, abs=1.0)
        assert row.deviation_N == pytest.approx(deviation_N, abs=1.0)
        assert row.independent is not None
        assert row.independent < 0.5 * row.samples
    assert result.weight_N == pytest.approx(324.4, abs=0.1)
    assert len(result.experiments) == 1
    assert any("sample for sample; counted once" in warning for warning in result.warnings)
    assert not result.feet
    assert any("only the vertical forces of the feet were logged" in words for words in result.refused)


@pytest.mark.real_data
def test_phases_of_the_yoga_log_are_those_that_were_seen(data_dir: Path, tmp_path: Path) -> None:
    """The left foot alone from 17 to 62 s, within 2 s, once offsets of the middle are off; both before and after."""
    file = tmp_path / "yoga.toml"
    text = (EXAMPLES / "22_icub_yoga_phases.toml").read_text(encoding="utf-8")
    file.write_text(text.replace("../../shared/data", data_dir.as_posix()), encoding="utf-8")
    experiment = load_experiment(file)
    result = balance([experiment], [corrections_of(experiment, {})])
    (interval,) = result.intervals
    assert any("the robot weighs" in warning for warning in result.warnings)  # with the offsets as they were logged
    time_s, middle = interval.time_s, (interval.time_s > 25.0) & (interval.time_s < 55.0)
    borne_N = {"l_sole": 324.2, "r_sole": 0.0}  # then it stands on its left foot
    forces = {sole: force - force[middle].mean() + borne_N[sole] for sole, force in interval.forces.items()}
    thresholds = BalanceOptions(
        touch=ForceLimit(force_N=15.0), release=ForceLimit(force_N=5.0), dwell_s=0.1
    ).thresholds(None)
    phases = support_phases(forces, time_s, thresholds).phases
    assert {phase.name for phase in phases} == {"l_sole", "l_sole + r_sole"}
    alone = max((phase for phase in phases if phase.name == "l_sole"), key=lambda phase: phase.duration_s)
    assert alone.start_s == pytest.approx(17.0, abs=2.0)  # before it the right foot taps, for 0.3 s at most
    assert alone.end_s == pytest.approx(62.0, abs=2.0)
    assert phases[-1].name == "l_sole + r_sole"
    assert max(phase.end_s for phase in phases[1:] if phase.name != "l_sole" and phase.end_s < 60.0) < 17.0


def test_no_event_is_claimed_while_an_offset_is_unknown(standing: Standing) -> None:
    """A sole under a sensor without its offset is named once; with it, the same points outside are events."""
    unknown = {name: replace(one, removes_offset=name != "l_foot_ft") for name, one in standing.corrections.items()}
    known, some = (balance([standing.experiment], [one]) for one in (standing.corrections, unknown))
    assert {event.sole for event in known.events} == {"l_sole", "r_sole"}
    assert balance_answer(known).concern is Concern.UNCERTAIN
    assert some.events == tuple(event for event in known.events if event.sole == "r_sole")
    untested = [warning for warning in some.warnings if "no look for slips" in warning]
    assert len(untested) == 1
    assert "on l_sole: " in untested[0]
    assert not any("no look for slips" in warning for warning in known.warnings)


def test_sensors_without_an_offset_share_one_warning(standing: Standing) -> None:
    """A robot of twenty sensors has one line, in which all are named."""
    unknown = {name: replace(one, removes_offset=False) for name, one in standing.corrections.items()}
    said = [one for one in balance([standing.experiment], [unknown]).warnings if "no offset was removed" in one]
    assert len(said) == 1
    assert all(name in said[0] for name in unknown)
