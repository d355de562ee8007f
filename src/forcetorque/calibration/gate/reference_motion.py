# SPDX-License-Identifier: BSD-3-Clause
"""Refusal of a reference that says nothing about a matrix: no load at all, or one that stands still."""

from __future__ import annotations

import numpy as np

from forcetorque.calibration.gate.setup import ROBOT, Setup
from forcetorque.calibration.moments import Moments
from forcetorque.errors import FitError
from forcetorque.spatial import FORCE_AND_MOMENT

NO_LOAD_N = 1e-3
"""Root mean square of the force below which nothing hangs on the sensor, whatever its moment is.

A third of what the finest six-axis sensors resolve, and the weight of 0.1 g; a model without mass gives exactly 0,
though inertia that was left in it gives a moment.
"""

STILL = 1e-3
"""Change of the reference, relative to its size, below which it stands still.

A limb that turns by 0.06 degrees changes its forces by as much; encoders of a limb at rest scatter by less, and
sensors resolve no better than some thousandths of their load.
"""

_LEVER_M = 0.01
"""Least lever by which the size of the moment is judged: where the load hangs below the sensor it has none."""


def require_moving_load(moments: Moments, setup: Setup = ROBOT) -> None:
    """Refuse a reference without load, or one that does not change.

    Args:
        moments: Moments of the fitted samples.
        setup: Where they come from.

    Raises:
        FitError: If it is so; the message names the likely cause and what to change in the experiment file.
    """
    change = np.maximum(np.diag(moments.reference_reference), 0.0)
    size = change + moments.reference_mean**2
    force_change, moment_change = (float(np.sqrt(change[part].sum())) for part in FORCE_AND_MOMENT)
    force, moment = (float(np.sqrt(size[part].sum())) for part in FORCE_AND_MOMENT)
    if force < NO_LOAD_N:
        raise FitError(f"the reference is {force:.2g} N and {moment:.2g} N m, {setup.give_mass}")
    if force_change <= STILL * force and moment_change <= STILL * max(moment, _LEVER_M * force):
        raise FitError(
            f"the reference stays within {force_change:.2g} N of {force:.3g} N and {moment_change:.2g} N m of "
            f"{moment:.3g} N m over all fitted samples, "
            f"{setup.move_load}"
        )
