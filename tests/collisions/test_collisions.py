# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of the small arm, planted into its log from the poses of its links, and what happens without any."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from copy import copy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.pose import cross
from forcetorque.collisions.collision_and_sole_events import with_collisions
from forcetorque.collisions.collisions import find_collisions
from forcetorque.collisions.contact_free_model import FreeChanges, matrix_errors
from forcetorque.collisions.result import Collisions
from forcetorque.collisions.sensor_residual import Level, changes_of, signals_of, split_columns
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.inspection.residual_findings import UNEXPLAINED
from forcetorque.recording.recording import Finding, Support
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.mechanics.measured_and_expected_wrench import robot_motion_at
from forcetorque.robot.tree import build_tree, joints_between
from forcetorque.viewer.scene_builder import build_scene
from forcetorque.viewer.viewer_log import viewer_log
from tests.app.outcome import Run
from tests.scenes.experiments import MOUNTED, PARQUET, edit, write_experiments

FORCE_N, PLACE_M, START_S, END_S = 12.0, (0.0, 0.0, -0.1), 17.0, 17.3
"""A push on the forearm, half way to the wrist, against its axis."""
ROUNDING = 1e-9
"""Of sums of some hundred numbers up to 100."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The arm, whose model may be wrong."""
    folder = tmp_path_factory.mktemp("arm")
    write_experiments(folder)
    edit(folder / PARQUET, 'tolerance = "exact"\n', "")
    return folder


def _run(folder: Path) -> SensorRun:
    return SensorRun(load_experiment(folder / PARQUET), "arm_ft")


def _found(run: SensorRun, free: tuple[str, ...] = ()) -> Collisions:
    return find_collisions(run, run.read_by(None, None).bare, (), free, 1.0)


def test_supports_share_terms_by_name(folder: Path) -> None:
    """Where a robot stands on one link, then on another, terms of one name have one column."""
    run = _run(folder)
    interval = run.experiment.recording.intervals[0]
    own = signals_of(run, run.read_by(None, None).bare, interval)
    names = ("mass of another", *reversed(own.of_model))
    shared = own.with_terms(names)
    assert len(own.of_model) > 3
    np.testing.assert_array_equal(shared.columns[:, :12], own.columns[:, :12])
    terms, of_model = (split_columns(one.columns)[2] for one in (shared, own))
    np.testing.assert_array_equal(terms[:, :, 1:], of_model[:, :, ::-1])
    assert not terms[:, :, 0].any()
    assert of_model.any()


def test_windows_change_against_the_mean_of_those_before_them(folder: Path) -> None:
    """Together as one by one: the mean forgets, stays where it is held, and begins anew after a pause."""
    run = _run(folder)
    whole = signals_of(run, run.read_by(None, None).bare, run.experiment.recording.intervals[0])
    kept = np.ones(len(whole), dtype=np.bool_)
    kept[120:140] = False
    signals = whole.kept(kept)
    together, known = Level(signals).changes(0, len(signals))
    level, mean, count = Level(signals), np.zeros_like(signals.columns[0]), 0
    for window, columns in enumerate(signals.columns):
        count = 0 if window == 120 else count
        if window == 80:
            held = copy(level)
            for later in range(window, window + 5):
                (change,), _ = held.changes(later, later + 1, held=True)
                np.testing.assert_allclose(change, signals.columns[later] - mean, atol=ROUNDING)
        (change,), (is_known,) = level.changes(window, window + 1)
        assert is_known == known[window] == (count >= 20)
        np.testing.assert_allclose(change, columns - mean, atol=ROUNDING)
        np.testing.assert_allclose(together[window], columns - mean, atol=ROUNDING)
        count += 1
        mean = mean + max(0.01, 1.0 / count) * (columns - mean)
    assert len(signals) > 200


