# SPDX-License-Identifier: BSD-3-Clause
"""Transfer functions of no closed form: lines and cubic splines in sections, a network of one hidden layer."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from forcetorque.base.arrays import FloatArray, array
from forcetorque.base.errors import FitError, SensorError, needs_extra
from forcetorque.sensor.transfer.transfer_function import TransferFunction, calibration_points, least_squares

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline


def knots_for(stimulus: FloatArray, sections: int) -> FloatArray:
    """Divide the range so that each section holds about as many different stimuli.

    Args:
        stimulus: Known stimuli; shape (n,).
        sections: Number of sections.

    Returns:
        Ends of the sections, ascending; shape (sections + 1,).

    Raises:
        FitError: If there are no sections, or fewer different stimuli than ends.
    """
    different = np.unique(stimulus)
    if sections < 1 or len(different) < sections + 1:
        raise FitError(
            f"expected 1 to {len(different) - 1} sections for {len(different)} different stimuli, got {sections}"
        )
    return np.asarray(np.quantile(different, np.linspace(0.0, 1.0, sections + 1)), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Sections(TransferFunction):
    """A function that is made of sections."""

    least_knots: ClassVar[int]
    """Number of knots that it needs."""
    knots: FloatArray = field(metadata=array(None))
    """Stimuli at the ends of the sections, ascending; shape (k,)."""
    values: FloatArray = field(metadata=array(None))
    """Outputs at the knots; shape (k,)."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        knots, values = self.knots, self.values
        fits = values.shape == knots.shape and len(knots) >= self.least_knots
        if not fits or not (np.isfinite(values).all() and np.isfinite(knots).all() and (np.diff(knots) > 0.0).all()):
            raise SensorError(
                f"{type(self).__name__}: expected at least {self.least_knots} ascending knots with one finite value "
                f"each, got {len(knots)} knots and {len(values)} values"
            )

    def _ends(self) -> FloatArray:
        """Ends of the sections within the range, which may be narrower than the knots."""
        inside = self.knots[(self.knots > self.lowest) & (self.knots < self.highest)]
        return np.concatenate([[self.lowest], inside, [self.highest]])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PiecewiseLinear(_Sections):
    """Straight lines between knots, thesis 3.1.4; beyond the outer knots the outer lines go on."""

    least_knots: ClassVar[int] = 2

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return _along_lines(stimulus, self.knots, self.values)

    def _stimulus(self, output: FloatArray) -> FloatArray:
        knots = self._ends()
        values = self._output(knots)
        order = slice(None) if values[-1] > values[0] else slice(None, None, -1)
        return np.asarray(np.interp(output, values[order], knots[order]), dtype=np.float64)

    def _turning_points(self) -> FloatArray:
        ends = self._ends()
        directions = np.sign(np.diff(self._output(ends)))
        # a level line is as bad as a turn: its output shows no single stimulus
        is_turn = (directions[:-1] != directions[1:]) | (directions[1:] == 0.0)
        return ends[1:-1][is_turn]


def _along_lines(stimulus: FloatArray, knots: FloatArray, values: FloatArray) -> FloatArray:
    section = np.clip(np.searchsorted(knots, stimulus, side="right") - 1, 0, len(knots) - 2)
    part = (stimulus - knots[section]) / np.diff(knots)[section]
    return (1.0 - part) * values[section] + part * values[section + 1]


