# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor is to be used for, and what error it will make there."""

from forcetorque.evaluation.use.load_case import ALLOWED_SHARE, LoadCase, UseOffset
from forcetorque.evaluation.use.loads import pushes_at, pushes_within, shares_of, weights
from forcetorque.evaluation.use.prediction import (
    CONFIDENCE,
    ErrorSize,
    ErrorSources,
    PredictedError,
    moment_of_use,
    predict,
    predict_by,
    predict_prior,
)

__all__ = [
    "ALLOWED_SHARE",
    "CONFIDENCE",
    "ErrorSize",
    "ErrorSources",
    "LoadCase",
    "PredictedError",
    "UseOffset",
    "moment_of_use",
    "predict",
    "predict_by",
    "predict_prior",
    "pushes_at",
    "pushes_within",
    "shares_of",
    "weights",
]
