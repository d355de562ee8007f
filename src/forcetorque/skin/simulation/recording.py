# SPDX-License-Identifier: BSD-3-Clause
"""A recording of a patch on which objects rest, one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.simulation.trace import EPOCH_NS
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.chamber import REST_COUNTS, TaxelResponses
from forcetorque.skin.simulation.contact import ContactTruth

if TYPE_CHECKING:
    from forcetorque.skin.simulation.heat import MotorHeat


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
    heat: MotorHeat | None = None,
) -> Recording:
    """Record the counts of a patch while objects are put on it and taken off.

    Args:
        layout: The patch.
        responses: How its taxels answer.
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
