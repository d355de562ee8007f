# SPDX-License-Identifier: BSD-3-Clause
"""Directions that the fitted loads excite, and how far measurements lie outside of them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.moments import Moments

HARDLY = 0.05
"""Share of the load below which it hardly moved."""


def hardly_moved(moved: float, load: float) -> bool:
    """Check whether a load moved too little to show a wrong matrix.

    Args:
        moved: Standard deviation of the load.
        load: Size of loads, in the same unit.

    Returns:
        Whether it did.
    """
    return moved <= HARDLY * load


EXPLAINED_SHARE = 0.5
"""A direction is excited if the reference explains at least this share of its variance."""

_RANK_TOLERANCE = 1e-12
"""Eigenvalues below this part of the largest are rounding of double precision moments."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Excitation(ArrayRecord):
    """Eigenvectors of the raw second moment, strongest first, and how far loads explain them."""

    variance: FloatArray = field(metadata=array("c"))
    """Variance of the raw readings along each direction; shape (c,); counts2."""
    directions: FloatArray = field(metadata=array("c", "c"))
    """Unit directions in the space of raw channels, one per row; shape (c, c)."""
    explained: FloatArray = field(metadata=array("c"))
    """Share of each variance that the reference wrench explains, 0 to 1; shape (c,)."""
    expected_wrench_sd: FloatArray = field(metadata=array(6))
    """Standard deviation of the reference wrench per component; shape (6,); N, N m."""

    @property
    def rank(self) -> int:
        """Number of directions whose variance is not zero to rounding."""
        return int(np.count_nonzero(self.variance > _RANK_TOLERANCE * self.variance[0]))

    @property
    def condition(self) -> float:
        """Ratio of the largest to the smallest standard deviation over the directions."""
        smallest = float(self.variance[-1])
        return float(np.sqrt(self.variance[0] / smallest)) if smallest > 0.0 else float("inf")

    @property
    def excited(self) -> tuple[bool, ...]:
        """Whether the loads move each direction more than anything else does."""
        nonzero = self.variance > _RANK_TOLERANCE * self.variance[0]
        return tuple(bool(n and e >= EXPLAINED_SHARE) for n, e in zip(nonzero, self.explained, strict=True))

    def describe_unexcited(self, *, channel_names: tuple[str, ...]) -> str:
        """Name the directions that are not excited.

        Args:
            channel_names: Names of the raw channels.

        Returns:
            Text such as `0.92 ch3 - 0.39 ch5 (12 counts, 8 % explained)`; empty if all are excited.
        """
        texts = []
        for ok, direction, variance, explained in zip(
            self.excited, self.directions, self.variance, self.explained, strict=True
        ):
            if not ok:
                texts.append(
                    f"{_combination(direction, channel_names)} "
                    f"({np.sqrt(max(variance, 0.0)):.3g} counts, {100 * explained:.0f} % explained)"
                )
        return "; ".join(texts)

    def unmoved_components(self) -> tuple[str, ...]:
        """Name the components of the reference wrench that hardly change over the data set.

        Returns:
            Components whose standard deviation is below 1 % of the largest of their kind (force or moment).
        """
        forces, moments = self.expected_wrench_sd[:3], self.expected_wrench_sd[3:]
        limits = np.repeat([0.01 * forces.max(), 0.01 * moments.max()], 3)
        low = self.expected_wrench_sd <= limits
        return tuple(name for name, is_low in zip(WRENCH_COMPONENTS, low, strict=True) if is_low)


def _combination(direction: FloatArray, names: tuple[str, ...]) -> str:
    """Write a direction as a sum of the channels that make up most of it."""
    order = [int(k) for k in np.argsort(-np.abs(direction)) if abs(direction[k]) >= 0.2 * np.abs(direction).max()]
    lead = np.sign(direction[order[0]])
    terms = [f"{'- ' if lead * direction[k] < 0 else '+ '}{abs(direction[k]):.2f} {names[k]}" for k in order]
    return " ".join(terms).removeprefix("+ ")


def excitation_of(moments: Moments) -> Excitation:
    """Split the raw second moment in directions, and each in load and disturbance.

    Args:
        moments: Moments of a data set.

    Returns:
        The excitation of its directions, strongest first.
    """
    eigenvalues, vectors = np.linalg.eigh(moments.raw_raw)
    variance = np.maximum(eigenvalues[::-1], 0.0)
    directions = vectors.T[::-1]
    # pseudo-inverse: components of the reference that never change explain nothing
    explained_matrix = (
        moments.reference_raw.T
        @ np.linalg.pinv(moments.reference_reference, rcond=_RANK_TOLERANCE, hermitian=True)
        @ moments.reference_raw
    )
    load = np.einsum("ij,jk,ik->i", directions, explained_matrix, directions)
    share = np.divide(load, variance, out=np.zeros_like(load), where=variance > 0.0)
    # six regressors explain part of any few samples: the share is adjusted for them, as adjusted R2 is
    free = moments.count - 1 - int(np.linalg.matrix_rank(moments.reference_reference, hermitian=True))
    share = 1.0 - (1.0 - share) * (moments.count - 1) / free if free > 0 else np.zeros_like(share)
    return Excitation(
        variance=variance,
        directions=directions,
        explained=np.clip(share, 0.0, 1.0),
        # a component that stands still far from zero may be rounded below it
        expected_wrench_sd=np.sqrt(np.maximum(np.diag(moments.reference_reference), 0.0)),
    )


