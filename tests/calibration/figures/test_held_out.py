# SPDX-License-Identifier: BSD-3-Clause
"""The choice of lambda: curves over their own lambdas, 0 and infinity apart, and the choice where it is."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from forcetorque.base.errors import ShapeError
from forcetorque.calibration.figures.lambda_curves import held_out_figure, infinite_place
from forcetorque.results.figure_style import look
from tests.report.drawing import LAMBDAS, legend_of, panels

DECADES = 10.0 ** np.arange(-2.0, 9.0)
WITH_PRIOR = np.append(DECADES, np.inf)
ERRORS = np.linspace(6.0, 4.0, len(WITH_PRIOR))


def _ticks(panel: Axes) -> dict[str, float]:
    return {text.get_text(): place for text, place in zip(panel.get_xticklabels(), panel.get_xticks(), strict=True)}


def _stars(panel: Axes) -> list[Line2D]:
    return [line for line in panel.lines if line.get_marker() == "*"]


def test_the_prior_has_a_place_of_its_own(drawn: list[Figure]) -> None:
    """Infinity lies right of the largest lambda, named as what it is, and its error is drawn there."""
    held_out_figure({"leg": (WITH_PRIOR, ERRORS, 1e4)})
    (panel,) = panels(drawn[0])
    place = infinite_place(DECADES)
    assert DECADES[-1] < place < panel.get_xlim()[1]
    assert _ticks(panel)["∞"] == place
    np.testing.assert_array_equal(panel.lines[0].get_xdata(), [*DECADES, place])
    np.testing.assert_array_equal(panel.lines[0].get_ydata(), ERRORS)
    assert panel.get_xlabel() == "lambda, counts² (∞: the prior)"
    assert panel.get_xlim()[0] < DECADES[0]


def test_lambda_zero_and_the_prior_at_the_two_ends(drawn: list[Figure]) -> None:
    """Both on one axis, of curves of which each has one of them."""
    held_out_figure({"a": (LAMBDAS, np.ones(len(LAMBDAS)), None), "b": (WITH_PRIOR, ERRORS, None)})
    (panel,) = panels(drawn[0])
    ticks = _ticks(panel)
    assert ticks["0"] == 0.0
    assert panel.get_xlim()[0] < 0.0 < DECADES[0] < DECADES[-1] < ticks["∞"] < panel.get_xlim()[1]
    first, second = panel.lines[:2]
    np.testing.assert_array_equal(first.get_xdata(), LAMBDAS)
    assert (first.get_marker(), second.get_marker()) == (look(0).marker, look(1).marker)
    assert legend_of(drawn[0]) == ["a: none chosen", "b: none chosen"]


def test_without_the_prior_there_is_no_such_place(drawn: list[Figure]) -> None:
    """The axis is that of the neighbours."""
    held_out_figure({"a": (LAMBDAS, np.ones(len(LAMBDAS)), 0.0)})
    (panel,) = panels(drawn[0])
    assert "∞" not in _ticks(panel)
    assert panel.get_xlabel() == "lambda, counts²"
    assert _stars(panel)[0].get_xydata().tolist() == [[0.0, 1.0]]


@pytest.mark.parametrize("lambdas", [[np.inf], [0.0], [0.0, np.inf], [3.0], [3.0, np.inf]])
def test_few_lambdas_are_drawn(lambdas: list[float], drawn: list[Figure]) -> None:
    """All points lie within the axis, each at another place."""
    held_out_figure({"leg": (np.array(lambdas), np.ones(len(lambdas)), lambdas[-1])})
    (panel,) = panels(drawn[0])
    at = panel.lines[0].get_xdata()
    assert len(set(at)) == len(lambdas)
    assert panel.get_xlim()[0] < min(at) <= max(at) < panel.get_xlim()[1]
    assert _stars(panel)[0].get_xdata()[0] == at[-1]


def test_the_choice_is_marked_and_said(drawn: list[Figure]) -> None:
    """A star on the point of each curve, in any order of lambdas, also where the prior was kept."""
    order = np.random.default_rng(1).permutation(len(WITH_PRIOR))
    held_out_figure(
        {
            "leg_$1": (WITH_PRIOR[order], ERRORS[order], 1e4),
            "arm": (WITH_PRIOR, ERRORS + 1.0, np.inf),
        }
    )
    (panel,) = panels(drawn[0])
    stars = [line.get_xydata()[0].tolist() for line in _stars(panel)]
    assert stars == [[1e4, ERRORS[6]], [infinite_place(DECADES), 5.0]]
    assert legend_of(drawn[0]) == [
        rf"leg_\$1: lambda 1e+04, error {ERRORS[6]:.4g}",
        "arm: prior kept, error 5",
        "chosen",
    ]
    np.testing.assert_array_equal(panel.lines[0].get_ydata(), ERRORS)


def test_the_worst_ratio_has_a_panel_of_its_own(drawn: list[Figure]) -> None:
    """With a line at 1, the looks of the curves above, and the star at the same lambda."""
    ratio = np.geomspace(30.0, 0.2, len(WITH_PRIOR))
    curves = {"leg": (WITH_PRIOR, ERRORS, 1.0), "arm": (WITH_PRIOR, ERRORS + 1.0, 100.0)}
    held_out_figure(curves, worst_ratios={"arm": ratio})
    above, below = panels(drawn[0])
    assert below.lines[0].get_ydata()[0] == 1.0
    np.testing.assert_array_equal(below.lines[1].get_ydata(), ratio)
    assert below.lines[1].get_color() == look(1).colour
    assert [line.get_xydata()[0].tolist() for line in _stars(below)] == [[100.0, ratio[4]]]
    assert (above.get_yscale(), below.get_yscale()) == ("linear", "log")
    assert above.get_xlim() == below.get_xlim()


def test_bad_input_is_refused() -> None:
    """No curves, lambdas and errors that do not fit, a choice or a name that is not there."""
    with pytest.raises(ShapeError, match="curves: expected at least one name"):
        held_out_figure({})
    with pytest.raises(ShapeError, match=r"curves\['a'\]: rmse: expected an array of shape \(13\)"):
        held_out_figure({"a": (LAMBDAS, np.ones(4), None)})
    with pytest.raises(ShapeError, match=r"curves\['a'\]: .*at least 0 counts2, got -1"):
        held_out_figure({"a": (np.array([1.0, -1.0]), np.ones(2), None)})
    with pytest.raises(ShapeError, match=r"curves\['a'\]: .*at least 0 counts2, got nan"):
        held_out_figure({"a": (np.array([1.0, np.nan]), np.ones(2), None)})
    with pytest.raises(ShapeError, match=r"curves\['a'\]: expected .* at most one infinite"):
        held_out_figure({"a": (np.array([np.inf, np.inf]), np.ones(2), None)})
    with pytest.raises(ShapeError, match=r"curves\['a'\]: .*expected at least one sample"):
        held_out_figure({"a": (np.zeros(0), np.zeros(0), None)})
    with pytest.raises(ShapeError, match=r"curves\['a'\]: chosen: expected one of the lambdas .* got 7"):
        held_out_figure({"a": (LAMBDAS, np.ones(13), 7.0)})
    with pytest.raises(ShapeError, match="worst_ratios: no curve is called 'b'"):
        held_out_figure({"a": (LAMBDAS, np.ones(13), None)}, worst_ratios={"b": np.ones(13)})
    with pytest.raises(ShapeError, match=r"worst_ratios\['a'\]: expected an array of shape \(13\)"):
        held_out_figure({"a": (LAMBDAS, np.ones(13), None)}, worst_ratios={"a": np.ones(3)})
