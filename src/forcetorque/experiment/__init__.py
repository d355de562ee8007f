# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file: from TOML to robot, recording, intervals and sensors."""

from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.foot_forces import FootForces, has_foot_forces, load_foot_forces
from forcetorque.experiment.load import load_experiment, load_shown, load_touched_robot
from forcetorque.experiment.parse import parse_experiment
from forcetorque.experiment.recorded_span import RecordedSpan
from forcetorque.experiment.schema import ExperimentFile
from forcetorque.experiment.skin.patches import ExperimentPatch, PatchExperiment, load_patches

__all__ = [
    "Experiment",
    "ExperimentFile",
    "ExperimentPatch",
    "ExperimentSensor",
    "FootForces",
    "PatchExperiment",
    "RecordedSpan",
    "has_foot_forces",
    "load_experiment",
    "load_foot_forces",
    "load_patches",
    "load_shown",
    "load_touched_robot",
    "parse_experiment",
]
