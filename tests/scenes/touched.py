# SPDX-License-Identifier: BSD-3-Clause
"""Files of a simulated patch on a limb: its layout, a chamber log, and a recording in which objects rest on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.skin.layout.formats.layout_table import write_layout_table
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import ContactTruth, SkinBody, contacts
from forcetorque.skin.simulation.recordings import (
    REFERENCE_PA,
    Loading,
    TaxelResponses,
    chamber_recording,
    contact_recording,
)
from forcetorque.skin.taxels.calibrate import calibrate_skin
from tests.scenes.patches import cylinder_patch

OBJECTS = 3
EXPERIMENT = """schema = "forcetorque/experiment/1"
name = "{name}"

[recording]
format = "parquet"
path = "{name}"

[[patch]]
name = "shank"
serial = "S1"
counts = "counts"
layout = "shank.csv"
{pressure}
[[interval]]
label = "all"
start_s = 0.0
use = "calibration"
"""


def shank_layout(along: int = 6) -> SkinLayout:
    """Modules around a cylinder, in so many rows, every number of whose messages is a taxel."""
    layout = cylinder_patch(across=9, along=along).layout()
    count = np.arange(len(layout))
    none = np.zeros(0, dtype=np.int64)
    return replace(layout, name="shank", columns=len(count), taxels=count, thermal_pads=none, thermal_modules=none)


def write_table(folder: Path) -> None:
    """Calibrate the taxels on `bag.toml` to `shank.json`."""
    answer = calibrate_skin([folder / "bag.toml"], code_version="1", created="2020-01-01")
    answer.calibration.save(folder / "shank.json")


def write_touched(
    folder: Path, *, seed: int = 6, broken: int | None = None, loading: Loading | None = None, along: int = 6
) -> Sequence[ContactTruth]:
    """Write `shank.csv`, `bag.toml` and `touched.toml` with their recordings; one taxel may be at its rail."""
    truths, bag, touched = _recorded(seed, loading, along)
    write_layout_table(folder / "shank.csv", shank_layout(along))
    write_recording(folder / "bag", bag)
    if broken is not None:
        stream = touched.stream("counts")
        counts = stream.signal("taxel_counts").values.copy()
        counts[:, broken] = 255.0
        signals = {"taxel_counts": replace(stream.signal("taxel_counts"), values=counts)}
        touched = replace(touched, streams={"counts": replace(stream, signals=signals)})
    write_recording(folder / "touched", touched)
    for name, pressure in (("bag", 'pressure = "chamber"\n'), ("touched", "")):
        (folder / f"{name}.toml").write_text(EXPERIMENT.format(name=name, pressure=pressure), encoding="utf-8")
    return truths


@cache
def _recorded(seed: int, loading: Loading | None, along: int) -> tuple[tuple[ContactTruth, ...], Recording, Recording]:
    """True contacts, chamber log and recording of a patch: tests of many modules write the same."""
    layout, rng = shank_layout(along), np.random.default_rng(seed)
    taxels = TaxelResponses.drawn(len(layout), rng)
    truths = tuple(contacts(SkinBody.of(layout), rng, OBJECTS))
    bag = chamber_recording(taxels, highest_pa=REFERENCE_PA, ramp_s=8.0, rng=rng)
    later = replace(taxels, rest=taxels.rest - 1.3)
    return truths, bag, contact_recording(layout, later, truths, rng, loading=loading)
