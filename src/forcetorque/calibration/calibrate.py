# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate a sensor, by the generative model or a type of the thesis, for a file; warnings about the result."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, Self

from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.answers import calibration_answer
from forcetorque.calibration.corrected_urdf import urdf_of
from forcetorque.calibration.generative.generative_calibration import generative_calibration
from forcetorque.calibration.interval_and_mount_doubts import (
    SegmentedDoubts,
    doubts_of_intervals,
    doubts_of_samples,
    with_estimated_mount,
)
from forcetorque.calibration.joint.result import JointOutcome
from forcetorque.calibration.reduced_recordings import recording_moments, reduced_in_segments
from forcetorque.calibration.summary import (
    InformationGain,
    calibration_blocks,
    component_records,
    information_figure,
    information_gains,
    learnt_words,
)
from forcetorque.calibration.thesis.calibrate import thesis_calibration
from forcetorque.experiment.calibration.calibration_file import CalibratedVariable, Calibration
from forcetorque.experiment.calibration.estimation_type import EstimationType, estimation_type
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import place_in_urdf
from forcetorque.experiment.calibration.robot_model_error import ModelError
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.free_sub_model import possible_touch
from forcetorque.experiment.long_recording import is_long, segment_runs, segments_of_run
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import unreliable_intervals
from forcetorque.recording.recording import Use
from forcetorque.results.answer import Answer
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Table, table_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOMENTS = "stored moments are fitted by the generative model; leave out the estimation type and lambda"


def calibrate_sensor(
    runs: Runs | None,
    *,
    code_version: str,
    created: str,
    moments: Sequence[RecordingMoments] = (),
    regularisation: float | Literal["held-out"] | None = None,
    kind: EstimationType | str | None = None,
    nonlinear: bool | None = None,
) -> Calibration:
    """Fit a sensor on the calibration intervals of any number of recordings.

    Args:
        runs: The sensor, in one experiment or several; None where moments are all there is.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        moments: What was kept of other recordings, for the generative model.
        regularisation: Lambda of a type of the thesis; counts2; `held-out` to choose it on held-out data; None for what
            the experiment says.
        kind: `generative`, or an estimation type of the thesis, also by its name, such as `OwTrTO`; None for what the
            experiment says, which is the generative model unless it names a type or a lambda, or one is given here.
        nonlinear: Whether quadratic terms may correct readings; None for what the experiment says.

    Returns:
        The calibration, with everything that tells how far to trust it.

    Raises:
        ExperimentError: If files ask for different estimators.
        FitError: If no estimation type is called so; the data cannot be those of the sensor under the modelled load, or
            do not determine the fit; or moments are to be fitted by a type of the thesis, which needs samples; or
            quadratic terms are asked for of such a type, or of a single recording.
    """
    if runs is None:
        if kind not in (None, "generative") or regularisation is not None:
            raise FitError(_MOMENTS)
        return generative_calibration(moments, code_version=code_version, created=created, nonlinear=nonlinear)
    campaign = Campaign.of(runs)
    if kind is None and regularisation is None:
        _require_one_estimator(campaign)
    campaign, mount = with_estimated_mount(campaign)
    options = campaign.runs[0].experiment.fit_options
    with _stating_touches(campaign):
        if kind == "generative" or (kind is None and regularisation is None and options.generative):
            recordings = [*moments, *recording_moments(campaign)]
            calibration = generative_calibration(
                recordings, code_version=code_version, created=created, nonlinear=nonlinear
            )
        elif nonlinear:
            raise FitError("nonlinear: the types of the thesis are linear; leave out the estimation type and lambda")
        elif moments:
            raise FitError(_MOMENTS)
        else:
            calibration = _of_thesis(campaign, regularisation, kind, code_version=code_version, created=created)
    return calibration if mount is None else calibration.model_copy(update={"mount": mount})


@contextmanager
def _stating_touches(campaign: Campaign) -> Iterator[None]:
    """Add to a refusal what may touch the robot beyond the sensor."""
    try:
        yield
    except FitError as error:
        sentences = dict.fromkeys(sentence for run in campaign.runs if (sentence := possible_touch(run)) is not None)
        if not sentences:
            raise
        raise FitError("; ".join([str(error), *sentences])) from error


