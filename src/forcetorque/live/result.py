# SPDX-License-Identifier: BSD-3-Clause
"""What a live run was worth: samples of every sensor, faults among them, bias, and packets that were lost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import counted
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import (
    FloatOrNull,
    Row,
    Shown,
    ShownWrench,
    Table,
    WrenchValues,
    optional_table,
    table_of,
)


class LiveSensor(Row):
    """One sensor of a live run."""

    sensor: Annotated[str, Shown("sensor")]
    """Name."""
    serial: Annotated[str, Shown("serial")]
    """Serial number."""
    samples: Annotated[int, Shown("samples")]
    """Samples that were corrected."""
    faulty: Annotated[int, Shown("with faults")]
    """Samples with a fault, each once."""
    not_finite: Annotated[int, Shown("not finite")]
    """Samples with NaN or infinite values."""
    saturated: Annotated[int, Shown("saturated")]
    """Samples at the limit of the converter."""
    frozen: Annotated[int, Shown("frozen")]
    """Samples that repeat one reading for too long."""
    repeated: Annotated[int, Shown("repeated")]
    """Samples whose number or stamp was there already."""
    late: Annotated[int, Shown("late")]
    """Samples that came after later ones."""
    device_errors: Annotated[int, Shown("device errors")]
    """Samples with an error of the device."""
    refused: Annotated[int, Shown("refused")]
    """Samples without a line, by the policy."""
    in_contact: Annotated[int, Shown("in contact")]
    """Samples during which the bias was not tracked."""
    wrench: Annotated[WrenchValues | None, ShownWrench("wrench", digits=3)]
    """Last wrench; N, N m; None without a sample that is finite."""
    bias: WrenchValues | None
    """Bias at the end, taken off beside the fitted offset; N, N m; None where the fitted offset was kept."""
    bias_half_width_95: WrenchValues | None
    """Half-width of its 95 % interval."""
    drift: WrenchValues | None
    """Change of the bias since the tare; None where it was not tracked."""
    power_cycle: str | None = None
    """Power cycle of the calibration whose offset was taken; None where it has none, or a tare gives the offset."""
    taring: bool
    """Whether its tare did not end: for want of time, of samples without fault, or of a load at rest."""
    tare_moved_N: float = 0.0
    """By how much the force moved during the tare, beyond noise; N; 0 for a load at rest."""


class LivePackets(Row):
    """Packets of a live run."""

    received: Annotated[int, Shown("received")]
    """Packets that could be read, repeated and late ones among them."""
    lost: Annotated[int | None, Shown("lost")]
    """Packets that never came; None where neither numbers nor stamps and a rate show it."""
    repeated: Annotated[int, Shown("repeated")]
    """Packets whose number or stamp was there already."""
    late: Annotated[int, Shown("late")]
    """Packets that came after later ones."""
    backwards: Annotated[int, Shown("time steps back")]
    """Packets in sequence whose stamp is older than that of an earlier one."""
    restarts: Annotated[int, Shown("restarts")]
    """Times that the sender began its numbers or stamps again."""
    unreadable: Annotated[int, Shown("unreadable")]
    """Lines or datagrams that are no sample."""
    oversized: Annotated[int, Shown("oversized")]
    """Lines that are too long."""
    foreign: Annotated[int, Shown("foreign")]
    """Datagrams from other addresses."""
    silences: Annotated[int, Shown("silences")]
    """Times that nothing came for longer than the limit."""
    longest_silence_s: Annotated[float, Shown("longest silence", "s", digits=1)]
    """Longest time without a packet; s."""
    unsent: Annotated[int, Shown("samples not taken")]
    """Samples that an output did not take: datagrams of `--udp`, and stamps before 1970 or after 2038 of a bag."""


class LiveCheck(Row):
    """A program of a robot on the stream of one sensor."""

    sensor: Annotated[str, Shown("sensor")]
    """Name."""
    program: Annotated[str, Shown("program")]
    """Program whose arithmetic was done."""
    file: Annotated[str, Shown("file")]
    """What it is given."""
    samples: Annotated[int, Shown("samples")]
    """Samples that were compared."""
    force_difference_N: Annotated[FloatOrNull, Shown("force", "N", digits=4, error="force_half_width_95_N")]
    """Largest difference of a component of the force; N; null without a sample."""
    force_half_width_95_N: FloatOrNull
    """Half-width of the 95 % interval of this component at this sample; null without a posterior."""
    moment_difference_Nm: Annotated[FloatOrNull, Shown("moment", "N m", digits=5, error="moment_half_width_95_Nm")]
    """Largest difference of a component of the moment; N m."""
    moment_half_width_95_Nm: FloatOrNull
    """Half-width of its 95 % interval."""
    outside: Annotated[int | None, Shown("outside")]
    """Samples with a component that differs by more than its interval; None without a sample or a posterior."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """Samples k of s sensors, copied out of a run."""

    first: int
    """Number of the first, from 0 at the begin of the run."""
    time_s: FloatArray
    """Time since the first sample, by the stamps of the senders, never decreasing; shape (k,); s."""
    stamp_ns: IntArray
    """Stamps; shape (k,); ns."""
    came: BoolArray
    """Whether the sample is of the sensor; else that of another stream stands beside its last; shape (k, s)."""
    wrench: FloatArray
    """Corrected wrenches; NaN where there is none; shape (k, s, 6); N, N m."""
    half_width: FloatArray
    """Half-widths of their 95 % intervals; shape (k, s, 6)."""
    reading: FloatArray
    """Wrenches by the prior matrix, as they were before the correction; NaN without one; shape (k, s, 6); N, N m."""
    positions: FloatArray
    """Positions of joints as they came; NaN before; shape (k, d); rad or m."""

    @property
    def next(self) -> int:
        """Number of the sample after the last."""
        return self.first + len(self.time_s)


class LiveRun(DrawnResult):
    """Account of a live run."""

    drawn_by: ClassVar[str] = "forcetorque.live.figures:live_figure"
    outlives_figure = True

    schema_name: Literal["forcetorque/live/1"] = Field(default="forcetorque/live/1", alias="schema")
    """Form of the result."""
    duration_s: float
    """Time between the first and the last sample, by the clock of the machine; s."""
    ended_by: Literal["end of input", "interrupt", "closed output"]
    """Why it ended."""
    stamps: Literal["sender", "arrival"]
    """Whose times samples have: the sender's, or those of arrival, in ns of a clock that begins at any time."""
    sensors: tuple[LiveSensor, ...]
    """One per sensor."""
    packets: LivePackets
    """What became of packets."""
    checks: tuple[LiveCheck, ...] = ()
    """Programs on the same stream."""
    slowest_s: FloatOrNull
    """Longest time from a packet to its lines; s; null without a packet."""
    replayed: bool = Field(default=False, exclude=True, repr=False)
    """Whether the samples are of a recording."""
    kept: Samples | None = Field(default=None, exclude=True, repr=False)
    """The last samples; None where none were kept."""
    output_file: str | None = None
    """Parquet file or bag; null where none was written."""

    def answers(self) -> Iterator[Answer]:
        """Give the answer for every sensor: samples, faults and losses.

        Yields:
            One per sensor.
        """
        lost = self.packets.lost
        for row in self.sensors:
            missing = "losses not countable" if lost is None else f"{lost} lost"
            packets = self.packets
            unsure = any(check.outside != 0 for check in self.checks if check.sensor == row.sensor)
            bad = bool(
                unsure
                or lost
                or row.faulty
                or packets.unreadable
                or packets.oversized
                or packets.silences
                or row.taring
                or row.tare_moved_N
            )
            yield Answer(
                subject=f"{row.sensor} ({row.serial})",
                verdict=f"{counted(row.samples, 'sample')}, {missing}, {row.faulty} with faults",
                why=tuple(self._why(row)),
                step=self._step(row),
                written=(self.output_file,),
                concern=Concern.UNCERTAIN if bad or not row.samples else Concern.NONE,
            )

    def _why(self, row: LiveSensor) -> Iterator[str]:
        packets = self.packets
        named = {
            "repeated": row.repeated,
            "late": row.late,
            "back in time": packets.backwards,
            "unreadable": packets.unreadable,
            "oversized": packets.oversized,
            "from other addresses": packets.foreign,
            "restarts": packets.restarts,
            "not finite": row.not_finite,
            "saturated": row.saturated,
            "frozen": row.frozen,
            "device errors": row.device_errors,
            "refused": row.refused,
            "not taken by an output": packets.unsent,
        }
        if counts := ", ".join(f"{count} {name}" for name, count in named.items() if count):
            yield f"{counts}."
        sentences = []
        if packets.silences:
            times = counted(packets.silences, "time")
            sentences.append(f"The source was silent {times}, for up to {packets.longest_silence_s:.1f} s.")
        if row.power_cycle is not None:
            sentences.append(f"Offset: as it was in power cycle {row.power_cycle!r} of the calibration.")
        if row.bias is not None and row.bias_half_width_95 is not None:
            force = ", ".join(
                f"{value:.2f} ±{half:.2f}" for value, half in zip(row.bias[:3], row.bias_half_width_95[:3], strict=True)
            )
            drift = "" if row.drift is None else f", {max(abs(row.drift[:3])):.2f} N away from the tare"
            sentences.append(f"Bias of the force: {force} N{drift}.")
        for check in self.checks:
            if check.sensor == row.sensor:
                sentences.append(_difference(check))
        if row.tare_moved_N:
            sentences.append(
                f"The load moved by {row.tare_moved_N:.2g} N during the tare: hold still, or state the tool."
            )
        if row.taring:
            sentences.append("Its tare did not end: the offset is that of the calibration.")
        if sentences:
            yield " ".join(sentences)

    def _step(self, row: LiveSensor) -> str:
        for check in self.checks:
            if check.sensor != row.sensor:
                continue
            if not check.samples:
                return f"look at the faults of the samples, and at their gravity where {check.program} takes a load off"
            if check.outside:
                return f"compare matrix, offset, tool and frame of {check.file} with what is stated, or write it anew"
        if self.packets.lost is None:
            if self.replayed:
                return "state --rate, so that lost samples are seen"
            stamps = "" if self.stamps == "sender" else "--stamp and "
            return f"state {stamps}--rate, or --sequence (--envelope of yarp), so that lost samples are seen"
        return "look at the network and at the rate of the sender" if self.packets.lost else ""

    def blocks(self) -> Iterator[Table | str]:
        """Give the counts.

        Yields:
            Two tables and a sentence.
        """
        yield table_of(self.sensors, "samples of sensors, and the last wrench")
        yield table_of((self.packets,), "packets")
        yield from optional_table(self.checks, "largest differences to programs, with half of our 95 % interval there")
        slowest = "" if self.slowest_s != self.slowest_s else f", slowest sample {1e3 * self.slowest_s:.1f} ms"
        yield f"ended by {self.ended_by} after {self.duration_s:.1f} s, stamps of the {self.stamps}{slowest}"


def _difference(check: LiveCheck) -> str:
    if not check.samples:
        return f"{check.program}: no sample was compared."
    interval = (
        "" if check.force_half_width_95_N != check.force_half_width_95_N else f" ±{check.force_half_width_95_N:.2g}"
    )
    samples = counted(check.samples, "sample")
    outside = f" in {samples}" if not check.outside else f"; {check.outside} of {samples} beyond the interval"
    outside += "; no interval to judge by" if check.outside is None else ""
    return (
        f"{check.program} differs by at most {check.force_difference_N:.2g}{interval} N, "
        f"{check.moment_difference_Nm:.2g} N m{outside}."
    )
