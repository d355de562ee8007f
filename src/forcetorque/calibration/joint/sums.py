# SPDX-License-Identifier: BSD-3-Clause
"""Second moments of the windows: they add up over any number of recordings and do not grow with their length."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.calibration.joint.model_error import ErrorTerm
from forcetorque.calibration.joint.windows import UNITS, PartWindows
from forcetorque.experiment.calibration.assumptions import LOADS

_CHANGES = 36


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
    k, p = len(windows.sensors), LOADS * len(windows.sensors) + _CHANGES * len(windows.sensors) + len(windows.terms)
    products, shared = np.zeros((LOADS, p, p)), np.zeros((LOADS, p))
    spread = np.zeros((k, LOADS, LOADS, LOADS))
    for block in windows.blocks():
        columns = block.columns.transpose(1, 2, 0)  # a row, a coefficient, a window
        products += columns @ columns.transpose(0, 2, 1)
        shared += (columns @ block.right.T[:, :, None])[..., 0]
        spread += block.spread.sum(axis=0)
    noise = np.zeros((LOADS, _CHANGES * k, _CHANGES * k))
    for number, name in enumerate(windows.sensors):
        covariance = noise_covariance(stretch.readings[name] / UNITS)
        own = slice(_CHANGES * number, _CHANGES * (number + 1))
        by_row = np.einsum("iab,cd->iacbd", spread[number], covariance)
        noise[:, own, own] = by_row.reshape(LOADS, _CHANGES, _CHANGES)
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Where the unknowns stand: changes of every sensor, offsets by session, errors of the model."""

    sensors: tuple[str, ...]
    """Sensors."""
    offsets: Mapping[tuple[str, str], int]
    """Number of the offset of a sensor in a session."""
    terms: tuple[ErrorTerm, ...]
    """Errors of the model."""

    @classmethod
    def of(cls, sums: Sequence[PartSums], terms: Sequence[ErrorTerm]) -> Places:
        """Lay out the unknowns of equations.

        Args:
            sums: Moments of the equations.
            terms: Errors of the model.

        Returns:
            The places.
        """
        pairs = dict.fromkeys((name, one.session) for one in sums for name in one.sensors)
        return cls(
            sensors=tuple(dict.fromkeys(name for name, _ in pairs)),
            offsets={pair: number for number, pair in enumerate(pairs)},
            terms=tuple(terms),
        )

    def __len__(self) -> int:
        return _CHANGES * len(self.sensors) + LOADS * len(self.offsets) + len(self.terms)

    def changes(self, sensor: str) -> slice:
        """Give the places of the changes of a sensor, row by row.

        Args:
            sensor: The sensor.

        Returns:
            36 places.
        """
        start = _CHANGES * self.sensors.index(sensor)
        return slice(start, start + _CHANGES)

    def offset(self, sensor: str, session: str) -> slice:
        """Give the places of an offset.

        Args:
            sensor: The sensor.
            session: The session.

        Returns:
            Six places.
        """
        start = _CHANGES * len(self.sensors) + LOADS * self.offsets[sensor, session]
        return slice(start, start + LOADS)

    @property
    def errors(self) -> slice:
        """The places of the errors of the model."""
        return slice(len(self) - len(self.terms), len(self))

    def of_part(self, sensors: Sequence[str], session: str, terms: Sequence[str]) -> IntArray:
        """Give the places of the coefficients of a part.

        Args:
            sensors: Its sensors.
            session: The session.
            terms: Names of the errors of the model that it depends on.

        Returns:
            Places in the order of the coefficients; shape (p,).
        """
        own = [self.changes(name) for name in sensors]
        own += [self.offset(name, session) for name in sensors]
        numbers = {term.name: number for number, term in enumerate(self.terms, start=self.errors.start)}
        return np.concatenate(
            [*(np.arange(s.start, s.stop) for s in own), np.array([numbers[name] for name in terms], dtype=np.int64)]
        )
