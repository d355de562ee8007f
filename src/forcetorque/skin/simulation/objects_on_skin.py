# SPDX-License-Identifier: BSD-3-Clause
"""Objects of given mass on a soft skin, their pressure and wrench, and contacts drawn at random.

Rigid objects are given by the height of their lower side above its lowest point, over a plane through it; a strip of
cloth has no shape of its own and presses by its tension alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar, Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.base.pose import cross
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.true_surface import SurfacePoints, TrueSurface

SKIN_STIFFNESS_PA_PER_M: Final = 2e7
"""Pressure of the skin's soft layer by how far it is pressed in: about 40 kPa at 2 mm."""
HAND_STIFFNESS_PA_PER_M: Final = 3e6
"""The same under a hand, which gives way more than the skin does."""
_WIDEST_CAP_M: Final = 0.05
"""How far from its lowest point a ball may touch a soft skin."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatWeight:
    """A cylinder that stands on its flat side."""

    kind: ClassVar[str] = "flat weight"
    stiffness: ClassVar[float] = SKIN_STIFFNESS_PA_PER_M
    radius_m: float
    """Radius."""
    tilt: tuple[float, float]
    """Slope of its lower side along and across."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return 1.5 * self.radius_m

    def height(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Height of the lower side; infinite beside it; m."""
        inside = np.hypot(along, across) <= self.radius_m
        return np.where(inside, self.tilt[0] * along + self.tilt[1] * across, np.inf)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sphere:
    """A ball."""

    kind: ClassVar[str] = "sphere"
    stiffness: ClassVar[float] = SKIN_STIFFNESS_PA_PER_M
    radius_m: float
    """Radius."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return 1.5 * min(self.radius_m, _WIDEST_CAP_M)

    def height(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Height of the lower side; infinite beside it; m."""
        inside = self.radius_m**2 - along**2 - across**2
        return np.where(inside > 0.0, self.radius_m - np.sqrt(np.maximum(inside, 0.0)), np.inf)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Palm:
    """A hand that is laid on: it follows most of the limb's bend, and bulges where it has muscles."""

    kind: ClassVar[str] = "palm"
    stiffness: ClassVar[float] = HAND_STIFFNESS_PA_PER_M
    half_lengths_m: tuple[float, float]
    """Half its extent along and across the limb."""
    bend_per_m: float
    """Curvature across, by which it follows the limb; its sides hang down."""
    bulges: FloatArray
    """Place along, place across, depth and width of each bulge; shape (k, 4); m."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return 1.5 * max(self.half_lengths_m)

    def height(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Height of the lower side; infinite beside it; m."""
        inside = np.hypot(along / self.half_lengths_m[0], across / self.half_lengths_m[1]) <= 1.0
        height = -0.5 * self.bend_per_m * across**2
        for place_along, place_across, depth, width in self.bulges:
            distance = np.hypot(along - place_along, across - place_across)
            height = height - depth * np.exp(-0.5 * (distance / width) ** 2)
        return np.where(inside, height, np.inf)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClothStrip:
    """A strip around part of the limb, from which a weight hangs: even pressure, which falls off at its sides."""

    kind: ClassVar[str] = "cloth strip"
    width_m: float
    """Width along the limb."""
    arc_m: float
    """Length around the limb that touches it."""
    hem_m: float
    """Distance over which the pressure falls off."""

    @property
    def reach_m(self) -> float:
        """Distance from where it touches beyond which it does not."""
        return max(self.width_m, self.arc_m) / 2.0 + self.hem_m

    def pressure(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Pressure over its pressure inside, by distances along the limb and around it."""
        sides = (self.width_m / 2.0 - np.abs(along), self.arc_m / 2.0 - np.abs(across))
        return np.prod([np.clip(0.5 + side / self.hem_m, 0.0, 1.0) for side in sides], axis=0)


RigidObject = FlatWeight | Sphere | Palm
"""What has a lower side of its own."""
SkinObject = RigidObject | ClothStrip
"""Anything that rests on skin."""


GRID_M: Final = 0.0005
"""Distance of the points that the truth is summed over; between taxels there are thirteen of them."""
PAD_RADIUS_M: Final = 0.0022
"""Radius of the pad over which a taxel takes the mean pressure."""
_ON_SKIN_M: Final = 0.0055
"""Distance to a taxel within which a point is skin: half of the diagonal between taxels of neighbouring modules."""
_DEEPEST_M: Final = 0.02
"""How far an object may press in."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinContact:
    """An object on the skin."""

    thing: SkinObject
    """What it is."""
    mass_kg: float
    """Its mass; it presses along the normal where it touches."""
    place: FloatArray
    """Where it touches, on the chart of the surface; shape (2,); m."""
    spin: float
    """How it is turned about that normal, right-handed, from along the axis of the surface; rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactTruth:
    """What an object does to the skin."""

    contact: SkinContact
    """The object."""
    wrench: FloatArray
    """Wrench on the link about its origin; shape (6,); N, N m."""
    normal_force_N: float
    """Integral of the pressure, (7.12)."""
    centre: FloatArray
    """Centre of pressure; shape (3,); m."""
    peak_Pa: float
    """Largest pressure."""
    on_skin: float
    """Share of the normal force that skin feels."""
    pressures: FloatArray
    """Mean pressure on the pad of each taxel; shape (n,); Pa."""

    @property
    def load_N(self) -> float:
        """Weight of the object."""
        return self.contact.mass_kg * STANDARD_GRAVITY


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinGrid:
    """Points on a surface over which pressures are summed."""

    places: FloatArray
    """Coordinates on the chart; shape (a, b, 2); m."""
    points: SurfacePoints
    """The points."""
    is_skin: FloatArray
    """1 where skin is, else 0; shape (a, b)."""

    @property
    def areas(self) -> FloatArray:
        """Area that each point stands for; shape (a, b); m²."""
        return self.points.stretch * GRID_M**2

    def around(self, place: FloatArray, reach_m: float) -> SkinGrid:
        """Give the part of the grid about a place, in views.

        Args:
            place: Place on the chart; shape (2,); m.
            reach_m: Half the side of a square; m.

        Returns:
            The grid inside the square.
        """
        start = np.rint((place - self.places[0, 0]) / GRID_M).astype(int)
        steps = int(np.ceil(reach_m / GRID_M))
        index = tuple(slice(max(0, first - steps), max(0, first + steps + 1)) for first in start)
        return SkinGrid(places=self.places[index], points=self.points[index], is_skin=self.is_skin[index])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinBody:
    """A patch of skin on its true surface, with the grid and the pads on which pressures are summed."""

    layout: SkinLayout
    """The patch, as its user knows it."""
    surface: TrueSurface
    """Where the skin truly is."""
    grid: SkinGrid
    """Grid over the skin and its surroundings."""
    pad_places: FloatArray
    """Points of the pads on the chart; shape (n, q, 2); m."""
    pads: SurfacePoints
    """The points."""

    @classmethod
    def of(cls, layout: SkinLayout) -> Self:
        """Lay a patch on a smooth surface.

        Args:
            layout: The patch.

        Returns:
            The patch and its surface.
        """
        surface = TrueSurface.through(layout)
        centres = surface.chart(layout.positions)
        pads = centres[:, None, :] + _disc(PAD_RADIUS_M)
        return cls(
            layout=layout,
            surface=surface,
            grid=_grid(surface, centres),
            pad_places=pads,
            pads=surface.at(pads),
        )

    def press(self, contact: SkinContact) -> ContactTruth:
        """Rest an object on the skin.

        Args:
            contact: The object and where it touches.

        Returns:
            Wrench, centre and what each taxel feels.
        """
        grid = self.grid.around(contact.place, contact.thing.reach_m)
        pressure = _pressure(self.surface, grid, contact)
        on_grid = pressure(grid.places, grid.points)
        force = on_grid * grid.areas
        normal_force = float(force.sum())
        pushes = -force[..., None] * grid.points.normals
        moments = cross(grid.points.positions, pushes)
        return ContactTruth(
            contact=contact,
            wrench=np.concatenate([pushes.sum(axis=(0, 1)), moments.sum(axis=(0, 1))]),
            normal_force_N=normal_force,
            centre=np.einsum("ab,abi->i", force, grid.points.positions) / normal_force,
            peak_Pa=float(on_grid.max()),
            on_skin=float((force * grid.is_skin).sum()) / normal_force,
            pressures=pressure(self.pad_places, self.pads).mean(axis=1),
        )


def _grid(surface: TrueSurface, taxels: FloatArray) -> SkinGrid:
    from scipy.spatial import KDTree

    axes = (np.arange(a, b, GRID_M) for a, b in zip(surface.low, surface.high, strict=True))
    places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    points = surface.at(places)
    distance, _ = KDTree(surface.at(taxels).positions).query(points.positions)
    return SkinGrid(places=places, points=points, is_skin=np.where(distance <= _ON_SKIN_M, 1.0, 0.0))


_Pressure = Callable[[FloatArray, SurfacePoints], FloatArray]


def _pressure(surface: TrueSurface, grid: SkinGrid, contact: SkinContact) -> _Pressure:
    """Pressure at points of the surface, such that the object's weight is carried."""
    body = contact.thing
    carried = grid.areas * (grid.points.normals @ surface.at(contact.place).normals)
    weight = contact.mass_kg * STANDARD_GRAVITY
    if isinstance(body, ClothStrip):
        cloth = _cloth(contact, body)
        tension = weight / float((cloth(grid.places, grid.points) * carried).sum())
        return lambda places, points: tension * cloth(places, points)
    above = _rigid(surface, contact, body)
    depth = _depth(above(grid.places, grid.points), carried, weight / body.stiffness)
    return lambda places, points: body.stiffness * np.maximum(above(places, points) + depth, 0.0)


def _cloth(contact: SkinContact, strip: ClothStrip) -> _Pressure:
    def shape(places: FloatArray, points: SurfacePoints) -> FloatArray:
        offset = places - contact.place
        return strip.pressure(offset[..., 1], offset[..., 0])

    return shape


def _rigid(surface: TrueSurface, contact: SkinContact, body: RigidObject) -> _Pressure:
    """How far the skin stands above the object's lower side, when its lowest point touches at the contact's place."""
    touch = surface.at(contact.place)
    axis = surface.link_R_axis[:, 2]
    across = cross(touch.normals, axis)
    across /= np.linalg.norm(across)
    along = cross(across, touch.normals)
    cosine, sine = np.cos(contact.spin), np.sin(contact.spin)

    def shape(places: FloatArray, points: SurfacePoints) -> FloatArray:
        offset = points.positions - touch.positions
        a, b = offset @ along, offset @ across
        above: FloatArray = offset @ touch.normals
        # the far side of the limb lies below the object too, but nothing touches it
        facing = points.normals @ touch.normals > 0.0
        return np.where(facing, above, -np.inf) - body.height(cosine * a + sine * b, cosine * b - sine * a)

    return shape


def _depth(above: FloatArray, carried: FloatArray, volume: float) -> float:
    """How far an object sinks in until it displaces a volume, given in m³ as weight over stiffness; m."""
    from scipy.optimize import brentq

    highest = float(above.max())
    near = above > highest - _DEEPEST_M
    close, area = above[near] - highest, carried[near]

    def missing(depth: float) -> float:
        return float(np.maximum(close + depth, 0.0) @ area) - volume

    if missing(_DEEPEST_M) < 0.0:
        raise SkinError(
            f"contact: expected a skin that carries the weight within {1e3 * _DEEPEST_M:g} mm, got one that does not; "
            "the object touches too little of it"
        )
    return float(brentq(missing, 0.0, _DEEPEST_M, xtol=1e-9)) - highest


def _disc(radius_m: float) -> FloatArray:
    """Points that cover a disc evenly: a centre and two rings, each for the same area; shape (19, 2); m."""
    rings = [(0.0, 1), (radius_m * np.sqrt(4.0 / 19.0), 6), (radius_m * np.sqrt(13.0 / 19.0), 12)]
    points = [
        (ring * np.cos(angle), ring * np.sin(angle))
        for ring, number in rings
        for angle in 2.0 * np.pi * (np.arange(number) + 0.5) / number
    ]
    return np.array(points)


LIGHTEST_KG: Final = 0.2
HEAVIEST_KG: Final = 3.0
LIGHTEST_CLOTH_KG: Final = 1.0
"""A lighter weight spreads over a strip so thinly that 8 bits hardly feel it."""
ON_SKIN: Final = 0.96
"""Share of the force that skin must feel where contacts off its edge are requested."""
_BESIDE_TAXEL_M: Final = 0.005
"""How far from a taxel a contact may be placed."""
_MOST_TRIES: Final = 1000


def contacts(
    body: SkinBody, rng: np.random.Generator, number: int, *, on_skin: float = ON_SKIN
) -> Iterator[ContactTruth]:
    """Rest objects on a skin, one after the other; kinds take turns.

    Masses are drawn evenly in their logarithm, from 0.2, of cloth from 1, to 3 kg. Weights have radii of 15 to 35 mm
    and slopes of 0.02, balls radii of 40 to 120 mm. Palms are 60 to 90 by 50 to 70 mm, follow 70 to 95 % of the mean
    bend, and have six bulges of up to 1 mm, 12 to 20 mm wide. Cloth is 15 to 30 mm wide and covers 50 to 110 degrees.

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
