# SPDX-License-Identifier: BSD-3-Clause
"""Linear, logarithmic, exponential and power functions: recovered from points, inverted, in any unit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import FitError, SensorError
from forcetorque.sensor.transfer.parametric import (
    Exponential,
    Linear,
    Logarithmic,
    Power,
    fit_exponential,
    fit_linear,
    fit_logarithmic,
    fit_power,
)
from forcetorque.sensor.transfer.transfer_function import TransferFunction

FITTED = 1e-7
"""Relative error of parameters from exact points: rounding times the condition of an exponent, about 1e8 at worst."""

INVERTED = 1e-9
"""Relative error of an inverse: rounding of the output over its slope, which falls a thousandfold over the range."""

TRUTHS: list[tuple[Callable[[Any, Any], TransferFunction], TransferFunction]] = [
    (fit_linear, Linear(lowest=-20.0, highest=50.0, slope=-0.3, offset=240.0)),
    (fit_logarithmic, Logarithmic(lowest=0.5, highest=50.0, slope=-12.0, offset=230.0)),
    (fit_exponential, Exponential(lowest=0.0, highest=50.0, scale=240.0, rate=-0.02)),
    (fit_exponential, Exponential(lowest=280.0, highest=310.0, scale=-1e-3, rate=0.05)),
    (fit_power, Power(lowest=0.0, highest=50.0, slope=-9.0, exponent=0.4, offset=240.0)),
    (fit_power, Power(lowest=1.0, highest=20.0, slope=5.0, exponent=-1.5, offset=-3.0)),
    (fit_power, Power(lowest=0.0, highest=3.0, slope=2.0, exponent=3.0, offset=1.0)),
]
EACH = pytest.mark.parametrize(("fit", "truth"), TRUTHS)


def _parameters(model: TransferFunction) -> list[float]:
    return [getattr(model, field.name) for field in fields(model)]


@EACH
def test_exact_points_give_the_parameters_back(
    fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction
) -> None:
    """Points on a function of the kind determine it, with the range of the points."""
    stimulus = np.linspace(truth.lowest, truth.highest, 40)
    fitted = fit(stimulus, truth.predict(stimulus))
    np.testing.assert_allclose(_parameters(fitted), _parameters(truth), rtol=FITTED)


@EACH
def test_noise_moves_the_fit_within_its_scatter(
    fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction
) -> None:
    """With noise the fitted curve is off by less than the noise, as 400 points carry 3 parameters at most."""
    rng = np.random.default_rng(1)
    stimulus = np.linspace(truth.lowest, truth.highest, 400)
    clean = truth.predict(stimulus)
    noise = 0.01 * float(np.ptp(clean))
    fitted = fit(stimulus, clean + noise * rng.normal(size=clean.shape))
    # standard error of a fitted curve: noise sqrt(3 / 400) on average, five times that at its worst place
    assert np.sqrt(((fitted.predict(stimulus) - clean) ** 2).mean()) < 5 * np.sqrt(3 / 400) * noise


@EACH
def test_the_fit_is_the_least_squares(fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction) -> None:
    """No parameter can be moved to lower the squared error of noisy points."""
    rng = np.random.default_rng(2)
    stimulus = np.linspace(truth.lowest, truth.highest, 60)
    clean = truth.predict(stimulus)
    noisy = clean + 0.02 * float(np.ptp(clean)) * rng.normal(size=clean.shape)
    fitted = fit(stimulus, noisy)
    least = ((fitted.predict(stimulus) - noisy) ** 2).sum()
    names = [field.name for field in fields(fitted) if field.name not in {"lowest", "highest"}]
    moved = 0
    for name in names:
        for factor in (1 - 1e-3, 1 + 1e-3):
            values = {field.name: getattr(fitted, field.name) for field in fields(fitted)}
            other = type(fitted)(**(values | {name: values[name] * factor}))
            assert ((other.predict(stimulus) - noisy) ** 2).sum() > least
            moved += 1
    assert moved == 2 * len(names) > 2


@EACH
def test_inverse_undoes_prediction(fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction) -> None:
    """The stimulus is told from the output all over the range, both ends among it."""
    stimulus = np.linspace(truth.lowest, truth.highest, 101)
    span = truth.highest - truth.lowest
    np.testing.assert_allclose(truth.inverse(truth.predict(stimulus)), stimulus, rtol=0, atol=INVERTED * span)


@EACH
def test_the_slope_of_the_inverse_is_one_over_the_slope(
    fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction
) -> None:
    """By central differences: a step there and back multiply to 1."""
    middle, step = 0.5 * (truth.lowest + truth.highest), 1e-4 * (truth.highest - truth.lowest)
    rise = np.diff(truth.predict([middle - step, middle + step]))[0]
    out = float(truth.predict(middle))
    run = np.diff(truth.inverse([out - 0.5 * rise, out + 0.5 * rise]))[0]
    assert run / (2 * step) == pytest.approx(1.0, abs=1e-6)  # truncation: the square of the relative step


@EACH
def test_fits_follow_the_units(fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction) -> None:
    """Pascal instead of kilopascal, and another unit of the output, give the same curve in those units."""
    rng = np.random.default_rng(3)
    stimulus = np.linspace(truth.lowest, truth.highest, 50)
    output = truth.predict(stimulus) + 0.01 * rng.normal(size=50) * float(np.ptp(truth.predict(stimulus)))
    once, scaled = fit(stimulus, output), fit(1e3 * stimulus, 1e-3 * output)
    curve = once.predict(stimulus)
    # offset and curve nearly cancel where the exponent is small, so compare with the size of the output
    np.testing.assert_allclose(1e3 * scaled.predict(1e3 * stimulus), curve, rtol=0, atol=1e-6 * np.abs(curve).max())


@EACH
def test_the_order_of_points_does_not_matter(
    fit: Callable[[Any, Any], TransferFunction], truth: TransferFunction
) -> None:
    """Shuffled points give the same function."""
    rng = np.random.default_rng(4)
    stimulus = np.linspace(truth.lowest, truth.highest, 30)
    output = truth.predict(stimulus) + 0.01 * rng.normal(size=30)
    order = rng.permutation(30)
    once, again = fit(stimulus, output), fit(stimulus[order], output[order])
    np.testing.assert_allclose(again.predict(stimulus), once.predict(stimulus), rtol=1e-6)


def test_values_by_hand() -> None:
    """Table 3.1 at a few places: C ln s + O, O exp(k s), C s^k + O, and C s + O."""
    assert Logarithmic(lowest=1.0, highest=9.0, slope=2.0, offset=1.0).predict(np.e) == pytest.approx(3.0)
    assert Exponential(lowest=0.0, highest=9.0, scale=2.0, rate=np.log(3)).predict(2.0) == pytest.approx(18.0)
    assert Power(lowest=0.0, highest=9.0, slope=2.0, exponent=0.5, offset=1.0).predict(9.0) == pytest.approx(7.0)
    assert Linear(lowest=0.0, highest=9.0, slope=2.0, offset=1.0).inverse(7.0) == pytest.approx(3.0)


def test_the_printed_logarithm_is_another_function() -> None:
    """Negative control: with `O s` in place of O the printed inverse does not undo it."""
    model = Logarithmic(lowest=1.0, highest=9.0, slope=2.0, offset=1.0)
    printed = 2.0 * np.log(3.0) + 1.0 * 3.0
    assert abs(float(model.inverse(printed)) - 3.0) > 1.0


@pytest.mark.long
@given(st.floats(0.05, 0.95))
def test_an_exponential_is_not_fitted_to_logarithms(part: float) -> None:
    """The fit weighs errors of the output: a wrong point at the small end hardly matters."""
    stimulus = np.linspace(0.0, 10.0, 30)
    output = 100.0 * np.exp(-stimulus)
    output[-1] += part * 1e-2
    assert fit_exponential(stimulus, output).rate == pytest.approx(-1.0, abs=1e-4)
    of_logarithms = np.polyfit(stimulus, np.log(output), 1)[0]
    assert abs(of_logarithms + 1.0) > 1e-3


@pytest.mark.parametrize(
    ("fit", "stimulus", "output", "message"),
    [
        (fit_logarithmic, [0.0, 1, 2], [1.0, 2, 3], "logarithmic: expected stimuli above 0, got 0"),
        (fit_power, [-1.0, 1, 2, 3], [1.0, 2, 3, 4], "power: expected stimuli of at least 0, got -1"),
        (fit_power, [1.0, 2, 4, 8, 16], [0.0, 1, 2, 3, 4], "is not separable from a logarithm|fits best"),
        (fit_exponential, [0.0, 1, 2, 3], [0.0, 0, 0, 1], "fits best"),
        (fit_exponential, [0.0, 1, 2, 3], [0.0, 0, 0, 0], "fits best|same for every stimulus"),
        (fit_linear, [1.0, 1, 1], [1.0, 2, 3], "1 different stimuli do not determine 2 parameters"),
        (fit_power, [1.0, 2, 2], [1.0, 2, 3], "2 different stimuli do not determine 3"),
        (fit_linear, [1.0, np.nan], [1.0, 2], "finite numbers"),
    ],
)
def test_points_that_a_kind_cannot_have_are_refused(
    fit: Callable[[Any, Any], TransferFunction], stimulus: list[float], output: list[float], message: str
) -> None:
    """Every refusal says what the points lack."""
    with pytest.raises(FitError, match=message):
        fit(stimulus, output)


def test_functions_that_cannot_be_are_refused() -> None:
    """A logarithm at zero, a power of zero, a negative base, an exponential that is zero."""
    with pytest.raises(SensorError, match="range above 0, got one from 0"):
        Logarithmic(lowest=0.0, highest=1.0, slope=1.0, offset=0.0)
    with pytest.raises(SensorError, match="exponent 0"):
        Power(lowest=0.0, highest=1.0, slope=1.0, exponent=0.0, offset=0.0)
    with pytest.raises(SensorError, match="range from 0"):
        Power(lowest=0.0, highest=1.0, slope=1.0, exponent=-1.0, offset=0.0)
    with pytest.raises(SensorError, match="other than 0"):
        Exponential(lowest=0.0, highest=1.0, scale=0.0, rate=1.0)
