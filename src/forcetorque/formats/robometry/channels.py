# SPDX-License-Identifier: BSD-3-Clause
"""Channels of a robometry file: samples, times, elements and units [1], and the streams made of them.

A channel is a group with `data`, of shape (samples, 1, elements) as h5py sees it, and `timestamps`. Names of
elements and units came with later versions; a unit may stand once for all elements. What a channel holds is its place
in the file. The form is that of [1] robotology/robometry, README.md and src/librobometry/src/BufferManager.cpp.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, MissingExtraError, UnitError
from forcetorque.base.units import SI_FACTORS, si_factor
from forcetorque.formats.hdf5_file import (
    MOST_OBJECTS,
    dataset_numbers,
    datasets,
    is_hdf5_file,
    is_member,
    member,
    not_in_file,
    opened_hdf5,
    require_readable,
)
from forcetorque.formats.log_format import StreamReading
from forcetorque.recording.orientation import OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Signal, Stream

DESCRIPTION = "description_list"
"""Names of the joints; the group that holds it is that of the log."""
LATEST_S = 9.2e9
"""Seconds that nanoseconds of 64 bits can count."""

_LONGEST_NAME = 1000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Channel:
    """Samples of one channel."""

    path: str
    """Its path below the group of the log, such as `FTs/l_leg_ft`."""
    values: FloatArray
    """Samples; shape (n, k); in the units of the file."""
    stamp_ns: IntArray
    """Times by the clock of the logger; shape (n,); ns since 1970."""
    elements: tuple[str, ...]
    """Names of the k elements; none in older files."""
    labels: tuple[str, ...]
    """Their units as the file labels them, one for all or k; none in older files."""


def log_group(file: Any) -> Any | None:
    """Find the group of the log: that which names the joints.

    Args:
        file: An open HDF5 file.

    Returns:
        The group, or None if the file is no log of robometry.
    """
    import h5py

    groups = [file, *(member(file, name) for name in file if is_member(file, name) and not_in_file(file, name) is None)]
    return next((group for group in groups if isinstance(group, h5py.Group) and is_member(group, DESCRIPTION)), None)


def is_robometry_log(path: Path) -> bool:
    """Check whether a file is a log of robometry, which labels what it holds.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it is one; False for a file that is damaged or cannot be opened without h5py: the format of HDF5 files
        in general reports that.
    """
    if not is_hdf5_file(path):
        return False
    try:
        with opened_hdf5(path) as file:
            return log_group(file) is not None
    except (FormatError, MissingExtraError):
        return False


def channel_paths(group: Any) -> Iterator[str]:
    """Name the channels of a log.

    Args:
        group: The group of the log.

    Yields:
        Paths below the group.
    """
    for dataset in datasets(group):
        parent = dataset.parent
        if dataset.name.rpartition("/")[2] == "data" and is_member(parent, "timestamps"):
            yield parent.name.removeprefix(group.name).strip("/")


def read_channel(group: Any, path: str) -> Channel:
    """Read one channel.

    Args:
        group: The group of the log.
        path: One of `channel_paths`.

    Returns:
        The channel.

    Raises:
        FormatError: If its samples are no vectors, or there are not as many times as samples.
    """
    leaf = member(group, path)
    place = f"{group.file.filename}: {path}"
    data, seconds = dataset_numbers(member(leaf, "data")), dataset_numbers(member(leaf, "timestamps")).ravel()
    samples = len(data) if data.ndim else 0
    if data.ndim not in (2, 3) or data.shape[1] != 1 or samples != len(seconds) or not data.size:
        raise FormatError(
            f"{place}: expected vectors, of shape (samples, 1, elements), and a time for each, got {data.shape} and "
            f"{len(seconds)} times; it is no channel of a sensor"
        )
    bad = np.flatnonzero(~(np.abs(seconds) < LATEST_S))
    if len(bad):
        raise FormatError(f"{place}: sample {bad[0] + 1}: expected a time in s since 1970, got {seconds[bad[0]]:g}")
    return Channel(
        path=path,
        values=data.reshape(samples, -1),
        stamp_ns=np.rint(seconds * 1e9).astype(np.int64),
        elements=texts(member(leaf, "elements_names")) if is_member(leaf, "elements_names") else (),
        labels=texts(member(leaf, "units_of_measure")) if is_member(leaf, "units_of_measure") else (),
    )


def texts(dataset: Any) -> tuple[str, ...]:
    """Read texts of MATLAB: a cell of references to them, or one by itself.

    Args:
        dataset: A dataset of references or of characters.

    Returns:
        The texts.

    Raises:
        FormatError: If it is something else, or longer than names are.
    """
    import h5py

    require_readable([dataset])
    if dataset.dtype.kind in "ui":
        return (_text(dataset),)
    if h5py.check_ref_dtype(dataset.dtype) is not h5py.Reference or dataset.size > MOST_OBJECTS:
        raise FormatError(f"{dataset.file.filename}: {dataset.name}: expected names, got {dataset.dtype}")
    names = (h5py.h5r.get_name(reference, dataset.file.id) for reference in dataset[()].ravel())
    return tuple(_text(member(dataset.file, (name or b"").decode().strip("/"))) for name in names)


def _text(dataset: Any) -> str:
    codes = dataset_codes(dataset)
    if not codes.size or "MATLAB_empty" in dataset.attrs:
        return ""
    return str(codes.astype("<u2").tobytes().decode("utf-16-le", "replace"))


def dataset_codes(dataset: Any) -> Any:
    """Read the characters of a text as MATLAB numbers them.

    Args:
        dataset: A dataset of characters.

    Returns:
        Codes; shape (n,).

    Raises:
        FormatError: If it is no text, or longer than names are.
    """
    require_readable([dataset])
    if dataset.dtype.kind not in "ui" or not dataset.size or dataset.size > _LONGEST_NAME:
        raise FormatError(
            f"{dataset.file.filename}: {dataset.name}: expected a text of at most {_LONGEST_NAME} characters"
        )
    return dataset[()].ravel()


CLOCK = "logger"
"""The one clock of such a file: the logger stamps all channels itself, so delays of sensors are not seen."""
JOINTS = "joints_state"
"""Group of the joints."""
JOINT_QUANTITIES = {
    "positions": "position",
    "velocities": "velocity",
    "accelerations": "acceleration",
    "torques": "torque",
}
"""What its channels hold."""
SENSOR_QUANTITIES = {
    "FTs": "wrench",
    "cartesian_wrenches": "wrench",
    "temperatures": "temperature",
    "gyros": "angular_velocity",
    "accelerometers": "proper_acceleration",
    "orientations": "orientation",
}
"""What sensors of a group read."""

_SPELLINGS = {"Nm": "N m", "N*m": "N m", "N.m": "N m", "C": "degC", "°C": "degC", "celsius": "degC"}
_ONE_TURN = 6.3


def sensor_quantity(path: str) -> str | None:
    """Give the quantity that a channel of a sensor holds.

    Args:
        path: Path of the channel.

    Returns:
        The quantity, or None if the channel is not one that is read.
    """
    group, _, name = path.partition("/")
    return SENSOR_QUANTITIES.get(group) if name and "/" not in name else None


def joint_stream(
    channels: Sequence[Channel], *, name: str, joints: Sequence[str], units: Mapping[str, Sequence[str]]
) -> StreamReading:
    """Make one stream of the channels of the joints.

    Args:
        channels: Channels of `JOINT_QUANTITIES`, at least one.
        name: Name for the stream.
        joints: Joints of the log, for files whose channels do not name their elements.
        units: Units of channels without a label, by path.

    Returns:
        The stream, with the times of the first channel, and findings.

    Raises:
        FormatError: If a channel has not one element per joint.
    """
    first = channels[0]
    signals, findings = {}, []
    for channel in channels:
        if not np.array_equal(channel.stamp_ns, first.stamp_ns):
            text = f"{channel.path} has other times than {first.path}, and is left out"
            findings.append(Finding(stream=name, kind="not_read", message=text, count=len(channel.stamp_ns)))
            continue
        names = channel.elements or tuple(joints)
        width = channel.values.shape[1]
        if len(names) != width or len(set(names)) != width or not all(names):
            raise FormatError(f"{channel.path}: expected the name of each of {width} joints, got {list(names)[:8]}")
        quantity = JOINT_QUANTITIES[channel.path.rpartition("/")[2]]
        values, si_units = _in_si(channel, units, QUANTITIES[quantity].units)
        signals[quantity] = Signal(quantity=quantity, values=values, columns=names, units=si_units)
        findings += _angle_unit_findings(channel, name)
    return StreamReading(Stream(name=name, clock=CLOCK, stamp_ns=first.stamp_ns, signals=signals), tuple(findings))


def sensor_stream(
    channel: Channel, *, name: str, frame: str | None, units: Mapping[str, Sequence[str]]
) -> StreamReading:
    """Make a stream of the channel of a sensor.

    Args:
        channel: Its channel.
        name: Name for the stream.
        frame: Frame in which it reads, where it has one.
        units: Units of channels without a label, by path.

    Returns:
        The stream.

    Raises:
        FormatError: If the channel has another number of elements than such a sensor.
        UnitError: If a unit is missing, or none of the quantity.
    """
    quantity = sensor_quantity(channel.path) or ""
    form = QUANTITIES[quantity]
    if channel.values.shape[1] != len(form.columns):
        raise FormatError(
            f"{channel.path}: expected the {len(form.columns)} elements of {quantity}, got {channel.values.shape[1]}"
        )
    values, si_units = _in_si(channel, units, form.units)
    if si_units != form.units:
        raise UnitError(f"{channel.path}: expected units that convert to {form.units}, got {si_units}")
    signal = Signal.of_fixed(quantity, values, frame=frame if form.has_frame else None)
    return StreamReading(Stream(name=name, clock=CLOCK, stamp_ns=channel.stamp_ns, signals={quantity: signal}))


def orientation_stream(
    channel: Channel, *, name: str, frame: str, layout: OrientationLayout, units: Mapping[str, Sequence[str]]
) -> StreamReading:
    """Make a stream of the roll, pitch and yaw of a sensor.

    Args:
        channel: Its channel.
        name: Name for the stream.
        frame: Frame whose orientation it is.
        layout: What the angles mean.
        units: Units of channels without a label, by path.

    Returns:
        The stream, and findings.

    Raises:
        FormatError: If the channel holds something else.
        UnitError: If a unit is missing, or none of angles.
    """
    initials = tuple(element.strip()[:1] for element in channel.elements)
    if channel.values.shape[1] != layout.count or initials not in ((), ("r", "p", "y")):
        elements = f": {', '.join(channel.elements[:9])}" if channel.elements else ""
        raise FormatError(
            f"{channel.path}: expected the {layout.count} elements r, p, y, got {channel.values.shape[1]}{elements}"
        )
    values, (unit, *_) = _in_si(channel, units, (layout.unit,))
    signals, findings = orientation_signals(
        values, layout, unit=unit, frame=frame, stream=name, place=lambda row: f"{channel.path}: sample {row + 1}"
    )
    return StreamReading(Stream(name=name, clock=CLOCK, stamp_ns=channel.stamp_ns, signals=signals), findings)


def _in_si(
    channel: Channel, specified: Mapping[str, Sequence[str]], allowed: Sequence[str]
) -> tuple[FloatArray, tuple[str, ...]]:
    """Samples in SI units, by the labels of the file."""
    width = channel.values.shape[1]
    labels = _known_labels(channel, specified.get(channel.path))
    units = [si_factor(label) for label in (labels * width if len(labels) == 1 else labels)]
    if len(units) != width or not {unit for unit, _ in units} <= set(allowed):
        raise UnitError(
            f"{channel.path}: expected one unit for all, or for each of {width} elements, that converts to "
            f"{' or '.join(dict.fromkeys(allowed))}, got {', '.join(labels)}"
        )
    with np.errstate(invalid="ignore", over="ignore"):  # damaged files hold signalling NaN
        values: FloatArray = channel.values * [factor for _, factor in units]
    return values, tuple(unit for unit, _ in units)


def _known_labels(channel: Channel, specified: Sequence[str] | None) -> tuple[str, ...]:
    labels = tuple(_spelled(label) for label in channel.labels)
    known = bool(labels) and all(label in SI_FACTORS for label in labels)
    if known and specified is not None and labels != tuple(specified):
        raise UnitError(
            f"{channel.path}: the file labels it {', '.join(labels)}, units has {', '.join(specified)}; delete it"
        )
    if not known and specified is None:
        got = f"got {', '.join(map(repr, labels[:6]))}" if labels else "the file has none"
        raise UnitError(
            f"{channel.path}: expected a unit as label, {got}; specify it, such as "
            f'units = {{ "{channel.path}" = "..." }}'
        )
    return labels if known or specified is None else tuple(specified)


def _spelled(label: str) -> str:
    word = label.strip().replace("^2", "2")
    return _SPELLINGS.get(word, word)


def _angle_unit_findings(channel: Channel, stream: str) -> list[Finding]:
    """The dumper writes the label `deg` with and without its option `useRadians`."""
    largest = float(np.nanmax(np.abs(channel.values), initial=0.0))
    may_be_radians = channel.path == f"{JOINTS}/positions" and "deg" in channel.labels and 0.0 < largest < _ONE_TURN
    if not may_be_radians:
        return []
    text = (
        f"positions are labelled deg and none exceeds {largest:.3g}: a robot that hardly moved, or rad under the label "
        "that telemetryDeviceDumper always writes; look at a joint whose angle is known"
    )
    return [
        Finding(stream=stream, kind="angle_units", message=text, count=len(channel.values), size=largest, unit="deg")
    ]
