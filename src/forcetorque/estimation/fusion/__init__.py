# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of several sources, each with its covariance, made one."""

from forcetorque.estimation.fusion.conflict import Conflict
from forcetorque.estimation.fusion.disagreement import Disagreement, Innovation
from forcetorque.estimation.fusion.friction import Friction, fit_friction
from forcetorque.estimation.fusion.fuse import FALSE_ALARM, WINDOW_S, Fusion, fuse
from forcetorque.estimation.fusion.motor import Motor, motor_source
from forcetorque.estimation.fusion.source import TorqueSource
from forcetorque.estimation.fusion.wrench_source import wrench_source

__all__ = [
    "FALSE_ALARM",
    "WINDOW_S",
    "Conflict",
    "Disagreement",
    "Friction",
    "Fusion",
    "Innovation",
    "Motor",
    "TorqueSource",
    "fit_friction",
    "fuse",
    "motor_source",
    "wrench_source",
]
