# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a live run, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.live.figures import live_figure
from forcetorque.live.result import LivePackets, LiveRun, LiveSensor, Samples


def kept_samples(time_s: FloatArray, came: BoolArray, wrench: FloatArray, half_width: FloatArray) -> Samples:
    """Samples of a run without joints, from its first on."""
    return Samples(
        first=0,
        time_s=time_s,
        stamp_ns=np.rint(1e9 * time_s).astype(np.int64),
        came=came,
        wrench=wrench,
        half_width=half_width,
        reading=np.full_like(wrench, np.nan),
        positions=np.zeros((len(time_s), 0)),
    )


def run_of(rng: np.random.Generator) -> LiveRun:
    """Five sensors, the first with a long name, the second without a posterior; a silence, and samples that lack."""
    names = ("_left $wrist$ " + "x" * 70, *(f"ft_{k}" for k in range(4)))
    time = np.concatenate([0.01 * np.arange(1500), 20.0 + 0.01 * np.arange(1500)])
    wrench = np.cumsum(rng.normal(0.0, np.repeat([0.1, 0.005], 3), (len(time), len(names), 6)), axis=0)
    wrench[700:720] = np.nan
    half_width = np.broadcast_to(np.repeat([0.5, 0.02], 3), wrench.shape).copy()
    half_width[:, 1] = np.nan
    return LiveRun(
        duration_s=35.0,
        ended_by="interrupt",
        stamps="sender",
        sensors=tuple(
            LiveSensor(
                sensor=name,
                serial=f"FT{k}",
                samples=len(time),
                faulty=20,
                not_finite=20,
                saturated=0,
                frozen=0,
                repeated=0,
                late=0,
                device_errors=0,
                refused=0,
                in_contact=0,
                wrench=None,
                bias=None,
                bias_half_width_95=None,
                drift=None,
                taring=False,
            )
            for k, name in enumerate(names)
        ),
        packets=LivePackets(
            received=len(time),
            lost=3,
            repeated=0,
            late=0,
            backwards=0,
            restarts=0,
            unreadable=0,
            oversized=0,
            foreign=0,
            silences=1,
            longest_silence_s=5.0,
            unsent=0,
        ),
        slowest_s=0.001,
        kept=kept_samples(time, np.full(wrench.shape[:2], True), wrench, half_width),
    )


def draw_live(rng: np.random.Generator) -> Figure:
    """More sensors than are drawn."""
    return live_figure(run_of(rng))
