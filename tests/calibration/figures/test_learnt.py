# SPDX-License-Identifier: BSD-3-Clause
"""What was learnt: shares and errors of every direction at their places, and little told apart from much."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.figures.information import learnt_figure
from forcetorque.calibration.summary import InformationGain
from forcetorque.results.figure_style import look
from tests.report.drawing import learnt_of, legend_of, panels

SHARES = (0.97, 0.5, 0.04, 0.9, 0.9, 0.0)


def _directions(*shares: float, after: float | None = None) -> list[InformationGain]:
    """Before the recordings 0.04 N per unit, and 0.002 N m; after them the share less."""
    return [
        InformationGain(
            direction=name,
            force_error_before_N=0.04,
            force_error_after_N=0.04 * (1.0 - share) + 0.0002 if after is None else after,
            moment_error_before_Nm=0.002,
            moment_error_after_Nm=0.002 * (1.0 - share) + 0.00001,
            uncertainty_reduction=share,
        )
        for name, share in zip(WRENCH_COMPONENTS, shares, strict=True)
    ]


def _points(panel: Axes, marker: str | None = None) -> list[tuple[float, float]]:
    lines = [line for line in panel.lines if len(line.get_xdata()) == 1]
    return [tuple(line.get_xydata()[0]) for line in lines if marker is None or line.get_marker() == marker]


def _numbers(panel: Axes) -> list[str]:
    return [text.get_text() for text in panel.texts]


def test_shares_and_errors_lie_at_their_values_in_the_unit_of_their_axis(drawn: list[Figure]) -> None:
    """Forces as loads above moments; before is a hollow square, and both numbers are written."""
    learnt_figure({"leg": _directions(*SHARES)})
    share, force, moment, turned, *_ = panels(drawn[0])
    np.testing.assert_allclose(_points(share), [[97.0, 0.0], [50.0, 1.0], [4.0, 2.0]])
    assert (_numbers(share), _numbers(turned)) == (["97 %", "50 %", "4 %"], ["90 %", "90 %", "0 %"])
    assert force.get_xlabel() == "force error, % of the force"
    np.testing.assert_allclose(_points(force, "s"), [[4.0, row] for row in range(3)])
    np.testing.assert_allclose(_points(force, "o"), [[0.14, 0.0], [2.02, 1.0]])
    assert _numbers(force) == ["0.14", "4.0", "2.0", "4.0", "3.9", "4.0"]
    assert moment.get_xlabel() == "moment error, N m per 1000 N"
    np.testing.assert_allclose(_points(moment, "s"), [[2.0, row] for row in range(3)])
    assert [panel.get_xlabel() for panel in panels(drawn[0])[4:]] == [
        "force error, N per N m",
        "moment error, % of the moment",
    ]
    assert [panel.get_xscale() for panel in panels(drawn[0])] == ["linear", "log", "log"] * 2
    assert share.get_ylim() == force.get_ylim() == (2.5, -0.5)


def test_what_was_hardly_learnt_differs_in_colour_marker_and_line(drawn: list[Figure]) -> None:
    """Less than half; half is enough. The legend says which."""
    learnt_figure({"leg": _directions(*SHARES)})
    for panel in panels(drawn[0])[:3]:
        after = [line for line in panel.lines if len(line.get_xdata()) == 1 and line.get_marker() != "s"]
        assert [line.get_marker() for line in after] == ["o", "o", "X"]
        assert [line.get_color() for line in after] == [look(k).colour for k in (0, 0, 1)]
        stems = [line for line in panel.lines if len(line.get_xdata()) == 2 and line.get_color() != "#000000"]
        assert [line.get_linestyle() for line in stems] == ["-", "-", ":"]
    assert legend_of(drawn[0])[2] == "after, where less than half is gained: the prior decides"


def test_numbers_stand_outside_of_their_points_where_the_error_grew_too(drawn: list[Figure]) -> None:
    """What the sensor does not repeat can be more than a narrow prior: the greater number is on the right."""
    sides = []
    for after in (0.01, 0.09):
        learnt_figure({"leg": _directions(*SHARES, after=after)})
        sides.append([text.get_ha() for text in panels(drawn[-1])[1].texts[:2]])
    assert sides == [["right", "left"], ["left", "right"]]


def test_calibrations_share_the_axes_of_errors(drawn: list[Figure]) -> None:
    """Two rows each, named, in the order given: the same place is the same error."""
    learnt_figure({"one": _directions(*SHARES), "ten": _directions(*[0.99] * 6)})
    titles = [panel.get_title(loc="left") for panel in panels(drawn[0])[::3]]
    assert titles == ["one", "", "ten", ""]
    for k in (1, 2, 4, 5):
        assert panels(drawn[0])[k].get_xlim() == panels(drawn[0])[k + 6].get_xlim()


def test_an_error_of_zero_does_not_break_the_axis(drawn: list[Figure]) -> None:
    """Without any error above zero there is still an axis."""
    learnt_figure({"leg": [row.model_copy(update={"force_error_before_N": 0.0, "force_error_after_N": 0.0})
                           for row in _directions(*SHARES)]})  # fmt: skip
    low, high = panels(drawn[0])[1].get_xlim()
    assert 0.0 < low < high


def test_other_directions_are_refused() -> None:
    """No calibration, or not the six components."""
    with pytest.raises(ShapeError, match="learnt: expected at least one calibration to draw, got none"):
        learnt_figure({})
    rows = learnt_of(np.random.default_rng(1))
    with pytest.raises(ShapeError, match=r"learnt\['leg'\]: expected the directions fx fy fz tx ty tz, got fx fy"):
        learnt_figure({"leg": rows[:2]})
