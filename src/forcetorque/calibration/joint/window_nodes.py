# SPDX-License-Identifier: BSD-3-Clause
"""Intervals of a joint calibration, in windows that are each reduced to three instants."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    FloatArray,
    IntArray,
    array,
    check_arrays,
    mapping,
    names,
    require_shape,
)
from forcetorque.base.errors import ShapeError
from forcetorque.base.rows_on_disk import RowsOnDisk, forget_pages
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stretch(ArrayRecord):
    """A stretch of a recording in which the same links touch the world; n samples."""

    label: str
    """Label of the interval."""
    recording: str
    """Recording that it is of: the noise of its readings is its own."""
    session: str
    """Stretch of time in which sensors keep their offsets."""
    time_s: FloatArray = field(metadata=array("n"))
    """Instants, rising; shape (n,); s."""
    tree: BodyTree
    """The robot, rooted at the link whose motion is known: that of an IMU, or one that stands still."""
    joints: JointMotion
    """Motion of the joints; those that were not logged are absent; NaN in gaps."""
    root: RootMotion
    """Motion of the root link's frame."""
    readings: Mapping[str, FloatArray] = field(metadata=mapping("n", 6))
    """Wrenches of the sensors by their prior matrices, without offset; shape (n, 6) each; N, N m; NaN in gaps."""
    touched: tuple[str, ...] = field(metadata=names())
    """Links that touch, or may touch, the world: nothing is asked of the parts that they are of."""
    keeps_disagreeing: bool = False
    """Whether seconds that disagree with all others are fitted too."""
    variables: Mapping[tuple[str, str], FloatArray] = field(default_factory=dict, metadata=mapping("n", 1))
    """By sensor and name, linear variables such as the temperature less their reference values; shape (n, 1) each; in
    their units; NaN in gaps."""

    def __post_init__(self) -> None:
        check_arrays(self)
        require_shape(self.time_s, name="time_s", shape=(len(self.joints),))
        if not (np.isfinite(self.time_s).all() and (np.diff(self.time_s) > 0.0).all()):
            raise ShapeError(f"interval {self.label!r}: time_s: expected finite instants that rise")

    def __len__(self) -> int:
        return len(self.time_s)

    def samples(self, rows: slice | IntArray) -> Stretch:
        """Look at some of the samples.

        Args:
            rows: Range of samples, without a step, or their numbers.

        Returns:
            The same memory for a range.
        """
        return self.with_rows(values[rows] for values in self.rows)

    @property
    def rows(self) -> list[FloatArray]:
        """Arrays with a row per sample: instants, joints, root where it moves, readings, variables."""
        of_joints = [getattr(self.joints, name) for name in _MOTION]
        of_root = [values for name in _OF_ROOT if (values := getattr(self.root, name)).ndim == 2]
        return [self.time_s, *of_joints, *of_root, *self.readings.values(), *self.variables.values()]

    def with_rows(self, rows: Iterable[FloatArray]) -> Stretch:
        """Take other arrays.

        Args:
            rows: Arrays in the order of `rows`.

        Returns:
            All else as it is.
        """
        own = iter(rows)
        time_s = next(own)
        of_joints: dict[str, Any] = {name: next(own) for name in _MOTION}
        of_root = {name: next(own) for name in _OF_ROOT if getattr(self.root, name).ndim == 2}
        return replace(
            self,
            time_s=time_s,
            joints=replace(self.joints, **of_joints),
            root=replace(self.root, **of_root),
            readings={name: next(own) for name in self.readings},
            variables={name: next(own) for name in self.variables},
        )

    def pieces(self, length_s: float) -> Iterator[Stretch]:
        """Cut the stretch.

        Args:
            length_s: Longest time that a piece takes; s.

        Yields:
            Pieces of one length that follow each other; none of a stretch without samples.
        """
        if not len(self):
            return
        start, duration = self.time_s[0], self.time_s[-1] - self.time_s[0]
        count = max(int(np.ceil(duration / length_s)), 1)
        edges = np.searchsorted(self.time_s, start + duration / count * np.arange(1, count))
        for first, last in zip([0, *edges], [*edges, len(self)], strict=True):
            block = slice(int(first), int(last))
            if block.start < block.stop:
                yield self.samples(block)
                forget_pages(self.rows)


_MOTION: Final = ("position", "velocity", "acceleration")
_OF_ROOT: Final = ("proper_acceleration", "angular_velocity", "angular_acceleration")


