# SPDX-License-Identifier: BSD-3-Clause
"""Calibration points: pairs of a stimulus and the output of the sensor, as every fit needs them."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError


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
