# SPDX-License-Identifier: BSD-3-Clause
"""Fewer triangles: vertices in one cell of a grid become one, which is crude and enough to recognise a robot."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.viewer.mesh_files import Triangles

MOST_TRIANGLES = 100_000
"""Triangles of a whole robot that are left as they are: 3 MB."""

_FIRST, _GROWTH = 0.8, 1.25
"""First size of a cell, relative to one that gives two triangles for each square of surface, and the factor from one
to the next."""

_SMALLEST_M = 1e-6
"""Smallest first size of a cell, for triangles without area."""
_MOST_NUMBERS = 9e18
"""Largest whole number of 64 bits."""


def simplified(meshes: Sequence[Triangles]) -> tuple[Triangles, ...]:
    """Reduce meshes together, with one size of cell, until they have few enough triangles.

    Args:
        meshes: Meshes in m.

    Returns:
        Meshes in the same order; the same ones where they have few enough.
    """
    cell = max(_FIRST * float(np.sqrt(2.0 * sum(_area(mesh) for mesh in meshes) / MOST_TRIANGLES)), _SMALLEST_M)
    reduced = tuple(meshes)
    while sum(len(mesh.faces) for mesh in reduced) > MOST_TRIANGLES:
        reduced = tuple(clustered(mesh, cell) for mesh in meshes)
        cell *= _GROWTH
    return reduced


def _area(mesh: Triangles) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def clustered(mesh: Triangles, cell: float) -> Triangles:
    """Join the vertices of each cell at their mean, and drop the triangles that thereby vanish.

    Args:
        mesh: The mesh.
        cell: Edge of a cell; m.

    Returns:
        The reduced mesh; no vertex moves by more than the diagonal of a cell.
    """
    cells = np.floor((mesh.vertices - mesh.vertices.min(axis=0)) / cell).astype(np.int64)
    _, joined = np.unique(_numbered(cells), return_inverse=True)
    faces = joined[mesh.faces]
    solid = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces = faces[solid]
    # the two sides of a thin wall fall together
    _, first = np.unique(_numbered(np.sort(faces, axis=1)), return_index=True)
    kept, faces = np.unique(faces[np.sort(first)], return_inverse=True)
    return Triangles(vertices=_means(mesh.vertices, joined)[kept], faces=faces.reshape(-1, 3).astype(np.uint32))


def _numbered(triples: IntArray) -> IntArray:
    """One number for each triple of whole numbers from 0: much faster to sort than rows are."""
    sizes = triples.max(axis=0, initial=0) + 1
    if float(np.prod(sizes.astype(np.float64))) > _MOST_NUMBERS:
        return np.unique(triples, axis=0, return_inverse=True)[1].reshape(-1)
    numbers: IntArray = (triples[:, 0] * sizes[1] + triples[:, 1]) * sizes[2] + triples[:, 2]
    return numbers


def _means(values: FloatArray, group: IntArray) -> FloatArray:
    counts = np.bincount(group)
    sums = np.stack([np.bincount(group, weights=values[:, k]) for k in range(3)], axis=1)
    means: FloatArray = sums / counts[:, None]
    return means
