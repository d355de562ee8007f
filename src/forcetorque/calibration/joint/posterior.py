# SPDX-License-Identifier: BSD-3-Clause
"""What a joint fit knows of all sensors together, and of one of them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import ConfigDict, Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.files import write_bytes_atomically
from forcetorque.base.output_file import refuse_output
from forcetorque.base.stored_model import Part, read_part
from forcetorque.calibration.joint.fit import JointFit
from forcetorque.calibration.joint.windows import LENGTH_M, UNITS
from forcetorque.experiment.calibration.artefact import JOINT_SCHEMA
from forcetorque.experiment.calibration.assumptions import LOADS
from forcetorque.experiment.calibration.posterior import Posterior, RowNoise


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


def sensor_posterior(
    fit: JointFit,
    sensor: str,
    sessions: Sequence[str],
    *,
    noise: FloatArray,
    repeatability: float,
    mean_loads: FloatArray,
) -> Posterior:
    """Give mean and covariance of what is unknown of a sensor.

    Args:
        fit: The fit of all sensors.
        sensor: One of them.
        sessions: Its sessions, the last of them last.
        noise: Noise of means over a second; shape (6,); N, N m.
        repeatability: Share of its response by which the sensor differs from one motion to the next.
        mean_loads: Mean load of every session; shape (sessions, 6); N, N m.

    Returns:
        The same by rows, in wrench space.
    """
    factor = np.asarray(np.linalg.inv(fit.change(sensor)), dtype=np.float64)
    offsets = np.stack([fit.offset(sensor, session) for session in sessions])
    jacobian = _jacobian(factor, offsets)
    places = fit.places
    spans = (places.changes(sensor), *(places.offset(sensor, session) for session in sessions))
    own = np.concatenate([np.arange(span.start, span.stop) for span in spans])
    size = np.outer(UNITS, 1.0 / UNITS).ravel()
    units = np.concatenate([size, np.tile(UNITS, len(sessions))])
    joint = jacobian @ (fit.covariance[np.ix_(own, own)] * np.outer(units, units)) @ jacobian.T
    rows = [_places_of_row(row, len(sessions)) for row in range(LOADS)]
    covariance = np.stack([joint[np.ix_(row, row)] for row in rows])
    learnt = covariance[:, :LOADS, :LOADS].copy()
    before = fit.prior_covariance(sensor) * np.outer(size, size)
    return Posterior(
        space="wrench",
        variables=(),
        sessions=tuple(sessions),
        drift=False,
        mean=np.c_[factor - np.eye(LOADS), -factor @ offsets.T],
        covariance=covariance + _repeatability(repeatability, mean_loads),
        learnt_covariance=learnt,
        prior_covariance=np.stack([before[np.ix_(row[:LOADS], row[:LOADS])] for row in rows]),
        to_wrench=fit.change(sensor),
        noise=tuple(RowNoise(white=float(one), time_constant_s=0.0, ratio=0.0) for one in noise),
        accuracy=np.zeros(LOADS),
        repeatability=repeatability,
        load_centre=mean_loads.mean(axis=0),
    )


def _jacobian(factor: FloatArray, offsets: FloatArray) -> FloatArray:
    """Derivative of [E row by row, e of every session] by [D row by row, o of every session]."""
    changes, sessions = LOADS * LOADS, len(offsets)
    jacobian = np.zeros((changes + LOADS * sessions,) * 2)
    jacobian[:changes, :changes] = -np.kron(factor, factor.T)
    for number, offset in enumerate(offsets):
        own = slice(changes + LOADS * number, changes + LOADS * (number + 1))
        # e = -(1 + E) o
        jacobian[own, :changes] = -np.kron(np.eye(LOADS), offset) @ jacobian[:changes, :changes]
        jacobian[own, own] = -factor
    return jacobian


def _places_of_row(row: int, sessions: int) -> list[int]:
    changes = LOADS * LOADS
    return [*range(LOADS * row, LOADS * (row + 1)), *(changes + LOADS * k + row for k in range(sessions))]


def _repeatability(share: float, mean_loads: FloatArray) -> FloatArray:
    """Covariance by motions in which the sensor answers otherwise, about the mean load of each session."""
    jacobian = np.r_[np.eye(LOADS), -mean_loads]
    return np.stack([jacobian @ np.diag(row**2) @ jacobian.T for row in share * np.outer(UNITS, 1.0 / UNITS)])
