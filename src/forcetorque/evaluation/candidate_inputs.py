# SPDX-License-Identifier: BSD-3-Clause
"""Candidates and samples whose errors are summed: checked, and centred so that no digits cancel."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CandidateInputs:
    """k candidates and n samples of c channels and v variables; m columns are channels, then variables.

    With the centre taken off the samples, the error of a candidate is matrix columns + constant -
    reference. Offsets of 24 000 counts enter it only through the constant, and cost no digits.
    """

    raw: FloatArray
    """Raw readings; shape (n, c); counts."""
    variables: FloatArray
    """Extra variables; shape (n, v)."""
    reference: FloatArray
    """Reference wrenches; shape (n, 6); N, N m."""
    columns_centre: FloatArray
    """Mean of every column; shape (m,)."""
    reference_centre: FloatArray
    """Mean reference wrench; shape (6,); N, N m."""
    matrices: FloatArray
    """Matrices and coefficients side by side; shape (k, 6, m)."""
    constants: FloatArray
    """Error at the centre; shape (k, 6); N, N m."""
    blocks: tuple[slice, ...]
    """Contiguous stretches of samples, as equal as can be."""

    def centred(self, samples: slice) -> tuple[FloatArray, FloatArray]:
        """Take the centre off some samples.

        Args:
            samples: Which.

        Returns:
            Columns, shape (m, samples), and reference, shape (6, samples).
        """
        columns = np.concatenate([self.raw[samples], self.variables[samples]], axis=1) - self.columns_centre
        return columns.T, (self.reference[samples] - self.reference_centre).T


def checked_candidates(
    raw: Any, reference: Any, matrices: Any, offsets: Any, *, variables: Any, coefficients: Any, blocks: int
) -> CandidateInputs:
    """Check candidates and samples; the arguments are those of `candidate_errors`.

    Args:
        raw: Raw readings.
        reference: Reference wrenches.
        matrices: Matrices.
        offsets: Offsets.
        variables: Extra variables, or None.
        coefficients: Their coefficients, or None.
        blocks: Number of blocks; there are fewer if there are fewer samples.

    Returns:
        Candidates and samples.

    Raises:
        ShapeError: If the shapes do not fit each other, nothing is there to judge, or a value is not finite.
    """
    if (variables is None) != (coefficients is None):
        raise ShapeError("expected variables and their coefficients, or neither, got one of the two")
    r, C = _finite(raw, "raw", (None, None)), _finite(matrices, "matrices", (None, 6, None))
    n, channels, k = *r.shape, len(C)
    if not n or not channels or not k or blocks < 1:
        raise ShapeError(
            "expected at least one sample, channel, candidate and block, got "
            f"{n} samples of {channels} channels, {k} candidates and {blocks} blocks"
        )
    require_shape(C, name="matrices", shape=(k, 6, channels))
    v = _finite(np.empty((n, 0)) if variables is None else variables, "variables", (n, None))
    c = _finite(np.empty((k, 6, 0)) if coefficients is None else coefficients, "coefficients", (k, 6, v.shape[1]))
    f, o = _finite(reference, "reference", (n, 6)), _finite(offsets, "offsets", (k, 6))
    columns_centre, reference_centre = np.append(r.mean(axis=0), v.mean(axis=0)), f.mean(axis=0)
    matrices = np.concatenate([C, c], axis=2)
    # hundreds of newtons cancel here, for all samples alike: extended precision where there is one
    constants = matrices.astype(np.longdouble) @ columns_centre + o - reference_centre
    return CandidateInputs(
        raw=r,
        variables=v,
        reference=f,
        columns_centre=columns_centre,
        reference_centre=reference_centre,
        matrices=matrices,
        constants=constants.astype(np.float64),
        blocks=_contiguous(n, min(blocks, n)),
    )


def _finite(values: Any, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    array: FloatArray = np.asarray(values, dtype=np.float64)
    require_shape(array, name=name, shape=shape)
    if not np.isfinite(array).all():
        first = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ShapeError(f"{name}: expected finite values only, got {array[first]} at {first}; leave out gaps")
    return array


def _contiguous(n: int, blocks: int) -> tuple[slice, ...]:
    """Divide samples as `numpy.array_split` does."""
    shortest, longer = divmod(n, blocks)
    return tuple(slice(*ends) for ends in pairwise(b * shortest + min(b, longer) for b in range(blocks + 1)))
