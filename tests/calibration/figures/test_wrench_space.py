# SPDX-License-Identifier: BSD-3-Clause
"""Forces and torques by type of data set: in space and in planes, and no cloud hides another."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.calibration.figures.excitation import space_figure
from forcetorque.results.figure_style import DRAWN_POINTS, look, png_bytes
from tests.cases import some_cases
from tests.report.drawing import count_of, legend_of, panels, pixels

PLANES = ((0, 1), (1, 2), (0, 2))


def _cloud(count: int, scale: float, seed: int = 1) -> np.ndarray:
    return scale * np.random.default_rng(seed).normal(size=(count, 6))


def test_a_row_of_forces_and_a_row_of_torques(drawn: list[Figure]) -> None:
    """Each a view in space and the planes x-y, y-z and x-z, labelled with units; types are named once."""
    space_figure({"grid": _cloud(50, 1.0), "z-torque": _cloud(50, 2.0)})
    shown = panels(drawn[0])
    assert [panel.name == "3d" for panel in shown] == [True, False, False, False] * 2
    for symbol, unit, row in (("f", "N", shown[:4]), ("t", "N m", shown[4:])):
        labels = [f"{symbol}{axis}, {unit}" for axis in "xyz"]
        assert [row[0].get_xlabel(), row[0].get_ylabel(), row[0].get_zlabel()] == labels
        assert [(panel.get_xlabel(), panel.get_ylabel()) for panel in row[1:]] == [
            (labels[a], labels[b]) for a, b in PLANES
        ]
    assert legend_of(drawn[0]) == ["grid", "z-torque"]


def test_the_components_are_where_their_labels_are(drawn: list[Figure]) -> None:
    """Every plane holds the columns of the wrenches that its labels name."""
    wrenches = _cloud(50, 1.0)
    space_figure({"grid": wrenches})
    shown = panels(drawn[0])
    for row, first in ((shown[:4], 0), (shown[4:], 3)):
        for panel, (a, b) in zip(row[1:], PLANES, strict=True):
            np.testing.assert_array_equal(panel.lines[0].get_xydata(), wrenches[:, [first + a, first + b]])
        np.testing.assert_array_equal(np.transpose(row[0].lines[0].get_data_3d()), wrenches[:, first : first + 3])


@some_cases("names", [("wide", "narrow"), ("narrow", "wide")])
def test_a_large_cloud_does_not_hide_a_small_one(names: tuple[str, str]) -> None:
    """Fifty points in the middle of a hundred thousand show their colour, whichever comes first."""
    clouds = {"wide": _cloud(100_000, 10.0), "narrow": _cloud(50, 1.0, seed=2)}
    image = pixels(space_figure({name: clouds[name] for name in names}))
    colour = look(names.index("narrow")).colour
    # the view in space; in the planes points are half transparent
    assert count_of(image[:350, :400], colour) > 20


def test_points_are_thinned_and_outlines_are_not(drawn: list[Figure]) -> None:
    """Of a long recording some thousand points are drawn; the outline reaches its one farthest sample all the same."""
    wrenches = np.random.default_rng(1).uniform(-1.0, 1.0, size=(100_000, 6))
    wrenches[12_345, :2] = 50.0, 40.0
    space_figure({"grid": wrenches})
    points, outline = panels(drawn[0])[1].lines
    assert len(points.get_xydata()) == DRAWN_POINTS
    assert points.get_xydata().max() < 2.0
    assert outline.get_xydata().max(axis=0) == pytest.approx([50.0, 40.0])


def test_the_outline_is_the_hull_of_a_square(drawn: list[Figure]) -> None:
    """By hand: four corners and back, without the sample in the middle."""
    square = np.zeros((5, 6))
    square[:, 0], square[:, 1] = [0.0, 2.0, 2.0, 0.0, 1.0], [0.0, 0.0, 2.0, 2.0, 1.0]
    space_figure({"square": square})
    outline = panels(drawn[0])[1].lines[1].get_xydata()
    np.testing.assert_array_equal(outline[0], outline[-1])
    assert sorted(map(tuple, outline[:-1])) == [(0.0, 0.0), (0.0, 2.0), (2.0, 0.0), (2.0, 2.0)]


@pytest.mark.parametrize(
    "wrenches",
    [
        np.zeros((1, 6)),
        np.zeros((500, 6)),
        np.outer(np.arange(9.0), np.ones(6)),
        np.full((4, 6), np.nan),
        np.full((4, 6), np.inf),
    ],
    ids=["one", "all alike", "on a line", "all missing", "infinite"],
)
def test_clouds_without_area_are_drawn(wrenches: np.ndarray, drawn: list[Figure]) -> None:
    """They have no outline; the others are drawn as ever."""
    space_figure({"thin": wrenches, "grid": _cloud(50, 1.0)})
    assert legend_of(drawn[0]) == ["thin", "grid"]


@pytest.mark.long
def test_a_missing_component_leaves_out_the_sample(drawn: list[Figure]) -> None:
    """The other samples are those of the cloud without it."""
    wrenches = _cloud(50, 1.0)
    wrenches[7, 4] = np.nan
    assert png_bytes(space_figure({"grid": wrenches})) == png_bytes(
        space_figure({"grid": np.delete(wrenches, 7, axis=0)})
    )
    assert len(panels(drawn[0])[1].lines[0].get_xydata()) == 49


def test_what_is_no_cloud_is_refused() -> None:
    """No clouds at all, a cloud of forces alone, an empty one."""
    with pytest.raises(ShapeError, match="clouds: expected at least one"):
        space_figure({})
    with pytest.raises(ShapeError, match=r"clouds\['grid'\]: expected an array of shape \(n, 6\)"):
        space_figure({"grid": np.zeros((5, 3))})
    with pytest.raises(ShapeError, match=r"clouds\['grid'\]: expected at least one sample"):
        space_figure({"grid": np.zeros((0, 6))})
