# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that a verdict compares, by hand, and the decision on either side of each limit."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from forcetorque.evaluation.load_cases.load_case import LoadCase, LoadCaseOffset
from forcetorque.evaluation.load_cases.predicted_error import predict_from_posterior
from forcetorque.evaluation.load_cases.validation_evidence import Evidence, MeasuredError
from forcetorque.evaluation.load_cases.verdict import (
    ADD_VALIDATION,
    RECORDED,
    LoadCaseAssessment,
    LoadCaseVerdict,
    Reason,
    load_case_verdict,
)
from forcetorque.experiment.calibration.posterior import RowNoise
from tests.evaluation.load_cases.test_predicted_error import _case, _posterior

SLOW = 1.7
"""Variance of the slow noise over that of the white."""
MOVED = np.random.default_rng(5).normal(size=(40, 6)) * np.repeat([10.0, 2.0], 3)
POSTERIOR = _posterior(()).model_copy(
    update={"noise": tuple(RowNoise(white=0.05 * (k + 1), time_constant_s=20.0, ratio=SLOW) for k in range(6))}
)
CALIBRATION: Any = SimpleNamespace(
    matrix=np.eye(6),
    posterior=POSTERIOR,
    prior=None,
    warnings=(),
    estimation_type="generative",
    validity=SimpleNamespace(expected_wrench_sd=np.ones(6)),
)
QUIET = MeasuredError(constant=0.0, constant_at_least=0.0, rest=0.0, rest_at_least=0.0)
WIDE = {"allowed_force_N": 1e3, "allowed_moment_Nm": 1e3}


def _assessed(case: LoadCase, *, seconds: int = 40, **errors: MeasuredError) -> LoadCaseAssessment:
    measured = Evidence(
        force=errors.get("force", QUIET), moment=errors.get("moment", QUIET), reference=MOVED[:seconds], moved=MOVED
    )
    return LoadCaseAssessment(case, CALIBRATION, measured)


def _against(assessment: LoadCaseAssessment, words: str) -> list[Reason]:
    return [reason for reason in assessment.verdict()[1] if words in reason.text]


def _error(name: str, value: float) -> MeasuredError:
    return replace(QUIET, **{name: value, name.removesuffix("_at_least"): value})


def test_the_error_that_is_expected_of_validation_data_has_their_loads_and_slow_noise() -> None:
    """Upper end of the prediction at the loads about their means, tared, and the slow part of every row."""
    there = LoadCase(name="there", words="", wrench=MOVED, offset=LoadCaseOffset.TARED)
    predicted = predict_from_posterior(POSTERIOR, there)
    slow = POSTERIOR.to_wrench**2 @ np.array([SLOW * (0.05 * (k + 1)) ** 2 for k in range(6)])
    wanted = {
        "force": np.sqrt(predicted.force.at_most**2 + slow[:3].sum()),
        "moment": np.sqrt(predicted.moment.at_most**2 + slow[3:].sum()),
    }
    expected = _assessed(_case(**WIDE))._expected_there()
    assert expected == pytest.approx(wanted, rel=1e-12)
    assert slow[:3].sum() > 0.05 * predicted.force.at_most**2
    for quantity, limit in wanted.items():
        for share, is_more in ((0.99, False), (1.01, True)):
            assessment = _assessed(_case(**WIDE), **{quantity: _error("rest_at_least", share * limit)})
            named = _against(assessment, f"its {quantity} error is")
            assert [reason.against for reason in named] == (["data"] if is_more else [])
            assert all("something is not in the model" in reason.text for reason in named)


@pytest.mark.parametrize("quantity", ["force", "moment"])
def test_an_error_beyond_what_is_allowed_forbids_the_use(quantity: str) -> None:
    """Its lower end without the constant part, of the quantity itself."""
    for share, against in ((0.99, None), (1.01, "use")):
        limits = {"allowed_force_N": 3.0, "allowed_moment_Nm": 0.4}
        limit = limits["allowed_force_N" if quantity == "force" else "allowed_moment_Nm"]
        case, error = _case(offset=LoadCaseOffset.TARED, **limits), _error("rest_at_least", share * limit)
        assessment = _assessed(case, **{quantity: error})
        assert any(
            reason.against == "use" and "without the constant part" in reason.text for reason in assessment.verdict()[1]
        ) == (against == "use")


