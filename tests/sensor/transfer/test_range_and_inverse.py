# SPDX-License-Identifier: BSD-3-Clause
"""Where functions are valid, and where they have an inverse: every kind."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.transfer.parametric import Linear, Polynomial, Power
from forcetorque.sensor.transfer.sections_and_network import Network, PiecewiseLinear, Spline
from forcetorque.sensor.transfer.transfer_function import TransferFunction

KNOTS = np.array([0.0, 1.0, 2.5, 4.0, 6.0])
FALLING = np.array([10.0, 8.0, 7.0, 3.0, 1.0])
BUMPY = np.array([10.0, 8.0, 9.0, 3.0, 1.0])

MONOTONE: list[TransferFunction] = [
    Polynomial(lowest=0.0, highest=6.0, coefficients=np.array([1.0, 2.0, 0.0, 0.1])),
    Polynomial(lowest=0.0, highest=6.0, coefficients=np.array([1.0, -2.0])),
    Polynomial(lowest=-1.0, highest=1.0, coefficients=np.array([0.0, 0.0, 0.0, 1.0])),
    PiecewiseLinear(lowest=0.0, highest=6.0, knots=KNOTS, values=FALLING),
    PiecewiseLinear(lowest=0.5, highest=5.0, knots=KNOTS, values=-FALLING),
    Spline(lowest=0.0, highest=6.0, knots=KNOTS, values=np.array([0.0, 2.0, 4.0, 6.5, 9.0])),
    Network(
        lowest=-2.0,
        highest=3.0,
        weights=np.array([1.0, 0.5]),
        biases=np.array([0.2, -1.0]),
        output_weights=np.array([2.0, 5.0]),
        output_bias=1.0,
    ),
]
BENT: list[TransferFunction] = [
    Polynomial(lowest=-1.0, highest=1.0, coefficients=np.array([0.0, 0.0, 1.0])),
    PiecewiseLinear(lowest=0.0, highest=6.0, knots=KNOTS, values=BUMPY),
    PiecewiseLinear(lowest=0.0, highest=6.0, knots=KNOTS, values=np.array([4.0, 4.0, 3.0, 2.0, 1.0])),
    Spline(lowest=0.0, highest=6.0, knots=KNOTS, values=BUMPY),
    Network(
        lowest=-2.0,
        highest=2.0,
        weights=np.array([1.0, 3.0]),
        biases=np.zeros(2),
        output_weights=np.array([2.0, -2.0]),
        output_bias=0.0,
    ),
]

INVERTED = 1e-12
"""Rounding of an inverse relative to the range: eps over the slope, here above a hundredth of the mean slope."""

FLAT_INVERTED = 1e-5
"""The same for s^3, whose slope is zero in the middle: the cube root of the rounding."""


@pytest.mark.parametrize("model", MONOTONE, ids=lambda model: type(model).__name__)
def test_inverse_undoes_prediction_all_over_the_range(model: TransferFunction) -> None:
    """The stimulus is told from the output, both ends among it, for arrays of any shape."""
    stimulus = np.linspace(model.lowest, model.highest, 40).reshape(8, 5)
    is_flat = isinstance(model, Polynomial) and model.coefficients[1] == 0.0
    tolerance = (FLAT_INVERTED if is_flat else INVERTED) * (model.highest - model.lowest)
    np.testing.assert_allclose(model.inverse(model.predict(stimulus)), stimulus, rtol=0, atol=tolerance)
    assert float(model.inverse(model.predict(model.highest))) == pytest.approx(model.highest, abs=tolerance)


@pytest.mark.parametrize("model", BENT, ids=lambda model: type(model).__name__)
def test_functions_that_turn_have_no_inverse(model: TransferFunction) -> None:
    """An output that tells two stimuli is refused, and the message says where the function turns."""
    with pytest.raises(SensorError, match="no inverse between .* turns at a stimulus of"):
        model.inverse(model.predict(0.0))


def test_the_turn_is_where_the_slope_is_zero() -> None:
    """(s - 1)^2 turns at 1; on one side of it there is an inverse."""
    parabola = Polynomial(lowest=0.0, highest=3.0, coefficients=np.array([1.0, -2.0, 1.0]))
    with pytest.raises(SensorError, match="turns at a stimulus of 1;"):
        parabola.inverse(0.5)
    right = dataclasses.replace(parabola, lowest=1.0)
    assert right.inverse(0.25) == pytest.approx(1.5)
    left = dataclasses.replace(parabola, highest=1.0)
    assert left.inverse(0.25) == pytest.approx(0.5)


@pytest.mark.parametrize(
    "level",
    [
        Linear(lowest=0.0, highest=1.0, slope=0.0, offset=3.0),
        Power(lowest=0.0, highest=1.0, slope=0.0, exponent=2.0, offset=3.0),
    ],
)
def test_level_functions_have_no_inverse(level: TransferFunction) -> None:
    """An output that every stimulus gives tells none."""
    with pytest.raises(SensorError, match="same output at both ends"):
        level.inverse(3.0)


@pytest.mark.parametrize("model", MONOTONE, ids=lambda model: type(model).__name__)
def test_beyond_the_range_both_directions_refuse(model: TransferFunction) -> None:
    """A fit says nothing about stimuli that it did not see; the message says how to go further."""
    step = 0.01 * (model.highest - model.lowest)
    first, last = model.output_ends()
    tried = 0
    for stimulus, output in (
        (model.lowest - step, first - 0.01 * (last - first)),
        (model.highest + step, last + 0.01 * (last - first)),
    ):
        with pytest.raises(SensorError, match=r"1 stimuli outside the fitted range .* dataclasses\.replace"):
            model.predict([stimulus, model.lowest])
        with pytest.raises(SensorError, match="1 outputs outside"):
            model.inverse([output, first])
        tried += 1
    assert tried == 2


@pytest.mark.parametrize("model", MONOTONE, ids=lambda model: type(model).__name__)
def test_numbers_that_are_none_are_refused(model: TransferFunction) -> None:
    """NaN is in no range."""
    with pytest.raises(SensorError, match="such as nan"):
        model.predict(np.nan)
    with pytest.raises(SensorError, match="such as nan"):
        model.inverse([np.nan])


def test_an_output_that_rounding_moved_beyond_an_end_is_that_end() -> None:
    """Outputs that went through other arithmetic may lie beyond by rounding; a root of less than zero is not taken."""
    root = Power(lowest=0.0, highest=50.0, slope=-9.0, exponent=0.4, offset=240.0)
    assert root.inverse(240.0 * (1 + 1e-15)) == 0.0
    with pytest.raises(SensorError, match="1 outputs outside"):
        root.inverse(240.001)


def test_a_wider_range_goes_further_on_purpose() -> None:
    """Stating the range extends the function as it is: the line goes on, as do the outer lines and cubics."""
    line = dataclasses.replace(MONOTONE[3], highest=8.0)
    assert line.predict(8.0) == pytest.approx(-1.0)  # 1 at 6, falling by 1 per unit
    assert line.inverse(0.0) == pytest.approx(7.0)
    with pytest.raises(SensorError, match="outside"):
        MONOTONE[3].predict(8.0)


@pytest.mark.parametrize(("low", "high"), [(1.0, 1.0), (2.0, 1.0), (0.0, np.inf), (np.nan, 1.0)])
def test_ranges_that_are_none_are_refused(low: float, high: float) -> None:
    """A range is finite and goes upwards."""
    with pytest.raises(SensorError, match="Linear: expected a finite range with lowest below highest"):
        Linear(lowest=low, highest=high, slope=1.0, offset=0.0)


def test_models_cannot_be_changed_and_arguments_are_not() -> None:
    """Arrays of a model are read-only copies."""
    knots = KNOTS.copy()
    model = PiecewiseLinear(lowest=0.0, highest=6.0, knots=knots, values=FALLING)
    knots[0] = -5.0
    assert model.knots[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        model.knots[0] = 1.0


def test_parts_that_do_not_fit_are_refused() -> None:
    """Knots that do not ascend, too few of them, weights without biases."""
    with pytest.raises(SensorError, match="PiecewiseLinear: expected at least 2 ascending knots"):
        PiecewiseLinear(lowest=0.0, highest=6.0, knots=KNOTS[::-1], values=FALLING)
    with pytest.raises(SensorError, match="Spline: expected at least 4 ascending knots .* got 3 knots"):
        Spline(lowest=0.0, highest=6.0, knots=KNOTS[:3], values=FALLING[:3])
    with pytest.raises(SensorError, match="Polynomial: expected at least one finite coefficient"):
        Polynomial(lowest=0.0, highest=1.0, coefficients=np.array([np.nan]))
    with pytest.raises(SensorError, match="got 1, 0 and 1"):
        Network(
            lowest=0.0,
            highest=1.0,
            weights=np.ones(1),
            biases=np.zeros(0),
            output_weights=np.ones(1),
            output_bias=0.0,
        )
