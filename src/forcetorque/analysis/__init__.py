# SPDX-License-Identifier: BSD-3-Clause
"""Questions to the sensors of experiments: one file per question, each a function and its result.

Each is imported when it is first used: who asks one question does not wait for what all the others compute with.
Whatever recordings an answer is about, what their experiment files add to the logs is a warning of it.
"""

from typing import TYPE_CHECKING

from forcetorque.analysis.added import saying_what_was_added
from forcetorque.door import open_door

if TYPE_CHECKING:
    from forcetorque.analysis.acceptance import Acceptance, accept, criteria_table
    from forcetorque.analysis.acceptance_file import AcceptanceFile, read_acceptance
    from forcetorque.analysis.applicability import by_sensor, one_per_sensor
    from forcetorque.analysis.assessment import Assessment, Demands, assess
    from forcetorque.analysis.balance import Balance, balance
    from forcetorque.analysis.bench_file import BenchFile
    from forcetorque.analysis.bench_recording import BenchRecording, read_bench
    from forcetorque.analysis.best_candidate import BestCandidate, CandidateComparison
    from forcetorque.analysis.calibrate import calibrate_sensor
    from forcetorque.analysis.campaign import Campaign, Runs
    from forcetorque.analysis.campaign_interval import CampaignInterval
    from forcetorque.analysis.candidate import JudgedCandidate
    from forcetorque.analysis.coherence import coherence, force_error
    from forcetorque.analysis.coherence_rows import Coherence, CoherenceSummary, OffsetOfSensor, PhaseForce
    from forcetorque.analysis.compare import Comparison, compare
    from forcetorque.analysis.contact_forces import ContactForceErrors, ContactForces, contact_forces
    from forcetorque.analysis.contest import Contest, contest
    from forcetorque.analysis.contest_entries import Contestant, ContestRun, Entries, read_entries
    from forcetorque.analysis.contest_file import ContestFile, Method
    from forcetorque.analysis.contest_rows import ContestLoadRow
    from forcetorque.analysis.corrections import corrections_of
    from forcetorque.analysis.criterion import Bound, Criterion
    from forcetorque.analysis.decide import use_verdicts
    from forcetorque.analysis.device import DeviceDesign, design_device
    from forcetorque.analysis.device_demands import DeviceDemands, device_demands
    from forcetorque.analysis.device_files import write_device
    from forcetorque.analysis.device_span import DeviceSpan, device_span
    from forcetorque.analysis.estimate import IntervalEstimates, estimate_experiment
    from forcetorque.analysis.estimate_summary import EstimateSummary, estimates_of_recordings, summarise_estimates
    from forcetorque.analysis.evaluate import CandidateErrors, Evaluation, RecordingErrors, evaluate
    from forcetorque.analysis.experiment_assessment import ExperimentAssessment, assess_experiment
    from forcetorque.analysis.export import (
        export_coefficients,
        export_icub_matrix,
        export_table,
        export_wholebodydynamics,
    )
    from forcetorque.analysis.export_rows import Export, ExportedCalibration
    from forcetorque.analysis.findings import doubtful_spans, inspect_experiment, inspect_recording
    from forcetorque.analysis.gains import Gains, SensorGains, select_gains, sensor_gains
    from forcetorque.analysis.init import Draft, draft_experiment
    from forcetorque.analysis.inspect import FindingRow, Inspection, finding_rows, finding_table, inspect_log
    from forcetorque.analysis.interval_balance import BalanceOptions, IntervalBalance
    from forcetorque.analysis.interval_quality import IntervalQuality
    from forcetorque.analysis.joint_calibration import calibrate_jointly, calibration_file
    from forcetorque.analysis.joint_data import JOINT_FILE
    from forcetorque.analysis.joint_interval import joint_interval
    from forcetorque.analysis.joint_plan import JointPlan, plan_jointly
    from forcetorque.analysis.joint_torques import JointTorqueErrors, JointTorques, joint_torques
    from forcetorque.analysis.judged import JudgedWrenches
    from forcetorque.analysis.learnt import LITTLE_LEARNT, LearntDirection, learnt_directions, learnt_words, to_learn
    from forcetorque.analysis.loads_of_use import loads_of_use
    from forcetorque.analysis.motion import Motion, motion
    from forcetorque.analysis.motion_rows import MotionCurve, OscillationRow, SettlingRow, TrackingRow
    from forcetorque.analysis.motion_signals import MotionSignal, motion_signals, motion_signals_of_arrays
    from forcetorque.analysis.offsets import offset_policies
    from forcetorque.analysis.payload import WeighedLoad, weigh_load
    from forcetorque.analysis.plan import Plan, plan, plan_sentence
    from forcetorque.analysis.plan_files import refuse_full_folder, write_plan
    from forcetorque.analysis.plan_rows import PlannedPosture, PlannedRecording
    from forcetorque.analysis.population import read_population
    from forcetorque.analysis.prior_comparison import Independence, PriorComparison, compare_with_prior
    from forcetorque.analysis.reader_groups import read_candidates
    from forcetorque.analysis.reading import Correction
    from forcetorque.analysis.recording_moments import recording_moments, store_moments
    from forcetorque.analysis.response import Response, response
    from forcetorque.analysis.response_rows import DecayCurve, EventRow, InverseRow, ResponseCurve, ResponseNumber
    from forcetorque.analysis.robot_load import export_load, robot_load
    from forcetorque.analysis.samples import IntervalSamples
    from forcetorque.analysis.sensor_calibration import (
        SensorCalibration,
        SensorCalibrations,
        calibrate_for_file,
        data_doubts,
    )
    from forcetorque.analysis.sensor_run import SensorRun
    from forcetorque.analysis.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
    from forcetorque.analysis.skin_calibrate import SkinCalibration, calibrate_skin, read_patches
    from forcetorque.analysis.skin_check import LayoutFindingRow, SkinCheck, check_patch, check_skin
    from forcetorque.analysis.skin_contact_rows import SkinContactRow, SkinWrenchPicture
    from forcetorque.analysis.skin_sources import frames_of_patches
    from forcetorque.analysis.skin_wrench import SkinWrench, skin_wrench
    from forcetorque.analysis.skin_wrench_choice import WrenchChoice
    from forcetorque.analysis.sphere import Spheres, spheres, spheres_of_sensors
    from forcetorque.analysis.sphere_rows import FailureRow, SphereRow
    from forcetorque.analysis.static_checks import IntervalOffset, StaticChecks, check
    from forcetorque.analysis.study import SensorStudy, study_sensor
    from forcetorque.analysis.study_data import StudyData, read_study_data
    from forcetorque.analysis.study_result import StudiedSensor, Studies, studied_sensor, study_warnings
    from forcetorque.analysis.tare import Tare, TaredSensor, tare
    from forcetorque.analysis.thermal import Thermal, thermal
    from forcetorque.analysis.thermal_rows import SensorThermal, ThermalCurve, ThermalDriftRow
    from forcetorque.analysis.torque_fusion import TorqueFusion, fuse_experiment
    from forcetorque.analysis.torque_loop import TorqueLoopStudy, torque_loop
    from forcetorque.analysis.torque_loop_file import TorqueLoopFile, read_torque_loop
    from forcetorque.analysis.torque_loop_rows import TorqueLoopOnsetRow, TorqueLoopRow
    from forcetorque.analysis.torque_picture import TorquePicture, torque_picture
    from forcetorque.analysis.trial_group import TrialGroup, group_trials
    from forcetorque.analysis.trials import TrialSphere, read_trials
    from forcetorque.analysis.use_verdict import Reason, UseError, UseVerdict, use_sentences
    from forcetorque.analysis.validate import Validation, validate
    from forcetorque.analysis.verdict import VerdictLine
    from forcetorque.analysis.workbench import workbench
    from forcetorque.analysis.workbench_result import Workbench
    from forcetorque.analysis.workbench_rows import BenchPicture

