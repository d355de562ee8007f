# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to its log is said once by every answer that rests on it, and by none that does not."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from types import FunctionType

import pytest

from forcetorque import analysis
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
from forcetorque.analysis.runs.added import added_to, with_recording_notes
from forcetorque.calibration import Calibration
from forcetorque.experiment import load_experiment
from forcetorque.result import Result, result_classes
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
    question, first = with_recording_notes(_question), asked.run.experiment
    other = replace(first, name="other", recording=replace(first.recording))
    words = added_to(first.recording)
    assert question([asked.run]).warnings == question(first).warnings == words
    assert question({"a": first, "b": other}).warnings == tuple(
        f"{name}: {sentence}" for name in ("small arm", "other") for sentence in words
    )
    told = tuple(f"small arm: {sentence}" for sentence in words)
    assert question(first, told).warnings == told


def _forgetful(name: str) -> bool:
    """Whether an analysis of recordings gives a result without the warnings of what was added to them."""
    function = getattr(analysis, name)
    if not isinstance(function, FunctionType):
        return False
    results = {kind.__name__ for kind in result_classes(analysis).values()}
    takes = " ".join(str(kind) for argument, kind in function.__annotations__.items() if argument != "return")
    recorded = re.search(r"\b(Runs|SensorRun|Campaign|Experiment|MotionSignal|FootForces)\b", takes)
    gives = str(function.__annotations__.get("return"))
    return bool(recorded) and gives in results and not hasattr(function, "__wrapped__")


def test_no_analysis_of_recordings_forgets_what_was_added() -> None:
    """Every one that offers a result of the command line; a negative control is one without the decorator."""
    assert [name for name in analysis.__all__ if _forgetful(name)] == []
    wrapped = [name for name in analysis.__all__ if hasattr(getattr(analysis, name), "__wrapped__")]
    assert len(wrapped) > 20


def test_an_analysis_that_forgets_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: one of them without its decorator."""
    monkeypatch.setattr(analysis, "validate", analysis.validate.__wrapped__)  # type: ignore[attr-defined]
    assert _forgetful("validate")
