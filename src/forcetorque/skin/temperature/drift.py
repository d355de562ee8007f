# SPDX-License-Identifier: BSD-3-Clause
"""What taxels read at one instant that is no pressure."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray, read_only


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelDrift:
    """Fall of n taxels that is known to be no pressure, and how much more may be none."""

    fall: FloatArray
    """Counts below rest that are no pressure; shape (n,)."""
    sd: FloatArray
    """Standard deviation of that; shape (n,); counts."""
    limit: FloatArray
    """Further counts that heat through a contact may add, which no pad tells; NaN if not known; shape (n,)."""

    def __post_init__(self) -> None:
        for name in ("fall", "sd", "limit"):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=(len(self.fall),)))
