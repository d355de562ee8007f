# SPDX-License-Identifier: BSD-3-Clause
"""Which taxels feel the same contact."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.skin.surface.surface import SkinSurface

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
