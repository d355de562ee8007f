# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the measured wrench follows the expected one: sense, gain, full scale and moment unit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.experiment.calibration.sensor_model import measured_components
from forcetorque.inspection.plausibility.compared_wrenches import ROBOT, Doubt, Movement, Setup

_SPREAD = np.repeat([0.1, 0.2], 3)
"""Standard deviation of the coefficients of a matrix, relative to those of their row, in rows of force and of moment.

Mounted sensors are off by half as much. Their readings may still be off by tens of percent: coefficients nearly cancel,
and a moment leaks into a force. A gain beside such errors is what is left for the model to answer for.
"""

_INDEPENDENT = 10.0
"""Independent samples that what lasts in the residual counts for: drift and creep wander over a whole recording."""

_ROUNDING = 1e-6
"""Residual relative to the reference below which there is none, as in simulations without noise."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Gains(ArrayRecord):
    """Gains of the components of the wrench, 1 where model and prior are right."""

    components: FloatArray = field(metadata=array(6))
    """Gain of each component; shape (6,)."""
    deviations: FloatArray = field(metadata=array(6))
    """Standard deviation of each; infinite where the reference does not move or the sensor does not measure it; shape
    (6,)."""

    @property
    def overall(self) -> float:
        """Their mean, each counted by what it is worth."""
        weight = self._weight
        return float(weight @ self.components / weight.sum()) if weight.any() else 1.0

    @property
    def deviation(self) -> float:
        """Standard deviation of the mean; infinite where no load moves."""
        total = float(self._weight.sum())
        return total**-0.5 if total > 0.0 else float("inf")

    @property
    def _weight(self) -> FloatArray:
        return self.deviations**-2.0


def gains_of(movement: Movement, prior: FloatArray) -> Gains:
    """Fit `reading_i = g_i reference_i + error of coefficients + offset + noise` for each component.

    Errors of the coefficients are Gaussian, as those of sensors are; nothing is known of the gains beforehand.

    Args:
        movement: How the prior's reading and the reference move.
        prior: The prior; shape (6, c); N/count, N m/count.

    Returns:
        The gains.
    """
    eigenvalues, vectors = np.linalg.eigh(movement.second[6:, 6:])
    deviations = np.sqrt(np.maximum(eigenvalues, 0.0))
    moving = deviations > 1e-7 * deviations.max()
    # six samples with the second moments of all, so that a factorisation of them loses no digits
    reference = (vectors[:, moving] * deviations[moving]).T
    reading = (vectors[:, moving] / deviations[moving]).T @ movement.second[6:, :6]
    counts = reference @ np.linalg.pinv(prior).T
    lasting = movement.left(movement.lasting)
    white = np.maximum(movement.left(movement.second) - lasting, 0.0)
    noise = np.sqrt(lasting / _INDEPENDENT + white / movement.count)
    size = np.where(movement.size > 0.0, movement.size, movement.size.max())  # a component may never be loaded
    noise = np.maximum(noise, np.maximum(_ROUNDING * size, np.finfo(float).tiny))
    scale = _SPREAD * np.sqrt((prior**2).mean(axis=1))
    fits = [
        _gain(reading[:, i], reference[:, i], scale[i] * counts, noise[i]) if measured else (1.0, float("inf"))
        for i, measured in enumerate(measured_components(prior))
    ]
    return Gains(components=np.array([gain for gain, _ in fits]), deviations=np.array([spread for _, spread in fits]))


def _gain(reading: FloatArray, reference: FloatArray, error_of: FloatArray, noise: float) -> tuple[float, float]:
    """Gain and its deviation, with coefficients of the error that have a deviation of 1."""
    channels = error_of.shape[1]
    design = np.block(
        [[error_of / noise, reference[:, None] / noise], [np.eye(channels), np.zeros((channels, 1))]],
    )
    q, r = np.linalg.qr(design)
    worth = abs(float(r[-1, -1]))
    if worth == 0.0:
        return 1.0, float("inf")
    return float(q[: len(reading), -1] @ reading / noise / r[-1, -1]), 1.0 / worth


_SENSOR = 1.8
"""Factor by which no sensor's gain changes: beyond it, up or down, the model is wrong."""

