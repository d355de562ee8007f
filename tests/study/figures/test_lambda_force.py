# SPDX-License-Identifier: BSD-3-Clause
"""Contact force over lambda: colour by data set, points and dashes by type, the Workbench matrix and the choice."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.results.figure_style import look
from forcetorque.study.figures import MOST_HUES, lambda_force_figure
from tests.report.drawing import LAMBDAS, TYPES, legend_of, panels

WORKBENCH = 16.6642
"""Mean contact force with the Workbench matrix, thesis table 5.5; N."""


def _curves(*names: str) -> dict[str, dict[str, np.ndarray]]:
    rng = np.random.default_rng(1)
    return {name: {kind: rng.uniform(5.0, 12.0, len(LAMBDAS)) for kind in TYPES} for name in names}


def test_colour_by_data_set_and_points_by_type(drawn: list[Figure]) -> None:
    """Each of the 18 curves has the colour of its data set and the points of its type, and the legend says which."""
    curves = _curves("noTz", "suppOnly", "All")
    lambda_force_figure(LAMBDAS, curves, workbench=WORKBENCH)
    (panel,) = panels(drawn[0])
    lines = iter(panel.lines[1:])
    for k, types in enumerate(curves.values()):
        for j, values in enumerate(types.values()):
            line = next(lines)
            np.testing.assert_array_equal(line.get_ydata(), values)
            assert to_hex(line.get_color()) == look(k).colour.lower()
            assert line.get_marker() == look(j).marker
    assert not list(lines)
    assert legend_of(drawn[0]) == [*curves, *TYPES, "Workbench: 16.66 N"]
    assert drawn[0].get_supylabel() == "mean magnitude of the contact force, N"
    assert panel.get_xlabel() == "lambda, counts²"


def test_the_workbench_is_a_horizontal_line(drawn: list[Figure]) -> None:
    """Over the whole width at its force; without such a matrix there is none."""
    lambda_force_figure(LAMBDAS, _curves("All"), workbench=WORKBENCH)
    lambda_force_figure(LAMBDAS, _curves("All"))
    np.testing.assert_array_equal(panels(drawn[0])[0].lines[0].get_ydata(), [WORKBENCH, WORKBENCH])
    assert len(panels(drawn[1])[0].lines) == len(TYPES)
    assert legend_of(drawn[1]) == list(TYPES)


def test_the_best_generative_fit_is_a_second_horizontal_line(drawn: list[Figure]) -> None:
    """It has no lambda; in the legend its force stands after the workbench's."""
    lambda_force_figure(LAMBDAS, _curves("All"), workbench=WORKBENCH, generative=3.25)
    np.testing.assert_array_equal(panels(drawn[0])[0].lines[1].get_ydata(), [3.25, 3.25])
    assert legend_of(drawn[0])[-1] == "generative, best: 3.25 N"


def test_the_choice_is_marked_where_it_is(drawn: list[Figure]) -> None:
    """A star on its point, and its force in the legend."""
    curves = _curves("noTz", "All")
    curves["All"]["OwTrTO"][6] = 5.498
    lambda_force_figure(LAMBDAS, curves, workbench=WORKBENCH, chosen=("All", "OwTrTO", 1000.0))
    star = panels(drawn[0])[0].lines[-1]
    assert star.get_marker() == "*"
    assert star.get_xydata().tolist() == [[1000.0, 5.498]]
    assert legend_of(drawn[0])[-1] == "All, OwTrTO, lambda 1000: 5.498 N"


@pytest.mark.parametrize(("sets", "types"), [(MOST_HUES, 3), (3, 6)])
def test_a_few_data_sets_share_a_panel(sets: int, types: int, drawn: list[Figure]) -> None:
    """Up to six with up to twenty curves together."""
    curves = {name: dict(list(each.items())[:types]) for name, each in _curves(*map(str, range(sets))).items()}
    lambda_force_figure(LAMBDAS, curves, workbench=WORKBENCH)
    assert len(panels(drawn[0])) == 1


