# SPDX-License-Identifier: BSD-3-Clause
"""Tables of a report, from rows of results."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.acceptance.static_checks import StaticChecks
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.results.number_text import with_error
from forcetorque.results.table import COMPONENTS, Table, short_names

_MOST_ROWS = 200
"""Rows of a table that are shown; the JSON has them all."""


def matrix_table(name: str, calibration: Calibration) -> Table:
    """Show a matrix and offset with their standard errors.

    Args:
        name: Name of the calibration.
        calibration: The calibration.

    Returns:
        A row per component.
    """
    errors, offset_errors = calibration.matrix_standard_error, calibration.offset_standard_error
    rows = []
    for k, component in enumerate(COMPONENTS):
        cells = [
            _scientific(value, None if errors is None else float(errors[k, channel]))
            for channel, value in enumerate(calibration.matrix[k])
        ]
        offset = with_error(
            float(calibration.offset[k]), None if offset_errors is None else float(offset_errors[k]), digits=3
        )
        coefficients = [
            _scientific(v.coefficients[k], None if v.standard_error is None else float(v.standard_error[k]))
            for v in calibration.variables
        ]
        rows.append((component, *cells, offset, *coefficients))
    channels = tuple(f"ch{channel}" for channel in range(calibration.matrix.shape[1]))
    variables = tuple(f"{v.name}, per {v.unit}" for v in calibration.variables)
    return Table(
        caption=f"{name}: matrix per count, offset, and coefficients of variables, ± standard error",
        headings=("", *channels, "offset", *variables),
        rows=tuple(rows),
    )


def noise_table(name: str, posterior: Posterior) -> Table:
    """Show the noise that a generative fit found in every row of its model.

    Args:
        name: Name of the calibration.
        posterior: What it knows.

    Returns:
        A row per component, or per channel where there was no prior of six channels.
    """
    in_wrench = posterior.space == "wrench"
    labels = COMPONENTS if in_wrench else [f"ch{k}, counts" for k in range(len(posterior.noise))]
    rows = tuple(
        (
            label,
            f"{noise.white:.3g}",
            *(
                (f"{math.sqrt(noise.ratio) * noise.white:.3g}", f"{noise.time_constant_s:.3g}", f"{noise.ratio:.3g}")
                if noise.ratio > 0.0
                else ("none", "", "")
            ),
        )
        for label, noise in zip(labels, posterior.noise, strict=True)
    )
    return Table(
        caption=f"{name}: noise of means over a second: a white part and a slow offset, standard deviations",
        headings=("", "white", "slow", "forgets itself in, s", "variance, slow over white"),
        rows=rows,
    )


def static_table(rows: Sequence[StaticChecks]) -> Table:
    """Show resolution and full scale per component.

    Returns:
        A row per candidate and quantity.
    """
    shown: list[tuple[str, ...]] = []
    names = short_names([row.calibration for row in rows])
    for row in rows:
        for label, values in (
            ("resolution, one count rms", row.resolution_rms),
            ("full scale, positive", row.full_scale_positive),
            ("full scale, negative", row.full_scale_negative),
            ("offset change between intervals", row.offset_change),
            ("offset per °C", row.offset_per_degC),
        ):
            if values is not None:
                shown.append((names[row.calibration], label, *(f"{value:.3g}" for value in values)))
        if row.condition is not None:
            shown.append((names[row.calibration], "condition of the matrix", f"{row.condition:.3g}", *[""] * 5))
    return Table(
        caption="What the sensor and its matrix can do", headings=("calibration", "", *COMPONENTS), rows=tuple(shown)
    )


def result_tables(content: Mapping[str, Any]) -> list[Table]:
    """Show the lists of a result of another command.

    Returns:
        A table per list of rows; lists and tables inside a row become columns of their own.
    """
    tables = []
    for key, rows in content.items():
        if not (isinstance(rows, list) and rows and all(isinstance(row, dict) for row in rows)):
            continue
        flat = [dict(_flattened(row)) for row in rows[:_MOST_ROWS]]
        headings = tuple(dict.fromkeys(name for row in flat for name in row))
        more = f"; {len(rows) - len(flat)} more rows are in its file" if len(rows) > len(flat) else ""
        shown = tuple(tuple(_cell(row.get(name)) for name in headings) for row in flat)
        tables.append(Table(caption=key.replace("_", " ") + more, headings=headings, rows=shown))
    return tables


def _flattened(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Plain cells of a row, with the names that lead to them."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from _flattened(part, f"{name} {key}".strip())
    elif isinstance(value, list) and value and all(isinstance(part, (int, float, type(None))) for part in value):
        axes = {3: "xyz", 6: WRENCH_COMPONENTS}.get(len(value), range(len(value)))
        for axis, part in zip(axes, value, strict=True):
            yield f"{name} {axis}", part
    elif isinstance(value, list):
        yield name, ", ".join(str(part) for part in value)
    else:
        yield name, value


def _scientific(value: float, error: float | None) -> str:
    return f"{value:.3e}" if error is None else f"{value:.3e} ±{error:.0e}"


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.5g}"
    return "" if value is None else str(value)
