# SPDX-License-Identifier: BSD-3-Clause
"""Contacts drawn at random: what rests where on a skin, from 0.2 to 3 kg."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SkinError
from forcetorque.simulation.skin.contact import ContactTruth, SkinBody, SkinContact
from forcetorque.simulation.skin.objects import ClothStrip, FlatWeight, Palm, SkinObject, Sphere

LIGHTEST_KG: Final = 0.2
HEAVIEST_KG: Final = 3.0
LIGHTEST_CLOTH_KG: Final = 1.0
"""A lighter weight spreads over a strip so thinly that 8 bits hardly feel it."""
ON_SKIN: Final = 0.96
"""Share of the force that skin must feel where contacts off its edge are asked for."""
_BESIDE_TAXEL_M: Final = 0.005
"""How far from a taxel a contact may be placed."""
_MOST_TRIES: Final = 1000


def contacts(
    body: SkinBody, rng: np.random.Generator, number: int, *, on_skin: float = ON_SKIN
) -> Iterator[ContactTruth]:
    """Rest objects on a skin, one after the other; kinds take turns.

    Args:
        body: The skin.
        rng: Source of kinds, masses, sizes and places.
        number: How many.
        on_skin: Least share of the force that skin feels; places where it is less are drawn anew.

    Yields:
        What each does to the skin.

    Raises:
        SkinError: If the skin has no room for an object.
    """
    draws = (_flat_weight, _sphere, _palm, _cloth_strip)
    for turn in range(number):
        thing = draws[turn % len(draws)](body, rng)
        lightest = LIGHTEST_CLOTH_KG if isinstance(thing, ClothStrip) else LIGHTEST_KG
        mass = float(np.exp(rng.uniform(np.log(lightest), np.log(HEAVIEST_KG))))
        for _ in range(_MOST_TRIES):
            truth = body.press(_placed(body, rng, thing, mass))
            if truth.on_skin >= on_skin:
                yield truth
                break
        else:
            raise SkinError(
                f"patch {body.layout.name!r}: expected room for a {thing.kind} of {mass:.2f} kg, got less than "
                f"{on_skin:.0%} of its force on the skin at {_MOST_TRIES} places"
            )


def _placed(body: SkinBody, rng: np.random.Generator, thing: SkinObject, mass_kg: float) -> SkinContact:
    taxels = body.surface.chart(body.layout.positions)
    beside: FloatArray = rng.uniform(-_BESIDE_TAXEL_M, _BESIDE_TAXEL_M, 2)
    place = taxels[rng.integers(len(taxels))] + beside
    # a hand lies around a limb, not along it
    spin = rng.normal(0.0, 0.2) if isinstance(thing, Palm) else rng.uniform(0.0, 2.0 * np.pi)
    return SkinContact(thing=thing, mass_kg=mass_kg, place=place, spin=float(spin))


def _flat_weight(body: SkinBody, rng: np.random.Generator) -> FlatWeight:
    tilt = rng.normal(0.0, 0.02, 2)
    return FlatWeight(radius_m=float(rng.uniform(0.015, 0.035)), tilt=(float(tilt[0]), float(tilt[1])))


def _sphere(body: SkinBody, rng: np.random.Generator) -> Sphere:
    return Sphere(radius_m=float(rng.uniform(0.04, 0.12)))


def _palm(body: SkinBody, rng: np.random.Generator) -> Palm:
    halves = rng.uniform((0.03, 0.025), (0.045, 0.035))
    number = 6
    return Palm(
        half_lengths_m=(float(halves[0]), float(halves[1])),
        bend_per_m=float(rng.uniform(0.7, 0.95)) / body.surface.mean_radius_m,
        bulges=np.column_stack(
            [
                rng.uniform(-halves[0], halves[0], number),
                rng.uniform(-halves[1], halves[1], number),
                rng.uniform(0.0, 0.001, number),
                rng.uniform(0.012, 0.02, number),
            ]
        ),
    )


def _cloth_strip(body: SkinBody, rng: np.random.Generator) -> ClothStrip:
    angle = np.radians(rng.uniform(50.0, 110.0))
    return ClothStrip(
        width_m=float(rng.uniform(0.015, 0.03)), arc_m=float(angle) * body.surface.mean_radius_m, hem_m=0.003
    )
