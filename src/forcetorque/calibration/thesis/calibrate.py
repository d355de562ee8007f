# SPDX-License-Identifier: BSD-3-Clause
"""From samples of one sensor to matrix, offset and lambda, and to the artefact, by an estimation type."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError, require_known
from forcetorque.calibration.thesis.lambda_choice import (
    BLOCKS,
    RULE,
    LambdaCurve,
    StandardErrors,
    choose_lambda,
    fewest_samples,
    jackknife_errors,
)
from forcetorque.calibration.thesis.regression import MatrixFit, fit_matrix, require_determined, solve
from forcetorque.experiment.calibration.calibration_file import CalibratedVariable, Calibration, Prior, SessionOffset
from forcetorque.experiment.calibration.estimation_type import Estimation, EstimationType, OffsetStrategy
from forcetorque.experiment.calibration.excitation import Excitation
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.provenance import (
    FittedLoads,
    Provenance,
    Selection,
    SensorIdentity,
    Validity,
    readings_twice,
)
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.payload.load_warnings import reference_doubts
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Use

_FLAT = 1e-6
"""Variance of the force along its weakest direction, relative to the strongest, below which it spans no space."""


def sphere_centre(moments: Moments) -> FloatArray:
    """Find the raw reading without load: where the regression of raw counts on the force passes zero force.

    Right only for a rigid limb that turns slowly in one posture, so that its moment is a linear
    function of its force, which gravity alone makes: `r0 = mean(r) - S_rf S_ff^-1 mean(f)`.

    Args:
        moments: Moments of such a motion, a grid.

    Returns:
        Raw offset; shape (c,); counts.

    Raises:
        FitError: If the force stays in a plane or on a line: its offset across is then unknown.
    """
    force = slice(moments.channels + moments.variables, moments.channels + moments.variables + 3)
    force_force = moments.second[force, force]
    spans = np.linalg.eigvalsh(force_force)
    if not spans[0] > _FLAT * spans[-1]:
        deviation = np.sqrt(np.maximum(spans, 0.0))
        raise FitError(
            "sphere offset: expected a force that turns in space, got one that moves by only "
            f"{deviation[0]:.3g} N along one direction and by {deviation[-1]:.3g} N along another; "
            "turn the limb about two axes, or take the one-shot offset"
        )
    slope = np.linalg.solve(force_force, moments.second[force, : moments.channels]).T  # (c, 3)
    return moments.raw_mean - slope @ moments.mean[force]


class HeldOut(StrEnum):
    """What the blocks are on which lambda is chosen."""

    RECORDINGS = "whole recordings"
    """Each recording is a block: what is learnt in one must hold in the others."""
    PIECES = "equal contiguous pieces of the intervals"
    """There is one recording, or one that can be fitted alone."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CalibrationFit:
    """A fit with the choice of lambda and its uncertainty."""

    fit: MatrixFit
    """The model, its residual and excitation."""
    estimation: Estimation
    """What was estimated: type, prior, variables, their reference values and the raw offset of the sphere types."""
    curve: LambdaCurve | None
    """Held-out error over lambda; None where lambda was given."""
    held_out: HeldOut | None
    """What was held out to choose it; None where lambda was given."""
    standard_errors: StandardErrors | None
    """Standard errors by leaving out blocks; None with one block."""
    prior_offset: FloatArray | None
    """Offset that the same data give with the prior matrix; shape (6,); N, N m; None without prior."""


