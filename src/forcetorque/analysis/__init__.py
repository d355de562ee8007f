# SPDX-License-Identifier: BSD-3-Clause
"""Questions to the sensors of experiments: one file per question, each a function and its result."""

from forcetorque.analysis.acceptance import Acceptance, accept_sensor
from forcetorque.analysis.acceptance_file import AcceptanceFile, read_acceptance
from forcetorque.analysis.applicability import by_sensor, one_per_sensor

# TEMP from forcetorque.analysis.assessment import Assessment, Demands, assess
from forcetorque.analysis.calibrate import calibrate_sensor
from forcetorque.analysis.candidate import JudgedCandidate
from forcetorque.analysis.compare import Comparison, compare
from forcetorque.analysis.comparison import Independence, PriorComparison, compare_with_prior
from forcetorque.analysis.corrections import corrections_of
from forcetorque.analysis.estimate import IntervalEstimates, estimate_experiment
from forcetorque.analysis.evaluate import CandidateErrors, Evaluation, evaluate

# TEMP from forcetorque.analysis.experiment_assessment import ExperimentAssessment, assess_experiment
from forcetorque.analysis.gains import JointPosition, SensorGains, StrongestSample, select_gains
from forcetorque.analysis.inspect import doubtful_spans, inspect_experiment, inspect_recording
from forcetorque.analysis.joint_torques import JointTorques, JointTorqueVerdict, compare_joint_torques
from forcetorque.analysis.judged import JudgedWrenches
from forcetorque.analysis.population import read_population
from forcetorque.analysis.reading import Correction
from forcetorque.analysis.samples import IntervalSamples
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.analysis.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
from forcetorque.analysis.sphere import Spheres, spheres, spheres_of_sensors
from forcetorque.analysis.sphere_rows import FailureRow, SphereRow
from forcetorque.analysis.static_checks import StaticChecks, check_sensor
from forcetorque.analysis.study import SensorStudy, study_sensor
from forcetorque.analysis.study_data import StudyData, read_study_data
from forcetorque.analysis.trial_group import TrialGroup, group_trials
from forcetorque.analysis.trials import TrialSphere, read_trials
from forcetorque.analysis.validate import ContactForceComparison, ContactForceVerdict, compare_contact_forces
from forcetorque.analysis.verdict import VerdictLine

__all__ = [
    # TEMP     "Assessment",
    # TEMP     "Demands",
    # TEMP     "ExperimentAssessment",
    "Independence",
    "PriorComparison",
    "VerdictLine",
    # TEMP     "assess",
    # TEMP     "assess_experiment",
    "compare_with_prior",
    "CandidateErrors",
    "Evaluation",
    "evaluate",
    "Acceptance",
    "AcceptanceFile",
    "ContactForceComparison",
    "ContactForceVerdict",
    "Correction",
    "IntervalEstimates",
    "IntervalSamples",
    "JointPosition",
    "JointTorqueVerdict",
    "JointTorques",
    "JudgedCandidate",
    "JudgedWrenches",
    "SensorGains",
    "Comparison",
    "FailureRow",
    "SensorSphere",
    "SphereRow",
    "Spheres",
    "SensorStudy",
    "StaticChecks",
    "StrongestSample",
    "StudyData",
    "TrialGroup",
    "TrialSphere",
    "accept_sensor",
    "by_sensor",
    "one_per_sensor",
    "calibrate_sensor",
    "check_sensor",
    "compare_contact_forces",
    "compare_joint_torques",
    "corrections_of",
    "doubtful_spans",
    "estimate_experiment",
    "compare",
    "group_trials",
    "inspect_experiment",
    "inspect_recording",
    "read_acceptance",
    "read_population",
    "read_study_data",
    "read_trials",
    "SensorRun",
    "select_gains",
    "sensor_spheres",
    "sphere_intervals",
    "spheres",
    "spheres_of_sensors",
    "study_sensor",
]
