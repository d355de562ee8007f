# SPDX-License-Identifier: BSD-3-Clause
"""Progress of long work, with the time that is left."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

Progress = Callable[[str], None]
"""Called with a line for people as work goes on, such as `print`."""

_LEAST_SHARE = 0.01
"""Share of the steps below which no time left is predicted (heuristic)."""


class TimeLeft:
    """Report how far a loop is: at most one line in a stated time, none of a loop that ends before the first."""

    __slots__ = ("_begun", "_every_s", "_last", "_now", "_progress", "_text", "_total")

    def __init__(
        self,
        progress: Progress,
        text: str,
        total: int,
        *,
        every_s: float = 3.0,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        """Begin.

        Args:
            progress: Called with every line.
            text: What is done.
            total: Number of steps, such as samples or files.
            every_s: Least time between two lines; s.
            now: Clock; s.
        """
        self._progress, self._text, self._total = progress, text, total
        self._every_s, self._now = every_s, now
        self._begun = self._last = now()

    def at(self, done: int) -> None:
        """Report that some steps are done.

        Args:
            done: Their number.
        """
        now = self._now()
        if now - self._last < self._every_s or not 0 < done < self._total:
            return
        self._last = now
        share = done / self._total
        # the first steps of a loop may be slower than all others
        left = f", {duration_text((now - self._begun) * (1.0 - share) / share)} left" if share >= _LEAST_SHARE else ""
        self._progress(f"{self._text}: {100.0 * share:.0f} %{left}")


def duration_text(seconds: float) -> str:
    """Write a duration as people say it.

    Args:
        seconds: The duration; s.

    Returns:
        Such as `40 s`, `12 min` or `2 h 5 min`.
    """
    if seconds < 90.0:
        return f"{math.ceil(seconds)} s"
    minutes = math.ceil(seconds / 60.0)
    hours, rest = divmod(minutes, 60)
    return f"{minutes} min" if minutes < 90 else f"{hours} h {rest} min"
