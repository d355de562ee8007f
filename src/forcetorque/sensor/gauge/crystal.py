# SPDX-License-Identifier: BSD-3-Clause
"""Crystals under load: a charge that leaks, and an oscillation that changes its frequency."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import SensorError
from forcetorque.sensor.require import require_finite, require_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class PiezoelectricGauge:
    """A crystal with a charge per force, thesis (1.14), that leaks: it sees changes, not a constant force.

    `dq/dt = coefficient dF/dt - q / (R C)`, and the voltage is `q / C`, thesis (1.12) with q a charge.
    """

    coefficient: float
    """Charge per force along the axis of the cut; C/N."""
    capacitance: float
    """Capacitance of the crystal and its cable; F."""
    leakage_resistance: float
    """Resistance through which the charge is lost; ohm."""

    def __post_init__(self) -> None:
        require_finite(self.coefficient, name="PiezoelectricGauge: coefficient", unit="C/N")
        require_positive(self.capacitance, name="PiezoelectricGauge: capacitance", unit="F")
        require_positive(self.leakage_resistance, name="PiezoelectricGauge: leakage_resistance", unit="ohm")
        if self.coefficient == 0.0:
            raise SensorError("PiezoelectricGauge: a coefficient of 0 C/N sees no force; expected another number")

    @property
    def time_constant(self) -> float:
        """Time in which the charge under a constant force falls to 1/e; s."""
        return self.leakage_resistance * self.capacitance

    def charge(self, force: Any, *, rate_hz: float, initial_charge: float = 0.0) -> FloatArray:
        """Give the charge under a sampled force, exactly for a force that is linear between samples.

        This is the first-order hold: with `a = exp(-1 / (rate R C))`,
        `q[k+1] = a q[k] + coefficient (F[k+1] - F[k]) rate R C (1 - a)`.

        Args:
            force: Forces at even steps of time; shape (n,); N.
            rate_hz: Samples per second.
            initial_charge: Charge at the first sample; 0 if that force has acted for long; C.

        Returns:
            Charges at the same samples; shape (n,); C.

        Raises:
            ShapeError: If the force is not one series.
            SensorError: If the rate is not above zero.
        """
        from scipy.signal import lfilter  # here because importing it takes longer than the filter

        forces = np.asarray(force, dtype=np.float64)
        require_shape(forces, name="force", shape=(None,))
        require_positive(rate_hz, name="PiezoelectricGauge: rate_hz", unit="Hz")
        require_finite(initial_charge, name="PiezoelectricGauge: initial_charge", unit="C")
        if not len(forces):
            return np.zeros(0)
        steps = 1.0 / (rate_hz * self.time_constant)
        # expm1: a crystal that keeps its charge for days must not lose the digits of 1 - a
        gain = self.coefficient * -math.expm1(-steps) / steps
        driven = np.concatenate([[initial_charge], gain * np.diff(forces)])
        return np.asarray(lfilter([1.0], [1.0, -math.exp(-steps)], driven), dtype=np.float64)

    def voltage(self, charge: Any) -> FloatArray:
        """Give the voltage of a charge, thesis (1.12).

        Args:
            charge: Charges; any shape; C.

        Returns:
            Voltages; same shape; V.
        """
        return np.asarray(charge, dtype=np.float64) / self.capacitance


@dataclass(frozen=True, slots=True, kw_only=True)
class QuartzResonator:
    """A resonator with `df = F K f0^2 n / l`, thesis (1.15)."""

    fundamental_hz: float
    """Fundamental frequency without load, f0; Hz."""
    constant: float
    """Constant of the cut, K; its unit follows from (1.15): m s/N."""
    size: float
    """Size of the crystal, l; m."""
    overtone: int = 1
    """Number of the overtone mode, n; 1 for the fundamental."""

    def __post_init__(self) -> None:
        require_positive(self.fundamental_hz, name="QuartzResonator: fundamental_hz", unit="Hz")
        require_finite(self.constant, name="QuartzResonator: constant", unit="m s/N")
        require_positive(self.size, name="QuartzResonator: size", unit="m")
        if self.constant == 0.0 or self.overtone < 1:
            raise SensorError(
                "QuartzResonator: expected a constant other than 0 m s/N and an overtone of at least 1, "
                f"got {self.constant:g} and {self.overtone}"
            )

    @property
    def sensitivity(self) -> float:
        """Change of frequency per force; Hz/N."""
        return self.constant * self.fundamental_hz**2 * self.overtone / self.size

    def frequency_shift(self, force: Any) -> FloatArray:
        """Give the change of frequency, thesis (1.15).

        Args:
            force: Forces on the crystal; any shape; N.

        Returns:
            Changes of frequency; same shape; Hz.
        """
        return self.sensitivity * np.asarray(force, dtype=np.float64)

    def force(self, frequency_shift: Any) -> FloatArray:
        """Give the force that a change of frequency tells.

        Args:
            frequency_shift: Changes of frequency; any shape; Hz.

        Returns:
            Forces on the crystal; same shape; N.
        """
        return np.asarray(frequency_shift, dtype=np.float64) / self.sensitivity
