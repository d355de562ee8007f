# SPDX-License-Identifier: BSD-3-Clause
"""Evaluate calibrations by the blocks of a dataset: errors per axis and verdicts, without samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import ClassVar, Final, Literal

from pydantic import Field

from forcetorque.evaluation.load_cases.validation_evidence import static_loads_text
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, verdict_texts, with_predicted_errors
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.fleet.sensor_evaluation import SensorEvaluation, StoredErrors
from forcetorque.fleet.sensor_record import SensorRecord
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, short_names, table_of

WITHOUT_SAMPLES: Final = (
    "of blocks, not of samples: largest errors, mean norms, the number of independent samples and readings outside the "
    "fitted range need the log"
)
"""What an evaluation by a dataset lacks."""


class DatasetEvaluation(DrawnResult):
    """Errors of calibrations, and of their priors, by the blocks of a dataset."""

    answered_by: ClassVar[str | None] = "forcetorque.fleet.answers:evaluation_answers"

    drawn_by: ClassVar[str] = "forcetorque.evaluation.figures.load_cases:use_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("predicted", "shown_names")

    schema_name: Literal["forcetorque/evaluate_dataset/1"] = Field(
        default="forcetorque/evaluate_dataset/1", alias="schema"
    )
    """Form of the result."""
    dataset: str
    """Folder of the dataset."""
    errors: tuple[StoredErrors, ...]
    """One per sensor, calibration and offset, errors of all recordings pooled."""
    load_cases: tuple[LoadCaseVerdict, ...]
    """One per calibration and load case: whether it may be used."""
    logs: tuple[str, ...]
    """Experiment files of the recordings."""
    left_out: tuple[str, ...] = ()
    """A message for every recording that has readings of a longer one, and therefore does not count."""

    @property
    def predicted(self) -> tuple[LoadCaseVerdict, ...]:
        """Verdicts with a predicted error, which the figure shows.

        Raises:
            ShapeError: As `with_predicted_errors`.
        """
        return with_predicted_errors(self.load_cases)

    @property
    def shown_names(self) -> dict[str, str]:
        """Calibrations by file, as short as they can be told apart."""
        return short_names([row.calibration for row in self.errors])

    def blocks(self) -> Iterator[Table | str]:
        """List errors and verdicts.

        Yields:
            A table, and sentences.
        """
        yield table_of(self.errors, f"{self.dataset}: errors on data that were not fitted")
        yield WITHOUT_SAMPLES
        yield from verdict_texts(self.load_cases)


def evaluate_dataset(dataset: Dataset, calibrations: Mapping[str, Calibration]) -> DatasetEvaluation:
    """Evaluate calibrations on all validation intervals of a dataset.

    Args:
        dataset: The dataset.
        calibrations: Calibrations by name, of any of its sensors.

    Returns:
        Errors and verdicts.

    Raises:
        ExperimentError: If a calibration is of a sensor that is not in the dataset, has seen the samples, or the
            sensor has no validation interval.
    """
    by_serial: dict[str, dict[str, Calibration]] = {}
    for name, calibration in calibrations.items():
        by_serial.setdefault(calibration.sensor.serial, {})[name] = calibration
    parts = [
        evaluate_records(dataset.folder, serial, dataset.records(dataset.of_sensor(serial)), group)
        for serial, group in by_serial.items()
    ]
    if not parts:
        return DatasetEvaluation(dataset=str(dataset.folder), errors=(), load_cases=(), logs=())
    whole = DatasetEvaluation.together(parts)
    return whole.model_copy(update={"logs": tuple(dict.fromkeys(whole.logs))})


def evaluate_records(
    folder: Path, serial: str, records: Sequence[SensorRecord], calibrations: Mapping[str, Calibration]
) -> DatasetEvaluation:
    """Evaluate calibrations of one sensor on its records.

    Args:
        folder: Folder of the dataset.
        serial: Serial number of the sensor.
        records: Its records in the order of time.
        calibrations: Its calibrations by name, at least one.

    Returns:
        Errors and verdicts.
    """
    sensor = SensorEvaluation(folder, serial, records, calibrations)
    rows = tuple(sensor.rows())
    texts = (static_loads_text((row.excitation_N, row.load_N), (row.excitation_Nm, row.load_Nm)) for row in rows)
    flat = (f"{rows[0].sensor}: {text}" for text in texts if text is not None)
    return DatasetEvaluation(
        dataset=str(folder),
        errors=rows,
        load_cases=tuple(sensor.verdicts()),
        logs=tuple(record.file for record in sensor.evaluated),
        left_out=sensor.left_out,
        warnings=tuple(dict.fromkeys((*flat, *sensor.left_out))),
    )
