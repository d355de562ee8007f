# SPDX-License-Identifier: BSD-3-Clause
"""The stages of an estimation for one block, in the order of the equations of thesis 2.4.

The equation of a sub-model gets its least-squares, minimum-norm solution per lane by one-sided Jacobi [1]: plane
rotations make the six rows of C orthogonal to each other. Their lengths are then the singular values, and the rotated
right side holds its component along each of them. No branch depends on a lane, so all lanes run together; a column of
zeros, a contact that is not there, gets the solution zero.

References:
    [1] M. R. Hestenes, Inversion of matrices by biorthogonalization, 1958.
"""

from __future__ import annotations

import math

from numba import njit

from forcetorque.robot.compiled.recursion_and_vectors import (
    FORMULA,
    LANES,
    PASS,
    STRIDE,
    add_inwards,
    add_to,
    angles,
    carry_inwards,
    copy,
    difference,
    follow,
    from_frame,
    gaps,
    load,
    load_vector,
    move_prismatic,
    move_rotary,
    net_wrench,
    point_inwards,
    store,
    take_from,
    take_outwards,
    to_frame,
)

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


@njit(**PASS)
def read_motion(bodies, work, columns, motion, root, first, count):
    """Load joints and root."""
    load(motion[0], first, count, columns, work.q.reshape(-1))
    load(motion[1], first, count, columns, work.dq.reshape(-1))
    load(motion[2], first, count, columns, work.ddq.reshape(-1))
    for j in range(3):
        load_vector(root[j], first, count, work.motion[0], 3 * j)
    work.gap[:] = 0.0
    for c in range(len(columns)):
        if bodies.mimics[c]:
            follow(work.q[c], bodies.multiplier[c], bodies.offset[c])
            follow(work.dq[c], bodies.multiplier[c], 0.0)
            follow(work.ddq[c], bodies.multiplier[c], 0.0)


@njit(**PASS)
def demand(bodies, work):
    """Motion of every body that matters, and the wrench that it takes."""
    for i in range(len(bodies.parent)):
        c, rows = bodies.coordinate[i], work.motion[bodies.motion[i]]
        if c >= 0:
            parent = work.motion[bodies.motion[bodies.parent[i]]]
            if bodies.slides[i]:
                work.cosine[c], work.sine[c] = 1.0, 0.0
                move_prismatic(parent, rows, work.q[c], work.dq[c], work.ddq[c], bodies.R[i], bodies.p[i])
            else:
                angles(work.q[c], work.cosine[c], work.sine[c])
                move_rotary(
                    parent, rows, work.dq[c], work.ddq[c], work.cosine[c], work.sine[c], bodies.R[i], bodies.p[i]
                )
        if bodies.weighed[i]:
            net_wrench(rows, work.wrench[i], bodies.mass[i], bodies.first_moment[i], bodies.second_moment[i])
    for i in bodies.blank:
        work.wrench[i] = 0.0


@njit(**PASS)
def link_wrenches(bodies, links, frames, work, out, first, count):
    """Net wrench of single links, in their own frames."""
    for j in range(len(frames.body)):
        rows = work.motion[bodies.motion[frames.body[j]]]
        net_wrench(rows, work.carried, links.mass[j], links.first_moment[j], links.second_moment[j])
        to_frame(work.carried, frames.R[j], frames.p[j], 1.0)
        gaps(work.carried, 6, work.gap)
        store(work.carried, count, out, first, 6 * j, 6)


@njit(**PASS)
def take_known(frames, work, columns, known, first, count):
    """What known contacts do to their bodies need not be done by others."""
    load(known, first, count, columns, work.known.reshape(-1))
    for j in range(len(frames.body)):
        from_frame(work.known[j], frames.R[j], frames.p[j], 1.0)
        take_from(work.known[j], work.wrench[frames.body[j]])


@njit(**FORMULA)
def pass_inwards(bodies, work, i, wrenches):
    """Add the wrench of a body to its parent's."""
    c = bodies.coordinate[i]
    parent = wrenches[bodies.parent[i]]
    if c < 0:
        add_to(wrenches[i], parent)
    else:
        add_inwards(
            wrenches[i], parent, work.q[c], work.cosine[c], work.sine[c], bodies.R[i], bodies.p[i], bodies.slides[i]
        )


@njit(**FORMULA)
def hand_outwards(bodies, work, i, wrench, wrenches):
    """Carry a wrench on a body's parent on to the body, and take it off what the body demands."""
    c = bodies.coordinate[i]
    if c < 0:
        take_from(wrench, wrenches[i])
    else:
        take_outwards(
            wrench, wrenches[i], work.q[c], work.cosine[c], work.sine[c], bodies.R[i], bodies.p[i], bodies.slides[i]
        )


