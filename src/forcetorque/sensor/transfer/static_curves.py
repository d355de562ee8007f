# SPDX-License-Identifier: BSD-3-Clause
"""Static transfer curves of every channel of a sensor: which kind of function foretells what it reads (thesis 3.1)."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Annotated, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.noise.means import means_over
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval
from forcetorque.results.table import Row, Shown
from forcetorque.sensor.transfer.compare import FITTERS, Comparison, Fitter, compare

POINT_S: Final = 0.2
"""Length of the mean that is a point; s."""
MOST_POINTS: Final = 400
"""Points of a sensor, above which means are longer."""
LEAST_POINTS: Final = 40
"""Points below which held-out errors say little."""
CURVED: Final = 0.9
"""Held-out error over that of a straight line below which a channel counts as curved; a heuristic."""
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
    curved: Annotated[bool, Shown("curved")]
    """Whether the error is below nine tenths of that of a line, a heuristic."""
    nonlinearity_percent: Annotated[float, Shown("from the line", "%", digits=2)]
    """Largest distance of the best from the straight line, of the span; what noise makes of it where nothing is
    curved."""
    not_fitted: Annotated[tuple[str, ...], Shown("not fitted")]
    """Kinds that these points do not allow, such as a logarithm of loads of either sign."""


def static_curves(
    runs: Sequence[SensorRun], intervals: Collection[str] = (), *, fitters: Mapping[str, Fitter] = FITTERS
) -> tuple[StaticCurve, ...]:
    """Compare transfer functions of every channel on points that were held out.

    A channel answers to one direction of the load: the combination of the six components of the expected wrench that
    foretells it best in a straight line. Along it the kinds are compared; a whole interval is held out at a time, or a
    fifth of a single one.

    Args:
        runs: One sensor in one or several recordings.
        intervals: Labels of the intervals; all that are not ignored if none is named.
        fitters: Kinds to compare, by name; `linear` among them.

    Returns:
        A row for every channel that the load moves.

    Raises:
        ExperimentError: If there is no interval in which it is known what the sensor must read.
        FitError: If there are too few points.
    """
    chosen = [
        (run, interval)
        for run, interval in chosen_intervals(runs, intervals)
        if interval.support is None or not run.touched_beyond(interval)
    ]
    if not chosen:
        raise ExperimentError("static curves: expected an interval in which it is known what the sensor must read")
    load, reading, groups = _points(chosen)
    if len(load) < LEAST_POINTS:
        raise FitError(
            f"static curves: expected {LEAST_POINTS} points of {POINT_S:g} s at least, got {len(load)}; take more or "
            "longer intervals"
        )
    signal = runs[0].stream.signal(runs[0].sensor.quantity)
    design = np.column_stack([np.ones(len(load)), load])
    stimuli = design @ np.linalg.lstsq(design, reading, rcond=None)[0]
    held_out = groups if len(set(groups)) > 1 else None
    rows = []
    for channel, unit, stimulus, output in zip(signal.columns, signal.units, stimuli.T, reading.T, strict=True):
        if np.ptp(stimulus) > 0.0:
            rows.append(_row(channel, unit, stimulus, compare(stimulus, output, fitters=fitters, groups=held_out)))
    return tuple(rows)


def _points(chosen: Sequence[tuple[SensorRun, Interval]]) -> tuple[FloatArray, FloatArray, list[str]]:
    """Means of expected wrench and reading as logged, shape (m, 6) and (m, c), and their interval."""
    total_s = sum(1e-9 * (interval.end_ns - interval.start_ns) for _, interval in chosen)
    window_s = max(POINT_S, total_s / MOST_POINTS)
    parts, groups = [], []
    for run, interval in chosen:
        part = run.interval_samples(interval, smoothed=False, with_flattening=False)
        columns = np.hstack([part.samples.reference, part.readings.logged])
        known = np.isfinite(columns).all(axis=1)
        seconds = (part.samples.stamp_ns[known] - run.experiment.recording.start_ns) * 1e-9
        if len(seconds):
            _, means, _ = means_over(seconds, columns[known], window_s)
            parts.append(means)
            groups += [f"{run.experiment.file}: {interval.label}"] * len(means)
    points = np.concatenate([*parts, np.zeros((0, 6 if not parts else parts[0].shape[1]))])
    return points[:, :6], points[:, 6:], groups


def _row(channel: str, unit: str, stimulus: FloatArray, comparison: Comparison) -> StaticCurve:
    best = comparison.scores[0]
    line = next(score for score in comparison.scores if score.name == _LINEAR)
    grid = np.linspace(float(stimulus.min()), float(stimulus.max()), _GRID)
    distance = np.abs(best.model.predict(grid) - line.model.predict(grid)).max()
    span = float(np.ptp(stimulus))
    return StaticCurve(
        channel=channel,
        unit=unit,
        points=best.count,
        span=span,
        best=best.name,
        best_rmse=best.rmse,
        linear_rmse=line.rmse,
        curved=best.rmse < CURVED * line.rmse,
        nonlinearity_percent=100.0 * float(distance) / span,
        not_fitted=tuple(failure.name for failure in comparison.failures),
    )
