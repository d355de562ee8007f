# SPDX-License-Identifier: BSD-3-Clause
"""Columns of the generative model at every mean, and what they come to under each shape of slow noise.

    response = E wrench + k (variables - reference values) + quadratic + flattening + offset of the session + noise

All rows of the response have the same columns. Constants large against what changes are taken off first, by session.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise, Timeline
from forcetorque.experiment.calibration.moments import symmetric_pseudo_inverse
from forcetorque.experiment.calibration.quadratic_correction import quadratic_terms
from forcetorque.experiment.calibration.window_means import WindowMeans


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Design:
    """Columns at n means: 6 of the wrench, v of variables, 21 quadratic, 6 of flattening; then those that are free."""

    columns: FloatArray
    """All columns without their means; shape (n, a)."""
    free: FloatArray
    """Ones of every session, and its time where it may drift; shape (n, f); they have no prior."""
    response: FloatArray
    """What is regressed, without its means; shape (n, rows)."""
    column_means: FloatArray
    """Means that were taken off; shape (sessions, a)."""
    response_means: FloatArray
    """Means that were taken off; shape (sessions, rows)."""
    timeline: Timeline
    """When the means were taken."""
    sessions: tuple[str, ...]
    """Names of the sessions."""
    session_time_s: FloatArray
    """Mean time of every session on its recordings' clocks, from which drift counts; shape (sessions,); s."""
    load_centre: FloatArray
    """Mean wrench, about which the quadratic terms are taken; shape (6,); N, N m."""


def design_of(
    stretches: Sequence[WindowMeans], response: FloatArray, counts: FloatArray, *, drift: bool, centre: FloatArray
) -> Design:
    """Set up the columns.

    Args:
        stretches: Means by recording, in the order of time.
        response: What is regressed; shape (n, rows).
        counts: Modelled readings, relative to full scale, that the quadratic terms are products of; shape (n, 6).
        drift: Whether the offset of a session may move in time.
        centre: Reference values of the variables; shape (v,).

    Returns:
        The design.
    """
    sessions = tuple(dict.fromkeys(stretch.session for stretch in stretches))
    member = np.repeat([sessions.index(s.session) for s in stretches], [len(s) for s in stretches])
    count, time = np.concatenate([s.count for s in stretches]), np.concatenate([s.time_s for s in stretches])
    wrench = np.concatenate([s.reference for s in stretches])
    about = counts - counts.mean(axis=0)
    variables = np.concatenate([s.variables for s in stretches]) - centre
    flattening = np.concatenate([s.flattening for s in stretches])
    columns, column_means = _centred(np.hstack([wrench, variables, quadratic_terms(about), flattening]), member, count)
    centred, response_means = _centred(response, member, count)
    elapsed, session_time = _centred(time[:, None], member, count)
    ones = (member[:, None] == np.arange(len(sessions))).astype(np.float64)
    recordings = list(dict.fromkeys(s.recording for s in stretches))
    return Design(
        columns=columns,
        free=np.hstack([ones, ones * elapsed]) if drift else ones,
        response=centred,
        column_means=column_means,
        response_means=response_means,
        timeline=Timeline.of(
            time,
            np.repeat([recordings.index(s.recording) for s in stretches], [len(s) for s in stretches]),
            count / np.median(count),
        ),
        sessions=sessions,
        session_time_s=session_time[:, 0],
        load_centre=np.average(wrench, axis=0, weights=count),
    )


def _centred(values: FloatArray, member: IntArray, count: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values less the mean of their session, and these means."""
    means = session_means(values, member, count)
    return values - means[member], means


def session_means(values: FloatArray, member: IntArray, count: FloatArray) -> FloatArray:
    """Average values over sessions.

    Args:
        values: Values; shape (n, k).
        member: Number of the session of each; shape (n,).
        count: Samples that each stands for; shape (n,).

    Returns:
        Means; shape (sessions, k).
    """
    total = np.zeros((int(member.max()) + 1, values.shape[1]))
    np.add.at(total, member, values * count[:, None])
    return total / np.bincount(member, weights=count)[:, None]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Whitened:
    """All that a fit needs of the data under one shape of the noise; free columns are projected out."""

    noise: SlowNoise
    """The shape."""
    log_determinant: float
    """Of the noise and of what the free columns take."""
    columns: FloatArray
    """Products of the columns; shape (a, a)."""
    shared: FloatArray
    """Products of columns and response; shape (a, rows)."""
    response: FloatArray
    """Products of every response with itself; shape (rows,)."""
    free_covariance: FloatArray
    """Covariance of the free unknowns for noise of size 1 if the others were known; shape (f, f)."""
    free_columns: FloatArray
    """Free unknowns that each column is worth; shape (f, a)."""
    free_response: FloatArray
    """Free unknowns that the response is worth; shape (f, rows)."""


def whiten(design: Design, candidates: Sequence[SlowNoise] = CANDIDATES) -> list[Whitened]:
    """Reduce the data under every shape of the noise.

    Args:
        design: The columns.
        candidates: Shapes of the noise.

    Returns:
        What is left of the data, one per shape.
    """
    a, f = design.columns.shape[1], design.free.shape[1]
    everything = np.asfortranarray(np.hstack([design.columns, design.free, design.response]))
    scale = np.abs(everything).max(axis=0, initial=0.0)
    scale[scale == 0.0] = 1.0
    unit = everything / scale
    results = []
    for noise in candidates:
        product, log_determinant = design.timeline.product(unit, noise)
        product *= np.outer(scale, scale)
        free = product[a : a + f, a : a + f]
        inverse = symmetric_pseudo_inverse(free)
        worth = inverse @ product[a : a + f]
        left = product - product[:, a : a + f] @ worth
        results.append(
            Whitened(
                noise=noise,
                log_determinant=log_determinant + _log_determinant(free),
                columns=left[:a, :a],
                shared=left[:a, a + f :],
                response=np.maximum(np.diag(left)[a + f :], 0.0),
                free_covariance=inverse,
                free_columns=worth[:, :a],
                free_response=worth[:, a + f :],
            )
        )
    return results


def _log_determinant(matrix: FloatArray) -> float:
    """Of the directions of a symmetric matrix that are not zero."""
    size = np.sqrt(np.maximum(np.diag(matrix), np.finfo(float).tiny))
    values = np.linalg.eigvalsh(matrix / np.outer(size, size))
    return float(np.log(values[values > 1e-10]).sum() + 2.0 * np.log(size).sum())
