# SPDX-License-Identifier: BSD-3-Clause
"""Streams: what one device sent, with its own time stamps, and the quantities that a stream may hold."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final, Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, is_frozen, read_only, read_only_mapping
from forcetorque.base.errors import RecordingError, ShapeError, known_names, require_known
from forcetorque.base.labelled_arrays import AXIS, TIME, LabelledArray, xarray_dataset
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS

ROW_CLOCK: Final = "row"
"""Clock of samples without times, each of a robot at rest: sample k is stamped k seconds."""


class Labels(StrEnum):
    """What names the columns of a quantity."""

    FIXED = "fixed"
    """The columns always have the same names."""
    JOINTS = "joints"
    """One column per joint, named as in the robot model."""
    CHANNELS = "channels"
    """One column per channel of the electronics, in the order of the electronics."""
    TAXELS = "taxels"
    """One column per number in a message of skin, in its order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """One physical quantity of a recording."""

    name: str
    """Name of the signal in a stream."""
    labels: Labels = Labels.FIXED
    """What names its columns."""
    columns: tuple[str, ...] = ()
    """Column names where they are fixed."""
    units: tuple[str, ...] = ()
    """Allowed units: one per column where the columns are fixed, else the choice that each column has; any if empty."""
    has_frame: bool = False
    """Whether the values are along the axes of a frame, which must then be named."""
    description: str
    """Meaning, in one line."""


_XYZ = ("x", "y", "z")


def _wrench(name: str, description: str) -> Quantity:
    return Quantity(name=name, columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, has_frame=True, description=description)


def _vector(name: str, unit: str, description: str) -> Quantity:
    return Quantity(name=name, columns=_XYZ, units=(unit,) * 3, has_frame=True, description=description)


def _number(name: str, unit: str, description: str) -> Quantity:
    return Quantity(name=name, columns=(name,), units=(unit,), description=description)


def _several(
    name: str, labels: Labels, units: tuple[str, ...], description: str, *, has_frame: bool = False
) -> Quantity:
    return Quantity(name=name, labels=labels, units=units, has_frame=has_frame, description=description)


QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        _wrench("wrench", "Measurement of a force-torque sensor, already converted to force, then moment."),
        _wrench(
            "applied_wrench",
            "Known wrench, as of a dead weight: what an exact sensor without bias reads, in its direction.",
        ),
        _number(
            "vertical_force",
            "N",
            "Force of the ground on a foot along the normal of its sole, positive where it presses.",
        ),
        _several(
            "raw", Labels.CHANNELS, ("counts",), "Raw samples of a force-torque sensor as its electronics deliver it."
        ),
        _several(
            "position", Labels.JOINTS, ("rad", "m"), "Joint positions: rad for rotary joints, m for prismatic ones."
        ),
        _several("velocity", Labels.JOINTS, ("rad/s", "m/s"), "Joint velocities as logged."),
        _several("acceleration", Labels.JOINTS, ("rad/s2", "m/s2"), "Joint accelerations as logged."),
        _several(
            "torque",
            Labels.JOINTS,
            ("N m", "N"),
            "Joint torques along +q as the robot has them: N m for rotary joints, N for prismatic ones.",
        ),
        _several(
            "motor_current",
            Labels.JOINTS,
            ("A",),
            "Current of the motor of every joint, positive where it drives along +q times the gear ratio.",
        ),
        _several(
            "pwm",
            Labels.JOINTS,
            ("1",),
            "PWM duty of the motor of every joint, from -1 to 1, with the sign of the current.",
        ),
        _number("temperature", "degC", "Temperature of a sensor."),
        _vector("proper_acceleration", "m/s2", "Measurement of an accelerometer: +9.8 m/s2 upwards at rest."),
        Quantity(
            name="orientation",
            columns=tuple(f"r{row}{column}" for row in "123" for column in "123"),
            units=("1",) * 9,
            has_frame=True,
            description="Rotation matrix of a frame, row by row: it rotates vectors along its axes to the world's.",
        ),
        _vector("translation", "m", "Where the origin of a frame is in the world, along the world's axes."),
        _vector("gravity", "m/s2", "Acceleration of free fall along the axes of a frame: it points down."),
        _vector("angular_velocity", "rad/s", "Measurement of a gyroscope."),
        _vector("angular_acceleration", "rad/s2", "Angular acceleration, where a device gives it."),
        _number(
            "saturated",
            "0 or 1",
            "Status of a board: 1 while a channel is at its limit and the last valid sample is held.",
        ),
        _several(
            "taxel_counts",
            Labels.TAXELS,
            ("counts",),
            "Counts of every taxel of a patch of skin as its electronics deliver it; pressure lowers them.",
        ),
        _several(
            "skin_event",
            Labels.CHANNELS,
            ("m", "1", "counts", "heuristic"),
            "Contacts that a skinManager sees on a patch; its force is a heuristic, not newtons.",
            has_frame=True,
        ),
        _number(
            "pressure",
            "Pa",
            "Pressure of a chamber or bag above that of the air around, which skin is calibrated with.",
        ),
        _several(
            "scalar",
            Labels.CHANNELS,
            (),
            "Any other variable that may change a measurement, such as a supply voltage, as logged.",
        ),
        _number("device_stamp", "tick", "The device's own clock, in its own unit: shows transport delay and jitter."),
    )
}
"""Every quantity by name."""


