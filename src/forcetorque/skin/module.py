# SPDX-License-Identifier: BSD-3-Clause
"""The triangular module that patches are made of: ten pressure taxels and two thermal pads on one flexible board.

Taxel 3 is its centre; x and y lie in the board, z points out of the link. The ten taxels are a triangular grid of
6.533 mm, rows of four, three, two and one.
"""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only, read_only_integers
from forcetorque.spatial import split_pose

MODULE_COLUMNS = 12
"""Numbers of a module in a message of counts: ten taxels and two thermal pads."""
MODULE_CENTRE = 3
"""Taxel at the centre of a module."""
MODULE_SIDE_M = 0.030
"""Side of the triangular board; m. Neighbours are farther apart where they need room."""
MODULE_THERMAL: IntArray = read_only_integers([6, 10], name="MODULE_THERMAL", shape=(2,))
"""Columns of a module that are thermal pads; shape (2,)."""
MODULE_TAXELS: IntArray = read_only_integers([0, 1, 2, 3, 4, 5, 7, 8, 9, 11], name="MODULE_TAXELS", shape=(10,))
"""Columns of a module that are taxels; shape (10,)."""

_MM = [
    (6.533, 0.0),
    (9.8, -5.66),
    (3.267, -5.66),
    (0.0, 0.0),
    (-3.267, -5.66),
    (-9.8, -5.66),
    (-6.533, -3.75),
    (-6.533, 0.0),
    (-3.267, 5.66),
    (0.0, 11.317),
    (0.0, 7.507),
    (3.267, 5.66),
]
MODULE_PADS: FloatArray = read_only(
    1e-3 * np.column_stack([np.array(_MM), np.zeros(MODULE_COLUMNS)]), name="MODULE_PADS", shape=(MODULE_COLUMNS, 3)
)
"""Centres of all pads in the module's frame, by column; shape (12, 3); m."""


def placed_pads(a_H_module: FloatArray, *, mirrored: bool = False) -> FloatArray:
    """Put the pads of a module where it is.

    Args:
        a_H_module: Pose of the module in a frame; shape (4, 4); m.
        mirrored: Whether its board is the mirror image, as boards of the other side of a robot may be: x is reversed.

    Returns:
        Centres of its pads in that frame, by column; shape (12, 3); m.
    """
    rotation, centre = split_pose(a_H_module)
    pads = MODULE_PADS * [-1.0, 1.0, 1.0] if mirrored else MODULE_PADS
    return pads @ rotation.T + centre
