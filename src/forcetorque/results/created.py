# SPDX-License-Identifier: BSD-3-Clause
"""When a result is made, as results state it."""

from __future__ import annotations

from datetime import UTC, datetime


def created_now() -> str:
    """Say when it is.

    Returns:
        Date and time in UTC as ISO 8601 writes them, to the second.
    """
    return datetime.now(UTC).isoformat(timespec="seconds")
