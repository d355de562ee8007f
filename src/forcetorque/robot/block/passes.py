# SPDX-License-Identifier: BSD-3-Clause
"""The passes of the Newton-Euler recursion over the lanes of one block.

The motion of a body is nine rows (angular velocity, angular acceleration, proper acceleration), a
wrench six (force, moment). A joint is `parent_R_joint @ Rz(q)`, or a slide by q along that z. The
formulas are those of `robot.kinematics` and `robot.newton_euler`.
"""

from numba import njit

from forcetorque.robot.block.lanes import (
    FORMULA,
    LANES,
    PASS,
    STRIDE,
    add,
    as_columns,
    as_rows,
    as_vector,
    cross,
    get,
    put,
    rotate,
    scale,
    subtract,
    swing,
    turn_z,
)
from forcetorque.robot.block.sincos import cosine_sine


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
