# SPDX-License-Identifier: BSD-3-Clause
"""Judge candidates at loads that were not fitted.

What is judged where nothing touches has the loads of the limb's own weight and motion, as what is fitted has. A matrix
may be good there and read a push wrong. Where the true matrix is known, the error of pushes says so. Where it is not,
the generative fit of the same data predicts how far the truth may be from its own reading of a push; a candidate that
reads the push many of these standard deviations otherwise has left what prior and data tell together. Where loads are
fitted the prediction is narrow, but few of these errors count in the mean over all pushes; where they are not it is
as wide as the prior's, and a type that lets noise replace the prior there leaves it by far.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.push_error import pushes
from forcetorque.study.candidate import Candidate, GenerativeCandidate

FAR_SD: Final = 3.0
"""Standard deviations beyond which a candidate has left what prior and data tell together."""


def push_deviations(
    candidates: Sequence[Candidate | GenerativeCandidate], generative: Sequence[GenerativeCandidate]
) -> FloatArray:
    """Tell how far the candidates read pushes from what the generative fit of the same data reads.

    Args:
        candidates: The k candidates.
        generative: Generative fits.

    Returns:
        Per component, the root mean square difference over pushes, over that of the predicted error; shape (k, 6); 1;
        not a number where the data set has no generative fit.
    """
    fits = {fit.data_set: fit for fit in generative}
    sizes = {name: _predicted(fit) for name, fit in fits.items()}
    responses = {name: _response(fit) for name, fit in fits.items()}
    deviations: FloatArray = np.full((len(candidates), 6), np.nan)
    for k, candidate in enumerate(candidates):
        name = candidate.data_set
        if name in fits:
            change = pushes() @ (candidate.model.matrix @ responses[name] - np.eye(6)).T
            deviations[k] = np.sqrt((change**2).mean(axis=0)) / sizes[name]
    return deviations


def _predicted(fit: GenerativeCandidate) -> FloatArray:
    """Root mean square of the predicted error of pushes; shape (6,); N, N m."""
    variance = np.einsum("nii->i", fit.posterior.error_covariance(pushes())) / len(pushes())
    return np.asarray(np.sqrt(variance), dtype=np.float64)


def _response(fit: GenerativeCandidate) -> FloatArray:
    """Readings per load of the sensor that the fit believes in; shape (c, 6); counts/N, counts/(N m)."""
    if fit.posterior.space == "channel":
        return fit.posterior.mean[:, :6]
    return np.asarray(np.linalg.inv(fit.model.matrix), dtype=np.float64)
