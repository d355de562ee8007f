# SPDX-License-Identifier: BSD-3-Clause
"""The passes of the Newton-Euler recursion over the lanes of one block, and vectors and angles in lanes.

A 3-vector lives in three rows of lanes; in formulas it is a tuple, which the compiler turns into registers. The motion
of a body is nine rows (angular velocity, angular acceleration, proper acceleration), a wrench six (force, moment). A
joint is `parent_R_joint @ Rz(q)`, or a slide by q along that z. The formulas are those of `robot.dynamics`.

Sizes are literals because compiled code is kept on disk under the text of its source, not under the values of its
globals.

References:
    [1] W. J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980.
    [2] fdlibm, k_sin.c and k_cos.c, Sun Microsystems, 1993 (freely granted).
"""

from __future__ import annotations

from typing import Any

import numpy as np
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


@njit(**FORMULA)
def cosine_sine(x):
    """Cosine and sine of x."""
    # no branch and no call, so that loops over lanes stay vectorised: the angle is reduced to a quarter turn with pi/2
    # in three parts [1]; the rest are the polynomials of fdlibm for |r| <= pi/4 [2]; one unit in the last place up to
    # |x| = 1e6
    # math.floor would give an integer, for which there is no vector instruction before AVX-512
    quarters = np.floor(x * 0.6366197723675814 + 0.5)
    r = x - quarters * 1.5707963267341256
    r = r - quarters * 6.077100506303966e-11
    r = r - quarters * 2.0222662487959506e-21
    z = r * r
    s = 1.58969099521155010221e-10
    s = -2.50507602534068634195e-08 + z * s
    s = 2.75573137070700676789e-06 + z * s
    s = -1.98412698298579493134e-04 + z * s
    s = 8.33333333332248946124e-03 + z * s
    s = r + r * z * (-1.66666666666666324348e-01 + z * s)
    c = -1.13596475577881948265e-11
    c = 2.08757232129817482790e-09 + z * c
    c = -2.75573143513906633035e-07 + z * c
    c = 2.48015872894767294178e-05 + z * c
    c = -1.38888888888741095749e-03 + z * c
    c = 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * c)
    quarter = quarters - 4.0 * np.floor(quarters * 0.25)
    odd = (quarter == 1.0) | (quarter == 3.0)
    cosine = s if odd else c
    sine = c if odd else s
    return (
        -cosine if (quarter == 1.0) | (quarter == 2.0) else cosine,
        -sine if quarter >= 2.0 else sine,
    )


@njit(**PASS)
def load(values, first, count, columns, rows):
    """Turn samples into lanes: row j of the block is a column of the input."""
    for k in range(count):
        for j in range(len(columns)):
            rows[j * STRIDE + k] = values[first + k, columns[j]]


@njit(**PASS)
def load_vector(values, first, count, rows, row):
    """Turn 3-vectors into lanes; one sample is taken for all."""
    step = 0 if len(values) == 1 else 1
    for k in range(count):
        i = (first + k) * step
        put(rows, row, k, (values[i, 0], values[i, 1], values[i, 2]))


@njit(**PASS)
def store(rows, count, values, first, column, width):
    """Turn lanes back into samples."""
    for k in range(count):
        for j in range(width):
            values[first + k, column + j] = rows[j * STRIDE + k]


@njit(**PASS)
def follow(row, multiplier, offset):
    """Turn the coordinate of a leader into that of a joint that mimics it."""
    for k in range(LANES):
        row[k] = multiplier * row[k] + offset


@njit(**PASS)
def gaps(rows, count, marks):
    """Add zero to the marks where all rows are finite, NaN elsewhere."""
    for j in range(count):
        for k in range(LANES):
            marks[k] += rows[j * STRIDE + k] - rows[j * STRIDE + k]


@njit(**PASS)
def angles(q, cosine, sine):
    """Cosine and sine of an angle; in a loop of its own, whose short bodies overlap in the processor."""
    for k in range(LANES):
        cosine[k], sine[k] = cosine_sine(q[k])


@njit(**PASS)
def move_rotary(parent, body, dq, ddq, cosine, sine, R, p):
    """Carry the motion of the parent across a rotary joint."""
    back, r = as_columns(R), as_vector(p)
    for k in range(LANES):
        omega, alpha, c, s = get(parent, 0, k), get(parent, 3, k), cosine[k], sine[k]
        put(body, 6, k, turn_z(c, -s, rotate(back, add(get(parent, 6, k), swing(omega, alpha, r)))))
        omega, alpha = turn_z(c, -s, rotate(back, omega)), turn_z(c, -s, rotate(back, alpha))
        put(body, 0, k, (omega[0], omega[1], omega[2] + dq[k]))
        put(body, 3, k, (alpha[0] + dq[k] * omega[1], alpha[1] - dq[k] * omega[0], alpha[2] + ddq[k]))


@njit(**PASS)
def move_prismatic(parent, body, q, dq, ddq, R, p):
    """Carry the motion of the parent across a prismatic joint."""
    back, origin, z = as_columns(R), as_vector(p), (R[0, 2], R[1, 2], R[2, 2])
    for k in range(LANES):
        omega, alpha, r = get(parent, 0, k), get(parent, 3, k), add(origin, scale(q[k], z))
        a = rotate(back, add(get(parent, 6, k), swing(omega, alpha, r)))
        omega = rotate(back, omega)
        put(body, 0, k, omega)
        put(body, 3, k, rotate(back, alpha))
        put(body, 6, k, (a[0] + 2.0 * dq[k] * omega[1], a[1] - 2.0 * dq[k] * omega[0], a[2] + ddq[k]))


