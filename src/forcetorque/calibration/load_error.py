# SPDX-License-Identifier: BSD-3-Clause
"""What a calibration must not take for known: loads that were estimated together with the matrix."""

from __future__ import annotations

import numpy as np

from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.payload.identification.parameters import OF_LOAD, Kind, places
from forcetorque.payload.identification.solution import LoadSolution

_ROUNDING = 1e-12
"""Share of the largest variance below which a combination of loads is known exactly."""


def load_error_of(solution: LoadSolution) -> LoadError | None:
    """Tell by how much errors of estimated loads move the response of a sensor and its offsets.

    Args:
        solution: Loads that were estimated with a matrix that is known in part.

    Returns:
        The errors; None where no load was estimated, or the matrix was taken as exact.
    """
    listed = solution.guess.parameters
    loads = [k for k, one in enumerate(listed) if one.kind in OF_LOAD]
    loads = [k for k in loads if np.isfinite(solution.covariance[k, k])]
    if not loads or not places(listed, Kind.MATRIX):
        return None
    own = solution.covariance[np.ix_(loads, loads)]
    size = np.sqrt(np.diag(own))
    size[size == 0.0] = 1.0
    variance, directions = np.linalg.eigh(own / np.outer(size, size))
    uncertain = variance > _ROUNDING * variance.max(initial=0.0)
    # S^-1/2, in the directions in which loads are uncertain
    root = directions[:, uncertain] / np.sqrt(variance[uncertain]) / size[:, None]
    sessions = [name.name for name in solution.sessions]
    factor = np.zeros((6, 6 + len(sessions), root.shape[1]))
    for row in range(6):
        factor[row, :6] = solution.covariance[np.ix_(places(listed, Kind.MATRIX, row), loads)] @ root
        for number in range(len(sessions)):
            biases = places(listed, Kind.BIAS, number)
            if biases and np.isfinite(solution.covariance[biases[row], biases[row]]):
                factor[row, 6 + number] = solution.covariance[biases[row], loads] @ root
    return LoadError(sessions=tuple(sessions), factor=factor)