def fit_piecewise_linear(stimulus: Any, output: Any, *, sections: int = 4) -> PiecewiseLinear:
    """Fit connected straight lines by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        sections: Number of lines; each holds about as many different stimuli.

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are too few different stimuli.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=sections + 1)
    knots = knots_for(stimuli, sections)
    # how much of the value at each knot a point has
    design = np.column_stack([_along_lines(stimuli, knots, row) for row in np.eye(len(knots))])
    return PiecewiseLinear(
        lowest=float(knots[0]), highest=float(knots[-1]), knots=knots, values=least_squares(design, outputs)
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spline(_Sections):
    """Cubics between knots, with equal slope and curvature where they meet (not-a-knot ends), thesis 3.1.5."""

    least_knots: ClassVar[int] = 4  # they carry one cubic

    def _curve(self) -> CubicSpline:
        from scipy.interpolate import CubicSpline  # here because importing it takes longer than most fits

        return CubicSpline(self.knots, self.values)

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return np.asarray(self._curve()(stimulus), dtype=np.float64)

    def _turning_points(self) -> FloatArray:
        slope = self._curve().derivative()
        # where the slope is zero all over a section, SciPy marks the rest of it with NaN
        roots = np.asarray(slope.roots(), dtype=np.float64)
        inside = np.unique(roots[(roots > self.lowest) & (roots < self.highest)])
        edges = np.concatenate([[self.lowest], inside, [self.highest]])
        signs = np.sign(slope(0.5 * (edges[:-1] + edges[1:])))
        return inside[(signs[:-1] != signs[1:]) | (signs[1:] == 0.0)]


def fit_spline(stimulus: Any, output: Any, *, sections: int = 4) -> Spline:
    """Fit a cubic spline by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        sections: Number of cubics, at least 3; each holds about as many different stimuli.

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are too few sections or different stimuli.
    """
    from scipy.interpolate import CubicSpline

    if sections < Spline.least_knots - 1:
        raise FitError(f"spline: expected at least {Spline.least_knots - 1} sections, got {sections}")
    stimuli, outputs = calibration_points(stimulus, output, parameters=sections + 1)
    knots = knots_for(stimuli, sections)
    # a spline is linear in its values at the knots
    design = np.asarray(CubicSpline(knots, np.eye(len(knots)))(stimuli), dtype=np.float64)
    return Spline(lowest=float(knots[0]), highest=float(knots[-1]), knots=knots, values=least_squares(design, outputs))


_ITERATIONS = 5000
"""Steps of the training; below a hundred are usual."""

_LOOKS = 2001
"""Stimuli at which the slope is looked at for turns."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Network(TransferFunction):
    """`E = sum_j output_weights[j] tanh(weights[j] s + biases[j]) + output_bias`, thesis (3.9).

    Whether it is monotone is looked at in 2001 places, so a narrow turn between two of them is missed.
    """

    weights: FloatArray = field(metadata=array(None))
    """Weight of the stimulus in each neuron; shape (neurons,); one over the unit of the stimulus."""
    biases: FloatArray = field(metadata=array(None))
    """Bias of each neuron; shape (neurons,)."""
    output_weights: FloatArray = field(metadata=array(None))
    """Weight of each neuron in the output; shape (neurons,); unit of the output."""
    output_bias: float
    """Bias of the output; unit of the output."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if not len(self.weights) == len(self.biases) == len(self.output_weights) > 0:
            raise SensorError(
                "Network: expected as many weights, biases and output weights, at least one; "
                f"got {len(self.weights)}, {len(self.biases)} and {len(self.output_weights)}"
            )

    def _output(self, stimulus: FloatArray) -> FloatArray:
        hidden = np.tanh(stimulus[..., None] * self.weights + self.biases)  # (..., neurons)
        return np.asarray(hidden @ self.output_weights + self.output_bias, dtype=np.float64)

    def _turning_points(self) -> FloatArray:
        places = np.linspace(self.lowest, self.highest, _LOOKS)
        hidden = np.tanh(places[:, None] * self.weights + self.biases)
        directions = np.sign((1.0 - hidden**2) @ (self.weights * self.output_weights))
        return places[1:][directions[1:] != directions[:-1]]


_WEIGHT_DECAY = 1e-6
"""Weight of the squared weights in the cost, for points scaled to unit deviation."""


def fit_network(stimulus: Any, output: Any, *, neurons: int = 4, seed: int = 0) -> Network:
    """Train a network with one hidden layer by least squares of the output.

    The squared error has many local minima; another seed finds another network. The result needs no
    scikit-learn any more.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        neurons: Number of neurons of the hidden layer.
        seed: Seed of the first weights.

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer different stimuli than parameters, the output does not change, or the training
            does not end.
        MissingExtraError: If scikit-learn is not installed.
    """
    with needs_extra("networks are fitted by scikit-learn", "network"):
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.neural_network import MLPRegressor
    if neurons < 1:
        raise FitError(f"network: expected at least 1 neuron, got {neurons}")
    stimuli, outputs = calibration_points(stimulus, output, parameters=3 * neurons + 1)
    middle, spread, level, swing = stimuli.mean(), stimuli.std(), outputs.mean(), outputs.std()
    if not swing > 0.0:
        raise FitError("network: the output is the same for every stimulus; there is nothing to learn")
    trainer = MLPRegressor(
        hidden_layer_sizes=(neurons,),
        activation="tanh",
        solver="lbfgs",  # least squares of a small set; the others are for data that do not fit into memory
        alpha=_WEIGHT_DECAY,
        tol=1e-6,  # the default of 1e-4 stops at errors that are visible beside those of a converter
        max_iter=_ITERATIONS,
        random_state=seed,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error", ConvergenceWarning)
        try:
            trainer.fit(((stimuli - middle) / spread)[:, None], (outputs - level) / swing)
        except ConvergenceWarning as warning:
            raise FitError(
                f"network: the training did not end in {_ITERATIONS} steps; use fewer neurons, or another seed"
            ) from warning
    (first, second), (biases, (last,)) = trainer.coefs_, trainer.intercepts_
    # the scaling of the points goes into the weights
    weights = first[0] / spread
    return Network(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        weights=weights,
        biases=biases - weights * middle,
        output_weights=second[:, 0] * swing,
        output_bias=float(last * swing + level),
    )
