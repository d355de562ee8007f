# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with one sample of a live sensor."""

from __future__ import annotations

from enum import IntEnum, IntFlag
from functools import lru_cache
from typing import Final


class Status(IntFlag):
    """State of one sample of one sensor; 0 where nothing is wrong."""

    NOT_FINITE = 1
    """A channel, a variable or the gravity that a tool needs is NaN or infinite."""
    SATURATED = 2
    """A channel is at the limit of the converter, or the device says so."""
    FROZEN = 4
    """All channels repeat one reading for longer than the limit."""
    REPEATED = 8
    """The stamp is that of the sample before."""
    LATE = 16
    """The stamp is older than that of an earlier sample."""
    DEVICE = 32
    """The device reports an error, or the joint positions that a tool needs are missing."""
    TARING = 64
    """A tare is collecting; the offset is still that from before. No fault."""
    CONTACT = 128
    """The bias is not tracked, because the load differs from that of the tool. No fault."""


FAULTS: Final = int(
    Status.NOT_FINITE | Status.SATURATED | Status.FROZEN | Status.REPEATED | Status.LATE | Status.DEVICE
)
"""Bits of samples that say nothing of the load at their time."""


class DeviceStatus(IntEnum):
    """Codes of `yarp::dev::MAS_status`, YARP `MultipleAnalogSensorsInterfaces.h`."""

    OK = 0
    """Valid."""
    ERROR = 1
    """Error of the sensor."""
    OVERFLOW = 2
    """Out of range: saturated."""
    TIMEOUT = 3
    """No new sample."""
    WAITING = 4
    """No sample yet."""
    UNKNOWN = 5
    """Not known."""


def status_of_device(code: int) -> Status:
    """Give the status that a code of a device stands for.

    Args:
        code: Code, a `DeviceStatus`; others are errors.

    Returns:
        The status.
    """
    if code == DeviceStatus.OK:
        return Status(0)
    return Status.SATURATED if code == DeviceStatus.OVERFLOW else Status.DEVICE


@lru_cache(maxsize=256)
def status_text(status: int) -> str:
    """Write a status for people and files.

    Args:
        status: Bits of `Status`.

    Returns:
        `ok`, or names between `|`.
    """
    return "|".join(bit.name.lower() for bit in Status if bit & status and bit.name) or "ok"
