# SPDX-License-Identifier: BSD-3-Clause
"""What a recording that is yet to be made would teach.

Its loads are known, so that its information is: per row of the posterior `X^T N^-1 X`, with the noise that the row has,
means over a second, and an offset of its own that nobody knows. Quadratic terms, which a fit finds beside the matrix,
are unknown too; what derivative windows flatten is left out; the share by which a sensor does not repeat itself stays
as it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.generative.assumptions import QUADRATIC, Assumptions
from forcetorque.calibration.generative.rows import rows_of
from forcetorque.calibration.posterior import Posterior, RowNoise
from forcetorque.calibration.quadratic_correction import PAIRS, quadratic_terms
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
            with_prior: Whether the rows of the posterior are components of the wrench.

        Returns:
            The terms.
        """
        rows = rows_of(matrix, assumptions, in_wrench=with_prior)
        return cls(load_to_full_scale=rows.load_to_full_scale, deviation=QUADRATIC.expected * rows.unit)

    def columns(self, wrench: FloatArray, centre: FloatArray) -> FloatArray:
        """Compute the products.

        Args:
            wrench: Loads; shape (n, 6); N, N m.
            centre: Load about which they are taken; shape (6,).

        Returns:
            Products; shape (n, 21).
        """
        return quadratic_terms((wrench - centre) @ self.load_to_full_scale.T)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Knowledge:
    """What is known of a sensor, to which recordings can be added."""

    posterior: Posterior
    """Matrix, variables, and the offset of the last recording."""
    together: FloatArray
    """Covariance of matrix, variables and quadratic terms without the repeatability; shape (rows, q, q)."""
    seconds: float
    """How much was fitted so far, which the mean load is of; s."""
    nuisance: Nuisance | None
    """Quadratic terms; None for a sensor that is known to have none."""
    centre: FloatArray | None
    """Load about which they are taken; shape (6,); N, N m; None for the mean of the first recording."""

    @classmethod
    def of(cls, posterior: Posterior, *, seconds: float = 0.0, nuisance: Nuisance | None = None) -> Knowledge:
        """Begin with a posterior; of its quadratic terms, which it does not keep, nothing is known.

        Args:
            posterior: What is known of the sensor.
            seconds: How much was fitted so far; s.
            nuisance: Quadratic terms; None for a sensor that is known to have none.

        Returns:
            What is known.
        """
        used, terms = 6 + len(posterior.variables), 0 if nuisance is None else len(PAIRS[0])
        together = np.zeros((len(posterior.mean), used + terms, used + terms))
        together[:, :used, :used] = posterior.covariance[:, :used, :used]
        together[:, :6, :6] = posterior.learnt_covariance
        if nuisance is not None:
            together[:, used:, used:] = nuisance.deviation[:, None, None] ** 2 * np.eye(terms)
        return cls(
            posterior=posterior,
            together=together,
            seconds=seconds,
            nuisance=nuisance,
            centre=None,
        )

    def taught(self, lesson: Lesson) -> Knowledge:
        """Add a recording.

        Args:
            lesson: The recording.

        Returns:
            What would be known after it; its offset is that of the recording.
        """
        posterior, used = self.posterior, 6 + len(self.posterior.variables)
        centre = lesson.wrench.mean(axis=0) if self.centre is None else self.centre
        line, columns = Timeline.of(lesson.time_s), lesson.columns
        if self.nuisance is not None:
            columns = np.hstack([columns, self.nuisance.columns(lesson.wrench, centre)])
        mean = columns.mean(axis=0)
        products = {shape: _product(line, columns - mean, shape) for shape in set(map(_shape, posterior.noise))}
        repeated = posterior.covariance[:, :6, :6] - posterior.learnt_covariance
        together = np.empty_like(self.together)
        covariance = np.zeros((len(together), used + 1, used + 1))
        moved = np.zeros((used + 1, 6))
        moved[:6], moved[used] = np.eye(6), -mean[:6]
        for k, noise in enumerate(posterior.noise):
            information, weighed, worth = products[_shape(noise)]
            variance = max(noise.white, _LEAST_NOISE) ** 2
            together[k] = _narrowed(self.together[k], information / variance)
            # from the unknowns to those that are kept and the offset
            turned = np.vstack([np.eye(used, len(mean)), -(mean + weighed)])
            covariance[k] = turned @ together[k] @ turned.T + moved @ repeated[k] @ moved.T
            covariance[k, used, used] += variance / worth
        seconds = self.seconds + len(line)
        update = {
            "sessions": (_SESSION,),
            "drift": False,
            "mean": np.zeros((len(together), used + 1)),
            "covariance": covariance,
            "learnt_covariance": together[:, :6, :6].copy(),
            "load_centre": (self.seconds * posterior.load_centre + len(line) * mean[:6]) / seconds,
        }
        after = posterior.model_copy(update=update)
        return Knowledge(posterior=after, together=together, seconds=seconds, nuisance=self.nuisance, centre=centre)


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
