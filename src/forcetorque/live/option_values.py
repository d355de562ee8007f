# SPDX-License-Identifier: BSD-3-Clause
"""What options of live runs may be; it imports nothing heavy, so that the help of the command stays quick."""

from __future__ import annotations

from enum import StrEnum


class Input(StrEnum):
    """Form of lines on standard input."""

    CSV = "csv"
    """A table with a heading."""
    YARP = "yarp"
    """`yarp read` of the port of one sensor."""
    YARP_MEASURES = "yarp-measures"
    """`yarp read` of `measures:o` of a device with several sensors."""
    ROS2_CSV = "ros2-csv"
    """`ros2 topic echo --csv` of `geometry_msgs/WrenchStamped`."""


class HeldQuantity(StrEnum):
    """What samples hold."""

    RAW = "raw"
    """Counts."""
    WRENCH = "wrench"
    """Wrenches by the prior matrix of the calibration; N, N m."""


class OffsetSource(StrEnum):
    """Where the offset of a live sensor comes from."""

    FITTED = "fitted"
    """The calibration."""
    TARE = "tare"
    """The mean of the first seconds; with a tool, less what the tool weighs there."""
    TRACKED = "tracked"
    """Such a tare, from which the bias is tracked."""


class FaultPolicy(StrEnum):
    """What becomes of a sample with a fault."""

    FLAG = "flag"
    """Its wrench is given with the status."""
    HOLD = "hold"
    """The last wrench without a fault is given with the status; NaN before there is one."""
    REFUSE = "refuse"
    """NaN is given with the status; streams write no line for it, and count it."""


class Lines(StrEnum):
    """Form of the lines on standard output."""

    CSV = "csv"
    """A table with a heading."""
    JSON = "json"
    """An object per line."""
    NONE = "none"
    """No lines."""
