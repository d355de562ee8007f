# SPDX-License-Identifier: BSD-3-Clause
"""A contest of sensors and methods on one motion: phases, errors per phase and load, pairs, ranks."""

from forcetorque.evaluation.contest.pairs import FAMILY_ERROR, Parts, RatedPair, Standing, rated_pairs, rms_intervals
from forcetorque.evaluation.contest.path import MotionPath, require_same_motion
from forcetorque.evaluation.contest.scores import Change, changes, repeatability
from forcetorque.evaluation.contest.trial import Trial, by_load, common_phases, trial_of
from forcetorque.evaluation.thermal.drift import LEAST_RANGE_DEGC

__all__ = [
    "FAMILY_ERROR",
    "LEAST_RANGE_DEGC",
    "Change",
    "MotionPath",
    "Parts",
    "RatedPair",
    "Standing",
    "Trial",
    "by_load",
    "changes",
    "common_phases",
    "rated_pairs",
    "repeatability",
    "require_same_motion",
    "rms_intervals",
    "trial_of",
]
