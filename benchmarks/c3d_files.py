# SPDX-License-Identifier: BSD-3-Clause
"""C3D files: our reader against the loop over the frames of the library `c3d`.

The file is synthetic, of a trial of 30 s with two force plates at 1000 Hz and 30 markers at 100 Hz.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import c3d
import numpy as np

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.formats.c3d.c3d_file import read_c3d
from forcetorque.formats.c3d.writing import write_c3d

FRAME_RATE_HZ, SAMPLES, CHANNELS, MARKERS = 100.0, 10, 12, 30


def _write(path: Path, frames: int) -> None:
    rng = np.random.default_rng(1)
    names = {"ANALOG:LABELS": tuple(f"ch{k}" for k in range(CHANNELS)), "ANALOG:UNITS": ("N",) * CHANNELS}
    write_c3d(
        path,
        names | {"POINT:LABELS": tuple(f"m{k}" for k in range(MARKERS)), "POINT:UNITS": ("mm",)},
        analog=rng.normal(scale=100.0, size=(frames * SAMPLES, CHANNELS)),
        markers=rng.normal(scale=1000.0, size=(frames, MARKERS, 3)),
        frame_rate_hz=FRAME_RATE_HZ,
    )


def _loop(path: Path) -> np.ndarray:
    """What users of the library write: a loop over the frames."""
    with path.open("rb") as file:
        frames = [(points, analog) for _, points, analog in c3d.Reader(file).read_frames()]
    return np.concatenate([analog for _, analog in frames], axis=1).T


def main() -> None:
    """Time both and write the ratio."""
    options = arguments(__doc__ or "")
    frames, rounds = (500, 3) if options.quick else (3000, 10)
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "trial.c3d"
        _write(path, frames)
        seconds = interleaved({"read_c3d": lambda: read_c3d(path), "c3d": lambda: _loop(path)}, rounds=rounds)
        difference = float(np.abs(read_c3d(path).analog - _loop(path)).max())
    write_result(
        options.json,
        ratios={"speed against the loop of c3d": 1.0 / median_ratio(seconds["read_c3d"], seconds["c3d"])},
        seconds=seconds,
        accuracy={"analog, largest difference, N": difference},
        rounds=rounds,
        packages=("numpy", "c3d"),
    )


if __name__ == "__main__":
    main()