def _stamps(values: Any, *, name: str) -> IntArray:
    if is_frozen(values, np.int64) and values.ndim == 1:
        return np.asarray(values)
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

    @property
    def dimension(self) -> str:
        """Name of the dimension of its columns in a data set."""
        by_labels = {Labels.JOINTS: "joint", Labels.CHANNELS: "channel", Labels.TAXELS: "taxel"}
        by_columns = {WRENCH_COMPONENTS: AXIS, _XYZ: "xyz"}
        labels = QUANTITIES[self.quantity].labels
        return by_labels.get(labels) or by_columns.get(self.columns) or f"{self.quantity}_column"

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

        Returns:
            Its samples; shape (n,).

        Raises:
            RecordingError: If there is no such column.
        """
        require_known(name, self.columns, RecordingError, f"{self.quantity}: no column {name!r}")
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

    def to_xarray(self) -> Any:
        """Give the samples as a data set of xarray.

        Returns:
            `xarray.Dataset` with a variable per quantity over `time` and columns: `axis` of a wrench, `xyz`, `joint`,
            `channel`, `taxel`, or `QUANTITY_column`; attributes `units` and `frame`.

        Raises:
            MissingExtraError: If xarray is not installed.
        """
        columns: dict[str, tuple[str, ...]] = {}
        dims = {}
        for key, signal in self.signals.items():
            shared = columns.setdefault(signal.dimension, signal.columns) == signal.columns
            dims[key] = signal.dimension if shared else f"{key}_column"
            columns[dims[key]] = signal.columns
        arrays = {
            key: LabelledArray(
                values=signal.values,
                dims=(TIME, dims[key]),
                units=signal.units[0] if len(set(signal.units)) == 1 else signal.units,
                attributes={} if signal.frame is None else {"frame": signal.frame},
            )
            for key, signal in self.signals.items()
        }
        columns.pop(AXIS, None)
        return xarray_dataset(self.stamp_ns, arrays, columns, stream=self.name, clock=self.clock)

    @property
    def held(self) -> BoolArray:
        """Samples that the board itself calls saturated: it repeats its last valid one; shape (n,)."""
        if "saturated" not in self.signals:
            return np.zeros(len(self), dtype=bool)
        return self.signals["saturated"].values[:, 0] > 0.0

    def signal(self, quantity: str) -> Signal:
        """Give one signal.

        Args:
            quantity: Name of the quantity.

        Returns:
            The signal.

        Raises:
            RecordingError: If the stream has no such signal.
        """
        require_known(quantity, self.signals, RecordingError, f"stream {self.name!r} has no {quantity}")
        return self.signals[quantity]
