# SPDX-License-Identifier: BSD-3-Clause
"""What a joint calibration knows of all sensors and of the robot model, and corrections of robot models by it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Final, Literal

import numpy as np
from pydantic import ConfigDict, Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FormatError, RobotError, known_names
from forcetorque.base.stored_table import StoredTable, read_json, read_stored_table, write_stored_table
from forcetorque.experiment.calibration.calibration_file import JOINT_SCHEMA, read_calibration
from forcetorque.experiment.calibration.robot_model_error import CENTRE, MASS, ZERO, ModelError
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import tag_lines

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


_EXPECTED: Final = "a file of `calibrate`, or joint.json of `calibrate --jointly`, there is none"
OF_ROBOT: Final = (MASS, CENTRE, ZERO)
"""How names of errors begin, or go on after the axis, that are of the robot and not of one recording."""


def read_model_errors(path: Path | str) -> tuple[ModelError, ...]:
    """Read what a calibration found of masses, centres of mass and joint zeros.

    Args:
        path: A calibration of one sensor, or `joint.json` of all sensors together.

    Returns:
        The errors; without those of one recording, such as its delay.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not such a file, or holds no errors of a robot model.
    """
    file = Path(path)
    content = read_json(file, expected=_EXPECTED)
    jointly = isinstance(content, dict) and content.get("schema") == JOINT_SCHEMA
    errors = (read_joint_posterior(file) if jointly else read_calibration(file)).model_errors
    of_robot = tuple(error for error in errors if any(word in error.name for word in OF_ROBOT))
    if not of_robot:
        raise FormatError(
            f"{file}: expected errors of a robot model, got none of masses, centres of mass or joint zeros; calibrate "
            'with a [robot] tolerance of these other than 0 or "exact", or with --jointly'
        )
    return of_robot


def robot_errors(model: RobotModel, errors: Sequence[ModelError]) -> RobotErrors:
    """Give errors of bodies and joints link by link and joint by joint.

    An error of a body is one of all links that are fixed to each other and to no sensor; its name is that of the
    heaviest of these, along whose axes its centre of mass moves.

    Args:
        model: The robot as it is described.
        errors: What a calibration found.

    Returns:
        The differences between the robot and its model.

    Raises:
        RobotError: If the robot has no such body or joint.
    """
    tree = build_tree(model, model.root_link)
    bodies = {
        max(body.links, key=lambda link: tree.inertias[link].mass): body.links for body in tree.bodies if body.links
    }
    mass: dict[str, float] = {}
    centre: dict[str, FloatArray] = {}
    zero: dict[str, float] = {}
    for error in errors:
        if error.name.startswith(ZERO):
            joint = error.name.removeprefix(ZERO)
            _require(joint, model.joints, error)
            zero[joint] = error.value
            continue
        axis, _, name = error.name.rpartition(MASS if error.name.startswith(MASS) else CENTRE)
        _require(name, bodies, error)
        body_R_name = tree.frames[name][1][:3, :3]
        for link in bodies[name]:
            if model.links[link].mass <= 0.0:
                continue
            if axis:
                shift = tree.frames[link][1][:3, :3].T @ body_R_name[:, "xyz".index(axis)] * error.value
                centre[link] = centre.get(link, np.zeros(3)) + shift
            else:
                mass[link] = error.value
    return RobotErrors(mass=mass, centre_m=centre, joint_zero_rad=zero)


def place_in_urdf(urdf: Path | None, name: str) -> str:
    """Say where in a URDF file a mass, a centre of mass or the place of a joint stands.

    Args:
        urdf: The file; None where there is none.
        name: Name of an error of the robot model.

    Returns:
        File, line and tag, in brackets; empty where it is not found, or the error is none of the file.
    """
    kind = next((kind for kind in OF_ROBOT if kind in name), None)
    if urdf is None or kind is None:
        return ""
    outer, inner = ("joint", ()) if kind == ZERO else ("link", ("inertial",))
    tag = "mass" if kind == MASS else "origin"
    lines = tag_lines(urdf, outer, name.rpartition(kind)[2])
    found = next((path for path in ((*inner, tag), inner) if path in lines), None)
    return "" if found is None else f" ({urdf.name}:{lines[found]}, <{found[-1] if found else outer}>)"


def _require(name: str, known: Mapping[str, object], error: ModelError) -> None:
    if name not in known:
        raise RobotError(
            f"{error.name}: the robot has no such body or joint; {known_names(name, known)}. Use the same URDF, "
            "sensors and fixed joints as the calibration"
        )
