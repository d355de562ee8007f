# SPDX-License-Identifier: BSD-3-Clause
"""Experiments with a simulated patch in a pressure chamber."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.skin.simulation.recordings import REFERENCE_PA, TaxelResponses, chamber_recording
from forcetorque.skin.taxels.taxel_faults import TaxelFault

TAXELS = 60
BROKEN = {
    4: TaxelFault.NEVER_MOVES,
    9: TaxelFault.RAILS,
    17: TaxelFault.WRAPS,
    23: TaxelFault.JUMPS,
    31: TaxelFault.NOISE,
    40: TaxelFault.RISES,
}
"""What is wrong with which taxel in both recordings."""
LATER = {50: TaxelFault.JUMPS, 51: TaxelFault.RAILS}
"""What breaks before the second recording."""
RAMP_S = 20.0
HIGHEST_PA = 1.6 * REFERENCE_PA

TEXT = """schema = "forcetorque/experiment/1"
name = "{name}"

[recording]
format = "parquet"
path = "{name}"

[[patch]]
name = "palm"
serial = "P7"
counts = "counts"
pressure = "chamber"

[[interval]]
label = "cycle"
start_s = 0.0
use = "{use}"
"""


def responses(*, hysteresis: bool = True, seed: int = 3) -> TaxelResponses:
    """Taxels of one batch."""
    drawn = TaxelResponses.drawn(TAXELS, np.random.default_rng(seed))
    return drawn if hysteresis else replace(drawn, hysteresis=np.zeros(TAXELS))


def chamber(
    taxels: TaxelResponses,
    seed: int,
    *,
    broken: Mapping[int, TaxelFault] | None = None,
    highest_pa: float = HIGHEST_PA,
) -> Recording:
    """A recording of them."""
    rng = np.random.default_rng(seed)
    return chamber_recording(taxels, highest_pa=highest_pa, ramp_s=RAMP_S, rng=rng, broken=broken)


def write_chamber(folder: Path, name: str, recording: Recording, *, use: str = "calibration") -> Path:
    """The experiment file of a recording, which is written beside it."""
    write_recording(folder / name, recording)
    file = folder / f"{name}.toml"
    file.write_text(TEXT.format(name=name, use=use), encoding="utf-8")
    return file


def write_chambers(folder: Path) -> tuple[Path, Path]:
    """A recording to fit and one to judge by, at another rest level, after two more taxels broke."""
    taxels = responses()
    moved = replace(taxels, rest=taxels.rest - 1.7)
    fit = write_chamber(folder, "fit", chamber(taxels, 11, broken=BROKEN))
    kept = write_chamber(folder, "kept", chamber(moved, 12, broken=BROKEN | LATER), use="validation")
    return fit, kept
