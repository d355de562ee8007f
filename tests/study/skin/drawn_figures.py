# SPDX-License-Identifier: BSD-3-Clause
"""The figure of `study skin`, of random data, and the trials that it is made of."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.study.figures import skin_study_figure
from forcetorque.study.skin.load_trial import LoadTrial
from forcetorque.study.skin.raised_leg import LOADS, LoadTruth
from forcetorque.study.skin.result import skin_study

KNEE_NM = 4.5
SIMPLE_GAIN = 0.8
"""Of the simple force; the interpolated one has 1."""
FT_ERROR_NM, SKIN_ERROR_NM, HOT_ERROR_NM = 0.1, 0.2, 2.0
"""Constant errors of the torques."""
LOST_NM_PER_DEG = 0.01
"""What the torque of skin loses by a degree of lean."""


def made_trials(rng: np.random.Generator, trials: int = 3, *, noise: float = 0.1) -> list[list[LoadTrial]]:
    """Trials of all loads with stated errors, and noise in N and, a tenth as large, in N m."""

    def torque(error: float) -> np.ndarray:
        return KNEE_NM + error + 0.1 * noise * rng.normal(size=20)

    return [
        [
            LoadTrial(
                truth=LoadTruth(load=load, wrench=np.zeros(6), along_N=1.0, knee_Nm=KNEE_NM, peak_Pa=4e4),
                simple_N=SIMPLE_GAIN * load.mass_kg * STANDARD_GRAVITY + noise * rng.normal(),
                interpolated_N=load.mass_kg * STANDARD_GRAVITY + noise * rng.normal(),
                beyond_range=load.mass_kg == 3.0 and not load.on_top,
                ft_Nm=torque(FT_ERROR_NM),
                skin_Nm=torque(SKIN_ERROR_NM - LOST_NM_PER_DEG * (90 - load.degrees)),
                hot_Nm=torque(HOT_ERROR_NM),
            )
            for load in LOADS
        ]
        for _ in range(trials)
    ]


def draw_skin_study(rng: np.random.Generator) -> Figure:
    """Errors by load and angle, beside those of the thesis."""
    return skin_study_figure(skin_study(made_trials(rng), layout="right_leg_lower.txt", taxels=380, seed=1))
