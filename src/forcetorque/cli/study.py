# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study`: every estimation type, lambda and combination of data sets, and the best of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from forcetorque.analysis import SensorStudy, read_study_data, study_sensor
from forcetorque.calibration import ESTIMATION_TYPES, estimation_type
from forcetorque.cli.output import Format, console, print_result, refuse_output_folder, start_logging, table
from forcetorque.cli.study_files import write_calibrations, write_figures, write_tables
from forcetorque.cli.study_result import ModeResult, SensorStudyResult, StudyResult, sensor_result
from forcetorque.errors import FitError, ForceTorqueError, MissingExtraError
from forcetorque.experiment.inputs import stated_in
from forcetorque.new_folder import new_folder
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.study import SWEEP_LAMBDAS, tables

if TYPE_CHECKING:
    from rich.table import Table


def run(
    paths: Sequence[Path],
    *,
    output: Path,
    sensors: Sequence[str] | None,
    data_sets: Sequence[str] | None,
    kinds: Sequence[str] | None,
    lambdas: Sequence[float] | None,
    sphere: Sequence[str] | None,
    output_format: Format,
) -> None:
    """Study the sensors of several recordings.

    Args:
        paths: Experiment files.
        output: Folder to make.
        sensors: Names of the sensors; all of the first file if None.
        data_sets: `NAME=LABEL,LABEL` with labels or kinds of intervals; every combination of kinds if None.
        kinds: Names of estimation types; all nine if None.
        lambdas: Lambdas of (5.4), as `calibrate` takes them; counts2; the thirteen of the thesis' tables if None.
        sphere: Labels of the intervals that draw the sphere; what the files say if None.
        output_format: Form of the result.
    """
    log = start_logging()
    refuse_output_folder(output)
    combinations = None if data_sets is None else _data_sets(data_sets)
    chosen_kinds = [estimation_type(name) for name in kinds or ESTIMATION_TYPES]
    chosen_lambdas = _lambdas(lambdas)
    created = datetime.now(UTC).isoformat(timespec="seconds")
    found = read_study_data(paths, sensors, progress=log.info)
    results, rows = [], []
    with new_folder(output) as fresh:
        for data in found:
            log.info("studying %s (%s)", data.identity.name, data.identity.serial)
            with stated_in(f"sensor {data.identity.name!r}"):
                made = study_sensor(
                    data,
                    data_sets=combinations,
                    kinds=chosen_kinds,
                    lambdas=chosen_lambdas,
                    sphere=sphere,
                    code_version=version("forcetorque"),
                    created=created,
                    progress=log.info,
                )
            fitted = {interval.session for interval in data.calibration}
            for session in sorted({interval.session for interval in data.validation} & fitted):
                log.warning("session %r is fitted and judged: its score is not what another session gives", session)
            for line in made.study.fits.left_out:
                log.warning("left out: %s", line)
            name = quote(f"{data.identity.name}_{data.identity.serial}", safe=" ")
            files = _write(made, fresh / name)
            results.append(sensor_result(made, folder=str(output / name), files=files))
            rows += [{"sensor": data.identity.name, **row} for row in tables.candidate_rows(made.study)]
    result = StudyResult(experiments=[str(path) for path in paths], folder=str(output), sensors=results)
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))


def _write(made: SensorStudy, folder: Path) -> list[str]:
    log = start_logging()
    folder.mkdir()
    files = [*write_tables(made, folder), *write_calibrations(made, folder)]
    log.info("drawing figures")
    try:
        files += write_figures(made, folder)
    except MissingExtraError as error:
        log.warning("no figures: %s", error)
    return files


def _data_sets(texts: Sequence[str]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for text in texts:
        name, _, words = text.partition("=")
        labels = [word.strip() for word in words.split(",") if word.strip()]
        if not name.strip() or not labels:
            raise ForceTorqueError(f"--data-set: expected NAME=LABEL,LABEL with labels or kinds, got {text!r}")
        if name.strip() in found:
            raise ForceTorqueError(f"--data-set: the name {name.strip()!r} comes twice; name the data sets apart")
        found[name.strip()] = labels
    return found


def _lambdas(given: Sequence[float] | None) -> tuple[float, ...]:
    chosen = tuple(sorted(set(SWEEP_LAMBDAS if given is None else given)))
    if not all(0.0 <= value < math.inf for value in chosen):
        raise FitError(f"--lambda: expected numbers of at least 0 counts2, got {list(chosen)}")
    return chosen


def _show(result: StudyResult) -> None:
    screen = console()
    for sensor in result.sensors:
        screen.print(
            f"{sensor.sensor} ({sensor.serial}): {sensor.candidates} matrices of {len(sensor.combinations)} data sets, "
            f"judged on {sensor.validation_samples} samples that were not fitted",
            soft_wrap=True,
        )
        screen.print(_best_table(sensor))
        screen.print(_axis_table(sensor))
        for mode in sensor.modes:
            if mode.across_sessions:
                screen.print(_session_table(mode))
        for combination in sensor.combinations:
            if combination.excited < combination.channels:
                moved = f"{combination.excited} of {combination.channels}"
                screen.print(f"{combination.name}: loads move only {moved} raw directions", soft_wrap=True)
        screen.print(f"tables, figures and calibrations are in {sensor.folder}", soft_wrap=True)


def _best_table(sensor: SensorStudyResult) -> Table:
    headings = [f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    made = table(
        "candidate", "offset", "force, N", "moment, N m", *headings,
        title="mean contact force where nothing touches; per axis: mean absolute value",
    )  # fmt: skip
    shown = [] if sensor.workbench is None else [(sensor.workbench, "re-estimated")]
    for best, offset in [*shown, *((mode.best, mode.offset) for mode in sensor.modes)]:
        made.add_row(
            best.name,
            offset,
            f"{best.force_mean_N:.3f} ±{best.force_mean_error_N:.3f}",
            f"{best.moment_mean_Nm:.4f}",
            *(f"{value:.3f}" for value in best.mean_absolute),
        )
    return made


def _axis_table(sensor: SensorStudyResult) -> Table:
    made = table("axis", "best", "offset", "value", "workbench", title="best candidate of every axis")
    for mode in sensor.modes:
        for row in mode.by_axis:
            workbench = "-" if row.workbench is None else f"{row.workbench:.4f}"
            made.add_row(row.axis, row.name, mode.offset, f"{row.mean_absolute:.4f}", workbench)
    return made


def _session_table(mode: ModeResult) -> Table:
    made = table(
        "scored on", "chosen on the other sessions", "samples", "force, N", "workbench, N",
        title=f"what to expect on another session, offset {mode.offset}",
    )  # fmt: skip
    for row in mode.across_sessions:
        workbench = "-" if row.workbench_force_mean_N is None else f"{row.workbench_force_mean_N:.3f}"
        made.add_row(row.session, row.chosen, str(row.samples), f"{row.force_mean_N:.3f}", workbench)
    return made
