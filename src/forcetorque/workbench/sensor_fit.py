# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of a workbench: its fit, errors at positions that were left out of the fit, and its calibration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.calibration.generative.agreement import unmoved_directions
from forcetorque.calibration.thesis.calibrate import validity_of
from forcetorque.experiment.calibration.calibration_file import GENERATIVE, Calibration, Prior, SessionOffset
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.experiment.calibration.provenance import FittedInterval, Provenance, Selection, SensorIdentity
from forcetorque.experiment.calibration.sensor_model import component_names
from forcetorque.inspection.plausibility.compared_wrenches import Doubt, Setup
from forcetorque.workbench.bench_recording import BenchRecording
from forcetorque.workbench.matrix_fit import SESSION, BenchFit, fit_bench, fit_means
from forcetorque.workbench.position_means import Bench
from forcetorque.workbench.result import BenchSensorRow, SeriesRow

FOLDS = 5
"""Folds that positions are divided into."""
SHUFFLES = 20
"""Number of random partitions: the error of a single one may be twice the mean."""


def held_out_errors(fitted: BenchFit, folds: Sequence[IntArray]) -> FloatArray:
    """Compute the errors of positions with fits to all others.

    Exact, without fitting again, for prior and noise variances that are estimated from the whole bench: the leverage of
    a position is known, `e = (1 - H)^-1 residual`.

    Args:
        fitted: The fit of all positions.
        folds: Indices of positions that are left out together; every position once.

    Returns:
        Measured less known wrench, of a fit to all other folds; shape (n, 6); N, N m.
    """
    posterior, means = fitted.fit.posterior, fitted.means
    loads = means.reference
    design = np.hstack([loads, np.ones((len(loads), 1))])
    response = _response(fitted)
    errors = np.zeros_like(response)
    for row, noise in enumerate(posterior.noise):
        variance = noise.white**2 * (1.0 + noise.ratio) * np.median(means.count) / means.count
        information = design.T @ (design / variance[:, None])
        if posterior.prior_covariance is not None:
            information[:6, :6] += np.linalg.inv(posterior.prior_covariance[row])
        covariance = np.linalg.pinv(information, hermitian=True)
        residual = response[:, row] - design @ (covariance @ (design.T @ (response[:, row] / variance)))
        for fold in folds:
            leverage = design[fold] @ covariance @ (design[fold] / variance[fold, None]).T
            errors[fold, row] = np.linalg.solve(np.eye(len(fold)) - leverage, residual[fold])
    return errors @ posterior.to_wrench.T


def _response(fitted: BenchFit) -> FloatArray:
    """Data that the rows of the posterior are fitted to, less their prior expectation; shape (n, rows)."""
    prior, means = fitted.bench.prior, fitted.means
    if fitted.fit.posterior.space == "wrench":
        return means.raw @ np.asarray(prior).T - means.reference
    if prior is None:
        return means.raw
    scale = fitted.bench.full_scale
    expected: FloatArray = means.reference @ (scale[:, None] * np.linalg.pinv(prior * scale)).T
    return np.asarray(means.raw - expected, dtype=np.float64)


def one_by_one(fitted: BenchFit) -> FloatArray:
    """Compute the error of every position with a fit to all others.

    Args:
        fitted: The fit of all positions.

    Returns:
        Root mean square errors; shape (6,); N, N m.
    """
    return rms(held_out_errors(fitted, [np.array([k]) for k in range(len(fitted.bench))]))


def in_folds(fitted: BenchFit, rng: np.random.Generator) -> FloatArray:
    """Compute the errors of cross-validation for random partitions of the positions into folds.

    Args:
        fitted: The fit of all positions.
        rng: Source of the partitions.

    Returns:
        Root mean square errors of every partition; shape (`SHUFFLES`, 6); N, N m.
    """
    partitions = (np.array_split(rng.permutation(len(fitted.bench)), FOLDS) for _ in range(SHUFFLES))
    return np.stack([rms(held_out_errors(fitted, folds)) for folds in partitions])


def whole_series(fitted: BenchFit) -> dict[str, FloatArray | str]:
    """Compute the error of every series with a new fit to the others.

    Args:
        fitted: The fit of all positions.

    Returns:
        By name of the series, its errors, shape (k, 6), N, N m; or the reason why the others do not predict it. Empty
        where there is one series.
    """
    series = np.array(fitted.bench.loads.series)
    names = list(dict.fromkeys(fitted.bench.loads.series))
    return {name: _of_series(fitted, series == name) for name in names} if len(names) > 1 else {}


