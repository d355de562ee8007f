# SPDX-License-Identifier: BSD-3-Clause
"""What is not known of loads that a sensor weighed itself, as errors of its response: a fit takes loads as exact."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import numpy as np

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.calibration.generative.rows import LOADS
from forcetorque.calibration.posterior import Posterior
from forcetorque.part import Part


class LoadError(Part):
    """Errors of response and offsets that come of the loads.

    Loads phi and response E were estimated together, with covariance S of phi and T of E and phi. A fit of E under the
    estimated loads has the covariance of E given phi; what the loads add is `T S^-1 T^T`, here as `factor factor^T`.
    """

    sessions: tuple[str, ...]
    """Power-ups whose offsets it moves."""
    factor: Annotated[FloatArray, ArrayField((LOADS, None, None))]
    """Of every component of the reading, what each of q independent errors of size 1 does to the six coefficients of
    its response and to its offsets; shape (6, 6 + sessions, q); per N, per N m; N, N m."""

    @classmethod
    def largest(cls, errors: Iterable[LoadError | None]) -> LoadError | None:
        """Choose among what several recordings carry.

        Args:
            errors: Of each recording; the same of those that were weighed together.

        Returns:
            The one that moves the response most: moments that were stored apart do not say what their loads have in
            common. None if none carries any.
        """
        known = [error for error in errors if error is not None]
        return max(known, key=lambda error: float((error.factor[:, :LOADS] ** 2).sum()), default=None)

    def widened(self, posterior: Posterior, prior: FloatArray) -> Posterior:
        """Add what the loads leave open to what a fit knows under them.

        Args:
            posterior: What the fit knows.
            prior: Prior matrix, by which the loads were weighed; shape (6, c).

        Returns:
            The posterior with wider covariances.
        """
        placed = self._placed(posterior)
        if posterior.space == "channel":
            response = np.linalg.pinv(prior)
            placed = np.einsum("ji,ipq->jpq", response, placed)
        added = placed @ placed.transpose(0, 2, 1)
        return posterior.model_copy(
            update={
                "covariance": posterior.covariance + added,
                "learnt_covariance": posterior.learnt_covariance + added[:, :LOADS, :LOADS],
            }
        )

    def _placed(self, posterior: Posterior) -> FloatArray:
        """The factor at the places of the posterior's unknowns; shape (6, p, q)."""
        placed = np.zeros((LOADS, posterior.mean.shape[1], self.factor.shape[2]))
        placed[:, :LOADS] = self.factor[:, :LOADS]
        first = LOADS + len(posterior.variables)
        for place, session in enumerate(posterior.sessions, start=first):
            number = next((k for k, name in enumerate(self.sessions) if _same(name, session)), None)
            if number is not None:
                placed[:, place] = self.factor[:, LOADS + number]
        return placed


def _same(name: str, session: str) -> bool:
    """Whether a power-up is a session, with or without its recording in front."""
    return name == session or name.endswith(f": {session}")
