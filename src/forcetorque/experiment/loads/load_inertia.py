# SPDX-License-Identifier: BSD-3-Clause
"""The inertia that a model takes for a load: as it was stated, or as readings told it."""

from __future__ import annotations

import numpy as np

from forcetorque.errors import ExperimentError
from forcetorque.loads import Load, LoadEstimate, LoadSolution
from forcetorque.spatial import Inertia


def inertia_of_stated(load: Load) -> Inertia:
    """Give the inertia of a load of which nothing is to be estimated.

    Args:
        load: The load.

    Returns:
        Its inertia in its own frame; zero where nothing hangs, or something of it is to be estimated.
    """
    if not load.mass or isinstance(load.inertia, str):
        return Inertia.zero()
    return Inertia.about_centre_of_mass(
        mass=load.mass,
        centre_of_mass=np.zeros(3) if load.centre_of_mass is None else load.centre_of_mass,
        second_moment=np.zeros((3, 3)) if load.inertia is None else load.inertia,
    )


def inertia_of_estimated(solution: LoadSolution, estimate: LoadEstimate) -> Inertia:
    """Give the inertia of a load that readings told.

    Args:
        solution: What they told, with what they leave open.
        estimate: The load.

    Returns:
        Its inertia in its own frame.

    Raises:
        ExperimentError: If they leave it open, or fit a negative mass.
    """
    if not estimate.is_determined:
        words = "; ".join(entry.words for entry in solution.open_directions) or "no calibration interval has it"
        raise ExperimentError(
            f"load {estimate.name!r}: the calibration intervals do not determine it: {words}; `forcetorque payload` "
            "says what they do determine, and mass_kg with centre_of_mass_m state the load"
        )
    if not estimate.mass >= 0.0:
        words = "; ".join(entry.words for entry in solution.hypotheses) or "see `forcetorque payload`"
        raise ExperimentError(
            f"load {estimate.name!r}: the readings fit a mass of {estimate.mass:.3g} kg, beside the links of the URDF "
            f"where there is one; expected a positive one: {words}"
        )
    return estimate.as_inertia()
