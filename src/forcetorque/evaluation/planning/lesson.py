# SPDX-License-Identifier: BSD-3-Clause
"""What a recording that is yet to be made would teach.

Its loads are known, so that its information is: per row of the posterior `X^T N^-1 X`, with the noise that the row has,
means over a second, and an offset of its own that nobody knows. Quadratic terms, which a fit finds beside the matrix,
are found anew in every recording; what derivative windows flatten is left out; the share by which a sensor does not
repeat itself stays as it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.generative.assumptions import QUADRATIC, Assumptions
from forcetorque.calibration.generative.rows import rows_of
from forcetorque.calibration.posterior import Posterior, RowNoise
from forcetorque.calibration.quadratic_correction import quadratic_terms
from forcetorque.noise import SlowNoise, Timeline

_SESSION = "planned"
_LEAST_NOISE = 1e-9
"""Least white noise, in the unit of the row: a posterior without noise would be taught anything by one posture."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lesson:
    """Loads of a recording as its means over a second see them; one power-up."""

    time_s: FloatArray
    """Instants; shape (n,); s."""
    wrench: FloatArray
    """Loads; shape (n, 6); N, N m."""
    variables: FloatArray
    """Linear variables of the posterior, less their reference values; shape (n, v)."""

    def __post_init__(self) -> None:
        n = len(np.asarray(self.time_s))
        for field, shape in (("time_s", (n,)), ("wrench", (n, 6)), ("variables", (n, None))):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    @property
    def columns(self) -> FloatArray:
        """What the unknowns of a row are multiplied by, without the offset; shape (n, 6 + v)."""
        return np.hstack([self.wrench, self.variables])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Nuisance:
    """Quadratic terms, which a fit has to tell from the matrix."""

    load_to_full_scale: FloatArray
    """Share of full scale that a load makes of six independent readings; shape (6, 6)."""
    deviation: FloatArray
    """What each of the 21 products of these may add to a row, as a standard deviation; shape (rows,)."""

    @classmethod
    def of(cls, matrix: FloatArray, assumptions: Assumptions, *, with_prior: bool) -> Nuisance:
        """Take what the generative model takes for granted.

        Args:
            matrix: Matrix of the sensor; shape (6, c).
            assumptions: What is known beside it.
            with_prior: Whether the posterior is that of a sensor with a prior matrix.

        Returns:
            The terms.
        """
        rows = rows_of(matrix, assumptions, with_prior=with_prior)
        return cls(load_to_full_scale=rows.load_to_full_scale, deviation=QUADRATIC.expected * rows.unit)

    def columns(self, wrench: FloatArray) -> FloatArray:
        """Compute the products about the mean load.

        Args:
            wrench: Loads; shape (n, 6); N, N m.

        Returns:
            Products; shape (n, 21).
        """
        shares = wrench @ self.load_to_full_scale.T
        return quadratic_terms(shares - shares.mean(axis=0))


def taught(
    posterior: Posterior, lesson: Lesson, *, seconds_before: float, nuisance: Nuisance | None = None
) -> Posterior:
    """Add a recording to what is known.

    Args:
        posterior: What is known of the sensor.
        lesson: The recording.
        seconds_before: How much was fitted so far, which its mean load is of; s.
        nuisance: Quadratic terms; None for a sensor that is known to have none.

    Returns:
        What would be known after it; its offset is that of the recording.
    """
    rows, used = len(posterior.mean), 6 + len(posterior.variables)
    line, columns = Timeline.of(lesson.time_s), lesson.columns
    deviation = np.zeros((rows, 0))
    if nuisance is not None:
        terms = nuisance.columns(lesson.wrench)
        columns, deviation = np.hstack([columns, terms]), np.repeat(nuisance.deviation[:, None], terms.shape[1], axis=1)
    mean = columns.mean(axis=0)
    products = {shape: _product(line, columns - mean, shape) for shape in set(map(_shape, posterior.noise))}
    repeated = posterior.covariance[:, :6, :6] - posterior.learnt_covariance
    covariance = np.zeros((rows, used + 1, used + 1))
    learnt = np.empty((rows, 6, 6))
    for k, noise in enumerate(posterior.noise):
        information, weighed, worth = products[_shape(noise)]
        variance = max(noise.white, _LEAST_NOISE) ** 2
        known = np.zeros((len(mean), len(mean)))
        known[:used, :used] = posterior.covariance[k, :used, :used]
        known[:6, :6] = posterior.learnt_covariance[k]
        known[used:, used:] = np.diag(deviation[k] ** 2)
        after = _narrowed(known, information / variance)
        # from the unknowns to those that are kept and the offset
        turned = np.vstack([np.eye(used, len(mean)), -(mean + weighed)])
        covariance[k] = turned @ after @ turned.T
        covariance[k, used, used] += variance / worth
        learnt[k] = after[:6, :6]
        moved = np.zeros((used + 1, 6))
        moved[:6], moved[used] = np.eye(6), -mean[:6]
        covariance[k] += moved @ repeated[k] @ moved.T
    n = len(line)
    return posterior.model_copy(
        update={
            "sessions": (_SESSION,),
            "drift": False,
            "mean": np.zeros((rows, used + 1)),
            "covariance": covariance,
            "learnt_covariance": learnt,
            "load_centre": (seconds_before * posterior.load_centre + n * mean[:6]) / (seconds_before + n),
        }
    )


def _shape(noise: RowNoise) -> SlowNoise:
    return SlowNoise(time_constant_s=noise.time_constant_s, ratio=noise.ratio)


def _product(line: Timeline, columns: FloatArray, noise: SlowNoise) -> tuple[FloatArray, FloatArray, float]:
    """Information of the columns without the offset, their mean as it is weighed, and that of the offset alone."""
    size = np.abs(columns).max(axis=0, initial=0.0)
    size[size == 0.0] = 1.0
    product, _ = line.product(np.asfortranarray(np.column_stack([columns / size, np.ones(len(line))])), noise)
    worth = float(product[-1, -1])
    mean = product[-1, :-1] / worth
    information = product[:-1, :-1] - worth * np.outer(mean, mean)
    return information * np.outer(size, size), mean * size, worth


def _narrowed(covariance: FloatArray, information: FloatArray) -> FloatArray:
    """`(covariance^-1 + information)^-1`, also where the covariance has no inverse."""
    size = np.sqrt(np.maximum(np.diag(covariance), np.finfo(float).tiny))
    values, vectors = np.linalg.eigh(covariance / np.outer(size, size))
    root = size[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
    inner = np.eye(len(root)) + root.T @ information @ root
    narrowed: FloatArray = root @ np.linalg.solve(inner, root.T)
    return 0.5 * (narrowed + narrowed.T)
