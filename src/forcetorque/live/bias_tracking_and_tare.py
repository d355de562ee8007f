# SPDX-License-Identifier: BSD-3-Clause
"""A Kalman filter on the bias of live sensors that does not follow contacts, and the bias of a tare.

The bias of each component is a random walk, with a part that is linear in temperature if wanted. It is measured where
nothing touches: reading less weight of the tool. What is neither bias nor load (noise, vibration, inertia of the tool,
errors of its model) has a stated deviation and a stated correlation time. Means over a short period are taken in. A
mean that lies further from the bias than the gate is of a contact: nothing is taken in until the means have stayed
within a narrower gate for a while. A contact within the gate is followed with the time constant of the filter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.window_means import mean_error
from forcetorque.base.units import NORMAL_95

_HOUR_S = 3600.0


def _both(force: float, moment: float) -> FloatArray:
    return np.repeat([force, moment], 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tracking:
    """How the bias may move, and what keeps it from following contacts."""

    random_walk_N: float = 1.0
    """Standard deviation by which the bias of a force moves in an hour; N."""
    random_walk_Nm: float = 0.02
    """The same of a moment; N m."""
    noise_N: float = 0.2
    """Standard deviation of what is neither bias nor load in a force, of means over the period; N."""
    noise_Nm: float = 0.005
    """The same of a moment; N m."""
    noise_time_s: float = 1.0
    """How long that stays alike; s."""
    period_s: float = 0.1
    """Period of the means; s."""
    enter_gate: float = 5.0
    """Standard deviations from which on a mean is of a contact."""
    leave_gate: float = 3.0
    """Standard deviations below which it is not of a contact that lasts."""
    leave_after_s: float = 1.0
    """Time that means stay below before the bias is tracked again; s."""
    with_temperature: bool = False
    """Whether a part of the bias is linear in temperature."""
    coefficient_sd_N: float = 0.5
    """Standard deviation of this part before any data, of a force; N per degC."""
    coefficient_sd_Nm: float = 0.01
    """The same of a moment; N m per degC."""

    def __post_init__(self) -> None:
        for entry in fields(self):
            value = getattr(self, entry.name)
            if not isinstance(value, bool) and not (math.isfinite(value) and value > 0.0):
                raise RecordingError(f"tracking: {entry.name}: expected a number above 0, got {value}")
        if self.leave_gate > self.enter_gate:
            raise RecordingError(
                f"tracking: leave_gate: expected at most enter_gate {self.enter_gate}, got {self.leave_gate}"
            )


class BiasTracker:
    """Bias of s sensors, tracked from a tare on."""

    def __init__(
        self,
        tracking: Tracking,
        bias: FloatArray,
        variance: FloatArray,
        temperature: FloatArray | None = None,
    ) -> None:
        """Begin.

        Args:
            tracking: How the bias may move.
            bias: Bias now; shape (s, 6); N, N m.
            variance: Its variance; shape (s, 6).
            temperature: Temperatures now; shape (s,); degC; needed with temperature.

        Raises:
            RecordingError: If there is no temperature although the bias depends on it.
        """
        if tracking.with_temperature and temperature is None:
            raise RecordingError("tracking with temperature: expected a temperature with every sample, got none")
        self.bias, self.variance = bias.copy(), variance.copy()
        self.in_contact = np.zeros(len(bias), dtype=bool)
        self._tracking = tracking
        self._constant, self._constant_variance = bias.copy(), variance.copy()
        self._coefficient, self._covariance = np.zeros_like(bias), np.zeros_like(bias)
        spread = _both(tracking.coefficient_sd_N, tracking.coefficient_sd_Nm) ** 2
        self._coefficient_variance = np.broadcast_to(spread, bias.shape).copy()
        self._from = np.zeros(len(bias)) if temperature is None else np.array(temperature, dtype=np.float64)
        self._step_variance = _both(tracking.random_walk_N, tracking.random_walk_Nm) ** 2 / _HOUR_S
        self._gate_variance = _both(tracking.noise_N, tracking.noise_Nm) ** 2
        self._within_s = np.zeros(len(bias))
        self._sum, self._warmth = np.zeros_like(bias), np.zeros(len(bias))
        self._counts = np.zeros(len(bias), dtype=np.int64)
        self._last_ns: int | None = None

    @property
    def coefficient(self) -> FloatArray:
        """Part that is linear in temperature; shape (s, 6); N, N m per degC."""
        return self._coefficient

    def begin(self, sensor: int, bias: FloatArray, variance: FloatArray, temperature: FloatArray | None) -> None:
        """Begin again with a sensor.

        Args:
            sensor: Its index.
            bias: Its bias now; shape (6,); N, N m.
            variance: Its variance; shape (6,).
            temperature: Temperatures now; shape (s,); degC; None without.
        """
        self.bias[sensor] = self._constant[sensor] = bias
        self.variance[sensor] = self._constant_variance[sensor] = variance
        self._coefficient[sensor] = self._covariance[sensor] = 0.0
        self._coefficient_variance[sensor] = (
            _both(self._tracking.coefficient_sd_N, self._tracking.coefficient_sd_Nm) ** 2
        )
        self._from[sensor] = 0.0 if temperature is None else temperature[sensor]
        self.in_contact[sensor], self._within_s[sensor] = False, 0.0
        self._sum[sensor], self._warmth[sensor], self._counts[sensor] = 0.0, 0.0, 0

    def restart_time(self) -> None:
        """Let stamps begin anew."""
        self._last_ns = None

    def add(
        self, unloaded: FloatArray, stamp_ns: int, temperature: FloatArray | None, usable: BoolArray | None = None
    ) -> bool:
        """Take a sample in.

        Args:
            unloaded: Readings less the weight of the tool, without any bias taken off; shape (s, 6); N, N m.
            stamp_ns: Time of the sample; ns.
            temperature: Temperatures; shape (s,); degC; None without.
            usable: Which sensors have a sample without fault; shape (s,); None for all.

        Returns:
            Whether a period ended, so that the bias may be another.
        """
        if self._last_ns is None:
            self._last_ns = stamp_ns
        if usable is None or usable.all():
            self._sum += unloaded
            self._counts += 1
            if temperature is not None:
                self._warmth += temperature
        else:
            for k in np.flatnonzero(usable):
                self._sum[k] += unloaded[k]
                self._counts[k] += 1
                if temperature is not None:
                    self._warmth[k] += temperature[k]
        seconds = (stamp_ns - self._last_ns) * 1e-9
        if seconds < self._tracking.period_s:
            return False
        self._last_ns = stamp_ns
        self._end_period(seconds)
        return True

    def _end_period(self, seconds: float) -> None:
        tracking, present = self._tracking, self._counts > 0
        number = np.maximum(self._counts, 1)
        mean = self._sum / number[:, None]
        warmer = (self._warmth / number - self._from)[:, None] if tracking.with_temperature else np.zeros((1, 1))
        self._sum[:], self._warmth[:], self._counts[:] = 0.0, 0.0, 0
        self._constant_variance += self._step_variance * seconds
        with_constant = self._constant_variance + self._covariance * warmer
        with_coefficient = self._covariance + self._coefficient_variance * warmer
        variance = with_constant + with_coefficient * warmer
        innovation = mean - self._constant - self._coefficient * warmer
        size = np.abs(innovation / np.sqrt(variance + self._gate_variance)).max(axis=1)
        self._gate(size, present, seconds)
        taken = (present & ~self.in_contact)[:, None]
        # white noise of this variance has the spectrum at zero of what stays alike for the noise time
        noise = self._gate_variance * max(tracking.noise_time_s / seconds, 1.0)
        gain = np.where(taken, 1.0 / (variance + noise), 0.0)
        self._constant += gain * with_constant * innovation
        self._constant_variance -= gain * with_constant**2
        if tracking.with_temperature:
            self._coefficient += gain * with_coefficient * innovation
            self._coefficient_variance -= gain * with_coefficient**2
            self._covariance -= gain * with_constant * with_coefficient
        self.bias = np.where(present[:, None], self._constant + self._coefficient * warmer, self.bias)
        self.variance = np.where(
            present[:, None],
            self._constant_variance + warmer * (2.0 * self._covariance + warmer * self._coefficient_variance),
            self.variance + self._step_variance * seconds,
        )

    def _gate(self, size: FloatArray, present: BoolArray, seconds: float) -> None:
        tracking = self._tracking
        entering = present & (size > tracking.enter_gate)
        within = present & (size < tracking.leave_gate)
        self._within_s = np.where(within, self._within_s + seconds, np.where(present, 0.0, self._within_s))
        leaving = self.in_contact & (self._within_s >= tracking.leave_after_s)
        self.in_contact = (self.in_contact & ~leaving) | entering


_FEWEST = 8
"""Samples without which a sensor has no bias yet."""
_PARTS = 10
"""Parts of a tare whose means are compared."""
_NOISE = 8.0
"""Standard errors of such a mean, by steps from sample to sample, that count as noise (heuristic)."""


class TareSamples:
    """Readings of s sensors less the weights of their tools, of each over a given time from its first on."""

    def __init__(self, seconds: float, sensors: int, *, still_N: float, until_still: bool) -> None:
        """Begin.

        Args:
            seconds: Time to collect; s.
            sensors: How many sensors there are.
            still_N: Change of the force over the time, beyond noise, up to which nothing moved; N.
            until_still: Whether a sensor whose force moved collects anew.
        """
        self.moved_N = np.zeros(sensors)
        """By how much the force moved over the last time that each collected, 0 where nothing moved; shape (s,); N."""
        self._still_N, self._until_still = still_N, until_still
        self.collecting = np.ones(sensors, dtype=np.bool_)
        """Which sensors have no bias yet; shape (s,)."""
        self._seconds = seconds
        self._samples: list[list[FloatArray]] = [[] for _ in range(sensors)]
        self._stamps_ns: list[list[int]] = [[] for _ in range(sensors)]

    def restart_time(self) -> None:
        """Begin again with the sensors that have no bias yet."""
        for samples, stamps in zip(self._samples, self._stamps_ns, strict=True):
            samples.clear()
            stamps.clear()

    def add(self, unloaded: FloatArray, stamp_ns: int, usable: BoolArray) -> list[int]:
        """Take a sample in.

        Args:
            unloaded: Readings less weights; shape (s, 6); N, N m.
            stamp_ns: Its time; ns.
            usable: Which sensors have no fault; shape (s,).

        Returns:
            Indices of the sensors that have a bias from now on.
        """
        ended: list[int] = []
        for k in np.flatnonzero(self.collecting & usable).tolist():
            stamps = self._stamps_ns[k]
            if stamps and stamp_ns <= stamps[-1]:
                continue
            self._samples[k].append(unloaded[k].copy())
            stamps.append(stamp_ns)
            if (stamp_ns - stamps[0]) * 1e-9 >= self._seconds and len(stamps) >= _FEWEST:
                self.moved_N[k] = self._moved_N(np.array(self._samples[k])[:, :3])
                if self._until_still and self.moved_N[k]:
                    self._samples[k].clear()
                    stamps.clear()
                    continue
                self.collecting[k] = False
                ended.append(k)
        return ended

    def _moved_N(self, force: FloatArray) -> float:
        """Largest less smallest mean of a tenth, of the axis that moves most, where it is no noise; else 0."""
        parts = np.array_split(force, min(_PARTS, len(force) // 2))
        change = np.ptp([part.mean(axis=0) for part in parts], axis=0)
        error = np.diff(force, axis=0).std(axis=0) / np.sqrt(2.0 * min(map(len, parts)))
        return float(np.max(change, where=change > self._still_N + _NOISE * error, initial=0.0))

    def bias(self, sensor: int) -> tuple[FloatArray, FloatArray]:
        """Give the mean of a sensor over the time.

        Args:
            sensor: Its index.

        Returns:
            Bias, shape (6,), N, N m, and its variance, by noise that is white and slow: half of a 95 % interval
            over 1.96, squared.
        """
        samples, stamps = np.array(self._samples[sensor]), np.array(self._stamps_ns[sensor])
        half = mean_error(samples, (stamps - stamps[0]) * 1e-9).half_width
        spread = samples.std(axis=0)
        return samples.mean(axis=0), (np.where(np.isfinite(half), half, NORMAL_95 * spread) / NORMAL_95) ** 2
