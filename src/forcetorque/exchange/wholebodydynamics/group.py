# SPDX-License-Identifier: BSD-3-Clause
"""The groups of the configuration that hold one list of numbers per sensor."""

from __future__ import annotations

from enum import StrEnum


class Group(StrEnum):
    """A group, by the name that it has in the file."""

    SECONDARY_CALIBRATION = "FT_SECONDARY_CALIBRATION"
    TEMPERATURE_COEFFICIENTS = "FT_TEMPERATURE_COEFFICIENTS"
    OFFSET = "FT_OFFSET"

    @property
    def length(self) -> int:
        """How many numbers a sensor has in the group."""
        return _LENGTHS[self]


_LENGTHS = {Group.SECONDARY_CALIBRATION: 36, Group.TEMPERATURE_COEFFICIENTS: 7, Group.OFFSET: 6}
