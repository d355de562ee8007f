# SPDX-License-Identifier: BSD-3-Clause
"""What excites a sensor."""

from __future__ import annotations

from enum import StrEnum


class ExcitationKind(StrEnum):
    """What was done to the sensor."""

    IMPACT = "impact"
    """It was tapped."""
    RELEASE = "release"
    """A weight that hung on it was let go."""
    PENDULUM = "pendulum"
    """A known mass swings on it."""
