# SPDX-License-Identifier: BSD-3-Clause
"""The figure of spheres: outlines as the ellipsoid is seen, and what is not known is seen to be so."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.figures.sphere import ellipsoid_outline, sphere_figure
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, ellipsoid_of_map
from forcetorque.results.figure_style import REFERENCE_COLOUR, look
from tests.report.drawing import panels, recorded_figures, sphere_of, words

PLANES = ((0, 1), (1, 2), (0, 2))
MATRIX = np.array([[1.2, 0.1, 0.0], [0.2, 1.4, -0.1], [0.0, 0.1, 0.9]])
WEIGHT, OFFSET = 46.0, np.array([10.0, -20.0, 30.0])


def _clouds(count: int, part: float) -> tuple[np.ndarray, np.ndarray]:
    """Measured and reference forces over a part of the sphere, from the pole."""
    rng = np.random.default_rng(1)
    z = 1.0 - part * rng.uniform(0.0, 2.0, size=count)
    turn = rng.uniform(0.0, 2.0 * np.pi, size=count)
    across = np.sqrt(1.0 - z**2)
    reference = WEIGHT * np.column_stack([across * np.cos(turn), across * np.sin(turn), z])
    return reference @ MATRIX.T + OFFSET + 0.3 * rng.normal(size=(count, 3)), reference


def test_outlines_reach_to_the_half_widths() -> None:
    """The shadow of an ellipsoid bounds the shadows of its points and touches the half-widths."""
    ellipsoid = ellipsoid_of_map(MATRIX, centre=OFFSET, radius=WEIGHT)
    for plane in PLANES:
        outline = ellipsoid_outline(ellipsoid, plane) - OFFSET[list(plane)]
        # 180 steps of two degrees pass the farthest point by at most one
        np.testing.assert_allclose(outline.max(axis=0), ellipsoid.half_widths[list(plane)], rtol=2e-4)
        np.testing.assert_allclose(outline[0], outline[-1], atol=1e-12)
    ball = ellipsoid_outline(Ellipsoid(centre=np.zeros(3), shape=np.eye(3) / 4.0), (0, 1))
    np.testing.assert_allclose(np.linalg.norm(ball, axis=1), 2.0)


def _lines(count: int, part: float, *, with_model: bool) -> tuple[dict[str, list[object]], str]:
    """Dashes of the outlines of the first panel by colour, and all words."""
    force, reference = _clouds(count, part)
    found = sphere_of(force, reference if with_model else None, mass=WEIGHT / 9.81)
    with recorded_figures() as figures:
        sphere_figure([found])
    (figure,) = figures
    dashes: dict[str, list[object]] = {}
    for line in panels(figure)[0].get_lines():
        dashes.setdefault(str(line.get_color()), []).append(line.get_linestyle())
    return dashes, words(figure)


def test_what_is_known_is_drawn_in_full() -> None:
    """Cloud, both ellipsoids and the weight, each with its own colour; nothing is dotted."""
    dashes, text = _lines(600, 0.9, with_model=True)
    assert set(dashes) == {look(0).colour, look(1).colour, look(2).colour, REFERENCE_COLOUR}
    assert all(":" not in styles for styles in dashes.values())
    assert "not identifiable" not in text
    assert "leg_ft (SN1), prior" in text
    assert "weight by the model" in text


def test_what_is_not_known_is_dotted_or_left_out() -> None:
    """On a cap the ellipsoid without the model is dotted; without a reference there is none with the model."""
    dashes, text = _lines(600, 0.03, with_model=False)
    assert look(1).colour not in dashes
    assert "with the model" not in text
    assert dashes.get(look(2).colour, [":"]) == [":"]
    assert "not identifiable" in text


@pytest.mark.long
def test_the_offset_is_taken_off() -> None:
    """The cloud lies about zero, where the weight's circle is, however large the offset."""
    force, reference = _clouds(600, 0.9)
    with recorded_figures() as figures:
        sphere_figure([sphere_of(force, reference), sphere_of(force + 500.0, reference)])
    (figure,) = figures
    first, second = (panels(figure)[k].get_lines()[0].get_xydata() for k in (0, 3))
    np.testing.assert_allclose(first, second, atol=1e-6)
    assert np.abs(np.asarray(first)).max() < 2.0 * WEIGHT


def test_a_row_per_analysis_and_three_views() -> None:
    """Titles name sensor, serial number and candidate; axes name component and unit."""
    force, reference = _clouds(600, 0.9)
    with recorded_figures() as figures:
        sphere_figure([sphere_of(force, reference, candidate=name) for name in ("prior", "new_$1.json")])
    (figure,) = figures
    assert len(panels(figure)) == 6
    assert [panel.get_xlabel() for panel in panels(figure)[:3]] == ["fx, N", "fy, N", "fx, N"]
    assert [panel.get_ylabel() for panel in panels(figure)[:3]] == ["fy, N", "fz, N", "fz, N"]
    assert r"new_\$1.json" in words(figure)


def test_nothing_to_draw_is_refused() -> None:
    """One line that says so."""
    with pytest.raises(ShapeError, match="spheres: expected at least one to draw, got none"):
        sphere_figure([])
