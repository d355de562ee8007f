# SPDX-License-Identifier: BSD-3-Clause
"""Expected measurements with their derivatives by every parameter, and mountings that the axes may have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import skew
from forcetorque.base.wrench import FORCE, reading_sign
from forcetorque.payload.identification.estimation_problem import INERTIAL, Load, LoadProblem, LoadRows
from forcetorque.payload.identification.parameter_vector import AXES, OF_LOAD, Guess, Kind, inertia_of, places, six_of
from forcetorque.robot.mount_estimate import nearest_rotation, rotation_by

_SMALL = 1e-5
"""rad: step of the differences that give derivatives by rotations; what is left is of the order of its square."""

_SIX = np.array([inertia_of(six) for six in np.eye(6)])
"""What each of the six numbers of an inertia is as a matrix; shape (6, 3, 3)."""
_GYROSCOPIC = np.einsum("ijk,akl->iajl", -skew(np.eye(3)), _SIX)
"""`w x I w` by the six numbers of I and the products of w; shape (3, 6, 3, 3)."""


def load_columns(rows: LoadRows, rotation: FloatArray, tilt: FloatArray) -> FloatArray:
    """Give what a unit of mass, first moment and inertia adds to the wrench that moves a load.

    Args:
        rows: How it moves.
        rotation: `sensor_R_motion`; shape (3, 3).
        tilt: Rotation vector of gravity about x and y of the world; shape (2,), or none; rad.

    Returns:
        About the sensor's origin, along its axes; shape (n, 6, 10).
    """
    if rows.columns is not None:
        return turned_by(rotation) @ rows.columns
    acceleration = rows.proper_acceleration
    if len(tilt) and rows.orientation is not None:
        # the change alone: a mean of orientations is no rotation, so that there and back would shorten the mean
        upwards = np.einsum("nij,nj->ni", rows.orientation, acceleration)
        change = upwards @ (rotation_by(np.append(tilt, 0.0)) - np.eye(3)).T
        acceleration = acceleration + np.einsum("nji,nj->ni", rows.orientation, change)
    acceleration = acceleration @ rotation.T
    if rows.angular_velocity_products is None or rows.angular_acceleration is None:
        return inertial_columns(acceleration)
    turning = rows.angular_acceleration @ rotation.T
    return inertial_columns(acceleration, turning, rotation @ rows.angular_velocity_products @ rotation.T)


def inertial_columns(
    proper_acceleration: FloatArray,
    angular_acceleration: FloatArray | None = None,
    angular_velocity_products: FloatArray | None = None,
) -> FloatArray:
    """Give what a unit of mass, first moment and inertia adds to the wrench that moves a body.

    Args:
        proper_acceleration: Of the origin of the body's frame, along its axes; shape (n, 3); m/s2.
        angular_acceleration: Along these axes; shape (n, 3); rad/s2; None of a body that does not turn.
        angular_velocity_products: Products `w w'` of the angular velocity w; shape (n, 3, 3); rad2/s2; None as well.

    Returns:
        About this origin, along these axes; shape (n, 6, 10).
    """
    columns = np.zeros((len(proper_acceleration), 6, INERTIAL))
    columns[:, :3, 0] = proper_acceleration
    columns[:, 3:, 1:4] = -skew(proper_acceleration)  # h x a
    if angular_velocity_products is None or angular_acceleration is None:
        return columns
    products = angular_velocity_products
    squared = np.trace(products, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    columns[:, :3, 1:4] = skew(angular_acceleration) + products - squared  # w x (w x h) = (w w' - w'w) h
    columns[:, 3:, 4:] = np.einsum("aij,nj->nia", _SIX, angular_acceleration)
    columns[:, 3:, 4:] += np.einsum("iajl,njl->nia", _GYROSCOPIC, products)
    return columns


def turned_by(rotation: FloatArray) -> FloatArray:
    """Turn wrenches about the origin.

    Args:
        rotation: The rotation; shape (3, 3).

    Returns:
        What turns force and moment; shape (6, 6).
    """
    turned = np.zeros((6, 6))
    turned[:3, :3] = turned[3:, 3:] = rotation
    return turned


def inertial(load: Load, number: int, guess: Guess) -> tuple[FloatArray, FloatArray]:
    """Give mass, first moment and inertia of a load, and their change with the load's unknowns.

    Args:
        load: The load.
        number: Its number.
        guess: Values of the unknowns.

    Returns:
        Shape (10,), about the sensor's origin; and shape (10, q) for its q unknowns in their order.
    """
    mass = float(guess.of(Kind.MASS, number)[0]) if load.mass is None else load.mass
    free_first = load.centre_of_mass is None and load.mass != 0.0
    centre = np.zeros(3) if load.centre_of_mass is None else load.centre_of_mass
    first = guess.of(Kind.FIRST_MOMENT, number) if free_first else mass * centre
    stated = np.zeros((3, 3)) if load.inertia is None or isinstance(load.inertia, str) else load.inertia
    reach = first / mass if free_first and mass else centre
    if isinstance(load.inertia, str):
        six = guess.of(Kind.INERTIA, number)
    else:
        six = six_of(stated - mass * skew(reach) @ skew(reach))
    changes = []
    if load.mass is None:
        own = np.zeros(3) if free_first else centre
        changes.append(np.concatenate([[1.0], own, six_of((1.0 if free_first else -1.0) * skew(reach) @ skew(reach))]))
    if free_first:
        for axis in np.eye(3):
            second = 2.0 * (axis @ reach) * np.eye(3) - np.outer(axis, reach) - np.outer(reach, axis)
            changes.append(np.concatenate([[0.0], axis, six_of(second)]))
    if isinstance(load.inertia, str):
        changes = [np.concatenate([change[:4], np.zeros(6)]) for change in changes]
        changes += list(np.eye(10)[4:])
    return np.concatenate([[mass], first, six]), np.array(changes).reshape(-1, 10).T


def masses(problem: LoadProblem, guess: Guess) -> tuple[float, ...]:
    """Give the masses of the loads, stated or not.

    Args:
        problem: The problem.
        guess: Values of the unknowns.

    Returns:
        Masses in the order of the problem; kg; NaN of a load that no row has.
    """
    unknown = [guess.of(Kind.MASS, number) for number in range(len(problem.loads))]
    pairs = zip(problem.loads, unknown, strict=True)
    return tuple(float(own[0]) if len(own) else np.nan if load.mass is None else load.mass for load, own in pairs)


def expected(problem: LoadProblem, guess: Guess) -> FloatArray:
    """Give what the sensor is expected to read.

    Args:
        problem: The problem.
        guess: Values of the unknowns.

    Returns:
        Readings; shape (n, 6); N, N m.
    """
    rows = problem.rows
    wrench = load_wrench(problem, guess) @ guess.response.T
    for number in range(len(problem.variables)):
        wrench = wrench + np.outer(variable_about_mean(rows, number), guess.of(Kind.VARIABLE, number))
    since = since_middle(rows)
    for number in range(len(problem.sessions)):
        mine, drift = rows.session == number, guess.of(Kind.DRIFT, number)
        if mine.any():
            wrench[mine] += guess.of(Kind.BIAS, number)
            wrench[mine] += np.outer(since[mine], drift) if len(drift) else 0.0
    return wrench


def load_wrench(problem: LoadProblem, guess: Guess) -> FloatArray:
    """Give the wrenches of loads and known bodies, as an exact sensor without bias reads them.

    Args:
        problem: The problem.
        guess: Values of the unknowns.

    Returns:
        Wrenches; shape (n, 6); N, N m.
    """
    sign = reading_sign(problem.direction, child_is_outboard=True)
    columns = load_columns(problem.rows, guess.rotation, guess.of(Kind.TILT))
    wrench = np.zeros((len(problem.rows), 6))
    for number, load in enumerate(problem.loads):
        mine = problem.rows.load == number
        if mine.any():
            wrench[mine] = sign * columns[mine] @ inertial(load, number, guess)[0]
    return wrench if problem.rows.known is None else wrench + problem.rows.known @ turned_by(guess.rotation).T


def changes(problem: LoadProblem, guess: Guess) -> FloatArray:
    """Give the change of what is expected with every unknown.

    Args:
        problem: The problem.
        guess: Values of the unknowns.

    Returns:
        Shape (n, 6, p).
    """
    rows, listed = problem.rows, guess.parameters
    sign = reading_sign(problem.direction, child_is_outboard=True)
    columns = sign * guess.response @ load_columns(rows, guess.rotation, guess.of(Kind.TILT))
    design = np.zeros((len(rows), 6, len(listed)))
    for number, load in enumerate(problem.loads):
        mine = rows.load == number
        places_of_load = [k for kind in OF_LOAD for k in places(listed, kind, number)]
        if places_of_load and mine.any():
            design[np.ix_(mine, range(6), places_of_load)] = columns[mine] @ inertial(load, number, guess)[1]
    for kind in (Kind.MOUNT, Kind.TILT):
        for k in places(listed, kind):
            design[:, :, k] = _difference(problem, guess, k)
    since = since_middle(rows)
    wrench = load_wrench(problem, guess) if places(listed, Kind.MATRIX) else None
    for k, one in enumerate(listed):
        mine = rows.session == one.owner
        if one.kind is Kind.BIAS:
            design[mine, one.component, k] = 1.0
        elif one.kind is Kind.DRIFT:
            design[mine, one.component, k] = since[mine]
        elif one.kind is Kind.VARIABLE:
            design[:, one.component, k] = variable_about_mean(rows, one.owner)
        elif one.kind is Kind.MATRIX and wrench is not None:
            design[:, one.owner, k] = wrench[:, one.component]
    return design


def _difference(problem: LoadProblem, guess: Guess, place: int) -> FloatArray:
    """Change by a small rotation, as a central difference; shape (n, 6)."""
    step = np.zeros(len(guess.values))
    step[place] = _SMALL
    ahead, behind = (load_wrench(problem, replace(guess, values=guess.values + side * step)) for side in (1.0, -1.0))
    return (ahead - behind) / (2.0 * _SMALL) @ guess.response.T


def variable_about_mean(rows: LoadRows, number: int) -> FloatArray:
    """Count a variable from its mean.

    Returns:
        Shape (n,).
    """
    values = np.zeros(len(rows)) if rows.variables is None else rows.variables[:, number]
    return values - values.mean()


def since_middle(rows: LoadRows) -> FloatArray:
    """Count time from the mean instant of each session.

    Args:
        rows: The rows; without instants they are a second apart.

    Returns:
        Shape (n,); s.
    """
    time = instants(rows).copy()
    for number in np.unique(rows.session):
        mine = rows.session == number
        time[mine] -= time[mine].mean()
    return time


def instants(rows: LoadRows) -> FloatArray:
    """Give instants, or the order of rows that have none.

    Returns:
        Shape (n,); s, or numbers from 0.
    """
    return np.arange(float(len(rows))) if rows.time_s is None else rows.time_s


def turn_words(turn: FloatArray) -> str:
    """Name a rotation that brings axes to axes.

    Args:
        turn: `sensor_R_motion`; shape (3, 3).

    Returns:
        Words such as `x of the sensor is -y of the motion, y is x, z is z`.
    """
    named = []
    for axis, row in zip(AXES, turn, strict=True):
        k = int(np.abs(row).argmax())
        named.append(f"{axis} is {'-' if row[k] < 0.0 else ''}{AXES[k]}")
    return f"{named[0].replace('is', 'of the sensor is', 1)} of the motion, {named[1]}, {named[2]}"


def first_mount(problem: LoadProblem) -> FloatArray:
    """Turn the axes of the motion to those of the sensor as the weight shows itself in the forces.

    Forces are `sign m R a + bias`, whatever the centre of mass: R is the rotation that is nearest to the best matrix.

    Returns:
        `sensor_R_motion`; shape (3, 3).
    """
    sign = reading_sign(problem.direction, child_is_outboard=True)
    moment = force_response(problem)
    return nearest_rotation(sign * moment)


def force_response(problem: LoadProblem) -> FloatArray:
    """Covariance of forces with proper accelerations within sessions and loads, which is that of `m R` for even turns.

    Returns:
        Shape (3, 3); N m/s2.
    """
    rows = problem.rows
    force, moved = rows.moved(rows.wrench[:, FORCE]), rows.moved(rows.proper_acceleration)
    return force.T @ moved @ np.linalg.pinv(moved.T @ moved, rcond=1e-6, hermitian=True)
