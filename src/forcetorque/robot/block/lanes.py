# SPDX-License-Identifier: BSD-3-Clause
"""Rows of lanes: the size of a block, and 3-vectors that live in three rows.

Vectors are tuples, which the compiler turns into registers. Both sizes are literals because
compiled code is kept on disk under the text of its source, not under the values of its globals.
"""

from typing import Any

from numba import njit

LANES = 96
"""Samples of a block: its rows stay in the second-level cache."""
STRIDE = LANES + 4
"""Numbers from one row to the next; not a power of two, or all rows would fall on the same cache sets."""

FORMULA: dict[str, Any] = {"inline": "always", "fastmath": {"contract", "nsz"}, "error_model": "numpy"}
"""Small formulas, put where they are called; multiply-adds may be fused, NaN stays NaN."""
DRIVER: dict[str, Any] = {"fastmath": {"contract", "nsz"}, "error_model": "numpy", "nogil": True}
"""What makes the arrays of a block and hands them to the passes."""
PASS: dict[str, Any] = DRIVER | {"_nrt": False}
"""Loops over the lanes of a block. They make no arrays, so that numba need not count references to rows."""


@njit(**FORMULA)
def add(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@njit(**FORMULA)
def subtract(a, b):
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@njit(**FORMULA)
def scale(c, a):
    """c a."""
    return c * a[0], c * a[1], c * a[2]


@njit(**FORMULA)
def cross(a, b):
    """a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@njit(**FORMULA)
def dot(a, b):
    """a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(**FORMULA)
def rotate(R, a):
    """R a, with R as three rows."""
    return dot(R[0], a), dot(R[1], a), dot(R[2], a)


@njit(**FORMULA)
def turn_z(c, s, a):
    """Rotate a about z by the angle with cosine c and sine s."""
    return c * a[0] - s * a[1], s * a[0] + c * a[1], a[2]


@njit(**FORMULA)
def swing(omega, alpha, r):
    """alpha x r + omega x (omega x r): acceleration at r beyond that at the origin."""
    return add(cross(alpha, r), subtract(scale(dot(omega, r), omega), scale(dot(omega, omega), r)))


@njit(**FORMULA)
def get(rows, row, k):
    """The 3-vector of lane k in three rows."""
    return rows[row * STRIDE + k], rows[(row + 1) * STRIDE + k], rows[(row + 2) * STRIDE + k]


@njit(**FORMULA)
def put(rows, row, k, a):
    """Set the 3-vector of lane k in three rows."""
    rows[row * STRIDE + k], rows[(row + 1) * STRIDE + k], rows[(row + 2) * STRIDE + k] = a


@njit(**FORMULA)
def as_rows(R):
    """A 3 x 3 array as three rows."""
    return (R[0, 0], R[0, 1], R[0, 2]), (R[1, 0], R[1, 1], R[1, 2]), (R[2, 0], R[2, 1], R[2, 2])


@njit(**FORMULA)
def as_columns(R):
    """The transpose of a 3 x 3 array as three rows."""
    return (R[0, 0], R[1, 0], R[2, 0]), (R[0, 1], R[1, 1], R[2, 1]), (R[0, 2], R[1, 2], R[2, 2])


@njit(**FORMULA)
def as_vector(a):
    """An array of three as a vector."""
    return a[0], a[1], a[2]
