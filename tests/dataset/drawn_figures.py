# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a checked dataset, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.dataset.figures import episodes_figure
from forcetorque.dataset.result import DatasetCheck, DatasetFinding, EpisodeFieldRow, Kind


def draw_episodes(rng: np.random.Generator) -> Figure:
    """Findings of two fields, one with a long name, and weights of which some are not separable."""
    fields = ("observation.wrench", "_left $wrist$ " + "x" * 70)
    findings = tuple(
        DatasetFinding(
            field=fields[k % 2],
            component="tz" if kind is Kind.STUCK else None,
            kind=kind,
            harm=kind is not Kind.NOISY,
            episodes=tuple(np.flatnonzero(rng.uniform(size=40) < 0.2).tolist()),
            frames=10,
            size=None,
            unit=None,
            message=f"is {kind}",
        )
        for k, kind in enumerate((Kind.DEAD, Kind.STUCK, Kind.TOOL_CHANGE, Kind.NOISY))
    )
    records = tuple(
        EpisodeFieldRow(
            episode=episode,
            field=field,
            frames=70,
            missing=0,
            dead=(),
            stuck_frames=0,
            clipped_frames=0,
            noise_over_usual=1.0,
            weight=None if episode % 7 == 3 else float(rng.normal(7.8, 0.1)),
            weight_error=None if episode % 7 == 3 else 0.1,
        )
        for episode in range(40)
        for field in fields
    )
    return episodes_figure(
        DatasetCheck(
            source="pick_$1",
            version="v3.0",
            fps=30.0,
            episodes=40,
            frames=2800,
            fields=fields,
            findings=findings,
            not_checked=(),
            records_of_episodes=records,
        )
    )
