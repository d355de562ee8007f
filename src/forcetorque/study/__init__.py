# SPDX-License-Identifier: BSD-3-Clause
"""Study: fits over estimation types, lambdas and data sets, judged by contact forces, and the choice among them."""

from forcetorque.study import tables
from forcetorque.study.candidate import Candidate, GenerativeCandidate
from forcetorque.study.fitting import Combination, Fits, fit_candidates
from forcetorque.study.judging import Judgement, judge, with_offset
from forcetorque.study.lambdas import CONVENTION, SWEEP_LAMBDAS, TABLE_FACTOR, TABLE_LAMBDAS, relative_lambda
from forcetorque.study.selection import (
    SessionScore,
    assembled,
    best_by_axis,
    best_by_magnitude,
    scored_across_sessions,
)
from forcetorque.study.study import WORKBENCH, Choice, Study, run_study
from forcetorque.study.unfitted import FAR_SD, push_deviations
from forcetorque.study.validation_set import OFFSET_S, ValidationSet

__all__ = [
    "CONVENTION",
    "FAR_SD",
    "OFFSET_S",
    "SWEEP_LAMBDAS",
    "TABLE_FACTOR",
    "TABLE_LAMBDAS",
    "WORKBENCH",
    "Candidate",
    "Choice",
    "Combination",
    "Fits",
    "GenerativeCandidate",
    "Judgement",
    "SessionScore",
    "Study",
    "ValidationSet",
    "assembled",
    "best_by_axis",
    "best_by_magnitude",
    "fit_candidates",
    "judge",
    "push_deviations",
    "relative_lambda",
    "run_study",
    "scored_across_sessions",
    "tables",
    "with_offset",
]
