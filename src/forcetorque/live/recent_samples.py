# SPDX-License-Identifier: BSD-3-Clause
"""The last corrected samples of a run, for who looks at it from another thread and is never waited for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.live.corrector import Corrected, Corrector
from forcetorque.live.option_values import FaultPolicy, HeldQuantity
from forcetorque.live.packets import Packet
from forcetorque.live.result import Samples
from forcetorque.live.sample_status import FAULTS, Status

KEPT: Final = 60_000
"""Samples that are kept: a minute at 1 kHz."""
_OLD: Final = int(Status.REPEATED | Status.LATE)
_SECOND_NS: Final = 10**9
"""A gap in time from which on lines are broken, and a step back from which on the sender began again; ns."""
_HELD_NS: Final = _SECOND_NS // 2
"""Age at which the last sample of another stream is no longer shown beside new ones; ns."""


class RecentSamples:
    """Keeps the last samples. One thread takes them, any thread reads them: without a lock, so that none waits."""

    def __init__(self, correctors: Sequence[Corrector], *, joints: int = 0, kept: int = KEPT) -> None:
        """Allocate.

        Args:
            correctors: One for each group of sensors.
            joints: Joints whose positions come with packets.
            kept: Samples to keep.
        """
        sizes = [len(corrector.calibrations) for corrector in correctors]
        ends = np.cumsum(sizes).tolist()
        self._sensors = [slice(end - size, end) for end, size in zip(ends, sizes, strict=True)]
        self._refuses = [corrector.options.policy is FaultPolicy.REFUSE for corrector in correctors]
        self._to_reading = [
            _reading_matrix(one, corrector) for corrector in correctors for one in corrector.calibrations
        ]
        self.kept, self._size = kept, 2 * kept  # what is read is not what is written next
        channels = max(corrector.channels for corrector in correctors)
        shape = (self._size, ends[-1])
        self._time_ns, self._stamp_ns = np.zeros((2, self._size), dtype=np.int64)
        self._came = np.zeros(shape, dtype=np.bool_)
        self._wrench, self._half_width = (np.full((*shape, 6), np.nan, dtype=np.float32) for _ in range(2))
        self._sample = np.full((*shape, channels), np.nan)
        self._positions = np.full((self._size, joints), np.nan, dtype=np.float32)
        self._origin_ns: list[int | None] = [None] * len(sizes)
        self._came_ns = [0] * len(sizes)
        self._last_ns = 0
        self.total = 0
        """Samples so far."""

    def take(self, packet: Packet, corrected: Corrected, stamp_ns: int) -> None:
        """Keep a sample; repeated and late ones have no place in time and are left out.

        Args:
            packet: As it came.
            corrected: The same, corrected.
            stamp_ns: Its time; ns.
        """
        statuses = corrected.status.tolist()
        if all(status & _OLD for status in statuses):
            return
        group, sensors = packet.group, self._sensors[packet.group]
        now_ns = self._instant_ns(group, stamp_ns)
        if now_ns - self._last_ns > _SECOND_NS:
            self._begin(self._last_ns, stamp_ns)
            self.total += 1
        place = self._begin(now_ns, stamp_ns)
        if len(self._sensors) > 1:
            self._hold_others(place, group, now_ns)
        self._came[place, sensors] = True
        self._wrench[place, sensors], self._half_width[place, sensors] = corrected.wrench, corrected.half_width
        if self._refuses[group]:
            self._wrench[place, sensors][(corrected.status & FAULTS) != 0] = np.nan
        self._sample[place, sensors, : packet.values.shape[1]] = packet.values
        if packet.positions is not None:
            self._positions[place] = packet.positions
        self._came_ns[group] = self._last_ns = now_ns
        self.total += 1  # last, as it is what shows the sample to readers

    def since(self, number: int, most: int) -> Samples:
        """Copy samples.

        Args:
            number: Number of the first one that is wanted; where it is no longer kept, the oldest that is.
            most: Most samples to copy.

        Returns:
            The samples, in their order.
        """
        while True:
            total = self.total
            first = max(0, min(number, total), total - self.kept)
            places = np.arange(first, min(total, first + most)) % self._size
            reading = np.full((len(places), len(self._to_reading), 6), np.nan)
            for k, matrix in enumerate(self._to_reading):
                if matrix is not None:
                    reading[:, k] = self._sample[places, k, : matrix.shape[1]] @ matrix.T
            samples = Samples(
                first=first,
                time_s=np.asarray(self._time_ns[places] * 1e-9, dtype=np.float64),
                stamp_ns=self._stamp_ns[places],
                came=self._came[places],
                wrench=self._wrench[places].astype(np.float64),
                half_width=self._half_width[places].astype(np.float64),
                reading=reading,
                positions=self._positions[places].astype(np.float64),
            )
            if self.total - first < self._size:  # else new ones took the place of some while they were copied
                return samples

    def _begin(self, now_ns: int, stamp_ns: int) -> int:
        """Make the next place empty, and give it."""
        place = self.total % self._size
        self._time_ns[place], self._stamp_ns[place] = now_ns, stamp_ns
        self._came[place] = False
        for values in (self._wrench, self._half_width, self._sample):
            values[place] = np.nan
        self._positions[place] = self._positions[place - 1]
        return place

    def _hold_others(self, place: int, group: int, now_ns: int) -> None:
        """Put the last samples of other streams beside a new one."""
        for other, sensors in enumerate(self._sensors):
            if other != group and now_ns - self._came_ns[other] <= _HELD_NS:
                for values in (self._wrench, self._half_width, self._sample):
                    values[place, sensors] = values[place - 1, sensors]

    def _instant_ns(self, group: int, stamp_ns: int) -> int:
        """Time since the begin of the run: every stream has its own clock, which may begin again."""
        origin_ns = self._origin_ns[group]
        if origin_ns is None or stamp_ns - origin_ns < self._last_ns - _SECOND_NS:
            self._origin_ns[group] = origin_ns = stamp_ns - self._last_ns
        return max(self._last_ns, stamp_ns - origin_ns)


def _reading_matrix(calibration: Calibration, corrector: Corrector) -> FloatArray | None:
    """What makes a wrench by the prior of a sample; None without a prior."""
    if corrector.options.quantity is HeldQuantity.WRENCH:
        return np.eye(6)
    return None if calibration.prior is None else calibration.prior.matrix
