# SPDX-License-Identifier: BSD-3-Clause
"""A sensor on a spring that is tapped, let go, or swung on: a simulated truth sixteen times finer than its samples.

It reads `gain / (1 + 2 damping s / w0 + (s / w0)^2)` of the force and of a coloured force that nobody measures, then
white noise is added and the sum is rounded. The measured force has noise of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray

FINER = 16
"""Steps of the truth in a sample."""
OFFSET_N, QUANTUM_N, WHITE_N, HIDDEN_N, HIDDEN_HZ, FORCE_NOISE_N = 3.0, 0.02, 0.05, 0.05, 5.0, 0.02
MASS_KG, GRAVITY = 2.0, 9.80665
TAPS, RELEASES = 8, 5

TEXT = """\
schema = "forcetorque/experiment/1"
name = "excited"

[load]
frame = "ft"
applied = "{applied}"
measure_direction = "child_to_parent"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "{log}"
stamp = {{ column = "t", unit = "s" }}

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft"

[[recording.stream.signal]]
quantity = "applied_wrench"
columns = ["hx", "hy", "hz", "htx", "hty", "htz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft"

[[sensor]]
name = "wrist"
stream = "log"
serial = "FT1"
prior = "identity"

[[interval]]
label = "taps"
start_s = 0.0
use = "calibration"
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spring:
    """A sensor with what is mounted on it."""

    natural_hz: float = 32.0
    """Natural frequency; Hz."""
    damping: float = 0.04
    """Damping ratio."""
    gain: float = 0.95
    """Reading by force at rest."""
    rate_hz: float = 1000.0
    """Rate; Hz."""

    @classmethod
    def drawn(cls, rng: np.random.Generator, *, slow: bool = False) -> Spring:
        """Draw one; a slow one is an arm that yields, on which a mass can swing."""
        return cls(
            natural_hz=rng.uniform(5.0, 9.0) if slow else rng.uniform(20.0, 60.0),
            damping=rng.uniform(0.02, 0.08),
            gain=rng.uniform(0.8, 1.2),
            rate_hz=200.0 if slow else 1000.0,
        )

    @property
    def truth(self) -> FloatArray:
        """Natural frequency, damping, gain; shape (3,)."""
        return np.array([self.natural_hz, self.damping, self.gain])

    def instants(self, seconds: float) -> FloatArray:
        """Instants of the truth; s."""
        return np.arange(round(seconds * self.rate_hz) * FINER) / (self.rate_hz * FINER)

    def read(self, rng: np.random.Generator, force: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Instants, measured force, reading."""
        from scipy.signal import cont2discrete, lfilter, lfilter_zi

        hidden = HIDDEN_N * _coloured(rng, len(force), self.rate_hz * FINER)
        w = 2.0 * np.pi * self.natural_hz
        system = ([self.gain * w**2], [1.0, 2.0 * self.damping * w, w**2])
        (b,), a, _ = cont2discrete(system, 1.0 / (self.rate_hz * FINER), method="foh")
        moved = force + hidden
        reading = lfilter(b, a, moved, zi=lfilter_zi(b, a) * moved[0])[0][::FINER] + OFFSET_N
        reading = reading + WHITE_N * rng.normal(size=len(reading))
        measured = force[::FINER] + FORCE_NOISE_N * rng.normal(size=len(reading))
        return np.arange(len(reading)) / self.rate_hz, measured, QUANTUM_N * np.round(reading / QUANTUM_N)


def _coloured(rng: np.random.Generator, n: int, rate_hz: float) -> FloatArray:
    """Noise of deviation 1 that forgets itself with a corner of `HIDDEN_HZ`."""
    from scipy.signal import lfilter

    keep = np.exp(-2.0 * np.pi * HIDDEN_HZ / rate_hz)
    first = round(rate_hz)
    coloured: FloatArray = lfilter([np.sqrt(1.0 - keep**2)], [1.0, -keep], rng.normal(size=n + first))[first:]
    return coloured


def tapped(rng: np.random.Generator, spring: Spring, *, taps: int = TAPS, apart_s: float = 2.0) -> FloatArray:
    """Force of taps of 20 to 50 N in 5 to 8 ms; N."""
    time = spring.instants(taps * apart_s + 0.6)
    force = np.zeros(len(time))
    for k in range(taps):
        start, length = 0.5 + apart_s * k + rng.uniform(0.0, 0.1), rng.uniform(0.005, 0.008)
        phase = (time - start) / length
        force += np.where((phase > 0.0) & (phase < 1.0), rng.uniform(20.0, 50.0) * np.sin(np.pi * phase) ** 2, 0.0)
    return force


def released(rng: np.random.Generator, spring: Spring, *, apart_s: float = 4.0) -> FloatArray:
    """Force of a weight that is hung on slowly and let go within 1 ms, again and again; N."""
    time = spring.instants(RELEASES * apart_s + 1.4)
    force = np.zeros(len(time))
    for k in range(RELEASES):
        at = 2.4 + apart_s * k + rng.uniform(0.0, 0.1)
        hung = np.clip(time - (at - 2.3), 0.0, 1.0)
        held = hung**2 * (3.0 - 2.0 * hung) * (1.0 - np.clip((time - at) / 0.001, 0.0, 1.0))
        force -= MASS_KG * GRAVITY * held
    return force


def swung(rng: np.random.Generator, spring: Spring, *, seconds: float = 120.0) -> FloatArray:
    """Pull of a mass on a rope across its rest, damped, at about 0.9 Hz with what a large swing has of harmonics; N."""
    time = spring.instants(seconds)
    angle = rng.uniform(0.5, 0.8) * np.exp(-time / 200.0) * np.sin(2.0 * np.pi * rng.uniform(0.8, 1.0) * time)
    most = np.abs(angle).max()
    pull = MASS_KG * GRAVITY * (3.0 * np.cos(angle) - 2.0 * np.cos(most * np.exp(-time / 200.0)))
    return np.asarray(pull * np.sin(angle))


def write_excited(
    folder: Path, time: FloatArray, force: FloatArray, reading: FloatArray, *, name: str = "taps"
) -> Path:
    """Write log and experiment file; the force acts along z, other components are noise alone."""
    rng = np.random.default_rng(1)
    quiet = np.array([0.05, 0.05, 0.0, 0.002, 0.002, 0.002]) * rng.normal(size=(len(time), 6))
    wrench, applied = quiet + 0.0, np.zeros((len(time), 6))
    wrench[:, 2], applied[:, 2] = reading, force
    header = "t,fx,fy,fz,tx,ty,tz,hx,hy,hz,htx,hty,htz"
    rows = np.column_stack([time, wrench, applied])
    np.savetxt(folder / f"{name}.csv", rows, delimiter=",", header=header, comments="", fmt="%.9g")
    path = folder / f"{name}.toml"
    path.write_text(TEXT.format(log=f"{name}.csv", applied="log"))
    return path


def write_taps(folder: Path, *, seed: int = 3, spring: Spring | None = None) -> Path:
    """Write five taps on a sensor at 500 Hz."""
    rng, spring = np.random.default_rng(seed), spring or Spring(rate_hz=500.0)
    return write_excited(folder, *spring.read(rng, tapped(rng, spring, taps=5, apart_s=1.5)))
