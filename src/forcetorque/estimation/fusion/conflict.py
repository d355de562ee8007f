# SPDX-License-Identifier: BSD-3-Clause
"""Whether sources contradict each other by more than they allow for, and which one is in conflict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from forcetorque.estimation.fusion.disagreement import Disagreement, Innovation, disagreement
from forcetorque.estimation.fusion.windows import WindowMeans


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """What the sources of an interval, or of a window, have against each other."""

    is_there: bool
    """Whether they disagree by more than chance makes them."""
    everyone: Disagreement
    """Of all sources."""
    without: Mapping[str, Disagreement]
    """Of the others, by the source that is left out."""
    suspects: tuple[str, ...]
    """Sources without which the others agree, where there is a conflict."""

    @property
    def source(self) -> str | None:
        """The source in conflict; None without conflict, and where several or none alone explain it."""
        return self.suspects[0] if len(self.suspects) == 1 else None

    def innovation(self, source: str) -> Innovation:
        """Give the innovation of one source against all others together.

        Args:
            source: Its name.

        Returns:
            What the disagreement is less without it.
        """
        total, rest = self.everyone.total, self.without[source].total
        return Innovation(
            chi2=total.chi2 - rest.chi2, degrees_of_freedom=total.degrees_of_freedom - rest.degrees_of_freedom
        )


def conflict_between(sources: Mapping[str, WindowMeans], false_alarm: float) -> Conflict:
    """Look for a conflict, and for the source without which there is none.

    Sums of squared normalised innovations are distributed as chi-squared if covariances are right and errors normal, so
    the rate of false alarms is the one asked for. Of two sources, nothing tells which is wrong.

    Args:
        sources: Means of every source over the same windows, by name.
        false_alarm: Rate of false alarms that is allowed.

    Returns:
        The conflict, if there is one.
    """
    everyone = disagreement(tuple(sources.values()))
    without = {name: disagreement([one for other, one in sources.items() if other != name]) for name in sources}
    alarmed = everyone.alarms(false_alarm)
    return Conflict(
        is_there=alarmed,
        everyone=everyone,
        without=without,
        suspects=tuple(name for name, rest in without.items() if alarmed and not rest.alarms(false_alarm)),
    )
