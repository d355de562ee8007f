# SPDX-License-Identifier: BSD-3-Clause
"""Whether quadratic terms correct readings of recordings that were not fitted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Final, Literal

import numpy as np

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.calibration.part import Part

CLEARLY: Final = 0.9
"""Pooled error with the correction over that without, below which it is kept."""
MOST: Final = 0.7
"""Share of the recordings that may not be worse with it."""

Half = Literal["force", "moment"]
HALVES: Final[tuple[Half, Half]] = ("force", "moment")
"""Force and moment are judged apart: nothing makes a newton and a newton metre one unit."""


class NonlinearTrial(Part):
    """Errors on each recording in turn of a fit to all others, with and without the correction by quadratic terms.

    The offset of a session is taken from the judged recording itself.
    """

    recordings: tuple[str, ...]
    """The recordings."""
    samples: Annotated[FloatArray, ArrayField((None,), minimum=0.0)]
    """Samples of each; shape (n,)."""
    linear_rms: Annotated[FloatArray, ArrayField((None, 2), minimum=0.0)]
    """Root mean square error of force and moment by matrix, variables and offset; shape (n, 2); N, N m."""
    corrected_rms: Annotated[FloatArray, ArrayField((None, 2), minimum=0.0)]
    """The same with the correction; shape (n, 2); N, N m."""

    @property
    def ratios(self) -> FloatArray:
        """Error of all recordings together with the correction over that without, force and moment; shape (2,)."""
        before, after = (self.samples @ rms**2 for rms in (self.linear_rms, self.corrected_rms))
        ratios: FloatArray = np.sqrt(np.divide(after, before, out=np.ones(2), where=before > 0.0))
        return ratios

    @property
    def shares(self) -> FloatArray:
        """Share of the recordings that are not worse with the correction, force and moment; shape (2,)."""
        shares: FloatArray = (self.corrected_rms <= self.linear_rms).mean(axis=0)
        return shares

    @property
    def kept(self) -> tuple[Half, ...]:
        """Which of force and moment are corrected: where it is clearly better together, and not worse in most."""
        wins = (self.ratios < CLEARLY) & (self.shares >= MOST)
        return tuple(half for half, win in zip(HALVES, wins, strict=True) if win)

    def sentences(self) -> Sequence[str]:
        """Say what came of it.

        Returns:
            A sentence each for force and moment.
        """
        return [self._sentence(k) for k in range(2)]

    def _sentence(self, k: int) -> str:
        half, unit = HALVES[k], ("N", "N m")[k]
        before, after = (np.sqrt(self.samples @ r[:, k] ** 2 / self.samples.sum()) for r in self._errors)
        count = round(float(self.shares[k]) * len(self.recordings))
        numbers = (
            f"on recordings that were not fitted the error is {after:.3g} {unit} with it and {before:.3g} {unit} "
            f"without ({100 * (self.ratios[k] - 1):+.0f} %), and {count} of {len(self.recordings)} are not worse"
        )
        if half in self.kept:
            return f"the quadratic correction of the {half} is kept: {numbers}"
        return (
            f"the quadratic correction of the {half} is refused: {numbers}; it is kept from {100 * (CLEARLY - 1):+.0f} "
            f"% with {100 * MOST:.0f} % of the recordings"
        )

    @property
    def _errors(self) -> tuple[FloatArray, FloatArray]:
        return self.linear_rms, self.corrected_rms
