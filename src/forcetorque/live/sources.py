# SPDX-License-Identifier: BSD-3-Clause
"""Where packets come from: lines of a pipe, and recordings that are replayed."""

from __future__ import annotations

import os
import selectors
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.live.option_values import HeldQuantity
from forcetorque.live.packets import NUMBERS, Packet, PacketCounts
from forcetorque.live.text_lines import LineForm
from forcetorque.recording.stream import Stream

LONGEST_LINE: Final = 1 << 16
"""Bytes of the longest line."""
_CHUNK: Final = 1 << 16
WAIT_S: Final = 0.2
"""Time after which a source that has no packet says so; s."""


class Source(Protocol):
    """Gives packets until it ends."""

    counts: PacketCounts
    """What was no packet: unreadable and oversized lines, foreign datagrams."""
    rate_hz: float | None
    """Rate of the sender; None for not known."""
    numbers: int
    """Numbers of its packets, as of `PacketAccount`."""

    def packets(self) -> Iterator[Packet | None]:
        """Give packets.

        Yields:
            Packets; None whenever none is waiting, at least every `WAIT_S`.
        """


class LineSource:
    """Lines of a file descriptor, such as standard input."""

    def __init__(
        self,
        descriptor: int,
        form: LineForm,
        *,
        rate_hz: float | None = None,
        warn: Callable[[str], None] = lambda _: None,
    ) -> None:
        """Begin.

        Args:
            descriptor: Where lines are read.
            form: What they mean.
            rate_hz: Rate of the sender; Hz; None for not known.
            warn: Called with the reason for the first line that is no sample.
        """
        self.counts, self.rate_hz, self.numbers = PacketCounts(), rate_hz, form.numbers
        self._descriptor, self._form, self._warn = descriptor, form, warn
        self._number = 0

    def packets(self) -> Iterator[Packet | None]:
        """Give packets, as of `Source`.

        Yields:
            Packets; None when none is waiting.
        """
        rest, skipping = b"", False
        for chunk in self._chunks():
            if chunk is None:
                yield None
                continue
            *lines, rest = (rest + chunk).split(b"\n")
            for line in lines:
                if skipping:  # the end of a line that was too long
                    skipping = False
                    continue
                yield from self._packet(line)
            if len(rest) > LONGEST_LINE:
                if not skipping:
                    self._count_oversized()
                skipping, rest = True, b""
            yield None
        if rest and not skipping:
            yield from self._packet(rest)

    def _chunks(self) -> Iterator[bytes | None]:
        with selectors.DefaultSelector() as selector:
            try:
                selector.register(self._descriptor, selectors.EVENT_READ)
            except (OSError, ValueError):  # a file is always ready, and cannot be waited for
                waits = False
            else:
                waits = True
            while True:
                if waits and not selector.select(WAIT_S):
                    yield None
                    continue
                chunk = os.read(self._descriptor, _CHUNK)
                if not chunk:
                    return
                yield chunk

    def _count_oversized(self) -> None:
        self.counts.oversized += 1
        self._number += 1

    def _packet(self, line: bytes) -> Iterator[Packet]:
        if len(line) > LONGEST_LINE:
            self._count_oversized()
            return
        self._number += 1
        text = line.decode("utf-8", errors="replace").strip()
        if not text:
            return
        try:
            packet = self._form.packet(text)
        except FormatError as error:
            if not self.counts.unreadable:
                self._warn(f"line {self._number}: {error}; further such lines are counted only")
            self.counts.unreadable += 1
            return
        if packet is not None:
            yield packet


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ReplayedGroup:
    """Sensors of one recording with the same stamps and the same quantity."""

    sensors: tuple[ExperimentSensor, ...]
    """The sensors."""
    calibrations: tuple[Calibration, ...]
    """Their calibrations."""
    stamp_ns: IntArray
    """Stamps in the order of the log; shape (n,); ns."""
    values: FloatArray
    """Samples; shape (n, s, c); counts, or N and N m."""
    variables: FloatArray
    """Variables at these instants; shape (n, s, v)."""
    gravity: FloatArray | None
    """Free fall in the frame of the reading; shape (n, 3); m/s2; None where it is not in the stream of one sensor."""

    @property
    def quantity(self) -> HeldQuantity:
        """What its samples hold."""
        return HeldQuantity(self.sensors[0].quantity)