@pytest.mark.parametrize(("share", "named"), [(0.99, False), (1.01, True)])
def test_a_constant_error_forbids_a_use_with_its_own_offset(share: float, named: bool) -> None:
    """From a hundredth of the loads on, or from what is allowed; not where the sensor is tared before."""
    default = _case()
    error = _error("constant_at_least", share * 0.01 * default.force_N)
    assert bool(_against(_assessed(default, force=error), "are constant")) == named
    moment = _error("constant_at_least", share * 0.01 * default.moment_Nm)
    assert bool(_against(_assessed(default, moment=moment), "are constant")) == named
    stated = _case(allowed_force_N=2.0)
    assert bool(_against(_assessed(stated, force=_error("constant_at_least", share * 2.0)), "are constant")) == named
    assert not _against(_assessed(_case(offset=LoadCaseOffset.TARED), force=error), "are constant")
    # what no limit is stated for is not evaluated
    assert not _against(_assessed(stated, moment=_error("constant_at_least", 100.0)), "are constant")


def test_five_seconds_of_data_test_a_calibration_and_four_do_not() -> None:
    """Means of a second are counted."""
    for seconds, short in ((4, True), (5, False)):
        assert bool(_against(_assessed(_case(**WIDE), seconds=seconds), "too short to test it")) == short


def test_a_prediction_counts_from_a_chance_of_95_percent_on() -> None:
    """Of both errors at once; below it data are lacking, with the chance in words."""
    draws = predict_from_posterior(POSTERIOR, _case()).force.draws
    for chance, enough in ((0.949, False), (0.951, True)):
        case = _case(allowed_force_N=float(np.quantile(draws, chance)), allowed_moment_Nm=1e3)
        assessment = _assessed(case)
        assert assessment.within == pytest.approx(chance, abs=3e-4)
        assert bool(_against(assessment, "the chance that both are within what is allowed is 95 %")) != enough
        assert (assessment.limited_by is None) == enough


def test_the_measured_error_has_its_constant_part_where_the_sensor_is_not_tared() -> None:
    """As the root of the sum of squares; tared it is the rest alone."""
    error = replace(QUIET, constant=3.0, rest=4.0)
    for offset, size in ((LoadCaseOffset.FITTED, 5.0), (LoadCaseOffset.TARED, 4.0)):
        force, moment = _assessed(_case(offset=offset, **WIDE), force=error).errors()
        assert (force.measured, moment.measured) == (size, 0.0)


def _verdict(case: LoadCase, measured: Evidence | None, *, full_scale: float = 1e4) -> LoadCaseVerdict:
    sensor: Any = SimpleNamespace(name="arm_ft", serial="SN1", full_scale=np.full(6, full_scale))
    return load_case_verdict(sensor, case, ("new", CALIBRATION), measured, lambda offset: (), ())


def test_without_data_that_test_it_a_calibration_is_not_called_good() -> None:
    """However good its prediction is, and with what to record; the error is then predicted alone."""
    verdict = _verdict(_case(**WIDE), None)
    assert verdict.decision == "not enough data"
    (against,) = [reason for reason in verdict.reasons if reason.against is not None]
    assert (against.against, against.remedy) == ("data", ADD_VALIDATION)
    assert all(error.measured is None for error in verdict.errors)
    assert _verdict(_case(**WIDE), _assessed(_case(**WIDE)).measured).decision == "use"


def test_loads_that_the_sensor_cannot_read_leave_a_verdict_on_those_of_the_data() -> None:
    """Predicted at the recorded loads, with the reason; where nothing moved in the data, at the usual ones."""
    case, measured = replace(_case(**WIDE), is_stated=False, readable="smaller"), _assessed(_case(**WIDE)).measured
    assert measured is not None
    measured = replace(measured, reference=MOVED + [100.0, 0.0, 0.0, 0.0, 0.0, 10.0])  # of which only changes count
    largest = float(np.abs(case.wrench).max())
    inside, beyond = (_verdict(case, measured, full_scale=share * largest) for share in (1.001, 0.999))
    assert (inside.load_case, inside.beyond_range) == (case.name, None)
    assert beyond.load_case == RECORDED
    assert [error.load for error in beyond.errors] == pytest.approx(
        [np.sqrt((MOVED[:, part] ** 2).sum(axis=1).mean()) for part in (slice(3), slice(3, 6))]
    )
    assert beyond.beyond_range == beyond.reasons[-1].text
    assert beyond.readable_load_case == "smaller"
    assert "state your loads as [[load_case]]" in beyond.reasons[-1].text
    at_rest = replace(measured, moved=np.zeros_like(MOVED))
    for evidence in (at_rest, None):
        assert _verdict(case, evidence, full_scale=0.5 * largest).load_case == case.name
