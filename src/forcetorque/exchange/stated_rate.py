# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file states of rows without a time, whatever the format of their log: a rate and a start."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.arrays import IntArray
from forcetorque.errors import FormatError
from forcetorque.recording import Finding
from forcetorque.toml_table import Finite, Positive, Table

_LATEST_S = 9.2e9
"""Later instants do not fit into 64 bits of nanoseconds."""


class StatedRate(Table):
    """Rows that were taken at even steps of time."""

    rate_hz: Positive | None = None
    """In place of a column with the time: rows per second."""
    start_s: Finite | Annotated[tuple[Finite, ...], Field(min_length=1)] | None = None
    """With `rate_hz`: time of the first row since the epoch of the clock; s; of several files one for each."""

    @model_validator(mode="after")
    def _rate_has_a_start(self) -> StatedRate:
        if (self.rate_hz is None) != (self.start_s is None):
            raise PydanticCustomError(
                "rate_rules",
                "rate_hz needs start_s, the time of the first row on its clock, such as 0.0; and start_s needs rate_hz",
            )
        return self

    @property
    def starts_s(self) -> tuple[float, ...]:
        """Time of the first row of every file; s."""
        if self.start_s is None:
            return ()
        return self.start_s if isinstance(self.start_s, tuple) else (self.start_s,)

    def rate_findings(self, stream: str, count: int) -> tuple[Finding, ...]:
        """Say that times of rows were not logged.

        Args:
            stream: Name of the stream.
            count: Number of its rows.

        Returns:
            One finding; none where times were logged.
        """
        if self.rate_hz is None:
            return ()
        starts = ", ".join(f"{start:g} s" for start in self.starts_s)
        text = f"no time is logged: rows are taken at {self.rate_hz:g} Hz from {starts} on, as stated"
        return (Finding(stream=stream, kind="stated_rate", message=text, count=count, size=self.rate_hz, unit="Hz"),)


def even_stamps(count: int, *, rate_hz: float, start_s: float) -> IntArray:
    """Give rows times at even steps, each rounded by itself so that steps do not add up rounding.

    Args:
        count: Number n of rows.
        rate_hz: Rows per second.
        start_s: Time of the first one; s.

    Returns:
        Stamps; shape (n,); ns.

    Raises:
        FormatError: If they lie beyond what 64 bits hold, or two of them in one nanosecond.
    """
    if rate_hz > 1e9 or not abs(start_s) + count / rate_hz < _LATEST_S:
        raise FormatError(
            f"rate_hz, start_s: expected rows at most 1e9 times a second and within {_LATEST_S:g} s of the epoch, got "
            f"{count} rows at {rate_hz:g} Hz from {start_s:g} s"
        )
    stamps: IntArray = round(start_s * 1e9) + np.rint(np.arange(count) * (1e9 / rate_hz)).astype(np.int64)
    return stamps
