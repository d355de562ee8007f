# SPDX-License-Identifier: BSD-3-Clause
"""From samples to the artefact, by an estimation type of the thesis."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.thesis.calibrate import CalibrationFit, calibrate
from forcetorque.calibration.thesis.held_out import RULE
from forcetorque.experiment.calibration.artefact import CalibratedVariable, Calibration, Prior, SessionOffset
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.calibration.excitation import Excitation
from forcetorque.experiment.calibration.provenance import FittedLoads, Provenance, Selection, SensorIdentity, Validity
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.payload.diagnostics import reference_doubts
from forcetorque.recording.recording import Use
from forcetorque.recording.sample_quality import UnusableCounts


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
    from forcetorque.calibration.plausibility.checks import examine

    sensor, variables = campaign.sensor, campaign.sensor.variables if kind.with_variables else ()
    intervals = campaign.samples(Use.CALIBRATION, variables=[variable.linear.name for variable in variables])
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
        doubts=tuple(doubts),
    )


def _variables(intervals: Sequence[CampaignInterval], result: CalibrationFit) -> tuple[CalibratedVariable, ...]:
    values, model = np.concatenate([i.part.samples.variables for i in intervals]), result.fit.model
    return tuple(
        CalibratedVariable(
            name=variable.name,
            unit=variable.unit,
            reference_value=float(model.reference_values[k]),
            coefficients=model.coefficients[:, k],
            standard_error=None if result.standard_errors is None else result.standard_errors.coefficients[:, k],
            prior=variable.prior,
            minimum=float(values[:, k].min()),
            maximum=float(values[:, k].max()),
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
        reference_deviation=excitation.reference_deviation,
        rank=excitation.rank,
        condition=excitation.condition if math.isfinite(excitation.condition) else None,
        directions=excitation.directions,
        variance_counts2=excitation.variance,
        explained=excitation.explained,
        excited=excitation.excited,
        loads=FittedLoads.of(loads, excitation.reference_deviation),
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
