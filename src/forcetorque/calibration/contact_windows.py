# SPDX-License-Identifier: BSD-3-Clause
"""Windows that disagree with all others: something touched the links beyond the sensor.

One rule for single and joint fits, by the residuals of the fit. A contact is short and has one direction. So the
residual of each second is taken about those of the seconds around it, and a second counts by no less than four
deviations of what else may remain: noise of its mean, what the other seconds do not determine of the measurement
under its load, and model error.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import SlowNoise
from forcetorque.base.noise.window_means import WINDOW_S
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration.expected_sensor_errors import FLATTENED, Assumptions
from forcetorque.experiment.calibration.moments import DataSet, WindowMeans
from forcetorque.experiment.calibration.sensor_model import LinearVariable

FAR: Final = 4.0
"""Robust standard deviations of the residual from which a window disagrees."""
FEWEST: Final = 20
"""Windows below which nobody can tell which disagree."""


def disagreeing(left: FloatArray, least: FloatArray | float, *, far: float = FAR) -> BoolArray:
    """Tell which windows are far from the others.

    Args:
        left: What a fit leaves of each of w windows; shape (w, k).
        least: Smallest standard deviation that counts; shape broadcast to (w, k); above 0.
        far: Robust standard deviations from which a window is far.

    Returns:
        Marks, none of fewer than `FEWEST` windows; shape (w,).
    """
    if len(left) < FEWEST:
        return np.zeros(len(left), dtype=bool)
    left = left - np.median(left, axis=0)
    scale = np.maximum(MAD_TO_DEVIATION * np.median(np.abs(left), axis=0), least)
    return np.asarray(np.sqrt(((left / scale) ** 2).mean(axis=1)) > far)


def with_neighbours(marks: BoolArray, count: int) -> BoolArray:
    """Mark the neighbours of windows too: a contact begins and ends gently.

    Args:
        marks: Windows that follow each other; shape (w,).
        count: How many to either side.

    Returns:
        The marks with those of the neighbours; shape (w,).
    """
    spread = np.convolve(marks, np.ones(2 * count + 1), mode="full")[count : count + len(marks)]
    return np.asarray(spread > 0.5)


def minority(marks: BoolArray) -> BoolArray:
    """Keep marks of less than half of the windows only: where most disagree nobody knows which are right.

    Args:
        marks: Windows that disagree; shape (w,).

    Returns:
        The same, or none; shape (w,).
    """
    return marks if 2 * np.count_nonzero(marks) <= len(marks) else np.zeros(len(marks), dtype=bool)


_ROUNDS = 5
_SUSPECT: Final = 2.0
"""Deviations from which a window leaves the first fit: a contact hides in a fit to it. What agrees with the next one
comes back."""
_PARTS: Final = 4
"""Parts of a window, from which the noise of its mean follows."""
_AROUND: Final = 21
"""Windows of which one and its surroundings are: a contact that lasts half as long is level, not contact."""
_TURNED: Final = float(np.radians(0.25))
"""By how much the load may be turned otherwise than modelled, as by the zero of a joint; rad."""
_SHIFTED_M: Final = 0.001
"""By how much a centre of mass may be elsewhere; m."""
_MOVED: Final = 0.3
"""Share of the spread of all loads, in each of their directions, that the rest has at least."""
_RESTS: Final = 1e-9
"""Share of its largest value below which the spread of a component is rounding."""
_DIRECTION: Final = 0.1
"""Share of the largest spread from which a direction counts."""
_NOISE: Final = SlowNoise(time_constant_s=15.0, ratio=1.0)
"""Noise of the fits that only tell which windows disagree: slow enough that drift is no gain."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreeing:
    """A span of samples that disagree with all others."""

    label: str
    """Label of the interval."""
    start_s: float
    """First sample; s on the clock of the data set."""
    end_s: float
    """Last sample; s on the clock of the data set."""
    force_N: float
    """Largest mean over a second of the force that is read too much; N."""
    moment_Nm: float
    """The same of the moment; N m."""


def agreeing_samples(
    data_sets: Sequence[DataSet],
    prior: FloatArray | None,
    assumptions: Assumptions,
    *,
    variables: Sequence[LinearVariable] = (),
    drift: bool = False,
) -> tuple[list[BoolArray], tuple[Disagreeing, ...]]:
    """Find the samples of a recording that disagree with all others, by the rule of the joint fit.

    Args:
        data_sets: Samples of the calibration intervals of one recording, with their instants.
        prior: As of `fit_generative`.
        assumptions: As of `fit_generative`.
        variables: As of `fit_generative`.
        drift: As of `fit_generative`.

    Returns:
        Which samples of every data set agree, shape (n,) each, and the spans of those that do not. All agree in fewer
        than `FEWEST` seconds, in a table of single samples, where the rest does not determine a fit, and where all
        motion in some direction would leave: then the prior matrix or the reference is wrong.
    """
    means = [WindowMeans.of(data) for data in data_sets]
    every = [np.ones(len(data.raw), dtype=bool) for data in data_sets]
    ends = np.cumsum([len(one) for one in means])
    if not len(ends) or ends[-1] < FEWEST or np.median(np.concatenate([one.count for one in means])) < _PARTS:
        return every, ()
    exact = replace(assumptions, accuracy=np.zeros(6))
    marks, left = np.zeros(ends[-1], dtype=bool), np.zeros((ends[-1], 6))
    for far in (_SUSPECT, *(FAR,) * (_ROUNDS - 1)):
        kept = [one.kept(~own) for one, own in zip(means, np.split(marks, ends[:-1]), strict=True) if not own.all()]
        fit = None
        try:
            fit = fit_generative(kept, prior, exact, variables=variables, drift=drift, shapes=(_NOISE,))
        except FitError:
            if prior is None or marks.any():  # the fit of all says why, if it fails too
                return every, ()
            # a contact may turn the matrix so far that the fit is refused: the prior matrix tells what to suspect
        residuals = [_residual(data, one, fit, prior) for data, one in zip(data_sets, means, strict=True)]
        left = np.concatenate([one[0] for one in residuals])
        alone = disagreeing(left, np.concatenate([one[1] for one in residuals]), far=far)
        found = minority(np.concatenate([with_neighbours(own, 1) for own in np.split(alone, ends[:-1])]))
        if np.array_equal(found, marks):
            break
        marks = found
    if _loses_direction(np.concatenate([one.reference for one in means]), marks):
        return every, ()
    spans: list[Disagreeing] = []
    agree = []
    for data, own, rest in zip(data_sets, np.split(marks, ends[:-1]), np.split(left, ends[:-1]), strict=True):
        window = data.window
        spans += _spans(data, window, own, rest)
        agree.append(~own[window])
    return agree, tuple(spans)


