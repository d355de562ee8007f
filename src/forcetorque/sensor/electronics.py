# SPDX-License-Identifier: BSD-3-Clause
"""From resistance to counts: Wheatstone bridge, analogue-to-digital converter, saturation."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, require_last_axis, require_shape
from forcetorque.base.errors import SensorError, ShapeError, require_positive
from forcetorque.sensor.elastic_element import Beam, Bending, ElasticElement, GaugePlace, Material, RectangularSection
from forcetorque.sensor.gauges import ResistiveGauge


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
    return (r1 * r3 - r2 * r4) / ((r1 + r2) * (r3 + r4))


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

HALF_BRIDGE = Bridge(strain_shares=(1.0, -1.0, 0.0, 0.0), is_gauge=(True, True, False, False))
"""Gauges on both faces of a bent beam in neighbouring arms: twice the output, compensated."""

_MOST_BITS = 32
"""More bits than any converter of a force sensor has; below the 53 of a float64, so counts stay exact."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Adc:
    """A converter of `bits` bits; signed ones convert -reference to reference, others 0 to reference."""

    bits: int
    """Number of bits."""
    reference: float
    """Reference voltage; V."""
    signed: bool
    """Whether counts run from -2^(bits-1) to 2^(bits-1) - 1 (two's complement), or from 0 to 2^bits - 1."""

    def __post_init__(self) -> None:
        require_positive(self.reference, name="Adc: reference", unit="V")
        if not 1 <= self.bits <= _MOST_BITS:
            raise SensorError(f"Adc: expected 1 to {_MOST_BITS} bits, got {self.bits}")

    @property
    def lowest(self) -> int:
        """Lowest count."""
        return -(1 << (self.bits - 1)) if self.signed else 0

    @property
    def highest(self) -> int:
        """Highest count: one less in magnitude than the lowest of a signed converter."""
        return self.lowest + (1 << self.bits) - 1

    @property
    def step(self) -> float:
        """Voltage of one count, the range over 2^bits, thesis (3.13) as the errata correct it; V/count."""
        return (2.0 if self.signed else 1.0) * self.reference / (1 << self.bits)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeldCounts(ArrayRecord):
    """The stream of a board that holds its last valid sample."""

    counts: FloatArray = field(metadata=array("n", "c"))
    """Streamed counts; shape (n, c); NaN before the first valid sample, as there is nothing to hold."""
    saturated: BoolArray = field(metadata=array("n", dtype="bool"))
    """Status of each sample, true while any channel is saturated; shape (n,)."""


def hold_on_saturation(counts: Any, *, lowest: Any, highest: Any) -> HeldCounts:
    """Hold the last valid sample of all channels while any channel is at a limit, thesis 4.3.2.

    Args:
        counts: Counts of the converter in the order of time; shape (n, c).
        lowest: Count at which a channel is saturated, and below; a number, or shape (c,).
        highest: Count at which a channel is saturated, and above; a number, or shape (c,).

    Returns:
        What the board streams, with its status.

    Raises:
        ShapeError: If the counts are not samples by channels, or the limits do not fit them.
        SensorError: If a lower limit is not below its upper one, or a count is not a number.
    """
    raw = np.asarray(counts, dtype=np.float64)
    require_shape(raw, name="counts", shape=(None, None))
    low, high = np.asarray(lowest, dtype=np.float64), np.asarray(highest, dtype=np.float64)
    for name, limit in (("lowest", low), ("highest", high)):
        if limit.shape not in {(), raw.shape[1:]}:
            raise ShapeError(f"{name}: expected a number or one per channel, {raw.shape[1]}, got shape {limit.shape}")
    if not (low < high).all():
        raise SensorError(f"expected limits with lowest below highest, got {low.tolist()} and {high.tolist()}")
    if np.isnan(raw).any():
        raise SensorError("counts: expected numbers, got NaN; a converter always gives a count")
    saturated: BoolArray = np.any((raw <= low) | (raw >= high), axis=1)
    # index of the last valid sample up to each one; -1 before the first
    last_valid = np.maximum.accumulate(np.where(saturated, -1, np.arange(len(raw))))
    held = np.where((last_valid < 0)[:, None], np.nan, raw[last_valid])
    return HeldCounts(counts=held, saturated=saturated)


_SMALL_STRAIN = 1e-7
"""Strain of a few newtons: the bridge is linear to rounding there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Electronics:
    """What every channel of a board is made of."""

    gauge: ResistiveGauge = ResistiveGauge(gauge_factor=130.0, resistance=200.0)
    """A silicon gauge."""
    bridge: Bridge = HALF_BRIDGE
    """Gauges on both faces of an arm."""
    excitation: float = 2.5
    """Voltage across the bridge; V."""
    amplifier_gain: float = 100.0
    """Gain between bridge and converter."""
    adc: Adc = Adc(bits=16, reference=1.65, signed=True)
    """Converter."""

    @property
    def counts_per_strain(self) -> float:
        """Change of the count per strain, for small ones; 1/strain."""
        up, down = (float(self.bridge.ratio(self.gauge, sign * _SMALL_STRAIN)) for sign in (1.0, -1.0))
        return self.amplifier_gain * self.excitation * (up - down) / (2.0 * _SMALL_STRAIN) / self.adc.step


_STEEL = Material.from_poisson_ratio(200e9, 0.3)
_PLACES = tuple(
    GaugePlace(arm=arm, position=position, bending=bending)
    for arm in range(3)
    for position, bending in ((0.81e-3, Bending.IN_PLANE), (1.96e-3, Bending.OUT_OF_PLANE))
)
Y_ELEMENT = ElasticElement(
    beam=Beam(length=7.4e-3, section=RectangularSection(width=7.4e-3, height=7.0e-3), material=_STEEL),
    hub_radius=14.9e-3,
    arm_angles=np.deg2rad([0.0, 120.0, 240.0]),
    places=_PLACES,
)
"""Three arms at 120 degrees; channels 0, 2, 4 bend in the plane, 1, 3, 5 out of it."""

CHANNEL_ANGLES = Y_ELEMENT.arm_angles[[place.arm for place in _PLACES]]
"""Direction of the arm of every channel about z; shape (6,); rad."""
IN_PLANE = np.array([place.bending is Bending.IN_PLANE for place in _PLACES])
"""Whether a channel sees its arm bend in the plane; shape (6,)."""
