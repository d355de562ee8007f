# SPDX-License-Identifier: BSD-3-Clause
"""What numbers that describe a part of a sensor must be, with one wording for all parts."""

from __future__ import annotations

import math

from forcetorque.base.errors import SensorError


def require_positive(value: float, *, name: str, unit: str) -> None:
    """Refuse what is not a finite number above zero.

    Args:
        value: Number to check.
        name: Part and argument, for the message.
        unit: Unit of the number, for the message; "1" for a ratio.

    Raises:
        SensorError: If the number is zero, negative, infinite or NaN.
    """
    if not 0.0 < value < math.inf:
        raise SensorError(f"{name}: expected a finite number above 0 {unit}, got {value:g}")


def require_finite(value: float, *, name: str, unit: str) -> None:
    """Refuse infinity and NaN.

    Args:
        value: Number to check.
        name: Part and argument, for the message.
        unit: Unit of the number, for the message; "1" for a ratio.

    Raises:
        SensorError: If the number is infinite or NaN.
    """
    if not math.isfinite(value):
        raise SensorError(f"{name}: expected a finite number of {unit}, got {value:g}")
