# SPDX-License-Identifier: BSD-3-Clause
"""Known masses that are fastened to a robot, as when a sensor is calibrated with weights."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import read_only
from forcetorque.base.errors import RobotError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.robot.model import RobotModel


def with_load(
    model: RobotModel, link: str, *, mass_kg: float, centre_of_mass_m: Any, second_moment: Any = None
) -> RobotModel:
    """Fasten a known mass to a link.

    Args:
        model: The robot.
        link: Link that carries it.
        mass_kg: Mass; kg.
        centre_of_mass_m: Its centre of mass in the link's frame; shape (3,); m.
        second_moment: Rotational inertia about its centre of mass, in the link's axes; shape (3, 3); kg m2; that of
            a point if None.

    Returns:
        A robot whose link is heavier.

    Raises:
        RobotError: If there is no such link, or the mass is negative or not finite.
    """
    if link not in model.links:
        raise RobotError(f"load: robot {model.name!r} has no link {link!r}; {known_names(link, model.links)}")
    centre = read_only(centre_of_mass_m, name="centre_of_mass_m", shape=(3,))
    if not 0.0 <= mass_kg < np.inf or not np.isfinite(centre).all():
        raise RobotError(f"load on {link!r}: expected a mass of at least 0 kg, got {mass_kg} kg at {centre.tolist()} m")
    load = Inertia.about_centre_of_mass(
        mass=mass_kg,
        centre_of_mass=centre,
        second_moment=np.zeros((3, 3)) if second_moment is None else second_moment,
    )
    return replace(model, links={**model.links, link: model.links[link] + load})
