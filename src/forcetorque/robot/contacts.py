# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of the robot with the world (thesis 2.4), and wrenches of sensors or contacts matched by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, names, read_only
from forcetorque.base.errors import RobotError, ShapeError, require_known
from forcetorque.base.pose import make_pose


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Wrenches(ArrayRecord):
    """Wrenches by name, each in a frame of its own."""

    names: tuple[str, ...] = field(metadata=names("w"))
    """Sensors or contacts, in any order."""
    values: FloatArray = field(metadata=array(None, "w", 6))
    """Force, then moment; shape (n, names, 6); N, N m; NaN where there is none."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if len(set(self.names)) != len(self.names):
            raise ShapeError(f"names of wrenches: expected each once, got {self.names}")

    @classmethod
    def of(cls, wrenches: Mapping[str, Any]) -> Wrenches:
        """Stack wrenches that are given one by one.

        Args:
            wrenches: Wrenches by name; shape (n, 6) each; N, N m.

        Returns:
            The same, side by side.

        Raises:
            ShapeError: If their shapes differ, or there are none.
        """
        arrays = [np.asarray(values, dtype=np.float64) for values in wrenches.values()]
        if not arrays or {array.shape for array in arrays} != {(len(arrays[0]), 6)}:
            shapes = {name: np.shape(values) for name, values in wrenches.items()}
            raise ShapeError(f"wrenches: expected the shape (n, 6) for each name, got {shapes}")
        return cls(names=tuple(wrenches), values=np.stack(arrays, axis=1))

    def of_name(self, name: str) -> FloatArray:
        """Give the wrenches of one name.

        Args:
            name: Sensor or contact.

        Returns:
            Its wrenches; shape (n, 6); N, N m.

        Raises:
            RobotError: If there is none of that name.
        """
        require_known(name, self.names, RobotError, f"no wrench of {name!r}")
        return self.values[:, self.names.index(name)]

    def __len__(self) -> int:
        return len(self.values)


_UNIT = 1e-6
"""A direction may be this far from unit length."""


class ContactType(StrEnum):
    """What is unknown about a contact."""

    WRENCH = "wrench"
    """Force and moment: six unknowns."""
    FORCE = "force"
    """A force at the origin of the contact frame, without a moment about it: three unknowns."""
    FORCE_ALONG = "force_along"
    """The size of a force at the origin of the contact frame along a known direction: one unknown."""
    KNOWN = "known"
    """Nothing: the wrench is given, as by calibrated skin."""

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Names of the unknown components."""
        return {
            ContactType.WRENCH: ("fx", "fy", "fz", "tx", "ty", "tz"),
            ContactType.FORCE: ("fx", "fy", "fz"),
            ContactType.FORCE_ALONG: ("f",),
            ContactType.KNOWN: (),
        }[self]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Contact:
    """A contact; its wrench is what the environment does to the robot, in and about the contact frame."""

    link: str
    """Link that is touched, or any frame of the robot that the URDF has as a link."""
    name: str = ""
    """Name, unique in an estimation; that of the link if left out."""
    type: ContactType = ContactType.WRENCH
    """What is unknown."""
    link_H_contact: FloatArray = field(default_factory=lambda: np.eye(4))
    """Pose of the contact frame in the link's frame; shape (4, 4); m."""
    direction: FloatArray | None = None
    """Unit vector of a `force_along`, in the contact frame; shape (3,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", self.name or self.link)
        object.__setattr__(self, "type", ContactType(self.type))
        pose = read_only(self.link_H_contact, name=f"contact {self.name!r}: link_H_contact", shape=(4, 4))
        object.__setattr__(self, "link_H_contact", pose)
        if (self.direction is None) == (self.type is ContactType.FORCE_ALONG):
            wanted = "a direction" if self.direction is None else "no direction"
            raise ShapeError(f"contact {self.name!r}: expected {wanted} with type {self.type}; a force_along needs one")
        if self.direction is not None:
            direction = read_only(self.direction, name=f"contact {self.name!r}: direction", shape=(3,))
            if not abs(float(np.linalg.norm(direction)) - 1.0) < _UNIT:
                raise ShapeError(f"contact {self.name!r}: expected a unit direction, got {direction.tolist()}")
            object.__setattr__(self, "direction", direction)

    @classmethod
    def at_point(
        cls,
        link: str,
        point: object,
        *,
        name: str = "",
        type: ContactType = ContactType.WRENCH,
        direction: FloatArray | None = None,
    ) -> Contact:
        """Touch a point of a link, along the link's axes.

        Args:
            link: The link.
            point: Position in the link's frame; shape (3,); m.
            name: Name; that of the link if left out.
            type: What is unknown.
            direction: Unit vector of a `force_along`, in the link's axes; shape (3,).

        Returns:
            The contact.
        """
        pose = make_pose(np.eye(3), read_only(point, name=f"contact on {link!r}: point", shape=(3,)))
        return cls(link=link, name=name, type=type, link_H_contact=pose, direction=direction)

    def unknown_map(self) -> FloatArray:
        """Map the unknowns to the wrench in the contact frame.

        Returns:
            Matrix of shape (6, unknowns); N, N m per unknown.
        """
        if self.direction is not None:
            return np.concatenate([self.direction, np.zeros(3)])[:, None]
        return np.eye(6)[:, : len(self.type.unknowns)]
