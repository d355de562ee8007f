# SPDX-License-Identifier: BSD-3-Clause
"""What may be wrong with a layout, one file for each matter."""

from collections.abc import Callable, Iterator

from forcetorque.skin.description import PatchDescription
from forcetorque.skin.findings.finding import Defect, LayoutFinding
from forcetorque.skin.findings.places import duplicates

_LOOKS: tuple[Callable[[PatchDescription], Iterator[LayoutFinding]], ...] = (duplicates,)


def layout_findings(patch: PatchDescription) -> tuple[LayoutFinding, ...]:
    """Look for everything that may be wrong with a layout.

    Args:
        patch: Patch.

    Returns:
        Findings; none where it is sound.
    """
    return tuple(finding for look in _LOOKS for finding in look(patch))


__all__ = ["Defect", "LayoutFinding", "layout_findings"]
