# SPDX-License-Identifier: BSD-3-Clause
"""Which offset a candidate is judged with: three quantities, each with a word of its own."""

from __future__ import annotations

from enum import StrEnum


class Offset(StrEnum):
    """Offset of a judged candidate."""

    FIRST_SECOND = "first-second"
    """From the first second of every judged interval, which is then not judged: the matrix is judged, as on a robot
    that starts (thesis Table 5.5)."""
    FITTED = "fitted"
    """That of the fitted data: matrix and offset are judged (Table 5.6)."""
    JUDGED_MEAN = "judged-mean"
    """Mean of the judged samples themselves: what is left when nothing constant counts; nobody has it beforehand."""
    NONE = "none"
    """None was removed, because there was no data to give one: whatever the sensor has is in the error."""


KNOWN_BEFORE = (Offset.FIRST_SECOND, Offset.FITTED)
"""Offsets that are known when the judging begins."""
