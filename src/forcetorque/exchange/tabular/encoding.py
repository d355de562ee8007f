# SPDX-License-Identifier: BSD-3-Clause
"""Text files as UTF-8, whatever encoding the mark at their beginning states."""

from __future__ import annotations

import codecs
from pathlib import Path
from typing import BinaryIO, cast

_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def open_text(file: Path) -> BinaryIO:
    """Open a text file.

    Args:
        file: The file; it exists.

    Returns:
        Its bytes, those of UTF-16 as UTF-8 where the file begins with a byte-order mark; what is no character becomes
        one that no number has, so that the reader of the line refuses it.
    """
    stream = file.open("rb")
    mark = stream.read(len(_MARKS[0]))
    stream.seek(0)
    if mark not in _MARKS:
        return stream
    return cast(BinaryIO, codecs.EncodedFile(stream, "utf-8", "utf-16", errors="replace"))
