# SPDX-License-Identifier: BSD-3-Clause
"""Arrays with a checked shape that are read-only, in data classes and pydantic models; runs of true values in masks."""

from __future__ import annotations

import copyreg
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import cache
from types import MappingProxyType
from typing import Any, Literal, TypeVar

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from forcetorque.base.errors import ShapeError

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]


def read_only(values: Any, *, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    """Copy values to a float64 array that is read-only.

    An array that is read-only already, with all memory that it is a view of, is taken as it is: a
    recording of ten million samples need not be held twice, and a file mapped for reading not at all.

    Args:
        values: Anything NumPy can turn into numbers.
        name: Name of the argument, for the message.
        shape: Expected shape; `None` accepts any length of that axis.

    Returns:
        A read-only array of that shape.

    Raises:
        ShapeError: If the shape differs.
    """
    array = values if is_frozen(values) else np.array(values, dtype=np.float64, order="C")
    require_shape(array, name=name, shape=shape)
    array.setflags(write=False)
    return array


def read_only_integers(values: Any, *, name: str, shape: tuple[int | None, ...]) -> IntArray:
    """Copy whole numbers to an int64 array that is read-only.

    Args:
        values: Anything NumPy can turn into whole numbers; an empty list is none of them.
        name: Name of the argument, for the message.
        shape: Expected shape; `None` accepts any length of that axis.

    Returns:
        A read-only array of that shape.

    Raises:
        ShapeError: If the shape differs, or a number has a fraction.
    """
    numbers = np.asarray(values)
    require_shape(numbers, name=name, shape=shape)
    array = numbers.astype(np.int64)
    if not np.array_equal(array, numbers):
        raise ShapeError(f"{name}: expected whole numbers, got {numbers[array != numbers].flat[0]}")
    array.setflags(write=False)
    return array


Axis = int | str | None
"""Length of an axis: a number, a name that stands for one length throughout a record, or None for any."""


@dataclass(frozen=True, slots=True)
class _Declared:
    shape: tuple[Axis, ...]
    dtype: Literal["float", "int", "bool", "tuple"] = "float"
    of_mapping: bool = False


def array(*shape: Axis, dtype: Literal["float", "int", "bool"] = "float") -> dict[str, _Declared]:
    """Declare a field of an `ArrayRecord` as a read-only array: `matrix: FloatArray = field(metadata=array(6, "c"))`.

    Args:
        *shape: Length of every axis; an axis of the same name has the same length in all fields of the record.
        dtype: Kind of numbers: float64, int64 or bool.

    Returns:
        Metadata of the field; a value of None is left alone.
    """
    return {"declared": _Declared(shape, dtype)}


def names(length: Axis = None) -> dict[str, _Declared]:
    """Declare a field of an `ArrayRecord` as a tuple, whose length may name an axis of its arrays.

    Returns:
        Metadata of the field.
    """
    return {"declared": _Declared((length,), "tuple")}


def mapping(*shape: Axis) -> dict[str, _Declared]:
    """Declare a field of an `ArrayRecord` as a read-only mapping.

    Args:
        *shape: Shape of its values where they are arrays; nothing to leave them as they are.

    Returns:
        Metadata of the field.
    """
    return {"declared": _Declared(shape, of_mapping=True)}


def check_arrays(record: object) -> None:
    """Check and freeze the declared fields of a record; its own `__post_init__` calls this first.

    Args:
        record: A frozen dataclass that is being made.

    Raises:
        ShapeError: If a shape differs from what is declared, or a whole number has a fraction.
    """
    lengths: dict[str, int] = {}
    for name, declared in _declared(type(record)):  # type: ignore[arg-type]  # a class is hashable
        value = getattr(record, name)
        if value is None:
            continue
        if declared.of_mapping:
            items = dict(value)
            if declared.shape:
                items = {key: _settled(item, f"{name} of {key!r}", declared, lengths) for key, item in items.items()}
            object.__setattr__(record, name, read_only_mapping(items))
        else:
            object.__setattr__(record, name, _settled(value, name, declared, lengths))


class ArrayRecord:
    """Base of frozen data classes with declared fields, which are checked and frozen when one is made."""

    __slots__ = ()

    def __post_init__(self) -> None:
        """Check and freeze the declared fields."""
        check_arrays(self)


@cache
def _declared(record: type) -> tuple[tuple[str, _Declared], ...]:
    return tuple((one.name, one.metadata["declared"]) for one in fields(record) if "declared" in one.metadata)


def _settled(value: Any, name: str, declared: _Declared, lengths: dict[str, int]) -> Any:
    """The value as it is declared; `lengths` learns the axes that it names."""
    if declared.dtype == "tuple":
        value = tuple(value)
    shape = tuple(lengths.get(axis) if isinstance(axis, str) else axis for axis in declared.shape)
    if declared.dtype == "tuple":
        if shape[0] is not None and len(value) != shape[0]:
            raise ShapeError(f"{name}: expected {shape[0]}, got {len(value)}")
        got: tuple[int, ...] = (len(value),)
    else:
        make = {"float": read_only, "int": read_only_integers, "bool": _read_only_flags}[declared.dtype]
        value = make(value, name=name, shape=shape)
        got = value.shape
    for axis, length in zip(declared.shape, got, strict=True):
        if isinstance(axis, str) and lengths.setdefault(axis, length) != length:
            raise ShapeError(f"{name}: expected axes {axis} of one length, got {got}")
    return value


def _read_only_flags(values: Any, *, name: str, shape: tuple[int | None, ...]) -> BoolArray:
    flags = np.array(values, dtype=np.bool_)
    require_shape(flags, name=name, shape=shape)
    flags.setflags(write=False)
    return flags


def is_frozen(values: Any, dtype: type = np.float64) -> bool:
    """Whether values are a C-ordered array that is read-only, with all memory that it is a view of.

    Args:
        values: Anything.
        dtype: Kind of numbers.

    Returns:
        Whether they need not be copied.
    """
    if not isinstance(values, np.ndarray) or values.dtype != dtype or not values.flags.c_contiguous:
        return False
    while isinstance(values, np.ndarray):
        if values.flags.writeable:
            return False
        values = values.base
    return True


def require_shape(array: npt.NDArray[Any], *, name: str, shape: tuple[int | None, ...]) -> None:
    """Check the shape of an array; `None` accepts any length of that axis.

    Args:
        array: Array to check.
        name: Name of the argument, for the message.
        shape: Expected shape.

    Raises:
        ShapeError: If the shape differs.
    """
    fits = array.ndim == len(shape) and all(
        expected is None or got == expected for got, expected in zip(array.shape, shape, strict=True)
    )
    if not fits:
        wanted = "(" + ", ".join("n" if k is None else str(k) for k in shape) + ")"
        raise ShapeError(f"{name}: expected an array of shape {wanted}, got {array.shape}")


def require_last_axis(array: npt.NDArray[Any], *, name: str, length: int) -> None:
    """Check that the components of an array lie along its last axis.

    Args:
        array: Array to check, any number of leading axes.
        name: Name of the argument, for the message.
        length: Expected length of the last axis.

    Raises:
        ShapeError: If the array is a scalar or its last axis has another length.
    """
    if array.ndim == 0 or array.shape[-1] != length:
        raise ShapeError(f"{name}: expected shape (..., {length}), got {array.shape}")


@dataclass(frozen=True, slots=True)
class ArrayField:
    """Annotation of an array field: `Annotated[FloatArray, ArrayField((6, None))]`."""

    shape: tuple[int | None, ...]
    """Expected shape; `None` accepts any length of that axis."""
    minimum: float | None = None
    """Least value; `None` accepts any."""
    form: str | None = None
    """What its numbers are, for messages, such as `[x, y, z] in m`; by its shape if None."""

    def _validate(self, values: Any) -> FloatArray:
        if isinstance(values, list) and not values and self.shape[0] is None:
            # lists within an empty one are lost: their lengths are those that are expected
            values = np.zeros([length or 0 for length in self.shape])
        try:
            array = read_only(values, name="array", shape=self.shape)
        except ShapeError as error:
            if self.form is None:
                raise
            raise ValueError(f"expected {self.form}") from error
        except TypeError as error:
            raise ValueError(f"expected nested lists of numbers, got {error}") from error
        except ValueError as error:  # a text, or lists of different lengths
            reason = "" if self.form is not None else f": {error}"
            raise ValueError(f"expected {self._form()}{reason}") from error
        if not np.isfinite(array).all():
            raise ValueError("expected finite numbers")
        if self.minimum is not None and (array < self.minimum).any():
            raise ValueError(f"expected numbers of at least {self.minimum:g}, got {array.min():g}")
        return array

    def _form(self) -> str:
        if self.form is not None:
            return self.form
        if self.shape == (None,):
            return "a list of numbers in brackets, as [0.0, 1.0]"
        if len(self.shape) == 1:
            return f"{self.shape[0]} numbers in brackets, as [{', '.join(['0.0'] * (self.shape[0] or 0))}]"
        return "lists of numbers within a list, each row in brackets, as [[0.0, 1.0], [2.0, 3.0]]"

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self._validate,
            serialization=core_schema.plain_serializer_function_ser_schema(self._listed),
        )

    def _listed(self, array: FloatArray) -> list[Any]:
        return list(array.tolist())

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        described: dict[str, Any] = {"type": "number"}
        if self.minimum is not None:
            described["minimum"] = self.minimum
        for length in reversed(self.shape):
            described = {"type": "array", "items": described}
            if length is not None:
                described |= {"minItems": length, "maxItems": length}
        return described


