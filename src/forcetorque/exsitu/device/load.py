# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on the hinge: the carrier and its weights as one rigid body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SensorError
from forcetorque.exsitu.device.description import Device, Part, Weights
from forcetorque.spatial import Inertia


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HungLoad:
    """A load on the hinge, carrier included."""

    name: str
    """What it is called, such as `35 kg`."""
    inertia: Inertia
    """In and about the frame of the carrier: at the hinge, y along its axis, z towards the load."""

    @classmethod
    def point(cls, mass_kg: float, distance_m: float) -> HungLoad:
        """Put all mass in one place straight in front of the hinge.

        Args:
            mass_kg: Mass.
            distance_m: Distance of its centre from the axis of the hinge.

        Returns:
            The load.

        Raises:
            SensorError: If the mass or the distance is not positive.
        """
        if not (0.0 < mass_kg < np.inf and 0.0 < distance_m < np.inf):
            raise SensorError(
                f"load: expected a mass of more than 0 kg in front of the hinge, got {mass_kg:g} kg at {distance_m:g} m"
            )
        inertia = Inertia.about_centre_of_mass(
            mass=mass_kg, centre_of_mass=[0.0, 0.0, distance_m], second_moment=np.zeros((3, 3))
        )
        return cls(name=f"{mass_kg:g} kg at {distance_m:g} m", inertia=inertia)

    @property
    def mass_kg(self) -> float:
        """Mass."""
        return self.inertia.mass

    @property
    def centre_of_mass_m(self) -> FloatArray:
        """Centre of mass in the frame of the carrier; shape (3,)."""
        return self.inertia.first_moment / self.inertia.mass


def device_load(device: Device, load_kg: float) -> HungLoad:
    """Put weights on the carrier.

    Args:
        device: The device.
        load_kg: Load, carrier included, in steps of a plate; 0 is the empty carrier; kg.

    Returns:
        The load.

    Raises:
        SensorError: If there is no such number of plates.
    """
    steps = load_kg / device.weights.step_kg
    if not 0.0 <= load_kg <= device.weights.most_kg + 1e-9 or abs(steps - round(steps)) > 1e-9:
        raise SensorError(
            f"load: device {device.name!r} takes {', '.join(f'{load:g}' for load in device.loads_kg)} kg, carrier "
            f"included and 0 for the empty carrier; got {load_kg:g} kg"
        )
    carrier = part_inertia(device.carrier)
    if round(steps) == 0:
        return HungLoad(name="empty carrier", inertia=carrier)
    return HungLoad(
        name=f"{load_kg:g} kg", inertia=carrier + _plates(device.weights, load_kg, load_kg - device.carrier.mass_kg)
    )


def part_inertia(part: Part) -> Inertia:
    """Give the inertia of a part in and about its frame.

    Args:
        part: The part.

    Returns:
        Its inertia.
    """
    return Inertia.about_centre_of_mass(
        mass=part.mass_kg, centre_of_mass=part.centre_of_mass_m, second_moment=np.diag(part.moments_kgm2)
    )


def _plates(weights: Weights, load_kg: float, mass_kg: float) -> Inertia:
    """A solid cylinder as high as the plates that make up a load."""
    height = weights.height_m * load_kg / weights.step_kg
    across = mass_kg * (3.0 * weights.radius_m**2 + height**2) / 12.0
    along = mass_kg * weights.radius_m**2 / 2.0
    return Inertia.about_centre_of_mass(
        mass=mass_kg,
        centre_of_mass=[0.0, 0.0, weights.foot_m + height / 2.0],
        second_moment=np.diag([across, across, along]),
    )
