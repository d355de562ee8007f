# SPDX-License-Identifier: BSD-3-Clause
"""The stream of a topic: types of messages fix quantity and unit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.ros.bag import Bag
from forcetorque.formats.ros.messages import POSE_TYPES, Fields, TopicBatch, not_measured, topic_batches
from forcetorque.recording.orientation import OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Signal, Stream

CLOCK = "ros"
"""Clock of all streams: the stamps of headers, which ROS demands to be of one time."""

_RATES = {"position": "", "velocity": "/s", "torque": ""}


@dataclass(kw_only=True)
class Samples:
    """What was read of a topic, in batches of k messages that have one layout."""

    stamps: list[IntArray] = field(default_factory=list)
    """Stamps of the sender; shape (k,) each; ns."""
    received: list[IntArray] = field(default_factory=list)
    """When the recorder had them; shape (k,) each; ns."""
    counters: list[IntArray] = field(default_factory=list)
    """Counters of the sender, where messages have one; shape (k,) each."""
    numbers: list[dict[str, FloatArray]] = field(default_factory=list)
    """Numbers by quantity; shape (k, columns) each."""
    frames: dict[str, None] = field(default_factory=dict)
    """Frames that messages name, each once."""
    names: dict[str, None] = field(default_factory=dict)
    """Joints or channels that messages name, each once."""
    batch_names: list[tuple[str, ...]] = field(default_factory=list)
    """Those of every batch, in its order of columns."""
    order: list[IntArray] = field(default_factory=list)
    """Places of the messages among all of the topic; shape (k,) each."""

    def joined(self, name: str) -> FloatArray:
        """Put the batches of some numbers one behind the other; shape (n, k)."""
        return np.concatenate([batch[name] for batch in self.numbers])


def read_topic(bag: Bag, topic: str, *, child: str | None = None, parent: str | None = None) -> Samples:
    """Read all messages of a topic.

    Args:
        bag: The bag.
        topic: Topic, of a type in `MESSAGES`.
        child: Of poses, the frame whose pose is wanted, where messages name it.
        parent: Of poses, the frame in which they are seen, where messages name it.

    Returns:
        Its samples.

    Raises:
        FormatError: If there are none.
    """
    kind = bag.types[topic]
    samples, pairs = Samples(), set()
    for messages in topic_batches(bag, topic):
        for fields in messages.batch.fields:
            pairs.add(fields.frames if kind in POSE_TYPES else ())
            if child is None or all(
                named in ("", wanted) for named, wanted in zip(fields.frames, (parent, child), strict=False)
            ):
                _keep(samples, messages, fields)
    if not samples.stamps:
        known = ", ".join(sorted(" -> ".join(pair) for pair in pairs if pair)) or "no message"
        wanted = f"poses of {child} in {parent}" if child else "messages"
        raise FormatError(f"{bag.path}: {topic}: expected {wanted}, got {known}")
    return samples


def _keep(samples: Samples, messages: TopicBatch, fields: Fields) -> None:
    batch = messages.batch
    samples.stamps.append(batch.stamp_ns(fields.stamp))
    samples.received.append(messages.received)
    samples.order.append(messages.numbers)
    if fields.counter is not None:
        samples.counters.append(batch.counters(fields.counter))
    samples.numbers.append({name: batch.numbers(*place) for name, place in fields.numbers.items()})
    samples.frames[fields.frame] = None
    samples.names |= dict.fromkeys(fields.names)
    samples.batch_names.append(fields.names)


def topic_stream(
    bag: Bag,
    topic: str,
    *,
    name: str,
    frame: str | None,
    world: str | None,
    joint_units: Mapping[str, str],
    orientation: OrientationLayout | None = None,
) -> StreamReading:
    """Make the stream of a topic.

    Args:
        bag: The bag.
        topic: Topic, of a type in `MESSAGES`.
        name: Name for the stream.
        frame: Frame of its readings; that of its messages if None. Of poses the frame whose pose is wanted.
        world: Of poses, the frame in which that is seen.
        joint_units: Unit of joints, rad or m; rad where a joint is missing.
        orientation: What the orientations of the messages mean, to read these and nothing that an IMU measures beside.

    Returns:
        The stream, and findings.

    Raises:
        FormatError: If messages have two frames and none is specified.
    """
    samples = read_topic(bag, topic, child=None if world is None else frame, parent=world)
    order = np.argsort(np.concatenate(samples.order), kind="stable")
    stamps, stamp_findings = _stamps(samples, name, order)
    if frame is None and len(samples.frames) > 1:
        frames = ", ".join(map(repr, sorted(samples.frames)))
        raise FormatError(f"{bag.path}: {topic}: expected messages of one frame, got {frames}; specify it")
    own = next(iter(samples.frames)).strip("/") or name
    signals: dict[str, Signal]
    findings: tuple[Finding, ...] = ()
    if orientation is None:
        signals = _signals(samples, order, frame=frame or own, joint_units=joint_units)
    else:
        place = f"{bag.path}: {topic}"
        signals, findings = _pose(samples, order, orientation, name=name, frame=frame or own, place=place)
    if not signals:
        raise FormatError(f"{bag.path}: {topic}: expected messages with numbers, got none that were measured")
    counters = np.concatenate(samples.counters)[order] if samples.counters else None
    stream = Stream(
        name=name,
        clock=CLOCK,
        stamp_ns=stamps,
        signals=signals,
        # drivers that leave the counter at zero do not count
        sequence=counters if counters is not None and world is None and counters.any() else None,
    )
    return StreamReading(stream, (*stamp_findings, *findings))


def _stamps(samples: Samples, name: str, order: IntArray) -> tuple[IntArray, tuple[Finding, ...]]:
    stamps = np.concatenate(samples.stamps)[order]
    if stamps.any():
        return stamps, ()
    text = "no message has a stamp; those of the recorder are used, which are later by the transport"
    finding = Finding(stream=name, kind="recorder_stamp", message=text, count=len(stamps))
    return np.concatenate(samples.received)[order], (finding,)


def _signals(samples: Samples, order: IntArray, *, frame: str, joint_units: Mapping[str, str]) -> dict[str, Signal]:
    signals: dict[str, Signal] = {}
    for quantity in dict.fromkeys(key for batch in samples.numbers for key in batch if key in QUANTITIES):
        if quantity == "orientation":
            continue  # the rotation's sense is not specified
        if quantity in _RATES:
            units = tuple(_joint_unit(quantity, joint_units.get(joint, "rad")) for joint in samples.names)
            values = _by_joint(samples, quantity)[order]
            signals[quantity] = Signal(quantity=quantity, values=values, columns=tuple(samples.names), units=units)
            continue
        if not _missing(samples, quantity).all():
            has_frame = QUANTITIES[quantity].has_frame
            signals[quantity] = Signal.of_fixed(
                quantity, samples.joined(quantity)[order], frame=frame if has_frame else None
            )
    return signals


def _pose(
    samples: Samples, order: IntArray, layout: OrientationLayout, *, name: str, frame: str, place: str
) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    missing = _missing(samples, "orientation")
    if missing.all():
        raise FormatError(
            f"{place}: expected orientations, got messages whose covariance begins with -1: the device estimates none; "
            "leave orientation out"
        )
    rotations = np.where(missing[:, None], np.nan, samples.joined("orientation"))[order]
    numbers = np.concatenate(samples.order)[order]
    signals, findings = orientation_signals(
        rotations,
        layout,
        unit=layout.unit,
        frame=frame,
        stream=name,
        place=lambda row: f"{place}: message {numbers[row] + 1}",
    )
    if "translation" in samples.numbers[0]:
        translation = samples.joined("translation")[order]
        signals["translation"] = Signal.of_fixed("translation", translation, frame=frame)
    return signals, findings


def _missing(samples: Samples, quantity: str) -> BoolArray:
    """Messages whose driver flags that it does not measure a quantity; shape (n,)."""
    covariance = not_measured(quantity)
    if covariance not in samples.numbers[0]:
        return np.zeros(sum(map(len, samples.stamps)), dtype=bool)
    return samples.joined(covariance)[:, 0] == -1.0


def _joint_unit(quantity: str, unit: str) -> str:
    if quantity == "torque":
        return "N m" if unit == "rad" else "N"
    return unit + _RATES[quantity]


def _by_joint(samples: Samples, quantity: str) -> FloatArray:
    """Columns by name, for any order and choice of joints in a message; NaN where it lacks one."""
    columns = {joint: k for k, joint in enumerate(samples.names)}
    batches = []
    for names, numbers, stamps in zip(samples.batch_names, samples.numbers, samples.stamps, strict=True):
        values = np.full((len(stamps), len(columns)), np.nan)
        if quantity in numbers:
            values[:, [columns[joint] for joint in names]] = numbers[quantity]
        batches.append(values)
    return np.concatenate(batches)
