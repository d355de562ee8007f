# SPDX-License-Identifier: BSD-3-Clause
"""Static transfer curves of every channel of a sensor: which kind of function foretells what it reads (thesis 3.1)."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Annotated, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.noise.means import means_over
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval
from forcetorque.recording.stream import Signal
from forcetorque.results.table import Row, Shown
from forcetorque.sensor.transfer.compare import FITTERS, Fitter, compare

POINT_S: Final = 0.2
"""Length of the mean that is a point; s."""
MOST_POINTS: Final = 400
"""Points of a sensor, above which means are longer."""
LEAST_POINTS: Final = 40
"""Points below which held-out errors say little."""
CURVED: Final = 0.9
"""Held-out error over that of a straight line below which a channel may count as curved; a heuristic."""
MOVED: Final = 5.0
"""Span over the held-out error of a line below which the load moves a channel too little for a verdict; a heuristic."""
LEAST_GROUPS: Final = 5
"""Parts that are held out, below which better in all of them may be chance."""
_CHANCE: Final = 0.05
_LINEAR: Final = "linear"
_GRID: Final = 101


class StaticCurve(Row):
    """What a channel reads of the load that it answers to, and the function that foretells it best."""

    channel: Annotated[str, Shown("channel")]
    """Column of the reading as it was logged."""
    unit: Annotated[str, Shown("unit")]
    """Its unit."""
    points: Annotated[int, Shown("points")]
    """Means of the reading that are compared, each held out once."""
    span: Annotated[float, Shown("span", digits=4)]
    """Range of the reading that the load explains; in that unit."""
    best: Annotated[str, Shown("best")]
    """Kind of function with the least error on held-out points."""
    best_rmse: Annotated[float, Shown("error", digits=4)]
    """Root mean square of these errors; in that unit."""
    linear_rmse: Annotated[float, Shown("of a line", digits=4)]
    """The same of a straight line."""
    curved: Annotated[bool | None, Shown("curved")]
    """Whether the best has less than nine tenths of the error of a line, less error in more of the held-out parts than
    chance explains (sign test, 5 %), and leaves the line by more than its error; a heuristic. Null where the span is
    below five errors of a line."""
    nonlinearity_percent: Annotated[float | None, Shown("from the line", "%", digits=2)]
    """Largest distance of the best from the straight line, of the span; what noise makes of it where nothing is
    curved; null where `curved` is."""
    not_fitted: Annotated[tuple[str, ...], Shown("not fitted")]
    """Kinds that these points do not allow, such as a logarithm of loads of either sign."""


def static_curves(
    runs: Sequence[SensorRun], intervals: Collection[str] = (), *, fitters: Mapping[str, Fitter] = FITTERS
) -> tuple[StaticCurve, ...]:
    """Compare transfer functions of every channel on points that were held out.

    A channel answers to one direction of the load: the combination of the six components of the expected wrench that
    foretells it best in a straight line, with an offset per session. Along it the kinds are compared; a whole interval
    is held out at a time, or a fifth of the points of fewer than five.

    Args:
        runs: One sensor in one or several recordings.
        intervals: Labels of the intervals; all that are not ignored if none is named.
        fitters: Kinds to compare, by name; `linear` among them.

    Returns:
        A row for every channel.

    Raises:
        ExperimentError: If there is no interval in which it is known what the sensor must read, or the recordings name
            other channels or units.
        FitError: If there are too few points.
    """
    chosen = [
        (run, interval)
        for run, interval in chosen_intervals(runs, intervals)
        if interval.support is None or not run.touched_beyond(interval)
    ]
    if not chosen:
        raise ExperimentError("static curves: expected an interval in which it is known what the sensor must read")
    signal = _one_signal(runs)
    load, reading, groups, sessions = _points(chosen)
    if len(load) < LEAST_POINTS:
        raise FitError(
            f"static curves: expected {LEAST_POINTS} points of {POINT_S:g} s at least, got {len(load)}; take more or "
            "longer intervals"
        )
    named = sorted(set(sessions))
    offsets = np.array([[float(session == name) for name in named] for session in sessions])
    solution = np.linalg.lstsq(np.hstack([offsets, load]), reading, rcond=None)[0]
    stimuli, outputs = load @ solution[len(named) :], reading - offsets @ solution[: len(named)]
    held_out = groups if len(set(groups)) >= LEAST_GROUPS else None
    moves = np.ptp(reading, axis=0) > 0.0
    return tuple(
        channel_curve(name, unit, stimulus * moving, output * moving, fitters=fitters, groups=held_out)
        for name, unit, stimulus, output, moving in zip(
            signal.columns, signal.units, stimuli.T, outputs.T, moves, strict=True
        )
    )


def channel_curve(
    channel: str,
    unit: str,
    stimulus: FloatArray,
    output: FloatArray,
    *,
    fitters: Mapping[str, Fitter] = FITTERS,
    groups: Sequence[str] | None = None,
) -> StaticCurve:
    """Compare transfer functions of one channel.

    Args:
        channel: Its name.
        unit: Its unit.
        stimulus: What a straight line makes of the load; shape (m,); that unit; 0 for a channel that reads the same
            throughout.
        output: The reading without offsets of sessions; shape (m,); that unit.
        fitters: Kinds to compare, by name; `linear` among them.
        groups: Group of each point, held out together; fifths of all points if None.

    Returns:
        Its curve.
    """
    span = float(np.ptp(stimulus))
    if not span:
        return StaticCurve(
            channel=channel,
            unit=unit,
            points=len(output),
            span=0.0,
            best=_LINEAR,
            best_rmse=float(output.std()),
            linear_rmse=float(output.std()),
            curved=None,
            nonlinearity_percent=None,
            not_fitted=(),
        )
    comparison = compare(stimulus, output, fitters=fitters, groups=groups)
    best = comparison.scores[0]
    line = next(score for score in comparison.scores if score.name == _LINEAR)
    grid = np.linspace(float(stimulus.min()), float(stimulus.max()), _GRID)
    distance = float(np.abs(best.model.predict(grid) - line.model.predict(grid)).max())
    moved = span >= MOVED * line.rmse
    better = int((best.fold_rmse < line.fold_rmse).sum())
    folds = len(best.fold_rmse)
    by_chance = sum(math.comb(folds, k) for k in range(better, folds + 1)) / 2**folds
    curved = best.rmse < min(CURVED * line.rmse, distance) and by_chance < _CHANCE
    return StaticCurve(
        channel=channel,
        unit=unit,
        points=best.count,
        span=span,
        best=best.name,
        best_rmse=best.rmse,
        linear_rmse=line.rmse,
        curved=curved if moved else None,
        nonlinearity_percent=100.0 * distance / span if moved else None,
        not_fitted=tuple(failure.name for failure in comparison.failures),
    )


def _one_signal(runs: Sequence[SensorRun]) -> Signal:
    """The reading, whose channels and units are the same in all recordings."""
    first, *others = [run.stream.signal(run.sensor.quantity) for run in runs]
    for run, other in zip(runs[1:], others, strict=True):
        if (other.columns, other.units) != (first.columns, first.units):
            raise ExperimentError(
                f"static curves: expected {_with_units(first)} as in {runs[0].experiment.file}, got "
                f"{_with_units(other)} in {run.experiment.file}; evaluate these recordings apart"
            )
    return first


def _with_units(signal: Signal) -> str:
    return ", ".join(f"{column} ({unit})" for column, unit in zip(signal.columns, signal.units, strict=True))


def _points(chosen: Sequence[tuple[SensorRun, Interval]]) -> tuple[FloatArray, FloatArray, list[str], list[str]]:
    """Means of expected wrench and reading as logged, shape (m, 6) and (m, c), their intervals and their sessions."""
    total_s = sum(1e-9 * (interval.end_ns - interval.start_ns) for _, interval in chosen)
    window_s = max(POINT_S, total_s / MOST_POINTS)
    parts, groups, sessions = [], [], []
    for run, interval in chosen:
        part = run.interval_samples(interval, smoothed=False, with_flattening=False)
        columns = np.hstack([part.samples.reference, part.readings.logged])
        known = np.isfinite(columns).all(axis=1)
        seconds = (part.samples.stamp_ns[known] - run.experiment.recording.start_ns) * 1e-9
        if len(seconds):
            _, means, _ = means_over(seconds, columns[known], window_s)
            parts.append(means)
            groups += [f"{run.experiment.file}: {interval.label}"] * len(means)
            sessions += [run.experiment.session_names(interval.label)[0]] * len(means)
    points = np.concatenate([*parts, np.zeros((0, 6 if not parts else parts[0].shape[1]))])
    return points[:, :6], points[:, 6:], groups, sessions
