# SPDX-License-Identifier: BSD-3-Clause
"""Errors of one contestant in one run of the motion: a mean for every phase."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, read_only
from forcetorque.errors import RecordingError

_LEAST_SHARE = 0.5
"""Share of the phases that all runs must have: with less, the motion was not repeated."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trial:
    """Means over the p phases of one run."""

    load_kg: float
    """Mass that hung there; kg."""
    error: FloatArray
    """Measured less reference, offset removed; shape (p, 6); N, N m; NaN where no sample is."""
    level: FloatArray
    """Mean error without any offset removed: what runs differ by if the sensor drifts; shape (6,); N, N m."""
    reference: FloatArray
    """What mechanics demands; shape (p, 6); N, N m; NaN where no sample is."""
    time_s: float
    """Middle of the run, on a clock that all runs share; s; NaN where there is none."""
    temperature_degC: float = np.nan
    """Mean temperature of the sensor; degC; NaN where none was recorded."""

    def __post_init__(self) -> None:
        p = len(np.asarray(self.error))
        for field in ("error", "reference"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(p, 6)))
        object.__setattr__(self, "level", read_only(self.level, name="level", shape=(6,)))


def trial_of(
    phase: FloatArray,
    error: Any,
    reference: FloatArray,
    removed: FloatArray | None,
    *,
    phases: int,
    load_kg: float,
    time_s: float = np.nan,
    temperature_degC: float = np.nan,
) -> Trial:
    """Average the samples of a run over phases.

    Args:
        phase: Phase of every sample, 0 to 1; shape (n,).
        error: Measured less reference, no offset removed; shape (n, 6); N, N m.
        reference: What mechanics demands; shape (n, 6); N, N m.
        removed: Offset to remove; shape (6,); N, N m; the mean over the phases if None.
        phases: Number of phases.
        load_kg: Mass that hung there; kg.
        time_s: Middle of the run; s.
        temperature_degC: Mean temperature; degC.

    Returns:
        The trial.
    """
    place = np.minimum((np.asarray(phase) * phases).astype(np.int64), phases - 1)
    means = _means(place, np.hstack([np.asarray(error, dtype=np.float64), reference]), phases)
    level = np.nanmean(means[:, :6], axis=0)
    return Trial(
        load_kg=load_kg,
        error=means[:, :6] - (level if removed is None else removed),
        level=level,
        reference=means[:, 6:],
        time_s=time_s,
        temperature_degC=temperature_degC,
    )


def _means(place: np.ndarray[Any, np.dtype[np.int64]], values: FloatArray, phases: int) -> FloatArray:
    count = np.bincount(place, minlength=phases)
    sums = np.stack([np.bincount(place, column, minlength=phases) for column in values.T], axis=1)
    means: FloatArray = np.where(count[:, None] > 0, sums / np.maximum(count, 1)[:, None], np.nan)
    return means


def common_phases(contestants: Mapping[str, Sequence[Trial]]) -> BoolArray:
    """Tell which phases every run of every contestant has.

    Args:
        contestants: Runs by name of the contestant, all of equally many phases.

    Returns:
        Whether all have it; shape (p,).

    Raises:
        RecordingError: If fewer than half are common.
    """
    known = np.stack([np.isfinite(trial.error).all(axis=1) for trials in contestants.values() for trial in trials])
    common: BoolArray = np.asarray(known.all(axis=0), dtype=np.bool_)
    if common.mean() < _LEAST_SHARE:
        raise RecordingError(
            f"phases: expected samples of all runs in at least {_LEAST_SHARE:.0%} of {common.size} phases, got "
            f"{common.mean():.0%}; ask for fewer phases, or record more slowly"
        )
    return common


def by_load(trials: Iterable[Trial]) -> dict[float, tuple[Trial, ...]]:
    """Sort runs by their loads.

    Args:
        trials: Runs of one contestant.

    Returns:
        Runs by load, the lightest first.
    """
    every = tuple(trials)
    return {load: tuple(t for t in every if t.load_kg == load) for load in sorted({t.load_kg for t in every})}