_SURELY_OFF, _LIKELY = 3.0, 2.5
"""Standard deviations of the gain that a refusal, or a doubt, takes."""

_TURNED_LESS = 5.0
"""Gain from which on the joints may have turned further than the model did: by 57, less where turns are large."""


def scale_doubts(movement: Movement, prior: FloatArray, setup: Setup = ROBOT) -> Iterator[Doubt]:
    """Judge the gain of a prior's reading on the reference.

    Args:
        movement: How they move.
        prior: The prior; shape (6, c); N/count, N m/count.
        setup: Where the data come from.

    Yields:
        A doubt where the gain changed by more than mounting changes it: no single recording tells it from wrong masses.

    Raises:
        FitError: If no sensor changes its gain by so much.
    """
    gains = gains_of(movement, prior)
    gain, deviation = gains.overall, gains.deviation
    off = abs(gain - 1.0)
    if not 1.0 / _SENSOR < gain < _SENSOR and off > _SURELY_OFF * deviation:
        raise FitError(
            f"the prior's reading moves {gain:.3g} times as much as the reference, which no sensor does; "
            f"{_cause(movement, gain, setup)}{setup.check_gain}"
        )
    if off > setup.doubtful_gain and off > _LIKELY * deviation:
        yield Doubt(
            kind="scale",
            message=f"the gain changed by {gain - 1.0:+.0%} from the prior's, and wrong masses look the same; "
            f"{_cause(movement, gain, setup)}{setup.check_gain}",
        )


_TOLD = 0.1
"""Standard deviation of a gain up to which it is compared with others; loads of an axis give .04 to .08 at best."""


def axis_doubts(movement: Movement, prior: FloatArray, setup: Setup) -> Iterator[Doubt]:
    """Compare the gains of the components with each other: the gain of a type of sensor is shared by all of them.

    Args:
        movement: How the prior's reading and the reference move.
        prior: The prior; shape (6, c); N/count, N m/count.
        setup: Where the data come from.

    Yields:
        A doubt that names the components whose gain no sensor of the type has.
    """
    if setup.doubtful_axis is None:
        return
    gains = gains_of(movement, prior)
    told = gains.deviations < _TOLD
    if not told.any():
        return
    median = float(np.median(gains.components[told]))
    ratio = gains.components / median
    off = told & ((ratio > setup.doubtful_axis) | (ratio < 1.0 / setup.doubtful_axis))
    if off.any():
        named = ", ".join(f"{WRENCH_COMPONENTS[k]} moves {gains.components[k]:.2f}" for k in np.flatnonzero(off))
        yield Doubt(
            kind="axis",
            message=f"the prior's reading of {named} times the reference, while the median of all components is "
            f"{median:.2f}; {setup.check_gain}",
        )


def _cause(movement: Movement, gain: float, setup: Setup) -> str:
    second = np.diag(movement.second)
    size = float(np.linalg.norm(movement.size[:3]))
    change = float(np.sqrt(second[6:9].sum()))
    # the reading moves as the weight of the model would if it turned further
    turned_less = setup.joints_move_too_little and gain > _TURNED_LESS
    if turned_less and change < 0.2 * size and np.sqrt(second[:3].sum()) < 2.0 * size:
        return (
            f"the reference moves by {change:.3g} N only, with a size of {size:.3g} N: are joints in radians read as "
            "degrees (a log of YARP holds degrees; units of [[recording.stream]] otherwise)? If not, "
        )
    return next((f"{words} " for low, high, words in setup.gain_causes if low < gain < high), "")


_BEYOND = 2.0
"""Part of its full scale that a sensor never reads; nominal full scales are often exceeded by some tens of percent."""


