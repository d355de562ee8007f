# SPDX-License-Identifier: BSD-3-Clause
"""Calibration: data set to moments to fit, the choice of lambda, and the `Calibration` artefact."""

from forcetorque.calibration.artefact import (
    Calibration,
    FittedInterval,
    Prior,
    Provenance,
    Selection,
    SensorIdentity,
    Validity,
    read_calibration,
    write_calibration,
)
from forcetorque.calibration.calibrate import CalibrationFit, DataSet, calibrate
from forcetorque.calibration.excitation import Excitation, excitation_of
from forcetorque.calibration.fit import MatrixFit, fit_matrix
from forcetorque.calibration.held_out import RULE, LambdaCurve, choose_lambda
from forcetorque.calibration.moments import Moments, pooled
from forcetorque.calibration.raw import is_invertible, recover_raw
from forcetorque.calibration.secondary import secondary_matrix

__all__ = [
    "RULE",
    "Calibration",
    "CalibrationFit",
    "DataSet",
    "Excitation",
    "FittedInterval",
    "LambdaCurve",
    "MatrixFit",
    "Moments",
    "Prior",
    "Provenance",
    "Selection",
    "SensorIdentity",
    "Validity",
    "calibrate",
    "choose_lambda",
    "excitation_of",
    "fit_matrix",
    "is_invertible",
    "pooled",
    "read_calibration",
    "recover_raw",
    "secondary_matrix",
    "write_calibration",
]
