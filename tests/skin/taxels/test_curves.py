# SPDX-License-Identifier: BSD-3-Clause
"""Curves of taxels: what each form holds to, and that it finds a truth of its own form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.interpolate import BPoly
from scipy.optimize import least_squares

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.skin.taxels.curve_comparison import HeldOutErrors, calibrated_taxel
from forcetorque.skin.taxels.taxel_curve import CurveKind, _capacitor, _logarithmic, _slope, fit_curve

FALL = np.arange(0.0, 61.0)
EXACT = 1e-6
"""Share of the largest pressure: a truth of the form itself is found to the rounding of the fit."""
TABLE = np.arange(256.0)


@pytest.mark.parametrize(
    ("kind", "truth"),
    [
        (CurveKind.MONOTONE, 5e3 * FALL + 30.0 * FALL**2),
        (CurveKind.LINE, 4e3 * FALL - 2e3),
        (CurveKind.POLYNOMIAL, 3e3 * FALL - 50.0 * FALL**2 + 2.0 * FALL**3 - 1e-3 * FALL**4 + 1e-5 * FALL**5),
        (CurveKind.CAPACITOR, 6e3 * FALL / (1.0 + 0.004 * FALL)),
        (CurveKind.LOGARITHMIC, 2e4 * np.expm1(0.03 * FALL)),
        (CurveKind.LOGARITHMIC, 5e3 * FALL),
    ],
)
def test_a_truth_of_its_form_is_found(kind: CurveKind, truth: np.ndarray) -> None:
    """Inside the range; a mean over repeated levels is the same fit."""
    curve = fit_curve(kind, FALL, truth, range_counts=60.0)
    assert np.abs(curve.pressure(FALL) - truth).max() < EXACT * truth.max()
    order = np.random.default_rng(4).permutation(3 * len(FALL))
    again = fit_curve(kind, np.tile(FALL, 3)[order], np.tile(truth, 3)[order], range_counts=60.0)
    np.testing.assert_allclose(again.coefficients, curve.coefficients, rtol=1e-6, atol=1e-6 * truth.max())


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_the_slope_beyond_the_range_is_that_of_the_weighted_line(unit: float) -> None:
    """As a regression has it, in any unit of the weights; a line that falls is all but level."""
    rng = np.random.default_rng(5)
    share, weight = rng.uniform(0.0, 1.2, 40), unit * rng.uniform(0.1, 3.0, 40)
    pressure = 5e4 * share + 2e4 * share**2 + 1e3 * rng.normal(size=40)
    assert _slope(share, pressure, weight) == pytest.approx(np.polyfit(share, pressure, 1, w=weight)[0], rel=1e-9)
    assert 0.0 < _slope(share, -pressure, weight) < 1e-300


@given(st.integers(0, 2**32 - 1))
def test_the_default_rises_everywhere(seed: int) -> None:
    """Whatever it is fitted to: from rest to 255 counts, 0 above rest, and as a straight line beyond the range."""
    rng = np.random.default_rng(seed)
    fall = np.rint(rng.uniform(-3.0, rng.uniform(10.0, 80.0), 200))
    pressure = np.cumsum(rng.normal(1e3, 5e3, 200))[np.argsort(np.argsort(fall))] + rng.normal(0.0, 1e4, 200)
    curve = fit_curve(CurveKind.MONOTONE, fall, pressure, range_counts=float(fall.max()) - 2.0)
    value = curve.pressure(TABLE)
    assert (np.diff(value) >= 0.0).all()
    assert value[0] == 0.0
    assert not curve.pressure(np.array([-0.5, -7.0])).any()
    beyond = np.diff(value[curve.range_counts + 1.0 < TABLE])
    assert np.ptp(beyond) <= 1e-9 * value.max()


def test_the_fifth_order_says_nothing_beyond_its_range() -> None:
    """Negative control: on the same noisy samples it falls, and the default does not."""
    rng = np.random.default_rng(8)
    truth = 8e3 * FALL
    fall = np.rint(np.tile(FALL, 20) + rng.normal(0.0, 1.0, 61 * 20))
    pressure = np.tile(truth, 20) + rng.normal(0.0, 4e3, 61 * 20)
    printed, default = (
        fit_curve(kind, fall, pressure, range_counts=60.0).pressure(TABLE)
        for kind in (CurveKind.POLYNOMIAL, CurveKind.MONOTONE)
    )
    assert np.abs(printed - 8e3 * TABLE).max() > 10.0 * np.abs(default - 8e3 * TABLE).max()
    assert (np.diff(printed) < 0.0).any()


def test_too_few_levels_are_refused() -> None:
    """Five levels do not determine six coefficients."""
    with pytest.raises(
        FitError, match="at 6 levels or more to fit a curve to, got 5: .*; let the interval hold all of it"
    ):
        fit_curve(CurveKind.POLYNOMIAL, FALL[:5], FALL[:5], range_counts=5.0)
    with pytest.raises(FitError, match="expected a fall above 0 counts, got -3"):
        fit_curve(CurveKind.LINE, FALL, FALL, range_counts=-3.0)


def test_hysteresis_and_error_are_told_apart() -> None:
    """A lag of 2 counts while unloading is found as such, and leaves nothing to the error of a fit to loading."""
    pressure = np.concatenate([np.linspace(0.0, 1e5, 4000), np.linspace(1e5, 0.0, 4000)])
    unloading = np.arange(8000) >= 4000
    fall = pressure / 2e3 + np.where(unloading, 2.0, 0.0)
    curve = fit_curve(CurveKind.LINE, fall[:4000], pressure[:4000], range_counts=50.0)
    response = calibrated_taxel(0, curve, fall, pressure, unloading)
    assert response.hysteresis_pa == pytest.approx(4e3, rel=1e-6)
    assert response.hysteresis_share == pytest.approx(2.0 / 50.0, rel=1e-6)
    assert response.error_pa < EXACT * 1e5
    assert response.rmse_pa == pytest.approx(4e3 / np.sqrt(2.0), rel=1e-3)


@pytest.mark.parametrize("form", [_capacitor, _logarithmic])
@pytest.mark.parametrize("q", [0.0, 5e-5, 0.02, 0.8, 5.0])
def test_forms_change_with_their_curvature_as_differences_say(
    form: Callable[[FloatArray, float], tuple[FloatArray, FloatArray]], q: float
) -> None:
    """Central ones; at rest a form has the slope 1, whatever its curvature, and none is bent at 0."""
    u = np.linspace(0.0, 1.5, 16)
    step = 1e-5
    above, below = (form(u, q + side * step)[0] for side in (1.0, -1.0))
    # a capacitor and the first terms of an exponential go on below 0
    np.testing.assert_allclose(form(u, q)[1], (above - below) / (2.0 * step), rtol=1e-5, atol=1e-8)
    assert form(np.array([1e-7]), q)[0] == pytest.approx(1e-7, rel=1e-5)
    np.testing.assert_allclose(form(u, 0.0)[0], u, rtol=1e-12)


def test_the_exponential_goes_on_where_it_is_written_by_its_first_terms() -> None:
    """On both sides of the least curvature they are the same to what the next term makes, a part in 1e9."""
    u = np.linspace(0.0, 2.0, 9)
    for part in range(2):
        below, above = (_logarithmic(u, q)[part] for q in (1e-4 * (1.0 - 1e-9), 1e-4 * (1.0 + 1e-9)))
        np.testing.assert_allclose(below, above, rtol=2e-8)


def test_the_default_is_a_curve_of_bernstein_and_then_a_line() -> None:
    """By scipy's Bernstein polynomials with a first coefficient of 0; beyond the range by the slope of all samples."""
    rng = np.random.default_rng(5)
    fall = np.rint(rng.uniform(0.0, 66.0, 900))
    pressure = 5e3 * fall + 20.0 * fall**2 + 2e3 * rng.normal(size=900)
    curve = fit_curve(CurveKind.MONOTONE, fall, pressure, range_counts=60.0)
    inside = np.linspace(0.0, 60.0, 13)
    printed = BPoly(np.array([0.0, *curve.coefficients[:5]])[:, None], [0.0, 60.0])
    np.testing.assert_allclose(curve.pressure(inside), printed(inside), rtol=1e-9, atol=1e-6)
    slope = np.polyfit(fall, pressure, 1)[0]
    beyond = curve.pressure(np.array([60.0, 61.0, 70.0]))
    np.testing.assert_allclose((beyond[1:] - beyond[0]) / [1.0, 10.0], slope, rtol=1e-9)

    # no other curve of this kind is nearer: along each coefficient the sum of squares rises
    def cost(change: FloatArray) -> float:
        coefficients = np.concatenate(
            [np.cumsum(np.diff([0.0, *curve.coefficients[:5]]) + change), curve.coefficients[5:]]
        )
        return float(((replace(curve, coefficients=coefficients).pressure(fall) - pressure) ** 2).mean())

    assert (np.diff([0.0, *curve.coefficients[:5]]) > 1e-2 * slope * 60.0 / 5.0).all()  # none is held at its least
    for change in np.eye(5):
        ends = [cost(side * 50.0 * change) for side in (-1.0, 0.0, 1.0)]
        assert ends[1] < min(ends[0], ends[2])
        assert abs(ends[2] - ends[0]) < 0.02 * (ends[0] + ends[2] - 2.0 * ends[1])


