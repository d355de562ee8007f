# SPDX-License-Identifier: BSD-3-Clause
"""The twelve steps by which the thesis excites a sensor (6.3.3)."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from forcetorque.exsitu.device.description import Device
from forcetorque.exsitu.device.sequence import Sequence


class YawReturn(StrEnum):
    """How yaw gets back to 0 before steps 7 and 9, of which the thesis says but where they end."""

    TOGETHER = "together"
    """Together with pitch, as the words "move to [0,0,0]" have it."""
    BEFORE = "before"
    """Before pitch moves."""
    AFTER = "after"
    """After pitch moved."""
    BACKWARDS = "backwards"
    """It need not: step 8 turns backwards."""
    NEVER = "never"
    """It need not: yaw turns on without end."""


def twelve_steps(device: Device, *, yaw_return: YawReturn = YawReturn.TOGETHER) -> Sequence:
    """Make the twelve steps.

    Steps 2 to 5 are done twice, so that yaw goes once around. The hinge is at 0 up to step 10, at the end of 11 at 90.

    Args:
        device: The device; a turn of it stays at 0.
        yaw_return: How yaw gets back to 0.

    Returns:
        The sequence.
    """
    ways = [(1, -90.0, 0.0, 0.0)]
    for half in (0.0, 180.0):
        ways += [(2, 90.0, half, 0.0), (3, 90.0, half + 90.0, 0.0)]
        ways += [(4, -90.0, half + 90.0, 0.0), (5, -90.0, half + 180.0, 0.0)]
    around = 360.0
    if yaw_return is YawReturn.NEVER:
        ways += [(7, 0.0, around, 0.0), (8, 0.0, 2 * around, 0.0), (9, -90.0, 2 * around, 0.0)]
        ways += [(11, 0.0, 2 * around, 90.0), (12, 0.0, 3 * around, 90.0)]
    elif yaw_return is YawReturn.BACKWARDS:
        ways += [(7, 0.0, around, 0.0), (8, 0.0, 0.0, 0.0), (9, -90.0, 0.0, 0.0)]
        ways += [(11, 0.0, 0.0, 90.0), (12, 0.0, around, 90.0)]
    else:
        ways += [*_return(7, (-90.0, 0.0), yaw_return), (8, 0.0, around, 0.0), *_return(9, (0.0, -90.0), yaw_return)]
        ways += [(11, 0.0, 0.0, 90.0), (12, 0.0, around, 90.0)]
    steps, pitch, yaw, hinge = (np.array(column) for column in zip(*ways, strict=True))
    others = [] if device.turn is None else [np.zeros(len(ways))]
    return Sequence.of(
        device,
        "12 steps",
        np.column_stack([pitch, yaw, *others, hinge]),
        steps=tuple(int(step) for step in steps),
        unlocked=tuple(int(step) == 11 for step in steps[1:]),
    )


def _return(step: int, pitch: tuple[float, float], yaw_return: YawReturn) -> list[tuple[int, float, float, float]]:
    """The ways of a step in which pitch goes from one position to another, and yaw from 360 to 0 deg."""
    end = (step, pitch[1], 0.0, 0.0)
    if yaw_return is YawReturn.BEFORE:
        return [(step, pitch[0], 0.0, 0.0), end]
    if yaw_return is YawReturn.AFTER:
        return [(step, pitch[1], 360.0, 0.0), end]
    return [end]
