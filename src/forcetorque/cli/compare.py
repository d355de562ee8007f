# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque compare`: the spheres of many sensors, mounting conditions and trials in one table and one figure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from forcetorque.analysis import TrialGroup, group_trials, read_trials
from forcetorque.atomic import write_bytes_atomically
from forcetorque.cli.compare_result import CompareResult, flat_rows, group_rows, trial_row
from forcetorque.cli.compare_tables import show
from forcetorque.cli.figure_file import refuse_figure
from forcetorque.cli.output import Format, print_result, start_logging
from forcetorque.cli.reading import read_calibrations
from forcetorque.cli.sphere_result import FailureRow
from forcetorque.errors import ForceTorqueError
from forcetorque.evaluation.sphere import RULE, TOLERANCE


def run(
    paths: Sequence[Path],
    *,
    sensors: Sequence[str] | None,
    calibrations: Sequence[Path] | None,
    intervals: Sequence[str] | None,
    by_interval: bool,
    figure: Path | None,
    output_format: Format,
) -> None:
    """Compare the spheres of sensors over experiments.

    Args:
        paths: Experiment files.
        sensors: Names of sensors; None for all.
        calibrations: Calibration files to compare with the priors.
        intervals: Labels or kinds of the intervals whose motion draws the sphere; None for what each file says.
        by_interval: Whether each interval is a trial of its own.
        figure: PNG file to draw.
        output_format: Form of the result.

    Raises:
        Exit: With code 1 if a file, a sensor or the figure failed; the result has the others.
    """
    log = start_logging()
    refuse_figure(figure)
    loaded = read_calibrations(calibrations)
    trials, failed = read_trials(
        paths, sensors=sensors, calibrations=loaded, intervals=intervals, by_interval=by_interval, progress=log.info
    )
    failures = [FailureRow(file=each.file, sensor=each.sensor, message=each.message) for each in failed]
    for each in failures:
        log.warning("failed: %s", each.message)
    groups, warnings = group_trials(trials, progress=log.info)
    for line in warnings:
        log.warning("%s", line)
    for trial in trials:
        if trial.sphere.fitted_on:
            labels = ", ".join(map(repr, trial.sphere.fitted_on))
            log.warning(
                "%s was fitted on %s of %s, so the verdict on it flatters", trial.sphere.candidate, labels, trial.file
            )
    drawn, not_drawn = _drawn(figure, groups)
    failures += not_drawn
    result = CompareResult(
        tolerance=TOLERANCE,
        rule=RULE,
        figure=drawn,
        trials=[trial_row(trial, k) for group in groups for k, trial in enumerate(group.trials, 1)],
        groups=group_rows(groups),
        failures=failures,
    )
    print_result(
        result.model_dump(mode="json", by_alias=True), flat_rows(result), output_format, show=lambda: show(result)
    )
    if failures:
        raise typer.Exit(1)


def _drawn(figure: Path | None, groups: Sequence[TrialGroup]) -> tuple[str | None, list[FailureRow]]:
    """Draw the figure, and name it if it was drawn; what fails then must not cost the result."""
    if figure is None or not groups:
        return None, []
    from forcetorque.report import index_figure

    try:
        write_bytes_atomically(figure, index_figure(groups))
    except (ForceTorqueError, OSError) as error:
        return None, [FailureRow(file=str(figure), sensor=None, message=" ".join(str(error).split()))]
    return str(figure), []
