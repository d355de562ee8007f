# SPDX-License-Identifier: BSD-3-Clause
"""Sensors made from others whose data are there: with errors of another family, and with eight channels."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import make_pose
from forcetorque.base.wrench import wrench_matrix
from forcetorque.simulation.simulated_sensor import distorted_by_mounting
from tests.calibration.push_error import Case

NOISE_COUNTS = 3.0


def _gains(truth: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Every channel has another gain, by 6 %."""
    return truth * (1.0 + 0.06 * rng.normal(size=truth.shape[1]))


def _frame(truth: FloatArray, rng: np.random.Generator) -> FloatArray:
    """The sensor is turned by 2.3 degrees about some axis and shifted by 4 mm."""
    axis, shift = rng.normal(size=(2, 3))
    rotation = Rotation.from_rotvec(np.deg2rad(2.3) * axis / np.linalg.norm(axis)).as_matrix()
    turned: FloatArray = wrench_matrix(make_pose(rotation, 0.004 * shift / np.linalg.norm(shift))) @ truth
    return turned


def _relative(truth: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Every entry of the relative error is 5 %, in units of the root mean square of the rows of the matrix."""
    size = np.sqrt((truth**2).mean(axis=1))
    changed: FloatArray = (np.eye(6) + 0.05 * rng.normal(size=(6, 6)) * np.outer(size, 1.0 / size)) @ truth
    return changed


FAMILIES: Mapping[str, Callable[[FloatArray, np.random.Generator], FloatArray]] = MappingProxyType(
    {"gains": _gains, "frame": _frame, "relative": _relative}
)
"""Prior matrices of a true one, by what is wrong with them."""


def with_error(case: Case, family: str) -> Case:
    """Give a sensor another prior, the same for all its motions.

    Args:
        case: The sensor and its data.
        family: What is wrong with the prior.

    Returns:
        The same data with that prior.
    """
    return replace(case, prior=FAMILIES[family](case.truth, _drawn(case, family)))


def with_eight_channels(case: Case) -> Case:
    """Add two channels that see mixtures of what the six see, and noise on all eight.

    Args:
        case: A sensor without noise, creep or cross-talk, and its data.

    Returns:
        A sensor of eight channels under the same loads.
    """
    rng = _drawn(case, "eight channels")
    mixture = np.vstack([np.eye(6), rng.normal(size=(2, 6)) / np.sqrt(6.0)])
    truth = np.linalg.pinv(mixture @ np.linalg.inv(case.truth))
    data = []
    for one in case.data:
        counts = one.raw @ mixture.T
        data.append(replace(one, raw=counts + NOISE_COUNTS * rng.normal(size=counts.shape)))
    return replace(case, data=data, truth=truth, prior=distorted_by_mounting(truth, relative=0.06, rng=rng))


def _drawn(case: Case, what: str) -> np.random.Generator:
    return np.random.default_rng([case.seed, *f"{case.sensor} {what}".encode()])
