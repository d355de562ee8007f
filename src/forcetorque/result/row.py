# SPDX-License-Identifier: BSD-3-Clause
"""Rows: the frozen models that every answer is made of."""

from __future__ import annotations

from collections.abc import Iterator
from types import NoneType
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, PlainSerializer

from forcetorque.array_field import ArrayField, ArrayModel
from forcetorque.arrays import FloatArray
from forcetorque.result.cells import finite_or_none
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

WrenchValues = Annotated[FloatArray, ArrayField((6,))]
"""Six numbers fx fy fz (N) tx ty tz (N m)."""
AxisValues = Annotated[FloatArray, ArrayField((3,))]
"""Three numbers x y z."""
Values = Annotated[FloatArray, ArrayField((None,))]
"""Any number of numbers."""
FloatOrNull = Annotated[float, PlainSerializer(finite_or_none, return_type=float | None)]
"""A number that may be infinite, or NaN where there is none; null in JSON, which has neither."""

_FEW = 8
"""Numbers of a list that are shown; more are counted."""


class Row(ArrayModel):
    """One line of an answer. Names of fields are its keys in JSON, with the unit where it is not plain."""

    model_config = ConfigDict(
        defer_build=True,
        extra="forbid",
        frozen=True,
        arbitrary_types_allowed=True,
        populate_by_name=True,
        protected_namespaces=(),  # before pydantic 2.10 every `model_` is protected, and rows have `model_mass_kg`
    )

    def __repr_args__(self) -> Iterator[tuple[str, Any]]:
        """Say what it holds in a few words: lists are counted."""
        for name, field in type(self).model_fields.items():
            value = getattr(self, name)
            if field.repr and value is not None and not (isinstance(value, (tuple, list, dict, str)) and not value):
                yield name, _Brief(value)

    __str__ = BaseModel.__repr__

    def flat(self) -> dict[str, object]:
        """Give the row as one line of a table of numbers.

        Returns:
            Values by key. Six numbers become `key_fx_N` ... `key_tz_Nm`; three become `key_x`, `key_y`, `key_z` before
            the unit of the key, principal ones `1`, `2`, `3`; rows inside it join the keys by underscores.
        """
        return dict(_flat(self.model_dump(mode="json", by_alias=True)))


class _Brief:
    """Writes a value in at most a few words."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def __repr__(self) -> str:
        value = self.value
        if isinstance(value, np.ndarray) and value.ndim == 1 and len(value) <= _FEW:
            return "[" + ", ".join(f"{entry:.4g}" for entry in value) + "]"
        if isinstance(value, np.ndarray):
            return f"array of shape {value.shape}"
        if isinstance(value, float):
            return f"{value:.6g}"
        if isinstance(value, (tuple, list)) and all(isinstance(entry, str) for entry in value) and len(value) <= _FEW:
            return repr(list(value))
        if isinstance(value, (tuple, list, dict)):
            return f"<{len(value)}>"
        return repr(value)


def _flat(values: dict[str, Any], before: str = "") -> Iterator[tuple[str, object]]:
    for name, value in values.items():
        key = before + name
        if isinstance(value, dict):
            yield from _flat(value, f"{key}_")
        elif isinstance(value, list) and value and all(isinstance(entry, (int, float, NoneType)) for entry in value):
            yield from zip(_keys(key, len(value)), value, strict=True)
        elif isinstance(value, list):
            yield key, "; ".join(str(entry) for entry in value)
        else:
            yield key, value


def _keys(key: str, count: int) -> list[str]:
    if count == len(WRENCH_COMPONENTS):
        units = (unit.replace(" ", "") for unit in WRENCH_UNITS)
        return [f"{key}_{component}_{unit}" for component, unit in zip(WRENCH_COMPONENTS, units, strict=True)]
    name, _, unit = key.rpartition("_")
    places = ("1", "2", "3") if "principal" in key else ("x", "y", "z")
    if count == len(places) and name:
        return [f"{name}_{place}_{unit}" for place in places]
    return [f"{key}_{k}" for k in range(count)]