def _of_thesis(
    campaign: Campaign,
    regularisation: float | Literal["held-out"] | None,
    kind: EstimationType | str | None,
    *,
    code_version: str,
    created: str,
) -> Calibration:
    if isinstance(regularisation, str) and regularisation != "held-out":
        raise FitError(f"regularisation: expected lambda in counts2, or 'held-out', got {regularisation!r}")
    options = campaign.runs[0].experiment.fit_options
    named = estimation_type(kind) if isinstance(kind, str) else kind
    given = options.regularisation if regularisation is None else regularisation
    return thesis_calibration(
        campaign,
        options.kind(has_variables=bool(campaign.sensor.variables)) if named is None else named,
        regularisation=None if given == "held-out" else given,
        code_version=code_version,
        created=created,
    )


def _require_one_estimator(campaign: Campaign) -> None:
    """Refuse files that ask for different estimators: one of them would be overruled in silence."""
    first, *others = (run.experiment for run in campaign.runs)
    for other in others:
        if _estimator(other) != _estimator(first):
            raise ExperimentError(
                f"{other.file}: expected the estimator that [calibration] of {first.file} asks for, got another; state "
                "the same type, offset, variables and lambda in both, or give an estimation type for all"
            )


def _estimator(experiment: Experiment) -> tuple[object, ...]:
    options = experiment.fit_options
    of_thesis = (options.offset, options.from_reference, experiment.fit_options.regularisation)
    return options.generative, options.with_variables, None if options.generative else of_thesis


def fit_doubts(calibration: Calibration, *, said: Collection[str] = (), urdf: Path | None = None) -> Iterator[str]:
    """Say what makes a calibration doubtful.

    Args:
        calibration: The calibration.
        said: Doubts about its data that were said already.
        urdf: File of the robot model, whose lines are named; None where there is none.

    Yields:
        A sentence per doubt, with the name of the sensor.
    """
    sensor = calibration.sensor.name
    own = (
        *_turned(calibration),
        *_unmoved(calibration),
        *_left_prior(calibration),
        *_refused(calibration),
        *_wrong_model(calibration, urdf),
    )
    for sentence in (*(doubt for doubt in calibration.warnings if doubt not in said), *own):
        yield f"{sensor}: {sentence}"


def _turned(calibration: Calibration) -> Iterator[str]:
    secondary = calibration.secondary_matrix()
    if secondary is None:
        return
    turned = [c for c, own in zip(WRENCH_COMPONENTS, secondary.diagonal(), strict=True) if own < 0.0]
    if turned:
        yield (
            f"{', '.join(turned)} come(s) out with the sign of the prior reversed; "
            "is gravity_direction or measure_direction the right way round?"
        )


def _unmoved(calibration: Calibration) -> Iterator[str]:
    """Variables that say nothing because they did not move."""
    if calibration.posterior is None:
        return
    for variable in calibration.variables:
        if variable.maximum == variable.minimum:
            yield (
                f"{variable.name} is {variable.minimum:g} {_unit(variable)}throughout the fitted data, so that what it "
                "does is not known: its coefficients are those that were expected"
            )


def _left_prior(calibration: Calibration) -> Iterator[str]:
    """A type of the thesis shrinks the matrix where no load speaks; the generative model keeps the prior there."""
    excited = calibration.validity.excited
    if calibration.posterior is not None or not (unexcited := excited.count(False)):
        return
    yield (
        f"the loads leave {unexcited} of {len(excited)} raw directions unexcited; along them "
        f"{calibration.estimation_type} leaves the prior for noise, and a load that was not recorded may read worse "
        "than before; the default estimator keeps the prior there"
    )


def _refused(calibration: Calibration) -> Iterator[str]:
    """A correction that was asked for and lost."""
    if calibration.nonlinear is not None:
        yield from calibration.nonlinear.refusals()


_MOST_ERRORS = 3
"""Errors of the robot model that a warning lists."""


def _wrong_model(calibration: Calibration, urdf: Path | None) -> Iterator[str]:
    """Numbers of the robot model, and pulls of cables, beyond their tolerances."""
    errors = sorted(
        (error for error in calibration.model_errors if error.is_suspicious),
        key=lambda error: -abs(error.value) / error.tolerance,
    )
    if of_model := [error for error in errors if not error.is_of_cables]:
        yield (
            f"the robot model does not fit the data within its tolerances: {_listed(of_model, urdf)}. One sensor does "
            "not separate all masses, centres and zeros, so another link or joint may be the cause: weigh or measure "
            "before you change the URDF, or raise [robot] tolerance"
        )
    if of_cables := [error for error in errors if error.is_of_cables]:
        yield (
            "the load changes with positions of joints as if cables or covers pulled, along the axes of the sensor: "
            f"{_listed(of_cables, urdf)}. Look at cables, hoses and covers that cross the sensor; another joint that "
            "moves alike, or a contact, may be the cause; raise cable_N_rad in [robot] tolerance if they are to stay"
        )


