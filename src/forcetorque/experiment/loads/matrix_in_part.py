# SPDX-License-Identifier: BSD-3-Clause
"""Loads that are weighed by a sensor whose matrix is known in part: how far that may be off, and usual inertias."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np

from forcetorque.calibration.generative import Assumptions
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import ExperimentSensor
from forcetorque.experiment.full_scale import full_scale_of
from forcetorque.loads import Load, LoadEstimate, LoadProblem, MatrixSpread, settled
from forcetorque.loads.fit import fit
from forcetorque.loads.load import INERTIAL
from forcetorque.loads.solve import load_estimates
from forcetorque.loads.unknowns import six_of
from forcetorque.spatial import skew

if TYPE_CHECKING:
    from forcetorque.experiment.content import Experiment

GYRATION_M: Final = 0.1
"""Radius of gyration about its centre of mass that an unknown load is expected to stay below (one s.d.); m."""


def spread_of(experiment: Experiment, sensor: ExperimentSensor) -> MatrixSpread:
    """Say how far the matrix of a sensor may be off, as the generative calibration takes it.

    Args:
        experiment: The experiment.
        sensor: One of its sensors, with a prior.

    Returns:
        The spread.

    Raises:
        ExperimentError: If it has no prior, or its full scale is not known.
    """
    if sensor.prior is None:
        raise ExperimentError(f"sensor {sensor.name!r}: expected prior, the matrix that is known in part, got none")
    accuracy = experiment.fit_options.accuracy
    full_scale = full_scale_of(sensor, accuracy, channels=sensor.prior.shape[1])
    return MatrixSpread.of(sensor.prior, Assumptions(full_scale=full_scale, accuracy=accuracy))


def with_matrix_in_part(problem: LoadProblem, spread: MatrixSpread) -> LoadProblem:
    """Let the matrix be known in part, and unknown inertias be those of loads of a usual size.

    Args:
        problem: Rows and loads.
        spread: How far the matrix may be off.

    Returns:
        The problem to solve.
    """
    free = [isinstance(load.inertia, str) and load.expected is None for load in problem.loads]
    if not any(free):
        return settled(problem, spread)
    points = tuple(
        replace(load, inertia=None) if unknown else load for load, unknown in zip(problem.loads, free, strict=True)
    )
    # only their places are wanted of it: sizes of the matrix would run after what the inertias do
    expected = replace(problem, loads=points, matrix_prior=spread.covariance(spread.expected))
    first = fit(expected, drift=bool(problem.drift))
    sized = tuple(
        _of_usual_size(load, estimate) if unknown and estimate.is_determined else load
        for load, estimate, unknown in zip(problem.loads, load_estimates(first), free, strict=True)
    )
    return settled(replace(problem, loads=sized), spread)


def _of_usual_size(load: Load, point: LoadEstimate) -> Load:
    """A load whose inertia about its centre of mass is that of a body of usual size."""
    hat = skew(point.centre_of_mass)
    expected, precision = np.zeros(INERTIAL), np.zeros((INERTIAL, INERTIAL))
    expected[4:] = six_of(-point.mass * hat @ hat)
    precision[4:, 4:] = np.eye(6) / (abs(point.mass) * GYRATION_M**2) ** 2
    return replace(load, expected=expected, precision=precision)
