# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to its log is said once by every answer that rests on it, and by none that does not."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from forcetorque.analysis import (
    AcceptanceFile,
    Campaign,
    SensorRun,
    accept,
    calibrate_for_file,
    calibrate_sensor,
    coherence,
    compare,
    corrections_of,
    estimate_experiment,
    evaluate,
    motion,
    motion_signals,
    recording_moments,
    select_gains,
    spheres,
    summarise_estimates,
    tare,
    validate,
)
from forcetorque.analysis.runs.added import added_to, saying_what_was_added
from forcetorque.calibration import Calibration
from forcetorque.experiment import load_experiment
from forcetorque.result import Result
from tests.scenes.experiments import PARQUET, add

CLOCK = '\n[[clock]]\nstream = "arm_ft"\nto = "joints"\ndelay_s = 0.0\n'
ADDED = "arm_ft: stamped 0 ms later than 'joints', as stated"
RECORD = {"code_version": "0", "created": "2026-01-01T00:00:00+00:00"}
LIMITS = AcceptanceFile.model_validate(
    {"schema": "forcetorque/acceptance/1", "name": "test", "evaluate": {"force_error_mean_N": 5.0}}
)


def _estimated(run: SensorRun, calibration: Calibration) -> Result:
    corrections = corrections_of(run.experiment, {"new": calibration})
    return summarise_estimates(run.experiment, corrections, estimate_experiment(run.experiment, corrections))


@dataclass(frozen=True, kw_only=True, eq=False)
class Asked:
    """What is asked."""

    run: SensorRun
    calibration: Calibration
    file: Path
    times: int


QUESTIONS: dict[str, Callable[[SensorRun, Calibration, Path], Result]] = {
    "accept": lambda run, calibration, file: accept(run, LIMITS, ("new", calibration)),
    "calibrate": lambda run, calibration, file: calibrate_for_file(run, file.parent / "new.json", **RECORD),
    "calibrate, thesis": lambda run, calibration, file: calibrate_for_file(
        [run], file.parent / "new.json", regularisation=1.0, **RECORD
    ),
    "coherence": lambda run, calibration, file: coherence(run.experiment, offsets=["none"]),
    "compare": lambda run, calibration, file: compare([file]),
    "estimate": lambda run, calibration, file: _estimated(run, calibration),
    "evaluate": lambda run, calibration, file: evaluate(run, {"new": calibration}),
    "evaluate, a campaign": lambda run, calibration, file: evaluate(Campaign(run), {"new": calibration}),
    "gains": lambda run, calibration, file: select_gains(run),
    "motion": lambda run, calibration, file: motion(motion_signals(file, ["wrist"])),
    "sphere": lambda run, calibration, file: spheres(run, {}),
    "tare": lambda run, calibration, file: tare(run, "judge"),
    "validate": lambda run, calibration, file: validate(run, {"new": calibration}),
}
"""Of every kind of question: of a run, of several, of an experiment, of a file, and one that asks others."""


@pytest.fixture(scope="module", params=[False, True], ids=["as logged", "with a clock"])
def asked(request: pytest.FixtureRequest, intact: Path, tmp_path_factory: pytest.TempPathFactory) -> Asked:
    """A sensor with its calibration, of a file that adds nothing or a clock."""
    folder = Path(shutil.copytree(intact, tmp_path_factory.mktemp("added") / "arm"))
    file = add(folder / PARQUET, CLOCK) if request.param else folder / PARQUET
    run = SensorRun(load_experiment(file), "arm_ft")
    return Asked(run=run, calibration=calibrate_sensor(run, **RECORD), file=file, times=int(request.param))


@pytest.mark.parametrize("question", QUESTIONS)
def test_every_answer_says_what_was_added_once(asked: Asked, question: str) -> None:
    """As a warning; of a file that adds nothing there is none."""
    answer = QUESTIONS[question](asked.run, asked.calibration, asked.file)
    assert len([warning for warning in answer.warnings if ADDED in warning]) == asked.times


def test_a_calibration_keeps_what_was_added(asked: Asked) -> None:
    """Its file goes to other recordings, where nobody knows of that any more; so do stored moments."""
    for added in (asked.calibration.provenance.added, *(one.added for one in recording_moments(asked.run))):
        assert added == added_to(asked.run.experiment.recording)
        assert len(added) == asked.times
    assert not asked.calibration.doubts


class _Answer(Result):
    """An answer that may warn of something itself."""


def _question(experiments: object, told: tuple[str, ...] = ()) -> _Answer:
    return _Answer(warnings=told)


def test_of_several_recordings_each_is_named(asked: Asked) -> None:
    """One alone is not, and what a question says itself is not said again."""
    question, first = saying_what_was_added(_question), asked.run.experiment
    other = replace(first, name="other", recording=replace(first.recording))
    words = added_to(first.recording)
    assert question([asked.run]).warnings == question(first).warnings == words
    assert question({"a": first, "b": other}).warnings == tuple(
        f"{name}: {sentence}" for name in ("small arm", "other") for sentence in words
    )
    told = tuple(f"small arm: {sentence}" for sentence in words)
    assert question(first, told).warnings == told


def test_what_is_no_result_is_left_alone() -> None:
    """Numbers, classes and constants pass as they are."""
    assert saying_what_was_added(Result) is Result
    assert saying_what_was_added(len) is len
    assert saying_what_was_added(_number)(1.0) == 2.0


def _number(value: float) -> float:
    return 2.0 * value
