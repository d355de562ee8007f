# SPDX-License-Identifier: BSD-3-Clause
"""How large wrenches are, in words."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.spatial.wrench import FORCE_AND_MOMENT


def rms_words(wrenches: FloatArray) -> str | None:
    """Give the root mean squares of the norms of force and moment.

    Args:
        wrenches: Wrenches; shape (n, 6); N, N m; NaN in gaps.

    Returns:
        Such as `1.2 N, 0.03 N m`; None where no wrench is whole.
    """
    whole = wrenches[np.isfinite(wrenches).all(axis=1)]
    if not len(whole):
        return None
    force, moment = (np.sqrt((whole[:, part] ** 2).sum(axis=1).mean()) for part in FORCE_AND_MOMENT)
    return f"{force:.3g} N, {moment:.3g} N m"
