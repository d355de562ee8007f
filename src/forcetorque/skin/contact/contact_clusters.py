# SPDX-License-Identifier: BSD-3-Clause
"""The contacts of a frame of pressures: clusters of taxels, position, wrench, and maxima of pressure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.skin.contact.pressure_frame import PressureFrame
from forcetorque.skin.surface import SkinSurface
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressure_to_wrench import WrenchMethod, WrenchOperator

FEWEST: Final = 2
"""Active taxels that make a contact: one alone may be noise."""
NO_CONTACT: Final = -1
"""Number of the contact of a taxel that has none."""


def clusters(surface: SkinSurface, active: BoolArray, live: BoolArray) -> IntArray:
    """Number the groups of active taxels that are joined by neighbours, and give each its ring.

    A taxel of the ring between two contacts belongs to the one whose active taxel is nearest. A dead taxel beside
    active ones may well be pressed too, so that it joins them.

    Args:
        surface: Who is whose neighbour.
        active: Live taxels that feel something; shape (n,).
        live: Taxels that can be trusted; shape (n,).

    Returns:
        Contact of each taxel, from 0, and `NO_CONTACT` elsewhere; shape (n,).
    """
    inside = active if live.all() else active | (surface.with_ring(active) & ~live)
    contact = _joined(surface, inside, active)
    _add_ring(surface, inside, contact)
    return contact


def _joined(surface: SkinSurface, inside: BoolArray, active: BoolArray) -> IntArray:
    """Contact of the taxels inside, in groups of neighbours with enough active ones."""
    taxels = np.flatnonzero(inside)
    number = np.full(len(inside), NO_CONTACT)
    number[taxels] = np.arange(len(taxels))
    beside = number[surface.neighbours[taxels].T]  # (d, m): minima over the first axis are quick
    beside = np.where(beside == NO_CONTACT, np.arange(len(taxels)), beside)
    label = np.arange(len(taxels))
    while True:
        # the smallest number around, then that of the taxel which has it: distances double in each turn
        smaller = label[beside].min(axis=0, initial=len(taxels))
        smaller = smaller[smaller]
        if np.array_equal(smaller, label):
            break
        label = smaller
    sizes = np.bincount(label[active[taxels]], minlength=len(taxels))
    kept = np.where(sizes >= FEWEST, np.cumsum(sizes >= FEWEST) - 1, NO_CONTACT)
    contact = np.full(len(inside), NO_CONTACT)
    contact[taxels] = kept[label]
    return contact


def _add_ring(surface: SkinSurface, inside: BoolArray, contact: IntArray) -> None:
    """Give taxels beside a contact its number; `contact` is changed."""
    core = np.flatnonzero(contact != NO_CONTACT)
    beside = surface.neighbours[core]
    own, other = np.nonzero(~inside[beside])
    claimed, claiming = beside[own, other], core[own]
    distance = np.linalg.norm(surface.positions[claimed] - surface.positions[claiming], axis=1)
    # of several that claim a taxel the last one stays: the nearest
    order = np.argsort(-distance, kind="stable")
    contact[claimed[order]] = contact[claiming[order]]


RESIDUAL_SHARE: Final = 0.303
"""Error of the pressure between taxels that one taxel stands for, over what its neighbours did not predict of it."""
SHAPE_SHARE: Final = 0.031
"""Error of a wrench over its size that no taxel shows: edges that are sharper than a pad, the shape of the surface.

