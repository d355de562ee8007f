# SPDX-License-Identifier: BSD-3-Clause
"""What may be wrong with a layout, one file for each matter."""

from collections.abc import Callable, Iterator

from forcetorque.skin.layout.findings.finding import Defect, LayoutFinding, counted
from forcetorque.skin.layout.findings.gaps import gaps
from forcetorque.skin.layout.findings.modules import NEAREST_CENTRES_M, off_template, overlaps
from forcetorque.skin.layout.findings.normals import FACETED_DEG, OBLIQUE_DEG, normal_directions, normal_lengths
from forcetorque.skin.layout.findings.positions import duplicates, representatives
from forcetorque.skin.layout.findings.shape import PatchShape, shape_of
from forcetorque.skin.layout.layout import PatchDescription

_LOOKS: tuple[Callable[[PatchShape], Iterator[LayoutFinding]], ...] = (
    representatives,
    duplicates,
    off_template,
    overlaps,
    normal_lengths,
    normal_directions,
    gaps,
)


def layout_findings(patch: PatchDescription) -> tuple[LayoutFinding, ...]:
    """Look for everything that may be wrong with a layout.

    Args:
        patch: Patch.

    Returns:
        Findings; none where it is sound.
    """
    return shape_findings(shape_of(patch))


def shape_findings(shape: PatchShape) -> tuple[LayoutFinding, ...]:
    """Look for everything that may be wrong with a layout whose shape is known.

    Args:
        shape: Patch.

    Returns:
        Findings; none where it is sound.
    """
    return tuple(finding for look in _LOOKS for finding in look(shape))


__all__ = [
    "FACETED_DEG",
    "NEAREST_CENTRES_M",
    "OBLIQUE_DEG",
    "Defect",
    "LayoutFinding",
    "PatchShape",
    "counted",
    "layout_findings",
    "shape_findings",
    "shape_of",
]
