# SPDX-License-Identifier: BSD-3-Clause
"""What is printed where the terminal has fewer letters than a table: signs are spelled, nothing is a traceback."""

from __future__ import annotations

import codecs
import sys
from io import TextIOWrapper

_SPELLED = {"±": "+-", "─": "-", "²": "2", "°": "deg", "≤": "<=", "≥": ">=", "·": "*", "✓": "ok", "✗": "x"}
_HANDLER = "forcetorque.spelled"


def spell_missing_letters() -> None:
    """Let standard output and standard error spell what their encoding lacks, as under `LC_ALL=C`."""
    codecs.register_error(_HANDLER, _spelled)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # not where a test or a notebook has put something else
            stream.reconfigure(errors=_HANDLER)


def _spelled(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    letters = error.object[error.start : error.end]
    # a name that is not text in the file system's encoding holds surrogates
    return "".join(_SPELLED.get(letter, f"\\x{ord(letter):x}") for letter in letters), error.end
