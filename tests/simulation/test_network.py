# SPDX-License-Identifier: BSD-3-Clause
"""Faults of a network are found by the findings, as many as were asked for, also through a folder of logs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RecordingError
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_state_ext
from forcetorque.formats.yarp.log_format import PortKind
from forcetorque.formats.yarp.writing import StreamPort, write_ports
from forcetorque.recording.alignment import require_overlap
from forcetorque.recording.recording import Finding, Recording
from forcetorque.recording.stream import Stream
from forcetorque.recording.stream_faults import stream_findings
from forcetorque.simulation.network_faults import (
    fail_groups,
    jitter_stamps,
    lose_messages,
    offset_clocks,
    step_back,
)
from forcetorque.simulation.simulated_sensor import calibrated_by_board
from tests.recording.recordings import described, even_stamps, recording, refused, signal, stream

N = 500
PERIOD_NS = 10_000_000
JOINTS = ("a", "b", "c")


def _clean() -> Recording:
    """A sensor and three joints, evenly stamped, with nothing to find."""
    rng = np.random.default_rng(3)
    ft = stream(even_stamps(N), signal("wrench", rng.normal(size=(N, 6))), name="ft", sequence=100 + np.arange(N))
    leg = stream(even_stamps(N) + 3_000_000, signal("position", rng.normal(size=(N, 3))), name="leg")
    return recording(ft, leg)


def _found(held: Stream) -> dict[str, list[Finding]]:
    found: dict[str, list[Finding]] = {}
    for finding in stream_findings(held):
        found.setdefault(finding.kind, []).append(finding)
    return found


Fault = Callable[[Recording, int], Recording]
FAULTS: dict[str, Fault] = {
    "jitter": lambda r, seed: jitter_stamps(r, largest_s=0.002, rng=np.random.default_rng(seed)),
    "loss": lambda r, seed: lose_messages(r, bursts=7, length=2, rng=np.random.default_rng(seed)),
    "repeated": lambda r, seed: step_back(r, count=5, seconds=0.0, rng=np.random.default_rng(seed)),
    "backward": lambda r, seed: step_back(r, count=5, seconds=0.002, rng=np.random.default_rng(seed)),
    "failed": lambda r, seed: fail_groups(r, quantity="position", bursts=4, length=3, rng=np.random.default_rng(seed)),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_seed_gives_the_same_bits_and_the_argument_stays(name: str) -> None:
    """Twice the same seed is the same recording, another seed is another, and what came in is as it was."""
    clean = _clean()
    before = described(clean)
    first, again, other = (described(FAULTS[name](clean, seed)) for seed in (1, 1, 2))
    assert first == again
    assert first != other
    assert first != before
    assert described(clean) == before


def test_a_clean_recording_has_nothing_to_find() -> None:
    """Negative control of all the counts below."""
    for held in _clean().streams.values():
        assert stream_findings(held) == ()


@pytest.mark.parametrize(("bursts", "length"), [(1, 1), (7, 2), (12, 10), (249, 1)])
def test_lost_messages_are_counted_by_their_sequence(bursts: int, length: int) -> None:
    """One finding per burst, each of its length; the last number is still that of the last message."""
    lossy = lose_messages(_clean(), bursts=bursts, length=length, rng=np.random.default_rng(4), streams=["ft"])
    held = lossy.stream("ft")
    assert len(held) == N - bursts * length
    assert (held.sequence[0], held.sequence[-1]) == (100, 100 + N - 1)  # type: ignore[index]
    lost = _found(held)["lost_messages"]
    assert [finding.count for finding in lost] == [length] * bursts
    assert ("gap" in _found(held)) == (length >= 5 and bursts < 249)
    np.testing.assert_array_equal(held.stamp_ns, even_stamps(N)[held.sequence - 100])  # type: ignore[operator]
    assert len(lossy.stream("leg")) == N


def test_a_stream_without_sequence_numbers_gets_them() -> None:
    """Without them a loss could not be counted."""
    held = lose_messages(_clean(), bursts=3, rng=np.random.default_rng(4)).stream("leg")
    assert [finding.count for finding in _found(held)["lost_messages"]] == [1, 1, 1]


def test_repeated_and_backward_stamps_are_counted() -> None:
    """As many as were asked for, of the size that was asked for, and nothing else."""
    repeated = _found(step_back(_clean(), count=9, seconds=0.0, rng=np.random.default_rng(5)).stream("ft"))
    assert {kind: [f.count for f in found] for kind, found in repeated.items()} == {"repeated_stamp": [9]}
    backward = _found(step_back(_clean(), count=9, seconds=0.004, rng=np.random.default_rng(5)).stream("ft"))
    assert {kind: [f.count for f in found] for kind, found in backward.items()} == {"backward_stamp": [9]}
    assert backward["backward_stamp"][0].size == pytest.approx(0.004, abs=1e-9)


def test_failed_groups_are_missing_values_of_all_columns() -> None:
    """One finding per burst, each of its length; other streams and quantities are left alone."""
    failed = fail_groups(_clean(), quantity="position", bursts=6, length=4, rng=np.random.default_rng(6))
    found = _found(failed.stream("leg"))
    assert {kind: [f.count for f in each] for kind, each in found.items()} == {"missing": [4] * 6}
    missing = np.isnan(failed.stream("leg").signal("position").values)
    assert missing.sum() == 6 * 4 * len(JOINTS)
    assert _found(failed.stream("ft")) == {}


def test_jitter_stays_within_its_bound_and_is_centred() -> None:
    """Uniform both ways: bounded, mean zero within four standard errors, standard deviation bound / sqrt 3."""
    moved = jitter_stamps(_clean(), largest_s=0.004, rng=np.random.default_rng(7))
    moves = (moved.stream("ft").stamp_ns - even_stamps(N)) * 1e-9
    assert 0.0035 < np.abs(moves).max() <= 0.004
    deviation = 0.004 / np.sqrt(3.0)
    assert abs(moves.mean()) < 4.0 * deviation / np.sqrt(N)
    assert moves.std() == pytest.approx(deviation, rel=0.1)
    assert _found(moved.stream("ft")) == {}
    wild = jitter_stamps(_clean(), largest_s=0.012, rng=np.random.default_rng(7))
    assert "backward_stamp" in _found(wild.stream("ft"))


def test_clocks_that_are_apart_keep_their_name_unless_told() -> None:
    """The stamps move by the offset exactly; only a clock that is known to be apart is called otherwise."""
    clean = _clean()
    apart = offset_clocks(clean, {"leg": 0.25})
    np.testing.assert_array_equal(apart.stream("leg").stamp_ns - clean.stream("leg").stamp_ns, 250_000_000)
    np.testing.assert_array_equal(apart.stream("ft").stamp_ns, clean.stream("ft").stamp_ns)
    require_overlap(apart.stream("ft"), apart.stream("leg"))
    known = offset_clocks(clean, {"leg": 0.25}, clocks={"leg": "board"})
    with refused(RecordingError, "stamped by the clocks 'robot' and 'board'"):
        require_overlap(known.stream("ft"), known.stream("leg"))


def test_streams_of_one_port_suffer_the_same_faults() -> None:
    """Streams with the same stamps and sequence are one port's: they lose the same messages, others do not."""
    clean = _clean()
    twin = replace(clean.stream("ft"), name="twin")
    other = replace(clean.stream("ft"), name="other", stamp_ns=clean.stream("ft").stamp_ns + 1)
    made = replace(clean, streams={**clean.streams, "twin": twin, "other": other})
    lossy = jitter_stamps(
        lose_messages(made, bursts=9, rng=np.random.default_rng(8)), largest_s=0.002, rng=np.random.default_rng(9)
    )
    np.testing.assert_array_equal(lossy.stream("ft").stamp_ns, lossy.stream("twin").stamp_ns)
    np.testing.assert_array_equal(lossy.stream("ft").sequence, lossy.stream("twin").sequence)
    assert lossy.stream("ft").sequence.tolist() != lossy.stream("other").sequence.tolist()  # type: ignore[union-attr]


