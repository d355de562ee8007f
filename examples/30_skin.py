# SPDX-License-Identifier: BSD-3-Clause
"""Write a simulated patch of skin: its layout, two recordings in a pressure chamber, and one in which it is touched.

Usage: python examples/30_skin.py [FOLDER]

Writes shank.csv (layout), fit.toml and kept.toml (chamber), touched.toml (three objects, one after the other) and
turned.csv (the layout with inward normals on one module). docs/guides/skin.md reads them.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.skin.layout.formats.layout_table import write_layout_table
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import SkinBody, contacts
from forcetorque.skin.simulation.recordings import TaxelResponses, chamber_recording, contact_recording

TAXELS, RADIUS_M = 400, 0.05
EXPERIMENT = """schema = "forcetorque/experiment/1"
name = "{name}"

[recording]
format = "parquet"
path = "{name}"

[[patch]]
name = "shank"
serial = "P7"
counts = "counts"
{source}

[[interval]]
label = "{name}"
start_s = 0.0
use = "{use}"
"""


def shank() -> SkinLayout:
    """Lay taxels 6.5 mm apart around a limb."""
    row, column = np.divmod(np.arange(TAXELS), 20)
    angle = 0.13 * (column + 0.5 * (row % 2))
    normals = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    return SkinLayout(
        name="shank",
        frame="lower_leg",
        columns=TAXELS,
        taxels=np.arange(TAXELS),
        modules=row // 2 * 4 + column // 5,  # two rows of five
        positions=RADIUS_M * normals + np.outer(row, [0.0, 0.0, 0.0056]),
        normals=normals,
        thermal_pads=[],
        thermal_modules=[],
    )


def write_recorded(folder: Path, name: str, recording: Recording, *, use: str, source: str) -> None:
    """Write a recording and its experiment file."""
    write_recording(folder / name, recording)
    text = EXPERIMENT.format(name=name, use=use, source=source)
    (folder / f"{name}.toml").write_text(text, encoding="utf-8")


def main(folder: Path) -> None:
    """Write all files."""
    rng = np.random.default_rng(5)
    layout, responses = shank(), TaxelResponses.drawn(TAXELS, rng)
    folder.mkdir(parents=True, exist_ok=True)
    write_layout_table(folder / "shank.csv", layout)
    inward = np.where((layout.modules == 7)[:, None], -layout.normals, layout.normals)
    write_layout_table(folder / "turned.csv", replace(layout, normals=inward))
    for name, use in (("fit", "calibration"), ("kept", "validation")):
        chamber = chamber_recording(responses, highest_pa=60_000.0, ramp_s=8.0, rng=rng)
        write_recorded(folder, name, chamber, use=use, source='pressure = "chamber"')
    truths = list(contacts(SkinBody.of(layout), rng, 3))
    touched = contact_recording(layout, responses, truths, rng)
    write_recorded(folder, "touched", touched, use="validation", source='layout = "shank.csv"')
    loads = ", ".join(f"{np.linalg.norm(truth.wrench[:3]):.1f} N" for truth in truths)
    print(f"written to {folder}; the objects press with {loads}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write a simulated patch of skin with its recordings.")
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path("skin"), help="folder for the files; made if it does not exist"
    )
    main(parser.parse_args().folder)
