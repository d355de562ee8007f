# SPDX-License-Identifier: BSD-3-Clause
"""The prior of a sensor, from what its entry states: a file of any known form, or the reading itself."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.input_files import Inputs, stated_in
from forcetorque.experiment.sensor_section import PriorTable, Sensor
from forcetorque.formats.icub_matrix import serial_number_in_name
from forcetorque.formats.prior.prior_file import PriorFile, RawUnit, StatedUnits
from forcetorque.formats.prior.registry import read_prior_file

IDENTITY = "identity"
"""Prior of a sensor whose calibrated reading, a wrench already, takes the place of counts."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StatedPrior:
    """The prior matrix of a sensor."""

    matrix: FloatArray
    """Shape (6, c); N/count, N m/count."""
    source: str
    """Its file, as the experiment names it; `identity` where the reading itself takes the place of counts."""
    full_scale: FloatArray | None = None
    """Full scale that a maker states; shape (6,); N, N m; None to take it from the counts that a channel can have."""


def read_prior(where: str, entry: Sensor, inputs: Inputs) -> StatedPrior | None:
    """Read the prior matrix of a sensor.

    Args:
        where: File and table, for messages.
        entry: The sensor.
        inputs: Resolves and remembers the files.

    Returns:
        The matrix; None where the file states none.

    Raises:
        ExperimentError: If it is that of another sensor, or takes something else than counts.
    """
    if entry.prior is None:
        return None
    if entry.prior == IDENTITY:
        return StatedPrior(matrix=np.eye(6), source=IDENTITY)
    stated = entry.prior if isinstance(entry.prior, PriorTable) else PriorTable(path=Path(entry.prior))
    with stated_in(where):
        units = StatedUnits(force=stated.force_unit, moment=stated.moment_unit)
        _require_serial(serial_number_in_name(stated.path), entry, stated.path)
        file = read_prior_file(inputs.file(stated.path), units)
        _require_serial(file.serial, entry, stated.path)
        scale = _volts_per_count(file, stated)
    maker = file.raw_unit is RawUnit.VOLTS
    return StatedPrior(
        matrix=file.matrix * scale,
        source=stated.path.as_posix(),
        # counts that a board's channel can have say its full scale; volts that a card may see do not
        full_scale=file.full_scale if maker else None,
    )


def full_scale_of(entry: Sensor, prior: StatedPrior | None) -> FloatArray | None:
    """Give the full scale of a sensor.

    Args:
        entry: The sensor.
        prior: Its prior; None for none.

    Returns:
        What the file states, else the maker; shape (6,); N, N m; None where neither does.
    """
    if entry.full_scale is not None:
        return np.array(entry.full_scale)
    return None if prior is None else prior.full_scale


def _require_serial(serial: str | None, entry: Sensor, path: Path) -> None:
    if serial is not None and serial != entry.serial:
        raise ExperimentError(
            f"expected the prior matrix of the sensor {entry.serial!r}, got that of {serial!r} ({path}); every sensor "
            "has its own"
        )


def _volts_per_count(file: PriorFile, stated: PriorTable) -> float:
    """What makes the matrix per count."""
    if file.raw_unit is RawUnit.WRENCH:
        raise ExperimentError(
            f"prior: expected a matrix that takes counts, got {file.form}, which corrects wrenches of another "
            'calibration; apply it to the log, or leave it out, and state prior = "identity" for a stream of wrenches'
        )
    if file.raw_unit is RawUnit.COUNTS:
        if stated.volts_per_count is not None:
            raise ExperimentError(f"prior: expected no volts_per_count: {file.form} is per count; delete it")
        return 1.0
    if stated.volts_per_count is None:
        raise ExperimentError(
            f"prior: expected volts_per_count, for {file.form} is per volt; write prior = {{ path = "
            f'"{stated.path.as_posix()}", volts_per_count = ... }}: the span of the converter over its steps, 1.0 for '
            "a log in volts"
        )
    return stated.volts_per_count
