# SPDX-License-Identifier: BSD-3-Clause
"""Spans of a recording that need no support frame: those of skin, and of feet whose forces were logged."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from forcetorque.arrays import BoolArray, IntArray
from forcetorque.experiment import schema
from forcetorque.experiment.inputs import stated_in
from forcetorque.experiment.intervals import refuse_overlap, span_ns
from forcetorque.recording import Recording, Use


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedSpan:
    """A span of time, start included and end excluded; it needs no support frame."""

    label: str
    """Name of the interval."""
    start_ns: int
    """First instant; ns."""
    end_ns: int
    """First instant after it; ns."""
    use: Use
    """What it is for."""

    def holds(self, stamp_ns: IntArray) -> BoolArray:
        """Tell which instants lie in the interval.

        Args:
            stamp_ns: Instants; shape (n,); ns on the recording's clock.

        Returns:
            Whether each does; shape (n,).
        """
        inside: BoolArray = (stamp_ns >= self.start_ns) & (stamp_ns < self.end_ns)
        return inside


def read_spans(parsed: schema.ExperimentFile, file: Path, recording: Recording) -> tuple[RecordedSpan, ...]:
    """Bring the intervals of a file to the clock of its recording.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams.

    Returns:
        The spans in the order of the file.
    """
    with stated_in(f"{file}: recording"):
        first, last = recording.span_ns
    spans = []
    for index, span in enumerate(parsed.interval):
        start_ns, end_ns = span_ns(f"{file}: interval[{index}] {span.label!r}", span, first, last)
        spans.append(RecordedSpan(label=span.label, start_ns=start_ns, end_ns=end_ns, use=span.use))
    refuse_overlap(file, spans)
    return tuple(spans)
