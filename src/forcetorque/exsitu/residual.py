# SPDX-License-Identifier: BSD-3-Clause
"""What a line through all positions leaves of readings, each position counted by what it is worth.

    reading_p = (1 + E) load_p + offset + s_p        cov(s_p) = scatter of the position, a 6 x 6 matrix

E and offset are free. What they can explain is no evidence of anything; the rest is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import SensorError

_RANK = 1e-9
"""Share of the largest singular value below which a column of the design explains nothing by itself."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ResidualSpace:
    """Readings of n positions without what a line explains."""

    precision: FloatArray
    """G = S^-1 - S^-1 X (X' S^-1 X)^-1 X' S^-1 for design X and scatter S; shape (n, 6, n, 6)."""

    @classmethod
    def of(cls, loads: FloatArray, scatter: FloatArray, known_faults: FloatArray | None = None) -> ResidualSpace:
        """Set up the space.

        Args:
            loads: Loads; shape (n, 6); N, N m.
            scatter: Covariance of every position; shape (n, 6, 6).
            known_faults: Columns that are explained besides; shape (6 n, k).

        Returns:
            The space.

        Raises:
            SensorError: If a scatter is none.
        """
        n = len(loads)
        require_shape(scatter, name="scatter", shape=(n, 6, 6))
        try:
            roots = np.linalg.inv(np.linalg.cholesky(scatter))  # S^-1 = roots' roots
        except np.linalg.LinAlgError as error:
            raise SensorError("scatter: expected covariances of positions, all above 0") from error
        columns = design_columns(loads)
        if known_faults is not None:
            columns = np.hstack([columns, known_faults])
        white = np.einsum("pij,pjk->pik", roots, columns.reshape(n, 6, -1)).reshape(6 * n, -1)
        sizes = np.linalg.norm(white, axis=0)
        left, strengths, _ = np.linalg.svd(white / np.where(sizes > 0.0, sizes, 1.0), full_matrices=False)
        explained = left[:, strengths > _RANK * strengths[0]]
        kept = (np.eye(6 * n) - explained @ explained.T).reshape(n, 6, n, 6)
        return cls(precision=np.einsum("pki,pkql,qlj->piqj", roots, kept, roots, optimize=True))

    @property
    def own(self) -> FloatArray:
        """Blocks of the precision of every position with itself; shape (n, 6, 6)."""
        own: FloatArray = np.einsum("pipj->pij", self.precision)
        return own

    def weighed(self, residual: FloatArray) -> FloatArray:
        """Multiply readings by the precision.

        Args:
            residual: Readings less loads of sensors; shape (s, n, 6).

        Returns:
            What is left of them, weighed; shape (s, n, 6).
        """
        n = len(self.precision)
        flat = residual.reshape(len(residual), 6 * n) @ self.precision.reshape(6 * n, 6 * n)
        weighed: FloatArray = flat.reshape(residual.shape)
        return weighed

    def distances(self, weighed: FloatArray) -> FloatArray:
        """Say how far positions are from what all others say of them.

        Args:
            weighed: As of `weighed`; shape (s, n, 6).

        Returns:
            Squared distances, chi-squared of 6 for the stated scatter; shape (s, n).
        """
        inverse = np.linalg.pinv(self.own, rcond=_RANK, hermitian=True)
        squares: FloatArray = np.einsum("spi,pij,spj->sp", weighed, inverse, weighed)
        return squares


def design_columns(loads: FloatArray) -> FloatArray:
    """Give what E and an offset do to the readings of all positions.

    Args:
        loads: Loads; shape (n, 6); N, N m.

    Returns:
        A column per coefficient, position by position; shape (6 n, 42).
    """
    with_one = np.hstack([loads, np.ones((len(loads), 1))])
    columns: FloatArray = np.einsum("pk,ij->pikj", with_one, np.eye(6)).reshape(6 * len(loads), 42)
    return columns
