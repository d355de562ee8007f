# SPDX-License-Identifier: BSD-3-Clause
"""What is regressed on the load, row by row, and how far each row may deviate before any data.

With a prior matrix of six channels the rows are the components of the wrench that it reads (wrench space), which is
the safer choice where one posture moves only some loads. They are also where an accuracy of the reference is given, in
N and N m: an error of a moment moves all channels together, and as an error of each by itself it would be one of force.
Else they are the channels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration.generative.assumptions import ACCURACY_SHARE, FRAME_ROOTS, Assumptions

LOADS = 6
"""Coefficients of a row of the matrix, one for each component of a load; and components of a wrench."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rows:
    """The rows of the model, each in units of its own size."""

    space: Literal["wrench", "channel"]
    """What the rows are."""
    unit: FloatArray
    """Size of each row; shape (rows,); N, N m in wrench space, counts in channel space."""
    group: IntArray
    """Rows of one number share the sizes of their deviations: forces and moments, or all channels; shape (rows,)."""
    from_raw: FloatArray
    """What reads the rows off the raw readings, in these units; shape (rows, c)."""
    from_load: FloatArray
    """What a load is expected to do to the rows, in these units; shape (rows, 6)."""
    load_to_full_scale: FloatArray
    """Share of full scale that a load makes of six independent readings; shape (6, 6)."""
    sensor_root: FloatArray
    """L of every row, with L L^T the covariance of its six coefficients where the sensor differs by 1; (rows, 6, 6)."""
    frame_root: FloatArray
    """The same for gain, rotation and displacement of the reference; shape (rows, 6, 6)."""
    accuracy: FloatArray
    """Standard deviation of the slow error of the reference, in these units; shape (rows,)."""


def rows_of(matrix: FloatArray, assumptions: Assumptions, *, in_wrench: bool) -> Rows:
    """Choose the rows.

    Args:
        matrix: Prior matrix; without a prior one that reads the data roughly, for the sizes; shape (6, c).
        assumptions: What is known beside it.
        in_wrench: Whether the rows of six channels are components of the wrench.

    Returns:
        The rows.
    """
    scaled = matrix * assumptions.full_scale  # N, N m per full scale of a channel
    response = np.asarray(np.linalg.pinv(scaled), dtype=np.float64)
    channels = len(response)
    size = np.sqrt((scaled**2).mean(axis=1))
    accuracy = assumptions.reference_accuracy(matrix)
    spread = _root(response.T @ response)
    if channels == LOADS and in_wrench:
        return Rows(
            space="wrench",
            unit=size,
            group=np.repeat([0, 1], 3),
            from_raw=matrix / size[:, None],
            from_load=np.diag(1.0 / size),
            load_to_full_scale=response,
            sensor_root=np.stack([spread] * LOADS),
            frame_root=FRAME_ROOTS / size[:, None, None],
            accuracy=accuracy / size,
        )
    _, strengths, directions = np.linalg.svd(response, full_matrices=False)
    readings: FloatArray = np.sqrt(LOADS / channels) * strengths[:, None] * directions
    squares = np.einsum("ji,iab->jab", response**2, FRAME_ROOTS @ FRAME_ROOTS)
    return Rows(
        space="channel",
        unit=np.array(assumptions.full_scale),
        group=np.zeros(channels, dtype=np.int64),
        from_raw=np.diag(1.0 / assumptions.full_scale),
        from_load=response,
        load_to_full_scale=readings,
        sensor_root=np.stack([spread / np.sqrt(channels)] * channels),
        frame_root=np.sqrt(squares),
        accuracy=_channel_accuracy(response, accuracy, assumptions),
    )


def _channel_accuracy(response: FloatArray, accuracy: FloatArray, assumptions: Assumptions) -> FloatArray:
    if assumptions.accuracy is None:
        return np.full(len(response), ACCURACY_SHARE)
    share: FloatArray = np.sqrt(response**2 @ accuracy**2)
    return share


def _root(square: FloatArray) -> FloatArray:
    """L with L L^T the given matrix."""
    vectors, values, _ = np.linalg.svd(square)
    root: FloatArray = vectors * np.sqrt(values)
    return root
