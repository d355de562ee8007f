# SPDX-License-Identifier: BSD-3-Clause
"""Excitation by known loads: the directions that they span, and the matrix error that uncertain loads cause."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, mapping, read_only
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.workbench.known_loads import BenchLoads
from forcetorque.workbench.matrix_fit import rotation_derivatives, shift_derivatives
from forcetorque.workbench.position_means import Placement

RANK_TOLERANCE: Final = 1e-9
"""Share of the largest singular value below which a direction is not spanned: rounding leaves 1e-15."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MissingMoment:
    """A sum of force and moment that is zero for all loads: the moment about a line, for weights of rigid bodies.

    `axis . moment + (point x axis) . force + pitch_m axis . force`; a pitch of 0 leaves the moment about the line.
    """

    axis: FloatArray
    """Direction of the line in the sensor's frame, of length 1, its largest component positive; shape (3,)."""
    point_m: FloatArray
    """Point of the line that is nearest to the sensor's origin; shape (3,); m."""
    pitch_m: float
    """Coefficient of the force along the line; m."""
    functional: FloatArray
    """Coefficients of force and moment; shape (6,); m, 1."""

    @classmethod
    def of(cls, functional: FloatArray) -> MissingMoment | None:
        """Compute the line of a linear functional of wrenches.

        Args:
            functional: Coefficients of force and moment, up to a factor; shape (6,).

        Returns:
            The line; None where the functional has no moment.
        """
        size = float(np.linalg.norm(functional[3:]))
        if size <= RANK_TOLERANCE * float(np.linalg.norm(functional[:3])):
            return None
        sign = np.sign(functional[3 + int(np.argmax(np.abs(functional[3:]).round(9)))])
        scaled = sign * functional / size
        arm, axis = scaled[:3], scaled[3:]
        return cls(
            axis=axis,
            point_m=np.cross(axis, arm),
            pitch_m=float(axis @ arm),
            functional=read_only(scaled, name="functional", shape=(6,)),
        )

    def distance_m(self, position_m: Any) -> float:
        """Compute the distance of a position from the line.

        Args:
            position_m: The position, in the sensor's frame; shape (3,); m.

        Returns:
            The distance; m.
        """
        return float(np.linalg.norm(np.cross(np.asarray(position_m, dtype=np.float64) - self.point_m, self.axis)))

    @property
    def text(self) -> str:
        """The line as text."""
        x, y, z = ((1e3 * self.point_m).round(6) + 0.0).tolist()
        along = ", ".join(f"{value:.3f}" for value in (self.axis.round(9) + 0.0).tolist())
        screw = "" if abs(self.pitch_m) < 1e-6 else f", with {1e3 * self.pitch_m:.3g} mm of the force along it"
        return f"the moment about the line through ({x:.1f}, {y:.1f}, {z:.1f}) mm along ({along}){screw}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Span:
    """Linear span of loads, with force and moment each over its largest."""

    rank: int
    """Directions of load that are spanned, to a share of 1e-9."""
    strengths: FloatArray
    """Singular values of the scaled loads over the root of their number, largest first; shape (6,)."""
    missing: tuple[MissingMoment, ...]
    """The same as moments about lines, where they have a moment."""

    @property
    def least_strength(self) -> float:
        """The smallest singular value."""
        return float(self.strengths[-1])

    @classmethod
    def of(cls, wrench: Any) -> Span:
        """Compute the span of loads.

        Args:
            wrench: Loads; shape (n, 6), n at least 6; N, N m.

        Returns:
            Rank, singular values, and moments that are missing.

        Raises:
            ShapeError: If there are fewer than six loads, or all are zero.
        """
        loads = read_only(wrench, name="wrench", shape=(None, 6))
        if len(loads) < 6 or not loads.any():
            raise ShapeError(f"wrench: expected at least six loads that are not all zero, got {len(loads)}")
        size = load_sizes(loads)
        _, values, directions = np.linalg.svd(loads / size, full_matrices=False)
        rank = int((values > RANK_TOLERANCE * values[0]).sum())
        lines = (MissingMoment.of(functional) for functional in directions[rank:] / size)
        return cls(
            rank=rank,
            strengths=values / np.sqrt(len(loads)),
            missing=tuple(line for line in lines if line is not None),
        )


