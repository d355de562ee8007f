# SPDX-License-Identifier: BSD-3-Clause
"""What the recordings taught of every load direction, in numbers and words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import numpy as np

from forcetorque.calibration import Calibration
from forcetorque.result import Row, Shown
from forcetorque.spatial import FORCE_AND_MOMENT, WRENCH_COMPONENTS

LITTLE_LEARNT = 0.5
"""Share below which more should be recorded along a direction."""


class LearntDirection(Row):
    """One load direction: what a push along it would read wrong, before the recordings and after."""

    direction: Annotated[str, Shown("load")]
    """Component of the load: fx to tz in the sensor's frame."""
    force_error_before_N: Annotated[float, Shown("force before", "N/unit", digits=4)]
    """Predicted standard deviation of the force error that one newton, or newton metre, makes with the prior."""
    force_error_after_N: Annotated[float, Shown("after", "N/unit", digits=4)]
    """The same with the calibration."""
    moment_error_before_Nm: Annotated[float, Shown("moment before", "N m/unit", digits=5)]
    """Predicted standard deviation of the moment error that one newton, or newton metre, makes with the prior."""
    moment_error_after_Nm: Annotated[float, Shown("after", "N m/unit", digits=5)]
    """The same with the calibration."""
    learnt: Annotated[float, Shown("narrower by", digits=2)]
    """One less the uncertainty after over that before: 0 where the recordings said nothing, 1 where they said all."""


def learnt_directions(calibration: Calibration) -> tuple[LearntDirection, ...] | None:
    """Tell what the recordings taught of every load direction.

    Args:
        calibration: The calibration.

    Returns:
        One row per component of the load; None for a type of the thesis, or without a prior.
    """
    posterior = calibration.posterior
    shares = None if posterior is None else posterior.learnt_shares()
    before = None if posterior is None else posterior.prior_error_covariance(np.eye(6))
    if posterior is None or shares is None or before is None:
        return None
    after = posterior.error_covariance(np.eye(6))
    sizes = [
        [np.sqrt(np.trace(covariance[k][part, part])) for part in FORCE_AND_MOMENT]
        for covariance in (before, after)
        for k in range(6)
    ]
    return tuple(
        LearntDirection(
            direction=name,
            force_error_before_N=sizes[k][0],
            force_error_after_N=sizes[6 + k][0],
            moment_error_before_Nm=sizes[k][1],
            moment_error_after_Nm=sizes[6 + k][1],
            learnt=float(shares[k]),
        )
        for k, name in enumerate(WRENCH_COMPONENTS)
    )


def learnt_words(directions: Sequence[LearntDirection]) -> str:
    """Say what was learnt, and what to record for the rest.

    Args:
        directions: What the recordings taught.

    Returns:
        Words such as `fz 97 %, tz 4 %: add a load off the axis`.
    """
    shares = ", ".join(f"{row.direction} {100.0 * row.learnt:.0f} %" for row in directions)
    little = [row.direction for row in directions if row.learnt < LITTLE_LEARNT]
    if not little:
        return f"learnt: {shares}"
    return f"learnt: {shares}; for {', '.join(little)} the prior decides: {to_learn(directions)}"


def to_learn(directions: Sequence[LearntDirection]) -> str | None:
    """Say what to record for the directions of which little was learnt.

    Args:
        directions: What the recordings taught.

    Returns:
        Words such as `add a load off the axis`; None where enough is known of all.
    """
    little = [row.direction for row in directions if row.learnt < LITTLE_LEARNT]
    advice = []
    if any(name.startswith("t") for name in little):
        advice.append("add a load off the axis, or another tool or posture with its centre of mass elsewhere")
    if any(name.startswith("f") for name in little):
        advice.append("turn the sensor so that the weight acts along it, or add weight")
    return "; ".join(advice) or None
