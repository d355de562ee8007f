# SPDX-License-Identifier: BSD-3-Clause
"""Wheatstone bridges: from four resistances to a voltage, with one, two or four gauges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_last_axis
from forcetorque.errors import SensorError, ShapeError
from forcetorque.sensor.gauge import ResistiveGauge


def bridge_ratio(resistances: Any) -> FloatArray:
    """Give the output voltage of a bridge per input voltage, exactly [1].

    Balanced, with output 0, where `R1 R3 = R2 R4`, so `R1 / R2 = R4 / R3`.

    Args:
        resistances: R1 to R4 around the bridge, each above zero; shape (..., 4); ohm.

    Returns:
        Output per input voltage; shape (...).

    Raises:
        ShapeError: If there are not four resistances.
        SensorError: If a resistance is not above zero.

    References:
        [1] Thesis (1.11); its text prints the balance as R1 / R2 = R3 / R4.
    """
    ohms = np.asarray(resistances, dtype=np.float64)
    require_last_axis(ohms, name="resistances", length=4)
    if not (ohms > 0.0).all():
        raise SensorError(f"resistances: expected numbers above 0 ohm, got {ohms.min():g}")
    r1, r2, r3, r4 = np.moveaxis(ohms, -1, 0)
    ratio: FloatArray = (r1 * r3 - r2 * r4) / ((r1 + r2) * (r3 + r4))
    return ratio


def linearised_bridge_ratio(relative_changes: Any) -> FloatArray:
    """Give the output per input voltage of four resistors that are equal without load, to first order.

    `(c1 - c2 + c3 - c4) / 4`: changes of neighbours subtract, changes of opposite arms add.

    Args:
        relative_changes: `dR / R` of each arm; shape (..., 4).

    Returns:
        Output per input voltage; shape (...); wrong by terms of the square of the changes.

    Raises:
        ShapeError: If there are not four changes.
    """
    changes = np.asarray(relative_changes, dtype=np.float64)
    require_last_axis(changes, name="relative_changes", length=4)
    ratio: FloatArray = 0.25 * (changes @ np.array([1.0, -1.0, 1.0, -1.0]))
    return ratio


@dataclass(frozen=True, slots=True, kw_only=True)
class Bridge:
    """Which arms of a bridge of equal resistors are gauges, and what strain each of them sees.

    Temperature is compensated where the gauges of neighbouring arms warm up alike. That needs equal
    gauges at one temperature (thesis 1.3.1); for gauges at different ones, give the changes of each arm
    to `bridge_ratio`.
    """

    strain_shares: tuple[float, float, float, float]
    """Strain of each arm per strain at the bridge; 1 and -1 on the two faces of a bent beam."""
    is_gauge: tuple[bool, bool, bool, bool]
    """Whether the arm is a gauge, which warms up with the others, or a fixed resistor, which does not change."""

    def __post_init__(self) -> None:
        if len(self.strain_shares) != 4 or len(self.is_gauge) != 4:
            raise ShapeError(f"Bridge: expected four arms, got {len(self.strain_shares)} and {len(self.is_gauge)}")
        for arm, (share, gauge) in enumerate(zip(self.strain_shares, self.is_gauge, strict=True), start=1):
            if share != 0.0 and not gauge:
                raise SensorError(f"Bridge: arm {arm} is a fixed resistor but sees strain; make it a gauge")
        if self.factor == 0.0:
            raise SensorError("Bridge: the strains of the arms cancel; expected neighbours with opposite strain")

    @property
    def factor(self) -> float:
        """Output per that of a single gauge: 1 for a quarter, 2 for a half, 4 for a full bridge in bending."""
        s1, s2, s3, s4 = self.strain_shares
        return s1 - s2 + s3 - s4

    @property
    def is_temperature_compensated(self) -> bool:
        """Whether a common temperature leaves a bridge without strain in balance: R1 R3 and R2 R4 grow alike."""
        g1, g2, g3, g4 = self.is_gauge
        return g1 + g3 == g2 + g4

    def relative_changes(self, gauge: ResistiveGauge, strain: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the relative change of resistance of each arm.

        Args:
            gauge: What each gauge of the bridge is.
            strain: Strains at the bridge; any shape.
            temperature_change: Temperature of all gauges above the reference; broadcast against `strain`; degC.

        Returns:
            `dR / R`; broadcast shape, then 4.
        """
        strains, warming = np.broadcast_arrays(
            np.asarray(strain, dtype=np.float64), np.asarray(temperature_change, dtype=np.float64)
        )
        changes = gauge.relative_change(strains[..., None] * np.array(self.strain_shares), warming[..., None])
        return np.where(self.is_gauge, changes, 0.0)

    def ratio(self, gauge: ResistiveGauge, strain: Any, temperature_change: Any = 0.0) -> FloatArray:
        """Give the output voltage per input voltage, exactly.

        Args:
            gauge: What each gauge of the bridge is; fixed resistors have its resistance without load.
            strain: Strains at the bridge; any shape.
            temperature_change: Temperature of all gauges above the reference; broadcast against `strain`; degC.

        Returns:
            Output per input voltage; broadcast shape.
        """
        return bridge_ratio(gauge.resistance * (1.0 + self.relative_changes(gauge, strain, temperature_change)))


QUARTER_BRIDGE = Bridge(strain_shares=(1.0, 0.0, 0.0, 0.0), is_gauge=(True, False, False, False))
"""One gauge and three resistors: temperature looks like strain."""

QUARTER_BRIDGE_WITH_DUMMY = Bridge(strain_shares=(1.0, 0.0, 0.0, 0.0), is_gauge=(True, True, False, False))
"""One gauge with a second, unstrained one beside it that only feels the temperature: compensated."""

HALF_BRIDGE = Bridge(strain_shares=(1.0, -1.0, 0.0, 0.0), is_gauge=(True, True, False, False))
"""Gauges on both faces of a bent beam in neighbouring arms: twice the output, compensated."""

OPPOSITE_HALF_BRIDGE = Bridge(strain_shares=(1.0, 0.0, 1.0, 0.0), is_gauge=(True, False, True, False))
"""Gauges with equal strain in opposite arms: twice the output, but twice the temperature too."""

FULL_BRIDGE = Bridge(strain_shares=(1.0, -1.0, 1.0, -1.0), is_gauge=(True, True, True, True))
"""Two gauges on each face of a bent beam: four times the output, compensated, and linear without approximation."""
