# SPDX-License-Identifier: BSD-3-Clause
"""Values of all unknowns of a problem of loads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.unknowns import Kind, Parameter, places
from forcetorque.spatial import skew


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


def rotation_by(vector: FloatArray) -> FloatArray:
    """Rotate by a rotation vector (Rodrigues).

    Args:
        vector: Axis times angle; shape (3,); rad.

    Returns:
        The rotation; shape (3, 3).
    """
    angle = float(np.linalg.norm(vector))
    hat = skew(vector)
    if angle < 1e-12:
        return np.eye(3) + hat
    rotation: FloatArray = np.eye(3) + np.sin(angle) / angle * hat + (1.0 - np.cos(angle)) / angle**2 * hat @ hat
    return rotation