@njit(**FORMULA)
def bring_inwards(bodies, work, i, wrench):
    """Express a wrench on a body in its parent's frame."""
    c = bodies.coordinate[i]
    if c >= 0:
        carry_inwards(wrench, work.q[c], work.cosine[c], work.sine[c], bodies.R[i], bodies.p[i], bodies.slides[i])


@njit(**PASS)
def expect(bodies, sums, frames, work, wrenches, out, first, count):
    """What sensors read where one contact takes up all that the robot demands; uses the wrenches up."""
    for i in sums.expected:
        pass_inwards(bodies, work, i, wrenches)
    if len(sums.expected_path):
        copy(wrenches[0], work.carried)
        for i in sums.expected_path:
            hand_outwards(bodies, work, i, work.carried, wrenches)
    for j in range(len(frames.body)):
        copy(wrenches[frames.body[j]], work.readout[j])
        to_frame(work.readout[j], frames.R[j], frames.p[j], frames.sign[j])
    gaps(work.readout.reshape(-1), 6 * len(frames.body), work.gap)
    store(work.readout.reshape(-1), count, out, first, 0, 6 * len(frames.body))


@njit(**PASS)
def read_sensors(bodies, frames, work, columns, measured, first, count):
    """A cut transmits what was measured."""
    load(measured, first, count, columns, work.reading.reshape(-1))
    for j in range(len(frames.body)):
        from_frame(work.reading[j], frames.R[j], frames.p[j], frames.sign[j])
        add_to(work.reading[j], work.wrench[bodies.parent[frames.body[j]]])


@njit(**PASS)
def solve_parts(plan, work, out, count, first):
    """Sum up inside the sub-models, and give their contacts what is missing at the base."""
    for i in plan.sums.parts:
        pass_inwards(plan.bodies, work, i, work.wrench)
    for s in range(len(plan.parts.base)):
        if plan.parts.closed[s]:
            solve_closed(plan, work, s)
        else:
            solve_open(plan, work, s)
        if plan.parts.column[s] >= 0:
            report(plan, work, s, out, first, count)
    gaps(work.contact.reshape(-1), 6 * len(work.contact), work.gap)
    store(work.contact.reshape(-1), count, out.contact_wrenches, first, 0, 6 * len(work.contact))


@njit(**FORMULA)
def missing_at_base(plan, work, s, wrench):
    """What the links of a sub-model demand and the sensors at its cuts do not give, at its base."""
    base, reading = plan.parts.base[s], plan.parts.reading[s]
    if reading >= 0:
        difference(work.wrench[base], work.reading[reading], wrench)
    else:
        copy(work.wrench[base], wrench)


@njit(**FORMULA)
def solve_closed(plan, work, s):
    """One full wrench takes up everything, while it is there."""
    j = plan.parts.members[plan.parts.first[s]]
    wrench, frames = work.contact[j], plan.contact_frames
    missing_at_base(plan, work, s, wrench)
    if plan.contacts.switched[j]:
        for r in range(6):
            for k in range(LANES):
                wrench[r * STRIDE + k] *= work.active[j, k]
    path = plan.contacts.path[j]
    steps = 0
    while path[steps] >= 0:
        steps += 1
    take_from(wrench, work.wrench[plan.parts.base[s]])
    for step in range(steps - 1, -1, -1):
        hand_outwards(plan.bodies, work, path[step], wrench, work.wrench)
    to_frame(wrench, frames.R[j], frames.p[j], 1.0)
    if plan.parts.column[s] >= 0:
        condition_of_lever(plan, work, j, steps)


@njit(**FORMULA)
def condition_of_lever(plan, work, j, steps):
    """Condition of a force and moment moved by a lever, from its length alone."""
    point, path = work.carried, plan.contacts.path[j]
    for r in range(3):
        point[r * STRIDE : (r + 1) * STRIDE] = plan.contact_frames.p[j, r]
    for step in range(steps):
        i = path[step]
        c = plan.bodies.coordinate[i]
        if c >= 0:
            point_inwards(
                point,
                work.q[c],
                work.cosine[c],
                work.sine[c],
                plan.bodies.R[i],
                plan.bodies.p[i],
                plan.bodies.slides[i],
            )
    for k in range(LANES):
        square = point[k] ** 2 + point[STRIDE + k] ** 2 + point[2 * STRIDE + k] ** 2
        half = 0.5 * square / plan.length_scale**2
        there = work.active[j, k] > 0.0
        work.rank[k] = 6.0 if there else 0.0
        # the singular values are those of [[1, 0], [lever, 1]]: s, s, 1, 1, 1/s, 1/s
        work.condition[k] = 1.0 + half + (half * (half + 2.0)) ** 0.5 if there else 0.0 / 0.0


