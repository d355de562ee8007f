# SPDX-License-Identifier: BSD-3-Clause
"""Differences over lambda: 0 has a place, and curves that coincide are all seen."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.calibration.figures.lambda_curves import lambda_difference_figure
from forcetorque.results.figure_style import look, png_bytes
from tests.report.drawing import LAMBDAS, TYPES, count_of, legend_of, panels, pixels, words

UNIT = "1e-4 N/count"
FALLING = 30.0 / (1.0 + LAMBDAS / 1e4)


def test_every_curve_is_drawn_and_named(drawn: list[Figure]) -> None:
    """At its lambdas, in its order, with units and what lambda means."""
    curves = {kind: FALLING + k for k, kind in enumerate(TYPES)}
    lambda_difference_figure(LAMBDAS, curves, unit=UNIT)
    (panel,) = panels(drawn[0])
    assert legend_of(drawn[0]) == list(TYPES)
    for line, values in zip(panel.lines, curves.values(), strict=True):
        np.testing.assert_array_equal(line.get_xydata(), np.column_stack([LAMBDAS, values]))
    assert panel.get_xlabel() == "lambda, counts²"
    assert panel.get_ylabel() == f"difference to the Workbench matrix, {UNIT}"
    assert "lambda of (5.4): it weighs |C - C_prior|² beside mean |f - C r - o|²" in words(drawn[0])


def test_lambda_0_has_a_place_left_of_the_others(drawn: list[Figure]) -> None:
    """It is marked, within the panel, and as far from the next as can be seen; decades are equally far apart."""
    lambda_difference_figure(LAMBDAS, {"a": FALLING}, unit=UNIT)
    (panel,) = panels(drawn[0])
    assert [label.get_text() for label in panel.get_xticklabels()][:3] == ["0", "$10^{0}$", "$10^{1}$"]
    x = panel.transData.transform(np.column_stack([[0.0, 1.0, 10.0, 100.0, 1e6], np.zeros(5)]))[:, 0]
    box = panel.get_window_extent()
    assert box.x0 < x[0]
    assert x[-1] < box.x1
    assert x[1] - x[0] > 60.0
    assert x[2] - x[1] == pytest.approx(x[3] - x[2], rel=1e-6)


@pytest.mark.parametrize("lambdas", [[0.0], [3.0], [0.0, 3.0], [1.0, 1e6], [0.0, 1e-9, 1e12]])
def test_any_lambdas_make_an_axis(lambdas: list[float], drawn: list[Figure]) -> None:
    """One, two, without 0, over many decades: all points lie within the panel."""
    lambda_difference_figure(lambdas, {"a": np.ones(len(lambdas))}, unit=UNIT)
    (panel,) = panels(drawn[0])
    box = panel.get_window_extent()
    assert all(box.contains(x, y) for x, y in panel.transData.transform(panel.lines[0].get_xydata()))


def test_the_order_of_the_lambdas_does_not_matter() -> None:
    """The curve runs from small to large lambda."""
    order = np.random.default_rng(1).permutation(len(LAMBDAS))
    mixed = png_bytes(lambda_difference_figure(LAMBDAS[order], {"a": FALLING[order]}, unit=UNIT))
    assert mixed == png_bytes(lambda_difference_figure(LAMBDAS, {"a": FALLING}, unit=UNIT))


def test_curves_that_coincide_are_both_seen() -> None:
    """The first is not covered: it has as much of the line as the second, and points of its own."""
    image = pixels(lambda_difference_figure(LAMBDAS, {"C": FALLING, "O": FALLING.copy()}, unit=UNIT))
    first, second = (count_of(image[:450], look(k).colour) for k in range(2))
    assert min(first, second) > 500
    assert 0.4 < first / second < 2.5


def test_curves_that_coincide_in_part_are_both_seen() -> None:
    """Where they run together, the first is wider than the second and shows beside it."""
    apart = FALLING + np.where(LAMBDAS > 1e4, 5.0, 0.0)
    image = pixels(lambda_difference_figure(LAMBDAS, {"C": FALLING, "O": apart}, unit=UNIT))
    together = image[:450, 120:700]
    assert min(count_of(together, look(k).colour) for k in range(2)) > 200


def test_a_missing_value_breaks_the_curve(drawn: list[Figure]) -> None:
    """The others stay, and so does the curve that coincides otherwise."""
    broken = FALLING.copy()
    broken[4] = np.nan
    lambda_difference_figure(LAMBDAS, {"a": broken, "b": FALLING, "c": np.full(len(LAMBDAS), np.inf)}, unit=UNIT)
    drawn_values = panels(drawn[0])[0].lines[0].get_ydata()
    np.testing.assert_array_equal(np.isnan(drawn_values), np.isnan(broken))


def test_what_is_no_curve_is_refused() -> None:
    """No curves, another number of values, lambdas that no fit has."""
    with pytest.raises(ShapeError, match="curves: expected at least one"):
        lambda_difference_figure(LAMBDAS, {}, unit=UNIT)
    with pytest.raises(ShapeError, match=r"curves\['a'\]: expected an array of shape \(13\)"):
        lambda_difference_figure(LAMBDAS, {"a": np.ones(12)}, unit=UNIT)
    for wrong in (-1.0, np.nan, np.inf):
        with pytest.raises(ShapeError, match=rf"lambdas: expected finite numbers .* got {wrong} at index 1"):
            lambda_difference_figure([0.0, wrong], {"a": np.ones(2)}, unit=UNIT)
    with pytest.raises(ShapeError, match="lambdas: expected at least one"):
        lambda_difference_figure([], {"a": []}, unit=UNIT)
