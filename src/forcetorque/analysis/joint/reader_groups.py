# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations that read the sensors of a robot together, side by side with others that do."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from forcetorque.analysis.joint.data import JOINT_FILE
from forcetorque.calibration import Calibration, read_calibration
from forcetorque.errors import MissingFileError

FILES = "calibrations"
"""What the calibrations are called together that are given as files, where there are several."""


def read_candidates(paths: Iterable[Path]) -> dict[str, Mapping[str, Calibration]]:
    """Read calibrations of the sensors of a robot: all files are one candidate, every folder is one of its own.

    Args:
        paths: Calibration files, and folders of them such as `calibrate --jointly` writes.

    Returns:
        By name of the candidate its calibrations by name of their file.

    Raises:
        MissingFileError: If a folder holds no calibration.
        FormatError: If a file is none.
    """
    candidates: dict[str, Mapping[str, Calibration]] = {}
    single: dict[str, Calibration] = {}
    for path in paths:
        if not path.is_dir():
            single[str(path)] = read_calibration(path)
            continue
        files = sorted(file for file in path.glob("*.json") if file.name != JOINT_FILE)
        if not files:
            raise MissingFileError(f"{path}: expected a folder of calibrations, .json; it holds none")
        candidates[str(path)] = {str(file): read_calibration(file) for file in files}
    if single:
        return {next(iter(single)) if len(single) == 1 else FILES: single, **candidates}
    return candidates
