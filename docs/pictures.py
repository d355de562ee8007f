# SPDX-License-Identifier: BSD-3-Clause
"""Draw pictures of the documentation, of simulated data alone: `python docs/pictures.py [FOLDER]`.

They are what the commands of the pages draw, in fewer colours. `tests/test_pictures.py` draws them again and compares.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
COLOURS = 40
"""Colours of a picture; more take more bytes."""
DEMO = ["-m", "forcetorque", "demo", "-o", "."]
BENCH, SKIN = ([str(ROOT / "examples" / f"{name}.py"), "."] for name in ("29_bench", "30_skin"))
PICTURES = {
    "learnt": (DEMO, "calibrate experiment.toml -o again.json --figure {}"),
    "joint_torques": (DEMO, "estimate experiment.toml -c calibration.json -o samples.parquet --figure {}"),
    "sphere": (DEMO, "study sphere experiment.toml -c calibration.json --figure {}"),
    "gains": (DEMO, "bench gains experiment.toml --figure {}"),
    "use": (DEMO, "evaluate experiment.toml -c calibration.json --figure {}"),
    "plan": (DEMO, "plan experiment.toml --clearance-deg 5 --figure {}"),
    "workbench": (BENCH, "bench workbench weights.toml --figure {}"),
    "temperature": (BENCH, "bench thermal warm.toml --figure {}"),
    "skin_layout": (SKIN, "skin check shank.csv --figure {}"),
    "taxels": (SKIN, "skin calibrate fit.toml -o taxels.json --figure {}"),
    "skin_contacts": (SKIN, "skin wrench touched.toml --table shank.json --figure {}"),
}
"""By name what makes the data, and the command that draws it."""
BEFORE = {"skin_contacts": "skin calibrate fit.toml -o shank.json"}
"""Commands that come first."""


def draw(folder: Path) -> None:
    """Draw all pictures.

    Args:
        folder: Folder for the files.
    """
    with tempfile.TemporaryDirectory() as name:
        for picture, (data, command) in PICTURES.items():
            place = Path(name) / Path(data[0] if data is not DEMO else "demo").stem
            if not place.exists():
                place.mkdir()
                _run(data, place)
            if picture in BEFORE:
                _run(["-m", "forcetorque", *BEFORE[picture].split()], place)
            _run(["-m", "forcetorque", *command.format(f"{picture}.png").split()], place)
            (folder / f"{picture}.png").write_bytes(_small((place / f"{picture}.png").read_bytes()))


def _run(arguments: list[str], folder: Path) -> None:
    subprocess.run([sys.executable, *arguments], cwd=folder, check=True, capture_output=True)


def _small(png: bytes) -> bytes:
    reduced = Image.open(io.BytesIO(png)).convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=0)
    small = io.BytesIO()
    reduced.save(small, "PNG", optimize=True)
    return small.getvalue()


if __name__ == "__main__":
    draw(Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES)
