# SPDX-License-Identifier: BSD-3-Clause
"""Materials of piezoresistive gauges, thesis Table 1.1."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class GaugeMaterial:
    """What Table 1.1 says of a material; a range where it prints one."""

    lowest_gauge_factor: float
    """Least relative change of resistance per strain."""
    highest_gauge_factor: float
    """Greatest relative change of resistance per strain."""
    resistance: float
    """Typical resistance of a gauge; ohm."""
    temperature_coefficient: float
    """Relative change of resistance per degree; 1/degC."""


# The table's column of names is lost in the text of the thesis. The names here are those that the
# paragraph below the table gives to nickel (constant gauge factor), platinum alloys and
# semiconductors (factor set by doping); the composition of the nickel alloy is not known from it.
GAUGE_MATERIALS = {
    "nickel_alloy": GaugeMaterial(
        lowest_gauge_factor=2.0, highest_gauge_factor=2.0, resistance=100.0, temperature_coefficient=10.8e-6
    ),
    "platinum_alloy": GaugeMaterial(
        lowest_gauge_factor=4.0, highest_gauge_factor=6.0, resistance=50.0, temperature_coefficient=2160e-6
    ),
    "semiconductor": GaugeMaterial(
        lowest_gauge_factor=-100.0, highest_gauge_factor=150.0, resistance=200.0, temperature_coefficient=90000e-6
    ),
}
"""Materials of piezoresistive gauges by name; thesis Table 1.1, from Fraden's handbook."""
