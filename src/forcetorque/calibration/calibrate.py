# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate a sensor, by the generative model or by a type of the thesis, and warn of what makes it doubtful."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Literal

from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.generative.artefact import generative_calibration
from forcetorque.calibration.reduce_recordings import recording_moments
from forcetorque.calibration.thesis.from_samples import thesis_calibration
from forcetorque.experiment.calibration.artefact import CalibratedVariable, Calibration
from forcetorque.experiment.calibration.estimation_type import EstimationType, estimation_type
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.free_sub_model import possible_touch

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
    try:
        return _fitted(
            campaign,
            code_version=code_version,
            created=created,
            moments=moments,
            regularisation=regularisation,
            kind=kind,
            nonlinear=nonlinear,
        )
    except FitError as error:
        sentences = dict.fromkeys(sentence for run in campaign.runs if (sentence := possible_touch(run)) is not None)
        if not sentences:
            raise
        raise FitError("; ".join([str(error), *sentences])) from error


def _fitted(
    campaign: Campaign,
    *,
    code_version: str,
    created: str,
    moments: Sequence[RecordingMoments],
    regularisation: float | Literal["held-out"] | None,
    kind: EstimationType | str | None,
    nonlinear: bool | None,
) -> Calibration:
    experiment = campaign.runs[0].experiment
    options = experiment.fit_options
    if kind == "generative" or (kind is None and regularisation is None and options.generative):
        recordings = [*moments, *recording_moments(campaign)]
        return generative_calibration(recordings, code_version=code_version, created=created, nonlinear=nonlinear)
    if nonlinear:
        raise FitError("nonlinear: the types of the thesis are linear; leave out the estimation type and lambda")
    if moments:
        raise FitError(_MOMENTS)
    if isinstance(regularisation, str) and regularisation != "held-out":
        raise FitError(f"regularisation: expected lambda in counts2, or 'held-out', got {regularisation!r}")
    named = estimation_type(kind) if isinstance(kind, str) else kind
    given = experiment.fit_options.regularisation if regularisation is None else regularisation
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


def fit_doubts(calibration: Calibration, *, said: Collection[str] = ()) -> Iterator[str]:
    """Say what makes a calibration doubtful.

    Args:
        calibration: The calibration.
        said: Doubts about its data that were said already.

    Yields:
        A sentence per doubt, with the name of the sensor.
    """
    sensor = calibration.sensor.name
    own = (*_turned(calibration), *_unmoved(calibration), *_left_prior(calibration), *_refused(calibration))
    for sentence in (*(doubt for doubt in calibration.doubts if doubt not in said), *own):
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


def _unit(variable: CalibratedVariable) -> str:
    return f"{variable.unit} " if variable.unit else ""