def calibrate(
    data_sets: Sequence[DataSet],
    prior: FloatArray | None,
    *,
    regularisation: float | None = None,
    kind: EstimationType | None = None,
    variables: Sequence[LinearVariable] = (),
    sphere: Collection[str] | None = None,
) -> CalibrationFit:
    """Fit matrix, offset and linear variables of a sensor to the reference wrenches.

    Args:
        data_sets: Stretches of calibration data, at least one; they share one offset.
        prior: Matrix to stay close to; shape (6, c); None for a sensor without one.
        regularisation: Lambda; counts2; None to choose it on held-out recordings, or pieces of a single one.
        kind: Estimation type; if None, one-shot, with variables from their reference values if there are any.
        variables: What the columns of `variables` in the data sets are.
        sphere: For the sphere types, labels of the data sets that draw the sphere; may be None if there is only one.

    Returns:
        The fit, the choice of lambda and standard errors.

    Raises:
        FitError: If there are no data, lambda is to be chosen without a prior, or the data leave an
            unpenalised unknown undetermined.
        ShapeError: If the data sets have different numbers of channels or variables.
    """
    if kind is None:
        kind = EstimationType(with_variables=bool(variables), from_reference=bool(variables))
    if not data_sets:
        raise FitError("expected at least one calibration interval, got none")
    shapes = {(data.raw.shape[1], data.variables.shape[1]) for data in data_sets}
    if len(shapes) > 1:
        raise ShapeError(f"data sets: expected one number of raw channels and of variables, got {sorted(shapes)}")
    raw_offset = _raw_offset(data_sets, sphere) if kind.offset is OffsetStrategy.SPHERE else None
    estimation = estimation_of(data_sets[0], prior, kind=kind, variables=variables, raw_offset=raw_offset)
    blocks = _blocks(data_sets)
    moments = pooled(blocks)
    curve = held_out = None
    if regularisation is None:
        if prior is None:
            raise FitError("lambda cannot be chosen without a prior matrix; give a prior, or lambda 0")
        require_determined(moments, estimation, 0.0)
        recordings = _recordings(data_sets)
        held_out = HeldOut.RECORDINGS if len(recordings) > 1 else HeldOut.PIECES
        curve = choose_lambda(recordings if held_out is HeldOut.RECORDINGS else blocks, estimation)
        regularisation = curve.chosen
    fit = fit_matrix(moments, estimation, regularisation)
    return CalibrationFit(
        fit=fit,
        estimation=estimation,
        curve=curve,
        held_out=held_out,
        standard_errors=jackknife_errors(blocks, estimation, regularisation) if len(blocks) > 1 else None,
        prior_offset=None if prior is None else solve(moments, Estimation(prior=prior), math.inf).offset,
    )


def estimation_of(
    first: DataSet,
    prior: FloatArray | None,
    *,
    kind: EstimationType,
    variables: Sequence[LinearVariable] = (),
    raw_offset: FloatArray | None = None,
) -> Estimation:
    """Settle what a type takes from the data: the reference values of variables.

    Args:
        first: First data set; variables without a reference value of their own get that of its first sample.
        prior: Matrix to stay close to; shape (6, c); None for a sensor without one.
        kind: Estimation type.
        variables: What the columns of `variables` in the data are.
        raw_offset: Raw reading without load, for the sphere types; shape (c,); counts.

    Returns:
        Settings of the fit.

    Raises:
        ShapeError: If the data have another number of variables.
    """
    columns = first.variables.shape[1]
    if columns != len(variables):
        raise ShapeError(f"variables: {len(variables)} are described, the data sets have {columns}")
    values = np.zeros(columns)
    if kind.from_reference:
        own = [variable.reference_value for variable in variables]
        pairs = zip(first.variables[0], own, strict=True)
        values = np.array([value if given is None else given for value, given in pairs])
    return Estimation(
        kind=kind, prior=prior, variables=tuple(variables), reference_values=values, raw_offset=raw_offset
    )


def sphere_labels(labels: Sequence[str], named: Collection[str] | None) -> tuple[str, ...]:
    """Tell which data sets draw the sphere of the sphere types.

    Args:
        labels: Labels of the data sets.
        named: Those that the user names; None if there is only one data set.

    Returns:
        Their labels.

    Raises:
        FitError: If there are several and none is named, or a name is unknown.
    """
    if named is None and len(labels) > 1:
        raise FitError(
            f"sphere offset: name the data sets that draw the sphere, out of {', '.join(labels)}; "
            "in an experiment file they are sphere_intervals of [calibration]"
        )
    for label in named or ():
        require_known(label, labels, FitError, f"sphere offset: no data set is called {label!r}")
    return tuple(label for label in labels if named is None or label in named)


