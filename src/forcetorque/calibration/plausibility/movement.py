# SPDX-License-Identifier: BSD-3-Clause
"""How measured and expected wrench move together within data sets: what the plausibility checks compare."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.experiment.calibration.moments import DataSet, Moments, symmetric_pseudo_inverse

_SHARED = 0.5
"""Share of the movement of the reference that neighbouring samples have in common, below which white noise cannot be
told from the rest.

Of a motion that is sampled as a sensor is they share nearly all; of poses in any order, a row for each, nothing.
"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Movement:
    """Second moments of k columns of reading and six of reference about the mean of each data set.

    What the linear variables and a slow drift explain is taken out, in each data set by itself, as its offset is.
    """

    count: int
    """Number of samples."""
    second: FloatArray
    """Mean products of reading and reference; shape (k + 6, k + 6)."""
    lasting: FloatArray
    """The same of what neighbouring samples share: white noise is not in it; shape (k + 6, k + 6).

    All of `second` where the reference itself differs from sample to sample, as in a table of poses.
    """
    size: FloatArray
    """Root mean square of the reference, its mean included; shape (6,); N, N m."""

    def __post_init__(self) -> None:
        width = len(np.asarray(self.second))
        object.__setattr__(self, "second", read_only(self.second, name="second", shape=(width, width)))
        object.__setattr__(self, "lasting", read_only(self.lasting, name="lasting", shape=(width, width)))
        object.__setattr__(self, "size", read_only(self.size, name="size", shape=(6,)))

    @classmethod
    def of(cls, data_sets: Sequence[DataSet], prior: FloatArray | None) -> Self:
        """Reduce data sets.

        Args:
            data_sets: Data sets of at least two samples each.
            prior: Matrix that makes a wrench of the raw reading; shape (6, c); None to take the channels as they are.

        Returns:
            The movement; its reading is a wrench if there is a prior, else raw counts.
        """
        channels = data_sets[0].raw.shape[1]
        reading = np.eye(channels) if prior is None else prior
        turn = np.zeros((len(reading) + 6, channels + 6))
        turn[: len(reading), :channels], turn[len(reading) :, channels:] = reading, np.eye(6)
        counts = np.array([len(data.raw) for data in data_sets])
        share = counts / counts.sum()
        second = turn @ np.tensordot(share, [_second(*_columns(data)) for data in data_sets], 1) @ turn.T
        # the mean of two neighbours holds half of the white noise, and all of what both share
        halved = turn @ np.tensordot(share, [_second(*map(_paired, _columns(data))) for data in data_sets], 1) @ turn.T
        square = np.tensordot(share, [(data.reference**2).mean(axis=0) for data in data_sets], 1)
        shared = 2.0 * halved - second
        lasting = shared if _lasts(shared, second, square) else second
        return cls(count=int(counts.sum()), second=second, lasting=lasting, size=np.sqrt(square))

    @property
    def columns(self) -> int:
        """Number k of columns of the reading."""
        return len(self.second) - 6

    @property
    def follows(self) -> FloatArray:
        """Matrix by which the reading follows the reference, by least squares; shape (k, 6)."""
        k = self.columns
        return self.second[:k, k:] @ symmetric_pseudo_inverse(self.second[k:, k:])

    def left(self, second: FloatArray) -> FloatArray:
        """Take out of the reading what follows the reference.

        Args:
            second: `second` or `lasting`; shape (k + 6, k + 6).

        Returns:
            Mean square of the rest of every column; shape (k,).
        """
        rest = np.hstack([np.eye(self.columns), -self.follows])
        return np.maximum(np.einsum("ij,jk,ik->i", rest, second, rest), 0.0)


def _lasts(shared: FloatArray, second: FloatArray, square: FloatArray) -> bool:
    """Whether neighbouring samples have the same load: components of the reference count by how much they move."""
    worth = np.divide(1.0, square, out=np.zeros(6), where=square > 0.0)
    return bool(worth @ np.diag(shared)[-6:] >= _SHARED * (worth @ np.diag(second)[-6:]))


def _columns(data: DataSet) -> tuple[FloatArray, FloatArray, FloatArray]:
    along = np.linspace(-1.0, 1.0, len(data.raw))[:, None]
    return data.raw, data.reference, np.hstack([data.variables, along, along**2])


def _paired(values: FloatArray) -> FloatArray:
    return 0.5 * (values[1:] + values[:-1])


def _second(raw: Any, reference: Any, variables: Any) -> FloatArray:
    return Moments.of(raw, reference, variables).without_variables().second


DoubtKind = Literal["span", "scale", "delay"]
"""What is doubtful: whether the reading follows the reference at all, by how much, or when."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubt:
    """A reason not to trust whatever is fitted to some data."""

    kind: DoubtKind
    """What is doubtful: that the reading follows the reference at all, by how much, or when."""
    message: str
    """What was seen, its likely cause, and what to change."""
