# SPDX-License-Identifier: BSD-3-Clause
"""The offset in raw counts from a motion in which gravity draws a sphere (thesis 5.1.2, in-situ offset)."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.moments import Moments
from forcetorque.errors import FitError

_FLAT = 1e-6
"""Variance of the force along its weakest direction, relative to the strongest, below which it spans no space."""


def sphere_centre(moments: Moments) -> FloatArray:
    """Find the raw reading without load: where the regression of raw counts on the force passes zero force.

    Right only for a rigid limb that turns slowly in one posture, so that its moment is a linear
    function of its force, which gravity alone makes: `r0 = mean(r) - S_rf S_ff^-1 mean(f)`.

    Args:
        moments: Moments of such a motion, a grid.

    Returns:
        Raw offset; shape (c,); counts.

    Raises:
        FitError: If the force stays in a plane or on a line: its offset across is then unknown.
    """
    force = slice(moments.channels + moments.variables, moments.channels + moments.variables + 3)
    force_force = moments.second[force, force]
    spans = np.linalg.eigvalsh(force_force)
    if not spans[0] > _FLAT * spans[-1]:
        deviation = np.sqrt(np.maximum(spans, 0.0))
        raise FitError(
            "sphere offset: expected a force that turns in space, got one that moves by only "
            f"{deviation[0]:.3g} N along one direction and by {deviation[-1]:.3g} N along another; "
            "turn the limb about two axes, or take the one-shot offset"
        )
    slope = np.linalg.solve(force_force, moments.second[force, : moments.channels]).T  # (c, 3)
    centre: FloatArray = moments.raw_mean - slope @ moments.mean[force]
    return centre
