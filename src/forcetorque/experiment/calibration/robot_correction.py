# SPDX-License-Identifier: BSD-3-Clause
"""What a calibration found of the robot model, applied to the model of another recording, or to a URDF file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RobotError, known_names
from forcetorque.base.stored_table import read_json
from forcetorque.experiment.calibration.calibration_file import JOINT_SCHEMA, read_calibration
from forcetorque.experiment.calibration.joint_posterior import read_joint_posterior
from forcetorque.experiment.calibration.robot_model_error import CENTRE, MASS, ZERO, ModelError
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import tag_lines

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
            f"{file}: expected errors of a robot model, got none; calibrate with [robot] tolerance other than "
            '"exact", or with --jointly'
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
