# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of a simulated patch: in a pressure chamber, and under objects, one after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final, Protocol, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.errors import ShapeError, SkinError
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.simulation.trace import EPOCH_NS
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.taxels.taxel_faults import TaxelFault

REFERENCE_PA: Final = 50e3
"""Pressure up to which the patch of the thesis was calibrated."""
SIMPLE_AREA_M2: Final = 39e-6
"""Area of a taxel in (7.13), with which the sum is as much too small as in Table 7.1: a triangle of 3 cm over 10."""
REST_COUNTS: Final = 240
"""Reading without load, 0xF0; it falls with pressure."""
SWING_COUNTS: Final = 46.0
"""Mean fall at the reference pressure."""
NOISE_COUNTS: Final = 0.65
"""Standard deviation of white noise, as measured on an insole."""


class PatchHeat(Protocol):
    """How motors warm a patch, at each message."""

    @property
    def responses(self) -> Any:
        """How taxels and pads respond, a `HeatResponses`."""

    @property
    def rise_K(self) -> FloatArray:
        """Rise at each message; shape (k,)."""

    def pad_counts(self, rng: np.random.Generator) -> FloatArray:
        """Read the thermal pads.

        Args:
            rng: Source of noise.

        Returns:
            Readings; shape (k, t); counts.
        """


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelResponses(ArrayRecord):
    """Responses of n taxels, which differ from each other."""

    rest: FloatArray = field(metadata=array("n"))
    """Reading without load; shape (n,); counts."""
    swing: FloatArray = field(metadata=array("n"))
    """Fall at the reference pressure; shape (n,); counts."""
    bend: FloatArray = field(metadata=array("n"))
    """How much the curve flattens; 0 is a line; shape (n,)."""
    hysteresis: FloatArray = field(metadata=array("n"))
    """Most that a reading lags behind when pressure is taken off, over the fall at its peak; shape (n,)."""
    noise: FloatArray = field(metadata=array("n"))
    """Standard deviation of white noise; shape (n,); counts."""

    @classmethod
    def drawn(cls, number: int, rng: np.random.Generator) -> Self:
        """Draw taxels as they come from one batch.

        Rest is within half a count, the logarithm of the fall has a deviation of 0.15, bend is up to 0.5, and
        hysteresis is 2 to 7 %.

        Args:
            number: How many.
            rng: Source of their differences.

        Returns:
            The taxels.
        """
        return cls(
            rest=REST_COUNTS + rng.uniform(-0.5, 0.5, number),
            swing=SWING_COUNTS * np.exp(rng.normal(0.0, 0.15, number)),
            bend=rng.uniform(0.0, 0.5, number),
            hysteresis=rng.uniform(0.02, 0.07, number),
            noise=np.full(number, NOISE_COUNTS),
        )

    def fall(self, pressure: FloatArray, peak: FloatArray | None = None) -> FloatArray:
        """Give how far readings fall under pressure, without noise.

        Args:
            pressure: Pressure on every taxel; shape (..., n); Pa.
            peak: Largest pressure since each was last without load, if it is being taken off; shape (..., n); Pa.

        Returns:
            Fall; shape (..., n); counts.
        """
        share = pressure / REFERENCE_PA
        fall: FloatArray = self.swing * share * (1.0 + self.bend) / (1.0 + self.bend * share)
        if peak is None:
            return fall
        left = np.divide(pressure, peak, out=np.ones_like(fall), where=peak > 0.0)
        return fall + self.hysteresis * 4.0 * left * (1.0 - left) * self.fall(peak)

    def counts(
        self,
        pressure: FloatArray,
        rng: np.random.Generator,
        *,
        frames: int,
        peak: FloatArray | None = None,
        beside: FloatArray | float = 0.0,
    ) -> IntArray:
        """Read the taxels, with noise and in whole counts of 8 bits.

        Args:
            pressure: Pressure on every taxel, constant over the frames; shape (n,); Pa.
            rng: Source of noise.
            frames: How often to read.
            peak: As in `fall`.
            beside: Fall that is no pressure, such as by heat; shape (n,); counts.

        Returns:
            Readings; shape (frames, n); counts.
        """
        level = self.rest - self.fall(pressure, peak) - beside
        noisy = level + self.noise * rng.standard_normal((frames, len(level)))
        return np.clip(np.rint(noisy), 0, 255).astype(np.int64)


CHAMBER_RATE_HZ = 50.0
"""Messages per second, as an insole sends them; Hz."""
REST_S = 5.0
"""Time without pressure at either end, by default; s."""

