# SPDX-License-Identifier: BSD-3-Clause
"""What is known of a sensor before any recording: its prior matrix, and how far sensors differ from theirs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import LinearVariable
from forcetorque.calibration.generative import assumptions as expected
from forcetorque.calibration.generative.assumptions import Assumptions
from forcetorque.calibration.generative.rows import LOADS, rows_of
from forcetorque.calibration.posterior import Posterior, RowNoise
from forcetorque.errors import FitError

ASSUMED_NOISE: Final = 1e-4
"""White noise of a mean over a second that is assumed where none was measured, as a share of full scale."""
ASSUMED_DRIFT: Final = 5e-4
"""Size of the slow offset that is assumed with it, or the accuracy of the reference where that is larger."""
ASSUMED_TIME_S: Final = 15.0
"""How long that offset is assumed to last; s."""

UNKNOWN: Final = 1e5
"""Standard deviation of what an unknown coefficient makes of the loads to come, over the noise of a reading."""


def unfitted_posterior(
    matrix: FloatArray, assumptions: Assumptions, variables: Sequence[LinearVariable] = ()
) -> Posterior:
    """Say what the generative model takes for granted before any data.

    Args:
        matrix: Prior matrix; shape (6, c); N/count, N m/count.
        assumptions: What is known beside it.
        variables: Linear variables that will be fitted.

    Returns:
        Prior covariance and assumed noise; its only session has an offset that is known.

    Raises:
        FitError: If nothing tells what a variable may do.
    """
    rows = rows_of(matrix, assumptions, in_wrench=True)
    unit = rows.unit
    roots = np.concatenate(
        [expected.SENSOR.expected * rows.sensor_root, expected.FRAME.expected * rows.frame_root], axis=2
    )
    prior = unit[:, None, None] ** 2 * roots @ roots.transpose(0, 2, 1)
    size = LOADS + len(variables) + 1
    covariance = np.zeros((len(unit), size, size))
    covariance[:, :LOADS, :LOADS] = prior + assumptions.repeatability**2 * _spread(rows.sensor_root, unit)
    for k, variable in enumerate(variables):
        own = [expected.variable_size(variable, row) for row in rows.from_load]
        if None in own:
            raise FitError(
                f"variable {variable.name!r}: expected prior_deviation, what one {variable.unit or 'unit'} of it may "
                "do; before any recording nothing tells, and it is no temperature"
            )
        covariance[:, LOADS + k, LOADS + k] = (unit * np.array(own)) ** 2
    drift = np.maximum(ASSUMED_DRIFT, rows.accuracy)
    in_wrench = rows.space == "wrench"
    return Posterior(
        space=rows.space,
        variables=tuple(variable.name for variable in variables),
        sessions=("none",),
        drift=False,
        mean=np.zeros((len(unit), size)),
        covariance=covariance,
        learnt_covariance=prior,
        prior_covariance=prior,
        to_wrench=np.eye(LOADS) if in_wrench else matrix,
        noise=tuple(
            RowNoise(
                white=ASSUMED_NOISE * float(one),
                time_constant_s=ASSUMED_TIME_S,
                ratio=float((slow / ASSUMED_NOISE) ** 2),
            )
            for one, slow in zip(unit, drift, strict=True)
        ),
        accuracy=assumptions.reference_accuracy(matrix),
        repeatability=assumptions.repeatability,
        load_centre=np.zeros(6),
    )


def blank_posterior(noise: FloatArray, load: FloatArray) -> Posterior:
    """Say that nothing is known of a sensor, not even a prior matrix.

    Args:
        noise: White noise of a reading, as wrench; shape (6,); N, N m.
        load: Sizes of the loads to come, by which coefficients are said to be unknown; shape (6,); N, N m.

    Returns:
        The posterior, whose rows are components of the wrench.
    """
    size = LOADS + 1
    covariance = np.zeros((LOADS, size, size))
    unknown = (UNKNOWN * noise[:, None] / load) ** 2
    covariance[:, range(LOADS), range(LOADS)] = unknown
    covariance[:, LOADS, LOADS] = (UNKNOWN * noise) ** 2
    return Posterior(
        space="wrench",
        variables=(),
        sessions=("none",),
        drift=False,
        mean=np.zeros((LOADS, size)),
        covariance=covariance,
        learnt_covariance=covariance[:, :LOADS, :LOADS].copy(),
        prior_covariance=None,
        to_wrench=np.eye(LOADS),
        noise=tuple(RowNoise(white=float(one), time_constant_s=0.0, ratio=0.0) for one in noise),
        accuracy=np.zeros(LOADS),
        repeatability=0.0,
        load_centre=np.zeros(LOADS),
    )


def _spread(roots: FloatArray, unit: FloatArray) -> FloatArray:
    scaled = roots * unit[:, None, None]
    spread: FloatArray = scaled @ scaled.transpose(0, 2, 1)
    return spread
