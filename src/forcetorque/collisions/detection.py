# SPDX-License-Identifier: BSD-3-Clause
"""Contacts as spans in which the residual is larger than errors and noise let it be.

The statistic of a window is the squared residual over its covariance. Its threshold follows from the stated rate of
false alarms: by the F distribution, for the size of the noise is known from few independent samples, and by how the
largest values of the free samples are distributed, whose tails are heavier (peaks over a threshold with an exponential
tail); the higher counts.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.collisions.contact_free_model import FreeChanges
from forcetorque.collisions.sensor_residual import TOGETHER, WINDOW_S, Level, Signals
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS

RELEASE: Final = 0.25
"""Share of the threshold below which a contact is over."""
HOLD_S: Final = 0.2
"""Time below it after which it is."""
LONGEST_S: Final = 20.0
"""Length from which a contact is taken for a new level: the sensor stepped, or something leans on the robot."""
NOTICED: Final = 0.95
"""Probability with which the smallest force is noticed in the direction in which the sensor knows least."""
_SLOW_S: Final = 1.0
"""Time that slow noise goes on at least, which vibration may hide; s."""
_BLOCK_S: Final = 1.0
"""Length of the blocks whose largest values show the tail; s."""
_HIGH: Final = 0.8
"""Share of the blocks below the values that show it."""
_FEWEST: Final = 8
"""Values that it takes at least."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Threshold:
    """Threshold of the statistic."""

    value: float
    """Statistic from which a window is a contact."""
    by_tail: float | None
    """The same by the tail of the free samples; None of too few."""
    alarms_per_hour: float
    """Rate of false alarms that it is for."""
    free_s: float
    """Time of the free samples that it is from; s."""


def threshold_of(
    statistic: FloatArray, correlation_s: float, *, alarms_per_hour: float, components: int = LOADS
) -> Threshold:
    """Set the threshold for a rate of false alarms.

    Args:
        statistic: Of free windows, in the order of time; shape (w,).
        correlation_s: Time over which noise goes on; s.
        alarms_per_hour: Rate of false alarms; above 0.
        components: Components of the residual that the statistic is of.

    Returns:
        The threshold.
    """
    from scipy.special import betaincinv  # scipy.stats is slow to import

    tests = 3600.0 / max(correlation_s, WINDOW_S)
    independent = len(statistic) * WINDOW_S / max(correlation_s, _SLOW_S)
    freedom = components * max(independent - 1.0, 1.0)
    share = float(betaincinv(0.5 * freedom, 0.5 * components, min(alarms_per_hour / tests, 0.5)))
    by_law = freedom * (1.0 - share) / share  # `components` times the upper quantile of the F distribution
    blocks = np.array_split(statistic, max(round(len(statistic) * WINDOW_S / _BLOCK_S), 1))
    largest = np.array([block.max() for block in blocks if len(block)])
    by_tail = None
    if len(largest) * (1.0 - _HIGH) >= _FEWEST:
        high = float(np.quantile(largest, _HIGH))
        scale = float((largest[largest > high] - high).mean())
        per_hour = 3600.0 / _BLOCK_S * float(np.mean(largest > high))
        by_tail = high + scale * float(np.log(max(per_hour / alarms_per_hour, 1.0)))
    return Threshold(
        value=max(by_law, by_tail or 0.0),
        by_tail=by_tail,
        alarms_per_hour=alarms_per_hour,
        free_s=len(statistic) * WINDOW_S,
    )


class Release:
    """The rule that ends a contact: the statistic stays below `RELEASE` of its threshold for `HOLD_S`."""

    def __init__(self) -> None:
        """Begin with a contact."""
        self.quiet = 0
        """Windows below it, up to the last one."""

    def follows(self, over_threshold: float) -> bool:
        """Take the next window.

        Args:
            over_threshold: Its statistic over the threshold.

        Returns:
            Whether the contact is over; its last `quiet` windows are none of it.
        """
        self.quiet = self.quiet + 1 if over_threshold < RELEASE else 0
        return self.quiet * WINDOW_S >= HOLD_S


@dataclass(slots=True, kw_only=True, eq=False)
class Contact:
    """A span in which something touches the robot beyond a sensor."""

    windows: list[int] = field(default_factory=list)
    """Numbers of its windows."""
    wrenches: list[FloatArray] = field(default_factory=list)
    """What the sensor reads too much in each; shape (6,) each; N, N m."""
    covariances: list[FloatArray] = field(default_factory=list)
    """Its covariance; shape (6, 6) each."""
    statistics: list[float] = field(default_factory=list)
    """Statistic of each."""
    stays: bool = False
    """Whether it was still there after `LONGEST_S`, or at the end of the readings."""

    @property
    def strongest(self) -> int:
        """Place of the window with the largest force."""
        return int(np.argmax([np.linalg.norm(wrench[:3]) for wrench in self.wrenches]))


