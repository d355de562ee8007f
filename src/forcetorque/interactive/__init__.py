# SPDX-License-Identifier: BSD-3-Clause
"""What scripts and notebooks hold: an experiment, from a file or from arrays, and its sensors with every question."""

from forcetorque.interactive.arrays import experiment_of_arrays
from forcetorque.interactive.benches import workbench
from forcetorque.interactive.contests import contest
from forcetorque.interactive.device import design_device
from forcetorque.interactive.experiment import Experiment, calibrate_jointly, load_experiment
from forcetorque.interactive.motions import motion, motion_of_arrays
from forcetorque.interactive.run import Run
from forcetorque.interactive.simulations import simulate
from forcetorque.interactive.skin import calibrate_skin, skin_wrench
from forcetorque.interactive.studies import study
from forcetorque.interactive.verdicts import Verdicts

__all__ = [
    "Experiment",
    "Run",
    "Verdicts",
    "calibrate_jointly",
    "calibrate_skin",
    "design_device",
    "contest",
    "experiment_of_arrays",
    "load_experiment",
    "motion",
    "motion_of_arrays",
    "simulate",
    "skin_wrench",
    "study",
    "workbench",
]
