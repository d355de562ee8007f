# SPDX-License-Identifier: BSD-3-Clause
"""The power transfer function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FitError, SensorError
from forcetorque.sensor.transfer.exponent import fit_exponent
from forcetorque.sensor.transfer.points import calibration_points
from forcetorque.sensor.transfer.transfer_function import TransferFunction

_POSITIVE = np.geomspace(0.02, 20.0, 40)
_CANDIDATES = np.concatenate([-_POSITIVE[::-1], _POSITIVE])
"""Exponents to start from; smaller ones cannot be told from a logarithm."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Power(TransferFunction):
    """`E = C s^k + O` for stimuli of at least zero, thesis Table 3.1."""

    slope: float
    """C; unit of the output per that of the stimulus to the power of k."""
    exponent: float
    """k, dimensionless."""
    offset: float
    """O, in the unit of the output."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if self.exponent == 0.0 or not (self.lowest > 0.0 or (self.lowest == 0.0 and self.exponent > 0.0)):
            raise SensorError(
                "Power: expected an exponent other than 0 and a range above 0 (from 0 if the exponent is positive), "
                f"got exponent {self.exponent:g} and a range from {self.lowest:g}"
            )

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.slope * stimulus**self.exponent + self.offset

    def _stimulus(self, output: FloatArray) -> FloatArray:
        stimuli: FloatArray = ((output - self.offset) / self.slope) ** (1.0 / self.exponent)
        return stimuli

    def _turning_points(self) -> FloatArray:
        return np.zeros(0)


def fit_power(stimulus: Any, output: Any) -> Power:
    """Fit a power with an offset by least squares of the output.

    Args:
        stimulus: Known stimuli of at least zero; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than three different stimuli, one is negative, or no exponent fits best.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=3)
    if stimuli.min() < 0.0:
        raise FitError(f"power: expected stimuli of at least 0, got {stimuli.min():g}")
    highest = stimuli.max()
    scaled = stimuli / highest  # the same search in every unit
    exponent, (slope, offset) = fit_exponent(
        lambda exponent: np.column_stack([scaled**exponent, np.ones_like(scaled)]),
        outputs,
        candidates=_POSITIVE if stimuli.min() == 0.0 else _CANDIDATES,
        name="power",
    )
    if abs(exponent) < _POSITIVE[0]:
        raise FitError(
            f"power: the best exponent, {exponent:.2g}, cannot be told from a logarithm; fit a logarithmic function"
        )
    return Power(
        lowest=float(stimuli.min()),
        highest=float(highest),
        slope=float(slope / highest**exponent),
        exponent=exponent,
        offset=float(offset),
    )
