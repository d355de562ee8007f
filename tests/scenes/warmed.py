# SPDX-License-Identifier: BSD-3-Clause
"""Files of a simulated patch with thermal pads: chamber log, warm-up, and an object held while it is warm."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.skin.layout.formats.layout_table import write_layout_table
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ContactTruth, SkinBody, contacts
from forcetorque.skin.simulation.recordings import (
    NOISE_COUNTS,
    TaxelResponses,
    chamber_messages,
)
from forcetorque.skin.simulation.temperature import HeatResponses, Warmth, warm_recording
from tests.scenes.patches import cylinder_patch
from tests.scenes.touched import EXPERIMENT

MASS_KG: Final = 1.0
WARM_UP: Final = Warmth(hold_s=600.0, inside_s=150.0)
"""Ten degrees from inside, without contact."""
HELD: Final = Warmth(hold_s=300.0, inside_s=80.0, after_s=30.0)
"""The same, with an object, which then is taken off."""
HAND: Final = Warmth(hold_s=300.0, inside_K=0.0, outside_K=10.0, outside_s=80.0, pads_lag_s=40.0, after_s=30.0)
"""Ten degrees through the object."""


@dataclass(frozen=True, kw_only=True)
class WarmShank:
    """A small patch, its taxels, and an object on it."""

    layout: SkinLayout
    taxels: TaxelResponses
    heat: HeatResponses
    truth: ContactTruth

    @classmethod
    def drawn(cls, seed: int = 5) -> WarmShank:
        """Draw taxels and an object of a kilogram."""
        layout = replace(cylinder_patch(across=7, along=4).layout(), name="shank")
        rng = np.random.default_rng(seed)
        body = SkinBody.of(layout)
        light = next(contacts(body, rng, 1))
        return cls(
            layout=layout,
            taxels=TaxelResponses.drawn(len(layout), rng),
            heat=HeatResponses.drawn(layout, rng),
            truth=body.press(replace(light.contact, mass_kg=MASS_KG)),
        )

    def recorded(self, warmth: Warmth, *, touched: bool = False, seed: int = 7) -> Recording:
        """A recording of it while it warms."""
        truth = self.truth if touched else None
        return warm_recording(
            self.layout, self.taxels, self.heat, np.random.default_rng(seed), warmth=warmth, truth=truth
        )

    def chamber(self, seed: int = 8) -> Recording:
        """A chamber log; pads stay as they are."""
        return chamber_messages(self.layout, self.taxels, np.random.default_rng(seed))


def counts_of(recording: Recording) -> tuple[FloatArray, FloatArray]:
    """Times and counts; s, counts."""
    stream = recording.stream("counts")
    return 1e-9 * (stream.stamp_ns - stream.stamp_ns[0]), stream.signal("taxel_counts").values.copy()


def with_counts(recording: Recording, counts: FloatArray) -> Recording:
    """The recording with other counts."""
    stream = recording.stream("counts")
    columns = counts.shape[1]
    signal = replace(
        stream.signal("taxel_counts"),
        values=counts,
        columns=tuple(map(str, range(columns))),
        units=("counts",) * columns,
    )
    changed = replace(stream, signals={"taxel_counts": signal})
    return replace(recording, streams={**recording.streams, "counts": changed})


def write_log(folder: Path, name: str, recording: Recording) -> None:
    """Write a recording and its experiment file."""
    write_recording(folder / name, recording)
    pressure = 'pressure = "chamber"\n' if "chamber" in recording.streams else ""
    (folder / f"{name}.toml").write_text(EXPERIMENT.format(name=name, pressure=pressure), encoding="utf-8")


def write_warmed(folder: Path) -> WarmShank:
    """Write `shank.csv`, and `bag`, `warm`, `held` and `hand`, each with its experiment file."""
    shank = WarmShank.drawn()
    write_layout_table(folder / "shank.csv", shank.layout)
    write_log(folder, "bag", shank.chamber())
    write_log(folder, "warm", shank.recorded(WARM_UP))
    write_log(folder, "held", shank.recorded(HELD, touched=True))
    write_log(folder, "hand", shank.recorded(HAND, touched=True))
    return shank


def late_pads(shank: WarmShank, warmth: Warmth, lag_s: float, *, touched: bool = False, seed: int = 7) -> Recording:
    """A recording of it while it warms from inside, with pads that follow heat by a first-order lag."""
    recording = shank.recorded(warmth, touched=touched, seed=seed)
    seconds, counts = counts_of(recording)
    since, heating = np.maximum(seconds - warmth.rest_s, 0.0), warmth.inside_s
    left = heating * np.exp(-since / heating) - (lag_s * np.exp(-since / lag_s) if lag_s else 0.0)
    rise = warmth.inside_K * (1.0 - left / (heating - lag_s))
    level = shank.heat.pad_rest - rise[:, None] * shank.heat.pads
    noise = NOISE_COUNTS * np.random.default_rng([seed, 1]).standard_normal(level.shape)
    counts[:, shank.layout.thermal_pads] = np.rint(level + noise)
    return with_counts(recording, counts)
