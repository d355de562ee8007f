# SPDX-License-Identifier: BSD-3-Clause
"""Second moments of the windows: they add up over any number of recordings and do not grow with their length."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.joint.unknowns import CHANGES, UNITS
from forcetorque.calibration.joint.windows import PartWindows
from forcetorque.experiment.calibration.assumptions import LOADS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartSums:
    """Moments of the windows of one part in one recording and session; p coefficients, one set per row."""

    part: str
    """Name of the part."""
    recording: str
    """The recording."""
    session: str
    """The session."""
    sensors: tuple[str, ...]
    """Its k sensors."""
    terms: tuple[str, ...]
    """Names of the errors of the model that it depends on."""
    products: FloatArray
    """Products of the coefficients; shape (6, p, p)."""
    shared: FloatArray
    """Products of coefficients and right side; shape (6, p)."""
    square: FloatArray
    """Square of the right side; shape (6,)."""
    noise: FloatArray
    """What noise of the readings adds to the products of the changes; shape (6, 36 k, 36 k)."""
    common: FloatArray
    """What makes the common scale of its sensors and masses, each by its share of what is added up; shape (p,)."""
    count: float
    """Number of windows."""

    def rest(self, unknowns: FloatArray) -> FloatArray:
        """Give the mean square of what unknowns leave of the right side.

        Args:
            unknowns: Values of the coefficients; shape (p,).

        Returns:
            For every row; shape (6,).
        """
        left = self.square - 2.0 * self.shared @ unknowns + unknowns @ self.products @ unknowns
        return np.maximum(left / self.count, 0.0)


def part_sums(windows: Iterable[PartWindows]) -> list[PartSums]:
    """Add windows up.

    Args:
        windows: Windows of parts; those of one part in one recording have the noise of that recording.

    Returns:
        Their moments; none of windows of which nothing is left.
    """
    return [_summed(one) for one in windows if len(one)]


def _summed(windows: PartWindows) -> PartSums:
    stretch = windows.stretch
    k, p = len(windows.sensors), LOADS * len(windows.sensors) + CHANGES * len(windows.sensors) + len(windows.terms)
    products, shared = np.zeros((LOADS, p, p)), np.zeros((LOADS, p))
    spread = np.zeros((k, LOADS, LOADS, LOADS))
    for block in windows.blocks():
        columns = block.columns.transpose(1, 2, 0)  # a row, a coefficient, a window
        products += columns @ columns.transpose(0, 2, 1)
        shared += (columns @ block.right.T[:, :, None])[..., 0]
        spread += block.spread.sum(axis=0)
    noise = np.zeros((LOADS, CHANGES * k, CHANGES * k))
    for number, name in enumerate(windows.sensors):
        covariance = noise_covariance(stretch.readings[name] / UNITS)
        own = slice(CHANGES * number, CHANGES * (number + 1))
        by_row = np.einsum("iab,cd->iacbd", spread[number], covariance)
        noise[:, own, own] = by_row.reshape(LOADS, CHANGES, CHANGES)
    return PartSums(
        part=windows.part,
        recording=stretch.recording,
        session=stretch.session,
        sensors=windows.sensors,
        terms=windows.terms,
        products=products,
        shared=shared,
        square=(windows.right**2).sum(axis=0),
        noise=noise,
        common=_common(windows),
        count=float(len(windows)),
    )


def _common(windows: PartWindows) -> FloatArray:
    """Share of every coefficient in the common scale: gains of sensors by their loads, masses by what they demand."""
    gains = np.concatenate([share * np.eye(LOADS).ravel() / LOADS for share in windows.load_shares[:-1]])
    masses = windows.load_shares[-1] * windows.mass_shares
    return np.concatenate([gains, np.zeros(LOADS * len(windows.sensors)), masses])


def noise_covariance(readings: FloatArray) -> FloatArray:
    """Estimate the white noise of readings by how they bend from sample to sample.

    Args:
        readings: Readings; shape (n, 6); NaN in gaps.

    Returns:
        Covariance of the noise of a sample; shape (6, 6); zero for less than ten bends.
    """
    bends = np.diff(readings, n=2, axis=0)
    bends = bends[np.isfinite(bends).all(axis=1)]
    if len(bends) < 10:
        return np.zeros((LOADS, LOADS))
    # samples that are held, or quantised, bend by nothing, and knocks by much
    kept = (np.abs(bends) <= 3.0 * np.quantile(np.abs(bends), 0.7, axis=0) + 1e-12).all(axis=1)
    bends = bends[kept]
    return bends.T @ bends / max(len(bends), 1) / 6.0  # a second difference has six variances
