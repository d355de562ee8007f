# SPDX-License-Identifier: BSD-3-Clause
"""The transfer function of a network with one hidden layer."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, array
from forcetorque.base.errors import FitError, MissingExtraError, SensorError, install_line
from forcetorque.sensor.transfer.transfer_function import TransferFunction, calibration_points

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
    try:
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.neural_network import MLPRegressor
    except ImportError as error:
        raise MissingExtraError(f"networks are fitted by scikit-learn: {install_line('network')}") from error
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
