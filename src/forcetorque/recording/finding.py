# SPDX-License-Identifier: BSD-3-Clause
"""Findings: what is wrong with a recording, where and how much."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One observation about the quality of a stream."""

    stream: str
    """Stream in which it was found."""
    kind: str
    """Kind of the finding, such as `failed_group`."""
    message: str
    """What was found, with numbers."""
    count: int
    """Number of samples concerned."""
    start_ns: int | None = None
    """Stamp of the first sample concerned."""
    end_ns: int | None = None
    """Stamp of the last sample concerned."""
    channel: str | None = None
    """Signal or column concerned, where it is not the whole stream."""
    size: float | None = None
    """How large it is, in `unit`."""
    unit: str | None = None
    """Unit of the size."""
