# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate force-torque sensors where they are mounted, and say how far to trust them.

The names here are what a first script needs; everything else is in the packages. They are
imported when they are first used, so that
`import forcetorque` and the command line's help cost no scientific library.
"""

from typing import TYPE_CHECKING

from forcetorque.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.analysis.calibration.calibrate import calibrate_sensor
    from forcetorque.analysis.evaluate.evaluate import evaluate
    from forcetorque.analysis.joint.plan import plan_jointly
    from forcetorque.analysis.runs.sensor_run import SensorRun
    from forcetorque.calibration.artefact import Calibration, read_calibration, write_calibration
    from forcetorque.calibration.calibrate import calibrate
    from forcetorque.calibration.data_set import DataSet
    from forcetorque.errors import ForceTorqueError
    from forcetorque.evaluation.wrench_errors import wrench_errors
    from forcetorque.interactive.arrays import experiment_of_arrays
    from forcetorque.interactive.contests import contest
    from forcetorque.interactive.experiment import Experiment, calibrate_jointly, load_experiment
    from forcetorque.interactive.skin import calibrate_skin, skin_wrench
    from forcetorque.recording.recording import Recording
    from forcetorque.recording.storage import read_recording, write_recording
    from forcetorque.robot.model import RobotModel
    from forcetorque.robot.newton_euler import expected_wrenches
    from forcetorque.robot.urdf import read_urdf

__all__ = [
    "Calibration",
    "DataSet",
    "Experiment",
    "ForceTorqueError",
    "Recording",
    "RobotModel",
    "SensorRun",
    "calibrate",
    "calibrate_jointly",
    "calibrate_sensor",
    "calibrate_skin",
    "contest",
    "evaluate",
    "expected_wrenches",
    "experiment_of_arrays",
    "load_experiment",
    "plan_jointly",
    "read_calibration",
    "read_recording",
    "read_urdf",
    "skin_wrench",
    "wrench_errors",
    "write_calibration",
    "write_recording",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Calibration": "forcetorque.calibration.artefact",
        "DataSet": "forcetorque.calibration.data_set",
        "Experiment": "forcetorque.interactive.experiment",
        "ForceTorqueError": "forcetorque.errors",
        "Recording": "forcetorque.recording.recording",
        "RobotModel": "forcetorque.robot.model",
        "SensorRun": "forcetorque.analysis.runs.sensor_run",
        "calibrate": "forcetorque.calibration.calibrate",
        "calibrate_jointly": "forcetorque.interactive.experiment",
        "calibrate_sensor": "forcetorque.analysis.calibration.calibrate",
        "calibrate_skin": "forcetorque.interactive.skin",
        "contest": "forcetorque.interactive.contests",
        "evaluate": "forcetorque.analysis.evaluate.evaluate",
        "expected_wrenches": "forcetorque.robot.newton_euler",
        "experiment_of_arrays": "forcetorque.interactive.arrays",
        "load_experiment": "forcetorque.interactive.experiment",
        "plan_jointly": "forcetorque.analysis.joint.plan",
        "read_calibration": "forcetorque.calibration.artefact",
        "read_recording": "forcetorque.recording.storage",
        "read_urdf": "forcetorque.robot.urdf",
        "skin_wrench": "forcetorque.interactive.skin",
        "wrench_errors": "forcetorque.evaluation.wrench_errors",
        "write_calibration": "forcetorque.calibration.artefact",
        "write_recording": "forcetorque.recording.storage",
    },
)