def _listed(errors: Sequence[ModelError], urdf: Path | None) -> str:
    """The first of some errors, and how many there are beside."""
    listed = "; ".join(error.message + place_in_urdf(urdf, error.name) for error in errors[:_MOST_ERRORS])
    return f"{listed}; and {len(errors) - _MOST_ERRORS} more" if len(errors) > _MOST_ERRORS else listed


def _unit(variable: CalibratedVariable) -> str:
    return f"{variable.unit} " if variable.unit else ""


class SensorCalibration(Row):
    """One calibration and the file that holds it."""

    file: str
    """Path of the file."""
    calibration: Calibration = Field(repr=False)
    """Its content."""
    secondary_matrix: Annotated[FloatArray, ArrayField((6, 6))] | None
    """`C C_prior^-1`, for a stream that is calibrated with the prior."""
    information_gain: tuple[InformationGain, ...] | None
    """What the recordings taught of every load direction; None for a type of the thesis, or without a prior."""
    channels: tuple[str, ...] = Field(default=(), exclude=True, repr=False)
    """Names of its channels in the logs; none where they have none, or several."""

    @classmethod
    def of(cls, file: Path | str, calibration: Calibration, campaign: Campaign | None) -> Self:
        """Take a calibration.

        Args:
            file: As of the class.
            calibration: As of the class.
            campaign: The fitted recordings; None where moments were all there was.

        Returns:
            The calibration with what is told of it.
        """
        return cls(
            file=str(file),
            calibration=calibration,
            secondary_matrix=calibration.secondary_matrix(),
            information_gain=information_gains(calibration),
            channels=() if campaign is None else channel_names(campaign),
        )