@njit(**PASS)
def solve_open(plan, work, s):
    """Any other number and type of contacts, in the least squares and of least norm."""
    count = fill_columns(plan, work, s)
    missing_at_base(plan, work, s, work.right)
    for i in range(3 * STRIDE, 6 * STRIDE):
        work.right[i] /= plan.length_scale
    solve(work.columns, count, work.right, work.work, work.solution, work.rank, work.condition)
    u = 0
    for m in range(plan.parts.first[s], plan.parts.last[s]):
        j = plan.parts.members[m]
        u = unpack(plan, work, j, u)
        copy(work.contact[j], work.carried)
        from_frame(work.carried, plan.contact_frames.R[j], plan.contact_frames.p[j], 1.0)
        take_from(work.carried, work.wrench[plan.contact_frames.body[j]])
        for i in plan.contacts.path[j]:
            if i < 0:
                break
            bring_inwards(plan.bodies, work, i, work.carried)
            take_from(work.carried, work.wrench[plan.bodies.parent[i]])


@njit(**FORMULA)
def fill_columns(plan, work, s):
    """Wrench at the base for every unknown by itself, moments in units of the length scale; gives their number."""
    u, frames = 0, plan.contact_frames
    for m in range(plan.parts.first[s], plan.parts.last[s]):
        j = plan.parts.members[m]
        for component in range(plan.contacts.unknowns[j]):
            column = work.columns[u]
            column[:] = 0.0
            size = plan.length_scale if component >= 3 else 1.0
            for r in range(6):
                along = 1.0 if r == component else 0.0
                if plan.contacts.unknowns[j] == 1:
                    along = plan.contacts.direction[j, r] if r < 3 else 0.0
                for k in range(LANES):
                    column[r * STRIDE + k] = along * size * work.active[j, k]
            from_frame(column, frames.R[j], frames.p[j], 1.0)
            for i in plan.contacts.path[j]:
                if i < 0:
                    break
                bring_inwards(plan.bodies, work, i, column)
            for i in range(3 * STRIDE, 6 * STRIDE):
                column[i] /= plan.length_scale
            u += 1
    return u


@njit(**FORMULA)
def unpack(plan, work, j, u):
    """From unknowns to the wrench in the contact frame; gives the index of the next unknown."""
    wrench, unknowns = work.contact[j], plan.contacts.unknowns[j]
    wrench[:] = 0.0
    for component in range(unknowns):
        size = plan.length_scale if component >= 3 else 1.0
        if unknowns == 1:
            for r in range(3):
                for k in range(LANES):
                    wrench[r * STRIDE + k] = plan.contacts.direction[j, r] * work.solution[u, k]
        else:
            for k in range(LANES):
                wrench[component * STRIDE + k] = size * work.solution[u + component, k]
    return u + unknowns


@njit(**FORMULA)
def report(plan, work, s, out, first, count):
    """Rank, condition, and what the contacts leave, in the frame of the sensor at the base."""
    column, reading = plan.parts.column[s], plan.parts.reading[s]
    missing_at_base(plan, work, s, work.carried)
    if reading >= 0:
        to_frame(work.carried, plan.measured_frames.R[reading], plan.measured_frames.p[reading], 1.0)
    gaps(work.carried, 6, work.gap)
    store(work.carried, count, out.residual, first, 6 * column, 6)
    for k in range(count):
        left = 0.0
        for r in range(6):
            left += work.carried[r * STRIDE + k]
        whole = left == left
        out.rank[first + k, column] = int(work.rank[k]) if whole else 0
        out.condition[first + k, column] = work.condition[k] if whole else 0.0 / 0.0


@njit(**PASS)
def carry_residue(plan, work):
    """What outboard sub-models leave is part of the whole tree's sum at every joint inboard of them."""
    work.residue[:] = 0.0
    for n in range(len(plan.sums.residue)):
        i, s = plan.sums.residue[n], plan.sums.residue_part[n]
        if s >= 0:
            add_to(work.wrench[i], work.residue[i])
            take_from(work.reading[plan.parts.reading[s]], work.residue[i])
        pass_inwards(plan.bodies, work, i, work.residue)


@njit(**PASS)
def torques(plan, work, out, first, count):
    """Component along the joint of the wrench across it."""
    for j in range(len(plan.torques.body)):
        i, row = plan.torques.body[j], plan.torques.component[j] * STRIDE
        for k in range(LANES):
            work.torque[j, k] = work.wrench[i, row + k]
        if plan.torques.inboard[j]:
            for k in range(LANES):
                work.torque[j, k] += work.residue[i, row + k]
    gaps(work.torque.reshape(-1), len(plan.torques.body), work.gap)
    store(work.torque.reshape(-1), count, out, first, 0, len(plan.torques.body))
