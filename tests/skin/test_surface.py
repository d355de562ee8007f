# SPDX-License-Identifier: BSD-3-Clause
"""Triangles between taxels: they cover the skin once, look outwards, and know their neighbours."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.base.pose import rotation_from_rpy
from forcetorque.skin.surface import (
    HALF_PITCH_M,
    LONGEST_EDGE_M,
    edge_taxels,
    rim_strip,
    skin_surface,
    surface_triangles,
    unrolled,
)
from tests.skin.layout.skins import PITCH_M, cylinder, plane_lattice

ROUNDING = 1e-12
"""Of lengths below a metre, summed over hundreds of facets, with room."""


def test_the_strip_is_half_as_wide_as_taxels_are_apart() -> None:
    """On a module, to 2 %: a wider one adds force to every contact at the edge."""
    assert pytest.approx(0.5 * PITCH_M, rel=0.02) == HALF_PITCH_M


def test_a_plane_is_covered_once() -> None:
    """The facets of a lattice have together the area inside its outline, and all of them the plane's normal."""
    rows, columns = 8, 10
    surface = skin_surface(plane_lattice(rows, columns), outward=np.tile([0.0, 0.0, 1.0], (rows * columns, 1)))
    # columns - 1 whole triangles up and down in each row; the sides may have one more in every notch
    inside = (rows - 1) * (columns - 1) * np.sqrt(0.75) * PITCH_M**2
    notches = (rows // 2 - 1 + rows // 2) * 2 * np.sqrt(3) / 4 * PITCH_M**2 / 2
    assert inside - ROUNDING < surface.area < inside + notches + ROUNDING
    np.testing.assert_allclose(surface.facet_normals, np.tile([0.0, 0.0, 1.0], (len(surface.triangles), 1)), atol=1e-12)
    assert len(surface) - len(surface.edges) + len(surface.triangles) == 1  # Euler: one piece without holes


def test_directions_say_which_side_is_out() -> None:
    """Of a plane nothing else can: without them it is refused, with the opposite ones normals turn around."""
    flat = plane_lattice()
    with pytest.raises(SkinError, match="state rough outward directions"):
        skin_surface(flat)
    down = skin_surface(flat, outward=np.tile([0.3, 0.0, -1.0], (len(flat), 1)))
    np.testing.assert_allclose(down.vertex_normals, np.tile([0.0, 0.0, -1.0], (len(flat), 1)), atol=1e-12)


def test_a_bulge_tells_its_outer_side() -> None:
    """Normals of a half pipe are those of the cylinder within the angle of half a facet."""
    radius = 0.05
    positions = cylinder(radius)
    surface = skin_surface(positions)
    true = positions * [0.0, 1.0, 1.0] / radius
    assert ((surface.vertex_normals * true).sum(axis=1) > np.cos(PITCH_M / radius)).all()
    assert set(surface.triangles.ravel()) == set(range(len(positions)))


def test_a_closed_pipe_has_two_boundaries_only() -> None:
    """No plane could hold it: all around, every edge between the ends belongs to two facets."""
    columns, rows = 24, 10
    angle = 2.0 * np.pi * np.arange(columns) / columns
    radius = columns * PITCH_M / (2.0 * np.pi)
    row, column = np.divmod(np.arange(rows * columns), columns)
    turn = angle[column] + 0.5 * angle[1] * (row % 2)
    positions = np.stack([PITCH_M * np.sqrt(0.75) * row, radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    surface = skin_surface(positions, outward=positions * [0.0, 1.0, 1.0])
    assert len(surface.boundary) == 2 * columns
    assert len(surface.triangles) == 2 * columns * (rows - 1)


def test_turning_the_link_turns_the_surface() -> None:
    """The same facets, with turned normals."""
    positions = cylinder()
    turn = rotation_from_rpy([0.3, -0.5, 1.8])
    surface, turned = skin_surface(positions), skin_surface(positions @ turn.T + [0.1, -0.2, 0.3])
    assert {tuple(sorted(facet)) for facet in surface.triangles.tolist()} == {
        tuple(sorted(facet)) for facet in turned.triangles.tolist()
    }
    np.testing.assert_allclose(turned.vertex_normals, surface.vertex_normals @ turn.T, atol=ROUNDING)


def test_triangles_that_are_kept_are_those_of_the_same_taxels() -> None:
    """Asked again, they are there; a taxel that moved, or another longest edge, has others."""
    positions = plane_lattice()
    kept = surface_triangles(positions, LONGEST_EDGE_M)
    assert surface_triangles(positions.copy(), LONGEST_EDGE_M) is kept
    with pytest.raises(ValueError, match="read-only"):
        kept[0] = 0
    moved = positions.copy()
    moved[0] += 1.0
    assert len(surface_triangles(moved, LONGEST_EDGE_M)) < len(kept)
    assert len(surface_triangles(positions, 0.5 * PITCH_M)) == 0


def test_a_ring_is_the_neighbours() -> None:
    """Of one taxel inside a lattice: the six about it."""
    positions = plane_lattice()
    surface = skin_surface(positions, outward=np.tile([0.0, 0.0, 1.0], (len(positions), 1)))
    taxels = np.arange(len(positions)) == 34
    near = np.linalg.norm(positions - positions[34], axis=1) < 1.1 * PITCH_M
    np.testing.assert_array_equal(surface.with_ring(taxels), near)
    assert near.sum() == 7


def test_gaps_stay_open() -> None:
    """No edge is longer than the limit; a taxel farther from all others has no facet and no normal."""
    positions = np.concatenate([plane_lattice(), plane_lattice() + [0.2, 0.0, 0.0], [[0.15, 0.2, 0.0]]])
    surface = skin_surface(positions, outward=np.tile([0.0, 0.0, 1.0], (len(positions), 1)))
    length = np.linalg.norm(positions[surface.edges[:, 1]] - positions[surface.edges[:, 0]], axis=1)
    assert length.max() <= LONGEST_EDGE_M
    assert set(surface.triangles.ravel()) == set(range(len(positions) - 1))
    np.testing.assert_array_equal(surface.vertex_normals[-1], np.zeros(3))


def test_the_rim_has_its_width_all_around() -> None:
    """Around a square of four taxels: a frame as wide as stated, with square corners."""
    side = 0.01
    square = side * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    surface = skin_surface(square, outward=np.tile([0.0, 0.0, 1.0], (4, 1)))
    rim = rim_strip(surface)
    corners = np.concatenate([square, rim.positions])[rim.triangles]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (doubled[:, 2] > 0.0).all()
    np.testing.assert_allclose(doubled[:, 2].sum() / 2.0, (side + 2.0 * HALF_PITCH_M) ** 2 - side**2, rtol=1e-12)


def test_the_rim_goes_on_in_the_plane_of_the_skin() -> None:
    """On a cylinder of facets its outer points rise above the tangent by less than a fifth of its width."""
    positions = cylinder()
    surface = skin_surface(positions)
    rim = rim_strip(surface)
    outwards = (rim.positions - positions[rim.taxels]) / HALF_PITCH_M
    normals = positions[rim.taxels] * [0.0, 1.0, 1.0] / 0.05
    assert len(outwards) == 50
    assert np.abs((outwards * normals).sum(axis=1)).max() < 0.2


@pytest.mark.parametrize("corner_deg", [20.0, 50.0, 57.0, 70.0, 90.0])
def test_a_sharp_corner_of_the_rim_is_cut(corner_deg: float) -> None:
    """The strip keeps its width where the corner is no longer than two widths, and never goes farther."""
    half = np.deg2rad(0.5 * corner_deg)
    arms = 0.01 * np.array([[0.0, 0.0, 0.0], [np.cos(half), -np.sin(half), 0.0], [np.cos(half), np.sin(half), 0.0]])
    rim = rim_strip(skin_surface(arms, outward=np.tile([0.0, 0.0, 1.0], (3, 1))))
    (length,) = np.linalg.norm(rim.positions - arms[rim.taxels], axis=1)[rim.taxels == 0] / HALF_PITCH_M
    if 1.0 / np.sin(half) <= 2.0:
        np.testing.assert_allclose(length, 1.0 / np.sin(half))
    else:
        assert 0.5 < length <= 2.0


def test_where_two_boundaries_meet_each_keeps_its_strip() -> None:
    """Two triangles that touch in one taxel: six outer points, three around each."""
    positions = 0.01 * np.array([[0, 0, 0], [1, -0.5, 0], [1, 0.5, 0], [-1, 0.5, 0], [-1, -0.5, 0]], dtype=float)
    surface = skin_surface(positions, outward=np.tile([0.0, 0.0, 1.0], (5, 1)), longest_edge_m=0.0115)
    rim = rim_strip(surface)
    assert len(surface.triangles) == 2
    np.testing.assert_array_equal(np.bincount(rim.taxels), [2, 1, 1, 1, 1])


@pytest.mark.parametrize(
    ("positions", "message"),
    [
        (np.repeat(plane_lattice(2, 2), 2, axis=0), r"distinct taxels, got \[0, 1\]"),
        (1e3 * plane_lattice(), "positions are in m"),
        (plane_lattice(1, 10) * [1.0, 0.0, 0.0], "no triangle between them"),
        (np.zeros((0, 3)), "got 0 taxels"),
    ],
)
def test_what_is_no_surface_is_refused(positions: np.ndarray, message: str) -> None:
    """Taxels on each other, in millimetres, on a line, or none."""
    with pytest.raises(SkinError, match=message):
        skin_surface(positions)


def test_a_cylinder_is_unrolled_to_its_length() -> None:
    """Distances between neighbours stay, around as along, but for the corners of facets."""
    positions = cylinder()
    surface = skin_surface(positions)
    flat = unrolled(surface)
    start, end = surface.edges.T
    true = np.linalg.norm(positions[end] - positions[start], axis=1)
    np.testing.assert_allclose(np.linalg.norm(flat[end] - flat[start], axis=1), true, rtol=0.12)
    assert np.ptp(flat, axis=0).max() > np.ptp(positions, axis=0).max()


def test_a_plane_stays_as_it_is() -> None:
    """Distances between all taxels."""
    positions = plane_lattice()
    flat = unrolled(skin_surface(positions, outward=np.tile([0.0, 0.0, 1.0], (len(positions), 1))))
    for before, after in zip(positions, flat, strict=True):
        np.testing.assert_allclose(
            np.linalg.norm(flat - after, axis=1), np.linalg.norm(positions - before, axis=1), atol=1e-9
        )


def test_a_small_hole_is_no_edge() -> None:
    """Four taxels whose diagonals are too long are joined by the strip; a hole of six is an edge like any other."""
    turn = np.pi / 4.0 + np.pi / 2.0 * np.arange(4)
    square = 0.0078 * np.column_stack([np.cos(turn), np.sin(turn)])  # sides of 11 mm
    step = 0.007 * np.array([[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]])
    beside = (square[:, None] + step).reshape(-1, 2)
    outside = np.abs(beside).max(axis=1) > 0.006
    flat = np.concatenate([square, beside[outside], square + 0.007 * np.sign(square)])
    points = np.column_stack([flat, np.zeros(len(flat))])
    surface = skin_surface(points, outward=np.tile([0.0, 0.0, 1.0], (len(points), 1)))
    assert len(surface.boundary) == 4 + len(points) - 4
    np.testing.assert_array_equal(edge_taxels(surface), np.arange(len(points)) >= 4)
    lattice = np.delete(plane_lattice(), 34, axis=0)
    holed = skin_surface(lattice, outward=np.tile([0.0, 0.0, 1.0], (len(lattice), 1)), longest_edge_m=0.011)
    around = np.linalg.norm(lattice - plane_lattice()[34], axis=1) < 1.1 * PITCH_M
    assert edge_taxels(holed)[around].all()
