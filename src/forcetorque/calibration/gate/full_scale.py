# SPDX-License-Identifier: BSD-3-Clause
"""Refusal of a reference beyond what the sensor can read: without a prior the only check of its size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.data_set import DataSet
from forcetorque.errors import FitError
from forcetorque.spatial import WRENCH_COMPONENTS

_BEYOND = 2.0
"""Part of its full scale that a sensor never reads; nominal full scales are often exceeded by some tens of percent."""


def require_within_full_scale(data_sets: Sequence[DataSet], full_scale: FloatArray) -> None:
    """Refuse a reference that the sensor cannot have read.

    Args:
        data_sets: The data.
        full_scale: Largest wrench that the sensor reads; shape (6,); N, N m.

    Raises:
        FitError: If a component of the reference is beyond twice that; the message names the likely cause.
    """
    largest = np.max([np.abs(data.reference).max(axis=0) for data in data_sets], axis=0)
    worst = int(np.argmax(largest / full_scale))
    if largest[worst] > _BEYOND * full_scale[worst]:
        unit = "N" if worst < 3 else "N m"
        raise FitError(
            f"the reference reaches {largest[worst]:.4g} {unit} in {WRENCH_COMPONENTS[worst]}, the sensor's full scale "
            f"is {full_scale[worst]:.4g} {unit}; are the masses in the file that urdf of [robot] names, or mass_kg of "
            "[load], in grams instead of kg, is the load estimated with joints in another unit than stated, or is "
            "full_scale of [[sensor]] not that of its data sheet, in N and N m?"
        )
