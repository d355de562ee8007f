# SPDX-License-Identifier: BSD-3-Clause
"""The last samples of a run, as who looks at it gets them: in order, complete, and never of two moments at once."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import numpy as np
import pytest

from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.option_values import FaultPolicy, HeldQuantity
from forcetorque.live.packets import Packet
from forcetorque.live.recent_samples import RecentSamples
from forcetorque.live.result import Samples
from forcetorque.live.sample_status import Status
from tests.scenes.calibrations import FACTORY, make_calibration

RAW = np.array([[100.0, -200.0, 300.0, -400.0, 500.0, -600.0]])
MS = 10**6


class Taken:
    """A ring, and what is given to it."""

    def __init__(self, *quantities: HeldQuantity, kept: int = 8, policy: FaultPolicy = FaultPolicy.FLAG) -> None:
        options = [CorrectorOptions(quantity=one, policy=policy) for one in quantities or (HeldQuantity.RAW,)]
        self.correctors = [Corrector(make_calibration(name=f"leg{k}"), one) for k, one in enumerate(options)]
        self.recent = RecentSamples(self.correctors, joints=1, kept=kept)

    def take(self, stamp_ns: int, *, scale: float = 1.0, group: int = 0, fault: Status | None = None) -> None:
        values = (1.0 + 1e-3 * scale) * RAW  # not frozen
        packet = Packet(values=values, stamp_ns=stamp_ns, group=group, positions=np.array([scale]))
        corrector = self.correctors[group]
        faults = None if fault is None else [int(fault)]
        self.recent.take(packet, corrector.correct(values, stamp_ns=stamp_ns, faults=faults), stamp_ns)

    def all(self) -> Samples:
        return self.recent.since(0, 1000)


def _times(samples: Samples) -> Sequence[float]:
    return np.round(samples.time_s, 9).tolist()


def test_samples_come_in_order_and_old_ones_leave() -> None:
    """A reader gets what came since it asked, at most what is kept, and learns where that begins."""
    taken = Taken()
    for k in range(30):
        taken.take(5 * 10**9 + k * 10 * MS, scale=k)
    samples = taken.recent.since(25, 3)
    assert (samples.first, samples.next) == (25, 28)
    assert _times(samples) == [0.25, 0.26, 0.27]
    assert samples.positions[:, 0].tolist() == [25.0, 26.0, 27.0]
    assert samples.stamp_ns[0] == 5 * 10**9 + 250 * MS
    expected = make_calibration().apply(1.025 * RAW, serial="SN001")
    assert np.allclose(samples.wrench[0, 0], expected[0], rtol=1e-6)
    assert np.allclose(samples.reading[0, 0], 1.025 * FACTORY @ RAW[0], rtol=1e-12)
    assert taken.recent.since(0, 1000).first == 22
    assert len(taken.recent.since(30, 1000).time_s) == len(taken.recent.since(99, 1000).time_s) == 0


def test_repeated_and_late_samples_have_no_place() -> None:
    """They are in the counts and the lines, not on a page."""
    taken = Taken()
    for k, fault in enumerate([None, Status.REPEATED, Status.LATE, None]):
        taken.take(k * MS, fault=fault)
    assert _times(taken.all()) == [0.0, 0.003]


def test_a_silence_breaks_the_lines() -> None:
    """One empty sample stands between."""
    taken = Taken()
    taken.take(0)
    taken.take(3 * 10**9)
    samples = taken.all()
    assert _times(samples) == [0.0, 0.0, 3.0]
    assert np.isnan(samples.wrench[:, 0, 0]).tolist() == [False, True, False]


def test_a_sender_that_begins_again_goes_on_where_it_was() -> None:
    """Its new stamps are small; time on the page does not step back."""
    taken = Taken()
    for stamp_s in (100.0, 100.5, 1.0, 1.5):
        if stamp_s == 1.0:
            taken.correctors[0].restart_time()  # as the run does
        taken.take(round(stamp_s * 1e9))
    assert _times(taken.all()) == [0.0, 0.5, 0.5, 1.0]


def test_streams_with_clocks_of_their_own_stand_side_by_side() -> None:
    """The last sample of the other one is beside each, until it is half a second old."""
    taken = Taken(HeldQuantity.RAW, HeldQuantity.WRENCH)
    taken.take(10**12)
    taken.take(7, group=1)
    taken.take(10**12 + 400 * MS)
    taken.take(10**12 + 600 * MS)
    samples = taken.all()
    assert _times(samples) == [0.0, 0.0, 0.4, 0.6]
    assert samples.came.tolist() == [[True, False], [False, True], [True, False], [True, False]]
    assert np.isnan(samples.wrench[:, 0, 0]).tolist() == [False] * 4
    assert np.isnan(samples.wrench[:, 1, 0]).tolist() == [True, False, False, True]
    assert np.allclose(samples.reading[1, 1], 1.001 * RAW[0])


@pytest.mark.parametrize("policy", [FaultPolicy.FLAG, FaultPolicy.REFUSE])
def test_a_refused_sample_is_a_gap(policy: FaultPolicy) -> None:
    """As it has no line; a flagged one is drawn."""
    taken = Taken(policy=policy)
    taken.take(0, fault=Status.DEVICE)
    assert np.isnan(taken.all().wrench).all() == (policy is FaultPolicy.REFUSE)


def test_a_reader_in_another_thread_gets_samples_of_one_moment() -> None:
    """Time and position of every copied sample are of the same packet, while the ring turns many times."""
    taken = Taken(kept=64)
    torn, copies, ended = [], 0, threading.Event()

    def read() -> None:
        nonlocal copies
        while not ended.is_set() or not copies:
            samples = taken.recent.since(0, 64)
            copies += 1
            torn.append(float(np.abs(samples.time_s * 1e3 - samples.positions[:, 0]).max(initial=0.0)))

    reader = threading.Thread(target=read)
    reader.start()
    for k in range(5000):
        taken.take(k * MS, scale=k)
    ended.set()
    reader.join()
    assert max(torn) < 1e-6
