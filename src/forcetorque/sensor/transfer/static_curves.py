# SPDX-License-Identifier: BSD-3-Clause
"""Static transfer curves of every channel of a sensor: which kind of function foretells what it reads (thesis 3.1)."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, ShapeError
from forcetorque.base.noise.window_means import means_over
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval
from forcetorque.recording.stream import Signal
from forcetorque.results.table import Row, Shown
from forcetorque.sensor.transfer.parametric import (
    fit_exponential,
    fit_linear,
    fit_logarithmic,
    fit_polynomial,
    fit_power,
)
from forcetorque.sensor.transfer.sections_and_network import fit_network, fit_piecewise_linear, fit_spline
from forcetorque.sensor.transfer.transfer_function import TransferFunction, calibration_points

Fitter = Callable[[FloatArray, FloatArray], TransferFunction]
"""What fits a kind of function to stimuli and outputs; `functools.partial(fit_polynomial, degree=5)` sets a setting."""

FITTERS: Mapping[str, Fitter] = {
    "linear": fit_linear,
    "logarithmic": fit_logarithmic,
    "exponential": fit_exponential,
    "power": fit_power,
    "polynomial": fit_polynomial,
    "piecewise_linear": fit_piecewise_linear,
    "spline": fit_spline,
    "network": fit_network,
}
"""Every kind of function, with the settings that its fit has when none are given."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Score:
    """How a kind of function foretold the points that were held out."""

    name: str
    """Name of the kind."""
    count: int
    """Number of held-out points, over all folds."""
    beyond: int
    """Number of them outside the range of their fold's fit, where the function was extended."""
    rmse: float
    """Root mean square error of all held-out points together; unit of the output."""
    fold_rmse: FloatArray
    """The same of each fold, in the order of the groups' labels or of the blocks; shape (f,); unit of the output."""
    largest: float
    """Largest absolute error of a held-out point; unit of the output."""
    model: TransferFunction
    """The function fitted to all points."""


def compare(
    stimulus: Any,
    output: Any,
    *,
    fitters: Mapping[str, Fitter] = FITTERS,
    groups: Any = None,
    folds: int = 5,
) -> tuple[tuple[Score, ...], dict[str, str]]:
    """Fit every kind of function and compare them on points that were held out.

    Errors of all folds are pooled before the RMSE is taken. Held-out points beyond the range of a fit
    are foretold too, by extending the function, and counted: they show how a kind behaves there.

    Args:
        stimulus: Known stimuli, in the order in which they were recorded; shape (n,).
        output: Outputs of the sensor; shape (n,).
        fitters: Kinds to compare, by name.
        groups: Label of each point's pose or session; shape (n,); each is held out once. If left out,
            contiguous blocks are, as neighbouring points repeat each other.
        folds: Number of contiguous blocks, where no groups are given.

    Returns:
        Scores of the kinds that could be fitted in every fold, with errors in the unit of the output, the least RMSE
        first; and messages of the errors of the others by name, in the order given.

    Raises:
        ShapeError: If stimuli, outputs and groups do not fit each other.
        FitError: If there are fewer than two groups or blocks.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    held_out = _held_out(len(stimuli), groups, folds)
    scores, failures = [], dict[str, str]()
    for name, fit in fitters.items():
        try:
            scores.append(_score(name, fit, stimuli, outputs, held_out))
        except ForceTorqueError as error:
            failures[name] = str(error)
    return tuple(sorted(scores, key=lambda score: score.rmse)), failures


def _held_out(count: int, groups: Any, folds: int) -> list[BoolArray]:
    """Which points each fold holds out; shape (n,) each."""
    if groups is None:
        if not 2 <= folds <= count:
            raise FitError(f"compare: expected 2 to {count} folds for {count} points, got {folds}")
        labels = np.repeat(np.arange(folds), [len(block) for block in np.array_split(np.arange(count), folds)])
    else:
        labels = np.asarray(groups)
        if labels.shape != (count,):
            raise ShapeError(f"groups: expected one label per point, shape ({count},), got {labels.shape}")
    names = np.unique(labels)
    if len(names) < 2:
        raise FitError("compare: expected at least two groups, got one; nothing could be held out")
    return [labels == name for name in names]


def _score(name: str, fit: Fitter, stimulus: FloatArray, output: FloatArray, held_out: list[BoolArray]) -> Score:
    errors, beyond = np.zeros(len(stimulus)), 0
    for out in held_out:
        model = fit(stimulus[~out], output[~out])
        low, high = float(stimulus[out].min()), float(stimulus[out].max())
        beyond += int(((stimulus[out] < model.lowest) | (stimulus[out] > model.highest)).sum())
        wide = dataclasses.replace(model, lowest=min(model.lowest, low), highest=max(model.highest, high))
        errors[out] = wide.predict(stimulus[out]) - output[out]
    return Score(
        name=name,
        count=len(errors),
        beyond=beyond,
        rmse=float(np.sqrt((errors**2).mean())),
        fold_rmse=np.array([np.sqrt((errors[out] ** 2).mean()) for out in held_out]),
        largest=float(np.abs(errors).max()),
        model=fit(stimulus, output),
    )


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
    scores, failures = compare(stimulus, output, fitters=fitters, groups=groups)
    best = scores[0]
    line = next(score for score in scores if score.name == _LINEAR)
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
        not_fitted=tuple(failures),
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
