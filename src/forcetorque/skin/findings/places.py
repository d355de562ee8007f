# SPDX-License-Identifier: BSD-3-Clause
"""Taxels that lie where another one is."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.skin.findings.finding import Defect, LayoutFinding, counted, finding_of
from forcetorque.skin.findings.shape import PatchShape


def duplicates(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find taxels that have the position of another one.

    Args:
        shape: Patch.

    Yields:
        One finding of them all.
    """
    patch, count = shape.patch, np.bincount(shape.place)
    shared = count[shape.place] > 1
    if shared.any():
        places = counted(int(np.count_nonzero(count > 1)), "place")
        yield finding_of(
            patch,
            patch.taxels[shared],
            defect=Defect.DUPLICATE,
            message=f"{np.count_nonzero(shared)} taxels share {places}: {len(count)} distinct places of {len(patch)}",
            remedy="place their modules anew, from the frames of the modules' centres",
        )
