# SPDX-License-Identifier: BSD-3-Clause
"""The lag between a thermal pad and the taxels beside it: its estimate, and the filter that removes it."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only

_LATE_S: Final = (3.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 90.0)
LAGS_S: Final = (*(-lag for lag in reversed(_LATE_S)), 0.0, *_LATE_S)
"""Lags that are tried; s."""
LEAST_LAG_S: Final = 2.0
"""Smaller lags are none: pads are averaged over as much; s."""
LAG_SD: Final = 4.0
"""Standard deviations by which the lag of a pad must differ from that of the others to be its own."""
_SD_OF_MEDIAN: Final = 1.2533
"""Standard deviation of a median of many normal deviates, over that of their mean."""


def lagged(seconds: FloatArray, values: FloatArray, lag_s: float) -> FloatArray:
    """Let values pass a first-order lag, from equilibrium at the first one.

    Args:
        seconds: Times, increasing; shape (k,); s.
        values: Values; shape (k, ...).
        lag_s: Time constant; 0 changes nothing; s.

    Returns:
        What follows them that much later; shape (k, ...).
    """
    if lag_s == 0.0:
        return values
    followed = np.array(values, dtype=np.float64)
    shares = -np.expm1(-np.diff(seconds) / lag_s)
    for row, share in enumerate(shares.tolist(), start=1):
        followed[row] = followed[row - 1] + share * (0.5 * (values[row - 1] + values[row]) - followed[row - 1])
    return followed


def pad_lags(
    instants: FloatArray, taxels: FloatArray, pads: FloatArray, follows: BoolArray, *, averaged: int
) -> FloatArray:
    """Estimate by how much each pad lags the taxels that follow it.

    Of the lags of a grid the one counts for which pad and taxels agree best, each taxel with a gain of its own. Noise
    that the lag itself takes away is put back, so that it is no reason for one. Pads of one patch are built alike: a
    pad whose lag does not differ from the median by more than its error has the median.

    Args:
        instants: Times of means of messages; shape (k,); s.
        taxels: Means of taxels; shape (k, n); counts.
        pads: Means of pads; shape (k, t); counts.
        follows: Whether each taxel is valid and follows each pad; shape (n, t).
        averaged: Means that are averaged once more before they are compared.

    Returns:
        Time constant of a first-order lag of each pad behind its taxels, negative where the pad leads; 0 where none is
        separable from noise; shape (t,); s.
    """
    squares = np.array([_squares(instants, taxels, pads, follows, lag, averaged) for lag in LAGS_S])  # (g, t, 2)
    number = len(instants) // averaged
    found = [_lag(squares[:, pad, 0], squares[:, pad, 1], number) for pad in range(pads.shape[1])]
    lags, sd = np.array(found).T
    followed = follows.any(axis=0)
    if not followed.any():
        return np.zeros(len(lags))
    usual = float(np.median(lags[followed]))
    if abs(usual) <= LAG_SD * _SD_OF_MEDIAN * float(np.median(sd[followed])) / np.sqrt(np.count_nonzero(followed)):
        usual = 0.0
    lags = np.where(np.abs(lags - usual) > LAG_SD * sd, lags, usual)
    return np.where(followed & (np.abs(lags) >= LEAST_LAG_S), lags, 0.0)


def means_of(values: FloatArray, averaged: int) -> FloatArray:
    """Average rows.

    Args:
        values: Rows; shape (k, ...).
        averaged: Rows that are averaged to one; those that are left over at the end are left out.

    Returns:
        Means; shape (k // averaged, ...).
    """
    whole = len(values) // averaged * averaged
    return values[:whole].reshape(-1, averaged, *values.shape[1:]).mean(axis=1)


def _squares(
    instants: FloatArray, taxels: FloatArray, pads: FloatArray, follows: BoolArray, lag_s: float, averaged: int
) -> FloatArray:
    """Mean square that each pad leaves of its taxels at a lag, and how much of that is not noise; shape (t, 2)."""
    impulses = np.zeros((len(instants), averaged))
    impulses[averaged + np.arange(averaged), np.arange(averaged)] = 1.0
    both = []
    for values, own_s in ((taxels, max(lag_s, 0.0)), (pads, max(-lag_s, 0.0))):
        means = means_of(lagged(instants, values, own_s), averaged)
        # what such means keep of the variance of white noise
        kept = float((means_of(lagged(instants, impulses, own_s), averaged) ** 2).sum())
        both.append((means - means.mean(axis=0), kept * np.mean(np.diff(values, axis=0) ** 2, axis=0) / 2.0))
    (y, y_noise), (x, x_noise) = both
    gains = (x.T @ y) / (x**2).sum(axis=0)[:, None]  # (t, n)
    left = (y**2).mean(axis=0) - gains**2 * (x**2).mean(axis=0)[:, None]
    more = left - y_noise - gains**2 * x_noise[:, None]
    number = np.maximum(follows.sum(axis=0), 1)
    return np.stack([(one * follows.T).sum(axis=1) / number for one in (left, more)], axis=1)


def _lag(left: FloatArray, more: FloatArray, number: int) -> tuple[float, float]:
    """Lag at which the least is left beyond noise, and its standard deviation; at an end of the grid that end."""
    best = int(more.argmin())
    if best in (0, len(LAGS_S) - 1):
        return LAGS_S[best], 0.0
    near = slice(best - 1, best + 2)
    bend, slope, _ = np.polyfit(LAGS_S[near], more[near], 2)
    return float(-slope / (2.0 * bend)), float(np.sqrt(left[best] / number / bend))


PADS_S: Final = 2.0
"""Time constant over which pads are averaged at least: their noise is common to ten taxels, and heat is slow; s."""
LATE_PADS: Final = 1.25
"""Time constant over which a pad that lags is averaged, over the square root of its lag; sqrt(s).

The trend that makes up for the lag then has the same noise at every lag."""


class PadFilter:
    """Follows t thermal pads: those that lead are held back, those that lag are continued along their trend.

    A first-order lag is made up for; until a trend is seen, which takes about `LATE_PADS` sqrt(lag), it is not.
    """

    def __init__(self, lags: FloatArray) -> None:
        """Begin with nothing.

        Args:
            lags: Lag of each pad behind its taxels, negative where it leads; shape (t,); s.
        """
        self.lags = read_only(lags, name="lags", shape=(None,))
        self._constants = np.maximum(PADS_S, np.where(lags > 0.0, LATE_PADS * np.sqrt(np.maximum(lags, 0.0)), -lags))
        self._once: FloatArray | None = None
        self._twice: FloatArray | None = None

    def follow(self, passed: float, now: FloatArray) -> FloatArray:
        """Take the next readings.

        Args:
            passed: Time since the ones before; s.
            now: Readings; shape (t,); counts.

        Returns:
            What the pads would read if they followed heat when their taxels do; shape (t,); counts.
        """
        if self._once is None or self._twice is None:
            self._once = self._twice = now
        share = self._share(passed)
        self._once = self._once + share * (now - self._once)
        self._twice = self._twice + share * (self._once - self._twice)
        ahead = self._once + (1.0 + self._lead(passed)) * (self._once - self._twice)
        return np.where(self.lags > 0.0, ahead, self._once)

    def noise(self, passed: float, sd: FloatArray) -> FloatArray:
        """Give the noise of what follows pads that lag; that of others is less than their own, and taken as none.

        Args:
            passed: Time from one reading to the next; s.
            sd: Standard deviation of each reading; shape (t,); counts.

        Returns:
            Standard deviation; shape (t,); counts.
        """
        share = self._share(passed)
        kept = 1.0 - (1.0 - share) ** 2
        once, twice = 2.0 + self._lead(passed), 1.0 + self._lead(passed)
        with np.errstate(divide="ignore", invalid="ignore"):
            variance = (
                once**2 * share**2 / kept
                - 2.0 * once * twice * share**3 / kept**2
                + twice**2 * share**4 * (2.0 - kept) / kept**3
            )
        return np.where((self.lags > 0.0) & (share > 0.0), sd * np.sqrt(np.maximum(variance, 0.0)), 0.0)

    def _share(self, passed: float) -> FloatArray:
        return -np.expm1(-passed / self._constants)

    def _lead(self, passed: float) -> FloatArray:
        """Lag of each pad, over the time by which one average is behind the other."""
        share = self._share(passed)
        behind = np.where(
            share > 0.0, passed * (1.0 - share) / np.maximum(share, np.finfo(float).tiny), self._constants
        )
        return np.maximum(self.lags, 0.0) / np.maximum(behind, np.finfo(float).tiny)