_GAUGE_PA = 20.0
"""Standard deviation of the gauge; Pa."""
_WRAPPED_COUNTS = 300.0
"""Fall of a taxel that wraps: more than its rest level."""
_JUMP_COUNTS, _JUMPS = 60.0, 5
"""Size and number of the jumps of a taxel that jumps."""
_RISE_COUNTS = 10.0
"""How much a taxel that rises does so at the peak."""
_NOISY_COUNTS = 6.0
"""Standard deviation of a noisy taxel; counts."""


def chamber_recording(
    responses: TaxelResponses,
    *,
    highest_pa: float,
    ramp_s: float,
    rng: np.random.Generator,
    rest_s: float = REST_S,
    broken: Mapping[int, TaxelFault] | None = None,
) -> Recording:
    """Record a patch while the pressure rises evenly to a peak and falls again.

    Args:
        responses: How each taxel responds.
        highest_pa: Peak of the pressure; Pa.
        ramp_s: Time up to it, and down again; s.
        rng: Source of noise.
        rest_s: Time without pressure at either end; s.
        broken: What is wrong with which taxel; nothing if None.

    Returns:
        The streams `counts`, a column per taxel, and `chamber`, on one clock.

    Raises:
        SkinError: If an fault is of a taxel that there is not.
    """
    taxels = len(responses.rest)
    seconds = np.arange(round((2.0 * (rest_s + ramp_s)) * CHAMBER_RATE_HZ)) / CHAMBER_RATE_HZ
    peak_s = rest_s + ramp_s
    pressure = highest_pa * np.clip(1.0 - np.abs(seconds - peak_s) / ramp_s, 0.0, 1.0)
    peak = np.where(seconds > peak_s, highest_pa, pressure)
    fall = responses.fall(pressure[:, None], np.broadcast_to(peak[:, None], (len(seconds), taxels)))
    level = responses.rest - fall + responses.noise * rng.standard_normal(fall.shape)
    counts = np.clip(np.rint(level), 1.0, 254.0)
    for taxel, fault in (broken or {}).items():
        if not 0 <= taxel < taxels:
            raise SkinError(f"broken: expected taxels of 0 to {taxels - 1}, got {taxel}")
        share = pressure / highest_pa
        counts[:, taxel] = _broken(fault, level[:, taxel], float(responses.rest[taxel]), share, rng)
    stamps = EPOCH_NS + np.rint(seconds * 1e9).astype(np.int64)
    gauge = pressure + _GAUGE_PA * rng.standard_normal(len(pressure))
    return Recording(streams={stream.name: stream for stream in (_counts(stamps, counts), _chamber(stamps, gauge))})


def chamber_messages(layout: SkinLayout, taxels: TaxelResponses, rng: np.random.Generator) -> Recording:
    """Record whole messages of a patch in a chamber, up to the pressure of the thesis.

    Args:
        layout: The patch.
        taxels: How its taxels respond.
        rng: Source of noise.

    Returns:
        The streams `counts`, a column for every number of a message, thermal pads at rest, and `chamber`.
    """
    log = chamber_recording(taxels, highest_pa=REFERENCE_PA, ramp_s=8.0, rng=rng)
    stream = log.stream("counts")
    counts = np.zeros((len(stream.stamp_ns), layout.columns))
    counts[:, layout.taxels] = stream.signal("taxel_counts").values
    counts[:, layout.thermal_pads] = REST_COUNTS
    return replace(log, streams={**log.streams, "counts": _counts(stream.stamp_ns, counts)})


def _broken(
    fault: TaxelFault, level: FloatArray, rest: float, share: FloatArray, rng: np.random.Generator
) -> FloatArray:
    """What a broken taxel sends in place of its level; shape (n,); counts."""
    quiet = rest + rng.normal(0.0, 0.3, len(level))
    sent = level.copy()
    if fault is TaxelFault.WRAPS:
        return np.asarray(np.rint(quiet - _WRAPPED_COUNTS * share) % 256.0, dtype=np.float64)
    if fault is TaxelFault.RAILS:
        return np.asarray(np.where(share > 0.5, 255.0, np.rint(quiet)), dtype=np.float64)
    if fault is TaxelFault.JUMPS:
        sent[rng.choice(np.arange(1, len(sent), 2), _JUMPS, replace=False)] -= _JUMP_COUNTS
    elif fault is TaxelFault.NOISE:
        sent += rng.normal(0.0, _NOISY_COUNTS, len(level))
    else:
        sent = quiet + (_RISE_COUNTS * share if fault is TaxelFault.RISES else 0.0)
    return np.asarray(np.clip(np.rint(sent), 1.0, 254.0), dtype=np.float64)