@pytest.mark.parametrize(("sets", "types"), [(4, 6), (MOST_HUES + 1, 2), (9, 6)])
def test_many_data_sets_have_panels_of_their_own(sets: int, types: int, drawn: list[Figure]) -> None:
    """Each with its name over it, all on the same scales."""
    names = [f"set {k}" for k in range(sets)]
    curves = {name: dict(list(each.items())[:types]) for name, each in _curves(*names).items()}
    lambda_force_figure(LAMBDAS, curves, workbench=WORKBENCH, chosen=(names[3], "SnTdTO", 0.0))
    shown = panels(drawn[0])
    assert [panel.get_title() for panel in shown] == names
    assert len({panel.get_ylim() for panel in shown}) == len({panel.get_xlim() for panel in shown}) == 1
    assert [len(panel.lines) for panel in shown] == [types + 1 + (k == 3) for k in range(sets)]
    # the lowest of every column has numbers and a label
    assert [bool(panel.get_xlabel()) for panel in shown] == [k >= sets - 3 for k in range(sets)]


def test_small_forces_beside_large_ones_are_told_apart(drawn: list[Figure]) -> None:
    """Over more than a decade the axis is logarithmic, with numbers as people write them; else it is linear."""
    curves = {"All": {"good": np.full(len(LAMBDAS), 0.15), "better": np.full(len(LAMBDAS), 0.13)}}
    lambda_force_figure(LAMBDAS, curves, workbench=17.0)
    lambda_force_figure(LAMBDAS, {"All": {"good": np.full(len(LAMBDAS), 9.0)}}, workbench=17.0)
    small, large = (panels(figure)[0] for figure in drawn)
    assert (small.get_yscale(), large.get_yscale()) == ("log", "linear")
    heights = small.transData.transform([[1.0, 0.13], [1.0, 0.15]])[:, 1]
    assert heights[1] - heights[0] > 8.0
    assert {"0.2", "1", "10"} <= {label.get_text() for label in small.get_yticklabels()}


def test_types_that_coincide_show_their_points_in_turn(drawn: list[Figure]) -> None:
    """One data set, two types with one result: one line, and the points of both."""
    same = np.linspace(6.0, 9.0, len(LAMBDAS))
    lambda_force_figure(LAMBDAS, {"noTz": {"a": same, "b": same}, "All": {"a": same + 2.0, "b": same + 3.0}})
    first, second, *others = panels(drawn[0])[0].lines
    assert (first.get_markevery(), second.get_markevery()) == ((0, 2), (1, 2))
    assert first.get_linestyle() != "None"
    assert second.get_linestyle() == "None"
    assert all(line.get_markevery() == (0, 1) for line in others)


def test_data_sets_may_lack_types_and_values(drawn: list[Figure]) -> None:
    """A type that one data set lacks, a curve of NaN: the rest is drawn."""
    missing = np.full(len(LAMBDAS), np.nan)
    lambda_force_figure(LAMBDAS, {"a": {"S": missing}, "b": {"O": missing + 1.0, "S": np.ones(len(LAMBDAS))}})
    assert legend_of(drawn[0]) == ["a", "b", "S", "O"]


def test_what_cannot_be_drawn_is_refused() -> None:
    """Nothing, a data set without types, a choice that is not there; the message lists what is."""
    curves = _curves("noTz", "All")
    with pytest.raises(ShapeError, match="curves: expected at least one data set"):
        lambda_force_figure(LAMBDAS, {})
    with pytest.raises(ShapeError, match=r"curves\['All'\]: expected at least one"):
        lambda_force_figure(LAMBDAS, {"All": {}})
    with pytest.raises(ShapeError, match=r"curves\['All'\]\['S'\]: expected an array of shape \(13\)"):
        lambda_force_figure(LAMBDAS, {"All": {"S": [1.0]}})
    with pytest.raises(ShapeError, match='no data set is called .*did you mean "All"'):
        lambda_force_figure(LAMBDAS, curves, chosen=("all", "SnTdTO", 0.0))
    with pytest.raises(ShapeError, match="no estimation type 'XnTdTO'"):
        lambda_force_figure(LAMBDAS, curves, chosen=("All", "XnTdTO", 0.0))
    with pytest.raises(ShapeError, match="expected one of the lambdas .* got 7.0"):
        lambda_force_figure(LAMBDAS, curves, chosen=("All", "SnTdTO", 7.0))
    with pytest.raises(ShapeError, match="workbench: expected a finite force"):
        lambda_force_figure(LAMBDAS, curves, workbench=np.nan)
    with pytest.raises(ShapeError, match="generative, best: expected a finite force"):
        lambda_force_figure(LAMBDAS, curves, generative=np.nan)
