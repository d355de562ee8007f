# SPDX-License-Identifier: BSD-3-Clause
"""What a fit was made from: its intervals, and by what their samples are known again."""

from __future__ import annotations

from pydantic import Field

from forcetorque.part import Part
from forcetorque.recording.sample_quality import UnusableCounts


class Content(Part):
    """By what the samples of an interval are known again in another log (`recording.fingerprint`)."""

    quantity: str
    """Quantity of the reading as it was logged: `raw` or `wrench`."""
    windows: str = Field(pattern=r"^([0-9a-f]{16})+$", repr=False)
    """Hashes of windows of its samples, hexadecimal numbers of 16 letters one behind the other."""


class FittedInterval(Part):
    """A stretch of time that was fitted."""

    label: str
    """Label of the interval."""
    start_ns: int
    """Start; ns on the recording's clock."""
    end_ns: int
    """End; ns on the recording's clock."""
    session: str | None = None
    """Session that it belongs to; None in files of earlier versions."""
    experiment: str | None = None
    """Experiment that it is of; None in files of earlier versions, where there was one."""
    content: Content | None = None
    """By what its samples are known again; None in files of earlier versions, and where they hardly change."""


class Provenance(Part):
    """What the fit was made from."""

    code_version: str
    """Version of this library."""
    created: str
    """Date and time of the fit, ISO 8601, UTC."""
    experiment: str
    """Name of the experiment."""
    intervals: tuple[FittedInterval, ...]
    """The fitted intervals."""
    samples: int = Field(ge=0)
    """Number of fitted samples."""
    dropped: int = Field(ge=0)
    """Samples of the intervals that were left out."""
    unusable: UnusableCounts = UnusableCounts()
    """Those among them that say nothing of the load: frozen, saturated, repeated; zeros in earlier files."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment file names it."""
    added: tuple[str, ...] = ()
    """What experiment files add to their logs: clocks, frames, joints, rates; in sentences."""
