# SPDX-License-Identifier: BSD-3-Clause
"""One sample of all sensors in compiled functions: its faults, its wrenches, and their intervals.

Arrays are allocated by the caller, once. Sums are taken in the order of the formulas.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
from numba import njit

from forcetorque.base.compiled_functions import source_digest
from forcetorque.base.units import NORMAL_95
from forcetorque.live import sample_status
from forcetorque.live.option_values import FaultPolicy
from forcetorque.live.sample_status import FAULTS, Status

NEVER = -(2**63)
"""Time of what did not happen yet; ns."""
NOW, BEFORE = 0, 1
"""Places of the times of this sample and of the one before."""
_NOT_FINITE, _SATURATED, _FROZEN = int(Status.NOT_FINITE), int(Status.SATURATED), int(Status.FROZEN)
_REPEATED, _LATE = int(Status.REPEATED), int(Status.LATE)
_VARIANCE = NORMAL_95**2
_FLAG, _HOLD, _REFUSE = range(3)
POLICIES = {FaultPolicy.FLAG: _FLAG, FaultPolicy.HOLD: _HOLD, FaultPolicy.REFUSE: _REFUSE}
"""Numbers of policies in compiled code."""


@cache
def compiled_sample() -> tuple[Callable[..., bool], Callable[..., None]]:
    """Give the functions; the first machine to call it compiles them.

    Returns:
        Functions of s sensors, c channels, v variables and d = 7 + v terms of the error, compiled. The first finds
        faults, writes status and wrenches, and gives whether any sensor has a fault. The second takes bias and weight
        off the wrenches, writes intervals, and does with faults what the policy says.
    """
    source = source_digest(Path(__file__), Path(sample_status.__file__))

    @njit(
        "b1(f8[:,::1], f8[:,::1], f8[:,:,::1], f8[:,:,::1], i8[::1], f8, f8, i8[::1], f8[:,::1], i8[::1], f8[:,::1], "
        "i8[::1])",
        cache=True, error_model="numpy",
    )  # fmt: skip
    def read(
        sample, reference, matrix, to_counts, counts, limit, frozen_after_ns, clock_ns, previous, same_since_ns, load,
        status,
    ):  # fmt: skip
        source  # noqa: B018 - closed over: a change in these files compiles it anew
        sensors, columns = sample.shape
        variables = reference.shape[1]
        channels = columns - 1 - variables
        now, before, faulty = clock_ns[NOW], clock_ns[BEFORE], False
        time = 0
        if now != NEVER and before != NEVER and now <= before:
            time = _REPEATED if now == before else _LATE
        for k in range(sensors):
            for j in range(variables):
                sample[k, channels + j] -= reference[k, j]
            bits = time
            for j in range(columns):
                if not np.isfinite(sample[k, j]):
                    bits |= _NOT_FINITE
                    sample[k, j] = np.nan
            for i in range(counts[k]):
                value = sample[k, i]
                if len(to_counts):
                    value = 0.0
                    for j in range(6):
                        value += to_counts[k, i, j] * sample[k, j]
                if abs(value) >= limit:
                    bits |= _SATURATED
            if now != NEVER and not time:
                same = True
                for j in range(channels):
                    same &= sample[k, j] == previous[k, j]
                    previous[k, j] = sample[k, j]
                if not same:
                    same_since_ns[k] = NEVER
                elif same_since_ns[k] == NEVER:
                    same_since_ns[k] = before
                elif now - same_since_ns[k] > frozen_after_ns:
                    bits |= _FROZEN
            for i in range(6):
                value = 0.0
                for j in range(columns):
                    value += matrix[k, i, j] * sample[k, j]
                load[k, i] = value
            for j in range(variables):
                load[k, 6 + j] = sample[k, channels + j]
            status[k] = bits
            faulty |= bits != 0
        if now != NEVER and not time:
            clock_ns[BEFORE] = now
        return faulty

    @njit(
        "void(f8[:,::1], f8[:,::1], f8[:,::1], f8[:,::1], f8[:,:,:,::1], f8[:,::1], i8, f8[:,:,::1], i8[::1], "
        "f8[:,::1], f8[::1])",
        cache=True, error_model="numpy",
    )  # fmt: skip
    def finish(load, bias, bias_variance, tared, covariance, weight, policy, held, status, half_width, since):
        source  # noqa: B018 - as above
        sensors, terms = load.shape
        for k in range(sensors):
            for i in range(6):
                load[k, i] -= bias[k, i]
            for j in range(terms):
                since[j] = load[k, j] - tared[k, j]
            faulty = status[k] & FAULTS != 0
            for i in range(6):
                variance = _VARIANCE * bias_variance[k, i]
                for a in range(terms):
                    product = 0.0
                    for b in range(terms):
                        product += covariance[k, i, a, b] * since[b]
                    variance += since[a] * product
                half_width[k, i] = np.sqrt(0.0 if variance < 0.0 else variance)
                load[k, i] -= weight[k, i]  # not before: the errors of the matrix act on the weight too
                if policy == _REFUSE and faulty:
                    load[k, i] = half_width[k, i] = np.nan
                elif policy == _HOLD and faulty:
                    load[k, i], half_width[k, i] = held[0, k, i], held[1, k, i]
                elif policy == _HOLD:
                    held[0, k, i], held[1, k, i] = load[k, i], half_width[k, i]

    return read, finish
