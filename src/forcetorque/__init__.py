# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate force-torque sensors where they are mounted, and say how far to trust them.

The names here are what a first script needs; everything else is in the packages, which are the
nouns of the equation in the README. They are imported when they are first used, so that
`import forcetorque` and the command line's help cost no scientific library.
"""

from typing import TYPE_CHECKING

from forcetorque.door import open_door

if TYPE_CHECKING:
    from forcetorque.analysis import SensorRun, calibrate_sensor, evaluate, plan_jointly
    from forcetorque.calibration import Calibration, DataSet, calibrate, read_calibration, write_calibration
    from forcetorque.errors import ForceTorqueError
    from forcetorque.evaluation.wrench_errors import wrench_errors  # of the package, mypy may take it for the module
    from forcetorque.interactive import (
        Experiment,
        calibrate_jointly,
        calibrate_skin,
        contest,
        experiment_of_arrays,
        load_experiment,
        skin_wrench,
    )
    from forcetorque.recording import Recording, read_recording, write_recording
    from forcetorque.robot import RobotModel, expected_wrenches, read_urdf

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

open_door(__name__)
