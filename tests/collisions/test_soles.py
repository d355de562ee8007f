# SPDX-License-Identifier: BSD-3-Clause
"""Contacts that are expected, on soles: what these cannot bear is an event of the sensor above them."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.collisions.collision_and_sole_events import events_on_soles, with_collisions
from forcetorque.collisions.collisions import find_collisions
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.locomotion.section import SOLES as SECTION
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole
from forcetorque.locomotion.standing.sole_limits import EventKind
from forcetorque.recording.recording import Interval, Use
from forcetorque.recording.storage import read_recording, write_recording
from tests.app.outcome import Run
from tests.locomotion.standing_robot import DAY, Standing, switching

FOOT, LASTS_S = "r_foot_ft", 0.4
OUTLINE_M = np.array([[-0.2, -0.15], [0.2, -0.15], [0.2, 0.15], [-0.2, 0.15]])


@pytest.fixture(scope="module")
def standing(tmp_path_factory: pytest.TempPathFactory) -> Standing:
    """The biped that hangs, stands on both feet and on one; its robot is exactly known.

    It stands as if it were bolted to the ground, so that its soles are made as large as its points go.
    """
    standing = switching(tmp_path_factory.mktemp("standing") / "out")
    soles = tuple(
        replace(one, sole=Sole(frame=one.sole.frame, outline=OUTLINE_M)) for one in standing.experiment.section(SECTION)
    )
    return replace(standing, experiment=replace(standing.experiment, sections={SECTION.key: soles}))


def _on_right(experiment: Experiment) -> Interval:
    """The first interval in which the right foot alone bears the robot."""
    return next(
        one for one in experiment.recording.intervals if one.support is not None and one.support.frame == "r_sole"
    )


def _with(standing: Standing, wrench: FloatArray) -> SensorRun:
    """The log with a wrench on the sensor of the right foot for some time, in its frame and direction; shape (6,)."""
    experiment = standing.experiment
    recording, sensor = experiment.recording, next(one for one in experiment.sensors if one.name == FOOT)
    stream, interval = recording.stream(sensor.stream), _on_right(experiment)
    first_ns = (interval.start_ns + interval.end_ns) // 2
    inside = (stream.stamp_ns >= first_ns) & (stream.stamp_ns < first_ns + round(1e9 * LASTS_S))
    assert inside.sum() > 5
    signal, counts = stream.signal("raw"), np.linalg.solve(standing.corrections[FOOT].model.matrix, wrench)
    values = signal.values + inside[:, None] * counts
    changed = replace(stream, signals={**stream.signals, "raw": replace(signal, values=values)})
    streams = {**recording.streams, sensor.stream: changed}
    return SensorRun(replace(experiment, recording=replace(recording, streams=streams)), FOOT)


@pytest.mark.parametrize(
    ("wrench", "kinds"),
    [
        ((0.0, 0.0, 0.0, 0.0, 0.0, 0.0), []),
        ((0.0, 0.0, 0.0, 0.0, 10.0, 0.0), []),  # 31 mm
        ((0.0, 0.0, 0.0, 0.0, 100.0, 0.0), ["outside"]),  # 314 mm
    ],
)
def test_a_moment_that_a_sole_cannot_bear_is_an_event(
    standing: Standing, wrench: tuple[float, ...], kinds: list[str]
) -> None:
    """A point outside the outline, at its time; inside it, and without any, there is none."""
    run = _with(standing, np.array(wrench))
    events, untested = events_on_soles(run, None, ())
    assert untested == ()
    assert [(event.kind, event.sole) for event in events] == [(kind, "r_sole") for kind in kinds]
    for event in events:
        assert event.sensors == (FOOT,)
        assert event.end_s - event.start_s == pytest.approx(LASTS_S, abs=0.1)
        assert event.beyond_mm is not None
        assert event.beyond_mm > 50.0


@pytest.mark.parametrize(("moment_Nm", "kinds"), [(0.0, []), (100.0, ["outside"])])
def test_viewer_and_report_show_it_among_their_findings(standing: Standing, moment_Nm: float, kinds: list[str]) -> None:
    """At its time, of its sensor; without a moment there is none."""
    run = _with(standing, np.array([0.0, 0.0, 0.0, 0.0, moment_Nm, 0.0]))
    experiment = replace(run.experiment, sensors=(run.sensor,))
    found = [one for one in with_collisions(tuple, experiment, {}) if one.kind in get_args(EventKind)]
    assert [(one.kind, one.sensor) for one in found] == [(kind, FOOT) for kind in kinds]
    interval = _on_right(experiment)
    for one in found:
        assert "pressed outside its outline" in one.message
        assert one.start_ns is not None
        middle_ns = (interval.start_ns + interval.end_ns) // 2
        assert abs(one.start_ns - middle_ns) < 100_000_000


def test_of_a_long_log_the_soles_that_were_not_tested_are_named(
    standing: Standing, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the sensor next to them; a sensor without one says nothing of soles."""
    monkeypatch.setattr("forcetorque.collisions.collision_and_sole_events.LONGEST_S", 0.0)
    found = {one.stream: one.message for one in with_collisions(tuple, standing.experiment, {})}
    streams = {one.name: one.stream for one in standing.experiment.sensors}
    assert "; no test of what presses on r_sole; see `robot balance`" in found[streams[FOOT]]
    assert "no look for collisions" in found[streams["r_leg_ft"]]
    assert "presses" not in found[streams["r_leg_ft"]]


