# SPDX-License-Identifier: BSD-3-Clause
"""Normals that are no directions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.skin.description import UNIT_DIGITS
from forcetorque.skin.findings.finding import Defect, LayoutFinding, finding_of
from forcetorque.skin.findings.shape import PatchShape

REBUILD = "rebuild the normals from the positions (`rebuild_normals` of `read_layout`)"
"""What to do about wrong normals where positions are right."""


def normal_lengths(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find normals of length 0, and of another one than 1.

    Args:
        shape: Patch.

    Yields:
        A finding for each.
    """
    patch = shape.patch
    if patch.normals is None:
        return
    length = np.linalg.norm(patch.normals, axis=1)
    zero = length == 0.0
    if zero.any():
        yield finding_of(
            patch,
            patch.taxels[zero],
            defect=Defect.ZERO,
            message=f"{np.count_nonzero(zero)} of {len(patch)} normals are 0 0 0",
            remedy=REBUILD,
        )
    other = ~zero & ~np.isclose(length, 1.0, rtol=0.0, atol=UNIT_DIGITS)
    if other.any():
        yield finding_of(
            patch,
            patch.taxels[other],
            defect=Defect.NOT_UNIT,
            message=f"{np.count_nonzero(other)} of {len(patch)} normals have a length of {length[other].min():.3f} to "
            f"{length[other].max():.3f}",
            remedy=f"divide them by their lengths if they are directions, else {REBUILD}",
        )