def require_within_full_scale(data_sets: Sequence[DataSet], full_scale: FloatArray) -> None:
    """Refuse a reference that the sensor cannot have read.

    Args:
        data_sets: The data.
        full_scale: Largest wrench that the sensor reads; shape (6,); N, N m.

    Raises:
        FitError: If a component of the reference is beyond twice that; the message names the likely cause.
    """
    largest = np.max([np.abs(data.reference).max(axis=0) for data in data_sets], axis=0)
    worst = int(np.argmax(largest / full_scale))
    if largest[worst] > _BEYOND * full_scale[worst]:
        unit = "N" if worst < 3 else "N m"
        raise FitError(
            f"the reference reaches {largest[worst]:.4g} {unit} in {WRENCH_COMPONENTS[worst]}, the sensor's full scale "
            f"is {full_scale[worst]:.4g} {unit}; are the masses in the file that urdf of [robot] names, or mass_kg of "
            "[load], in grams instead of kg, is the load estimated with joints in another unit than stated, or is "
            "full_scale of [[sensor]] not that of its data sheet, in N and N m?"
        )


_LEAST = 0.2
"""Movement of a moment, relative to that of its reference, below which no sensor stays where its force follows.

A force that leaks into moments makes them larger. Only in all three at once, and just so, could it take away this much.
N m that are stated as kgf cm, lbf in or N mm stay below.
"""

_FORCE = (0.5, 2.0)
"""Movement of the force, relative to that of its reference, between which the unit of moments is what is wrong."""

_NO_MOMENT_LEVER_M = 1e-3
"""Lever below which the reference hardly moves a moment, and says nothing about it; m."""


def require_moment_unit(movement: Movement, setup: Setup = ROBOT) -> None:
    """Refuse a prior's reading whose force follows the reference while its moment is far too small.

    Args:
        movement: How the prior's reading and the reference move.
        setup: Where the data come from.

    Raises:
        FitError: If it is so; the message names the unit of the stream.
    """
    # taking out what variables explain may leave less than nothing of what does not move
    second = np.maximum(np.diag(movement.second), 0.0)
    force, moment, reference_force, reference_moment = np.sqrt(second.reshape(4, 3).sum(axis=1))
    if reference_moment <= _NO_MOMENT_LEVER_M * reference_force or not reference_force > 0.0:
        return
    follows = _FORCE[0] < force / reference_force < _FORCE[1]
    if follows and moment < _LEAST * reference_moment:
        raise FitError(
            f"the moment of the prior's reading moves by {moment:.3g} N m, {moment / reference_moment:.2g} times as "
            f"much as that of the reference, while its force moves {force / reference_force:.2g} times as much; "
            f"{setup.check_moment}"
        )


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

_NO_LOAD_LEVER_M = 0.01
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
    if force_change <= STILL * force and moment_change <= STILL * max(moment, _NO_LOAD_LEVER_M * force):
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


_SURELY_REVERSED = 3.0
"""Standard deviations by which a gain is below 0 before it is called negative."""

_EXCITED = 0.1
"""Part of the change of the whole force from which on an axis is judged by itself."""


def require_same_sign(movement: Movement, prior: FloatArray, setup: Setup = ROBOT) -> None:
    """Refuse a prior whose force, or one axis of it, is opposite to the expected force.

    Args:
        movement: How they move.
        prior: The prior; shape (6, c); N/count, N m/count.
        setup: Where the data come from.

    Raises:
        FitError: If it is so; the message names the keys that turn a sign.
    """
    gains = gains_of(movement, prior)
    if gains.overall + _SURELY_REVERSED * gains.deviation < 0.0:
        raise FitError(
            f"the force by the prior matrix is opposite to the expected force, {gains.overall:.2f} times it; "
            f"{setup.check_sign}"
        )
    # taking out what variables explain may leave less than nothing of an axis that does not move
    change = np.sqrt(np.maximum(np.diag(movement.second)[6:9], 0.0))
    against = [
        f"f{axis}"
        for axis, gain, deviation, moved in zip("xyz", gains.components, gains.deviations, change, strict=False)
        if gain + _SURELY_REVERSED * deviation < 0.0 and moved > _EXCITED * np.linalg.norm(change)
    ]
    if against:
        raise FitError(
            f"{', '.join(against)} by the prior matrix is opposite to the expected force, other components are not; "
            f"{setup.check_axes}"
        )
