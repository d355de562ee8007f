# SPDX-License-Identifier: BSD-3-Clause
"""Where to divide the range of a function that is made of sections."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FitError, SensorError


def knots_for(stimulus: FloatArray, sections: int) -> FloatArray:
    """Divide the range so that each section holds about as many different stimuli.

    Args:
        stimulus: Known stimuli; shape (n,).
        sections: Number of sections.

    Returns:
        Ends of the sections, ascending; shape (sections + 1,).

    Raises:
        FitError: If there are no sections, or fewer different stimuli than ends.
    """
    different = np.unique(stimulus)
    if sections < 1 or len(different) < sections + 1:
        raise FitError(
            f"expected 1 to {len(different) - 1} sections for {len(different)} different stimuli, got {sections}"
        )
    return np.asarray(np.quantile(different, np.linspace(0.0, 1.0, sections + 1)), dtype=np.float64)


def require_knots(knots: FloatArray, values: FloatArray, *, name: str, least: int) -> None:
    """Check the knots of a function that is made of sections.

    Args:
        knots: Stimuli; shape (k,).
        values: Outputs at the knots.
        name: Kind of function, for the message.
        least: Number of knots that it needs.

    Raises:
        SensorError: If the knots are too few, do not ascend, or do not have one finite value each.
    """
    fits = values.shape == knots.shape and len(knots) >= least
    if not fits or not (np.isfinite(values).all() and np.isfinite(knots).all() and (np.diff(knots) > 0.0).all()):
        raise SensorError(
            f"{name}: expected at least {least} ascending knots with one finite value each, "
            f"got {len(knots)} knots and {len(values)} values"
        )
