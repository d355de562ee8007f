# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the expected wrench moves, that the measured one follows it, and that it is not reversed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.plausibility.magnitude import gains_of
from forcetorque.calibration.plausibility.movement import Doubt, Movement
from forcetorque.calibration.plausibility.setup import ROBOT, Setup
from forcetorque.experiment.calibration.moments import Moments

NO_LOAD_N = 1e-3
"""Root mean square of the force below which nothing hangs on the sensor, whatever its moment is.

A third of what the finest six-axis sensors resolve, and the weight of 0.1 g; a model without mass gives exactly 0,
though inertia that was left in it gives a moment.
"""

STILL = 1e-3
"""Change of the reference, relative to its size, below which it stands still.

A limb that turns by 0.06 degrees changes its forces by as much; encoders of a limb at rest scatter by less, and
sensors resolve no better than some thousandths of their load.
"""

_LEVER_M = 0.01
"""Least lever by which the size of the moment is judged: where the load hangs below the sensor it has none."""


def require_moving_load(moments: Moments, setup: Setup = ROBOT) -> None:
    """Refuse a reference without load, or one that does not change.

    Args:
        moments: Moments of the fitted samples.
        setup: Where they come from.

    Raises:
        FitError: If it is so; the message names the likely cause and what to change in the experiment file.
    """
    change = np.maximum(np.diag(moments.reference_reference), 0.0)
    size = change + moments.reference_mean**2
    force_change, moment_change = (float(np.sqrt(change[part].sum())) for part in FORCE_AND_MOMENT)
    force, moment = (float(np.sqrt(size[part].sum())) for part in FORCE_AND_MOMENT)
    if force < NO_LOAD_N:
        raise FitError(f"the reference is {force:.2g} N and {moment:.2g} N m, {setup.give_mass}")
    if force_change <= STILL * force and moment_change <= STILL * max(moment, _LEVER_M * force):
        raise FitError(
            f"the reference stays within {force_change:.2g} N of {force:.3g} N and {moment_change:.2g} N m of "
            f"{moment:.3g} N m over all fitted samples, "
            f"{setup.move_load}"
        )


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


_SURE = 3.0
"""Standard deviations by which a gain is below 0 before it is called negative."""

_EXCITED = 0.1
"""Part of the change of the whole force from which on an axis is judged by itself."""


def require_same_sign(movement: Movement, prior: FloatArray, setup: Setup = ROBOT) -> None:
    """Refuse a prior's reading whose force, or one axis of it, runs against the reference.

    Args:
        movement: How they move.
        prior: The prior; shape (6, c); N/count, N m/count.
        setup: Where the data come from.

    Raises:
        FitError: If it is so; the message names the keys that turn a sign.
    """
    gains = gains_of(movement, prior)
    if gains.overall + _SURE * gains.deviation < 0.0:
        raise FitError(
            f"the prior's reading runs against the reference, by {gains.overall:.2f} times of it; {setup.check_sign}"
        )
    # taking out what variables explain may leave less than nothing of an axis that does not move
    change = np.sqrt(np.maximum(np.diag(movement.second)[6:9], 0.0))
    against = [
        f"f{axis}"
        for axis, gain, deviation, moved in zip("xyz", gains.components, gains.deviations, change, strict=False)
        if gain + _SURE * deviation < 0.0 and moved > _EXCITED * np.linalg.norm(change)
    ]
    if against:
        raise FitError(
            f"{', '.join(against)} of the prior's reading run(s) against the reference, other forces do not; "
            f"{setup.check_axes}"
        )
