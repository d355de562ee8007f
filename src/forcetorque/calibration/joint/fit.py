# SPDX-License-Identifier: BSD-3-Clause
"""All sensors of a robot in one fit, from equations of link groups without contact, and its prior distribution.

The unknowns, changes of all matrices, offsets and errors of the model, are normal with a prior: the size of a
sensor's changes follows from the data (evidence), tolerances of the model are specified. The noise of every row of
every link group is the residual, found by iteration. Noise of the measurements stands in the coefficients too: its
expected part of the normal equations is taken off, no more of it than the residual can hold (errors in variables).

What coefficients make of wrenches is uneven. A sensor that computes moments from forces by small differences of its
channels reads a moment as a force far more easily than another, and only its prior matrix shows that. Gain, rotation
and displacement of its frame make the rest.

Evidence may lower the size of changes, but not raise it above the expected one: on a real robot the misfit of its
model passes for changes of the matrices, and larger sizes would open directions that the motion does not determine.
Predicted errors are those that the estimate makes if changes are as large as evidence says.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.base.errors import FitError
from forcetorque.calibration.joint.sums import PartSums
from forcetorque.calibration.joint.unknowns import UNITS, JointFit, Places
from forcetorque.experiment.calibration.assumptions import FRAME, FRAME_ROOTS, SENSOR
from forcetorque.experiment.calibration.model_error import ErrorTerm

KINDS: Final = (SENSOR, FRAME)
"""Expected size of both kinds of changes, and what that expectation weighs."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChangeSpread:
    """How the rows of D scatter before any data; in `UNITS`."""

    roots: FloatArray
    """L of both kinds and every row, with L L^T its covariance where its size is 1; shape (2, 6, 6, 6).

    First coefficients that are off by as much as their row is large; then gain, rotation and displacement of the frame.
    """

    @classmethod
    def of(cls, matrix: FloatArray, full_scale: FloatArray) -> Self:
        """Tell it from a prior matrix.

        Args:
            matrix: Prior matrix; shape (6, c); N/count, N m/count.
            full_scale: Full scale of every channel; shape (c,); counts.

        Returns:
            The spread.
        """
        require_shape(full_scale, name="full_scale", shape=(matrix.shape[1],))
        scaled = matrix * full_scale
        response = np.linalg.pinv(scaled) * UNITS
        sizes = np.sqrt((scaled**2).mean(axis=1)) / UNITS
        return cls(
            roots=np.stack(
                [
                    sizes[:, None, None] * np.linalg.cholesky(response.T @ response),
                    FRAME_ROOTS * UNITS / UNITS[:, None, None],
                ]
            )
        )

    def covariance(self, sizes: FloatArray) -> FloatArray:
        """Give the covariance of every row.

        Args:
            sizes: Size of both kinds; shape (2,).

        Returns:
            Covariances; shape (6, 6, 6).
        """
        scaled = sizes[:, None, None, None] * self.roots
        return (scaled @ scaled.transpose(0, 1, 3, 2)).sum(axis=0)


EVEN: Final = ChangeSpread(roots=np.stack([np.stack([np.eye(6)] * 6), np.zeros((6, 6, 6))]))
"""Every coefficient of D scatters alike: for a sensor of which no matrix is known."""


_SMALLEST, _LARGEST = 0.1, 5.0
"""How far the size of changes by evidence may be from the expected one."""
_OFFSET_DEVIATION = 1e3
"""Standard deviation of an offset before any data, in `UNITS`: hardly anything is known of it.

Much more would cost the digits that directions need which only the prior tells, such as a joint's zero from the frame
of the sensor beside it.
"""
_REPEATS = 4.0
"""Residuals of neighbouring windows are alike, so that n windows tell as much as n over this."""
_LEAST_VARIANCE = 1e-4
_NOISE_SHARE = 0.9
"""Largest share of what is left over that noise of the readings may claim: taking off more explodes."""
_ROUNDS = 12


