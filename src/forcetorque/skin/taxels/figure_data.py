# SPDX-License-Identifier: BSD-3-Clause
"""What figures of a calibration of taxels are drawn of: samples of one recording, and the curves of a taxel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.skin.taxels.curve import CurveKind, TaxelCurve
from forcetorque.skin.taxels.recording import PatchRecording

_DRAWN = 10
"""Taxels whose samples are drawn: more would hide each other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelPicture:
    """A recording of pressure, and the curves of one taxel."""

    recording: str
    """Recording."""
    seconds: FloatArray
    """Instants; shape (n,); s."""
    pressure: FloatArray
    """Pressure above that at rest; shape (n,); Pa."""
    fall: FloatArray
    """Counts below rest of sound taxels, spread over all; shape (n, k)."""
    mean_fall: FloatArray
    """Mean over all sound taxels; shape (n,); counts."""
    names: tuple[str, ...]
    """Names of the k taxels."""
    curves: Mapping[str, FloatArray]
    """Curves of the first of them at `levels`, by their forms; Pa."""
    levels: FloatArray
    """Counts below rest at which they are given; shape (m,)."""
    highest: float
    """Highest fitted pressure; Pa."""

    def __post_init__(self) -> None:
        n, k = len(self.seconds), len(self.names)
        shapes = {"seconds": (n,), "pressure": (n,), "fall": (n, k), "mean_fall": (n,), "levels": (None,)}
        for name, shape in shapes.items():
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=shape))


def taxel_picture(
    recording: PatchRecording,
    name: str,
    columns: Sequence[int],
    curves: Mapping[CurveKind, Sequence[TaxelCurve | None]],
    highest: float,
) -> TaxelPicture:
    """Choose what is drawn of a recording that was fitted.

    Args:
        recording: The recording.
        name: Its name.
        columns: Column of every taxel.
        curves: Curves of every taxel by their forms.
        highest: Highest fitted pressure; Pa.

    Returns:
        Taxels with a curve, evenly spread over their ranges, the one in the middle first.
    """
    reach = {k: curve.range_counts for k, curve in enumerate(next(iter(curves.values()))) if curve is not None}
    ranked = sorted(reach, key=reach.__getitem__)
    middle = ranked[len(ranked) // 2]
    spread = [ranked[place] for place in np.linspace(0, len(ranked) - 1, min(_DRAWN, len(ranked))).astype(int)]
    drawn = list(dict.fromkeys([middle, *spread]))
    fall = recording.cycle.fall
    levels = np.linspace(0.0, float(fall[:, middle].max()) + 3.0, 200)
    chosen = {kind: own[middle] for kind, own in curves.items()}
    return TaxelPicture(
        recording=name,
        seconds=recording.seconds,
        pressure=recording.cycle.pressure,
        fall=fall[:, drawn],
        mean_fall=fall[:, ranked].mean(axis=1),
        names=tuple(f"taxel {columns[k]}" for k in drawn),
        curves={kind.value: curve.pressure(levels) for kind, curve in chosen.items() if curve is not None},
        levels=levels,
        highest=highest,
    )
