# SPDX-License-Identifier: BSD-3-Clause
"""Arrays as fields of pydantic models: nested lists of finite numbers in a file, read-only in memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from forcetorque.arrays import FloatArray, read_only


@dataclass(frozen=True, slots=True)
class ArrayField:
    """Annotation of an array field: `Annotated[FloatArray, ArrayField((6, None))]`."""

    shape: tuple[int | None, ...]
    """Expected shape; `None` accepts any length of that axis."""
    minimum: float | None = None
    """Least value; `None` accepts any."""

    def _validate(self, values: Any) -> FloatArray:
        if isinstance(values, list) and not values and self.shape[0] is None:
            # lists within an empty one are lost: their lengths are those that are expected
            values = np.zeros([length or 0 for length in self.shape])
        try:
            array = read_only(values, name="array", shape=self.shape)
        except TypeError as error:
            raise ValueError(f"expected nested lists of numbers, got {error}") from error
        if not np.isfinite(array).all():
            raise ValueError("expected finite numbers")
        if self.minimum is not None and (array < self.minimum).any():
            raise ValueError(f"expected numbers of at least {self.minimum:g}, got {array.min():g}")
        return array

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self._validate,
            serialization=core_schema.plain_serializer_function_ser_schema(lambda array: array.tolist()),
        )

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        described: dict[str, Any] = {"type": "number"}
        if self.minimum is not None:
            described["minimum"] = self.minimum
        for length in reversed(self.shape):
            described = {"type": "array", "items": described}
            if length is not None:
                described |= {"minItems": length, "maxItems": length}
        return described


class ArrayModel(BaseModel):
    """A model whose fields may be arrays, compared by their numbers: NumPy has no single answer, so pydantic fails."""

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and _same(self.__dict__, other.__dict__)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        numbers = all(isinstance(given, np.ndarray) and given.dtype.kind == "f" for given in (one, other))
        return np.array_equal(one, other, equal_nan=numbers)
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_same(one[name], other[name]) for name in one)
    if isinstance(one, tuple | list) and type(one) is type(other):
        return len(one) == len(other) and all(map(_same, one, other))
    return one is other or bool(one == other)
