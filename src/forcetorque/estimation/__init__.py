# SPDX-License-Identifier: BSD-3-Clause
"""What mechanics demands of sensors, contacts and joints."""

from forcetorque.estimation.ambiguity import indistinguishable
from forcetorque.estimation.contact import Contact, ContactType
from forcetorque.estimation.estimate import Evaluator, estimate, evaluator_of_samples
from forcetorque.estimation.estimates import Estimates, Layout
from forcetorque.estimation.needs import required_joints_of
from forcetorque.estimation.question import MinimumNorm, Question, TorqueSum, moving_joints
from forcetorque.estimation.root_motion import support_motion_at
from forcetorque.estimation.samples import Processing, SensorSamples, sensor_samples

__all__ = [
    "Contact",
    "ContactType",
    "Estimates",
    "Evaluator",
    "Layout",
    "MinimumNorm",
    "Processing",
    "Question",
    "SensorSamples",
    "TorqueSum",
    "estimate",
    "evaluator_of_samples",
    "indistinguishable",
    "moving_joints",
    "required_joints_of",
    "sensor_samples",
    "support_motion_at",
]
