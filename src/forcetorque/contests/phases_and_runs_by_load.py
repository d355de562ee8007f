# SPDX-License-Identifier: BSD-3-Clause
"""Phases of a motion by its path, errors of a contestant per phase, and what changes between runs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, read_only
from forcetorque.base.errors import RecordingError
from forcetorque.sensor.temperature.drift_regression import LEAST_RANGE_DEGC

STEP_RAD = 0.05
"""What moves less than this from the last point of the path stands still: more than encoders and IMUs jitter; rad."""

TOLERANCE_RAD = math.radians(5.0)
"""Largest difference at equal phases between two runs of one motion; rad."""

_SHIFTS = np.linspace(-1.0, 1.0, 9)
"""By how much phases of two runs may be apart; phases."""

_LEAST_STEPS = 5
"""Steps of a path below which nothing moved."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MotionPath:
    """The path of one run of a motion."""

    names: tuple[str, ...]
    """What moves: joints, or components of the direction of gravity."""
    phase: FloatArray
    """Phase of every sample, from 0 to 1, not falling; shape (n,)."""
    length: FloatArray
    """Phases of the points of the path; shape (v,)."""
    points: FloatArray
    """The points; shape (v, k); rad, m, or 1 for directions."""

    @classmethod
    def of(cls, names: Sequence[str], positions: Any) -> Self:
        """Follow a motion.

        Args:
            names: What moves.
            positions: Where it is at n instants, in the order of time; shape (n, k); rad, m, or 1 for directions.

        Returns:
            Its path.

        Raises:
            RecordingError: If nothing moves.
        """
        values = read_only(positions, name="positions", shape=(None, len(tuple(names))))
        corners = _corners(values)
        points = values[corners]
        behind = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        if len(corners) <= _LEAST_STEPS:
            raise RecordingError(
                f"motion: expected {', '.join(names)} to move by more than {_LEAST_STEPS * STEP_RAD:g} rad, got "
                f"{behind[-1]:.2g}; a contest needs a motion that defines phases"
            )
        last = np.searchsorted(corners, np.arange(len(values)), side="right") - 1
        beyond = np.linalg.norm(values - points[last], axis=1)
        ends = np.append(behind[1:], behind[-1])
        phase = np.minimum(behind[last] + beyond, ends[last]) / behind[-1]
        return cls(
            names=tuple(names),
            phase=read_only(np.maximum.accumulate(phase), name="phase", shape=(len(values),)),
            length=read_only(behind / behind[-1], name="length", shape=(len(corners),)),
            points=read_only(points, name="points", shape=(len(corners), len(tuple(names)))),
        )

    def at(self, phase: FloatArray) -> FloatArray:
        """Give where the path is at phases.

        Args:
            phase: Phases from 0 to 1; shape (p,).

        Returns:
            Positions; shape (p, k).
        """
        return np.stack([np.interp(phase, self.length, column) for column in self.points.T], axis=1)


def _corners(values: FloatArray) -> IntArray:
    """Samples that are each a step farther than the one before: what lies between jitters."""
    corners, point = [0], values[0]
    for k, value in enumerate(values):
        step = value - point
        if float(step @ step) > STEP_RAD**2:
            corners.append(k)
            point = value
    return np.asarray(corners, dtype=np.int64)


def require_same_motion(paths: Mapping[str, MotionPath], *, phases: int) -> None:
    """Refuse runs that do not go the same way phase by phase.

    Args:
        paths: Paths by name of the run, at least one.
        phases: Number of phases that are compared.

    Raises:
        RecordingError: If two move other joints, or lie farther than `TOLERANCE_RAD` from each other at a phase.
    """
    (first, wanted), *others = paths.items()
    middles = (np.arange(phases) + 0.5) / phases
    # jitter adds a little to the length of a path, so that a phase may be off by a part of itself
    expected = np.stack([wanted.at(middles + shift / phases) for shift in _SHIFTS])
    for name, path in others:
        if path.names != wanted.names:
            raise RecordingError(
                f"{name}: expected the motion of {', '.join(wanted.names)} as in {first}, got {', '.join(path.names)}; "
                "compare runs of one motion"
            )
        away = np.abs(path.at(middles) - expected)
        nearest = np.take_along_axis(away, away.max(axis=2).argmin(axis=0)[None, :, None], axis=0)[0]
        phase, k = np.unravel_index(int(nearest.argmax()), nearest.shape)
        if nearest[phase, k] > TOLERANCE_RAD:
            raise RecordingError(
                f"{name}: expected the motion of {first} phase by phase, got {path.names[k]} "
                f"{nearest[phase, k]:.2f} rad (or m) away from it at {100.0 * middles[phase]:.0f} % of the path; "
                "repeat the same motion, from its start to its end"
            )


