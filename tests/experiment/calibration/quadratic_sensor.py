# SPDX-License-Identifier: BSD-3-Clause
"""A sensor that is quadratic in its load, moved in all directions: what a quadratic correction is for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.generative.generative_calibration import generative_calibration
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import DataSet, WindowMeans
from forcetorque.experiment.calibration.provenance import FittedInterval, SensorIdentity
from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection, steepness
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments
from forcetorque.simulation.simulated_sensor import distorted_by_mounting
from tests.scenes.calibrations import FACTORY

LIMIT_COUNTS = 32767.0
ASSUMPTIONS = Assumptions.of_counts(6, LIMIT_COUNTS, accuracy=np.zeros(6))
NOISE_COUNTS = 2.0
SECONDS, RATE_HZ = 60, 4
IDENTITY = SensorIdentity(
    name="leg_ft", serial="SN001", robot="arm", frame="child", measure_direction=MeasureDirection.CHILD_TO_PARENT
)


class Specimen:
    """One sensor with its recordings."""

    def __init__(self, seed: int, crosstalk_counts: float) -> None:
        """Draw the sensor.

        Args:
            seed: Seed of all that is drawn.
            crosstalk_counts: What products of loads add, where both are at full scale; zero for a linear sensor.
        """
        self.rng = np.random.default_rng(seed)
        self.matrix = distorted_by_mounting(FACTORY, relative=0.05, rng=self.rng)
        self.crosstalk = crosstalk_counts * self.rng.standard_normal((6, 6, 6))
        self.mean = 0.1 * self.rng.standard_normal(6)

    def recording(self, number: int, *, reach: float = 0.1) -> DataSet:
        """Move it.

        Args:
            number: Number of the recording, a power-up of its own.
            reach: Standard deviation of the loads about their mean, as a share of full scale.

        Returns:
            Its samples.
        """
        time = np.arange(SECONDS * RATE_HZ) / RATE_HZ
        phases, speeds = self.rng.uniform(0.0, 2.0 * np.pi, size=(2, 3, 6))
        waves = np.sin(0.2 * speeds[:, None] * time[:, None] + phases[:, None]).sum(axis=0)
        load = (self.mean + reach * waves) * LIMIT_COUNTS @ self.matrix.T
        noise = NOISE_COUNTS * self.rng.standard_normal(load.shape)
        return DataSet(
            label=f"part {number}",
            raw=self.counts(load) + 500.0 * self.rng.standard_normal(6) + noise,
            reference=load,
            time_s=time,
            session=f"power-up {number}",
            recording=f"recording {number}",
        )

    def counts(self, load: FloatArray) -> FloatArray:
        """Read loads; shape (n, 6); counts."""
        share = load @ np.linalg.inv(self.matrix).T / LIMIT_COUNTS
        counts: FloatArray = share * LIMIT_COUNTS + np.einsum("ni,cij,nj->nc", share, self.crosstalk, share)
        return counts


def means_of(data: Sequence[DataSet]) -> list[WindowMeans]:
    """Reduce recordings to their means."""
    return [WindowMeans.of(one) for one in data]


def calibrated(data: Sequence[DataSet], *, nonlinear: bool | None, stated: bool = False) -> Calibration:
    """Fit recordings by way of their moments.

    Args:
        data: The recordings.
        nonlinear: Whether quadratic terms are asked for; None for what the moments say.
        stated: What the moments say.

    Returns:
        The calibration.
    """
    moments = [
        RecordingMoments(
            sensor=IDENTITY,
            experiment=one.recording,
            prior=FACTORY,
            prior_source="matrix.txt",
            full_scale=ASSUMPTIONS.full_scale,
            accuracy=ASSUMPTIONS.accuracy,
            repeatability=ASSUMPTIONS.repeatability,
            drift=False,
            nonlinear=stated,
            variables=(),
            intervals=(
                IntervalMoments.of(
                    one, FittedInterval(label=one.label, start_ns=0, end_ns=1, session=one.session), dropped=0
                ),
            ),
            inputs_sha256={},
        )
        for one in data
    ]
    return generative_calibration(moments, code_version="1", created="2026-01-01T00:00:00+00:00", nonlinear=nonlinear)


def correction_of_steepness(value: float) -> QuadraticCorrection:
    """Make a correction that changes by so much per unit of load where it is steepest."""
    rng = np.random.default_rng(4)
    coefficients = FACTORY * LIMIT_COUNTS @ rng.standard_normal((6, 21))
    to_full_scale = np.linalg.inv(FACTORY) / LIMIT_COUNTS
    directions = np.linalg.qr(rng.standard_normal((6, 6)))[0]
    maximum = rng.uniform(0.1, 0.3, size=6)
    own = steepness(to_full_scale @ coefficients, directions, -0.5 * maximum, maximum)
    return QuadraticCorrection(
        coefficients=value / own * coefficients,
        to_full_scale=to_full_scale,
        centre=0.1 * rng.standard_normal(6),
        directions=directions,
        minimum=-0.5 * maximum,
        maximum=maximum,
    )