class StretchRows:
    """A stretch whose parts come one after the other, in temporary files where it is long."""

    def __init__(self, stretch: Stretch, beside: Mapping[str, FloatArray]) -> None:
        """Begin.

        Args:
            stretch: The first part; others are of the same joints and sensors.
            beside: What else was logged at its instants, by name; shape (n, c) each.
        """
        self._first = stretch.samples(np.arange(0))  # a copy, without the memory of the part
        self._beside = tuple(beside)
        self._rows = [RowsOnDisk(values.shape[1:]) for values in (*stretch.rows, *beside.values())]
        self.append(stretch, beside)

    def append(self, stretch: Stretch, beside: Mapping[str, FloatArray]) -> None:
        """Add the next part.

        Args:
            stretch: The part.
            beside: As of the first.
        """
        for own, values in zip(self._rows, (*stretch.rows, *beside.values()), strict=True):
            own.append(values)

    def mapped(self) -> tuple[Stretch, dict[str, FloatArray]]:
        """Put the parts together.

        Returns:
            The stretch, and what else was logged at its instants.
        """
        rows = [own.mapped() for own in self._rows]
        count = len(rows) - len(self._beside)
        return self._first.with_rows(rows[:count]), dict(zip(self._beside, rows[count:], strict=True))


NODES: Final = 3
"""Nodes of a window."""
_PLACES = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0])
"""Nodes, in halves of a window from its middle."""
_MOMENT_S = 1e-4
WEIGHTS: Final = np.array([5.0, 8.0, 5.0]) / 18.0
"""Their weights in the mean over a window."""


class WindowNodes:
    """Windows of samples that follow each other."""

    def __init__(self, time_s: FloatArray, window_s: float) -> None:
        """Cut instants into windows.

        Args:
            time_s: Instants, rising; shape (n,), n > 0; s.
            window_s: Length of a window; s.
        """
        number = np.floor((time_s - time_s[0]) / window_s + 1e-9).astype(np.int64)
        self._starts = np.flatnonzero(np.diff(number, prepend=-1))
        self.counts = np.diff(self._starts, append=len(time_s))
        """Samples of every window; shape (w,)."""
        self.time_s = self.means(time_s[:, None])[:, 0]
        """Mean instants; shape (w,); s."""
        extent = time_s[self._starts + self.counts - 1] - time_s[self._starts]
        # samples stand for what lies between them; one alone, for a moment
        self._half = np.where(self.counts > 1, 0.5 * extent * self.counts / np.maximum(self.counts - 1, 1), _MOMENT_S)
        centred = time_s - np.repeat(self.time_s, self.counts)
        self._basis = self._polynomials(centred / np.repeat(self._half, self.counts))
        gram = np.add.reduceat(self._basis[:, :, None] * self._basis[:, None, :], self._starts, axis=0)
        self._inverse = np.linalg.pinv(gram, rcond=1e-9, hermitian=True)

    def __len__(self) -> int:
        return len(self._starts)

    def means(self, values: FloatArray) -> FloatArray:
        """Average samples over every window.

        Args:
            values: Values of every sample; shape (n, k).

        Returns:
            Means; shape (w, k); NaN where a window has a gap.
        """
        return np.add.reduceat(values, self._starts, axis=0) / self.counts[:, None]

    def node_means(self, values: FloatArray) -> FloatArray:
        """Average values at nodes over every window.

        Args:
            values: Values at the nodes; shape (3 w, k).

        Returns:
            Means; shape (w, k).
        """
        return np.einsum("n,wnk->wk", WEIGHTS, values.reshape(len(self), NODES, -1))

    def condensed(self, stretch: Stretch) -> Stretch:
        """Reduce a stretch to its nodes.

        Args:
            stretch: The stretch, of the same n samples.

        Returns:
            Parabolas through its signals at the nodes; 3 w samples.
        """
        time_s = (self.time_s[:, None] + self._half[:, None] * _PLACES).ravel()
        return stretch.with_rows([time_s, *map(self._at_nodes, stretch.rows[1:])])

    def rates(self, values: FloatArray) -> FloatArray:
        """Differentiate a signal.

        Args:
            values: Values of every sample; shape (n, k).

        Returns:
            Derivatives of the parabolas that fit best, at the nodes; shape (3 w, k); per second.
        """
        slopes = np.stack([np.zeros(NODES), np.ones(NODES), 3.0 * _PLACES], axis=1) / self._half[:, None, None]
        return (slopes @ self._parabolas(values)).reshape(NODES * len(self._starts), values.shape[1])

    def _at_nodes(self, values: FloatArray) -> FloatArray:
        """Parabolas that fit samples best, at the nodes; shape (3 w, k)."""
        nodes = np.stack([np.ones(NODES), _PLACES, 1.5 * _PLACES**2 - 0.5], axis=1)
        return (nodes @ self._parabolas(values)).reshape(NODES * len(self._starts), values.shape[1])

    def _parabolas(self, values: FloatArray) -> FloatArray:
        """Coefficients of the parabolas that fit samples best; shape (w, 3, k)."""
        products = np.stack(
            [np.add.reduceat(column[:, None] * values, self._starts, axis=0) for column in self._basis.T], axis=1
        )
        return self._inverse @ products

    def _polynomials(self, place: FloatArray) -> FloatArray:
        """Legendre's polynomials, of no higher degree than the samples of a window can tell; shape (n, 3)."""
        count = np.repeat(self.counts, self.counts)
        return np.stack(
            [np.ones_like(place), place * (count > 1), (1.5 * place**2 - 0.5) * (count > 2)],
            axis=1,
        )