_LEAST_SHARE = 0.5
"""Share of the phases that all runs must have: with less, the motion was not repeated."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trial(ArrayRecord):
    """Means over the p phases of one run."""

    load_kg: float
    """Mass of the carried load; kg."""
    error: FloatArray = field(metadata=array("p", 6))
    """Measured less reference, offset removed; shape (p, 6); N, N m; NaN where no sample is."""
    level: FloatArray = field(metadata=array(6))
    """Mean error without any offset removed: what runs differ by if the sensor drifts; shape (6,); N, N m."""
    reference: FloatArray = field(metadata=array("p", 6))
    """Expected wrenches; shape (p, 6); N, N m; NaN where no sample is."""
    time_s: float
    """Middle of the run, on a clock that all runs share; s; NaN where there is none."""
    temperature_degC: float = np.nan
    """Mean temperature of the sensor; degC; NaN where none was recorded."""


def trial_by_phase(
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
        reference: Expected wrenches; shape (n, 6); N, N m.
        removed: Offset to remove; shape (6,); N, N m; the mean over the phases if None.
        phases: Number of phases.
        load_kg: Mass of the carried load; kg.
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
    return np.where(count[:, None] > 0, sums / np.maximum(count, 1)[:, None], np.nan)


def common_phases(contestants: Mapping[str, Sequence[Trial]]) -> BoolArray:
    """Find the phases that every run of every contestant has.

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
            f"{common.mean():.0%}; set fewer phases, or record more slowly"
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


_HOUR_S = 3600.0


OffsetDrift = tuple[FloatArray, FloatArray | None]
"""How the offset changes from run to run: slope per hour or per degree, and half of its 95 % interval; (6,) each; N,
N m. No interval where there are no more runs than unknowns."""


def repeatability(loads: Mapping[float, Sequence[Trial]], common: BoolArray) -> FloatArray | None:
    """Give how much runs with one load differ at the same phases, offsets removed.

    Args:
        loads: Runs by load.
        common: Phases that all runs have; shape (p,).

    Returns:
        Standard deviation; shape (6,); N, N m; None where no load was repeated.
    """
    repeated = [np.stack([t.error[common] for t in trials]) for trials in loads.values() if len(trials) > 1]
    if not repeated:
        return None
    free = sum(len(errors) - 1 for errors in repeated)
    squares = sum(((errors - errors.mean(axis=0)) ** 2).sum(axis=0).mean(axis=0) for errors in repeated)
    return np.sqrt(np.asarray(squares, dtype=np.float64) / free)


def changes(loads: Mapping[float, Sequence[Trial]]) -> dict[str, OffsetDrift]:
    """Regress the mean error of runs on their times and temperatures, with a level of its own for every load.

    A wrong matrix errs alike in every run with one load, so that only what changes between them is left.

    Args:
        loads: Runs by load.

    Returns:
        Changes `per hour` and `per degC`, as far as the runs determine them.
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


def _fitted(design: FloatArray, levels: FloatArray, names: Sequence[str], first: int) -> dict[str, OffsetDrift]:
    solution = np.linalg.lstsq(design, levels, rcond=None)[0]
    free = len(design) - design.shape[1]
    residual = levels - design @ solution
    spread = np.diag(np.linalg.inv(design.T @ design))
    widths: list[FloatArray | None] = [None] * len(names)
    if free > 0:
        from scipy.special import stdtrit  # here because importing it takes longer than most commands

        deviation = np.sqrt((residual**2).sum(axis=0) / free)
        widths = [float(stdtrit(free, 0.975)) * math.sqrt(spread[first + k]) * deviation for k in range(len(names))]
    return {name: (solution[first + k], widths[k]) for k, name in enumerate(names)}