@njit(**PASS)
def net_wrench(motion, wrench, mass, first_moment, second_moment):
    """Wrench that makes a body move as it does."""
    c, tensor = as_vector(first_moment), as_rows(second_moment)
    for k in range(LANES):
        omega, alpha, a = get(motion, 0, k), get(motion, 3, k), get(motion, 6, k)
        put(wrench, 0, k, add(scale(mass, a), swing(omega, alpha, c)))
        put(wrench, 3, k, add(rotate(tensor, alpha), add(cross(omega, rotate(tensor, omega)), cross(c, a))))


@njit(**FORMULA)
def inwards(forth, r, c, s, force, moment):
    """A wrench in a body's frame, in its parent's."""
    there = rotate(forth, turn_z(c, s, force))
    return there, add(rotate(forth, turn_z(c, s, moment)), cross(r, there))


@njit(**PASS)
def add_inwards(wrench, parent, q, cosine, sine, R, p, slides):
    """Add a body's wrench to its parent's."""
    forth, origin, z = as_rows(R), as_vector(p), (R[0, 2], R[1, 2], R[2, 2])
    for k in range(LANES):
        r = add(origin, scale(q[k], z)) if slides else origin
        force, moment = inwards(forth, r, cosine[k], sine[k], get(wrench, 0, k), get(wrench, 3, k))
        put(parent, 0, k, add(get(parent, 0, k), force))
        put(parent, 3, k, add(get(parent, 3, k), moment))


@njit(**PASS)
def carry_inwards(wrench, q, cosine, sine, R, p, slides):
    """Express a wrench in a body's frame in its parent's, in place."""
    forth, origin, z = as_rows(R), as_vector(p), (R[0, 2], R[1, 2], R[2, 2])
    for k in range(LANES):
        r = add(origin, scale(q[k], z)) if slides else origin
        force, moment = inwards(forth, r, cosine[k], sine[k], get(wrench, 0, k), get(wrench, 3, k))
        put(wrench, 0, k, force)
        put(wrench, 3, k, moment)


@njit(**PASS)
def take_outwards(wrench, body, q, cosine, sine, R, p, slides):
    """Express a wrench in a parent's frame in that of a body that hangs on it, in place, and take it off the body's."""
    back, origin, z = as_columns(R), as_vector(p), (R[0, 2], R[1, 2], R[2, 2])
    for k in range(LANES):
        r = add(origin, scale(q[k], z)) if slides else origin
        force = get(wrench, 0, k)
        moment = turn_z(cosine[k], -sine[k], rotate(back, subtract(get(wrench, 3, k), cross(r, force))))
        force = turn_z(cosine[k], -sine[k], rotate(back, force))
        put(wrench, 0, k, force)
        put(wrench, 3, k, moment)
        put(body, 0, k, subtract(get(body, 0, k), force))
        put(body, 3, k, subtract(get(body, 3, k), moment))


@njit(**PASS)
def from_frame(wrench, R, p, sign):
    """Express a wrench in a frame of a body in the body's frame, in place, times a sign."""
    forth, r = as_rows(R), as_vector(p)
    for k in range(LANES):
        force = scale(sign, rotate(forth, get(wrench, 0, k)))
        moment = add(scale(sign, rotate(forth, get(wrench, 3, k))), cross(r, force))
        put(wrench, 0, k, force)
        put(wrench, 3, k, moment)


@njit(**PASS)
def to_frame(wrench, R, p, sign):
    """Express a wrench in a body's frame in a frame of that body, in place, times a sign."""
    back, r = as_columns(R), as_vector(p)
    for k in range(LANES):
        force = get(wrench, 0, k)
        moment = subtract(get(wrench, 3, k), cross(r, force))
        put(wrench, 0, k, scale(sign, rotate(back, force)))
        put(wrench, 3, k, scale(sign, rotate(back, moment)))


@njit(**PASS)
def point_inwards(point, q, cosine, sine, R, p, slides):
    """Express a point in a body's frame in its parent's, in place."""
    forth, origin, z = as_rows(R), as_vector(p), (R[0, 2], R[1, 2], R[2, 2])
    for k in range(LANES):
        r = add(origin, scale(q[k], z)) if slides else origin
        put(point, 0, k, add(r, rotate(forth, turn_z(cosine[k], sine[k], get(point, 0, k)))))


@njit(**PASS)
def copy(a, b):
    """b = a, for any number of rows."""
    for i in range(len(a)):
        b[i] = a[i]


@njit(**PASS)
def add_to(a, b):
    """b += a, for six rows."""
    for i in range(6 * STRIDE):
        b[i] += a[i]


@njit(**PASS)
def difference(a, b, c):
    """c = a - b, for six rows."""
    for i in range(6 * STRIDE):
        c[i] = a[i] - b[i]


@njit(**PASS)
def take_from(a, b):
    """b -= a, for six rows."""
    for i in range(6 * STRIDE):
        b[i] -= a[i]
