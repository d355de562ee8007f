# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate all sensors of a robot at once, from any number of recordings."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from urllib.parse import quote

from forcetorque.analysis.calibration_doubts import fit_doubts
from forcetorque.analysis.campaign import Campaign
from forcetorque.analysis.campaign_recording import CampaignRecording
from forcetorque.analysis.joint_artefact import sensor_artefact
from forcetorque.analysis.joint_interval import JointInterval, joint_interval, required_prior
from forcetorque.analysis.joint_outcome import JointOutcome
from forcetorque.analysis.learnt import learnt_directions
from forcetorque.analysis.recording_moments import channel_full_scale
from forcetorque.analysis.sensor_calibration import SensorCalibration, SensorCalibrations, data_doubts
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.calibration.joint import ChangeSpread, ModelTolerance, fit_stretches
from forcetorque.experiment import Experiment
from forcetorque.recording import Use

JOINT_FILE = "joint.json"
"""Name of the file with the covariance of all sensors, beside their calibrations."""


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
        EstimationError: If every part of an interval is touched.
        FitError: If a sensor that was asked for is beside no untouched part whose joints were logged.
    """
    names = tuple(sensor.name for sensor in experiments[0].sensors) if sensors is None else tuple(sensors)
    campaigns = {name: Campaign([SensorRun(experiment, name) for experiment in experiments]) for name in names}
    first = campaigns[names[0]]
    intervals = list(_intervals(first, names, progress))
    spreads = {name: _spread(campaign) for name, campaign in campaigns.items()}
    result = fit_stretches([one.untouched for one in intervals], tolerance, spreads=spreads, progress=progress)
    place = Path(folder)
    calibrations = {
        name: sensor_artefact(
            name, campaigns[name], intervals, result, joint_file=JOINT_FILE, code_version=code_version, created=created
        )
        for name in names
        if name in result.fit.places.sensors
    }
    joint = JointOutcome.of(result, calibrations, str(place / JOINT_FILE))
    doubts = [
        *(_without_equation(name) for name in names if name not in calibrations),
        *joint.doubts(),
        *(doubt for name in calibrations for run in campaigns[name].runs for doubt in data_doubts(run, by_model=False)),
        *(doubt for calibration in calibrations.values() for doubt in fit_doubts(calibration)),
    ]
    return SensorCalibrations(
        experiment="; ".join(dict.fromkeys(first.experiments)),
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


def _spread(campaign: Campaign) -> ChangeSpread:
    full_scale = channel_full_scale(CampaignRecording.of(campaign.runs[0]))
    return ChangeSpread.of(required_prior(campaign.sensor), full_scale)


def _without_equation(sensor: str) -> str:
    return f"{sensor}: beside no untouched part whose joints were logged, so not calibrated"


def _intervals(campaign: Campaign, sensors: Sequence[str], progress: Callable[[str], None]) -> Iterator[JointInterval]:
    runs = [
        run for run in campaign.runs if any(one.use is Use.CALIBRATION for one in run.experiment.recording.intervals)
    ]
    for run in runs or campaign.runs[:1]:  # the first says itself what it lacks
        for interval in run.experiment.intervals(Use.CALIBRATION):
            label = campaign.label(run, interval.label)
            progress(f"reading {label}")
            with campaign.stated(run):
                yield joint_interval(
                    run.experiment,
                    interval,
                    sensors,
                    label=label,
                    recording=campaign.recording(run),
                    session=campaign.session(run, interval.label),
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
