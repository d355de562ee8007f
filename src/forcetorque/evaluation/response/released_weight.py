# SPDX-License-Identifier: BSD-3-Clause
"""A weight that hangs on a sensor and is let go: a step of known size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.evaluation.response.even import EvenRecord
from forcetorque.evaluation.response.events import Event
from forcetorque.evaluation.response.ring_down import RingDown, error_of_mean, quiet_noise

SETTLED = 0.3
"""Part of the stretch behind an event that is averaged for the first look at a step, before weights hang again."""


def step_direction(record: EvenRecord, events: tuple[Event, ...]) -> FloatArray:
    """Find the direction of the force that weights took off.

    Args:
        record: Wrenches; shape (n, 6).
        events: Releases.

    Returns:
        Of the mean step, against which the weights pulled; force of size 1, no moment; shape (6,).
    """
    steps = [_step(record.signals[:, :3], event) for event in events]
    mean = np.mean(steps, axis=0)
    return np.concatenate([mean / max(float(np.linalg.norm(mean)), np.finfo(np.float64).tiny), np.zeros(3)])


def gains(
    record: EvenRecord, events: tuple[Event, ...], decays: Sequence[RingDown], weight_N: float
) -> tuple[FloatArray, FloatArray]:
    """Tell what the sensor reads of a newton of each released weight.

    Args:
        record: One signal; shape (n, 1).
        events: Releases.
        decays: The decay behind each.
        weight_N: Force that was let go; N.

    Returns:
        Gains, of one sign with the step, and their standard errors under coloured noise; shapes (k,).
    """
    values = record.signals[:, 0]
    noise = quiet_noise(values, events)
    steps, errors = [], []
    for event, decay in zip(events, decays, strict=True):
        held = values[event.quiet]
        error = 0.0 if noise is None else error_of_mean(len(held), noise)
        steps.append(decay.level - float(held.mean()))
        errors.append(np.hypot(decay.level_error, error))
    return np.array(steps) / weight_N, np.array(errors) / weight_N


def _step(force: FloatArray, event: Event) -> FloatArray:
    behind = force[event.peak : event.after]
    step: FloatArray = behind[: max(1, int(SETTLED * len(behind)))].mean(axis=0) - force[event.quiet].mean(axis=0)
    return step
