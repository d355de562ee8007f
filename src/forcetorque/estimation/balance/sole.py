# SPDX-License-Identifier: BSD-3-Clause
"""Soles: flat undersides of feet, where they are on a link, and how far they reach."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_last_axis
from forcetorque.errors import EstimationError
from forcetorque.estimation.contact import Contact

_FEWEST_CORNERS = 3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sole:
    """A flat sole: the plane z = 0 of its frame, z away from the ground."""

    frame: str
    """Link of the robot whose axes it has."""
    position: FloatArray = field(default_factory=lambda: np.zeros(3))
    """Origin of the sole in that frame, a point of its plane; shape (3,); m."""
    outline: FloatArray | None = None
    """Corners of the sole along x and y from its origin; shape (k, 2); m; None where nobody knows how far it reaches.
    The ground presses, so the centre of pressure lies in the smallest convex shape around them."""
    edges: FloatArray = field(init=False)
    """Outward unit normals of that shape and their offsets, `normal . point + offset` being positive outside; shape
    (e, 3); 1, 1, m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", read_only(self.position, name=f"sole {self.frame!r}", shape=(3,)))
        edges = np.empty((0, 3))
        if self.outline is not None:
            outline = read_only(self.outline, name=f"sole {self.frame!r}: outline", shape=(None, 2))
            object.__setattr__(self, "outline", outline)
            edges = _convex_edges(self.frame, outline)
        object.__setattr__(self, "edges", read_only(edges, name="edges", shape=(None, 3)))

    @property
    def contact(self) -> Contact:
        """The whole wrench of the ground, in and about the frame of the sole."""
        return Contact.at_point(self.frame, self.position)

    def beyond(self, points: FloatArray) -> FloatArray:
        """Tell how far points lie outside the sole.

        Args:
            points: Points of its plane; shape (n, 2); m.

        Returns:
            Largest distance to an edge, from the inside outwards: positive outside; shape (n,); m. NaN for points that
            are, and where the outline is not known.
        """
        require_last_axis(points, name="points", length=2)
        if not len(self.edges):
            return np.full(len(points), np.nan)
        farthest: FloatArray = (points @ self.edges[:, :2].T + self.edges[:, 2]).max(axis=1)
        return farthest


def _convex_edges(frame: str, outline: FloatArray) -> FloatArray:
    from scipy.spatial import ConvexHull, QhullError  # here because importing it takes longer than most commands

    if len(outline) >= _FEWEST_CORNERS and np.isfinite(outline).all():
        try:
            return np.asarray(ConvexHull(outline).equations, dtype=np.float64)
        except QhullError:
            pass
    raise EstimationError(
        f"sole {frame!r}: outline: expected at least {_FEWEST_CORNERS} corners x, y in m that span an area, got "
        f"{len(outline)}: {np.round(outline, 6).tolist()}"
    )
