# SPDX-License-Identifier: BSD-3-Clause
"""Calibration: data set to moments to fit, the choice of lambda, and the `Calibration` artefact."""

from forcetorque.calibration.artefact import (
    GENERATIVE,
    JOINT,
    CalibratedVariable,
    Calibration,
    Prior,
    SessionOffset,
    read_calibration,
    write_calibration,
)
from forcetorque.calibration.calibrate import CalibrationFit, HeldOut, calibrate, estimation_of, sphere_labels
from forcetorque.calibration.data_set import DataSet
from forcetorque.calibration.estimation import Estimation
from forcetorque.calibration.estimation_type import (
    ESTIMATION_TYPES,
    EstimationType,
    OffsetStrategy,
    estimation_type,
)
from forcetorque.calibration.excitation import Excitation, excitation_of
from forcetorque.calibration.extrapolation import Extrapolation, extrapolation, predicted_error
from forcetorque.calibration.fit import MatrixFit, fit_matrix, require_determined
from forcetorque.calibration.fitted_loads import FittedLoads
from forcetorque.calibration.generative import (
    Assumptions,
    GenerativeFit,
    WindowMeans,
    corrected_fit,
    disagreements,
    fit_generative,
    try_correction,
)
from forcetorque.calibration.held_out import RULE, LambdaCurve, choose_lambda
from forcetorque.calibration.linear_variable import LinearVariable
from forcetorque.calibration.moments import Moments, pooled
from forcetorque.calibration.nonlinear_trial import NonlinearTrial
from forcetorque.calibration.posterior import Posterior, RowNoise
from forcetorque.calibration.provenance import Content, FittedInterval, Provenance
from forcetorque.calibration.quadratic_correction import QuadraticCorrection
from forcetorque.calibration.raw import is_invertible, recover_raw
from forcetorque.calibration.recording_moments import (
    IntervalMoments,
    RecordingMoments,
    VariableDescription,
    read_moments,
    require_same_sensor,
)
from forcetorque.calibration.regression import Regression, solve
from forcetorque.calibration.secondary import secondary_matrix, secondary_model
from forcetorque.calibration.selection import Selection
from forcetorque.calibration.sensor_identity import SensorIdentity
from forcetorque.calibration.sphere import sphere_centre
from forcetorque.calibration.validity import Validity
from forcetorque.calibration.wrench_model import WrenchModel

__all__ = [
    "ESTIMATION_TYPES",
    "GENERATIVE",
    "JOINT",
    "RULE",
    "Assumptions",
    "CalibratedVariable",
    "Calibration",
    "CalibrationFit",
    "DataSet",
    "Estimation",
    "EstimationType",
    "Excitation",
    "Extrapolation",
    "Content",
    "FittedInterval",
    "FittedLoads",
    "GenerativeFit",
    "HeldOut",
    "IntervalMoments",
    "LambdaCurve",
    "LinearVariable",
    "MatrixFit",
    "Moments",
    "NonlinearTrial",
    "OffsetStrategy",
    "Posterior",
    "Prior",
    "Provenance",
    "QuadraticCorrection",
    "RecordingMoments",
    "Regression",
    "RowNoise",
    "Selection",
    "SensorIdentity",
    "SessionOffset",
    "Validity",
    "VariableDescription",
    "WindowMeans",
    "WrenchModel",
    "calibrate",
    "choose_lambda",
    "corrected_fit",
    "disagreements",
    "estimation_of",
    "estimation_type",
    "excitation_of",
    "extrapolation",
    "fit_generative",
    "fit_matrix",
    "is_invertible",
    "pooled",
    "predicted_error",
    "read_calibration",
    "read_moments",
    "recover_raw",
    "require_determined",
    "require_same_sensor",
    "secondary_matrix",
    "secondary_model",
    "solve",
    "sphere_centre",
    "sphere_labels",
    "try_correction",
    "write_calibration",
]
