# SPDX-License-Identifier: BSD-3-Clause
"""Residuals: every sample in a bin, outliers at the edges and said, correlation over lag with its effective number."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import StepPatch

from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.evaluation.figures.errors_and_matrices import bin_edges, residual_figure, thinned_lags
from forcetorque.results.figure_style import looks
from tests.report.drawing import legend_of, panels, words

COUNT = 2000
TIME = 0.01 * np.arange(COUNT)


def _white(seed: int, count: int = COUNT) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(count, 6))


def _steps(figure: Figure, panel: int) -> list[StepPatch]:
    return [patch for patch in panels(figure)[panel].patches if isinstance(patch, StepPatch)]


def test_every_sample_is_in_a_bin_that_all_candidates_share(drawn: list[Figure]) -> None:
    """The shares add up to all samples, outliers and those at the edges too, over the same edges."""
    prior = 3.0 * _white(1) + 2.0
    prior[:7, 0] = 500.0
    residual_figure(TIME, {"prior": prior, "new": _white(2)})
    for panel in (0, 2, 4, 6, 8, 10):
        first, second = (steps.get_data() for steps in _steps(drawn[0], panel))
        np.testing.assert_array_equal(first.edges, second.edges)
        assert first.values.sum() == pytest.approx(100.0)
        assert second.values.sum() == pytest.approx(100.0)
    edge = _steps(drawn[0], 0)[0].get_data()
    assert edge.edges[-1] < 50.0
    assert edge.values[-1] >= 100.0 * 7 / COUNT


def test_what_lies_beyond_the_edges_is_said(drawn: list[Figure]) -> None:
    """By panel, of all candidates together."""
    prior = np.tile(np.linspace(-1.0, 1.0, COUNT)[:, None], 6)
    prior[:5, 1], prior[5:8, 1] = 90.0, -90.0
    residual_figure(TIME, {"prior": prior, "new": 0.5 * prior[::-1].copy() * (np.abs(prior[::-1]) < 2.0)})
    titles = [panels(drawn[0])[k].get_title() for k in (0, 4, 8)]
    assert titles == ["none beyond the edges", f"8 of {2 * COUNT} beyond the edges", "none beyond the edges"]


def test_edges_by_hand() -> None:
    """Quartiles 2 and 6 of 0 to 8 let through up to 18: neither range nor one far value moves the edges further."""
    values = np.arange(9.0)
    np.testing.assert_array_equal(bin_edges([values])[[0, -1]], [0.0, 8.0])
    np.testing.assert_array_equal(bin_edges([np.append(values, [1e6] * 2)])[[0, -1]], [0.0, 22.5])
    np.testing.assert_array_equal(bin_edges([values, values + 100.0])[[0, -1]], [0.0, 108.0])
    # no scale among equal values: all are shown
    np.testing.assert_array_equal(bin_edges([np.array([1.0] * 9 + [5.0])])[[0, -1]], [1.0, 5.0])
    assert bin_edges([np.zeros(5)])[0] < 0.0 < bin_edges([np.zeros(5)])[-1]


def test_the_legend_says_size_and_worth(drawn: list[Figure]) -> None:
    """Root mean square by hand, and the numbers of `autocorrelation` for each component."""
    values = np.zeros((COUNT, 6))
    values[:, 0], values[:, 5] = 3.0 * (-1.0) ** np.arange(COUNT), np.cumsum(_white(3)[:, 0])
    residual_figure(TIME, {"new": values, "white": _white(4)})
    slow = autocorrelation(values[:, 5], TIME).effective_count
    assert 1.0 < slow < 9.95
    torque = np.sqrt((values[:, 5] ** 2).mean())
    first, second, band = legend_of(drawn[0])
    assert first == (f"new: rms 3 N, {torque:.3g} N m, n 2000, n_eff fx 2000, fy –, fz –, tx –, ty –, tz {slow:.1f}")
    assert second.startswith("white: rms ")
    assert "95 %" in band


def test_the_curves_are_those_of_the_autocorrelation(drawn: list[Figure]) -> None:
    """Where no lag is left out point by point; the looks tell candidates apart; the band is that of white noise."""
    values, few = _white(5, 60), 0.01 * np.arange(60)
    residual_figure(few, {"prior": values, "new": values[::-1] ** 2})
    found = autocorrelation(values[:, 3], few)
    panel = panels(drawn[0])[3]
    assert "tx" in panel.get_title()
    assert panel.get_xscale() == "log"
    _, prior, new = panel.lines
    np.testing.assert_allclose(prior.get_xdata()[::2], found.lag_s[1:])
    np.testing.assert_allclose(prior.get_ydata()[::2], found.rho[1:])
    styles = looks(["prior", "new"])
    assert [(line.get_color(), line.get_marker()) for line in (prior, new)] == [
        (styles[name].colour, styles[name].marker) for name in ("prior", "new")
    ]
    (band,) = (each for each in panel.collections if isinstance(each, PolyCollection))
    assert band.get_paths()[0].get_extents().y1 == pytest.approx(found.white_band.max())


def test_thinning_keeps_peaks() -> None:
    """A single lag that stands out among 100 000 is drawn at its height."""
    rho = np.zeros(100_000)
    rho[77_777], rho[3] = 0.9, -0.4
    lag, drawn = thinned_lags(0.01 * np.arange(len(rho)), rho)
    assert len(lag) < 700
    assert (drawn.max(), drawn.min()) == (0.9, -0.4)
    assert lag[drawn.argmin()] == pytest.approx(0.03)
    assert (np.diff(lag) >= 0.0).all()


def test_pauses_are_not_bridged(drawn: list[Figure]) -> None:
    """With one in the middle, other pairs are correlated than without."""
    values = _white(6)
    for time in (TIME, TIME + 5.0 * (np.arange(COUNT) > COUNT // 2)):
        residual_figure(time, {"new": np.cumsum(values, axis=0)})
    without, paused = (panels(figure)[1].lines[1].get_xdata().max() for figure in drawn)
    assert paused < 0.8 * without


@pytest.mark.long
@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_samples_are_drawn(count: int, drawn: list[Figure]) -> None:
    """A single one has no autocorrelation and says so."""
    residual_figure(TIME[:count], {"new": _white(7, count)})
    assert ("n_eff fx –" in words(drawn[0])) == (count == 1)


def test_missing_values_are_left_out(drawn: list[Figure]) -> None:
    """What is no number is in no bin, no pair and no root mean square; the caller's arrays stay as they are."""
    values = _white(8)
    values[100:150, 2] = np.nan
    kept = values.copy()
    residual_figure(TIME, {"new": values})
    np.testing.assert_array_equal(values, kept)
    rest = np.delete(values, slice(100, 150), axis=0)
    force = np.sqrt((rest[:, :3] ** 2).sum(axis=1).mean())
    assert f"rms {force:.3g} N" in legend_of(drawn[0])[0]
    assert _steps(drawn[0], 8)[0].get_data().values.sum() == pytest.approx(100.0)


def test_bad_input_is_refused() -> None:
    """No candidates, another shape, time that falls or stands, a component without a number."""
    with pytest.raises(ShapeError, match="residuals: expected at least one name"):
        residual_figure(TIME, {})
    with pytest.raises(ShapeError, match=r"residuals\['new'\]: expected an array of shape \(2000, 6\)"):
        residual_figure(TIME, {"new": _white(1)[:, :3]})
    with pytest.raises(ShapeError, match="time_s: expected finite instants that do not fall"):
        residual_figure(-TIME, {"new": _white(1)})
    with pytest.raises(ShapeError, match="time_s: expected instants that pass"):
        residual_figure(0.0 * TIME, {"new": _white(1)})
    values = _white(1)
    values[:, 4] = np.inf
    with pytest.raises(ShapeError, match=r"residuals\['new'\]: expected residuals of ty, got no finite number"):
        residual_figure(TIME, {"new": values})
