# SPDX-License-Identifier: BSD-3-Clause
"""The smooth surface on which the taxels of a simulated patch truly lie: around an axis, as a limb is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, require_last_axis
from forcetorque.base.errors import SkinError
from forcetorque.base.pose import cross
from forcetorque.skin.layout.layout import SkinLayout

if TYPE_CHECKING:
    from scipy.interpolate import RectBivariateSpline


_LENGTH_M: Final = 0.01
"""Length in which smoothness is meant: about half a module."""
_SMOOTHING: Final = 1.0
"""How far the surface passes by the taxels: the planes of the modules, which a limb has not, are rounded off."""
_MARGIN_M: Final = 0.025
"""How far the surface goes on beyond the outermost taxels."""
_KNOTS_M: Final = 0.002
"""Distance of the knots of the spline."""
_STEEPEST: Final = 0.5
"""Least cosine between normals and rays from the axis: below it the surface folds back, and has no such chart."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfacePoints:
    """Points of a surface."""

    positions: FloatArray
    """In the frame of the link; shape (..., 3); m."""
    normals: FloatArray
    """Outward unit normals; shape (..., 3)."""
    stretch: FloatArray
    """Area of the surface over area of the chart; shape (...)."""

    def __getitem__(self, index: tuple[slice, ...]) -> SurfacePoints:
        return SurfacePoints(positions=self.positions[index], normals=self.normals[index], stretch=self.stretch[index])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrueSurface:
    """A surface around an axis; its chart is (arc at the mean radius, place along the axis), in m."""

    link_R_axis: FloatArray
    """Rotation of the axis' frame, whose z is the axis, in the link; shape (3, 3)."""
    origin: FloatArray
    """A point of the axis in the link; shape (3,); m."""
    mean_radius_m: float
    """Distance of the taxels from the axis."""
    low: FloatArray
    """Smallest coordinates of the chart; shape (2,); m."""
    high: FloatArray
    """Largest coordinates of the chart; shape (2,); m."""
    radius: RectBivariateSpline
    """Distance from the axis over the chart; m."""

    @classmethod
    def through(cls, layout: SkinLayout) -> Self:
        """Lay a smooth surface through the taxels of a patch.

        Args:
            layout: Patch with valid normals; they determine the axis.

        Returns:
            The surface; it passes the taxels by some tenths of a millimetre.

        Raises:
            SkinError: If the patch folds back, seen from the axis of its normals, or is flat.
        """
        try:
            return cls._through(layout)
        except np.linalg.LinAlgError:
            raise SkinError(
                f"patch {layout.name!r}: expected a surface around an axis, got a flat or too small one; simulate a "
                "patch of a limb"
            ) from None

    @classmethod
    def _through(cls, layout: SkinLayout) -> Self:
        from scipy.interpolate import RBFInterpolator, RectBivariateSpline

        rotation, origin = _axis(layout.positions, layout.normals)
        local = (layout.positions - origin) @ rotation
        radii = np.linalg.norm(local[:, :2], axis=1)
        outwards = (local[:, :2] * (layout.normals @ rotation)[:, :2]).sum(axis=1) / radii
        if not (outwards > _STEEPEST).all():
            raise SkinError(
                f"patch {layout.name!r}: expected a surface around an axis, got normals that turn back from it at "
                f"taxel {layout.taxels[outwards.argmin()]}; simulate a patch of one limb"
            )
        places = _chart(local, float(radii.mean()))
        low, high = places.min(axis=0) - _MARGIN_M, places.max(axis=0) + _MARGIN_M
        arcs, heights = (np.arange(a, b + _KNOTS_M, _KNOTS_M) for a, b in zip(low, high, strict=True))
        smooth = RBFInterpolator(places / _LENGTH_M, radii, kernel="thin_plate_spline", smoothing=_SMOOTHING)
        knots = np.stack(np.meshgrid(arcs, heights, indexing="ij"), axis=-1).reshape(-1, 2)
        return cls(
            link_R_axis=rotation,
            origin=origin,
            mean_radius_m=float(radii.mean()),
            low=low,
            high=high,
            radius=RectBivariateSpline(arcs, heights, smooth(knots / _LENGTH_M).reshape(len(arcs), -1)),
        )

    def chart(self, positions: FloatArray) -> FloatArray:
        """Give the coordinates of points, seen from the axis.

        Args:
            positions: Points in the link; shape (k, 3); m.

        Returns:
            Coordinates; shape (k, 2); m.
        """
        return _chart((positions - self.origin) @ self.link_R_axis, self.mean_radius_m)

    def at(self, places: FloatArray) -> SurfacePoints:
        """Give the points of the surface at coordinates.

        Args:
            places: Coordinates; shape (..., 2); m.

        Returns:
            Points, normals and how much larger the surface is there than its chart.
        """
        require_last_axis(places, name="places", length=2)
        arc, height = places[..., 0], places[..., 1]
        radius, by_arc, by_height = (self.radius.ev(arc, height, dx=dx, dy=dy) for dx, dy in ((0, 0), (1, 0), (0, 1)))
        angle = arc / self.mean_radius_m
        ray = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
        around = np.stack([-np.sin(angle), np.cos(angle), np.zeros_like(angle)], axis=-1)
        along_arc = by_arc[..., None] * ray + (radius / self.mean_radius_m)[..., None] * around
        along_axis = by_height[..., None] * ray + np.array([0.0, 0.0, 1.0])
        area = cross(along_arc, along_axis)
        stretch = np.linalg.norm(area, axis=-1)
        local = radius[..., None] * ray + height[..., None] * np.array([0.0, 0.0, 1.0])
        return SurfacePoints(
            positions=local @ self.link_R_axis.T + self.origin,
            normals=(area / stretch[..., None]) @ self.link_R_axis.T,
            stretch=stretch,
        )


def _chart(local: FloatArray, mean_radius_m: float) -> FloatArray:
    return np.stack([mean_radius_m * np.arctan2(local[:, 1], local[:, 0]), local[:, 2]], axis=1)


def _axis(positions: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotation and a point of the axis that normals turn about; x is the mean normal."""
    _, _, directions = np.linalg.svd(normals, full_matrices=False)
    axis = directions[2]
    mean = normals.mean(axis=0)
    first = mean - (mean @ axis) * axis
    first /= np.linalg.norm(first)
    rotation = np.stack([first, cross(axis, first), axis], axis=1)
    flat, lines = positions @ rotation[:, :2], normals @ rotation[:, :2]
    lines /= np.linalg.norm(lines, axis=1, keepdims=True)
    # the point nearest to all lines along the normals
    across = np.eye(2) - lines[:, :, None] * lines[:, None, :]
    centre = np.linalg.solve(across.sum(axis=0), np.einsum("nij,nj->i", across, flat))
    origin: FloatArray = rotation[:, :2] @ centre
    return rotation, origin
