# SPDX-License-Identifier: BSD-3-Clause
"""Which sensor a calibration is of."""

from __future__ import annotations

from pydantic import Field

from forcetorque.part import Part
from forcetorque.spatial import MeasureDirection


class SensorIdentity(Part):
    """Which sensor, mounted where, read how."""

    name: str
    """Name in the robot model."""
    serial: str = Field(min_length=1)
    """Serial number."""
    robot: str
    """Name of the robot."""
    frame: str
    """Frame of the reading: child, parent or sensor frame of the robot model's tag."""
    measure_direction: MeasureDirection
    """Who acts on whom in the reading."""
