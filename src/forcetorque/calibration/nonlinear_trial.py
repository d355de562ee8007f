# SPDX-License-Identifier: BSD-3-Clause
"""Whether quadratic terms correct readings of recordings that were not fitted."""

from __future__ import annotations

from typing import Annotated, Final, Literal

import numpy as np

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.part import Part

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
"""Force and moment are judged apart: nothing makes a newton and a newton metre one unit."""

UNITS: Final = ("N", "N m")
"""Their units."""


class NonlinearTrial(Part):
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
        ratios: FloatArray = np.sqrt(np.divide(after, before, out=np.ones(2), where=before > 0.0))
        return ratios

    @property
    def shares(self) -> FloatArray:
        """Share of the recordings that are not worse with the correction, force and moment; shape (2,)."""
        shares: FloatArray = (self.corrected_rms <= WORSE * self.linear_rms).mean(axis=0)
        return shares

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
