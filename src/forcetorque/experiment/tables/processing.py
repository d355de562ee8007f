# SPDX-License-Identifier: BSD-3-Clause
"""The tables of how a log is filtered and differentiated."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import (
    Discriminator,
    Field,
    Tag,
)

from forcetorque.toml_table import Positive, Table, word_or_table


class Smoothing(Table):
    """A Savitzky-Golay filter."""

    window_s: Positive
    """Length of the window; s."""
    order: Annotated[int, Field(ge=0, strict=True)]
    """Order of the polynomial."""


class ProcessingTable(Table):
    """How logged samples become reading and reference."""

    derivatives: Annotated[
        Annotated[Smoothing, Tag("table")] | Annotated[Literal["logged"], Tag("word")],
        Discriminator(word_or_table),
    ] = Smoothing(window_s=0.3, order=3)
    """Filter that differentiates joint positions, or `logged` to take velocity and acceleration from the log."""
    smoothing: Smoothing | None = None
    """Filter of reading and reference alike inside each interval, against vibration; none if left out."""
