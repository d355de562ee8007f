# SPDX-License-Identifier: BSD-3-Clause
"""Which side of a triangulated surface is the outer one."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import SkinError

_FLAT: Final = 0.02
"""Mean outward cosine below which a surface does not tell by its shape which side is out."""


def outward_triangles(positions: FloatArray, triangles: IntArray, outward: FloatArray | None) -> IntArray:
    """Turn triangles so that their corners run counterclockwise where they are seen from outside.

    Neighbours are turned alike; which way, every connected piece is told by rough directions, or by its shape: a piece
    of skin bulges outwards.

    Args:
        positions: Points; shape (n, 3); m.
        triangles: Triangles, of which at most two share an edge; shape (m, 3).
        outward: Rough outward direction at every point, of which only the mean matters; shape (n, 3); None to go by
            the shape.

    Returns:
        The triangles, turned; shape (m, 3).

    Raises:
        SkinError: If the surface has only one side, or neither directions nor shape tell which one is outer.
    """
    turned, pieces = _turned_alike(triangles)
    corners = positions[turned]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])  # (m, 3), twice the area
    if outward is None:
        directions = corners.mean(axis=1) - positions[np.unique(turned)].mean(axis=0)
    else:
        directions = outward[turned].mean(axis=1)
    agreement = (normals * directions).sum(axis=1)
    full = np.linalg.norm(normals, axis=1) * np.linalg.norm(directions, axis=1)
    for piece in range(int(pieces.max(initial=-1)) + 1):
        own = pieces == piece
        cosine = agreement[own].sum() / full[own].sum() if full[own].any() else 0.0
        if not abs(cosine) > _FLAT:
            raise SkinError(
                f"outward: expected directions that tell the outer side of the skin about taxel {turned[own][0, 0]}, "
                f"got a mean cosine of {cosine:.3f}; state rough outward directions of the taxels"
            )
        if cosine < 0.0:
            turned[own] = turned[own][:, ::-1]
    return turned


def _turned_alike(triangles: IntArray) -> tuple[IntArray, IntArray]:
    """Triangles turned like their neighbours, and the connected piece of each."""
    beside = _sharing(triangles)
    turned = triangles.copy()
    pieces = np.full(len(triangles), -1)
    for seed in range(len(triangles)):
        if pieces[seed] >= 0:
            continue
        pieces[seed] = pieces.max() + 1
        open_ended = [seed]
        while open_ended:
            one = open_ended.pop()
            for other in beside[one]:
                runs_alike = not _runs_against(turned[one], turned[other])
                if pieces[other] < 0:
                    pieces[other] = pieces[seed]
                    turned[other] = turned[other][::-1] if runs_alike else turned[other]
                    open_ended.append(other)
                elif runs_alike:
                    raise SkinError(
                        f"positions: expected a skin with two sides, got one whose sides meet at taxels {turned[one]}; "
                        "look at the layout with `forcetorque skin check`"
                    )
    return turned, pieces


def _sharing(triangles: IntArray) -> list[list[int]]:
    """Triangles that share an edge with each."""
    owners: dict[tuple[int, int], list[int]] = {}
    for number, corners in enumerate(triangles.tolist()):
        for k in range(3):
            owners.setdefault((min(corners[k - 1], corners[k]), max(corners[k - 1], corners[k])), []).append(number)
    beside: list[list[int]] = [[] for _ in range(len(triangles))]
    for pair in owners.values():
        if len(pair) == 2:
            beside[pair[0]].append(pair[1])
            beside[pair[1]].append(pair[0])
    return beside


def _runs_against(one: IntArray, other: IntArray) -> bool:
    """Whether two triangles run along the edge that they share in opposite directions."""
    forward = {(one[k - 1], one[k]) for k in range(3)}
    return any((other[k], other[k - 1]) in forward for k in range(3))