def _raw_offset(data_sets: Sequence[DataSet], sphere: Collection[str] | None) -> FloatArray:
    chosen = sphere_labels([data.label for data in data_sets], sphere)
    return sphere_centre(pooled(Moments.of(data.raw, data.reference) for data in data_sets if data.label in chosen))


def _blocks(data_sets: Sequence[DataSet]) -> list[Moments]:
    """Divide every stretch in equal contiguous pieces, so that there are at least `BLOCKS` in all."""
    pieces = math.ceil(BLOCKS / len(data_sets))
    return [
        Moments.of(data.raw[part], data.reference[part], data.variables[part])
        for data in data_sets
        for part in np.array_split(np.arange(len(data.raw)), min(pieces, max(len(data.raw), 1)))
    ]


def _recordings(data_sets: Sequence[DataSet]) -> list[Moments]:
    """Pool the data sets of every recording; one too short to be fitted alone goes with its neighbour."""
    moments: dict[str, list[Moments]] = {}
    for data in data_sets:
        moments.setdefault(data.recording, []).append(Moments.of(data.raw, data.reference, data.variables))
    blocks: list[Moments] = []
    for recording in map(pooled, moments.values()):
        if blocks and min(recording.count, blocks[-1].count) < fewest_samples(recording.channels):
            blocks[-1] = pooled([blocks[-1], recording])
        else:
            blocks.append(recording)
    return blocks


def thesis_calibration(
    campaign: Campaign,
    kind: EstimationType,
    *,
    regularisation: float | None,
    code_version: str,
    created: str,
) -> Calibration:
    """Fit a sensor by a type of the thesis: one matrix and one offset for all intervals.

    Args:
        campaign: The sensor.
        kind: Estimation type.
        regularisation: Lambda; counts2; None to choose it on held-out blocks, or recordings where there are several.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.

    Returns:
        The calibration.

    Raises:
        FitError: If the data cannot be those of the sensor under the modelled load, or do not determine the fit.
    """
    from forcetorque.inspection.plausibility.gate import examine

    sensor, variables = campaign.sensor, campaign.sensor.variables if kind.with_variables else ()
    sensor.require_six_components(f"estimation type {kind.name}")
    intervals = campaign.samples(Use.CALIBRATION, variables=[variable.linear.name for variable in variables])
    for message in readings_twice(
        (one.recording, len(one.part.samples), one.part.content) for one in intervals
    ).values():
        raise FitError(f"{message}; leave one of the two out")
    data_sets = [interval.data_set for interval in intervals]
    # where the prior is kept there is no matrix to spoil, and a limb at rest tells the offset
    doubts = () if regularisation == math.inf else examine(data_sets, sensor.prior, sensor.full_scale)
    result = calibrate(
        data_sets,
        sensor.prior,
        regularisation=regularisation,
        kind=kind,
        variables=[variable.linear for variable in variables],
        sphere=campaign.sphere_intervals,
    )
    return artefact(
        result,
        intervals,
        sensor=sensor,
        identity=campaign.identity,
        code_version=code_version,
        created=created,
        experiment="; ".join(dict.fromkeys(campaign.experiments)),
        inputs_sha256=campaign.inputs_sha256,
        doubts=[
            *(doubt.message for doubt in doubts),
            *dict.fromkeys(sentence for run in campaign.runs for sentence in reference_doubts(run)),
        ],
        added=campaign.added,
    )


