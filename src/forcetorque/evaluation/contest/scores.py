# SPDX-License-Identifier: BSD-3-Clause
"""What a contestant does between runs of one motion: how well it repeats itself, and where it drifts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.evaluation.contest.trial import Trial
from forcetorque.evaluation.thermal.drift import LEAST_RANGE_DEGC

_HOUR_S = 3600.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Change:
    """How the offset of a contestant moves from run to run."""

    per_unit: FloatArray
    """Per hour, or per degree; shape (6,); N, N m."""
    half_width: FloatArray | None
    """Half of its 95 % interval; shape (6,); None where as many runs as unknowns leave none."""


def repeatability(loads: Mapping[float, Sequence[Trial]], common: BoolArray) -> FloatArray | None:
    """Give how much runs with one load differ at the same phases, offsets removed.

    Args:
        loads: Runs by load.
        common: Phases that all runs have; shape (p,).

    Returns:
        Standard deviation; shape (6,); N, N m; None where no load was hung twice.
    """
    repeated = [np.stack([t.error[common] for t in trials]) for trials in loads.values() if len(trials) > 1]
    if not repeated:
        return None
    free = sum(len(errors) - 1 for errors in repeated)
    squares = sum(((errors - errors.mean(axis=0)) ** 2).sum(axis=0).mean(axis=0) for errors in repeated)
    size: FloatArray = np.sqrt(np.asarray(squares, dtype=np.float64) / free)
    return size


def changes(loads: Mapping[float, Sequence[Trial]]) -> dict[str, Change]:
    """Regress the mean error of runs on their times and temperatures, with a level of its own for every load.

    A wrong matrix errs alike in every run with one load, so that only what changes between them is left.

    Args:
        loads: Runs by load.

    Returns:
        Changes `per hour` and `per degC`, those that the runs can tell.
    """
    every = [trial for trials in loads.values() for trial in trials]
    columns = {}
    times = np.array([trial.time_s for trial in every]) / _HOUR_S
    degrees = np.array([trial.temperature_degC for trial in every])
    if np.isfinite(times).all() and np.ptp(times) > 0.0:
        columns["per hour"] = times
    if np.isfinite(degrees).all() and np.ptp(degrees) >= LEAST_RANGE_DEGC:
        columns["per degC"] = degrees
    levels = np.array([[trial.load_kg == load for load in loads] for trial in every], dtype=np.float64)
    design = np.column_stack([levels, *columns.values()])
    scaled = design / np.maximum(np.abs(design).max(axis=0), 1e-12)
    if not columns or np.linalg.matrix_rank(scaled) < design.shape[1]:
        return {}
    return _fitted(design, np.stack([trial.level for trial in every]), tuple(columns), levels.shape[1])


def _fitted(design: FloatArray, levels: FloatArray, names: Sequence[str], first: int) -> dict[str, Change]:
    solution = np.linalg.lstsq(design, levels, rcond=None)[0]
    free = len(design) - design.shape[1]
    residual = levels - design @ solution
    spread = np.diag(np.linalg.inv(design.T @ design))
    widths: list[FloatArray | None] = [None] * len(names)
    if free > 0:
        from scipy.special import stdtrit  # here because importing it takes longer than most commands

        deviation = np.sqrt((residual**2).sum(axis=0) / free)
        widths = [float(stdtrit(free, 0.975)) * math.sqrt(spread[first + k]) * deviation for k in range(len(names))]
    return {name: Change(per_unit=solution[first + k], half_width=widths[k]) for k, name in enumerate(names)}
