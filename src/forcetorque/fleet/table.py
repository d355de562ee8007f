# SPDX-License-Identifier: BSD-3-Clause
"""The sensors of a dataset, those with the largest errors first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any, ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.fleet.parquet_dataset import Dataset, RecordFile
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.number_text import amount, counted
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, table_of

_COLUMNS: Final = ("identity", "start_ns", "end_ns", "findings", "prior_error", "file")
FAR: Final = 2.0
"""Times the median of all sensors from which an error is worth a look (heuristic)."""
_MOST: Final = 4
"""Sensors that the answer lists."""


class FleetSensor(Row):
    """One sensor over all its recordings."""

    robot: Annotated[str, Shown("robot")]
    """Name of the robot in the dataset."""
    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor in the robot model."""
    serial: Annotated[str, Shown("serial")]
    """Its serial number."""
    recordings: Annotated[int, Shown("recordings")]
    """Number of recordings, copies of others included, as in all that follows."""
    duration_s: Annotated[float, Shown("recorded", "s", digits=0)]
    """Length of all recordings together."""
    first_date: Annotated[str, Shown("from")]
    """Day of the first recording, UTC."""
    last_date: Annotated[str, Shown("to")]
    """Day of the last recording, UTC."""
    samples: Annotated[int, Shown("samples")]
    """Samples over which the error of the prior matrix is; 0 for a sensor without one."""
    prior_force_error_N: Annotated[float | None, Shown("force error", "N", digits=2)]
    """Root mean square of the norm of the force error of the prior matrix, its mean in every interval removed; None
    without a prior."""
    prior_moment_error_Nm: Annotated[float | None, Shown("moment error", "N m", digits=3)]
    """The same of the moment error."""
    times_median: Annotated[float | None, Shown("times median", digits=1)]
    """The larger of both errors over the median of all sensors."""
    findings: Annotated[int, Shown("findings")]
    """Number of findings of `inspect` in all recordings."""
    most_frequent_finding: Annotated[str | None, Shown("most frequent")]
    """Kind of finding that most recordings have; None without any."""
    last_file: str
    """Experiment file of the last recording."""

    @property
    def subject(self) -> str:
        """Which sensor it is, for people."""
        return f"{self.robot} {self.sensor} ({self.serial})"


class FleetTable(DrawnResult):
    """Sensors of a dataset, those with the largest errors first."""

    drawn_by: ClassVar[str] = "forcetorque.fleet.figures:fleet_table_figure"

    schema_name: Literal["forcetorque/fleet_table/1"] = Field(default="forcetorque/fleet_table/1", alias="schema")
    """Form of the result."""
    dataset: str
    """Folder of the dataset."""
    recordings: int
    """Number of recordings."""
    sensors: tuple[FleetSensor, ...]
    """One per sensor."""

    def answers(self) -> Iterator[Answer]:
        """Name the sensors with the largest errors.

        Yields:
            One answer each, at most four.
        """
        for row in self.sensors[:_MOST]:
            far = row.times_median is not None and row.times_median >= FAR
            yield Answer(
                subject=row.subject,
                verdict=_error_text(row),
                why=(
                    f"errors of the prior matrix, mean removed, in {counted(row.recordings, 'recording')}; "
                    f"{counted(row.findings, 'finding')}"
                    + (f", mostly {row.most_frequent_finding}" if row.most_frequent_finding else ""),
                    f"{self.dataset} has {counted(len(self.sensors), 'sensor')} in "
                    f"{counted(self.recordings, 'recording')}",
                ),
                step="calibrate it from the dataset",
                command=typed("calibrate", self.dataset, "--sensor", row.serial, "-o", f"{row.serial}.json"),
                concern=Concern.UNCERTAIN if far else Concern.NONE,
            )

    def blocks(self) -> Iterator[Table]:
        """List the sensors.

        Yields:
            A table.
        """
        yield table_of(self.sensors, f"{self.dataset}: sensors, the largest error first")


def _error_text(row: FleetSensor) -> str:
    if row.prior_force_error_N is None or row.prior_moment_error_Nm is None:
        return "NO PRIOR"
    errors = f"{amount(row.prior_force_error_N, 'N')}, {amount(row.prior_moment_error_Nm, 'N m')}"
    return errors if row.times_median is None else f"{errors} ({row.times_median:.1f} x median)"


def fleet_table_of(folder: Path) -> FleetTable:
    """Sum up the sensors of a dataset.

    Args:
        folder: Folder of the dataset.

    Returns:
        The sensors, as `fleet_sensors` sorts them.
    """
    dataset = Dataset.opened(folder)
    return FleetTable(dataset=str(folder), recordings=dataset.recordings, sensors=tuple(fleet_sensors(dataset)))


def fleet_sensors(dataset: Dataset) -> list[FleetSensor]:
    """Sum up the sensors of a dataset.

    Args:
        dataset: The dataset.

    Returns:
        The sensors, those first whose error is largest against the median of all; those without a prior last.
    """
    groups: dict[tuple[str, str], list[RecordFile]] = {}
    for file in dataset.files:
        groups.setdefault((file.robot, file.serial), []).append(file)
    rows = [_sensor(files, dataset.rows(files, _COLUMNS)) for files in groups.values()]
    medians = prior_medians(rows)
    ranked = [row.model_copy(update={"times_median": _times(row, medians)}) for row in rows]
    return sorted(ranked, key=lambda row: (-(row.times_median or 0.0), -row.findings, row.robot, row.serial))


def prior_medians(sensors: Sequence[FleetSensor]) -> tuple[float, float]:
    """Compute the medians of the priors' errors.

    Args:
        sensors: Sensors, those without a prior do not count.

    Returns:
        Median of the force errors and of the moment errors; N, N m; 0 without a prior.
    """
    force, moment = (
        float(np.median([value for row in sensors if (value := getattr(row, name)) is not None] or [0.0]))
        for name in ("prior_force_error_N", "prior_moment_error_Nm")
    )
    return force, moment


def _times(row: FleetSensor, medians: Sequence[float]) -> float | None:
    errors = (row.prior_force_error_N, row.prior_moment_error_Nm)
    ratios = [error / median for error, median in zip(errors, medians, strict=True) if error is not None and median]
    return max(ratios, default=None)


def _sensor(files: Sequence[RecordFile], rows: Sequence[dict[str, Any]]) -> FleetSensor:
    last = max(rows, key=lambda row: (row["start_ns"], row["file"]))
    errors = [row["prior_error"] for row in rows if row["prior_error"] is not None]
    samples = sum(error["samples"] for error in errors)
    force, moment = (
        float(np.sqrt(sum(error[name] for error in errors) / samples)) if samples else None
        for name in ("force_square_N2", "moment_square_Nm2")
    )
    kinds = Counter(kind for row in rows for kind in {finding["kind"] for finding in row["findings"]})
    return FleetSensor(
        robot=files[0].robot,
        sensor=last["identity"]["name"],
        serial=files[0].serial,
        recordings=len(rows),
        duration_s=sum((row["end_ns"] - row["start_ns"]) * 1e-9 for row in rows),
        first_date=min(file.date for file in files),
        last_date=max(file.date for file in files),
        samples=samples,
        prior_force_error_N=force,
        prior_moment_error_Nm=moment,
        times_median=None,
        findings=sum(len(row["findings"]) for row in rows),
        most_frequent_finding=min(kinds, key=lambda kind: (-kinds[kind], kind), default=None),
        last_file=last["file"],
    )
