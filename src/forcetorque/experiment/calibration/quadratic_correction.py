# SPDX-License-Identifier: BSD-3-Clause
"""Terms of a measurement that are quadratic in the load, and whether they improve recordings that were not fitted."""

from __future__ import annotations

import itertools
import math
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import model_validator

from forcetorque.base.arrays import ArrayField, BoolArray, FloatArray, require_last_axis
from forcetorque.base.stored_model import StoredTable

PAIRS: Final = np.triu_indices(6)
"""Pairs of components of the load whose products are the 21 quadratic terms."""

STEEPEST: Final = 0.5
"""Largest change of a correction per change of load, in shares of full scale; beyond it is no correction."""
_LEFT: Final = 1e-12
"""What the iteration leaves of the correction, relative."""
_ORTHONORMAL: Final = 1e-6
"""By how much directions of a file may miss being orthonormal."""


def quadratic_terms(shares: FloatArray) -> FloatArray:
    """Multiply every pair of components.

    Args:
        shares: Shares of full scale, relative to the centre; shape (..., 6).

    Returns:
        The 21 products; shape (..., 21).
    """
    return shares[..., PAIRS[0]] * shares[..., PAIRS[1]]


def steepness(coefficients: FloatArray, directions: FloatArray, minimum: FloatArray, maximum: FloatArray) -> float:
    """Tell how fast quadratic terms change within limits.

    Args:
        coefficients: What a unit of every term adds; shape (6, 21); shares of full scale.
        directions: Directions that the limits are along, one per row; shape (6, 6).
        minimum: Lower limits; shape (6,).
        maximum: Upper limits; shape (6,).

    Returns:
        The largest norm of the derivative; it grows in proportion to the limits.
    """
    # the derivative is linear in the load, so its norm is largest at a corner
    corners = np.array(list(itertools.product(*zip(minimum, maximum, strict=True)))) @ directions
    first, second = PAIRS
    derivative = np.zeros((len(corners), len(first), 6))
    terms = np.arange(len(first))
    derivative[:, terms, first] = corners[:, second]
    derivative[:, terms, second] += corners[:, first]  # of a square both, which is twice the load
    return float(np.linalg.norm(coefficients @ derivative, ord=2, axis=(1, 2)).max())


class QuadraticCorrection(StoredTable):
    """Quadratic terms of the load that are taken off readings, and where they hold."""

    coefficients: Annotated[FloatArray, ArrayField((6, 21))]
    """What a unit of every term adds to a reading; shape (6, 21); N, N m; rows of zeros are not corrected."""
    to_full_scale: Annotated[FloatArray, ArrayField((6, 6))]
    """Shares of full scale of six independent readings that a load makes; shape (6, 6); per N, per N m."""
    centre: Annotated[FloatArray, ArrayField((6,))]
    """Shares of full scale about which the terms are; shape (6,)."""
    directions: Annotated[FloatArray, ArrayField((6, 6))]
    """Principal directions of the fitted shares, orthonormal, one per row; shape (6, 6)."""
    minimum: Annotated[FloatArray, ArrayField((6,))]
    """Smallest fitted share along each direction, relative to the centre; shape (6,)."""
    maximum: Annotated[FloatArray, ArrayField((6,))]
    """Largest fitted share along each direction, relative to the centre; shape (6,)."""

    @model_validator(mode="after")
    def _is_small(self) -> QuadraticCorrection:
        if np.abs(self.directions @ self.directions.T - np.eye(6)).max() > _ORTHONORMAL:
            raise ValueError("expected directions that are orthonormal")
        if (self.minimum > self.maximum).any():
            raise ValueError("expected a minimum of at most the maximum along every direction")
        if not self.steepness <= STEEPEST:
            raise ValueError(
                f"expected a correction that changes by at most {STEEPEST} per unit of load, got {self.steepness:.3g}"
            )
        return self

    @property
    def steepness(self) -> float:
        """Largest change of the correction per change of load within the limits, in shares of full scale."""
        return steepness(self.to_full_scale @ self.coefficients, self.directions, self.minimum, self.maximum)

    def added(self, load: Any) -> FloatArray:
        """Give what the sensor adds to its reading of a load.

        Args:
            load: Loads; shape (..., 6); N, N m.

        Returns:
            What is added; shape (..., 6); N, N m; beyond the limits that of the limit.
        """
        wrench = np.asarray(load, dtype=np.float64)
        require_last_axis(wrench, name="load", length=6)
        along = np.clip(self._along(wrench), self.minimum, self.maximum)
        return quadratic_terms(along @ self.directions) @ self.coefficients.T

    def corrected(self, reading: Any) -> FloatArray:
        """Find the loads that were read.

        Args:
            reading: Wrenches by matrix, variables and offset; shape (..., 6); N, N m.

        Returns:
            Loads; shape (..., 6); N, N m; NaN where a reading is.
        """
        wrench = np.asarray(reading, dtype=np.float64)
        require_last_axis(wrench, name="reading", length=6)
        load = wrench
        for _ in range(self._iterations):
            load = wrench - self.added(load)
        return load

    def beyond(self, load: Any) -> BoolArray:
        """Tell which loads lie outside the limits of those that were fitted.

        Args:
            load: Loads; shape (..., 6); N, N m.

        Returns:
            Whether; shape (...).
        """
        along = self._along(np.asarray(load, dtype=np.float64))
        # a fitted load at a limit stays inside whatever the last bits of the product are
        slack = 1e-9 * np.maximum(self.maximum - self.minimum, np.finfo(float).tiny)
        return np.asarray(((along < self.minimum - slack) | (along > self.maximum + slack)).any(axis=-1))

    @property
    def _iterations(self) -> int:
        """Steps until no more than `_LEFT` of the correction is missing."""
        return 1 + math.ceil(math.log(_LEFT) / math.log(max(self.steepness, _LEFT)))

    def _along(self, load: FloatArray) -> FloatArray:
        return (load @ self.to_full_scale.T - self.centre) @ self.directions.T


