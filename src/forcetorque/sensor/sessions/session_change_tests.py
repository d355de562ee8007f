# SPDX-License-Identifier: BSD-3-Clause
"""Regression of readings on expected loads with an offset and a gain of every session, and tests of their changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import Regression, Timeline, half_width, regress

LEAST_KNOWN_GAIN = 0.1
"""Half-width of the 95 % interval of a gain above which a session does not determine it."""
ERROR_RATE = 0.01
"""Nominal rate at which any change at all is reported of a sensor that did not change (Holm). By simulation of sessions
of 120 s it is 1 % under white noise, 5 % under slow noise that forgets itself in 10 s, and 11 % in 30 s."""

_STANDS_STILL = 1e-4
"""Part of the largest load about its mean below which a load counts as constant."""
_CROSS_SHARE = 0.02
"""Part of the largest motion of other loads below which their cross-talk is left out."""
_ROUNDING = 1e-9
"""Change of readings without noise that is no more than rounding; N, N m, or of a gain."""
_LEVER_M = 0.1
"""Lever by which moments are compared with forces, to choose directions of cross-talk; m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SessionMeans(ArrayRecord):
    """Means over windows of all sessions of one sensor; n windows, s sessions."""

    line: Timeline
    """When they were taken."""
    session: IntArray = field(metadata=array("n", dtype="int"))
    """Number of the session of each, from 0 to s - 1, every one with some; shape (n,)."""
    measured: FloatArray = field(metadata=array("n", 6))
    """Readings without any offset removed; shape (n, 6); N, N m."""
    expected: FloatArray = field(metadata=array("n", 6))
    """What a sensor without error reads; shape (n, 6); N, N m."""

    @property
    def sessions(self) -> int:
        """Number of sessions."""
        return int(self.session.max()) + 1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SessionFit(ArrayRecord):
    """One component in s sessions: reading = expected + offset + (gain - 1) (expected - mean load) + cross-talk."""

    mean_load: float
    """Expected reading at which the offsets hold, the mean of all sessions; N or N m."""
    offset: FloatArray = field(metadata=array("s"))
    """Reading less expected reading at the mean load; shape (s,); N or N m."""
    offset_half_width: FloatArray = field(metadata=array("s"))
    """Half-widths of 95 % intervals; shape (s,); infinite where not determined."""
    gain: FloatArray = field(metadata=array("s"))
    """Change of the reading per change of the load; shape (s,); 1."""
    gain_half_width: FloatArray = field(metadata=array("s"))
    """Half-widths of 95 % intervals; shape (s,); infinite where the gain is not one of this session."""
    gain_session: IntArray = field(metadata=array("s", dtype="int"))
    """Session whose gain each has: itself, another that determines it, or -1 for a gain of 1; shape (s,)."""
    covariance: FloatArray = field(metadata=array("p", "p"))
    """Of offsets and fitted gains; shape (p, p)."""
    degrees_of_freedom: FloatArray = field(metadata=array("p"))
    """Of Student's t; shape (p,)."""
    gain_column: IntArray = field(metadata=array("s", dtype="int"))
    """Which of the p coefficients is the gain of each session, -1 for none; shape (s,)."""

    def change(self, first: int, second: int, *, of_gain: bool) -> Change | None:
        """Compare two sessions.

        Args:
            first: The earlier session.
            second: The later session.
            of_gain: Whether gains are compared, not offsets.

        Returns:
            The change; None where one of the gains is not that of its session.
        """
        columns = (first, second)
        values = self.offset
        if of_gain:
            if any(self.gain_session[session] != session for session in columns):
                return None
            columns = int(self.gain_column[first]), int(self.gain_column[second])
            values = self.gain
        contrast = np.zeros(len(self.covariance))
        contrast[list(columns)] = -1.0, 1.0
        error = max(float(contrast @ self.covariance @ contrast), 0.0) ** 0.5
        freedom = float(self.degrees_of_freedom[list(columns)].min())
        return Change(float(values[second] - values[first]), error, freedom)


@dataclass(frozen=True, slots=True)
class Change:
    """The change of an offset or a gain from one session to another."""

    size: float
    """N, N m, or 1 of a gain."""
    standard_error: float
    """Its standard error; infinite where not determined."""
    degrees_of_freedom: float
    """Of Student's t; 0 for none."""

    @property
    def half_width(self) -> float:
        """Half of its 95 % interval."""
        return float(half_width(np.array([self.standard_error]), np.array([self.degrees_of_freedom]))[0])

    @property
    def p_value(self) -> float:
        """Probability of a change at least as large where there is none."""
        from scipy.special import stdtr  # here because importing it takes longer than most commands

        if not self.degrees_of_freedom > 0.0 or not self.standard_error < np.inf:
            return 1.0
        if self.standard_error == 0.0:  # readings without noise
            return float(abs(self.size) <= _ROUNDING)
        return float(2.0 * stdtr(self.degrees_of_freedom, -abs(self.size) / self.standard_error))


