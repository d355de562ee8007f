# SPDX-License-Identifier: BSD-3-Clause
"""The cubic spline transfer function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError
from forcetorque.sensor.transfer.knots import knots_for, require_knots
from forcetorque.sensor.transfer.points import calibration_points, least_squares
from forcetorque.sensor.transfer.transfer_function import TransferFunction

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

_LEAST_KNOTS = 4
"""Knots that carry one cubic."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spline(TransferFunction):
    """Cubics between knots, with equal slope and curvature where they meet (not-a-knot ends), thesis 3.1.5."""

    knots: FloatArray
    """Stimuli where the cubics meet, ascending; shape (k,), k at least 4."""
    values: FloatArray
    """Outputs at the knots; shape (k,)."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        for field in ("knots", "values"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(None,)))
        require_knots(self.knots, self.values, name="Spline", least=_LEAST_KNOTS)

    def _curve(self) -> CubicSpline:
        from scipy.interpolate import CubicSpline  # here because importing it takes longer than most fits

        return CubicSpline(self.knots, self.values)

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return np.asarray(self._curve()(stimulus), dtype=np.float64)

    def _turning_points(self) -> FloatArray:
        slope = self._curve().derivative()
        # where the slope is zero all over a section, SciPy marks the rest of it with NaN
        roots = np.asarray(slope.roots(), dtype=np.float64)
        inside = np.unique(roots[(roots > self.lowest) & (roots < self.highest)])
        edges = np.concatenate([[self.lowest], inside, [self.highest]])
        signs = np.sign(slope(0.5 * (edges[:-1] + edges[1:])))
        turns: FloatArray = inside[(signs[:-1] != signs[1:]) | (signs[1:] == 0.0)]
        return turns


def fit_spline(stimulus: Any, output: Any, *, sections: int = 4) -> Spline:
    """Fit a cubic spline by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        sections: Number of cubics, at least 3; each holds about as many different stimuli.

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are too few sections or different stimuli.
    """
    from scipy.interpolate import CubicSpline

    if sections < _LEAST_KNOTS - 1:
        raise FitError(f"spline: expected at least {_LEAST_KNOTS - 1} sections, got {sections}")
    stimuli, outputs = calibration_points(stimulus, output, parameters=sections + 1)
    knots = knots_for(stimuli, sections)
    # a spline is linear in its values at the knots
    design = np.asarray(CubicSpline(knots, np.eye(len(knots)))(stimuli), dtype=np.float64)
    return Spline(lowest=float(knots[0]), highest=float(knots[-1]), knots=knots, values=least_squares(design, outputs))
