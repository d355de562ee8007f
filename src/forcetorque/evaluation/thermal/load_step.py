# SPDX-License-Identifier: BSD-3-Clause
"""A load that did not stay: a step in what temperature and time leave of a reading."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.constants import MAD_TO_DEVIATION
from forcetorque.evaluation.thermal.cycles import Cycles

BESIDE = 5
"""Means on either side of a step that are compared."""
STEP_DEVIATIONS = 8.0
"""Robust deviations of such differences from which on one is a step, not noise: by simulation of white and slow noise
no record of 200 had one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadStep:
    """The largest step of a record."""

    time_s: float
    """When; s."""
    signal: int
    """Which signal, from 0."""
    size: float
    """How large, in the unit of the signal."""


def find_load_step(cycles: Cycles, residual: FloatArray) -> LoadStep | None:
    """Look for a step in the residual of a fit.

    Args:
        cycles: Means that were fitted.
        residual: What the fit left; shape (m, k).

    Returns:
        The step that stands out most; None where none does.
    """
    if len(residual) <= 4 * BESIDE:
        return None
    sums = np.cumsum(np.vstack([np.zeros(residual.shape[1]), residual]), axis=0)
    means = (sums[BESIDE:] - sums[:-BESIDE]) / BESIDE
    difference = means[BESIDE:] - means[:-BESIDE]  # of the mean from BESIDE + i on to the one before
    number = cycles.line.recording
    difference[number[BESIDE:][: len(difference)] != number[: len(difference)]] = (
        0.0  # a new power-up has its own offset
    )
    scale = MAD_TO_DEVIATION * np.median(np.abs(difference), axis=0)
    outstanding = np.abs(difference) / np.where(scale > 0.0, scale, np.inf)
    at, signal = np.unravel_index(int(outstanding.argmax()), outstanding.shape)
    if outstanding[at, signal] < STEP_DEVIATIONS:
        return None
    return LoadStep(
        time_s=float(cycles.time_s[at + BESIDE]), signal=int(signal), size=float(abs(difference[at, signal]))
    )
