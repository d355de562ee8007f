# SPDX-License-Identifier: BSD-3-Clause
"""Errors at the loads of use: intervals at their places, what is allowed, and too much told apart from enough."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.evaluation import Evaluation
from forcetorque.evaluation.figures.load_cases import use_figure
from forcetorque.results.figure_style import look
from tests.report.drawing import legend_of, panels, use_of

NAMES = {"leg.json": "leg.json", "new.json": "new.json"}


def _marks(panel: Axes) -> list[tuple[str, float]]:
    lines = [line for line in panel.lines if len(line.get_xdata()) == 1]
    return [(str(line.get_marker()), float(line.get_xdata()[0])) for line in lines]


def _intervals(panel: Axes) -> list[list[float]]:
    level = [line for line in panel.lines if len(line.get_xdata()) == 2 and len(set(line.get_ydata())) == 1]
    return [[float(value) for value in line.get_xdata()] for line in level]


def test_intervals_and_medians_lie_at_their_values(drawn: list[Figure]) -> None:
    """Before and after, force left and moment right, on logarithmic axes; the words have the numbers."""
    use_figure([use_of(force=4.0, before=20.0, allowed=8.0)], NAMES)
    force, moment = panels(drawn[0])
    assert _marks(force) == [("s", 20.0), ("o", 4.0)]
    assert _intervals(force) == [[10.0, 40.0], [2.0, 8.0]]
    np.testing.assert_allclose([value for _, value in _marks(moment)], [0.2, 0.04])
    texts = [text.get_text() for text in force.texts]
    assert texts == ["before 20 N (95 %: 40)", "after 4.0 N (95 %: 8.0)", "8.0 N allowed"]
    assert [panel.get_xscale() for panel in (force, moment)] == ["log", "log"]
    assert [panel.get_title(loc="left") for panel in (force, moment)] == ["force error, N", "moment error, N m"]


def test_what_was_measured_is_a_mark_of_its_own(drawn: list[Figure]) -> None:
    """At its value, also far outside the interval; named in the legend."""
    use_figure([use_of(force=4.0, measured=90.0)], NAMES)
    for panel, value in zip(panels(drawn[0]), (90.0, 0.9), strict=True):
        assert dict(_marks(panel))["D"] == pytest.approx(value)
        assert panel.get_xlim()[0] < value < panel.get_xlim()[1]
    assert "measured on other data" in legend_of(drawn[0])


def test_what_may_be_too_much_differs_in_colour_marker_and_line(drawn: list[Figure]) -> None:
    """Up to the limit is enough; a hair above it is not. The legend names what is drawn, and nothing else."""
    for allowed in (8.0, 7.99):
        use_figure([use_of(force=4.0, allowed=allowed)], NAMES)
    looks = []
    for figure in drawn:
        panel = panels(figure)[0]
        stem = [line for line in panel.lines if len(line.get_xdata()) == 2 and len(set(line.get_ydata())) == 1][1]
        looks.append((_marks(panel)[1][0], stem.get_color(), stem.get_linestyle()))
    assert looks == [("o", look(0).colour, "-"), ("X", look(1).colour, "--")]
    assert [legend_of(figure)[1] for figure in drawn] == ["after: calibration", "after, perhaps too much"]


def test_the_title_follows_the_verdict(drawn: list[Figure]) -> None:
    """Measured errors beyond what is allowed, and a verdict against a use, come before good predictions."""
    use_figure([use_of(measured=7.9)], NAMES)
    use_figure([use_of(), use_of("new.json", measured=8.1)], NAMES)
    use_figure([use_of(measured=8.1, decision="do not use")], NAMES)
    use_figure([use_of(allowed=None, decision="do not use")], NAMES)
    kept = "{} predictions stay within what is allowed, with 95 %"
    assert [figure.get_suptitle().replace("\n", " ") for figure in drawn] == [
        kept.format("1 of 1"),
        f"Measured errors of 1 of 2 are beyond what is allowed. {kept.format('2 of 2')}",
        f"Do not use for 1 of 1. Measured errors of 1 of 1 are beyond what is allowed. {kept.format('1 of 1')}",
        "Do not use for 1 of 1. Largest predicted force error: at most 8.0 N",
    ]


def test_a_use_that_judges_nothing_and_a_calibration_without_prior_are_drawn(drawn: list[Figure]) -> None:
    """No limit, no grey, no line before; the legend does not speak of them."""
    use_figure([use_of(before=None, allowed=None)], NAMES)
    panel = panels(drawn[0])[0]
    assert _marks(panel) == [("o", 4.0)]
    assert len(panel.collections) == 0
    assert legend_of(drawn[0]) == ["after: calibration"]


def test_rows_are_named_by_calibration_and_use_and_share_the_axis(drawn: list[Figure]) -> None:
    """In the order given, the first on top."""
    use_figure([use_of(), use_of("new.json", "tool", force=0.01)], NAMES)
    force, _ = panels(drawn[0])
    assert [label.get_text() for label in force.get_yticklabels()] == ["leg.json\npush", "new.json\ntool"]
    bottom, top = force.get_ylim()
    assert bottom > top


@pytest.mark.long
def test_words_stay_inside_their_panel(drawn: list[Figure]) -> None:
    """However far apart the errors are."""
    for scale in (1.0, 1e-3, 1e3):
        use_figure([use_of(force=4.0, before=20.0), use_of(force=4.0 * scale, before=20.0 * scale)], NAMES)
    for figure in drawn:
        figure.draw_without_rendering()  # which places texts and panels
        renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
        for panel in panels(figure):
            frame = panel.get_window_extent(renderer)
            for text in panel.texts:
                extent = text.get_window_extent(renderer)
                assert frame.x0 <= extent.x0, text.get_text()
                assert extent.x1 <= frame.x1, text.get_text()


def test_verdicts_that_predict_nothing_are_refused() -> None:
    """None at all, or one without errors."""
    for verdicts in ([], [use_of().model_copy(update={"errors": ()})]):
        with pytest.raises(ShapeError, match="uses: expected at least one verdict, each with predicted errors"):
            use_figure(verdicts, NAMES)


def test_an_evaluation_draws_its_verdicts(drawn: list[Figure]) -> None:
    """A row per verdict with a predicted error; sensors of other quantities, and none at all, are refused."""
    use = use_of(force=4.0, before=20.0)
    evaluation = Evaluation(experiment="walk", verdicts=(), load_cases=(use, use.model_copy(update={"errors": ()})))
    assert evaluation.predicted == (use,)
    use_figure(evaluation.predicted, NAMES)
    assert len(panels(drawn[0])[0].get_yticks()) == 1
    force_alone = use.model_copy(update={"errors": use.errors[:1]})
    for cases, message in (((), "there is none to draw"), ((use, force_alone), "some of force alone")):
        with pytest.raises(ShapeError, match=message):
            evaluation.model_copy(update={"load_cases": cases}).figure()
