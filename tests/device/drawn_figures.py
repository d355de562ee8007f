# SPDX-License-Identifier: BSD-3-Clause
"""The figure of requirements, of random data."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from forcetorque.device.figures import requirement_figure
from forcetorque.device.requirements import RequirementRow, Verdict


def draw_requirement(rng: np.random.Generator) -> Figure:
    """Values of every verdict, one of them a temperature and one not computed, of a device with a long name."""
    values = rng.uniform(0.01, 3.0, 6).tolist()
    rows: list[RequirementRow] = [
        RequirementRow(
            number=number,
            requirement="excitation at least that of the 24 positions",
            verdict=Verdict.MET if value <= 1.0 else Verdict.NOT_MET,
            value=60.0 if number == 5 else value,
            limit=1.0,
            unit="degC" if number == 5 else "N m",
            why="",
        )
        for number, value in enumerate(values, start=1)
    ]
    rows.append(RequirementRow(number=9, requirement="cost", verdict=Verdict.NOT_COMPUTED, why=""))
    design: Any = SimpleNamespace(
        device="_rig $1$ " + "x" * 70, sensors=("ft_1",), demands=SimpleNamespace(requirements=rows)
    )
    return requirement_figure(design)
