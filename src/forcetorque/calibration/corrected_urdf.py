# SPDX-License-Identifier: BSD-3-Clause
"""The URDF file of an experiment, corrected by what a calibration found of the robot."""

from __future__ import annotations

from pathlib import Path

from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import refuse_output, write_bytes_atomically
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import read_model_errors, robot_errors
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.robot.installed_robots import urdf_file
from forcetorque.robot.urdf import read_urdf
from forcetorque.robot.urdf_and_mjcf_text import corrected_urdf_text


def urdf_of(experiment: Experiment) -> Path | None:
    """Find the URDF file of an experiment.

    Returns:
        The file; None without a robot, or where the experiment is none of a file.
    """
    table = parse_experiment(experiment.file).robot if experiment.file.is_file() else None
    return None if table is None else urdf_file(table.urdf, experiment.file.parent)


def write_corrected_urdf(
    experiment: Experiment, calibration: Path | str, file: Path | str, *, force: bool = False
) -> None:
    """Write the URDF of an experiment with the masses, centres of mass and joint zeros that a calibration found.

    All else in the file stays as it is. Where the experiment was corrected by an earlier calibration, both corrections
    are in the new file, and `from` is to be taken out of the tolerance of an experiment that names it.

    Args:
        experiment: An experiment of the calibration.
        calibration: File of a calibration of one sensor, or `joint.json` of all sensors together.
        file: File to write or to replace.
        force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

    Raises:
        ExperimentError: If the experiment has no URDF.
        FormatError: If the calibration holds no errors of a robot model.
        RobotError: If they are of another robot.
        OutputError: If the file is an input, or a file that `force` is needed for.
    """
    table, urdf = parse_experiment(experiment.file).robot, urdf_of(experiment)
    if table is None or urdf is None:
        raise ExperimentError(f"{experiment.file}: expected [robot] with a URDF to correct, got none")
    found = [read_model_errors(calibration)]
    if table.tolerance != "exact" and table.tolerance.found_by is not None:
        found.insert(0, read_model_errors(experiment.file.parent / table.tolerance.found_by))
    model = read_urdf(urdf)
    refuse_output(file, force=force)  # when all inputs are read, the calibration among them
    for errors in found:
        model = robot_errors(experiment.model, errors).applied_to(model)
    write_bytes_atomically(Path(file), corrected_urdf_text(urdf, model).encode())
