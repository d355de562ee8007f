# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment: what questions share is computed once, and is the same as if it were computed anew."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate, validate
from forcetorque.experiment import sensor_samples as samples_module
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.report.sensor_assessment import assess
from tests.scenes.experiments import PARQUET


@pytest.fixture
def run(arm: Path) -> SensorRun:
    """The arm's sensor."""
    return SensorRun(load_experiment(arm / PARQUET), "arm_ft")


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    """Counts the costly computations."""
    counts = {"samples": 0, "motion": 0}

    def counted(name: str, compute: Callable[..., Any]) -> Callable[..., Any]:
        def call(*given: Any, **options: Any) -> Any:
            counts[name] += 1
            return compute(*given, **options)

        return call

    monkeypatch.setattr(samples_module, "sensor_samples", counted("samples", samples_module.sensor_samples))
    monkeypatch.setattr(SensorRun, "motion_at", counted("motion", SensorRun.motion_at))
    return counts


def _fitted(run: SensorRun, regularisation: float) -> Calibration:
    return calibrate_sensor(run, code_version="1", created="2020-01-01T00:00:00+00:00", regularisation=regularisation)


@pytest.mark.long
def test_all_questions_about_a_sensor_compute_samples_and_motion_once(run: SensorRun, calls: dict[str, int]) -> None:
    """One interval to fit and one to judge, however many candidates; a run of its own for each would not do so."""
    calibrations = {f"{k}.json": _fitted(run, 10.0**k) for k in range(4)}
    assert calls == {"samples": 1, "motion": 0}
    assessment = assess(run, calibrations)
    assert len(assessment.evaluation) == 10
    assert calls == {"samples": 2, "motion": 1}
    assess(SensorRun(run.experiment, "arm_ft"), calibrations)  # negative control
    assert calls["samples"] > 2


def test_much_work_in_all_intervals_together_is_compiled(run: SensorRun, monkeypatch: pytest.MonkeyPatch) -> None:
    """However little there is in each: two intervals are more than either."""
    readable, module = len(run.samples(Use.VALIDATION)[0].samples), sys.modules["forcetorque.robot.mechanics.estimate"]
    stamps = run.stream.stamp_ns
    counts = [
        np.count_nonzero((one.start_ns <= stamps) & (stamps <= one.end_ns))
        for one in run.experiment.recording.intervals
        if one.support is not None
    ]
    assert max(counts) < sum(counts)
    monkeypatch.setattr(module, "_FEW", sum(counts))
    monkeypatch.setattr(module, "_is_compiled", lambda: True)
    monkeypatch.setattr(module, "_run_readable", None)
    (compiled,) = SensorRun(run.experiment, "arm_ft").samples(Use.VALIDATION)
    assert len(compiled.samples) == readable
    monkeypatch.setattr(module, "_FEW", sum(counts) + 1)  # negative control
    with pytest.raises(TypeError):
        SensorRun(run.experiment, "arm_ft").samples(Use.VALIDATION)


@pytest.mark.long
def test_answers_do_not_depend_on_what_was_asked_before(run: SensorRun) -> None:
    """To the last digit: evaluation and validation by a run that has answered everything else."""
    calibrations = {"new.json": _fitted(run, 5.0)}
    assess(run, calibrations)
    fresh = SensorRun(run.experiment, "arm_ft")
    assert evaluate(run, calibrations).json_text() == evaluate(fresh, calibrations).json_text()
    assert validate(run, calibrations).json_text() == validate(fresh, calibrations).json_text()


def test_another_calibration_of_the_same_name_is_another_one(run: SensorRun) -> None:
    """What is known is known of the calibration, not of its name."""
    first, second = (evaluate(run, {"new.json": _fitted(run, value)}) for value in (1.0, 1e9))
    assert first.verdicts[0].rmse.tolist() == second.verdicts[0].rmse.tolist()
    assert first.verdicts[2].rmse.tolist() != second.verdicts[2].rmse.tolist()


def test_a_sensor_is_found_by_name_or_given(run: SensorRun) -> None:
    """Both are the same; a wrong name lists the known ones; it says in short what it is."""
    given = SensorRun(run.experiment, run.experiment.sensors[0])
    (first,), (second,) = given.samples(Use.VALIDATION), run.samples(Use.VALIDATION)
    np.testing.assert_array_equal(first.raw, second.raw)
    with pytest.raises(ExperimentError, match="has no sensor 'leg_ft'.*arm_ft"):
        SensorRun(run.experiment, "leg_ft")
    assert repr(run) == "SensorRun('small arm', 'arm_ft', serial='SIM001')"


def test_an_answer_shows_itself(run: SensorRun) -> None:
    """In a narrow terminal, in a notebook, in one line of a shell."""
    evaluation = evaluate(run, {"new.json": _fitted(run, 5.0)})
    assert max(map(len, evaluation.text(60).splitlines())) <= 60
    rmse = f"{evaluation.verdicts[2].rmse[0]:.3f}"
    assert rmse in evaluation.text(60)
    assert f">{rmse}<" in evaluation._repr_html_()
    assert len(repr(evaluation.model_copy(update={"warnings": ()}))) < 200  # these are whole sentences
    assert len(repr(evaluation.verdicts[0])) < 800


def test_a_segment_counts_as_its_recording(run: SensorRun, monkeypatch: pytest.MonkeyPatch) -> None:
    """A long recording is compiled for however short its segments are."""
    chosen = []
    monkeypatch.setattr(
        sys.modules["forcetorque.experiment.sensor_samples"],
        "evaluator_of_samples",
        lambda samples, **_: chosen.append(samples),
    )
    start_ns, end_ns = run.experiment.recording.span_ns
    longer = replace(run.experiment.recording, of_span_ns=(start_ns, start_ns + 10 * (end_ns - start_ns)))
    for recording in (run.experiment.recording, longer):
        SensorRun(replace(run.experiment, recording=recording), "arm_ft").samples(Use.VALIDATION)
    assert chosen[1] == pytest.approx(10 * chosen[0], rel=0.05)
