# SPDX-License-Identifier: BSD-3-Clause
"""The linear transfer function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.sensor.transfer.points import calibration_points, least_squares
from forcetorque.sensor.transfer.transfer_function import TransferFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Linear(TransferFunction):
    """`E = C s + O`, thesis (3.2)."""

    slope: float
    """Sensitivity C; unit of the output per that of the stimulus."""
    offset: float
    """Output O without stimulus."""

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.slope * stimulus + self.offset

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return (output - self.offset) / self.slope

    def _turning_points(self) -> FloatArray:
        return np.zeros(0)


def fit_linear(stimulus: Any, output: Any) -> Linear:
    """Fit a line by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than two different stimuli.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    middle = stimuli.mean()  # a range far from zero would lose digits otherwise
    slope, level = least_squares(np.column_stack([stimuli - middle, np.ones_like(stimuli)]), outputs)
    return Linear(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        slope=float(slope),
        offset=float(level - slope * middle),
    )
