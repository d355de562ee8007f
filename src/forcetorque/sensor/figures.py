# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a sensor: range of its channels by gain, drift over temperature and sessions, response to fast forces."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.results.figure_style import (
    COLOURS,
    LIMIT_LINE,
    REFERENCE_COLOUR,
    ROW_INCHES,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    thinned_cloud,
    thinned_line,
)
from forcetorque.results.visual_roles import LIMIT
from forcetorque.sensor.answers import response_answer
from forcetorque.sensor.choice.result import Holds

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.sensor.bandwidth.driven_response import ChannelResponse
    from forcetorque.sensor.bandwidth.frequency_response import ResponseCurve
    from forcetorque.sensor.bandwidth.pooled_decays import DecayCurve
    from forcetorque.sensor.bandwidth.response import Response
    from forcetorque.sensor.choice.result import SensorChoice
    from forcetorque.sensor.gains.gains import SensorGains
    from forcetorque.sensor.sessions.session_drift import SensorSessions, SessionRow
    from forcetorque.sensor.temperature.temperature_drift import SensorThermal


@in_figure_style
def gain_figure(sensors: Sequence[SensorGains]) -> Figure:
    """Draw the raw channels against their limits, with the present and with the recommended gains [1].

    Args:
        sensors: Samples and channels of each sensor; one row each.

    Returns:
        The figure, `ROW_INCHES` times the number of rows at `DOTS_PER_INCH`.

    Raises:
        MissingExtraError: If matplotlib is not installed.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.8.
    """
    figure = new_figure(ROW_INCHES[1] * len(sensors))
    panels = figure.subplots(len(sensors), 2, squeeze=False, sharey="row")
    for (before, after), gains in zip(panels, sensors, strict=True):
        known = all(channel.recommended_gain is not None for channel in gains.channels)
        _draw_range(before, gains, gains.counts, title=f"{gains.sensor} ({gains.serial}), as recorded")
        _draw_range(
            after, gains, gains.counts * gains.factors, title=f"with the recommended {'gains' if known else 'factors'}"
        )
        before.set_ylabel("raw, counts")
        after.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure


