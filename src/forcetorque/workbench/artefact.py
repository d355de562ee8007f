# SPDX-License-Identifier: BSD-3-Clause
"""From the fit of a bench to the artefact that all other commands take."""

from __future__ import annotations

from forcetorque.calibration.thesis.from_samples import validity_of
from forcetorque.experiment.calibration.artefact import GENERATIVE, Calibration, Prior, SessionOffset
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.provenance import FittedInterval, Provenance, Selection, SensorIdentity
from forcetorque.workbench.bench import Bench
from forcetorque.workbench.fit import SESSION, BenchFit
from forcetorque.workbench.recording import BenchRecording

_RULE = "readings of known loads regressed on them; sizes of prior deviations by evidence"


def bench_calibration(
    recording: BenchRecording, fitted: BenchFit, *, code_version: str, created: str, doubts: tuple[str, ...] = ()
) -> Calibration:
    """Make the artefact of a bench.

    Args:
        recording: What the fit is of.
        fitted: The fit.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        doubts: What makes it doubtful.

    Returns:
        The calibration; its offset holds for readings as they come, after the last bias.
    """
    bench, fit, sensor = fitted.bench, fitted.fit, recording.sensor
    posterior, matrix = fit.posterior, fit.model.matrix
    error = posterior.offset_error(fit.model.offset, SESSION)
    readings = bench.raw + bench.bias
    prior = _prior(recording, bench)
    session = SessionOffset(
        name=SESSION,
        offset=fitted.offset,
        standard_error=error,
        prior_offset=None if prior is None else prior.offset,
    )
    return Calibration(
        sensor=SensorIdentity(
            name=sensor.name,
            serial=sensor.serial,
            robot="workbench",
            frame=sensor.frame,
            measure_direction=sensor.measure_direction,
        ),
        matrix=matrix,
        offset=fitted.offset,
        sessions=(session,),
        estimation_type=GENERATIVE,
        posterior=posterior,
        matrix_standard_error=posterior.matrix_error(matrix),
        offset_standard_error=error,
        residual_rms=fit.residual,
        lambda_counts2=None,
        prior=prior,
        validity=validity_of(
            readings.min(axis=0),
            readings.max(axis=0),
            excitation_of(Moments.of(bench.raw, bench.loads.wrench)),
            [fit.model.wrench(bench.raw)],
        ),
        selection=Selection(rule=_RULE),
        doubts=doubts,
        provenance=_provenance(recording, bench, code_version=code_version, created=created),
    )


def _prior(recording: BenchRecording, bench: Bench) -> Prior | None:
    """The matrix so far, with the offset at which it reads the loads of the bench in the mean; None where none is."""
    if bench.prior is None:
        return None
    offset = (bench.loads.wrench - bench.read_by(bench.prior)).mean(axis=0) - bench.prior @ bench.bias
    return Prior(matrix=bench.prior, offset=offset, source=str(recording.sensor.prior or "given"))


def _provenance(recording: BenchRecording, bench: Bench, *, code_version: str, created: str) -> Provenance:
    return Provenance(
        code_version=code_version,
        created=created,
        experiment=recording.file,
        intervals=(
            FittedInterval(
                label=SESSION,
                start_ns=round(1e9 * bench.instants_s.min()),
                end_ns=round(1e9 * bench.instants_s.max()),
                session=SESSION,
                experiment=recording.file,
            ),
        ),
        samples=len(bench),
        dropped=len(recording.loads) - len(bench),
        inputs_sha256=recording.inputs_sha256,
    )
