# SPDX-License-Identifier: BSD-3-Clause
"""Single causes of a misfit that a load cannot take up: a gain of one axis, permuted or reversed axes, a turned mount.

Each is fitted with the row weights of the robust fit. They are compared by the logarithm of what they leave of every
axis, with a penalty per parameter (BIC). A gain or a mount is named only if a fit under slow noise confirms it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import FORCE, WRENCH_COMPONENTS
from forcetorque.payload.identification.estimation_problem import LoadProblem
from forcetorque.payload.identification.load_estimates import HypothesisRow
from forcetorque.payload.identification.measurement_model import changes, load_wrench
from forcetorque.payload.identification.parameter_vector import Guess, Kind, places
from forcetorque.payload.identification.robust_fit import Fit, fit, plain_fit
from forcetorque.robot.mount_estimate import rotation_vector, rotation_words

_LEAVES = 0.7
"""A cause is named if it leaves less than this part of what is left of the axes that it changes."""
_SURE = 2.0
"""Half-widths of its 95 % interval by which a gain is off 1, or a mount off the stated one."""
_HELD = 1e-12
"""Variance of the coefficients that are held while one gain is fitted."""
_LEAST_LEFT = 1e-6
"""A gain of which the other unknowns leave less than this part to be told is not separable from them."""
_SPARE_ROWS = 4.0
"""Rows beyond the unknowns per axis, below which any cause explains them."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Cause:
    """An account of the rows."""

    name: str
    words: str
    severity: Literal["contradiction", "caution"] = "caution"
    problem: LoadProblem
    """The problem with the cause taken into account."""
    scale: FloatArray
    """What the readings of the problem are to be multiplied by to be those of the log; shape (6,)."""
    parameters: int = 0
    """Number of parameters that it adds."""
    axes: tuple[int, ...]
    """Components that it changes."""


def axis_errors(fitted: Fit, *, permuted: bool, drift: bool) -> Iterator[HypothesisRow]:
    """Name the one cause that explains the misfit of a problem, if one does.

    Args:
        fitted: The problem as stated, with the weights of its rows. Its matrix counts as exact.
        permuted: Whether permuted and reversed axes are tried, which leave large misfits only.
        drift: Whether biases move evenly in time.

    Yields:
        One account at most.
    """
    problem, weight = replace(fitted.problem, matrix_prior=None, slope=()), fitted.weight
    guess, residual = plain_fit(problem, drift=drift, weight=weight)
    count = float(weight.sum())
    if problem.mount or problem.tilt or count < len(guess.parameters) / 6.0 + _SPARE_ROWS:
        return
    stated = _squares(residual, weight)
    if not (stated > 0.0).all():
        return
    best: tuple[_Cause, FloatArray] | None = None
    least = 0.0
    causes = [_mount(problem), *_gains(problem, guess, residual, weight), *(_permutations(problem) if permuted else ())]
    for cause in causes:
        left = plain_fit(cause.problem, drift=drift, weight=weight)[1] * cause.scale
        squares = _squares(left, weight)
        worth = count * float(np.log(squares / stated).sum()) + cause.parameters * np.log(6.0 * count)
        if worth < least:
            best, least = (cause, squares), worth
    if best is not None:
        yield from _confirmed(fitted, best[0], (stated, best[1]), drift=drift)


def _squares(residual: FloatArray, weight: FloatArray) -> FloatArray:
    """Mean squares of every axis, at least rounding; shape (6,)."""
    squares = weight @ residual**2 / weight.sum()
    return np.maximum(squares, np.finfo(float).eps * squares.max())


def _mount(problem: LoadProblem) -> _Cause:
    words = "the sensor is turned by {turn} against the axes that the file states"
    return _Cause(
        name="turned mount",
        words=words,
        problem=replace(problem, mount=True),
        scale=np.ones(6),
        parameters=3,
        axes=tuple(range(6)),
    )


def _gains(problem: LoadProblem, guess: Guess, residual: FloatArray, weight: FloatArray) -> Iterator[_Cause]:
    """Give the gain of one force and of one moment that explain most, by a linear step from the fit."""
    root = np.sqrt(weight)[:, None] / np.sqrt(_squares(residual, weight))
    design = (changes(problem, guess) * root[:, :, None]).reshape(-1, len(guess.parameters))
    columns = np.zeros((*residual.shape, 6))
    columns[:, range(6), range(6)] = load_wrench(problem, guess) * root
    whole = columns.reshape(-1, 6)
    own = whole - design @ np.linalg.lstsq(design, whole, rcond=1e-9)[0]
    size, square = (whole**2).sum(axis=0), (own**2).sum(axis=0)
    separable = square > _LEAST_LEFT * size
    error = np.where(separable, own.T @ (residual * root).reshape(-1) / np.where(separable, square, 1.0), 0.0)
    worth = error**2 * square
    for axes in (range(3), range(3, 6)):
        k = max(axes, key=lambda axis: float(worth[axis]))
        if not 1.0 + error[k] > 0.0 or not worth[k] > 0.0:
            continue
        scale = np.ones(6)
        scale[k] += error[k]
        rows = replace(problem.rows, wrench=problem.rows.wrench / scale)
        yield _Cause(
            name="gain of an axis",
            words=f"{WRENCH_COMPONENTS[k]} changes by {{gain}} of what the other axes make of the load",
            problem=replace(problem, rows=rows),
            scale=scale,
            parameters=1,
            axes=(k,),
        )


