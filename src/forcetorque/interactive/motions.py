# SPDX-License-Identifier: BSD-3-Clause
"""Measures of motion, for scripts and notebooks."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from forcetorque import analysis
from forcetorque.analysis import Motion
from forcetorque.analysis.motion.motion import BAND_SHARE
from forcetorque.calibration import Calibration


def motion(
    log: Path | str,
    columns: Sequence[str],
    *,
    steps_s: Sequence[float] = (),
    band_share: float = BAND_SHARE,
    desired: Sequence[str] = (),
    intervals: Collection[str] = (),
    calibrations: Mapping[str, Calibration] | None = None,
) -> Motion:
    """Say how columns of a log move.

    Args:
        log: Experiment file, with or without sensors, or a log.
        columns: Columns of the log, or of `balance`.
        steps_s: Instants of steps; those of what was wanted if none is named; s.
        band_share: Half of the band of settling over the step.
        desired: Columns of the log with what was wanted, one for each of the first; none if nothing was.
        intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.
        calibrations: Calibrations that read the sensors for columns of `balance`, by name.

    Returns:
        Oscillations, settling times and tracking errors.
    """
    signals = analysis.motion_signals(log, columns, desired=desired, intervals=intervals, calibrations=calibrations)
    return analysis.motion(signals, steps_s=steps_s, band_share=band_share)


def motion_of_arrays(
    time_s: Any,
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    *,
    desired: Mapping[str, Any] | None = None,
    steps_s: Sequence[float] = (),
    band_share: float = BAND_SHARE,
) -> Motion:
    """Say how arrays move, such as columns of a data frame or of a simulation.

    Args:
        time_s: Instants; shape (n,); s.
        columns: Samples by name; shape (n,) each.
        units: Unit of each.
        desired: What was wanted of some of them, by their names; shape (n,) each.
        steps_s: Instants of steps; those of what was wanted if none is named; s.
        band_share: Half of the band of settling over the step.

    Returns:
        Oscillations, settling times and tracking errors.
    """
    signals = analysis.motion_signals_of_arrays(time_s, columns, units, desired=desired)
    return analysis.motion(signals, steps_s=steps_s, band_share=band_share)
