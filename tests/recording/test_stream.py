# SPDX-License-Identifier: BSD-3-Clause
"""Signals, streams and recordings refuse what contradicts itself, and nobody can change them afterwards."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, replace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError, RecordingError, ShapeError
from forcetorque.recording.recording import Finding, Interval, Recording, Use
from forcetorque.recording.stream import QUANTITIES, Labels, Signal, Stream
from tests.recording.recordings import recording, refused, signal, stream

WRENCH = {
    "quantity": "wrench",
    "values": np.zeros((2, 6)),
    "columns": QUANTITIES["wrench"].columns,
    "units": QUANTITIES["wrench"].units,
    "frame": "ft",
}
JOINTS = {"quantity": "position", "values": np.zeros((2, 2)), "columns": ("hip", "lift"), "units": ("rad", "m")}


@pytest.mark.parametrize("fields", [WRENCH, JOINTS], ids=["wrench", "position"])
def test_valid_signals_are_accepted(fields: dict[str, Any]) -> None:
    """What the refusals below start from is valid; every column is found by its name."""
    held = Signal(**fields)
    assert len(held.columns) == held.values.shape[1] > 1
    for k, name in enumerate(held.columns):
        np.testing.assert_array_equal(held.column(name), held.values[:, k])


@pytest.mark.parametrize(
    ("fields", "change", "kind", "match"),
    [
        (WRENCH, {"quantity": "wrenches"}, RecordingError, 'no quantity is called .*did you mean "wrench"'),
        (
            WRENCH,
            {"values": np.zeros((2, 5))},
            ShapeError,
            r"wrench: expected an array of shape \(n, 6\), got \(2, 5\)",
        ),
        (WRENCH, {"values": np.zeros(6)}, ShapeError, r"got \(6,\)"),
        (WRENCH, {"columns": WRENCH["columns"][::-1]}, RecordingError, "convert or reorder them when reading"),
        (WRENCH, {"units": ("N",) * 6}, RecordingError, "wrench: expected the columns .* in .*N m"),
        (WRENCH, {"frame": None}, RecordingError, "wrench: expected the frame of its axes, got None"),
        (JOINTS, {"frame": "ft"}, RecordingError, "position: expected no frame, got 'ft'"),
        (JOINTS, {"columns": ("hip", "hip")}, RecordingError, "each name once, got"),
        (JOINTS, {"columns": (), "values": np.zeros((2, 0)), "units": ()}, RecordingError, "at least one column"),
        (JOINTS, {"units": ("rad",)}, RecordingError, "expected one unit out of .* for each of 2 columns"),
        (JOINTS, {"units": ("rad", "deg")}, RecordingError, "got .*'deg'.*; convert when reading"),
    ],
)
def test_contradicting_signals_are_refused(
    fields: dict[str, Any], change: dict[str, Any], kind: type[ForceTorqueError], match: str
) -> None:
    """Each single change that makes a valid signal contradict itself is refused."""
    with refused(kind, match):
        Signal(**fields | change)


def test_unknown_columns_and_signals_are_named_with_the_known_ones() -> None:
    """A name that is not there brings the names that are."""
    held = stream([1, 2], Signal(**JOINTS))
    with refused(RecordingError, r"position: no column 'hips'; did you mean \"hip\"\? known: hip, lift"):
        held.signal("position").column("hips")
    with refused(RecordingError, "stream 's' has no velocity; known: position"):
        held.signal("velocity")
    with refused(RecordingError, "the recording has no stream 't'; known: s"):
        recording(held).stream("t")


@pytest.mark.parametrize(
    ("change", "kind", "match"),
    [
        ({"stamp_ns": [1.0, 2.0]}, ShapeError, r"s: stamp_ns: expected integers of shape \(n,\), got float64"),
        ({"stamp_ns": [[1], [2]]}, ShapeError, r"got int64 of shape \(2, 1\)"),
        (
            {"stamp_ns": np.array([1, 2**63], dtype=np.uint64)},
            ShapeError,
            "64 bits with a sign, got 9223372036854775808",
        ),
        ({"stamp_ns": [1, 2, 3]}, ShapeError, "stream 's': 2 samples of position for 3 stamps"),
        ({"sequence": [1]}, ShapeError, "s: 1 sequence numbers for 2 stamps"),
        ({"sequence": [0.5, 1.5]}, ShapeError, "s: sequence: expected integers"),
        ({"signals": {}}, RecordingError, "stream 's': expected at least one signal, got none"),
        ({"signals": {"raw": Signal(**JOINTS)}}, RecordingError, "the key 'raw' holds the quantity 'position'"),
    ],
)
def test_contradicting_streams_are_refused(change: dict[str, Any], kind: type[ForceTorqueError], match: str) -> None:
    """Each single change that makes a valid stream contradict itself is refused."""
    fields: dict[str, Any] = {"name": "s", "clock": "c", "stamp_ns": [1, 2], "signals": {"position": Signal(**JOINTS)}}
    assert len(Stream(**fields)) == 2
    with refused(kind, match):
        Stream(**fields | change)


def test_empty_streams_are_streams() -> None:
    """A device that sent nothing has a stream without samples, also where the list of stamps has no type."""
    empty = stream([], signal("raw", np.zeros((0, 6))))
    assert len(empty) == 0
    assert empty.stamp_ns.dtype == np.int64


def test_the_key_of_a_stream_is_its_name() -> None:
    """A recording cannot call a stream otherwise than the stream calls itself."""
    with refused(RecordingError, "the key 'other' holds the stream 's'"):
        Recording(streams={"other": stream([1, 2])})


def test_labels_of_intervals_are_unique() -> None:
    """Two intervals with one label are refused, with the label; other intervals may replace them."""
    first, second = (Interval(label="a", start_ns=k, end_ns=9, use=Use.IGNORE, support=None) for k in (1, 2))
    with refused(RecordingError, "2 intervals are labelled 'a'; give each its own label"):
        recording(stream([1]), intervals=(first, second))
    other = recording(stream([1]), intervals=(first,)).with_intervals([replace(second, label="b")])
    assert [interval.label for interval in other.intervals] == ["b"]


def test_the_span_covers_all_streams() -> None:
    """Second 0 is the earliest stamp of any stream, in whatever order stamps came; empty streams do not count."""
    streams = (stream([50, 20, 30], name="a"), stream([40, 60], name="b"), stream([], name="c"))
    assert recording(*streams).span_ns == (20, 60)
    assert recording(*streams).start_ns == 20
    with refused(RecordingError, "the recording holds no sample in any stream"):
        _ = recording(stream([])).span_ns


def test_joints_are_found_in_whatever_stream_holds_them() -> None:
    """Every joint has one stream per quantity; two streams with the same joint are refused."""
    legs = stream([1], signal("position", [[1.0, 2.0]], ("hip", "knee")), name="legs")
    arms = stream([1], signal("position", [[3.0]], ("elbow",)), signal("velocity", [[4.0]], ("knee",)), name="arms")
    found = recording(legs, arms).joint_signals("position")
    assert {joint: held.name for joint, (held, _) in found.items()} == {"hip": "legs", "knee": "legs", "elbow": "arms"}
    assert list(recording(legs, arms).joint_signals("velocity")) == ["knee"]
    again = stream([1], signal("position", [[1.0]], ("knee",)), name="again")
    with refused(RecordingError, "joint 'knee' is in the streams 'legs' and 'again'; keep one"):
        recording(legs, arms, again).joint_signals("position")


def test_nobody_can_change_a_recording() -> None:
    """Arrays are read-only copies, mappings cannot be assigned to, lists that were handed in are copied."""
    values, stamps, intervals = (
        np.zeros((2, 1)),
        np.array([1, 2]),
        [Finding(stream="s", kind="k", message="m", count=1)],
    )
    held = stream(stamps, signal("position", values), sequence=stamps)
    whole = recording(held, findings=intervals)
    values[:], stamps[:] = 7.0, 7
    intervals.clear()
    assert not held.signal("position").values.any()
    assert held.stamp_ns.tolist() == [1, 2]
    assert len(whole.findings) == 1
    with pytest.raises(ValueError, match="read-only"):
        held.signal("position").values[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        held.stamp_ns[0] = 1
    with pytest.raises(TypeError, match="does not support item assignment"):
        whole.streams["t"] = held  # type: ignore[index]
    with pytest.raises(TypeError, match="does not support item assignment"):
        held.signals["raw"] = held.signal("position")  # type: ignore[index]
    with pytest.raises(FrozenInstanceError, match="clock"):
        held.clock = "other"  # type: ignore[misc]


def test_every_quantity_is_complete() -> None:
    """Fixed columns have one unit each, free ones a choice of units, a scalar any; every name is its key."""
    assert len(QUANTITIES) >= 8
    for key, quantity in QUANTITIES.items():
        assert quantity.name == key
        assert bool(quantity.units) is (quantity.name != "scalar")
        assert quantity.description.endswith(".")
        assert len(quantity.columns) == (len(quantity.units) if quantity.labels is Labels.FIXED else 0)
