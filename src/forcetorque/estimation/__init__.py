# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches, joint torques and expected wrenches of a recording, fused over sources, with covariances."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.estimation.estimate import estimate_experiment as estimate_experiment
    from forcetorque.estimation.result import summarise_estimates as summarise_estimates
    from forcetorque.estimation.torque.experiment_fusion import fuse_experiment as fuse_experiment

CAPABILITY = Capability(
    page="estimation/estimation.md",
    needs=("skin", "inspection"),
    commands=("forcetorque.estimation.command:estimate",),
    sections=(
        "forcetorque.estimation.section:MOTORS",
        "forcetorque.estimation.section:FUSION",
        "forcetorque.estimation.section:LENGTH_SCALE",
    ),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    estimate_experiment="forcetorque.estimation.estimate",
    fuse_experiment="forcetorque.estimation.torque.experiment_fusion",
    summarise_estimates="forcetorque.estimation.result",
)
