# SPDX-License-Identifier: BSD-3-Clause
"""The report on a fleet as one HTML page: verdicts first, then what to do, errors over time, loads and failures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Final

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.evaluation.load_cases.verdict import TONES
from forcetorque.fleet.figures import MOST_OVER_TIME, errors_over_time, over_time_figure
from forcetorque.fleet.report import DECISIONS, FleetReport, RankedSensor
from forcetorque.fleet.sensor_evaluation import RecordingError
from forcetorque.results.document.content import (
    Block,
    Document,
    Figure,
    List,
    Picture,
    Section,
    Text,
    Tone,
    Verdict,
    html_bytes,
)
from forcetorque.results.number_text import amount, counted
from forcetorque.results.result import created_now
from forcetorque.results.table import Table, table_of, with_first_column

_NAMED: Final = 10
"""Sensors that a verdict names."""
_HEADINGS: Final = ("rank", "sensor", "verdict", "last error (95 %)", "allowed", "times allowed", "findings", "why")


def write_page(report: FleetReport, path: Path) -> None:
    """Write the report for a browser.

    Args:
        report: The report.
        path: HTML file to write or to replace.

    Raises:
        ForceTorqueError: If the name does not end in .html.
        MissingExtraError: If the extra `report` is not installed.
    """
    if path.suffix.lower() != ".html":
        raise ForceTorqueError(f"--output {path}: expected a name that ends in .html")
    write_bytes_atomically(path, html_bytes(page(report, created=created_now())))


def page(report: FleetReport, *, created: str) -> Document:
    """Lay the report out.

    Args:
        report: The report.
        created: Date and time, ISO 8601 with time zone.

    Returns:
        The document; its pictures are drawn when it is written.
    """
    days = sorted(row.date for row in report.over_time)
    over = f"; validation recordings from {days[0]} to {days[-1]}" if days and days[0] > "1970-01-01" else ""
    sensors, robots = len(report.sensors), len({row.robot for row in report.sensors})
    return Document(
        title="Force-torque sensors of a fleet",
        subtitle=f"{report.dataset}: {counted(sensors, 'sensor')} of {counted(robots, 'robot')} in "
        f"{counted(report.recordings, 'recording')}{over}; forcetorque {version('forcetorque')}",
        created=created,
        sections=tuple(_sections(report)),
    )


def _sections(report: FleetReport) -> Iterator[Section]:
    yield Section(title="Worst sensors first", blocks=(*_verdicts(report), *_ranking(report)))
    yield Section(title="What to do next", blocks=tuple(_steps(report)) or (Text(text="Nothing is to be done."),))
    if report.ranked:
        yield Section(title="Error and offset over time", blocks=tuple(_figures(report)))
    yield Section(title="Coverage by loads", blocks=tuple(_coverage(report)))
    if report.warnings:
        yield Section(title="Warnings", blocks=(List(points=tuple(report.cautions())),))
    if report.unranked:
        table = table_of(report.unranked, "Sensors that were not evaluated, the largest error of the prior first")
        yield Section(title="Sensors without a rank", blocks=(table,))
    failed: Block = Text(text="None.")
    if report.failures:
        failed = table_of(report.failures, "Recordings that could not be added; `fleet run --retry-failed` tries again")
    yield Section(title="Recordings that failed", blocks=(failed,))


def _steps(report: FleetReport) -> Iterator[Text | List]:
    """Every step once, with the sensors that it is for and their commands."""
    points: dict[str, list[str]] = {}
    for row in report.sensors:
        if row.step:
            command = f": `forcetorque {row.command}`" if row.command else ""
            points.setdefault(row.step, []).append(f"{row.subject}{command}")
    for step, own in points.items():
        yield Text(text=step)
        yield List(points=tuple(own))


def _verdicts(report: FleetReport) -> Iterator[Verdict | Text]:
    for decision in DECISIONS:
        rows = [row for row in report.ranked if row.decision == decision]
        if rows:
            yield Verdict(tone=Tone(TONES[decision]), word=decision, text=_names([row.subject for row in rows]))
    if report.unranked:
        names = _names([row.subject for row in report.unranked])
        yield Verdict(tone=Tone.UNKNOWN, word="not evaluated", text=names)
    yield Text(
        text=f"Only sensors that were evaluated have a rank: {len(report.ranked)} of {len(report.sensors)}. "
        "The order is that of the error in the last recording against what is allowed."
    )


def _names(names: Sequence[str]) -> str:
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{len(names)}: {', '.join(names[:_NAMED])}{more}."


def _ranking(report: FleetReport) -> Iterator[Table]:
    if report.ranked:
        yield Table(
            caption="Last error: root mean square in the last recording, of force or moment, whichever is larger "
            "against what is allowed, in means over a second, with its 95 % interval; without its mean where the "
            "sensor is tared before use. Limits in brackets are no limits of [[load_case]], but a share of the loads. "
            "Verdict: by all recordings that were not fitted, and by the last one alone",
            headings=_HEADINGS,
            rows=tuple(map(_row, report.ranked)),
        )


def _row(row: RankedSensor) -> tuple[str, ...]:
    most = "any" if row.error_at_most is None else amount(row.error_at_most, "")
    allowed = "" if row.allowed is None else amount(row.allowed, row.unit)
    return (
        str(row.rank),
        row.subject,
        row.decision,
        f"{amount(row.error, row.unit)} ({amount(row.error_at_least, '')} to {most})",
        allowed if row.allowed_is_specified or not allowed else f"({allowed})",
        "" if row.times_allowed is None else f"{row.times_allowed:.2f}",
        f"{row.findings}{f', mostly {row.most_frequent_finding}' if row.most_frequent_finding else ''}",
        row.reason,
    )


def _figures(report: FleetReport) -> Iterator[Figure]:
    for start in range(0, len(report.ranked), MOST_OVER_TIME):
        rows = report.ranked[start : start + MOST_OVER_TIME]
        drawn = errors_over_time(report, rows)
        yield Figure(
            picture=Picture(lambda drawn=drawn: over_time_figure(drawn)),  # type: ignore[misc]
            caption=f"Sensors {rows[0].rank} to {rows[-1].rank}. Solid: root mean square of the error in a recording "
            "without its mean. Dashed: norm of the mean error with the offset of the calibration.",
            description="Force and moment errors of every recording of "
            + "; ".join(f"{name}: {_text(own)}" for name, own, _ in drawn),
        )


def _text(errors: Sequence[RecordingError]) -> str:
    return ", ".join(
        f"{amount(one.force_error_rms_N, 'N')} and {amount(one.moment_error_rms_Nm, 'N m')}" for one in errors
    )


def _coverage(report: FleetReport) -> Iterator[Table]:
    for caption, key, recordings in (
        ("Calibration intervals", "fitted", "fitted_recordings"),
        ("Validation intervals", "validated", "validation_recordings"),
    ):
        rows = [row for row in report.coverage if getattr(row, recordings)]
        if not rows:
            continue
        shown = [row.model_copy(update={"fitted": getattr(row, key)}) for row in rows]
        table = table_of(
            shown,
            f"{caption}: standard deviation of the expected loads; a component that hardly moved was not tested",
            leave_out=("fitted_recordings", "validation_recordings"),
        )
        yield with_first_column(table, "recordings", [str(getattr(row, recordings)) for row in rows])
