# SPDX-License-Identifier: BSD-3-Clause
"""The tables of thesis 5.3 as rows: tables 5.2 to 5.7 for any sensor."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.study.candidate_fits import WORKBENCH, Study
from forcetorque.study.candidate_selection import Candidate, GenerativeCandidate, lambda_text

Row = dict[str, str | float]
"""One row: cell by heading; numbers in N and N m unless the heading says otherwise."""

DIFFERENCE_UNIT = 1e-4
"""Unit of the differences between matrices in table 5.3 and figure 5.4: 1e-4 N/count and N m/count."""


def squared_errors(study: Study) -> list[Row]:
    """Table 5.2: mean squared error of every type on the data that it was fitted to, at the smallest lambda.

    Returns:
        One row per combination and type, those of the generative fits last; N2, (N m)2 (5.19).
    """
    moments = {combination.name: combination.moments for combination in study.fits.combinations}
    rows = [
        _labelled(candidate) | _axes(moments[candidate.data_set].squared_error(candidate.model))
        for candidate in unregularised(study)
    ]
    return rows + [_labelled(candidate) | _axes(candidate.squared_error) for candidate in study.generative]


def matrix_differences(study: Study, data_set: str) -> tuple[tuple[str, ...], FloatArray]:
    """Table 5.3: mean absolute difference between the matrices of the types, and the workbench's.

    Args:
        study: The study.
        data_set: Combination of data sets.

    Returns:
        Names of the k matrices and their differences, shape (k, k); `DIFFERENCE_UNIT`, rows of N and N m alike.
    """
    named = {} if study.workbench is None else {WORKBENCH: study.workbench.matrix}
    named |= {c.type: c.model.matrix for c in _without_lambda(study) if c.data_set == data_set}
    stacked = np.stack(list(named.values()))
    return tuple(named), np.abs(stacked[:, None] - stacked[None]).mean(axis=(2, 3)) / DIFFERENCE_UNIT


def offsets(study: Study) -> list[Row]:
    """Table 5.4: offset of every type at the smallest lambda, where its variables have their reference values.

    Returns:
        One row per combination and type, those of the generative fits last, in their last session; N, N m.
    """
    return [_labelled(candidate) | _axes(candidate.model.offset) for candidate in _without_lambda(study)]


def mean_forces(study: Study, source: Offset) -> list[Row]:
    """Tables 5.5 and 5.6: mean magnitude of the contact force by combination, type and lambda.

    Args:
        study: The study.
        source: Offset from the first second (5.5) or fitted (5.6).

    Returns:
        One row per combination and type, a column per lambda, headed in both ways, then their mean; N. The generative
        fits, which have no lambda, and the workbench are last.
    """
    force = study.errors[source].pooled().force_mean
    rows: dict[tuple[str, str], Row] = {}
    for candidate, value in zip(study.fits.candidates, force, strict=False):
        row = rows.setdefault((candidate.data_set, candidate.kind.name), _labelled(candidate))
        row[_heading(candidate)] = float(value)
    table = list(rows.values())
    for row in table:
        row["mean"] = float(np.mean([value for value in row.values() if isinstance(value, float)]))
    first = len(study.fits.candidates)
    table += [_labelled(c) | {"mean": float(force[first + k])} for k, c in enumerate(study.generative)]
    if study.workbench is not None:
        table.append({"data_set": WORKBENCH, "type": "", "mean": float(force[-1])})
    return table


def best_by_axis_table(study: Study) -> list[Row]:
    """Table 5.7: the best candidate of every axis in both modes, and the workbench.

    Returns:
        One row per component; mean absolute value in N, N m.
    """
    table = []
    pooled = {source: study.errors[source].pooled().mean_absolute for source in KNOWN_BEFORE}
    for axis, component in enumerate(WRENCH_COMPONENTS):
        row: Row = {"axis": component}
        for source in KNOWN_BEFORE:
            best = study.choices[source].by_axis[axis]
            row[f"best, offset {source}"] = study.name(best)
            row[f"value, offset {source}"] = float(pooled[source][best, axis])
        if study.workbench is not None:
            row[WORKBENCH] = float(pooled[Offset.FIRST_SECOND][-1, axis])
        table.append(row)
    return table


def candidate_rows(study: Study) -> list[Row]:
    """Give everything about every candidate, and the workbench.

    Returns:
        One row each: data set, type, lambda in three conventions, whether the data determine it, since nothing else is
        chosen, mean errors in both modes; N, N m. Then, where the true matrix is known, the error of pushes that were
        not recorded; and how many standard deviations of the generative fit of the same data set they are
        read from what that reads.
    """
    pooled = {source: study.errors[source].pooled() for source in KNOWN_BEFORE}
    spread = {source: study.errors[source].standard_error() for source in KNOWN_BEFORE}
    table = []
    for index in range(len(study.models)):
        row: Row = {"data_set": WORKBENCH}
        candidate = study.candidates[index] if index < len(study.candidates) else None
        if candidate is not None:
            row = _labelled(candidate) | {"determined": candidate.determined}
        if isinstance(candidate, Candidate):
            row |= {
                "lambda_counts2": candidate.lambda_counts2,
                "table_lambda_counts2": candidate.table_lambda,
                "relative_lambda": candidate.relative_lambda,
            }
        for source in KNOWN_BEFORE:
            mode = source.replace("-", "_")
            row[f"force_mean_{mode}"] = float(pooled[source].force_mean[index])
            row[f"force_mean_error_{mode}"] = float(spread[source].force_mean[index])
            row[f"moment_mean_{mode}"] = float(pooled[source].moment_mean[index])
            row |= {f"{key}_{mode}": v for key, v in _axes(pooled[source].mean_absolute[index]).items()}
        table.append(row | _unfitted(study, index))
    return table


def _unfitted(study: Study, index: int) -> Row:
    """What is known of a model at loads that were not fitted."""
    row: Row = {}
    if (push := study.push_error(index)) is not None:
        row |= {"push_force_N": push.force_N, "push_moment_Nm": push.moment_Nm}
    if index < len(study.candidates) and np.isfinite(deviation := float(study.push_deviations[index].max())):
        row["push_deviation_sd"] = deviation
    return row


def differences_to_workbench(study: Study, data_set: str) -> tuple[tuple[float, ...], dict[str, FloatArray]]:
    """Figure 5.4: mean absolute difference to the workbench matrix over lambda.

    Args:
        study: The study, of a sensor with a prior.
        data_set: Combination of data sets.

    Returns:
        Lambdas of (5.4), and by type the differences in `DIFFERENCE_UNIT`.

    Raises:
        FitError: If there is no prior to differ from.
    """
    if study.workbench is None:
        raise FitError("differences to the workbench matrix need one; this sensor has no prior")
    matrix = study.workbench.matrix
    curves: dict[str, list[float]] = {}
    for candidate in study.fits.candidates:
        if candidate.data_set == data_set:
            distance = float(np.abs(candidate.model.matrix - matrix).mean()) / DIFFERENCE_UNIT
            curves.setdefault(candidate.kind.name, []).append(distance)
    lambdas = dict.fromkeys(c.lambda_counts2 for c in study.fits.candidates)
    return tuple(lambdas), {kind: np.array(values) for kind, values in curves.items()}


def unregularised(study: Study) -> Iterable[Candidate]:
    """Give the candidates with the smallest lambda of the sweep.

    Returns:
        One per combination and type.
    """
    smallest = min(candidate.lambda_counts2 for candidate in study.fits.candidates)
    return [candidate for candidate in study.fits.candidates if candidate.lambda_counts2 == smallest]


def _without_lambda(study: Study) -> list[Candidate | GenerativeCandidate]:
    """One candidate per combination and type, then the generative fits."""
    return [*unregularised(study), *study.generative]


def _heading(candidate: Candidate) -> str:
    return f"lambda {lambda_text(candidate.lambda_counts2)} (table {lambda_text(candidate.table_lambda)})"


def _labelled(candidate: Candidate | GenerativeCandidate) -> Row:
    return {"data_set": candidate.data_set, "type": candidate.type}


def _axes(values: FloatArray) -> Row:
    return {component: float(value) for component, value in zip(WRENCH_COMPONENTS, values, strict=True)}
