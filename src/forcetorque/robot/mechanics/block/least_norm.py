# SPDX-License-Identifier: BSD-3-Clause
"""Least-squares, minimum-norm solution of the equation of a sub-model, one per lane.

One-sided Jacobi [1]: plane rotations make the six rows of C orthogonal to each other. Their lengths
are then the singular values, and the rotated right side holds its part along each of them. No
branch depends on a lane, so all lanes run together; a column of zeros, a contact that is not
there, gets the solution zero.

References:
    [1] M. R. Hestenes, Inversion of matrices by biorthogonalization, 1958.
"""

import math

from numba import njit

from forcetorque.robot.block.lanes import LANES, PASS, STRIDE

MOST_SWEEPS = 12
"""Six rows are orthogonal after five or six sweeps; the limit is for rounding that goes round in circles."""
ORTHOGONAL = 1e-13
"""The largest product that the last sweep found, relative to the whole. Equal singular values, such as those of a
wrench, do not converge quadratically: what was found may be left."""
RANK_TOLERANCE_SQUARED = 1e-18
"""Square of `reference.RANK_TOLERANCE`."""
TINY = 1e-300
"""Keeps a division of zero by zero at zero."""


@njit(**PASS)
def solve(columns, count, right, work, solution, rank, condition):
    """Solve; `columns` (count, 6 rows) and `right` (6 rows) are used up, `work` is (8, lanes) of scratch."""
    for _ in range(MOST_SWEEPS):
        largest = 0.0
        for i in range(5):
            for j in range(i + 1, 6):
                largest = max(largest, rotate_pair(columns, count, right, work, i, j))
        if largest < ORTHOGONAL:
            break
    sum_up(columns, count, right, work, solution, rank, condition)


@njit(**PASS)
def rotate_pair(columns, count, right, work, i, j):
    """Make rows i and j orthogonal; gives the largest product that they had, relative to their lengths."""
    a, b, g, product = work[0], work[1], work[2], work[3]
    a[:], b[:], g[:] = TINY, TINY, 0.0
    for u in range(count):
        x, y = columns[u, i * STRIDE : (i + 1) * STRIDE], columns[u, j * STRIDE : (j + 1) * STRIDE]
        for k in range(LANES):
            a[k] += x[k] * x[k]
            b[k] += y[k] * y[k]
            g[k] += x[k] * y[k]
    for k in range(LANES):
        d = b[k] - a[k]
        root = math.sqrt(d * d + 4.0 * g[k] * g[k])
        t = (2.0 * g[k] if d >= 0.0 else -2.0 * g[k]) / (abs(d) + root + TINY)
        product[k] = abs(g[k]) / (a[k] + b[k])
        a[k] = 1.0 / math.sqrt(1.0 + t * t)
        b[k] = a[k] * t
    for u in range(count):
        turn_rows(columns[u, i * STRIDE : (i + 1) * STRIDE], columns[u, j * STRIDE : (j + 1) * STRIDE], a, b)
    turn_rows(right[i * STRIDE : (i + 1) * STRIDE], right[j * STRIDE : (j + 1) * STRIDE], a, b)
    largest = 0.0
    for k in range(LANES):  # NaN is not larger: a sample with a gap does not keep the others busy
        if product[k] > largest:
            largest = product[k]
    return largest


@njit(**PASS)
def turn_rows(x, y, c, s):
    """Rotate two rows in their plane."""
    for k in range(LANES):
        x[k], y[k] = c[k] * x[k] - s[k] * y[k], s[k] * x[k] + c[k] * y[k]


@njit(**PASS)
def sum_up(columns, count, right, work, solution, rank, condition):
    """Add up the part of the solution along every row that counts."""
    most, least = work[6], work[7]
    most[:] = 0.0
    for i in range(6):
        length = work[i]
        length[:] = 0.0
        for u in range(count):
            x = columns[u, i * STRIDE : (i + 1) * STRIDE]
            for k in range(LANES):
                length[k] += x[k] * x[k]
        for k in range(LANES):
            most[k] = length[k] if length[k] > most[k] else most[k]
    solution[:count] = 0.0
    rank[:] = 0.0
    for k in range(LANES):
        least[k] = most[k]
    for i in range(6):
        length, b = work[i], right[i * STRIDE : (i + 1) * STRIDE]
        for k in range(LANES):
            counts = length[k] > RANK_TOLERANCE_SQUARED * most[k]
            least[k] = length[k] if counts and length[k] < least[k] else least[k]
            rank[k] += 1.0 if counts else 0.0
            # a gap in the sample makes its solution one, even where nothing is determined
            b[k] = (b[k] / length[k] if counts else 0.0) + 0.0 * (b[k] + length[k])
        for u in range(count):
            x, y = columns[u, i * STRIDE : (i + 1) * STRIDE], solution[u]
            for k in range(LANES):
                y[k] += b[k] * x[k]
    for k in range(LANES):
        condition[k] = math.sqrt(most[k] / least[k])
