# SPDX-License-Identifier: BSD-3-Clause
"""Contacts that may be several: those whose pressure has more than one hill."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.skin.contact.contacts import SkinContacts
from forcetorque.skin.surface import SkinSurface

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
