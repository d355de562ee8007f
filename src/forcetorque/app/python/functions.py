# SPDX-License-Identifier: BSD-3-Clause
"""Analyses of arrays, for scripts and notebooks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from forcetorque.locomotion.movement import BAND_SHARE, Motion


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
    from forcetorque.locomotion.logged_signals import motion_signals_of_arrays
    from forcetorque.locomotion.movement import motion

    signals = motion_signals_of_arrays(time_s, columns, units, desired=desired)
    return motion(signals, steps_s=steps_s, band_share=band_share)