def test_six_loads_give_what_the_terms_of_all_coefficients_give(folder: Path) -> None:
    """Change and covariance are those of one column for each coefficient of the matrix, written out."""
    run = _run(folder)
    correction = run.read_by(None, None).bare
    signals = signals_of(run, correction, run.experiment.recording.intervals[0])
    of_load = matrix_errors(run, correction.model.matrix)
    changes = changes_of([signals])
    model = FreeChanges.of(changes, signals.unmodelled, of_load)
    wrenches, covariances = model.wrench(changes)
    residual, load, of_model = split_columns(changes)
    terms = np.concatenate([np.einsum("wl,lkp->wkp", load, of_load), of_model], axis=2)
    spread = np.einsum("wkp,pq,wnq->wkn", terms, model.free.covariance, terms, optimize=True)
    np.testing.assert_allclose(wrenches, residual - terms @ model.free.mean, atol=ROUNDING * np.abs(residual).max())
    np.testing.assert_allclose(covariances, model.free.noise + spread, rtol=1e-9, atol=1e-9 * np.abs(spread).max())
    assert np.abs(terms @ model.free.mean).max() > 1e-3 * np.abs(residual).max()


def _relative_poses(run: SensorRun, link: str) -> tuple[FloatArray, FloatArray]:
    """`sensor_H_link` and `base_R_sensor` at every sample of the sensor."""
    experiment, tree = run.experiment, build_tree(run.experiment.model, "base")
    support = next(one.support for one in experiment.recording.intervals)
    assert isinstance(support, Support)
    needed = joints_between(tree, link)
    joints, _ = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        needed,
        run.stream,
        run.stream.stamp_ns,
        processing=experiment.processing,
    )
    base_H_sensor, base_H_link = (link_pose(tree, joints, name) for name in ("upper_arm", link))
    return np.linalg.inv(base_H_sensor) @ base_H_link, base_H_sensor[:, :3, :3]


def _planted(
    folder: Path, target: Path, wrench: Callable[[SensorRun], FloatArray], *, end_s: float = END_S
) -> SensorRun:
    """The log with a wrench on the arm, in the axes and about the origin of the sensor; shape (n, 6)."""
    write_experiments(target)
    edit(target / PARQUET, 'tolerance = "exact"\n', "")
    recording, run = read_recording(target / "recording"), _run(folder)
    stream = recording.stream("arm_ft")
    since_s = (stream.stamp_ns - recording.start_ns) * 1e-9
    inside = (since_s >= START_S) & (since_s <= end_s)
    signal = stream.signal("raw")
    counts = signal.values + inside[:, None] * np.linalg.solve(MOUNTED, wrench(run).T).T
    changed = replace(stream, signals={**stream.signals, "raw": replace(signal, values=counts)})
    shutil.rmtree(target / "recording")
    write_recording(target / "recording", replace(recording, streams={**recording.streams, "arm_ft": changed}))
    return _run(target)


def _push(run: SensorRun) -> FloatArray:
    """A force on the forearm along its x axis, which the sensor transmits from child to parent with its sign."""
    sensor_H_link, _ = _relative_poses(run, "forearm")
    force = FORCE_N * sensor_H_link[:, :3, 0]
    place = (sensor_H_link @ np.r_[PLACE_M, 1.0])[:, :3]
    return np.hstack([force, cross(place, force)])


def test_a_push_is_detected_located_and_measured(folder: Path, tmp_path: Path) -> None:
    """Time, size, direction and link are those that were planted; it is one collision."""
    run = _planted(folder, tmp_path, _push)
    (row,) = _found(run).collisions
    assert row.kind == "collision"
    assert START_S - 0.06 < row.start_s < START_S + 0.06
    assert END_S - 0.06 < row.end_s < END_S + 0.3
    # the prior matrix is 5 % off, which the free samples correct
    assert row.force_N == pytest.approx(FORCE_N, rel=0.05)
    sensor_H_link, base_R_sensor = _relative_poses(run, "forearm")
    at = int(np.searchsorted(run.stream.stamp_ns, run.experiment.recording.start_ns + round(1e9 * START_S) + 10**8))
    assert np.dot(row.direction, (base_R_sensor @ sensor_H_link[:, :3, :3])[at][:, 0]) > 0.95  # the arm turns meanwhile
    assert "forearm" in (row.link, *row.other_links)
    assert abs(row.couple_Nm) < max(row.couple_half_width_95_Nm, 0.05)
    assert row.impulse_Ns == pytest.approx(FORCE_N * (END_S - START_S), rel=0.4)


