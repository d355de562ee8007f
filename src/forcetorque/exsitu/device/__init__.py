# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device (thesis 6.2 to 6.5): what it is made of, how it moves, what its sensors and motors feel."""

from forcetorque.exsitu.device.answer import DeviceAnswer, answer_of
from forcetorque.exsitu.device.description import Axis, Device, Hinge, Part, StackedSensor, Turn, Weights
from forcetorque.exsitu.device.design import DesignedMotion, Designer
from forcetorque.exsitu.device.excitation import least_excitation
from forcetorque.exsitu.device.file import DeviceFile, DeviceMotion, DevicePosture, DeviceSimulation
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
from forcetorque.exsitu.device.load import Load, device_load, part_inertia
from forcetorque.exsitu.device.model import BASE, device_model, device_root
from forcetorque.exsitu.device.read import DEFAULT_DEVICE, read_device
from forcetorque.exsitu.device.recording import DeviceRecording, DeviceSpecimens, simulate_device
from forcetorque.exsitu.device.remedies import Remedy, Run, remedies, swing_at_yaw_zero, third_lock_steps, uncertain
from forcetorque.exsitu.device.sequence import Sequence, joint_ranges, with_free_hinge
from forcetorque.exsitu.device.tolerances import Poses, Tolerances
from forcetorque.exsitu.device.trajectory import DeviceTrajectory, joint_speeds
from forcetorque.exsitu.device.twelve_steps import YawReturn, twelve_steps

__all__ = [
    "BASE",
    "DEFAULT_DEVICE",
    "HELD_OUT_FORCE_N",
    "HELD_OUT_MOMENT_NM",
    "SAMPLES",
    "Axis",
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
    "HeldOutError",
    "Hinge",
    "Load",
    "Part",
    "Poses",
    "Remedy",
    "Run",
    "Sequence",
    "StackedSensor",
    "Tolerances",
    "Turn",
    "Weights",
    "YawReturn",
    "answer_of",
    "bench_error",
    "device_error",
    "device_load",
    "device_model",
    "device_root",
    "hanging",
    "held_out_loads",
    "joint_ranges",
    "joint_speeds",
    "least_excitation",
    "part_inertia",
    "read_device",
    "remedies",
    "sample_noise",
    "simulate_device",
    "swing_at_yaw_zero",
    "third_lock_steps",
    "twelve_steps",
    "uncertain",
    "with_free_hinge",
]
