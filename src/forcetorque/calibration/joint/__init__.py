# SPDX-License-Identifier: BSD-3-Clause
"""All sensors of a robot at once: joint calibration from parts between sensors that nothing touches."""

from forcetorque.calibration.joint.calibrate import JointResult, UntouchedStretch, fit_stretches
from forcetorque.calibration.joint.fit import JointFit, fit_jointly
from forcetorque.calibration.joint.joint_posterior import JointPosterior, read_joint_posterior
from forcetorque.calibration.joint.model_error import EXACT, ErrorTerm, ModelTolerance, delay_terms, error_terms
from forcetorque.calibration.joint.residual import PartResidual
from forcetorque.calibration.joint.sensor_posterior import sensor_posterior
from forcetorque.calibration.joint.spread import EVEN, ChangeSpread
from forcetorque.calibration.joint.stretch import Stretch
from forcetorque.calibration.joint.sums import PartSums, Places, part_sums
from forcetorque.calibration.joint.touch import Touch, residuals, residuals_by, untouched
from forcetorque.calibration.joint.windows import UNITS, PartWindows, part_windows, window_means

__all__ = [
    "EVEN",
    "EXACT",
    "UNITS",
    "ChangeSpread",
    "ErrorTerm",
    "JointFit",
    "JointPosterior",
    "JointResult",
    "ModelTolerance",
    "PartResidual",
    "PartSums",
    "PartWindows",
    "Places",
    "Stretch",
    "Touch",
    "UntouchedStretch",
    "delay_terms",
    "error_terms",
    "fit_jointly",
    "fit_stretches",
    "part_sums",
    "part_windows",
    "read_joint_posterior",
    "residuals",
    "residuals_by",
    "sensor_posterior",
    "untouched",
    "window_means",
]
