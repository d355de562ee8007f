# SPDX-License-Identifier: BSD-3-Clause
"""What the reader of a port gives."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.recording import Finding, Stream

CLOCK = "yarp"
"""Name of the clock of all streams of a YARP network, whose machines are assumed to be synchronised."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PortReading:
    """A stream and what was found while reading it."""

    stream: Stream
    """The stream."""
    findings: tuple[Finding, ...]
    """What is wrong with it; empty if nothing is."""
