# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate all sensors of a robot jointly, from any number of recordings that are read once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, Self
from urllib.parse import quote

import numpy as np

from forcetorque.base.errors import EstimationError, ExperimentError, FitError, ForceTorqueError
from forcetorque.calibration.calibrate import SensorCalibration, SensorCalibrations, data_doubts, fit_doubts
from forcetorque.calibration.corrected_urdf import urdf_of
from forcetorque.calibration.generative.agreement import require_unmirrored
from forcetorque.calibration.joint.posterior_and_calibrations import joint_posterior, sensor_artefact
from forcetorque.calibration.joint.result import JointOutcome
from forcetorque.calibration.joint.robust_fit import JointResult, fit_stretches
from forcetorque.calibration.joint.unknowns import JointFit, SensorPrior
from forcetorque.calibration.joint.untouched_interval import JointInterval, joint_interval, required_prior
from forcetorque.calibration.moments_of_samples import assumptions_of
from forcetorque.experiment.calibration.calibration_file import Calibration, calibrations_in, read_calibration
from forcetorque.experiment.calibration.provenance import Content, readings_twice
from forcetorque.experiment.calibration.robot_model_error import ModelTolerance, TermKind
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignRecording
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.interval_samples import logged_content
from forcetorque.experiment.long_recording import first_segment, segment_experiments
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.plausibility.gate import require_sense
from forcetorque.recording.recording import Use

