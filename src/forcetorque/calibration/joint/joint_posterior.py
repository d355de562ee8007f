# SPDX-License-Identifier: BSD-3-Clause
"""What a joint fit knows of all sensors together, in one file beside the calibrations."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Field

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.atomic import write_bytes_atomically
from forcetorque.calibration.artefact import JOINT_SCHEMA
from forcetorque.calibration.joint.fit import JointFit
from forcetorque.calibration.joint.windows import LENGTH_M
from forcetorque.output_file import refuse_output
from forcetorque.part import Part, read_part


class JointSensor(Part):
    """A sensor of a joint fit: 36 unknowns D row by row, with `wrench = (1 + D) prior raw + offset`."""

    name: str
    """Name in the robot model."""
    serial: str
    """Serial number."""


class JointOffset(Part):
    """An offset of a joint fit: six unknowns."""

    sensor: str
    """Name of the sensor."""
    session: str
    """Session."""


class JointTerm(Part):
    """An error of the robot model or of the IMU: one unknown."""

    name: str
    """What it is."""
    unit: str
    """Its unit; empty for a relative one."""
    prior_deviation: float = Field(gt=0.0)
    """Standard deviation before any data."""


class JointPosterior(Part):
    """Mean and covariance of all that was unknown: changes of the sensors, then offsets, then errors of the model."""

    model_config = ConfigDict(
        defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True
    )

    schema_name: Literal["forcetorque/joint/1"] = Field(default=JOINT_SCHEMA, alias="schema")
    """Form of the file."""
    sensors: tuple[JointSensor, ...]
    """Sensors."""
    offsets: tuple[JointOffset, ...]
    """Offsets."""
    terms: tuple[JointTerm, ...]
    """Errors of the model."""
    length_m: float = LENGTH_M
    """Forces count in N, moments in N m over this length."""
    mean: Annotated[FloatArray, ArrayField((None,))]
    """Most probable values; shape (p,)."""
    covariance: Annotated[FloatArray, ArrayField((None, None))]
    """Their covariance; shape (p, p)."""

    @classmethod
    def of(cls, fit: JointFit, serials: dict[str, str]) -> Self:
        """Keep what a fit knows.

        Args:
            fit: The fit.
            serials: Serial numbers by the names of the sensors.

        Returns:
            The same for a file.
        """
        places = fit.places
        return cls(
            sensors=tuple(JointSensor(name=name, serial=serials[name]) for name in places.sensors),
            offsets=tuple(JointOffset(sensor=sensor, session=session) for sensor, session in places.offsets),
            terms=tuple(
                JointTerm(name=term.name, unit=term.unit, prior_deviation=term.deviation) for term in places.terms
            ),
            mean=fit.mean,
            covariance=fit.covariance,
        )

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write it as JSON; on any error the file keeps what it held before.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            OutputError: If the file is an input of it, or a file that `force` is needed for.
        """
        refuse_output(path, force=force)
        content: dict[str, Any] = self.model_dump(mode="json", by_alias=True)
        write_bytes_atomically(Path(path), (json.dumps(content, allow_nan=False) + "\n").encode())


def read_joint_posterior(path: Path | str) -> JointPosterior:
    """Read what `JointPosterior.save` wrote.

    Args:
        path: JSON file.

    Returns:
        The same.
    """
    return read_part(path, JointPosterior, expected="a file of `calibrate --jointly`, there is none")
