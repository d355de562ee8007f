# SPDX-License-Identifier: BSD-3-Clause
"""Contests as scripts and notebooks ask for them, with a file or without."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path

from forcetorque import analysis
from forcetorque.created import created_now


def contest(entries: analysis.Entries | Path | str) -> analysis.Contest:
    """Rank sensors and methods on the same loads: `contest("contest.toml")`.

    Args:
        entries: Runs and contestants, or the file that states them.

    Returns:
        Ranks, scores and pairs; it shows itself as tables.
    """
    stated = entries if isinstance(entries, analysis.Entries) else analysis.read_entries(entries)
    created = created_now()
    return analysis.contest(stated, code_version=version("forcetorque"), created=created)