def _counts(stamps: np.ndarray, counts: FloatArray) -> Stream:
    names = tuple(str(k) for k in range(counts.shape[1]))
    signal = Signal(quantity="taxel_counts", values=counts, columns=names, units=("counts",) * len(names))
    return Stream(name="counts", clock="board", stamp_ns=stamps, signals={"taxel_counts": signal})


def _chamber(stamps: np.ndarray, pressure: FloatArray) -> Stream:
    signal = Signal(quantity="pressure", values=pressure[:, None], columns=("pressure",), units=("Pa",))
    return Stream(name="chamber", clock="board", stamp_ns=stamps, signals={"pressure": signal})


RATE_HZ = 50.0
"""Messages per second; Hz."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Loading:
    """How objects are put on and taken off."""

    rest_s: float = 3.0
    """Time without any before the first one; s."""
    ramp_s: float = 0.5
    """Time in which each is put on, and taken off; s."""
    hold_s: float = 2.0
    """Time that each rests; s."""

    @property
    def turn_s(self) -> float:
        """Time from one object to the next; s."""
        return self.rest_s + 2.0 * self.ramp_s + self.hold_s

    def shares(self, objects: int) -> tuple[FloatArray, FloatArray]:
        """Give how much of its weight each object rests with.

        Args:
            objects: Their number, k.

        Returns:
            Times, shape (n,), and shares, shape (n, k); s.
        """
        seconds = np.arange(round((objects * self.turn_s + self.rest_s) * RATE_HZ)) / RATE_HZ
        begin = self.rest_s + self.turn_s * np.arange(objects)
        since = seconds[:, None] - begin
        left = 2.0 * self.ramp_s + self.hold_s - since
        return seconds, np.clip(np.minimum(since, left) / self.ramp_s, 0.0, 1.0)


def contact_recording(
    layout: SkinLayout,
    responses: TaxelResponses,
    truths: Sequence[ContactTruth],
    rng: np.random.Generator,
    *,
    loading: Loading | None = None,
    heat: PatchHeat | None = None,
) -> Recording:
    """Record the counts of a patch while objects are put on it and taken off.

    Args:
        layout: The patch.
        responses: How its taxels respond.
        truths: What each object does when it rests.
        rng: Source of noise.
        loading: How they are put on; as by default if None.
        heat: How motors warm the patch meanwhile, at each message; not at all if None.

    Returns:
        The stream `counts`, a column for every number of a message; dummies are 0, and without heat thermal pads stay
        at rest.

    Raises:
        ShapeError: If the heat is not that of every message.
    """
    seconds, shares = (loading or Loading()).shares(len(truths))
    if heat is not None and len(heat.rise_K) != len(seconds):
        raise ShapeError(
            f"heat: rise_K: expected one for each of {len(seconds)} messages, got {len(heat.rise_K)}; "
            "`Loading.shares` has their times"
        )
    pressures = np.stack([truth.pressures for truth in truths])  # (k, n)
    counts = np.zeros((len(seconds), layout.columns))
    counts[:, layout.thermal_pads] = REST_COUNTS if heat is None else heat.pad_counts(rng)
    rests = shares == 1.0
    was_held = np.maximum.accumulate(rests, axis=0)
    for row in range(len(seconds)):
        peak = was_held[row] * (shares[row] > 0.0) @ pressures
        now = shares[row] @ pressures
        warm = 0.0 if heat is None else heat.responses.taxels * heat.rise_K[row]
        counts[row, layout.taxels] = responses.counts(now, rng, frames=1, peak=np.maximum(peak, now), beside=warm)[0]
    return counts_recording(seconds, counts)


def counts_recording(seconds: FloatArray, counts: FloatArray) -> Recording:
    """Make a recording of messages.

    Args:
        seconds: Their times; shape (k,); s.
        counts: Messages; shape (k, columns); counts.

    Returns:
        The stream `counts`.
    """
    columns = counts.shape[1]
    signal = Signal(
        quantity="taxel_counts",
        values=counts,
        columns=tuple(map(str, range(columns))),
        units=("counts",) * columns,
    )
    stamps = EPOCH_NS + np.rint(seconds * 1e9).astype(np.int64)
    stream = Stream(name="counts", clock="board", stamp_ns=stamps, signals={"taxel_counts": signal})
    return Recording(streams={"counts": stream})
