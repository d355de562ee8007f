# SPDX-License-Identifier: BSD-3-Clause
"""Pressure linear between neighbours on the curved surface: plain, without a negative weight, exactly testable."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.skin.surface import SkinSurface
from forcetorque.skin.wrench.elements import POINTS, SkinElements
from forcetorque.skin.wrench.operator import WrenchMethod, WrenchOperator, summed_weights


def linear_operator(surface: SkinSurface, elements: SkinElements, live: BoolArray) -> WrenchOperator:
    """Take the pressure as linear in every piece, and at a dead taxel as the mean of its neighbours.

    Args:
        surface: Who is whose neighbour.
        elements: The pieces.
        live: Taxels that count; shape (n,).

    Returns:
        The operator.
    """
    count = len(surface)
    weights, areas = summed_weights(
        elements.positions.reshape(-1, 3),
        elements.areas.reshape(-1, 3),
        np.repeat(elements.taxels, len(POINTS), axis=0),
        np.tile(POINTS, (len(elements.taxels), 1)),
        count,
    )
    filled = _filled(surface, live)
    return WrenchOperator(method=WrenchMethod.LINEAR, live=live, weights=weights @ filled, areas=areas @ filled)


def _filled(surface: SkinSurface, live: BoolArray) -> FloatArray:
    """Pressures of all taxels by those of the live ones: dead ones are the mean of their neighbours; shape (n, n)."""
    filled = np.diag(live.astype(np.float64))
    dead = np.flatnonzero(~live)
    if not len(dead):
        return filled
    beside = np.zeros((len(surface), len(surface)))
    start, end = surface.edges.T
    beside[start, end] = beside[end, start] = 1.0
    balance = np.diag(beside[dead].sum(axis=1)) - beside[np.ix_(dead, dead)]
    # a dead taxel from which no live one can be reached has no pressure at all
    filled[np.ix_(dead, live)] = np.linalg.lstsq(balance, beside[np.ix_(dead, live)], rcond=None)[0]
    return filled
