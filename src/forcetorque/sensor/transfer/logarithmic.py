# SPDX-License-Identifier: BSD-3-Clause
"""The logarithmic transfer function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FitError, SensorError
from forcetorque.sensor.transfer.points import calibration_points, least_squares
from forcetorque.sensor.transfer.transfer_function import TransferFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Logarithmic(TransferFunction):
    """`E = C ln s + O` for stimuli above zero [1].

    References:
        [1] Thesis Table 3.1, which prints `C ln + O s`; its inverse, exp((E - O) / C), is right.
    """

    slope: float
    """C: rise of the output where the stimulus grows e-fold."""
    offset: float
    """O: output at a stimulus of 1 in the unit of the stimulus."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if not self.lowest > 0.0:
            raise SensorError(f"Logarithmic: expected a range above 0, got one from {self.lowest:g}")

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.slope * np.log(stimulus) + self.offset

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return np.exp((output - self.offset) / self.slope)

    def _turning_points(self) -> FloatArray:
        return np.zeros(0)


def fit_logarithmic(stimulus: Any, output: Any) -> Logarithmic:
    """Fit a logarithm by least squares of the output, in which it is linear.

    Args:
        stimulus: Known stimuli, above zero; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than two different stimuli, or one is not above zero.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    if not stimuli.min() > 0.0:
        raise FitError(f"logarithmic: expected stimuli above 0, got {stimuli.min():g}; leave them out, or fit a power")
    logarithms = np.log(stimuli)
    middle = logarithms.mean()
    slope, level = least_squares(np.column_stack([logarithms - middle, np.ones_like(stimuli)]), outputs)
    return Logarithmic(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        slope=float(slope),
        offset=float(level - slope * middle),
    )
