# SPDX-License-Identifier: BSD-3-Clause
"""Long recordings and many: CPU time and peak memory of `inspect`, `fleet add` and of a fit, against length and number.

Ratios compare a recording with one of a quarter of its length, and a fit of some recordings with one of a quarter of
them, so above 4 where the effort grows faster than the data. Every task is a process of its own, whose peak memory is
that of the operating system. Filters of the whole stream are the named peer of those around the looked-at rows.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from benchmarks.commands import command_cost, simulated_recordings
from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.recording.smoothing import DERIVATIVE_WINDOW, FilteredColumns, smooth_columns

_ROWS = 400
"""Rows that are looked at in a long stream, evenly."""


def _filters(rounds: int) -> tuple[dict[str, list[float]], bool]:
    """Derivatives of a long stream in some rows: around them alone, and of all."""
    stamps = np.arange(200_000) * 10_000_000
    values = np.random.default_rng(1).normal(size=(len(stamps), 7)).cumsum(axis=0)
    rows = np.linspace(0, len(stamps) - 1, _ROWS).astype(np.int64)

    def around() -> list[np.ndarray]:
        return FilteredColumns(stamps, values, DERIVATIVE_WINDOW, derivatives=(1, 2)).at(rows)

    def whole() -> list[np.ndarray]:
        return [smooth_columns(stamps, values, DERIVATIVE_WINDOW, derivative=k)[rows] for k in (1, 2)]

    equal = all(np.array_equal(a, b) for a, b in zip(around(), whole(), strict=True))
    return interleaved({"around rows": around, "whole stream": whole}, rounds=rounds), equal


def main() -> None:
    """Measure lengths and numbers, and write figures and ratios."""
    options = arguments(__doc__ or "")
    length, number, rounds = (120.0, 8, 3) if options.quick else (3600.0, 200, 6)
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        lengths = {"quarter": length / 4.0, "whole": length}
        for name, file in zip(lengths, simulated_recordings(folder, "biped", "biped", lengths), strict=True):
            cpu, memory = command_cost("inspect", file, "--format", "json")
            figures |= {f"inspect {name} cpu_s": cpu, f"inspect {name} peak_MB": memory}
            cpu, memory = command_cost("fleet", "add", file, "--into", folder / "dataset")
            figures |= {f"fleet add {name} cpu_s": cpu, f"fleet add {name} peak_MB": memory}
        files = simulated_recordings(folder, "arm", "arm", {f"r{k:03d}": 20.0 for k in range(number)})
        for name, some in (("quarter", files[: number // 4]), ("whole", files)):
            cpu, memory = command_cost("calibrate", *some, "-o", folder / f"fit_{name}")
            figures |= {f"fit {name} cpu_s": cpu, f"fit {name} peak_MB": memory}
    seconds, equal = _filters(rounds)
    write_result(
        options.json,
        ratios={
            "filter around rows, whole stream": median_ratio(seconds["around rows"], seconds["whole stream"]),
            **{
                f"{task} {what}, a quarter of the {of}": figures[f"{task} whole {unit}"]
                / figures[f"{task} quarter {unit}"]
                for task, of in (("inspect", "length"), ("fleet add", "length"), ("fit", "recordings"))
                for what, unit in (("cpu", "cpu_s"), ("memory", "peak_MB"))
            },
        },
        seconds=seconds,
        accuracy={"filters equal": equal},
        rounds=rounds,
        packages=("numpy", "scipy"),
        figures={**figures, "length_s": length, "recordings": number},
    )


if __name__ == "__main__":
    main()
