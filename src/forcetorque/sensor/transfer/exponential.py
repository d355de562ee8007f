# SPDX-License-Identifier: BSD-3-Clause
"""The exponential transfer function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FitError, SensorError
from forcetorque.sensor.transfer.exponent import fit_exponent
from forcetorque.sensor.transfer.points import calibration_points
from forcetorque.sensor.transfer.transfer_function import TransferFunction

_CANDIDATES = np.concatenate([-np.geomspace(100.0, 1e-3, 40), np.geomspace(1e-3, 100.0, 40)])
"""Rates to start from, per span of the stimuli: from a factor of 1.001 to one of e^100 over the range."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Exponential(TransferFunction):
    """`E = O exp(k s)`, thesis Table 3.1."""

    scale: float
    """O: output without stimulus."""
    rate: float
    """k: one over the unit of the stimulus."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if self.scale == 0.0 or self.rate == 0.0:
            raise SensorError(f"Exponential: expected scale and rate other than 0, got {self.scale:g}, {self.rate:g}")

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.scale * np.exp(self.rate * stimulus)

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return np.log(output / self.scale) / self.rate

    def _turning_points(self) -> FloatArray:
        return np.zeros(0)


def fit_exponential(stimulus: Any, output: Any) -> Exponential:
    """Fit an exponential by least squares of the output (not of its logarithm, which would weigh small ones more).

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than two different stimuli, or no rate fits best.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    middle, span = 0.5 * (stimuli.min() + stimuli.max()), np.ptp(stimuli)
    scaled = (stimuli - middle) / span  # the same search in every unit, and no overflow
    rate, (scale,) = fit_exponent(
        lambda rate: np.exp(rate * scaled)[:, None], outputs, candidates=_CANDIDATES, name="exponential"
    )
    if rate == 0.0 or scale == 0.0:
        raise FitError("exponential: the output is the same for every stimulus, so no rate is determined")
    return Exponential(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        scale=float(scale * np.exp(-rate * middle / span)),
        rate=float(rate / span),
    )
