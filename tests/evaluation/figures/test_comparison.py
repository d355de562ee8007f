# SPDX-License-Identifier: BSD-3-Clause
"""Measured against reference: six components, a reference that nothing hides, and how far they differ."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.figures.errors_and_matrices import comparison_figure
from forcetorque.results.figure_style import REFERENCE_COLOUR, look, png_bytes
from tests.cases import some_cases
from tests.report.drawing import count_of, legend_of, panels, pixels

COUNT = 500
TIME = np.arange(COUNT) * 0.01
REFERENCE = np.column_stack([np.sin((k + 1.0) * TIME) for k in range(6)])


def test_six_panels_with_their_components(drawn: list[Figure]) -> None:
    """Forces on the left, torques on the right; in each the reference and the candidates are those of its label."""
    measured = REFERENCE + 1.0
    comparison_figure(TIME, REFERENCE, {"ex situ": measured})
    shown = {panel.get_ylabel(): panel for panel in panels(drawn[0])}
    assert list(shown) == ["fx, N", "tx, N m", "fy, N", "ty, N m", "fz, N", "tz, N m"]
    for k, name in enumerate(("fx, N", "fy, N", "fz, N", "tx, N m", "ty, N m", "tz, N m")):
        reference, candidate = shown[name].lines
        np.testing.assert_array_equal(reference.get_ydata()[:-1], REFERENCE[:, k])
        np.testing.assert_array_equal(candidate.get_ydata()[:-1], measured[:, k])
        assert reference.get_color() == REFERENCE_COLOUR
    assert [panel.get_xlabel() for panel in panels(drawn[0])] == [""] * 4 + ["time, s"] * 2


def test_the_legend_states_the_difference(drawn: list[Figure]) -> None:
    """By hand: (3, 4, 0) N in half of the samples is 5 / sqrt(2) N; 0.1 N m throughout."""
    measured = REFERENCE.copy()
    measured[: COUNT // 2, :3] += [3.0, 4.0, 0.0]
    measured[:, 4] -= 0.1
    comparison_figure(TIME, REFERENCE, {"ex situ": measured, "in situ": REFERENCE})
    assert legend_of(drawn[0]) == [
        "reference",
        "ex situ: rms difference 3.54 N, 0.1 N m",
        "in situ: rms difference 0 N, 0 N m",
    ]


def test_the_title_names_what_errs_least_in_force_and_in_moment(drawn: list[Figure]) -> None:
    """By hand, for one calibration, for two that are each better in one, and where a component is always absent."""
    force, moment = (REFERENCE + np.eye(6)[k] * size for k, size in ((0, 2.0), (5, 0.5)))
    comparison_figure(TIME, REFERENCE, {"ex situ": force})
    comparison_figure(TIME, REFERENCE, {"ex situ": force, "in situ": moment})
    comparison_figure(TIME, REFERENCE, {"ex situ": np.where(np.arange(6) == 1, np.nan, force)})
    assert [figure.get_suptitle() for figure in drawn] == [
        "RMS error: force 2 N, moment 0 N m",
        "Least RMS error: force 0 N (in situ), moment 0 N m (ex situ)",
        "No sample has all six components",
    ]


@pytest.mark.long
def test_agreement_hides_neither() -> None:
    """A candidate equal to the reference is seen between its dashes, and the reference is not covered."""
    image = pixels(comparison_figure(TIME, REFERENCE, {"in situ": REFERENCE.copy()}))
    inside = image[:700, 80:580]
    # bluish somewhere in about every other column of the first panel, not only where its few points are
    assert look(0).colour == "#0072B2"
    bluish = inside[:220, :, 2] - inside[:220, :, 0] > 90
    assert bluish.any(axis=0).sum() > 200
    bare = pixels(comparison_figure(TIME, REFERENCE, {"in situ": np.full((COUNT, 6), np.nan)}))[:700, 80:580]
    assert count_of(inside, REFERENCE_COLOUR) > 0.8 * count_of(bare, REFERENCE_COLOUR)


def test_noise_does_not_hide_the_reference() -> None:
    """Under noise of many times its line it is still dashed in black."""
    noisy = REFERENCE + np.random.default_rng(1).normal(size=(COUNT, 6))
    panel = pixels(comparison_figure(TIME, REFERENCE, {"noisy": noisy}))[20:220, 100:560]
    assert count_of(panel, REFERENCE_COLOUR) > 150


def test_every_peak_of_a_long_recording_stays(drawn: list[Figure]) -> None:
    """One sample among half a million, in the reference and in a candidate."""
    count = 500_000
    reference, measured = np.zeros((count, 6)), np.zeros((count, 6))
    reference[77_777, 5], measured[123_457, 0] = 3.0, -80.0
    comparison_figure(np.arange(count) * 0.001, reference, {"a": measured})
    first, last = panels(drawn[0])[0], panels(drawn[0])[-1]
    assert np.nanmin(first.lines[1].get_ydata()) == -80.0
    assert np.nanmax(last.lines[0].get_ydata()) == 3.0
    assert len(first.lines[1].get_ydata()) < 2100


def test_missing_values_break_lines_and_count_in_no_difference(drawn: list[Figure]) -> None:
    """Of a candidate, and of the reference; without a common sample there is no difference to state."""
    reference, measured = REFERENCE.copy(), REFERENCE + [3.0, 0.0, 4.0, 0.0, 0.0, 1.0]
    reference[:100], measured[200:300, 0] = np.nan, np.inf
    comparison_figure(TIME, reference, {"a": measured, "b": np.full((COUNT, 6), np.nan)})
    assert legend_of(drawn[0])[1:] == ["a: rms difference 5 N, 1 N m", "b: no samples"]
    lines = panels(drawn[0])[0].lines
    assert np.count_nonzero(np.isnan(lines[0].get_ydata()[:COUNT])) == 100
    assert np.count_nonzero(np.isnan(lines[1].get_ydata()[:COUNT])) == 100


@some_cases("count", [1, 2])
def test_a_few_samples_are_drawn(count: int) -> None:
    """The shortest recordings make a figure too."""
    assert png_bytes(comparison_figure(TIME[:count], REFERENCE[:count], {"a": REFERENCE[:count]}))[:4] == b"\x89PNG"


def test_what_cannot_be_drawn_is_refused() -> None:
    """Nothing to compare, another number of samples, forces alone, time that falls."""
    with pytest.raises(ShapeError, match="candidates: expected at least one"):
        comparison_figure(TIME, REFERENCE, {})
    with pytest.raises(ShapeError, match=r"reference: expected an array of shape \(500, 6\), got \(499, 6\)"):
        comparison_figure(TIME, REFERENCE[1:], {"a": REFERENCE})
    with pytest.raises(ShapeError, match=r"candidates\['a'\]: expected an array of shape \(500, 6\), got \(500, 3\)"):
        comparison_figure(TIME, REFERENCE, {"a": REFERENCE[:, :3]})
    with pytest.raises(ShapeError, match="time_s: expected finite instants"):
        comparison_figure(-TIME, REFERENCE, {"a": REFERENCE})