def _permutations(problem: LoadProblem) -> Iterator[_Cause]:
    """Two axes exchanged, of force, of moment or of both, and one reversed."""
    for of_force, of_moment in ((True, False), (False, True), (True, True)):
        starts = [start for start, used in ((0, of_force), (3, of_moment)) if used]
        for first, second in ((0, 1), (0, 2), (1, 2)):
            order = np.arange(6)
            for start in starts:
                order[[start + first, start + second]] = start + second, start + first
            pairs = " and ".join(
                f"{WRENCH_COMPONENTS[start + first]} with {WRENCH_COMPONENTS[start + second]}" for start in starts
            )
            axes = tuple(start + axis for start in starts for axis in (first, second))
            words = f"columns are exchanged, {pairs}: list them as fx, fy, fz, tx, ty, tz"
            rows = replace(problem.rows, wrench=problem.rows.wrench[:, order])
            yield _contradiction("exchanged axes", words, replace(problem, rows=rows), np.ones(6), axes)
        for axis in range(3):
            axes = tuple(start + axis for start in starts)
            scale = np.ones(6)
            scale[list(axes)] = -1.0
            named = " and ".join(WRENCH_COMPONENTS[k] for k in axes)
            words = f"the sign of {named} is reversed against the other axes: state the frame of the wrench, or turn it"
            rows = replace(problem.rows, wrench=problem.rows.wrench * scale)
            yield _contradiction("reversed axis", words, replace(problem, rows=rows), np.ones(6), axes)


def _contradiction(name: str, words: str, problem: LoadProblem, scale: FloatArray, axes: tuple[int, ...]) -> _Cause:
    return _Cause(name=name, words=words, severity="contradiction", problem=problem, scale=scale, axes=axes)


def _confirmed(
    fitted: Fit, cause: _Cause, squares: tuple[FloatArray, FloatArray], *, drift: bool
) -> Iterator[HypothesisRow]:
    """Name a cause that leaves little of its axes and, where it has parameters, is told from noise."""
    axes = list(cause.axes)
    stated, left = (float(np.exp(np.log(values[axes]).mean() / 2.0)) for values in squares)
    if not left < _LEAVES * stated:
        return
    problem = replace(fitted.problem, matrix_prior=None, slope=())
    if cause.name == "gain of an axis":
        words = _gain_words(problem, cause, drift=drift)
    elif cause.name == "turned mount":
        words = _mount_words(cause, squares, drift=drift)
    else:
        words = cause.words
    if words is not None:
        yield HypothesisRow(name=cause.name, description=words, residual_share=left / stated, severity=cause.severity)


def _gain_words(problem: LoadProblem, cause: _Cause, *, drift: bool) -> str | None:
    (k,) = cause.axes
    prior = np.tile(_HELD * np.eye(6), (6, 1, 1))
    prior[k, k, k] = 1.0
    refit = fit(replace(problem, matrix_prior=prior), drift=drift)
    place = places(refit.guess.parameters, Kind.MATRIX, k)[k]
    error, half = float(refit.guess.values[place]), float(refit.half_width[place])
    if not abs(error) > _SURE * half:
        return None
    words = cause.words.format(gain=f"{1.0 + error:.3f} ±{half:.2g}")
    return f"{words}: calibrate the sensor, or look for a channel or unit of that axis"


def _mount_words(cause: _Cause, squares: tuple[FloatArray, FloatArray], *, drift: bool) -> str | None:
    refit = fit(cause.problem, drift=drift)
    own = places(refit.guess.parameters, Kind.MOUNT)
    half, vector = refit.half_width[own], rotation_vector(refit.guess.rotation)
    if not (np.abs(vector) > _SURE * half).any():
        return None
    before, after = (float(np.sqrt(values[FORCE].sum())) for values in squares)
    turn = f"{rotation_words(-vector)} (±{np.rad2deg(half.max()):.1f} deg)"
    return f'{cause.words.format(turn=turn)}: residual {before:.2g} -> {after:.2g} N; set mount = "unknown"'
