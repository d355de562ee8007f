# SPDX-License-Identifier: BSD-3-Clause
"""Hundreds of calibrations of one sensor, beside plain NumPy: 351 fits, and their errors on a million samples."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from benchmarks.calibration import fitting, generative, judging
from benchmarks.calibration.measured import Measured
from benchmarks.harness import arguments, write_result

PARTS: tuple[Callable[..., Measured], ...] = (fitting.measure, generative.measure, judging.measure)
"""What to measure, one after the other; each names its figures after itself."""


def main() -> None:
    """Measure all parts and write the result."""
    options = arguments(__doc__ or "")
    rounds = 3 if options.quick else 10
    load: dict[str, Any] = {"load average at the start": os.getloadavg()}
    parts = [measure(quick=options.quick, rounds=rounds) for measure in PARTS]
    figures = load | {name: value for part in parts for name, value in part.figures.items()}
    figures["load average at the end"] = os.getloadavg()
    write_result(
        options.json,
        ratios={name: value for part in parts for name, value in part.ratios.items()},
        seconds={name: values for part in parts for name, values in part.seconds.items()},
        accuracy={name: value for part in parts for name, value in part.accuracy.items()},
        rounds=rounds,
        packages=("numpy", "numba"),
        figures=figures,
    )
    for part in parts:
        for name, value in (*part.accuracy.items(), *part.figures.items()):
            print(f"{name}: {value}")


if __name__ == "__main__":
    main()
