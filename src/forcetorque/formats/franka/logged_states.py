# SPDX-License-Identifier: BSD-3-Clause
"""The texts in which libfranka writes robot states [1]: an object of JSON for each, or a table of joint values.

`std::cout << state` writes a state as one object with the names of the fields; `logToCSV` a table with headings such as
`state.q[0]`. Time is in ms.

References:
[1] frankarobotics/libfranka, src/robot_state.cpp, src/logging/robot_state_log.cpp.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import require_file
from forcetorque.base.rows_on_disk import RowsOnDisk, rows_where
from forcetorque.formats.arm_log import first_of_repeats
from forcetorque.formats.decoded_parts_cache import kept
from forcetorque.formats.tabular.table import read_numbers
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal

LENGTHS = {
    "O_T_EE": 16,
    "F_T_EE": 16,
    "EE_T_K": 16,
    "O_F_ext_hat_K": 6,
    "K_F_ext_hat_K": 6,
    "m_ee": 1,
    "m_load": 1,
    "F_x_Cload": 3,
    "q": 7,
    "dq": 7,
    "tau_J": 7,
    "tau_ext_hat_filtered": 7,
}
"""Numbers of each field that is read."""
_TIME = "time"
_JOINT_FIELDS = ("q", "dq", "tau_J", "tau_ext_hat_filtered")
"""Fields of a state in a table."""
_LONGEST_LINE = 1 << 20
"""Bytes of a state, which has some thousand characters."""
_BLOCK = 1024
"""States that are lists of numbers at a time."""
_LATEST_MS = 9.2e12
"""Later instants do not fit into 64 bits of nanoseconds."""
_NS_PER_MS = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedStates:
    """What a controller sent, each cycle once."""

    stamp_ns: IntArray
    """Time since the controller started; shape (n,), rising; ns."""
    values: Mapping[str, FloatArray]
    """Numbers by field; shape (n, k); as the controller sends them."""
    repeated: int
    """States that had the same time as the one before."""
    is_cut: bool
    """Whether the last line is not complete, and is left out."""


def _headings(field: str) -> tuple[str, ...]:
    return tuple(f"state.{field}[{k}]" for k in range(LENGTHS[field]))


def _first_line(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.readline(_LONGEST_LINE)


def _table_fields(line: bytes) -> tuple[str, ...]:
    """Fields of a table of logToCSV, as far as all their columns are there; none for another text."""
    names = {name.strip() for name in line.decode("ascii", errors="replace").split(",")}
    if _TIME not in names:
        return ()
    return tuple(field for field in _JOINT_FIELDS if set(_headings(field)) <= names)


def _object_fields(line: bytes) -> tuple[str, ...]:
    """Fields of a state as an object of JSON; none for another text."""
    if not line.lstrip().startswith(b"{"):
        return ()
    try:
        state = json.loads(line)
    except (ValueError, RecursionError):
        return ()
    named = (
        isinstance(state, dict) and {_TIME, "tau_J"} & set(state) and {"O_T_EE", "tau_ext_hat_filtered"} & set(state)
    )
    return tuple(field for field in LENGTHS if field in state) if named else ()


def is_logged_states(path: Path) -> bool:
    """Check whether a file has states of libfranka, by its first line.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it has.
    """
    if not path.is_file():
        return False
    line = _first_line(path)
    return bool(_object_fields(line)) or "tau_J" in _table_fields(line)


def read_states(path: Path) -> LoggedStates:
    """Read states; their numbers are in temporary files where they are many.

    Args:
        path: The file.

    Returns:
        Their fields.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it has no states, one is damaged, or time goes back.
    """
    require_file(path, "a log of robot states of libfranka")
    return kept(path, "states", lambda: _read_states(path))


def _read_states(path: Path) -> LoggedStates:
    line = _first_line(path)
    if fields := _object_fields(line):
        time_ms, numbers, is_cut = _objects(path, fields)
        for row in np.flatnonzero(~(np.abs(time_ms) < _LATEST_MS))[:1]:
            raise FormatError(f"{path}: state {row + 1}: {_TIME}: expected milliseconds, got {time_ms[row]:g}")
        stamp_ns = np.rint(time_ms).astype(np.int64) * _NS_PER_MS
    elif fields := _table_fields(line):
        stamp_ns, numbers = _table(path, fields)
        is_cut = False
    else:
        raise FormatError(
            f"{path}: expected states of libfranka, an object of JSON with O_T_EE in each line or a table with "
            "state.tau_J[0], got another file"
        )
    is_first = first_of_repeats(stamp_ns, path)
    stamps, *values = rows_where(is_first, [stamp_ns, *numbers])
    return LoggedStates(
        stamp_ns=stamps,
        values=dict(zip(fields, values, strict=True)),
        repeated=int((~is_first).sum()),
        is_cut=is_cut,
    )


def _table(path: Path, fields: Sequence[str]) -> tuple[IntArray, list[FloatArray]]:
    signals = tuple(
        TableSignal(quantity=field, columns=_headings(field), units=("1",) * LENGTHS[field]) for field in fields
    )
    return read_numbers(path, TableLayout(stamp=StampColumn(column=_TIME, unit="ms"), signals=signals))


def _objects(path: Path, fields: Sequence[str]) -> tuple[FloatArray, list[FloatArray], bool]:
    """Times, shape (n,), ms; numbers of each field, shape (n, k); and whether the last line is cut."""
    columns = [RowsOnDisk((1,)), *(RowsOnDisk((LENGTHS[field],)) for field in fields)]
    ends = np.cumsum([1, *(LENGTHS[field] for field in fields)])[:-1]
    rows: list[list[float]] = []
    is_cut = False

    def write() -> None:
        if rows:
            for column, numbers in zip(columns, np.split(np.array(rows), ends, axis=1), strict=True):
                column.append(numbers)
            rows.clear()

    with path.open("rb") as file:
        for number, line in enumerate(iter(lambda: file.readline(_LONGEST_LINE), b""), start=1):
            if not line.strip():
                continue
            try:
                rows.append(_numbers(json.loads(line), fields))
            except (ValueError, TypeError, KeyError, OverflowError, RecursionError) as error:
                is_cut = not line.endswith(b"\n") and isinstance(error, json.JSONDecodeError) and not file.read(1)
                if is_cut:
                    break
                raise FormatError(
                    f"{path}:{number}: expected a state with {_TIME}, {', '.join(fields)} as the first line has, got "
                    f"{' '.join(str(error).split())[:120]}; remove the line"
                ) from error
            if len(rows) == _BLOCK:
                write()
    write()
    time, *values = (column.mapped() for column in columns)
    return time[:, 0], values, is_cut


def _numbers(state: Any, fields: Sequence[str]) -> list[float]:
    if not isinstance(state, dict):
        raise TypeError("no object")
    numbers = [float(state[_TIME])]
    for field in fields:
        values = state[field] if LENGTHS[field] > 1 else [state[field]]
        if not isinstance(values, list) or len(values) != LENGTHS[field]:
            raise ValueError(f"{field} without {LENGTHS[field]} numbers")
        numbers += map(float, values)
    if not np.isfinite(numbers).all():
        raise ValueError("a number that is not finite")
    return numbers