JOINT_FILE = "joint.json"
"""Name of the file with the covariance of all sensors, beside their calibrations."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointData:
    """What the calibration intervals of recordings say of several sensors."""

    campaigns: Mapping[str, Campaign]
    """Every sensor in all recordings, by its name."""
    intervals: tuple[JointInterval, ...]
    """The intervals."""
    references: Mapping[tuple[str, str], float]
    """By sensor and name of its linear variables, the value at which each adds nothing."""
    left_out: tuple[str, ...] = ()
    """Intervals in which every part is touched, in words."""

    @classmethod
    def of(
        cls, experiments: Sequence[Experiment], sensors: Sequence[str] | None, progress: Callable[[str], None]
    ) -> Self:
        """Read them.

        Args:
            experiments: Recordings of one robot.
            sensors: Sensors with a prior matrix; all of the first file if None.
            progress: Called with what is being done.

        Returns:
            The data.

        Raises:
            ExperimentError: If there is no calibration interval, the files are of different sensors, two have the same
                readings, or in one no untouched part has all joints in the log.
            EstimationError: If every part is touched in every interval.
            FitError: If a variable of a sensor has no value in them.
        """
        names = tuple(sensor.name for sensor in experiments[0].sensors) if sensors is None else tuple(sensors)
        campaigns = {name: Campaign([SensorRun(experiment, name) for experiment in experiments]) for name in names}
        for message in readings_twice(_contents(campaigns[names[0]])).values():
            raise ExperimentError(f"{message}; leave one of the two out")
        references = {pair: value for one in campaigns.values() for pair, value in _references(one)}
        intervals, touched = [], []
        for label, outcome in _intervals(campaigns[names[0]], names, references, progress):
            if isinstance(outcome, JointInterval):
                intervals.append(outcome)
            else:
                touched.append((label, outcome))
        if not intervals:
            raise touched[0][1]
        pairs = ((name, one.linear.name) for name, own in campaigns.items() for one in own.sensor.variables)
        for sensor, variable in pairs:
            if (sensor, variable) not in references and any(sensor in one.raw for one in intervals):
                raise FitError(
                    f"sensor {sensor!r}: variable {variable!r} has no value in the calibration intervals; log it, or "
                    "leave it out of [[sensor]]"
                )
        left_out = tuple(f"interval {label!r} is left out: {error}" for label, error in touched)
        return cls(campaigns=campaigns, intervals=tuple(intervals), references=references, left_out=left_out)

    @property
    def recordings(self) -> tuple[str, ...]:
        """Names of the recordings that have a calibration interval."""
        return tuple(dict.fromkeys(one.untouched.stretch.recording for one in self.intervals))

    def of_recordings(self, recordings: Collection[str]) -> tuple[JointInterval, ...]:
        """Pick the intervals of some recordings.

        Args:
            recordings: Their names.

        Returns:
            The intervals.
        """
        return tuple(one for one in self.intervals if one.untouched.stretch.recording in recordings)

    def fit(
        self,
        intervals: Sequence[JointInterval],
        tolerance: ModelTolerance | None = None,
        progress: Callable[[str], None] = lambda _: None,
    ) -> JointResult:
        """Fit all sensors to some intervals.

        Args:
            intervals: Some of these intervals.
            tolerance: How far the robot model may be off; `ModelTolerance()` if None.
            progress: Called with what is being done.

        Returns:
            The fit.

        Raises:
            FitError: If there are no equations.
        """
        specified = ModelTolerance() if tolerance is None else tolerance
        priors = {name: _prior(campaign, specified, intervals) for name, campaign in self.campaigns.items()}
        return fit_stretches([one.untouched for one in intervals], specified, priors=priors, progress=progress)

    def calibrations(
        self, intervals: Sequence[JointInterval], result: JointResult, *, code_version: str, created: str
    ) -> dict[str, Calibration]:
        """Give the calibration of every sensor beside a part with forces and moments.

        One of which only weights are known is no calibration: they tell nothing of its moments.

        Args:
            intervals: The intervals that were fitted.
            result: The fit.
            code_version: Version of this library, for the record.
            created: Date and time, ISO 8601, for the record.

        Returns:
            Calibrations by sensor.
        """
        whole = {name for part in result.residuals if part.rows.all() and part.kept.any() for name in part.sensors}
        return {
            name: sensor_artefact(
                name,
                campaign,
                intervals,
                result,
                references={
                    variable: self.references[owner, variable] for owner, variable in self.references if owner == name
                },
                joint_file=JOINT_FILE,
                code_version=code_version,
                created=created,
            )
            for name, campaign in self.campaigns.items()
            if name in whole
        }


def _prior(campaign: Campaign, tolerance: ModelTolerance, intervals: Sequence[JointInterval]) -> SensorPrior:
    sensor = campaign.sensor
    assumptions = assumptions_of(CampaignRecording.of(campaign.runs[0]))
    extents = []
    for variable in sensor.variables:
        pair = sensor.name, variable.linear.name
        seen = np.concatenate([np.empty(0), *(one.variables[pair] for one in intervals if pair in one.variables)])
        if np.isfinite(seen).any():  # else the sensor is beside no part that is fitted
            extents.append((variable.linear, float(np.nanmax(seen) - np.nanmin(seen))))
    assumptions = replace(assumptions, mount=tolerance.mount_of(sensor.name))
    try:
        return SensorPrior.of(required_prior(sensor), assumptions, extents)
    except FitError as error:
        raise FitError(f"sensor {sensor.name!r}: {error}") from error


_FEW: Final = 1000
"""Instants at which a variable is read at a time, in search of its first value."""


def _references(campaign: Campaign) -> Iterator[tuple[tuple[str, str], float]]:
    """Values at which the variables of a sensor add nothing: as stated, or the first of its calibration intervals."""
    for variable in campaign.sensor.variables:
        name, stated = variable.linear.name, variable.linear.reference_value
        value = _first_value(campaign, name) if stated is None else stated
        if value is not None:  # without calibration data the first recording says itself what it lacks
            yield (campaign.sensor.name, name), value


def _first_value(campaign: Campaign, variable: str) -> float | None:
    """A variable at the first instant of the calibration intervals that has a value."""
    for run in campaign.runs:
        source = run.sensor.variable(variable).source
        for part in segment_experiments(run.experiment) or (run.experiment,):
            stamps = part.recording.stream(campaign.sensor.stream).stamp_ns
            for interval in part.recording.intervals:
                if interval.use is Use.CALIBRATION:
                    own = stamps[interval.holds(stamps)]
                    for start in range(0, len(own), _FEW):
                        values = source.at(part.recording, own[start : start + _FEW])
                        finite = values[np.isfinite(values)]
                        if len(finite):
                            return float(finite[0])
    return None


def _contents(campaign: Campaign) -> Iterator[tuple[str, float, Content | None]]:
    """Recording of calibration readings, or segment of a long one, their duration, and by what they are known again."""
    for run in campaign.runs:
        segments = segment_experiments(run.experiment)
        for part in segments or (run.experiment,):
            for interval in part.recording.intervals if len(segments) + len(campaign.runs) > 1 else ():
                start_s = round((interval.start_ns - run.experiment.recording.start_ns) * 1e-9)
                name = campaign.recording(run) + (f" from {start_s} s" if segments else "")
                if interval.use is Use.CALIBRATION:
                    yield name, interval.end_ns - interval.start_ns, logged_content(part, run.sensor, interval)


def _intervals(
    campaign: Campaign,
    sensors: Sequence[str],
    references: Mapping[tuple[str, str], float],
    progress: Callable[[str], None],
) -> Iterator[tuple[str, JointInterval | EstimationError]]:
    """Each with its label: what it says, or why no part of it does."""
    runs = [
        run for run in campaign.runs if any(one.use is Use.CALIBRATION for one in run.experiment.recording.intervals)
    ]
    for run in runs or campaign.runs[:1]:  # the first says itself what it lacks
        segments = segment_experiments(run.experiment)
        for interval in run.experiment.intervals(Use.CALIBRATION):
            label = campaign.label(run, interval.label)
            progress(f"reading {label}")
            try:
                with campaign.stated(run):
                    outcome: JointInterval | EstimationError = joint_interval(
                        run.experiment,
                        interval,
                        sensors,
                        label=label,
                        recording=campaign.recording(run),
                        session=campaign.session(run, interval.label),
                        segments=segments,
                        references=references,
                    )
            except EstimationError as error:
                outcome = error
            yield label, outcome


FILES = "calibrations"
"""What the calibrations are called together that are given as files, where there are several."""


def read_candidates(paths: Iterable[Path]) -> dict[str, Mapping[str, Calibration]]:
    """Read calibrations of the sensors of a robot: all files are one candidate, every folder is one of its own.

    Args:
        paths: Calibration files, and folders of them such as `calibrate --jointly` writes.

    Returns:
        By name of the candidate its calibrations by name of their file.

    Raises:
        MissingFileError: If a folder holds no calibration.
        FormatError: If a file is none.
    """
    candidates: dict[str, Mapping[str, Calibration]] = {}
    single: dict[str, Calibration] = {}
    for path in paths:
        if not path.is_dir():
            single[str(path)] = read_calibration(path)
        else:
            candidates[str(path)] = calibrations_in(path)
    if single:
        return {next(iter(single)) if len(single) == 1 else FILES: single, **candidates}
    return candidates


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
        tolerance: How far the robot model may be off; what the first file says if None.
        progress: Called with what is being done.

    Returns:
        A calibration per sensor, which no file holds yet, and in `joint` errors of the model, what is left of the
        equations, and spans that were touched.

    Raises:
        ExperimentError: If there is no calibration interval, the files are of different sensors, or in one no untouched
            part has all joints in the log.
        EstimationError: If every part is touched in every interval.
        FitError: If a sensor that was asked for is beside no untouched part whose joints were logged; the data of one
            cannot be those under the load beyond it, where that is known; or a body comes out with a mass below zero,
            as where gravity or a sensor has the wrong sign.
    """
    data = JointData.of(experiments, sensors, progress)
    for campaign in data.campaigns.values():
        _require_sense(campaign)
    specified = experiments[0].fit_options.tolerance if tolerance is None else tolerance
    result = data.fit(data.intervals, specified, progress)
    require_positive_masses(result.fit)
    for name in result.fit.places.sensors:
        try:
            require_unmirrored(result.fit.change(name))
        except FitError as error:
            raise FitError(f"sensor {name!r}: {error}") from error
    calibrations = data.calibrations(data.intervals, result, code_version=code_version, created=created)
    if not calibrations:
        raise FitError(
            f"{', '.join(data.campaigns)}: beside no untouched part whose joints were logged; log them all, name the "
            "other sensors of the part too, or take a motion in which nothing touches it"
        )
    place = Path(folder)
    described = {name: campaign.sensor for name, campaign in data.campaigns.items()}
    posterior = joint_posterior(result.fit, described, data.references)
    joint = JointOutcome.of(result, calibrations, str(place / JOINT_FILE), posterior)
    doubts = [
        *data.left_out,
        *(
            f"{name}: beside no untouched part whose joints were logged, so not calibrated; its readings count by "
            "their weight at most"
            for name in data.campaigns
            if name not in calibrations
        ),
        *joint.doubts(urdf_of(experiments[0])),
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
            SensorCalibration.of(
                place / calibration_file(calibration.sensor.name, calibration.sensor.serial),
                calibration,
                data.campaigns[name],
            )
            for name, calibration in calibrations.items()
        ),
        joint=joint,
        has_validation=any(run.has(Use.VALIDATION) for one in data.campaigns.values() for run in one.runs),
        warnings=tuple(dict.fromkeys(doubts)),
    )


