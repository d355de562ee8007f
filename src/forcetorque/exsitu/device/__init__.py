# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device (thesis 6.2 to 6.5): what it is made of, how it moves, what its sensors and motors feel."""

from forcetorque.exsitu.device.answer import DeviceAnswer, answer_of
from forcetorque.exsitu.device.description import Axis, Device, Hinge, Part, StackedSensor, Turn, Weights
from forcetorque.exsitu.device.file import DeviceFile, DeviceMotion, DevicePosture, DeviceSimulation
from forcetorque.exsitu.device.hanging import hanging
from forcetorque.exsitu.device.load import Load, device_load, part_inertia
from forcetorque.exsitu.device.model import BASE, device_model, device_root
from forcetorque.exsitu.device.read import DEFAULT_DEVICE, read_device
from forcetorque.exsitu.device.recording import DeviceRecording, DeviceSpecimens, simulate_device
from forcetorque.exsitu.device.sequence import Sequence, joint_ranges, with_free_hinge
from forcetorque.exsitu.device.trajectory import DeviceTrajectory, joint_speeds
from forcetorque.exsitu.device.twelve_steps import YawReturn, twelve_steps

__all__ = [
    "BASE",
    "DEFAULT_DEVICE",
    "Axis",
    "Device",
    "DeviceAnswer",
    "DeviceFile",
    "DeviceMotion",
    "DevicePosture",
    "DeviceRecording",
    "DeviceSimulation",
    "DeviceSpecimens",
    "DeviceTrajectory",
    "Hinge",
    "Load",
    "Part",
    "Sequence",
    "StackedSensor",
    "Turn",
    "Weights",
    "YawReturn",
    "answer_of",
    "device_load",
    "device_model",
    "device_root",
    "hanging",
    "joint_ranges",
    "joint_speeds",
    "part_inertia",
    "read_device",
    "simulate_device",
    "twelve_steps",
    "with_free_hinge",
]
