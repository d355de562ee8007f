# SPDX-License-Identifier: BSD-3-Clause
"""What was measured: streams with their own clocks, intervals, findings; see docs/recording.md."""

from forcetorque.recording.finding import Finding
from forcetorque.recording.interval import Interval, MovingSupport, Support, Use
from forcetorque.recording.orientation import (
    QUATERNION_XYZW,
    ROLL_PITCH_YAW,
    EulerAxes,
    OrientationForm,
    OrientationLayout,
    OrientationSense,
    orientation_signals,
)
from forcetorque.recording.quantity import QUANTITIES, Labels, Quantity
from forcetorque.recording.recording import Recording
from forcetorque.recording.scalar_source import ScalarSource
from forcetorque.recording.schema import recording_schema
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream

__all__ = [
    "QUANTITIES",
    "QUATERNION_XYZW",
    "ROLL_PITCH_YAW",
    "EulerAxes",
    "Finding",
    "Interval",
    "Labels",
    "MovingSupport",
    "OrientationForm",
    "OrientationLayout",
    "OrientationSense",
    "Quantity",
    "Recording",
    "SavitzkyGolay",
    "ScalarSource",
    "Signal",
    "Stream",
    "Support",
    "Use",
    "orientation_signals",
    "read_recording",
    "recording_schema",
    "write_recording",
]
