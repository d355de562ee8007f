# SPDX-License-Identifier: BSD-3-Clause
"""Questions to the person at the terminal, on standard error."""

from __future__ import annotations

import sys

import typer


def is_terminal() -> bool:
    """Tell whether a person can answer.

    Returns:
        Whether standard input is a terminal.
    """
    return sys.stdin.isatty()


def ask(question: str) -> str:
    """Ask for a value.

    Args:
        question: The question.

    Returns:
        The answer; empty to leave it open.
    """
    sys.stderr.write(f"{question}\n")
    return str(typer.prompt("answer (empty to leave it open)", default="", show_default=False, err=True))


def accepts(proposal: str) -> bool:
    """Ask whether a proposal is accepted.

    Args:
        proposal: The proposal.

    Returns:
        Whether it is; no if the answer is empty.
    """
    sys.stderr.write(f"{proposal}\n")
    return bool(typer.confirm("change the file so", default=False, err=True))
