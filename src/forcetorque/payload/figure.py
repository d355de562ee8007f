# SPDX-License-Identifier: BSD-3-Clause
"""Figure of loads: mass and centre of mass with their intervals, of all recordings and of each by itself."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from forcetorque.base.errors import ShapeError
from forcetorque.payload.result import LoadRow, RecordingLoadRow, load_words
from forcetorque.results.figures import headline, in_figure_style, legend_below, look, new_figure, shown_name
from forcetorque.results.visual_roles import PRIOR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW_INCHES, _FRAME_INCHES = 0.45, 1.6
"""Height of a load, and of axes and titles; inch."""
_ALL, _ALONE = look(0), look(1)
_STATED: dict[str, Any] = {"color": PRIOR.colour, "marker": PRIOR.marker, "linestyle": "none"}


@in_figure_style
def load_figure(loads: Sequence[LoadRow], recordings: Sequence[RecordingLoadRow] = ()) -> Figure:
    """Draw loads.

    Args:
        loads: Loads by all recordings together.
        recordings: The same by each recording alone.

    Returns:
        The figure: a row per load, below it one per recording; mass and the three coordinates of the centre of mass,
        with their 95 % intervals.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no load.
    """
    if not loads:
        raise ShapeError("loads: expected at least one to draw, got none")
    rows = [row for load in loads for row in (load, *(one for one in recordings if one.load == load.load))]
    figure = new_figure(_FRAME_INCHES + _ROW_INCHES * max(len(rows), 2))
    panels = figure.subplots(1, 4, sharey=True)
    for place, row in enumerate(rows):
        _draw(panels[0], place, row, row.mass_kg, row.mass_half_width_95_kg)
        for k, panel in enumerate(panels[1:]):
            centre, half_width = row.centre_of_mass_m[k], row.centre_of_mass_half_width_95_m[k]
            _draw(panel, place, row, _in_mm(centre), _in_mm(half_width))
    for panel, title in zip(panels, ("mass, kg", *(f"centre of mass {axis}, mm" for axis in "xyz")), strict=True):
        panel.set_title(title, loc="left")
        panel.margins(x=0.2)
        panel.locator_params(axis="x", nbins=5)
    panels[0].set_ylim(len(rows) - 0.5, -0.5)
    names = [row.recording if isinstance(row, RecordingLoadRow) else row.load for row in rows]
    panels[0].set_yticks(range(len(rows)), [shown_name(name) for name in names])
    headline(figure, f"{shown_name(loads[0].load)}: {load_words(loads[0].model_copy(update={'load': 'load'}))}")
    keys = [("estimated; line: 95 % interval", _ALL.key | {"linestyle": "-"})]
    if recordings:
        keys.append(("by one recording", _ALONE.key | {"linestyle": "-"}))
    if any(not row.estimated for row in rows):
        keys.append(("as stated", _STATED))
    legend_below(figure, keys)
    return figure


def _in_mm(value: float | None) -> float | None:
    return None if value is None else 1e3 * value


def _draw(panel: Axes, place: int, row: LoadRow, value: float | None, half_width: float | None) -> None:
    if value is None:
        panel.text(0.5, place, "open", transform=panel.get_yaxis_transform(), ha="center", va="center")
        return
    style = _ALONE if isinstance(row, RecordingLoadRow) else _ALL
    mark: dict[str, Any] = (
        {"color": style.colour, "marker": style.marker, "linestyle": "none"} if row.estimated else _STATED
    )
    if half_width is not None and row.estimated:
        panel.plot([value - half_width, value + half_width], [place, place], color=style.colour, linewidth=1.8)
    panel.plot(value, place, markersize=7.0, **mark)
