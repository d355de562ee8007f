# SPDX-License-Identifier: BSD-3-Clause
"""Simulated sensors that are calibrated from the description of the device alone, judged on loads they never saw."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.device.tolerances import Poses, Tolerances
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.workbench.bench import Placement
from forcetorque.workbench.excitation import RANK_TOLERANCE, load_sizes
from forcetorque.workbench.loads import BenchLoads
from forcetorque.workbench.simulated_benches import simulate_bench

HELD_OUT_FORCE_N: Final = 100.0
"""Standard deviation of every component of a held-out force; N."""
HELD_OUT_MOMENT_NM: Final = 5.0
"""The same of the moment; N m."""
SAMPLES: Final = 360
"""Samples that a calibration has, however it is made."""
NOISE_COUNTS: Final = 1.0
"""Noise of a sample; counts."""
FAMILY: Final = "standard"
"""Family that sensors are drawn from."""
_LOADS: Final = 400
_JUDGED_SEED: Final = 7_000_000
"""Loads that are judged come of other seeds than sensors and errors."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldOutError:
    """Error of one calibrated sensor at held-out loads, root mean square over loads and axes."""

    force_N: float
    """Of the force; N."""
    moment_Nm: float
    """Of the moment; N m."""


def held_out_loads(seed: int = 0) -> FloatArray:
    """Draw loads that no calibration saw.

    Args:
        seed: Source of them.

    Returns:
        Changes of load; shape (400, 6); N, N m.
    """
    size = np.repeat([HELD_OUT_FORCE_N, HELD_OUT_MOMENT_NM], 3)
    return size * np.random.default_rng(_JUDGED_SEED + seed).standard_normal((_LOADS, 6))


def sample_noise() -> FloatArray:
    """Give the covariance of the noise of a sample of the nominal sensor; shape (6, 6); N, N m."""
    matrix = np.linalg.inv(FAMILIES[FAMILY].nominal())
    return NOISE_COUNTS**2 * matrix @ matrix.T


def device_error(poses: Sequence[Poses], sensor: str, tolerances: Tolerances, seed: int) -> HeldOutError:
    """Calibrate a simulated sensor on a device that is not quite as it is described.

    Args:
        poses: Poses with each load.
        sensor: Name of the sensor.
        tolerances: How exact the device is.
        seed: Source of the sensor, of what is wrong with the device, and of the noise.

    Returns:
        Its error.
    """
    rng = np.random.default_rng(seed)
    response = FAMILIES[FAMILY].draw(rng)
    names = dict.fromkeys(name for one in poses for name in one.errors)
    errors = {name: tolerances.draw(name, np.random.default_rng([seed, *name.encode()])) for name in names}
    stated, readings, counts = [], [], []
    for one in poses:
        fresh = np.deg2rad(tolerances.encoder_deg) * rng.uniform(-0.5, 0.5, (len(one.count), 3))
        true = one.wrench(sensor, errors, fresh)
        noise = NOISE_COUNTS / np.sqrt(one.count)[:, None] * rng.standard_normal((len(true), len(response)))
        stated.append(one.wrench(sensor))
        readings.append(true @ response.T + noise)
        counts.append(one.count)
    matrix = fitted_matrix(np.concatenate(stated), np.concatenate(readings), np.concatenate(counts))
    return _judged(matrix, response, seed)


def bench_error(loads: BenchLoads, placement: Placement, seed: int) -> HeldOutError:
    """Calibrate a simulated sensor on a workbench whose weights are not quite where they are said to be.

    Args:
        loads: Loads of weights.
        placement: How far they are off.
        seed: Source of the sensor, of the placement, and of the noise.

    Returns:
        Its error.
    """
    rng = np.random.default_rng(seed)
    noise = NOISE_COUNTS / np.sqrt(SAMPLES / len(loads))
    specimen = simulate_bench(loads, placement, rng, family=FAMILY, noise_counts=noise)
    matrix = fitted_matrix(loads.wrench, specimen.bench.raw, np.ones(len(loads)))
    return _judged(matrix, specimen.response, seed)


def fitted_matrix(wrench: FloatArray, readings: FloatArray, count: FloatArray) -> FloatArray:
    """Fit a matrix to known loads by least squares, without a prior and with an offset.

    Where the loads do not span six directions, the response of least norm is taken, loads over their largest.

    Args:
        wrench: Loads; shape (n, 6); N, N m.
        readings: Mean readings; shape (n, c); counts.
        count: Samples of each mean; shape (n,).

    Returns:
        The matrix; shape (6, c); N/count, N m/count.
    """
    size, weight = load_sizes(wrench), np.sqrt(count)[:, None]
    design = (wrench - np.average(wrench, axis=0, weights=count)) / size
    moved = readings - np.average(readings, axis=0, weights=count)
    response = np.linalg.lstsq(weight * design, weight * moved, rcond=RANK_TOLERANCE)[0].T
    return size[:, None] * np.linalg.pinv(response, rcond=RANK_TOLERANCE)


def _judged(matrix: FloatArray, response: FloatArray, seed: int) -> HeldOutError:
    loads = held_out_loads(seed)
    error = loads @ (matrix @ response).T - loads
    force, moment = (float(np.sqrt((error[:, half] ** 2).mean())) for half in FORCE_AND_MOMENT)
    return HeldOutError(force_N=force, moment_Nm=moment)
