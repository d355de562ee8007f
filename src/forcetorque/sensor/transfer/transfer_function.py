# SPDX-License-Identifier: BSD-3-Clause
"""What every transfer function offers, and the calibration points that every fit needs."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, check_arrays
from forcetorque.base.errors import FitError, SensorError, ShapeError

_ROUNDING = 1e-9
"""Part of the output's span by which an output may lie beyond the ends: what rounding does, and far below noise."""

_HALVINGS = 80
"""Halvings of the range in a search for the inverse: more than the 52 bits of a number between its ends."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TransferFunction(ABC):
    """`E = h(s)`: the output of a sensor for a stimulus, thesis (3.1), in the units that the caller fitted.

    A fit is known to hold between the least and the greatest stimulus it was made from. Beyond them both
    directions refuse. To go further on purpose, state the wider range: `dataclasses.replace(model, highest=...)`.
    """

    lowest: float
    """Least stimulus for which the function is valid."""
    highest: float
    """Greatest stimulus for which the function is valid."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not -math.inf < self.lowest < self.highest < math.inf:
            raise SensorError(
                f"{type(self).__name__}: expected a finite range with lowest below highest, "
                f"got {self.lowest:g} to {self.highest:g}"
            )

    def predict(self, stimulus: Any) -> FloatArray:
        """Give the output of the sensor.

        Args:
            stimulus: Stimuli within the range; any shape.

        Returns:
            Outputs; same shape.

        Raises:
            SensorError: If a stimulus is outside the range.
        """
        values = np.asarray(stimulus, dtype=np.float64)
        self._require_inside(values, self.lowest, self.highest, "stimuli outside the fitted range")
        return self._output(values)

    def inverse(self, output: Any) -> FloatArray:
        """Give the stimulus of an output.

        Args:
            output: Outputs between those at the ends of the range; any shape.

        Returns:
            Stimuli within the range; same shape.

        Raises:
            SensorError: If the function does not rise, or fall, all over its range, so that an output shows several
                stimuli, or if an output is outside.
        """
        self._require_monotone()
        values = np.asarray(output, dtype=np.float64)
        low, high = sorted(self.output_ends())
        slack = _ROUNDING * (high - low)
        self._require_inside(values, low, high, "outputs outside those of the fitted range,", slack)
        return np.clip(self._stimulus(np.clip(values, low, high)), self.lowest, self.highest)

    def _require_inside(self, values: FloatArray, low: float, high: float, what: str, slack: float = 0.0) -> None:
        outside = ~((values >= low - slack) & (values <= high + slack))
        if outside.any():
            raise SensorError(
                f"{type(self).__name__}: {int(outside.sum())} {what} {low:g} to {high:g}, such as "
                f"{values[outside].flat[0]:g}; limit them with np.clip, or state a wider range with dataclasses.replace"
            )

    def output_ends(self) -> tuple[float, float]:
        """Give the outputs at the ends of the range.

        Returns:
            Output at the lowest and at the highest stimulus.
        """
        return float(self._output(np.array(self.lowest))), float(self._output(np.array(self.highest)))

    @abstractmethod
    def _output(self, stimulus: FloatArray) -> FloatArray:
        """Output for stimuli within the range."""

    def _turning_points(self) -> FloatArray:
        """Stimuli strictly within the range at which the function stops rising or falling; none if monotone."""
        return np.zeros(0)

    def _stimulus(self, output: FloatArray) -> FloatArray:
        """Stimulus of outputs between the ends of a monotone function, by halving the range for all at once."""
        below = np.full(output.shape, self.lowest)
        above = np.full(output.shape, self.highest)
        first, last = self.output_ends()
        for _ in range(_HALVINGS):
            middle = 0.5 * (below + above)
            is_beyond = (self._output(middle) - output) * (last - first) > 0.0
            below, above = np.where(is_beyond, below, middle), np.where(is_beyond, middle, above)
        middle = 0.5 * (below + above)
        return np.asarray(middle, dtype=np.float64)

    def _require_monotone(self) -> None:
        turns = self._turning_points()
        first, last = self.output_ends()
        if len(turns) or first == last:
            where = f"turns at a stimulus of {turns[0]:g}" if len(turns) else "has the same output at both ends"
            raise SensorError(
                f"{type(self).__name__}: no inverse between {self.lowest:g} and {self.highest:g}, as the function "
                f"{where}; state a narrower range with dataclasses.replace, or fit another kind"
            )


def calibration_points(stimulus: Any, output: Any, *, parameters: int) -> tuple[FloatArray, FloatArray]:
    """Check calibration points for a fit.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        parameters: Number of parameters to fit, which as many different stimuli are needed for.

    Returns:
        Both as arrays.

    Raises:
        ShapeError: If they are not two series of one length.
        FitError: If one is not finite, or there are too few different stimuli.
    """
    stimuli, outputs = np.asarray(stimulus, dtype=np.float64), np.asarray(output, dtype=np.float64)
    if stimuli.ndim != 1 or stimuli.shape != outputs.shape:
        raise ShapeError(f"expected stimulus and output of one shape (n,), got {stimuli.shape} and {outputs.shape}")
    if not (np.isfinite(stimuli).all() and np.isfinite(outputs).all()):
        raise FitError("calibration points: expected finite numbers; leave out points without a value")
    different = len(np.unique(stimuli))
    needed = max(parameters, 2)
    if different < needed:
        raise FitError(
            f"{different} different stimuli do not determine {parameters} parameters; expected {needed} or more"
        )
    return stimuli, outputs


def least_squares(design: FloatArray, output: FloatArray) -> FloatArray:
    """Solve for parameters in which a function is linear, thesis (3.6).

    Args:
        design: Output per parameter; shape (n, parameters).
        output: Outputs; shape (n,).

    Returns:
        Parameters; shape (parameters,).

    Raises:
        FitError: If the points do not determine all parameters.
    """
    parameters, _, rank, _ = np.linalg.lstsq(design, output, rcond=None)
    if rank < design.shape[1]:
        raise FitError(
            f"{len(output)} points determine {rank} of {design.shape[1]} parameters; "
            "spread the stimuli, or use fewer parameters"
        )
    return np.asarray(parameters, dtype=np.float64)
