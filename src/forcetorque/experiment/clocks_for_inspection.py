# SPDX-License-Identifier: BSD-3-Clause
"""The streams of an experiment for `inspect`: a delay that its log does not determine is no error here."""

from __future__ import annotations

from pathlib import Path

from forcetorque.experiment.additions import read_robot
from forcetorque.experiment.file import parse_experiment
from forcetorque.experiment.input_files import Inputs
from forcetorque.experiment.sensors import declare_sensors
from forcetorque.experiment.streams import read_streams
from forcetorque.recording.recording import Recording


def load_tried_clocks(path: Path | str) -> Recording:
    """Read the streams of an experiment, also where its log does not tell a delay that is to be estimated.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The recording; its `clocks` say of each whether it was told, and why not.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    inputs = Inputs(file.parent)
    model = None
    if parsed.robot is not None:
        model = declare_sensors(parsed.sensor, file, read_robot(parsed.robot, file, inputs))
    return read_streams(parsed, file, model, inputs, clocks_must_tell=False)
