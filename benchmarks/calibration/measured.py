# SPDX-License-Identifier: BSD-3-Clause
"""What a part of the benchmark brings back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """Figures of one part, by name, as `benchmarks.harness.write_result` takes them."""

    ratios: Mapping[str, float]
    """Ours against the named peer."""
    seconds: Mapping[str, list[float]]
    """Seconds of every round, per unit of work."""
    accuracy: Mapping[str, Any]
    """How far the results agree."""
    figures: Mapping[str, Any]
    """Sizes, what was extrapolated, and anything else."""