def replayed_groups(experiment: Experiment, calibrations: Sequence[Calibration]) -> tuple[ReplayedGroup, ...]:
    """Take from a recording what is replayed.

    Args:
        experiment: The experiment.
        calibrations: A calibration per sensor.

    Returns:
        Groups of sensors that are read together.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If the experiment lacks a sensor or a variable.
    """
    groups: list[list[tuple[ExperimentSensor, Calibration]]] = []
    for calibration in calibrations:
        sensor = experiment.sensor(calibration.sensor.name)
        calibration.require_serial(sensor.serial)
        for group in groups:
            other = group[0][0]
            stamps = experiment.recording.stream(other.stream).stamp_ns
            same = np.array_equal(experiment.recording.stream(sensor.stream).stamp_ns, stamps)
            if same and sensor.quantity == other.quantity:
                group.append((sensor, calibration))
                break
        else:
            groups.append([(sensor, calibration)])
    return tuple(_group(experiment, members) for members in groups)


def _group(experiment: Experiment, members: Sequence[tuple[ExperimentSensor, Calibration]]) -> ReplayedGroup:
    recording = experiment.recording
    stamps = recording.stream(members[0][0].stream).stamp_ns
    signals = [recording.stream(sensor.stream).signal(sensor.quantity).values for sensor, _ in members]
    names = [[variable.name for variable in calibration.variables] for _, calibration in members]
    values = np.zeros((len(stamps), len(members), max(signal.shape[1] for signal in signals)))
    variables = np.zeros((len(stamps), len(members), max(map(len, names))))
    for k, ((sensor, _), signal) in enumerate(zip(members, signals, strict=True)):
        values[:, k, : signal.shape[1]] = signal
        for place, name in enumerate(names[k]):
            variables[:, k, place] = sensor.variable(name).source.at(recording, stamps)
    return ReplayedGroup(
        sensors=tuple(sensor for sensor, _ in members),
        calibrations=tuple(calibration for _, calibration in members),
        stamp_ns=stamps,
        values=values,
        variables=variables,
        gravity=_gravity(recording.stream(members[0][0].stream), members[0][0].quantity) if len(members) == 1 else None,
    )


def _gravity(stream: Stream, quantity: str) -> FloatArray | None:
    """Gravity of the stream of a sensor, where it is in the frame of its samples."""
    gravity = stream.signals.get("gravity")
    return None if gravity is None or gravity.frame != stream.signal(quantity).frame else gravity.values


class ReplaySource:
    """Packets of groups, in the order of their stamps."""

    def __init__(
        self,
        groups: Sequence[ReplayedGroup],
        *,
        speed: float,
        rate_hz: float | None = None,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        experiment: Experiment | None = None,
    ) -> None:
        """Begin.

        Args:
            groups: What is replayed.
            speed: Times as fast as it was recorded; infinite for as fast as possible.
            rate_hz: Rate of the recording, so that gaps in time are counted; Hz; None for not known.
            clock: Gives seconds.
            sleep: Waits for seconds.
            experiment: What the groups are of, for who shows its robot.

        Raises:
            RecordingError: If the speed is not above 0.
        """
        if not speed > 0.0:
            raise RecordingError(f"speed: expected more than 0, got {speed}")
        self.counts, self.experiment = PacketCounts(), experiment
        self.rate_hz, self.numbers = rate_hz, NUMBERS
        self._groups, self._speed, self._clock, self._sleep = tuple(groups), speed, clock, sleep

    def packets(self) -> Iterator[Packet | None]:
        """Give packets, as of `Source`.

        Yields:
            Packets; None while it waits.
        """
        # late stamps stay where the log has them
        due = [np.maximum.accumulate(group.stamp_ns) for group in self._groups]
        number = np.concatenate([np.full(len(one), k) for k, one in enumerate(due)])
        place = np.concatenate([np.arange(len(one)) for one in due])
        times = np.concatenate(due)
        order = np.argsort(times, kind="stable")
        begun, first = self._clock(), int(times[order[0]]) if len(order) else 0
        for which in order.tolist():
            at = (int(times[which]) - first) * 1e-9 / self._speed
            while (left := begun + at - self._clock()) > 0.0:
                yield None
                self._sleep(min(left, WAIT_S))
            group, k = int(number[which]), int(place[which])
            replayed = self._groups[group]
            yield Packet(
                values=replayed.values[k],
                variables=replayed.variables[k],
                stamp_ns=int(replayed.stamp_ns[k]),
                gravity=None if replayed.gravity is None else replayed.gravity[k],
                group=group,
            )
