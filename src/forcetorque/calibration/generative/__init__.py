# SPDX-License-Identifier: BSD-3-Clause
"""The default estimator: the load causes the reading, and the prior is a distribution."""

from forcetorque.calibration.generative.agreement import Disagreement, disagreements
from forcetorque.calibration.generative.assumptions import ACCURACY_SHARE, REPEATABILITY, Assumptions
from forcetorque.calibration.generative.determined import unmoved_directions
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.generative.means import WindowMeans
from forcetorque.calibration.generative.nonlinear import corrected_fit, try_correction
from forcetorque.calibration.generative.untouched import Disagreeing, agreeing_samples

__all__ = [
    "ACCURACY_SHARE",
    "REPEATABILITY",
    "Assumptions",
    "Disagreeing",
    "Disagreement",
    "GenerativeFit",
    "WindowMeans",
    "agreeing_samples",
    "corrected_fit",
    "disagreements",
    "fit_generative",
    "try_correction",
    "unmoved_directions",
]
