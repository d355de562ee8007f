# SPDX-License-Identifier: BSD-3-Clause
"""From a calibration matrix to the fixed-point coefficients and full scales of the sensor's DSP.

The arithmetic is that of exact fractions: whether a code fits is decided at ties, where the
rounding of floats would choose.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from forcetorque.arrays import read_only
from forcetorque.errors import FormatError
from forcetorque.exchange.icub.matrix_file import (
    FULL_SCALE_COUNTS,
    LARGEST_FULL_SCALE,
    Q15_ONE,
    MatrixFile,
    checked_full_scale,
)
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


def encode_matrix(matrix: Any, *, full_scale: Sequence[int] | None = None) -> MatrixFile:
    """Encode a calibration matrix for the sensor's DSP, in the layout of the factory's files.

    Each coefficient is encoded against the integer full scale that is stored, so that decoding gives
    it back within half a least significant bit, `full_scale / 32767 / 2^16`.

    Without `full_scale`, row i gets `ceil(32767 * sum_j |C_ij|)`, as the factory's files have it: the
    largest value that raw counts within 32767 can give, so that the DSP's sum stays in range up to the
    rounding of codes. A smaller one may be given if every coefficient fits; large wrenches can then saturate.

    Args:
        matrix: Calibration matrix, rows fx to tz, columns raw channels; shape (6, 6); N/count, N m/count.
        full_scale: Full scales to use for fx, fy, fz, tx, ty, tz instead; N, N m.

    Returns:
        The content of the matrix file.

    Raises:
        FormatError: If the matrix is not finite, or if a coefficient does not fit the full scale.
    """
    values = read_only(matrix, name="matrix", shape=(6, 6))
    if not np.isfinite(values).all():
        row, column = np.argwhere(~np.isfinite(values))[0]
        raise FormatError(f"matrix[{row}, {column}]: expected a finite coefficient, got {values[row, column]}")
    coefficients = [[Fraction(value) for value in row] for row in values.tolist()]
    if full_scale is None:
        scales = tuple(_natural_full_scale(row, index=index) for index, row in enumerate(coefficients))
    else:
        scales = checked_full_scale(full_scale)
        for index, (row, scale) in enumerate(zip(coefficients, scales, strict=True)):
            _require_fit(row, scale, index=index)
    codes = [[_code(value, scale) for value in row] for row, scale in zip(coefficients, scales, strict=True)]
    return MatrixFile(codes=np.array(codes, dtype=np.int64), full_scale=scales)


def _code(coefficient: Fraction, full_scale: int) -> int:
    return round(coefficient * FULL_SCALE_COUNTS * Q15_ONE / full_scale)


def _natural_full_scale(row: list[Fraction], *, index: int) -> int:
    ceiling = math.ceil(FULL_SCALE_COUNTS * sum(abs(value) for value in row))
    # A row with one positive coefficient can have it at exactly 1 in parts of the full scale, which is
    # code 32768, one beyond what Q1.15 holds: such a row needs a full scale slightly above its ceiling.
    scale = max(1, ceiling, *(_smallest_full_scale(value) for value in row))
    if scale > LARGEST_FULL_SCALE:
        raise FormatError(
            f"matrix row {index} ({WRENCH_COMPONENTS[index]}): expected coefficients whose full scale is at most "
            f"{LARGEST_FULL_SCALE} {WRENCH_UNITS[index]}, got {_listed(row)}; "
            f"check that they are in {WRENCH_UNITS[index]} per raw count"
        )
    return scale


def _smallest_full_scale(coefficient: Fraction) -> int:
    """Smallest integer full scale with which a coefficient rounds to a code of Q1.15."""
    product = abs(coefficient) * FULL_SCALE_COUNTS * Q15_ONE
    if coefficient > 0:
        # Ties round to the even 32768, which does not fit: product / scale must be below 32767.5.
        return math.floor(product / (Q15_ONE - Fraction(1, 2))) + 1
    # Ties round to the even -32768, which fits.
    return max(1, math.ceil(product / (Q15_ONE + Fraction(1, 2))))


def _require_fit(row: list[Fraction], full_scale: int, *, index: int) -> None:
    smallest = [_smallest_full_scale(value) for value in row]
    if max(smallest) <= full_scale:
        return
    column = smallest.index(max(smallest))
    remedy = (
        f"the smallest full scale that holds it is {max(smallest)}"
        if max(smallest) <= LARGEST_FULL_SCALE
        else f"no full scale up to {LARGEST_FULL_SCALE} holds it; check the units"
    )
    raise FormatError(
        f"matrix[{index}, {column}] ({WRENCH_COMPONENTS[index]}): expected a coefficient within [-1, 1) in parts of "
        f"the full scale {full_scale} per {FULL_SCALE_COUNTS} counts, got {float(row[column])!r}; {remedy}"
    )


def _listed(row: list[Fraction]) -> str:
    return ", ".join(f"{float(value):.6g}" for value in row)
