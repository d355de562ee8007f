# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to its log is said once by every answer that rests on it, and by none that does not."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from types import FunctionType

import pytest

import forcetorque
from forcetorque import evaluation
from forcetorque.calibration.calibrate import calibrate_for_file, calibrate_sensor
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.result import summarise_estimates
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.commands import compare, evaluate, validate
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.recording_notes import added_to, with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.locomotion.commands import coherence
from forcetorque.locomotion.logged_signals import motion_signals
from forcetorque.locomotion.motion_quality import motion
from forcetorque.payload.tare_offset import tare
from forcetorque.results.result import Result, result_classes
from forcetorque.sensor.gains.gains import select_gains
from tests.scenes.experiments import PARQUET, add
from tests.test_architecture import NEEDS

RECORDED = r"\b(Runs|SensorRun|Campaign|Experiment|MotionSignal|FootForces)\b"
"""Arguments that hold recordings."""
CLOCK = '\n[[clock]]\nstream = "arm_ft"\nto = "joints"\ndelay_s = 0.0\n'
ADDED = "arm_ft: stamped 0 ms later than 'joints', as specified"
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
    assert not asked.calibration.warnings


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


def _analyses() -> dict[str, FunctionType]:
    """Public functions of capabilities that take recordings and give a result with a schema."""
    results = {kind.__name__ for kind in result_classes(forcetorque).values()}
    found = {}
    for package in NEEDS:
        module = import_module(f"forcetorque.{package}")
        for name in getattr(module, "__all__", ()):
            function = getattr(module, name)
            if isinstance(function, FunctionType):
                kinds = {argument: str(kind) for argument, kind in function.__annotations__.items()}
                gives = kinds.pop("return", "")
                if gives in results and any(re.search(RECORDED, kind) for kind in kinds.values()):
                    found[f"{package}.{name}"] = function
    return found


def test_no_analysis_of_recordings_forgets_what_was_added() -> None:
    """Every one has the decorator."""
    analyses = _analyses()
    assert [name for name, function in analyses.items() if not hasattr(function, "__wrapped__")] == []
    assert len(analyses) > 15


def test_an_analysis_that_forgets_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: one of them without its decorator."""
    monkeypatch.setattr(evaluation, "validate", evaluation.validate.__wrapped__)  # type: ignore[attr-defined]
    assert not hasattr(_analyses()["evaluation.validate"], "__wrapped__")