def test_a_curve_that_would_fall_rises_by_the_least_share() -> None:
    """Each coefficient by a thousandth of what a straight line rises from one to the next."""
    fall = np.tile(np.arange(61.0), 3)
    falling = np.where(fall < 20.0, 1e4 * fall, 2e5 - 10.0 * (fall - 20.0)) + 1e3 * fall
    curve = fit_curve(CurveKind.MONOTONE, fall, falling, range_counts=60.0)
    least = 1e-3 * np.polyfit(fall, falling, 1)[0] * 60.0 / 5.0
    steps = np.diff([0.0, *curve.coefficients[:5]])
    assert steps.min() == pytest.approx(least, rel=1e-6)


def test_least_squares_weigh_each_message_alike() -> None:
    """Of a bent form: no other scale and curvature is nearer to all samples, however often a level is repeated."""
    rng = np.random.default_rng(6)
    fall = np.rint(60.0 * rng.uniform(0.0, 1.0, 800) ** 2)
    pressure = 6e3 * fall / (1.0 + 0.004 * fall) * rng.uniform(0.95, 1.05, 800)
    for kind, form in ((CurveKind.CAPACITOR, _capacitor), (CurveKind.LOGARITHMIC, _logarithmic)):
        curve = fit_curve(kind, fall, pressure if kind is CurveKind.CAPACITOR else pressure**1.3, range_counts=60.0)
        wanted = pressure if kind is CurveKind.CAPACITOR else pressure**1.3

        def left(numbers: FloatArray, form=form, wanted=wanted) -> FloatArray:  # type: ignore[no-untyped-def]
            return (numbers[0] * form(fall / 60.0, float(numbers[1]))[0] - wanted) / wanted.max()

        best = least_squares(left, [wanted.max(), 0.5], x_scale=[wanted.max(), 1.0], xtol=1e-14, ftol=1e-14).x
        np.testing.assert_allclose(curve.coefficients, best, rtol=1e-4)
        assert best[1] > 0.05


def test_a_taxel_that_is_left_out_has_no_error_and_adds_none() -> None:
    """By hand, inside and above the fitted pressures: no root mean square of its own, and no share of that of a sum."""
    errors = HeldOutErrors(squares=np.array([[4.0, 9.0], [16.0, 50.0]]), numbers=np.array([[1.0, 1.0], [4.0, 2.0]]))
    np.testing.assert_allclose(errors.rmse, [[2.0, 3.0], [2.0, 5.0]])
    left = errors.of(np.array([True, False]))
    np.testing.assert_allclose(left.rmse, [[2.0, np.nan], [2.0, np.nan]])
    np.testing.assert_allclose((left + errors).rmse, errors.rmse)
    assert left.median() == (2.0, 2.0)
    assert errors.of(np.array([False, False])).median() == (None, None)
