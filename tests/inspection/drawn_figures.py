# SPDX-License-Identifier: BSD-3-Clause
"""The figure of findings, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.inspection.figures import findings_figure
from forcetorque.inspection.inspect import FindingRow, Inspection


def draw_findings(rng: np.random.Generator) -> Figure:
    """Kinds of two streams with a long name, one of which is about all of the log."""
    kinds = ("contact", "step", "gap", "saturation", "mass")
    rows = tuple(
        FindingRow(
            stream="_left $wrist$ " + "x" * 70 if kind == "gap" else "arm_ft",
            kind=kind,
            channel=None,
            start_s=None if kind == "mass" else float(start),
            end_s=None if kind == "mass" else float(start + length),
            count=3,
            size=float(length),
            unit="N",
            message=f"a {kind}",
        )
        for kind in kinds
        for start, length in zip(np.sort(rng.uniform(0.0, 50.0, 3)), rng.exponential(1.0, 3), strict=True)
    )
    return findings_figure(
        Inspection(
            source="log_$1.csv", streams={}, duration_s=60.0, findings=rows, in_use_s=((0.0, 20.0), (25.0, 55.0))
        )
    )
