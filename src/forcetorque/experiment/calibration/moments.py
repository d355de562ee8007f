# SPDX-License-Identifier: BSD-3-Clause
"""Second moments and means over seconds of a recording: all that a fit needs of a data set."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from typing import Any

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    IntArray,
    array,
    check_arrays,
    read_only,
    require_shape,
)
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.noise.window_means import means_over, windows_of
from forcetorque.base.rows_on_disk import concatenated
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm
from forcetorque.experiment.calibration.sensor_model import WrenchModel

_BLOCK = 8192
"""Samples per pass: what is made of them stays in the processor's cache."""

_SINGULAR = 1e-14
"""Eigenvalues of scaled second moments below this part of the largest are rounding."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moments(ArrayRecord):
    """Count, mean and centred second moment of m = c + v + 6 columns: raw channels, variables, reference."""

    count: int
    """Number of samples."""
    channels: int
    """Number c of raw channels."""
    variables: int
    """Number v of linear variables."""
    origin: FloatArray = field(metadata=array("m"))
    """Rough mean of every column, which keeps the digits of what is beyond it; shape (m,)."""
    step: FloatArray = field(metadata=array("m"))
    """Mean of every column beyond the rough one; shape (m,)."""
    second: FloatArray = field(metadata=array("m", "m"))
    """Mean product of centred columns; shape (m, m)."""

    def __post_init__(self) -> None:
        check_arrays(self)
        require_shape(self.origin, name="origin", shape=(self.channels + self.variables + 6,))

    @classmethod
    def of(cls, raw: Any, reference: Any, variables: Any = None) -> Moments:
        """Reduce samples to their moments.

        A rough mean is taken off before multiplying. That keeps the accuracy of an orthogonal
        factorisation: offsets of 24 000 counts otherwise cost it eight digits.

        Args:
            raw: Raw readings; shape (n, c); counts.
            reference: Reference wrenches; shape (n, 6); N, N m.
            variables: Linear variables; shape (n, v); each in its own unit; None for none.

        Returns:
            The moments of the n samples.

        Raises:
            ShapeError: If the arrays do not fit each other.
            FitError: If there is no sample, or a value is not finite.
        """
        r, f = np.asarray(raw, dtype=np.float64), np.asarray(reference, dtype=np.float64)
        if r.ndim != 2 or f.shape != (len(r), 6):
            raise ShapeError(f"expected raw (n, c) and reference (n, 6), got {r.shape} and {f.shape}")
        v = np.empty((len(r), 0)) if variables is None else np.asarray(variables, dtype=np.float64)
        if v.ndim != 2 or len(v) != len(r):
            raise ShapeError(f"variables: expected shape ({len(r)}, v), got {v.shape}")
        if not len(r):
            raise FitError("expected at least one sample, got none")
        rough, step, second = _reduce((r, v, f))
        if not np.isfinite(second).all():
            raise FitError("expected finite values only, got others; leave out gaps")
        return cls(count=len(r), channels=r.shape[1], variables=v.shape[1], origin=rough, step=step, second=second)

    @property
    def mean(self) -> FloatArray:
        """Mean of every column; shape (m,)."""
        return self.origin + self.step

    @property
    def raw_mean(self) -> FloatArray:
        """Mean raw reading; shape (c,); counts."""
        return self.mean[: self.channels]

    @property
    def variable_mean(self) -> FloatArray:
        """Mean of every variable; shape (v,)."""
        return self.mean[self.channels : -6]

    @property
    def reference_mean(self) -> FloatArray:
        """Mean reference wrench; shape (6,); N, N m."""
        return self.mean[-6:]

    @property
    def raw_raw(self) -> FloatArray:
        """Mean product of centred raw readings; shape (c, c); counts2."""
        return self.second[: self.channels, : self.channels]

    @property
    def reference_raw(self) -> FloatArray:
        """Mean product of centred reference and raw; shape (6, c); N counts, N m counts."""
        return self.second[-6:, : self.channels]

    @property
    def reference_reference(self) -> FloatArray:
        """Mean product of centred references; shape (6, 6)."""
        return self.second[-6:, -6:]

    def __add__(self, other: Moments) -> Moments:
        if (self.channels, self.variables) != (other.channels, other.variables):
            raise ShapeError(
                f"moments: expected {self.channels} channels and {self.variables} variables in every part, "
                f"got {other.channels} and {other.variables}"
            )
        count = self.count + other.count
        mine, theirs = self.count / count, other.count / count
        # in this order: of a clock that counts from 1970 the means would lose what lies between them
        step = (other.origin - self.origin) + (other.step - self.step)
        return Moments(
            count=count,
            channels=self.channels,
            variables=self.variables,
            origin=self.origin,
            step=self.step + theirs * step,
            second=mine * self.second + theirs * other.second + mine * theirs * np.outer(step, step),
        )

    def about(self, origin: FloatArray) -> FloatArray:
        """Give the mean product of the columns' differences from a point other than their mean.

        Args:
            origin: The point; shape (m,).

        Returns:
            Second moment about it; shape (m, m).
        """
        step = (self.origin - origin) + self.step
        return self.second + np.outer(step, step)

    def without_variables(self) -> Moments:
        """Take out of raw readings and reference what the variables explain of them.

        Returns:
            Moments of what is left, without variables.
        """
        v = slice(self.channels, self.channels + self.variables)
        remaining = np.r_[: self.channels, self.channels + self.variables : len(self.origin)]
        shared = self.second[remaining][:, v]
        left = (
            self.second[np.ix_(remaining, remaining)] - shared @ symmetric_pseudo_inverse(self.second[v, v]) @ shared.T
        )
        origin, step = self.origin[remaining], self.step[remaining]
        return Moments(count=self.count, channels=self.channels, variables=0, origin=origin, step=step, second=left)

    def squared_error(self, model: WrenchModel) -> FloatArray:
        """Mean squared error of a model on these samples, per component.

        Args:
            model: The model, of all variables of the samples or of none.

        Returns:
            Mean of the squared error of every component; shape (6,); N2, (N m)2.
        """
        from_zero = model.counted_from_zero(self.variables)
        error_of = np.hstack([from_zero.matrix, from_zero.coefficients, -np.eye(6)])  # (6, m)
        bias = error_of @ self.mean + from_zero.offset
        spread = np.einsum("ij,jk,ik->i", error_of, self.second, error_of)
        return np.maximum(spread, 0.0) + bias**2


def _reduce(parts: tuple[FloatArray, ...]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A rough mean of the columns, what their mean is beyond it, and their centred second moment."""
    rough = np.concatenate([part[:_BLOCK].mean(axis=0) for part in parts])
    width, n = len(rough), len(parts[0])
    # a column of ones beside the others gives their sums in the same product
    block = np.ones((min(_BLOCK, n), width + 1))
    total = np.zeros((width + 1, width + 1))
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite is found in the sums
        for start in range(0, n, _BLOCK):
            stop, column = min(start + _BLOCK, n), 0
            for part in parts:
                end = column + part.shape[1]
                np.subtract(part[start:stop], rough[column:end], out=block[: stop - start, column:end])
                column = end
            total += block[: stop - start].T @ block[: stop - start]
        step = total[-1, :-1] / n
        return rough, step, total[:-1, :-1] / n - np.outer(step, step)


