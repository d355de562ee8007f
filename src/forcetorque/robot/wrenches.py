# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches of several sensors or contacts at the same instants, matched by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import RobotError, ShapeError, known_names


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Wrenches:
    """Wrenches by name, each in a frame of its own."""

    names: tuple[str, ...]
    """Sensors or contacts, in any order."""
    values: FloatArray
    """Force, then moment; shape (n, names, 6); N, N m; NaN where there is none."""

    def __post_init__(self) -> None:
        names = tuple(self.names)
        object.__setattr__(self, "names", names)
        values = read_only(self.values, name="wrenches", shape=(None, len(names), 6))
        object.__setattr__(self, "values", values)
        if len(set(names)) != len(names):
            raise ShapeError(f"names of wrenches: expected each once, got {names}")

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
        if name not in self.names:
            raise RobotError(f"no wrench of {name!r}; {known_names(name, self.names)}")
        return self.values[:, self.names.index(name)]

    def __len__(self) -> int:
        return len(self.values)
