# SPDX-License-Identifier: BSD-3-Clause
"""The figure of indices: a line for each number, the smallest on top, and what is not known is seen to be so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.figures.sphere import index_figure, sphere_figure
from forcetorque.evaluation.trials.trials import mean_of_trials
from forcetorque.results.figure_style import PAPER, look, png_bytes
from tests.report.drawing import legend_of, panels, recorded_figures, size_of, trial_groups, words


def _drawn(**options: object) -> Figure:
    with recorded_figures() as figures:
        index_figure(trial_groups(np.random.default_rng(1), **options))  # type: ignore[arg-type]
    (figure,) = figures
    return figure


def test_a_point_for_every_trial_mean_and_pooled_fit() -> None:
    """With the model three trials, their mean and the pooled fit, each where its index is."""
    groups = trial_groups(np.random.default_rng(1), sensors=1)
    with recorded_figures() as figures:
        index_figure(groups)
    panel = panels(figures[0])[0]
    points = {
        (str(line.get_marker()), round(float(np.asarray(line.get_xdata())[0]), 9))
        for line in panel.get_lines()
        if line.get_marker() in {look(k).marker for k in range(3)}
    }
    (group,) = groups
    mean, _, _ = mean_of_trials(group.identifiable_indices(with_model=True))
    pooled = group.pooled_fit(with_model=True)
    assert pooled is not None
    expected = {(look(1).marker, round(mean, 9)), (look(2).marker, round(pooled.index / 9.81, 9))}
    for trial in group.trials:
        fit = trial.fit(with_model=True)
        assert fit is not None
        expected.add((look(0).marker, round(fit.index / 9.81, 9)))
    assert points == expected
    assert len(points) == 5


@pytest.mark.long
def test_the_smallest_index_is_on_top_and_what_is_unknown_below() -> None:
    """Names from top to bottom follow the pooled index; the caps come last, hollow and named in the legend."""
    groups = trial_groups(np.random.default_rng(2), sensors=5, caps=2, with_model=False)
    with recorded_figures() as figures:
        index_figure(groups)
    (figure,) = figures
    names = [text.get_text() for text in panels(figure)[0].get_yticklabels()]
    index = {group.first.sphere.serial: group.index(with_model=False) for group in groups}
    known = sorted((value, name) for name, value in index.items() if value is not None)
    assert len(known) == 3
    assert names[:3] == [name for _, name in known]
    assert set(names[3:]) == {name for name, value in index.items() if value is None}
    assert legend_of(figure)[-1] == "not identifiable"
    faces = {line.get_markerfacecolor() for line in panels(figure)[-1].get_lines() if line.get_marker() == "o"}
    assert PAPER in faces
    assert "not identifiable" not in words(_drawn(sensors=1))


def test_a_panel_that_has_nothing_is_left_out() -> None:
    """Without any reference there is only the fit without the model."""
    with recorded_figures() as figures:
        index_figure(trial_groups(np.random.default_rng(3), sensors=1, with_model=False))
    (panel,) = panels(figures[0])
    assert "without the model" in panel.get_title(loc="left")


def test_files_of_one_name_have_their_folders_in_the_figures() -> None:
    """Deep below a folder that both have in common, which would push the difference out of a name of 60 letters."""
    (group,) = trial_groups(np.random.default_rng(5), sensors=1, trials=1)
    files = [f"/{'somewhere/' * 5}{folder}/leg.json" for folder in ("old", "new")]
    groups = [
        replace(group, trials=(replace(group.first, sphere=replace(group.first.sphere, calibration=file)),))
        for file in files
    ]
    with recorded_figures() as figures:
        index_figure(groups)
        sphere_figure([each.first.sphere for each in groups])
    labels = [text.get_text() for text in panels(figures[0])[0].get_yticklabels()]
    titles = [panel.get_title(loc="left") for panel in panels(figures[1])[::3]]
    for names in (labels, titles):
        assert len(set(names)) == 2


@pytest.mark.long
def test_two_hundred_sensors_have_a_line_each() -> None:
    """Every name is there in letters of full size, one below the other, with the axis at both ends."""
    few = trial_groups(np.random.default_rng(4), sensors=2, trials=1)
    many = [few[k % 2] for k in range(200)]
    with recorded_figures() as figures:
        png = png_bytes(index_figure(many))
    width, height = size_of(png)
    assert width == 1200
    assert 3000 < height < 5000
    labels = panels(figures[0])[0].get_yticklabels()
    assert len(labels) == 200
    boxes = [label.get_window_extent() for label in labels]
    tops = sorted((box.y0, box.y1) for box in boxes)
    assert all(lower[1] <= upper[0] + 2.0 for lower, upper in zip(tops[:-1], tops[1:], strict=True))
    assert all(tick.label2.get_visible() for tick in panels(figures[0])[0].xaxis.get_major_ticks())


def test_nothing_to_draw_is_refused() -> None:
    """There is no empty figure."""
    with pytest.raises(ShapeError, match="expected at least one group to draw"):
        index_figure([])
