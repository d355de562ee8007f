# SPDX-License-Identifier: BSD-3-Clause
"""What is known of a sensor before any recording, and the information that a recording to come would add."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.noise.slow_noise import SlowNoise, Timeline
from forcetorque.experiment.calibration import expected_sensor_errors as expected
from forcetorque.experiment.calibration.expected_sensor_errors import (
    LOADS,
    QUADRATIC_ALONE,
    Assumptions,
    Scale,
    rows_of,
)
from forcetorque.experiment.calibration.posterior import ModelPart, Posterior, RowNoise
from forcetorque.experiment.calibration.quadratic_correction import PAIRS, quadratic_terms
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm
from forcetorque.experiment.calibration.sensor_model import LinearVariable

ASSUMED_NOISE: Final = 1e-4
"""White noise of a mean over a second that is assumed where none was measured, as a share of full scale."""
ASSUMED_DRIFT: Final = 5e-4
"""Size of the slow offset that is assumed with it, or the accuracy of the reference where that is larger."""
ASSUMED_TIME_S: Final = 15.0
"""How long that offset is assumed to last; s."""

UNKNOWN: Final = 1e5
"""Standard deviation of what an unknown coefficient makes of the loads to come, over the noise of a reading."""


def unfitted_posterior(
    matrix: FloatArray, assumptions: Assumptions, variables: Sequence[LinearVariable] = ()
) -> Posterior:
    """Compute the prior distribution of the generative model.

    Args:
        matrix: Prior matrix; shape (6, c); N/count, N m/count.
        assumptions: What is known beside it.
        variables: Linear variables that will be fitted.

    Returns:
        Prior covariance and assumed noise; its only session has an offset that is known.

    Raises:
        FitError: If nothing tells what a variable may do.
    """
    rows = rows_of(matrix, assumptions, in_wrench=True)
    unit = rows.unit
    sizes = rows.prior_sizes(assumptions, expected.SENSOR.expected)[:, None, None]
    roots = np.concatenate([sizes * rows.sensor_root, expected.FRAME.expected * rows.frame_root], axis=2)
    prior = unit[:, None, None] ** 2 * roots @ roots.transpose(0, 2, 1)
    size = LOADS + len(variables) + 1
    covariance = np.zeros((len(unit), size, size))
    covariance[:, :LOADS, :LOADS] = prior + assumptions.repeatability**2 * _spread(rows.sensor_root, unit)
    for k, variable in enumerate(variables):
        own = expected.variable_sizes(variable, rows.from_load, 0.0)
        covariance[:, LOADS + k, LOADS + k] = (unit * own) ** 2
    drift = np.maximum(ASSUMED_DRIFT, rows.accuracy)
    in_wrench = rows.space == "wrench"
    return Posterior(
        space=rows.space,
        variables=tuple(variable.name for variable in variables),
        sessions=("none",),
        drift=False,
        mean=np.zeros((len(unit), size)),
        covariance=covariance,
        mean_covariance=prior,
        prior_covariance=prior,
        to_wrench=np.eye(LOADS) if in_wrench else matrix,
        noise=tuple(
            RowNoise(
                white=ASSUMED_NOISE * float(one),
                time_constant_s=ASSUMED_TIME_S,
                ratio=float((slow / ASSUMED_NOISE) ** 2),
            )
            for one, slow in zip(unit, drift, strict=True)
        ),
        accuracy=assumptions.reference_accuracy(matrix),
        repeatability=assumptions.repeatability,
        load_centre=np.zeros(6),
    )


def blank_posterior(noise: FloatArray, load: FloatArray) -> Posterior:
    """Make the posterior of a sensor of which nothing is known, not even a prior matrix.

    Args:
        noise: White noise of a reading, as wrench; shape (6,); N, N m.
        load: Sizes of the loads to come, by which coefficients are said to be unknown; shape (6,); N, N m.

    Returns:
        The posterior, whose rows are components of the wrench.
    """
    size = LOADS + 1
    covariance = np.zeros((LOADS, size, size))
    unknown = (UNKNOWN * noise[:, None] / load) ** 2
    covariance[:, range(LOADS), range(LOADS)] = unknown
    covariance[:, LOADS, LOADS] = (UNKNOWN * noise) ** 2
    return Posterior(
        space="wrench",
        variables=(),
        sessions=("none",),
        drift=False,
        mean=np.zeros((LOADS, size)),
        covariance=covariance,
        mean_covariance=covariance[:, :LOADS, :LOADS].copy(),
        prior_covariance=None,
        to_wrench=np.eye(LOADS),
        noise=tuple(RowNoise(white=float(one), time_constant_s=0.0, ratio=0.0) for one in noise),
        accuracy=np.zeros(LOADS),
        repeatability=0.0,
        load_centre=np.zeros(LOADS),
    )


def _spread(roots: FloatArray, unit: FloatArray) -> FloatArray:
    scaled = roots * unit[:, None, None]
    return scaled @ scaled.transpose(0, 2, 1)


_SESSION = "planned"
_LEAST_NOISE = 1e-9
"""Least white noise, in the unit of the row: a posterior without noise would be taught anything by one posture."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlannedLoads(ArrayRecord):
    """Loads of a recording to come, as means over a second; one power cycle."""

    time_s: FloatArray = field(metadata=array("n"))
    """Instants; shape (n,); s."""
    wrench: FloatArray = field(metadata=array("n", 6))
    """Loads; shape (n, 6); N, N m."""
    variables: FloatArray = field(metadata=array("n", None))
    """Linear variables of the posterior, less their reference values; shape (n, v)."""
    terms: tuple[ErrorTerm, ...] = ()
    """Errors of the robot model that the loads depend on; those of the recording alone have a name of their own."""
    model: FloatArray | None = field(default=None, metadata=array("n", 6, None))
    """Derivatives of the loads by these; shape (n, 6, terms); N, N m per unit of the term; None without terms."""

    @property
    def columns(self) -> FloatArray:
        """What the unknowns of a row are multiplied by, without the offset; shape (n, 6 + v)."""
        return np.hstack([self.wrench, self.variables])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Nuisance:
    """Quadratic terms, which a fit has to separate from the matrix."""

    load_to_full_scale: FloatArray
    """Share of full scale that a load makes of six independent readings; shape (6, 6)."""
    deviation: FloatArray
    """What each of the 21 products of these may add to a row, as a standard deviation; shape (rows,)."""

    @classmethod
    def of(
        cls, matrix: FloatArray, assumptions: Assumptions, *, with_prior: bool, size: Scale = QUADRATIC_ALONE
    ) -> Nuisance:
        """Take what the generative model takes for granted.

        Args:
            matrix: Matrix of the sensor; shape (6, c).
            assumptions: What is known beside it.
            with_prior: Whether the rows of the posterior are components of the wrench.
            size: Expected size of the terms, of full scale.

        Returns:
            The terms.
        """
        rows = rows_of(matrix, assumptions, in_wrench=with_prior)
        return cls(load_to_full_scale=rows.load_to_full_scale, deviation=size.expected * rows.unit)

    def columns(self, wrench: FloatArray, centre: FloatArray) -> FloatArray:
        """Compute the products.

        Args:
            wrench: Loads; shape (n, 6); N, N m.
            centre: Load about which they are taken; shape (6,).

        Returns:
            Products; shape (n, 21).
        """
        return quadratic_terms((wrench - centre) @ self.load_to_full_scale.T)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Knowledge:
    """What is known of a sensor, to which recordings can be added.

    Errors of the robot model are common to all rows, and to recordings of the same robot. Given these errors, the
    unknowns of a row are independent of those of the other rows.
    """

    posterior: Posterior
    """Matrix, variables, and the offset of the last recording."""
    together: FloatArray
    """Covariance of matrix, variables and quadratic terms without the repeatability, given the errors of the robot
    model; shape (rows, q, q)."""
    model: ModelPart
    """Errors of the robot model, and what these unknowns owe to them."""
    recordings: int
    """Number of planned recordings so far."""
    seconds: float
    """How much was fitted so far, which the mean load is of; s."""
    nuisance: Nuisance | None
    """Quadratic terms; None for a sensor that is known to have none."""
    centre: FloatArray | None
    """Load about which they are taken; shape (6,); N, N m; None for the mean of the first recording."""

    @classmethod
    def of(cls, posterior: Posterior, *, seconds: float = 0.0, nuisance: Nuisance | None = None) -> Knowledge:
        """Begin with a posterior; of its quadratic terms, which it does not keep, nothing is known.

        Args:
            posterior: What is known of the sensor.
            seconds: How much was fitted so far; s.
            nuisance: Quadratic terms; None for a sensor that is known to have none.

        Returns:
            What is known.
        """
        used, terms = 6 + len(posterior.variables), 0 if nuisance is None else len(PAIRS[0])
        together = np.zeros((len(posterior.mean), used + terms, used + terms))
        together[:, :used, :used] = posterior.covariance[:, :used, :used]
        together[:, :6, :6] = posterior.mean_covariance
        model = ModelPart.exact(*together.shape[:2])
        if posterior.model is not None:
            response = np.zeros((*together.shape[:2], len(posterior.model.terms)))
            response[:, :used] = posterior.model.response[:, :used]
            model = posterior.model.model_copy(update={"response": response})
            together -= model.covariance
        if nuisance is not None:
            together[:, used:, used:] = nuisance.deviation[:, None, None] ** 2 * np.eye(terms)
        return cls(
            posterior=posterior,
            together=together,
            model=model,
            recordings=0,
            seconds=seconds,
            nuisance=nuisance,
            centre=None,
        )

    @property
    def next_recording(self) -> str:
        """Name of the recording to come, which has errors of acceleration and delay of its own."""
        return f"planned recording {self.recordings + 1}"

    def updated(self, loads: PlannedLoads) -> Knowledge:
        """Add a recording.

        Args:
            loads: Loads of the recording.

        Returns:
            Knowledge after the recording; its offset is that of the recording.
        """
        posterior, used = self.posterior, 6 + len(self.posterior.variables)
        centre = loads.wrench.mean(axis=0) if self.centre is None else self.centre
        line, columns = Timeline.of(loads.time_s), loads.columns
        if self.nuisance is not None:
            columns = np.hstack([columns, self.nuisance.columns(loads.wrench, centre)])
        model = self.model.with_terms(loads.terms)
        by_model = self._model_columns(loads, model)
        q, terms = columns.shape[1], len(model.terms)
        repeated = posterior.covariance[:, :6, :6] - posterior.mean_covariance
        together, response = np.empty_like(self.together), np.empty_like(model.response)
        covariance = np.zeros((len(together), used + 1, used + 1))
        kept = np.zeros((len(together), used + 1, terms))
        term_information = np.zeros((terms, terms))
        moved = np.zeros((used + 1, 6))
        moved[:6], moved[used] = np.eye(6), -columns[:, :6].mean(axis=0)
        products: dict[tuple[SlowNoise, int], tuple[FloatArray, FloatArray, FloatArray, float]] = {}
        for k, noise in enumerate(posterior.noise):
            # rows have the same columns where the robot model is exact
            key = _shape(noise), k if terms else 0
            if key not in products:
                products[key] = _product(line, np.hstack([columns, by_model[k]]), key[0])
            information, mean, weighed, worth = products[key]
            variance = max(noise.white, _LEAST_NOISE) ** 2
            information = information / variance
            before, own, mixed = model.response[k], information[:q, :q], information[:q, q:]
            together[k] = _narrowed(self.together[k], own)
            # of the errors themselves, whose change moves the unknowns too
            along = own @ before + mixed
            response[k] = before - together[k] @ along
            term_information += (
                information[q:, q:] + before.T @ along + mixed.T @ before - along.T @ together[k] @ along
            )
            # from the unknowns to those that are kept and the offset
            to_offset = -(mean + weighed)
            turned = np.vstack([np.eye(used, q), to_offset[:q]])
            kept[k] = turned @ response[k]
            kept[k, used] += to_offset[q:]
            covariance[k] = turned @ together[k] @ turned.T + moved @ repeated[k] @ moved.T
            covariance[k, used, used] += variance / worth
        term_covariance = _narrowed(model.term_covariance, term_information)
        model = ModelPart(terms=model.terms, term_covariance=term_covariance, response=response)
        of_posterior = ModelPart(terms=model.terms, term_covariance=term_covariance, response=kept)
        seconds = self.seconds + len(line)
        update = {
            "sessions": (_SESSION,),
            "drift": False,
            "mean": np.zeros((len(together), used + 1)),
            "covariance": covariance + of_posterior.covariance,
            "mean_covariance": (together + model.covariance)[:, :6, :6],
            "model": of_posterior if terms else None,
            "load_centre": (self.seconds * posterior.load_centre - len(line) * moved[used]) / seconds,
        }
        return Knowledge(
            posterior=posterior.model_copy(update=update),
            together=together,
            model=model,
            recordings=self.recordings + 1,
            seconds=seconds,
            nuisance=self.nuisance,
            centre=centre,
        )

    def _model_columns(self, loads: PlannedLoads, model: ModelPart) -> FloatArray:
        """What a unit of every error of the model adds to the rows; shape (rows, n, terms)."""
        columns = np.zeros((len(self.together), len(loads.time_s), len(model.terms)))
        if loads.model is not None:
            columns[:, :, model.places(loads.terms)] = rows_by_model(self.posterior, loads.model)
        return columns


