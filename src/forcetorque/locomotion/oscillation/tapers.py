# SPDX-License-Identifier: BSD-3-Clause
"""Spectra by several tapers: at every frequency some independent numbers, of which a swing explains a pattern.

Whatever colour noise has, within the narrow band of the tapers it is white, so that what the pattern leaves of these
numbers is the noise that the pattern itself is told with [1]. Nothing needs to be known of the noise elsewhere.

References:
    [1] D. J. Thomson, Spectrum estimation and harmonic analysis, Proceedings of the IEEE 70 (1982), sections X and XI.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray

ComplexArray = npt.NDArray[np.complex128]

_PADDING = 4
"""Frequencies that are looked at for each that is independent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TaperFamily:
    """Slepian tapers of one bandwidth."""

    half_bandwidth: int
    """Half of the band in cycles per record, Thomson's NW."""
    count: int
    """Tapers: fewer than twice that, or they leak."""
    from_cycles: float
    """Cycles in the record from which on they are used: the band must not reach slow drift."""

    def tapers(self, n: int) -> FloatArray:
        """Give the tapers.

        Args:
            n: Samples.

        Returns:
            Of unit length and orthogonal; shape (count, n).
        """
        return (_kept if n <= _MOST_KEPT else _slepian)(n, self.half_bandwidth, self.count)


def _slepian(n: int, half_bandwidth: int, count: int) -> FloatArray:
    from scipy.signal.windows import dpss  # here because importing it takes longer than most commands

    windows: FloatArray = dpss(n, half_bandwidth, Kmax=count)
    windows.setflags(write=False)
    return windows


_MOST_KEPT = 20_000
"""Samples up to which tapers are kept for the next record: of simulations there are many of one length."""
_kept = lru_cache(maxsize=32)(_slepian)


FAMILIES = (
    TaperFamily(half_bandwidth=3, count=5, from_cycles=3.3),
    TaperFamily(half_bandwidth=5, count=8, from_cycles=7.0),
)
"""Few cycles are told with a narrow band, which knows the noise less well."""
LEAST_CYCLES = FAMILIES[0].from_cycles
"""Cycles that a record must hold of an oscillation."""


def tapered_spectrum(values: FloatArray, tapers: FloatArray) -> tuple[FloatArray, ComplexArray]:
    """Transform signals under every taper.

    Args:
        values: Signals; shape (p, n).
        tapers: Shape (k, n).

    Returns:
        Cycles in n samples, shape (m,), and the complex transforms, shape (p, k, m).
    """
    from scipy import fft

    n = values.shape[1]
    size = fft.next_fast_len(_PADDING * n, real=True)
    transforms: ComplexArray = fft.rfft(tapers * values[:, None, :], size, axis=2)
    cycles: FloatArray = np.arange(transforms.shape[2], dtype=np.float64) * (n / size)
    return cycles, transforms


def growth_pattern(tapers: FloatArray, growth: float) -> FloatArray:
    """Give what a swing of unit amplitude in the middle, growing evenly, is under every taper at its own frequency.

    Args:
        tapers: Shape (k, n).
        growth: Logarithm of the amplitude at the end over that at the start.

    Returns:
        Shape (k,).
    """
    n = tapers.shape[1]
    place = (np.arange(n) - 0.5 * (n - 1)) / n
    return tapers @ np.exp(growth * place)
