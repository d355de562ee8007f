# SPDX-License-Identifier: BSD-3-Clause
"""The figure of studies, of random data."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.study.candidate_fits import WORKBENCH
from forcetorque.study.figures import studies_figure
from forcetorque.study.result import ChosenCandidate, ModeChoice, StudiedSensor, UnfittedLoad

UNKNOWN = UnfittedLoad(push_force_N=None, push_moment_Nm=None, deviation_sd=None)

UNDETERMINED = 8
"""Candidates that the data do not determine, with small errors."""


def draw_studies(rng: np.random.Generator) -> Figure:
    """Two sensors, one with a long name and without a workbench matrix."""
    return studies_figure([_sensor(rng, "arm_ft", 4.0), _sensor(rng, "_left $leg$ " + "x" * 70, None)])


def _sensor(rng: np.random.Generator, name: str, workbench_N: float | None) -> StudiedSensor:
    keys = {offset: f"force_mean_{offset.replace('-', '_')}" for offset in KNOWN_BEFORE}
    rows: list[dict[str, Any]] = [
        {"data_set": "all", "determined": k >= UNDETERMINED}
        | {key: float((0.1 if k < UNDETERMINED else 1.0) * np.exp(rng.normal(0.5, 0.6))) for key in keys.values()}
        for k in range(60)
    ]
    best = {offset: min(row[key] for row in rows[UNDETERMINED:]) for offset, key in keys.items()}
    return StudiedSensor(
        sensor=name,
        serial="FT1",
        folder=None,
        candidates=60,
        generative=0,
        validation_samples=1000,
        combinations=(),
        left_out=(),
        workbench=None if workbench_N is None else _chosen(WORKBENCH, workbench_N),
        modes=tuple(_mode(offset, best[offset]) for offset in KNOWN_BEFORE),
        files=(),
        candidate_rows=(*rows, {"data_set": WORKBENCH} | dict.fromkeys(keys.values(), 0.01)),
    )


def _mode(offset: Offset, force_N: float) -> ModeChoice:
    return ModeChoice(
        offset=offset,
        best=_chosen("all, OnTdTO, lambda 600", force_N),
        by_axis=(),
        by_axis_unfitted=UNKNOWN,
        across_sessions=(),
    )


def _chosen(name: str, force_N: float) -> ChosenCandidate:
    return ChosenCandidate(
        name=name,
        lambda_counts2=None,
        table_lambda_counts2=None,
        relative_lambda=None,
        force_mean_N=force_N,
        force_mean_error_N=0.1 * force_N,
        moment_mean_Nm=0.1,
        mean_absolute=np.full(6, force_N / 3.0),
        unfitted=UNKNOWN,
    )
