# SPDX-License-Identifier: BSD-3-Clause
"""Cross-talk beyond linear: products of wrench components that no matrix takes out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Crosstalk:
    """A quadratic form per channel in the wrench relative to a full scale."""

    quadratic: FloatArray
    """Counts at full scale times full scale; shape (c, 6, 6)."""
    full_scale: FloatArray
    """Wrench that counts as one; shape (6,); N, N m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "quadratic", read_only(self.quadratic, name="quadratic", shape=(None, 6, 6)))
        object.__setattr__(self, "full_scale", read_only(self.full_scale, name="full_scale", shape=(6,)))

    def counts(self, wrench: FloatArray) -> FloatArray:
        """Give what it adds.

        Args:
            wrench: True wrenches; shape (n, 6); N, N m.

        Returns:
            Counts; shape (n, c).
        """
        relative = wrench / self.full_scale
        added: FloatArray = np.einsum("ni,cij,nj->nc", relative, self.quadratic, relative)
        return added
