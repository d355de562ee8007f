# SPDX-License-Identifier: BSD-3-Clause
"""Small sources of torques whose errors are drawn as they state them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.estimation.torque.torque_source import TorqueSource

JOINTS = ("knee", "hip")
RATE_HZ = 20.0
SAMPLES = 400


def truth(samples: int = SAMPLES) -> FloatArray:
    """Torques that two joints bear; shape (n, 2); N m."""
    time_s = np.arange(samples) / RATE_HZ
    return np.stack([3.0 * np.sin(time_s), 2.0 + np.cos(0.7 * time_s)], axis=1)


def stamps(samples: int = SAMPLES) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """Instants; ns."""
    return np.arange(samples, dtype=np.int64) * round(1e9 / RATE_HZ)


def source(name: str, rng: np.random.Generator, *, noise: float, offset: float, samples: int = SAMPLES) -> TorqueSource:
    """A source with correlated noise and an offset per joint, drawn as it says."""
    root = noise * np.array([[1.0, 0.0], [0.5, 0.8]])
    lasting = np.broadcast_to(offset * np.eye(2), (samples, 2, 2))
    errors = rng.standard_normal((samples, 2)) @ root.T + lasting[0] @ rng.standard_normal(2)
    return TorqueSource(
        name=name,
        joints=JOINTS,
        stamp_ns=stamps(samples),
        torque=truth(samples) + errors,
        noise=np.broadcast_to(root @ root.T, (samples, 2, 2)),
        lasting=lasting,
    )


def three(seed: int, samples: int = SAMPLES) -> list[TorqueSource]:
    """A precise source, a middling one and a rough one."""
    rng = np.random.default_rng(seed)
    return [
        source("ft", rng, noise=0.05, offset=0.1, samples=samples),
        source("skin", rng, noise=0.2, offset=0.3, samples=samples),
        source("current", rng, noise=0.3, offset=0.2, samples=samples),
    ]


def shifted(one: TorqueSource, by: float) -> TorqueSource:
    """The same source with an error that it does not allow for."""
    return replace(one, torque=one.torque + by)
