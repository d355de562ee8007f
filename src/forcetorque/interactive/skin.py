# SPDX-License-Identifier: BSD-3-Clause
"""Questions about artificial skin, for scripts and notebooks."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path
from typing import Any

from forcetorque import analysis
from forcetorque.analysis import SkinCalibration, SkinWrench, WrenchChoice
from forcetorque.created import created_now
from forcetorque.skin import PatchCalibration
from forcetorque.skin.taxels import CurveKind


def calibrate_skin(
    *experiments: Path | str,
    patch: str | None = None,
    curve: str = CurveKind.MONOTONE,
    highest_pa: float | None = None,
    warm_up: Path | str | None = None,
) -> SkinCalibration:
    """Fit the pressure curve of every taxel of a patch.

    Args:
        experiments: Experiment files with the patch, fitted and kept back.
        patch: Name of the patch; None for the only one.
        curve: Form of curve to keep.
        highest_pa: Highest pressure above rest to fit; Pa; None for all.
        warm_up: Experiment file of a recording without contact while the robot warms up; heat is not told from pressure
            without one.

    Returns:
        The answer, with the curves as its `calibration`.
    """
    created = created_now()
    return analysis.calibrate_skin(
        experiments,
        code_version=version("forcetorque"),
        created=created,
        patch=patch,
        curve=curve,
        highest_pa=highest_pa,
        warm_up=warm_up,
    )


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
