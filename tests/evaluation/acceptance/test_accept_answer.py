# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `accept`: the verdict, and the criterion that is farthest from its limit."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.evaluation.acceptance.acceptance import Acceptance
from forcetorque.evaluation.acceptance.criteria import Bound, Criterion
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, Reason
from forcetorque.results.answer import AGAIN, EXPERIMENT, FIRST_EXPERIMENT, Concern, answer_text


@pytest.fixture(autouse=True)
def _files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files of the calibrations, in the working folder."""
    monkeypatch.chdir(tmp_path)
    for file in (Path("leg.json"), Path("old/leg.json"), Path("old/leg")):
        file.parent.mkdir(exist_ok=True)
        file.touch()


def _criterion(name: str, measured: float, limit: float, bound: Bound = Bound.AT_MOST, **given: str) -> Criterion:
    return Criterion(
        sensor=given.get("sensor", "leg"),
        serial="SN1",
        calibration=given.get("calibration", "old/leg.json"),
        criterion=name,
        measured=measured,
        bound=bound,
        limit=limit,
        unit=given.get("unit", "N"),
        count=10,
        note=given.get("note", ""),
    )


def _accepted(*criteria: Criterion, load_cases: tuple[LoadCaseVerdict, ...] = ()) -> Acceptance:
    return Acceptance(experiment="walk", specification="feet", criteria=criteria, measured=(), load_cases=load_cases)


GOOD = _criterion("evaluate.force_error_mean_N", 0.9, 1.0)
DIRECTIONS = _criterion("excitation.directions", 3.0, 6.0, Bound.AT_LEAST, unit="")


def test_an_accepted_sensor_is_exported() -> None:
    """The reason is the criterion that is nearest to its limit."""
    (answer,) = _accepted(_criterion("matrix.condition", 2.0, 9.0, unit=""), GOOD).answers()
    assert (answer.subject, answer.verdict) == ("leg (SN1), leg.json, by 'feet'", "ACCEPTED")
    assert answer.why == (
        "2 of 2 criteria hold; nearest to its limit: evaluate.force_error_mean_N 0.9 N, at most 1 N allowed",
    )
    assert answer.command == "export old/leg.json --to csv -o leg.csv"
    assert answer.concern is Concern.NONE


def test_a_sensor_without_enough_data_is_undecided() -> None:
    """Every limit holds, the verdict of `evaluate` is the reason, and the next step is to record."""
    use = LoadCaseVerdict(
        sensor="leg",
        serial="SN1",
        calibration="old/leg.json",
        load_case="push",
        loads="pushes of 50 N",
        offset="fitted",
        specified=False,
        decision="not enough data",
        message="not enough data for pushes of 50 N: it errs by 9 N",
        reasons=(),
        within=None,
        errors=(),
    )
    (answer,) = _accepted(GOOD, load_cases=(use,)).answers()
    assert (answer.verdict, answer.concern) == ("UNDECIDED", Concern.UNCERTAIN)
    assert answer.why[1:] == (use.message,)
    assert answer.command == f"plan {EXPERIMENT} -c old/leg.json --clearance-deg 10"

    tare = Reason(against="data", text="the offset", remedy='tare it and state offset = "tared" in [[load_case]]')
    tared = _accepted(GOOD, load_cases=(use.model_copy(update={"reasons": (tare,)}),))
    (answer,) = tared.answers()
    assert (answer.step, answer.command) == (tare.remedy, AGAIN)
    assert answer_text((answer,), 80).splitlines()[-1].startswith("next: tare it")  # from Python nothing was typed


def test_no_command_names_a_calibration_that_is_in_no_file() -> None:
    """From Python a calibration may have any name, which no command finds: the step is to save it first."""
    for name in ("mine", "nowhere.json", "a" * 300):
        (answer,) = _accepted(_criterion("evaluate.force_error_mean_N", 0.9, 1.0, calibration=name)).answers()
        assert (answer.step, answer.command) == ("save the calibration, and export its matrix to the robot", "")
    (answer,) = _accepted(_criterion("evaluate.force_error_mean_N", 0.9, 1.0, calibration="old/leg")).answers()
    assert answer.command == "export old/leg --to csv -o leg.csv"  # whatever its ending
    for name in ("excitation.condition", "evaluate.rmse.fz"):
        (answer,) = _accepted(_criterion(name, 6.0, 5.0, calibration="mine")).answers()
        assert answer.step
        assert answer.command == ""


def test_the_worst_criterion_is_the_reason_of_a_rejection() -> None:
    """In multiples of the limit, on either side of it; the others are named."""
    small = _criterion("evaluate.rmse.fz", 0.6, 0.5)
    (answer,) = _accepted(GOOD, small, DIRECTIONS).answers()
    assert (answer.verdict, answer.concern) == ("REJECTED", Concern.BAD)
    assert answer.why == (
        "2 of 3 criteria fail; farthest from its limit: excitation.directions 3, at least 6 allowed",
        "also failed: evaluate.rmse.fz",
    )


@pytest.mark.parametrize(
    ("name", "candidate", "command"),
    [
        ("recording.lost_share", "leg.json", f"inspect {FIRST_EXPERIMENT}"),
        ("excitation.condition", "leg.json", f"plan {EXPERIMENT} -c leg.json --clearance-deg 10"),
        ("evaluate.rmse.fz", "leg.json", f"evaluate {EXPERIMENT} -c leg.json --details"),
        ("evaluate.rmse.fz", "prior", f"calibrate {EXPERIMENT} --sensor leg -o leg.json"),
    ],
)
def test_the_next_command_is_by_the_table_that_failed(name: str, candidate: str, command: str) -> None:
    """A recording is inspected, information is planned, errors are evaluated, and a prior is calibrated."""
    (answer,) = _accepted(_criterion(name, 2.0, 1.0, calibration=candidate)).answers()
    assert answer.command == command


def test_every_sensor_has_its_answer() -> None:
    """Sensors of one file."""
    answers = _accepted(GOOD, _criterion("matrix.condition", 2.0, 1.0, sensor="arm")).answers()
    assert [answer.verdict for answer in answers] == ["ACCEPTED", "REJECTED"]
