# SPDX-License-Identifier: BSD-3-Clause
"""Temperature of simulated skin: heat from motors inside, which pads measure, and from a hand, which they hardly do."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.recording.recording import Recording
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.simulation.recordings import NOISE_COUNTS, REST_COUNTS, TaxelResponses, counts_recording

COUNTS_PER_K: Final = 1.2
"""Mean fall of a taxel or pad by temperature; heat reads as pressure."""
SPREAD: Final = 0.25
"""Standard deviation of that from one to the next, as a share."""
_BESIDE_M: Final = 0.005
"""Distance from a contact at which its heat has fallen to 0.6."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeatResponses(ArrayRecord):
    """How the taxels and thermal pads of a patch respond to heat."""

    taxels: FloatArray = field(metadata=array("n"))
    """Fall of each taxel by temperature; shape (n,); counts/K."""
    pads: FloatArray = field(metadata=array("t"))
    """Fall of each thermal pad; shape (t,); counts/K."""
    pad_rest: FloatArray = field(metadata=array("t"))
    """Reading of each pad when cold; shape (t,); counts."""

    @classmethod
    def drawn(cls, layout: SkinLayout, rng: np.random.Generator) -> Self:
        """Draw a patch as it comes from one batch.

        Args:
            layout: The patch.
            rng: Source of differences.

        Returns:
            Its responses.
        """
        taxels, pads = len(layout), len(layout.thermal_pads)
        return cls(
            taxels=COUNTS_PER_K * (1.0 + SPREAD * rng.standard_normal(taxels)),
            pads=COUNTS_PER_K * (1.0 + SPREAD * rng.standard_normal(pads)),
            pad_rest=REST_COUNTS + rng.uniform(-0.5, 0.5, pads),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MotorHeat(ArrayRecord):
    """Heat from inside, evenly on all of a patch, which its pads feel as its taxels do."""

    responses: HeatResponses
    """How taxels and pads respond."""
    rise_K: FloatArray = field(metadata=array(None))
    """Rise at each message; shape (k,)."""

    def pad_counts(self, rng: np.random.Generator) -> FloatArray:
        """Read the thermal pads.

        Args:
            rng: Source of noise.

        Returns:
            Readings; shape (k, t); counts.
        """
        return _read(self.responses.pad_rest - self.rise_K[:, None] * self.responses.pads, NOISE_COUNTS, rng)


@dataclass(frozen=True, slots=True, kw_only=True)
class Warmth:
    """How a patch is heated while it is recorded."""

    inside_K: float = 10.0
    """Rise by motors inside, on all of the patch."""
    inside_s: float = 240.0
    """Time constant of that."""
    outside_K: float = 0.0
    """Rise by what touches the patch, below it."""
    outside_s: float = 240.0
    """Time constant of that."""
    pads_share: float = 0.4
    """Share of the outside heat that pads feel."""
    pads_lag_s: float = 120.0
    """How much later they do."""
    rest_s: float = 10.0
    """Time at the beginning in which all is cold and nothing touches the patch."""
    hold_s: float = 960.0
    """Time for which it then is heated, and touched."""
    after_s: float = 0.0
    """Time after that without a contact; what came through it goes as it came."""
    rate_hz: float = 10.0
    """Messages per second."""


def warm_recording(
    layout: SkinLayout,
    responses: TaxelResponses,
    heat: HeatResponses,
    rng: np.random.Generator,
    *,
    warmth: Warmth | None = None,
    truth: ContactTruth | None = None,
) -> Recording:
    """Record a patch while it warms, with or without something on it.

    Args:
        layout: The patch.
        responses: How its taxels respond to pressure.
        heat: How its taxels and pads respond to heat.
        rng: Source of noise.
        warmth: How it is heated; as by default if None.
        truth: What touches it from the end of the rest on; nothing if None.

    Returns:
        The stream `counts`, a column for every number of a message; dummies are 0.
    """
    warm = warmth or Warmth()
    seconds = np.arange(round((warm.rest_s + warm.hold_s + warm.after_s) * warm.rate_hz)) / warm.rate_hz
    since = seconds - warm.rest_s
    inside = warm.inside_K * _rise(since, warm.inside_s)
    outside, felt = (warm.outside_K * _passing(since - lag, warm) for lag in (0.0, warm.pads_lag_s))
    pressure = np.zeros(len(layout)) if truth is None else truth.pressures
    near = _near(layout, pressure)
    on_pads = np.array([near[layout.modules == module].mean() for module in layout.thermal_modules])
    held = (since >= 0.0) & (since < warm.hold_s)
    counts = np.zeros((len(seconds), layout.columns))
    level = responses.rest - held[:, None] * responses.fall(pressure)
    level -= heat.taxels * (inside[:, None] + outside[:, None] * near)
    counts[:, layout.taxels] = _read(level, responses.noise, rng)
    pads = heat.pad_rest - heat.pads * (inside[:, None] + warm.pads_share * felt[:, None] * on_pads)
    counts[:, layout.thermal_pads] = _read(pads, NOISE_COUNTS, rng)
    return counts_recording(seconds, counts)


def _rise(since: FloatArray, constant_s: float) -> FloatArray:
    """Share of a rise that begins at 0."""
    return 1.0 - np.exp(-np.maximum(since, 0.0) / constant_s)


def _passing(since: FloatArray, warm: Warmth) -> FloatArray:
    """Share of the heat of a contact that begins at 0 and ends after the hold."""
    return _rise(since, warm.outside_s) - _rise(since - warm.hold_s, warm.outside_s)


def _near(layout: SkinLayout, pressure: FloatArray) -> FloatArray:
    """Share of the heat of a contact that reaches each taxel; shape (n,)."""
    from scipy.spatial import KDTree

    touched = layout.positions[pressure > 0.0]
    if not len(touched):
        return np.zeros(len(layout))
    distance, _ = KDTree(touched).query(layout.positions)
    return np.exp(-0.5 * (distance / _BESIDE_M) ** 2)


def _read(level: FloatArray, noise: FloatArray | float, rng: np.random.Generator) -> FloatArray:
    """Whole counts of 8 bits, with noise."""
    return np.clip(np.rint(level + noise * rng.standard_normal(level.shape)), 0.0, 255.0)
