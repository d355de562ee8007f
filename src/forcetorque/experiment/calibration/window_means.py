# SPDX-License-Identifier: BSD-3-Clause
"""Means over a second: what the generative model needs of a recording, and all of it that grows with its length."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.noise.means import means_over
from forcetorque.experiment.calibration.moments import DataSet


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowMeans:
    """Means of n windows of one stretch of time."""

    label: str
    """Label of the interval."""
    session: str
    """Power-up: readings of one session share an offset."""
    recording: str
    """Recording: within it slow noise goes on, from one stretch to the next."""
    time_s: FloatArray
    """Mean instants on the clock of the recording; shape (n,); s."""
    count: FloatArray
    """Samples in each; shape (n,)."""
    raw: FloatArray
    """Readings; shape (n, c); counts."""
    reference: FloatArray
    """Expected wrenches; shape (n, 6); N, N m."""
    flattening: FloatArray
    """What a derivative window of twice the length takes from them; shape (n, 6); N, N m."""
    variables: FloatArray
    """Linear variables; shape (n, v)."""

    def __post_init__(self) -> None:
        n = len(np.asarray(self.time_s))
        for field, width in (("raw", None), ("reference", 6), ("flattening", 6), ("variables", None)):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(n, width)))
        for field in ("time_s", "count"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(n,)))

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
        return replace(self, **{name: getattr(self, name)[marks] for name in names})

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
        time, means, count = means_over(data.time_s, columns)
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