def test_nothing_is_found_where_nothing_touches(folder: Path) -> None:
    """The negative control: the same log without the push, with the force from which one would be noticed."""
    found = _found(_run(folder))
    assert not found.collisions
    (sensor,) = found.sensitivity
    assert 0.1 < sensor.smallest_force_N < FORCE_N
    assert sensor.looked_at_s == pytest.approx(20.5, abs=0.3)  # without a second of each interval for the level
    assert any("do not show the tail" in words for words in found.warnings)


def test_a_push_below_what_is_noticed_is_not(folder: Path, tmp_path: Path) -> None:
    """A tenth of the stated force is not told from noise."""
    smallest = _found(_run(folder)).sensitivity[0].smallest_force_N
    run = _planted(folder, tmp_path, lambda run: 0.1 * smallest / FORCE_N * _push(run))
    assert not _found(run).collisions


def test_a_push_of_what_its_link_shows_is_noticed(folder: Path, tmp_path: Path) -> None:
    """Every link has its force, none above that of any wrench; half as much again is noticed, a third is not."""
    found = _found(_run(folder))
    by_link = {row.link: row.smallest_force_N for row in found.by_link}
    assert len(by_link) > 1
    # the median is over fewer windows
    assert all(0.0 < force <= 1.01 * found.sensitivity[0].smallest_force_N for force in by_link.values())
    for share, count in ((1.5, 1), (0.3, 0)):
        size = share * by_link["forearm"] / FORCE_N
        target = tmp_path / str(count)
        target.mkdir()
        run = _planted(folder, target, lambda run, size=size: size * _push(run))
        assert len(_found(run).collisions) == count