__all__ = [
    "JOINT_FILE",
    "LITTLE_LEARNT",
    "Acceptance",
    "AcceptanceFile",
    "Assessment",
    "Balance",
    "BalanceOptions",
    "BenchFile",
    "BenchPicture",
    "BenchRecording",
    "BestCandidate",
    "Bound",
    "Campaign",
    "CampaignInterval",
    "CandidateComparison",
    "CandidateErrors",
    "Coherence",
    "CoherenceSummary",
    "Comparison",
    "ContactForceErrors",
    "ContactForces",
    "Contest",
    "ContestFile",
    "ContestLoadRow",
    "ContestRun",
    "Contestant",
    "Correction",
    "Criterion",
    "DecayCurve",
    "Demands",
    "DeviceDemands",
    "DeviceDesign",
    "DeviceSpan",
    "Draft",
    "Entries",
    "EstimateSummary",
    "Evaluation",
    "EventRow",
    "ExperimentAssessment",
    "Export",
    "ExportedCalibration",
    "FailureRow",
    "FindingRow",
    "Gains",
    "Independence",
    "Inspection",
    "IntervalBalance",
    "IntervalEstimates",
    "IntervalOffset",
    "IntervalQuality",
    "IntervalSamples",
    "InverseRow",
    "JointPlan",
    "JointTorqueErrors",
    "JointTorques",
    "JudgedCandidate",
    "JudgedWrenches",
    "LayoutFindingRow",
    "LearntDirection",
    "Method",
    "Motion",
    "MotionCurve",
    "MotionSignal",
    "OscillationRow",
    "OffsetOfSensor",
    "PhaseForce",
    "Plan",
    "PlannedPosture",
    "PlannedRecording",
    "PriorComparison",
    "Reason",
    "RecordingErrors",
    "Response",
    "ResponseCurve",
    "ResponseNumber",
    "Runs",
    "SensorCalibration",
    "SensorCalibrations",
    "SensorGains",
    "SensorRun",
    "SensorSphere",
    "SensorStudy",
    "SensorThermal",
    "SettlingRow",
    "SkinCalibration",
    "SkinCheck",
    "SkinContactRow",
    "SkinWrench",
    "SkinWrenchPicture",
    "SphereRow",
    "Spheres",
    "StaticChecks",
    "StudiedSensor",
    "Studies",
    "StudyData",
    "Tare",
    "TaredSensor",
    "Thermal",
    "ThermalCurve",
    "ThermalDriftRow",
    "TorqueFusion",
    "TorqueLoopStudy",
    "TorqueLoopFile",
    "TorqueLoopOnsetRow",
    "TorqueLoopRow",
    "TorquePicture",
    "TrackingRow",
    "TrialGroup",
    "TrialSphere",
    "UseError",
    "UseVerdict",
    "Validation",
    "VerdictLine",
    "WeighedLoad",
    "Workbench",
    "WrenchChoice",
    "accept",
    "assess",
    "assess_experiment",
    "balance",
    "by_sensor",
    "calibrate_for_file",
    "calibrate_jointly",
    "calibrate_sensor",
    "calibrate_skin",
    "calibration_file",
    "check",
    "check_patch",
    "check_skin",
    "coherence",
    "compare",
    "compare_with_prior",
    "contact_forces",
    "contest",
    "corrections_of",
    "criteria_table",
    "data_doubts",
    "design_device",
    "device_demands",
    "device_span",
    "draft_experiment",
    "doubtful_spans",
    "estimate_experiment",
    "estimates_of_recordings",
    "evaluate",
    "export_coefficients",
    "export_icub_matrix",
    "export_load",
    "export_table",
    "export_wholebodydynamics",
    "finding_rows",
    "finding_table",
    "force_error",
    "frames_of_patches",
    "offset_policies",
    "read_candidates",
    "fuse_experiment",
    "group_trials",
    "inspect_experiment",
    "inspect_log",
    "inspect_recording",
    "joint_interval",
    "joint_torques",
    "learnt_directions",
    "learnt_words",
    "loads_of_use",
    "motion",
    "motion_signals",
    "motion_signals_of_arrays",
    "one_per_sensor",
    "plan",
    "plan_jointly",
    "plan_sentence",
    "read_acceptance",
    "read_bench",
    "read_entries",
    "read_patches",
    "read_population",
    "read_study_data",
    "read_torque_loop",
    "read_trials",
    "recording_moments",
    "refuse_full_folder",
    "response",
    "robot_load",
    "select_gains",
    "sensor_gains",
    "sensor_spheres",
    "skin_wrench",
    "sphere_intervals",
    "spheres",
    "spheres_of_sensors",
    "store_moments",
    "studied_sensor",
    "study_sensor",
    "study_warnings",
    "summarise_estimates",
    "tare",
    "thermal",
    "to_learn",
    "torque_loop",
    "torque_picture",
    "use_sentences",
    "use_verdicts",
    "validate",
    "weigh_load",
    "workbench",
    "write_device",
    "write_plan",
]

open_door(__name__, handed_out=saying_what_was_added)