def artefact(
    result: CalibrationFit,
    intervals: Sequence[CampaignInterval],
    *,
    sensor: ExperimentSensor,
    identity: SensorIdentity,
    code_version: str,
    created: str,
    experiment: str,
    inputs_sha256: Mapping[str, str],
    doubts: Sequence[str] = (),
    added: Sequence[str] = (),
) -> Calibration:
    """Make the calibration that a fit leaves on disk.

    Args:
        result: The fit.
        intervals: The fitted intervals.
        sensor: The sensor.
        identity: Which sensor it is.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        experiment: Name of the experiment.
        inputs_sha256: SHA-256 of every input file, by its path.
        doubts: What made the fit doubtful before it was made.
        added: What experiment files add to their logs, in sentences.

    Returns:
        The calibration.
    """
    parts = [interval.part for interval in intervals]
    errors, kept = result.standard_errors, math.isinf(result.fit.regularisation)
    return Calibration(
        sensor=identity,
        matrix=result.fit.matrix,
        offset=result.fit.offset,
        sessions=tuple(
            SessionOffset(
                name=name,
                offset=result.fit.offset,
                standard_error=None if errors is None else errors.offset,
                prior_offset=result.prior_offset,
            )
            for name in dict.fromkeys(interval.session for interval in intervals)
        ),
        variables=_variables(intervals, result),
        estimation_type=result.estimation.kind.name,
        raw_offset_counts=result.estimation.raw_offset,
        matrix_standard_error=None if errors is None or kept else errors.matrix,
        offset_standard_error=None if errors is None else errors.offset,
        residual_rms=result.fit.residual,
        lambda_counts2=result.fit.regularisation,
        prior=None
        if sensor.prior is None or result.prior_offset is None or sensor.prior_source is None
        else Prior(matrix=sensor.prior, offset=result.prior_offset, source=sensor.prior_source),
        validity=validity_of(
            np.min([part.raw.min(axis=0) for part in parts], axis=0),
            np.max([part.raw.max(axis=0) for part in parts], axis=0),
            result.fit.excitation,
            [result.fit.model.linear.wrench(part.raw, part.samples.variables) for part in parts],
        ),
        selection=_selection(result),
        provenance=Provenance(
            code_version=code_version,
            created=created,
            experiment=experiment,
            intervals=tuple(interval.fitted for interval in intervals),
            samples=sum(len(p.samples) for p in parts),
            dropped=sum(p.samples.dropped for p in parts),
            unusable=UnusableCounts.total(p.samples.unusable for p in parts),
            inputs_sha256=dict(inputs_sha256),
            added=tuple(added),
        ),
        warnings=tuple(doubts),
    )


def _variables(intervals: Sequence[CampaignInterval], result: CalibrationFit) -> tuple[CalibratedVariable, ...]:
    values, model = np.concatenate([i.part.samples.variables for i in intervals]), result.fit.model
    errors = None if result.standard_errors is None else result.standard_errors.coefficients.T
    return tuple(
        CalibratedVariable.of(
            variable,
            model.reference_values[k],
            model.coefficients[:, k],
            None if errors is None else errors[k],
            values[:, k],
        )
        for k, variable in enumerate(result.estimation.variables)
    )


def validity_of(
    minimum: FloatArray,
    maximum: FloatArray,
    excitation: Excitation,
    loads: Sequence[FloatArray],
) -> Validity:
    """Tell where data support a fit.

    Args:
        minimum: Smallest fitted reading per channel; shape (c,); counts.
        maximum: Largest fitted reading per channel; shape (c,); counts.
        excitation: How the loads moved the readings.
        loads: Fitted loads by the linear part of the fit, with the offset of their session, per interval; shape (n, 6)
            each; N, N m.

    Returns:
        The same for the artefact.
    """
    return Validity(
        raw_minimum_counts=minimum,
        raw_maximum_counts=maximum,
        expected_wrench_sd=excitation.expected_wrench_sd,
        rank=excitation.rank,
        condition=excitation.condition if math.isfinite(excitation.condition) else None,
        directions=excitation.directions,
        variance_counts2=excitation.variance,
        explained=excitation.explained,
        excited=excitation.excited,
        loads=FittedLoads.of(loads, excitation.expected_wrench_sd),
    )


def _selection(result: CalibrationFit) -> Selection:
    if result.curve is None:
        return Selection(rule="given")
    return Selection(
        rule=f"{RULE}; blocks are {result.held_out}",
        lambda_counts2=tuple(float(v) for v in result.curve.regularisations),
        held_out_rmse=tuple(float(v) for v in result.curve.held_out_error),
        worst_ratio_to_prior=tuple(float(v) for v in result.curve.worst_ratio),
    )
