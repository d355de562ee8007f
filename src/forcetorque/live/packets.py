# SPDX-License-Identifier: BSD-3-Clause
"""Packets of live sensors, and an account of those that are lost, repeated, late or out of time."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.live.sample_status import Status

NUMBERS: Final = 1 << 32
"""Numbers of packets, from 0 on, where the sender has no other count of them."""
_REMEMBERED: Final = 4096
"""Sequence numbers that may still come late; a packet that lies further back means that the sender began again."""
_RESTARTED: Final = 8
"""Old packets in a row, in their order, from which on the sender began again."""
_FARTHEST: Final = 1 << 20
"""Numbers ahead from which on the sender began to count elsewhere."""
_FOLLOWED: Final = 0.1
"""Share of what a sample is off its period by which the periods move, so that they follow a clock that is off."""
_LEARNT: Final = 0.0025
"""The same share by which the period itself moves: a quarter of the square of that above damps it critically."""
_FARTHEST_RATE: Final = 0.1
"""Share by which the rate of the sender may be off the stated one."""
_FIRST: Final = 256
"""Stamps by which the period is learnt first."""
_ALIKE: Final = 0.2
"""Length of the mean unit vector from which on stamps have a period: of random ones it is longer in 1 run of 500."""
_DOUBTFUL: Final = 2
"""Samples within which one that is too early shows that one before was only late, and nothing lost."""


@dataclass(slots=True, kw_only=True, eq=False)
class Packet:
    """One sample of the sensors that are read together."""

    values: FloatArray
    """Samples; shape (s, c); counts, or N and N m."""
    variables: FloatArray | None = None
    """Variables; shape (s, v)."""
    stamp_ns: int | None = None
    """Time of the sender; ns; None where it sends none."""
    sequence: int | None = None
    """Number of the packet; None where it has none."""
    gravity: FloatArray | None = None
    """Acceleration of free fall in the frame of the reading; shape (3,); m/s2."""
    faults: list[int] | None = None
    """Bits of `Status` per sensor that the source knows of."""
    begins: bool = False
    """Whether it is the first after the sender was asked to begin again."""
    positions: FloatArray | None = None
    """Joint positions that came last; shape (d,); rad or m; None where the stream has none, or nobody looks at them."""
    group: int = 0
    """Which corrector it is for, where streams have stamps of their own."""


@dataclass(slots=True, kw_only=True)
class PacketCounts:
    """What became of packets."""

    received: int = 0
    """Packets that could be read, repeated and late ones among them."""
    lost: int = 0
    """Packets that never came, by gaps of the sequence, or of time where a rate is stated."""
    repeated: int = 0
    """Packets whose number or stamp was there already."""
    late: int = 0
    """Packets that came after one with a higher number or a later stamp."""
    backwards: int = 0
    """Packets in sequence whose stamp is older than that of an earlier one."""
    restarts: int = 0
    """Times that the sender began its numbers or stamps again."""
    unreadable: int = 0
    """Lines or datagrams that are no sample: wrong types, wrong lengths."""
    oversized: int = 0
    """Lines that are longer than a line may be."""
    foreign: int = 0
    """Datagrams from other addresses."""
    silences: int = 0
    """Times that nothing came for longer than the limit."""
    longest_silence_s: float = 0.0
    """Longest time without a packet; s."""
    countable: bool = False
    """Whether losses can be seen: packets have numbers, or stamps and a stated rate."""

    def total(self, other: PacketCounts) -> None:
        """Add the counts of another source.

        Args:
            other: Its counts.
        """
        for name in self.__slots__:
            own, added = getattr(self, name), getattr(other, name)
            if name == "longest_silence_s":
                setattr(self, name, max(own, added))
            elif name == "countable":
                self.countable = own or added
            else:
                setattr(self, name, own + added)


def _period_of(stamps_ns: list[int], stated_ns: float) -> float | None:
    """Period, ns, within a tenth of the stated one at which stamps lie best on a grid; None where at none they do."""
    at = (np.array(stamps_ns) - stamps_ns[0]) / stated_ns
    if np.ptp(at) > 4 * _FIRST:
        return None
    # the sum of unit vectors is largest where multiples of the period are the stamps; gaps do not matter to it
    rates = np.linspace(1.0 - _FARTHEST_RATE, 1.0 + _FARTHEST_RATE, 4 * _FIRST)
    alike = np.abs(np.exp(2j * np.pi * np.outer(1.0 / rates, at)).mean(axis=1))
    best = int(alike.argmax())
    return float(stated_ns * rates[best]) if alike[best] > _ALIKE else None


@dataclass(slots=True)
class _OldOnes:
    """Old numbers or stamps in a row."""

    last: int = 0
    count: int = 0

    def begin_again(self, old: int, follows: bool) -> bool:
        """Whether so many old ones followed each other that they are new ones."""
        self.last, self.count = old, self.count + 1 if follows else 1
        return self.count >= _RESTARTED


class PacketAccount:
    """Decides of each packet whether it is new, repeated or late, and counts those that are lost."""

    def __init__(self, rate_hz: float | None = None, numbers: int = NUMBERS) -> None:
        """Begin.

        Args:
            rate_hz: Stated rate of the sender, by which gaps in time are lost samples where packets have no numbers;
                the period is learnt from the stamps, up to a tenth off it; None for not known.
            numbers: Numbers of packets, from 0 on; behind the last comes 0 again.
        """
        self.counts = PacketCounts()
        self._stated_ns = self._period_ns = None if rate_hz is None else 1e9 / rate_hz
        self._numbers = numbers
        self._highest: int | None = None
        self._stamp_ns: int | None = None
        self._missing: OrderedDict[int, None] = OrderedDict()
        self._old_numbers, self._old_stamps = _OldOnes(), _OldOnes()
        self._behind, self._doubtful, self._since_gap = 0.0, 0, 0
        self._first_ns: list[int] = []

    def add(self, packet: Packet) -> Status:
        """Count a packet.

        Args:
            packet: The packet.

        Returns:
            `REPEATED` or `LATE`; 0 for a packet in its order.
        """
        self.counts.received += 1
        if packet.sequence is not None:
            self.counts.countable = True
            status = self._begin(packet.sequence) if packet.begins else self._by_number(packet.sequence)
            if not status and packet.stamp_ns is not None:
                self._follow_clock(packet.stamp_ns)
            return status
        if packet.stamp_ns is None:
            return Status(0)
        self.counts.countable = self._period_ns is not None
        status = self._by_time(packet.stamp_ns)
        if self._stated_ns is not None and len(self._first_ns) < _FIRST:
            self._first_ns.append(packet.stamp_ns)
            if len(self._first_ns) == _FIRST:
                self._count_again(1e9 / self._stated_ns)
        return status

    def _count_again(self, rate_hz: float) -> None:
        """Count the losses among the first stamps by the period that these have."""
        if (period_ns := _period_of(self._first_ns, 1e9 / rate_hz)) is None:
            return
        again = PacketAccount(rate_hz)
        again._period_ns = period_ns
        for stamp_ns in self._first_ns:
            again._by_time(stamp_ns)
        self.counts.lost, self._period_ns, self._behind = again.counts.lost, again._period_ns, again._behind
        self._doubtful, self._since_gap = again._doubtful, again._since_gap

    def _by_number(self, number: int) -> Status:
        highest = self._highest
        if highest is None:
            self._highest = number
            return Status(0)
        step = (number - highest) % self._numbers
        if step == 0:
            self.counts.repeated += 1
            return Status.REPEATED
        if step <= min(_FARTHEST, self._numbers // 2):
            self._skip(highest, step - 1)
            self._missing.pop(number, None)  # missing a round ago
            self._highest = number
            self._old_numbers.count = 0
            return Status(0)
        if step < self._numbers // 2:
            return self._begin(number)
        again = self._old_numbers.begin_again(number, number == self._old_numbers.last + 1)
        if number in self._missing:
            del self._missing[number]
            self.counts.lost -= 1
            self.counts.late += 1
            return Status.LATE
        if self._numbers - step < _REMEMBERED and not again:
            self.counts.repeated += 1
            return Status.REPEATED
        return self._begin(number)

    def _begin(self, number: int) -> Status:
        """Count from here on, as the sender does."""
        self.counts.restarts += 1
        self._missing.clear()
        self._highest, self._stamp_ns = number, None
        self._old_numbers.count = self._old_stamps.count = 0
        return Status(0)

    def _follow_clock(self, stamp_ns: int) -> None:
        """Count stamps that step back while numbers go on, until they are those of a clock that began again."""
        if self._stamp_ns is not None and stamp_ns < self._stamp_ns and not self._stamps_begin_again(stamp_ns):
            self.counts.backwards += 1
        elif stamp_ns != self._stamp_ns:
            self._stamp_ns, self._old_stamps.count = stamp_ns, 0

    def _stamps_begin_again(self, stamp_ns: int) -> bool:
        again = self._old_stamps.begin_again(stamp_ns, stamp_ns > self._old_stamps.last)
        self.counts.restarts += again
        return again

    def _skip(self, highest: int, count: int) -> None:
        self.counts.lost += count
        if count >= _REMEMBERED:
            self._missing.clear()
        for number in range(highest + max(1, count - _REMEMBERED + 1), highest + count + 1):
            self._missing[number % self._numbers] = None
            self._missing.move_to_end(number % self._numbers)
        while len(self._missing) > _REMEMBERED:
            self._missing.popitem(last=False)

    def _by_time(self, stamp_ns: int) -> Status:
        before = self._stamp_ns
        if before is not None and stamp_ns <= before:
            if stamp_ns == before:
                self.counts.repeated += 1
                return Status.REPEATED
            if self._stamps_begin_again(stamp_ns):
                self._stamp_ns, self._old_stamps.count, self._behind = stamp_ns, 0, 0.0
                return Status(0)
            if not self._is_found():
                self._behind -= 1.0
            self.counts.late += 1
            self.counts.backwards += 1
            return Status.LATE
        if before is not None and self._period_ns is not None and self._stated_ns is not None:
            periods = (stamp_ns - before) / self._period_ns + self._behind
            steps = round(periods)
            if steps > 1:
                self.counts.lost += steps - 1
                self._doubtful, self._since_gap = steps - 1, 0
            elif steps == 1 or not self._is_found():
                steps = 1
            self._since_gap += 1
            off = max(-1.0, periods - steps)
            self._behind = (1.0 - _FOLLOWED) * off
            # of other samples it is not known whether they are late or one is lost
            learnt = _LEARNT * off if steps == 1 and abs(off) <= 0.5 else 0.0
            period_ns = self._period_ns * (1.0 + learnt)
            farthest_ns = _FARTHEST_RATE * self._stated_ns
            self._period_ns = min(max(period_ns, self._stated_ns - farthest_ns), self._stated_ns + farthest_ns)
        self._stamp_ns, self._old_stamps.count = stamp_ns, 0
        return Status(0)

    def _is_found(self) -> bool:
        """Take back a loss just before, as the sample is there."""
        if not self._doubtful or self._since_gap > _DOUBTFUL:
            return False
        self._doubtful -= 1
        self.counts.lost -= 1
        return True
