# SPDX-License-Identifier: BSD-3-Clause
"""What is said about the joint torques of an experiment that has skin, or several sources of torques."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from forcetorque.analysis.estimate.estimate import estimate_experiment
from forcetorque.analysis.estimate.torque_picture import TorquePicture, torque_picture
from forcetorque.analysis.runs.corrections import corrections_of
from forcetorque.analysis.torque.fusion import TorqueFusion, fuse_experiment, summarise_fusion
from forcetorque.calibration import Calibration
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment
from forcetorque.experiment.skin.skin_alone import is_skin_alone


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueAssessment:
    """Joint torques over time, by source where there are several."""

    fusion: TorqueFusion | None = None
    """What the sources come to; None without `[fusion]`."""
    picture: TorquePicture | None = None
    """Torques over time; None where there are none."""
    left_out: tuple[str, ...] = ()
    """Why there are none."""


def assess_torques(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> TorqueAssessment:
    """Tell joint torques where something but force-torque sensors tells them too.

    Args:
        experiment: The experiment.
        calibrations: A calibration by sensor; others are read by their prior.

    Returns:
        Torques; nothing for an experiment with neither `[fusion]` nor a patch with a table, or without a robot.
    """
    if is_skin_alone(experiment.model) or (experiment.fusion is None and not experiment.force_patches):
        return TorqueAssessment()
    try:
        corrections = corrections_of(experiment, calibrations)
        if experiment.fusion is None:
            return TorqueAssessment(picture=torque_picture(experiment, estimate_experiment(experiment, corrections)))
        fusions, frictions = fuse_experiment(experiment, corrections)
        return TorqueAssessment(
            fusion=summarise_fusion(experiment, fusions, frictions), picture=torque_picture(experiment, fusions=fusions)
        )
    except ForceTorqueError as error:
        return TorqueAssessment(left_out=(str(error),))
