# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque inspect`."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.recording import Finding


class FindingRow(BaseModel):
    """One finding."""

    stream: str
    """Stream in which it was found."""
    kind: str
    """Kind, such as `gap`, `saturation`, `step`, `contact`."""
    channel: str | None
    """Channel, where it is not the whole stream."""
    start_s: float | None
    """First sample concerned; s from the earliest stamp of the recording."""
    end_s: float | None
    """Last sample concerned; s from the earliest stamp of the recording."""
    count: int
    """Number of samples concerned."""
    size: float | None
    """How large it is, in `unit`."""
    unit: str | None
    """Unit of the size."""
    message: str
    """What was found."""


class InspectResult(BaseModel):
    """What `forcetorque inspect` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/inspect/1"] = Field(default="forcetorque/inspect/1", alias="schema")
    """Form of the result."""
    source: str
    """What was inspected."""
    streams: dict[str, int]
    """Samples per stream."""
    duration_s: float
    """Time from the earliest to the latest stamp."""
    findings: list[FindingRow]
    """Findings in the order of time."""


def finding_row(finding: Finding, start_ns: int) -> FindingRow:
    """Give a finding as a row.

    Args:
        finding: The finding.
        start_ns: Earliest stamp of the recording; ns.

    Returns:
        The row.
    """
    return FindingRow(
        stream=finding.stream,
        kind=finding.kind,
        channel=finding.channel,
        start_s=None if finding.start_ns is None else (finding.start_ns - start_ns) * 1e-9,
        end_s=None if finding.end_ns is None else (finding.end_ns - start_ns) * 1e-9,
        count=finding.count,
        size=finding.size,
        unit=finding.unit,
        message=finding.message,
    )
