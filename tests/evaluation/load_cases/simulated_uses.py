# SPDX-License-Identifier: BSD-3-Clause
"""Simulated sensors that are judged for three uses, and what is true of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import cast

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.fit import GenerativeFit
from forcetorque.evaluation.load_cases.load_case import (
    LoadCase,
    LoadCaseOffset,
    full_scale_loads,
    pushes_around_sensor,
    pushes_at,
)
from forcetorque.evaluation.load_cases.validation_evidence import Evidence, SecondMeans, evidence
from forcetorque.evaluation.load_cases.verdict import Decision, LoadCaseAssessment
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.moments import DataSet
from tests.calibration.push_error import LIMIT_COUNTS, Case, cases

FITTED = {"grid": ["grid"], "tz": ["tz"], "bsl": ["bsl"], "all": ["grid", "tz", "bsl", "bnsl"]}
"""Recordings that are fitted, by motion."""
LEG, FOOT = SENSORS = ("l_leg_ft", "l_foot_ft")
_JUDGED = "judged"
_OTHER_DAY = ["grid_2", "tz_2", "bsl_2"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """The verdict on one sensor, motion and use, and what is true."""

    case: Case
    """The sensor with what was fitted."""
    use: LoadCase
    """The use."""
    judged: list[DataSet]
    """Recordings of another day, on which it is judged."""
    fit: GenerativeFit
    """The calibration."""
    decision: Decision
    """What is said."""
    within: float
    """Predicted probability of an error within what is allowed."""
    true: FloatArray
    """True force and moment error; shape (2,); N, N m."""
    stated: FloatArray
    """The largest that are stated; shape (2,); N, N m."""

    @property
    def good(self) -> bool:
        """Whether its true error is within what is allowed."""
        return bool((self.true <= np.array(self.use.requirement)).all())

    @property
    def above(self) -> bool:
        """Whether its true force or moment error is larger than the largest that is stated."""
        return bool((self.true > self.stated).any())


def outcomes(seeds: range, *, fitted: Mapping[str, Sequence[str]] = FITTED) -> Iterator[Outcome]:
    """Calibrate simulated sensors and judge them for every use.

    Args:
        seeds: Seeds of the sensors.
        fitted: Recordings that are fitted, by motion.

    Yields:
        A verdict for every seed, sensor, motion and use.
    """
    motions = {**fitted, _JUDGED: _OTHER_DAY}
    group: dict[str, Case] = {}
    for case in cases(motions, dict.fromkeys(SENSORS, list(motions)), seeds):
        group[case.motion] = case
        if len(group) == len(motions):
            judged = group.pop(_JUDGED).data
            for one in group.values():
                fit = one.generative()
                for use in _uses(one):
                    yield outcome_of(one, fit, use, judged)
            group = {}


def outcome_of(case: Case, fit: GenerativeFit, use: LoadCase, judged: list[DataSet]) -> Outcome:
    """Judge a calibration for a use.

    Args:
        case: The sensor.
        fit: Its calibration.
        use: The use.
        judged: Recordings that were not fitted.

    Returns:
        The verdict, and what is true.
    """
    measured = _evidence(fit, judged)
    calibration = cast(
        "Calibration",
        SimpleNamespace(
            matrix=fit.model.matrix,
            posterior=fit.posterior,
            prior=SimpleNamespace(matrix=case.prior, offset=np.zeros(6)),
            validity=SimpleNamespace(
                expected_wrench_sd=np.concatenate([data.reference for data in case.data]).std(axis=0)
            ),
            warnings=(),
        ),
    )
    judge = LoadCaseAssessment(use, calibration, measured)
    within = judge.within
    assert within is not None
    return Outcome(
        case=case,
        use=use,
        judged=judged,
        fit=fit,
        decision=judge.verdict()[0],
        within=within,
        true=_true_error(use.wrench, fit.model.matrix, case.truth),
        stated=np.array([error.after_at_most for error in judge.errors()]),
    )


def _uses(case: Case) -> tuple[LoadCase, ...]:
    loads = {
        "push": pushes_around_sensor(50.0, 0.3),
        "weight": pushes_at([[0.0, 0.0, -0.1]], 320.0, 0.05, direction=[[0.0, 0.0, -1.0]]),
        "scale": full_scale_loads(LIMIT_COUNTS * np.linalg.norm(case.prior, axis=1), 0.1),
    }
    return tuple(LoadCase(name=k, words=k, wrench=wrench, offset=LoadCaseOffset.TARED) for k, wrench in loads.items())


def _error(fit: GenerativeFit, data: DataSet) -> FloatArray:
    return fit.model.wrench(data.raw, np.reshape(data.variables, (len(data.raw), -1))) - data.reference


def _evidence(fit: GenerativeFit, judged: list[DataSet]) -> Evidence:
    return evidence(
        [SecondMeans.of(data.session, [(data.time_s, _error(fit, data), data.reference)]) for data in judged]
    )


def _true_error(wrench: FloatArray, matrix: FloatArray, truth: FloatArray) -> FloatArray:
    error = wrench @ (matrix @ np.linalg.pinv(truth) - np.eye(6)).T
    square = (error**2).mean(axis=0)
    sizes: FloatArray = np.sqrt([square[:3].sum(), square[3:].sum()])
    return sizes
