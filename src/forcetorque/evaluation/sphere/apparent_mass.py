# SPDX-License-Identifier: BSD-3-Clause
"""From radii to apparent masses and the error of each axis (thesis 4.1.2 and Table 4.1)."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import ForceTorqueError


def apparent_masses(lengths: Any, *, gravity: float) -> FloatArray:
    """Give the mass whose weight each length is.

    Args:
        lengths: Radii of some kind; shape (3,); N.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        A mass for each; shape (3,); kg.
    """
    masses: FloatArray = read_only(lengths, name="lengths", shape=(3,)) / _positive(gravity, "gravity")
    return masses


def axis_errors(masses: Any, *, reference_mass: float, gravity: float) -> FloatArray:
    """Compare the force that each axis reads with the weight that the model has.

    Args:
        masses: Apparent masses by the axis intersections; shape (3,); kg.
        reference_mass: What hangs on the sensor; kg.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Measured minus true size of the weight; shape (3,); N.
    """
    excess = read_only(masses, name="masses", shape=(3,)) - _positive(reference_mass, "reference_mass")
    errors: FloatArray = excess * _positive(gravity, "gravity")
    return errors


def _positive(value: float, name: str) -> float:
    if not 0.0 < value < np.inf:
        raise ForceTorqueError(f"{name}: expected a positive number, got {value:g}")
    return value
