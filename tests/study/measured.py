# SPDX-License-Identifier: BSD-3-Clause
"""Data of a sensor that drifts with temperature, made from a known model, and a study of them."""

from __future__ import annotations

from functools import cache

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel
from forcetorque.experiment.validation_offset import Offset, ValidationSet
from forcetorque.study.candidate_fits import Study, run_study

RATE_HZ = 100.0
NOISE = np.array([0.3, 0.3, 0.3, 0.01, 0.01, 0.01])
"""Of the reference; standard deviation; N, N m."""

TEMPERATURE = LinearVariable(name="temperature", unit="degC")
TRUTH = WrenchModel(
    matrix=np.diag([1.0, 1.0, 1.0, 0.05, 0.05, 0.05])
    @ (0.02 * (np.eye(6) + 0.2 * np.random.default_rng(1).normal(size=(6, 6)))),
    offset=np.array([30.0, -12.0, 5.0, 0.4, -0.3, 0.2]),
    coefficients=np.array([[-0.4], [0.3], [-2.0], [0.02], [0.01], [-0.01]]),
    reference_values=np.array([29.0]),
)
PRIOR = TRUTH.matrix * (1.0 + 0.1 * np.random.default_rng(2).normal(size=(6, 6)))
"""Matrix of the workbench: the mounting changed every coefficient by some tenth."""


def moving(label: str, start_degC: float, end_degC: float, *, seed: int, n: int = 300, noise: float = 1.0) -> DataSet:
    """A limb that moves in all ways, at a temperature that rises or falls evenly."""
    rng = np.random.default_rng(seed)
    raw = rng.normal(size=(n, 6)) * [3000, 2500, 2000, 900, 800, 500] + [9000, -4000, 2000, 100, -3000, 5000]
    temperature = np.linspace(start_degC, end_degC, n)[:, None]
    reference = TRUTH.wrench(raw, temperature) + noise * NOISE * rng.normal(size=(n, 6))
    return DataSet(label=label, raw=raw, reference=reference, variables=temperature)


def grid(label: str, temperature_degC: float, *, seed: int, n: int = 200) -> DataSet:
    """A rigid limb that turns slowly: gravity of constant size, the moment a linear function of the force."""
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(n, 3)) + [0.0, 0.0, 0.5]
    force = 40.0 * direction / np.linalg.norm(direction, axis=1, keepdims=True)
    reference = np.hstack([force, np.cross([0.01, -0.02, -0.2], force)])
    temperature = np.full((n, 1), temperature_degC)
    drift = (temperature - TRUTH.reference_values) @ TRUTH.coefficients.T
    raw = np.linalg.solve(TRUTH.matrix, (reference - TRUTH.offset - drift).T).T + rng.normal(size=(n, 6))
    return DataSet(label=label, raw=raw, reference=reference, variables=temperature)


def judged(
    label: str, session: str, start_degC: float, end_degC: float, *, seed: int, n: int = 300, noise: float = 1.0
) -> ValidationSet:
    """A limb that moves in all ways on some day."""
    data = moving(label, start_degC, end_degC, seed=seed, n=n, noise=noise)
    return ValidationSet(
        label=label,
        session=session,
        time_s=0.5 + np.arange(n) / RATE_HZ,
        raw=data.raw,
        reference=data.reference,
        variables=data.variables,
    )


FITTED = (
    grid("grid", 29.0, seed=3),
    grid("grid_2", 42.0, seed=4),
    moving("cold", 29.5, 31.0, seed=5),
    moving("warm", 42.0, 41.0, seed=6),
)
"""Calibration data in the order of the files."""

COMBINATIONS = {
    "grid + cold": ("grid", "cold"),
    "grids + cold": ("grid", "grid_2", "cold"),
    "all": ("grid", "grid_2", "cold", "warm"),
}

JUDGED = (
    judged("one", "day 1", 38.0, 38.2, seed=7),
    judged("two", "day 1", 38.3, 38.4, seed=8, n=431),
    judged("three", "day 2", 27.3, 27.7, seed=9, n=250),
)


@cache
def study() -> Study:
    """Three combinations, nine types, thirteen lambdas, three validation sets of two days; computed once."""
    return run_study(FITTED, COMBINATIONS, JUDGED, prior=PRIOR, variables=[TEMPERATURE], sphere=("grid", "grid_2"))


def errors_by_samples(model: WrenchModel, one: ValidationSet, source: Offset) -> FloatArray:
    """What a model reads less what it should, sample by sample, after the first second; shape (n, 6)."""
    wrench = model.wrench(one.raw, one.variables if model.coefficients.shape[1] else None)
    error = wrench - one.reference
    first = one.time_s < one.time_s[0] + 1.0
    if source is Offset.FIRST_SECOND:
        error = error - error[first].mean(axis=0)
    rest: FloatArray = error[~first]
    return rest