def _of_series(fitted: BenchFit, left_out: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> FloatArray | str:
    means = fitted.means
    kept = {field: getattr(means, field)[~left_out] for field in _BY_POSITION}
    try:
        model = fit_means(fitted.bench, replace(means, **kept)).model
    except FitError as error:
        return str(error)
    return model.wrench(means.raw[left_out]) - means.reference[left_out]


_BY_POSITION = ("time_s", "count", "raw", "reference", "flattening", "variables")


def rms(errors: FloatArray) -> FloatArray:
    """Compute the root mean square.

    Args:
        errors: Errors; shape (n, 6); N, N m.

    Returns:
        Of every component; shape (6,); N, N m.
    """
    return np.sqrt((errors**2).mean(axis=0))


CHECK_PRIOR = "check prior of [sensor]"
"""Where to look if the loads contradict the prior matrix of a sensor with a file of its own."""
_PERMUTED = 0.5
"""Ratio of errors, with forces and moments exchanged over as specified, below which they were exchanged."""
_OFFSET_CHANCE, _OFFSET_TIMES = 1e-3, 2.0
"""Chance, with one offset, of a warning that it changes, and the least ratio of residuals for one."""
_SAMPLES = 10
"""Samples that a position counts for where neighbours are compared."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorFit:
    """A sensor with its fit and the errors of the fit."""

    recording: BenchRecording
    """The recording of the sensor."""
    row: BenchSensorRow
    """Errors and directions, as in the result."""
    bench: Bench
    """Positions whose load and raw sample are known."""
    fitted: BenchFit | None
    """The fit; None where the loads do not determine a matrix."""
    series: tuple[SeriesRow, ...]
    """Series left out as a whole."""
    warnings: tuple[str, ...] = ()
    """Warnings about the data."""

    @property
    def matrix(self) -> FloatArray | None:
        """The matrix; shape (6, c); None where there is none."""
        return None if self.fitted is None else self.fitted.fit.model.matrix


def fit_sensor(
    recording: BenchRecording,
    rng: np.random.Generator,
    *,
    with_series: bool,
    setup: Setup | None = None,
    check_prior: str = CHECK_PRIOR,
) -> SensorFit:
    """Fit a sensor and validate the fit.

    Args:
        recording: The recording of the sensor.
        rng: Source of the partitions into folds.
        with_series: Whether whole series are left out too, which takes a fit for each.
        setup: Limits and messages of the plausibility checks; those of a workbench if None.
        check_prior: Where to look if the loads contradict the prior matrix.

    Returns:
        The fit.

    Raises:
        ExperimentError: If nothing was measured.
    """
    if recording.bench is None:
        raise ExperimentError(f"{recording.file}: expected raw samples at positions, there are none yet")
    bench = recording.bench.usable()
    _require_force_first(bench, recording.file)
    unmoved = unmoved_directions(bench.loads.wrench, [len(bench)], bench.measured)
    count = int(bench.measured.sum())
    fitted, reason = None, ""
    warnings: tuple[str, ...] = ()
    changes = changing_offset(bench) if setup is None else ""
    try:
        doubts = _plausibility_doubts(bench, setup) if len(unmoved) < count else ()
        fitted, contradiction = _fitted(bench, doubts, check_prior)
        warnings = (
            *(doubt.message for doubt in doubts),
            *contradiction,
            *_unknown_disturbances(bench),
            *([changes] if changes else []),
        )
    except FitError as error:
        reason = str(error)
    held_out = None if fitted is None else one_by_one(fitted)
    folds = None if fitted is None else in_folds(fitted, rng)
    excitation = excitation_of(Moments.of(bench.raw, bench.loads.wrench))
    channels = tuple(f"ch{k}" for k in range(bench.raw.shape[1]))
    row = BenchSensorRow(
        file=recording.file,
        sensor=bench.sensor,
        serial=bench.serial,
        positions=len(bench),
        without_load=tuple(_unused_positions(recording.bench)),
        components=tuple(np.array(WRENCH_COMPONENTS)[bench.measured].tolist()),
        rank=count - len(unmoved),
        unmoved=unmoved,
        unexcited_raw=excitation.describe_unexcited(channel_names=channels) if len(channels) > count else "",
        fitted=fitted is not None,
        reason=reason,
        held_out=held_out,
        folds_mean=None if folds is None else folds.mean(axis=0),
        folds_least=None if folds is None else folds.min(axis=0),
        folds_largest=None if folds is None else folds.max(axis=0),
        prior=None if bench.prior is None else rms(bench.wrenches(bench.prior) - bench.loads.wrench) * bench.measured,
        offset_changes=changes,
        scatter="",
    )
    series: tuple[SeriesRow, ...] = ()
    if with_series and fitted is not None and held_out is not None:
        series = _series_rows(fitted, held_out)
    return SensorFit(recording=recording, row=row, bench=bench, fitted=fitted, series=series, warnings=warnings)


def _unknown_disturbances(bench: Bench) -> Iterator[str]:
    """Components that are neither measured nor loaded, to which the response stays unknown."""
    loaded = np.ptp(bench.loads.wrench, axis=0) > 0.0
    if (unknown := ~bench.measured & ~loaded).any():
        yield f"no position loads {component_names(unknown)}: what they add to a measurement is not known"


def changing_offset(bench: Bench) -> str:
    """Find out whether rows without load differ far more than a fit with an offset for each of their series leaves.

    Args:
        bench: Measurements of the loads.

    Returns:
        That they do, in words; empty where they do not, or where it is not determined.
    """
    is_zero = (bench.loads.wrench == 0.0).all(axis=1)
    series = np.cumsum(is_zero)
    if is_zero.sum() < 2 or not is_zero[0]:
        return ""
    own = (series[:, None] == np.unique(series)).astype(float)
    left, freedom = [], []
    for offsets in (np.ones((len(bench), 1)), own):
        design = np.hstack([bench.loads.wrench, offsets])
        coefficients, _, rank, _ = np.linalg.lstsq(design, bench.raw, rcond=None)
        left.append(((bench.raw - design @ coefficients) ** 2).sum(axis=0))
        freedom.append(len(bench) - int(rank))
    if freedom[1] < 1 or freedom[0] == freedom[1]:
        return ""
    from scipy.special import fdtrc  # importing it takes longer than most commands

    noise = left[1] / freedom[1] + np.finfo(float).tiny
    ratio = (left[0] - left[1]) / (freedom[0] - freedom[1]) / noise
    chance = float(fdtrc(freedom[0] - freedom[1], freedom[1], ratio.max())) * len(ratio)
    times = float(np.sqrt(left[0] / freedom[0] / noise).max())
    if chance >= _OFFSET_CHANCE or times <= _OFFSET_TIMES:
        return ""
    return (
        f"the {is_zero.sum()} rows without load do not have one offset: residuals are {times:.2g} times those of a fit "
        "with an offset from each such row on; if the set-up changed there, write series_from_zero = true in "
        "[measurements]"
    )


def _unused_positions(bench: Bench) -> Iterator[str]:
    """Positions that are not used, with the components of the load that are missing where others are there."""
    for name, wrench, raw in zip(bench.loads.names, bench.loads.wrench, bench.raw, strict=True):
        missing = [c for c, known in zip(WRENCH_COMPONENTS, np.isfinite(wrench), strict=True) if not known]
        if 0 < len(missing) < len(WRENCH_COMPONENTS):
            yield f"{name} (no {', '.join(missing)})"
        elif missing or not np.isfinite(raw).all():
            yield name


def _series_rows(fitted: BenchFit, held_out: FloatArray) -> tuple[SeriesRow, ...]:
    measured = fitted.bench.measured
    outcomes = whole_series(fitted)
    errors = [None if isinstance(outcome, str) else rms(outcome) for outcome in outcomes.values()]
    return tuple(
        SeriesRow(
            serial=fitted.bench.serial,
            series=name,
            error=error,
            largest_force_N=None if isinstance(outcome, str) else float(np.linalg.norm(outcome[:, :3], axis=1).max()),
            ratio=float("nan") if error is None else float((error[measured] / held_out[measured]).max()),
            reason=outcome if isinstance(outcome, str) else "",
        )
        for (name, outcome), error in zip(outcomes.items(), errors, strict=True)
    )


_CONTRADICTED = 2.0
"""Error of positions that were left out, over that of least squares without the prior, beyond which that is wrong."""


def _fitted(bench: Bench, doubts: Sequence[Doubt], check_prior: str = CHECK_PRIOR) -> tuple[BenchFit, tuple[str, ...]]:
    """Fit with the prior, and without it where it does not predict positions that were left out.

    Args:
        bench: Positions whose load and raw sample are known.
        doubts: Doubts of the plausibility checks.
        check_prior: Where to look if the loads contradict the prior matrix.

    Returns:
        The fit, and a warning where the prior was left out.

    Raises:
        FitError: If components of the prior have gains that differ, and the loads do not determine a matrix without it.
    """
    fitted = fit_bench(bench)
    if bench.prior is None:
        return fitted, ()
    alone = least_squares_errors(bench)
    if alone is None:
        for doubt in doubts:
            if doubt.kind == "axis":
                raise FitError(f"{doubt.message}; these loads alone do not determine a matrix")
        return fitted, ()
    errors = one_by_one(fitted)
    measured = np.flatnonzero(bench.measured)
    worst = int(measured[(errors[measured] / alone[measured]).argmax()])
    if not errors[worst] > _CONTRADICTED * alone[worst]:
        return fitted, ()
    unit = "N" if worst < 3 else "N m"
    warning = (
        f"the prior matrix contradicts the loads: with it {WRENCH_COMPONENTS[worst]} of a position that is left out is "
        f"off by {errors[worst]:.2g} {unit}, without it by {alone[worst]:.2g} {unit}; it is not used: "
        f"{check_prior}"
    )
    return fit_bench(replace(bench, prior=None)), (warning,)


def least_squares_errors(bench: Bench) -> FloatArray | None:
    """Compute the error of every position with a regression of raw samples on the loads of all others.

    Args:
        bench: Positions whose load and raw sample are known.

    Returns:
        Root mean square errors; shape (6,); N, N m; None where the loads of all others do not determine a matrix.
    """
    wrench = bench.loads.wrench
    scale = np.linalg.norm(wrench, axis=0)
    design = np.hstack([wrench / np.where(scale > 0.0, scale, 1.0), np.ones((len(wrench), 1))])
    left, sizes, right = np.linalg.svd(design, full_matrices=False)
    leverage = (left**2).sum(axis=1)
    if len(sizes) < design.shape[1] or sizes[-1] < _DETERMINED * sizes[0] or leverage.max() > 1.0 - _DETERMINED:
        return None
    solution = right.T @ ((left.T @ bench.raw) / sizes[:, None])
    matrix = np.linalg.pinv(solution[:6].T / scale)
    return rms((bench.raw - design @ solution) / (1.0 - leverage)[:, None] @ matrix.T)


_DETERMINED = 1e-6
"""Least share of the strongest direction of loads, and least part of a position that the others predict."""


def _plausibility_doubts(bench: Bench, setup: Setup | None = None) -> tuple[Doubt, ...]:
    """Doubts of the plausibility checks, which raise an error where measurements are implausible."""
    from forcetorque.inspection.plausibility.compared_wrenches import WORKBENCH
    from forcetorque.inspection.plausibility.gate import examine

    blocks = DataSet(
        label=bench.serial,
        raw=np.repeat(bench.raw, _SAMPLES, axis=0),
        reference=np.repeat(bench.loads.wrench, _SAMPLES, axis=0),
    )
    return examine([blocks], bench.prior, setup=setup or WORKBENCH)


def _require_force_first(bench: Bench, file: str) -> None:
    """Refuse known wrenches whose forces and moments were exchanged, where a prior matrix shows it."""
    if bench.prior is None:
        return
    measured, known = bench.wrenches(bench.prior), bench.loads.wrench
    sizes = np.repeat([max(float(np.abs(measured[:, half]).max()), 1e-12) for half in FORCE_AND_MOMENT], 3)
    as_specified, exchanged = (
        float((((measured - loads) / sizes) ** 2).sum()) for loads in (known, np.roll(known, 3, axis=1))
    )
    if exchanged < _PERMUTED**2 * as_specified:
        raise ExperimentError(
            f"{file}: expected known wrenches as force, then moment, got what the prior matrix measures as moment, "
            "then force; exchange the columns of measurements.known, or of measurements.channels"
        )


_RULE = "readings of known loads regressed on them; sizes of prior deviations by evidence"


def bench_calibration(
    recording: BenchRecording, fitted: BenchFit, *, code_version: str, created: str, warnings: tuple[str, ...] = ()
) -> Calibration:
    """Make the calibration of a sensor on a bench.

    Args:
        recording: The recording that was fitted.
        fitted: The fit.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        warnings: Warnings about the data.

    Returns:
        The calibration; its offset holds for raw samples that include the last bias.
    """
    bench, fit, sensor = fitted.bench, fitted.fit, recording.sensor
    posterior, matrix = fit.posterior, fit.model.matrix
    error = posterior.offset_error(fit.model.offset, SESSION)
    raw = bench.raw + bench.bias
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
            raw.min(axis=0),
            raw.max(axis=0),
            excitation_of(Moments.of(bench.raw, bench.loads.wrench)),
            [fit.model.wrench(bench.raw)],
        ),
        selection=Selection(rule=_RULE),
        warnings=warnings,
        provenance=_provenance(recording, bench, code_version=code_version, created=created),
    )


def _prior(recording: BenchRecording, bench: Bench) -> Prior | None:
    """The prior matrix with the offset of least mean error at the loads of the bench; None without a prior matrix."""
    if bench.prior is None:
        return None
    offset = (bench.loads.wrench - bench.wrenches(bench.prior)).mean(axis=0) - bench.prior @ bench.bias
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
