# SPDX-License-Identifier: BSD-3-Clause
"""Streams: what one device sent, with its own time stamps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray, read_only
from forcetorque.errors import RecordingError, ShapeError, known_names
from forcetorque.read_only_mapping import read_only_mapping
from forcetorque.recording.quantity import QUANTITIES, Labels


def _stamps(values: Any, *, name: str) -> IntArray:
    array = np.array(values, order="C")
    if array.ndim != 1 or (array.size and array.dtype.kind not in "iu"):
        raise ShapeError(f"{name}: expected integers of shape (n,), got {array.dtype} of shape {array.shape}")
    if array.size and array.max() > np.iinfo(np.int64).max:
        raise ShapeError(f"{name}: expected integers of 64 bits with a sign, got {array.max()}")
    array = array.astype(np.int64)
    array.setflags(write=False)
    return array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Signal:
    """Samples of one quantity; missing values are NaN."""

    quantity: str
    """Name of the quantity, one of `QUANTITIES`."""
    values: FloatArray
    """Samples; shape (n, k); in `units`."""
    columns: tuple[str, ...]
    """Names of the k columns."""
    units: tuple[str, ...]
    """Units of the k columns."""
    frame: str | None = None
    """Frame along whose axes the values are given; None for quantities that have none."""

    def __post_init__(self) -> None:
        quantity = QUANTITIES.get(self.quantity)
        if quantity is None:
            raise RecordingError(f"no quantity is called {self.quantity!r}; {known_names(self.quantity, QUANTITIES)}")
        columns, units = tuple(self.columns), tuple(self.units)
        object.__setattr__(self, "columns", columns)
        object.__setattr__(self, "units", units)
        object.__setattr__(self, "values", read_only(self.values, name=self.quantity, shape=(None, len(columns))))
        if len(set(columns)) != len(columns) or not columns:
            raise RecordingError(f"{self.quantity}: expected at least one column and each name once, got {columns}")
        if quantity.labels is Labels.FIXED and (columns, units) != (quantity.columns, quantity.units):
            raise RecordingError(
                f"{self.quantity}: expected the columns {quantity.columns} in {quantity.units}, "
                f"got {columns} in {units}; convert or reorder them when reading"
            )
        if len(units) != len(columns) or (quantity.units and not set(units) <= set(quantity.units)):
            raise RecordingError(
                f"{self.quantity}: expected one unit out of {quantity.units} for each of {len(columns)} columns, "
                f"got {units}; convert when reading"
            )
        if quantity.has_frame != (self.frame is not None):
            wanted = "the frame of its axes" if quantity.has_frame else "no frame"
            raise RecordingError(f"{self.quantity}: expected {wanted}, got {self.frame!r}")

    @classmethod
    def of_fixed(cls, quantity: str, values: Any, *, frame: str | None = None) -> Self:
        """Give samples of a quantity whose columns always have the same names and units.

        Args:
            quantity: Name of the quantity.
            values: Samples; shape (n, k); in its units.
            frame: As of the class.

        Returns:
            The signal.
        """
        form = QUANTITIES[quantity]
        return cls(quantity=quantity, values=values, columns=form.columns, units=form.units, frame=frame)

    def column(self, name: str) -> FloatArray:
        """Give one column.

        Args:
            name: Name of the column.

        Returns:
            Its samples; shape (n,).

        Raises:
            RecordingError: If there is no such column.
        """
        if name not in self.columns:
            raise RecordingError(f"{self.quantity}: no column {name!r}; {known_names(name, self.columns)}")
        return self.values[:, self.columns.index(name)]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stream:
    """What one device sent: signals that share time stamps."""

    name: str
    """Name of the stream, unique in its recording."""
    clock: str
    """Name of the clock that stamped it; only streams of one clock can be aligned."""
    stamp_ns: IntArray
    """Time of every sample in the order of the log, ns since the epoch of the clock; shape (n,)."""
    signals: Mapping[str, Signal]
    """Signals by quantity, all of n samples."""
    sequence: IntArray | None = None
    """Counter of the sender, where there is one; shape (n,); a jump is a lost message."""

    def __post_init__(self) -> None:
        stamps = _stamps(self.stamp_ns, name=f"{self.name}: stamp_ns")
        object.__setattr__(self, "stamp_ns", stamps)
        if self.sequence is not None:
            object.__setattr__(self, "sequence", _stamps(self.sequence, name=f"{self.name}: sequence"))
            if len(self.sequence) != len(stamps):
                raise ShapeError(f"{self.name}: {len(self.sequence)} sequence numbers for {len(stamps)} stamps")
        object.__setattr__(self, "signals", read_only_mapping(self.signals))
        if not self.signals:
            raise RecordingError(f"stream {self.name!r}: expected at least one signal, got none")
        for key, signal in self.signals.items():
            if key != signal.quantity:
                raise RecordingError(f"stream {self.name!r}: the key {key!r} holds the quantity {signal.quantity!r}")
            if len(signal.values) != len(stamps):
                raise ShapeError(
                    f"stream {self.name!r}: {len(signal.values)} samples of {key} for {len(stamps)} stamps"
                )

    def __len__(self) -> int:
        return len(self.stamp_ns)

    @property
    def held(self) -> BoolArray:
        """Samples that the board itself calls saturated: it repeats its last valid one; shape (n,)."""
        if "saturated" not in self.signals:
            return np.zeros(len(self), dtype=bool)
        held: BoolArray = self.signals["saturated"].values[:, 0] > 0.0
        return held

    def signal(self, quantity: str) -> Signal:
        """Give one signal.

        Args:
            quantity: Name of the quantity.

        Returns:
            The signal.

        Raises:
            RecordingError: If the stream has no such signal.
        """
        if quantity not in self.signals:
            raise RecordingError(f"stream {self.name!r} has no {quantity}; {known_names(quantity, self.signals)}")
        return self.signals[quantity]