def _loses_direction(loads: FloatArray, marks: BoolArray) -> bool:
    """Whether what is not marked hardly moves in a direction in which the whole does; loads of shape (n, 6)."""
    spread = loads.std(axis=0)
    moves = spread > _RESTS * np.abs(loads).max(axis=0)
    if not moves.any():
        return False
    moved = (loads - loads.mean(axis=0))[:, moves] / spread[moves]
    _, sizes, directions = np.linalg.svd(moved, full_matrices=False)
    along = moved @ directions[sizes > _DIRECTION * sizes[0]].T
    return bool((along[~marks].std(axis=0) < _MOVED * along.std(axis=0)).any())


def _residual(
    data: DataSet, means: WindowMeans, fit: GenerativeFit | None, prior: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """What fit or prior matrix leaves of every window about those around it, and its least deviation; (n, 6) each."""
    reference = data.reference if data.flattening is None else data.reference + FLATTENED * data.flattening
    if fit is None:
        error, undetermined = data.raw @ np.asarray(prior).T - reference, np.zeros((len(means), 6))
    else:
        session = fit.posterior.sessions.index(data.session) if data.session in fit.posterior.sessions else -1
        model, with_variables = replace(fit.model, offset=fit.offsets[session]), data.variables.shape[1] > 0
        error = model.wrench(data.raw, data.variables if with_variables else None) - model.expected_reading(reference)
        moved = means.variables - fit.model.reference_values if with_variables else None
        covariance = fit.posterior.error_covariance(
            means.reference, variables=moved, session=fit.posterior.sessions[session]
        )
        undetermined = np.einsum("kii->ki", covariance)
    window = data.window
    starts = np.flatnonzero(np.diff(window, prepend=-1))
    counts = np.diff(starts, append=len(window))
    left: FloatArray = np.add.reduceat(error, starts, axis=0) / counts[:, None]
    force, moment = (np.linalg.norm(means.reference[:, part], axis=1) for part in (slice(3), slice(3, 6)))
    of_model = np.repeat(np.stack([_TURNED * force, _TURNED * moment + _SHIFTED_M * force], axis=1), 3, axis=1)
    least = np.sqrt(undetermined + of_model**2 + _mean_variance(data, error, window))
    return left - _level(left), np.maximum(least, np.finfo(float).tiny)


def _mean_variance(data: DataSet, error: FloatArray, window: IntArray) -> FloatArray:
    """Variance of the mean of every window by how its parts scatter, the middle one of three; shape (n, 6)."""
    origin_s = data.time_s[0] if data.origin_s is None else data.origin_s
    part = np.floor((data.time_s - origin_s) / (WINDOW_S / _PARTS) + 1e-9).astype(np.int64)
    starts = np.flatnonzero(np.diff(part, prepend=-1))
    means = np.add.reduceat(error, starts, axis=0) / np.diff(starts, append=len(part))[:, None]
    of_part = window[starts]
    number = np.bincount(of_part)[:, None]
    total, square = (np.stack([np.bincount(of_part, column) for column in (means**k).T], axis=1) for k in (1, 2))
    variance = np.maximum(square / number - (total / number) ** 2, 0.0) / np.maximum(number - 1, 1)
    around = np.concatenate([variance[:1], variance, variance[-1:]])
    return np.median(np.stack([around[:-2], around[1:-1], around[2:]]), axis=0)


def _level(left: FloatArray) -> FloatArray:
    """Median of the windows around each; shape (n, 6)."""
    count = min(_AROUND, len(left))
    around = np.median(np.lib.stride_tricks.sliding_window_view(left, count, axis=0), axis=-1)
    return around[np.clip(np.arange(len(left)) - count // 2, 0, len(around) - 1)]


def _spans(data: DataSet, window: IntArray, marks: BoolArray, left: FloatArray) -> Iterator[Disagreeing]:
    edges = np.flatnonzero(np.diff(np.r_[False, marks, False].astype(int)))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        first, last = np.searchsorted(window, start), np.searchsorted(window, end) - 1
        sizes = [float(np.linalg.norm(left[start:end, part], axis=1).max()) for part in (slice(3), slice(3, 6))]
        yield Disagreeing(
            label=data.label,
            start_s=float(data.time_s[first]),
            end_s=float(data.time_s[last]),
            force_N=sizes[0],
            moment_Nm=sizes[1],
        )
