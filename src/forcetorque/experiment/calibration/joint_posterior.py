# SPDX-License-Identifier: BSD-3-Clause
"""What a joint calibration knows of all sensors and of the robot model together, as a file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final, Literal

import numpy as np
from pydantic import ConfigDict, Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.stored_table import StoredTable, read_stored_table, write_stored_table
from forcetorque.experiment.calibration.calibration_file import JOINT_SCHEMA
from forcetorque.experiment.calibration.robot_model_error import ModelError

LENGTH_M: Final = 0.1
"""Moment over force that weigh alike: 0.1 N m is as much as 1 N."""


class JointSensor(StoredTable):
    """A sensor of a joint fit: 36 unknowns D row by row.

    `wrench = (1 + D) prior raw + offset + slopes (variables - reference values)`
    """

    name: str
    """Name in the robot model."""
    serial: str
    """Serial number."""


class JointOffset(StoredTable):
    """An offset of a joint fit: six unknowns."""

    sensor: str
    """Name of the sensor."""
    session: str
    """Session."""


class JointSlope(StoredTable):
    """What a unit of a variable adds in a joint fit: six unknowns."""

    sensor: str
    """Name of the sensor."""
    variable: str
    """Name of the variable."""
    unit: str
    """Its unit."""
    reference_value: float
    """Value at which it adds nothing."""


class JointTerm(StoredTable):
    """An error of the robot model or of the IMU: one unknown."""

    name: str
    """What it is."""
    unit: str
    """Its unit; empty for a relative one."""
    prior_deviation: float = Field(gt=0.0)
    """Standard deviation before any data."""


class JointPosterior(StoredTable):
    """Mean and covariance of all that was unknown: changes of the sensors, offsets, slopes, errors of the model."""

    model_config = ConfigDict(
        defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True
    )

    schema_name: Literal["forcetorque/joint/1"] = Field(default=JOINT_SCHEMA, alias="schema")
    """Form of the file."""
    sensors: tuple[JointSensor, ...]
    """Sensors."""
    offsets: tuple[JointOffset, ...]
    """Offsets."""
    slopes: tuple[JointSlope, ...] = ()
    """Slopes by linear variables such as the temperature."""
    terms: tuple[JointTerm, ...]
    """Errors of the model."""
    length_m: float = LENGTH_M
    """Forces count in N, moments in N m over this length."""
    mean: Annotated[FloatArray, ArrayField((None,))]
    """Most probable values; shape (p,)."""
    covariance: Annotated[FloatArray, ArrayField((None, None))]
    """Their covariance; shape (p, p)."""

    @property
    def model_errors(self) -> tuple[ModelError, ...]:
        """What was found of the robot model and the IMU."""
        first = len(self.mean) - len(self.terms)
        deviations = np.sqrt(np.diag(self.covariance)[first:])
        return tuple(
            ModelError(
                name=term.name,
                unit=term.unit,
                value=float(value),
                standard_error=float(deviation),
                tolerance=term.prior_deviation,
            )
            for term, value, deviation in zip(self.terms, self.mean[first:], deviations, strict=True)
        )

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write it as JSON; on any error the file keeps what it held before.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            OutputError: If the file is an input of it, or a file that `force` is needed for.
        """
        write_stored_table(path, self, force=force)


def read_joint_posterior(path: Path | str) -> JointPosterior:
    """Read what `JointPosterior.save` wrote.

    Args:
        path: JSON file.

    Returns:
        The same.
    """
    return read_stored_table(path, JointPosterior, expected="a file of `calibrate --jointly`, there is none")
