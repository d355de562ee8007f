# SPDX-License-Identifier: BSD-3-Clause
"""What a joint fit knows of one of its sensors, in the form that every calibration has.

A joint fit writes the wrench by the reading, (1 + D) y + o; a calibration writes the reading by the wrench,
(1 + E) wrench + e with 1 + E = (1 + D)^-1 and e = -(1 + E) o. To first order the errors of one are linear in those of
the other. Rows of a calibration are independent, those of a joint fit are not: what they share is in `JointPosterior`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.generative.rows import LOADS
from forcetorque.calibration.joint.fit import JointFit
from forcetorque.calibration.joint.windows import UNITS
from forcetorque.calibration.posterior import Posterior, RowNoise


def sensor_posterior(
    fit: JointFit,
    sensor: str,
    sessions: Sequence[str],
    *,
    noise: FloatArray,
    repeatability: float,
    mean_loads: FloatArray,
) -> Posterior:
    """Give mean and covariance of what is unknown of a sensor.

    Args:
        fit: The fit of all sensors.
        sensor: One of them.
        sessions: Its sessions, the last of them last.
        noise: Noise of means over a second; shape (6,); N, N m.
        repeatability: Share of its response by which the sensor differs from one motion to the next.
        mean_loads: Mean load of every session; shape (sessions, 6); N, N m.

    Returns:
        The same by rows, in wrench space.
    """
    factor = np.asarray(np.linalg.inv(fit.change(sensor)), dtype=np.float64)
    offsets = np.stack([fit.offset(sensor, session) for session in sessions])
    jacobian = _jacobian(factor, offsets)
    places = fit.places
    spans = (places.changes(sensor), *(places.offset(sensor, session) for session in sessions))
    own = np.concatenate([np.arange(span.start, span.stop) for span in spans])
    size = np.outer(UNITS, 1.0 / UNITS).ravel()
    units = np.concatenate([size, np.tile(UNITS, len(sessions))])
    joint = jacobian @ (fit.covariance[np.ix_(own, own)] * np.outer(units, units)) @ jacobian.T
    rows = [_places_of_row(row, len(sessions)) for row in range(LOADS)]
    covariance = np.stack([joint[np.ix_(row, row)] for row in rows])
    learnt = covariance[:, :LOADS, :LOADS].copy()
    before = fit.prior_covariance(sensor) * np.outer(size, size)
    return Posterior(
        space="wrench",
        variables=(),
        sessions=tuple(sessions),
        drift=False,
        mean=np.c_[factor - np.eye(LOADS), -factor @ offsets.T],
        covariance=covariance + _repeatability(repeatability, mean_loads),
        learnt_covariance=learnt,
        prior_covariance=np.stack([before[np.ix_(row[:LOADS], row[:LOADS])] for row in rows]),
        to_wrench=fit.change(sensor),
        noise=tuple(RowNoise(white=float(one), time_constant_s=0.0, ratio=0.0) for one in noise),
        accuracy=np.zeros(LOADS),
        repeatability=repeatability,
        load_centre=mean_loads.mean(axis=0),
    )


def _jacobian(factor: FloatArray, offsets: FloatArray) -> FloatArray:
    """Derivative of [E row by row, e of every session] by [D row by row, o of every session]."""
    changes, sessions = LOADS * LOADS, len(offsets)
    jacobian = np.zeros((changes + LOADS * sessions,) * 2)
    jacobian[:changes, :changes] = -np.kron(factor, factor.T)
    for number, offset in enumerate(offsets):
        own = slice(changes + LOADS * number, changes + LOADS * (number + 1))
        # e = -(1 + E) o
        jacobian[own, :changes] = -np.kron(np.eye(LOADS), offset) @ jacobian[:changes, :changes]
        jacobian[own, own] = -factor
    return jacobian


def _places_of_row(row: int, sessions: int) -> list[int]:
    changes = LOADS * LOADS
    return [*range(LOADS * row, LOADS * (row + 1)), *(changes + LOADS * k + row for k in range(sessions))]


def _repeatability(share: float, mean_loads: FloatArray) -> FloatArray:
    """Covariance by motions in which the sensor answers otherwise, about the mean load of each session."""
    jacobian = np.r_[np.eye(LOADS), -mean_loads]
    return np.stack([jacobian @ np.diag(row**2) @ jacobian.T for row in share * np.outer(UNITS, 1.0 / UNITS)])
