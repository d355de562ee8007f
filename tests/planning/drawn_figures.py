# SPDX-License-Identifier: BSD-3-Clause
"""The figures of plans, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.planning.figures import joint_plan_figure, plan_figure
from forcetorque.planning.joint_calibration_plan import JointPlan, JointPlanStep, SensorForecast
from tests.planning.plans import plan_of, planned_recording


def draw_plan(rng: np.random.Generator) -> Figure:
    """Three recordings whose errors fall; only forces have a limit."""
    errors = np.sort(rng.uniform(0.5, 4.0, 3))[::-1].tolist()
    recordings = [planned_recording(k + 1, error, 0.05 * error, moment=np.inf) for k, error in enumerate(errors)]
    return plan_figure(plan_of(*recordings).model_copy(update={"sensor": "_arm $ft$"}))


def draw_joint_plan(rng: np.random.Generator) -> Figure:
    """Two recordings for three sensors, one of which has no limit of moments."""
    steps = [
        JointPlanStep(step=k, recording=f"_motion $ {k}", sensors=3, excess_before=2.0 / k, excess_after=1.0 / k)
        for k in (1, 2)
    ]
    sensors = [
        SensorForecast(
            step=step.step,
            sensor=f"_leg $ {k}",
            load_case="distal links",
            force_before_N=4.0 + k,
            force_after_N=float(rng.uniform(0.5, 3.0)) / step.step,
            force_after_at_most_N=4.0,
            force_allowed_N=2.0,
            moment_before_Nm=0.3,
            moment_after_Nm=float(rng.uniform(0.05, 0.2)) / step.step,
            moment_after_at_most_Nm=0.4,
            moment_allowed_Nm=np.inf if k == 2 else 0.1,
        )
        for step in steps
        for k in range(3)
    ]
    return joint_plan_figure(JointPlan(steps=tuple(steps), sensors=tuple(sensors), advice="record both"))
