# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate a sensor of an experiment: from its samples to the artefact."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from forcetorque.analysis.samples import IntervalSamples
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.calibration import (
    RULE,
    CalibratedVariable,
    Calibration,
    CalibrationFit,
    EstimationType,
    FittedInterval,
    Prior,
    Provenance,
    Selection,
    SensorIdentity,
    Validity,
    calibrate,
    gate,
)
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Use


def calibrate_sensor(
    run: SensorRun,
    *,
    code_version: str,
    created: str,
    regularisation: float | None = None,
    kind: EstimationType | None = None,
) -> Calibration:
    """Fit a sensor on the calibration intervals of an experiment.

    Args:
        run: The sensor.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        regularisation: Lambda; counts2; None to choose it on held-out blocks.
        kind: Estimation type; None for that of the experiment.

    Returns:
        The calibration, with everything that tells how far to trust it.

    Raises:
        FitError: If the data cannot be those of the sensor under the modelled load, or do not determine the fit.
    """
    experiment, sensor = run.experiment, run.sensor
    if kind is None:
        kind = experiment.fit_options.kind(has_variables=bool(sensor.variables))
    parts = run.samples(Use.CALIBRATION, variables=_variable_names(sensor) if kind.with_variables else ())
    data_sets = [part.data_set for part in parts]
    # where the prior is kept there is no matrix to spoil, and a limb at rest tells the offset
    doubts = () if regularisation == math.inf else gate.examine(data_sets, sensor.prior)
    result = calibrate(
        data_sets,
        sensor.prior,
        regularisation=regularisation,
        kind=kind,
        variables=[variable.linear for variable in sensor.variables] if kind.with_variables else (),
        sphere=experiment.sphere_intervals,
    )
    return artefact(
        result,
        parts,
        sensor=sensor,
        identity=identity_of(experiment, sensor),
        code_version=code_version,
        created=created,
        experiment=experiment.name,
        inputs_sha256=experiment.inputs_sha256,
        doubts=[doubt.message for doubt in doubts],
    )


def artefact(
    result: CalibrationFit,
    parts: Sequence[IntervalSamples],
    *,
    sensor: ExperimentSensor,
    identity: SensorIdentity,
    code_version: str,
    created: str,
    experiment: str,
    inputs_sha256: Mapping[str, str],
    doubts: Sequence[str] = (),
) -> Calibration:
    """Make the calibration that a fit leaves on disk.

    Args:
        result: The fit.
        parts: The fitted samples.
        sensor: The sensor.
        identity: Which sensor it is.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        experiment: Name of the experiment.
        inputs_sha256: SHA-256 of every input file, by its path.
        doubts: What made the fit doubtful before it was made.

    Returns:
        The calibration.
    """
    errors, kept = result.standard_errors, math.isinf(result.fit.regularisation)
    return Calibration(
        sensor=identity,
        matrix=result.fit.matrix,
        offset=result.fit.offset,
        variables=_variables(parts, result),
        estimation_type=result.estimation.kind.name,
        raw_offset_counts=result.estimation.raw_offset,
        matrix_standard_error=None if errors is None or kept else errors.matrix,
        offset_standard_error=None if errors is None else errors.offset,
        residual_rms=result.fit.residual,
        lambda_counts2=result.fit.regularisation,
        prior=None
        if sensor.prior is None or result.prior_offset is None or sensor.prior_source is None
        else Prior(matrix=sensor.prior, offset=result.prior_offset, source=sensor.prior_source),
        validity=_validity(parts, result),
        selection=_selection(result),
        provenance=Provenance(
            code_version=code_version,
            created=created,
            experiment=experiment,
            intervals=tuple(
                FittedInterval(label=p.interval.label, start_ns=p.interval.start_ns, end_ns=p.interval.end_ns)
                for p in parts
            ),
            samples=sum(len(p.samples) for p in parts),
            dropped=sum(p.samples.dropped for p in parts),
            inputs_sha256=dict(inputs_sha256),
        ),
        doubts=tuple(doubts),
    )


def identity_of(experiment: Experiment, sensor: ExperimentSensor) -> SensorIdentity:
    """Tell which sensor it is, where it is mounted and how it reads.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.

    Returns:
        Its identity.
    """
    tag = experiment.model.sensor(sensor.name)
    return SensorIdentity(
        name=sensor.name,
        serial=sensor.serial,
        robot=experiment.model.name,
        frame=tag.frame.value,
        measure_direction=tag.direction,
    )


def _variable_names(sensor: ExperimentSensor) -> list[str]:
    return [variable.linear.name for variable in sensor.variables]


def _variables(parts: Sequence[IntervalSamples], result: CalibrationFit) -> tuple[CalibratedVariable, ...]:
    values, model = np.concatenate([p.samples.variables for p in parts]), result.fit.model
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


def _validity(parts: Sequence[IntervalSamples], result: CalibrationFit) -> Validity:
    raw, excitation = np.concatenate([p.raw for p in parts]), result.fit.excitation
    return Validity(
        raw_minimum_counts=raw.min(axis=0),
        raw_maximum_counts=raw.max(axis=0),
        reference_deviation=excitation.reference_deviation,
        rank=excitation.rank,
        condition=excitation.condition if math.isfinite(excitation.condition) else None,
        directions=excitation.directions,
        variance_counts2=excitation.variance,
        explained=excitation.explained,
        excited=excitation.excited,
    )


def _selection(result: CalibrationFit) -> Selection:
    if result.curve is None:
        return Selection(rule="given")
    return Selection(
        rule=RULE,
        lambda_counts2=tuple(float(v) for v in result.curve.regularisations),
        held_out_rmse=tuple(float(v) for v in result.curve.held_out_error),
        worst_ratio_to_prior=tuple(float(v) for v in result.curve.worst_ratio),
    )
