# SPDX-License-Identifier: BSD-3-Clause
"""The figure of contacts, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.collisions.figures import collisions_figure, joint_collisions_figure
from forcetorque.collisions.result import (
    CollisionCurve,
    CollisionRow,
    Collisions,
    JointCollisions,
    JointRow,
    SensitivityRow,
    TorqueContactRow,
    TorqueCurve,
)


def draw_collisions(rng: np.random.Generator) -> Figure:
    """Two sensors with a long name, one with contacts that follow each other closely."""
    names = ("_left $leg$ " + "x" * 60, "right")
    time_s = np.arange(0.0, 60.0, 0.05)
    force = np.abs(rng.normal(size=len(time_s)))
    rows = []
    for start in (20.0, 20.6, 40.0):
        inside = (time_s > start) & (time_s < start + 0.4)
        force[inside] += 30.0
        rows.append(
            CollisionRow(
                sensor=names[0],
                interval="watched",
                kind="collision",
                start_s=start,
                end_s=start + 0.4,
                force_N=30.0,
                force_half_width_95_N=2.0,
                direction=(1.0, 0.0, 0.0),
                frame="root",
                impulse_Ns=12.0,
                couple_Nm=0.0,
                couple_half_width_95_Nm=0.1,
                link="lower $leg$",
                other_links=(),
                distance_mm=3.0,
                distance_half_width_95_mm=10.0,
                point_mm=(0.0, 0.0, -100.0),
                over_threshold=20.0,
            )
        )
    sensitivity = tuple(
        SensitivityRow(
            sensor=name,
            smallest_force_N=8.0,
            threshold=40.0,
            tail_decides=False,
            alarms_per_hour=1.0,
            free_s=60.0,
            looked_at_s=60.0,
        )
        for name in names
    )
    curves = tuple(CollisionCurve(sensor=name, time_s=time_s, force_N=force) for name in names)
    return collisions_figure(
        Collisions(experiment="walking", collisions=tuple(rows), sensitivity=sensitivity, curves=curves)
    )


def draw_joint_collisions(rng: np.random.Generator) -> Figure:
    """Two joints, one with a long name, and a contact."""
    time_s = np.arange(0.0, 60.0, 0.05)
    names = ("_joint $1$ " + "x" * 60, "elbow")
    return joint_collisions_figure(
        JointCollisions(
            experiment="arm",
            contacts=(
                TorqueContactRow(
                    interval="watched",
                    start_s=20.0,
                    end_s=20.4,
                    link="link",
                    joint=names[0],
                    torque_Nm=3.0,
                    half_width_95_Nm=0.1,
                    over_threshold=4.0,
                ),
            ),
            joints=tuple(JointRow(joint=name, threshold_Nm=0.5, noise_Nm=0.1, explained_Nm=0.3) for name in names),
            alarms_per_hour=1.0,
            free_s=60.0,
            looked_at_s=60.0,
            curves=tuple(
                TorqueCurve(joint=name, time_s=time_s, over_threshold=rng.normal(size=len(time_s))) for name in names
            ),
        )
    )