MARGIN = 0.1
"""Share of a fitted range by which it may be left before that is worth a word."""

_NOISE_DEVIATIONS = 4.0
"""Standard deviations of what the fit left unexplained: along a direction that no load moved the range is of noise."""

_MOST_PREDICTED = 20_000
"""Readings of which the predicted error is computed; evenly picked from more, whose mean square they give."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Extrapolation:
    """How far n readings lie outside what was fitted."""

    load: FloatArray
    """Loads by the linear part of the calibration; shape (n, 6); N, N m; NaN in gaps."""
    beyond: FloatArray
    """What of them lies beyond the fitted range; shape (n, 6); N, N m; 0 of readings inside."""
    variables: FloatArray
    """Variables; shape (n, v)."""
    variables_outside: BoolArray
    """Which of them lie outside their fitted range; shape (n, v)."""
    at_limit: BoolArray
    """Whether quadratic terms are taken as at the limit of the loads that they were fitted to; shape (n,). They have no
    margin, so by itself that is not outside."""

    @property
    def known(self) -> BoolArray:
        """Whether a reading has no gap; shape (n,)."""
        return np.asarray(np.isfinite(self.load).all(axis=1))

    @property
    def outside(self) -> BoolArray:
        """Whether reading or variable lies outside what was fitted; shape (n,)."""
        return np.asarray(self.beyond.any(axis=1) | self.variables_outside.any(axis=1))


def extrapolation(
    calibration: Calibration, raw: Any, variables: Any = None, *, offset: FloatArray | None = None
) -> Extrapolation:
    """Tell how far readings lie outside what a calibration was fitted on.

    Args:
        calibration: The calibration.
        raw: Raw readings; shape (n, c); counts; NaN in gaps.
        variables: Values of its variables in their order; shape (n, v); None where it has none.
        offset: Offset of the readings' session; shape (6,); N, N m; that of the calibration if None.

    Returns:
        The readings' loads, and what of them lies beyond.
    """
    counts, model = np.asarray(raw, dtype=np.float64), calibration.model
    values = np.empty((len(counts), 0)) if variables is None else np.asarray(variables, dtype=np.float64)
    model = model if offset is None else replace(model, offset=offset)
    load = model.linear.wrench(counts, values)
    box = _box(calibration)
    # channels keep what no load does to more than six of them, as their ranges do
    along = (counts + (load - counts @ model.matrix.T) @ box.to_along.T) if box.of_channels else load @ box.to_along.T
    noise = np.sqrt(box.to_along**2 @ calibration.residual_rms**2)
    margin = np.maximum(MARGIN * (box.high - box.low), _NOISE_DEVIATIONS * noise)
    left = (along < box.low - margin) | (along > box.high + margin)
    beyond = np.where(left, along - np.clip(along, box.low, box.high), 0.0) @ box.to_load.T
    quadratic, shape = calibration.quadratic, load.shape[:1]
    return Extrapolation(
        load=load,
        beyond=beyond,
        variables=values,
        variables_outside=_variables_outside(calibration, values),
        at_limit=np.zeros(shape, dtype=np.bool_) if quadratic is None else quadratic.beyond(quadratic.corrected(load)),
    )


def predicted_error(calibration: Calibration, load: FloatArray, variables: FloatArray) -> tuple[float, float] | None:
    """Predict the error under loads, as changes from the mean fitted load, at which the offset is known.

    Args:
        calibration: The calibration.
        load: Loads, at least one; shape (n, 6); N, N m.
        variables: Variables beside them; shape (n, v).

    Returns:
        Root mean square errors of force, N, and moment, N m; None for a calibration without a posterior.
    """
    posterior = calibration.posterior
    if posterior is None:
        return None
    step = -(-len(load) // _MOST_PREDICTED)
    change = load[::step] - posterior.load_centre
    warmer = variables[::step] - calibration.model.reference_values if posterior.variables else None
    variance = np.einsum("nii->ni", posterior.error_covariance(change, variables=warmer)).mean(axis=0)
    return float(np.sqrt(variance[:3].sum())), float(np.sqrt(variance[3:].sum()))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Box:
    """What was fitted, along some directions."""

    to_along: FloatArray
    """From loads to what they are along each direction; shape (k, 6)."""
    to_load: FloatArray
    """And back; shape (6, k)."""
    low: FloatArray
    """Smallest fitted along each; shape (k,)."""
    high: FloatArray
    """Largest; shape (k,)."""
    of_channels: bool
    """Whether the directions are channels."""


def _box(calibration: Calibration) -> _Box:
    validity, loads = calibration.validity, calibration.validity.loads
    if loads is not None:
        back = np.asarray(np.linalg.inv(loads.directions), dtype=np.float64)
        low, high = loads.direction_minimum, loads.direction_maximum
        return _Box(to_along=loads.directions, to_load=back, low=low, high=high, of_channels=False)
    to_counts = np.asarray(np.linalg.pinv(calibration.matrix), dtype=np.float64)
    low, high = (
        counts + to_counts @ calibration.offset for counts in (validity.raw_minimum_counts, validity.raw_maximum_counts)
    )
    return _Box(to_along=to_counts, to_load=calibration.matrix, low=low, high=high, of_channels=True)


def _variables_outside(calibration: Calibration, values: FloatArray) -> BoolArray:
    low = np.array([variable.minimum for variable in calibration.variables])
    high = np.array([variable.maximum for variable in calibration.variables])
    margin = MARGIN * (high - low)
    return (values < low - margin) | (values > high + margin)
