# SPDX-License-Identifier: BSD-3-Clause
"""Loads that were identified before, with several recordings, or by a sensor whose matrix is known in part."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Final

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ExperimentError, FormatError, known_names
from forcetorque.base.pose import skew
from forcetorque.base.stored_table import read_json
from forcetorque.base.toml_file import first_error
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.raw_counts import full_scale_of, prior_size_of
from forcetorque.payload.export.load_parameters import require_rigid
from forcetorque.payload.identification.estimation_problem import INERTIAL, Load, LoadProblem
from forcetorque.payload.identification.load_estimates import LoadEstimate
from forcetorque.payload.identification.loads_with_intervals import load_estimates
from forcetorque.payload.identification.matrix_uncertainty import MatrixSpread, settled
from forcetorque.payload.identification.parameter_vector import six_of
from forcetorque.payload.identification.robust_fit import fit

SCHEMA = "forcetorque/payload/3"
"""Form of the results that are read."""
MOST_UNCERTAIN: Final = 0.05
"""Half of the 95 % interval of a mass, over the mass, up to which it may stand for a stated one."""
_ROUNDING = np.repeat([1e-4, 1e-5, 1e-6], [1, 3, 6])
"""kg, kg m, kg m2: nothing was weighed better. What was stated there, or follows from what was estimated as the inertia
of a point mass does, has a precision by this; one that is much larger hides from the numbers what is told at all."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadFromFile:
    """A load from an earlier result of `forcetorque payload`."""

    load: Load
    """Expected parameters and their precision; on a wrist sensor as stated."""
    serial: str
    """Serial number of the sensor that identified it."""
    known_loads: tuple[str, ...]
    """Loads of that result that were specified, which determine the scale of the sensor; itself if specified."""

    def circular(self, serial: str) -> Iterator[str]:
        """Warn of a load that a sensor identified by itself, as `AttachedLoads.circular` does of all."""
        if self.serial == serial and not self.known_loads:
            yield (
                f"load {self.load.name!r}: weighed before by this sensor itself ({serial}), beside nothing that was "
                "stated, so its mass has the error that the sensor has, which no calibration or verdict on it can see; "
                "weigh it on a scale, or by another sensor"
            )


class _Row(BaseModel):
    model_config = ConfigDict(frozen=True, arbitrary_types_allowed=True)

    load: str
    estimated: bool
    mass_kg: float | None
    link: str | None = None
    inertial: Annotated[FloatArray, ArrayField((INERTIAL,))] | None = None
    covariance: Annotated[FloatArray, ArrayField((INERTIAL, INERTIAL))] | None = None
    mass_half_width_95_kg: float | None = None
    centre_of_mass_m: tuple[float | None, float | None, float | None] = (None, None, None)
    inertia_kgm2: Annotated[FloatArray, ArrayField((3, 3))] | None = None


class _Weighed(BaseModel):
    model_config = ConfigDict(frozen=True)

    serial: str
    frame: str | None = None
    loads: tuple[_Row, ...]

    def known_loads(self) -> tuple[str, ...]:
        return tuple(row.load for row in self.loads if not row.estimated and row.mass_kg)


def read_load_from_file(file: Path, name: str, link: str) -> LoadFromFile:
    """Read a load from a result of `forcetorque payload`.

    Args:
        file: JSON file.
        name: Name of the load; ignored if the file has one load only.
        link: Link of the load, in whose frame it was identified.

    Returns:
        The load under this name, with its sensor.

    Raises:
        FormatError: If it is no such result.
        ExperimentError: If it has no such load, or the load is undetermined, or in another frame.
    """
    weighed, row = _weighed(file, name)
    if row.link is None:
        raise ExperimentError(
            f"{file}: expected a load that was weighed on a link of a robot, got {row.load!r} in the frame of a "
            "sensor; state mass_kg and centre_of_mass_m in the frame of the link"
        )
    if row.link != link:
        raise ExperimentError(f"{file}: expected a load on the link {link!r}, got {row.load!r} on {row.link!r}")
    if row.inertial is None or row.covariance is None:
        raise ExperimentError(f"{file}: the load {row.load!r} was left open there; weigh it again, or state mass_kg")
    covariance = row.covariance + np.diag(_ROUNDING**2)
    if not np.array_equal(covariance, covariance.T) or np.linalg.eigvalsh(covariance)[0] <= 0.0:
        raise FormatError(f"{file}: loads: covariance: expected a symmetric positive matrix of {row.load!r}")
    load = Load(
        name=name,
        inertia="unknown",
        expected=row.inertial,
        precision=np.asarray(np.linalg.inv(covariance), dtype=np.float64),
    )
    return LoadFromFile(load=load, serial=weighed.serial, known_loads=weighed.known_loads())


