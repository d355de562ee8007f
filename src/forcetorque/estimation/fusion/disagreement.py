# SPDX-License-Identifier: BSD-3-Clause
"""By how much sources contradict each other, over what their covariances allow for: normalised innovations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.estimation.fusion.combination import inverse_of_known, precisions
from forcetorque.estimation.fusion.windows import WindowMeans

VARIANCE_MARGIN = 1.25
"""Factor by which the noise of sources may be more than stated before that is a conflict: variances of noise are
estimates themselves, from as many samples as a recording has, and hundreds of windows tell them to a few percent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Innovation:
    """A sum of squared normalised innovations."""

    chi2: float
    """The sum; as large as the degrees of freedom on average, if the covariances are right."""
    degrees_of_freedom: int
    """Number of independent ones."""

    @property
    def probability(self) -> float:
        """Probability of at least so much by chance; 1 where nothing is compared."""
        if not self.degrees_of_freedom:
            return 1.0
        from scipy.special import chdtrc

        return float(chdtrc(self.degrees_of_freedom, max(self.chi2, 0.0)))

    @property
    def ratio(self) -> float:
        """Mean squared innovation: about 1 if the covariances are right, 0 where nothing is compared."""
        return self.chi2 / self.degrees_of_freedom if self.degrees_of_freedom else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """Squared normalised innovations of sources against each other, in two independent parts."""

    lasting: Innovation
    """Of the lasting errors that sources tell of each other: few numbers, in which an offset shows."""
    passing: Innovation
    """Of all that changes from window to window beyond these: many numbers, in which a variance shows."""

    @property
    def total(self) -> Innovation:
        """Both together."""
        return Innovation(
            chi2=self.lasting.chi2 + self.passing.chi2,
            degrees_of_freedom=self.lasting.degrees_of_freedom + self.passing.degrees_of_freedom,
        )

    def alarms(self, false_alarm: float) -> bool:
        """Tell whether there is more of it than chance makes.

        Args:
            false_alarm: Largest rate at which chance does.

        Returns:
            Whether either part is too large, the passing one by more than `VARIANCE_MARGIN`.
        """
        passing = Innovation(
            chi2=self.passing.chi2 / VARIANCE_MARGIN, degrees_of_freedom=self.passing.degrees_of_freedom
        )
        compared = [part for part in (self.lasting, passing) if part.degrees_of_freedom]
        # the parts are independent: each has the rate with which any of them is too large as often as is allowed
        rate = 1.0 - (1.0 - false_alarm) ** (1.0 / max(1, len(compared)))
        return any(part.probability < rate for part in compared)


def disagreement(sources: Sequence[WindowMeans]) -> Disagreement:
    """Fit torques and lasting errors to all windows at once, and sum up what is left.

    With `y_k = torque + lasting_k z_k + noise_k` and z of unit variance, the torques are eliminated window by window,
    which leaves the normal equations `(H + 1) z = g` of the few z. Along an eigenvector of H with eigenvalue h, g has
    the variance h (h + 1). Where h is above 1, sources say more of each other's lasting errors than was known of them
    before: there `g^2 / (h (h + 1))` is the squared innovation of a lasting error.

    Args:
        sources: Means of the sources over the same windows.

    Returns:
        What they have against each other; nothing for a single source.
    """
    known = np.array([np.isfinite(source.torque) for source in sources])
    count = int(known.sum() - known.any(axis=0).sum())
    if not count:
        nothing = Innovation(chi2=0.0, degrees_of_freedom=0)
        return Disagreement(lasting=nothing, passing=nothing)
    weights = [precisions(source.torque, source.noise) for source in sources]
    ends = np.cumsum([1, *(source.lasting.shape[2] for source in sources)])
    # the torque of every source in the first column, what lasts in columns of its own: one elimination for both
    columns = np.zeros((len(sources), *known.shape[1:], ends[-1]))
    for k, source in enumerate(sources):
        columns[k, :, :, 0] = np.nan_to_num(source.torque)
        columns[k, :, :, ends[k] : ends[k + 1]] = source.lasting
    weighted = np.stack(weights) @ columns
    together = weighted.sum(axis=0)
    covariance = inverse_of_known(np.sum(weights, axis=0), np.logical_not(known.any(axis=0)))
    square = np.einsum("swji,swjk->ik", columns, weighted, optimize=True)
    square -= np.einsum("wji,wjk->ik", together, covariance @ together, optimize=True)
    values, vectors = np.linalg.eigh(square[1:, 1:])
    gradient = vectors.T @ square[1:, 0]
    sure = values > 1.0
    lasting = gradient[sure] ** 2 / (values[sure] * (values[sure] + 1.0))
    explained = np.sum(gradient[sure] ** 2 / values[sure]) + np.sum(gradient[~sure] ** 2 / (values[~sure] + 1.0))
    number = int(np.count_nonzero(sure))
    return Disagreement(
        lasting=Innovation(chi2=float(lasting.sum()), degrees_of_freedom=number),
        passing=Innovation(chi2=float(square[0, 0] - explained), degrees_of_freedom=count - number),
    )
