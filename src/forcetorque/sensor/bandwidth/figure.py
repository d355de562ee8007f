# SPDX-License-Identifier: BSD-3-Clause
"""Figure of what a sensor does to fast forces: Bode plot with coherence and intervals, and the decays behind events."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.results.figures import (
    REFERENCE_COLOUR,
    ROW_INCHES,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.sensor.bandwidth.bandwidth import Response
from forcetorque.sensor.bandwidth.result import DecayCurve, ResponseCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


MOST_DECAYS = 8
"""Decays that are drawn."""
_COLUMNS = 4
_MEASURED, _FITTED = look(0), look(1)


@in_figure_style
def response_figure(response: Response) -> Figure:
    """Draw gain, phase and coherence over frequency, and the first decays.

    Args:
        response: The response; panels that it has nothing for are left out.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    decays = response.decays[:MOST_DECAYS]
    curved = response.curve is not None
    decay_rows = -(-len(decays) // _COLUMNS)
    rows = max(curved + decay_rows, 1)
    figure = new_figure(ROW_INCHES[1] * 0.9 * rows)
    # a grid inside for each kind of panel: of columns that both divide, Matplotlib 3.8 leaves the panels nothing
    grid = figure.add_gridspec(rows, 1)
    if response.curve is not None:
        third = grid[0].subgridspec(1, 3)
        _bode([figure.add_subplot(third[k]) for k in range(3)], response.curve, response)
    if decays:
        quarter = grid[int(curved) :].subgridspec(decay_rows, _COLUMNS)
        for k, decay in enumerate(decays):
            _decay(figure.add_subplot(quarter[k]), decay, first=k % _COLUMNS == 0, signal=response.signal)
    keys: list[tuple[str, Any]] = [
        ("measured", {"color": _MEASURED.colour, "linestyle": _MEASURED.dashes}),
        ("fitted", {"color": _FITTED.colour, "linestyle": _FITTED.dashes}),
    ]
    if curved:
        keys.append(("95 % interval", {"color": _MEASURED.colour, "linewidth": 6.0, "alpha": 0.25}))
        keys.append(("coherence of chance, 95 %", {"color": REFERENCE_COLOUR, "linestyle": ":"}))
    legend_below(figure, keys)
    return figure


def _bode(panels: list[Axes], curve: ResponseCurve, response: Response) -> None:
    driven = np.asarray(curve.driven) > 0.0
    frequency, value = curve.frequency_hz[driven], (curve.real + 1j * curve.imaginary)[driven]
    size, radius = np.abs(value), curve.radius_95[driven]
    floor = 1e-3 * float(size.max())
    turn = np.degrees(np.arcsin(np.clip(radius / np.maximum(size, 1e-300), 0.0, 1.0)))
    # a phase whose interval is the whole circle is none; from -270 to 90 deg no resonance crosses the edge
    phase = np.where(radius < size, (np.degrees(np.angle(value)) - 90.0) % 360.0 - 270.0, np.nan)
    lines: dict[str, Any] = {"color": _MEASURED.colour, "linestyle": _MEASURED.dashes, "linewidth": 1.0}
    band: dict[str, Any] = {"color": _MEASURED.colour, "alpha": 0.25, "linewidth": 0.0}
    panels[0].fill_between(frequency, np.maximum(size - radius, floor), np.maximum(size + radius, floor), **band)
    panels[0].loglog(frequency, np.maximum(size, floor), **lines)
    panels[1].fill_between(frequency, phase - turn, phase + turn, **band)
    panels[1].semilogx(frequency, phase, **lines)
    panels[2].semilogx(frequency, curve.coherence[driven], **lines)
    panels[2].axhline(curve.chance, color=REFERENCE_COLOUR, linestyle=":", linewidth=1.0)
    panels[2].set_ylim(0.0, 1.05)
    if curve.fitted_real is not None and curve.fitted_imaginary is not None:
        fitted = (curve.fitted_real + 1j * curve.fitted_imaginary)[driven]
        style = {"color": _FITTED.colour, "linestyle": _FITTED.dashes, "linewidth": 1.4}
        panels[0].loglog(frequency, np.maximum(np.abs(fitted), floor), **style)
        panels[1].semilogx(frequency, (np.degrees(np.angle(fitted)) - 90.0) % 360.0 - 270.0, **style)
    for panel, label in zip(panels, ("gain", "phase, deg", "coherence"), strict=True):
        panel.set_ylabel(label)
        panel.set_xlabel("frequency, Hz")
    panels[0].set_title(shown_name(f"{response.sensor}, {response.signal}"), loc="left")


def _decay(panel: Axes, decay: DecayCurve, *, first: bool, signal: str) -> None:
    time = 1e3 * decay.time_s
    panel.plot(time, decay.reading, color=_MEASURED.colour, linestyle=_MEASURED.dashes, linewidth=1.0)
    panel.plot(time, decay.fitted, color=_FITTED.colour, linestyle=_FITTED.dashes, linewidth=1.2)
    panel.set_title(_short(decay.title), loc="left")
    panel.set_xlabel("behind the event, ms")
    if first:
        panel.set_ylabel(shown_name(signal))


def _short(title: str) -> str:
    """The end of a title, which tells the event."""
    return shown_name(title if len(title) <= 28 else f"…{title[-27:]}")
