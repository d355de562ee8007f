# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a plan, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.planning.figure import plan_figure
from tests.planning.plans import plan_of, planned_recording


def draw_plan(rng: np.random.Generator) -> Figure:
    """Three recordings whose errors fall; only forces have a limit."""
    errors = np.sort(rng.uniform(0.5, 4.0, 3))[::-1].tolist()
    recordings = [planned_recording(k + 1, error, 0.05 * error, moment=np.inf) for k, error in enumerate(errors)]
    return plan_figure(plan_of(*recordings).model_copy(update={"sensor": "_arm $ft$"}))
