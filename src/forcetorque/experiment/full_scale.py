# SPDX-License-Identifier: BSD-3-Clause
"""Full scale of the channels of a sensor's raw reading."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.calibration.assumptions import ACCURACY_SHARE
from forcetorque.experiment.experiment import ExperimentSensor


def full_scale_of(sensor: ExperimentSensor, accuracy: FloatArray | None, *, channels: int) -> FloatArray:
    """Give the full scale of every channel of a sensor's raw reading.

    Args:
        sensor: The sensor.
        accuracy: Accuracy of its reference, as the file states it; shape (6,); N, N m; None where it does not.
        channels: Number c of channels of a raw reading.

    Returns:
        Full scales; shape (c,); counts, or N and N m where the logged wrench takes the place of counts.

    Raises:
        ExperimentError: If a wrench takes the place of counts, and neither its full scale nor an accuracy is stated.
    """
    if sensor.prior_source != "identity":
        return np.full(channels, sensor.limit_counts)
    if sensor.full_scale is not None:
        return sensor.full_scale
    if accuracy is not None and (accuracy > 0.0).all():
        return accuracy / ACCURACY_SHARE
    raise ExperimentError(
        f'sensor {sensor.name!r}: expected full_scale with the prior "identity", which says nothing of sizes: six '
        "numbers in its [[sensor]], N and N m, as its data sheet has them; or accuracy of [calibration]"
    )
