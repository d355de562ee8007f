# SPDX-License-Identifier: BSD-3-Clause
"""Questions to the sensors of experiments, each a function and its result: one file per question, or a folder.

Each is imported when it is first used: who asks one question does not wait for what all the others compute with.
Whatever recordings an answer is about, what their experiment files add to the logs is a warning of it.
"""

from typing import TYPE_CHECKING

from forcetorque.door import open_door

if TYPE_CHECKING:
    from forcetorque.analysis.acceptance.acceptance import Acceptance, accept, criteria_table
    from forcetorque.analysis.acceptance.criterion import Bound, Criterion
    from forcetorque.analysis.acceptance.file import AcceptanceFile, read_acceptance
    from forcetorque.analysis.acceptance.static_checks import IntervalOffset, StaticChecks, check
    from forcetorque.analysis.assessment.assessment import Assessment, Demands, assess
    from forcetorque.analysis.assessment.experiment_assessment import ExperimentAssessment, assess_experiment
    from forcetorque.analysis.assessment.verdict import VerdictLine
    from forcetorque.analysis.balance.balance import Balance, balance
    from forcetorque.analysis.balance.interval_balance import BalanceOptions, IntervalBalance
    from forcetorque.analysis.calibration.calibrate import calibrate_sensor
    from forcetorque.analysis.calibration.learnt import (
        LITTLE_LEARNT,
        LearntDirection,
        learnt_directions,
        learnt_words,
        to_learn,
    )
    from forcetorque.analysis.calibration.recording_moments import recording_moments, store_moments
    from forcetorque.analysis.calibration.sensor_calibration import (
        SensorCalibration,
        SensorCalibrations,
        calibrate_for_file,
        data_doubts,
    )
    from forcetorque.analysis.coherence.coherence import coherence, force_error
    from forcetorque.analysis.coherence.rows import Coherence, CoherenceSummary, OffsetOfSensor, PhaseForce
    from forcetorque.analysis.compare.compare import Comparison, compare
    from forcetorque.analysis.compare.trial_group import TrialGroup, group_trials
    from forcetorque.analysis.compare.trials import TrialSphere, read_trials
    from forcetorque.analysis.contest.contest import Contest, contest
    from forcetorque.analysis.contest.entries import Contestant, ContestRun, Entries, read_entries
    from forcetorque.analysis.contest.file import ContestFile, Method
    from forcetorque.analysis.contest.rows import ContestLoadRow
    from forcetorque.analysis.device.demands import DeviceDemands, device_demands
    from forcetorque.analysis.device.device import DeviceDesign, design_device
    from forcetorque.analysis.device.files import write_device
    from forcetorque.analysis.device.span import DeviceSpan, device_span
    from forcetorque.analysis.estimate.estimate import IntervalEstimates, estimate_experiment
    from forcetorque.analysis.estimate.summary import EstimateSummary, estimates_of_recordings, summarise_estimates
    from forcetorque.analysis.estimate.torque_picture import TorquePicture, torque_picture
    from forcetorque.analysis.evaluate.evaluate import CandidateErrors, Evaluation, RecordingErrors, evaluate
    from forcetorque.analysis.export.export import (
        export_coefficients,
        export_icub_matrix,
        export_table,
        export_wholebodydynamics,
    )
    from forcetorque.analysis.export.rows import Export, ExportedCalibration
    from forcetorque.analysis.gains.gains import Gains, SensorGains, select_gains, sensor_gains
    from forcetorque.analysis.init import Draft, draft_experiment
    from forcetorque.analysis.inspect.findings import doubtful_spans, inspect_experiment, inspect_recording
    from forcetorque.analysis.inspect.inspect import (
        FindingRow,
        Inspection,
        finding_rows,
        finding_table,
        inspect_log,
        inspected,
    )
    from forcetorque.analysis.joint.calibration import calibrate_jointly, calibration_file
    from forcetorque.analysis.joint.data import JOINT_FILE
    from forcetorque.analysis.joint.interval import joint_interval
    from forcetorque.analysis.joint.plan import JointPlan, plan_jointly
    from forcetorque.analysis.joint.reader_groups import read_candidates
    from forcetorque.analysis.motion.motion import Motion, motion
    from forcetorque.analysis.motion.rows import MotionCurve, OscillationRow, SettlingRow, TrackingRow
    from forcetorque.analysis.motion.signals import MotionSignal, motion_signals, motion_signals_of_arrays
    from forcetorque.analysis.payload.payload import WeighedLoad, weigh_load
    from forcetorque.analysis.payload.robot_load import export_load, robot_load
    from forcetorque.analysis.plan.files import refuse_full_folder, write_plan
    from forcetorque.analysis.plan.plan import Plan, plan, plan_sentence
    from forcetorque.analysis.plan.rows import PlannedPosture, PlannedRecording
    from forcetorque.analysis.response.response import Response, response
    from forcetorque.analysis.response.rows import DecayCurve, EventRow, InverseRow, ResponseCurve, ResponseNumber
    from forcetorque.analysis.runs.applicability import by_sensor, one_per_sensor
    from forcetorque.analysis.runs.campaign import Campaign, Runs
    from forcetorque.analysis.runs.campaign_interval import CampaignInterval
    from forcetorque.analysis.runs.candidate import JudgedCandidate
    from forcetorque.analysis.runs.corrections import corrections_of
    from forcetorque.analysis.runs.interval_quality import IntervalQuality
    from forcetorque.analysis.runs.judged import JudgedWrenches
    from forcetorque.analysis.runs.offsets import offset_policies
    from forcetorque.analysis.runs.population import read_population
    from forcetorque.analysis.runs.reading import Correction
    from forcetorque.analysis.runs.samples import IntervalSamples
    from forcetorque.analysis.runs.sensor_run import SensorRun
    from forcetorque.analysis.skin.calibrate import SkinCalibration, calibrate_skin, read_patches
    from forcetorque.analysis.skin.check import LayoutFindingRow, SkinCheck, check_patch, check_skin
    from forcetorque.analysis.skin.contact_rows import SkinContactRow, SkinWrenchPicture
    from forcetorque.analysis.skin.sources import frames_of_patches
    from forcetorque.analysis.skin.wrench import SkinWrench, skin_wrench
    from forcetorque.analysis.skin.wrench_choice import WrenchChoice
    from forcetorque.analysis.sphere.rows import FailureRow, SphereRow
    from forcetorque.analysis.sphere.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
    from forcetorque.analysis.sphere.sphere import Spheres, spheres, spheres_of_sensors
    from forcetorque.analysis.study.data import StudyData, read_study_data
    from forcetorque.analysis.study.result import StudiedSensor, Studies, studied_sensor, study_warnings
    from forcetorque.analysis.study.study import SensorStudy, study_sensor
    from forcetorque.analysis.tare import Tare, TaredSensor, tare
    from forcetorque.analysis.thermal.rows import SensorThermal, ThermalCurve, ThermalDriftRow
    from forcetorque.analysis.thermal.thermal import Thermal, thermal
    from forcetorque.analysis.torque.fusion import TorqueFusion, fuse_experiment
    from forcetorque.analysis.torque.joint_torques import JointTorqueErrors, JointTorques, joint_torques
    from forcetorque.analysis.torque_loop.file import TorqueLoopFile, read_torque_loop
    from forcetorque.analysis.torque_loop.rows import TorqueLoopOnsetRow, TorqueLoopRow
    from forcetorque.analysis.torque_loop.torque_loop import TorqueLoopStudy, torque_loop
    from forcetorque.analysis.use.decide import use_verdicts
    from forcetorque.analysis.use.loads_of_use import loads_of_use
    from forcetorque.analysis.use.prior_comparison import Independence, PriorComparison, compare_with_prior
    from forcetorque.analysis.use.verdict import Reason, UseError, UseVerdict, use_sentences
    from forcetorque.analysis.validate.best_candidate import BestCandidate, CandidateComparison
    from forcetorque.analysis.validate.contact_forces import ContactForceErrors, ContactForces, contact_forces
    from forcetorque.analysis.validate.validate import Validation, validate
    from forcetorque.analysis.workbench.bench_file import BenchFile
    from forcetorque.analysis.workbench.bench_recording import BenchRecording, read_bench
    from forcetorque.analysis.workbench.result import Workbench
    from forcetorque.analysis.workbench.rows import BenchPicture
    from forcetorque.analysis.workbench.workbench import workbench

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
    "inspected",
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

open_door(__name__)
