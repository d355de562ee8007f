# SPDX-License-Identifier: BSD-3-Clause
"""An error that was measured while the load stood still says so: a sensor that is turned would pass."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.evaluation import Evaluation
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.excitation import HARDLY
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.report.sensor_assessment import assess
from tests.scenes.experiments import MOUNTED, OFFSET, PARQUET, add

NAME = "turned.json"
NOISE_COUNTS = 4.0
SWAY_RAD = 2e-3
"""By how much the joints of the arm at rest move."""


def _with(recording: Recording, stream: str, signal: str, values: FloatArray) -> Recording:
    source = recording.stream(stream)
    signals = {**source.signals, signal: replace(source.signal(signal), values=values)}
    return replace(recording, streams={**recording.streams, stream: replace(source, signals=signals)})


def _run(folder: Path) -> SensorRun:
    return SensorRun(load_experiment(folder / PARQUET), "arm_ft")


def _halt(folder: Path) -> None:
    """Hold the arm, but for a slight sway, in the half that is judged; the sensor reads what it then bears."""
    recording = read_recording(folder / "recording")
    joints = recording.stream("joints")
    seconds = (joints.stamp_ns - recording.start_ns) * 1e-9
    position = np.array(joints.signal("position").values)
    late = seconds >= 14.2
    position[late] = position[late][0] + SWAY_RAD * np.sin(0.6 * (seconds[late] - 14.2))[:, None]
    recording = _with(recording, "joints", "position", position)
    write_recording(folder / "recording", recording)
    (part,) = _run(folder).samples(Use.VALIDATION)
    raw = np.array(recording.stream("arm_ft").signal("raw").values)
    rows = np.isin(recording.stream("arm_ft").stamp_ns, part.samples.stamp_ns)
    bare = np.linalg.solve(MOUNTED, (part.samples.reference - OFFSET).T).T
    raw[rows] = bare + NOISE_COUNTS * np.random.default_rng(3).normal(size=bare.shape)
    write_recording(folder / "recording", _with(recording, "arm_ft", "raw", raw))


def _turned(run: SensorRun) -> Calibration:
    """The true matrix of the sensor as if mounted 90 degrees about its axis from how it is; its offset hides that."""
    calibration = calibrate_sensor(run, code_version="1", created="now")
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    matrix = np.kron(np.eye(2), quarter) @ MOUNTED
    (part,) = run.samples(Use.VALIDATION)
    offset = (part.samples.reference - part.raw @ matrix.T).mean(axis=0)
    sessions = tuple(one.model_copy(update={"offset": offset}) for one in calibration.sessions)
    return calibration.model_copy(update={"matrix": matrix, "offset": offset, "sessions": sessions})


def _rows(evaluation: Evaluation) -> list[tuple[float, bool]]:
    return [(row.force_error_mean_N, row.hardly_moved) for row in evaluation.verdicts if row.calibration == NAME]


@pytest.mark.long
def test_a_sensor_that_is_turned_and_judged_at_rest_is_said_to_be_judged_by_nothing(arm: Path) -> None:
    """Turned by 90 degrees it errs by some tenths of a newton at rest; negative control: in motion by tens."""
    moving = _run(arm)
    for error, hardly in _rows(evaluate(moving, {NAME: _turned(moving)})):
        assert error > 10.0
        assert not hardly
    moved = evaluate(moving, {NAME: _turned(moving)})
    assert not [words for words in moved.warnings if "hardly moved" in words]
    assert [use.decision for use in moved.load_cases] == ["do not use"]
    _halt(arm)
    still = _run(arm)
    evaluation = evaluate(still, {NAME: _turned(still)})
    for error, hardly in _rows(evaluation):
        assert error < 0.5
        assert hardly
    (words,) = [words for words in evaluation.warnings if "hardly moved" in words]
    row = evaluation.verdicts[-1]
    assert [use.decision for use in evaluation.load_cases] != ["use"]
    assert words == (
        f"arm_ft: the loads hardly moved in the validation samples ({row.excitation_N:.2g} N of {row.load_N:.2g} N, "
        f"{row.excitation_Nm:.2g} N m of {row.load_Nm:.2g} N m): a wrong matrix would show nothing"
    )
    assert sum("hardly moved" in line.text for line in assess(still, {NAME: _turned(still)}).verdict) == 1


@pytest.mark.long
def test_the_excitation_is_that_of_the_reference(arm: Path) -> None:
    """Of all three components together, alike for all candidates; the load is the larger of judged and fitted."""
    run = _run(arm)
    calibration = calibrate_sensor(run, code_version="1", created="now")
    (part,) = run.samples(Use.VALIDATION)
    reference = part.samples.reference
    rows = evaluate(run, {NAME: calibration}).verdicts
    assert len(rows) == 4
    for row in rows:
        assert row.excitation_N == pytest.approx(np.sqrt(reference[:, :3].var(axis=0).sum()))
        assert row.excitation_Nm == pytest.approx(np.sqrt(reference[:, 3:].var(axis=0).sum()))
        fitted = np.linalg.norm(calibration.validity.expected_wrench_sd[:3])
        assert row.load_N == pytest.approx(max(fitted, np.sqrt((reference[:, :3] ** 2).sum(axis=1).mean())))
    row = rows[0]
    forces = row.model_copy(update={"excitation_N": 0.9 * HARDLY * row.load_N})
    assert forces.hardly_moved
    assert "the forces hardly moved" in (forces.hardly_moved_words or "")
    assert "a matrix that is wrong for forces would show nothing" in (forces.hardly_moved_words or "")
    assert not row.model_copy(update={"excitation_N": 1.1 * HARDLY * row.load_N}).hardly_moved


def test_tables_tell_the_constant_part_from_the_rest(arm: Path) -> None:
    """Mean errors by the own offset in a table of their own, within 120 columns; whether anything was smoothed."""
    run = _run(arm)
    evaluation = evaluate(run, {NAME: calibrate_sensor(run, code_version="1", created="now")})
    errors, means, words, *_ = evaluation.blocks()
    assert not isinstance(errors, str)
    assert not isinstance(means, str)
    assert "mean error" in means.caption
    assert [row[0] for row in means.rows] == ["prior", NAME]
    fitted = [row for row in evaluation.verdicts if row.offset == "fitted"]
    assert [row[1] for row in means.rows] == [f"{row.bias[0]:.3f}" for row in fitted]
    assert means.headings[-3:] == ("independent", "moved, N", "moved, N m")
    assert max(map(len, evaluation.text(120).splitlines())) <= 120
    assert str(words).endswith("not smoothed")
    add(arm / PARQUET, "\n[processing]\nsmoothing = { window_s = 0.3, order = 2 }\n")
    smoothed = _run(arm)
    *_, words = evaluate(smoothed, {}).blocks()
    assert str(words).endswith("reading and reference smoothed over 0.3 s")
