# SPDX-License-Identifier: BSD-3-Clause
"""Curves of taxels: what each form holds to, and that it finds a truth of its own form."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import FitError
from forcetorque.skin.taxels.curve_comparison import calibrated_taxel
from forcetorque.skin.taxels.taxel_curve import CurveKind, fit_curve

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
