# SPDX-License-Identifier: BSD-3-Clause
"""The generative fit: a matrix, coefficients and one offset per session, with what is known of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise
from forcetorque.calibration.generative.agreement import require_rank
from forcetorque.calibration.generative.design import Design, design_of, whiten
from forcetorque.calibration.generative.evidence import infer
from forcetorque.calibration.generative.solution import SolvedRows
from forcetorque.experiment.calibration import assumptions as expected
from forcetorque.experiment.calibration.assumptions import LOADS, Assumptions, Rows, Scale, rows_of
from forcetorque.experiment.calibration.linear_variable import LinearVariable
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.quadratic_correction import PAIRS
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.calibration.window_means import WindowMeans, in_order


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GenerativeFit:
    """A fit with everything that is known of its unknowns."""

    model: WrenchModel
    """Matrix, coefficients, the offset of the last session, and quadratic terms where they correct readings."""
    offsets: FloatArray
    """Offset of every session, where every variable has its reference value; shape (sessions, 6); N, N m."""
    drifts: FloatArray | None
    """Drift of every offset; shape (sessions, 6); N/s, N m/s; None where offsets were taken as constant."""
    session_time_s: FloatArray
    """Instants at which the drifting offsets hold, on the clocks of the recordings; shape (sessions,); s."""
    posterior: Posterior
    """Mean and covariance of the unknowns."""
    residual: FloatArray
    """Root mean square residual of the model on the means; shape (6,); N, N m."""
    quadratic: FloatArray
    """What the 21 quadratic terms of the loads add to the rows of the posterior; shape (rows, 21); N, N m or counts."""
    load_to_full_scale: FloatArray
    """Shares of full scale that loads make, of which the quadratic terms are, about their mean; shape (6, 6)."""
    means: int
    """Number of means that were fitted."""


def fit_generative(
    stretches: Sequence[WindowMeans],
    prior: FloatArray | None,
    assumptions: Assumptions,
    *,
    variables: Sequence[LinearVariable] = (),
    drift: bool = False,
    quadratic: bool = True,
    shapes: Sequence[SlowNoise] = CANDIDATES,
) -> GenerativeFit:
    """Fit a sensor: readings are regressed on loads, and where no load speaks the prior stays.

    Args:
        stretches: Means of the calibration intervals of one sensor, of any number of recordings and sessions.
        prior: Matrix of the sensor so far; shape (6, c); None for a sensor without one.
        assumptions: Full scales, accuracy of the reference and repeatability.
        variables: What the columns of `variables` in the means are.
        drift: Whether the offset of a session may move evenly in time.
        quadratic: Whether there are quadratic terms; without them what is quadratic passes for gain.
        shapes: Shapes of the noise to choose from; white noise alone where nothing goes on from mean to mean.

    Returns:
        The fit.

    Raises:
        FitError: If there are no data, fewer than six channels, no prior and loads that do not tell all of the
            matrix, a variable that never moves and of which nothing is known, or the data say that the sensor has lost
            a direction.
        ShapeError: If the data do not fit each other, the prior or the variables.

    References:
        The load as the cause of the reading, with a Gaussian prior on the relative error of the prior matrix, sizes by
        evidence (MacKay, Bayesian interpolation, Neural Computation 4, 1992) and Ornstein-Uhlenbeck noise (Rasmussen,
        Williams, Gaussian processes for machine learning, 2006, appendix B).
    """
    ordered = [stretch.unflattened(expected.FLATTENED) for stretch in in_order(stretches)]
    raw = np.concatenate([stretch.raw for stretch in ordered])
    wrench = np.concatenate([stretch.reference for stretch in ordered])
    values = read_only(
        np.concatenate([s.variables for s in ordered]), name="variables", shape=(len(raw), len(variables))
    )
    if raw.shape[1] < LOADS:
        raise FitError(f"expected at least six channels, which six load directions need, got {raw.shape[1]}")
    if prior is None:
        require_rank(wrench, [len(stretch) for stretch in ordered])
    matrix = _rough(raw, wrench) if prior is None else read_only(prior, name="prior", shape=(6, raw.shape[1]))
    rows = rows_of(matrix, assumptions, in_wrench=prior is not None or assumptions.states_accuracy)
    centre = np.array(
        [values[0, k] if v.reference_value is None else v.reference_value for k, v in enumerate(variables)]
    )
    usual = np.column_stack([np.zeros((6, 0)), *(np.zeros(6) if v.prior is None else v.prior for v in variables)])
    # what a variable is expected to do is taken off, so that the prior of what is left is about zero
    expected_rows = -rows.from_load @ usual
    response = raw @ rows.from_raw.T - wrench @ rows.from_load.T - (values - centre) @ expected_rows.T
    shares = wrench @ rows.load_to_full_scale.T if quadratic else np.zeros((len(wrench), LOADS))
    design = design_of(ordered, response, shares, drift=drift, centre=centre)
    _require_means(design, drift=drift)
    basis = [
        _basis(rows, k, variables=_variable_sizes(variables, values, rows, k), width=design.columns.shape[1])
        for k in range(len(rows.unit))
    ]
    kinds = np.repeat(np.arange(5), [LOADS, LOADS, len(variables), len(PAIRS[0]), LOADS])
    unknowns = infer(
        whiten(design, shapes),
        basis,
        kinds,
        _scales(with_prior=prior is not None),
        group=rows.group,
        accuracy=rows.accuracy,
        freedom=max(len(raw) - design.free.shape[1], 1),
    )
    solved = SolvedRows(
        rows=rows,
        design=design,
        basis=basis,
        unknowns=unknowns,
        expected_rows=expected_rows,
        matrix=matrix,
        with_prior=prior is not None,
        assumptions=assumptions,
    )
    return _fit(solved, raw, wrench, values - centre, variables=variables, centre=centre)


def _fit(
    solved: SolvedRows,
    raw: FloatArray,
    wrench: FloatArray,
    moved: FloatArray,
    *,
    variables: Sequence[LinearVariable],
    centre: FloatArray,
) -> GenerativeFit:
    """Read the means by what the rows come to; `moved` are the values of the variables about their centre."""
    matrix, posterior = solved.solution(variables, wrench)
    design, v, sessions = solved.design, len(variables), len(posterior.sessions)
    mean, to_wrench = posterior.mean, posterior.to_wrench
    offsets = -(to_wrench @ mean[:, LOADS + v : LOADS + v + sessions]).T
    drifts = -(to_wrench @ mean[:, LOADS + v + sessions :]).T if posterior.drift else None
    model = WrenchModel(
        matrix=matrix,
        offset=offsets[-1],
        coefficients=-(to_wrench @ mean[:, LOADS : LOADS + v]),
        reference_values=centre,
    )
    error = raw @ matrix.T + moved @ model.coefficients.T - wrench
    return GenerativeFit(
        model=model,
        offsets=offsets,
        drifts=drifts,
        session_time_s=design.session_time_s,
        posterior=posterior,
        residual=_residual(design, error, offsets, drifts),
        quadratic=solved.quadratic(),
        load_to_full_scale=solved.rows.load_to_full_scale,
        means=len(raw),
    )


def _residual(design: Design, error: FloatArray, offsets: FloatArray, drifts: FloatArray | None) -> FloatArray:
    """Root mean square of errors without an offset, less offset and drift of each session; shape (6,); N, N m."""
    sessions = len(design.sessions)
    member = design.free[:, :sessions].argmax(axis=1)
    left = error + offsets[member]
    if drifts is not None:
        left = left + drifts[member] * design.free[:, sessions:].sum(axis=1)[:, None]
    return np.sqrt(np.average(left**2, axis=0, weights=design.timeline.share))


def _rough(raw: FloatArray, wrench: FloatArray) -> FloatArray:
    """A matrix that reads the data roughly, for a sensor that has none."""
    design = np.c_[wrench, np.ones(len(wrench))]
    response = np.linalg.lstsq(design, raw, rcond=None)[0][:LOADS].T
    return np.linalg.pinv(response)


def _scales(*, with_prior: bool) -> tuple[Scale, ...]:
    # without a prior matrix nothing is known of the sensor: its deviations may be as large as they like
    sensor = expected.SENSOR if with_prior else Scale(expected=1e3, weight=np.inf)
    return sensor, expected.FRAME, Scale(expected=1.0, weight=np.inf), expected.QUADRATIC, expected.FLATTENING


def _variable_sizes(variables: Sequence[LinearVariable], values: FloatArray, rows: Rows, row: int) -> FloatArray:
    """Standard deviation of what a unit of every variable may add to a row; shape (v,)."""
    sizes = np.zeros(len(variables))
    for k, variable in enumerate(variables):
        known = expected.variable_size(variable, rows.from_load[row])
        extent = float(np.ptp(values[:, k]))
        if known is None and extent == 0.0:
            raise FitError(
                f"variable {variable.name!r}: its value is {values[0, k]:g} {variable.unit} throughout the fitted "
                "data, which says nothing of its coefficients; fit data at several values, state prior_deviation, "
                "or leave it out"
            )
        sizes[k] = expected.VARIABLE_SHARE / extent if known is None else known
    return sizes


def _basis(rows: Rows, row: int, *, variables: FloatArray, width: int) -> FloatArray:
    """What the columns of the design are worth in the unknowns of a row; shape (a, q)."""
    v, pairs = len(variables), len(PAIRS[0])
    basis = np.zeros((width, 2 * LOADS + v + pairs + LOADS))
    basis[:LOADS, :LOADS], basis[:LOADS, LOADS : 2 * LOADS] = rows.sensor_root[row], rows.frame_root[row]
    place, column = 2 * LOADS, LOADS
    basis[column : column + v, place : place + v] = np.diag(variables)
    place, column = place + v, column + v
    basis[column : column + pairs, place : place + pairs] = np.eye(pairs)
    place, column = place + pairs, column + pairs
    basis[column:, place:] = np.diag(rows.from_load[row])
    return basis


def _require_means(design: Design, *, drift: bool) -> None:
    if not drift:
        return
    for number, name in enumerate(design.sessions):
        count = int(design.free[:, number].sum())
        if count < 3:
            raise FitError(
                f"session {name!r}: expected at least 3 s of data for an offset and its drift, got {count} s; "
                "take its offset as constant"
            )
