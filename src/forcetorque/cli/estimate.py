# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate`: contact wrenches, joint torques and expected readings of a recording."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import IntervalEstimates, corrections_of, estimate_experiment
from forcetorque.arrays import FloatArray
from forcetorque.cli.output import Format, console, finite_or_none, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.errors import ForceTorqueError
from forcetorque.evaluation import WrenchErrors, wrench_errors
from forcetorque.exchange.estimates_table import SUFFIXES, EstimatedSpan, write_estimates
from forcetorque.experiment import Experiment
from forcetorque.experiment.contacts import contact_in_words
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording.alignment import seconds_since


class ContactRow(BaseModel):
    """One contact over one interval."""

    interval: str
    """Label of the interval."""
    contact: str
    """Name of the contact."""
    samples: int
    """Number of samples with an estimate."""
    force_mean_N: float | None
    """Mean norm of the force."""
    force_standard_error_N: float | None
    """Standard error of that mean, from ten contiguous blocks."""
    force_largest_N: float | None
    """Largest norm of the force."""
    moment_mean_Nm: float | None
    """Mean norm of the moment."""


class PartRow(BaseModel):
    """The equation of one sub-model over one interval."""

    interval: str
    """Label of the interval."""
    part: str
    """Sensor at its base, or the support frame."""
    rank: int
    """Smallest rank over the samples."""
    condition_largest: float | None
    """Largest condition over the samples."""
    residual_force_mean_N: float | None
    """Mean norm of the force that its contacts leave unexplained."""
    residual_moment_mean_Nm: float | None
    """Mean norm of the moment that they leave unexplained."""
    ambiguous: list[list[str]]
    """Groups of unknowns that cannot be told apart."""


