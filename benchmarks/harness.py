# SPDX-License-Identifier: BSD-3-Clause
"""What every benchmark shares: interleaved rounds, ratios, and one JSON object per run."""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from _typeshed import DataclassInstance


def arguments(description: str) -> argparse.Namespace:
    """Parse the options of a benchmark.

    Args:
        description: First line of its help.

    Returns:
        `quick`, `json` and `data`.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quick", action="store_true", help="few rounds and small inputs")
    parser.add_argument("--json", type=Path, required=True, help="file for the result")
    parser.add_argument("--data", type=Path, default=Path("../shared/data"), help="folder of measured data")
    return parser.parse_args()


def interleaved(
    tasks: Mapping[str, Callable[[], object]], *, rounds: int, clock: Callable[[], float] = time.perf_counter
) -> dict[str, list[float]]:
    """Time tasks in turn, so that a busy machine disturbs all alike; one round of warming up is not counted.

    Args:
        tasks: What to time, by name.
        rounds: Counted rounds.
        clock: Seconds; `time.process_time` for processor time, which other programs disturb less.

    Returns:
        Seconds of every round, by name.
    """
    seconds: dict[str, list[float]] = {name: [] for name in tasks}
    for number in range(rounds + 1):
        for name, task in tasks.items():
            start = clock()
            task()
            if number:
                seconds[name].append(clock() - start)
    return seconds


def median_ratio(ours: list[float], peer: list[float]) -> float:
    """Give the median over rounds of our time divided by the peer's in the same round.

    Args:
        ours: Seconds of our rounds.
        peer: Seconds of the peer's rounds.

    Returns:
        Ratio; below 1 where we are faster.
    """
    return statistics.median(a / b for a, b in zip(ours, peer, strict=True))


def write_result(
    path: Path,
    *,
    ratios: Mapping[str, float],
    seconds: Mapping[str, list[float]],
    accuracy: Mapping[str, Any],
    rounds: int,
    packages: tuple[str, ...],
    figures: Mapping[str, Any] | None = None,
) -> None:
    """Write one object with everything that a figure in the README needs, and print the ratios.

    Args:
        path: File to write; its folder is made.
        ratios: Ours against the named peer.
        seconds: Seconds of every round.
        accuracy: How far the results agree.
        rounds: Counted rounds.
        packages: Packages whose versions matter.
        figures: Anything else that was measured, with its unit in its name.
    """
    commit = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True, check=False)
    result = {
        "ratios": dict(ratios),
        "seconds": {
            name: {"median": statistics.median(values), "quartiles": statistics.quantiles(values, n=4)}
            for name, values in seconds.items()
        },
        "accuracy": dict(accuracy),
        "figures": dict(figures or {}),
        "rounds": rounds,
        "machine": {"processor": platform.machine(), "cores": os.cpu_count(), "python": platform.python_version()},
        "versions": {name: version(name) for name in packages},
        "commit": commit.stdout.strip(),
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    for name, value in ratios.items():
        print(f"{name}: {value:.2f}")


def write_cases(path: Path | None, cases: Sequence[DataclassInstance]) -> None:
    """Write every case of a benchmark whose cases are read one by one.

    Args:
        path: File to write; None for none.
        cases: The cases, a JSON object each.
    """
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps([asdict(case) for case in cases], indent=1) + "\n", encoding="utf-8")