def test_what_does_not_fit_is_refused() -> None:
    """Too many faults, an unknown stream, a quantity that nobody has."""
    rng = np.random.default_rng(1)
    with refused(RecordingError, "expected room for 250 segments of 1 message.s. that do not touch, got 500 messages"):
        lose_messages(_clean(), bursts=250, rng=rng)
    with refused(RecordingError, "expected 0 or more faults of 1 or more messages, got 1 of 0"):
        lose_messages(_clean(), bursts=1, length=0, rng=rng)
    with refused(RecordingError, "no stream 'fd'; known: ft, leg"):
        step_back(_clean(), count=1, seconds=0.0, rng=rng, streams=["fd"])
    with refused(RecordingError, "expected a stream with temperature to fail"):
        fail_groups(_clean(), quantity="temperature", bursts=1, rng=rng)
    with refused(RecordingError, "no stream 'arm'"):
        offset_clocks(_clean(), {"arm": 1.0})


def test_the_faults_of_a_network_arrive_through_its_logs(tmp_path: Path) -> None:
    """Written as a folder and read, every fault is found as often as it was injected, on both ports."""
    rng = np.random.default_rng(10)
    faulty = lose_messages(_clean(), bursts=8, length=3, rng=rng)
    faulty = step_back(faulty, count=6, seconds=0.0, rng=rng, streams=["ft"])
    faulty = fail_groups(faulty, quantity="position", bursts=5, length=2, rng=rng)
    faulty = offset_clocks(faulty, {"leg": -0.125})
    ports = [
        StreamPort(path="ft/analog:o", kind=PortKind.ANALOG, stream="ft"),
        StreamPort(path="leg/stateExt:o", kind=PortKind.STATE_EXT, stream="leg"),
    ]
    write_ports(tmp_path / "log", faulty, ports)
    ft = read_analog(tmp_path / "log" / "ft/analog:o", stream="ft", frame="frame")
    leg = read_state_ext(tmp_path / "log" / "leg/stateExt:o", stream="leg", joints=JOINTS)
    (repeated,) = _found(ft.stream)["repeated_stamp"]
    assert repeated.count == 6
    for reading in (ft, leg):
        assert [finding.count for finding in _found(reading.stream)["lost_messages"]] == [3] * 8
    assert [finding.count for finding in leg.findings if finding.kind == "failed_group"] == [10]
    assert sum(finding.count for finding in _found(leg.stream)["missing"]) == 10
    assert leg.stream.stamp_ns[0] == _clean().stream("leg").stamp_ns[0] - 125_000_000


def test_a_board_turns_counts_into_a_wrench() -> None:
    """By hand: the matrix times the counts, in the sensor's frame; other streams and signals are kept."""
    counts = np.arange(12.0).reshape(2, 6)
    raw = stream(even_stamps(2), signal("raw", counts), signal("temperature", [[30.0], [31.0]]), name="ft")
    made = calibrated_by_board(recording(raw), "ft", matrix=np.diag([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), frame="foot")
    wrench = made.stream("ft").signal("wrench")
    assert wrench.frame == "foot"
    np.testing.assert_array_equal(wrench.values, [[0, 2, 6, 12, 20, 30], [6, 14, 24, 36, 50, 66]])
    assert list(made.stream("ft").signals) == ["wrench", "temperature"]
    with refused(RecordingError, "has no raw"):
        calibrated_by_board(made, "ft", matrix=np.eye(6), frame="foot")