def read_wrist_load_from_file(file: Path, name: str, frame: str) -> LoadFromFile:
    """Read a load on a wrist sensor from a result of `forcetorque payload`, as if it were stated.

    Args:
        file: JSON file.
        name: Name of the load; ignored if the file has one load only.
        frame: Frame of the sensor, in which it was identified.

    Returns:
        The load under this name, with its sensor.

    Raises:
        FormatError: If it is no such result, or no rigid body has the inertia.
        ExperimentError: If it has no such load, or the load is undetermined, of negative mass or one that is known to
            less than `MOST_UNCERTAIN`, or in another frame.
    """
    weighed, row = _weighed(file, name)
    if row.link is not None:
        raise ExperimentError(
            f"{file}: expected a load on a wrist sensor, got {row.load!r} on the link {row.link!r} of a robot; state "
            "mass_kg and centre_of_mass_m in the frame of the sensor"
        )
    if weighed.frame != frame:
        was = "a result that names no frame" if weighed.frame is None else f"one in {weighed.frame!r}"
        raise ExperimentError(
            f"{file}: expected a load in the frame {frame!r}, got {was}; weigh it again in this frame, or state "
            "mass_kg and centre_of_mass_m"
        )
    centre = [place for place in row.centre_of_mass_m if place is not None]
    if row.mass_kg is None or row.mass_half_width_95_kg is None or (row.mass_kg and len(centre) < 3):
        raise ExperimentError(f"{file}: the load {row.load!r} was left open there; weigh it again, or state mass_kg")
    if row.mass_kg < 0.0:
        raise ExperimentError(f"{file}: load {row.load!r}: expected a mass of 0 kg or more, got {row.mass_kg:.4g} kg")
    if row.mass_half_width_95_kg > MOST_UNCERTAIN * row.mass_kg:
        raise ExperimentError(
            f"{file}: load {row.load!r}: expected a mass that is known to {100 * MOST_UNCERTAIN:g} % (95 %), for it is "
            f"taken as exact, got {row.mass_kg:.4g} kg +- {row.mass_half_width_95_kg:.2g} kg; weigh it again, in more "
            "poses and for longer, or state mass_kg and centre_of_mass_m"
        )
    if row.inertia_kgm2 is not None:
        require_rigid(row.inertia_kgm2, f"{file}: load {row.load!r}")
    load = Load(
        name=name,
        mass=row.mass_kg,
        centre_of_mass=np.array(centre) if len(centre) == 3 else np.zeros(3),
        inertia=row.inertia_kgm2,
    )
    return LoadFromFile(load=load, serial=weighed.serial, known_loads=weighed.known_loads())


def _weighed(file: Path, name: str) -> tuple[_Weighed, _Row]:
    """The result, and its load of this name."""
    content = read_json(file, expected="a result of `forcetorque payload FILE --format json`, there is none")
    if not isinstance(content, dict) or content.get("schema") != SCHEMA:
        raise FormatError(f"{file}: expected a result of `forcetorque payload FILE --format json`, schema {SCHEMA!r}")
    try:
        weighed = _Weighed.model_validate(content)
    except ValidationError as error:
        raise FormatError(f"{file}: {first_error(error)}") from error
    names = [row.load for row in weighed.loads]
    if name not in names and len(names) != 1:
        raise ExperimentError(f"{file}: no load {name!r}; {known_names(name, names)}")
    return weighed, weighed.loads[names.index(name) if name in names else 0]


GYRATION_M: Final = 0.1
"""Radius of gyration about its centre of mass that an unknown load is expected to stay below (one s.d.); m."""


def spread_of(experiment: Experiment, sensor: ExperimentSensor) -> MatrixSpread:
    """Say how far the matrix of a sensor may be off, as the generative calibration takes it.

    Args:
        experiment: The experiment.
        sensor: One of its sensors, with a prior.

    Returns:
        The spread.

    Raises:
        ExperimentError: If it has no prior, or its full scale is not known.
    """
    if sensor.prior is None:
        raise ExperimentError(f"sensor {sensor.name!r}: expected prior, the matrix that is known in part, got none")
    accuracy = experiment.fit_options.accuracy
    full_scale = full_scale_of(sensor, accuracy, channels=sensor.prior.shape[1])
    size = prior_size_of(sensor, full_scale)
    return MatrixSpread.of(sensor.prior, Assumptions(full_scale=full_scale, accuracy=accuracy, prior_size=size))


def with_matrix_in_part(problem: LoadProblem, spread: MatrixSpread) -> LoadProblem:
    """Let the matrix be known in part, and unknown inertias be those of loads of a usual size.

    Args:
        problem: Rows and loads.
        spread: How far the matrix may be off.

    Returns:
        The problem to solve.
    """
    free = [isinstance(load.inertia, str) and load.expected is None for load in problem.loads]
    if not any(free):
        return settled(problem, spread)
    points = tuple(
        replace(load, inertia=None) if unknown else load for load, unknown in zip(problem.loads, free, strict=True)
    )
    # only their places are wanted of it: sizes of the matrix would run after what the inertias do
    expected = replace(problem, loads=points, matrix_prior=spread.covariance(spread.expected))
    first = fit(expected, drift=bool(problem.drift))
    sized = tuple(
        _of_usual_size(load, estimate) if unknown and estimate.is_determined else load
        for load, estimate, unknown in zip(problem.loads, load_estimates(first), free, strict=True)
    )
    return settled(replace(problem, loads=sized), spread)


def _of_usual_size(load: Load, point: LoadEstimate) -> Load:
    """A load whose inertia about its centre of mass is that of a body of usual size."""
    hat = skew(point.centre_of_mass)
    expected, precision = np.zeros(INERTIAL), np.zeros((INERTIAL, INERTIAL))
    expected[4:] = six_of(-point.mass * hat @ hat)
    precision[4:, 4:] = np.eye(6) / (abs(point.mass) * GYRATION_M**2) ** 2
    return replace(load, expected=expected, precision=precision)
