# SPDX-License-Identifier: BSD-3-Clause
"""The generative fit: a matrix, coefficients and one offset per session, with their covariance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, read_only
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise
from forcetorque.calibration.generative.agreement import (
    ALL_COMPONENTS,
    require_rank,
    require_response,
    require_sensor,
    require_unmirrored,
)
from forcetorque.calibration.generative.design_matrix import Design, cells_of, design_of
from forcetorque.calibration.generative.model import RowData, Sizes, Unknowns, infer, sizes_of_terms
from forcetorque.calibration.generative.whitening import FreeUnknowns, free_unknowns, whiten
from forcetorque.experiment.calibration import expected_sensor_errors as expected
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS, Assumptions, Rows, Scale, rows_of
from forcetorque.experiment.calibration.moments import WindowMeans, in_order, model_terms
from forcetorque.experiment.calibration.posterior import ModelPart, Posterior, RowNoise
from forcetorque.experiment.calibration.quadratic_correction import PAIRS
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, ModelError
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel, measured_components


def gain_and_frame_changes(from_raw: FloatArray, from_load: FloatArray, response: FloatArray) -> FloatArray:
    """Give what gains of channels, and rotation and shift of the frame of a sensor, change in the response to loads.

    Args:
        from_raw: What reads the rows off the raw readings; shape (rows, c).
        from_load: What a load does to the rows; shape (rows, 6).
        response: Response of the readings to loads; shape (c, 6).

    Returns:
        Changes of every row by relative gains, angles about and shifts along the axes; shape (rows, 6, c + 6).
    """
    skew = np.cross(np.eye(3)[:, None], np.eye(3)).transpose(0, 2, 1)
    frame = np.zeros((LOADS, LOADS, LOADS))
    frame[:3, :3, :3] = frame[:3, 3:, 3:] = frame[3:, 3:, :3] = skew
    gains = np.einsum("rk,kd->rdk", from_raw, response)
    return np.concatenate([gains, np.einsum("rc,kcd->rdk", from_load, frame)], axis=2)


@dataclass(frozen=True, slots=True)
class Layout:
    """Unknowns of a row: its own, then those that all rows share where the robot model may be wrong.

    Without terms of the model gain and frame of the reference are deviations of every row by itself.
    """

    own: Mapping[str, int]
    """Numbers of the row's own unknowns by their kind."""
    shared: Mapping[str, int]
    """The same of those that all rows share."""

    @classmethod
    def of(cls, *, variables: int, channels: int, terms: int) -> Self:
        """Lay out the unknowns.

        Args:
            variables: Number of linear variables.
            channels: Number of channels.
            terms: Numbers of the robot model that may be wrong; 0 where it is taken as exact.

        Returns:
            The layout.
        """
        return cls(
            {
                "coefficients": LOADS,
                "reference": 0 if terms else LOADS,
                "variables": variables,
                "quadratic": len(PAIRS[0]),
                "flattening": LOADS,
            },
            dict(
                zip(
                    ("gains", "rotation", "shift", "model"), (channels, 3, 3, terms) if terms else (0,) * 4, strict=True
                )
            ),
        )

    def __getitem__(self, kind: str) -> slice:
        counts = {**self.own, **self.shared}
        start = sum(list(counts.values())[: list(counts).index(kind)])
        return slice(start, start + counts[kind])

    def sizes(
        self, group: IntArray, terms: Sequence[ErrorTerm], assumptions: Assumptions, *, with_prior: bool
    ) -> Sizes:
        """Say which unknowns have one size, and what is expected of it.

        Args:
            group: Rows of one number share the sizes of their own unknowns; shape (rows,).
            terms: Numbers of the robot model that may be wrong.
            assumptions: Whether the accuracy of the prior is stated, and how far the frame of the sensor may be off.
            with_prior: Whether the sensor has a prior matrix.

        Returns:
            The sizes.
        """
        sensor = expected.COEFFICIENTS if terms else expected.SENSOR
        if assumptions.prior_size is not None:
            sensor = expected.STATED
        if not with_prior:  # nothing is known of the sensor: its deviations may be as large as they like
            sensor = Scale(expected=1e3, weight=np.inf)
        quadratic = expected.quadratic_scale(with_prior=with_prior, exact=not terms)
        own = (sensor, expected.FRAME, Scale(expected=1.0, weight=np.inf), quadratic, expected.FLATTENING)
        beside = (expected.GAIN, *expected.mount_scales(assumptions.mount)) if terms else ()
        scales = [*own * (int(group.max()) + 1), *beside]
        of_own = np.repeat(np.arange(len(own)), list(self.own.values()))
        counts = list(self.shared.values())[:-1]
        of_shared = np.repeat(len(scales) - len(counts) + np.arange(len(counts)), counts)
        of_terms, of_kinds = sizes_of_terms(terms, len(scales))
        together = np.concatenate([of_shared, of_terms]).astype(np.int64)
        shared = len(group) * len(of_own) + np.arange(len(together))
        return Sizes.scaled(
            [*scales, *of_kinds],
            np.concatenate([*(of_own + len(own) * number for number in group), together]),
            places=[np.r_[np.arange(len(of_own)) + k * len(of_own), shared] for k in range(len(group))],
            own=len(of_own),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedRows:
    """The rows of a regression with the unknowns that explain them."""

    rows: Rows
    """What was regressed."""
    design: Design
    """On what."""
    basis: Sequence[FloatArray]
    """What the columns of the design are worth in the unknowns of every row before those of terms; shape (a, b)
    each."""
    unknowns: Sequence[Unknowns]
    """Unknowns of every row."""
    layout: Layout
    """Where these stand."""
    expected_rows: FloatArray
    """What variables were expected to add to every row, which was taken off; shape (rows, v)."""
    matrix: FloatArray
    """Matrix about which the rows are written: the prior, or one that reads the data roughly; shape (6, c)."""
    with_prior: bool
    """Whether it is the prior."""
    assumptions: Assumptions
    """Full scales, accuracy of the reference and repeatability."""

    def free(self) -> list[FreeUnknowns]:
        """Give the offsets and drifts of every row, given its unknowns."""
        return free_unknowns(self.design, [unknown.noise for unknown in self.unknowns])

    def solution(
        self, variables: Sequence[LinearVariable], wrench: FloatArray, free: Sequence[FreeUnknowns]
    ) -> tuple[FloatArray, Posterior]:
        """Give the matrix, and what is known of all unknowns.

        Args:
            variables: The linear variables.
            wrench: Wrenches of the means; shape (n, 6); N, N m.
            free: Offsets and drifts of every row.

        Returns:
            The matrix, shape (6, c), and the posterior.

        Raises:
            FitError: If the data say that the sensor has lost a direction, or do not tell all of a matrix without a
                prior.
        """
        rows, unit, sessions = self.rows, self.rows.unit, self.design.sessions
        own = self.layout["model"]
        shared = self.unknowns[0].covariance[own, own]  # by all rows
        of_model = np.asarray(np.linalg.pinv(shared), dtype=np.float64)
        known = [self._row(k, own, of_model) for k, own in enumerate(free)]
        mean = np.stack([row[0] for row in known]) * unit[:, None]
        covariance = np.stack([row[1] for row in known]) * unit[:, None, None] ** 2
        learnt = covariance[:, :LOADS, :LOADS].copy()
        noise = self._noise()
        matrix, to_wrench = self._matrix(mean[:, :LOADS], noise)
        if rows.space == "channel":
            mean[:, :LOADS] += rows.from_load * unit[:, None]
        covariance += self._repeatability(matrix)
        prior = self._before(unit) if self.with_prior else None
        if not self.with_prior:
            response = mean[:, :LOADS] if rows.space == "channel" else np.eye(LOADS) + mean[:, :LOADS]
            measured = measured_components(self.matrix)
            require_response(response / unit[:, None], learnt / unit[:, None, None] ** 2, wrench, measured)
        posterior = Posterior(
            space=rows.space,
            variables=tuple(variable.name for variable in variables),
            sessions=sessions,
            drift=self.design.free.shape[1] > len(sessions),
            mean=mean,
            covariance=covariance,
            mean_covariance=learnt,
            prior_covariance=prior,
            to_wrench=to_wrench,
            noise=noise,
            accuracy=self.assumptions.reference_accuracy(self.matrix),
            repeatability=self.assumptions.repeatability,
            load_centre=self.design.load_centre,
            model=self._model([row[2] * size for row, size in zip(known, unit, strict=True)]),
        )
        return matrix, posterior

    def reading(self) -> FloatArray:
        """Give what the rows read of a load, in their units.

        Returns:
            Coefficients; shape (rows, 6).
        """
        change = [
            basis[:LOADS] @ unknown.coefficients[: basis.shape[1]]
            for basis, unknown in zip(self.basis, self.unknowns, strict=True)
        ]
        return self.rows.from_load + np.stack(change)

    def left(self, free: Sequence[FreeUnknowns], to_wrench: FloatArray) -> FloatArray:
        """Give what all unknowns together leave of the means, which the fit takes as noise.

        Args:
            free: Offsets and drifts of every row.
            to_wrench: Error of a wrench per error of a row; shape (6, rows).

        Returns:
            Root mean square; shape (6,); N, N m.
        """
        design, shared = self.design, self.design.derivatives.shared
        left = np.empty_like(design.response)
        for k, (unknown, basis, own) in enumerate(zip(self.unknowns, self.basis, free, strict=True)):
            by_columns, terms = np.split(unknown.coefficients, basis.shape[1:])
            by_columns = basis @ by_columns
            offsets = own.response - own.columns @ np.concatenate([by_columns, terms])
            # what several cells do not share has its means by session only where one cell has the session
            offsets_of_means = (np.where(design.centred_terms, 0.0, design.model_means[:, k]) @ terms)[design.member]
            local = np.append(terms, 0.0)[design.local_places[design.derivatives.group]]
            left[:, k] = design.response[:, k] - design.columns @ by_columns - design.free @ offsets
            left[:, k] += offsets_of_means - np.einsum("nw,nw->n", design.local[:, k], local)
            for block in design.blocks:
                left[block, k] -= design.model(block)[:, k] @ terms[shared]
        wrench = (left * self.rows.unit) @ to_wrench.T
        return np.sqrt(np.average(wrench**2, axis=0, weights=design.timeline.share))

    def quadratic(self) -> FloatArray:
        """Give what the quadratic terms of the loads add to the rows.

        Returns:
            Coefficients; shape (rows, 21); N, N m or counts.
        """
        terms = np.stack([unknown.coefficients[self.layout["quadratic"]] for unknown in self.unknowns])
        return terms * self.rows.unit[:, None]

    def model_errors(self) -> tuple[ModelError, ...]:
        """Give what was found of the robot model.

        Returns:
            An error per term.
        """
        own, unknown = self.layout["model"], self.unknowns[0]  # rows share them
        values, variances = unknown.coefficients[own], np.diag(unknown.covariance)[own]
        return tuple(
            ModelError(
                name=term.name,
                unit=term.unit,
                value=float(value) * term.deviation,
                standard_error=float(np.sqrt(max(variance, 0.0))) * term.deviation,
                tolerance=term.deviation,
            )
            for term, value, variance in zip(self.design.derivatives.terms, values, variances, strict=True)
        )

    def _noise(self) -> tuple[RowNoise, ...]:
        """Noise of every row, in its unit of readings."""
        return tuple(
            RowNoise(
                white=float(np.sqrt(unknown.variance) * unit),
                time_constant_s=unknown.noise.time_constant_s,
                ratio=unknown.noise.ratio,
            )
            for unknown, unit in zip(self.unknowns, self.rows.unit, strict=True)
        )

    def _row(self, k: int, free: FreeUnknowns, information: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Mean and covariance of [six coefficients, variables, offsets, drifts] of a row, in its unit.

        The offset is that which suits the robot model as it is: what the model is found to be off by in the mean of a
        session stays in it, and widens its covariance.

        Args:
            k: The row.
            free: Its offsets and drifts, given its unknowns.
            information: Inverse covariance of the errors of the model; shape (terms, terms).

        Returns:
            Mean, shape (p,), covariance, shape (p, p), and the change of the mean per tolerance of every error of the
            model, were that known; shape (p, terms).
        """
        unknown, basis, design = self.unknowns[k], self.basis[k], self.design
        (a, b), sessions = basis.shape, len(design.sessions)
        used = LOADS + self.expected_rows.shape[1]
        from_unknowns = np.zeros((used + design.free.shape[1], len(unknown.coefficients)))
        from_unknowns[:used, :b] = basis[:used]
        # the free unknowns are less by what the others explain
        from_unknowns[used:, :b] = -free.columns[:, :a] @ basis
        from_unknowns[used:, b:] = -free.columns[:, a:]
        offsets = slice(used, used + sessions)
        from_unknowns[offsets, :b] -= design.column_means[:, :used] @ basis[:used]
        of_model = design.model_means[:, k]  # (sessions, terms)
        kept_in_offset = of_model @ unknown.coefficients[b:]
        from_unknowns[offsets, b:] -= of_model
        constant = np.zeros(len(from_unknowns))
        constant[LOADS:used] = self.expected_rows[k]
        constant[used:] = free.response
        constant[offsets] += design.response_means[:, k] + kept_in_offset
        by_unknowns = from_unknowns @ unknown.covariance
        covariance = by_unknowns @ from_unknowns.T
        covariance[used:, used:] += unknown.variance * free.covariance
        covariance[offsets, offsets] += np.outer(kept_in_offset, kept_in_offset)
        by_model = by_unknowns[:, self.layout["model"]] @ information
        mean = constant + from_unknowns @ unknown.coefficients
        return mean, 0.5 * (covariance + covariance.T), by_model

    def _model(self, by_model: Sequence[FloatArray]) -> ModelPart | None:
        """What rows owe to errors of the robot model, of which they share what is known; None where it is exact."""
        terms, deviations, own = self.design.derivatives.terms, self.design.derivatives.deviations, self.layout["model"]
        if not terms:
            return None
        return ModelPart.fitted(
            terms,
            self.unknowns[0].covariance[own, own] * np.outer(deviations, deviations),
            np.stack(by_model) / deviations,
        )

    def _matrix(self, change: FloatArray, noise: Sequence[RowNoise]) -> tuple[FloatArray, FloatArray]:
        """The matrix, and what turns errors of rows into errors of wrenches."""
        rows, unit = self.rows, self.rows.unit
        if rows.space == "wrench":
            measured_over_prior = np.eye(LOADS) + change * (unit / unit[:, None])
            require_sensor(measured_over_prior)
            require_unmirrored(measured_over_prior)
            to_wrench = np.asarray(np.linalg.inv(np.eye(LOADS) + change), dtype=np.float64)
            return to_wrench @ self.matrix, to_wrench
        response = rows.from_load * unit[:, None] + change
        if self.with_prior:
            require_unmirrored(self.matrix @ response)
        precision = np.array([1.0 / (one.white**2 * (1.0 + one.ratio)) for one in noise])[:, None]
        measured = measured_components(self.matrix)
        own: FloatArray = response[:, measured]
        weighed: FloatArray = precision * own
        if self.assumptions.load_full_scale is not None:
            # loads in other components disturb the channels as noise does
            disturbed = response[:, ~measured] * self.assumptions.load_full_scale[~measured]
            covariance = np.diag(1.0 / precision[:, 0]) + disturbed @ disturbed.T
            weighed = np.asarray(np.linalg.solve(covariance, own), dtype=np.float64)
        matrix = np.zeros((LOADS, len(response)))
        matrix[measured] = np.linalg.solve(own.T @ weighed, weighed.T)
        return matrix, matrix

    def _before(self, unit: FloatArray) -> FloatArray:
        """Covariance of the six coefficients of every row before any data."""
        prior = []
        for k, unknown in enumerate(self.unknowns):
            root = self.basis[k][:LOADS] * unknown.deviations[: self.basis[k].shape[1]]
            prior.append(unit[k] ** 2 * root @ root.T)
        return np.stack(prior)

    def _repeatability(self, matrix: FloatArray) -> FloatArray:
        """Covariance by motions in which the sensor answers otherwise, about the mean load of each session."""
        rows, design = self.rows, self.design
        sessions, free = len(design.sessions), design.free.shape[1]
        used = LOADS + self.expected_rows.shape[1]
        jacobian = np.zeros((used + free, LOADS))
        jacobian[:LOADS] = np.eye(LOADS)
        jacobian[used : used + sessions] = -design.column_means[:, :LOADS]
        roots = rows_of(matrix, self.assumptions, in_wrench=rows.space == "wrench").sensor_root
        spread = self.assumptions.repeatability * jacobian @ (roots * rows.unit[:, None, None])
        return spread @ spread.transpose(0, 2, 1)


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
    """Root mean square of readings by the model less expected wrenches of the robot model as it is stated; shape (6,);
    N, N m."""
    noise_rms: FloatArray | None
    """Root mean square of what errors of the robot model, cables and quadratic terms leave of that; shape (6,); N, N m;
    None where the robot model was taken as exact."""
    quadratic: FloatArray
    """What the 21 quadratic terms of the loads add to the rows of the posterior; shape (rows, 21); N, N m or counts."""
    load_to_full_scale: FloatArray
    """Shares of full scale that loads make, of which the quadratic terms are, about their mean; shape (6, 6)."""
    means: int
    """Number of means that were fitted."""
    deviance: float
    """Minus twice the logarithm of the evidence, less a constant that depends on the data alone."""
    model_errors: tuple[ModelError, ...] = ()
    """What was found of the robot model."""


def fit_generative(
    stretches: Sequence[WindowMeans],
    prior: FloatArray | None,
    assumptions: Assumptions,
    *,
    variables: Sequence[LinearVariable] = (),
    drift: bool = False,
    quadratic: bool = True,
    shapes: Sequence[SlowNoise] = CANDIDATES,
    noise_floor: bool = True,
    measured: BoolArray = ALL_COMPONENTS,
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
        noise_floor: Whether the noise has at least the slow error of the expected wrench that is assumed; otherwise it
            is what the data show.
        measured: Components that a sensor without a prior matrix measures; shape (6,). With one its rows tell.

    Returns:
        The fit.

    Raises:
        FitError: If there are no data, fewer channels than components, no prior and loads that do not tell all of the
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
    if prior is not None:
        measured = measured_components(prior)
    components = int(measured.sum())
    if raw.shape[1] < components:
        raise FitError(f"expected at least {components} channels, one for each component, got {raw.shape[1]}")
    if prior is None:
        require_rank(wrench, [len(stretch) for stretch in ordered], measured)
    matrix = _rough(raw, wrench, measured) if prior is None else read_only(prior, name="prior", shape=(6, raw.shape[1]))
    rows = rows_of(matrix, assumptions, in_wrench=prior is not None or assumptions.states_accuracy)
    centre = np.array(
        [values[0, k] if v.reference_value is None else v.reference_value for k, v in enumerate(variables)]
    )
    usual = np.column_stack([np.zeros((6, 0)), *(np.zeros(6) if v.prior is None else v.prior for v in variables)])
    # what a variable is expected to do is taken off, so that the prior of what is left is about zero
    expected_rows = -rows.from_load @ usual
    response = raw @ rows.from_raw.T - wrench @ rows.from_load.T - (values - centre) @ expected_rows.T
    shares = wrench @ rows.load_to_full_scale.T if quadratic else np.zeros((len(wrench), LOADS))
    # without a prior matrix nothing separates an error of the model from one of the sensor
    with_terms = ordered if prior is not None else [replace(s, terms=(), model=None) for s in ordered]
    derivatives = model_terms(with_terms, cells_of(ordered))
    terms = derivatives.terms
    layout = Layout.of(variables=len(variables), channels=raw.shape[1], terms=len(terms))
    extents = np.ptp(values, axis=0).tolist()
    of_variables = [
        expected.variable_sizes(one, rows.from_load, extent) for one, extent in zip(variables, extents, strict=True)
    ]
    by_row = np.column_stack([np.zeros((len(rows.unit), 0)), *of_variables])
    to_raw = np.asarray(np.linalg.pinv(matrix), dtype=np.float64)
    changes = gain_and_frame_changes(rows.from_raw, rows.from_load, to_raw)
    basis = [
        _basis(rows, changes[k], k, layout, size=size, variables=by_row[k])
        for k, size in enumerate(rows.prior_sizes(assumptions, 1.0))
    ]

    def solve(
        reading: FloatArray, shapes: Sequence[SlowNoise], start: Sequence[Unknowns] = ()
    ) -> tuple[SolvedRows, float]:
        """Solve the rows, which read errors of the loads by `reading`; shape (rows, 6)."""
        design = design_of(ordered, response, shares, derivatives, reading, drift=drift, centre=centre)
        _require_means(design, drift=drift)
        data = [
            RowData(
                data=whitened,
                basis=own,
                terms=derivatives.shared[acting],
                accuracy=float(accuracy) if noise_floor else 0.0,
                freedom=max(len(raw) - design.free.shape[1], 1),
            )
            for whitened, own, acting, accuracy in zip(
                whiten(design, shapes), basis, design.acting, rows.accuracy, strict=True
            )
        ]
        sizes = layout.sizes(rows.group, terms, assumptions, with_prior=prior is not None)
        best = infer(data, sizes, local=design.local_places.ravel(), sensor=np.arange(LOADS), start=start)
        solved = SolvedRows(
            rows=rows,
            design=design,
            basis=basis,
            unknowns=best.rows(),
            layout=layout,
            expected_rows=expected_rows,
            matrix=matrix,
            with_prior=prior is not None,
            assumptions=assumptions,
        )
        return solved, best.deviance

    solved, deviance = solve(rows.from_load, shapes)
    if terms:
        # the prior matrix reads errors of the loads as it reads the loads: by its own error, which the first fit gives.
        # the second holds the sizes of the first: where a mass scales all loads, evidence would prefer a large error of
        # the mass, of which the matrix so read explains its own error
        noise = list(dict.fromkeys(own.noise for own in solved.unknowns))
        solved, deviance = solve(solved.reading(), noise, solved.unknowns)
    return _fit(solved, raw, wrench, values - centre, variables=variables, centre=centre, deviance=deviance)


def _fit(
    solved: SolvedRows,
    raw: FloatArray,
    wrench: FloatArray,
    moved: FloatArray,
    *,
    variables: Sequence[LinearVariable],
    centre: FloatArray,
    deviance: float,
) -> GenerativeFit:
    """Read the means by what the rows come to; `moved` are the values of the variables about their centre."""
    free = solved.free()
    matrix, posterior = solved.solution(variables, wrench, free)
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
    error = raw @ matrix.T + moved @ model.coefficients.T - model.expected_reading(wrench)
    return GenerativeFit(
        model=model,
        offsets=offsets,
        drifts=drifts,
        session_time_s=design.session_time_s,
        posterior=posterior,
        residual=_residual(design, error, offsets, drifts),
        noise_rms=solved.left(free, to_wrench) if design.derivatives.terms else None,
        quadratic=solved.quadratic(),
        load_to_full_scale=solved.rows.load_to_full_scale,
        means=len(raw),
        deviance=deviance,
        model_errors=solved.model_errors(),
    )


def _residual(design: Design, error: FloatArray, offsets: FloatArray, drifts: FloatArray | None) -> FloatArray:
    """Root mean square of errors without an offset, less offset and drift of each session; shape (6,); N, N m."""
    sessions = len(design.sessions)
    left = error + offsets[design.member]
    if drifts is not None:
        left = left + drifts[design.member] * design.free[:, sessions:].sum(axis=1)[:, None]
    return np.sqrt(np.average(left**2, axis=0, weights=design.timeline.share))


def _rough(raw: FloatArray, wrench: FloatArray, measured: BoolArray) -> FloatArray:
    """A matrix that reads the data roughly, for a sensor that has none."""
    design = np.c_[wrench, np.ones(len(wrench))]
    response = np.linalg.lstsq(design, raw, rcond=None)[0][:LOADS].T
    matrix = np.zeros((LOADS, raw.shape[1]))
    matrix[measured] = np.linalg.pinv(response[:, measured])
    return matrix


def _basis(
    rows: Rows, changes: FloatArray, row: int, layout: Layout, *, size: float, variables: FloatArray
) -> FloatArray:
    """What the columns of the design are worth in the unknowns of a row before those of terms; shape (a, b)."""
    v, pairs = layout.own["variables"], len(PAIRS[0])
    basis = np.zeros((2 * LOADS + v + pairs, layout["model"].start))
    basis[:LOADS, layout["coefficients"]] = size * rows.sensor_root[row]
    column = LOADS
    basis[column : column + v, layout["variables"]] = np.diag(variables)
    column += v
    basis[column : column + pairs, layout["quadratic"]] = np.eye(pairs)
    column += pairs
    basis[column : column + LOADS, layout["flattening"]] = np.diag(rows.from_load[row])
    if not layout.shared["model"]:
        basis[:LOADS, layout["reference"]] = rows.frame_root[row]
        return basis
    basis[:LOADS, layout["gains"].start : layout["shift"].stop] = changes
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
