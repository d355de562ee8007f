# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of forces or moments along the axes: every cloud is drawn and told apart, thinned ones with their extremes."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.figures.sphere import CLOUD_POINTS, force_space_figure
from forcetorque.results.figure_style import look, png_bytes
from tests.cases import some_cases
from tests.report.drawing import legend_of, panels, words


def _cloud(count: int, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(count, 3))


def test_every_cloud_is_drawn_whatever_their_number(drawn: list[Figure]) -> None:
    """More than there are colours: each still has its points and its outline in every view, and differs in its look."""
    clouds = [(f"cloud {k}", _cloud(5, k) + k) for k in range(9)]
    force_space_figure({"leg": clouds})
    assert legend_of(drawn[0]) == [name for name, _ in clouds]
    for panel, plane in zip(panels(drawn[0]), ((0, 1), (1, 2), (0, 2)), strict=True):
        points, outlines = panel.lines[:9], panel.lines[9:]
        assert len(outlines) == 9
        for line, (_, cloud) in zip(points, clouds, strict=True):
            np.testing.assert_array_equal(line.get_xydata(), cloud[:, plane])
        assert len({(line.get_color(), line.get_marker()) for line in points}) == 9


@some_cases(
    ("quantity", "labels"), [("force", ["fx, N", "fy, N", "fz, N"]), ("moment", ["tx, N m", "ty, N m", "tz, N m"])]
)
def test_axes_name_component_and_unit(quantity: str, labels: list[str], drawn: list[Figure]) -> None:
    """Forces if nothing is said; only the labels differ."""
    clouds = {"leg": [("prior", _cloud(20))]}
    png = png_bytes(force_space_figure(clouds, quantity=quantity))  # type: ignore[arg-type]
    assert [panel.get_xlabel() for panel in panels(drawn[0])] == [labels[0], labels[1], labels[0]]
    assert [panel.get_ylabel() for panel in panels(drawn[0])] == [labels[1], labels[2], labels[2]]
    assert (png == png_bytes(force_space_figure(clouds))) == (quantity == "force")


def test_a_name_looks_alike_in_all_rows(drawn: list[Figure]) -> None:
    """Also where a row lacks one; the legend names each once."""
    force_space_figure({"a": [("prior", _cloud(9)), ("model", _cloud(9))], "b_$1": [("model", _cloud(9))]})
    assert legend_of(drawn[0]) == ["prior", "model"]
    first, second = panels(drawn[0])[0], panels(drawn[0])[3]
    assert second.lines[0].get_color() == first.lines[1].get_color() == look(0).colour
    assert r"b_\$1" in words(drawn[0])


def test_a_thinned_cloud_keeps_its_extremes_in_the_outline(drawn: list[Figure]) -> None:
    """One sample of thousands that is far away, and not drawn as a point, is a corner."""
    cloud = _cloud(3 * CLOUD_POINTS)
    cloud[4] = [90.0, 80.0, 70.0]
    force_space_figure({"leg": [("model", cloud)]})
    points, hull = panels(drawn[0])[0].lines
    assert len(points.get_xydata()) == CLOUD_POINTS
    assert points.get_xydata().max() < 10.0
    assert hull.get_xydata().max(axis=0).tolist() == [90.0, 80.0]
    assert to_hex(hull.get_color()) == look(0).colour.lower()


@pytest.mark.long
def test_a_missing_component_leaves_out_the_sample() -> None:
    """The other samples are those of the cloud without it; the caller's array stays as it is."""
    cloud = _cloud(50)
    cloud[7, 2] = np.inf
    kept = cloud.copy()
    without = png_bytes(force_space_figure({"leg": [("prior", np.delete(cloud, 7, axis=0))]}))
    assert png_bytes(force_space_figure({"leg": [("prior", cloud)]})) == without
    np.testing.assert_array_equal(cloud, kept)


def test_what_is_no_cloud_is_refused() -> None:
    """No rows, a row without clouds, whole wrenches, nothing, an unknown quantity."""
    with pytest.raises(ShapeError, match="clouds: expected at least one row"):
        force_space_figure({})
    with pytest.raises(ShapeError, match=r"clouds\['leg'\]: expected at least one cloud"):
        force_space_figure({"leg": []})
    with pytest.raises(
        ShapeError, match=r"clouds\['leg'\], 'prior': expected an array of shape \(n, 3\), got \(5, 6\)"
    ):
        force_space_figure({"leg": [("prior", np.zeros((5, 6)))]})
    with pytest.raises(ShapeError, match="expected at least one sample"):
        force_space_figure({"leg": [("prior", np.zeros((0, 3)))]})
    with pytest.raises(ShapeError, match=r"quantity: expected one of \['force', 'moment'\], got 'torque'"):
        force_space_figure({"leg": [("prior", _cloud(5))]}, quantity="torque")  # type: ignore[arg-type]
