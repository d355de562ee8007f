# SPDX-License-Identifier: BSD-3-Clause
"""The tables and figures of thesis 5.3 for one sensor, and calibrations of the best candidates, as files."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from forcetorque.analysis import SensorStudy
from forcetorque.arrays import FloatArray
from forcetorque.atomic import write_bytes_atomically
from forcetorque.calibration import WrenchModel, write_calibration
from forcetorque.evaluation import KNOWN_BEFORE, Offset
from forcetorque.study import (
    WORKBENCH,
    ValidationSet,
    tables,
    with_offset,
)

_PAUSE_S = 2.0
"""Pause that is drawn between validation intervals; s."""


def write_tables(made: SensorStudy, folder: Path) -> list[str]:
    """Write tables 5.2 to 5.7, and everything about every candidate.

    Args:
        made: The study of one sensor.
        folder: Folder to write to.

    Returns:
        Names of the files.
    """
    study = made.study
    differences: list[tables.Row] = []
    for combination in study.fits.combinations:
        if any(candidate.data_set == combination.name for candidate in study.fits.candidates):
            names, values = tables.matrix_differences(study, combination.name)
            for name, row in zip(names, values, strict=True):
                cells = dict(zip(names, row.tolist(), strict=True))
                differences.append({"data_set": combination.name, "type": name, **cells})
    content = {
        "table_5_2_squared_errors.csv": tables.squared_errors(study),
        "table_5_3_matrix_differences.csv": differences,
        "table_5_4_offsets.csv": tables.offsets(study),
        "table_5_5_mean_forces_offset_first_second.csv": tables.mean_forces(study, Offset.FIRST_SECOND),
        "table_5_6_mean_forces_offset_fitted.csv": tables.mean_forces(study, Offset.FITTED),
        "table_5_7_best_by_axis.csv": tables.best_by_axis_table(study),
        "candidates.csv": tables.candidate_rows(study),
    }
    for name, rows in content.items():
        write_bytes_atomically(folder / name, _csv(rows))
    return list(content)


def write_calibrations(made: SensorStudy, folder: Path) -> list[str]:
    """Write the calibrations of the best candidates.

    Args:
        made: The study of one sensor.
        folder: Folder to write to.

    Returns:
        Names of the files.
    """
    for name, calibration in made.calibrations.items():
        write_calibration(folder / f"{name}.json", calibration)
    return [f"{name}.json" for name in made.calibrations]


def write_figures(made: SensorStudy, folder: Path) -> list[str]:
    """Draw figures 5.2 to 5.7 and 5.9; those over the types are of the best candidate's data set.

    Args:
        made: The study of one sensor.
        folder: Folder to write to.

    Returns:
        Names of the files.
    """
    from forcetorque.report import figures

    study = made.study
    chosen = study.choices[Offset.FIRST_SECOND].by_magnitude
    data_set = study.fits.candidates[chosen].data_set
    names, differences = tables.matrix_differences(study, data_set)
    unit = "1e-4 N/count"  # that of `tables.DIFFERENCE_UNIT`
    draw: dict[str, Callable[[], bytes]] = {
        "figure_5_2_wrench_space.png": lambda: figures.space_figure(_clouds(made)),
        "figure_5_3_matrix_differences.png": lambda: figures.difference_figure(names, differences, unit=unit),
        "figure_5_6_contact_forces.png": lambda: _contact_figure(made, slice(0, 3), "N"),
        "figure_5_7_contact_moments.png": lambda: _contact_figure(made, slice(3, 6), "N m"),
        "figure_5_9_measured_and_reference.png": lambda: _comparison_figure(made),
    }
    lambdas = {candidate.lambda_counts2 for candidate in study.fits.candidates}
    if study.workbench is not None and len(lambdas) > 1:
        lambdas_of, curves = tables.differences_to_workbench(study, data_set)
        draw["figure_5_4_differences_to_workbench.png"] = lambda: figures.lambda_difference_figure(
            np.array(lambdas_of), curves, unit=unit
        )
        for source in KNOWN_BEFORE:
            name = f"figure_5_5_mean_forces_offset_{source.replace('-', '_')}.png"
            draw[name] = lambda source=source: _lambda_force_figure(made, source)  # type: ignore[misc]
    for name, figure in draw.items():
        write_bytes_atomically(folder / name, figure())
    return sorted(draw)


def _clouds(made: SensorStudy) -> dict[str, FloatArray]:
    kinds: dict[str, list[FloatArray]] = {}
    for interval in made.data.calibration:
        kinds.setdefault(interval.kind, []).append(interval.part.samples.reference)
    return {kind: np.concatenate(parts) for kind, parts in kinds.items()}


def _lambda_force_figure(made: SensorStudy, source: Offset) -> bytes:
    from forcetorque.report.figures import lambda_force_figure

    study = made.study
    pooled, best = study.judgements[source].over(), study.choices[source].by_magnitude
    curves: dict[str, dict[str, list[float]]] = {}
    for candidate, value in zip(study.fits.candidates, pooled.force_mean, strict=False):
        curves.setdefault(candidate.data_set, {}).setdefault(candidate.kind.name, []).append(float(value))
    lambdas = list(dict.fromkeys(candidate.lambda_counts2 for candidate in study.fits.candidates))
    chosen = study.fits.candidates[best]
    return lambda_force_figure(
        np.array(lambdas),
        {name: {kind: np.array(values) for kind, values in types.items()} for name, types in curves.items()},
        workbench=float(pooled.force_mean[-1]),
        chosen=(chosen.data_set, chosen.kind.name, chosen.lambda_counts2),
    )


def _judged_models(made: SensorStudy) -> dict[str, tuple[WrenchModel, Offset]]:
    """The candidates of figures 5.6 and 5.7, with the offset that each is judged with."""
    found = {}
    if made.study.workbench is not None:
        found[WORKBENCH] = (made.study.workbench, Offset.FIRST_SECOND)
    for source in KNOWN_BEFORE:
        mode = source.replace("-", "_")
        found[f"best, offset {source}"] = (made.calibrations[f"best_offset_{mode}"].model, source)
        found[f"best by axis, offset {source}"] = (made.calibrations[f"best_by_axis_offset_{mode}"].model, source)
    return found


def _contact_figure(made: SensorStudy, axes: slice, unit: str) -> bytes:
    from forcetorque.report.figures import contact_figure

    sets = [interval.validation_set for interval in made.data.validation]
    candidates = {
        name: np.concatenate([(with_offset(model, one, source) - one.reference)[:, axes] for one in sets])
        for name, (model, source) in _judged_models(made).items()
    }
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


def _comparison_figure(made: SensorStudy) -> bytes:
    from forcetorque.report.figures import comparison_figure

    sets = [interval.validation_set for interval in made.data.validation]
    liveliest = max(sets, key=lambda one: float(one.reference[:, :3].var(axis=0).sum()))
    candidates = {
        name: with_offset(model, liveliest, source)
        for name, (model, source) in _judged_models(made).items()
        if name in (WORKBENCH, f"best, offset {Offset.FIRST_SECOND}")
    }
    return comparison_figure(liveliest.time_s, liveliest.reference, candidates)


def _csv(rows: Sequence[tables.Row]) -> bytes:
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, fieldnames=names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()
