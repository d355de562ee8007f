# SPDX-License-Identifier: BSD-3-Clause
"""Swings that keep their phase over a record, and what the tapers about a candidate see of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.evaluation.oscillation.candidate import Candidate
from forcetorque.evaluation.oscillation.tapers import ComplexArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaperedSwings:
    """Swings of one record; the shape of one is its cycles per record, and the growth of its logarithm per record."""

    place: FloatArray
    """Where the samples are, from the middle of the record; shape (n,); records."""
    carrier: ComplexArray
    """Tapers, turned back by the frequency of the candidate; shape (k, n)."""

    @classmethod
    def about(cls, candidate: Candidate, samples: int) -> Self:
        """Put the tapers about a candidate.

        Args:
            candidate: Where.
            samples: Samples of the record.

        Returns:
            The swings about it.
        """
        place = (np.arange(samples) - 0.5 * (samples - 1)) / samples
        carrier = candidate.family.tapers(samples) * np.exp(-2j * np.pi * candidate.cycles * place)
        return cls(place=place, carrier=carrier)

    def seen(self, signals: FloatArray) -> FloatArray:
        """Tell what the tapers see of signals.

        Args:
            signals: Signals; shape (n, ...).

        Returns:
            Real parts over imaginary ones; shape (2 k, ...).
        """
        numbers = self.carrier @ signals
        both: FloatArray = np.concatenate([numbers.real, numbers.imag])
        return both

    def cosine_and_sine(self, shape: Any) -> FloatArray:
        """Give the two swings of a shape of which all others are sums.

        Args:
            shape: Cycles and growth.

        Returns:
            Swings without mean and trend, as the signal has none; shape (n, 2).
        """
        from scipy.signal import detrend

        cycles, growth = shape
        envelope, angle = np.exp(growth * self.place), 2.0 * np.pi * cycles * self.place
        swings: FloatArray = detrend(np.column_stack([envelope * np.cos(angle), envelope * np.sin(angle)]), axis=0)
        return swings

    def columns(self, shape: Any) -> FloatArray:
        """Tell what the tapers see of these two.

        Args:
            shape: Cycles and growth.

        Returns:
            Columns of a regression; shape (2 k, 2).
        """
        return self.seen(self.cosine_and_sine(shape))
