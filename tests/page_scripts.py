# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of Python on pages: those between marks run after the demonstration, as they stand."""

from __future__ import annotations

import io
import re
from contextlib import redirect_stdout


def marked(page: str) -> list[str]:
    """Blocks between `<!-- example -->` and `<!-- /example -->`."""
    return re.findall(r"^<!-- example -->\n```python\n(.*?)^```\n<!-- /example -->$", page, re.DOTALL | re.MULTILINE)


def unmarked(page: str) -> list[str]:
    """All other blocks."""
    codes = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    return [code for code in codes if code not in marked(page)]


def printed(code: str, name: str) -> str:
    """Run a program in this process and give what it writes to standard output.

    Args:
        code: Its text.
        name: What tracebacks call it, and its own `__file__`.
    """
    written = io.StringIO()
    with redirect_stdout(written):
        exec(compile(code, name, "exec"), {"__name__": "__main__", "__file__": name})
    return written.getvalue()
