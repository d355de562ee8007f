# SPDX-License-Identifier: BSD-3-Clause
"""Columns of Parquet and Arrow with a list of numbers in every row, as one per element: `wrench[0]`, `wrench[1]`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc

from forcetorque.base.errors import FormatError

_FIRST_ROWS = 1024
"""Rows of which the first list gives the length of all."""
_MOST_ELEMENTS = 1000
"""Longer lists are no columns."""


def element_name(column: str, element: int) -> str:
    """Name the column of an element.

    Args:
        column: Name of the column of lists.
        element: Place of the element, from 0.

    Returns:
        The name.
    """
    return f"{column}[{element}]"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatColumns:
    """Columns of a file of Parquet or Arrow, those of lists as one per element."""

    names: tuple[str, ...]
    """Names of all columns, in the order of the file."""
    elements: Mapping[str, tuple[str, int]]
    """Column of lists and place in the list, from 0, by the name of an element."""
    lengths: Mapping[str, int]
    """Length of the lists, by the name of their column."""

    @classmethod
    def of(cls, table: Any) -> FlatColumns:
        """Look at the columns of a file.

        Args:
            table: Open `pyarrow.parquet.ParquetFile`, or `ArrowFile`.

        Returns:
            Its columns.
        """
        schema = table.schema_arrow
        lists = [field.name for field in schema if _is_list(field.type) and schema.names.count(field.name) == 1]
        first = next(table.iter_batches(batch_size=_FIRST_ROWS, columns=lists), None) if lists else None
        found = {} if first is None else {name: _length(first.column(name)) for name in lists}
        lengths = {name: length for name, length in found.items() if length is not None}
        names: list[str] = []
        elements: dict[str, tuple[str, int]] = {}
        for name in schema.names:
            of_list = tuple(element_name(name, k) for k in range(lengths.get(name, 0)))
            elements |= {element: (name, k) for k, element in enumerate(of_list)}
            names += of_list or [name]
        return cls(names=tuple(names), elements=elements, lengths=lengths)

    def sources(self, columns: Sequence[str]) -> list[str]:
        """Name the columns of the file that hold some columns.

        Args:
            columns: Names from `names`.

        Returns:
            Each once.
        """
        return list(dict.fromkeys(self.elements[name][0] if name in self.elements else name for name in columns))

    def uneven(self, batch: Any, place: Callable[[int], str]) -> dict[str, str]:
        """Find columns of lists that are of several lengths.

        Args:
            batch: Rows of all columns.
            place: Gives the location of a row of the batch, for messages, by its number from 0.

        Returns:
            What is wrong with each, by its name in the file.
        """
        rows = {name: self._row_of_other_length(_column(batch, name), name) for name in self.lengths}
        return {
            name: f"lists of several lengths: {place(row)} has {len(_column(batch, name)[row])} numbers, the first "
            f"rows {self.lengths[name]}"
            for name, row in rows.items()
            if row >= 0
        }

    def flattened(self, batch: Any, columns: Sequence[str], place: Callable[[int], str]) -> Any:
        """Take the elements of lists apart.

        Args:
            batch: Rows of the columns that `sources` names.
            columns: Names from `names`.
            place: Gives the location of a row of the batch, for messages, by its number from 0.

        Returns:
            The same rows, with a column of numbers for each name.

        Raises:
            FormatError: If a row has a list of another length than the first.
        """
        wanted = set(columns)
        for name in self.sources([element for element in self.elements if element in wanted]):
            self._require_length(_column(batch, name), name, place)
        arrays = [self._flat_column(batch, name) for name in columns]
        return pa.RecordBatch.from_arrays(arrays, names=list(columns))

    def _flat_column(self, batch: Any, name: str) -> Any:
        if name not in self.elements:
            return _column(batch, name)
        source, element = self.elements[name]
        return pc.list_element(_column(batch, source), element)

    def _row_of_other_length(self, column: Any, name: str) -> int:
        """First row whose list has another length; -1 for none."""
        other = pc.fill_null(pc.not_equal(pc.list_value_length(column), self.lengths[name]), False)
        return int(pc.index(other, True).as_py())

    def _require_length(self, column: Any, name: str, place: Callable[[int], str]) -> None:
        row = self._row_of_other_length(column, name)
        if row >= 0:
            raise FormatError(
                f"{place(row)}: column {name!r}: expected a list of {self.lengths[name]} numbers as in the first rows, "
                f"got {len(column[row])}"
            )


def _column(batch: Any, name: str) -> Any:
    """The first column of a name, which two may have."""
    return batch.column(batch.schema.get_all_field_indices(name)[0])


def _is_list(kind: Any) -> bool:
    is_list = pa.types.is_list(kind) or pa.types.is_large_list(kind) or pa.types.is_fixed_size_list(kind)
    return bool(is_list and (pa.types.is_floating(kind.value_type) or pa.types.is_integer(kind.value_type)))


def _length(column: Any) -> int | None:
    """Length of the first list; None where there is none, or its elements are no columns."""
    lists = pc.drop_null(column)
    length = len(lists[0]) if len(lists) else 0
    return length if 0 < length <= _MOST_ELEMENTS else None
