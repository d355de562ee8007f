# SPDX-License-Identifier: BSD-3-Clause
"""Workbenches as scripts and notebooks ask about them."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path

from forcetorque import analysis
from forcetorque.analysis import BenchRecording
from forcetorque.created import created_now


def workbench(
    *recordings: BenchRecording | Path | str,
    full_matrix: bool = False,
    only_next: bool = False,
    spec: analysis.AcceptanceFile | None = None,
    seed: int = 0,
) -> analysis.Workbench:
    """Calibrate sensors with known loads, and find faults of the workbench: `workbench("SN170.toml")`.

    Args:
        recordings: What was hung on each sensor, or the file of it.
        full_matrix: Whether loads that do not move all six directions are refused, whatever a prior says.
        only_next: Whether only blocks are checked, and nothing is fitted.
        spec: Limits to judge the calibrations by; none if left out.
        seed: Of the deals into folds.

    Returns:
        Faults, errors and matrices; `save` writes the calibration of a single sensor.
    """
    read = [given if isinstance(given, BenchRecording) else analysis.read_bench(given) for given in recordings]
    created = created_now()
    return analysis.workbench(
        read,
        code_version=version("forcetorque"),
        created=created,
        full_matrix=full_matrix,
        only_next=only_next,
        spec=spec,
        seed=seed,
    )
