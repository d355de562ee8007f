# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate all sensors of a robot at once, from any number of recordings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from urllib.parse import quote

from forcetorque.base.errors import FitError
from forcetorque.calibration.calibrate import fit_doubts
from forcetorque.calibration.joint.data import JOINT_FILE, JointData
from forcetorque.calibration.joint.model_error import ModelTolerance
from forcetorque.calibration.joint.outcome import JointOutcome
from forcetorque.calibration.sensor_calibration import SensorCalibration, SensorCalibrations, data_doubts
from forcetorque.calibration.summary import learnt_directions
from forcetorque.experiment.additions import with_recording_notes
from forcetorque.experiment.experiment import Experiment


@with_recording_notes
def calibrate_jointly(
    experiments: Sequence[Experiment],
    folder: Path | str,
    sensors: Sequence[str] | None = None,
    *,
    code_version: str,
    created: str,
    tolerance: ModelTolerance | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> SensorCalibrations:
    """Calibrate all sensors of a robot at once, on the calibration intervals of any number of recordings.

    No contact needs to be known: parts of the robot between its sensors that nothing touches give the equations.

    Args:
        experiments: Recordings of one robot; with an IMU as support where no link stands still.
        folder: Folder that `save` of the result writes the calibrations to.
        sensors: Sensors to calibrate, which have a prior matrix; all of the first file if None.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        tolerance: How far the robot model may be off; `ModelTolerance()` if None.
        progress: Called with what is being done.

    Returns:
        A calibration per sensor, which no file holds yet, and in `joint` errors of the model, what is left of the
        equations, and spans that were touched.

    Raises:
        ExperimentError: If there is no calibration interval, the files are of different sensors, or in one no untouched
            part has all joints in the log.
        EstimationError: If every part is touched in every interval.
        FitError: If a sensor that was asked for is beside no untouched part whose joints were logged.
    """
    data = JointData.of(experiments, sensors, progress)
    result = data.fit(data.intervals, tolerance, progress)
    calibrations = data.calibrations(data.intervals, result, code_version=code_version, created=created)
    if not calibrations:
        raise FitError(
            f"{', '.join(data.campaigns)}: beside no untouched part whose joints were logged; log them all, name the "
            "other sensors of the part too, or take a motion in which nothing touches it"
        )
    place = Path(folder)
    joint = JointOutcome.of(result, calibrations, str(place / JOINT_FILE))
    doubts = [
        *data.left_out,
        *(_without_equation(name) for name in data.campaigns if name not in calibrations),
        *joint.doubts(),
        *(
            doubt
            for name in calibrations
            for run in data.campaigns[name].runs
            for doubt in data_doubts(run, by_model=False)
        ),
        *(doubt for calibration in calibrations.values() for doubt in fit_doubts(calibration)),
    ]
    return SensorCalibrations(
        experiment="; ".join(dict.fromkeys(experiment.name for experiment in experiments)),
        calibrations=tuple(
            SensorCalibration(
                file=str(place / calibration_file(calibration.sensor.name, calibration.sensor.serial)),
                calibration=calibration,
                secondary_matrix=calibration.secondary_matrix(),
                learnt=learnt_directions(calibration),
            )
            for calibration in calibrations.values()
        ),
        joint=joint,
        warnings=tuple(dict.fromkeys(doubts)),
    )


def _without_equation(sensor: str) -> str:
    return (
        f"{sensor}: beside no untouched part whose joints were logged, so not calibrated; its readings count by their "
        "weight at most"
    )


def calibration_file(sensor: str, serial: str) -> str:
    """Name the file of a sensor's calibration.

    Args:
        sensor: Name of the sensor.
        serial: Its serial number.

    Returns:
        Name and serial number, quoted because either may hold a slash.
    """
    return f"{quote(f'{sensor}_{serial}', safe=' ')}.json"