def load_sizes(wrench: FloatArray) -> FloatArray:
    """Compute the largest force and the largest moment, as scales that make both comparable.

    Args:
        wrench: Loads; shape (n, 6); N, N m.

    Returns:
        The force three times, then the moment, 1 where there is none; shape (6,); N, N m.
    """
    largest = [float(np.linalg.norm(wrench[:, half], axis=1).max()) for half in FORCE_AND_MOMENT]
    return np.repeat([size if size > 0.0 else 1.0 for size in largest], 3)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UncertainLoads(ArrayRecord):
    """Known loads at n poses, with the effect of errors of the loads."""

    wrench: FloatArray = field(metadata=array("n", 6))
    """Expected wrenches; shape (n, 6); N, N m."""
    count: FloatArray = field(metadata=array("n"))
    """Samples at every pose, with independent noise; shape (n,)."""
    systematic: Mapping[str, FloatArray] = field(metadata=mapping("n", 6))
    """Change of the wrenches by one standard deviation of errors that all poses share, by name; shapes (n, 6)."""
    independent: FloatArray = field(metadata=array("n", 6, None))
    """The same of r errors that are independent at every pose; shape (n, 6, r); N, N m."""

    @classmethod
    def of_bench(cls, loads: BenchLoads, placement: Placement, *, samples: int) -> UncertainLoads:
        """Propagate errors of the placement to the loads of a workbench, independently at every position.

        Args:
            loads: Loads of weights.
            placement: Standard deviations of the placement.
            samples: Samples of all positions together.

        Returns:
            The loads.
        """
        return cls(
            wrench=loads.wrench,
            count=np.full(len(loads), samples / len(loads)),
            systematic={},
            independent=np.concatenate(
                [placement.angle_rad * rotation_derivatives(loads), placement.position_m * shift_derivatives(loads)],
                axis=2,
            ),
        )

    @classmethod
    def join(cls, segments: Sequence[UncertainLoads]) -> UncertainLoads:
        """Join loads; systematic errors of one name are one error.

        Args:
            segments: Loads with equally many independent errors each.

        Returns:
            All of them.
        """
        names = dict.fromkeys(name for loads in segments for name in loads.systematic)
        systematic = {
            name: np.concatenate([loads.systematic.get(name, np.zeros_like(loads.wrench)) for loads in segments])
            for name in names
        }
        return cls(
            wrench=np.concatenate([loads.wrench for loads in segments]),
            count=np.concatenate([loads.count for loads in segments]),
            systematic=systematic,
            independent=np.concatenate([loads.independent for loads in segments]),
        )

    def matrix_error(self, noise: Any) -> MatrixError:
        """Predict the error of a matrix that is fitted to the loads together with an offset.

        Args:
            noise: Covariance of the noise of a sample, as wrench; shape (6, 6).

        Returns:
            Covariance of the error.
        """
        size = load_sizes(self.wrench)
        moved = (self.wrench - np.average(self.wrench, axis=0, weights=self.count)) / size
        _, values, directions = np.linalg.svd(np.sqrt(self.count)[:, None] * moved, full_matrices=False)
        known = values > RANK_TOLERANCE * values[0]
        unspanned = np.where(np.abs(directions[~known]) > RANK_TOLERANCE, directions[~known], 0.0)
        # of the inverse second moment, without directions that are not spanned
        root = directions[known].T / values[known]
        gain = moved @ root @ root.T / size * self.count[:, None]  # (n, 6): of every pose for every column of E
        pairs = (gain[:, :, None] * gain[:, None, :]).reshape(len(gain), 36)
        by_pose = (self.independent @ self.independent.transpose(0, 2, 1)).reshape(len(gain), 36)
        white = np.outer(np.asarray(noise, dtype=np.float64), pairs.T @ (1.0 / self.count))
        # of rows i, j and columns a, b, put in the order i, a, j, b
        covariance = (by_pose.T @ pairs + white).reshape(6, 6, 6, 6).transpose(0, 2, 1, 3)
        for change in self.systematic.values():
            share = change.T @ gain
            covariance = covariance + share[:, :, None, None] * share
        return MatrixError(covariance=covariance, unspanned=unspanned / size)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixError:
    """Covariance of the relative error E of a fitted matrix; the measurement of a load l is wrong by `E l`."""

    covariance: FloatArray
    """Of E[i, a] with E[j, b]; shape (6, 6, 6, 6); without directions that loads do not span."""
    unspanned: FloatArray
    """Linear functionals of loads for which E is undetermined; shape (6 - rank, 6)."""

    @property
    def rank(self) -> int:
        """Number of directions of load that are determined."""
        return 6 - len(self.unspanned)

    @property
    def volume(self) -> float:
        """Logarithm of the determinant of the covariance of all of E, which D-optimal motions lower; N, N m are units.

        It is infinite where a direction is not spanned.
        """
        if self.rank < 6:
            return float(np.inf)
        return float(np.linalg.slogdet(self.covariance.reshape(36, 36))[1])

    def error(self, load: Any) -> FloatArray:
        """Predict the error of measurements of changes of load.

        Args:
            load: Loads; shape (..., 6); N, N m.

        Returns:
            Standard deviations of the components, infinite where undetermined; shape (..., 6); N, N m.
        """
        loads = np.asarray(load, dtype=np.float64)
        variance = np.einsum("iaib,...a,...b->...i", self.covariance, loads, loads)
        terms = np.abs(loads[..., None, :] * self.unspanned)
        beyond = (np.abs(loads @ self.unspanned.T) > RANK_TOLERANCE * terms.sum(axis=-1)).any(axis=-1)
        return np.where(beyond[..., None], np.inf, np.sqrt(np.maximum(variance, 0.0)))

    def mean_squares(self, loads: Any) -> tuple[float, float]:
        """Predict the mean square of the error over operating loads.

        Args:
            loads: Loads; shape (n, 6); N, N m.

        Returns:
            Mean squares of force and moment, all three components together; N^2, (N m)^2.
        """
        square = (self.error(loads) ** 2).mean(axis=0)
        return float(square[:3].sum()), float(square[3:].sum())
