# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of the numbers of lines that share a skeleton, by Arrow's CSV reader."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv as pacsv

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.bottle import Bottle, leaves
from forcetorque.exchange.yarp.message_line import is_number

_PUNCTUATION = b"()[]okfail"
"""What stands in a line besides numbers and spaces; no `e`, which belongs to numbers."""
_STAMP_TYPE = pa.decimal128(19, 9)
"""A float64 resolves 240 ns at today's epoch, so stamps are read as decimals, which are exact."""
_NS_PER_S = pa.scalar(10**9, pa.decimal128(10, 0))
_ARROW_BLOCK_SIZE = 1 << 18
"""Bytes that one thread of Arrow converts at a time."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Numbers:
    """Numbers of n lines."""

    sequence: IntArray
    """Sequence numbers; shape (n,)."""
    stamps_ns: IntArray
    """Stamps in the order of the line; shape (1 or 2, n); ns."""
    values: FloatArray
    """Chosen numbers of the messages; shape (n, width); NaN where a message has none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberLayout:
    """Where the numbers of a skeleton stand among the spaces once brackets and flags are deleted."""

    n_cells: int
    """Number of cells that the spaces separate; those of deleted flags and empty lists are empty."""
    head: tuple[int, ...]
    """Cells of the sequence number and the stamps."""
    wanted: tuple[int | None, ...]
    """Cell of each value that is wanted; None where the message has none."""


def layout_of(line: bytes, bottle: Bottle, *, n_stamps: int, chosen: Sequence[int | None]) -> NumberLayout:
    """Find the cells of the numbers in one line; every line of the same skeleton has the same.

    Args:
        line: The line without its end.
        bottle: The same line, parsed.
        n_stamps: Stamps that stand before the message.
        chosen: For each value that is wanted, which number of the message it is; None: not there.

    Returns:
        The layout.

    Raises:
        FormatError: If two elements touch, so that two numbers would become one.
    """
    texts = line.translate(None, _PUNCTUATION).split(b" ")
    cells = tuple(i for i, text in enumerate(texts) if text)
    if len(cells) != sum(map(is_number, leaves(bottle))):
        raise FormatError("expected a space between all elements, got two that touch; delete the line")
    n_head = 1 + n_stamps
    return NumberLayout(
        n_cells=len(texts),
        head=cells[:n_head],
        wanted=tuple(None if which is None else cells[n_head + which] for which in chosen),
    )


def convert(text: bytes, layout: NumberLayout) -> Numbers | None:
    """Convert the sequence numbers, the stamps and the wanted numbers of some lines.

    Numbers that are not wanted are not converted: in logs of boards they are two thirds.

    Args:
        text: Lines of the layout.
        layout: Where their numbers stand.

    Returns:
        The numbers, or None if something made of the characters of numbers is not a finite number.
    """
    types = dict(zip(layout.head, (pa.int64(), _STAMP_TYPE, _STAMP_TYPE), strict=False))
    types |= {cell: pa.float64() for cell in layout.wanted if cell is not None}
    names = {str(cell): kind for cell, kind in types.items()}
    try:
        table = pacsv.read_csv(
            pa.BufferReader(text.translate(None, _PUNCTUATION)),
            read_options=pacsv.ReadOptions(
                column_names=[str(cell) for cell in range(layout.n_cells)], block_size=_ARROW_BLOCK_SIZE
            ),
            parse_options=pacsv.ParseOptions(delimiter=" ", quote_char=False, ignore_empty_lines=False),
            convert_options=pacsv.ConvertOptions(column_types=names, include_columns=list(names), null_values=[]),
        )
        sequence, *stamps = (table.column(str(cell)) for cell in layout.head)
        stamps_ns = [pc.multiply(stamp, _NS_PER_S).cast(pa.int64()).to_numpy() for stamp in stamps]
    except pa.ArrowException:
        return None
    values = np.full((table.num_rows, len(layout.wanted)), np.nan)
    for column, cell in zip(values.T, layout.wanted, strict=True):
        if cell is not None:
            column[:] = table.column(str(cell)).to_numpy()
            if not np.isfinite(column).all():
                return None
    return Numbers(sequence=sequence.to_numpy(), stamps_ns=np.array(stamps_ns), values=values)