class SensorCalibrations(DrawnResult):
    """Calibrations of the sensors of an experiment."""

    interval_uses = ("calibration",)

    schema_name: Literal["forcetorque/calibrate/2"] = Field(default="forcetorque/calibrate/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    calibrations: tuple[SensorCalibration, ...]
    """One per sensor that could be fitted."""
    joint: JointOutcome | None = None
    """What a joint calibration says beside that; None where every sensor was calibrated alone."""
    saved: bool = Field(default=False, exclude=True, repr=False)
    """Whether the files are written; nothing is until `save`."""
    has_validation: bool = Field(default=True, exclude=True, repr=False)
    """Whether the recordings have data to evaluate it on."""

    def save(self, *, force: bool = False) -> Self:
        """Write every calibration to its file, in folders that are made where they are missing.

        Args:
            force: As of `Calibration.save`.

        Returns:
            The same, which says that it is written.
        """
        for entry in self.calibrations:
            file = Path(entry.file)
            file.parent.mkdir(parents=True, exist_ok=True)
            entry.calibration.save(file, force=force)
        if self.joint is not None and self.joint.file is not None and self.joint.posterior is not None:
            self.joint.posterior.save(self.joint.file, force=force)
        return self.model_copy(update={"saved": True})

    def figure(self) -> Figure:
        """Draw the information gained of every sensor or, of a joint calibration, residuals.

        Returns:
            The figure of `joint_figure` for a joint calibration, else of `learnt_figure`.

        Raises:
            FitError: If no calibration is a generative fit towards a prior matrix.
        """
        from forcetorque.calibration.figures.information import joint_figure

        if self.joint is not None:
            return joint_figure(self.joint.residuals)
        return information_figure([entry.calibration for entry in self.calibrations])

    def answers(self) -> Iterator[Answer]:
        """Say of every sensor what the recordings taught, and how to evaluate it.

        Yields:
            One per sensor.
        """
        for entry in self.calibrations:
            words = f"{entry.calibration.sensor.name}: "
            yield calibration_answer(
                entry.calibration,
                entry.information_gain,
                entry.file,
                saved=self.saved,
                doubtful=any(len(self.calibrations) == 1 or one.startswith(words) for one in self.warnings),
                has_validation=self.has_validation,
            )

    def blocks(self) -> Iterator[Table | str]:
        """Give matrix, variables and excitation of every sensor.

        Yields:
            Tables and sentences.
        """
        for entry in self.calibrations:
            yield from calibration_blocks(entry.calibration, entry.channels)
            if entry.information_gain:
                yield table_of(
                    entry.information_gain, "information gained: error that a unit load makes, one standard deviation"
                )
                yield learnt_words(entry.information_gain)
            yield f"written to {entry.file}" if self.saved else f"not written yet: `save` writes {entry.file}"
        if self.joint is not None:
            yield from self.joint.blocks()
            if self.joint.file is not None:
                written = f"written to {self.joint.file}" if self.saved else f"goes to {self.joint.file} by `save`"
                yield f"covariance of all sensors together {written}"

    def records(self) -> list[dict[str, object]]:
        """Give matrices, offsets and coefficients as flat lines.

        Returns:
            One line per sensor and component.
        """
        return [line for entry in self.calibrations for line in component_records(entry.calibration)]


@with_recording_notes
def calibrate_for_file(
    runs: Runs | None,
    file: Path | str,
    *,
    code_version: str,
    created: str,
    moments: Sequence[RecordingMoments] = (),
    regularisation: float | Literal["held-out"] | None = None,
    kind: EstimationType | str | None = None,
    nonlinear: bool | None = None,
) -> SensorCalibrations:
    """Fit a sensor, and say what makes the calibration doubtful.

    Of several recordings those that cannot be evaluated are left out, and named in the warnings.

    Args:
        runs: The sensor, in one experiment or several.
        file: File that `save` of the result writes.
        code_version: As of `calibrate_sensor`.
        created: As of `calibrate_sensor`.
        moments: As of `calibrate_sensor`.
        regularisation: As of `calibrate_sensor`.
        kind: As of `calibrate_sensor`.
        nonlinear: As of `calibrate_sensor`.

    Returns:
        The calibration, which no file holds yet.
    """
    campaign = None if runs is None else Campaign.of(runs).usable()
    calibration = calibrate_sensor(
        campaign,
        code_version=code_version,
        created=created,
        moments=moments,
        regularisation=regularisation,
        kind=kind,
        nonlinear=nonlinear,
    )
    left_out = () if campaign is None else campaign.left_out
    urdf = None if campaign is None else urdf_of(campaign.runs[0].experiment)
    doubts = [sentence for run in (campaign.runs if campaign else ()) for sentence in data_doubts(run)]
    doubts += [sentence for sentence in calibration.provenance.added if sentence not in doubts]  # of stored moments
    return SensorCalibrations(
        experiment=calibration.provenance.experiment,
        calibrations=(SensorCalibration.of(file, calibration, campaign),),
        has_validation=campaign is None or any(run.has(Use.VALIDATION) for run in campaign.runs),
        warnings=(*left_out, *doubts, *fit_doubts(calibration, said=doubts, urdf=urdf)),
    )


def channel_names(campaign: Campaign) -> tuple[str, ...]:
    """Give the names of the channels of a sensor, as its logs have them.

    Args:
        campaign: The sensor.

    Returns:
        A name per channel; none where counts are recovered from wrenches, or recordings have other names.
    """
    names = {
        run.stream.signal(run.sensor.quantity).columns
        if run.sensor.quantity == "raw" or run.sensor.prior_source == "identity"
        else ()
        for run in campaign.runs
    }
    return names.pop() if len(names) == 1 else ()


def data_doubts(run: SensorRun, *, by_model: bool = True) -> Iterator[str]:
    """Say what makes any fit on the calibration intervals doubtful.

    Args:
        run: The sensor.
        by_model: Whether it is compared with the model, as if nothing but the support touched the robot.

    Yields:
        A sentence where the load was weighed with the sensor itself, one for whatever the readings then contradict of
        the file, one per interval in which the file says that something touches the robot beyond it, and one per
        finding in a fitted interval; of many of one kind the first few, and how many more there are.
    """
    if is_long(run):
        yield from reduced_in_segments(run).warnings if by_model else _doubts_of_segments(run)
        return
    sensors = (run.sensor.name,)
    yield from doubts_of_samples(run)
    found = unreliable_intervals(run.experiment, Use.CALIBRATION, by_model=by_model, sensors=sensors, computed=run)
    yield from doubts_of_intervals(run, found, by_model=by_model)


def _doubts_of_segments(run: SensorRun) -> tuple[str, ...]:
    """Those of a long recording that is not compared with the model."""
    doubts = SegmentedDoubts(run, by_model=False)
    for part in segment_runs(run):
        doubts.add(part)
        del part
    return doubts.warnings(segments_of_run(run))
