# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate force-torque sensors where they are mounted, and say how far to trust them.

The names here are what a first script needs; everything else is in the packages. They are
imported when they are first used, so that
`import forcetorque` and the command line's help cost no scientific library.
"""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.app.python.arrays import experiment_of_arrays as experiment_of_arrays
    from forcetorque.app.python.experiment import (
        Experiment as Experiment,
        calibrate_jointly as calibrate_jointly,
        load_experiment as load_experiment,
    )
    from forcetorque.app.python.tables import (
        experiment_of_tables as experiment_of_tables,
        stream_of_arrays as stream_of_arrays,
    )
    from forcetorque.app.run.run import run as run
    from forcetorque.base.errors import ForceTorqueError as ForceTorqueError
    from forcetorque.calibration.calibrate import calibrate_sensor as calibrate_sensor
    from forcetorque.calibration.thesis.calibrate import calibrate as calibrate
    from forcetorque.contests.command import contest as contest
    from forcetorque.evaluation.commands import evaluate as evaluate
    from forcetorque.experiment.calibration.artefact import (
        Calibration as Calibration,
        read_calibration as read_calibration,
        write_calibration as write_calibration,
    )
    from forcetorque.experiment.calibration.moments import DataSet as DataSet
    from forcetorque.experiment.calibrations_under_test import wrench_errors as wrench_errors
    from forcetorque.experiment.sensor_run import SensorRun as SensorRun
    from forcetorque.planning.joint_calibration_plan import plan_jointly as plan_jointly
    from forcetorque.recording.recording import Recording as Recording
    from forcetorque.recording.storage import read_recording as read_recording, write_recording as write_recording
    from forcetorque.robot.dynamics import expected_wrenches as expected_wrenches
    from forcetorque.robot.model import RobotModel as RobotModel
    from forcetorque.robot.urdf import read_urdf as read_urdf
    from forcetorque.skin.commands import calibrate_skin as calibrate_skin, skin_wrench as skin_wrench


CAPABILITIES = (
    "calibration",
    "evaluation",
    "inspection",
    "payload",
    "dataset",
    "planning",
    "estimation",
    "sensor",
    "workbench",
    "plates",
    "device",
    "locomotion",
    "collisions",
    "skin",
    "simulation",
    "study",
    "contests",
    "fleet",
    "live",
)
"""Folders of capabilities, whose `CAPABILITY` says which commands and sections of the experiment file they have."""

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Calibration="forcetorque.experiment.calibration.artefact",
    DataSet="forcetorque.experiment.calibration.moments",
    Experiment="forcetorque.app.python.experiment",
    ForceTorqueError="forcetorque.base.errors",
    Recording="forcetorque.recording.recording",
    RobotModel="forcetorque.robot.model",
    SensorRun="forcetorque.experiment.sensor_run",
    calibrate="forcetorque.calibration.thesis.calibrate",
    calibrate_jointly="forcetorque.app.python.experiment",
    calibrate_sensor="forcetorque.calibration.calibrate",
    calibrate_skin="forcetorque.skin.commands",
    contest="forcetorque.contests.command",
    evaluate="forcetorque.evaluation.commands",
    expected_wrenches="forcetorque.robot.dynamics",
    experiment_of_arrays="forcetorque.app.python.arrays",
    experiment_of_tables="forcetorque.app.python.tables",
    load_experiment="forcetorque.app.python.experiment",
    plan_jointly="forcetorque.planning.joint_calibration_plan",
    read_calibration="forcetorque.experiment.calibration.artefact",
    read_recording="forcetorque.recording.storage",
    read_urdf="forcetorque.robot.urdf",
    run="forcetorque.app.run.run",
    skin_wrench="forcetorque.skin.commands",
    stream_of_arrays="forcetorque.app.python.tables",
    wrench_errors="forcetorque.experiment.calibrations_under_test",
    write_calibration="forcetorque.experiment.calibration.artefact",
    write_recording="forcetorque.recording.storage",
)
