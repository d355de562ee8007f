# SPDX-License-Identifier: BSD-3-Clause
"""Known loads with what may be wrong of them, and the error of the matrix that is fitted to them without a prior.

A sensor reads `w + d + n` where the reference says w: d is what is wrong with the reference, n the noise. Least squares
on w then find a matrix that is wrong by the share `E = sum of (d + n) w^T M^-1`, M the second moment of w about its
mean, and a reading under a load l is wrong by `E l`: linear in all errors, so that its covariance is that of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, read_only_mapping
from forcetorque.workbench.bench import Placement
from forcetorque.workbench.loads import BenchLoads
from forcetorque.workbench.scatter import moved_loads, turned_loads
from forcetorque.workbench.span import RANK_TOLERANCE, load_sizes


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UncertainLoads:
    """Loads at n poses."""

    wrench: FloatArray
    """Loads as the reference says; shape (n, 6); N, N m."""
    count: FloatArray
    """Samples at every pose, each with noise of its own; shape (n,)."""
    lasting: Mapping[str, FloatArray]
    """What errors that stay the same change, at one standard deviation, by name; shapes (n, 6); N, N m."""
    fresh: FloatArray
    """The same of r errors that are others at every pose; shape (n, 6, r); N, N m."""

    def __post_init__(self) -> None:
        n = len(np.asarray(self.wrench))
        for field, shape in (("wrench", (n, 6)), ("count", (n,)), ("fresh", (n, 6, None))):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))
        lasting = {name: read_only(change, name=name, shape=(n, 6)) for name, change in self.lasting.items()}
        object.__setattr__(self, "lasting", read_only_mapping(lasting))

    @classmethod
    def of_bench(cls, loads: BenchLoads, placement: Placement, *, samples: int) -> UncertainLoads:
        """Take the loads of a workbench, each placed anew.

        Args:
            loads: Loads of weights.
            placement: How far they may be off.
            samples: Samples of all positions together.

        Returns:
            The loads.
        """
        return cls(
            wrench=loads.wrench,
            count=np.full(len(loads), samples / len(loads)),
            lasting={},
            fresh=np.concatenate(
                [placement.angle_rad * turned_loads(loads), placement.position_m * moved_loads(loads)], axis=2
            ),
        )

    @classmethod
    def together(cls, parts: Sequence[UncertainLoads]) -> UncertainLoads:
        """Join loads; errors of one name are one error.

        Args:
            parts: Loads with as many fresh errors each.

        Returns:
            All of them.
        """
        names = dict.fromkeys(name for part in parts for name in part.lasting)
        lasting = {
            name: np.concatenate([part.lasting.get(name, np.zeros_like(part.wrench)) for part in parts])
            for name in names
        }
        return cls(
            wrench=np.concatenate([part.wrench for part in parts]),
            count=np.concatenate([part.count for part in parts]),
            lasting=lasting,
            fresh=np.concatenate([part.fresh for part in parts]),
        )

    def matrix_error(self, noise: Any) -> MatrixError:
        """Foretell the error of a matrix that is fitted to them, with an offset of its own.

        Args:
            noise: Covariance of the noise of a sample, as wrench; shape (6, 6).

        Returns:
            What is to be expected.
        """
        size = load_sizes(self.wrench)
        moved = (self.wrench - np.average(self.wrench, axis=0, weights=self.count)) / size
        _, values, directions = np.linalg.svd(np.sqrt(self.count)[:, None] * moved, full_matrices=False)
        known = values > RANK_TOLERANCE * values[0]
        unspanned = np.where(np.abs(directions[~known]) > RANK_TOLERANCE, directions[~known], 0.0)
        # of the inverse second moment, without directions that are not spanned
        root = directions[known].T / values[known]
        worth = moved @ root @ root.T / size * self.count[:, None]  # (n, 6): of every pose for every column of E
        pairs = (worth[:, :, None] * worth[:, None, :]).reshape(len(worth), 36)
        own = (self.fresh @ self.fresh.transpose(0, 2, 1)).reshape(len(worth), 36)
        white = np.outer(np.asarray(noise, dtype=np.float64), pairs.T @ (1.0 / self.count))
        # of rows i, j and columns a, b, put in the order i, a, j, b
        covariance = (own.T @ pairs + white).reshape(6, 6, 6, 6).transpose(0, 2, 1, 3)
        for change in self.lasting.values():
            share = change.T @ worth
            covariance = covariance + share[:, :, None, None] * share
        return MatrixError(covariance=covariance, unspanned=unspanned / size)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixError:
    """Covariance of the share E by which a fitted matrix reads wrongly; a load l is read wrongly by `E l`."""

    covariance: FloatArray
    """Of E[i, a] with E[j, b]; shape (6, 6, 6, 6); without what loads do not span."""
    unspanned: FloatArray
    """Directions of E of which nothing is known, each times a load; shape (6 - rank, 6)."""

    @property
    def rank(self) -> int:
        """Directions of load that are known."""
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
        """Foretell the error of readings under loads that are changes.

        Args:
            load: Loads; shape (..., 6); N, N m.

        Returns:
            Standard deviations of the components, infinite where a load is not known; shape (..., 6); N, N m.
        """
        loads = np.asarray(load, dtype=np.float64)
        variance = np.einsum("iaib,...a,...b->...i", self.covariance, loads, loads)
        terms = np.abs(loads[..., None, :] * self.unspanned)
        beyond = (np.abs(loads @ self.unspanned.T) > RANK_TOLERANCE * terms.sum(axis=-1)).any(axis=-1)
        return np.where(beyond[..., None], np.inf, np.sqrt(np.maximum(variance, 0.0)))

    def trace(self, loads: Any) -> tuple[float, float]:
        """Foretell the mean square of the error over loads of use.

        Args:
            loads: Loads; shape (n, 6); N, N m.

        Returns:
            Mean squares of force and moment, all three components together; N^2, (N m)^2.
        """
        square = (self.error(loads) ** 2).mean(axis=0)
        return float(square[:3].sum()), float(square[3:].sum())
