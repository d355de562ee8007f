# SPDX-License-Identifier: BSD-3-Clause
"""The scene of an experiment file."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path

from forcetorque.calibration import Calibration
from forcetorque.errors import MissingFileError
from forcetorque.experiment import Experiment, parse_experiment
from forcetorque.viewer.build import BuiltScene, build_scene


def scene_of(
    path: Path,
    experiment: Experiment,
    calibrations: Mapping[str, Calibration],
    *,
    sensors: Sequence[str] | None = None,
    mesh_folders: Sequence[Path] | None = None,
) -> BuiltScene:
    """Build the scene of an experiment.

    Args:
        path: Experiment file.
        experiment: What it points to.
        calibrations: Calibrations by their file; of a sensor any number.
        sensors: Sensors to show; all if None.
        mesh_folders: Folders with packages of meshes.

    Returns:
        The scene, which states the hashes of the calibrations.

    Raises:
        MissingFileError: If a folder does not exist.
    """
    for folder in mesh_folders or ():
        if not folder.is_dir():
            raise MissingFileError(f"--mesh-dir {folder}: expected a folder, there is none")
    robot = parse_experiment(path).robot
    return build_scene(
        experiment,
        calibrations,
        urdf=None if robot is None else path.parent / robot.urdf,
        sensors=sensors,
        mesh_folders=mesh_folders or (),
        provenance=[f"{file} sha256 {hashlib.sha256(Path(file).read_bytes()).hexdigest()}" for file in calibrations],
    )