def test_a_contact_in_the_free_interval_hides_no_other(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where enough is left, noise is learnt without the push that `inspect` finds: what is noticed is as without it."""
    run, labels = _planted(folder, tmp_path, _push, end_s=START_S + 1.0), ("judge", "fit")
    correction = run.read_by(None, None).bare
    clean = find_collisions(_run(folder), correction, (), labels, 1.0).sensitivity[0]
    short = find_collisions(run, correction, (), labels, 1.0)
    assert short.sensitivity[0].smallest_force_N > 1.2 * clean.smallest_force_N
    monkeypatch.setattr("forcetorque.collisions.collisions._ENOUGH_FREE_S", 10.0)
    found = find_collisions(run, correction, (), labels, 1.0)
    assert len(found.collisions) == 1
    assert found.sensitivity[0].smallest_force_N == pytest.approx(clean.smallest_force_N, rel=0.05)


def test_a_couple_is_no_force_at_a_point(folder: Path, tmp_path: Path) -> None:
    """A grip that turns: the moment about the line is outside its interval of zero."""

    def screw(run: SensorRun) -> FloatArray:
        wrench = _push(run)
        wrench[:, 3:] += 2.0 * wrench[:, :3] / FORCE_N
        return wrench

    (row,) = _found(_planted(folder, tmp_path, screw)).collisions
    assert row.couple_Nm == pytest.approx(2.0, abs=row.couple_half_width_95_Nm + 0.3)
    assert row.couple_Nm > row.couple_half_width_95_Nm


def test_what_is_learnt_where_something_touches_is_doubted(folder: Path, tmp_path: Path) -> None:
    """A free interval with a contact in it is a warning; too short a one is refused."""
    run = _planted(folder, tmp_path, _push)
    found = find_collisions(run, run.read_by(None, None).bare, (), ("judge", "fit"), 1.0)
    assert found.collisions
    assert any("from which noise is learnt" in words for words in found.warnings)
    with pytest.raises(ExperimentError, match=r"expected at least 10 s in which nothing touches .* got"):
        _found(run, free=("judge",))


def test_a_push_is_an_event_for_viewers(folder: Path, tmp_path: Path) -> None:
    """Time, size and link stand in the findings of the scene and in the log for other viewers; without it, nothing."""
    built = build_scene(_planted(folder, tmp_path, _push).experiment, {})
    (finding,) = (one for one in built.scene.findings if one.kind == "collision")
    assert finding.start_s == pytest.approx(START_S, abs=0.06)
    assert "arm_ft: 1" in finding.message
    assert "forearm" in finding.message
    events = [one for one in viewer_log(built).events if "arm_ft: collision: " in one.text]
    assert [one.is_warning for one in events] == [True]
    assert {one.kind for one in build_scene(_run(folder).experiment, {}).scene.findings} <= {"missing"}


def test_collisions_stand_among_other_findings(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the order of time; a sensor that cannot be looked at and a log that is too long are named, with the reason."""
    experiment = _planted(folder, tmp_path, _push).experiment
    others = tuple(
        Finding(stream="arm_ft", kind="gap", message="a gap", count=1, start_ns=experiment.recording.start_ns + at)
        for at in (10**9, 20 * 10**9)
    )
    assert [one.kind for one in with_collisions(lambda: others, experiment, {})] == ["gap", "collision", "gap"]
    monkeypatch.setattr("forcetorque.collisions.collision_and_sole_events.LONGEST_S", 10.0)
    assert [one.kind for one in with_collisions(lambda: others, experiment, {})] == ["not_compared", "gap", "gap"]
    ignored = experiment.recording.with_intervals([])
    untold, *left = with_collisions(lambda: others, replace(experiment, recording=ignored), {})
    assert (untold.kind, untold.sensor, tuple(left)) == ("not_compared", "arm_ft", others)
    assert untold.message.startswith("no look for collisions: ")
    assert "expected an interval with a support" in untold.message


def test_a_collision_hides_nothing_of_another_sensor_of_its_stream(folder: Path, tmp_path: Path) -> None:
    """What `inspect` found of the other sensor stays; the same of this sensor does not."""
    experiment = _planted(folder, tmp_path, lambda run: 60.0 / FORCE_N * _push(run)).experiment
    own = next(one for one in inspect_experiment(experiment, with_causes=False) if one.kind in UNEXPLAINED)
    assert own.sensor == "arm_ft"
    other = replace(own, sensor="other_ft")
    events = with_collisions(lambda: [own, other], experiment, {})
    assert [(one.kind, one.sensor) for one in events if one is not other] == [("collision", "arm_ft")]
    assert any(one is other for one in events)


@pytest.mark.parametrize(
    ("force_N", "end_s", "kinds"),
    [
        (60.0, END_S, ["collision"]),
        (FORCE_N, START_S + 1.5, ["contact"]),
        (60.0, 30.0, ["step", "new_level"]),
    ],
)
def test_a_push_is_one_event(folder: Path, tmp_path: Path, force_N: float, end_s: float, kinds: list[str]) -> None:
    """A collision stands in place of what `inspect` finds there; others stay."""
    experiment = _planted(folder, tmp_path, lambda run: force_N / FORCE_N * _push(run), end_s=end_s).experiment
    found = [one for one in inspect_experiment(experiment, with_causes=False) if one.kind in UNEXPLAINED]
    assert found
    events = with_collisions(lambda: found, experiment, {})
    assert [one.kind for one in events] == kinds
    assert events[-1].size == pytest.approx(force_N, rel=0.05)
    start_ns = experiment.recording.start_ns
    others = [
        replace(found[0], kind=kind, stream=stream, start_ns=start_ns + first * 10**9, end_ns=start_ns + last * 10**9)
        for kind, stream, first, last in (
            ("contact", "arm_ft", 2, 3), ("off_level", "arm_ft", 0, 40), ("contact", "joints", 17, 18),
            ("outlier", "arm_ft", 17, 17),
        )
    ]  # fmt: skip
    assert {id(one) for one in others} <= {id(one) for one in with_collisions(lambda: others, experiment, {})}


def test_the_command_prints_contacts_first(folder: Path, tmp_path: Path, run: Run) -> None:
    """Verdict, clearest contact, what is noticed; JSON has rows."""
    planted = _planted(folder, tmp_path, _push)
    assert planted.sensor.name == "arm_ft"
    out = run("robot", "collisions", tmp_path / PARQUET).out
    assert "1 CONTACT in 20" in out.splitlines()[0]
    assert "clearest: 16.9" in out
    assert "noticed: any force from" in out
    rows = run("robot", "collisions", tmp_path / PARQUET, "--format", "json").result()
    assert rows["collisions"][0]["kind"] == "collision"


@pytest.mark.parametrize("rate", [0.0, float("inf"), float("nan"), 1e-300])
def test_a_rate_that_no_threshold_can_be_set_for_is_refused(folder: Path, rate: float) -> None:
    """Numbers beyond what a threshold means."""
    run = _run(folder)
    with pytest.raises(ExperimentError, match="alarms per hour: expected a number from"):
        find_collisions(run, run.read_by(None, None).bare, (), (), rate)


def test_a_slow_stream_is_refused(folder: Path, tmp_path: Path) -> None:
    """Windows without a sample would count as time."""
    write_experiments(tmp_path)
    recording = read_recording(tmp_path / "recording")
    stream = recording.stream("arm_ft")
    signals = {name: replace(signal, values=signal.values[::5]) for name, signal in stream.signals.items()}
    slow = replace(stream, stamp_ns=stream.stamp_ns[::5], sequence=None, signals=signals)
    shutil.rmtree(tmp_path / "recording")
    write_recording(tmp_path / "recording", replace(recording, streams={**recording.streams, "arm_ft": slow}))
    with pytest.raises(ExperimentError, match="expected readings at 20 Hz at least, .* got 10 Hz"):
        _found(_run(tmp_path))


def test_an_interval_that_ends_before_there_is_a_level_is_refused(tmp_path: Path) -> None:
    """Below one second nothing is looked at; beside a longer interval it does not count, and a warning names it."""
    write_experiments(tmp_path)
    edit(tmp_path / PARQUET, "end_s = 23.5", "end_s = 15.1")
    run = _run(tmp_path)
    correction = run.read_by(None, None).bare
    with pytest.raises(
        ExperimentError, match="expected an interval with more than 1 s of readings .* got 'judge' of 0.6 s"
    ):
        find_collisions(run, correction, ["judge"], (), 1.0)
    alone, both = (find_collisions(run, correction, labels, (), 1.0) for labels in (["fit"], ()))
    assert both.sensitivity == alone.sensitivity
    said = "arm_ft: not looked at: judge, with at most 1 s of readings in a row, in which the level is found first"
    assert [warning for warning in both.warnings if "not looked at" in warning] == [said]
    assert said not in alone.warnings


def test_an_interval_with_gaps_is_not_called_short(folder: Path) -> None:
    """Where a reading comes every 0.9 s no level is found, however long the interval is: 9 s."""
    run = _run(folder)
    recording, stream = run.experiment.recording, run.stream
    judge = next(one for one in recording.intervals if one.label == "judge")
    kept = ~judge.holds(stream.stamp_ns) | (np.arange(len(stream)) % 45 == 0)
    signals = {name: replace(signal, values=signal.values[kept]) for name, signal in stream.signals.items()}
    thin = replace(stream, stamp_ns=stream.stamp_ns[kept], sequence=None, signals=signals)
    streams = {**recording.streams, "arm_ft": thin}
    found = _found(SensorRun(replace(run.experiment, recording=replace(recording, streams=streams)), "arm_ft"))
    said = "arm_ft: not looked at: judge, with at most 1 s of readings in a row"
    assert any(warning.startswith(said) for warning in found.warnings)
