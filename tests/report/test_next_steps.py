# SPDX-License-Identifier: BSD-3-Clause
"""What to do next: what the verdict asks for, once, in order, and nothing that nothing speaks for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np

from forcetorque.evaluation.load_cases.verdict import KEEP_PRIOR, LoadCaseVerdict, Reason
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.report.pooled_verdicts import Undecided, grouped_by_text, next_steps, texts_with_names
from tests.report.drawing import use_of
from tests.scenes.calibrations import make_calibration

KEY = ("leg_ft", "SN1")
MOVE = Reason(against="data", text="the load hardly moved; evaluate it on data that move")


def _steps(*uses: LoadCaseVerdict, undecided: tuple[Undecided, ...] = (), stands: bool = True) -> tuple[str, ...]:
    names = dict.fromkeys(row.calibration for row in (*uses, *undecided) if row.calibration is not None)
    calibrations = {name: make_calibration() for name in names}
    contents = {"plan": None, "load_case": (SimpleNamespace(name="push"),)}
    experiment = SimpleNamespace(stands=stands, section=lambda section: contents[section.key])
    run = cast("SensorRun", SimpleNamespace(experiment=experiment))
    return next_steps(KEY, uses, undecided, calibrations, {"walk.toml": run}).steps


def test_a_calibration_that_may_be_used_is_put_on_the_robot() -> None:
    """One step, with the command and with what its offset asks for; none says to record."""
    (step,) = _steps(use_of())
    assert step.startswith("Put leg.json on the robot for “push”: `forcetorque export`")
    assert "until the sensor is switched off" in step
    (tared,) = _steps(use_of(offset="tared"))
    assert "Tare the sensor" in tared


def test_one_that_may_not_be_used_leads_to_a_plan() -> None:
    """First what not to do and whether the prior is any better, then the remedy, then the command."""
    remedy = Reason(against="use", text="it errs by 40 N", remedy="Record more.")
    worse, no_better, better = (
        _steps(use_of(force=40.0, before=before, reasons=(remedy,))) for before in (80.0, 30.0, 2.0)
    )
    assert "predicted to err even more, so do not go back to it" in worse[0]
    assert "predicted to err too much as well" in no_better[0]
    assert "(the prior) may be used there" in better[0]
    assert worse[1] == "Record more."
    assert "`forcetorque plan walk.toml -c leg.json --clearance-deg 10` lists what to record next" in worse[2]


def test_a_measured_error_rules_over_a_predicted_one() -> None:
    """A prior that was measured to err less is not said to be predicted worse, however little the difference."""
    (today, *_) = _steps(use_of(force=40.0, before=80.0, larger_than_prior=("force",)))
    assert today.endswith("On data that were not fitted the matrix that it came from (the prior) errs less in force.")
    # where that forbids the use, the remedy says it
    reason = Reason(against="use", text="its force error is larger", remedy=KEEP_PRIOR)
    today, remedy, *_ = _steps(use_of(force=40.0, before=80.0, larger_than_prior=("force",), reasons=(reason,)))
    assert today == "Do not rely on leg.json for “push” yet."
    assert remedy == KEEP_PRIOR


def test_no_plan_where_none_can_be_had() -> None:
    """Of a wrist that nobody moves by a robot model, and of a use that only the acceptance file states."""
    assert any("forcetorque plan" in step for step in _steps(use_of(force=40.0)))
    assert not any("forcetorque plan" in step for step in _steps(use_of(force=40.0), stands=False))
    assert not any("forcetorque plan" in step for step in _steps(use_of(force=40.0, load_case="of the file")))


def test_a_prior_of_small_predicted_errors_is_to_be_judged_first() -> None:
    """A prediction alone does not make it fit for use."""
    (today, *_) = _steps(use_of(force=40.0, before=2.0))
    assert "if the errors that it shows on validation intervals confirm it" in today


def test_no_plan_where_the_prediction_is_not_what_speaks_against_it() -> None:
    """Data that did not move need other data to be judged on, not a smaller predicted error."""
    steps = _steps(use_of(decision="not enough data", reasons=(MOVE,)))
    assert "The load hardly moved; evaluate it on data that move." in steps
    assert not any("forcetorque plan" in step or "prior" in step for step in steps)


def test_the_same_step_for_several_is_said_once() -> None:
    """With the names where it is not about all; uses and calibrations of which the same holds come together."""
    doubtful = {"decision": "not enough data", "reasons": (MOVE,)}
    steps = _steps(*(use_of(name, case, **doubtful) for name in ("a.json", "b.json") for case in ("push", "tool")))
    assert sum("evaluate it on data that move" in step for step in steps) == 1
    assert "The load hardly moved; evaluate it on data that move." in steps
    assert steps[0].startswith("Do not rely on a.json and b.json for “push” and “tool” yet.")
    only_one = _steps(use_of("a.json"), use_of("b.json", **doubtful))
    assert only_one[0].startswith("Put a.json on the robot")
    assert only_one[1].startswith("Do not rely on b.json")


def test_a_use_that_nobody_stated_is_to_be_stated() -> None:
    """And one that somebody stated is not."""
    (_, step) = _steps(use_of(specified=False))
    assert step.startswith("Check that this is your use. The experiment file specifies none")
    assert "[[load_case]]" in step
    assert len(_steps(use_of(specified=True))) == 1


def test_where_there_is_no_verdict_the_reason_is_what_to_mend() -> None:
    """Of a calibration; of a sensor without any the command that makes one."""
    seen = Undecided(sensor="leg_ft", serial="SN1", calibration="leg.json", reason="it was fitted on 'moving'")
    assert _steps(undecided=(seen,)) == (
        "Remove what prevents a verdict on leg.json, as listed above, and write this report again.",
    )
    none = Undecided(sensor="leg_ft", serial="SN1", calibration=None, reason="no calibration was given")
    (step,) = _steps(undecided=(none,))
    assert "`forcetorque calibrate walk.toml --sensor leg_ft -o leg_ft.json`" in step


def test_sentences_of_several_come_once_in_their_order() -> None:
    """Behind the names of some, by themselves for all."""
    assert texts_with_names([("a", "x"), ("b", "y"), ("b", "x"), ("a", "x")], "ab") == ["x", "b: y"]
    assert texts_with_names([("a", "x")], "a") == ["x"]
    assert texts_with_names([("a", "x")], "ab") == ["a: x"], "the other is good"
    assert grouped_by_text([("a", 1), ("b", 1), ("a", 2)]) == [(("a", "b"), 1), (("a",), 2)]
    assert np.size(grouped_by_text([])) == 0
