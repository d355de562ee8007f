# SPDX-License-Identifier: BSD-3-Clause
"""Workbenches as scripts and notebooks ask about them."""

from __future__ import annotations

from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

from forcetorque import analysis
from forcetorque.analysis import BenchRecording


def workbench(*recordings: BenchRecording | Path | str, **options: Any) -> analysis.Workbench:
    """Calibrate sensors with known loads, and find faults of the workbench: `workbench("SN170.toml")`.

    Args:
        recordings: What was hung on each sensor, or the file of it.
        options: As of `forcetorque.analysis.workbench`: full_matrix, only_next, spec, seed.

    Returns:
        Faults, errors and matrices; `save` writes the calibration of a single sensor.
    """
    read = [given if isinstance(given, BenchRecording) else analysis.read_bench(given) for given in recordings]
    created = datetime.now(UTC).isoformat(timespec="seconds")
    return analysis.workbench(read, code_version=version("forcetorque"), created=created, **options)
