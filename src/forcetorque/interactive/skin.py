# SPDX-License-Identifier: BSD-3-Clause
"""Questions about artificial skin, for scripts and notebooks."""

from __future__ import annotations

from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

from forcetorque import analysis
from forcetorque.analysis import SkinCalibration, SkinWrench, WrenchChoice
from forcetorque.skin import PatchCalibration


def calibrate_skin(*experiments: Path | str, **options: Any) -> SkinCalibration:
    """Fit the pressure curve of every taxel of a patch.

    Args:
        experiments: Experiment files with the patch, fitted and kept back.
        options: As of `forcetorque.analysis.calibrate_skin`: patch, curve, highest_pa.

    Returns:
        The answer, with the curves as its `calibration`.
    """
    created = datetime.now(UTC).isoformat(timespec="seconds")
    return analysis.calibrate_skin(experiments, code_version=version("forcetorque"), created=created, **options)


def skin_wrench(
    experiment: Path | str, calibration: Path | str | PatchCalibration, *, patch: str | None = None, **choice: Any
) -> SkinWrench:
    """Find the contacts on a patch in a recording, and their wrenches on the link.

    Args:
        experiment: Experiment file with the patch.
        calibration: Calibration of its taxels, or its file.
        patch: Name of the patch; None for the only one.
        choice: As of `forcetorque.analysis.WrenchChoice`: method, taxel_area_mm2, plan, rest_s, averaged and others.

    Returns:
        Every contact of every frame.
    """
    return analysis.skin_wrench(experiment, calibration, patch=patch, choice=WrenchChoice(**choice))
