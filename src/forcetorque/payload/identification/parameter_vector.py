# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of a problem with their names, and parameter vectors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem
from forcetorque.robot.mount_estimate import rotation_by

AXES = ("x", "y", "z")
SECOND_MOMENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
"""Order in which the six numbers of an inertia are kept."""
SIX_PLACES = ((0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2))
"""Their rows and columns in the matrix."""

_LEAST_DRIFTING = 4
"""Rows that a session must have to have a drift: with fewer it would say nothing else."""


class Kind(StrEnum):
    """What a parameter is, in the order in which parameters are listed."""

    MASS = "mass"
    FIRST_MOMENT = "first moment"
    INERTIA = "inertia"
    MATRIX = "matrix"
    MOUNT = "mount"
    TILT = "tilt"
    VARIABLE = "variable"
    DRIFT = "drift"
    BIAS = "bias"


OF_LOAD = (Kind.MASS, Kind.FIRST_MOMENT, Kind.INERTIA)
"""What parameters of one load are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """One unknown number; SI units."""

    kind: Kind
    """What it is."""
    owner: int
    """Number of its load or session, or row of the matrix; 0 for what there is once."""
    component: int
    """Which axis or number of it."""
    name: str
    """Name for people, such as `bias fx of morning`."""


def unknowns_of(problem: LoadProblem, *, drift: bool) -> tuple[Parameter, ...]:
    """List what is to be estimated.

    Args:
        problem: The problem.
        drift: Whether the bias of every session moves evenly in time.

    Returns:
        Parameters: loads first, biases last; none of loads that no row has.
    """
    used = [k for k in range(len(problem.loads)) if (problem.rows.load == k).any()]
    listed = [one for k in used for one in _of_load(k, problem.loads[k])]
    if problem.matrix_prior is not None:
        for row, named in enumerate(WRENCH_COMPONENTS):
            words = [f"response of {named} to {load}" for load in WRENCH_COMPONENTS]
            listed += _listed(Kind.MATRIX, row, words)
    if problem.mount:
        listed += _listed(Kind.MOUNT, 0, [f"mount about {axis}" for axis in AXES])
    if problem.tilt:
        listed += _listed(Kind.TILT, 0, [f"tilt about {axis} of the world" for axis in AXES[:2]])
    for number, variable in enumerate(problem.variables):
        words = [f"{component} per unit of {variable}" for component in WRENCH_COMPONENTS]
        listed += _listed(Kind.VARIABLE, number, words)
    counts = np.bincount(problem.rows.session, minlength=len(problem.sessions))
    for kind, least in ((Kind.DRIFT, _LEAST_DRIFTING), (Kind.BIAS, 1)):
        for k in np.flatnonzero(counts >= least) if drift or kind is Kind.BIAS else ():
            named = problem.sessions[k]
            listed += _listed(kind, int(k), [f"{kind} {component} of {named}" for component in WRENCH_COMPONENTS])
    return tuple(listed)


def places(parameters: tuple[Parameter, ...], kind: Kind, owner: int = 0) -> list[int]:
    """Find the parameters of a kind.

    Args:
        parameters: All of them.
        kind: Their kind.
        owner: Number of their load or session.

    Returns:
        Places in the list.
    """
    return [k for k, one in enumerate(parameters) if one.kind is kind and one.owner == owner]


def _of_load(number: int, load: Load) -> list[Parameter]:
    if load.is_known:
        return []
    listed = []
    if load.mass is None:
        listed += _listed(Kind.MASS, number, [f"mass of {load.name}"])
    if load.centre_of_mass is None and load.mass != 0.0:
        listed += _listed(Kind.FIRST_MOMENT, number, [f"first moment {axis} of {load.name}" for axis in AXES])
    if isinstance(load.inertia, str):
        listed += _listed(Kind.INERTIA, number, [f"inertia {pair} of {load.name}" for pair in SECOND_MOMENTS])
    return listed


def _listed(kind: Kind, owner: int, names: list[str]) -> list[Parameter]:
    return [Parameter(kind=kind, owner=owner, component=k, name=name) for k, name in enumerate(names)]


def six_of(inertia: np.ndarray) -> np.ndarray:
    """Give the six numbers of an inertia; shape (..., 6).

    Args:
        inertia: Symmetric; shape (..., 3, 3).

    Returns:
        xx, yy, zz, xy, xz, yz.
    """
    first, second = SIX_PLACES
    return inertia[..., first, second]


def inertia_of(six: np.ndarray) -> np.ndarray:
    """Give an inertia of its six numbers.

    Args:
        six: xx, yy, zz, xy, xz, yz; shape (6,).

    Returns:
        The symmetric matrix; shape (3, 3).
    """
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


@dataclass(frozen=True, kw_only=True, eq=False)
class Guess:
    """Values of all unknowns, about which the problem is linear enough."""

    parameters: tuple[Parameter, ...]
    """What they are."""
    values: FloatArray
    """Their values; those of the mount are small rotations after `mount`; shape (p,); SI units."""
    mount: FloatArray
    """Rotation of the mount, before its small rotations; shape (3, 3)."""
    index: Mapping[tuple[Kind, int], list[int]]
    """Places of the unknowns of each kind and owner."""

    @classmethod
    def zero(cls, parameters: tuple[Parameter, ...], mount: FloatArray | None = None) -> Guess:
        """Guess that nothing hangs on the sensor.

        Args:
            parameters: The unknowns.
            mount: Rotation of the mount; none if left out.

        Returns:
            The guess.
        """
        index: dict[tuple[Kind, int], list[int]] = {}
        for place, one in enumerate(parameters):
            index.setdefault((one.kind, one.owner), []).append(place)
        turn = np.eye(3) if mount is None else mount
        return cls(parameters=parameters, values=np.zeros(len(parameters)), mount=turn, index=index)

    def of(self, kind: Kind, owner: int = 0) -> FloatArray:
        """Give the values of a kind.

        Args:
            kind: The kind.
            owner: Number of their load or session.

        Returns:
            Values; none where there are none.
        """
        return self.values[self.index.get((kind, owner), [])]

    @cached_property
    def rotation(self) -> FloatArray:
        """Rotation of the mount, small rotations included; shape (3, 3)."""
        small = self.of(Kind.MOUNT)
        return rotation_by(small) @ self.mount if len(small) else self.mount

    @property
    def response(self) -> FloatArray:
        """What the reading says of a load, `1 + E`; shape (6, 6)."""
        rows = [self.of(Kind.MATRIX, row) for row in range(6)]
        return np.eye(6) + np.array(rows) if len(rows[0]) else np.eye(6)

    def moved(self, values: FloatArray) -> Guess:
        """Take other values.

        Args:
            values: All of them; shape (p,).

        Returns:
            The guess; small rotations of the mount are taken into its rotation.
        """
        values = np.array(values)
        moved = replace(self, values=values)
        mount = moved.rotation
        kept = values.copy()
        kept[places(self.parameters, Kind.MOUNT)] = 0.0
        return replace(self, values=kept, mount=mount)
