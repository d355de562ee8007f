# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations of simulated sensors from the description of a device alone, validated with held-out loads."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.device.excitation_options import FAMILY, NOISE_COUNTS, SAMPLES, held_out_loads
from forcetorque.device.tolerances import Poses, Tolerances
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.workbench.excitation import RANK_TOLERANCE, load_sizes
from forcetorque.workbench.known_loads import BenchLoads
from forcetorque.workbench.position_means import Placement
from forcetorque.workbench.simulated_benches import simulate_bench


def device_error(poses: Sequence[Poses], sensor: str, tolerances: Tolerances, seed: int) -> FloatArray:
    """Calibrate a simulated sensor on a device with errors.

    Args:
        poses: Poses with each load.
        sensor: Name of the sensor.
        tolerances: Tolerances of the device.
        seed: Seed of the sensor, of the errors of the device, and of the noise.

    Returns:
        Root mean square errors of force and moment at held-out loads; shape (2,); N, N m.
    """
    rng = np.random.default_rng(seed)
    response = FAMILIES[FAMILY].draw(rng)
    names = dict.fromkeys(name for segment in poses for name in segment.errors)
    errors = {name: tolerances.draw(name, np.random.default_rng([seed, *name.encode()])) for name in names}
    expected, raw, counts = [], [], []
    for segment in poses:
        independent = np.deg2rad(tolerances.encoder_deg) * rng.uniform(-0.5, 0.5, (len(segment.count), 3))
        true = segment.wrench(sensor, errors, independent)
        noise = NOISE_COUNTS / np.sqrt(segment.count)[:, None] * rng.standard_normal((len(true), len(response)))
        expected.append(segment.wrench(sensor))
        raw.append(true @ response.T + noise)
        counts.append(segment.count)
    matrix = _fitted_matrix(np.concatenate(expected), np.concatenate(raw), np.concatenate(counts))
    return _held_out_error(matrix, response, seed)


def bench_error(loads: BenchLoads, placement: Placement, seed: int) -> FloatArray:
    """Calibrate a simulated sensor on a workbench with errors of the placement.

    Args:
        loads: Loads of weights.
        placement: Standard deviations of the placement.
        seed: Seed of the sensor, of the placement, and of the noise.

    Returns:
        Root mean square errors of force and moment at held-out loads; shape (2,); N, N m.
    """
    rng = np.random.default_rng(seed)
    noise = NOISE_COUNTS / np.sqrt(SAMPLES / len(loads))
    simulated = simulate_bench(loads, placement, rng, family=FAMILY, noise_counts=noise)
    matrix = _fitted_matrix(loads.wrench, simulated.bench.raw, np.ones(len(loads)))
    return _held_out_error(matrix, simulated.response, seed)


def _fitted_matrix(wrench: FloatArray, raw: FloatArray, count: FloatArray) -> FloatArray:
    """Matrix by least squares, without a prior matrix and with an offset; shape (6, c); N/count, N m/count.

    Where the loads do not span six directions, the response of least norm is taken, loads over their largest.
    """
    size, weight = load_sizes(wrench), np.sqrt(count)[:, None]
    design = (wrench - np.average(wrench, axis=0, weights=count)) / size
    moved = raw - np.average(raw, axis=0, weights=count)
    response = np.linalg.lstsq(weight * design, weight * moved, rcond=RANK_TOLERANCE)[0].T
    return size[:, None] * np.linalg.pinv(response, rcond=RANK_TOLERANCE)


def _held_out_error(matrix: FloatArray, response: FloatArray, seed: int) -> FloatArray:
    loads = held_out_loads(seed)
    error = loads @ (matrix @ response).T - loads
    return np.array([np.sqrt((error[:, half] ** 2).mean()) for half in FORCE_AND_MOMENT])