def test_a_sole_belongs_to_the_sensor_next_to_it(standing: Standing) -> None:
    """A hip has another sensor between itself and the sole; without an outline or a friction nothing is tested."""
    assert events_on_soles(SensorRun(standing.experiment, "r_leg_ft"), None, ()) == ((), ())
    bare = tuple(replace(one, sole=replace(one.sole, outline=None)) for one in standing.experiment.section(SECTION))
    experiment = replace(standing.experiment, sections={SECTION.key: bare})
    assert events_on_soles(SensorRun(experiment, FOOT), None, ()) == ((), ())


def test_a_sole_that_cannot_be_tested_is_named(standing: Standing) -> None:
    """Where no interval gives the offset, the reason is stated."""
    validated = replace(_on_right(standing.experiment), use=Use.VALIDATION)
    recording = standing.experiment.recording.with_intervals([validated])
    run = SensorRun(replace(standing.experiment, recording=recording), FOOT)
    events, (reason,) = events_on_soles(run, None, ())
    assert events == ()
    assert reason.startswith("r_foot_ft: no test of what presses on r_sole: ")


def test_an_event_stands_under_its_sensor(standing: Standing, tmp_path: Path, run: Run) -> None:
    """Of two sensors only the one above the sole has the event."""
    shutil.copytree(standing.experiment.file.parent, tmp_path / "out")
    file = tmp_path / "out" / f"{DAY}.toml"
    text = file.read_text(encoding="utf-8")
    assert '[[sole]]\nframe = "r_sole"\n' in text
    corners = f"outline_m = {OUTLINE_M.tolist()}\n"
    file.write_text(text.replace('[[sole]]\nframe = "r_sole"\n', f'[[sole]]\nframe = "r_sole"\n{corners}'))
    changed = _with(standing, np.array([0.0, 0.0, 0.0, 0.0, 100.0, 0.0]))
    logged = read_recording(file.with_suffix(""))
    name = changed.sensor.stream
    stream, values = logged.stream(name), changed.stream.signal("raw").values
    signals = {**stream.signals, "raw": replace(stream.signal("raw"), values=values)}
    shutil.rmtree(file.with_suffix(""))
    streams = {**logged.streams, name: replace(stream, signals=signals)}
    write_recording(file.with_suffix(""), replace(logged, streams=streams))
    out = run("robot", "collisions", file, "--sensor", "l_foot_ft", "--sensor", FOOT).out
    right, left = out.split("l_foot_ft, ")
    assert right.startswith(f"{FOOT}, ")
    assert "pressed outside its outline, which the ground cannot do: r_sole" in right
    assert "pressed outside" not in left


def test_what_is_noticed_counts_the_load_of_each_support(standing: Standing) -> None:
    """A foot hangs while errors are learnt, and bears the robot later: what is noticed anywhere is on every link."""
    run = SensorRun(standing.experiment, FOOT)
    supports = [one for one in standing.experiment.recording.intervals if one.support is not None]
    hanging = [one.label for one in supports if one.support is not None and one.support.frame != "r_sole"]
    found, alone = (
        find_collisions(run, run.read_by(None, None).bare, labels, hanging, 1.0) for labels in ((), hanging)
    )
    forces = {row.link: row.smallest_force_N for row in found.by_link}
    assert found.collisions == ()
    assert {"r_foot", "pelvis", "l_foot"} <= set(forces)
    assert max(forces.values()) <= found.sensitivity[0].smallest_force_N
    assert [row.link for row in alone.by_link] == ["r_foot"]
    assert found.sensitivity[0].smallest_force_N > 10.0 * alone.sensitivity[0].smallest_force_N
