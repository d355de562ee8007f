# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the findings of a log over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from forcetorque.base.errors import ForceTorqueError
from forcetorque.inspection.answers import events, is_about_all
from forcetorque.results.figures import GRID, MUTED, headline, in_figure_style, new_figure, shown_name
from forcetorque.results.visual_roles import CONTACT, FINDING, USES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.inspection.inspect import FindingRow, Inspection

_ROW_INCHES, _EDGE_INCHES = 0.3, 1.3
"""Height of a row, and of all that is no row; inch."""
_MOST_ROWS = 40
"""Rows that are drawn; the others are counted."""
_IN_USE = "calibration, validation"


@in_figure_style
def findings_figure(result: Inspection) -> Figure:
    """Draw when each kind of finding is there, a row for each stream, kind and channels, and what is in use.

    What holds for nearly all of the time, or has no time, is a bar over all of it.

    Args:
        result: The inspection of a log or an experiment.

    Returns:
        The figure.

    Raises:
        ForceTorqueError: If nothing has a time, as in the calibration of a maker.
        MissingExtraError: If matplotlib is not installed.
    """
    duration = result.duration_s
    if not duration > 0.0:
        raise ForceTorqueError(f"{result.source}: expected a log over time to draw its findings, got none")
    rows: dict[tuple[str, str], list[FindingRow]] = {}
    for row in result.findings:
        rows.setdefault((row.stream, row.kind), []).append(row)
    shown = list(rows.items())[:_MOST_ROWS]
    figure = new_figure(_EDGE_INCHES + _ROW_INCHES * (len(shown) + 1))
    panel = figure.subplots()
    for start, end in result.in_use_s:
        panel.barh(0, end - start, left=start, height=0.5, color=USES["validation"].colour)
    names = [_IN_USE if result.in_use_s else "nothing in use"]
    for place, ((stream, kind), found) in enumerate(shown, start=1):
        names.append(shown_name(f"{stream}: {kind.replace('_', ' ')}"))
        colour = CONTACT.colour if "contact" in kind else FINDING.colour
        for row in found:
            whole = is_about_all(row, duration)
            start, end = (0.0, duration) if whole else (row.start_s or 0.0, row.end_s or 0.0)
            panel.barh(place, end - start, left=start, height=0.6, color=colour, alpha=0.25 if whole else 0.6)
            if not whole:  # one sample is seen too
                panel.plot([start, start], [place - 0.3, place + 0.3], color=colour, linewidth=1.2)
        panel.annotate(
            _number(found), (1.0, place), xycoords=("axes fraction", "data"), xytext=(4, 0),
            textcoords="offset points", va="center", color=MUTED, annotation_clip=False,
        )  # fmt: skip
    panel.set_yticks(range(len(names)), names)
    panel.set(ylim=(len(names) - 0.4, -0.6), xlim=(0.0, duration), xlabel="time, s")
    panel.grid(axis="x", color=GRID, linewidth=0.6)
    headline(figure, _message(result, len(rows) - len(shown)))
    return figure


def _number(found: list[FindingRow]) -> str:
    """How many there are, and the largest size."""
    sizes = [(abs(row.size), row.unit) for row in found if row.size is not None and row.unit is not None]
    size, unit = max(sizes, default=(0.0, ""), key=lambda one: one[0])
    number = f"{len(found)} x" if len(found) > 1 else ""
    return f"{number}{', ' if number and unit else ''}{f'{size:.3g} {unit}' if unit else ''}"


def _message(result: Inspection, left_out: int) -> str:
    found = events(result.findings, result.duration_s)
    spoilt = sum(event.spoils(result.in_use_s) for event in found)
    in_use = f", {spoilt} in what is calibrated or validated" if result.in_use_s else ""
    more = f"; {left_out} more kinds are not drawn" if left_out else ""
    number = f"{len(found)} event{'' if len(found) == 1 else 's'}"
    return f"{shown_name(result.source)}: {number} in {result.duration_s:.1f} s{in_use}{more}"
