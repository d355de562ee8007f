# SPDX-License-Identifier: BSD-3-Clause
"""Effects that disturb a real sensor, each by itself: noise, temperature, creep, cross-talk, mounting."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, read_only, require_shape
from forcetorque.base.errors import ShapeError
from forcetorque.base.pose import skew


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Crosstalk(ArrayRecord):
    """A quadratic form per channel in the wrench relative to a full scale."""

    quadratic: FloatArray = field(metadata=array(None, 6, 6))
    """Counts at full scale times full scale; shape (c, 6, 6)."""
    full_scale: FloatArray = field(metadata=array(6))
    """Wrench that counts as one; shape (6,); N, N m."""

    def counts(self, wrench: FloatArray) -> FloatArray:
        """Give what it adds.

        Args:
            wrench: True wrenches; shape (n, 6); N, N m.

        Returns:
            Counts; shape (n, c).
        """
        relative = wrench / self.full_scale
        return np.einsum("ni,cij,nj->nc", relative, self.quadratic, relative)


def lagging(values: FloatArray, time_constant_s: float, *, rate_hz: float) -> FloatArray:
    """Put evenly spaced samples behind a first-order lag that is at rest when they start.

    Args:
        values: Samples; shape (n, ...).
        time_constant_s: Time in which 63 % of a step has come; s.
        rate_hz: Rate of the samples; Hz.

    Returns:
        The late values; same shape.
    """
    from scipy.signal import lfilter  # here because importing it takes longer than most commands

    keep = float(np.exp(-1.0 / (time_constant_s * rate_hz)))
    return lfilter([1.0 - keep], [1.0, -keep], values, axis=0, zi=keep * values[:1])[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class Creep:
    """One relaxation: a step of load is followed by a share of itself with a time constant."""

    share: float
    """What creep adds in the end, relative to the load."""
    time_constant_s: float
    """Time in which 63 % of it has come; s."""

    def __post_init__(self) -> None:
        if not self.time_constant_s > 0.0:
            raise ShapeError(f"creep: expected a positive time_constant_s, got {self.time_constant_s}")

    def response(self, strain: FloatArray, *, rate_hz: float) -> FloatArray:
        """Give the strain with creep; before the first sample the load was that of the first sample.

        Args:
            strain: Strain without creep, or what is proportional to it; shape (n, c).
            rate_hz: Rate of the samples; Hz.

        Returns:
            The same with creep; shape (n, c).
        """
        return strain + self.share * lagging(strain, self.time_constant_s, rate_hz=rate_hz)


_ACROSS = 0.3
"""Effect on channels across the plane of the arms, relative to those in it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScrewPattern(ArrayRecord):
    """Torques of the screws around the rim."""

    angle_rad: FloatArray = field(metadata=array("k"))
    """Where the screws are, about the z axis from the x axis; shape (k,), k at least 3; rad."""
    torque_Nm: FloatArray = field(metadata=array("k"))
    """Torque of each; shape (k,); N m."""
    tight_Nm: float = 2.0
    """Torque that the screws are meant for; N m."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if len(self.angle_rad) < 3 or not self.tight_Nm > 0.0 or (self.torque_Nm < 0.0).any():
            raise ShapeError("screws: expected at least three, torques of at least zero and a positive tight_Nm")

    def unevenness(self, angle_rad: Any) -> FloatArray:
        """Compute by how much the rim is held tighter than in the mean at some angles.

        The first two harmonics around the rim are fitted to the screws' deviations, as far as their
        number allows: a rim is stiff and smooths what lies between the screws.

        Args:
            angle_rad: Places; shape (m,); rad.

        Returns:
            Deviation relative to `tight_Nm`; shape (m,).
        """
        deviation = (self.torque_Nm - self.torque_Nm.mean()) / self.tight_Nm
        harmonics = 1 if len(self.angle_rad) < 5 else 2
        design = _harmonics(self.angle_rad, harmonics)
        coefficients = np.linalg.lstsq(design, deviation, rcond=None)[0]
        return _harmonics(np.asarray(angle_rad, dtype=np.float64), harmonics) @ coefficients


def mounted(
    sensitivity: Any, screws: ScrewPattern, *, arm_angle_rad: Any, in_plane: Any, strength: float = 0.1
) -> FloatArray:
    """Change the sensitivity of a sensor as uneven screws do.

    Args:
        sensitivity: Response of every channel before mounting; shape (c, 6); counts/N, counts/(N m).
        screws: The screws.
        arm_angle_rad: Where each channel's arm is, about the z axis; shape (c,); rad.
        in_plane: Whether each channel is in the plane of the arms; shape (c,).
        strength: Relative change of a channel in the plane where the rim is tighter by the full torque.

    Returns:
        Response after mounting; shape (c, 6); counts/N, counts/(N m).
    """
    before = read_only(sensitivity, name="sensitivity", shape=(None, 6))
    angle = read_only(arm_angle_rad, name="arm_angle_rad", shape=(len(before),))
    uneven = screws.unevenness(angle)
    # the slope of the unevenness along the rim turns an arm, its value stiffens it
    step = 1e-4
    slope = (screws.unevenness(angle + step) - screws.unevenness(angle - step)) / (2.0 * step)
    share = strength * np.where(np.asarray(in_plane, dtype=bool), 1.0, _ACROSS)
    after = np.empty_like(before)
    for c, row in enumerate(before):
        turn = np.eye(3) + share[c] * slope[c] * skew([0.0, 0.0, 1.0])
        after[c] = (1.0 - share[c] * uneven[c]) * np.concatenate([turn @ row[:3], turn @ row[3:]])
    return after


def _harmonics(angle: FloatArray, count: int) -> FloatArray:
    return np.column_stack([f(k * angle) for k in range(1, count + 1) for f in (np.cos, np.sin)])


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise:
    """Noise of every channel, independent of the others."""

    white_counts: float
    """Standard deviation of the white part; counts."""
    corner_hz: float = 0.0
    """Frequency at which the power of the 1/f part equals that of the white part; Hz; 0 for none."""

    def __post_init__(self) -> None:
        if not (self.white_counts >= 0.0 and self.corner_hz >= 0.0):
            raise ShapeError(f"noise: expected figures of at least zero, got {self.white_counts}, {self.corner_hz}")

    def sample(self, samples: int, channels: int, *, rate_hz: float, rng: np.random.Generator) -> FloatArray:
        """Draw noise for evenly spaced samples.

        The spectrum of white noise is multiplied by sqrt(1 + corner / f); the mean is left at that of
        the white part, since a power-up offset is drawn by itself.

        Args:
            samples: Number of samples, n.
            channels: Number of channels, c.
            rate_hz: Rate of the samples; Hz.
            rng: Source of randomness.

        Returns:
            Noise; shape (n, c); counts.
        """
        white = self.white_counts * rng.standard_normal((samples, channels))
        if self.corner_hz == 0.0 or samples < 2:
            return white
        spectrum = np.fft.rfft(white, axis=0)
        frequency = np.fft.rfftfreq(samples, 1.0 / rate_hz)
        spectrum[1:] *= np.sqrt(1.0 + self.corner_hz / frequency[1:])[:, None]
        return np.fft.irfft(spectrum, n=samples, axis=0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ThermalDrift(ArrayRecord):
    """Change of every channel with the temperature of the sensor.

    Three parts add up: `slope (T - T0)`; a part proportional to the difference between gauges,
    which is the temperature minus a copy of it that lags by a time constant; and a play of a
    given width, so that heating and cooling take different paths.
    """

    slope: FloatArray = field(metadata=array("c"))
    """Linear part; shape (c,); counts/degC."""
    reference_degC: float
    """Temperature without drift; degC."""
    gradient_slope: FloatArray | None = field(default=None, metadata=array("c"))
    """Part with the difference between gauges; shape (c,); counts/degC; None for none."""
    lag_s: float = 60.0
    """Time constant of the gauges that follow later; s."""
    hysteresis_slope: FloatArray | None = field(default=None, metadata=array("c"))
    """Part with the play; shape (c,); counts/degC; None for none."""
    play_degC: float = 2.0
    """Half the width of the play; degC."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not (self.lag_s > 0.0 and self.play_degC >= 0.0):
            raise ShapeError(
                f"thermal drift: expected lag_s > 0 and play_degC >= 0, got {self.lag_s}, {self.play_degC}"
            )

    def drift(self, temperature_degC: FloatArray, *, rate_hz: float) -> FloatArray:
        """Give the drift of evenly spaced samples.

        Args:
            temperature_degC: Temperature of the sensor; shape (n,); degC.
            rate_hz: Rate of the samples; Hz.

        Returns:
            What is added to every channel; shape (n, c); counts.
        """
        require_shape(temperature_degC, name="temperature_degC", shape=(None,))
        change = np.outer(temperature_degC - self.reference_degC, self.slope)
        if self.gradient_slope is not None:
            late = lagging(temperature_degC, self.lag_s, rate_hz=rate_hz)
            change = change + np.outer(temperature_degC - late, self.gradient_slope)
        if self.hysteresis_slope is not None:
            change = change + np.outer(self._play(temperature_degC) - self.reference_degC, self.hysteresis_slope)
        return change

    def _play(self, temperature: FloatArray) -> FloatArray:
        """Play operator: a follower that is pushed only when the temperature reaches the end of its play."""
        # while the temperature rises, or falls, the follower stays until it is pushed
        turns = np.flatnonzero(np.diff(np.sign(np.diff(temperature)))) + 2
        followed, position = [], temperature[0]
        for stretch in np.split(temperature, turns):
            followed.append(position.clip(stretch - self.play_degC, stretch + self.play_degC))
            position = followed[-1][-1]
        return np.concatenate(followed)
