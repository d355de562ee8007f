# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of many messages at once: those that share texts and lengths have their fields at the same places."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.ros.cursor import Cursor
from forcetorque.formats.ros.messages import Fields

MOST_LAYOUTS = 1000
"""Kinds of messages in a topic, by names and lengths; more make reading as slow as one by one."""

_Bytes = npt.NDArray[np.uint8]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Batch:
    """Messages whose fields lie at the same places; n of them."""

    rows: IntArray
    """Which messages of those that were given; shape (n,)."""
    fields: tuple[Fields, ...]
    """Where the fields lie."""
    data: _Bytes
    """The messages; shape (n, bytes)."""

    def numbers(self, start: int, count: int) -> FloatArray:
        """Read float64 numbers.

        Args:
            start: Their first byte.
            count: How many.

        Returns:
            The numbers; shape (n, count).
        """
        return self._as(start, 8 * count, "<f8")

    def stamp_ns(self, start: int) -> IntArray:
        """Read stamps.

        Args:
            start: Their first byte.

        Returns:
            The stamps; shape (n,); ns.
        """
        seconds, nanoseconds = self._as(start, 8, "<u4").astype(np.int64).T
        return seconds * 1_000_000_000 + nanoseconds

    def counters(self, start: int) -> IntArray:
        """Read counters.

        Args:
            start: Their first byte.

        Returns:
            The counters; shape (n,).
        """
        return self._as(start, 4, "<u4")[:, 0].astype(np.int64)

    def _as(self, start: int, size: int, kind: str) -> npt.NDArray[Any]:
        return np.ascontiguousarray(self.data[:, start : start + size]).view(kind)


def decode(
    messages: Sequence[bytes], find: Callable[[Cursor], tuple[Fields, ...]], *, cdr: bool, topic: str
) -> Iterator[Batch]:
    """Find the fields of messages of one topic.

    Args:
        messages: The messages.
        find: Finds the fields of one.
        cdr: Whether they are encoded as in ROS 2.
        topic: Topic, for messages of errors.

    Yields:
        Messages that are alike.

    Raises:
        FormatError: If a message is not whole, or hardly two are alike.
    """
    lengths: IntArray = np.fromiter(map(len, messages), dtype=np.int64, count=len(messages))
    layouts = 0
    for length in np.unique(lengths):
        rows = np.flatnonzero(lengths == length)
        joined = b"".join(messages if len(rows) == len(messages) else [messages[row] for row in rows.tolist()])
        data = np.frombuffer(joined, dtype=np.uint8).reshape(len(rows), length)
        while len(rows):
            layouts += 1
            cursor = Cursor(data=messages[int(rows[0])], cdr=cdr) if length else None
            if cursor is None or layouts > MOST_LAYOUTS:
                raise FormatError(f"{topic}: expected messages of few kinds, got empty ones or {layouts} kinds")
            try:
                fields = find(cursor)
            except FormatError as error:
                raise FormatError(f"{topic}: message {rows[0] + 1}: {error}") from error
            alike = np.ones(len(rows), dtype=bool)
            for start, end in cursor.shared:
                alike &= (data[:, start:end] == data[0, start:end]).all(axis=1)
            yield Batch(rows=rows[alike], fields=fields, data=data[alike] if not alike.all() else data)
            rows, data = rows[~alike], data[~alike]
