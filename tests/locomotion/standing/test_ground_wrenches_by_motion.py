# SPDX-License-Identifier: BSD-3-Clause
"""Foot forces by masses, joints and IMU alone are those of the ground, in motion too; several feet share unknown."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.locomotion.section import SOLES
from forcetorque.locomotion.standing.balance import balance
from forcetorque.locomotion.standing.ground_wrenches_by_motion import SHARES, balance_by_motion
from forcetorque.locomotion.standing.interval_balance import BalanceOptions, IntervalBalance
from forcetorque.locomotion.standing.support_phases import ForceLimit
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import MovingSupport
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario
from tests.app.outcome import Run
from tests.locomotion.standing_robot import Standing, switching
from tests.scenes.experiments import edit
from tests.scenes.switchings import short_switching

EXACT_N, EXACT_M = 1e-6, 1e-8
"""Rounding of forces of 300 N; the log keeps positions, velocities and accelerations exactly."""
SOLE_FRAMES = ("l_sole", "r_sole")


@pytest.fixture(scope="module")
def standing(tmp_path_factory: pytest.TempPathFactory) -> Standing:
    """The biped through all phases of contact switching."""
    return switching(tmp_path_factory.mktemp("standing") / "out")


def _true_force(standing: Standing, frame: str, interval: IntervalBalance) -> np.ndarray:
    stream = standing.truth.stream(frame)
    return interpolate(stream, stream.signal("wrench").values, interval.stamp_ns)[:, 2]


def _intervals(experiment: Experiment) -> dict[str, IntervalBalance]:
    return {one.label: one for one in balance_by_motion(experiment, BalanceOptions())}


def test_one_foot_bears_what_the_ground_does(standing: Standing) -> None:
    """Force and centre of pressure of a foot that is alone down, exactly; the other bears nothing."""
    seen = 0
    for one in _intervals(standing.experiment).values():
        for phase in one.phases.phases:
            if len(phase.feet) != 1:
                continue
            (frame,) = phase.feet
            foot = next(foot for foot in one.feet if foot.sole.frame == frame)
            assert one.forces[frame] == pytest.approx(_true_force(standing, frame, one), abs=EXACT_N)
            assert foot.pressure.points == pytest.approx(standing.true_points(frame, one.stamp_ns), abs=EXACT_M)
            (other,) = set(one.forces) - {frame}
            assert (one.forces[other] == 0.0).all()
            seen += 1
    assert seen == 2


def test_of_two_feet_the_sum_is_determined_and_the_shares_are_not(standing: Standing) -> None:
    """The sum is that of the ground on both; no share is guessed, and the result says so."""
    seen = 0
    for one in _intervals(standing.experiment).values():
        if one.phases.names != ("l_sole + r_sole",):
            continue
        truth = sum(_true_force(standing, frame, one) for frame in one.forces)
        assert one.net_N == pytest.approx(truth, abs=EXACT_N)
        assert all(np.isnan(force).all() for force in one.forces.values())
        assert SHARES in one.refused
        seen += 1
    assert seen >= 2


def test_an_interval_in_which_the_robot_hangs_is_not_determined(standing: Standing) -> None:
    """The torso is touched, and is no sole: no phase, and a sentence that names it."""
    hanging = _intervals(standing.experiment)["hanging"]
    assert hanging.phases.phases == ()
    assert "hanging: torso is touched and no [[sole]]" in hanging.refused[0]


def test_a_wrong_mass_is_a_wrong_force(standing: Standing) -> None:
    """Negative control: a link that is 1 kg heavier in the model adds its weight, and more where it accelerates."""
    model = standing.experiment.model
    heavy = replace(model.links["torso"], mass=model.links["torso"].mass + 1.0)
    wrong = replace(standing.experiment, model=replace(model, links={**model.links, "torso": heavy}))
    right, off = _intervals(standing.experiment), _intervals(wrong)
    label = next(label for label, one in right.items() if one.phases.names == ("l_sole",))
    assert (off[label].net_N - right[label].net_N).mean() == pytest.approx(9.80665, rel=1e-2)


def test_no_sensor_is_read(standing: Standing) -> None:
    """Without the streams of the sensors the result is the same."""
    recording = standing.experiment.recording
    sensors = {sensor.stream for sensor in standing.experiment.sensors}
    streams = {name: stream for name, stream in recording.streams.items() if name not in sensors}
    bare = replace(standing.experiment, sensors=(), recording=replace(recording, streams=streams))
    for label, one in _intervals(bare).items():
        assert one.net_N == pytest.approx(_intervals(standing.experiment)[label].net_N, nan_ok=True)


def _with_forces(standing: Standing, *, clock: str = "simulation", frames: tuple[str, ...] = SOLE_FRAMES) -> Experiment:
    """The experiment with logged vertical forces of soles."""
    experiment = standing.experiment
    streams, soles = dict(experiment.recording.streams), []
    for entry in experiment.section(SOLES):
        name = f"foot_{entry.sole.frame}"
        if entry.sole.frame in frames:
            stream = standing.truth.stream(entry.sole.frame)
            vertical = Signal.of_fixed("vertical_force", stream.signal("wrench").values[:, 2:3])
            streams[name] = replace(stream, name=name, clock=clock, signals={"vertical_force": vertical})
        soles.append(replace(entry, stream=name if entry.sole.frame in frames else None))
    return replace(
        experiment,
        recording=replace(experiment.recording, streams=streams),
        sections={**experiment.sections, SOLES.key: tuple(soles)},
    )


def test_forces_of_another_clock_are_refused(standing: Standing) -> None:
    """As by sensors: stamps of two clocks say nothing of each other."""
    with pytest.raises(RecordingError, match="'joints' and 'foot_l_sole' were stamped by the clocks"):
        balance([_with_forces(standing, clock="treadmill")], by_motion=True)


def test_forces_of_one_sole_alone_are_not_dropped_in_silence(standing: Standing) -> None:
    """The intervals state the contacts then, and a warning says so."""
    result = balance([_with_forces(standing, frames=("l_sole",))], by_motion=True)
    assert "the forces of foot_l_sole are not used, as r_sole has no stream" in result.warnings[0]
    assert {row.logged_N for row in result.phases} == {None}
    assert (result.contact_threshold_N, result.release_N, result.dwell_s) == (None, None, None)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (BalanceOptions(touch=ForceLimit(force_N=5000.0)), "--touch, --release, --dwell: expected a stream"),
        (BalanceOptions(dwell_s=100.0), "--touch, --release, --dwell: expected a stream"),
        (BalanceOptions(height_band_m=0.01), "--height-band: expected force sensors"),
    ],
)
def test_options_without_an_effect_are_refused(standing: Standing, options: BalanceOptions, message: str) -> None:
    """No stream to which thresholds apply; no wrench for (5.22)."""
    with pytest.raises(ExperimentError, match=message):
        balance([standing.experiment], options=options, by_motion=True)


def test_recordings_of_other_motion_are_all_counted(standing: Standing) -> None:
    """Of both feet no force is known; the sum tells two recordings of one time apart, and a copy is counted once."""
    recording = standing.experiment.recording
    both = [one for one in recording.intervals if isinstance(one.support, MovingSupport) and one.label != "hanging"][:1]
    first = replace(standing.experiment, name="first", recording=replace(recording, intervals=tuple(both)))
    joints = recording.stream("joints")
    faster = replace(joints.signal("acceleration"), values=joints.signal("acceleration").values + 0.1)
    streams = {**recording.streams, "joints": replace(joints, signals={**joints.signals, "acceleration": faster})}
    second = replace(first, name="second", recording=replace(first.recording, streams=streams))
    result = balance([first, second, replace(first, name="copy")], by_motion=True)
    assert result.experiments == ("first", "second")
    assert "copy: its forces are those of first" in result.warnings[0]


def test_a_support_that_is_fixed_to_a_sole_is_that_sole(standing: Standing) -> None:
    """The link of the foot in place of the frame of its sole: the same forces and points."""
    experiment = standing.experiment
    (label,) = (one.label for one in experiment.recording.intervals if one.label == "l_sole")
    foot = next(joint.parent for joint in experiment.model.joints.values() if joint.child == "l_sole")
    intervals = tuple(
        replace(one, support=replace(one.support, frame=foot)) if one.label == label and one.support else one
        for one in experiment.recording.intervals
    )
    moved = replace(experiment, recording=replace(experiment.recording, intervals=intervals))
    right, other = _intervals(experiment)[label], _intervals(moved)[label]
    assert other.phases.names == ("l_sole",)
    assert other.forces["l_sole"] == pytest.approx(right.forces["l_sole"], abs=EXACT_N)
    assert other.feet[0].pressure.points == pytest.approx(right.feet[0].pressure.points, abs=EXACT_M)


def test_logged_vertical_forces_give_the_phases(standing: Standing) -> None:
    """Soles with a stream: thresholds of the logged forces say which foot is down, whatever the intervals state."""
    result = balance([_with_forces(standing)], options=BalanceOptions(), by_motion=True)
    assert {row.phase for row in result.phases} == {"l_sole", "r_sole", "l_sole + r_sole"}
    for row in result.phases:
        assert row.net_N is not None
        assert row.logged_N == pytest.approx(row.net_N, abs=EXACT_N)


@pytest.mark.real_data
def test_the_real_walk_by_motion_beside_its_logged_forces(data_dir: Path) -> None:
    """Example 32: the motion demands the weight within its interval on either foot; the left foot logs less of it."""
    if not (data_dir / "icub_genova04_walking_ramadoss").is_dir():
        pytest.skip("the walking log is not there")
    experiment = load_experiment(Path(__file__).parents[3] / "examples/32_icub_walking_by_motion.toml", Purpose.MOTION)
    options = BalanceOptions(touch=ForceLimit(force_N=50.0), release=ForceLimit(force_N=20.0))
    rows = {row.phase: row for row in balance([experiment], options=options, by_motion=True).phases}
    assert {name: (row.intervals, row.samples) for name, row in rows.items()} == {
        "l_sole + r_sole": (10, 800),
        "r_sole": (3, 205),
        "l_sole": (6, 183),
    }
    for name, net, logged in (("l_sole", 325.2, 318.1), ("r_sole", 323.1, 325.1), ("l_sole + r_sole", 323.8, 333.3)):
        row = rows[name]
        assert (row.net_N, row.logged_N) == (pytest.approx(net, abs=0.1), pytest.approx(logged, abs=0.1))
        assert row.half_width_95_N is not None
        assert row.from_weight_N is not None
        assert abs(row.from_weight_N) < row.half_width_95_N


@pytest.fixture
def files(tmp_path: Path) -> Path:
    """The experiment file of the first day, as `simulate` writes it."""
    switching(tmp_path / "out")
    return tmp_path / "out" / "switching_day1.toml"


@pytest.mark.long
def test_files_of_simulate_have_soles(files: Path, run: Run) -> None:
    """`simulate switching` states both; balance reads them by sensors and by motion, and an offset is removed."""
    assert [entry.sole.frame for entry in load_experiment(files).section(SOLES)] == ["l_sole", "r_sole"]
    shown = run("robot", "balance", files, "--by-motion", "--details")
    assert shown.code == 0, shown.err
    assert "net force that the motion demands" in " ".join(shown.out.split())
    assert "a foot is down as the intervals state; no centre of pressure below" in " ".join(shown.out.split())
    by_motion = run("robot", "balance", files, "--by-motion", "--format", "json").result()
    assert by_motion["by_motion"] is True
    assert all(abs(row["from_weight_N"]) < 1.0 for row in by_motion["phases"])
    hung = run("robot", "balance", files, "--offset", "one-link-imu:hanging", "--format", "json").result()
    bare = run("robot", "balance", files, "--offset", "none", "--format", "json").result()
    assert hung["by_motion"] is False
    worst = [
        max(abs(row["from_weight_N"]) for row in one["phases"] if row["phase"] != "no foot") for one in (hung, bare)
    ]
    assert worst[0] < 0.5 * worst[1]


def test_without_soles_the_touched_links_are_named(files: Path, run: Run) -> None:
    """It asks, and proposes what the intervals touch."""
    text = files.read_text(encoding="utf-8")
    for frame in ("l_sole", "r_sole"):
        text = text.replace(f'\n[[sole]]\nframe = "{frame}"\n', "")
    files.write_text(text, encoding="utf-8")
    for words in ((), ("--by-motion",)):
        refused = run("robot", "balance", files, *words)
        assert refused.code == 2
        assert '[[sole]] frame = "l_sole"' in " ".join(refused.err.split())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--offset", "first-second"), "it comes from every interval itself"),
        (("--by-motion", "--offset", "none"), "no sensor is read"),
        (("--offset", "one-link-imu:nowhere"), "no interval is labelled 'nowhere'"),
    ],
)
def test_options_that_do_not_fit_are_refused(files: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """One line and exit code 2."""
    refused = run("robot", "balance", files, *words)
    assert refused.code == 2
    assert message in " ".join(refused.err.split())


def test_a_joint_that_was_not_logged_is_named(standing: Standing) -> None:
    """With the line that states where it is held."""
    recording = standing.experiment.recording
    joints = recording.stream("joints")
    kept = {
        name: replace(signal, values=signal.values[:, 1:], columns=signal.columns[1:], units=signal.units[1:])
        for name, signal in joints.signals.items()
    }
    streams = {**recording.streams, "joints": replace(joints, signals=kept)}
    lacking = replace(standing.experiment, recording=replace(recording, streams=streams))
    with pytest.raises(ExperimentError, match=r"which carry a mass and no stream holds; .* as fixed = \{ "):
        _intervals(lacking)
    no_joints = {name: stream for name, stream in recording.streams.items() if name != "joints"}
    with pytest.raises(ExperimentError, match="which carry a mass and no stream holds"):
        _intervals(replace(standing.experiment, recording=replace(recording, streams=no_joints)))


def test_a_robot_whose_joints_are_all_held_is_refused(files: Path) -> None:
    """Nothing gives the instants."""
    experiment = load_experiment(files)
    names = [name for name, joint in experiment.model.joints.items() if joint.type.moves]
    streams = {name: stream for name, stream in experiment.recording.streams.items() if name != "joints"}
    write_recording(files.parent / "held", replace(experiment.recording, streams=streams))
    edit(files, 'path = "switching_day1"', 'path = "held"')
    edit(files, "[robot]\n", f"[robot]\nfixed = {{ {', '.join(f'{name} = 0.0' for name in names)} }}\n")
    with pytest.raises(ExperimentError, match="got a robot whose joints are all held; leave those out of fixed"):
        _intervals(load_experiment(files, Purpose.MOTION))


def test_a_file_without_sensors_is_read_for_motion(files: Path) -> None:
    """No [[sensor]]: refused for sensors, read for motion."""
    text = files.read_text(encoding="utf-8")
    start = text.index("[[sensor]]")
    end = min(
        text.index(mark, start) for mark in ("[calibration]", "[processing]", "[[support]]") if mark in text[start:]
    )
    files.write_text(text[:start] + text[end:], encoding="utf-8")
    with pytest.raises(ExperimentError, match=r"expected \[\[sensor\]\]"):
        load_experiment(files)
    assert load_experiment(files, Purpose.MOTION).sensors == ()


@pytest.mark.long
def test_errors_of_a_robot_that_is_not_as_its_model(tmp_path: Path) -> None:
    """12 robots of `simulate switching`, masses off by 1 %, joint zeros by .2 deg, IMU with bias and noise: N, mm."""
    force, points = [], []
    for seed in range(301, 313):
        scenario = build_scenario(short_switching().model_copy(update={"seed": seed}))
        write_scenario(scenario, tmp_path / str(seed))
        truth = read_recording(tmp_path / str(seed) / "switching_day1_contacts")
        experiment = load_experiment(tmp_path / str(seed) / "switching_day1.toml")
        by_truth = Standing(experiment=experiment, corrections={}, truth=truth)
        for one in _intervals(experiment).values():
            for foot in one.feet:
                alone = one.forces[foot.sole.frame] > 1.0
                if not alone.any():
                    continue
                error = (one.forces[foot.sole.frame] - _true_force(by_truth, foot.sole.frame, one))[alone]
                off = (foot.pressure.points - by_truth.true_points(foot.sole.frame, one.stamp_ns))[alone]
                force.append(float(np.sqrt(np.mean(error**2))))
                points.append(1e3 * float(np.sqrt(np.mean(np.sum(off**2, axis=1)))))
    assert len(force) == 24
    assert (np.median(force), max(force)) == pytest.approx((0.66, 2.21), abs=0.02)
    assert (np.median(points), max(points)) == pytest.approx((2.49, 5.63), abs=0.05)
