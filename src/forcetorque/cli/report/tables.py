# SPDX-License-Identifier: BSD-3-Clause
"""Tables of a report, from rows of results."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from forcetorque.calibration import Calibration
from forcetorque.cli.accept_result import CriterionRow, MeasuredRow
from forcetorque.cli.report.result import ExperimentReport, SensorReport
from forcetorque.cli.words import with_error
from forcetorque.report.document import Table
from forcetorque.result.names import short_names
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

COMPONENTS = tuple(f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True))
"""Headings of six components."""

_MOST_ROWS = 200
"""Rows of a table that are shown; the JSON has them all."""


def evaluation_table(report: SensorReport) -> Table:
    """Show errors on data that was not fitted.

    Args:
        report: Numbers of the sensor.

    Returns:
        A row per candidate and offset.
    """
    names = short_names([row.candidate for row in report.evaluation])
    independent = {row.candidate: row.independent for row in report.independence}
    rows = []
    for row in report.evaluation:
        known = [count for count in independent.get(row.candidate, []) if count is not None]
        rows.append((
            names[row.candidate], row.offset, *(f"{value:.3f}" for value in row.rmse),
            with_error(row.force_error_mean_N, row.force_error_standard_error_N, digits=2),
            with_error(row.moment_error_mean_Nm, row.moment_error_standard_error_Nm, digits=3),
            str(row.samples), f"{min(known):.0f} to {max(known):.0f}" if known else "-",
        ))  # fmt: skip
    return Table(
        caption="Root mean square error per component, mean norm of the force and moment error ± standard error, "
        "number of samples, and how many independent ones they are worth",
        headings=("candidate", "offset", *COMPONENTS, "force, N", "moment, N m", "n", "independent"),
        rows=tuple(rows),
    )


def contact_table(report: SensorReport) -> Table:
    """Show contact wrenches where nothing touches.

    Args:
        report: Numbers of the sensor.

    Returns:
        A row per candidate and offset.
    """
    names = short_names([row.candidate for row in report.contact_forces])
    return Table(
        caption="Mean absolute contact wrench of the free sub-model, and mean norm of its force ± standard error; it "
        "should be zero",
        headings=("candidate", "offset", *COMPONENTS, "force, N", "moment, N m", "n"),
        rows=tuple(
            (names[row.candidate], row.offset, *(f"{value:.3f}" for value in row.mean_absolute),
             with_error(row.force_mean_N, row.force_mean_error_N, digits=2), f"{row.moment_mean_Nm:.3f}",
             str(row.samples))
            for row in report.contact_forces
        ),
    )  # fmt: skip


def torque_table(report: SensorReport) -> Table:
    """Show errors of joint torques, candidates of a joint next to each other.

    Args:
        report: Numbers of the sensor.

    Returns:
        A row per joint, offset and candidate.
    """
    names = short_names([row.candidate for row in report.joint_torques])
    joints = list(dict.fromkeys(row.joint for row in report.joint_torques))
    ordered = sorted(report.joint_torques, key=lambda row: (joints.index(row.joint), row.offset))
    return Table(
        caption="Torque of each joint as estimated from the sensor, less that of the rigid-body model",
        headings=("joint", "offset", "candidate", "RMSE", "mean", "largest", "unit", "n"),
        rows=tuple(
            (row.joint, row.offset, names[row.candidate], with_error(row.rmse, row.rmse_error, digits=3),
             with_error(row.mean, row.mean_error, digits=3), f"{row.largest:.3f}", row.unit, str(row.samples))
            for row in ordered
        ),
    )  # fmt: skip


def comparison_table(report: SensorReport) -> Table:
    """Show calibrations against their priors.

    Args:
        report: Numbers of the sensor.

    Returns:
        A row per candidate, offset and quantity.
    """
    names = short_names([row.candidate for row in report.evaluation])
    return Table(
        caption="Mean norm of the error against that of the prior on the same samples, and the 95 % interval of the "
        "difference; what is constant in the error another offset would take away",
        headings=(
            "candidate", "prior", "offset", "error of", "mean", "of the prior", "less by", "range", "constant", "unit",
            "independent",
        ),
        rows=tuple(
            (names[row.candidate], names[row.prior], row.offset, row.quantity, f"{row.mean:.3f}",
             f"{row.prior_mean:.3f}", f"{row.gain:.3f}",
             "-" if row.gain_low is None or row.gain_high is None else f"{row.gain_low:.3f} to {row.gain_high:.3f}",
             f"{row.constant:.3f}", row.unit, "-" if row.independent is None else f"{row.independent:.0f}")
            for row in report.comparisons
        ),
    )  # fmt: skip


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


def static_table(rows: Iterable[MeasuredRow]) -> Table:
    """Show resolution and full scale per component.

    Args:
        rows: Static checks.

    Returns:
        A row per candidate and quantity.
    """
    shown: list[tuple[str, ...]] = []
    names = short_names([row.candidate for row in rows])
    for row in rows:
        for label, values in (
            ("resolution, one count rms", row.resolution_rms),
            ("full scale, positive", row.full_scale_positive),
            ("full scale, negative", row.full_scale_negative),
            ("offset change between intervals", row.offset_change),
            ("offset per °C", row.offset_per_degC),
        ):
            if values is not None:
                shown.append((names[row.candidate], label, *(f"{value:.3g}" for value in values)))
        if row.condition is not None:
            shown.append((names[row.candidate], "condition of the matrix", f"{row.condition:.3g}", *[""] * 5))
    return Table(
        caption="What the sensor and its matrix can do", headings=("candidate", "", *COMPONENTS), rows=tuple(shown)
    )


def criteria_table(rows: Sequence[CriterionRow]) -> Table:
    """Show criteria and whether they hold.

    Args:
        rows: Criteria.

    Returns:
        A row per criterion.
    """
    names = short_names([row.candidate for row in rows])
    return Table(
        caption="Criteria of the acceptance file",
        headings=("candidate", "criterion", "measured", "", "limit", "unit", "holds", "where"),
        rows=tuple(
            (names[row.candidate], row.criterion, "infinite" if row.measured is None else f"{row.measured:.4g}",
             "≤" if row.bound == "at most" else "≥", f"{row.limit:.4g}", row.unit, "yes" if row.passed else "NO",
             row.note)
            for row in rows
        ),
    )  # fmt: skip


def interval_table(report: ExperimentReport) -> Table:
    """Show the intervals of an experiment.

    Args:
        report: Its numbers.

    Returns:
        A row per interval.
    """
    return Table(
        caption="Intervals",
        headings=("interval", "use", "from, s", "to, s", "support"),
        rows=tuple(
            (row.label, row.use, f"{row.start_s:.2f}", f"{row.end_s:.2f}", row.support or "-")
            for row in report.intervals
        ),
    )


def stream_table(report: ExperimentReport) -> Table:
    """Show the streams of a recording.

    Args:
        report: Its numbers.

    Returns:
        A row per stream.
    """
    return Table(
        caption="Streams",
        headings=("stream", "samples", "rate, Hz", "quantities"),
        rows=tuple(
            (
                row.stream,
                str(row.samples),
                "-" if row.rate_hz is None else f"{row.rate_hz:.1f}",
                ", ".join(row.quantities),
            )
            for row in report.streams
        ),
    )


def finding_table(report: ExperimentReport) -> Table:
    """Show findings, the longest list cut.

    Args:
        report: Its numbers.

    Returns:
        A row per finding.
    """
    rows = tuple(
        (row.stream, row.kind, row.channel or "", "" if row.start_s is None else f"{row.start_s:.2f}",
         "" if row.end_s is None else f"{row.end_s:.2f}", row.message)
        for row in report.findings[:_MOST_ROWS]
    )  # fmt: skip
    more = len(report.findings) - len(rows)
    return Table(
        caption="Findings about the recording" + (f"; {more} more are in the JSON" if more > 0 else ""),
        headings=("stream", "kind", "channel", "from, s", "to, s", "finding"),
        rows=rows,
    )


def input_table(reports: Sequence[ExperimentReport]) -> Table:
    """Show what was read.

    Args:
        reports: Numbers of every experiment.

    Returns:
        A row per file.
    """
    files = dict(item for report in reports for item in report.inputs_sha256.items())
    return Table(caption="Files that were read", headings=("file", "SHA-256"), rows=tuple(files.items()))


def result_tables(content: Mapping[str, Any]) -> list[Table]:
    """Show the lists of a result of another command.

    Args:
        content: The result.

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
