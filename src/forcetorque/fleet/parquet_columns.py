# SPDX-License-Identifier: BSD-3-Clause
"""Stored tables as columns of Parquet: nested types follow from the fields of a class, units are in their metadata."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from types import MappingProxyType, NoneType, UnionType
from typing import Annotated, Any, Final, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np
import pyarrow as pa
from pydantic import BaseModel

from forcetorque.base.arrays import ArrayField, FloatArray, IntArray

UNITS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "raw": "count",
        "extreme_raw": "count",
        "full_scale": "count",
        "limit_counts": "count",
        "reference": "N, N m",
        "flattening": "N, N m",
        "accuracy": "N, N m",
        "load_full_scale": "N, N m",
        "prior_size": "1",
        "prior": "N, N m per unit of what it multiplies",
        "prior_deviation": "N, N m per unit of the variable",
        "variables": "that of each variable",
        "extreme_variables": "that of each variable",
        "variable_minimum": "that of each variable",
        "variable_maximum": "that of each variable",
        "reference_value": "that of the variable",
        "mean": "count, that of each variable, N, N m",
        "second_moment": "products of count, those of the variables, N, N m",
        "model": "N, N m per unit of the term",
        "deviation": "that of the term",
        "nominal": "kg",
        "factor": "1, N, N m",
        "repeatability": "1",
        "size": "that of the column unit",
        "count": "1",
        "wrench": "N, N m",
        "changes": "that of the variable",
        "value": "that of the variable",
    }
)
"""Units of fields whose name does not have it."""
_SUFFIXES: Final[Mapping[str, str]] = MappingProxyType(
    {
        "ns": "ns",
        "s": "s",
        "N": "N",
        "Nm": "N m",
        "N2": "N2",
        "Nm2": "N2 m2",
        "counts": "count",
        "rad": "rad",
        "deg": "deg",
        "m": "m",
        "mm": "mm",
    }
)
_SCALARS: Final[Mapping[Any, Any]] = MappingProxyType(
    {str: pa.string(), int: pa.int64(), float: pa.float64(), bool: pa.bool_()}
)


def unit_of(name: str) -> str | None:
    """Give the unit of a field.

    Args:
        name: Its name.

    Returns:
        The unit, by the name's last part or `UNITS`; None for text and counts of samples.
    """
    _, underscore, last = name.rpartition("_")
    return UNITS.get(name, _SUFFIXES.get(last) if underscore else None)


@cache
def schema_of(table: type[BaseModel], metadata: tuple[tuple[str, str], ...] = ()) -> Any:
    """Give the schema of a file whose rows are tables of a class.

    Args:
        table: The class.
        metadata: Pairs of key and value of the file.

    Returns:
        `pyarrow.Schema`, with the unit of every number in the metadata of its field.
    """
    return pa.schema(_fields(table), metadata=dict(metadata))


def columns_of(table: type[BaseModel], rows: Sequence[BaseModel], metadata: tuple[tuple[str, str], ...] = ()) -> Any:
    """Put tables into columns.

    Args:
        table: Their class.
        rows: The tables.
        metadata: As of `schema_of`.

    Returns:
        `pyarrow.Table` with a row per table.
    """
    schema = schema_of(table, metadata)
    arrays = [_encoded(kind, [getattr(row, name) for row in rows]) for name, kind in _kinds(table).values()]
    return pa.Table.from_arrays(arrays, schema=schema)


def rows_of(table: type[BaseModel], columns: Any) -> list[dict[str, Any]]:
    """Take values out of columns.

    Args:
        table: Class of the tables.
        columns: `pyarrow.Table` that holds all of its columns or some.

    Returns:
        Values by column, a dictionary per row; arrays of NumPy where the class has them.
    """
    kinds = _kinds(table)
    decoded = {name: _decoded(kinds[name][1], columns.column(name).combine_chunks()) for name in columns.column_names}
    return [{name: values[k] for name, values in decoded.items()} for k in range(columns.num_rows)]


@cache
def _kinds(table: type) -> Mapping[str, tuple[str, Any]]:
    """Attribute and type of every field by its name in the file."""
    hints = get_type_hints(table, include_extras=True)
    if is_dataclass(table):
        return {field.name: (field.name, hints[field.name]) for field in fields(table)}
    models = table.model_fields.items()  # type: ignore[attr-defined]
    return {field.alias or name: (name, hints[name]) for name, field in models if not field.exclude}


def _fields(table: type) -> list[Any]:
    made = []
    for name, (_, kind) in _kinds(table).items():
        unit = unit_of(name)
        made.append(pa.field(name, _arrow_type(kind), metadata=None if unit is None else {"unit": unit}))
    return made


def _plain(kind: Any) -> Any:
    """The type without None, and without annotations that are not of an array."""
    if get_origin(kind) in (Union, UnionType):
        (kind,) = (one for one in get_args(kind) if one is not NoneType)
    if get_origin(kind) is Annotated and _depth(kind) == 0:
        return _plain(get_args(kind)[0])
    return kind


def _depth(kind: Any) -> int:
    """Number of axes of an array; 0 for anything else."""
    notes = get_args(kind)[1:] if get_origin(kind) is Annotated else ()
    return next((len(note.shape) for note in notes if isinstance(note, ArrayField)), 0)


def _is_struct(kind: Any) -> bool:
    return isinstance(kind, type) and (issubclass(kind, BaseModel) or is_dataclass(kind))


def _arrow_type(kind: Any) -> Any:
    kind = _plain(kind)
    if depth := _depth(kind):
        made = pa.float64()
        for _ in range(depth):
            made = pa.list_(made)
        return made
    if get_origin(kind) is tuple:
        return pa.list_(_arrow_type(get_args(kind)[0]))
    if get_origin(kind) is dict:
        return pa.map_(*map(_arrow_type, get_args(kind)))
    if _is_struct(kind):
        return pa.struct(_fields(kind))
    if get_origin(kind) is Literal or (isinstance(kind, type) and issubclass(kind, Enum)):
        return pa.string()
    return _SCALARS[kind]


def _encoded(kind: Any, values: Sequence[Any]) -> Any:
    kind, mask = _plain(kind), pa.array([value is None for value in values], pa.bool_())
    if depth := _depth(kind):
        return _encoded_arrays(values, depth, mask)
    if get_origin(kind) is tuple:
        children = _encoded(get_args(kind)[0], [child for value in values for child in value or ()])
        return pa.ListArray.from_arrays(_offsets([len(value or ()) for value in values]), children, mask=mask)
    if get_origin(kind) is dict:
        pairs = [pair for value in values for pair in (value or {}).items()]
        keys, items = (_encoded(one, [pair[k] for pair in pairs]) for k, one in enumerate(get_args(kind)))
        return pa.MapArray.from_arrays(_offsets([len(value or {}) for value in values]), keys, items)
    if _is_struct(kind):
        parts = [
            _encoded(child, [None if value is None else getattr(value, name) for value in values])
            for name, child in _kinds(kind).values()
        ]
        return pa.StructArray.from_arrays(parts, fields=_fields(kind), mask=mask)
    return pa.array([value.value if isinstance(value, Enum) else value for value in values], _arrow_type(kind))


def _offsets(lengths: Sequence[int]) -> Any:
    return pa.array(np.concatenate([[0], np.cumsum(lengths)]).astype(np.int32), pa.int32())


def _encoded_arrays(values: Sequence[FloatArray | None], depth: int, mask: Any) -> Any:
    present = [np.zeros((0,) * depth) if value is None else value for value in values]
    flat = pa.array(np.concatenate([value.ravel() for value in present] or [np.zeros(0)]), pa.float64())
    for axis in reversed(range(depth)):
        # an array of shape (a, b, c) has a lists of b lists of c numbers
        lengths = [
            np.full(int(np.prod(value.shape[:axis], dtype=np.int64)), value.shape[axis], dtype=np.int64)
            for value in present
        ]
        offsets = _offsets(np.concatenate(lengths) if lengths else np.zeros(0, dtype=np.int64))  # type: ignore[arg-type]
        flat = pa.ListArray.from_arrays(offsets, flat, mask=mask if axis == 0 else None)
    return flat


def _decoded(kind: Any, array: Any) -> list[Any]:
    kind = _plain(kind)
    if depth := _depth(kind):
        return _decoded_arrays(array, depth)
    if get_origin(kind) is tuple:
        children = _decoded(get_args(kind)[0], array.flatten())
        starts, lengths = _starts(array)
        return [
            tuple(children[start : start + length]) if valid else None
            for start, length, valid in zip(starts, lengths, array.is_valid().to_pylist(), strict=True)
        ]
    if get_origin(kind) is dict:
        return [dict(pairs or ()) for pairs in array.to_pylist()]
    if _is_struct(kind):
        known = {field.name for field in array.type}
        parts = {name: _decoded(child, array.field(name)) for name, (_, child) in _kinds(kind).items() if name in known}
        return [
            {name: values[k] for name, values in parts.items()} if valid else None
            for k, valid in enumerate(array.is_valid().to_pylist())
        ]
    return list(array.to_pylist())


def _starts(array: Any) -> tuple[IntArray, IntArray]:
    lengths = array.value_lengths().fill_null(0).to_numpy(zero_copy_only=False).astype(np.int64)
    return np.cumsum(lengths) - lengths, lengths


def _decoded_arrays(array: Any, depth: int) -> list[FloatArray | None]:
    valid, levels = array.is_valid().to_pylist(), []
    for _ in range(depth):
        levels.append(_starts(array))
        array = array.flatten()
    numbers = array.to_numpy(zero_copy_only=False)
    made: list[FloatArray | None] = []
    for row, present in enumerate(valid):
        shape: list[int] = []
        first = row
        for starts, lengths in levels:
            filled = all(shape)
            shape.append(int(lengths[first]) if filled else 0)
            first = int(starts[first]) if filled else 0
        count = int(np.prod(shape))
        made.append(numbers[first : first + count].reshape(shape) if present else None)
    return made
