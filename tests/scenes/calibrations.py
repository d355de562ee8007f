# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations of a plausible sensor, for tests of what is done with one."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.calibration.calibration_file import CalibratedVariable, Calibration, Prior
from forcetorque.experiment.calibration.provenance import Provenance, Selection, SensorIdentity, Validity
from forcetorque.simulation.simulated_sensor import distorted_by_mounting, y_shaped_matrix

FACTORY = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
"""Prior matrix; N/count, N m/count."""
MOUNTED = distorted_by_mounting(FACTORY, relative=0.05, rng=np.random.default_rng(7))
"""Another matrix of the same sensor."""
OFFSET = np.array([8.0, -5.0, 20.0, 0.3, -0.2, 0.1])
COEFFICIENTS = np.array([-0.4, 0.3, -1.2, 0.02, 0.01, -1.0 / 3.0])
"""What a variable adds per unit; the last has no short decimal form."""


def make_variable(
    *,
    name: str = "temperature",
    unit: str = "degC",
    reference_value: float = 29.3,
    coefficients: FloatArray = COEFFICIENTS,
) -> CalibratedVariable:
    """Make a linear variable of a calibration."""
    return CalibratedVariable(
        name=name,
        unit=unit,
        reference_value=reference_value,
        coefficients=coefficients,
        standard_error=None,
        minimum=reference_value - 1.0,
        maximum=reference_value + 12.0,
    )


def make_calibration(
    *,
    name: str = "leg_ft",
    serial: str = "SN001",
    matrix: FloatArray = MOUNTED,
    prior: FloatArray | None = FACTORY,
    offset: FloatArray = OFFSET,
    variables: tuple[CalibratedVariable, ...] = (),
    prior_source: str = "matrix.txt",
) -> Calibration:
    """Make a calibration whose fitted raw range is -3000 j to 2000 j counts for channel j = 1, 2, ..."""
    channels = matrix.shape[1]
    return Calibration(
        sensor=SensorIdentity(
            name=name, serial=serial, robot="arm", frame="child", measure_direction=MeasureDirection.CHILD_TO_PARENT
        ),
        matrix=matrix,
        offset=offset,
        variables=variables,
        estimation_type="OwTrTO" if variables else "OnTdTO",
        matrix_standard_error=None,
        offset_standard_error=None,
        residual_rms=np.ones(6),
        lambda_counts2=0.0,
        prior=None if prior is None else Prior(matrix=prior, offset=np.zeros(6), source=prior_source),
        validity=Validity(
            raw_minimum_counts=-3000.0 * np.arange(1, channels + 1),
            raw_maximum_counts=2000.0 * np.arange(1, channels + 1),
            expected_wrench_sd=np.ones(6),
            rank=channels,
            condition=12.0,
            directions=np.eye(channels),
            variance_counts2=np.ones(channels),
            explained=np.ones(channels),
            excited=(True,) * channels,
        ),
        selection=Selection(rule="given"),
        provenance=Provenance(
            code_version="1", created="2026-01-01T00:00:00+00:00", experiment="e", intervals=(), samples=3, dropped=0,
            inputs_sha256={},
        ),
    )  # fmt: skip