def fit_jointly(
    sums: Sequence[PartSums], terms: Sequence[ErrorTerm] = (), spreads: Mapping[str, ChangeSpread] | None = None
) -> JointFit:
    """Find what is most probable.

    Args:
        sums: Moments of the equations.
        terms: Errors of the model that their coefficients allow for.
        spreads: How the changes of a sensor scatter, by its name; `EVEN` for sensors that are not there.

    Returns:
        The fit.

    Raises:
        FitError: If there are no equations.
    """
    if not sums:
        raise FitError("joint calibration: no window of any part has readings and motion; look for gaps in the log")
    places = Places.of([(sensor, part.session) for part in sums for sensor in part.sensors], terms)
    columns = [places.of_part(part.sensors, part.session, part.terms) for part in sums]
    one = np.zeros(len(places))
    for sensor in places.sensors:
        one[places.changes(sensor)] = np.eye(6).ravel()
    own_spreads = [EVEN if spreads is None else spreads.get(sensor, EVEN) for sensor in places.sensors]
    expected = np.array([kind.expected for kind in KINDS])
    size = np.tile(expected, (len(places.sensors), 1))
    variance = [np.maximum(0.01 * part.square / part.count, _LEAST_VARIANCE) for part in sums]
    solution = _Solution(mean=np.zeros(len(places)), variance=variance)
    for sweep in range(_ROUNDS):
        solution = _solved(_prior_root(places, own_spreads, size), sums, columns, one, solution)
        if 1 < sweep < _ROUNDS - 1:
            size = _sizes(places, own_spreads, solution.mean, solution.covariance, size)
    by_evidence = _prior_root(places, own_spreads, size)
    covariance, held = solution.covariance, np.minimum(size, expected)
    if (held < size).any():
        root = _prior_root(places, own_spreads, held)
        for _ in range(_ROUNDS):
            solution = _solved(root, sums, columns, one, solution)
        covariance = solution.error_covariance(by_evidence)
    residual = tuple(
        (part.part, part.recording, np.sqrt(spread) * UNITS)
        for part, spread in zip(sums, solution.variance, strict=True)
    )
    return JointFit(places=places, mean=solution.mean, covariance=covariance, prior_root=by_evidence, residual=residual)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Solution:
    """Unknowns for one prior and one noise of the parts, and the noise that they leave."""

    mean: FloatArray
    """Most probable values; shape (p,)."""
    variance: Sequence[FloatArray]
    """Mean square of what they leave of every part; shape (6,) each."""
    root: FloatArray = field(default_factory=lambda: np.empty((0, 0)))
    """R of the prior; shape (p, p)."""
    directions: FloatArray = field(default_factory=lambda: np.empty((0, 0)))
    """Directions in which data and prior are independent, in units of R, as columns; shape (p, p)."""
    told: FloatArray = field(default_factory=lambda: np.empty(0))
    """Information of the data along them, that of the prior being 1; shape (p,)."""

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the unknowns, if they scatter as the prior says; shape (p, p)."""
        return self.error_covariance(self.root)

    def error_covariance(self, root: FloatArray) -> FloatArray:
        """Give the covariance of the errors of the mean if the unknowns scatter otherwise than the prior says.

        Args:
            root: R', with R' R'^T the covariance of the unknowns; shape (p, p).

        Returns:
            Covariance of what the prior pulls them by and of what the noise adds; shape (p, p).
        """
        scaled = self.root @ self.directions / (self.told + 1.0)
        pulled = scaled @ (self.directions.T @ np.linalg.solve(self.root, root))
        return pulled @ pulled.T + (scaled * self.told) @ scaled.T


def _solved(
    root: FloatArray, sums: Sequence[PartSums], columns: Sequence[IntArray], one: FloatArray, last: _Solution
) -> _Solution:
    """Solve the equations for a prior, with the noise that the last solution left."""
    products, shared = np.zeros_like(root), np.zeros(len(root))
    for part, own, spread in zip(sums, columns, last.variance, strict=True):
        _add(products, shared, part, own, spread, one[own], last.mean)
    values, directions = np.linalg.eigh(root.T @ products @ root)
    # where noise explains everything the prior stays
    told = np.maximum(values, 0.0)
    mean = root @ (directions @ ((directions.T @ (root.T @ shared)) / (told + 1.0)))
    variance = [np.maximum(part.rest(mean[own]), _LEAST_VARIANCE) for part, own in zip(sums, columns, strict=True)]
    return _Solution(mean=mean, variance=variance, root=root, directions=directions, told=told)


def _add(
    products: FloatArray,
    shared: FloatArray,
    part: PartSums,
    own: IntArray,
    variance: FloatArray,
    one: FloatArray,
    mean: FloatArray,
) -> None:
    """Add the equations of a part, each row by the noise that is left over, less what noise adds."""
    changes, scale = part.noise.shape[1], float(part.common @ mean[own])
    weighed, response = np.zeros((len(own), len(own))), np.zeros(len(own))
    for row in range(6):
        weight = 1.0 / (variance[row] * _REPEATS)
        noise = part.noise[row]
        claimed = one[:changes] @ noise @ one[:changes] / part.count
        share = 1.0 if claimed <= 0.0 else min(1.0, _NOISE_SHARE * variance[row] / claimed)
        left, right = part.products[row].copy(), part.shared[row].copy()
        left[:changes, :changes] -= share * noise
        right[:changes] += share * noise @ one[:changes]  # the same noise stands in coefficients and right side
        # what else is left over grows with all sensors and masses together: a fit would shrink them alike for nothing
        right += max(variance[row] - share * claimed, 0.0) * part.count * (1.0 + scale) * part.common
        weighed += weight * left
        response += weight * right
    products[np.ix_(own, own)] += weighed
    shared[own] += response


def _prior_root(places: Places, spreads: Sequence[ChangeSpread], size: FloatArray) -> FloatArray:
    deviations = np.full(len(places), _OFFSET_DEVIATION)
    deviations[places.errors] = [term.deviation for term in places.terms]
    root = np.diag(deviations)
    for sensor, spread, own in zip(places.sensors, spreads, size, strict=True):
        start = places.changes(sensor).start
        for row, factor in enumerate(np.linalg.cholesky(spread.covariance(own))):
            place = slice(start + 6 * row, start + 6 * (row + 1))
            root[place, place] = factor
    return root


def _sizes(
    places: Places, spreads: Sequence[ChangeSpread], mean: FloatArray, covariance: FloatArray, size: FloatArray
) -> FloatArray:
    """Sizes of both kinds of changes of every sensor, by what the data tell of them; shape (sensors, 2)."""
    determined, square, rows = np.empty_like(size), np.empty_like(size), np.arange(6)
    for number, (sensor, spread) in enumerate(zip(places.sensors, spreads, strict=True)):
        own, before = places.changes(sensor), spread.covariance(size[number])
        narrowed = before - covariance[own, own].reshape(6, 6, 6, 6)[rows, :, rows, :]
        # what of a change is of each kind, in its own size
        shares = size[number, :, None, None, None] * np.linalg.solve(before, spread.roots).transpose(0, 1, 3, 2)
        determined[number] = np.einsum("crij,rjk,crik->c", shares, narrowed, shares)
        square[number] = size[number] ** 2 * ((shares @ mean[own].reshape(6, 6, 1)) ** 2).sum(axis=(1, 2, 3))
    # every sensor has its own size of the first kind; frames of one robot are off alike
    determined[:, 1], square[:, 1] = determined[:, 1].sum(), square[:, 1].sum()
    expected, weight = (np.array([getattr(kind, name) for kind in KINDS]) for name in ("expected", "weight"))
    sizes = np.sqrt((square + weight * expected**2) / (np.maximum(determined, 0.0) + weight))
    return np.clip(sizes, _SMALLEST * expected, _LARGEST * expected)
