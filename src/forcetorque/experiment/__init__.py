# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file: from TOML to robot, recording, intervals and sensors, and on to a verdict."""

from forcetorque.experiment.acceptance import Acceptance, accept_sensor
from forcetorque.experiment.acceptance_file import AcceptanceFile, read_acceptance
from forcetorque.experiment.calibrate import calibrate_sensor
from forcetorque.experiment.candidates import JudgedCandidate, judged_candidates
from forcetorque.experiment.compare import TrialFailure, TrialGroup, TrialSphere, group_trials, read_trials
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.estimate import IntervalEstimates, estimate_experiment
from forcetorque.experiment.evaluate import (
    Verdict,
    beyond_fitted_range,
    evaluate_sensor,
    judged_where_chosen,
    require_unseen,
    verdicts_on,
)
from forcetorque.experiment.gains import JointPosition, SensorGains, StrongestSample, select_gains
from forcetorque.experiment.inspect import doubtful_spans, inspect_experiment, inspect_recording
from forcetorque.experiment.joint_torques import JointTorques, JointTorqueVerdict, compare_joint_torques
from forcetorque.experiment.judged import JudgedWrenches, judged_wrenches
from forcetorque.experiment.load import load_experiment
from forcetorque.experiment.parse import parse_experiment
from forcetorque.experiment.population import read_population
from forcetorque.experiment.readings import Correction, corrections_of
from forcetorque.experiment.samples import IntervalSamples, samples_of
from forcetorque.experiment.schema import ExperimentFile
from forcetorque.experiment.sphere import SensorSphere, analyse_sensor, sphere_intervals
from forcetorque.experiment.static_checks import StaticChecks, check_sensor
from forcetorque.experiment.study import SensorStudy, study_sensor
from forcetorque.experiment.study_data import StudyData, read_study_data
from forcetorque.experiment.validate import (
    ContactForceComparison,
    ContactForceVerdict,
    compare_contact_forces,
)

__all__ = [
    "Acceptance",
    "AcceptanceFile",
    "ContactForceComparison",
    "ContactForceVerdict",
    "Correction",
    "Experiment",
    "ExperimentFile",
    "ExperimentSensor",
    "IntervalEstimates",
    "IntervalSamples",
    "JointPosition",
    "JointTorqueVerdict",
    "JointTorques",
    "JudgedCandidate",
    "JudgedWrenches",
    "SensorGains",
    "SensorSphere",
    "SensorStudy",
    "StaticChecks",
    "StrongestSample",
    "StudyData",
    "TrialFailure",
    "TrialGroup",
    "TrialSphere",
    "Verdict",
    "accept_sensor",
    "analyse_sensor",
    "beyond_fitted_range",
    "calibrate_sensor",
    "check_sensor",
    "compare_contact_forces",
    "compare_joint_torques",
    "corrections_of",
    "doubtful_spans",
    "estimate_experiment",
    "evaluate_sensor",
    "group_trials",
    "inspect_experiment",
    "inspect_recording",
    "judged_candidates",
    "judged_where_chosen",
    "judged_wrenches",
    "load_experiment",
    "parse_experiment",
    "read_acceptance",
    "read_population",
    "read_study_data",
    "require_unseen",
    "read_trials",
    "samples_of",
    "select_gains",
    "sphere_intervals",
    "study_sensor",
    "verdicts_on",
]