def detect(
    signals: Signals, model: FreeChanges, threshold: float
) -> tuple[tuple[Contact, ...], FloatArray, FloatArray]:
    """Look for contacts.

    Args:
        signals: Windows of a sensor.
        model: What changes of the residual are without a contact.
        threshold: Threshold of the statistic.

    Returns:
        Contacts in the order of time; what the sensor reads too much in every window, the level held during contacts,
        NaN while there is no level, shape (w, 6), N, N m; its covariance without a contact, of the k windows with a
        level, shape (k, 6, 6).
    """
    level, excess = Level(signals), np.full((len(signals), LOADS), np.nan)
    covariances: list[FloatArray] = []
    contacts: list[Contact] = []
    current: Contact | None = None
    release = Release()
    starts = signals.starts()

    def close(contact: Contact, *, stays: bool) -> None:
        contact.stays = stays
        for values in (contact.windows, contact.wrenches, contact.covariances, contact.statistics):
            del values[len(values) - release.quiet :]
        contacts.append(contact)

    first = 0
    while first < len(signals):
        if starts[first] and current is not None:
            close(current, stays=True)
            current = None
        held, before = current is not None, copy(level)
        end = first + 1 if held else min(first + TOGETHER, len(signals))
        windows, wrenches, spreads, values = _compared(level, range(first, end), model, held=held)
        if not held and (over := np.flatnonzero(values > threshold)).size:
            level, end = before, int(windows[over[0]]) + 1  # what follows it is compared with the level held
            windows, wrenches, spreads, values = _compared(level, range(first, end), model, held=False)
            current, release = Contact(), Release()
        first = end
        excess[windows] = wrenches
        covariances.append(spreads)
        if current is None or not len(windows):
            continue
        current.windows.append(int(windows[-1]))
        current.wrenches.append(wrenches[-1])
        current.covariances.append(spreads[-1])
        current.statistics.append(float(values[-1]))
        if release.follows(current.statistics[-1] / threshold):
            close(current, stays=False)
            current = None
        elif len(current.windows) * WINDOW_S >= LONGEST_S:
            close(current, stays=True)
            current = None
            level.restart()
    if current is not None:
        close(current, stays=True)
    return tuple(contacts), excess, np.concatenate([*covariances, np.zeros((0, LOADS, LOADS))])


def _compared(
    level: Level, windows: range, model: FreeChanges, *, held: bool
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """The k windows that have a level; what each reads too much, shape (k, 6), its covariance, and its statistic."""
    changes, known = level.changes(windows.start, windows.stop, held=held)
    wrenches, covariances = model.wrench(changes if known.all() else changes[known])
    return np.array(windows)[known], wrenches, covariances, _squared(wrenches, covariances)


def _squared(wrenches: FloatArray, covariances: FloatArray) -> FloatArray:
    """Squares over covariances; shape (w,)."""
    return np.einsum("wi,wi->w", wrenches, np.linalg.solve(covariances, wrenches[..., None])[..., 0])


def statistics_of(changes: FloatArray, model: FreeChanges) -> FloatArray:
    """Give the statistic of windows.

    Args:
        changes: Changes of their columns; shape (w, 12 + 6 q).
        model: What these are without a contact.

    Returns:
        Statistics; shape (w,).
    """
    return _squared(*model.wrench(changes))


def noticed_square(threshold: float) -> float:
    """Give the squared size over its covariance that a single window notices with a probability of `NOTICED`.

    Args:
        threshold: Threshold of the statistic.

    Returns:
        The square.
    """
    from scipy.optimize import brentq
    from scipy.special import chndtr

    return float(
        brentq(lambda square: 1.0 - float(chndtr(threshold, LOADS, square)) - NOTICED, 0.0, 2.0 * threshold + 200.0)
    )


def smallest_force(covariances: FloatArray, threshold: float) -> float:
    """Give the force that a single window notices with a probability of `NOTICED`, wherever and however it acts.

    Args:
        covariances: Covariances of what a sensor reads without a contact; shape (w, 6, 6).
        threshold: Threshold of the statistic.

    Returns:
        Median over the windows; N.
    """
    of_force = covariances[:, :3, :3]
    return float(np.median(np.sqrt(noticed_square(threshold) * np.linalg.eigvalsh(of_force)[:, -1])))