def rows_by_model(posterior: Posterior, derivatives: FloatArray) -> FloatArray:
    """Give what errors of the robot model add to the rows of a posterior.

    Args:
        posterior: The posterior.
        derivatives: Derivatives of loads; shape (n, 6, terms); N, N m per unit of the term.

    Returns:
        Derivatives of the rows; shape (rows, n, terms).
    """
    return np.einsum("kc,nct->knt", np.linalg.pinv(posterior.to_wrench), derivatives)


def _shape(noise: RowNoise) -> SlowNoise:
    return SlowNoise(time_constant_s=noise.time_constant_s, ratio=noise.ratio)


def _product(line: Timeline, columns: FloatArray, noise: SlowNoise) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Information of columns beside an offset, their mean, that as weighed less it, and information of the offset."""
    centre = columns.mean(axis=0)
    columns = columns - centre
    size = np.abs(columns).max(axis=0, initial=0.0)
    size[size == 0.0] = 1.0
    product, _ = line.product(np.asfortranarray(np.column_stack([columns / size, np.ones(len(line))])), noise)
    worth = float(product[-1, -1])
    mean = product[-1, :-1] / worth
    information = product[:-1, :-1] - worth * np.outer(mean, mean)
    return information * np.outer(size, size), centre, mean * size, worth


def _narrowed(covariance: FloatArray, information: FloatArray) -> FloatArray:
    """`(covariance^-1 + information)^-1`, also where the covariance has no inverse."""
    size = np.sqrt(np.maximum(np.diag(covariance), np.finfo(float).tiny))
    values, vectors = np.linalg.eigh(covariance / np.outer(size, size))
    root = size[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
    inner = np.eye(len(root)) + root.T @ information @ root
    narrowed: FloatArray = root @ np.linalg.solve(inner, root.T)
    return 0.5 * (narrowed + narrowed.T)
