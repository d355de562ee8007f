# SPDX-License-Identifier: BSD-3-Clause
"""The figures of thesis 5.3 for one sensor, as files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.files import write_bytes_atomically
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.offset_policy import KNOWN_BEFORE, Offset
from forcetorque.experiment.validation_set import ValidationSet
from forcetorque.results.figures.canvas import png_bytes
from forcetorque.study import thesis_tables as tables
from forcetorque.study.candidate import Candidate
from forcetorque.study.one_sensor import WORKBENCH
from forcetorque.study.study import SensorStudy
from forcetorque.study.validation import with_offset

if TYPE_CHECKING:
    from matplotlib.figure import Figure


_PAUSE_S = 2.0
"""Pause that is drawn between validation intervals; s."""


def write_figures(sensor: SensorStudy, folder: Path) -> list[str]:
    """Draw figures 5.2 to 5.7 and 5.9; those over the types are of the best candidate's data set.

    Args:
        sensor: The study of one sensor.
        folder: Folder to write to.

    Returns:
        Names of the files.
    """
    from forcetorque.calibration.figures.excitation import space_figure
    from forcetorque.calibration.figures.lambda_axis import lambda_difference_figure
    from forcetorque.evaluation.figures.matrix_differences import difference_figure

    study = sensor.study
    chosen = study.choices[Offset.FIRST_SECOND].by_magnitude
    data_set = study.candidates[chosen].data_set
    names, differences = tables.matrix_differences(study, data_set)
    unit = "1e-4 N/count"  # that of `tables.DIFFERENCE_UNIT`
    draw: dict[str, Callable[[], Figure]] = {
        "figure_5_2_wrench_space.png": lambda: space_figure(_clouds(sensor)),
        "figure_5_3_matrix_differences.png": lambda: difference_figure(names, differences, unit=unit),
        "figure_5_6_contact_forces.png": lambda: _contact_figure(sensor, FORCE, "N"),
        "figure_5_7_contact_moments.png": lambda: _contact_figure(sensor, MOMENT, "N m"),
        "figure_5_9_measured_and_reference.png": lambda: _comparison_figure(sensor),
    }
    lambdas = {candidate.lambda_counts2 for candidate in study.fits.candidates}
    if study.workbench is not None and len(lambdas) > 1:
        lambdas_of, curves = tables.differences_to_workbench(study, data_set)
        draw["figure_5_4_differences_to_workbench.png"] = lambda: lambda_difference_figure(
            np.array(lambdas_of), curves, unit=unit
        )
        for offset in KNOWN_BEFORE:
            name = f"figure_5_5_mean_forces_offset_{offset.replace('-', '_')}.png"
            draw[name] = partial(_lambda_force_figure, sensor, offset)
    for name, figure in draw.items():
        write_bytes_atomically(folder / name, png_bytes(figure()))
    return sorted(draw)


def _clouds(sensor: SensorStudy) -> dict[str, FloatArray]:
    kinds: dict[str, list[FloatArray]] = {}
    for interval in sensor.data.calibration:
        kinds.setdefault(interval.kind, []).append(interval.part.samples.reference)
    return {kind: np.concatenate(parts) for kind, parts in kinds.items()}


def _lambda_force_figure(sensor: SensorStudy, offset: Offset) -> Figure:
    from forcetorque.study.figures.contact_force import lambda_force_figure

    study = sensor.study
    pooled, best = study.judgements[offset].over(), study.choices[offset].by_magnitude
    curves: dict[str, dict[str, list[float]]] = {}
    for candidate, value in zip(study.fits.candidates, pooled.force_mean, strict=False):
        curves.setdefault(candidate.data_set, {}).setdefault(candidate.kind.name, []).append(float(value))
    lambdas = list(dict.fromkeys(candidate.lambda_counts2 for candidate in study.fits.candidates))
    chosen = study.candidates[best]
    first = len(study.fits.candidates)
    default = pooled.force_mean[first : first + len(study.generative)]
    return lambda_force_figure(
        np.array(lambdas),
        {name: {kind: np.array(values) for kind, values in types.items()} for name, types in curves.items()},
        workbench=float(pooled.force_mean[-1]),
        generative=float(default.min()) if len(default) else None,
        chosen=(chosen.data_set, chosen.kind.name, chosen.lambda_counts2) if isinstance(chosen, Candidate) else None,
    )


def _judged_models(sensor: SensorStudy, session: str) -> dict[str, tuple[WrenchModel, Offset]]:
    """The candidates of figures 5.6 and 5.7 in a session, with the offset that each is judged with."""
    models = {}
    if sensor.study.workbench is not None:
        models[WORKBENCH] = (sensor.study.workbench, Offset.FIRST_SECOND)
    for offset in KNOWN_BEFORE:
        for name, key in (("best", "best"), ("best by axis", "best_by_axis")):
            calibration = sensor.calibrations[f"{key}_offset_{offset.replace('-', '_')}"]
            models[f"{name}, offset {offset}"] = (calibration.in_session(session).model, offset)
    return models


def _contact_figure(sensor: SensorStudy, axes: slice, unit: str) -> Figure:
    from forcetorque.estimation.figures import contact_figure

    sets = [interval.validation_set for interval in sensor.data.validation]
    errors: dict[str, list[FloatArray]] = {}
    for one in sets:
        for name, (model, offset) in _judged_models(sensor, one.session).items():
            errors.setdefault(name, []).append((with_offset(model, one, offset) - one.reference)[:, axes])
    candidates = {name: np.concatenate(parts) for name, parts in errors.items()}
    time, spans = _joined_time(sets)
    return contact_figure(time, candidates, unit=unit, spans=spans)


def _joined_time(sets: Sequence[ValidationSet]) -> tuple[FloatArray, list[tuple[str, int, int]]]:
    """One time axis for all validation intervals, and where each lies on it."""
    parts, spans, start, first = [], [], 0.0, 0
    for one in sets:
        parts.append(start + one.time_s - one.time_s[0])
        spans.append((one.label, first, first + len(one.time_s)))
        start, first = float(parts[-1][-1]) + _PAUSE_S, first + len(one.time_s)
    return np.concatenate(parts), spans


def _comparison_figure(sensor: SensorStudy) -> Figure:
    from forcetorque.evaluation.figures.errors import comparison_figure

    sets = [interval.validation_set for interval in sensor.data.validation]
    liveliest = max(sets, key=lambda one: float(one.reference[:, :3].var(axis=0).sum()))
    candidates = {
        name: with_offset(model, liveliest, offset)
        for name, (model, offset) in _judged_models(sensor, liveliest.session).items()
        if name in (WORKBENCH, f"best, offset {Offset.FIRST_SECOND}")
    }
    return comparison_figure(liveliest.time_s, liveliest.reference, candidates)
