# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the raw channels against their limits, before and after a change of gains."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.results.figures import COLOURS, ROW_INCHES, in_figure_style, new_figure, thinned_line
from forcetorque.sensor.gains.gains import SensorGains

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


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
        _draw(before, gains, gains.counts, title=f"{gains.sensor} ({gains.serial}), as recorded")
        _draw(
            after, gains, gains.counts * gains.factors, title=f"with the recommended {'gains' if known else 'factors'}"
        )
        before.set_ylabel("raw, counts")
        after.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure


def _draw(panel: Axes, gains: SensorGains, counts: FloatArray, *, title: str) -> None:
    limit = gains.limit_counts
    for sign in (-1.0, 1.0):
        panel.axhline(sign * limit, color="black", linestyle="--", linewidth=1.0)
        panel.axhspan(sign * (1.0 - gains.margin) * limit, sign * limit, color="black", alpha=0.08, linewidth=0.0)
    time, drawn = thinned_line(gains.time_s, counts)
    for k, channel in enumerate(gains.channels):
        # channels beyond the palette share a colour and differ in style
        style = ("-", ":", "-.")[k // len(COLOURS) % 3]
        colour = COLOURS[k % len(COLOURS)]
        panel.plot(time, drawn[:, k], style, color=colour, linewidth=0.9, label=channel.channel)
    reach = max(1.1 * limit, float(np.abs(counts).max()))
    panel.set_ylim(-reach, reach)
    panel.set_title(title)
    panel.set_xlabel("time, s")
