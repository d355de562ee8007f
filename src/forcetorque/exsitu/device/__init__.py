# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device (thesis 6.2 to 6.5): what it is made of, how it moves, what its sensors and motors feel."""

from forcetorque.exsitu.device.answer import DeviceAnswer, answer_of
from forcetorque.exsitu.device.description import Axis, Device, Hinge, Part, StackedSensor, Turn, Weights
from forcetorque.exsitu.device.design import DesignedMotion, Designer
from forcetorque.exsitu.device.duty import MotorDuty, average_torque, motor_duty
from forcetorque.exsitu.device.envelope import ARM_RADIUS_M, VIEWS, Silhouette, envelope
from forcetorque.exsitu.device.error_budget import ErrorBudget, drawn_errors
from forcetorque.exsitu.device.excitation import least_excitation, workbench_loads
from forcetorque.exsitu.device.file import DeviceFile, DeviceMotion, DevicePosture, DeviceSimulation
from forcetorque.exsitu.device.grades import (
    DATA_SHEETS,
    FORCE_LIMIT_N,
    MOMENT_LIMIT_NM,
    THESIS_GRADES,
    Grade,
    Graded,
    LoadErrors,
    graded,
    load_errors,
)
from forcetorque.exsitu.device.hanging import hanging
from forcetorque.exsitu.device.held_out import (
    HELD_OUT_FORCE_N,
    HELD_OUT_MOMENT_NM,
    SAMPLES,
    HeldOutError,
    bench_error,
    device_error,
    held_out_loads,
    sample_noise,
)
from forcetorque.exsitu.device.load import HungLoad, device_load, part_inertia
from forcetorque.exsitu.device.locking import HingeWay, hinge_ways, lag_rad, pendulum_Nm
from forcetorque.exsitu.device.model import BASE, device_model, device_root
from forcetorque.exsitu.device.read import DEFAULT_DEVICE, read_device
from forcetorque.exsitu.device.recording import DeviceRecording, DeviceSpecimens, simulate_device
from forcetorque.exsitu.device.reference import (
    BRACKET_LENGTH,
    COMPLIANCE,
    ENCODERS,
    IMU,
    LOAD_LENGTH,
    MASS,
    QUANTITIES,
    Reference,
)
from forcetorque.exsitu.device.remedies import Remedy, Run, remedies, swing_at_yaw_zero, third_lock_steps, uncertain
from forcetorque.exsitu.device.sequence import Sequence, joint_ranges, with_free_hinge
from forcetorque.exsitu.device.tolerance import NOISE_REACH, Tolerance
from forcetorque.exsitu.device.tolerances import Poses, Tolerances
from forcetorque.exsitu.device.trajectory import DeviceTrajectory, joint_speeds
from forcetorque.exsitu.device.twelve_steps import YawReturn, twelve_steps

__all__ = [
    "ARM_RADIUS_M",
    "Axis",
    "BASE",
    "BRACKET_LENGTH",
    "COMPLIANCE",
    "DATA_SHEETS",
    "DEFAULT_DEVICE",
    "DesignedMotion",
    "Designer",
    "Device",
    "DeviceAnswer",
    "DeviceFile",
    "DeviceMotion",
    "DevicePosture",
    "DeviceRecording",
    "DeviceSimulation",
    "DeviceSpecimens",
    "DeviceTrajectory",
    "ENCODERS",
    "ErrorBudget",
    "FORCE_LIMIT_N",
    "Grade",
    "Graded",
    "HELD_OUT_FORCE_N",
    "HELD_OUT_MOMENT_NM",
    "HeldOutError",
    "Hinge",
    "HingeWay",
    "IMU",
    "LOAD_LENGTH",
    "HungLoad",
    "LoadErrors",
    "MASS",
    "MOMENT_LIMIT_NM",
    "MotorDuty",
    "NOISE_REACH",
    "Part",
    "Poses",
    "QUANTITIES",
    "Reference",
    "Remedy",
    "Run",
    "SAMPLES",
    "Sequence",
    "Silhouette",
    "StackedSensor",
    "THESIS_GRADES",
    "Tolerance",
    "Tolerances",
    "Turn",
    "VIEWS",
    "Weights",
    "YawReturn",
    "answer_of",
    "average_torque",
    "bench_error",
    "device_error",
    "device_load",
    "device_model",
    "device_root",
    "drawn_errors",
    "envelope",
    "graded",
    "hanging",
    "held_out_loads",
    "hinge_ways",
    "joint_ranges",
    "joint_speeds",
    "lag_rad",
    "least_excitation",
    "load_errors",
    "motor_duty",
    "part_inertia",
    "pendulum_Nm",
    "read_device",
    "remedies",
    "sample_noise",
    "simulate_device",
    "swing_at_yaw_zero",
    "third_lock_steps",
    "twelve_steps",
    "uncertain",
    "with_free_hinge",
    "workbench_loads",
]
