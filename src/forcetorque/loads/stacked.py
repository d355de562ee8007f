# SPDX-License-Identifier: BSD-3-Clause
"""Forces or moments of all rows under one another."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.noise import Timeline


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Group:
    """Three axes under noise of one shape, stacked; 3 n values."""

    line: Timeline
    """When each was taken; every axis of every session is a recording of its own."""
    design: FloatArray
    """Change with every unknown, over the size of the axis; shape (3 n, p)."""
    values: FloatArray
    """Reading less what is expected, over the size of the axis; shape (3 n,)."""
    order: IntArray
    """Row that each value is of; shape (3 n,)."""
