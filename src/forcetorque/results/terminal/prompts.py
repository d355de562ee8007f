# SPDX-License-Identifier: BSD-3-Clause
"""Questions to the person at the terminal, on standard error."""

from __future__ import annotations

import select
import sys
from io import BufferedReader

import typer


def is_terminal() -> bool:
    """Tell whether a person can answer.

    Returns:
        Whether standard input is a terminal; none that is closed.
    """
    return sys.stdin is not None and not sys.stdin.closed and sys.stdin.isatty()


def has_piped_lines() -> bool:
    """Tell whether lines wait on a standard input that is no terminal.

    Returns:
        Whether there are; an empty or closed one, such as `/dev/null`, has none, and so has one that cannot be asked.
    """
    if is_terminal():
        return False
    try:
        ready, _, _ = select.select([sys.stdin], [], [], 0.0)
        return bool(ready) and isinstance(sys.stdin.buffer, BufferedReader) and bool(sys.stdin.buffer.peek(1))
    except (OSError, ValueError, AttributeError):
        return False


def ask(question: str) -> str:
    """Ask for a value.

    Returns:
        The answer; empty to leave it open.
    """
    sys.stderr.write(f"{question}\n")
    return str(typer.prompt("answer (empty to leave it open)", default="", show_default=False, err=True))


def accepts(proposal: str) -> bool:
    """Ask whether a proposal is accepted.

    Returns:
        Whether it is; no if the answer is empty.
    """
    sys.stderr.write(f"{proposal}\n")
    return bool(typer.confirm("change the file so", default=False, err=True))