Both are the likeliest for 1104 simulated contacts on a lower leg, in range and off its edge, by ideal pads and by a
chain of 8 bits; they were evaluated on others.
"""
_INTERPOLATING: Final = (WrenchMethod.LINEAR, WrenchMethod.KRIGING)
"""Methods whose error between taxels is of that size; the others have one that no contact shows."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinContacts:
    """Contacts of one frame; c of them, on n taxels, in the frame of the link."""

    contact: IntArray
    """Contact of each taxel, its ring included, and -1 where there is none; shape (n,)."""
    active: BoolArray
    """Taxels that feel something; shape (n,)."""
    wrench: FloatArray
    """What each does to the link, about the link's origin; shape (c, 6); N, N m."""
    covariance: FloatArray
    """Covariance of its error; NaN for methods whose error is not known; shape (c, 6, 6)."""
    hysteresis_N: FloatArray
    """How much more the same load reads while it is taken off than while it is put on; shape (c,)."""
    drift_limit_N: FloatArray
    """How much heat through the contact may add, which no thermal pad measures; NaN if not known; shape (c,)."""
    normal_force_N: FloatArray
    """Integral of the pressure, (7.12); shape (c,)."""
    area_m2: FloatArray
    """Area of the active taxels; shape (c,)."""
    centroid: FloatArray
    """Middle of that area; shape (c, 3); m."""
    centre_of_pressure: FloatArray
    """Mean position by pressure; shape (c, 3); m."""
    normal: FloatArray
    """Mean outward unit normal of the area; shape (c, 3)."""
    peak_Pa: FloatArray
    """Largest pressure of a taxel; shape (c,)."""
    edge_share: FloatArray
    """Share of the normal force on taxels at the edge of the patch: beyond them pressure is not felt; shape (c,)."""
    beyond_range: BoolArray
    """Whether a taxel reads more than it was calibrated for; shape (c,)."""
    identity: IntArray
    """Number that each keeps from frame to frame (`ContactLives`), or its index from 1; shape (c,)."""

    def __len__(self) -> int:
        return len(self.wrench)

    @property
    def force_N(self) -> FloatArray:
        """Norm of the force, (7.4); shape (c,)."""
        return np.linalg.norm(self.wrench[:, :3], axis=1)

    @property
    def force_sd_N(self) -> FloatArray:
        """Standard deviation of that norm; shape (c,)."""
        direction = self.wrench[:, :3] / np.maximum(self.force_N, np.finfo(np.float64).tiny)[:, None]
        variance: FloatArray = np.einsum("ci,cij,cj->c", direction, self.covariance[:, :3, :3], direction)
        return np.sqrt(variance)

    def taxels(self, number: int) -> IntArray:
        """Give the active taxels of a contact.

        Args:
            number: Contact, from 0.

        Returns:
            Indices of its taxels in the layout; shape (k,).
        """
        return np.flatnonzero(self.active & (self.contact == number))