@dataclass(frozen=True, slots=True)
class SymmetricField(ArrayField):
    """Annotation of a symmetric matrix, of which JSON has the lower triangle: rows of one number, two, three and so on.

    A matrix with all its rows is read too.
    """

    shape: tuple[int | None, ...] = (None, None)

    def _validate(self, values: Any) -> FloatArray:
        if isinstance(values, list) and all(isinstance(row, list) for row in values):
            lengths = [len(row) for row in values]
            if lengths == list(range(1, len(values) + 1)):
                numbers = ArrayField((None,))._validate([number for row in values for number in row])
                matrix = np.zeros((len(values), len(values)))
                matrix[np.tril_indices(len(values))] = numbers
                values = matrix + np.tril(matrix, -1).T
        matrix = ArrayField._validate(self, values)
        if matrix.shape[0] != matrix.shape[1]:
            raise ValueError(f"expected as many rows as columns, or a lower triangle, got shape {matrix.shape}")
        return matrix

    def _listed(self, array: FloatArray) -> list[Any]:
        if not np.array_equal(array, array.T):  # rounding, of a matrix that is no fit's
            return list(array.tolist())
        return [row[: k + 1].tolist() for k, row in enumerate(array)]


def rounded(values: FloatArray, digits: int) -> FloatArray:
    """Round to significant digits, of which text then has no more.

    Args:
        values: Finite numbers; any shape.
        digits: Number of digits.

    Returns:
        The numbers; a symmetric matrix stays one. Those below 1e-290 lose digits, and become 0 in the end.
    """
    size = np.maximum(np.abs(values), 1e-290)  # the scale of smaller ones is beyond floating point
    scale = 10.0 ** (digits - 1 - np.floor(np.log10(size)))
    return np.asarray(np.round(values * scale) / scale)


