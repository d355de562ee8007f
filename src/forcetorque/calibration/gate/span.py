# SPDX-License-Identifier: BSD-3-Clause
"""Whether the reading follows the reference at all."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.calibration.gate.doubt import Doubt
from forcetorque.calibration.gate.movement import Movement
from forcetorque.calibration.gate.setup import ROBOT, Setup
from forcetorque.errors import FitError

_FOLLOWS = 0.5
"""Explained share of what lasts in the reading below which it does not follow the reference.

A sensor under the modelled load follows it by more than .99; what is left is drift, creep and cross-talk.
"""

_VISIBLE, _LARGE = 0.1, 0.2
"""Unexplained force, relative to the size of the reference, from which on that is a doubt, or a refusal: drift and
vibration beside a load that hardly moves stay below."""

_FASTER = 3.0
"""Change of the reference, relative to that of the reading, which no reading hides under its noise."""


def span_doubts(movement: Movement, setup: Setup = ROBOT, *, has_prior: bool) -> Iterator[Doubt]:
    """Compare what moves in the reading with what the reference explains of it.

    Args:
        movement: How reading and reference move.
        setup: Where the data come from.
        has_prior: Whether the reading is a wrench; else it is raw counts, whose size says nothing.

    Yields:
        A doubt where the reference explains less than half.

    Raises:
        FitError: If that holds of a reading that moves as much as a load does, or of a reference that moves far more.
    """
    k = movement.columns
    rows = slice(3) if has_prior else slice(k)
    left = float(movement.left(movement.lasting)[rows].sum())
    moved = max(float(np.diag(movement.lasting)[rows].sum()), 0.0)
    if left <= (1.0 - _FOLLOWS) * moved:
        return
    # of a load that carries everything the differences may be rounded below zero
    rest, unit = np.sqrt(max(left, 0.0)), "N" if has_prior else "counts"
    change = float(np.sqrt(max(np.diag(movement.second)[k : k + 3].sum(), 0.0)))
    explained = max(1.0 - left / moved, 0.0) if moved > 0.0 else 0.0  # white noise alone lasts by chance, or not at all
    message = (
        f"the reading moves by {np.sqrt(moved):.3g} {unit}, of which the reference, which moves by {change:.3g} N, "
        f"explains {explained:.0%}; {setup.check_span}"
    )
    size = float(np.linalg.norm(movement.size[:3]))
    if has_prior and (rest > _LARGE * size or change > _FASTER * np.sqrt(moved)):
        raise FitError(message)
    if not has_prior or rest > _VISIBLE * size:
        yield Doubt(kind="span", message=message)
