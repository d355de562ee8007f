# SPDX-License-Identifier: BSD-3-Clause
"""Text for Arrow: the same bytes, of which Arrow's threads hold nothing of Python."""

from __future__ import annotations

import sys

import pyarrow as pa

from forcetorque.base.arrow import arrow_text


def test_arrow_holds_nothing_of_python() -> None:
    """The text has as many owners as before; with a reader of Python's own bytes it has one more."""
    text = b"1,2\n" * 1000
    owners = sys.getrefcount(text)
    source = arrow_text(text)
    assert sys.getrefcount(text) == owners
    assert source.read() == text
    shared = pa.BufferReader(text)
    assert sys.getrefcount(text) > owners
    assert shared.read() == text
