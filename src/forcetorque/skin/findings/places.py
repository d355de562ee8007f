# SPDX-License-Identifier: BSD-3-Clause
"""Taxels that lie where another one is."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.skin.description import PatchDescription
from forcetorque.skin.findings.finding import Defect, LayoutFinding, finding_of
from forcetorque.skin.layout import SAME_PLACE_M


def duplicates(patch: PatchDescription) -> Iterator[LayoutFinding]:
    """Find taxels that have the position of another one.

    Args:
        patch: Patch.

    Yields:
        One finding of them all.
    """
    _, place, count = np.unique(
        np.rint(patch.positions / SAME_PLACE_M), axis=0, return_inverse=True, return_counts=True
    )
    shared = count[place.ravel()] > 1
    if shared.any():
        yield finding_of(
            patch,
            shared,
            defect=Defect.DUPLICATE,
            message=f"{np.count_nonzero(shared)} taxels share {np.count_nonzero(count > 1)} places: {len(count)} "
            f"distinct positions of {len(patch)}",
            remedy="place the modules anew by the frames of their centres (`frames` in docs/skin_layout.md)",
        )