def _require_sense(campaign: Campaign) -> None:
    """Refuse a sensor that is read the wrong way round, where nothing touches the robot beyond it.

    Factors are no reason: in a motion that hardly moves its load the noise of an IMU moves the expected wrench more.
    Of a long recording the first segment with calibration data is looked at.

    Raises:
        FitError: If it is so.
    """
    try:
        first = Campaign([first_segment(run, Use.CALIBRATION) for run in campaign.runs])
        data = first.data_sets(Use.CALIBRATION)
    except ForceTorqueError:
        return  # the load beyond it is not known
    try:
        require_sense(data, required_prior(campaign.sensor))
    except FitError as error:
        raise FitError(f"sensor {campaign.sensor.name!r}: {error}") from error


_SURE: Final = 3.0
"""Standard deviations by which a mass is below zero."""


def require_positive_masses(fit: JointFit) -> None:
    """Refuse what no robot can be, but the wrong sign of gravity or of a sensor makes of it.

    Args:
        fit: The fit.

    Raises:
        FitError: If the mass of a body is below zero by three standard deviations.
    """
    masses = [(1.0 + value, left, term.name) for term, value, left in fit.model_errors() if term.kind is TermKind.MASS]
    share, deviation, name = min(masses, key=lambda mass: mass[0] / mass[1], default=(1.0, 0.0, ""))
    if share < -_SURE * deviation:
        raise FitError(
            f"{name}: by the data it is {share:.2g} times that of the model (standard deviation {deviation:.2g}), as "
            "if a sign were wrong; check gravity_direction of the support, and which side acts in the readings of the "
            "sensors beside this body (measure_direction)"
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
