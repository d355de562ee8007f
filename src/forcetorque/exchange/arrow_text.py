# SPDX-License-Identifier: BSD-3-Clause
"""Text for Arrow's reader of tables, in memory that Python has no part in."""

from __future__ import annotations

from typing import Any

import pyarrow as pa


def arrow_text(text: bytes) -> Any:
    """Copy text to memory of Arrow.

    A thread of Arrow may let go of what it read after the table was given back. If that is an object of Python, it
    waits for the interpreter, and a program that ends at that instant is aborted: no error code, SIGABRT.

    Args:
        text: The text.

    Returns:
        A `pyarrow.BufferReader` that holds no object of Python.
    """
    sink = pa.BufferOutputStream()
    sink.write(text)
    return pa.BufferReader(sink.getvalue())
