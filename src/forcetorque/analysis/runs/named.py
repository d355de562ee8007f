# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations as scripts give them, one or several by name, under their names."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError

Calibrations = Calibration | Mapping[str, Calibration]
"""One calibration, or several by name."""

NEW = "calibration"
"""Name of a calibration that is given without one."""


def named(calibrations: Calibrations | None) -> dict[str, Calibration]:
    """Give calibrations their names.

    Args:
        calibrations: One, several by name, or none.

    Returns:
        Them by name; one alone is called `calibration`.

    Raises:
        ExperimentError: If they are anything else, such as the file of one.
    """
    if calibrations is None:
        return {}
    if isinstance(calibrations, Calibration):
        return {NEW: calibrations}
    if not isinstance(calibrations, Mapping):
        raise ExperimentError(f"calibrations: expected a Calibration, or several by name, {_got(calibrations)}")
    return {name: _calibration(f"calibrations[{name!r}]", given) for name, given in calibrations.items()}


def one_named(calibration: Calibration | None) -> tuple[str | None, Calibration | None]:
    """Give the calibration by which a sensor is read its name.

    Args:
        calibration: The calibration; None for none.

    Returns:
        Its name and the calibration; None twice for none.

    Raises:
        ExperimentError: If it is anything else, such as the file of one.
    """
    return (None, None) if calibration is None else (NEW, _calibration("calibration", calibration))


def _calibration(place: str, given: Any) -> Calibration:
    if not isinstance(given, Calibration):
        raise ExperimentError(f"{place}: expected a Calibration, {_got(given)}")
    return given


def _got(given: Any) -> str:
    if isinstance(given, str | Path):
        return f"got {str(given)!r}; read_calibration({str(given)!r}) reads a file"
    return f"got a {type(given).__name__}"
