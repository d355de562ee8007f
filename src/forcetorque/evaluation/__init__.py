# SPDX-License-Identifier: BSD-3-Clause
"""How far a calibration can be trusted, on motions that were not fitted, and how well a sensor uses its range."""

from forcetorque.evaluation.autocorrelation import Autocorrelation, autocorrelation
from forcetorque.evaluation.candidate_errors import CandidateErrors, PooledErrors, candidate_errors, evaluator_of_work
from forcetorque.evaluation.contact_force import ContactForces, contact_forces
from forcetorque.evaluation.contact_force_validation import ContactForceValidation, OtherSensors
from forcetorque.evaluation.gains import (
    MARGIN,
    AxisResolution,
    ChannelRange,
    GainAdvice,
    GainChange,
    advise_gains,
    axis_resolution,
    channel_ranges,
    strongest_samples,
)
from forcetorque.evaluation.joint_torques import TorqueErrors, TorqueMap, joints_of_sensor, torque_errors, torque_map
from forcetorque.evaluation.model_findings import model_findings
from forcetorque.evaluation.offset import KNOWN_BEFORE, Offset, OffsetEstimate, mean_offset
from forcetorque.evaluation.offset_policy import OF_ONE_LINK, OffsetPolicy
from forcetorque.evaluation.paired import (
    ErrorRatio,
    Judgement,
    PairedComparison,
    PairedErrors,
    compare_errors,
)
from forcetorque.evaluation.population import FeaturePosition, PopulationPosition, position_in_population
from forcetorque.evaluation.push_error import LEVER_M, PUSH_N, PushError, push_error, pushes
from forcetorque.evaluation.static_checks import MatrixChecks, OffsetChange, matrix_checks, offset_change
from forcetorque.evaluation.wrench_errors import WrenchErrors, errors_from_zero, offset_removed, wrench_errors

__all__ = [
    "KNOWN_BEFORE",
    "LEVER_M",
    "MARGIN",
    "OF_ONE_LINK",
    "PUSH_N",
    "Autocorrelation",
    "AxisResolution",
    "CandidateErrors",
    "ChannelRange",
    "ContactForceValidation",
    "ContactForces",
    "ErrorRatio",
    "FeaturePosition",
    "GainAdvice",
    "GainChange",
    "Judgement",
    "MatrixChecks",
    "Offset",
    "OffsetChange",
    "OffsetEstimate",
    "OffsetPolicy",
    "OtherSensors",
    "PairedComparison",
    "PairedErrors",
    "PooledErrors",
    "PopulationPosition",
    "PushError",
    "TorqueErrors",
    "TorqueMap",
    "WrenchErrors",
    "advise_gains",
    "autocorrelation",
    "axis_resolution",
    "candidate_errors",
    "channel_ranges",
    "compare_errors",
    "contact_forces",
    "errors_from_zero",
    "evaluator_of_work",
    "joints_of_sensor",
    "matrix_checks",
    "mean_offset",
    "model_findings",
    "offset_change",
    "offset_removed",
    "position_in_population",
    "push_error",
    "pushes",
    "strongest_samples",
    "torque_errors",
    "torque_map",
    "wrench_errors",
]