def symmetric_pseudo_inverse(second: FloatArray) -> FloatArray:
    """Invert second moments whose columns have different units.

    Args:
        second: Second moments; shape (..., k, k).

    Returns:
        Their inverses; zero along columns that do not move, or that repeat others; shape (..., k, k).
    """
    # a column that stands still may be rounded below zero
    diagonal = np.sqrt(np.maximum(np.diagonal(second, axis1=-2, axis2=-1), 0.0))
    scale = np.where(diagonal > 0.0, diagonal, 1.0)
    unit = scale[..., :, None] * scale[..., None, :]
    return np.asarray(np.linalg.pinv(second / unit, rcond=_SINGULAR, hermitian=True) / unit, dtype=np.float64)


def pooled(parts: Iterable[Moments]) -> Moments:
    """Add up the moments of parts.

    Args:
        parts: Moments of disjoint sets of samples, at least one.

    Returns:
        The moments of all samples together.
    """
    return reduce(Moments.__add__, parts)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DataSet(ArrayRecord):
    """Readings and reference of one stretch of time."""

    label: str
    """Label of the interval."""
    raw: FloatArray = field(metadata=array("n", None))
    """Raw readings in the order of time; shape (n, c); counts."""
    reference: FloatArray = field(metadata=array("n", 6))
    """Reference wrenches; shape (n, 6); N, N m."""
    variables: Any = field(default=None, metadata=array("n", None))
    """Linear variables; shape (n, v), an array also where None was given: v is then 0."""
    time_s: Any = field(default=None, metadata=array("n"))
    """Instants on the clock of the recording; shape (n,); s; None where they are not known."""
    flattening: Any = field(default=None, metadata=array("n", 6))
    """What a derivative window of twice the length takes from the reference; shape (n, 6); N, N m; None for nothing."""
    session: str = ""
    """Power-up: data sets of one session share an offset."""
    recording: str = ""
    """Recording whose clock and slow noise it shares with others."""
    origin_s: float | None = None
    """Instant at which a window of a second starts; s; None for that of the first sample."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if self.variables is None:
            none = read_only(np.empty((len(self.raw), 0)), name="variables", shape=(None, 0))
            object.__setattr__(self, "variables", none)

    @property
    def window(self) -> IntArray:
        """Number, from 0, of the window of a second that each sample is in; shape (n,)."""
        number = windows_of(self.time_s, float(self.time_s[0]) if self.origin_s is None else self.origin_s)
        return np.cumsum(np.diff(number, prepend=number[0]) > 0.0)

    def kept(self, marks: BoolArray) -> DataSet:
        """Keep some of the samples.

        Args:
            marks: Which; shape (n,).

        Returns:
            The others left out; the same where none is.
        """
        if marks.all():
            return self
        return replace(
            self,
            raw=self.raw[marks],
            reference=self.reference[marks],
            variables=self.variables[marks],
            time_s=None if self.time_s is None else self.time_s[marks],
            flattening=None if self.flattening is None else self.flattening[marks],
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowMeans(ArrayRecord):
    """Means of n windows of one stretch of time."""

    label: str
    """Label of the interval."""
    session: str
    """Power-up: readings of one session share an offset."""
    recording: str
    """Recording: within it slow noise goes on, from one stretch to the next."""
    time_s: FloatArray = field(metadata=array("n"))
    """Mean instants on the clock of the recording; shape (n,); s."""
    count: FloatArray = field(metadata=array("n"))
    """Samples in each; shape (n,)."""
    raw: FloatArray = field(metadata=array("n", None))
    """Readings; shape (n, c); counts."""
    reference: FloatArray = field(metadata=array("n", 6))
    """Expected wrenches; shape (n, 6); N, N m."""
    flattening: FloatArray = field(metadata=array("n", 6))
    """What a derivative window of twice the length takes from them; shape (n, 6); N, N m."""
    variables: FloatArray = field(metadata=array("n", None))
    """Linear variables; shape (n, v)."""
    terms: tuple[ErrorTerm, ...] = ()
    """Numbers of the robot model that may be wrong."""
    model: FloatArray | None = field(default=None, metadata=array("n", 6, None))
    """Derivatives of the expected wrenches by these; shape (n, 6, terms); N, N m per unit of the term."""

    def __len__(self) -> int:
        return len(self.time_s)

    def unflattened(self, share: float) -> WindowMeans:
        """Give the reference back what the derivative window took from it.

        Args:
            share: That, over what a window of twice the length would take besides.

        Returns:
            The means with another reference.
        """
        return replace(self, reference=self.reference + share * self.flattening)

    def kept(self, marks: BoolArray) -> WindowMeans:
        """Keep some of the windows.

        Args:
            marks: Which; shape (n,).

        Returns:
            The others left out.
        """
        names = ("time_s", "count", "raw", "reference", "flattening", "variables")
        model = None if self.model is None else self.model[marks]
        return replace(self, model=model, **{name: getattr(self, name)[marks] for name in names})

    @classmethod
    def of(cls, data: DataSet) -> WindowMeans:
        """Average samples over windows of a second.

        Args:
            data: Samples with their instants.

        Returns:
            Their means.

        Raises:
            FitError: If the instants are not known, or a value is not finite.
        """
        if data.time_s is None:
            raise FitError(f"data set {data.label!r}: expected time_s, the instants of its samples, got none")
        flattening = np.zeros_like(data.reference) if data.flattening is None else data.flattening
        columns = np.hstack([data.raw, data.reference, flattening, data.variables])
        if not len(columns) or not np.isfinite(columns).all():
            raise FitError(f"data set {data.label!r}: expected samples of finite values; leave out gaps")
        time, means, count = means_over(data.time_s, columns, origin_s=data.origin_s)
        ends = np.cumsum([data.raw.shape[1], 6, 6])
        raw, reference, flattening, variables = np.split(means, ends, axis=1)
        return cls(
            label=data.label,
            session=data.session,
            recording=data.recording,
            time_s=time,
            count=count.astype(np.float64),
            raw=raw,
            reference=reference,
            flattening=flattening,
            variables=variables,
        )


def in_order(stretches: Sequence[WindowMeans]) -> list[WindowMeans]:
    """Put stretches of one recording together, in the order of time.

    Args:
        stretches: Means of one sensor.

    Returns:
        The same, by recording as they first come.

    Raises:
        FitError: If there is none.
        ShapeError: If they differ in channels or variables.
    """
    if not stretches:
        raise FitError("expected at least one calibration interval, got none")
    shapes = {(stretch.raw.shape[1], stretch.variables.shape[1]) for stretch in stretches}
    if len(shapes) > 1:
        raise ShapeError(f"data sets: expected one number of raw channels and of variables, got {sorted(shapes)}")
    recordings = list(dict.fromkeys(stretch.recording for stretch in stretches))
    return sorted(stretches, key=lambda s: (recordings.index(s.recording), s.time_s[0]))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TermColumns:
    """Derivatives of n means by t terms of the robot model: those of several groups of stretches, and those of one.

    Every recording has terms of its own, such as its delay, so that dense derivatives grow with the square of the
    number of recordings.
    """

    terms: tuple[ErrorTerm, ...]
    """The terms, one of a name and nominal value once."""
    shared: IntArray
    """Places of the terms that several groups have, or all where there is one group; shape (s,)."""
    columns: FloatArray
    """Derivatives by these, 0 where an interval does not depend on one; shape (n, 6, s); N, N m per unit of each."""
    group: IntArray
    """Number of the group of every mean; shape (n,)."""
    local: IntArray
    """Places of the terms that one group alone has, -1 after the last; shape (groups, w)."""
    local_columns: FloatArray
    """Derivatives of every mean by those of its group, 0 after the last; shape (n, 6, w); N, N m per unit of each."""

    @property
    def deviations(self) -> FloatArray:
        """Standard deviations of the terms; shape (t,)."""
        return np.array([term.deviation for term in self.terms])


def model_terms(stretches: Sequence[WindowMeans], groups: Sequence[int]) -> TermColumns:
    """Put the terms of the robot model of several intervals together.

    Args:
        stretches: Means of one sensor.
        groups: Number of the group of each.

    Returns:
        The terms and the derivatives by them.
    """
    known = {(term.name, term.nominal): term for stretch in stretches for term in stretch.terms}
    owners: dict[tuple[str, float], set[int]] = {key: set() for key in known}
    for stretch, group in zip(stretches, groups, strict=True):
        for term in stretch.terms:
            owners[term.name, term.nominal].add(group)
    several = max(groups) > 0
    own: list[list[int]] = [[] for _ in range(max(groups) + 1)]
    shared: list[int] = []
    column: dict[tuple[str, float], int] = {}
    for place, (key, having) in enumerate(owners.items()):
        places = own[min(having)] if several and len(having) == 1 else shared
        column[key] = len(places)
        places.append(place)
    width = max(map(len, own))
    columns, local_columns = [], []
    for stretch in stretches:
        keys = [(term.name, term.nominal) for term in stretch.terms]
        alone = np.array([several and len(owners[key]) == 1 for key in keys], dtype=bool)
        targets = np.array([column[key] for key in keys], dtype=np.int64)
        columns.append(_at_places(stretch, ~alone, targets, len(shared)))
        local_columns.append(_at_places(stretch, alone, targets, width))
    return TermColumns(
        terms=tuple(known.values()),
        shared=np.array(shared, dtype=np.int64),
        columns=columns[0] if len(columns) == 1 else concatenated(columns),
        group=np.repeat(groups, [len(stretch) for stretch in stretches]),
        local=np.array([places + [-1] * (width - len(places)) for places in own], dtype=np.int64),
        local_columns=np.concatenate(local_columns),
    )


def _at_places(stretch: WindowMeans, chosen: BoolArray, places: IntArray, width: int) -> FloatArray:
    """Derivatives by chosen terms in their columns; shape (n, 6, width)."""
    if stretch.model is not None and chosen.all() and np.array_equal(places, np.arange(width)):
        return stretch.model
    part = np.zeros((len(stretch), 6, width))
    if stretch.model is not None:
        part[:, :, places[chosen]] = stretch.model[:, :, chosen]
    return part