def _draw_range(panel: Axes, gains: SensorGains, counts: FloatArray, *, title: str) -> None:
    limit = gains.limit_counts
    for sign in (-1.0, 1.0):
        near = sign * (1.0 - gains.margin) * limit
        panel.axhline(sign * limit, **LIMIT_LINE)
        panel.axhspan(near, sign * limit, color=LIMIT.colour, alpha=0.08, linewidth=0.0)
    time, drawn = thinned_line(gains.time_s, counts)
    for k, channel in enumerate(gains.channels):
        # channels beyond the palette share a colour and differ in style
        style = ("-", ":", "-.")[k // len(COLOURS) % 3]
        colour = COLOURS[k % len(COLOURS)]
        panel.plot(time, drawn[:, k], style, color=colour, linewidth=0.9, label=channel.channel)
    reach = max(1.1 * limit, float(np.abs(counts).max()))
    panel.set(ylim=(-reach, reach), title=title, xlabel="time, s")


_POINTS = 400
"""Points of a branch that are drawn."""
_BRANCHES = ((1.0, "heating", look(1)), (-1.0, "cooling", look(0)))


@in_figure_style
def thermal_figure(sensors: Sequence[SensorThermal]) -> Figure:
    """Draw readings without offset and drift in time over temperature, with the fitted line of either branch.

    Args:
        sensors: Sensors; two rows each, of forces and of moments.

    Returns:
        The figure, 1.5 times `ROW_INCHES` high for each sensor.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(1.5 * ROW_INCHES[1] * len(sensors))
    panels = figure.subplots(2 * len(sensors), 3, squeeze=False, sharex="row")
    for k, sensor in enumerate(sensors):
        for j, panel in enumerate(panels[2 * k : 2 * k + 2].ravel()):
            _draw_drift(panel, sensor, j)
        name = shown_name(f"{sensor.sensor} ({sensor.serial})")
        panels[2 * k, 0].set_title(name if sensor.separable_from_time else f"{name}: {_UNKNOWN}", loc="left")
        for panel in panels[2 * k + 1]:
            panel.set_xlabel("temperature, degC")
    drifts = [
        (abs(row.drift_per_degC), f"{shown_name(sensor.curve.signals[j])} {row.drift_per_degC:+.2g} {row.unit}/degC")
        for sensor in sensors
        for j, row in enumerate(sensor.components[:3])
        if sensor.separable_from_time
    ]
    headline(figure, f"Largest drift of {max(drifts)[1]}" if drifts else f"Drift: {_UNKNOWN}")
    dots = [(name, _dots(style) | {"linestyle": "none"}) for _, name, style in _BRANCHES]
    lines = [(f"{name}, fitted", {"color": style.colour, "linestyle": style.dashes}) for _, name, style in _BRANCHES]
    legend_below(figure, [*dots, *lines])
    return figure


_UNKNOWN = "not separable from drift in time"


def _draw_drift(panel: Axes, sensor: SensorThermal, j: int) -> None:
    curve, row = sensor.curve, sensor.components[j]
    for sign, _, style in _BRANCHES:
        branch = curve.heating == sign
        if not branch.any():
            continue
        degrees, values = curve.temperature_degC[branch], curve.measurement[branch, j]
        cloud = thinned_cloud(np.column_stack([degrees, values]), _POINTS)
        panel.plot(cloud[:, 0], cloud[:, 1], linestyle="none", **_dots(style))
        ends = np.array([degrees.min(), degrees.max()])
        line = row.drift_per_degC * (ends - curve.reference_degC) + 0.5 * sign * (row.hysteresis or 0.0)
        panel.plot(ends, line, color=style.colour, linestyle=style.dashes, linewidth=1.4)
    panel.set_ylabel(curve.signals[j])
    if sensor.separable_from_time:
        rises = row.drift_per_degC > 0.0  # the label stands where no point is
        side, place = ("left", 0.03) if rises else ("right", 0.97)
        drift = f"{row.drift_per_degC:+.2g} {row.unit}/degC"
        panel.text(place, 0.94, drift, transform=panel.transAxes, ha=side, va="top", fontweight="bold")


def _dots(style: Any) -> dict[str, Any]:
    return {"color": style.colour, "marker": style.marker, "markersize": 2.5, "markerfacecolor": "none"}


MOST_DECAYS = 8
"""Decays that are drawn."""
_COLUMNS = 4
_MEASURED, _FITTED = look(0), look(1)


@in_figure_style
def response_figure(response: Response) -> Figure:
    """Draw gain, phase and coherence over frequency, the same of every channel of several, and the first decays.

    Args:
        response: The response; panels that it has nothing for are left out.

    Returns:
        The figure.

    Raises:
        ExperimentError: If the response is static, which has a table and no picture.
        MissingExtraError: If matplotlib is not installed.
    """
    if response.static_curves:
        raise ExperimentError("static curves have a table and no picture; leave out the figure, and look at --details")
    decays = response.decays[:MOST_DECAYS]
    curved = response.curve is not None
    decay_rows = -(-len(decays) // _COLUMNS)
    channels = response.channels if len(response.channels) > 1 else ()
    channel_rows = 2 if channels else 0
    rows = max(curved + channel_rows + decay_rows, 1)
    figure = new_figure(ROW_INCHES[1] * 0.9 * rows)
    # a grid inside for each kind of panel: of columns that both divide, Matplotlib 3.8 leaves the panels nothing
    grid = figure.add_gridspec(rows, 1)
    if response.curve is not None:
        third = grid[0].subgridspec(1, 3)
        _bode([figure.add_subplot(third[k]) for k in range(3)], response.curve)
    if channels:
        cells = grid[int(curved) : int(curved) + channel_rows].subgridspec(channel_rows, len(channels))
        for k, channel in enumerate(channels):
            _channel([figure.add_subplot(cells[row, k]) for row in range(channel_rows)], channel, first=k == 0)
    if decays:
        quarter = grid[int(curved) + channel_rows :].subgridspec(decay_rows, _COLUMNS)
        for k, decay in enumerate(decays):
            _decay(figure.add_subplot(quarter[k]), decay, first=k % _COLUMNS == 0, signal=response.signal)
    keys: list[tuple[str, Any]] = [
        ("measured", {"color": _MEASURED.colour, "linestyle": _MEASURED.dashes}),
        ("fitted", {"color": _FITTED.colour, "linestyle": _FITTED.dashes}),
    ]
    if curved or channels:
        keys.append(("95 % interval", {"color": _MEASURED.colour, "linewidth": 6.0, "alpha": 0.25}))
        keys.append(("coherence of chance, 95 %", {"color": REFERENCE_COLOUR, "linestyle": ":"}))
    name = shown_name(f"{response.sensor}, {response.signal}")
    headline(figure, f"{name}: {response_answer(response).verdict}")
    legend_below(figure, keys)
    return figure


def _bode(panels: list[Axes], curve: ResponseCurve) -> None:
    driven = np.asarray(curve.driven) > 0.0
    frequency, value = curve.frequency_hz[driven], (curve.real + 1j * curve.imaginary)[driven]
    size, radius = np.abs(value), curve.radius_95[driven]
    turn = np.degrees(np.arcsin(np.clip(radius / np.maximum(size, 1e-300), 0.0, 1.0)))
    # a phase whose interval is the whole circle is none; from -270 to 90 deg no resonance crosses the edge
    phase = np.where(radius < size, (np.degrees(np.angle(value)) - 90.0) % 360.0 - 270.0, np.nan)
    panels[1].fill_between(frequency, phase - turn, phase + turn, **_BAND)
    panels[1].semilogx(frequency, phase, **_CURVE)
    if curve.fitted_real is not None and curve.fitted_imaginary is not None:
        fitted = (curve.fitted_real + 1j * curve.fitted_imaginary)[driven]
        panels[1].semilogx(frequency, (np.degrees(np.angle(fitted)) - 90.0) % 360.0 - 270.0, **_FIT)
    _gain_and_coherence(panels[0], panels[2], curve)
    for panel, label in zip(panels, ("gain", "phase, deg", "coherence"), strict=True):
        panel.set(ylabel=label, xlabel="frequency, Hz")


_BAND: dict[str, Any] = {"color": _MEASURED.colour, "alpha": 0.25, "linewidth": 0.0}
_CURVE: dict[str, Any] = {"color": _MEASURED.colour, "linestyle": _MEASURED.dashes, "linewidth": 1.0}
_FIT: dict[str, Any] = {"color": _FITTED.colour, "linestyle": _FITTED.dashes, "linewidth": 1.4}


def _gain_and_coherence(gain: Axes, coherence: Axes, curve: ResponseCurve) -> None:
    driven = np.asarray(curve.driven) > 0.0
    frequency = curve.frequency_hz[driven]
    size, radius = np.hypot(curve.real, curve.imaginary)[driven], curve.radius_95[driven]
    floor = 1e-3 * (float(size.max()) or 1.0)
    gain.fill_between(frequency, np.maximum(size - radius, floor), np.maximum(size + radius, floor), **_BAND)
    gain.loglog(frequency, np.maximum(size, floor), **_CURVE)
    if curve.fitted_real is not None and curve.fitted_imaginary is not None:
        fitted = np.hypot(curve.fitted_real, curve.fitted_imaginary)[driven]
        gain.loglog(frequency, np.maximum(fitted, floor), **_FIT)
    coherence.semilogx(frequency, curve.coherence[driven], **_CURVE)
    coherence.axhline(curve.chance, color=REFERENCE_COLOUR, linestyle=":", linewidth=1.0)
    coherence.set_ylim(0.0, 1.05)


def _channel(panels: list[Axes], channel: ChannelResponse, *, first: bool) -> None:
    _gain_and_coherence(panels[0], panels[1], channel.curve)
    panels[0].set_title(channel.channel if channel.lowest_gain is not None else f"{channel.channel}: not explained")
    panels[1].set_xlabel("frequency, Hz")
    if first:
        panels[0].set_ylabel("gain")
        panels[1].set_ylabel("coherence")


def _decay(panel: Axes, decay: DecayCurve, *, first: bool, signal: str) -> None:
    time = 1e3 * decay.time_s
    panel.plot(time, decay.measurement, color=_MEASURED.colour, linestyle=_MEASURED.dashes, linewidth=1.0)
    panel.plot(time, decay.fitted, color=_FITTED.colour, linestyle=_FITTED.dashes, linewidth=1.2)
    panel.set_title(_short(decay.title), loc="left")
    panel.set_xlabel("behind the event, ms")
    if first:
        panel.set_ylabel(shown_name(signal))


def _short(title: str) -> str:
    """The end of a title, which shows the event."""
    return shown_name(title if len(title) <= 28 else f"…{title[-27:]}")


@in_figure_style
def session_figure(sensors: Sequence[SensorSessions]) -> Figure:
    """Draw offset and gain of every session with their 95 % intervals, those of a change beyond noise in colour.

    Args:
        sensors: Sensors; two rows each, offsets and gains, with a panel per component.

    Returns:
        The figure, 1.5 times `ROW_INCHES` high for each sensor.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    width = max(len({row.component for row in sensor.rows}) for sensor in sensors)
    figure = new_figure(1.5 * ROW_INCHES[1] * len(sensors))
    panels = figure.subplots(2 * len(sensors), width, squeeze=False)
    drawn: list[bool | None] = []
    for k, sensor in enumerate(sensors):
        components = list(dict.fromkeys(row.component for row in sensor.rows))
        for row, quantity in enumerate(("offset", "gain")):
            for panel, component in zip(panels[2 * k + row], components, strict=False):
                rows = [one for one in sensor.rows if one.component == component]
                changed = any(one.component == component and one.quantity == quantity for one in sensor.drifts)
                drawn.append(changed if _draw_sessions(panel, rows, quantity, changed=changed) > 1 else None)
            for panel in panels[2 * k + row, len(components) :]:
                panel.set_visible(False)
        panels[2 * k, 0].set_title(shown_name(f"{sensor.sensor} ({sensor.serial})"), loc="left")
    known = [changed for changed in drawn if changed is not None]
    rest = len(drawn) - len(known)
    unknown = f"; {rest} not determined in two sessions" if rest else ""
    headline(figure, f"{sum(known)} of {len(known)} offsets and gains changed beyond noise{unknown}")
    legend_below(figure, [("changed beyond noise", look(1).key), ("no change beyond noise", look(0).key)])
    return figure


def _draw_sessions(panel: Axes, rows: Sequence[SessionRow], quantity: str, *, changed: bool) -> int:
    """Give the number of sessions that determine the quantity."""
    style = look(1 if changed else 0)
    values = [row.offset if quantity == "offset" else row.gain for row in rows]
    widths = [row.offset_half_width_95 if quantity == "offset" else row.gain_half_width_95 for row in rows]
    for k, (value, width) in enumerate(zip(values, widths, strict=True)):
        if np.isfinite(width):
            panel.errorbar(k, value, width, color=style.colour, marker=style.marker, capsize=3.0)
        elif quantity == "offset":
            panel.plot(k, value, color=style.colour, marker=style.marker, markerfacecolor="none")
    known = [value for value, width in zip(values, widths, strict=True) if np.isfinite(width)]
    if not known and quantity == "gain":
        panel.text(0.5, 0.5, "not determined", transform=panel.transAxes, ha="center", va="center")
    panel.set_xlim(-0.5, len(rows) - 0.5)
    few = len(rows) <= _MOST_SESSION_NAMES
    panel.set_xticks(range(len(rows)) if few else [0, len(rows) - 1])
    if quantity == "gain":
        names = [shown_name(row.session) for row in rows]
        panel.set_xticklabels(names if few else [names[0], names[-1]], rotation=30.0, ha="right")
    else:
        panel.set_xticklabels([])
    unit = f", {rows[0].unit}" if quantity == "offset" else ""
    panel.set_ylabel(f"{quantity} of {rows[0].component}{unit}")
    return len(known)


_MOST_SESSION_NAMES = 8
"""Sessions that are named below a panel; of more the first and the last are."""


_ROW_INCHES = 0.19
_MOST_PERCENT = 150.0
"""Shares beyond it are drawn up to it."""
_LOOKS = {Holds.HELD: look(0), Holds.AXIS_BY_AXIS: look(1), Holds.EXCEEDED: look(5)}


@in_figure_style
def choice_figure(choice: SensorChoice) -> Figure:
    """Draw the share of every range that the loads use, and simulated readings of the principles.

    Args:
        choice: Sensors and principles.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    height = _ROW_INCHES * len(choice.sensors) + 0.8
    figure = new_figure(height + ROW_INCHES[1])
    ranges, readings = figure.subplots(2, 1, height_ratios=[height, ROW_INCHES[1]])
    places = np.arange(len(choice.sensors))
    for holds, style in _LOOKS.items():
        rows = [k for k, row in enumerate(choice.sensors) if row.holds is holds]
        used = [min(choice.sensors[k].combined_percent, _MOST_PERCENT) for k in rows]
        if rows:
            ranges.barh(places[rows], used, height=0.7, color=style.colour, label=str(holds))
    ranges.axvline(100.0 * (1.0 - choice.margin), **LIMIT_LINE)
    ranges.set_yticks(places, [shown_name(row.name) for row in choice.sensors])
    ranges.invert_yaxis()
    ranges.set(xlim=(0.0, _MOST_PERCENT), xlabel="shares of all axes together, % of the range")
    ranges.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    for k, curve in enumerate(choice.curves):
        style = look(k)
        readings.plot(
            curve.time_s, curve.share, **style.key, markevery=(30 * k, 240), linewidth=0.9, label=curve.principle
        )
    readings.set(
        ylim=(-0.2, 1.6),
        xlabel="time, s",
        ylabel="reading over load",
        title=f"{shown_name(choice.largest)} from 10 s on, 0.1 degC warmer from 60 to 120 s, simulated",
    )
    if choice.curves:
        readings.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    holding = sum(row.holds is Holds.HELD for row in choice.sensors)
    spare = f"{100.0 * choice.margin:.0f} % to spare"
    headline(figure, f"{holding} of {len(choice.sensors)} ranges hold the loads, all axes together, with {spare}")
    return figure