class ArrayModel(BaseModel):
    """A model whose fields may be arrays, compared by their numbers: NumPy gives an array, so pydantic fails."""

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and _same(self.__dict__, other.__dict__)

    def __dir__(self) -> list[str]:
        # what pydantic adds is no part of an answer, and would hide it where names are completed
        return [name for name in super().__dir__() if name not in _OF_PYDANTIC]


_OF_PYDANTIC = frozenset(name for name in dir(BaseModel) if not (name.startswith("__") and name.endswith("__")))


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        numbers = all(isinstance(given, np.ndarray) and given.dtype.kind == "f" for given in (one, other))
        return np.array_equal(one, other, equal_nan=numbers)
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_same(one[name], other[name]) for name in one)
    if isinstance(one, tuple | list) and type(one) is type(other):
        return len(one) == len(other) and all(map(_same, one, other))
    return one is other or bool(one == other)


_Key = TypeVar("_Key")
_Value = TypeVar("_Value")


def read_only_mapping(mapping: Mapping[_Key, _Value]) -> MappingProxyType[_Key, _Value]:
    """Copy a mapping to one that is read-only.

    Args:
        mapping: Any mapping.

    Returns:
        The copy.
    """
    return MappingProxyType(dict(mapping))


def _reduced(
    mapping: MappingProxyType[Any, Any],
) -> tuple[Callable[..., MappingProxyType[Any, Any]], tuple[dict[Any, Any]]]:
    return read_only_mapping, (dict(mapping),)


# Python pickles and deep-copies everything that an experiment holds but these: without it no experiment goes to
# another process
copyreg.pickle(MappingProxyType, _reduced)


def run_edges(mask: BoolArray) -> IntArray:
    """Find where runs of true values begin and end.

    Args:
        mask: Truth per sample; shape (n,).

    Returns:
        Index of the first sample of every run, and of the first one behind it; shape (runs, 2).
    """
    return np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8))).reshape(-1, 2)


def true_runs(mask: BoolArray) -> list[tuple[int, int]]:
    """Find the runs of true values.

    Args:
        mask: Truth per sample; shape (n,).

    Returns:
        First and last index of every run.
    """
    return [(first, behind - 1) for first, behind in run_edges(mask).tolist()]
