# SPDX-License-Identifier: BSD-3-Clause
"""What the matrix of a workbench makes of a true wrench once the sensor is mounted: `(1 + E)` times it."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FormatError


def matrix_error(workbench: FloatArray, mounted: FloatArray) -> FloatArray:
    """Give E of `read = (1 + E) true`.

    Args:
        workbench: Matrix that readings are made with; shape (6, 6); N/count, N m/count.
        mounted: True matrix; shape (6, 6); N/count, N m/count.

    Returns:
        E, force before moment; shape (6, 6); 1, 1/m above on the right, m below on the left.
    """
    error: FloatArray = workbench @ np.linalg.inv(mounted) - np.eye(6)
    return error


def random_matrix_error(share: float, lever_m: float, rng: np.random.Generator) -> FloatArray:
    """Draw an error of a size that is stated.

    Args:
        share: Root mean square of its coefficients, moments over the lever taken for forces.
        lever_m: Moment over force; m.
        rng: Source of the error; the same draw whatever the size.

    Returns:
        E; shape (6, 6); 1, 1/m above on the right, m below on the left.
    """
    drawn = rng.standard_normal((6, 6))
    size = np.repeat([1.0, lever_m], 3)
    error: FloatArray = share / np.sqrt((drawn**2).mean()) * drawn * size[:, None] / size
    return error


def mounted_matrix(where: str, workbench: FloatArray, error: FloatArray) -> FloatArray:
    """Give the true matrix of a sensor whose workbench matrix has an error.

    The matrix that moves is the mounted one: mounting is what changes a sensor, while the workbench matrix stays one
    that scatters like those of real sensors. Counts follow, since `mounted^-1 = workbench^-1 (1 + E)`.

    Args:
        where: What asks for the error, for messages.
        workbench: Matrix that readings are made with; shape (6, 6); N/count, N m/count.
        error: E of `read = (1 + E) true`; shape (6, 6).

    Returns:
        The true matrix; shape (6, 6); N/count, N m/count.

    Raises:
        FormatError: If no mounting can do so much.
    """
    # between no error and this one the sensor is singular somewhere if a real eigenvalue reaches -1
    values = np.linalg.eigvals(error)
    if ((values.imag == 0.0) & (values.real <= -1.0)).any():
        raise FormatError(
            f"{where}, with which a load would be read with the wrong sign; ask for less, or draw another sensor with "
            "another seed"
        )
    return np.asarray(np.linalg.solve(np.eye(6) + error, workbench), dtype=np.float64)
