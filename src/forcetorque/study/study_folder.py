# SPDX-License-Identifier: BSD-3-Clause
"""Studies as a folder: the tables and figures of thesis 5.3, and calibrations of the best candidates."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from urllib.parse import quote

from forcetorque.base.errors import MissingExtraError
from forcetorque.base.output_file import new_folder, write_bytes_atomically
from forcetorque.experiment.calibration.calibration_file import write_calibration
from forcetorque.experiment.validation_offset import Offset
from forcetorque.study import thesis_tables as tables
from forcetorque.study.candidate_fits import Study
from forcetorque.study.figures import write_figures
from forcetorque.study.result import StudiedSensor, Studies, studied_sensor, study_warnings
from forcetorque.study.study import SensorStudy


def write_study_folder(
    folder: Path | str,
    studies: Iterable[SensorStudy],
    *,
    experiments: Sequence[str],
    progress: Callable[[str], None] | None = None,
) -> Studies:
    """Write tables, figures and calibrations of studies, a folder per sensor.

    Args:
        folder: Folder to make; it is there as a whole or not at all.
        studies: Studies of sensors, computed one after the other, so that only one is in memory.
        experiments: Experiment files that were studied.
        progress: Called with what is done next.

    Returns:
        What the studies come to, and the files.

    Raises:
        ForceTorqueError: If the folder is there already.
    """
    output = Path(folder)
    sensors: list[StudiedSensor] = []
    warnings: list[str] = []
    with new_folder(output) as fresh:
        for study in studies:
            name = quote(f"{study.data.identity.name}_{study.data.identity.serial}", safe=" ")
            (fresh / name).mkdir()
            files = [*_write_tables(study.study, fresh / name), *_write_calibrations(study, fresh / name)]
            warnings += study_warnings(study)
            say = progress or (lambda _: None)
            say("drawing figures")
            try:
                files += write_figures(study, fresh / name, say)
            except MissingExtraError as error:
                warnings.append(f"no figures: {error}")
            written = {"folder": str(output / name), "files": tuple(files)}
            sensors.append(studied_sensor(study).model_copy(update=written))
    return Studies(experiments=tuple(experiments), folder=str(output), sensors=tuple(sensors), warnings=tuple(warnings))


def _write_tables(study: Study, folder: Path) -> list[str]:
    """Tables 5.2 to 5.7, and everything about every candidate."""
    content = {
        "table_5_2_squared_errors.csv": tables.squared_errors(study),
        "table_5_3_matrix_differences.csv": _differences(study),
        "table_5_4_offsets.csv": tables.offsets(study),
        "table_5_5_mean_forces_offset_first_second.csv": tables.mean_forces(study, Offset.FIRST_SECOND),
        "table_5_6_mean_forces_offset_fitted.csv": tables.mean_forces(study, Offset.FITTED),
        "table_5_7_best_by_axis.csv": tables.best_by_axis_table(study),
        "candidates.csv": tables.candidate_rows(study),
    }
    for name, rows in content.items():
        write_bytes_atomically(folder / name, _csv(rows))
    return list(content)


def _differences(study: Study) -> list[tables.Row]:
    """Table 5.3 of all combinations, one below the other."""
    rows: list[tables.Row] = []
    for combination in study.fits.combinations:
        if any(candidate.data_set == combination.name for candidate in study.fits.candidates):
            names, values = tables.matrix_differences(study, combination.name)
            for name, row in zip(names, values, strict=True):
                cells = dict(zip(names, row.tolist(), strict=True))
                rows.append({"data_set": combination.name, "type": name, **cells})
    return rows


def _write_calibrations(study: SensorStudy, folder: Path) -> list[str]:
    for name, calibration in study.calibrations.items():
        write_calibration(folder / f"{name}.json", calibration)
    return [f"{name}.json" for name in study.calibrations]


def _csv(rows: Sequence[tables.Row]) -> bytes:
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, fieldnames=names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()
