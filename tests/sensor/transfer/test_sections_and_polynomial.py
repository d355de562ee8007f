# SPDX-License-Identifier: BSD-3-Clause
"""Polynomials, straight sections and splines: what they reproduce, and what they refuse."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.sensor.transfer.parametric import fit_polynomial
from forcetorque.sensor.transfer.sections_and_network import fit_piecewise_linear, fit_spline
from forcetorque.sensor.transfer.transfer_function import TransferFunction

STIMULUS = np.linspace(0.0, 50.0, 60)
CUBIC = np.array([240.0, -3.0, 0.05, -4e-4])

EXACT = 1e-12
"""Relative rounding of least squares with a condition number below a hundred."""

FITS = [fit_polynomial, fit_piecewise_linear, fit_spline]


def test_a_polynomial_gives_its_coefficients_back() -> None:
    """Points on a cubic determine it, also with a higher degree to spare."""
    output = np.polynomial.Polynomial(CUBIC)(STIMULUS)
    np.testing.assert_allclose(fit_polynomial(STIMULUS, output).coefficients, CUBIC, rtol=1e-9)
    spare = fit_polynomial(STIMULUS, output, degree=5).coefficients
    np.testing.assert_allclose(spare[:4], CUBIC, rtol=1e-7)
    assert (np.abs(spare[4:] * 50.0 ** np.array([4, 5])) < 1e-8).all()


def test_a_range_far_from_zero_keeps_its_digits() -> None:
    """Temperatures in kelvin: a cubic over 20 K at 300 K is reproduced to what its size allows."""
    kelvin = np.linspace(290.0, 310.0, 40)
    output = 1.0 + 1e-3 * (kelvin - 300.0) ** 3
    fitted = fit_polynomial(kelvin, output)
    # coefficients of powers of s: terms of 1e-3 * 300^3 = 27000 cancel to about 1
    np.testing.assert_allclose(fitted.predict(kelvin), output, rtol=0, atol=27000 * 1e-14 * 100)


def test_a_swapped_fit_is_the_direct_inverse() -> None:
    """Thesis (3.8): fitting the stimulus to the output gives the polynomial of the inverse."""
    output = 3.0 + 2.0 * STIMULUS
    inverse = fit_polynomial(output, STIMULUS, degree=1)
    np.testing.assert_allclose(inverse.coefficients, [-1.5, 0.5], rtol=EXACT)


def test_straight_sections_reproduce_a_kinked_line() -> None:
    """A function of the kind, with its kinks at the knots, comes back; a curve does not."""
    knots = np.quantile(STIMULUS, [0.0, 0.25, 0.5, 0.75, 1.0])
    values = np.array([240.0, 200.0, 180.0, 170.0, 100.0])
    fitted = fit_piecewise_linear(STIMULUS, np.interp(STIMULUS, knots, values))
    np.testing.assert_allclose(fitted.knots, knots, rtol=EXACT)
    np.testing.assert_allclose(fitted.values, values, rtol=EXACT)
    curve = np.polynomial.Polynomial(CUBIC)(STIMULUS)
    assert np.abs(fit_piecewise_linear(STIMULUS, curve).predict(STIMULUS) - curve).max() > 0.1


def test_more_sections_follow_a_curve_closer() -> None:
    """The error of straight sections falls with the square of their length, that of cubics with the fourth power."""
    dense = np.linspace(0.0, 3.0, 400)
    errors = {
        fit: [
            np.abs(fit(dense, np.sin(dense), sections=count).predict(dense) - np.sin(dense)).max() for count in (5, 10)
        ]
        for fit in (fit_piecewise_linear, fit_spline)
    }
    straight, cubic = (errors[fit][0] / errors[fit][1] for fit in (fit_piecewise_linear, fit_spline))
    assert 3.0 < straight < 5.0
    assert 8.0 < cubic < 32.0


def test_a_spline_reproduces_cubics_and_splines() -> None:
    """One cubic all over the range is a spline, and a spline with these knots is itself."""
    curve = np.polynomial.Polynomial(CUBIC)(STIMULUS)
    np.testing.assert_allclose(fit_spline(STIMULUS, curve).predict(STIMULUS), curve, rtol=EXACT)
    knots = np.linspace(0.0, 50.0, 5)
    values = np.array([240.0, 200.0, 210.0, 170.0, 100.0])
    bent = np.asarray(CubicSpline(knots, values)(STIMULUS))
    np.testing.assert_allclose(fit_spline(STIMULUS, bent).values, values, rtol=EXACT)


def test_a_spline_is_smooth_at_its_knots() -> None:
    """Slope and curvature agree on both sides of a knot, by one-sided differences; straight sections do not."""
    output = np.sin(STIMULUS / 8.0)
    step = 1e-4

    def jump(model: TransferFunction, at: float) -> float:
        left, here, right = model.predict([at - step, at, at + step])
        return float(abs((right - here) - (here - left)) / step)

    spline, lines = fit_spline(STIMULUS, output), fit_piecewise_linear(STIMULUS, output)
    curvature = 1.0 / 64.0
    assert jump(spline, float(spline.knots[1])) < 2 * curvature * step
    assert jump(lines, float(lines.knots[1])) > 0.01


@pytest.mark.parametrize("fit", FITS)
def test_fits_follow_units_and_shuffling(fit: Callable[[Any, Any], TransferFunction]) -> None:
    """Other units and another order of the points give the same curve."""
    rng = np.random.default_rng(1)
    output = 240.0 - STIMULUS + rng.normal(size=60)
    once, order = fit(STIMULUS, output), rng.permutation(60)
    np.testing.assert_allclose(
        fit(STIMULUS[order], output[order]).predict(STIMULUS), once.predict(STIMULUS), rtol=1e-11
    )
    scaled = fit(1e3 * STIMULUS, 1e-3 * output)
    np.testing.assert_allclose(1e3 * scaled.predict(1e3 * STIMULUS), once.predict(STIMULUS), rtol=1e-11)


@pytest.mark.parametrize("fit", FITS)
def test_residuals_are_orthogonal_to_what_the_kind_can_do(fit: Callable[[Any, Any], TransferFunction]) -> None:
    """Least squares: fitting the residuals again finds nothing in them."""
    output = np.random.default_rng(2).normal(size=60)
    residual = output - fit(STIMULUS, output).predict(STIMULUS)
    np.testing.assert_allclose(fit(STIMULUS, residual).predict(STIMULUS), 0.0, atol=1e-12)
    assert np.abs(fit(STIMULUS, output).predict(STIMULUS)).max() > 0.1


@pytest.mark.parametrize(
    ("fit", "message"),
    [
        (partial(fit_polynomial, degree=4), "4 different stimuli do not determine 5 parameters"),
        (partial(fit_polynomial, degree=0), "degree of at least 1, got 0"),
        (partial(fit_piecewise_linear, sections=4), "4 different stimuli do not determine 5"),
        (partial(fit_piecewise_linear, sections=0), "expected 1 to 3 sections for 4 different stimuli, got 0"),
        (partial(fit_spline, sections=2), "at least 3 sections, got 2"),
    ],
)
def test_too_few_points_or_odd_settings_are_refused(fit: Callable[[Any, Any], TransferFunction], message: str) -> None:
    """Repeated stimuli count once; settings have limits."""
    with pytest.raises(FitError, match=message):
        fit([1.0, 2, 2, 2, 3, 4], [1.0, 2, 3, 4, 5, 6])


def test_points_of_other_shapes_are_refused() -> None:
    """Stimulus and output are two series of one length."""
    with pytest.raises(ShapeError, match=r"one shape \(n,\), got \(3,\) and \(2,\)"):
        fit_polynomial([1.0, 2, 3], [1.0, 2])
