# SPDX-License-Identifier: BSD-3-Clause
"""Peak of this machine in double precision: independent fused multiply-adds that stay in registers."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numba import njit

_FORMULA: dict[str, Any] = {"inline": "always", "fastmath": {"contract"}}
_CHAINS = 10
_STEPS = 16
_ROW = 256
_REPEATS = 40_000

OPERATIONS = 2 * _CHAINS * _STEPS * _ROW * _REPEATS
"""Floating-point operations of one call per thread; a multiply-add counts as two."""


@njit(**_FORMULA)
def _step(x):
    """One multiply-add on each of ten chains; ten vectors, factor and summand fit into sixteen registers."""
    c, d = 0.999, 0.001
    return (
        x[0] * c + d,
        x[1] * c + d,
        x[2] * c + d,
        x[3] * c + d,
        x[4] * c + d,
        x[5] * c + d,
        x[6] * c + d,
        x[7] * c + d,
        x[8] * c + d,
        x[9] * c + d,
    )


@njit(**_FORMULA)
def _four_steps(x):
    """Four in a row."""
    return _step(_step(_step(_step(x))))


@njit(nogil=True, fastmath={"contract"})
def _burn(rows, repeats):
    """Sixteen steps between one load and one store of every chain; the loop over k becomes vectors."""
    for _ in range(repeats):
        for k in range(_ROW):
            x = (
                rows[0, k],
                rows[1, k],
                rows[2, k],
                rows[3, k],
                rows[4, k],
                rows[5, k],
                rows[6, k],
                rows[7, k],
                rows[8, k],
                rows[9, k],
            )
            x = _four_steps(_four_steps(_four_steps(_four_steps(x))))
            rows[0, k], rows[1, k], rows[2, k], rows[3, k], rows[4, k] = x[0], x[1], x[2], x[3], x[4]
            rows[5, k], rows[6, k], rows[7, k], rows[8, k], rows[9, k] = x[5], x[6], x[7], x[8], x[9]


def burn(threads: int) -> None:
    """Do `OPERATIONS` floating-point operations on every thread.

    Args:
        threads: Number of threads.
    """
    rows = [np.ones((_CHAINS, _ROW + 4)) for _ in range(threads)]
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(lambda own: _burn(own, _REPEATS), rows))
