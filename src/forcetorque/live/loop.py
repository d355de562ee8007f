# SPDX-License-Identifier: BSD-3-Clause
"""The loop of a live run: packets are accounted for, corrected, given to outputs, and counted."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Literal, Protocol

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import NORMAL_95
from forcetorque.live.corrector import Corrected, Corrector
from forcetorque.live.option_values import FaultPolicy, OffsetSource
from forcetorque.live.outputs import CorrectedRow, Output
from forcetorque.live.packets import Packet, PacketAccount, PacketCounts
from forcetorque.live.program_check import ProgramCheck
from forcetorque.live.recent_samples import RecentSamples
from forcetorque.live.result import LivePackets, LiveRun, LiveSensor
from forcetorque.live.sample_status import FAULTS, Status
from forcetorque.live.sources import Source

SILENCE_S: Final = 2.0
"""Time without a packet from which on a source is silent; s."""
_COUNTED = {
    "not_finite": int(Status.NOT_FINITE),
    "saturated": int(Status.SATURATED),
    "frozen": int(Status.FROZEN),
    "repeated": int(Status.REPEATED),
    "late": int(Status.LATE),
    "device_errors": int(Status.DEVICE),
    "in_contact": int(Status.CONTACT),
}
"""Bits by the counts of them; plain integers, since flags of an enumeration take many times as long."""
_TARING = int(Status.TARING)


@dataclass(slots=True, kw_only=True, eq=False)
class SensorState:
    """One sensor of a run, as it is now."""

    name: str
    """Name."""
    serial: str
    """Serial number."""
    samples: int = 0
    """Samples so far."""
    faulty: int = 0
    """Samples with a fault."""
    refused: int = 0
    """Samples without a line."""
    counts: dict[str, int] = field(default_factory=lambda: dict.fromkeys(_COUNTED, 0))
    """Samples by their faults."""
    wrench: FloatArray | None = None
    """Last wrench; shape (6,); N, N m."""
    half_width: FloatArray | None = None
    """Half-width of its 95 % interval; shape (6,)."""
    status: int = 0
    """Last status."""
    tared: FloatArray | None = None
    """Bias by the tare; shape (6,)."""
    drift: FloatArray | None = None
    """Change of the bias since then; shape (6,)."""


class LiveLoop:
    """A run over one source."""

    def __init__(
        self,
        source: Source,
        correctors: Sequence[Corrector],
        outputs: Sequence[Output],
        *,
        clock: Callable[[], float],
        silence_s: float = SILENCE_S,
        warn: Callable[[str], None] = lambda _: None,
        show: Callable[[LiveLoop], None] = lambda _: None,
        checks: Sequence[ProgramCheck] = (),
        recent: RecentSamples | None = None,
    ) -> None:
        """Prepare.

        Args:
            source: Where packets come from.
            correctors: One for each group of sensors of the source.
            outputs: Where samples go.
            clock: Gives seconds.
            silence_s: Time without a packet from which on the source is silent; s.
            warn: Called when it falls silent.
            show: Called after packets, to show the state.
            checks: Programs that get the same samples.
            recent: Keeps the last samples for who looks at them; None for nobody.
        """
        self.correctors = tuple(correctors)
        self.accounts = [PacketAccount(source.rate_hz, source.numbers) for _ in correctors]
        self.states = [
            [SensorState(name=one.sensor.name, serial=one.sensor.serial) for one in corrector.calibrations]
            for corrector in correctors
        ]
        self._checks, self._recent = tuple(checks), recent
        self._source, self._outputs, self._clock = source, tuple(outputs), clock
        self._silence_s, self._warn, self._show = silence_s, warn, show
        self._first_s: float | None = None
        self._last_s = clock()
        self._silent = False
        self._slowest_s = math.nan
        self._by_arrival = False

    def run(self) -> Literal["end of input", "interrupt", "closed output"]:
        """Run until the source ends, the user interrupts, or nobody reads the output any more.

        Returns:
            Why it ended.
        """
        packets = self._source.packets()
        try:
            for packet in packets:
                if packet is None:
                    self._wait()
                else:
                    self._take(packet)
            for output in self._outputs:
                output.flush()
        except KeyboardInterrupt:
            return "interrupt"
        except BrokenPipeError:
            return "closed output"
        finally:
            close = getattr(packets, "close", None)
            if close is not None:
                close()
            if self._silent or self.silent_s > self._silence_s:
                self._count_silence(self._clock())
        return "end of input"

    @property
    def silent_s(self) -> float:
        """Time since the last packet; s."""
        return self._clock() - self._last_s

    def counts(self) -> PacketCounts:
        """Add up what became of packets.

        Returns:
            Counts of the source and of all groups.
        """
        counts = PacketCounts()
        counts.total(self._source.counts)
        for account in self.accounts:
            counts.total(account.counts)
        return counts

    def result(self, ended_by: Literal["end of input", "interrupt", "closed output"], unsent: int = 0) -> LiveRun:
        """Give the account of the run.

        Args:
            ended_by: Why it ended.
            unsent: Samples that an output did not take.

        Returns:
            The account.
        """
        counts = self.counts()
        names = (*LivePackets.model_fields.keys() - {"lost", "unsent"},)
        return LiveRun(
            duration_s=0.0 if self._first_s is None else self._last_s - self._first_s,
            ended_by=ended_by,
            stamps="arrival" if self._by_arrival else "sender",
            sensors=tuple(
                self._row(corrector, k, state)
                for corrector, states in zip(self.correctors, self.states, strict=True)
                for k, state in enumerate(states)
            ),
            packets=LivePackets(
                **{name: getattr(counts, name) for name in names},
                lost=counts.lost if counts.countable else None,
                unsent=unsent,
            ),
            checks=tuple(check.row() for check in self._checks),
            slowest_s=self._slowest_s,
        )

    def _row(self, corrector: Corrector, k: int, state: SensorState) -> LiveSensor:
        options = corrector.options
        has_bias = options.offset is not OffsetSource.FITTED and state.tared is not None
        tracked: Any = state.drift if options.offset is OffsetSource.TRACKED else None
        return LiveSensor(
            sensor=state.name,
            serial=state.serial,
            samples=state.samples,
            faulty=state.faulty,
            refused=state.refused,
            **state.counts,
            wrench=state.wrench,
            bias=corrector.bias[k].copy() if has_bias else None,
            bias_half_width_95=NORMAL_95 * np.sqrt(corrector.bias_variance[k]) if has_bias else None,
            drift=tracked,
            power_cycle=corrector.power_cycles[k],
            taring=bool(corrector.taring[k]),
            tare_moved_N=float(corrector.tare_moved_N[k]),
        )

    def _wait(self) -> None:
        silent_s = self.silent_s
        if silent_s > self._silence_s and not self._silent:
            self._silent = True
            self._warn(f"the source has been silent for {silent_s:.1f} s; waiting for it")
        for output in self._outputs:
            output.flush()
        self._show(self)

    def _count_silence(self, now: float) -> None:
        counts = self._source.counts
        counts.silences += 1
        counts.longest_silence_s = max(counts.longest_silence_s, now - self._last_s)

    def _take(self, packet: Packet) -> None:
        now = self._clock()
        if self._first_s is None:
            self._first_s = now
        elif self._silent or now - self._last_s > self._silence_s:
            self._count_silence(now)
        self._silent, self._last_s = False, now
        corrector, states = self.correctors[packet.group], self.states[packet.group]
        account = self.accounts[packet.group]
        restarts = account.counts.restarts
        known = account.add(packet)
        if account.counts.restarts > restarts:
            corrector.restart_time()
        faults = packet.faults
        if known:
            faults = [known | one for one in faults or [0] * len(states)]
        stamp_ns = packet.stamp_ns
        if stamp_ns is None:
            stamp_ns, self._by_arrival = round(now * 1e9), True
        corrected = corrector.correct(
            packet.values, variables=packet.variables, stamp_ns=stamp_ns, gravity=packet.gravity, faults=faults
        )
        for check in self._checks:
            if check.corrector is corrector:
                check.add(packet, corrected)
        self._give(corrector, states, corrected, stamp_ns)
        if self._recent is not None:
            self._recent.take(packet, corrected, stamp_ns)
        took = self._clock() - now
        self._slowest_s = took if math.isnan(self._slowest_s) else max(self._slowest_s, took)

    def _give(self, corrector: Corrector, states: list[SensorState], corrected: Corrected, stamp_ns: int) -> None:
        tells_bias = corrector.options.offset is not OffsetSource.FITTED
        for k, (state, status) in enumerate(zip(states, corrected.status.tolist(), strict=True)):
            state.samples += 1
            state.status = status
            if status:
                for name, bit in _COUNTED.items():
                    state.counts[name] += bool(status & bit)
            wrench, half_width = corrected.wrench[k], corrected.half_width[k]
            if status & FAULTS:
                state.faulty += 1
                if corrector.options.policy is FaultPolicy.REFUSE:
                    state.refused += 1
                    continue
            else:
                state.wrench, state.half_width = wrench.copy(), half_width.copy()
            if tells_bias and not status & _TARING:
                if state.tared is None:
                    state.tared = corrector.bias[k].copy()
                state.drift = corrector.bias[k] - state.tared
            if self._outputs:
                values = (*wrench.tolist(), *half_width.tolist())
                row = CorrectedRow(stamp_ns, state.name, values, status)
                for output in self._outputs:
                    output.write(row)


class LivePage(Protocol):
    """Shows a run while it lasts."""

    recent: RecentSamples
    """Takes the samples."""

    def follow(self, loop: LiveLoop) -> None:
        """Show the state of a run, too.

        Args:
            loop: The run.
        """

    def end(self, ended_by: str) -> None:
        """Show that the run ended.

        Args:
            ended_by: Why.
        """