CLEARLY: Final = 0.9
"""Pooled error with the correction over that without, below which it is kept."""
WORSE: Final = 1.1
"""Error with the correction over that without, above which it makes a recording worse."""
MOST: Final = 0.75
"""Share of the recordings that it may not make worse: all of two or three.

What the rule does on `icub-insitu`, eight recordings: of 80 sensors without cross-talk none keeps a correction, of 12
legs and feet with cross-talk all keep that of the force; on two or three recordings none is kept wrongly either.
"""

Half = Literal["force", "moment"]
HALVES: Final[tuple[Half, Half]] = ("force", "moment")
"""Force and moment are evaluated apart: nothing makes a newton and a newton metre one unit."""

UNITS: Final = ("N", "N m")
"""Their units."""


class NonlinearTrial(StoredTable):
    """Errors on each recording in turn of fits to all others, with and without the correction by quadratic terms.

    The offset of a session is taken from the judged recording itself.
    """

    recordings: tuple[str, ...]
    """The recordings."""
    samples: Annotated[FloatArray, ArrayField((None,), minimum=0.0)]
    """Samples of each; shape (n,)."""
    linear_rms: Annotated[FloatArray, ArrayField((None, 2), minimum=0.0)]
    """Root mean square error of force and moment by matrix, variables and offset; shape (n, 2); N, N m.

    The smaller one of two fits, with the terms and without any: a linear sensor reads best by the latter, where its
    loads cannot tell a term from a gain.
    """
    corrected_rms: Annotated[FloatArray, ArrayField((None, 2), minimum=0.0)]
    """The same with the correction, by the fit with the terms; shape (n, 2); N, N m."""

    @property
    def ratios(self) -> FloatArray:
        """Error of all recordings together with the correction over that without, force and moment; shape (2,)."""
        before, after = (self.samples @ rms**2 for rms in (self.linear_rms, self.corrected_rms))
        return np.sqrt(np.divide(after, before, out=np.ones(2), where=before > 0.0))

    @property
    def shares(self) -> FloatArray:
        """Share of the recordings that are not worse with the correction, force and moment; shape (2,)."""
        return (self.corrected_rms <= WORSE * self.linear_rms).mean(axis=0)

    @property
    def kept(self) -> tuple[Half, ...]:
        """Which of force and moment are corrected: where it is clearly better together, and not worse in most."""
        wins = (self.ratios < CLEARLY) & (self.shares >= MOST)
        return tuple(half for half, win in zip(HALVES, wins, strict=True) if win)

    def successes(self) -> list[str]:
        """Say what the correction wins.

        Returns:
            A sentence for each of force and moment that is corrected.
        """
        return [
            f"the quadratic correction of the {half} is kept: {self._numbers(k)}"
            for k, half in enumerate(HALVES)
            if half in self.kept
        ]

    def refusals(self) -> list[str]:
        """Say by how much the correction lost.

        Returns:
            A sentence for each of force and moment that is not corrected.
        """
        return [
            f"the quadratic correction of the {half} is refused: {self._numbers(k)}; it is kept from "
            f"{100 * (CLEARLY - 1):+.0f} % with {100 * MOST:.0f} % of them"
            for k, half in enumerate(HALVES)
            if half not in self.kept
        ]

    def _numbers(self, k: int) -> str:
        before, after = (
            np.sqrt(self.samples @ rms[:, k] ** 2 / self.samples.sum()) for rms in (self.linear_rms, self.corrected_rms)
        )
        count, unit = round(float(self.shares[k]) * len(self.recordings)), UNITS[k]
        return (
            f"on recordings that were not fitted the error is {after:.3g} {unit} with it and {before:.3g} {unit} "
            f"without ({100 * (self.ratios[k] - 1):+.0f} %), and {count} of {len(self.recordings)} read no worse"
        )


DECISIVE: Final = 20.0
"""Difference of deviance per channel from which a sensor is taken as linear: odds of e^10.

On simulated sensors without quadratic terms it is 34 to 75, on those of `icub-insitu`, which have some, 12 at most.
"""


class LinearityTest(StoredTable):
    """Evidence of two fits without an assumed error of the expected wrench, with quadratic terms and without."""

    channels: int
    """Number of channels."""
    quadratic_deviance: float
    """Minus twice the logarithm of the evidence of the fit with quadratic terms, less a constant."""
    linear_deviance: float
    """The same without them."""

    @property
    def is_linear(self) -> bool:
        """Whether the fit without quadratic terms is kept."""
        return self.quadratic_deviance - self.linear_deviance > DECISIVE * self.channels

    @property
    def message(self) -> str:
        """Which fit is kept, and by what evidence."""
        difference = (self.quadratic_deviance - self.linear_deviance) / self.channels
        kept = "without quadratic terms" if self.is_linear else "the default, with quadratic terms of the load"
        return (
            f"fit kept: {kept}; deviance per channel is {difference:+.1f} lower without them, decisive from "
            f"{DECISIVE:g} on"
        )