def holm(p_values: Sequence[float], error_rate: float = ERROR_RATE) -> BoolArray:
    """Choose what differs from noise, so that any false choice at all is as rare as stated (Holm's procedure).

    Args:
        p_values: Probability of each under noise alone.
        error_rate: Rate of any false choice.

    Returns:
        Which are chosen; shape (number of p_values,).
    """
    values = np.asarray(p_values, dtype=np.float64)
    order = np.argsort(values, kind="stable")
    passed = values[order] <= error_rate / (len(values) - np.arange(len(values)))
    chosen = np.zeros(len(values), dtype=bool)
    chosen[order[: len(values) if passed.all() else int(passed.argmin())]] = True
    return chosen


def fit_sessions(means: SessionMeans, component: int) -> SessionFit:
    """Fit offsets and gains of one component.

    Cross-talk of the other components is the same in all sessions. A session whose load hardly moves, or determines its
    gain worse than `LEAST_KNOWN_GAIN`, takes the gain of the session that determines it best; without any it is 1.

    Args:
        means: Means of all sessions.
        component: Index of the component, 0 to 5.

    Returns:
        Offsets and gains with intervals; noise is white and slow (`regress`).

    Raises:
        FitError: If there are too few means.
    """
    own = means.expected[:, component]
    mean_load = float(own.mean())
    load = own - mean_load
    indicators = (means.session[:, None] == np.arange(means.sessions)).astype(np.float64)
    apart = load - indicators @ ((indicators.T @ load) / indicators.sum(axis=0))
    spread = np.sqrt(indicators.T @ apart**2 / indicators.sum(axis=0))
    moves = spread > _STANDS_STILL * max(float(np.abs(own).max()), 1e-12)
    gain_session = _gains_by(np.where(moves, 1.0 / np.where(moves, spread, 1.0), np.inf), np.inf)
    error = means.measured[:, component] - own
    fit, widths, column = _regression(means, component, indicators, load, error, gain_session)
    loose = _gains_by(np.where(gain_session == np.arange(means.sessions), widths, np.inf), LEAST_KNOWN_GAIN)
    if not np.array_equal(loose, gain_session):
        gain_session = loose
        fit, widths, column = _regression(means, component, indicators, load, error, gain_session)
    s, used = means.sessions, means.sessions + len(set(gain_session.tolist()) - {-1})
    coefficients = fit.coefficients[0]
    return SessionFit(
        mean_load=mean_load,
        offset=coefficients[:s],
        offset_half_width=fit.half_width[0, :s],
        gain=1.0 + np.where(column >= 0, coefficients[column], 0.0),
        gain_half_width=np.where(gain_session == np.arange(s), widths, np.inf),
        gain_session=gain_session,
        covariance=fit.covariance[0, :used, :used],
        degrees_of_freedom=fit.degrees_of_freedom[0, :used],
        gain_column=column,
    )


def _gains_by(width: FloatArray, most: float) -> IntArray:
    """Session whose gain every session has: its own if its width is below the most, else that of the narrowest."""
    known = width < most
    narrowest = int(np.argmin(width)) if known.any() else -1
    return np.where(known, np.arange(len(width)), narrowest)


def _regression(
    means: SessionMeans,
    component: int,
    indicators: FloatArray,
    load: FloatArray,
    error: FloatArray,
    gain_session: IntArray,
) -> tuple[Regression, FloatArray, IntArray]:
    """The regression, half-widths of the gain that each session has, and the coefficient that it is."""
    fitted = sorted(set(gain_session.tolist()) - {-1})
    gains = [load * (indicators @ (gain_session == one)) for one in fitted]
    design = np.column_stack([indicators, *gains])
    design = np.hstack([design, _cross_talk(np.delete(means.expected, component, axis=1), component, design)])
    if len(design) <= 2 * design.shape[1]:
        raise FitError(
            f"expected more than {2 * design.shape[1]} means over windows to fit {design.shape[1]} coefficients of "
            f"{means.sessions} sessions, got {len(design)}; record longer, or join sessions"
        )
    fit = regress(means.line, design, error[:, None])
    column = np.array([-1 if one < 0 else means.sessions + fitted.index(one) for one in gain_session.tolist()])
    widths = np.where(column >= 0, fit.half_width[0, column], np.inf)
    return fit, widths, column


def _cross_talk(others: FloatArray, component: int, design: FloatArray) -> FloatArray:
    """Directions of the other loads whose cross-talk the data separate from what is fitted; shape (n, d)."""
    lever = np.delete(np.repeat([1.0, 1.0 / _LEVER_M], 3), component)
    moved = (others - others.mean(axis=0)) * lever
    left = moved - design @ np.linalg.lstsq(design, moved, rcond=None)[0]
    _, sizes, directions = np.linalg.svd(left, full_matrices=False)
    largest = float(np.sqrt((moved**2).sum(axis=0)).max(initial=0.0))
    return np.asarray(moved @ directions[sizes > max(_CROSS_SHARE * largest, 1e-9)].T, dtype=np.float64)