class EstimateResult(BaseModel):
    """What `forcetorque estimate` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/estimate/1"] = Field(default="forcetorque/estimate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    file: str
    """File with every sample."""
    rows: int
    """Its number of rows."""
    readings: dict[str, str]
    """By sensor, how its reading became a wrench."""
    contacts: list[ContactRow]
    """One per interval and contact."""
    parts: list[PartRow]
    """One per interval and sub-model."""
    left_out: list[str]
    """What the log does not allow to estimate."""


def run(
    path: Path,
    *,
    output: Path,
    calibrations: list[Path] | None,
    contacts: list[str] | None,
    length_scale: float | None,
    output_format: Format,
) -> None:
    """Estimate over the intervals of an experiment.

    Args:
        path: Experiment file.
        output: File for every sample, .parquet or .csv.
        calibrations: Calibration files; sensors without one are read through their prior.
        contacts: Contacts in words, in place of the experiment's.
        length_scale: Moment that weighs as much as one newton; m.
        output_format: Form of the result.

    Raises:
        ForceTorqueError: If the file cannot be of the wanted form.
    """
    log = start_logging()
    if output.suffix not in SUFFIXES:
        raise ForceTorqueError(f"--output {output}: expected a name that ends in {' or '.join(SUFFIXES)}")
    loaded = read_calibrations(calibrations)
    experiment = read_experiment(path, log)
    with stated_in(str(path)):
        named = None if not contacts else [contact_in_words(text, experiment.model) for text in contacts]
        corrections = corrections_of(experiment, loaded)
        for sensor, correction in corrections.items():
            log.info("%s: %s", sensor, correction.source)
        with _Progress() as progress:
            spans = estimate_experiment(
                experiment, corrections, contacts=named, length_scale=length_scale, progress=progress.show
            )
    left_out = list(dict.fromkeys(text for span in spans for text in span.left_out))
    for text in left_out:
        log.warning("left out: %s", text)
    rows = write_estimates(output, [_for_table(experiment, span) for span in spans], experiment.model)
    result = EstimateResult(
        experiment=experiment.name,
        file=str(output),
        rows=rows,
        readings={sensor: correction.source for sensor, correction in corrections.items()},
        contacts=[row for span in spans for row in _contact_rows(span)],
        parts=[row for span in spans for row in _part_rows(span)],
        left_out=left_out,
    )
    flat = [row.model_dump() for row in result.contacts]
    print_result(
        result.model_dump(mode="json", by_alias=True),
        flat,
        output_format,
        show=lambda: _show(result),
        columns=list(ContactRow.model_fields),
    )


class _Progress:
    """A bar on standard error, where somebody looks at it."""

    def __enter__(self) -> _Progress:
        from rich.console import Console
        from rich.progress import Progress

        self.bar = Progress(console=Console(file=sys.stderr), transient=True, disable=not sys.stderr.isatty())
        self.bar.start()
        self.task = self.bar.add_task("estimating", total=None)
        return self

    def __exit__(self, *_: object) -> None:
        self.bar.stop()

    def show(self, done: int, total: int) -> None:
        self.bar.update(self.task, completed=done, total=total)


def _for_table(experiment: Experiment, span: IntervalEstimates) -> EstimatedSpan:
    return EstimatedSpan(
        label=span.interval.label,
        stamp_ns=span.stamp_ns,
        time_s=seconds_since(span.stamp_ns, experiment.recording.start_ns),
        measured=span.measured,
        estimates=span.estimates,
    )


def _contact_rows(span: IntervalEstimates) -> list[ContactRow]:
    rows = []
    for name in span.estimates.layout.contacts:
        count, norms = _norms(span.estimates.contact(name))
        rows.append(
            ContactRow(
                interval=span.interval.label,
                contact=name,
                samples=count,
                force_mean_N=None if norms is None else norms.force_mean,
                force_standard_error_N=None if norms is None else finite_or_none(norms.force_mean_error),
                force_largest_N=None if norms is None else norms.force_largest,
                moment_mean_Nm=None if norms is None else norms.moment_mean,
            )
        )
    return rows


def _part_rows(span: IntervalEstimates) -> list[PartRow]:
    rows = []
    estimates = span.estimates
    for k, part in enumerate(estimates.layout.parts):
        whole = np.isfinite(estimates.residual[:, k]).all(axis=1)
        _, norms = _norms(estimates.residual[:, k])
        condition = estimates.condition[:, k][np.isfinite(estimates.condition[:, k])]
        rows.append(
            PartRow(
                interval=span.interval.label,
                part=part,
                rank=int(estimates.rank[whole, k].min()) if whole.any() else 0,
                condition_largest=float(condition.max()) if len(condition) else None,
                residual_force_mean_N=None if norms is None else norms.force_mean,
                residual_moment_mean_Nm=None if norms is None else norms.moment_mean,
                ambiguous=[list(group) for group in span.ambiguous.get(part, ())],
            )
        )
    return rows


def _norms(wrench: FloatArray) -> tuple[int, WrenchErrors | None]:
    """Number of samples without a gap, and their norms: errors against nothing touching."""
    whole = wrench[np.isfinite(wrench).all(axis=1)]
    return len(whole), wrench_errors(whole, np.zeros_like(whole)) if len(whole) else None


def _show(result: EstimateResult) -> None:
    screen = console()
    made = table("contact", "interval", "samples", "force, N", "largest, N", "moment, N m", title=result.experiment)
    for row in result.contacts:
        error = "" if row.force_standard_error_N is None else f" ±{row.force_standard_error_N:.2f}"
        made.add_row(
            row.contact,
            row.interval,
            str(row.samples),
            _number(row.force_mean_N, 2) + error,
            _number(row.force_largest_N, 2),
            _number(row.moment_mean_Nm, 3),
        )
    screen.print(made)
    made = table("sub-model", "interval", "rank", "condition", "residual, N", "residual, N m")
    for part in result.parts:
        made.add_row(
            part.part,
            part.interval,
            str(part.rank),
            _number(part.condition_largest, 1),
            _number(part.residual_force_mean_N, 2),
            _number(part.residual_moment_mean_Nm, 3),
        )
    screen.print(made)
    for part in result.parts:
        for group in part.ambiguous:
            screen.print(f"{part.part}, {part.interval}: cannot tell apart {', '.join(group)}", soft_wrap=True)
    screen.print("force and moment: mean norms of what the environment does to the robot, in the contact frame")
    screen.print(f"{result.rows} rows written to {result.file}", soft_wrap=True)


def _number(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f}"
