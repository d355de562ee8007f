# SPDX-License-Identifier: BSD-3-Clause
"""From channels of robometry to streams: what each holds is its place in the file, its unit the file's label."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, UnitError
from forcetorque.base.units import SI_FACTORS, si_factor
from forcetorque.formats.robometry.channel import Channel
from forcetorque.recording.orientation import OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Signal, Stream

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
    """Tell what a channel of a sensor holds.

    Args:
        path: Path of the channel.

    Returns:
        The quantity, or None if the channel is not one that is read.
    """
    group, _, name = path.partition("/")
    return SENSOR_QUANTITIES.get(group) if name and "/" not in name else None


def joint_stream(
    channels: Sequence[Channel], *, name: str, joints: Sequence[str], units: Mapping[str, Sequence[str]]
) -> tuple[Stream, tuple[Finding, ...]]:
    """Make one stream of the channels of the joints.

    Args:
        channels: Channels of `JOINT_QUANTITIES`, at least one.
        name: Name for the stream.
        joints: Joints of the log, for files whose channels do not name their elements.
        units: Units of channels without a label, by path.

    Returns:
        The stream, with the times of the first channel, and what is doubtful in it.

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
        findings += _doubtful_angles(channel, name)
    return Stream(name=name, clock=CLOCK, stamp_ns=first.stamp_ns, signals=signals), tuple(findings)


def sensor_stream(channel: Channel, *, name: str, frame: str | None, units: Mapping[str, Sequence[str]]) -> Stream:
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
    return Stream(name=name, clock=CLOCK, stamp_ns=channel.stamp_ns, signals={quantity: signal})


def orientation_stream(
    channel: Channel, *, name: str, frame: str, layout: OrientationLayout, units: Mapping[str, Sequence[str]]
) -> tuple[Stream, tuple[Finding, ...]]:
    """Make a stream of the roll, pitch and yaw of a sensor.

    Args:
        channel: Its channel.
        name: Name for the stream.
        frame: Frame whose orientation it is.
        layout: What the angles mean.
        units: Units of channels without a label, by path.

    Returns:
        The stream, and what is doubtful in it.

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
    return Stream(name=name, clock=CLOCK, stamp_ns=channel.stamp_ns, signals=signals), findings


def _in_si(
    channel: Channel, stated: Mapping[str, Sequence[str]], allowed: Sequence[str]
) -> tuple[FloatArray, tuple[str, ...]]:
    """Samples in SI units, by the labels of the file."""
    width = channel.values.shape[1]
    labels = _known_labels(channel, stated.get(channel.path))
    units = [si_factor(label) for label in (labels * width if len(labels) == 1 else labels)]
    if len(units) != width or not {unit for unit, _ in units} <= set(allowed):
        raise UnitError(
            f"{channel.path}: expected one unit for all, or for each of {width} elements, that converts to "
            f"{' or '.join(dict.fromkeys(allowed))}, got {', '.join(labels)}"
        )
    with np.errstate(invalid="ignore", over="ignore"):  # damaged files hold signalling NaN
        values: FloatArray = channel.values * [factor for _, factor in units]
    return values, tuple(unit for unit, _ in units)


def _known_labels(channel: Channel, stated: Sequence[str] | None) -> tuple[str, ...]:
    labels = tuple(_spelled(label) for label in channel.labels)
    known = bool(labels) and all(label in SI_FACTORS for label in labels)
    if known and stated is not None and labels != tuple(stated):
        raise UnitError(
            f"{channel.path}: the file labels it {', '.join(labels)}, units states {', '.join(stated)}; delete it"
        )
    if not known and stated is None:
        got = f"got {', '.join(map(repr, labels[:6]))}" if labels else "the file has none"
        raise UnitError(
            f'{channel.path}: expected a unit as label, {got}; state it, such as units = {{ "{channel.path}" = "..." }}'
        )
    return labels if known or stated is None else tuple(stated)


def _spelled(label: str) -> str:
    word = label.strip().replace("^2", "2")
    return _SPELLINGS.get(word, word)


def _doubtful_angles(channel: Channel, stream: str) -> list[Finding]:
    """The dumper writes the label `deg` whatever its option `useRadians` says."""
    largest = float(np.nanmax(np.abs(channel.values), initial=0.0))
    doubtful = channel.path == f"{JOINTS}/positions" and "deg" in channel.labels and 0.0 < largest < _ONE_TURN
    if not doubtful:
        return []
    text = (
        f"positions are labelled deg and none exceeds {largest:.3g}: a robot that hardly moved, or rad under the label "
        "that telemetryDeviceDumper always writes; look at a joint whose angle is known"
    )
    return [
        Finding(stream=stream, kind="angle_units", message=text, count=len(channel.values), size=largest, unit="deg")
    ]
