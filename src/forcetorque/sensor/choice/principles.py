# SPDX-License-Identifier: BSD-3-Clause
"""Sensing principles as six channels of one elastic element: noise, drift, nonlinearity and bandwidth of each."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_last_axis
from forcetorque.base.errors import SensorError
from forcetorque.sensor.choice.load_case import considerable_sizes
from forcetorque.sensor.choice.result import PrincipleCurve, PrincipleRow
from forcetorque.sensor.elastic_element import Bending, ElasticElement
from forcetorque.sensor.electronics import HALF_BRIDGE, QUARTER_BRIDGE, Y_ELEMENT, Bridge, Electronics
from forcetorque.sensor.gauges import (
    GAUGE_MATERIALS,
    FibreBraggGrating,
    ParallelPlates,
    PiezoelectricGauge,
    ReflectedIntensity,
    ResistiveGauge,
)

BOLTZMANN = 1.380649e-23
"""Boltzmann constant, J/K (SI, exact)."""
ELEMENTARY_CHARGE = 1.602176634e-19
"""Elementary charge, C (SI, exact)."""
ROOM_K = 293.15
"""Temperature of the noise; K."""
BANDWIDTH_HZ = 500.0
"""Bandwidth of the noise, that of the FTsense (thesis A.2.1); Hz."""
STEEL_EXPANSION = 11e-6
"""Thermal expansion of the element and of the spacers of gaps: typical of martensitic stainless steel; 1/degC."""
CARRIED_KG = 1.0
"""Mass on the sensor for the resonance, a point at the origin of its frame; kg."""
_MINUTE_S = 60.0


class Stimulus(StrEnum):
    """What a channel senses of the element."""

    STRAIN = "strain"
    """Strain where the gauges are."""
    DEFLECTION = "deflection"
    """Movement of the inner end of an arm, along y or z of the arm; m."""
    FORCE = "force"
    """Force that the hub exerts on an arm, along y or z of the arm; N."""


_SMALL = {Stimulus.STRAIN: 1e-7, Stimulus.DEFLECTION: 1e-10, Stimulus.FORCE: 1e-2}
"""Stimuli of about a newton, for slopes without load."""
_SMALL_DEGC = 1e-4


def stimulus_matrix(element: ElasticElement, stimulus: Stimulus) -> FloatArray:
    """Give what every channel of an element senses of a load.

    Args:
        element: The element; a channel for each of its places.
        stimulus: What is sensed.

    Returns:
        Stimulus per component of a wrench; shape (places, 6); per N, per N m.
    """
    if stimulus is Stimulus.STRAIN:
        return element.strain_matrix()
    arms = element.arm_wrenches()
    if stimulus is Stimulus.DEFLECTION:
        arms = np.asarray(np.linalg.solve(element.beam.stiffness(), arms), dtype=np.float64)
    return np.array([arms[place.arm, 1 if place.bending is Bending.IN_PLANE else 2] for place in element.places])


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel:
    """How one channel turns a stimulus into a signal; all six are alike."""

    principle: str
    """Name of the principle."""
    stimulus: Stimulus
    """What it senses."""
    signal: Callable[[Any, Any], FloatArray]
    """Signal of stimuli and of temperatures above the reference in degC, for loads that just began."""
    noise: float | None
    """Standard deviation of a sample in the unit of the signal; None where the model has none."""
    noise_by: str
    """What the noise consists of, or why there is none."""
    temperature_by: str
    """What the temperature acts on, or why that is not known."""
    temperature_known: bool = True
    """Whether the model has all by which the temperature acts on the zero."""
    gain_drift_known: bool = True
    """Whether it has all by which it acts on the gain."""
    leaking: PiezoelectricGauge | None = None
    """The crystal whose charge leaks; None where a constant load is read for ever."""

    def slope(self) -> float:
        """Signal per stimulus without load."""
        step = _SMALL[self.stimulus]
        return float(self.signal(step, 0.0) - self.signal(-step, 0.0)) / (2.0 * step)

    def slope_per_degC(self) -> float:
        """Signal per degree without load."""
        return float(self.signal(0.0, _SMALL_DEGC) - self.signal(0.0, -_SMALL_DEGC)) / (2.0 * _SMALL_DEGC)


def _bridge_channel(name: str, gauge: ResistiveGauge, bridge: Bridge, electronics: Electronics) -> Channel:
    volts = electronics.excitation
    thermal = math.sqrt(4.0 * BOLTZMANN * ROOM_K * gauge.resistance * BANDWIDTH_HZ)
    rounding = electronics.adc.step / electronics.amplifier_gain / math.sqrt(12.0)
    zero = "equal gauges at one temperature cancel" if bridge.is_temperature_compensated else "resistance of one gauge"
    adc, gain = electronics.adc, electronics.amplifier_gain
    lowest, highest = (count * adc.step / gain for count in (adc.lowest, adc.highest))

    def signal(strain: Any, degC: Any) -> FloatArray:
        # the linear gauge has no term of strain times temperature, so both act by themselves
        output = volts * np.asarray(bridge.ratio(gauge, strain) + bridge.ratio(gauge, 0.0, degC))
        if (output < lowest).any() or (output > highest).any():
            raise SensorError(
                f"{name}: expected bridge voltages from {lowest:.3g} to {highest:.3g} V, which the converter holds, "
                f"got {output.min():.3g} to {output.max():.3g} V"
            )
        return output

    return Channel(
        principle=name,
        stimulus=Stimulus.STRAIN,
        signal=signal,
        noise=math.hypot(thermal, rounding),
        noise_by="Johnson noise of the bridge, rounding",
        temperature_by=f"{zero}; of the gain: not in the model",
        gain_drift_known=False,
    )


def _table_1_1(material: str, gauge_factor: float) -> ResistiveGauge:
    row = GAUGE_MATERIALS[material]
    return ResistiveGauge(
        gauge_factor=gauge_factor, resistance=row.resistance, temperature_coefficient=row.temperature_coefficient
    )


_SILICON = _table_1_1("semiconductor", Electronics().gauge.gauge_factor)
_FOIL = _table_1_1("nickel_alloy", GAUGE_MATERIALS["nickel_alloy"].highest_gauge_factor)
_SILICON_BOARD = Electronics(amplifier_gain=113.0)
_FOIL_BOARD = Electronics(
    gauge=_FOIL, amplifier_gain=113.0 * _SILICON.gauge_factor / _FOIL.gauge_factor
)  # the same counts per strain

# plates of 10 mm2 with a gap of air of 50 um, read with 3.3 V: chosen, about those of small sensors
_PLATES, _GAP_M, _READ_V = ParallelPlates(area=10e-6, relative_permittivity=1.0), 50e-6, 3.3
# a fibre of 200 um core 100 um before the mirror, 10 uA at the detector: chosen
_FIBRE, _DISTANCE_M = ReflectedIntensity(core_radius=100e-6, cone_angle=0.2, contact_intensity=10e-6), 100e-6
# silica doped with germanium: p = .22, .55e-6 and 8.6e-6 per degC of A. Othonos, Fiber Bragg gratings, 1997
_GRATING = FibreBraggGrating(
    wavelength=1550e-9,
    photoelastic_coefficient=0.22,
    thermal_expansion=0.55e-6,
    refractive_index=1.447,
    thermo_optic_coefficient=8.6e-6 * 1.447,
)
# quartz, longitudinal effect: d11 = 2.31e-12 C/N; 100 pF with its cable and 1e12 ohm: chosen
_CRYSTAL = PiezoelectricGauge(coefficient=2.31e-12, capacitance=100e-12, leakage_resistance=1e12)


def _capacitive() -> Channel:
    capacitance = float(_PLATES.capacitance(_GAP_M))
    return Channel(
        principle="capacitive",
        stimulus=Stimulus.DEFLECTION,
        signal=lambda moved, degC: _PLATES.capacitance(_gap(_GAP_M, moved, degC)),
        noise=math.sqrt(BOLTZMANN * ROOM_K * capacitance) / _READ_V,
        noise_by="charge noise k T C of one reading",
        temperature_by="expansion of the gap",
    )


def _gap(rest_m: float, moved_m: Any, degC: Any) -> FloatArray:
    return np.asarray(rest_m * (1.0 + STEEL_EXPANSION * np.asarray(degC)) + np.asarray(moved_m), dtype=np.float64)


def _reflected() -> Channel:
    current = float(_FIBRE.intensity(_DISTANCE_M))
    return Channel(
        principle="optical, reflected light",
        stimulus=Stimulus.DEFLECTION,
        signal=lambda moved, degC: _FIBRE.intensity(_gap(_DISTANCE_M, moved, degC)),
        noise=math.sqrt(2.0 * ELEMENTARY_CHARGE * current * BANDWIDTH_HZ),
        noise_by="shot noise of the detector",
        temperature_by="not known: light source and detector are not in the model",
        temperature_known=False,
    )


def _grating() -> Channel:
    def signal(strain: Any, degC: Any) -> FloatArray:
        # bonded to steel, the fibre is stretched by what steel expands more than it
        bonded = np.asarray(strain) + (STEEL_EXPANSION - _GRATING.thermal_expansion) * np.asarray(degC)
        return _GRATING.shift(bonded, degC)

    return Channel(
        principle="optical, Bragg grating",
        stimulus=Stimulus.STRAIN,
        signal=signal,
        noise=None,
        noise_by="not known: that of the interrogator",
        temperature_by="refractive index, expansion of steel",
    )


def _piezoelectric() -> Channel:
    return Channel(
        principle="piezoelectric",
        stimulus=Stimulus.FORCE,
        signal=lambda force, degC: _CRYSTAL.coefficient * np.asarray(force) + 0.0 * np.asarray(degC),
        noise=math.sqrt(BOLTZMANN * ROOM_K * _CRYSTAL.capacitance),
        noise_by="charge noise k T C; that of the amplifier is not known",
        temperature_by="not known: expansion under preload is not in the model",
        temperature_known=False,
        leaking=_CRYSTAL,
    )


def channels() -> tuple[Channel, ...]:
    """Give a channel of every principle, with the numbers of the comparison.

    Returns:
        Silicon gauges in half and quarter bridge, foil gauges, capacitive, optical and piezoelectric.
    """
    return (
        _bridge_channel("silicon gauges, half bridge", _SILICON, HALF_BRIDGE, _SILICON_BOARD),
        _bridge_channel("silicon gauge, quarter bridge", _SILICON, QUARTER_BRIDGE, _SILICON_BOARD),
        _bridge_channel("foil gauges, half bridge", _FOIL, HALF_BRIDGE, _FOIL_BOARD),
        _capacitive(),
        _reflected(),
        _grating(),
        _piezoelectric(),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PrincipleSensor(ArrayRecord):
    """A simulated six-axis sensor of one principle, read by the slopes that it has without load."""

    channel: Channel
    """Each of its channels."""
    sensed: FloatArray = field(metadata=array(6, 6))
    """Stimulus of every channel per component of a wrench; shape (6, 6); per N, per N m."""

    @property
    def matrix(self) -> FloatArray:
        """Wrench per change of the signals; shape (6, 6)."""
        return np.asarray(np.linalg.inv(self.channel.slope() * self.sensed), dtype=np.float64)

    def read(
        self,
        wrench: Any,
        degC: Any,
        *,
        rate_hz: float | None = None,
        rng: np.random.Generator | None = None,
    ) -> FloatArray:
        """Read loads.

        Args:
            wrench: True loads; shape (n, 6); N, N m.
            degC: Temperatures above that of the zero; shape (n,), or one for all.
            rate_hz: Rate of the samples, evenly in time, of which the first load has acted for long; None for loads
                that just began, each by itself.
            rng: Source of the noise; None without.

        Returns:
            Measured loads; shape (n, 6); N, N m.

        Raises:
            SensorError: If a load leaves what the channels can sense: it closes a gap, or saturates a converter.
        """
        loads = np.asarray(wrench, dtype=np.float64)
        require_last_axis(loads, name="wrench", length=6)
        stimuli, warm = loads @ self.sensed.T, np.broadcast_to(np.asarray(degC, dtype=np.float64), loads.shape[:-1])
        crystal = self.channel.leaking
        if crystal is not None and rate_hz is not None:
            signals = np.stack([crystal.charge(stimulus, rate_hz=rate_hz) for stimulus in stimuli.T], axis=1)
        else:
            signals = self.channel.signal(stimuli, warm[..., None])
        if rng is not None and self.channel.noise is not None:
            signals = signals + self.channel.noise * rng.standard_normal(signals.shape)
        return np.asarray((signals - self.channel.signal(0.0, 0.0)) @ self.matrix.T, dtype=np.float64)

    def noise(self) -> FloatArray | None:
        """Standard deviation of a sample of every component; shape (6,); N, N m; None where the model has none."""
        noise = self.channel.noise
        return None if noise is None else noise * np.linalg.norm(self.matrix, axis=1)

    def zero_drift(self) -> FloatArray | None:
        """Load that one degree on all channels is read as; shape (6,); N, N m; None where that is not known."""
        return self.channel.slope_per_degC() * self.matrix.sum(axis=1) if self.channel.temperature_known else None

    def gain_per_degC(self, wrench: FloatArray) -> float | None:
        """Change of the reading of a load per degree, over the load, without that of the zero; None if not known."""
        if not (self.channel.temperature_known and self.channel.gain_drift_known):
            return None
        load, part = wrench[None], _loaded(wrench)
        warm, cold = (
            self.read(load, sign * _SMALL_DEGC) - self.read(0.0 * load, sign * _SMALL_DEGC) for sign in (1, -1)
        )
        change = ((warm - cold)[0] / (2.0 * _SMALL_DEGC))[part]
        return float(change @ wrench[part] / (wrench[part] @ wrench[part]))


def principle_sensors(element: ElasticElement = Y_ELEMENT) -> tuple[PrincipleSensor, ...]:
    """Give a sensor of every principle on one element.

    Args:
        element: Element with six places of gauges.

    Returns:
        The sensors.
    """
    return tuple(
        PrincipleSensor(channel=channel, sensed=stimulus_matrix(element, channel.stimulus)) for channel in channels()
    )


def resonance_hz(element: ElasticElement, mass_kg: float) -> float:
    """Give the lowest resonance of an element with a mass at the origin of its frame, which turns freely.

    Args:
        element: The element; its own mass is neglected.
        mass_kg: The mass; kg.

    Returns:
        The frequency; Hz.
    """
    compliance = np.linalg.inv(element.stiffness())[:3, :3]
    return math.sqrt(1.0 / (float(np.linalg.eigvalsh(compliance)[-1]) * mass_kg)) / (2.0 * math.pi)


def compare_principles(wrench: FloatArray) -> tuple[tuple[PrincipleRow, ...], tuple[PrincipleCurve, ...]]:
    """Compare the principles under one load.

    Args:
        wrench: The load; shape (6,), not zero; N, N m.

    Returns:
        Numbers of every principle, and simulated readings of a load that begins after 10 s, while it warms by a tenth
        of a degree from 60 to 120 s. Where the load leaves what a principle can sense there is no reading.
    """
    resonance, rows, curves = resonance_hz(Y_ELEMENT, CARRIED_KG), [], []
    for sensor in principle_sensors():
        noise, drift, crystal = sensor.noise(), sensor.zero_drift(), sensor.channel.leaking
        time_constant_s = math.inf if crystal is None else crystal.time_constant
        error = gain = None
        with suppress(SensorError):
            error = sensor.read(wrench[None], 0.0)[0] - wrench
            gain = sensor.gain_per_degC(wrench)
            curves.append(_curve(sensor, wrench))
        rows.append(
            PrincipleRow(
                principle=sensor.channel.principle,
                noise_N=None if noise is None else float(noise[:3].max()),
                noise_Nm=None if noise is None else float(noise[3:].max()),
                nonlinearity_percent=None if error is None else 100.0 * _relative(error, wrench),
                temperature_force_N_per_degC=None if drift is None else float(np.linalg.norm(drift[:3])),
                temperature_moment_Nm_per_degC=None if drift is None else float(np.linalg.norm(drift[3:])),
                gain_percent_per_degC=None if gain is None else 100.0 * gain,
                lost_percent_per_minute=-100.0 * math.expm1(-_MINUTE_S / time_constant_s),
                from_hz=1.0 / (2.0 * math.pi * time_constant_s),
                to_hz=resonance,
                noise_by=sensor.channel.noise_by,
                temperature_by=sensor.channel.temperature_by,
            )
        )
    return tuple(rows), tuple(curves)


def _relative(error: FloatArray, wrench: FloatArray) -> float:
    parts = zip((slice(3), slice(3, 6)), considerable_sizes(wrench[None]), strict=True)
    return max(float(np.linalg.norm(error[part])) / size for part, size in parts if size is not None)


def _loaded(wrench: FloatArray) -> slice:
    """The force, or the moment where the force is negligible."""
    return slice(3, 6) if considerable_sizes(wrench[None])[0] is None else slice(3)


_RATE_HZ = 10.0
_WARMING_DEGC = 0.1


def _curve(sensor: PrincipleSensor, wrench: FloatArray) -> PrincipleCurve:
    time_s = np.arange(0.0, 120.0, 1.0 / _RATE_HZ)
    loads = (time_s >= 10.0)[:, None] * wrench
    warm = _WARMING_DEGC * np.clip((time_s - 60.0) / 60.0, 0.0, 1.0)
    reading = sensor.read(loads, warm, rate_hz=_RATE_HZ, rng=np.random.default_rng(0))
    part = _loaded(wrench)
    share = reading[:, part] @ wrench[part] / (wrench[part] @ wrench[part])
    return PrincipleCurve(principle=sensor.channel.principle, time_s=time_s, share=share)