def find_contacts(patch: SkinPatch, frame: PressureFrame) -> SkinContacts:
    """Group the taxels that feel something, and give the wrench of each group and of one ring about it.

    Summing the whole patch instead would sum the rounding of hundreds of taxels that feel nothing. Two contacts that
    touch each other are one here; `lobes` shows those that may be two.

    Args:
        patch: The patch.
        frame: What its taxels say.

    Returns:
        The contacts.
    """
    require_shape(frame.pressures, name="frame.pressures", shape=(len(patch.layout),))
    operator = patch.operator(frame.live)
    contact = clusters(patch.surface, frame.active, frame.live)
    groups = _Groups.of(contact, operator)
    area = _areas(patch, groups, frame)
    push = _pushes(patch, groups, frame)
    wrench, normal_force, moment = push[:, :6], push[:, 6], push[:, 8:11]
    divisor = np.where(normal_force > 0.0, normal_force, np.inf)[:, None]
    common = (frame.hysteresis_Pa, frame.drift_Pa)
    lag, drift = (groups.sums(groups.weights[:, :3] * excess[groups.taxels, None]) for excess in common)
    return SkinContacts(
        contact=contact,
        active=frame.active,
        wrench=wrench,
        covariance=_covariance(patch, operator, groups, frame, wrench),
        hysteresis_N=np.linalg.norm(lag, axis=1),
        drift_limit_N=np.linalg.norm(drift, axis=1),
        normal_force_N=normal_force,
        area_m2=area[:, 0],
        centroid=area[:, 1:4],
        centre_of_pressure=np.where(normal_force[:, None] > 0.0, moment / divisor, area[:, 1:4]),
        normal=area[:, 4:7],
        peak_Pa=groups.largest(frame.pressures[groups.taxels]),
        edge_share=push[:, 7] / divisor[:, 0],
        beyond_range=groups.largest(np.where(frame.beyond_range & frame.active, 1.0, 0.0)[groups.taxels]) > 0.0,
        identity=np.arange(1, len(wrench) + 1),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Groups:
    """Taxels by contact."""

    taxels: IntArray
    """Taxels of the first contact, then of the next; shape (t,)."""
    starts: IntArray
    """Where each contact begins among them; shape (c,)."""
    weights: FloatArray
    """Their wrenches by pressure; shape (t, 6); N/Pa, N m/Pa."""
    areas: FloatArray
    """Their areas; shape (t,); m²."""

    @classmethod
    def of(cls, contact: IntArray, operator: WrenchOperator) -> Self:
        taxels = np.flatnonzero(contact != NO_CONTACT)
        taxels = taxels[np.argsort(contact[taxels], kind="stable")]
        return cls(
            taxels=taxels,
            starts=np.flatnonzero(np.diff(contact[taxels], prepend=NO_CONTACT)),
            weights=np.ascontiguousarray(operator.weights[:, taxels].T),
            areas=operator.areas[taxels],
        )

    def sums(self, columns: FloatArray) -> FloatArray:
        """Sums over the taxels of each contact, of rows by taxel; shape (c, k)."""
        if not len(self.starts):
            return np.zeros((0, columns.shape[1]))
        return np.add.reduceat(columns, self.starts, axis=0)

    def largest(self, values: FloatArray) -> FloatArray:
        """Largest value in each contact, of values by taxel; shape (c,)."""
        if not len(self.starts):
            return np.zeros(0)
        return np.maximum.reduceat(values, self.starts)


def _areas(patch: SkinPatch, groups: _Groups, frame: PressureFrame) -> FloatArray:
    """Area, middle and mean unit normal of the active taxels; shape (c, 7)."""
    taxels, layout = groups.taxels, patch.layout
    area = (groups.areas * frame.active[taxels])[:, None]
    sums = groups.sums(np.concatenate([area, area * layout.positions[taxels], area * layout.normals[taxels]], axis=1))
    sums[:, 1:4] /= sums[:, :1]
    sums[:, 4:] /= np.linalg.norm(sums[:, 4:], axis=1, keepdims=True)
    return sums


def _pushes(patch: SkinPatch, groups: _Groups, frame: PressureFrame) -> FloatArray:
    """Wrench, normal force, that of it at the edge, and its first moment; shape (c, 11)."""
    taxels = groups.taxels
    pressure = frame.pressures[taxels, None]
    force = groups.areas[:, None] * pressure
    at_edge, first_moment = force * patch.at_edge[taxels, None], force * patch.layout.positions[taxels]
    return groups.sums(np.concatenate([groups.weights * pressure, force, at_edge, first_moment], axis=1))


def _covariance(
    patch: SkinPatch, operator: WrenchOperator, groups: _Groups, frame: PressureFrame, wrench: FloatArray
) -> FloatArray:
    """Errors of taxels and of what is between them, as if each taxel erred by itself, and of the shape of the skin."""
    if operator.method not in _INTERPOLATING or not len(wrench):
        return np.full((len(wrench), 6, 6), np.nan)
    taxels = groups.taxels
    residual = patch.predicted_pressures(frame.live).residual(frame.pressures, taxels)
    # where neighbours are dead a taxel stands for more skin, and shows each bit of it less well
    between = RESIDUAL_SHARE * residual * groups.areas / patch.operator().areas[taxels]
    scaled = groups.weights * np.sqrt(frame.sd_Pa[taxels] ** 2 + between**2)[:, None]
    squares = np.stack([own.T @ own for own in np.split(scaled, groups.starts[1:])])
    return squares + SHAPE_SHARE**2 * wrench[:, :, None] * wrench[:, None]


_LEVELS: Final = (0.2, 0.35, 0.5, 0.65)
"""Shares of the peak above which hills are looked for; between two objects the pressure falls further than that."""
_SMALLEST: Final = 2
"""Taxels that make a hill."""


def lobes(surface: SkinSurface, contacts: SkinContacts, pressures: FloatArray) -> IntArray:
    """Count the hills of pressure in each contact.

    Args:
        surface: Who is whose neighbour.
        contacts: The contacts.
        pressures: Pressure on each taxel; shape (n,); Pa.

    Returns:
        Hills of each contact; more than one may be as many objects that touch each other; shape (c,).
    """
    most = np.ones(len(contacts), dtype=np.int64)
    if not len(contacts):
        return most
    peaks = np.where(contacts.active, contacts.peak_Pa[contacts.contact], np.inf)
    for level in _LEVELS:
        most = np.maximum(most, _hills(surface, contacts, pressures > level * peaks))
    return most


def _hills(surface: SkinSurface, contacts: SkinContacts, above: BoolArray) -> IntArray:
    """Groups of neighbours above a level, by contact."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = len(surface)
    start, end = surface.edges[above[surface.edges].all(axis=1)].T
    graph = coo_array((np.ones(len(start), dtype=np.int8), (start, end)), shape=(count, count))
    _, group = connected_components(graph, directed=False)
    taxels = np.flatnonzero(above)
    groups, first, size = np.unique(group[taxels], return_index=True, return_counts=True)
    owners = contacts.contact[taxels[first[size >= _SMALLEST]]]
    return np.bincount(owners, minlength=len(contacts))
