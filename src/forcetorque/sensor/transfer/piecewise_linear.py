# SPDX-License-Identifier: BSD-3-Clause
"""The transfer function of straight sections."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.sensor.transfer.knots import knots_for, require_knots
from forcetorque.sensor.transfer.points import calibration_points, least_squares
from forcetorque.sensor.transfer.transfer_function import TransferFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PiecewiseLinear(TransferFunction):
    """Straight lines between knots, thesis 3.1.4; beyond the outer knots the outer lines go on."""

    knots: FloatArray
    """Stimuli at the ends of the sections, ascending; shape (k,)."""
    values: FloatArray
    """Outputs at the knots; shape (k,)."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        for field in ("knots", "values"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(None,)))
        require_knots(self.knots, self.values, name="PiecewiseLinear", least=2)

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return _along_lines(stimulus, self.knots, self.values)

    def _stimulus(self, output: FloatArray) -> FloatArray:
        # only lines within the range count, which may be narrower than the knots
        inside = self.knots[(self.knots > self.lowest) & (self.knots < self.highest)]
        knots = np.concatenate([[self.lowest], inside, [self.highest]])
        values = self._output(knots)
        order = slice(None) if values[-1] > values[0] else slice(None, None, -1)
        return np.asarray(np.interp(output, values[order], knots[order]), dtype=np.float64)

    def _turning_points(self) -> FloatArray:
        inside = self.knots[(self.knots > self.lowest) & (self.knots < self.highest)]
        directions = np.sign(np.diff(self._output(np.concatenate([[self.lowest], inside, [self.highest]]))))
        # a level line is as bad as a turn: its output tells no single stimulus
        is_turn = (directions[:-1] != directions[1:]) | (directions[1:] == 0.0)
        turns: FloatArray = inside[is_turn]
        return turns


def _along_lines(stimulus: FloatArray, knots: FloatArray, values: FloatArray) -> FloatArray:
    section = np.clip(np.searchsorted(knots, stimulus, side="right") - 1, 0, len(knots) - 2)
    part = (stimulus - knots[section]) / np.diff(knots)[section]
    along: FloatArray = (1.0 - part) * values[section] + part * values[section + 1]
    return along


def fit_piecewise_linear(stimulus: Any, output: Any, *, sections: int = 4) -> PiecewiseLinear:
    """Fit connected straight lines by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        sections: Number of lines; each holds about as many different stimuli.

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are too few different stimuli.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=sections + 1)
    knots = knots_for(stimuli, sections)
    # how much of the value at each knot a point has
    design = np.column_stack([_along_lines(stimuli, knots, row) for row in np.eye(len(knots))])
    return PiecewiseLinear(
        lowest=float(knots[0]), highest=float(knots[-1]), knots=knots, values=least_squares(design, outputs)
    )
