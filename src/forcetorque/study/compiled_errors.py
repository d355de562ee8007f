# SPDX-License-Identifier: BSD-3-Clause
"""Sums of the errors of candidates over samples: the function that is compiled and kept on disk.

A block is LANES samples, turned so that every channel, variable and reference component is a row with
one lane per sample. All candidates meet a block while it is in the first-level cache, and the loop
over lanes does the same arithmetic on neighbouring numbers, so it becomes vector instructions. The
errors are summed up in registers and never stored.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numba import njit

from forcetorque.base.compiled_functions import source_digest

# literals, because compiled code is kept on disk under the text of its source
LANES = 256
"""Samples of a block: long against the cost of starting a loop, with twelve rows in the first-level cache."""
STRIDE = LANES + 4
"""Numbers from one row to the next; not a power of two, or all rows would fall on the same cache sets."""

_MATHS: dict[str, Any] = {"fastmath": {"contract", "nsz", "reassoc"}, "error_model": "numpy"}
"""Multiply-adds may be fused, and sums taken in another order, without which they are not vectorised."""
_FORMULA: dict[str, Any] = _MATHS | {"inline": "always"}


@njit(**_FORMULA)
def load(raw, variables, reference, columns_centre, reference_centre, first, count, rows):
    """Turn samples into lanes, less the centre."""
    channels, extra = raw.shape[1], variables.shape[1]
    for k in range(count):
        for j in range(channels):
            rows[j * STRIDE + k] = raw[first + k, j] - columns_centre[j]
        for j in range(extra):
            rows[(channels + j) * STRIDE + k] = variables[first + k, j] - columns_centre[channels + j]
        for j in range(6):
            rows[(channels + extra + j) * STRIDE + k] = reference[first + k, j] - reference_centre[j]


@njit(**_FORMULA)
def component(columns, matrix, constant, i, rows, k):
    """Component i of the error of one candidate in lane k."""
    error = constant[i] - rows[(columns + i) * STRIDE + k]
    for j in range(columns):
        error += matrix[i, j] * rows[j * STRIDE + k]
    return error


@njit(**_FORMULA)
def add_errors(columns, rows, count, matrices, constants, sums):
    """Add up the errors of all candidates in a block: forces, then moments, which leaves enough registers."""
    for candidate in range(len(matrices)):
        matrix, constant = matrices[candidate], constants[candidate]
        for half in range(2):
            i = 3 * half
            sum_x, sum_y, sum_z, sum_norm = 0.0, 0.0, 0.0, 0.0
            for k in range(count):
                x = component(columns, matrix, constant, i, rows, k)
                y = component(columns, matrix, constant, i + 1, rows, k)
                z = component(columns, matrix, constant, i + 2, rows, k)
                sum_x += abs(x)
                sum_y += abs(y)
                sum_z += abs(z)
                sum_norm += np.sqrt(x * x + y * y + z * z)
            sums[candidate, i] += sum_x
            sums[candidate, i + 1] += sum_y
            sums[candidate, i + 2] += sum_z
            sums[candidate, 6 + half] += sum_norm


@cache
def compiled_error_sums(columns: int) -> Callable[..., None]:
    """Give the compiled sums for so many columns; the first machine to call it compiles it.

    The number is part of the code, so that the loop over columns is unrolled.

    Args:
        columns: Number of channels and variables.

    Returns:
        A function of samples, their centre, candidates, and the sums that it adds to, shape (k, 8).
    """
    source = source_digest(Path(__file__))

    @njit(cache=True, nogil=True, **_MATHS)
    def sum_errors(raw, variables, reference, columns_centre, reference_centre, matrices, constants, sums):
        source  # noqa: B018 - closed over: a change in this file compiles it anew
        rows = np.empty((columns + 6) * STRIDE)
        for first in range(0, len(raw), LANES):
            count = min(LANES, len(raw) - first)
            load(raw, variables, reference, columns_centre, reference_centre, first, count, rows)
            add_errors(columns, rows, count, matrices, constants, sums)

    return sum_errors
